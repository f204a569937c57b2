"""The file of a measured diagram: its words, the machine and the code, then a row per setting."""

from __future__ import annotations

import os
import platform
from pathlib import Path
from typing import NamedTuple

import numba
import numpy as np
import pandas as pd
import scipy

from grainmodes.runtime.atomic import replaced
from grainmodes.runtime.provenance import code_version
from measurements.accuracy.diagram import Diagram, DiagramRow, Size
from measurements.machine import default_factorisation, processor_model

WORDS = ("title", "grains", "setting", "unit", "error", "reference", "machine", "code")
"""Keys of the comment on top."""


class Table(NamedTuple):
    """A file in memory: key → words, and a row per setting with the columns of `DiagramRow`."""

    words: dict[str, str]
    rows: pd.DataFrame


def machine() -> str:
    """Processor, cores and the libraries that matter."""
    versions = {"numpy": np, "scipy": scipy, "numba": numba}
    libraries = [f"{name} {module.__version__}" for name, module in versions.items()]
    python = f"Python {platform.python_version()}"
    processor = processor_model() or platform.processor() or platform.machine()
    cores = f"{processor}, {os.cpu_count()} cores"
    return ", ".join([cores, python, *libraries, default_factorisation()])


def table_of(diagram: Diagram, size: Size, rows: list[DiagramRow]) -> Table:
    """What was measured here and now."""
    words = {name: getattr(diagram, name) for name in WORDS if hasattr(diagram, name)}
    words |= {"grains": ", ".join(map(str, size.n))}
    words |= {"machine": machine(), "code": code_version()}
    return Table(words, pd.DataFrame(rows, columns=list(DiagramRow._fields)))


def write(path: Path, table: Table) -> None:
    """Write a table, whole or not at all.

    Raises:
        OSError: it cannot be written.
    """
    head = "".join(f"# {name}: {table.words[name]}\n" for name in WORDS)
    with replaced(path) as partial:
        partial.write_text(head + table.rows.to_csv(index=False), encoding="utf-8")


def read(path: Path) -> Table:
    """The table in a file of `write`.

    Raises:
        OSError: it cannot be read.
        ValueError: it is not such a file.
    """
    lines = path.read_text(encoding="utf-8").splitlines()
    pairs = (line[1:].partition(":") for line in lines if line.startswith("#"))
    words = {name.strip(): text.strip() for name, _, text in pairs}
    missing = [name for name in WORDS if name not in words]
    if missing:
        raise ValueError(
            f"{path}: expected a file of measure.py, got no {', '.join(missing)} in its head"
        )
    rows = pd.read_csv(path, comment="#")
    if list(rows.columns) != list(DiagramRow._fields):
        raise ValueError(
            f"{path}: expected the columns {', '.join(DiagramRow._fields)}, "
            f"got {', '.join(rows.columns)}"
        )
    return Table(words, rows)


def curves(table: Table) -> dict[str, list[DiagramRow]]:
    """The rows of every curve, in the order of the file."""
    rows = [DiagramRow(*values) for values in table.rows.itertuples(index=False)]
    return {
        name: [row for row in rows if row.curve == name] for name in table.rows["curve"].unique()
    }
