"""A packing as one row of a block, and back."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Frictionless, Interaction, NormalLaw
from grainmodes.packing.contacts import Contacts, History, rattlers
from grainmodes.packing.forces import largest, mean_contact_force, net_force, stress
from grainmodes.packing.state import Packing, find_contacts

MIN_LOAD_RATIO = 1e3
"""Least mean contact force of a jammed packing, relative to the largest net force on a grain."""


def packing_row(packing: Packing, normal: NormalLaw) -> dict[str, object]:
    """The row of a packing at rest, without friction."""
    interaction = Interaction(normal, Frictionless())
    contacts = find_contacts(packing)
    force, _ = largest(net_force(packing, contacts, interaction))
    is_rattler = rattlers(contacts, packing.n, threshold=2)
    load_bearing = ~(is_rattler[contacts.i] | is_rattler[contacts.j])
    grains = packing.n - int(is_rattler.sum())
    return grain_columns(packing) | {
        "position": packing.position,
        "contact_i": contacts.i,
        "contact_j": contacts.j,
        "pressure": -float(np.trace(stress(packing, contacts, interaction))) / 2.0,
        "contact_number": 2.0 * load_bearing.sum() / grains if grains else 0.0,
        "rattler_count": packing.n - grains,
        "jammed": is_jammed(packing, contacts, interaction, force),
        "max_force": force,
    }


def grain_columns(packing: Packing) -> dict[str, object]:
    """What defines a packing without springs: its exact fractions, its grains and its box."""
    return {
        "fraction": packing.fraction.T,
        "diameter": packing.diameter,
        "mass": packing.mass,
        "box_length": packing.box_length,
        "strain": packing.strain,
    }


def is_jammed(
    packing: Packing, contacts: Contacts, interaction: Interaction, max_force: float
) -> bool:
    """Whether a rigid backbone carries the load.

    The N' grains that are not rattlers must have at least the 2N' − 1 contacts of an isostatic
    packing under pressure, and contact forces far above `max_force`, the largest net force that
    the relaxation left on a grain.
    """
    is_rattler = rattlers(contacts, packing.n, threshold=2)
    load_bearing = int(np.count_nonzero(~(is_rattler[contacts.i] | is_rattler[contacts.j])))
    grains = packing.n - int(is_rattler.sum())
    loaded = mean_contact_force(contacts, interaction) > MIN_LOAD_RATIO * max_force
    return grains > 0 and load_bearing >= 2 * grains - 1 and loaded


def packing_in_row(block: Block, number: int) -> Packing:
    """The packing in a row: from the exact fractions, or from positions where there are none.

    Raises:
        PackingError: a stored value is NaN or infinite.
    """
    row = {name: array[number] for name, array in block.variables.items()}
    history = history_in_row(row) if "spring_state" in row else None
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


def history_in_row(row: Mapping[str, np.ndarray], prefix: str = "") -> History:
    """The springs in a row, whose columns are filled up with contacts of negative numbers."""
    present = row[f"{prefix}contact_i"] >= 0
    names = ("contact_i", "contact_j", "spring_state")
    return History.of(*(row[f"{prefix}{name}"][present] for name in names))
