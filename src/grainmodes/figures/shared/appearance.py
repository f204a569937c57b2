"""Colours, symbols and legend entries that the figures share."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import matplotlib
import matplotlib.colors
import matplotlib.style
import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

STYLE = Path(__file__).parents[1] / "grainmodes.mplstyle"
"""The style of all figures."""

RED, BLUE = "#b2182b", "#2166ac"
"""Two colours that colour-blind readers tell apart."""

TRANSLATIONAL, ROTATIONAL = RED, BLUE
"""Colours of ψ^T and ψ^R, red and blue as in A."""

BEFORE, AFTER = BLUE, RED
"""Colours of the state before and after an event or a release."""

OPEN_SYMBOLS = {"mfc": "none", "mew": 0.5, "markersize": 3.6}
"""Style of a curve that another curve covers: open symbols stay visible around those on top."""

MARKERS = "osD^vPX*"

SHORT_AXIS_RATIO = 200
"""Ratio of the limits of an axis below which labels at powers of ten alone would be too few."""


@contextmanager
def house_style() -> Iterator[None]:
    """The style of all figures alone: what a user's matplotlibrc says has no part in it."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.style.use(STYLE)
        yield


def curve_styles(values: list) -> Iterator[tuple]:
    """Value, colour and marker of each curve; lightness grows with the place in the list, so that
    a print in grey keeps the order."""
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.85, len(values)))
    for index, value in enumerate(values):
        yield value, tuple(colours[index]), MARKERS[index % len(MARKERS)]


def add_to_legend(axes: Axes, label: str, colour, marker: str, **style) -> None:
    """Add a symbol without an error bar to the legend."""
    axes.plot([], [], linestyle="none", marker=marker, color=colour, label=label, **style)


def draw_cloud(axes: Axes, x, y, error, colour, marker: str, **style) -> None:
    """Draw a curve of hundreds of points as small symbols with faint error bars.

    Args:
        error: (B,), or the lower and the upper arms (2, B).
    """
    faint = (*matplotlib.colors.to_rgb(colour), 0.35)
    style = {"markersize": 1.8, "ecolor": faint, "elinewidth": 0.5} | style
    axes.errorbar(x, y, error, fmt=marker, color=colour, **style)


def logarithmic_bars(mean: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Arms (2, B) of error bars on a logarithmic axis, where both have the length of the upper one.

    Below, a bar ends at mean / (1 + error / mean), which is mean − error for a small error and
    never 0.
    """
    mean, error = np.asarray(mean, float), np.asarray(error, float)
    return np.stack([mean * error / (mean + error), error])


def logarithmic_limits(values) -> tuple[float, float]:
    """Limits of an axis around positive values, with the bars of `logarithmic_bars` inside.

    The standard error of values that are not negative is at most their mean.
    """
    return values.min() / 3, values.max() * 3


def scale_logarithmically(axes: Axes) -> None:
    """Make the horizontal axis logarithmic, with labels that are enough also on a decade."""
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    if high < SHORT_AXIS_RATIO * low:
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
