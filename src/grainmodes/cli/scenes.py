"""Commands that estimate the cost of a scene, or the seeds that an accuracy needs."""

from __future__ import annotations

from argparse import Namespace


def cost(arguments: Namespace) -> None:
    """A scene → what it will cost.

    Raises:
        ValueError: the scene or the table has mistakes, or the scene costs too much.
    """
    from grainmodes.configuration import read_scene
    from grainmodes.cost import COSTS, check_budget, read_table, report

    scene = read_scene(arguments.config)
    check_budget(scene, read_table())
    print(report(scene, read_table(arguments.costs or COSTS), arguments.cores))


def plan(arguments: Namespace) -> None:
    """A pilot ensemble → the seeds and the CPU hours that an accuracy needs.

    Raises:
        ValueError: the table has mistakes, or nothing can be planned from this pilot.
    """
    from grainmodes.cost import COSTS, read_table
    from grainmodes.ensemble import open_ensemble
    from grainmodes.planning import report

    table = read_table(arguments.costs or COSTS)
    with open_ensemble(arguments.ensemble) as opened:
        try:
            print(report(opened, arguments.target_error, table))
        except ValueError as error:
            raise ValueError(f"{arguments.ensemble}: {error}") from error
