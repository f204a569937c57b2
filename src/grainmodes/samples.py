"""A packing, or a trajectory on its way, as one row of a block and back."""

from __future__ import annotations

import numpy as np

from grainmodes.dataset import Block, BlockError
from grainmodes.forces import largest, mean_contact_force, net_force, stress
from grainmodes.kernels.laws import Frictionless, Interaction
from grainmodes.packing import Contacts, History, Packing, find_contacts, rattlers
from grainmodes.parameters import Compression
from grainmodes.protocols.compression import Trajectory

BALANCE = 1e-6
"""Largest force on a grain, relative to the mean contact force, of a packing in balance."""

LOAD = 1e3
"""A jammed packing's mean contact force is at least this many times the largest net force."""


FORCE_FLOOR = 1e-10
"""Mean contact force below which a packing counts as unloaded, balanced or not."""


def checkpoint(trajectory: Trajectory) -> dict[str, object]:
    """The row of a trajectory that goes on later."""
    return _state(trajectory.packing) | {
        "phi_jamming": trajectory.phi_jamming,
        "iterations": trajectory.iterations,
        "step": trajectory.step,
        "converged": True,
    }


def trajectory_of(block: Block, number: int, protocol: Compression) -> Trajectory:
    """The trajectory in a row of checkpoints.

    Raises:
        BlockError: the checkpoints were made with another Φ or initial φ.
    """
    packing = packing_of(block, number)
    row = {name: block.variables[name][number] for name in ("step", "phi_jamming", "iterations")}
    phi = protocol.initial_phi + int(row["step"]) * protocol.phi_step
    if abs(packing.phi - phi) > 1e-9:
        raise BlockError(
            f"checkpoint at phi = {packing.phi:.6f}, but {int(row['step'])} steps of "
            f"{protocol.phi_step} from {protocol.initial_phi} end at {phi:.6f}: "
            "it belongs to another compression"
        )
    return Trajectory(packing, int(row["step"]), float(row["phi_jamming"]), int(row["iterations"]))


def packed(packing: Packing, normal) -> dict[str, object]:
    """The row of a packing at rest, without friction."""
    rule = Interaction(normal, Frictionless())
    contacts = find_contacts(packing)
    force, _ = largest(net_force(packing, contacts, rule))
    gone = rattlers(contacts, packing.n, threshold=2)
    held = ~(gone[contacts.i] | gone[contacts.j])
    backbone = packing.n - int(gone.sum())
    return _state(packing) | {
        "position": packing.position,
        "contact_i": contacts.i,
        "contact_j": contacts.j,
        "pressure": -float(np.trace(stress(packing, contacts, rule))) / 2.0,
        "contact_number": 2.0 * held.sum() / backbone if backbone else 0.0,
        "rattler_count": packing.n - backbone,
        "jammed": is_jammed(packing, contacts, rule, force),
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
    )


def _history(row: dict[str, np.ndarray]) -> History | None:
    """The loaded springs of a row, if it has any."""
    if "tangential_displacement" not in row:
        return None
    held = row["contact_i"] >= 0
    i, j, s = (row[name][held] for name in ("contact_i", "contact_j", "tangential_displacement"))
    order = np.lexsort((j, i))
    return History(i[order], j[order], s[order])


def jammed_packing(block: Block, number: int, interaction: Interaction) -> tuple[Packing, bool]:
    """The packing in a row, and whether it is jammed.

    Raises:
        ArithmeticError: its relaxation had not converged.
        BlockError: it is not in force balance, although it should be.
    """
    if not block.variables["converged"][number]:
        raise ArithmeticError("the packing did not reach its force balance")
    packing = packing_of(block, number)
    contacts = find_contacts(packing)
    force, _ = largest(net_force(packing, contacts, interaction))
    mean = mean_contact_force(contacts, interaction)
    jammed = is_jammed(packing, contacts, interaction, force)
    if mean > FORCE_FLOOR and force > BALANCE * mean:
        raise BlockError(
            f"packing of seed {int(block.variables['seed'][number])} is not in force balance: "
            f"max|F| = {force:.2e}, allowed is {BALANCE:.0e} of the mean contact force {mean:.2e}"
        )
    return packing, jammed


def _state(packing: Packing) -> dict[str, object]:
    return {
        "fraction": packing.fraction.T,
        "diameter": packing.diameter,
        "mass": packing.mass,
        "box_length": packing.box_length,
        "strain": packing.strain,
    }
