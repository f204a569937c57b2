"""Commands about a scene that compute nothing."""

from __future__ import annotations

from argparse import Namespace


def cost(arguments: Namespace) -> None:
    """A scene → what it will cost.

    Raises:
        ValueError: the scene or the table has mistakes, or there is no core.
    """
    from grainmodes.configuration import read_scene
    from grainmodes.cost import COSTS, read_table, report

    if arguments.cores < 1:
        raise ValueError(f"--cores = {arguments.cores}: allowed is a whole number from 1")
    scene = read_scene(arguments.config)
    print(report(scene, read_table(arguments.costs or COSTS), arguments.cores))
