"""Eigenvalues and modes of the Jacobian: counted, in windows, in bins, or all at once."""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.spectrum.binned_averages import Bands, band_averages
from grainmodes.spectrum.full import Spectrum, full_spectrum
from grainmodes.spectrum.problem import Problem, problem

__all__ = [
    "Bands",
    "Problem",
    "Spectrum",
    "SpectrumChoices",
    "band_averages",
    "full_spectrum",
    "problem",
    "spectrum",
]


def spectrum(
    packing: Packing,
    interaction: Interaction,
    threshold: int = 2,
    keep_rattlers: bool = False,
    modes: bool = True,
    forces: np.ndarray | None = None,
    choices: SpectrumChoices = SpectrumChoices(),
) -> Spectrum:
    """The whole spectrum of a packing: `full_spectrum` of its `problem`."""
    return full_spectrum(
        problem(packing, interaction, threshold, keep_rattlers), modes, forces, choices
    )
