"""How far a growing pair carries a state before contacts change, and which state to release: C, VI.

    Δq(t) = Re(a u e^(−iω_r t)),   |n·(Δr_i − Δr_j)| ≤ |a| |n·(u_i − u_j)|, reached once a turn
    M = |a|² ⟨|u_i|²⟩ / 2,   of (x, y) alone, mean over all grains and over a turn          C (30)

To first order a contact opens where its largest excursion is its overlap, and a near miss closes
where it is its gap. M at the first of all these is the room of the pair of modes. Counted are, as
along the shear, contacts between grains that carry load: a loose grain is put down a hair's breadth
from its neighbours, takes next to no force from them and gives none.

Released is the fastest pair whose linear growth changes no contact in the range of M in which the
growth is fitted.

| symbol         | name      | shape                               |
| -------------- | --------- | ----------------------------------- |
| u              | motions   | (N, 3, P) complex, of q, any norm   |
| n_ij           | normal    | (C, 2), contacts and near misses    |
| overlap or gap | margin    | (C,), d                             |
| |n·(u_i − u_j)| | excursion | (C, P)                              |
| M then         | rooms     | (P,), d²                            |
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from grainmodes.parameters.release import GROWTH_RANGE
from grainmodes.protocols.pair_tracking.detection import Seen
from grainmodes.relaxation.equilibrium_state import EquilibriumState

FARTHEST = 0.1
"""Largest gap of a near miss, in d. The two at a wider one never meet below M = 1e-11 d² in less
than 1e8 grains, were they all that moves; and contacts overlap by less."""


class Chosen(NamedTuple):
    """A state to release: ω_i of its pair, where that stands among the others, and its room."""

    growth: float
    state: Seen
    place: int
    room: float


def fastest_with_room(state: Seen, slower: float) -> Chosen | None:
    """The fastest pair of a state that grows faster than `slower` and has room; None without."""
    growth = state.pairs.growth
    faster = np.flatnonzero(growth > slower)
    if not len(faster):
        return None
    room = rooms(state.equilibrium, state.motions(faster))
    roomy = room > GROWTH_RANGE[1]
    if not roomy.any():
        return None
    best = int(np.argmax(np.where(roomy, growth[faster], 0.0)))
    place = int(faster[best])
    return Chosen(float(growth[place]), state, place, float(room[best]))


def rooms(equilibrium: EquilibriumState, motions: np.ndarray) -> np.ndarray:
    """M of the first change of contacts along every mode, (P,)."""
    packing, held = equilibrium.packing, equilibrium.backbone_mask
    larger = replace(packing, diameter=packing.diameter + FARTHEST, history=None)
    near = larger.contacts
    loaded = held[near.i] & held[near.j]
    margin = np.abs(near.overlap - FARTHEST)[loaded]
    plane = motions[:, :2]
    apart = plane[near.i[loaded]] - plane[near.j[loaded]]
    excursion = np.abs(np.einsum("ca,cap->cp", near.normal[loaded], apart))
    size = 1.0 / (excursion / margin[:, None]).max(axis=0)
    return size**2 * (np.abs(plane) ** 2).sum(axis=1).mean(axis=0) / 2.0
