"""The spectrum of J beside that of the effective Hessian in a sheared state: A, App. H.

At s = 0, where A compares the two, H equals J entry by entry, so that their densities of states are
the same by construction. Under shear the springs are stretched, s ≠ 0, and J has terms that H
leaves out (`packing.hessian`): only there does D = D_H say anything.

    shift = < |ω_n / ω_H,n − 1| >      over the modes, ranked by frequency

ω_n² is the real part of an eigenvalue of J, which is not symmetric at s ≠ 0.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.hessian import effective_hessian
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun

ZERO_MODE_RATIO = 1e-13
"""|λ| / λ_max below which an eigenvalue counts as zero; dense, without symmetry."""


def hessian_shift_under_shear(packing: Packing, interaction: Interaction, choices: Shear) -> float:
    """The mean shift between the spectra of J and H after quasistatic shear.

    Raises:
        ArithmeticError: a state along the shear has no stable equilibrium.
    """
    run = QuasistaticRun.from_packing(packing, interaction, choices)
    while not run.done:
        if not run.advance():
            raise ArithmeticError(f"shear at strain {run.state.strain:g}: {run.failure}")
    return spectral_shift(run.state.equilibrium.packing, interaction)


def spectral_shift(packing: Packing, interaction: Interaction) -> float:
    """< |ω_n / ω_H,n − 1| > of a packing, over the modes that are positive in both."""
    matrix = jacobian(packing, interaction).toarray()
    of_jacobian = np.sort(np.linalg.eigvals(matrix).real)
    of_hessian = np.linalg.eigvalsh(effective_hessian(packing, interaction).toarray())
    smallest = ZERO_MODE_RATIO * of_hessian[-1]
    known = (of_jacobian > smallest) & (of_hessian > smallest)
    return float(np.mean(np.abs(np.sqrt(of_jacobian[known] / of_hessian[known]) - 1.0)))
