"""How a claim of a paper is judged: parts with a standard error, a criterion, and one verdict.

A claim is a function of an ensemble that returns an `Outcome`. The first line of its docstring is
the statement that is printed in the table, and its paragraph `Criterion:` is the criterion, so that
text and check are in one place. `claim` turns it into a function that returns a `Verdict`.

A part is a number with its standard error and the interval in which the claim expects it. It holds
if it lies inside by at least two standard errors, and is contradicted if it lies outside by more
than three; otherwise, or without an error, it is not resolved. The limit is three because a claim
has many parts: with ten samples, one part in seventy lies that far outside by chance. A claim holds
if all its parts hold, and is contradicted if one of them is.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from grainmodes.statistics.estimates import Estimate

if TYPE_CHECKING:
    import xarray as xr

HOLDS = "holds"
CONTRADICTED = "contradicted"
NOT_RESOLVED = "not resolved at this size"
NOT_TESTED = "not tested"

SUMMARIES = {
    HOLDS: ("hold", "nearest to the limit"),
    NOT_RESOLVED: ("are not resolved", "farthest outside"),
    CONTRADICTED: ("are contradicted", "farthest outside"),
}
"""Verdict → what an explanation says about the parts that have it and about the first of them, in
ascending severity: the verdict of a claim is the severest among its parts."""

ERRORS_TO_HOLD = 2.0
"""Number of standard errors by which a part must lie inside its interval to hold."""

ERRORS_TO_CONTRADICT = 3.0
"""Number of standard errors by which a part must lie outside its interval to contradict."""

MAX_NAMED_PARTS = 4
"""Largest number of parts that an explanation lists."""


class NotTested(Exception):
    """The ensemble lacks what a claim needs; the message says what."""


class Part(NamedTuple):
    """One number of a claim: where it was measured, and the interval in which it is expected."""

    where: str
    estimate: Estimate
    low: float = -np.inf
    high: float = np.inf

    @property
    def margin(self) -> float:
        """Distance from the nearer end of the interval; negative outside."""
        return min(self.estimate.value - self.low, self.high - self.estimate.value)

    @property
    def verdict(self) -> str:
        """`HOLDS`, `CONTRADICTED` or `NOT_RESOLVED`."""
        if not np.isfinite(self.estimate).all():
            return NOT_RESOLVED
        if self.margin >= ERRORS_TO_HOLD * self.estimate.error:
            return HOLDS
        outside = -self.margin > ERRORS_TO_CONTRADICT * self.estimate.error
        return CONTRADICTED if outside else NOT_RESOLVED


class Outcome(NamedTuple):
    """All parts of a claim, and a note: a sentence or two with the numbers behind them."""

    parts: list[Part]
    note: str = ""


def all_parts(kinds: dict[str, list[Part]]) -> list[Part]:
    """The parts of a claim with several statements; every statement must have at least one.

    Args:
        kinds: what a statement needs in the ensemble → its parts.

    Raises:
        NotTested: a statement has no parts.
    """
    absent = [name for name, parts in kinds.items() if not parts]
    if absent:
        raise NotTested(" and ".join(absent))
    return [part for parts in kinds.values() for part in parts]


@dataclass(frozen=True)
class Verdict:
    """A row of the table of claims.

    `measured` is the number of the part that decided: if the claim holds, the one nearest to its
    limit, otherwise the one farthest outside; NaN if the claim was not tested. `uncertainty` is its
    standard error, and `where` says where it was measured.
    """

    claim: str
    statement: str
    where: str
    measured: float
    uncertainty: float
    unit: str
    criterion: str
    verdict: str
    explanation: str


Claim = Callable[["xr.Dataset"], Verdict]


def claim(name: str, unit: str) -> Callable[[Callable[[xr.Dataset], Outcome]], Claim]:
    """Make a function that returns an `Outcome` return the `Verdict` on claim `name`.

    Args:
        name: such as A6 for the sixth claim of paper A.
        unit: of the measured number; "1" for none.
    """

    def decorate(function: Callable[[xr.Dataset], Outcome]) -> Claim:
        statement, criterion = _statement_and_criterion(function)

        @wraps(function)
        def judge(ensemble: xr.Dataset) -> Verdict:
            part, verdict, explanation = _judged(function, ensemble)
            measured = (part.where, *part.estimate, unit)
            return Verdict(name, statement, *measured, criterion, verdict, explanation)

        return judge

    return decorate


def _statement_and_criterion(function: Callable) -> tuple[str, str]:
    paragraphs = [" ".join(text.split()) for text in inspect.getdoc(function).split("\n\n")]
    criterion = next(text for text in paragraphs if text.startswith("Criterion: "))
    return paragraphs[0], criterion.removeprefix("Criterion: ")


def _judged(function: Callable, ensemble: xr.Dataset) -> tuple[Part, str, str]:
    try:
        parts, note = function(ensemble)
        if not parts:
            raise NotTested("points with at least two jammed samples in the range of the claim")
    except NotTested as missing:
        no_part = Part("", Estimate(np.nan, np.nan))
        return no_part, NOT_TESTED, f"The ensemble lacks {missing}."
    severity = list(SUMMARIES)
    worst = max(parts, key=lambda part: (severity.index(part.verdict), -part.margin))
    return worst, worst.verdict, f"{_summary(parts, worst)} {note}".strip()


def _summary(parts: list[Part], worst: Part) -> str:
    """How many parts have the verdict of the worst one, and a list of them, the worst first."""
    same = sorted((p for p in parts if p.verdict == worst.verdict), key=lambda part: part.margin)
    named = "; ".join(f"{part.where}: {part.estimate}" for part in same[:MAX_NAMED_PARTS])
    rest = "; ..." if len(same) > MAX_NAMED_PARTS else ""
    verb, first = SUMMARIES[worst.verdict]
    order = f", the {first} first" if len(same) > 1 else ""
    return f"Parts that {verb}: {len(same)} of {len(parts)}{order}. {named}{rest}."
