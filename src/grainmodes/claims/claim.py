"""A claim of the paper, judged: parts with an uncertainty against a criterion, and one verdict.

A claim is a function of an ensemble that returns an `Outcome`. The first line of its docstring is
the statement that stands in the table, its paragraph `Criterion:` the criterion, so that text and
check stand in one place; `claim` wraps it into a function that returns a `Verdict`.

A part is a number with its standard error and the interval that the claim gives it. It holds if
it lies inside by two standard errors, is contradicted if it lies outside by three, and is not
resolved between or without an error. Three, because a claim has many parts: with ten samples one
part in seventy lies that far outside by chance. A claim holds if all its parts do and is
contradicted by any.
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

SUMMARY_VERBS = {
    HOLDS: "hold, the nearest to the limit first",
    NOT_RESOLVED: "are not resolved",
    CONTRADICTED: "are contradicted",
}
"""What an explanation says of the parts that decided; the verdict of a claim is its part's that
stands last here."""

ERRORS_TO_HOLD = 2.0
"""Standard errors by which a part must lie inside its interval to hold."""

ERRORS_TO_CONTRADICT = 3.0
"""Standard errors by which a part must lie outside its interval to contradict."""

MAX_NAMED_PARTS = 4
"""Parts of one verdict that an explanation names one by one."""


class NotTested(Exception):
    """The ensemble lacks what a claim needs; the message names it."""


class Part(NamedTuple):
    """One number of a claim: where it was measured, and the interval that the claim gives it."""

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
    """All parts of a claim, and a sentence or two with the numbers behind them."""

    parts: list[Part]
    note: str = ""


def all_parts(kinds: dict[str, list[Part]]) -> list[Part]:
    """The parts of a claim that says several things; there must be some of each.

    Args:
        kinds: what the ensemble needs for some parts → these parts.

    Raises:
        NotTested: there are no parts of some kind.
    """
    absent = [name for name, parts in kinds.items() if not parts]
    if absent:
        raise NotTested(" and ".join(absent))
    return [part for parts in kinds.values() for part in parts]


@dataclass(frozen=True)
class Verdict:
    """A row of the table.

    `measured` is the part that decided: of a claim that holds the one nearest to its limit, else
    the one farthest outside; NaN where nothing was asked. `where` names it.
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
        name: as A6, the sixth claim of paper A.
        unit: of the measured number.
    """

    def judged_by(function: Callable[[xr.Dataset], Outcome]) -> Claim:
        statement, criterion = _words(function)

        @wraps(function)
        def judge(ensemble: xr.Dataset) -> Verdict:
            part, verdict, explanation = _judged(function, ensemble)
            measured = (part.where, *part.estimate, unit)
            return Verdict(name, statement, *measured, criterion, verdict, explanation)

        return judge

    return judged_by


def _words(function: Callable) -> tuple[str, str]:
    paragraphs = [" ".join(text.split()) for text in inspect.getdoc(function).split("\n\n")]
    criterion = next(text for text in paragraphs if text.startswith("Criterion: "))
    return paragraphs[0], criterion.removeprefix("Criterion: ")


def _judged(function: Callable, ensemble: xr.Dataset) -> tuple[Part, str, str]:
    try:
        parts, note = function(ensemble)
        if not parts:
            raise NotTested("points with at least two jammed samples in the range of the claim")
    except NotTested as lacking:
        nothing = Part("", Estimate(np.nan, np.nan))
        return nothing, NOT_TESTED, f"The ensemble lacks {lacking}."
    severity = list(SUMMARY_VERBS)
    worst = max(parts, key=lambda part: (severity.index(part.verdict), -part.margin))
    return worst, worst.verdict, f"{_summary(parts, worst)} {note}".strip()


def _summary(parts: list[Part], worst: Part) -> str:
    """How many parts share the verdict, and the worst of them by name, the worst first."""
    same = sorted((p for p in parts if p.verdict == worst.verdict), key=lambda part: part.margin)
    named = "; ".join(f"{part.where}: {part.estimate}" for part in same[:MAX_NAMED_PARTS])
    rest = "; ..." if len(same) > MAX_NAMED_PARTS else ""
    return f"{len(same)} of {len(parts)} {SUMMARY_VERBS[worst.verdict]}: {named}{rest}."
