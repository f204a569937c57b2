"""Single eigenvectors: arrows for (x, y), colours for ℓ; a row of maps per k_T (A, Fig. 7).

A's caption and text exchange ω t_0 = 1e-4 and 1e-2 between the two k_T. The rotational band lies at
ω_R t_0 = (k_T/k_N)^(1/2): 1e-4 belongs to k_T/k_N = 1e-8 and 1e-2 to 1e-4, as the caption has it.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.quiver import Quiver

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import (
    GRAINS,
    at_point,
    components,
    described,
    grains,
    jammed,
    joined,
)
from grainmodes.figures.shared.grain_maps import (
    Scale,
    add_colour_bar,
    add_key,
    draw_map,
    write_caption,
)
from grainmodes.figures.shared.selection import Options, curves, positive

PAPER_N = 4096
PAPER_KT = (1e-8, 1e-4)

COLUMNS = {
    **GRAINS,
    "omega_asked": ("1/t_0", "frequency near which a mode was sought"),
    "omega": ("1/t_0", "frequency of the mode"),
    "psi_rotational": ("1", "its rotational fraction psi^R"),
    **described("mode", "1", "its eigenvector of norm 1, times N^(1/2); empty: a rattler"),
}


def table(fields: list[Block], options: Options) -> pd.DataFrame:
    """A row per k_T, mode and grain, with the columns `COLUMNS`.

    Raises:
        BlockError: samples are jammed, but none has eigenvectors.
        ValueError: no sample has the n, phi or kt asked for, or none a kt above 0.
    """
    samples = at_point(jammed(fields, "eigenvectors", "eigenvector"), options, PAPER_N)
    shown = _kts(samples, options) if samples else []
    chosen = sorted(
        (block for block in samples if block.attributes["kt"] in shown),
        key=lambda block: block.attributes["kt"],
    )
    return joined((rows for block in chosen for rows in _modes(block)), COLUMNS)


def _kts(samples: list[Block], options: Options) -> list[float]:
    """Those asked for, else A's, else up to two."""
    values = positive(np.unique([block.attributes["kt"] for block in samples]), "eigenvectors")
    paper = [kt for kt in PAPER_KT if kt in values]
    if options.kt is not None:
        return curves(options.kt, values, "kt")
    return paper or list(values[: len(PAPER_KT)])


def _modes(block: Block):
    sample = {name: array[0] for name, array in block.variables.items()}
    named = zip(
        sample["frequency_asked"], sample["frequency_found"], sample["eigenvector"], strict=True
    )
    for asked, found, vector in named:
        psi = np.nansum(vector[:, 2] ** 2)
        scaled = components("mode", vector * np.sqrt(len(vector)))
        yield grains(block).assign(omega_asked=asked, omega=found, psi_rotational=psi, **scaled)


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """All maps on one scale: without rotation a mode is pale, without motion it has no arrows."""
    kts = sorted(table["kt"].unique())
    columns = table.groupby("kt")["omega_asked"].nunique().max()
    figure.set_size_inches(7.0, 1.3 + 2.65 * len(kts))
    figure.set_layout_engine("compressed")
    grid = figure.subplots(len(kts), columns, squeeze=False, sharex=True, sharey=True)
    scale = Scale.of(table, ("mode",), arrow=1.2)
    for letter, kt, line in zip("abcdefgh", kts, grid, strict=False):
        arrows = _line(letter, line, table[table["kt"] == kt], scale)
        line[0].set_ylabel(f"$k_T / k_N = {appearance.power(kt)}$\n$y/d$")
    add_key(line[0], arrows, scale, "")
    label = r"rotation $N^{1/2} R^{\ell}_{n,i}$"
    add_colour_bar(figure, list(grid.ravel()), scale, label, orientation="horizontal", aspect=50)
    write_caption(figure, table, r"arrows: $N^{1/2} (R^x_{n,i}, R^y_{n,i})$")


def _line(letter: str, line: np.ndarray, of: pd.DataFrame, scale: Scale) -> Quiver:
    """The modes of one k_T, ascending in frequency; returns the arrows of the last."""
    modes = [mode for _, mode in of.groupby("omega_asked")]
    for axes in line[len(modes) :]:
        axes.set_visible(False)
    for number, (axes, mode) in enumerate(zip(line, modes, strict=False), start=1):
        arrows = draw_map(axes, mode, "mode", scale)
        axes.set_title(f"({letter}{number}) {_name(mode)}")
        axes.label_outer()
    return arrows


def _name(mode: pd.DataFrame) -> str:
    """ω and ψ^R of a mode, to two digits."""
    omega, psi = (
        appearance.power(float(f"{mode[column].iloc[0]:.2g}"))
        for column in ("omega", "psi_rotational")
    )
    return rf"$\omega t_0 = {omega}$" + "\n" + rf"$\psi^R = {psi}$"
