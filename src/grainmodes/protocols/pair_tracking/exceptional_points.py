"""Where two eigenvalues meet: the exceptional point γ_c of a birth or a death, C, Sec. III C, V B.

D = (λ1 − λ2)² is analytic in γ and has a simple zero at γ_c (C 19, 20), so that

    D = α (γ − γ_c) + β (γ − γ_c)²,   |λ1 − λ2| = |D|^(1/2) ∝ |γ − γ_c|^(1/2)               C (21)

The step in which a pair was born or died is halved, each middle reached from the last state below
it, until γ_c stands in a bracket no wider than asked. Whether the pair exists in the middle is read
from its invariant subspace (`complex_pairs.inverse_iteration`), followed from the nearest state in
which it is a pair. The bracket tells what happened:

| kind             | at the end of the halving                                            |
| ---------------- | -------------------------------------------------------------------- |
| `COALESCENCE`    | the same contacts on both sides, D changes its sign                  |
| `CONTACT_CHANGE` | contacts open or close, and with them the pair comes or goes         |
| `JUMP`           | the balance did not move on continuously                             |
| `LOST`           | none of these: the pair exchanges its plane with a third mode        |

States at δ = 1e-8 … 1e-5 on both sides of γ_c, on its contacts, give the exponent: the slope of
log|λ1 − λ2| against log δ, with the standard error of the fit (`fitted`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from grainmodes.complex_pairs.inverse_iteration import SETTLED, Plane, plane_near
from grainmodes.packing.mass_weighted import mass_weighted_jacobian
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.events import count_network_changes
from grainmodes.protocols.shear.strain_step import step_to
from grainmodes.relaxation.equilibrium_state import EquilibriumState

NEVER, COALESCENCE, CONTACT_CHANGE, JUMP, LOST, UNDECIDED = range(6)
"""What a birth or a death is; `NEVER`: still alive; `UNDECIDED`: contacts changed in its step."""

DISTANCES = np.logspace(-8, -5, 10)
"""δ of the states around γ_c: the lower end is 10 times the bracket, the upper one still linear."""

TURNED = 0.7
"""Part of a plane in the one it was followed from below which it counts as lost."""


class Side(NamedTuple):
    """A state next to γ_c and the plane of the two modes in it."""

    equilibrium: EquilibriumState
    plane: Plane

    @property
    def strain(self) -> float:
        """γ."""
        return self.equilibrium.packing.strain

    @property
    def is_pair(self) -> bool:
        """Whether the two eigenvalues are a complex pair here."""
        return self.plane.is_pair


class Near(NamedTuple):
    """The two modes at γ_c + `distance`."""

    distance: float
    plane: Plane


class Exponent(NamedTuple):
    """Slope of log|λ1 − λ2| against log|γ − γ_c|, its standard error, the number of states."""

    value: float
    error: float
    count: int


class ExceptionalPoint(NamedTuple):
    """A birth or death between two strains; `near` is empty unless it is a coalescence."""

    kind: int
    below: float
    above: float
    strain: float
    near: tuple[Near, ...] = ()

    def exponent(self, real: bool) -> Exponent:
        """The exponent on the side where the two modes are real, or a pair."""
        at = sorted(
            (abs(near.distance), abs(near.plane.discriminant))
            for near in self.near
            if (near.plane.discriminant > 0.0) == real
        )
        return fitted(*np.array(at).reshape(-1, 2).T)


def located(
    pair: Side, other: EquilibriumState, choices: Shear, bracket: float
) -> ExceptionalPoint:
    """The exceptional point between a state in which the pair is there and one in which it is not.

    Raises:
        ArithmeticError: no balance was found between the two.
    """
    born, jumped = other.packing.strain < pair.strain, False
    while abs(pair.strain - other.packing.strain) > bracket:
        low = other if born else pair.equilibrium
        middle, by_dynamics = step_to(0.5 * (pair.strain + other.packing.strain), low, choices)
        side = followed(pair, middle)
        if side is not None and side.is_pair:
            pair, jumped = side, by_dynamics if born else jumped
        else:
            other, jumped = middle, jumped if born else by_dynamics
    return _judged(pair, other, jumped, choices)


def followed(start: Side, equilibrium: EquilibriumState) -> Side | None:
    """The plane of a state in a later or earlier one; None where it is lost."""
    if not np.array_equal(start.equilibrium.backbone_mask, equilibrium.backbone_mask):
        return None
    try:
        plane = plane_near(
            mass_weighted_jacobian(equilibrium.matrix, equilibrium.backbone.mass), start.plane
        )
    except ArithmeticError:
        return None
    same = plane.residual <= SETTLED and plane.part_of(start.plane) > TURNED
    return Side(equilibrium, plane) if same else None


def _judged(pair: Side, other: EquilibriumState, jumped: bool, choices: Shear) -> ExceptionalPoint:
    """What happened between the two ends of a bracket, the upper one reached by a jump or not."""
    ends = sorted((pair.strain, other.packing.strain))
    if jumped:
        return ExceptionalPoint(JUMP, *ends, np.mean(ends))
    if any(count_network_changes(pair.equilibrium, other)):
        return ExceptionalPoint(CONTACT_CHANGE, *ends, np.mean(ends))
    real = followed(pair, other)
    if real is None or real.is_pair:
        return ExceptionalPoint(LOST, *ends, np.mean(ends))
    part = pair.plane.discriminant / (pair.plane.discriminant - real.plane.discriminant)
    strain = pair.strain + part * (real.strain - pair.strain)
    below, above = sorted((pair, real), key=lambda side: side.strain)
    near = [*_branch(below, strain, -DISTANCES, choices)][::-1]
    near += _branch(above, strain, DISTANCES, choices)
    return ExceptionalPoint(COALESCENCE, *ends, strain, tuple(near))


def _branch(end: Side, origin: float, distances: np.ndarray, choices: Shear) -> Iterator[Near]:
    """The two modes on one side of γ_c outwards, on its contacts, as far as they are found."""
    now = end
    for distance in distances.tolist():
        try:
            equilibrium, jumped = step_to(origin + distance, now.equilibrium, choices)
        except ArithmeticError:
            return
        side = followed(now, equilibrium)
        if side is None or jumped or any(count_network_changes(end.equilibrium, equilibrium)):
            return
        if side.is_pair != end.is_pair:
            return
        now = side
        yield Near(distance, side.plane)


BENT = 0.1
"""Largest bδ of a state in the fit of an exponent."""

FEWEST = 5
"""States on one side that a fit needs: two more than it has unknowns."""


def fitted(distance: np.ndarray, discriminant: np.ndarray) -> Exponent:
    """The exponent ν in log|D|/2 = ν log δ + c + bδ by least squares, δ ascending.

    The term bδ takes up the curvature of D, b = β/2α. States at which it is larger than `BENT` are
    left out: another singularity, such as a contact about to open, is near. NaN below `FEWEST`.
    """
    for count in range(len(distance), FEWEST - 1, -1):
        near = distance[:count] / distance[count - 1]
        terms = np.stack([np.log(near), np.ones(count), near], axis=1)
        measured = 0.5 * np.log(discriminant[:count])
        found, *_ = np.linalg.lstsq(terms, measured)
        if abs(found[2]) <= BENT:
            left = measured - terms @ found
            variance = left @ left / (count - 3) * np.linalg.inv(terms.T @ terms)[0, 0]
            return Exponent(float(found[0]), float(np.sqrt(variance)), count)
    return Exponent(np.nan, np.nan, 0)
