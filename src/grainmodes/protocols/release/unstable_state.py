"""A balance with a complex pair of M⁻¹J, its growth rate and its mode: C (12), (22)–(28).

    M⁻¹J u^m = λ^m u^m,   u^m = u_r + iu_i,   λ^m = λ_r + iλ_i,   ω_r + iω_i = (λ^m)^(1/2)
    ü^m = ü¹ + ü² = (λ_r u_r − λ_i u_i) + (λ_i u_r + λ_r u_i)        C (27), (28); (25) corrected

From rest in q with q̇ along ü^m = Re(c u^m), c = λ_r + λ_i + i(λ_i − λ_r), the linear dynamics is

    q(t) = Re(c u^m sin(Ωt) / Ω),   Ω = ω_r + iω_i,

at late times a spiral e^(ω_i t) Re(c' u^m e^(−iω_r t)) of every grain. What a drag makes of the
growth is in `complex_pairs.damped_growth`.

| C          | name                   | shape, type            |
| ---------- | ---------------------- | ---------------------- |
| λ^m        | eigenvalue             | complex, λ_i > 0       |
| u^m        | mode                   | (N, 3) complex, of q   |
| ω_r, ω_i   | frequency, growth_rate | float, 1/t_0           |
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from grainmodes.complex_pairs.damped_growth import DampedPair
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.packing.state import Packing


@dataclass(frozen=True)
class UnstableState:
    """A balance, the eigenvalue of a complex pair of M⁻¹J with λ_i > 0, and its eigenvector."""

    packing: Packing
    eigenvalue: complex
    mode: np.ndarray

    @property
    def frequency(self) -> float:
        """ω_r, in 1/t_0."""
        return float(np.sqrt(complex(self.eigenvalue)).real)

    @property
    def growth_rate(self) -> float:
        """ω_i, in 1/t_0."""
        return float(np.sqrt(complex(self.eigenvalue)).imag)

    def initial_velocity(self, size: float) -> np.ndarray:
        """Velocities of (x, y, ℓ) along ü^m with root mean square |ṙ_i| = `size`: C (28).

        Shape (N, 3), in d/t_0 as `size`.
        """
        along = ((self.eigenvalue.real + self.eigenvalue.imag) * self.mode.real) + (
            (self.eigenvalue.real - self.eigenvalue.imag) * self.mode.imag
        )
        root_mean_square = np.sqrt((along[:, :2] ** 2).sum(axis=1).mean())
        velocity: np.ndarray = along * (size / root_mean_square)
        return velocity

    def random_velocity(self, size: float, seed: int) -> np.ndarray:
        """Random velocities of (x, y, ℓ) without net momentum, (N, 3), with root mean square
        |ṙ_i| = `size`, in d/t_0 as `size`."""
        velocity = np.random.default_rng(seed).standard_normal((self.packing.n, 3))
        mass = self.packing.mass
        velocity[:, :2] -= mass @ velocity[:, :2] / mass.sum()
        return velocity * (size / np.sqrt((velocity[:, :2] ** 2).sum(axis=1).mean()))

    def under_drag(self, interaction: Interaction, damped_motion: str) -> DampedPair:
        """The pair under a drag on "translations" or on "all" motion: C, Sec. VII."""
        mass = generalized_mass(self.packing.mass)
        damped = mass * (np.array([1.0, 1.0, 0.0]) if damped_motion == "translations" else 1.0)
        matrix = jacobian(self.packing, interaction)
        return DampedPair(matrix, mass.ravel(), damped.ravel(), self.eigenvalue, self.mode.ravel())

    def residual(self, interaction: Interaction) -> float:
        """max|M⁻¹J u − λ u| over |λ| max|u|."""
        matrix = jacobian(self.packing, interaction)
        mass = generalized_mass(self.packing.mass).ravel()
        vector = self.mode.ravel()
        difference = matrix @ vector / mass - self.eigenvalue * vector
        return float(np.abs(difference).max() / (abs(self.eigenvalue) * np.abs(vector).max()))
