"""How costs grow with N: `snakemake -j1 growth` measures the table behind `grainmodes cost`.

Each work is timed at N = 256, 512, 1024, … until a run would take longer than `LONGEST`, each time
in a process of its own; the last sizes give c and p of c (N / 1024)^p by a straight line through
the logarithms, with standard errors. The table goes to a file that `grainmodes cost --costs` reads;
a work that cannot be measured here keeps its row.
"""

from __future__ import annotations

import platform
import sys
import tempfile
from collections.abc import Iterator
from importlib.util import find_spec
from itertools import accumulate
from multiprocessing import get_context
from pathlib import Path
from typing import NamedTuple

import numpy as np
import yaml

from grainmodes.cost.table import COSTS, REFERENCE
from grainmodes.environment import prepare
from grainmodes.parameters.grid import checkpoints_up_to

# Inherited by the processes that measure.
prepare()
sys.path.insert(0, str(Path(__file__).parent))

SIZES = (256, 512, 1024, 2048, 4096, 8192, 16384)

LONGEST = 100.0
"""CPU seconds that a single run may be expected to take."""

LAST = 4
"""So many of the largest sizes are fitted: small ones are governed by overheads."""

KEPT = {"close_up", "pairs", "release"}
"""Works whose cost hangs on where a sample has its events or its pairs, or on how slowly its
unstable state is left, more than on N."""

LEAST = 1.0
"""MB: less cannot be told from a bare job."""


class Fit(NamedTuple):
    """c and p of c (N / 1024)^p, with the relative error of c and the error of p."""

    c: float
    p: float
    c_error: float
    p_error: float


def fitted(n: list[int], values: list[float]) -> Fit:
    """The power law through the last sizes; errors are NaN below three of them."""
    x, y = np.log(np.array(n[-LAST:]) / REFERENCE), np.log(values[-LAST:])
    p, log_c = np.polyfit(x, y, 1)
    errors = np.full(2, np.nan)
    if len(x) > 2:
        errors = np.sqrt(np.diag(np.polyfit(x, y, 1, cov=True)[1]))
    return Fit(float(np.exp(log_c)), float(p), float(errors[1]), float(errors[0]))


def apart(function: str, *arguments):
    """A function of `works` in a fresh process."""
    with get_context("spawn").Pool(1) as pool:
        return pool.apply(_call, (function, *arguments))


def _call(function: str, *arguments):
    import works

    return getattr(works, function)(*arguments)


def series(work: str, folder: Path) -> Iterator[tuple[int, object]]:
    """N and what was timed there, until the next N would take too long."""
    seconds: list[float] = []
    for n in SIZES:
        if len(seconds) > 1 and seconds[-1] ** 2 / seconds[-2] > LONGEST:
            return
        timed = apart("timed", work, n, folder)
        seconds.append(max(timed.seconds, 1e-3))
        yield n, timed


def row(work: str, folder: Path, bare: float) -> tuple[dict, str]:
    """The row of the table of a work, and what is known of it in words."""
    sizes, timed = zip(*series(work, folder), strict=True)
    time = fitted(sizes, [max(each.seconds, 1e-3) / each.units for each in timed])
    memory = fitted(sizes, [max(each.megabytes - bare, LEAST) for each in timed])
    values = {
        "seconds": _digits(time.c),
        "exponent": _digits(time.p),
        "megabytes": _digits(memory.c),
        "memory_exponent": _digits(memory.p),
        "up_to": sizes[-1],
    }
    words = f"N = {sizes[-LAST:][0]} to {sizes[-1]}: c +- {100 * time.c_error:.0f} %"
    return values, f"{words}, p +- {time.p_error:.2f}"


def _digits(value: float) -> float:
    return float(f"{value:.3g}")


def climb_shares() -> dict[float, float]:
    """Part of a trajectory that is behind it at each checkpoint."""
    behind = list(accumulate(apart("climb", REFERENCE)))
    return {
        phi: _digits(seconds / behind[-1])
        for phi, seconds in zip(checkpoints_up_to(0.9), behind, strict=True)
    }


def line(work: str, kept: dict, folder: Path, bare: float) -> str:
    """The line of a work in the table, measured, or the row of the table before."""
    if work.endswith("_pardiso") and find_spec("pypardiso") is None:
        values, words = kept, "kept: pypardiso is not installed"
    elif work in KEPT:
        values, words = kept, "kept: not measured"
    else:
        values, words = row(work, folder, bare)
    flow = yaml.safe_dump(values, default_flow_style=True, sort_keys=False, width=999)
    return f"  {work}: {flow.strip()}  # {words}"


def main(output: Path) -> None:
    """Measure every work, print its line as it comes, and write the table."""
    table, lines = yaml.safe_load(COSTS.read_text(encoding="utf-8")), []
    table["machine"] = f"{platform.machine()}, Python {platform.python_version()}"
    with tempfile.TemporaryDirectory() as name:
        bare = apart("bare", Path(name))
        table["job"] = {"seconds": _digits(apart("start_up")), "megabytes": round(bare)}
        for work, kept in table["laws"].items():
            lines.append(line(work, kept, Path(name), bare))
            print(lines[-1], flush=True)
    table["climb"] = climb_shares()
    output.write_text(text(table, lines), encoding="utf-8")


def text(table: dict, lines: list[str]) -> str:
    """The file: what the package says of its columns, then what was measured."""
    head = COSTS.read_text(encoding="utf-8").partition("#\n")[0]
    rest = {name: value for name, value in table.items() if name not in ("machine", "laws")}
    return "\n".join(
        [
            f"{head}machine: {table['machine']}\n",
            "laws:",
            *lines,
            "",
            yaml.safe_dump(rest, default_flow_style=None, sort_keys=False, width=999),
        ]
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
