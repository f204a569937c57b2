"""Commands that join blocks and points, draw figures, and check claims."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from grainmodes.parameters.figures import FIGURES


def gather(arguments: Namespace) -> None:
    """Blocks of one point → the point."""
    from grainmodes.dataset.files import write_block
    from grainmodes.ensemble import gather_point

    write_block(arguments.output, gather_point(arguments.blocks))


def ensemble(arguments: Namespace) -> None:
    """Points → the ensemble."""
    from grainmodes.ensemble import write_ensemble

    write_ensemble(arguments.points, arguments.output, arguments.config)


def figure(arguments: Namespace) -> None:
    """An ensemble, or files of single samples → one figure."""
    from grainmodes.figures import draw

    given = {name: getattr(arguments, name) for name in ("n", "phi", "kt", "bin_density", "seed")}
    options = {name: value for name, value in given.items() if value is not None}
    draw(arguments.figure, _source(arguments), arguments.output, options)


def _source(arguments: Namespace) -> Path | list[Path]:
    """What the figure is drawn from: files of single samples, or one ensemble."""
    if FIGURES[arguments.figure].source != "ensemble":
        return arguments.data
    if len(arguments.data) > 1:
        raise ValueError(
            f"figure {arguments.figure}: expected one ensemble, got {len(arguments.data)} files"
        )
    return arguments.data[0]


def film(arguments: Namespace) -> None:
    """Released samples → the film of one of them."""
    from grainmodes.figures.paper_c import film

    given = {name: getattr(arguments, name) for name in ("n", "phi", "kt", "seed")}
    options = {name: value for name, value in given.items() if value is not None}
    film.write(arguments.data, arguments.output, options)


def claims(arguments: Namespace) -> None:
    """An ensemble → the verdict on every claim."""
    from grainmodes.claims import check, report
    from grainmodes.claims.samples import points_left_out
    from grainmodes.ensemble import open_ensemble

    for path in arguments.outputs:
        report.form(path)
    with open_ensemble(arguments.ensemble) as opened:
        verdicts, remark = check(opened), points_left_out(opened)
    for path in arguments.outputs:
        report.write(verdicts, path, remark)
    if not arguments.outputs:
        print(report.as_text(verdicts, remark), end="")
