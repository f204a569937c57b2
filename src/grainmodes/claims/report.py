"""The table of verdicts as text for a terminal, as a page in Markdown, and as CSV."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, fields
from pathlib import Path

import numpy as np

from grainmodes.claims.claim import Verdict
from grainmodes.runtime.atomic import replaced
from grainmodes.statistics.rounding import value_with_error

COLUMNS = [field.name for field in fields(Verdict)]


def as_text(verdicts: list[Verdict]) -> str:
    """One line per claim: its name, verdict, measured number and statement."""
    rows = [(v.claim, v.verdict, _measured(v), v.statement) for v in verdicts]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ["  ".join(map(str.ljust, row, widths)).rstrip() for row in rows]
    return "\n".join([*lines, "", _counts(verdicts)]) + "\n"


def as_markdown(verdicts: list[Verdict]) -> str:
    """The table, and below it the explanation of every verdict."""
    head = (
        "| claim | statement | measured | criterion | verdict |\n| --- | --- | --- | --- | --- |\n"
    )
    rows = [(v.claim, v.statement, _named(v), v.criterion, v.verdict) for v in verdicts]
    table = "".join(f"| {' | '.join(map(_cell, row))} |\n" for row in rows)
    found = "".join(f"\n**{v.claim}, {v.verdict}.** {_cell(v.explanation)}\n" for v in verdicts)
    return f"# Claims of papers A, B and C\n\n{_counts(verdicts)}\n\n{head}{table}{found}"


def as_csv(verdicts: list[Verdict]) -> str:
    """One row per claim, with the columns `COLUMNS`."""
    out = io.StringIO()
    writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(map(asdict, verdicts))
    return out.getvalue()


FORMS: dict[str, Callable[[list[Verdict]], str]] = {".md": as_markdown, ".csv": as_csv}
"""Suffix of a file → function that returns its content."""


def form(path: Path) -> Callable[[list[Verdict]], str]:
    """The function that returns the content of a file, by its suffix.

    Raises:
        ValueError: the suffix is neither .md nor .csv.
    """
    if path.suffix not in FORMS:
        raise ValueError(f"{path}: expected a suffix among {', '.join(FORMS)}, got {path.suffix!r}")
    return FORMS[path.suffix]


def write(verdicts: list[Verdict], path: Path) -> None:
    """Write a page or a table, all of it or nothing.

    Raises:
        ValueError: as `form`.
        OSError: the file cannot be written.
    """
    content = form(path)(verdicts)
    with replaced(path) as partial:
        partial.write_text(content, encoding="utf-8")


def _measured(verdict: Verdict) -> str:
    if not np.isfinite(verdict.measured):
        return "-"
    unit = "" if verdict.unit == "1" else f" {verdict.unit}"
    return f"{value_with_error(verdict.measured, verdict.uncertainty)}{unit}"


def _named(verdict: Verdict) -> str:
    return f"{verdict.where}: {_measured(verdict)}" if verdict.where else _measured(verdict)


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _counts(verdicts: list[Verdict]) -> str:
    counts = Counter(verdict.verdict for verdict in verdicts)
    return ", ".join(f"{count} {name}" for name, count in counts.items()) + "."
