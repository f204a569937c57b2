"""Figures of the papers: a picture, the same as vectors, the plotted numbers, and a caption.

| package   | holds                                          |
| --------- | ---------------------------------------------- |
| `paper_a` | figures of paper A, a module each              |
| `paper_b` | figures of paper B                             |
| `paper_c` | figures of paper C, and a film of its Fig. 5   |
| `own`     | figures of our own claims                      |
| `shared`  | what several figures need: rows, panels, words |

The name of a figure in `parameters.figures.FIGURES` is the name of its module, which has

    COLUMNS                      column → (unit, meaning), in the order of the CSV file
    table(source, options)       the plotted numbers, a pure function
    draw(figure, table)          the picture of these numbers and of nothing else
    caption(table)               what is drawn and what to look at: `shared.captions.Caption`
    EMPTY                        what an empty table means, if not that no sample is jammed or has
                                 its observable (`shared.missing.NOTHING`)

The source is the ensemble, or a list of blocks: the files of single samples.

Modules are imported by name when they are drawn, so that an edit of one affects its figure only.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path

import pandas as pd
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from grainmodes.dataset.files import BlockError
from grainmodes.ensemble import contact_law, open_ensemble
from grainmodes.figures.shared import appearance, captions, labels, missing
from grainmodes.figures.shared.sample_files import (
    compressed_with_friction,
    law_of,
    read_samples,
)
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.figures import FIGURES, files_of_stem
from grainmodes.runtime.atomic import replaced

DOTS_PER_INCH = 300
PDF_DOTS_PER_INCH = 450
"""Resolution of the parts of a PDF that are pixels: maps and curves of very many symbols."""


def draw(name: str, data: str | Path | list[Path], out_stem: str | Path, options: dict) -> None:
    """Write `out_stem`.png, .pdf, .csv and the caption .txt: all four or none.

    Args:
        name: a key of `parameters.figures.FIGURES`.
        data: file of `write_ensemble`; a list of files if the figure shows single samples.
        out_stem: path, to which the suffix of each form is added.
        options: keys of `selection.Options`; {} for the choices of the paper.

    Raises:
        ValueError: the figure or an option is unknown, or the figure does not use the option, or
            the source lacks a requested value.
        BlockError: a file is not readable, or lacks the observable.
        OSError: a file cannot be written.
    """
    if name not in FIGURES:
        raise ValueError(f"figure: expected one of {', '.join(FIGURES)}, got {name!r}")
    module = import_module(f"grainmodes.figures.{FIGURES[name].room}.{name}")
    chosen = Options.read(name, options)
    with _opened(name, data) as source:
        short = missing.shortages(name, source)
        try:
            table = module.table(source, chosen)
        except (BlockError, ValueError):
            # A variable, or all values of a coordinate, are gone together with their samples.
            if options or not any(shortage.used == 0 for shortage in short):
                raise
            table = pd.DataFrame(columns=list(module.COLUMNS))
        if not table.empty:
            chosen.check_used(name)
        law = law_of(source[0]) if isinstance(source, list) else contact_law(source)
        loaded = compressed_with_friction(source, table)
    title, empty = FIGURES[name].title, getattr(module, "EMPTY", "")
    lacking = missing.notes(name, short, table, empty)
    with appearance.house_style():
        figure = Figure()
        FigureCanvasAgg(figure)
        if table.empty:
            labels.say_empty(figure, lacking)
            caption = captions.in_paragraphs(f"{title}.", f"Empty: {captions.listed(lacking)}.")
        else:
            module.draw(figure, table)
            labels.write_below(figure, lacking)
            words = module.caption(table)
            caption = captions.caption_text(title, words, table, law, lacking, loaded)
        header = _header(title, module.COLUMNS, lacking)
        numbers = header + table.to_csv(index=False)
        _write(Path(out_stem), figure, numbers, caption, beyond=bool(lacking))


@contextmanager
def _opened(name: str, data: str | Path | list[Path]) -> Iterator:
    """The ensemble or the blocks from which a figure is drawn."""
    source = FIGURES[name].source
    if source != "ensemble":
        yield read_samples(data, source)
    else:
        with open_ensemble(data) as ensemble:
            yield ensemble


def _header(title: str, columns: dict[str, tuple[str, str]], lacking: list[str]) -> str:
    lines = [title, *(f"{name} [{unit}]: {meaning}" for name, (unit, meaning) in columns.items())]
    lines += [f"missing: {labels.plain(line)}" for line in lacking]
    return "".join(f"# {line}\n" for line in lines)


def _write(stem: Path, figure: Figure, numbers: str, caption: str, beyond: bool) -> None:
    """Write all four files; `beyond`: something is drawn outside of the figure."""
    png, pdf, csv, txt = files_of_stem(stem)
    with replaced(png) as png, replaced(pdf) as pdf, replaced(csv) as csv, replaced(txt) as txt:
        box, metadata = "tight" if beyond else None, {"Software": None}
        figure.savefig(png, format="png", dpi=DOTS_PER_INCH, metadata=metadata, bbox_inches=box)
        metadata = {"CreationDate": None}
        figure.savefig(pdf, format="pdf", dpi=PDF_DOTS_PER_INCH, metadata=metadata, bbox_inches=box)
        csv.write_text(numbers, encoding="utf-8")
        txt.write_text(caption, encoding="utf-8")
