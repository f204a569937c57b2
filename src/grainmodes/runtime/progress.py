"""How far a long run is."""

from __future__ import annotations

from typing import NamedTuple


class Progress(NamedTuple):
    """The part done (0 to 1), the same in words, and a count of some unit."""

    done: float
    words: str
    count: int
    unit: str
