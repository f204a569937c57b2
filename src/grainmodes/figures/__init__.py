"""Figures of the papers: each a picture, the same picture as vectors, and the plotted numbers.

| package   | holds                                          |
| --------- | ---------------------------------------------- |
| `paper_a` | figures of paper A, a module each              |
| `paper_b` | figures of paper B                             |
| `paper_c` | figures of paper C, and a film of its Fig. 5   |
| `shared`  | what several figures need: rows, panels, words |

The name of a figure in `parameters.figures.FIGURES` is the name of its module, which has

    COLUMNS                      column → (unit, meaning), in the order of the CSV file
    table(source, options)       the plotted numbers, a pure function
    draw(figure, table)          the picture of these numbers and of nothing else

The source is the ensemble, or a list of blocks: the files of single samples.

Modules are imported by name when they are drawn, so that an edit of one affects its figure only.
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
from grainmodes.figures.shared.labels import say_empty
from grainmodes.figures.shared.sample_files import read_samples
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.figures import FIGURES
from grainmodes.runtime.atomic import replaced

STYLE = Path(__file__).with_name("grainmodes.mplstyle")
DOTS_PER_INCH = 300
PDF_DOTS_PER_INCH = 450
"""Resolution of the parts of a PDF that are pixels: maps and curves of very many symbols."""


def draw(name: str, data: str | Path | list[Path], out_stem: str | Path, options: dict) -> None:
    """Write `out_stem`.png, .pdf and .csv: all three or none.

    Args:
        name: a key of `parameters.figures.FIGURES`.
        data: file of `write_ensemble`; a list of files if the figure shows single samples.
        out_stem: path without suffix.
        options: keys of `selection.Options`; {} for the choices of the paper.

    Raises:
        ValueError: the figure or an option is unknown, or the source lacks a requested value.
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
            say_empty(figure)
        else:
            module.draw(figure, table)
        _write(Path(out_stem), figure, table, _header(name, module.COLUMNS))


@contextmanager
def _opened(name: str, data: str | Path | list[Path]) -> Iterator:
    """The ensemble or the blocks from which a figure is drawn."""
    source = FIGURES[name].source
    if source != "ensemble":
        yield read_samples(data, source)
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
        figure.savefig(png, format="png", dpi=DOTS_PER_INCH, metadata={"Software": None})
        figure.savefig(pdf, format="pdf", dpi=PDF_DOTS_PER_INCH, metadata={"CreationDate": None})
        csv.write_text(header + table.to_csv(index=False), encoding="utf-8")
