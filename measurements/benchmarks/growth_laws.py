"""Growth laws c (N / 1024)^p from rows of growth.csv, and a table for `grainmodes cost --costs`.

A straight line through the logarithms of the largest sizes; its standard errors rest on the scatter
around it. A work without rows keeps its row of the table, and so do the shares of a trajectory.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import yaml

from grainmodes.cost.table import COSTS, REFERENCE
from grainmodes.runtime.atomic import replaced
from grainmodes.statistics.rounding import value_with_error

FITTED_SIZES = 4
"""Number of the largest sizes that are fitted; overheads dominate small ones."""

MIN_MEGABYTES = 3.0
"""Smallest memory above that of a bare job that can be measured, in MB."""

USUAL_EDGES = 160
"""Number of edges of the bins of a usual density of states."""


class Fit(NamedTuple):
    """c and p of c (N / 1024)^p, with the relative error of c and the error of p."""

    c: float
    p: float
    c_error: float
    p_error: float


def fit_power_law(n, values) -> Fit:
    """The power law through the last sizes; errors are NaN below three of them."""
    x, y = np.log(np.array(n[-FITTED_SIZES:]) / REFERENCE), np.log(values[-FITTED_SIZES:])
    p, log_c = np.polyfit(x, y, 1)
    errors = np.full(2, np.nan)
    if len(x) > 2:
        errors = np.sqrt(np.diag(np.polyfit(x, y, 1, cov=True)[1]))
    return Fit(float(np.exp(log_c)), float(p), float(errors[1]), float(errors[0]))


def per_sample(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows with the CPU seconds of a whole sample, and the memory in MB above that of a bare job.

    A sample of counts has 160 edges; the other works are timed on a whole sample. Memory
    too small to be measured is NaN.
    """
    bare = rows.loc[rows["work"] == "bare", "megabytes"].item()
    timed = rows[rows["work"] != "bare"]
    edges = timed["work"].str.startswith("count").map({True: USUAL_EDGES, False: np.nan})
    seconds = (timed["seconds"] * edges / timed["units"]).fillna(timed["seconds"])
    memory = timed["megabytes"] - bare
    return timed.assign(seconds=seconds, megabytes=memory.where(memory >= MIN_MEGABYTES))


def fit_laws(rows: pd.DataFrame) -> dict[str, tuple[Fit, Fit]]:
    """Work → the law of its time and that of its memory, per sample, for two sizes or more."""
    return {
        work: (_fit_column(samples, "seconds"), _fit_column(samples, "megabytes"))
        for work, samples in per_sample(rows).groupby("work", sort=False)
        if len(samples) > 1
    }


def _fit_column(samples: pd.DataFrame, name: str) -> Fit:
    """The law of a column, from the sizes with a value; NaN for fewer than two."""
    known = samples[samples[name].notna()]
    if len(known) < 2:
        return Fit(*[np.nan] * 4)
    return fit_power_law(known["n"].tolist(), known[name].tolist())


def exponents(rows: pd.DataFrame) -> str:
    """The exponents as a table in Markdown."""
    lines = ["| stage | fitted on N | time N^p, p | memory N^q, q |", "| --- | --- | --- | --- |"]
    for work, (time, memory) in fit_laws(rows).items():
        sizes = rows["n"][rows["work"] == work].tolist()[-FITTED_SIZES:]
        numbers = f"{exponent_text(time)} | {exponent_text(memory)}"
        lines.append(f"| {work.replace('_', ' ')} | {sizes[0]} to {sizes[-1]} | {numbers} |")
    return "\n".join(lines) + "\n"


def exponent_text(fit: Fit) -> str:
    """An exponent with its error."""
    return value_with_error(fit.p, fit.p_error) if np.isfinite(fit.p) else "–"


def write(machine: str, rows: pd.DataFrame, path: Path) -> None:
    """The table of costs of a machine."""
    table = yaml.safe_load(COSTS.read_text(encoding="utf-8"))
    bare = rows[rows["work"] == "bare"].iloc[0]
    job = {"seconds": _digits(bare["seconds"]), "megabytes": round(bare["megabytes"])}
    lines = [_line(work, kept, rows) for work, kept in table["laws"].items()]
    with replaced(path) as partial:
        partial.write_text(_text(table | {"machine": machine, "job": job}, lines), encoding="utf-8")


def _line(work: str, kept: dict, rows: pd.DataFrame) -> str:
    """The line of a work in the table: measured, or its row of the previous table."""
    timed = rows[rows["work"] == work]
    values, words = _row(timed, rows) if len(timed) > 1 else (kept, "kept: not measured")
    flow = yaml.safe_dump(values, default_flow_style=True, sort_keys=False, width=999)
    return f"  {work}: {flow.strip()}  # {words}"


def _row(timed: pd.DataFrame, rows: pd.DataFrame) -> tuple[dict, str]:
    sizes = timed["n"].tolist()
    time = fit_power_law(sizes, (timed["seconds"] / timed["units"]).tolist())
    megabytes = per_sample(rows).loc[timed.index, "megabytes"].fillna(MIN_MEGABYTES)
    memory = fit_power_law(sizes, megabytes.tolist())
    values = {
        "seconds": _digits(time.c),
        "exponent": _digits(time.p),
        "megabytes": _digits(memory.c),
        "memory_exponent": _digits(memory.p),
        "up_to": sizes[-1],
    }
    words = f"N = {sizes[-FITTED_SIZES:][0]} to {sizes[-1]}: c +- {100 * time.c_error:.0f} %"
    return values, f"{words}, p +- {time.p_error:.2f}"


def _digits(value: float) -> float:
    return float(f"{value:.3g}")


def _text(table: dict, lines: list[str]) -> str:
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
