"""The stage `rigidity`: g, g_A and g_NA of every packing by linear response (A, Sec. III B)."""

from __future__ import annotations

from dataclasses import asdict

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.response.moduli import Moduli, rigidity
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import jammed_packing, springs_at_rest


def rigidity_block(packings: Block, law: ContactLaw, rattlers: Rattlers) -> Block:
    """g, g_A, g_NA of every packing, unloaded and loaded, from one sparse solve each."""
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        force = max_force_and_torque(net_force(packing, interaction))
        row: dict[str, object] = {"jammed": jammed, "converged": True}
        row |= {"max_force": force[0], "max_torque": force[1]}
        if not jammed:
            return row | dict.fromkeys([*_moduli_names(""), *_moduli_names("_loaded")], 0.0)
        moduli = rigidity(packing, interaction, rattlers.largest(law, springs_at_rest(packings)))
        return row | _moduli("", moduli.unloaded) | _moduli("_loaded", moduli.loaded)

    config = {"law": asdict(law), "rattlers": asdict(rattlers)}
    return response_block(packings, "rigidity", config, law, sample)


def _moduli_names(suffix: str) -> tuple[str, str, str]:
    return f"g{suffix}", f"g_affine{suffix}", f"g_nonaffine{suffix}"


def _moduli(suffix: str, moduli: Moduli) -> dict[str, float]:
    values = (moduli.g, moduli.g_affine, moduli.g_nonaffine)
    return dict(zip(_moduli_names(suffix), values, strict=True))
