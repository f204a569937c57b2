"""Two real eigenvalues of M⁻¹J meet under shear and become a complex pair, C (19): C, Fig. 1.

Above the real parts, below the imaginary parts of the two, against γ; the dashed line lies where
they meet.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.ensemble import contact_law
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import law_values
from grainmodes.figures.shared.labels import write_sample_caption
from grainmodes.figures.shared.pair_samples import (
    EIGENVALUES,
    SAMPLE,
    choose_sample,
    draw_eigenvalues,
    is_pair,
    longest_pair,
    samples_with_paths,
)
from grainmodes.figures.shared.selection import Options

COLUMNS = SAMPLE | {"strain": ("1", "strain of the state")} | EIGENVALUES

STATES_AFTER_BIRTH = 20
"""Number of states of the pair that are shown."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """A row per state up to some states after the birth, with the columns `COLUMNS`.

    Raises:
        BlockError: the study did not request complex pairs.
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    sample = choose_sample(samples_with_paths(ensemble), options)
    if sample is None:
        return pd.DataFrame(columns=list(COLUMNS))
    path = longest_pair(sample)
    birth = is_pair(path).to_numpy().argmax()
    identity = sample.coordinates | law_values(contact_law(ensemble))
    return path.iloc[: birth + STATES_AFTER_BIRTH].assign(**identity)[list(COLUMNS)]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Two eigenvalues λ of M⁻¹J of one sample under quasistatic shear: above their real parts, "
        "below their imaginary parts, against strain γ. Blue and red: the two modes; dashed line: "
        "where they meet.",
        "two real eigenvalues approach, meet, and leave as a complex pair: one real part, two "
        "imaginary parts ±λ_i.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the real parts above the imaginary ones."""
    figure.set_size_inches(3.6, 4.2)
    real, imaginary = figure.subplots(2, 1, sharex=True)
    draw_eigenvalues(real, imaginary, table)
    imaginary.set(xlabel=r"$\gamma$")
    figure.align_ylabels()
    write_sample_caption(figure, table, "two real modes become a complex pair")
