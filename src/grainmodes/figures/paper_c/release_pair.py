"""The pair of a released state along its shear, and its growth: C, Fig. 12.

(a) real parts, (b) imaginary parts of the two eigenvalues of M⁻¹J against γ; dotted line: the state
that is released; (c) M(t), C (29), of its release without damping against ω_i t, line e^(2 ω_i t).
C draws them for harmonic grains with the smoothed Coulomb law.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import TRANSLATIONAL
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.pair_samples import EIGENVALUES, draw_eigenvalues
from grainmodes.figures.shared.release_rows import (
    END_TIME,
    RUN,
    ReleasedState,
    growing_records,
    growth_line,
    one_released_state,
    release_caption,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **RUN,
    "kind": ("", "shear: a state of the shear; record: a time of the release"),
    "strain": ("1", "strain of a state of the shear"),
    **EIGENVALUES,
    "released_strain": ("1", "strain of the state that is released"),
    "time": ("t_0", "time of a record"),
    "m": ("d^2", "mean square displacement M"),
    **END_TIME,
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The states of the shear, then the records of the release, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    return joined((_rows(state) for state in one_released_state(releases, options)), COLUMNS)


def _rows(state: ReleasedState) -> pd.DataFrame:
    path = {name: state.values(f"path_{name}") for name in ("strain", *EIGENVALUES)}
    shear = pd.DataFrame(state.identity() | {"kind": "shear"} | path).dropna(subset="strain")
    names = {"time": "time", "m": "mean_square_displacement"}
    records = state.records(names).assign(kind="record", end_time=state.first("end_time"))
    rows = pd.concat([shear, records], ignore_index=True)
    return rows.assign(released_strain=float(state.values("start_strain")))


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "A complex pair of M⁻¹J of one sample under quasistatic shear, (a) real parts and (b) "
        "imaginary parts of its two eigenvalues against strain; dashed lines: where they meet and "
        "part; dotted: the state that is released. (c) Mean square displacement M of this state "
        "released without damping, against ω_i t; line: e^(2 ω_i t).",
        "the pair is born where two real eigenvalues meet, and the released state leaves its "
        "equilibrium at the rate of the pair.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the eigenvalues on the left and the growth on the right."""
    figure.set_size_inches(7.0, 3.6)
    left, right = figure.subfigures(1, 2, squeeze=False)[0]
    real, imaginary = left.subplots(2, 1, sharex=True)
    draw_eigenvalues(real, imaginary, table[table["kind"] == "shear"])
    for axes in (real, imaginary):
        axes.axvline(table["released_strain"].iloc[0], color="0.3", ls=":", lw=0.9, zorder=0)
    imaginary.set(xlabel=r"$\gamma$")
    left.align_ylabels()
    growth = right.subplots()
    _draw_growth(growth, table[table["kind"] == "record"])
    for index, (axes, title) in enumerate(
        ((real, "real parts"), (imaginary, "imaginary parts"), (growth, "growth"))
    ):
        labels.name_panel(axes, index, title)
    figure.suptitle(release_caption(table))


def _draw_growth(axes: Axes, records: pd.DataFrame) -> None:
    shown = growing_records(records)
    time = shown["rate"] * shown["time"]
    axes.semilogy(time, shown["m"], ".", color="k", ms=1.6, label="dynamics")
    style = {"color": TRANSLATIONAL, "label": r"$e^{2 \omega_i t}$"}
    axes.semilogy(time, growth_line(shown, "m", 2.0), **style)
    axes.set(xlabel=r"$\omega_i t$", ylabel="$M / d^2$")
    axes.legend(loc="upper left")
