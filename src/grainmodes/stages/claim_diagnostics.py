"""Numbers that single claims of paper A need, a row per packing and k_T: stage `claim_diagnostics`.

| claim                                        | diagnostic                             |
| -------------------------------------------- | -------------------------------------- |
| A1   simulation with A's damped dynamics     | one forward step, k_T/k_N ≥ 1          |
| A12  D = D_H                                 | H − J, with slopes and with k_N, k_T;  |
|                                              | the shift of the spectra under shear   |
| A16  g does not depend on Δγ                 | forward step strains of three sizes    |
| A17  translational modes alone give g        | mode sum over ψ^T > 1/2                |
| A18  velocity Verlet is right to Δt² and Δt  | one step against 32 short ones         |
| A19  compressed with friction: complex pairs | λ of M⁻¹J, and J − Jᵀ                  |
| A21  u of theory = u of simulation (Fig. 3)  | ‖u − u simulated‖ / ‖u‖                |

A diagnostic that fails leaves NaN in its place and its sentence among the failures; the row counts
as converged all the same, so that the sample is not lost for the other observables. NaN also stands
for what does not exist: at k_T = 0 there is no velocity Verlet, a sum over modes needs a symmetric
J, and large packings have no dense matrices (`MAX_DENSE_GRAINS`, `MAX_PAIR_GRAINS`). A packing that
is not jammed has g = 0 and no pairs. A rotation of weak friction takes 1 / κ time units to relax in
A's dynamics, which is therefore run at k_T/k_N ≥ 1 only, where it takes seconds.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.damping import Dashpot
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.hessian import effective_hessian
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing, backbone
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.strain import Shear, StepStrain
from grainmodes.protocols.shear.sheared_hessian import hessian_shift_under_shear
from grainmodes.protocols.shear.step_strain import forward_rigidity
from grainmodes.protocols.shear.step_strain_field import simulated_field
from grainmodes.relaxation.accuracy import step_orders
from grainmodes.response.fields import nonaffine_field
from grainmodes.response.mode_sum import ModeRigidity
from grainmodes.response.stability import asymmetry, count_complex_pairs
from grainmodes.spectrum import packing_spectrum
from grainmodes.stages.rows import SAMPLE_ERRORS, response_block
from grainmodes.stages.samples import jammed_packing, springs_at_rest

STRAINS = (1e-6, 1e-5, 1e-4)
"""Δγ of claim A16."""

SHEAR = Shear(strain=0.01, step=1e-3, min_step=1e-5)
"""The shear to the state of claim A12."""

MIN_DAMPED_KAPPA = 1.0
"""Smallest k_T/k_N at which a step strain is relaxed by the damped dynamics."""

MAX_DENSE_GRAINS = 1024
"""Most grains of which all eigenvectors are computed."""

MAX_PAIR_GRAINS = 512
"""Most grains of which all eigenvalues of a matrix that is not symmetric are computed."""

MAX_DAMPED_GRAINS = 128
"""Most grains that the damped dynamics relaxes, or that are sheared to the state of claim A12."""


class Attempts:
    """Calls functions that may fail, and collects the sentences of those that do."""

    def __init__(self):
        self.sentences: list[str] = []

    def __call__(self, default: Any, function: Callable, *arguments: Any) -> Any:
        """What the function returns, or `default` where it fails."""
        try:
            return function(*arguments)
        except SAMPLE_ERRORS as error:
            self.sentences.append(f"{function.__name__}: {error}")
            return default


def claim_diagnostics_block(
    packings: Block, law: ContactLaw, rattlers: Rattlers, step: StepStrain
) -> Block:
    """All diagnostics of every packing; a packing that is not in balance has no numbers."""
    threshold = rattlers.largest(law, springs_at_rest(packings))

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, Interaction.from_law(law))
        attempt = Attempts()
        if jammed:
            row = diagnostics_row(packing, law, threshold, step, attempt)
        else:
            row = unjammed_row(packing, law)
        failures = {"failures": "; ".join(attempt.sentences)} if attempt.sentences else {}
        return {"diagnostic_strain": STRAINS, "converged": True} | row | failures

    config = {"law": asdict(law), "rattlers": asdict(rattlers), "step_strain": asdict(step)}
    return response_block(packings, "claim_diagnostics", config, law, sample)


def unjammed_row(packing: Packing, law: ContactLaw) -> dict[str, object]:
    """The row of a packing that is not jammed."""
    row: dict[str, object] = {"g_forward_by_strain": np.zeros(len(STRAINS))}
    if packing.n <= MAX_DENSE_GRAINS:
        row |= {"g_translational": 0.0}
    if law.frictional and packing.n <= MAX_PAIR_GRAINS:
        row["complex_pairs_at_rest"] = 0
    return row


def diagnostics_row(
    packing: Packing, law: ContactLaw, threshold: int, step: StepStrain, attempt: Attempts
) -> dict[str, object]:
    """The row of a jammed packing, in which a diagnostic that fails is NaN.

    `threshold` is the largest number of contacts of a rattler.
    """
    interaction = Interaction.from_law(law)
    row = {
        "g_forward_by_strain": [
            attempt(np.nan, forward_rigidity, packing, interaction, sized, threshold)
            for sized in (replace(step, strain=strain) for strain in STRAINS)
        ],
        "hessian_difference": attempt(np.nan, hessian_difference, packing, interaction, "tangent"),
        "hessian_printed_difference": attempt(
            np.nan, hessian_difference, packing, interaction, "printed"
        ),
        "field_difference": attempt(
            np.nan, field_difference, packing, interaction, step, threshold
        ),
    }
    if packing.n <= MAX_DENSE_GRAINS and packing.history is None:
        row["g_translational"] = attempt(
            np.nan, translational_rigidity, packing, interaction, threshold
        )
    return row | _frictional(packing, law, threshold, step, attempt)


def _frictional(
    packing: Packing, law: ContactLaw, threshold: int, step: StepStrain, attempt: Attempts
) -> dict[str, object]:
    """The diagnostics of a packing whose grains have velocities and springs."""
    if not law.frictional:
        return {}
    interaction = Interaction.from_law(law)
    orders = attempt((np.nan, np.nan), step_orders, packing, interaction, Dashpot(step.damping))
    row = dict(zip(("verlet_order_position", "verlet_order_velocity"), orders, strict=True))
    rigid = backbone(packing, threshold)
    row["asymmetry_at_rest"] = asymmetry(jacobian(rigid, interaction))
    if packing.n <= MAX_PAIR_GRAINS:
        row["complex_pairs_at_rest"] = attempt(np.nan, pairs_at_rest, rigid, interaction)
    if packing.n > MAX_DAMPED_GRAINS:
        return row
    row["hessian_shift_sheared"] = attempt(
        np.nan, hessian_shift_under_shear, packing, interaction, SHEAR
    )
    if law.kt >= MIN_DAMPED_KAPPA:
        damped = replace(step, relaxation="damped")
        row["g_forward_damped"] = attempt(
            np.nan, forward_rigidity, packing, interaction, damped, threshold
        )
    return row


def translational_rigidity(packing: Packing, interaction: Interaction, threshold: int) -> float:
    """g to which only the modes with ψ^T > 1/2 contribute."""
    by_mode = ModeRigidity(packing, interaction, threshold)
    found = packing_spectrum(packing, interaction, threshold, forces=by_mode.forces)
    assert found.psi_rotational is not None  # all modes are requested
    translational = found.psi_rotational < 0.5
    return by_mode.g_affine + float(by_mode.contributions(found)[translational].sum())


def field_difference(
    packing: Packing, interaction: Interaction, step: StepStrain, threshold: int
) -> float:
    """‖u − u simulated‖ / ‖u‖ over all grains and components that exist."""
    theory = nonaffine_field(packing, interaction, threshold)
    simulated = simulated_field(packing, interaction, step, threshold)
    return float(np.sqrt(np.nansum((theory - simulated) ** 2) / np.nansum(theory**2)))


def hessian_difference(packing: Packing, interaction: Interaction, stiffness: str) -> float:
    """max|H − J| / max|J| over the entries."""
    matrix = jacobian(packing, interaction)
    difference = effective_hessian(packing, interaction, stiffness) - matrix
    return float(abs(difference).max() / abs(matrix).max())


def pairs_at_rest(rigid: Packing, interaction: Interaction) -> int:
    """Number of complex pairs of a packing without rattlers; a symmetric J has none."""
    return 0 if rigid.history is None else count_complex_pairs(rigid, interaction)
