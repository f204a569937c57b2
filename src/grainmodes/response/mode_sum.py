"""Rigidity as a sum over modes: A (38), (44), for a symmetric J (L_n = R_n).

    u = Σ'_n (R_n · Σa) R_n / λ_n
    g_NA = −(1/L²) Σ'_n (R_n · Σa_loaded) (R_n · Σa) / λ_n

Σ' leaves out the two translations. The second line follows from the first and A (44): the stress
that u relaxes is that of the loaded affine step (`moduli`), since K is symmetric. It needs two
projections of every mode and not the modes themselves. The sum must equal the direct solution; it
shows which modes carry the response.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing, backbone
from grainmodes.response.moduli import AffineStep, Moduli
from grainmodes.spectrum import FullSpectrum


def mode_sum(
    packing: Packing,
    interaction: Interaction,
    spectrum: FullSpectrum,
    threshold: int = 2,
    loaded: bool = False,
) -> Moduli:
    """g of a packing, and its non-affine field, from all modes of J of its backbone: A (38), (44).

    Args:
        spectrum: of the packing without its rattlers, with modes (M, M).
        threshold: a grain with at most so many contacts is a rattler.
        loaded: whether the affine step loads the tangential springs.

    Raises:
        ValueError: the Jacobian is not symmetric.
    """
    step = _affine_step(packing, interaction, threshold, loaded)
    elastic = elastic_modes(spectrum.eigenvalue)
    assert spectrum.modes is not None  # the method is "dense"
    modes = spectrum.modes[:, elastic]
    weight = modes.T @ step.force.ravel() / spectrum.eigenvalue[elastic]
    return step.moduli(modes @ weight)


class ModeRigidity:
    """Contribution of each mode to the unloaded g_NA of a packing without its rattlers.

    Attributes:
        forces: (M, 2) in k_N d^(3/2), on which the spectrum has to project its modes: Σa of the
            unloaded step and of the loaded one.

    Raises:
        ValueError: the Jacobian is not symmetric.
    """

    def __init__(self, packing: Packing, interaction: Interaction, threshold: int = 2):
        self._unloaded, loaded = (
            _affine_step(packing, interaction, threshold, how) for how in (False, True)
        )
        self.forces = np.stack([self._unloaded.force.ravel(), loaded.force.ravel()], axis=1)
        self._area = packing.box_length**2

    @property
    def g_affine(self) -> float:
        """g_A of the unloaded step."""
        return self._unloaded.moduli(np.zeros(len(self.forces))).g_affine

    def contributions(self, spectrum: FullSpectrum) -> np.ndarray:
        """Contribution of every mode to g_NA, (M,) in k_N d^(1/2); 0 for the translations.

        Raises:
            ArithmeticError: more eigenvalues are 0 than the two of the translations.
        """
        elastic = elastic_modes(spectrum.eigenvalue)
        if np.any(spectrum.eigenvalue[elastic] == 0.0):
            raise ArithmeticError("some modes lie below the lowest safe edge: no sum over modes")
        assert spectrum.projection is not None  # `forces` was projected
        product = spectrum.projection[elastic].prod(axis=1) / spectrum.eigenvalue[elastic]
        shares = np.zeros(len(spectrum.eigenvalue))
        shares[elastic] = -product / self._area
        return shares


def elastic_modes(eigenvalue: np.ndarray) -> np.ndarray:
    """Indices of all modes except the two translations, those of the smallest |λ|; (M − 2,)."""
    return np.sort(np.argsort(np.abs(eigenvalue), kind="stable")[2:])


def _affine_step(
    packing: Packing, interaction: Interaction, threshold: int, loaded: bool
) -> AffineStep:
    if packing.history is not None:
        raise ValueError("expected a symmetric Jacobian for a sum over modes, got one with springs")
    return AffineStep(backbone(packing, threshold), interaction, loaded)
