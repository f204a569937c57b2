"""Growth of every stage with N: `snakemake -j1 growth` → results/growth.{csv,png,pdf}, costs.yaml.

    python -m measurements.benchmarks.growth FOLDER --longest SECONDS

Each work (`works.py`) is timed at N = 64, 128, … 65536 until a run would take longer than
`SECONDS`, each time in a process of its own. Rows are added to growth.csv as they are measured, and
stay there: a run that was interrupted continues, a longer limit adds sizes, and without the file
all is measured again. Exponents (`growth_laws.py`) and the figure (`growth_figure.py`)
follow from it.

| column    | meaning                                                        |
| --------- | -------------------------------------------------------------- |
| seconds   | CPU time of one thread                                         |
| units     | what it was for: modes, edges, steps, states, else one sample  |
| megabytes | peak memory of the process; in the row `bare`, of a job on few grains |
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
from importlib.util import find_spec
from multiprocessing import get_context
from pathlib import Path

import pandas as pd

from grainmodes.runtime.environment import prepare
from measurements.machine import default_factorisation, processor_model

SIZES = tuple(64 * 2**k for k in range(11))

WORKS = (
    *("rigidity", "count_pardiso", "count_superlu", "step_strain", "equilibrate", "trajectory"),
    *("dense_values", "dense_modes", "window_pardiso", "window_superlu", "shear"),
    *("complex_pairs", "fields", "law_comparison"),
)
"""Event details, releases and claim diagnostics are left out. Their cost depends less on N than on
where a sample has its events, how slowly its unstable state grows, and how a compression with
friction goes."""

COLUMNS = ["work", "n", "seconds", "units", "megabytes"]


def machine() -> str:
    """Processor, cores, Python, and the factorisation that "auto" takes."""
    processor = " ".join(filter(None, [processor_model(), platform.machine()]))
    factorisation = default_factorisation().replace("SuperLU", "SuperLU alone")
    python = f"Python {platform.python_version()}"
    return f"{processor}, {os.cpu_count()} cores, {python}, {factorisation}"


def read(path: Path) -> tuple[str, pd.DataFrame]:
    """The machine and the rows of a file of this module."""
    head = path.read_text(encoding="utf-8").partition("\n")[0]
    return head.removeprefix("# "), pd.read_csv(path, comment="#")


def in_fresh_process(function: str, *arguments):
    """A function of `works` in a fresh process."""
    with get_context("spawn").Pool(1) as pool:
        return pool.apply(_call, (function, *arguments))


def _call(function: str, *arguments):
    from measurements.benchmarks import works

    return getattr(works, function)(*arguments)


def measure(path: Path, longest: float) -> None:
    """Add to the file the rows that it lacks.

    Raises:
        ValueError: the file is of another machine.
    """
    if not path.exists():
        path.write_text(f"# {machine()}\n{','.join(COLUMNS)}\n", encoding="utf-8")
    if read(path)[0] != machine():
        raise ValueError(f"{path}: measured on another machine ({read(path)[0]}); remove it first")
    scratch = path.with_suffix("")
    scratch.mkdir(exist_ok=True)
    if "bare" not in set(read(path)[1]["work"]):
        _add(path, "bare", 16, in_fresh_process("start_up"), 1.0, in_fresh_process("bare", scratch))
    for work in WORKS:
        if not work.endswith("_pardiso") or find_spec("pypardiso"):
            _extend(path, work, longest, scratch)


def _extend(path: Path, work: str, longest: float, scratch: Path) -> None:
    """Rows of a work at the sizes that are missing, up to the limit."""
    rows = read(path)[1]
    seconds = rows["seconds"][rows["work"] == work].tolist()
    if not seconds:
        in_fresh_process(
            "timed", work, SIZES[0], scratch
        )  # what is compiled now would count as memory
    for n in SIZES[len(seconds) :]:
        if expected(seconds) > longest:
            return
        timed = in_fresh_process("timed", work, n, scratch)
        seconds.append(timed.seconds)
        _add(path, work, n, *timed)


def expected(seconds: list[float]) -> float:
    """CPU seconds of the next size: the last step once more, but no decrease, and at most N³."""
    if len(seconds) < 2:
        return max(seconds, default=0.0)
    return seconds[-1] * min(max(1.0, seconds[-1] / seconds[-2]), 8.0)


def _add(path: Path, work: str, n: int, seconds: float, units: float, megabytes: float) -> None:
    row = f"{work},{n},{seconds:.4g},{units:g},{megabytes:.4g}"
    print(row, flush=True)
    with path.open("a", encoding="utf-8") as file:
        file.write(f"{row}\n")


def main() -> None:
    """Measure, then fit and draw."""
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--longest", type=float, required=True, help="CPU seconds of one run")
    arguments = parser.parse_args()
    prepare()  # for the processes that measure
    arguments.folder.mkdir(parents=True, exist_ok=True)
    path = arguments.folder / "growth.csv"
    try:
        measure(path, arguments.longest)
    except ValueError as error:
        sys.exit(f"growth.py: {error}")

    from measurements.benchmarks import growth_figure, growth_laws

    growth_laws.write(*read(path), arguments.folder / "costs.yaml")
    growth_figure.write(*read(path), arguments.folder / "growth")


if __name__ == "__main__":
    main()
