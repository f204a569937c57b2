"""Effect × stage × cost: `snakemake -j1 effects` measures the table of docs/effects.md.

| column     | meaning                                                                         |
| ---------- | ------------------------------------------------------------------------------- |
| µs         | CPU time of one thread per grain, and per step where the stage takes steps; the |
|            | least of as many runs as fit into `PATIENCE`, the first compiled beforehand      |
| bytes      | how far resident memory rises above the state given, per grain, at the largest N |

Linux alone tells the peak of a single call: /proc/self/clear_refs starts it anew.
"""

from __future__ import annotations

import csv
import ctypes
import gc
import sys
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

from grainmodes.runtime.atomic import replaced
from grainmodes.runtime.environment import prepare

prepare()

from measurements.benchmarks.called_for import LARGE, Row, Work, rows  # noqa: E402
from measurements.benchmarks.cases import cpu  # noqa: E402

FEW = 64
"""Grains of the first run of each row, which compiles."""

PATIENCE = 0.2
"""CPU seconds after which a work is not repeated."""


class Cost(NamedTuple):
    """A row of results/effects.csv."""

    stage: str
    effect: str
    n: int
    microseconds_per_grain: float
    bytes_per_grain: float


def measured(row: Row, n: int) -> Cost:
    """The cost of an effect at a stage among n grains."""
    seconds, size = timed(row.prepare(n))
    return Cost(row.stage, row.effect, n, 1e6 * seconds / n / row.steps, size / n)


def timed(work: Work) -> tuple[float, int]:
    """(least CPU seconds of a run, bytes by which the first one raises resident memory)."""
    held = _forget_the_peak()
    seconds = [cpu(work)]
    size = _memory("VmHWM") - held
    while sum(seconds) < PATIENCE:
        seconds.append(cpu(work))
    return min(seconds), size


def _forget_the_peak() -> int:
    """Give free memory back, let the peak start anew, and return what is resident, in bytes."""
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
    sizes = "".join(f" µs, N = {n} |" for n in LARGE)
    table = [f"| stage | effect |{sizes} bytes |", "| --- " * (len(LARGE) + 3) + "|"]
    for (stage, effect), found in groupby(costs, key=lambda cost: cost[:2]):
        at = {cost.n: cost for cost in found}
        times = [f"{at[n].microseconds_per_grain:.3g}" if n in at else "–" for n in LARGE]
        numbers = " | ".join([*times, f"{at[max(at)].bytes_per_grain:.0f}"])
        table.append(f"| {stage} | {effect} | {numbers} |")
    return table


def write(path: Path, costs: list[Cost]) -> None:
    """The costs as a table of comma-separated values."""
    with replaced(path) as partial, partial.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(Cost._fields)
        writer.writerows([*cost[:3], *(f"{value:.4g}" for value in cost[3:])] for cost in costs)


def main(output: Path) -> None:
    """Measure row by row, write what there is after each, and print the table."""
    costs: list[Cost] = []
    for row in rows():
        row.prepare(FEW)()
        costs += [measured(row, n) for n in row.sizes]
        write(output, costs)
    print("\n".join(lines(costs)))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
