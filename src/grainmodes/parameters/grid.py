"""Points, blocks of seeds and checkpoints, and the one text of each that stands in a path."""

from __future__ import annotations

import re
from dataclasses import dataclass

CHECKPOINT_SPACING = 0.01
"""Spacing in φ of the states along a compression from which every packing is reached."""

LOWEST_CHECKPOINT = 0.80
"""First checkpoint: the first job of a trajectory compresses from random placement to here."""

MAX_SEED = 2**63 - 1
"""Largest seed: files hold seeds as integers of 64 bits."""

MAX_SEEDS_PER_FILE = 10_000
"""Largest number of seeds in a file."""


@dataclass(frozen=True)
class Point:
    """One point of a grid."""

    n: int
    phi: float
    kt: float


def format_value(value: float | int) -> str:
    """The text of a number in a path: the shortest that reads back as the same number.

    >>> [format_value(v) for v in (256, 0.84, 1e-08, 0.0, 10.0)]
    ['256', '0.84', '1e-08', '0.0', '10.0']
    """
    return repr(int(value)) if isinstance(value, int) else repr(float(value))


def format_seeds(first: int, last: int) -> str:
    """The text of a block of seeds, both ends included: `0000-0007`."""
    return f"{first:04d}-{last:04d}"


def parse_seeds(text: str) -> range:
    """The seeds of a block name.

    Raises:
        ValueError: `text` is not `first-last` with 0 <= first <= last, or a seed is too large, or
            there are too many.
    """
    ends = re.fullmatch(r"([0-9]{1,100})-([0-9]{1,100})", text)
    if not ends or int(ends[1]) > int(ends[2]):
        raise ValueError(
            f"seeds {text!r}: expected first-last with first <= last, such as 0000-0007"
        )
    first, last = int(ends[1]), int(ends[2])
    if last > MAX_SEED:
        raise ValueError(f"seeds {text!r}: expected seeds of at most {MAX_SEED}, got {last}")
    if last - first >= MAX_SEEDS_PER_FILE:
        raise ValueError(
            f"seeds {text!r}: expected at most {MAX_SEEDS_PER_FILE} seeds, got {last - first + 1}"
        )
    return range(first, last + 1)


def seed_blocks(count: int, size: int) -> list[str]:
    """Names of the blocks that hold seeds 0 … count − 1, every block but the last `size` long.

    >>> seed_blocks(10, 4)
    ['0000-0003', '0004-0007', '0008-0009']
    """
    return [format_seeds(a, min(a + size, count) - 1) for a in range(0, count, size)]


def phi_at_step(initial_phi: float, phi_step: float, step: int) -> float:
    """φ after `step` steps of the compression grid, free of accumulated rounding."""
    return round(initial_phi + step * phi_step, 12)


def checkpoint_at_or_below(phi: float) -> float:
    """The highest checkpoint of a trajectory that does not exceed φ.

    >>> [checkpoint_at_or_below(p) for p in (0.80, 0.845, 0.9, 0.8999999999)]
    [0.8, 0.84, 0.9, 0.89]
    """
    nearest = round(phi / CHECKPOINT_SPACING)
    checkpoint = round(nearest * CHECKPOINT_SPACING, 12)
    return checkpoint if checkpoint <= phi else round((nearest - 1) * CHECKPOINT_SPACING, 12)


def checkpoints_up_to(phi: float) -> list[float]:
    """The checkpoints on the way to φ, the lowest first.

    >>> checkpoints_up_to(0.825)
    [0.8, 0.81, 0.82]
    """
    count = round((checkpoint_at_or_below(phi) - LOWEST_CHECKPOINT) / CHECKPOINT_SPACING)
    return [round(LOWEST_CHECKPOINT + k * CHECKPOINT_SPACING, 12) for k in range(count + 1)]
