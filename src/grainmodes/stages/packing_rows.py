"""A packing as one row of a block, and back."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Frictionless, Interaction, NormalLaw, TangentialLaw
from grainmodes.packing.contact_count import may_be_rigid, most_contacts_of_rattler
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import (
    is_frictionless,
    max_force_and_torque,
    mean_contact_force,
    net_force,
    stress,
)
from grainmodes.packing.state import Packing, backbone

FRICTIONLESS = Frictionless()

MIN_LOAD_RATIO = 1e3
"""Least mean contact force of a jammed packing, relative to the largest net force on a grain."""


def packing_row(
    packing: Packing, normal: NormalLaw, tangential: TangentialLaw = FRICTIONLESS
) -> dict[str, object]:
    """The row of a packing at rest, compressed under these laws."""
    interaction = Interaction(normal, tangential)
    rigid = backbone(packing, most_contacts_of_rattler(packing))
    force, torque = max_force_and_torque(net_force(packing, interaction))
    return grain_columns(packing) | {
        "position": packing.position,
        "contact_i": packing.contacts.i,
        "contact_j": packing.contacts.j,
        "pressure": -float(np.trace(stress(packing, interaction))) / 2.0,
        "contact_number": 2.0 * len(rigid.contacts.i) / rigid.n if rigid.n else 0.0,
        "rattler_count": packing.n - rigid.n,
        "jammed": is_jammed(packing, interaction, max(force, torque)),
        "max_force": force,
        "max_torque": torque,
        "compressed_with_friction": not is_frictionless(interaction),
    }


def grain_columns(packing: Packing) -> dict[str, object]:
    """What defines a packing: its exact fractions, its grains, its box, and its loaded springs."""
    return {
        "fraction": packing.fraction.T,
        "diameter": packing.diameter,
        "mass": packing.mass,
        "box_length": packing.box_length,
        "strain": packing.strain,
        **_springs(packing),
    }


def _springs(packing: Packing) -> dict[str, object]:
    """The springs of the contacts; nothing where friction was never loaded."""
    if packing.history is None:
        return {}
    contacts = packing.contacts
    return {
        "contact_i": contacts.i,
        "contact_j": contacts.j,
        "spring_state": contacts.springs,
    }


def is_jammed(packing: Packing, interaction: Interaction, max_force: float) -> bool:
    """Whether a rigid backbone carries the load.

    Its contact forces must lie far above `max_force`, the largest net force that the relaxation
    left on a grain.
    """
    loaded = mean_contact_force(packing, interaction) > MIN_LOAD_RATIO * max_force
    return loaded and may_be_rigid(packing)


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
