"""Words of the figures: numbers as formulas, units of axes, titles of panels, captions."""

from __future__ import annotations

import math
import re
import textwrap
from fractions import Fraction

from matplotlib.axes import Axes
from matplotlib.figure import Figure

MODULUS_UNIT = {"hertz": r"$(k_N d^{1/2})$", "harmonic": "$k_N$"}
"""Unit of a modulus under each normal contact law."""

CHARACTERS_PER_INCH = 22
"""Number of characters of small print in an inch."""

MAX_DENOMINATOR = 99
"""Largest denominator of a k_T/k_N that is written as a ratio."""

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def modulus_label(symbol: str, table) -> str:
    """Label of an axis: a modulus and its unit under the contact law of the table."""
    return f"{symbol} / {MODULUS_UNIT[table['law'].iloc[0]]}"


def power(value: float, digits: int | None = None) -> str:
    """A number as a formula, first rounded to `digits` significant digits if they are given.

    1e-08 → 10^{-8}, 0.03 → 3 x 10^{-2}, 2 → 2.
    """
    if digits is not None:
        value = float(f"{value:.{digits}g}")
    rounded = f"{value:.2e}"
    if value == 0 or 0.1 <= abs(float(rounded)) < 1000:
        return f"{value:g}"
    mantissa, power_of_ten = rounded.split("e")
    factor, exponent = f"{float(mantissa):g}", int(power_of_ten)
    return rf"10^{{{exponent}}}" if factor == "1" else rf"{factor}\times 10^{{{exponent}}}"


def ratio(kt: float) -> str:
    """k_T/k_N as a formula: a ratio of small integers where it is one that decimals cut off.

    0.2857142857142857 → 2/7, 1e-8 → 10^{-8}, 0.25 → 0.25.
    """
    exact = Fraction(kt).limit_denominator(MAX_DENOMINATOR)
    is_short = math.isclose(float(f"{kt:.4g}"), kt, rel_tol=1e-12)
    if is_short or not math.isclose(exact, kt, rel_tol=1e-12):
        return power(kt)
    return f"{exact.numerator}/{exact.denominator}"


def plain(formula: str) -> str:
    r"""Formulas of `power` and `ratio` as text: $3\times 10^{-2}$ → 3 × 10⁻²."""
    raised = re.sub(r"\^\{(.+?)\}", lambda found: found[1].translate(SUPERSCRIPTS), formula)
    return raised.replace(r"\times", " ×").replace("$", "")


def fraction(phi: float) -> str:
    """An area fraction with at least two digits: 0.9 → 0.90, 0.845 → 0.845."""
    return f"{phi:.2f}" if math.isclose(phi, round(phi, 2)) else f"{phi:g}"


def count_samples(counts, one: str = "sample") -> str:
    """How many samples stand behind the points of a figure: `8 samples`, `6–8 samples`."""
    low, high = int(min(counts)), int(max(counts))
    word = one if high == 1 else f"{one}s"
    return f"{high} {word}" if low == high else f"{low}–{high} {word}"


CONSTANTS = {
    "n": lambda n: f"$N = {n}$",
    "phi": lambda phi: rf"$\phi = {fraction(phi)}$",
    "kt": lambda kt: f"$k_T / k_N = {ratio(kt)}$",
    "friction_coefficient": lambda mu: rf"$\mu = {mu:g}$",
}
"""How a caption states a value that all curves of a figure have in common."""


def constants(table, names: tuple[str, ...] = ("n", "phi", "kt")) -> list[str]:
    """These values of the first row of a table, as formulas; then Coulomb's μ, if it has one."""
    if "friction_coefficient" in table and table["friction_coefficient"].notna().any():
        names = (*names, "friction_coefficient")
    return [CONSTANTS[name](table[name].iloc[0]) for name in names]


def sample_caption(table, *parts: str) -> str:
    """N, φ, k_T and the seed of the sample that a table is about, then further parts."""
    return ", ".join([*constants(table), f"seed {table['seed'].iloc[0]}", *parts])


def write_caption(figure: Figure, table, names: tuple = ("n",), note: str = "") -> None:
    """Write constants, number of samples and the meaning of the bars above the figure, and a note
    below them."""
    parts = [*constants(table, names), count_samples(table["samples"]), "bars: standard error"]
    figure.suptitle(", ".join(parts) + (f"\n{note}" if note else ""))


def write_sample_caption(figure: Figure, table, note: str) -> None:
    """Write the constants of one sample above the figure, and a note below them."""
    figure.suptitle(f"{sample_caption(table)}\n{note}")


def name_panel(axes: Axes, index: int, text: str) -> None:
    """Write letter and title above a panel."""
    axes.set_title(f"({'abcdefgh'[index]}) {text}", loc="left")


def say_empty(figure: Figure, lines: list[str]) -> None:
    """Draw an empty frame, and in it why there is nothing to show."""
    axes = figure.subplots()
    axes.set(xticks=[], yticks=[])
    axes.minorticks_off()
    text = _wrapped(figure, lines)
    axes.text(0.5, 0.5, text, ha="center", va="center", transform=axes.transAxes, fontsize=8)


def write_below(figure: Figure, lines: list[str]) -> None:
    """Write below a figure which samples it lacks; nothing without lines.

    The text lies outside of the figure, whose picture `savefig(bbox_inches="tight")` then widens.
    """
    if lines:
        text = "missing: " + _wrapped(figure, lines)
        figure.text(0.02, -0.01, text, ha="left", va="top", fontsize=7, color="#b2182b")


def _wrapped(figure: Figure, lines: list[str]) -> str:
    """Lines that fit into the width of a figure at 7 or 8 points."""
    width = int(CHARACTERS_PER_INCH * figure.get_figwidth())
    return "\n".join(textwrap.fill(line, width) for line in lines)
