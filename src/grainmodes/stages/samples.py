"""A packing, or a trajectory on its way, as one row of a block and back."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np

from grainmodes.dataset.files import Block, BlockError
from grainmodes.kernels.laws import Frictionless, Interaction
from grainmodes.packing.contacts import Contacts, History, rattlers
from grainmodes.packing.forces import largest, mean_contact_force, net_force, stress
from grainmodes.packing.state import Packing, find_contacts
from grainmodes.parameters.compression import Compression
from grainmodes.protocols.compression.trajectory import Trajectory

BALANCE = 1e-6
"""Largest force on a grain, relative to the mean contact force, of a packing in balance."""

LOAD = 1e3
"""A jammed packing's mean contact force is at least this many times the largest net force."""


def checkpoint(trajectory: Trajectory) -> dict[str, object]:
    """The row of a trajectory that goes on later."""
    return _state(trajectory.packing) | {
        "phi_jamming": trajectory.phi_jamming,
        "iterations": trajectory.iterations,
        "step": trajectory.step,
        "converged": True,
    }


def check_start(block: Block, config: dict, phi: float) -> None:
    """Refuse checkpoints that a compression with parameters `config` to φ cannot start from.

    Raises:
        BlockError: they lie above φ, or were made with other parameters.
    """
    made, asked = _flat(block.mapping("config")), _flat(config)
    differing = [key for key in asked if made.get(key) != asked[key]]
    other = [f"expected {key} = {asked[key]}, got {made.get(key)}" for key in differing]
    if other:
        raise BlockError(f"the checkpoints belong to another compression: {'; '.join(other)}")
    reached = float(block.attributes["phi"])
    if reached > phi + 1e-12:
        raise BlockError(f"the checkpoints: expected a phi of at most {phi}, got {reached}")


def _flat(config: dict) -> dict:
    """The keys of a compression beside those around it."""
    return {**config.get("compression", {}), "normal": config.get("normal")}


def check_same(block: Block, n: int, seeds: range) -> None:
    """Refuse checkpoints of other samples.

    Raises:
        BlockError: the block holds other seeds or another number of grains.
    """
    held = block.variables["seed"].tolist()
    if held != list(seeds) or int(block.attributes["n"]) != n:
        raise BlockError(
            f"the checkpoints: expected {n} grains and seeds {list(seeds)}, "
            f"got {block.attributes['n']} grains and seeds {held}"
        )


def trajectory_of(block: Block, number: int) -> Trajectory:
    """The trajectory in a row of checkpoints.

    Raises:
        ValueError: a stored value is NaN or infinite.
    """
    row = {name: block.variables[name][number] for name in ("step", "phi_jamming", "iterations")}
    if not np.isfinite(row["phi_jamming"]):
        raise ValueError(
            f"phi_jamming of the checkpoint: expected a finite number, got {row['phi_jamming']}"
        )
    return Trajectory(
        packing_of(block, number),
        int(row["step"]),
        float(row["phi_jamming"]),
        int(row["iterations"]),
    )


def packed(packing: Packing, normal) -> dict[str, object]:
    """The row of a packing at rest, without friction."""
    interaction = Interaction(normal, Frictionless())
    contacts = find_contacts(packing)
    force, _ = largest(net_force(packing, contacts, interaction))
    gone = rattlers(contacts, packing.n, threshold=2)
    held = ~(gone[contacts.i] | gone[contacts.j])
    backbone = packing.n - int(gone.sum())
    return _state(packing) | {
        "position": packing.position,
        "contact_i": contacts.i,
        "contact_j": contacts.j,
        "pressure": -float(np.trace(stress(packing, contacts, interaction))) / 2.0,
        "contact_number": 2.0 * held.sum() / backbone if backbone else 0.0,
        "rattler_count": packing.n - backbone,
        "jammed": is_jammed(packing, contacts, interaction, force),
        "max_force": force,
    }


def is_jammed(
    packing: Packing, contacts: Contacts, interaction: Interaction, max_force: float
) -> bool:
    """Whether a rigid backbone carries the load.

    The grains that are no rattlers must have at least the 2N' − 1 contacts of an isostatic packing
    under pressure, and forces far above what the balance left over.
    """
    gone = rattlers(contacts, packing.n, threshold=2)
    held = int(np.count_nonzero(~(gone[contacts.i] | gone[contacts.j])))
    grains = packing.n - int(gone.sum())
    loaded = mean_contact_force(contacts, interaction) > LOAD * max_force
    return grains > 0 and held >= 2 * grains - 1 and loaded


def packing_of(block: Block, number: int) -> Packing:
    """The packing in a row: from the exact fractions, or from positions where there are none."""
    row = {name: array[number] for name, array in block.variables.items()}
    history = _history(row)
    if "fraction" not in row:
        return Packing.from_positions(
            row["position"],
            row["diameter"],
            row["box_length"],
            row.get("strain", 0.0),
            row.get("mass"),
            history,
        )
    return Packing(
        np.ascontiguousarray(row["fraction"].T),
        row["diameter"],
        row["mass"],
        float(row["box_length"]),
        float(row["strain"]),
        history=history,
    ).checked()


def _history(row: dict[str, np.ndarray]) -> History | None:
    """The loaded springs of a row, if it has any."""
    if "spring_state" not in row:
        return None
    held = row["contact_i"] >= 0
    names = ("contact_i", "contact_j", "spring_state")
    return History.of(*(row[name][held] for name in names))


def jammed_packing(block: Block, number: int, interaction: Interaction) -> tuple[Packing, bool]:
    """The packing in a row, and whether it is jammed.

    Raises:
        ArithmeticError: its relaxation had not converged.
        PackingError: a stored value is NaN or infinite; the other samples may be sound.
        BlockError: it is not in force balance, although it should be.
    """
    if not block.variables["converged"][number]:
        raise ArithmeticError("the packing did not reach its force balance")
    packing = packing_of(block, number)
    contacts = find_contacts(packing)
    force, _ = largest(net_force(packing, contacts, interaction))
    mean = mean_contact_force(contacts, interaction)
    limit = max(BALANCE * mean, force_tolerance(block))
    if not force <= limit:
        raise BlockError(
            f"packing of seed {seed_of(block, number)} is not in force balance: expected "
            f"max|F| <= {limit:.1e} at a mean contact force of {mean:.2e}, got {force:.2e}"
        )
    return packing, is_jammed(packing, contacts, interaction, force)


def first_sample(block: Block) -> Block:
    """The block of its first sample alone."""
    seed = str(seed_of(block, 0))
    failures = {key: text for key, text in block.mapping("failures").items() if key == seed}
    rows = {name: array[:1] for name, array in block.variables.items()}
    return Block(rows, block.attributes | {"failures": failures})


def seed_of(block: Block, number: int) -> int:
    """The seed of a row."""
    return int(block.variables["seed"][number])


def force_tolerance(block: Block) -> float:
    """F_Th that the packings of a block were made to; of foreign ones A's 1e-14."""
    return block.mapping("config").get("compression", asdict(Compression()))["force_tolerance"]


def _state(packing: Packing) -> dict[str, object]:
    return {
        "fraction": packing.fraction.T,
        "diameter": packing.diameter,
        "mass": packing.mass,
        "box_length": packing.box_length,
        "strain": packing.strain,
    }
