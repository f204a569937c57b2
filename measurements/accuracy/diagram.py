"""Work-precision diagrams: the error that a numerical choice leaves against the CPU time it takes.

A numerical choice is tried at many settings. Every setting is a point: CPU seconds to the right,
error against a reference upwards. Along a curve more time gives a smaller error, up to

    the knee, the cheapest setting whose error is within 3 times the smallest error of its curve.

Smaller errors may well be round-off, which differs between settings by chance.
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

KNEE_FACTOR = 3.0
"""Largest error of the knee, in units of the smallest error of its curve."""

MAXRSS_PER_MEGABYTE = 2**20 if sys.platform == "darwin" else 2**10
"""Units of `ru_maxrss` in a megabyte: bytes on macOS, kilobytes elsewhere."""

PROCESS_STATUS = Path("/proc/self/status")
"""File in which Linux states the memory of a process."""


class DiagramRow(NamedTuple):
    """One setting of one curve.

    Attributes:
        curve: its name, "method, quantity" where curves differ in both: "FIRE, error of g".
        setting: value of the numerical choice.
        seconds: CPU seconds per unit of work, mean or median over samples.
        megabytes: peak resident memory of the process that measured it.
        error: against the reference, mean or median over samples.
        spread: its standard error, or half the interquartile range over samples.
        samples: number of samples with a result.
        failed: number of samples without a result at this setting.
        default: whether this setting is the default of the project.
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
    """Numbers of grains, and the number of samples of each."""

    n: tuple[int, ...]
    seeds: int


def size_suffix(n: int, size: Size) -> str:
    """End of the name of a curve: its number of grains, if there are several."""
    return f", N = {n}" if len(size.n) > 1 else ""


class Diagram(NamedTuple):
    """A numerical choice.

    The texts are labels of axes and parts of the caption; `unit` is the work that the CPU seconds
    are for. A measurement of size `small` takes minutes, of size `large` hours.
    """

    title: str
    setting: str
    unit: str
    error: str
    reference: str
    small: Size
    large: Size
    measure: Callable[[Size], Iterator[DiagramRow]]


def knee(rows: list[DiagramRow]) -> DiagramRow | None:
    """The knee of one curve; None where every setting failed in some sample."""
    served = [row for row in rows if row.failed == 0 and row.error < math.inf]
    if not served:
        return None
    allowed = KNEE_FACTOR * min(row.error for row in served)
    return min((row for row in served if row.error <= allowed), key=lambda row: row.seconds)


class TimedError(NamedTuple):
    """CPU seconds and error of one sample; the error is NaN if the sample gave no result."""

    seconds: float
    error: float


FAILED = TimedError(math.nan, math.nan)


def summarise(
    curve: str,
    setting: float,
    samples: list[TimedError],
    megabytes: float,
    default: bool = False,
    mean: bool = False,
) -> DiagramRow:
    """The row of a setting: medians over the samples with a result, NaN if there is none.

    Args:
        mean: give the mean of the errors instead, and its standard error as spread.
    """
    seconds, errors = np.array([s for s in samples if not math.isnan(s.error)]).reshape(-1, 2).T
    error, spread = (_mean if mean else _median)(errors)
    counts = len(errors), len(samples) - len(errors)
    return DiagramRow(
        curve, setting, _median(seconds)[0], megabytes, error, spread, *counts, default
    )


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


class ProcessResult(NamedTuple):
    """What a function returned, its CPU seconds, and the peak memory of its process."""

    value: Any
    seconds: float
    megabytes: float


def in_fresh_process(function: Callable, *arguments) -> ProcessResult:
    """Call a function of a module in a fresh process."""
    with get_context("spawn").Pool(1) as pool:
        return pool.apply(_called, (function, *arguments))


def _called(function: Callable, *arguments) -> ProcessResult:
    start = time.process_time()
    value = function(*arguments)
    seconds = time.process_time() - start
    return ProcessResult(value, seconds, peak_megabytes())


def peak_megabytes() -> float:
    """Peak resident memory of this process.

    On Linux `ru_maxrss` of a child includes what its parent held when it started the child.
    """
    if PROCESS_STATUS.is_file():
        lines = PROCESS_STATUS.read_text(encoding="utf-8").splitlines()
        return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 2**10
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / MAXRSS_PER_MEGABYTE


MIN_CPU_SECONDS = 0.02
"""CPU seconds for which a short call is repeated, so that the clock can measure it."""


def timed(function: Callable, *arguments, at_least: float = MIN_CPU_SECONDS) -> tuple[Any, float]:
    """What a function returned, and its CPU seconds: the mean of calls for `at_least` seconds.

    Call the function once on few grains before, so that its kernels are compiled and loaded.
    """
    start, calls, seconds = time.process_time(), 0, 0.0
    while calls == 0 or seconds < at_least:
        value, calls = function(*arguments), calls + 1
        seconds = time.process_time() - start
    return value, seconds / calls
