"""The table of verdicts as text for a terminal, as a page in Markdown, and as CSV."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, fields
from pathlib import Path

from grainmodes.claims.claim import Verdict
from grainmodes.runtime.atomic import replaced

COLUMNS = [field.name for field in fields(Verdict)]

HEADS = ("claim", "statement", "asked of", "criterion", "measured", "verdict", "needed")
"""Columns of the page."""


def as_text(verdicts: list[Verdict], remark: str = "") -> str:
    """One line per claim: its name, verdict, measured number, statement and what is needed."""
    rows = [(v.claim, v.verdict, _measured(v), v.statement) for v in verdicts]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(map(str.ljust, row, widths)).rstrip() + _needed(verdict)
        for row, verdict in zip(rows, verdicts, strict=True)
    ]
    return "\n".join([*lines, "", _summary(verdicts, remark)]) + "\n"


def as_markdown(verdicts: list[Verdict], remark: str = "") -> str:
    """The table, and below it the explanation of every verdict."""
    head = f"| {' | '.join(HEADS)} |\n| {' | '.join('---' for _ in HEADS)} |\n"
    rows = [
        (v.claim, v.statement, v.asked_of, v.criterion, _named(v), v.verdict, v.needed or "-")
        for v in verdicts
    ]
    table = "".join(f"| {' | '.join(map(_cell, row))} |\n" for row in rows)
    found = "".join(f"\n**{v.claim}, {v.verdict}.** {_cell(v.explanation)}\n" for v in verdicts)
    return f"# Claims, checked\n\n{_summary(verdicts, remark)}\n\n{head}{table}{found}"


def as_csv(verdicts: list[Verdict], _remark: str = "") -> str:
    """One row per claim, with the columns `COLUMNS`; a table has no place for the remark."""
    out = io.StringIO()
    writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(map(asdict, verdicts))
    return out.getvalue()


FORMS: dict[str, Callable[[list[Verdict], str], str]] = {".md": as_markdown, ".csv": as_csv}
"""Suffix of a file → function that returns its content."""


def form(path: Path) -> Callable[[list[Verdict], str], str]:
    """The function that returns the content of a file, by its suffix.

    Raises:
        ValueError: the suffix is neither .md nor .csv.
    """
    if path.suffix not in FORMS:
        raise ValueError(f"{path}: expected a suffix among {', '.join(FORMS)}, got {path.suffix!r}")
    return FORMS[path.suffix]


def write(verdicts: list[Verdict], path: Path, remark: str = "") -> None:
    """Write a page or a table, all of it or nothing.

    Args:
        remark: a sentence on the ensemble, which stands beside the numbers of verdicts.

    Raises:
        ValueError: as `form`.
        OSError: the file cannot be written.
    """
    content = form(path)(verdicts, remark)
    with replaced(path) as partial:
        partial.write_text(content, encoding="utf-8")


def _measured(verdict: Verdict) -> str:
    unit = "" if verdict.unit == "1" or verdict.printed == "-" else f" {verdict.unit}"
    return f"{verdict.printed}{unit}"


def _needed(verdict: Verdict) -> str:
    return f" (needed: {verdict.needed})" if verdict.needed else ""


def _named(verdict: Verdict) -> str:
    return f"{verdict.where}: {_measured(verdict)}" if verdict.where else _measured(verdict)


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _summary(verdicts: list[Verdict], remark: str) -> str:
    counts = Counter(verdict.verdict for verdict in verdicts)
    listed = ", ".join(f"{count} {name}" for name, count in counts.items())
    return f"{listed}. {remark}".strip()
