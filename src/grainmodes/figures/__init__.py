"""Figures: each a picture, the same picture as vectors, and the plotted numbers.

A figure is a module of its paper's package, of the name in `parameters.figures.FIGURES`, with

    COLUMNS                      column → (unit, meaning), in the order of the CSV file
    table(source, options)       the plotted numbers, a pure function
    draw(figure, table)          the picture of these numbers and of nothing else

Its source is the ensemble, or the files of single samples: a list of blocks.

Modules are imported by name when they are drawn, so that an edit of one touches that figure only.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path

import matplotlib.style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from grainmodes.ensemble import open_ensemble
from grainmodes.figures.shared import appearance, field_rows
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.figures import FIGURES
from grainmodes.runtime.atomic import replaced

STYLE = Path(__file__).with_name("grainmodes.mplstyle")
RESOLUTION = 300
FINE_RESOLUTION = 450
"""Dots per inch of what is pixels within a PDF: crowds of symbols."""


def draw(name: str, data: str | Path | list[Path], out_stem: str | Path, options: dict) -> None:
    """Write `out_stem`.png, .pdf and .csv: all three or none.

    Args:
        name: a key of `parameters.figures.FIGURES`.
        data: file of `write_ensemble`; a list of files, where the figure's source is a stage that
            keeps single samples.
        out_stem: path without suffix.
        options: keys of `selection.Options`; {} for the choices of the paper.

    Raises:
        ValueError: unknown figure or option, or a value that the source does not have.
        BlockError: a file is not readable, or lacks the observable.
        OSError: a file cannot be written.
    """
    if name not in FIGURES:
        raise ValueError(f"figure: expected one of {', '.join(FIGURES)}, got {name!r}")
    module = import_module(f"grainmodes.figures.{FIGURES[name].room}.{name}")
    with _opened(name, data) as source:
        table = module.table(source, Options.read(name, options))
    with matplotlib.style.context(STYLE):
        figure = Figure()
        FigureCanvasAgg(figure)
        if table.empty:
            appearance.say_empty(figure)
        else:
            module.draw(figure, table)
        _write(Path(out_stem), figure, table, _header(name, module.COLUMNS))


@contextmanager
def _opened(name: str, data: str | Path | list[Path]) -> Iterator:
    """What a figure is drawn from."""
    source = FIGURES[name].source
    if source != "ensemble":
        yield field_rows.read(data, source)
    else:
        with open_ensemble(data) as ensemble:
            yield ensemble


def _header(name: str, columns: dict[str, tuple[str, str]]) -> str:
    lines = [FIGURES[name].title]
    lines += [f"{column} [{unit}]: {meaning}" for column, (unit, meaning) in columns.items()]
    return "".join(f"# {line}\n" for line in lines)


def _write(stem: Path, figure: Figure, table, header: str) -> None:
    png, pdf, csv = (stem.with_name(stem.name + suffix) for suffix in (".png", ".pdf", ".csv"))
    with replaced(png) as png, replaced(pdf) as pdf, replaced(csv) as csv:
        figure.savefig(png, format="png", dpi=RESOLUTION, metadata={"Software": None})
        figure.savefig(pdf, format="pdf", dpi=FINE_RESOLUTION, metadata={"CreationDate": None})
        csv.write_text(header + table.to_csv(index=False), encoding="utf-8")
