"""The stage `step_strain`: g of every packing by simulated step strains (A, Sec. II)."""

from __future__ import annotations

from dataclasses import asdict

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import step_strain
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import jammed_packing, springs_at_rest


def step_strain_block(
    packings: Block, law: ContactLaw, rattlers: Rattlers, step: StepStrain
) -> Block:
    """g of every packing from step strains, relaxed by the full non-linear forces."""
    interaction = Interaction.from_law(law)
    threshold = rattlers.largest(law, springs_at_rest(packings))

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        if not jammed:
            return {"g_simulated": 0.0, "g_simulated_forward": 0.0, "converged": True}
        result = step_strain(packing, interaction, step, threshold)
        if not result.converged:
            raise ArithmeticError(
                f"step strain {result.strain}: expected max|F| and max|2T/d| < "
                f"{step.force_tolerance:.1e}, got {result.max_force:.1e} and "
                f"{result.max_torque:.1e} after {result.iterations} iterations"
            )
        return {
            "g_simulated": result.g,
            "g_simulated_forward": result.g_forward,
            "g_simulated_error": result.error,
            "strain_simulated": result.strain,
            "contact_changes": result.contact_changes,
            "iterations_simulated": result.iterations,
            "max_force_simulated": result.max_force,
            "max_torque_simulated": result.max_torque,
            "converged": True,
        }

    config = {"law": asdict(law), "rattlers": asdict(rattlers), "step_strain": asdict(step)}
    return response_block(packings, "step_strain", config, law, sample)
