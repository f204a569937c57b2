"""How a claim is judged: parts with their uncertainty, a criterion, and one verdict.

A claim is a function of an ensemble that returns an `Outcome`. The first line of its docstring is
the statement that is printed in the table, its paragraph `Asked of:` says which parts the claim
must have, and its paragraph `Criterion:` is the criterion, so that text and check are in one place.
`claim` turns it into a function that returns a `Verdict`.

The parts are grouped by what they need in the ensemble. A claim of which a group is empty was not
tested, whatever its other parts say, unless one of them contradicts it.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from grainmodes.claims.part import (
    CONTRADICTED,
    HOLDS,
    NOT_COMPARABLE,
    NOT_RESOLVED,
    Part,
    by_certainty,
    needed_by,
    verdicts_of,
)

if TYPE_CHECKING:
    import xarray as xr

NOT_TESTED = "not tested"

SUMMARIES = {
    HOLDS: ("hold", "least certain"),
    NOT_RESOLVED: ("are not resolved", "least certain"),
    NOT_COMPARABLE: ("are not comparable at this size", "least certain"),
    CONTRADICTED: ("are contradicted", "most certain"),
}
"""Verdict → what an explanation says about the parts that have it and about the first of them, in
ascending severity: the verdict of a claim is the severest among its parts."""

MAX_NAMED_PARTS = 4
"""Largest number of parts that an explanation lists."""


class NotTested(Exception):
    """The ensemble lacks what a claim needs; the message says what."""


class Outcome(NamedTuple):
    """The parts of a claim, and a note: a sentence or two with the numbers behind them.

    `parts`: what a part of the claim needs in the ensemble → these parts. Every part that the claim
    must have has its entry, empty where the ensemble lacks what it needs.
    """

    parts: dict[str, list[Part]]
    note: str = ""


@dataclass(frozen=True)
class Verdict:
    """A row of the table of claims.

    `measured` is the number of the part that decided, of those with the verdict of the claim the
    first that the explanation names; NaN if the claim was not tested. `low` and `high` are the ends
    of its 95 % interval, `printed` is the number with its uncertainty, and `where` says where it
    was measured. `needed` says what would decide a claim that is not decided.
    """

    claim: str
    statement: str
    asked_of: str
    where: str
    measured: float
    low: float
    high: float
    printed: str
    unit: str
    criterion: str
    verdict: str
    needed: str
    explanation: str


Claim = Callable[["xr.Dataset"], Verdict]


def claim(name: str, unit: str) -> Callable[[Callable[[xr.Dataset], Outcome]], Claim]:
    """Make a function that returns an `Outcome` return the `Verdict` on claim `name`.

    Args:
        name: such as A6 for the sixth claim of paper A.
        unit: of the measured number; "1" for none.
    """

    def decorate(function: Callable[[xr.Dataset], Outcome]) -> Claim:
        statement = _paragraph(function, "")
        asked_of, criterion = (_paragraph(function, head) for head in ("Asked of: ", "Criterion: "))

        @wraps(function)
        def judge(ensemble: xr.Dataset) -> Verdict:
            part, verdict, needed, explanation = _judged(function, ensemble)
            number = _number(part)
            return Verdict(
                name, statement, asked_of, *number, unit, criterion, verdict, needed, explanation
            )

        return judge

    return decorate


def _paragraph(function: Callable, head: str) -> str:
    """The first paragraph of the docstring that begins so, without this beginning."""
    paragraphs = [" ".join(text.split()) for text in _docstring(function).split("\n\n")]
    return next(text for text in paragraphs if text.startswith(head)).removeprefix(head)


def _docstring(function: Callable) -> str:
    """The docstring of a function; read in its source where Python runs with -OO."""
    if function.__doc__:
        return inspect.cleandoc(function.__doc__)
    (definition,) = ast.parse(inspect.getsource(function)).body
    return ast.get_docstring(cast(ast.FunctionDef, definition)) or ""


def _number(part: Part | None) -> tuple[str, float, float, float, str]:
    if part is None:
        return "", np.nan, np.nan, np.nan, "-"
    measured = part.measured
    return part.where, measured.value, *measured.interval(), str(measured)


def _judged(function: Callable, ensemble: xr.Dataset) -> tuple[Part | None, str, str, str]:
    """The part that decides, the verdict, what is needed for a better one, and the explanation."""
    try:
        groups, note = function(ensemble)
    except NotTested as missing:
        return None, NOT_TESTED, str(missing), f"The ensemble lacks {missing}."
    parts = list(chain.from_iterable(groups.values()))
    absent = " and ".join(need for need, group in groups.items() if not group)
    lacking = f"The ensemble lacks {absent}." if absent else ""
    if not parts:
        return None, NOT_TESTED, absent, lacking
    verdicts = verdicts_of(parts)
    worst = max(verdicts, key=list(SUMMARIES).index)
    alike = [part for part, found in zip(parts, verdicts, strict=True) if found == worst]
    same = by_certainty(alike, worst)
    verdict = NOT_TESTED if absent and worst != CONTRADICTED else worst
    needed = (
        absent
        if verdict == NOT_TESTED
        else needed_by(same, verdict, sum(part.decidable for part in parts))
    )
    explanation = " ".join(filter(None, (lacking, _summary(parts, same, worst), note)))
    return same[0], verdict, needed, explanation


def _summary(parts: list[Part], same: list[Part], verdict: str) -> str:
    """How many parts have the verdict, and a list of them."""
    named = "; ".join(f"{part.where}: {part.printed}" for part in same[:MAX_NAMED_PARTS])
    others = len(same) - MAX_NAMED_PARTS
    rest = f"; and {others} more" if others > 0 else ""
    verb, first = SUMMARIES[verdict]
    order = f", the {first} first" if len(same) > 1 else ""
    return f"Parts that {verb}: {len(same)} of {len(parts)}{order}. {named}{rest}."
