"""An equilibrium state along a shear and what is measured on it: B (15)-(18), (42)-(51).

    σ_αβ(γ),   g_αβ = dσ_αβ/dγ by one solve with J,   the energy E that the contacts store

The rigidity is that of the loading protocol in use (`response.moduli`); B uses the unloaded one.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from grainmodes.packing.forces import energy, stress
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.response.moduli import AffineStep, Moduli
from grainmodes.response.stability import lowest_eigenvalue


class CurvePoint(NamedTuple):
    """One state of a stress-strain curve, in numbers.

    `stress` is σ_αβ (2, 2) in k_N d^(1/2), `modulus` g_αβ (2, 2) in k_N d^(1/2), `energy` E in
    k_N d^(5/2), and `lowest_eigenvalue` that of J, NaN where it was not requested.
    """

    strain: float
    stress: np.ndarray
    modulus: np.ndarray
    energy: float
    contact_number: float
    lowest_eigenvalue: float


@dataclass(frozen=True)
class ShearedState:
    """An equilibrium state at the strain of `strain_units` times Δγ_Th.

    `loaded` selects the loading protocol of the rigidity. `jumped` says that the dynamics had to
    find the equilibrium. `response_guess` is the non-affine field dq̊/dγ of a state near this one,
    (N', k) in d, from which the iteration for its own field starts.
    """

    equilibrium: EquilibriumState
    strain_units: int
    loaded: bool
    jumped: bool = False
    response_guess: np.ndarray | None = None

    @property
    def strain(self) -> float:
        """γ."""
        return self.equilibrium.packing.strain

    @cached_property
    def stress(self) -> np.ndarray:
        """σ_αβ, (2, 2) in k_N d^(1/2): B (15)."""
        equilibrium = self.equilibrium
        return stress(equilibrium.backbone, equilibrium.interaction)

    @cached_property
    def response(self) -> Moduli:
        """Linear response to a small strain: g and dq̊/dγ of the grains that carry load, B (41).

        Raises:
            FloppyError: the backbone has zero modes beyond the translations.
        """
        equilibrium = self.equilibrium
        step = AffineStep(equilibrium.backbone, equilibrium.interaction, self.loaded)
        return step.moduli(equilibrium.solve(step.force, self.response_guess))

    @cached_property
    def modulus(self) -> np.ndarray:
        """g_αβ = dσ_αβ/dγ, (2, 2) in k_N d^(1/2): B (42)-(51)."""
        modulus: np.ndarray = self.response.affine + self.response.nonaffine
        return modulus

    @property
    def sigma(self) -> float:
        """σ = (σ_xy + σ_yx)/2."""
        return float(self.stress[0, 1] + self.stress[1, 0]) / 2.0

    @property
    def g(self) -> float:
        """g = (g_xy + g_yx)/2."""
        return float(self.modulus[0, 1] + self.modulus[1, 0]) / 2.0

    @cached_property
    def lowest_eigenvalue(self) -> float:
        """Smallest |λ| of J apart from its two translations, with the sign of its real part."""
        equilibrium = self.equilibrium
        return lowest_eigenvalue(equilibrium.matrix, equilibrium.factor, equilibrium.force.shape[1])

    def curve_point(self, with_lowest: bool) -> CurvePoint:
        """This state in numbers, on request with the lowest eigenvalue of J."""
        equilibrium = self.equilibrium
        grains = int(equilibrium.backbone_mask.sum())
        return CurvePoint(
            self.strain,
            self.stress,
            self.modulus,
            energy(equilibrium.backbone, equilibrium.interaction),
            2.0 * len(equilibrium.backbone.contacts.i) / grains if grains else 0.0,
            self.lowest_eigenvalue if with_lowest else np.nan,
        )
