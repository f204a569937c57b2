"""Single eigenvectors of the Jacobian as maps, a row of maps per k_T: A, Fig. 7.

Arrows are the components (x, y) of a mode, colours its rotation ℓ, all maps on one scale: a mode
without rotation is pale, a mode without translation has no arrows.

The caption and the text of A exchange ω t_0 = 1e-4 and 1e-2 between the two k_T. The rotational
band lies at ω_R t_0 = (k_T/k_N)^(1/2), so that 1e-4 belongs to k_T/k_N = 1e-8 and 1e-2 to 1e-4, as
the caption has it.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.grain_maps import (
    add_colour_bar,
    add_keys,
    draw_map,
    write_map_caption,
)
from grainmodes.figures.shared.grain_rows import GRAINS, field_columns, field_values, grain_rows
from grainmodes.figures.shared.map_scale import Scale, arrow_note
from grainmodes.figures.shared.mode_marks import PAPER_KTS, row_letters
from grainmodes.figures.shared.sample_files import jammed_at_point, joined
from grainmodes.figures.shared.selection import Options, choose_curves, positive_kts

PAPER_N = 4096

COLUMNS = {
    **GRAINS,
    "omega_asked": ("1/t_0", "frequency near which a mode was sought"),
    "omega": ("1/t_0", "frequency of the mode"),
    "psi_rotational": ("1", "its rotational fraction psi^R"),
    **field_columns("mode", "1", "its eigenvector of norm 1, times N^(1/2); empty: a rattler"),
}


def table(fields: list[Block], options: Options) -> pd.DataFrame:
    """A row per k_T, mode and grain, with the columns `COLUMNS`.

    Raises:
        BlockError: samples are jammed, but none has eigenvectors.
        ValueError: no sample has the requested n, phi or kt, or none a kt above 0.
    """
    samples = jammed_at_point(fields, options, "eigenvectors", "eigenvector", PAPER_N)
    kts = _choose_kts(samples, options) if samples else []
    shown = sorted(
        (block for block in samples if block.attributes["kt"] in kts),
        key=lambda block: block.attributes["kt"],
    )
    return joined((rows for block in shown for rows in _rows_of_modes(block)), COLUMNS)


def _choose_kts(samples: list[Block], options: Options) -> list[float]:
    """The requested k_T, else A's, else up to two."""
    values = np.unique([block.attributes["kt"] for block in samples])
    values = positive_kts(values, "eigenvectors")
    if options.kt is not None:
        return choose_curves(options.kt, values, "kt")
    paper = [kt for kt in PAPER_KTS if kt in values]
    return paper or list(values[: len(PAPER_KTS)])


def _rows_of_modes(block: Block) -> Iterator[pd.DataFrame]:
    names = ("frequency_requested", "frequency_found", "eigenvector")
    modes = zip(*(block.variables[name][0] for name in names), strict=True)
    for requested, found, vector in modes:
        psi = np.nansum(vector[:, 2] ** 2)
        scaled = field_values("mode", vector * np.sqrt(len(vector)))
        yield grain_rows(block).assign(
            omega_asked=requested, omega=found, psi_rotational=psi, **scaled
        )


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Eigenvectors of the Jacobian near three frequencies, a row of maps per k_T/k_N, of one "
        "sample. Arrows: components (x, y), colours: rotations ℓ, of the eigenvector of norm 1 "
        f"times N^(1/2), all on one scale{arrow_note(table)}. Above each map its frequency and its "
        "rotational fraction ψᴿ. An empty circle is a grain that carries no load.",
        "(a1), (b1): rotations alone, as in Region I; (a3), (b3): translations; (a2) beside (b2): "
        "the same frequency, once translations alone and once both.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a row of maps per k_T."""
    kts = sorted(table["kt"].unique())
    columns = table.groupby("kt")["omega_asked"].nunique().max()
    figure.set_size_inches(7.0, 1.3 + 2.65 * len(kts))
    figure.set_layout_engine("compressed")
    grid = figure.subplots(len(kts), columns, squeeze=False, sharex=True, sharey=True)
    scale = Scale.from_fields(table, ("mode",), arrow=1.2)
    for letter, kt, panels in zip(row_letters(kts), kts, grid, strict=True):
        _row_of_maps(letter, panels, table[table["kt"] == kt], scale)
        panels[0].set_ylabel(f"$k_T / k_N = {labels.ratio(kt)}$\n$y/d$")
    add_keys(panels[-1], scale, "")
    label = r"rotation $N^{1/2} R^{\ell}_{n,i}$"
    add_colour_bar(figure, list(grid.ravel()), scale, label, orientation="horizontal", aspect=50)
    write_map_caption(figure, table, r"arrows: $N^{1/2} (R^x_{n,i}, R^y_{n,i})$")


def _row_of_maps(letter: str, panels: np.ndarray, rows: pd.DataFrame, scale: Scale) -> None:
    """Draw the modes of one k_T, ascending in frequency."""
    modes = [mode for _, mode in rows.groupby("omega_asked")]
    for axes in panels[len(modes) :]:
        axes.set_visible(False)
    for number, (axes, mode) in enumerate(zip(panels, modes, strict=False), start=1):
        draw_map(axes, mode, "mode", scale)
        axes.set_title(f"({letter}{number}) {_title(mode)}")
        axes.label_outer()


def _title(mode: pd.DataFrame) -> str:
    """ω and ψ^R of a mode, to two digits."""
    omega, psi = (labels.power(mode[name].iloc[0], 2) for name in ("omega", "psi_rotational"))
    return rf"$\omega t_0 = {omega}$" + "\n" + rf"$\psi^R = {psi}$"
