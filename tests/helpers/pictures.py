"""Reads what every figure writes: a PNG, a PDF, its numbers, and its caption."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from grainmodes.parameters.figures import FIGURES


def numbers_of(folder: Path, name: str) -> pd.DataFrame:
    """The numbers of a figure drawn into a folder, once all four files are what they should be."""
    assert (folder / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    assert (folder / f"{name}.pdf").read_bytes().startswith(b"%PDF")
    header = [line for line in (folder / f"{name}.csv").open() if line.startswith("#")]
    numbers = pd.read_csv(folder / f"{name}.csv", comment="#")
    assert header[0] == f"# {FIGURES[name].title}\n"
    assert [line.split()[1] for line in header[1:]] == list(numbers.columns)
    caption = caption_of(folder, name)
    assert caption[0] == f"{FIGURES[name].title}."
    assert numbers.empty or [caption[2].split()[0], caption[3][:8]] == ["Drawn:", "Look at:"]
    return numbers


def caption_of(folder: Path, name: str) -> list[str]:
    """The paragraphs of the caption of a figure."""
    text = (folder / f"{name}.txt").read_text(encoding="utf-8")
    return [" ".join(paragraph.split()) for paragraph in text.split("\n\n")]
