"""Fields of a packing: the displacement of its grains under a step strain, and single modes.

    r_i(Δγ) − r_i(0) = Δγ (y_i − L/2, 0) + Δr̊_i,    ℓ_i(Δγ) − ℓ_i(0) = Δℓ̊_i        A (10), (11)
    u_i = (dr̊_i/dγ, dℓ̊_i/dγ)                                                     A (12), (13), (33)

u is found in three ways that must agree: the direct solve of `moduli`, the sum over the modes,
A (38), and relaxed step strains (`protocols.shear.step_strain_field`). Eigenvectors,
J R_n = λ_n R_n with λ_n = ω_n², are those of A (21), (48).

A field is (N, 3) float64, components (x, y, ℓ), on all grains: NaN for the rattlers, which are
removed before anything is solved, and NaN for ℓ where friction does not exist. The mean of x and of
y is zero: a translation of all grains is no response to strain.

| symbol  | name                       |   | symbol | name                        |
| ------- | -------------------------- | - | ------ | --------------------------- |
| y − L/2 | `affine_field`             |   | ω_n    | `NearestModes.frequency`    |
| u       | `nonaffine_field`, …       |   | R_n    | `NearestModes.eigenvector`  |
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing, nan_on_rattlers, rattlers
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.response.mode_sum import mode_sum
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import Eigenproblem, packing_spectrum
from grainmodes.spectrum.nearest_eigenpair import nearest_eigenpair


@dataclass(frozen=True)
class NearestModes:
    """M modes: ω_n in 1/t_0 (M,), R_n of norm 1 (M, N, 3), and |J R − λ R| (M,)."""

    frequency: np.ndarray
    eigenvector: np.ndarray
    residual: np.ndarray


def affine_field(packing: Packing) -> np.ndarray:
    """(y_i − L/2, 0, 0) of every grain, (N, 3) in d: the affine displacement per unit strain."""
    field = np.zeros((packing.n, 3))
    field[:, 0] = packing.position[:, 1] - packing.box_length / 2
    return field


def nonaffine_field(packing: Packing, interaction: Interaction, threshold: int = 2) -> np.ndarray:
    """u from one sparse solve, for springs that the affine step does not load; (N, 3) in d.

    Raises:
        FloppyError: the backbone has zero modes beyond the translations.
    """
    backbone_mask = ~rattlers(packing, threshold)
    unloaded = rigidity(packing, interaction, threshold).unloaded
    return nan_on_rattlers(unloaded.displacement, backbone_mask)


def mode_sum_field(packing: Packing, interaction: Interaction, threshold: int = 2) -> np.ndarray:
    """u from all eigenvectors of a dense J, A (38); (N, 3) in d.

    Raises:
        ValueError: J is not symmetric.
    """
    backbone_mask = ~rattlers(packing, threshold)
    modes = packing_spectrum(
        packing, interaction, threshold, choices=SpectrumChoices(method="dense")
    )
    displacement = mode_sum(packing, interaction, modes, threshold).displacement
    return nan_on_rattlers(displacement, backbone_mask)


def nearest_modes(
    packing: Packing, interaction: Interaction, frequencies: tuple[float, ...], threshold: int = 2
) -> NearestModes:
    """The mode whose λ is nearest to ω², for each ω in `frequencies` (1/t_0), except translations.

    Raises:
        ValueError: J is not symmetric.
    """
    if packing.history is not None:
        raise ValueError(
            "expected a symmetric Jacobian for single modes, got one with springs (s other than 0)"
        )
    backbone_mask = ~rattlers(packing, threshold)
    eigenproblem = Eigenproblem.from_packing(packing, interaction, threshold)
    pairs = [_nearest(eigenproblem, frequency**2) for frequency in frequencies]
    values, vectors = np.array([value for value, _ in pairs]), np.array([r for _, r in pairs])
    return NearestModes(
        np.sqrt(np.abs(values)),
        np.stack(
            [
                nan_on_rattlers(vector.reshape(-1, eigenproblem.k), backbone_mask)
                for vector in vectors
            ]
        ),
        np.linalg.norm(eigenproblem.matrix @ vectors.T - vectors.T * values, axis=0),
    )


def _nearest(eigenproblem: Eigenproblem, shift: float) -> tuple[float, np.ndarray]:
    """The eigenpair nearest to a shift, without translations; its largest component is positive."""
    (value,), vectors = nearest_eigenpair(eigenproblem.symmetric_shift(), shift, eigenproblem.bound)
    vector = vectors[:, 0]
    return value, vector * np.sign(vector[np.argmax(np.abs(vector))])
