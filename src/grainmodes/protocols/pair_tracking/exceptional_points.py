"""Exceptional points γ_c, where two eigenvalues meet: C, Sec. III C, V B.

At an exceptional point a complex pair is born or dies. D = (λ1 − λ2)² is analytic in γ and has a
simple zero at γ_c (C 19, 20), so that

    D = α (γ − γ_c) + β (γ − γ_c)²,   |λ1 − λ2| = |D|^(1/2) ∝ |γ − γ_c|^(1/2)               C (21)

The step in which a pair was born or died is halved until γ_c lies in a bracket no wider than
requested; each middle is reached from the last state below it. Whether the pair exists in the
middle is read from its invariant subspace (`complex_pairs.inverse_iteration`), followed from the
nearest state in which it is a pair. The bracket tells what happened:

| kind             | at the end of the halving                                            |
| ---------------- | -------------------------------------------------------------------- |
| `COALESCENCE`    | the same contacts on both sides, D changes its sign                  |
| `CONTACT_CHANGE` | contacts open or close, and with them the pair comes or goes         |
| `JUMP`           | the equilibrium did not move on continuously                         |
| `LOST`           | none of these: the subspace mixes with a third mode                  |
| `FAILED`         | a state in the bracket has no equilibrium, or a method did not       |
|                  | converge                                                             |

States at δ = 1e-8 … 1e-5 on both sides of γ_c, on its contacts, give the exponent: the slope of
log|λ1 − λ2| against log δ, with the standard error of the fit (`fit_exponent`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from grainmodes.complex_pairs.inverse_iteration import (
    INVARIANCE_TOLERANCE,
    InvariantSubspace,
    nearest_subspace,
)
from grainmodes.linalg.failures import NUMERICAL_ERRORS
from grainmodes.packing.mass_weighted import mass_weighted_jacobian
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.events import count_network_changes
from grainmodes.protocols.shear.strain_step import step_to
from grainmodes.relaxation.equilibrium_state import EquilibriumState

NEVER, COALESCENCE, CONTACT_CHANGE, JUMP, LOST, UNDECIDED, FAILED = range(7)
"""Kinds of births and deaths. `NEVER`: the pair still exists. `UNDECIDED`: contacts changed in the
step, and it was not located."""

DISTANCES = np.logspace(-8, -5, 10)
"""δ of the states around γ_c: the lower end is 10 times the bracket, the upper one still linear."""

MIN_FOLLOWED_OVERLAP = 0.7
"""Projector overlap of a subspace with the one it was followed from, below which it is lost."""


class TwoModeState(NamedTuple):
    """A state in equilibrium and the subspace of two of its modes."""

    equilibrium: EquilibriumState
    subspace: InvariantSubspace

    @property
    def strain(self) -> float:
        """γ."""
        return self.equilibrium.packing.strain

    @property
    def is_pair(self) -> bool:
        """Whether the two eigenvalues are a complex pair here."""
        return self.subspace.is_pair


class NeighbourState(NamedTuple):
    """The subspace of the two modes at γ_c + `distance`."""

    distance: float
    subspace: InvariantSubspace


class Exponent(NamedTuple):
    """Slope of log|λ1 − λ2| against log|γ − γ_c|, its standard error, the number of states."""

    value: float
    error: float
    n_states: int


class ExceptionalPoint(NamedTuple):
    """A birth or death between the strains `below` and `above`.

    `neighbours` is empty unless it is a coalescence.
    """

    kind: int
    below: float
    above: float
    strain: float
    neighbours: tuple[NeighbourState, ...] = ()

    @classmethod
    def between(cls, kind: int, one: float, other: float) -> ExceptionalPoint:
        """One that is known only to lie between two strains, in any order."""
        return cls(kind, min(one, other), max(one, other), float(np.mean([one, other])))

    def exponent(self, real: bool) -> Exponent:
        """The exponent on the side where the two modes are real, or where they are a pair."""
        side = sorted(
            (abs(state.distance), abs(state.subspace.discriminant))
            for state in self.neighbours
            if (state.subspace.discriminant > 0.0) == real
        )
        return fit_exponent(*np.array(side).reshape(-1, 2).T)


def locate_exceptional_point(
    pair: TwoModeState, other: EquilibriumState, choices: Shear, bracket: float
) -> ExceptionalPoint:
    """The exceptional point between a state with the pair and one without it.

    Raises:
        ArithmeticError: no equilibrium was found between the two.
    """
    born, jumped = other.packing.strain < pair.strain, False
    while abs(pair.strain - other.packing.strain) > bracket:
        low = other if born else pair.equilibrium
        middle, by_dynamics = step_to(0.5 * (pair.strain + other.packing.strain), low, choices)
        followed = follow_modes(pair, middle)
        if followed is not None and followed.is_pair:
            pair, jumped = followed, by_dynamics if born else jumped
        else:
            other, jumped = middle, jumped if born else by_dynamics
    return _classify(pair, other, jumped, choices)


def follow_modes(start: TwoModeState, equilibrium: EquilibriumState) -> TwoModeState | None:
    """The two modes of one state in a later or earlier one; None where they are lost."""
    if not np.array_equal(start.equilibrium.backbone_mask, equilibrium.backbone_mask):
        return None
    matrix = mass_weighted_jacobian(equilibrium.matrix, equilibrium.backbone.mass)
    try:
        subspace = nearest_subspace(matrix, start.subspace)
    except NUMERICAL_ERRORS:
        return None
    invariant = subspace.residual <= INVARIANCE_TOLERANCE
    same = invariant and subspace.overlap_with(start.subspace) > MIN_FOLLOWED_OVERLAP
    return TwoModeState(equilibrium, subspace) if same else None


def _classify(
    pair: TwoModeState, other: EquilibriumState, jumped: bool, choices: Shear
) -> ExceptionalPoint:
    """What happened in a bracket; `jumped`: the dynamics had to find its upper end."""
    low, high = sorted((pair.strain, other.packing.strain))
    if jumped:
        return ExceptionalPoint.between(JUMP, low, high)
    if any(count_network_changes(pair.equilibrium, other)):
        return ExceptionalPoint.between(CONTACT_CHANGE, low, high)
    real = follow_modes(pair, other)
    if real is None or real.is_pair:
        return ExceptionalPoint.between(LOST, low, high)
    part = pair.subspace.discriminant / (pair.subspace.discriminant - real.subspace.discriminant)
    strain = pair.strain + part * (real.strain - pair.strain)
    below, above = sorted((pair, real), key=lambda state: state.strain)
    neighbours = [*_branch(below, strain, -DISTANCES, choices)][::-1]
    neighbours += _branch(above, strain, DISTANCES, choices)
    return ExceptionalPoint(COALESCENCE, low, high, strain, tuple(neighbours))


def _branch(
    end: TwoModeState, origin: float, distances: np.ndarray, choices: Shear
) -> Iterator[NeighbourState]:
    """The two modes on one side of γ_c outwards, on its contacts, as far as they are found."""
    now = end
    for distance in distances.tolist():
        try:
            equilibrium, jumped = step_to(origin + distance, now.equilibrium, choices)
        except NUMERICAL_ERRORS:
            return
        followed = follow_modes(now, equilibrium)
        if followed is None or jumped:
            return
        if any(count_network_changes(end.equilibrium, equilibrium)):
            return
        if followed.is_pair != end.is_pair:
            return
        now = followed
        yield NeighbourState(distance, followed.subspace)


MAX_CURVATURE_TERM = 0.1
"""Largest bδ of a state in the fit of an exponent."""

MIN_STATES = 5
"""States on one side that a fit needs: two more than it has unknowns."""


def fit_exponent(distance: np.ndarray, discriminant: np.ndarray) -> Exponent:
    """The exponent ν in log|D|/2 = ν log δ + c + bδ by least squares.

    The term bδ represents the curvature of D, b = β/2α. States at which it is larger than
    `MAX_CURVATURE_TERM` are left out: there another singularity is near, such as a contact about to
    open.

    Args:
        distance: δ, (K,), ascending.
        discriminant: |D|, (K,).

    Returns:
        NaN with fewer than `MIN_STATES` states.
    """
    for count in range(len(distance), MIN_STATES - 1, -1):
        scaled = distance[:count] / distance[count - 1]
        terms = np.stack([np.log(scaled), np.ones(count), scaled], axis=1)
        measured = 0.5 * np.log(discriminant[:count])
        found, *_ = np.linalg.lstsq(terms, measured)
        if abs(found[2]) <= MAX_CURVATURE_TERM:
            left = measured - terms @ found
            variance = left @ left / (count - 3) * np.linalg.inv(terms.T @ terms)[0, 0]
            return Exponent(float(found[0]), float(np.sqrt(variance)), count)
    return Exponent(np.nan, np.nan, 0)
