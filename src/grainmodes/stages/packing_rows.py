"""A packing as one row of a block, and back."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Frictionless, Interaction, NormalLaw
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import max_force_and_torque, mean_contact_force, net_force, stress
from grainmodes.packing.state import Packing, backbone

MIN_LOAD_RATIO = 1e3
"""Least mean contact force of a jammed packing, relative to the largest net force on a grain."""


def packing_row(packing: Packing, normal: NormalLaw) -> dict[str, object]:
    """The row of a packing at rest, without friction."""
    interaction = Interaction(normal, Frictionless())
    contacts, rigid = packing.contacts, backbone(packing, threshold=2)
    force, _ = max_force_and_torque(net_force(packing, interaction))
    return grain_columns(packing) | {
        "position": packing.position,
        "contact_i": contacts.i,
        "contact_j": contacts.j,
        "pressure": -float(np.trace(stress(packing, interaction))) / 2.0,
        "contact_number": 2.0 * len(rigid.contacts.i) / rigid.n if rigid.n else 0.0,
        "rattler_count": packing.n - rigid.n,
        "jammed": is_jammed(packing, interaction, force),
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


def is_jammed(packing: Packing, interaction: Interaction, max_force: float) -> bool:
    """Whether a rigid backbone carries the load.

    The N' grains that are not rattlers must have at least the 2N' − 1 contacts of an isostatic
    packing under pressure, and contact forces far above `max_force`, the largest net force that
    the relaxation left on a grain.
    """
    rigid = backbone(packing, threshold=2)
    loaded = mean_contact_force(packing, interaction) > MIN_LOAD_RATIO * max_force
    return rigid.n > 0 and len(rigid.contacts.i) >= 2 * rigid.n - 1 and loaded


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
    return History.from_pairs(*(row[f"{prefix}{name}"][present] for name in names))
