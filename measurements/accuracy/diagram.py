"""What a work-precision diagram is made of.

A numerical choice is tried at many settings. Every setting is a point: CPU seconds to the right,
error against a reference upwards. Along a curve time buys accuracy, until it buys no more: at

    the knee, the cheapest setting whose error is within 3 times the least error of its curve,

where what lies below may well be round-off, which is as large at one setting as at the next.
"""

from __future__ import annotations

import math
import resource
import sys
import time
from collections.abc import Callable, Iterator
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

WITHIN = 3.0
"""Times the least error of a curve that the error of its knee may be."""

PER_MEGABYTE = 2**20 if sys.platform == "darwin" else 2**10
"""Units of `ru_maxrss`: bytes there, kilobytes elsewhere."""

STATUS = Path("/proc/self/status")
"""Where Linux says what a process holds."""


class Row(NamedTuple):
    """One setting of one curve.

    Attributes:
        curve: its line, "who, what" where lines differ in two ways: "fast, error of g".
        setting: value of the numerical choice.
        seconds: CPU seconds per unit of work, mean or median over samples.
        megabytes: peak resident memory of the process that did it.
        error: against the reference, mean or median over samples.
        spread: its standard error, or half the interquartile range over samples.
        samples: samples that count.
        failed: samples that came to no result at this setting.
        default: whether the project ships with this setting.
    """

    curve: str
    setting: float
    seconds: float
    megabytes: float
    error: float
    spread: float
    samples: int
    failed: int
    default: bool


class Size(NamedTuple):
    """Grains, and samples of each number of grains."""

    n: tuple[int, ...]
    seeds: int


def of(n: int, size: Size) -> str:
    """What a curve says of its number of grains, where there are several."""
    return f", N = {n}" if len(size.n) > 1 else ""


class Diagram(NamedTuple):
    """A numerical choice; the words stand at axes and in the caption, `unit` says seconds of what.

    `small` takes minutes, `large` hours.
    """

    title: str
    setting: str
    unit: str
    error: str
    reference: str
    small: Size
    large: Size
    measure: Callable[[Size], Iterator[Row]]


def knee(rows: list[Row]) -> Row | None:
    """The knee of one curve; None where no setting served all samples."""
    served = [row for row in rows if row.failed == 0 and row.error < math.inf]
    if not served:
        return None
    allowed = WITHIN * min(row.error for row in served)
    return min((row for row in served if row.error <= allowed), key=lambda row: row.seconds)


class Sample(NamedTuple):
    """CPU seconds and error of one sample; an error that is no number: it came to no result."""

    seconds: float
    error: float


FAILED = Sample(math.nan, math.nan)


def row(
    curve: str,
    setting: float,
    samples: list[Sample],
    megabytes: float,
    default: bool = False,
    mean: bool = False,
) -> Row:
    """Medians over the samples that came to a result, NaN where none did.

    Args:
        mean: the error is a mean instead, and its spread the standard error.
    """
    seconds, errors = np.array([s for s in samples if not math.isnan(s.error)]).reshape(-1, 2).T
    error, spread = (_mean if mean else _median)(errors)
    counts = len(errors), len(samples) - len(errors)
    return Row(curve, setting, _median(seconds)[0], megabytes, error, spread, *counts, default)


def _median(values: np.ndarray) -> tuple[float, float]:
    """Median and half the interquartile range."""
    if not len(values):
        return math.nan, math.nan
    low, middle, high = np.quantile(values, [0.25, 0.5, 0.75])
    return float(middle), float(0.5 * (high - low))


def _mean(values: np.ndarray) -> tuple[float, float]:
    """Mean and standard error."""
    if len(values) < 2:
        return (float(values[0]) if len(values) else math.nan), math.nan
    return float(values.mean()), float(values.std(ddof=1) / math.sqrt(len(values)))


class Apart(NamedTuple):
    """What a function returned, its CPU seconds, and the peak memory of its process."""

    value: Any
    seconds: float
    megabytes: float


def apart(function: Callable, *arguments) -> Apart:
    """A function of a module, called in a fresh process."""
    with get_context("spawn").Pool(1) as pool:
        return pool.apply(_called, (function, *arguments))


def _called(function: Callable, *arguments) -> Apart:
    start = time.process_time()
    value = function(*arguments)
    seconds = time.process_time() - start
    return Apart(value, seconds, peak_megabytes())


def peak_megabytes() -> float:
    """Peak resident memory of this process.

    On Linux `ru_maxrss` of a child includes what its parent held when it started the child.
    """
    if STATUS.is_file():
        lines = STATUS.read_text(encoding="utf-8").splitlines()
        return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 2**10
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / PER_MEGABYTE


LEAST = 0.02
"""CPU seconds for which a short call is repeated, to be seen by the clock."""


def timed(function: Callable, *arguments, at_least: float = LEAST) -> tuple[Any, float]:
    """What a function returned, and its CPU seconds: the mean of calls for `at_least` seconds.

    Where kernels are compiled or loaded first, call it once on little.
    """
    start, calls, seconds = time.process_time(), 0, 0.0
    while calls == 0 or seconds < at_least:
        value, calls = function(*arguments), calls + 1
        seconds = time.process_time() - start
    return value, seconds / calls
