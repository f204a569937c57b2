"""Reads what every figure writes: a PNG, a PDF, and its numbers."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from grainmodes.parameters.figures import FIGURES


def numbers_of(folder: Path, name: str) -> pd.DataFrame:
    """The numbers of a figure drawn into a folder, once all three files are what they should be."""
    assert (folder / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    assert (folder / f"{name}.pdf").read_bytes().startswith(b"%PDF")
    header = [line for line in (folder / f"{name}.csv").open() if line.startswith("#")]
    numbers = pd.read_csv(folder / f"{name}.csv", comment="#")
    assert header[0] == f"# {FIGURES[name].title}\n"
    assert [line.split()[1] for line in header[1:]] == list(numbers.columns)
    return numbers
