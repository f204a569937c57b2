"""What became of a release, from its records: C, Sec. VI A and B, Figs. 5 to 7.

| stage of C, Sec. VI B      | here                                                               |
| -------------------------- | ------------------------------------------------------------------ |
| exponential growth         | M between 1e-19 and 1e-11 d², where the laws of M and A are fitted |
| its end                    | the first record whose M is half of the mean law off the law       |
| contacts change            | the first record whose contacts are not those of the start         |
| plateau                    | from that end to the second instability                            |
| second instability         | the first record with M above ⟨ξ⟩², the mean overlap squared       |
| the state it leads to      | means over the last tenth of the run                               |

What did not happen has a time and an M of NaN.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.packing.state import find_contacts
from grainmodes.protocols.release.growth import LINEAR, UNKNOWN, Law, fitted
from grainmodes.protocols.release.record import Record
from grainmodes.protocols.release.run import Run

OFF = 0.5
"""How far M may lie off its law, in parts of the mean law, while it still grows."""

LAST = 0.1
"""Part of a run, at its end, over which the state it leads to is averaged."""


class Moment(NamedTuple):
    """A time of a run, and M then."""

    time: float
    square: float


NEVER = Moment(np.nan, np.nan)


class Fate(NamedTuple):
    """The laws of M and A, the moments in the table above, and the means of every record's end."""

    displacement: Law
    rotation: Law
    end: Moment
    change: Moment
    second: Moment
    largest: float
    after: Record


def fate_of(run: Run) -> Fate:
    """What became of a run that is done."""
    of = columns(run.records)
    square = of["mean_square_displacement"]
    displacement, rotation = (
        _law(run, of, name) for name in ("mean_square_displacement", "mean_square_rotation")
    )
    overlap = find_contacts(run.start.packing).overlap.mean()
    last = of["time"] >= (1.0 - LAST) * of["time"][-1]
    return Fate(
        displacement,
        rotation,
        _end(of, displacement),
        _first(of, of["changed"] > 0),
        _first(of, square > overlap**2),
        float(square.max()),
        Record(*(float(values[last].mean()) for values in of.values())),
    )


def columns(records: list[Record]) -> dict[str, np.ndarray]:
    """Every quantity of the records, (R,)."""
    return dict(zip(Record._fields, np.array(records, float).T, strict=True))


def linear(square: np.ndarray) -> np.ndarray:
    """The records (R,) of the exponential growth, by their M."""
    beyond = np.cumsum(square > LINEAR[1]) > 0
    return (square > LINEAR[0]) & ~beyond


def _law(run: Run, of: dict[str, np.ndarray], name: str) -> Law:
    """The law of M or A, if M grew through all of the range in which it is fitted."""
    used = linear(of["mean_square_displacement"])
    if not (of["mean_square_displacement"] > LINEAR[1]).any():
        return UNKNOWN
    rate = run.start.rate_under(run.drag)
    return fitted(of["time"][used], of[name][used], rate, run.start.frequency)


def _end(of: dict[str, np.ndarray], law: Law) -> Moment:
    """Where M leaves its law, with M of the law."""
    used = linear(of["mean_square_displacement"])
    if not np.isfinite(law.rate):
        return NEVER
    time, square = of["time"], of["mean_square_displacement"]
    later = time >= time[used][-1]
    with np.errstate(over="ignore"):
        off = later & (np.abs(square - law.at(time)) > OFF * law.mean(time))
    if not off.any():
        return NEVER
    end = float(time[np.argmax(off)])
    return Moment(end, float(law.mean(end)))


def _first(of: dict[str, np.ndarray], happened: np.ndarray) -> Moment:
    if not happened.any():
        return NEVER
    place = np.argmax(happened)
    return Moment(float(of["time"][place]), float(of["mean_square_displacement"][place]))
