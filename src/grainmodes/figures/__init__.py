"""Figures of an ensemble: each a picture, the same picture as vectors, and the plotted numbers.

A figure is a module of this package of the name in `parameters.FIGURES`, with

    COLUMNS                      column → (unit, meaning), in the order of the CSV file
    table(ensemble, options)     the plotted numbers, a pure function
    draw(figure, table)          the picture of these numbers and of nothing else

Modules are imported by name when they are drawn, so that an edit of one touches that figure only.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

import matplotlib.style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from grainmodes.atomic import replaced
from grainmodes.ensemble import open_ensemble
from grainmodes.figures import appearance
from grainmodes.figures.selection import Options
from grainmodes.parameters import FIGURES

STYLE = Path(__file__).with_name("grainmodes.mplstyle")
RESOLUTION = 300


def draw(name: str, ensemble_path: str | Path, out_stem: str | Path, options: dict) -> None:
    """Write `out_stem`.png, .pdf and .csv: all three or none.

    Args:
        name: a key of `parameters.FIGURES`.
        ensemble_path: file of `write_ensemble`.
        out_stem: path without suffix.
        options: keys of `selection.Options`; {} for the choices of the paper.

    Raises:
        ValueError: unknown figure or option, or a value that the ensemble does not have.
        BlockError: the ensemble is not readable, or lacks the observable.
        OSError: a file cannot be written.
    """
    if name not in FIGURES:
        raise ValueError(f"figure {name!r}: expected one of {', '.join(FIGURES)}")
    module = import_module(f"grainmodes.figures.{name}")
    with open_ensemble(ensemble_path) as ensemble:
        table = module.table(ensemble, Options.read(name, options))
    with matplotlib.style.context(STYLE):
        figure = Figure()
        FigureCanvasAgg(figure)
        if table.empty:
            appearance.say_empty(figure)
        else:
            module.draw(figure, table)
        _write(Path(out_stem), figure, table, _header(name, module.COLUMNS))


def _header(name: str, columns: dict[str, tuple[str, str]]) -> str:
    lines = [FIGURES[name].title]
    lines += [f"{column} [{unit}]: {meaning}" for column, (unit, meaning) in columns.items()]
    return "".join(f"# {line}\n" for line in lines)


def _write(stem: Path, figure: Figure, table, header: str) -> None:
    png, pdf, csv = (stem.with_name(stem.name + suffix) for suffix in (".png", ".pdf", ".csv"))
    with replaced(png) as png, replaced(pdf) as pdf, replaced(csv) as csv:
        figure.savefig(png, format="png", dpi=RESOLUTION, metadata={"Software": None})
        figure.savefig(pdf, format="pdf", metadata={"CreationDate": None})
        csv.write_text(header + table.to_csv(index=False), encoding="utf-8")
