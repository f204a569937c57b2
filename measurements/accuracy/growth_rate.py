"""Growth rate ω_i of an unstable state, measured on its motion: C (9)–(13).

    K = M^(−1/2) J M^(−1/2),   K u = λ u,   vᴴ K = λ vᴴ,   Ω = √λ = ω_r + iω_i
    c = vᴴ M^(1/2) q obeys c̈ = −λ c;   a = (c + i ċ/Ω) / 2 ∝ e^(−iΩt),   ω_i = ln|a(T)/a(0)| / T

so that a motion that starts in the balance with q̇ along the mode gives ω_i without a fit. Terms
even in q, which are the first nonlinear term and the residual forces of the balance, cancel in half
the difference of two motions with opposite initial velocities.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.kernels.damping import Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.mass_weighted import root_mass
from grainmodes.packing.state import Packing, nonaffine_motion
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.pair_tracking.tracking import PairTracking
from grainmodes.relaxation.dynamics import move
from measurements.accuracy.packings import compressed

INTERACTION = Interaction.from_law(ContactLaw("hertz", "smoothed_coulomb", 2.0 / 7.0, 10.0))
"""C's law."""

GRAINS = Compression(phi_step=1e-3, large_diameter=1.4, masses="equal")
"""C's grains."""

SHEAR, PAIRS = Shear(0.02, force_tolerance=2e-15), PairChoices("dense", max_located=0)

MIN_GROWTH_RATE = 5e-3
"""ω_i t_0 below which a state is left out, as its growth would take too long."""

START_SPEED = 1e-8
"""Norm of q̇ at the start, d/t_0."""

GROWTH_TIMES = 3.0
"""Duration of a motion in 1/ω_i."""


class UnstableState(NamedTuple):
    """A balance, Ω of its fastest pair, and M^(1/2) times its vectors: u/M and v, (3N,) complex."""

    packing: Packing
    omega: complex
    mode: np.ndarray
    left: np.ndarray

    def amplitude(self, packing: Packing, velocity: np.ndarray) -> complex:
        """a of a moving packing."""
        moved = nonaffine_motion(self.packing, packing).ravel()
        c, rate = (np.vdot(self.left, motion) for motion in (moved, velocity.ravel()))
        return complex(c + 1j * rate / self.omega) / 2.0

    @property
    def duration(self) -> float:
        """Time that `rate` covers, with both kicks, in t_0."""
        return 2.0 * GROWTH_TIMES / self.omega.imag

    def rate(self, time_step: float) -> float:
        """ω_i of velocity Verlet with this Δt, in 1/t_0."""
        kick = START_SPEED * self.mode.real.reshape(-1, 3) / np.linalg.norm(self.mode.real)
        steps = round(GROWTH_TIMES / (self.omega.imag * time_step))
        ends = [
            move(self.packing, sign * kick, INTERACTION, Undamped(), time_step, Stop(0.0, steps))
            for sign in (1.0, -1.0)
        ]
        there, back = (self.amplitude(end.packing, end.velocity) for end in ends)
        grown = (there - back) / 2.0 / self.amplitude(self.packing, kick)
        return float(np.log(abs(grown)) / (steps * time_step))


def unstable_state(n: int, seed: int) -> UnstableState | None:
    """The state along a shear that is released; None if it grows too slowly."""
    tracking = PairTracking.start(compressed(n, seed, 0.9, GRAINS), INTERACTION, SHEAR, PAIRS)
    while not tracking.done:
        tracking.advance()
    (found,) = tracking.candidates.found
    if found is None or found.growth < MIN_GROWTH_RATE:
        return None
    pairs, packing = found.state.pairs, found.state.equilibrium.packing
    root = root_mass(packing.mass).ravel()
    right, left = (vectors[:, found.place] for vectors in (pairs.right, pairs.left))
    omega = complex(np.sqrt(pairs.value[found.place]))
    return UnstableState(packing, omega, right / root, left * root)
