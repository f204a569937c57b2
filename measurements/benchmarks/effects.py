"""Effect × stage × cost: `snakemake -j1 effects` measures the table of docs/effects.md.

| column     | meaning                                                                          |
| ---------- | -------------------------------------------------------------------------------- |
| µs         | CPU time of one thread per grain, and per step where the stage takes steps; the  |
|            | least of the runs that fit into `MIN_CPU_SECONDS`, the first compiled beforehand |
| bytes      | how far resident memory rises above the state given, per grain, at the largest N |

Only Linux can measure the peak of a single call: /proc/self/clear_refs resets it.
"""

from __future__ import annotations

import argparse
import csv
import ctypes
import gc
import time
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from grainmodes.runtime.atomic import replaced
from grainmodes.runtime.environment import prepare

if TYPE_CHECKING:
    from measurements.benchmarks.effect_works import EffectRow, Work

WARM_UP_N = 64
"""Number of grains of the first run of each row, which compiles."""

MIN_CPU_SECONDS = 0.2
"""A work is repeated until its runs together took so many CPU seconds."""


class Cost(NamedTuple):
    """A row of results/effects.csv."""

    stage: str
    effect: str
    n: int
    microseconds_per_grain: float
    bytes_per_grain: float


def measure(row: EffectRow, n: int) -> Cost:
    """The cost of an effect at a stage among n grains."""
    seconds, size = timed(row.prepare(n))
    return Cost(row.stage, row.effect, n, 1e6 * seconds / n / row.steps, size / n)


def timed(work: Work) -> tuple[float, int]:
    """(least CPU seconds of a run, bytes by which the first one raises resident memory)."""
    held = _reset_peak()
    seconds = [_cpu_seconds(work)]
    size = _memory("VmHWM") - held
    while sum(seconds) < MIN_CPU_SECONDS:
        seconds.append(_cpu_seconds(work))
    return min(seconds), size


def _cpu_seconds(work: Work) -> float:
    start = time.process_time()
    work()
    return time.process_time() - start


def _reset_peak() -> int:
    """Return free memory to the system and reset the peak; returns the resident memory in bytes."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    return _memory("VmRSS")


def _memory(name: str) -> int:
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith(name):
            return 1024 * int(line.split()[1])
    raise KeyError(name)


def lines(costs: list[Cost]) -> list[str]:
    """The table in Markdown, an effect a line."""
    sizes = sorted({cost.n for cost in costs})
    heads = "".join(f" µs, N = {n} |" for n in sizes)
    table = [f"| stage | effect |{heads} bytes |", "| --- " * (len(sizes) + 3) + "|"]
    for (stage, effect), found in groupby(costs, key=lambda cost: cost[:2]):
        at = {cost.n: cost for cost in found}
        times = [f"{at[n].microseconds_per_grain:.3g}" if n in at else "–" for n in sizes]
        numbers = " | ".join([*times, f"{at[max(at)].bytes_per_grain:.0f}"])
        table.append(f"| {stage} | {effect} | {numbers} |")
    return table


def write(path: Path, costs: list[Cost]) -> None:
    """The costs as a table of comma-separated values."""
    with replaced(path) as partial, partial.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(Cost._fields)
        writer.writerows([*cost[:3], *(f"{value:.4g}" for value in cost[3:])] for cost in costs)


def main() -> None:
    """Measure row by row, write all rows after each, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("output", type=Path, metavar="CSV")
    output = parser.parse_args().output
    prepare()  # before numpy and numba are imported
    from measurements.benchmarks.effect_works import rows

    costs: list[Cost] = []
    for row in rows():
        row.prepare(WARM_UP_N)()
        costs += [measure(row, n) for n in row.sizes]
        write(output, costs)
    print("\n".join(lines(costs)))


if __name__ == "__main__":
    main()
