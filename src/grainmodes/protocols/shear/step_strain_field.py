"""The non-affine field of a simulated step strain: A (10)–(13).

    u = [Δr̊(Δγ) − Δr̊(−Δγ)] / 2Δγ

A takes the forward difference; the central difference leaves an error of second order.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import (
    Packing,
    nan_on_rattlers,
    nonaffine_motion,
    rattlers,
)
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import relaxed_steps, unbalanced


def simulated_field(
    packing: Packing, interaction: Interaction, protocol: StepStrain, threshold: int = 2
) -> np.ndarray:
    """u of steps ±Δγ, relaxed by the full non-linear forces, (N, 3) in d, NaN on rattlers.

    Raises:
        ArithmeticError: a relaxation did not reach its force tolerance.
    """
    is_rattler = rattlers(packing, threshold)
    backbone = packing.without(is_rattler)
    steps = relaxed_steps(backbone, interaction, protocol)
    for step in steps:
        if not step.converged:
            raise ArithmeticError(unbalanced(step, protocol))
    forward, backward = (nonaffine_motion(backbone, step.packing) for step in steps)
    u = (forward - backward) / (2.0 * protocol.strain)
    u[:, :2] -= u[:, :2].mean(axis=0)
    return nan_on_rattlers(u, ~is_rattler)
