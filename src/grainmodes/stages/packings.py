"""The stages of a study as pure functions: a block of samples in, a block of samples out.

    random grains → checkpoint → packing → { rigidity, step strain, spectrum }

No function here touches a file or knows a path. Every block says what made it: the parameters
(attribute `config`), the version of the code, and the sentence of every sample that failed.
"""

from __future__ import annotations

from dataclasses import asdict

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import largest, net_force
from grainmodes.packing.state import find_contacts
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.compression.trajectory import (
    compress_along_grid,
    compress_to,
    place_at_random,
)
from grainmodes.protocols.shear.step_strain import step_strain
from grainmodes.response.moduli import Moduli, rigidity
from grainmodes.stages.rows import block_of, described, response_block
from grainmodes.stages.samples import (
    check_same,
    check_start,
    checkpoint,
    jammed_packing,
    packed,
    trajectory_of,
)


def compress_block(
    n: int,
    seeds: range,
    phi: float,
    compression: Compression,
    normal: str,
    start: Block | None,
) -> Block:
    """Trajectories at the checkpoint φ, from random placement or from the checkpoint `start`."""
    law = _normal(normal)
    config = {"compression": asdict(compression), "normal": normal}
    if start is not None:
        check_start(start, config, phi)
        check_same(start, n, seeds)

    def sample(number: int) -> dict[str, object]:
        before = (
            place_at_random(n, seeds[number], law, compression)
            if start is None
            else trajectory_of(start, number)
        )
        return checkpoint(compress_along_grid(before, phi, law, compression))

    attributes = described("trajectories", config, n=n, phi=phi)
    failures = {} if start is None else start.mapping("failures")
    return block_of(seeds, sample, failures, attributes)


def packing_block(start: Block, phi: float, compression: Compression, normal: str) -> Block:
    """Packings at φ in their final balance, each on a branch from its checkpoint."""
    law = _normal(normal)
    config = {"compression": asdict(compression), "normal": normal}
    check_start(start, config, phi)

    def sample(number: int) -> dict[str, object]:
        grid = compress_along_grid(trajectory_of(start, number), phi, law, compression)
        relaxed = compress_to(grid, phi, law, compression)
        if not relaxed.converged:
            raise ArithmeticError(
                f"max|F| = {relaxed.max_force:.1e} after {relaxed.iterations} iterations"
            )
        return packed(relaxed.packing, law) | {
            "phi_jamming": grid.phi_jamming,
            "converged": True,
            "iterations": relaxed.iterations,
        }

    attributes = described("packings", config, n=int(start.attributes["n"]), phi=phi)
    failures = start.mapping("failures")
    return block_of(start.variables["seed"], sample, failures, attributes)


def rigidity_block(packings: Block, law: ContactLaw, rattler: Rattlers) -> Block:
    """g, g_A, g_NA of every packing, unloaded and loaded, from one sparse solve each."""
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        force = largest(net_force(packing, find_contacts(packing), interaction))
        row = {"jammed": jammed, "converged": True, "max_force": force[0], "max_torque": force[1]}
        if not jammed:
            return row | dict.fromkeys([*_moduli_names(""), *_moduli_names("_loaded")], 0.0)
        moduli = rigidity(packing, interaction, rattler.largest(law))
        return row | _moduli("", moduli.unloaded) | _moduli("_loaded", moduli.loaded)

    config = {"law": asdict(law), "rattlers": asdict(rattler)}
    return response_block(packings, "rigidity", config, law, sample)


def step_strain_block(packings: Block, law: ContactLaw, step: StepStrain) -> Block:
    """g of every packing from step strains, relaxed by the full non-linear forces."""
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        if not jammed:
            return {"g_simulated": 0.0, "g_simulated_forward": 0.0, "converged": True}
        result = step_strain(packing, interaction, step)
        if not result.converged:
            raise ArithmeticError(
                f"step strain {result.strain}: max|F| = {result.max_force:.1e}, max|2T/d| = "
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

    config = {"law": asdict(law), "step_strain": asdict(step)}
    return response_block(packings, "step_strain", config, law, sample)


def _normal(name: str):
    return Interaction.from_law(ContactLaw(normal=name)).normal


def _moduli_names(suffix: str) -> tuple[str, str, str]:
    return f"g{suffix}", f"g_affine{suffix}", f"g_nonaffine{suffix}"


def _moduli(suffix: str, moduli: Moduli) -> dict[str, float]:
    values = (moduli.g, moduli.g_affine, moduli.g_nonaffine)
    return dict(zip(_moduli_names(suffix), values, strict=True))
