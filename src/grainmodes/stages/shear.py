"""The stage `shear`: every packing of a block sheared quasistatically, with its events.

A sample takes minutes to hours, so a keeper may be told now and then how far it has come and asked
where to go on. Where it was interrupted leaves no trace in the numbers: a walk is kept only where
its state alone determines what follows (`Walk.restartable`).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, replace
from typing import Protocol

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import is_frictionless
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.event_multipoles import rotational_poles
from grainmodes.protocols.shear.first_event import bracket_ends, brackets
from grainmodes.protocols.shear.run import Walk
from grainmodes.protocols.shear.state import Change, Event, Point, reopened
from grainmodes.relaxation.balance import Balance
from grainmodes.response.stability import asymmetry, complex_pairs
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import jammed_packing, seed_of

MOST_FOR_PAIRS = 1200
"""Degrees of freedom up to which complex pairs are counted, in a second an event."""


class Keeper(Protocol):
    """Where walks are kept between two runs."""

    def kept(self, name: str) -> Walk | None:
        """The walk of this name as far as it came, if one was kept."""

    def watch(self, name: str, walk: Walk) -> None:
        """Called after every step: keep the walk if it is time to, and `restartable`."""


def shear_block(
    packings: Block,
    law: ContactLaw,
    choices: Shear,
    coarse_run: bool = False,
    keeper: Keeper | None = None,
) -> Block:
    """The stress-strain curve of every packing.

    `coarse_run`: once more without brackets, and the first event in brackets of every width.
    """
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        seed = seed_of(packings, number)
        if not jammed:
            return {"curve_count": 0, "jammed": False, "converged": True}
        walk = walked(packing, interaction, choices, keeper, f"seed-{seed}")
        row = row_of(walk) | ({} if walk.done else {"failure": walk.ending})
        if coarse_run:
            coarse = replace(choices, min_step=choices.step)
            row |= _coarse_run(
                walked(packing, interaction, coarse, keeper, f"seed-{seed}-coarse_run")
            )
            row |= bracket_ends(brackets(packing, interaction, choices))
        return row

    config = {"law": asdict(law), "shear": asdict(choices), "coarse_run": coarse_run}
    return response_block(packings, "shear", config, law, sample)


def walked(
    packing: Packing, interaction: Interaction, choices: Shear, keeper: Keeper | None, name: str
) -> Walk:
    """A walk as far as it goes, taken up where its keeper has it."""
    walk = (keeper and keeper.kept(name)) or Walk.start(packing, interaction, choices)
    while not walk.done and walk.advance():
        if keeper:
            keeper.watch(name, walk)
    return walk


def _coarse_run(walk: Walk) -> dict[str, object]:
    """The stress of a walk whose events are not bracketed."""
    return {
        "coarse_strain": [p.strain for p in walk.curve],
        "coarse_stress": [(p.stress[0, 1] + p.stress[1, 0]) / 2.0 for p in walk.curve],
    }


def row_of(walk: Walk) -> dict[str, object]:
    """All that was recorded on the way; not converged where it ended before the last strain."""
    balance = walk.now.balance
    packing, interaction = balance.packing, balance.interaction
    still = {name: getattr(packing, name) for name in ("diameter", "mass", "box_length")}
    return {
        **still,
        **_curve(walk.curve),
        **_events(walk.events, interaction),
        "last_asymmetry": asymmetry(balance.matrix),
        "last_complex_pairs": _pairs(balance),
        **_changes(walk.changes),
        "jammed": True,
        "converged": walk.done,
    }


def _curve(points: list[Point]) -> dict[str, object]:
    stress, modulus = (
        np.array([getattr(p, name) for p in points]) for name in ("stress", "modulus")
    )
    return {
        "curve_count": len(points),
        "curve_strain": [p.strain for p in points],
        "curve_stress_xy": stress[:, 0, 1],
        "curve_stress_yx": stress[:, 1, 0],
        "curve_pressure": -np.trace(stress, axis1=1, axis2=2) / 2.0,
        "curve_g_xy": modulus[:, 0, 1],
        "curve_g_yx": modulus[:, 1, 0],
        "curve_energy": [p.energy for p in points],
        "curve_contact_number": [p.contact_number for p in points],
        "curve_lowest_eigenvalue": [p.lowest for p in points],
    }


def _events(events: list[Event], interaction: Interaction) -> dict[str, object]:
    row: dict[str, object] = {"event_count": len(events)}
    if not events:
        return row
    row |= {
        f"event_{name}": [getattr(e, name) for e in events] for name in ("kind", "opened", "closed")
    }
    row["event_displacement"] = np.stack([_three(e.displacement) for e in events])
    poles = [rotational_poles(e.after, e.displacement) for e in events]
    row["event_quadrupole"], row["event_other_multipoles"] = zip(*poles, strict=True)
    row["event_reopened"] = [reopened(e.before, e.after, interaction) for e in events]
    for number, side in enumerate(("before", "after")):
        balances = [Balance.of(getattr(e, side), interaction) for e in events]
        row |= _side(side, balances, [e.points[number] for e in events])
    row["event_complex_pairs_after"] = [_pairs(balance) for balance in balances]
    return row


def _pairs(balance: Balance) -> float:
    """Complex pairs of eigenvalues of M⁻¹J; a symmetric J has none."""
    if is_frictionless(balance.interaction):
        return 0.0
    few = balance.matrix.shape[0] <= MOST_FOR_PAIRS
    return float(complex_pairs(balance.backbone, balance.interaction)) if few else np.nan


def _side(side: str, balances: list[Balance], points: list[Point]) -> dict[str, object]:
    """What is kept of the states on one side of all events."""
    packings = [balance.packing for balance in balances]
    symmetric = {
        name: [(of[0, 1] + of[1, 0]) / 2.0 for of in tensors]
        for name, tensors in (
            ("stress", [p.stress for p in points]),
            ("g", [p.modulus for p in points]),
        )
    }
    row = symmetric | {
        "strain": [p.strain for p in points],
        "energy": [p.energy for p in points],
        "lowest_eigenvalue": [p.lowest for p in points],
        "asymmetry": [asymmetry(balance.matrix) for balance in balances],
        "fraction": np.stack([packing.fraction.T for packing in packings]),
    }
    if packings[0].rotation is not None:
        histories = [packing.history for packing in packings]
        row |= {
            "rotation": np.stack([packing.rotation for packing in packings]),
            "contact_i": _even((h.i for h in histories), -1),
            "contact_j": _even((h.j for h in histories), -1),
            "spring_state": _even((h.spring_state for h in histories), np.nan),
        }
    return {f"event_{name}_{side}": values for name, values in row.items()}


def _changes(changes: list[Change]) -> dict[str, object]:
    row = {f"change_{name}": [getattr(c, name) for c in changes] for name in Change._fields}
    return {"change_count": len(changes)} | (row if changes else {})


def _three(field: np.ndarray) -> np.ndarray:
    """A field (N, k) with a column for the rotation, NaN where friction does not exist."""
    whole = np.full((len(field), 3), np.nan)
    whole[:, : field.shape[1]] = field
    return whole


def _even(rows: Iterable[np.ndarray], fill: float) -> np.ndarray:
    """Rows of different lengths as one array, the shorter ones filled up."""
    rows = list(rows)
    whole = np.full((len(rows), max(map(len, rows))), fill, rows[0].dtype)
    for place, row in enumerate(rows):
        whole[place, : len(row)] = row
    return whole
