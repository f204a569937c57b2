"""The non-affine field of a simulated step strain: A (10)–(13).

    u = [Δr̊(Δγ) − Δr̊(−Δγ)] / 2Δγ

A takes the forward difference; the central one leaves an error of second order.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import rattlers
from grainmodes.packing.state import Packing, find_contacts, nonaffine_motion, on_all_grains
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import relaxed_steps


def simulated_field(
    packing: Packing, interaction: Interaction, protocol: StepStrain, threshold: int = 2
) -> np.ndarray:
    """u from step strains to both sides, relaxed by the full non-linear forces; (N, 3) in d.

    Raises:
        ArithmeticError: a relaxation did not reach its force tolerance.
    """
    gone = rattlers(find_contacts(packing), packing.n, threshold)
    backbone = packing.without(gone)
    steps = relaxed_steps(backbone, interaction, protocol)
    for step in steps:
        if not step.converged:
            worst = max(step.max_force, step.max_torque)
            raise ArithmeticError(f"step strain: {worst:.1e} is left after {step.iterations} steps")
    forward, backward = (nonaffine_motion(backbone, step.packing) for step in steps)
    u = (forward - backward) / (2.0 * protocol.strain)
    u[:, :2] -= u[:, :2].mean(axis=0)
    return on_all_grains(u, gone)
