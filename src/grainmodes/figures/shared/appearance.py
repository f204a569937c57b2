"""What the figures share: colours in the order of a parameter, symbols, legends, captions."""

from __future__ import annotations

import math
from collections.abc import Iterator

import matplotlib.colors
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

MODULUS = {"hertz": r"$(k_N d^{1/2})$", "harmonic": "$k_N$"}
"""Unit of a modulus under each normal contact law."""

TRANSLATIONAL, ROTATIONAL = "#b2182b", "#2166ac"
"""Red and blue as in A, of a pair that the colour-blind tell apart."""

OPEN = {"mfc": "none", "mew": 0.5, "markersize": 3.6}
"""A curve that others cover: open symbols around theirs."""

SHORT = 200
"""Ratio of limits below which powers of ten alone are too few labels."""

MARKERS = "osD^vPX*"


def series(values: list[float]) -> Iterator[tuple[float, tuple, str]]:
    """Value, colour and marker of each curve; the lightness grows, so that grey keeps the order."""
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.85, len(values)))
    for index, value in enumerate(values):
        yield value, tuple(colours[index]), MARKERS[index % len(MARKERS)]


def add_to_legend(axes: Axes, label: str, colour, marker: str, **style) -> None:
    """A symbol in the legend without the error bar."""
    axes.plot([], [], linestyle="none", marker=marker, color=colour, label=label, **style)


def draw_cloud(axes: Axes, x, y, error, colour, marker: str, **style) -> None:
    """A curve of hundreds of points: small symbols, faint bars."""
    faint = (*matplotlib.colors.to_rgb(colour), 0.35)
    style = {"markersize": 1.8, "ecolor": faint, "elinewidth": 0.5} | style
    axes.errorbar(x, y, error, fmt=marker, color=colour, **style)


def draw_spectrum(axes: Axes, of, column: str, label: str, colour, marker: str, **style) -> None:
    """A column of spectral rows against omega, with its entry in the legend; none without rows."""
    if of[column].notna().any():
        bars = of[f"{column}_standard_error"]
        draw_cloud(axes, of["omega"], of[column], bars, colour, marker, **style)
        entry = {key: style[key] for key in ("mfc",) if key in style}
        add_to_legend(axes, label, colour, marker, **entry)


def draw_kinds(axes: Axes, of, column: str, styles: dict[str, dict]) -> None:
    """Spectra of several kinds, each in its style where there is one, the first on top."""
    for place, (kind, style) in enumerate(styles.items()):
        draw_spectrum(axes, of[of["kind"] == kind], column, zorder=3 - place / 10, **style)


def scale_frequencies(axes: Axes) -> None:
    """A logarithmic axis whose labels also fit where it spans about a decade."""
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    if high < SHORT * low:
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda omega, _: f"{omega:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def modulus_label(symbol: str, table) -> str:
    """Label of an axis: a modulus over its unit under the contact law of the table."""
    return f"{symbol} / {MODULUS[table['law'].iloc[0]]}"


def power(value: float) -> str:
    """A number as a formula: 1e-08 → 10^{-8}, 0.03 → 3 x 10^{-2}, 2 → 2."""
    if value == 0 or 0.1 <= value < 1000:
        return f"{value:g}"
    exponent = math.floor(math.log10(value) + 1e-12)
    factor = f"{value / 10.0**exponent:.3g}"
    return rf"10^{{{exponent}}}" if factor == "1" else rf"{factor}\times 10^{{{exponent}}}"


def fraction(phi: float) -> str:
    """An area fraction with at least two digits: 0.9 → 0.90, 0.845 → 0.845."""
    return f"{phi:.2f}" if math.isclose(phi, round(phi, 2)) else f"{phi:g}"


def samples(counts) -> str:
    """How many samples stand behind the points of a figure: `8 samples`, `6–8 samples`."""
    low, high = int(min(counts)), int(max(counts))
    word = "sample" if high == 1 else "samples"
    return f"{high} {word}" if low == high else f"{low}–{high} {word}"


CONSTANTS = {
    "n": lambda n: f"$N = {n}$",
    "phi": lambda phi: rf"$\phi = {fraction(phi)}$",
    "kt": lambda kappa: f"$k_T / k_N = {power(kappa)}$",
}
"""How a caption names what all curves of a figure have in common."""


def write_caption(figure: Figure, table, constants: tuple = ("n",), note: str = "") -> None:
    """Constants of the table, number of samples, meaning of the bars, and a note, on top."""
    parts = [CONSTANTS[name](table[name].iloc[0]) for name in constants]
    parts += [samples(table["samples"]), "bars: standard error"]
    figure.suptitle(", ".join(parts) + (f"\n{note}" if note else ""))


def name_panel(axes: Axes, index: int, text: str) -> None:
    """Letter and text above a panel."""
    axes.set_title(f"({'abcdefgh'[index]}) {text}")


def logarithmic_limits(values) -> tuple[float, float]:
    """Limits around positive values; error bars that reach 0 would else set them."""
    return values.min() / 3, values.max() * 3


def say_empty(figure: Figure) -> None:
    """A figure for which the ensemble has no point to show."""
    figure.text(0.5, 0.5, "no converged sample to show", ha="center", va="center")
