"""Rigidity as a sum over modes: A (38), (44), for a symmetric J (L_n = R_n).

    u = Σ'_n (R_n · Σa) R_n / λ_n

Σ' leaves out the two translations. The sum must equal the direct solve of `rigidity`; it costs all
eigenvectors, and is here because it says which modes carry the response.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing import Packing, find_contacts, rattlers
from grainmodes.rigidity import AffineStep, Moduli
from grainmodes.spectrum import Spectrum


def mode_sum(
    packing: Packing,
    interaction: Interaction,
    spectrum: Spectrum,
    threshold: int = 2,
    loaded: bool = False,
    among: np.ndarray | None = None,
) -> Moduli:
    """g of a packing from the modes of its symmetric J without rattlers.

    `among`, (M,) bool, lets only these modes respond; g_A is that of the whole packing.

    Raises:
        ValueError: the spectrum is that of a Jacobian that is not symmetric.
    """
    if packing.history is not None:
        raise ValueError("the sum over modes needs a symmetric Jacobian, every s = 0")
    gone = rattlers(find_contacts(packing), packing.n, threshold)
    backbone = packing.without(gone) if gone.any() else packing
    step = AffineStep(backbone, find_contacts(backbone), interaction, loaded)
    elastic = elastic_modes(spectrum.eigenvalue)
    if among is not None:
        elastic = elastic[among[elastic]]
    modes = spectrum.modes[:, elastic]
    weight = modes.T @ step.force.ravel() / spectrum.eigenvalue[elastic]
    return step.moduli(modes @ weight)


def elastic_modes(eigenvalue: np.ndarray) -> np.ndarray:
    """Indices of all modes but the two translations, those of the smallest |λ|."""
    return np.sort(np.argsort(np.abs(eigenvalue), kind="stable")[2:])
