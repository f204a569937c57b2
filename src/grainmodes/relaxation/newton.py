"""Newton's method for force balance: J u = F̃, a handful of sparse solves.

Quadratic near a balance, lost far from one, so every step must lower max|F̃|; where none does, the
iteration stops unconverged and the caller goes back to dynamics. Contacts are found anew at every
iterate. A frictional step carries the tangential springs along (`springs`),

    s → s + t·δr + δℓ     t at the middle of the step: error O(δ³)

with s = 0 for a pair at first touch, so a path through n iterates is a path of n short strains.

The packing must be without rattlers: a lone Hertz contact relaxes only as ξ → ξ/3 a step, and a
grain without contacts makes J singular.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.springs import advance_springs, clip_springs
from grainmodes.linalg.pinned_factor import FloppyError, PinnedFactor
from grainmodes.packing.contacts import Contacts, History
from grainmodes.packing.forces import is_frictionless, largest, net_force
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing, find_contacts
from grainmodes.relaxation.result import Relaxed

SHORTEST_STEP = 0.1
"""Fraction of a Newton step below which it is given up: the balance is not near."""


def newton(
    packing: Packing, interaction: Interaction, tolerance: float, max_iterations: int = 8
) -> Relaxed:
    """Relax a packing without rattlers until max|F̃| < `tolerance`; at least one step is taken."""
    contacts = find_contacts(packing)
    force = net_force(packing, contacts, interaction)
    for iteration in range(1, max_iterations + 1):
        trial = _step(packing, contacts, interaction, force)
        if trial is None:
            return _result(packing, force, tolerance, iteration)
        packing, contacts, force = trial
        if max(largest(force)) < tolerance:
            break
    return _result(packing, force, tolerance, iteration)


def _result(packing: Packing, force: np.ndarray, tolerance: float, iterations: int) -> Relaxed:
    max_force, max_torque = largest(force)
    converged = max(max_force, max_torque) < tolerance
    return Relaxed(packing, converged, iterations, max_force, max_torque)


def _step(packing, contacts, interaction, force):
    """The Newton step, shortened until max|F̃| falls; None if it never does."""
    matrix = jacobian(packing, contacts, interaction)
    try:
        u = PinnedFactor(matrix, contacts.spring_state is None).solve(force)
    except FloppyError:
        return None
    u = u.reshape(packing.n, -1)
    goal, length = max(largest(force)), 1.0
    while length >= SHORTEST_STEP:
        moved = moved_by(packing, contacts, interaction, length * u)
        moved, touching = slipped(moved, interaction)
        left = net_force(moved, touching, interaction)
        if max(largest(left)) < goal or goal == 0.0:
            return moved, touching, left
        length *= 0.5
    return None


def moved_by(
    packing: Packing, contacts: Contacts, interaction: Interaction, u: np.ndarray
) -> Packing:
    """The packing after a small motion u (N, k), its tangential springs carried along."""
    moved = packing.displaced(u[:, :2])
    if is_frictionless(interaction):
        return moved
    rotation = np.zeros(packing.n) if packing.rotation is None else packing.rotation
    c = contacts
    s = advance_springs(interaction, c.normal, c.distance, c.overlap, c.displacement, c.i, c.j, u)
    return replace(moved, rotation=rotation + u[:, 2], history=History(contacts.i, contacts.j, s))


def slipped(packing: Packing, interaction: Interaction) -> tuple[Packing, Contacts]:
    """The packing and its contacts, each spring no longer than its law lets it be."""
    contacts = find_contacts(packing)
    if packing.history is None:
        return packing, contacts
    s = clip_springs(interaction, contacts.overlap, contacts.displacement)
    history = History(contacts.i, contacts.j, s)
    return replace(packing, history=history), replace(contacts, spring_state=s)
