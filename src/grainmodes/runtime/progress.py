"""Progress of a long run."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Progress:
    """The fraction that is done (0 to 1), the same in words, and a count of some unit."""

    done: float
    words: str
    count: int
    unit: str
