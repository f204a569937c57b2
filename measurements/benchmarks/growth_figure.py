"""One figure of how every stage grows with N: CPU time of a sample above, peak memory below."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from grainmodes.cost.table import REFERENCE
from grainmodes.figures.shared import appearance, labels
from grainmodes.runtime.atomic import replaced
from measurements.benchmarks.growth_laws import FITTED_SIZES, Fit, fit_laws, per_sample

PANELS = {
    "packings, rigidity": ("trajectory", "equilibrate", "step_strain", "rigidity"),
    "all modes": ("dense_modes", "dense_values", "window_superlu", "window_pardiso"),
    "counts, fields": ("count_superlu", "count_pardiso", "fields"),
    "along a shear": ("law_comparison", "complex_pairs", "shear"),
}
"""Title of a column of panels → its works."""

LABELS = {
    "step_strain": "step strain",
    "dense_modes": "LAPACK, modes",
    "dense_values": "LAPACK, values",
    "window_superlu": "slicing, SuperLU",
    "window_pardiso": "slicing, PARDISO",
    "count_superlu": "160 edges, SuperLU",
    "count_pardiso": "160 edges, PARDISO",
    "law_comparison": "law_comparison, 200 steps",
    "complex_pairs": "pairs, 200 steps",
    "shear": "shear, 200 steps",
}

SIZE = (7.0, 5.6)
"""Inches."""


def write(machine: str, rows: pd.DataFrame, stem: Path) -> None:
    """Draw the rows into `stem`.png and `stem`.pdf."""
    with appearance.house_style():
        figure = draw(machine, rows)
        for form in ("png", "pdf"):
            with replaced(stem.with_suffix(f".{form}")) as partial:
                figure.savefig(partial, format=form, dpi=200, metadata=_timeless(form))
        plt.close(figure)


def _timeless(form: str) -> dict:
    return {"CreationDate": None} if form == "pdf" else {"Software": None}


def draw(machine: str, rows: pd.DataFrame) -> plt.Figure:
    """A column of panels per theme; legends below them hold the exponents."""
    figure, axes = plt.subplots(2, len(PANELS), figsize=SIZE, sharex=True, sharey="row")
    found, samples = fit_laws(rows), per_sample(rows)
    for index, (title, works) in enumerate(PANELS.items()):
        for place, name in enumerate(("seconds", "megabytes")):
            _panel(axes[place, index], samples, name, works, found, place)
        labels.name_panel(axes[0, index], index, title)
        _legend(axes[1, index], works, found)
    axes[0, 0].set(ylabel="CPU time of a sample (s)", xlim=(45, 90_000))
    axes[1, 0].set(ylabel="memory it adds (MB)")
    figure.suptitle(f"{machine}, one thread\n{NOTE}")
    return figure


NOTE = f"lines: fits to the last {FITTED_SIZES} sizes; below a name: exponents of time, of memory"


def _panel(axes: Axes, samples, name: str, works, found, place: int) -> None:
    """Draw symbols for the measurements and lines for the fitted laws."""
    for work, colour, marker in appearance.curve_styles(list(works)):
        rows = samples[(samples["work"] == work) & samples[name].notna()]
        axes.loglog(rows["n"], rows[name], marker, color=colour, mfc="none", markersize=3.6)
        if work in found:
            _line(axes, found[work][place], rows["n"].to_numpy()[-FITTED_SIZES:], colour)
    axes.set_xticks([1e2, 1e3, 1e4])


def _line(axes: Axes, law: Fit, sizes: np.ndarray, colour) -> None:
    axes.plot(sizes, law.c * (sizes / REFERENCE) ** law.p, "-", color=colour, linewidth=0.8)


def _legend(axes: Axes, works, found) -> None:
    """Names with the exponents of time and of memory, below the column."""
    for work, colour, marker in appearance.curve_styles(list(works)):
        if work in found:
            label = LABELS.get(work, work)
            exponents = ", ".join(map(_exponent, found[work]))
            appearance.add_to_legend(axes, f"{label}\n{exponents}", colour, marker, mfc="none")
    axes.set_xlabel("$N$")
    axes.legend(loc="upper left", bbox_to_anchor=(-0.08, -0.22), handlelength=0.8)


def _exponent(law: Fit) -> str:
    if not np.isfinite(law.p):
        return "–"
    error = rf" \pm {law.p_error:.2f}" if np.isfinite(law.p_error) else ""
    return f"${law.p:.2f}{error}$"
