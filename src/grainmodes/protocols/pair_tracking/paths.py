"""Two modes along a whole shear: C, Figs. 1 to 3.

The plane of a pair is followed from the state in which it was found to earlier and to later states
of the walk, through birth and death, until it is lost or the two have been real for some states.
For a few grains all scalar products of one mode with the others are told as well (C, Fig. 2).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
import scipy.linalg

from grainmodes.packing.mass_weighted import mass_weighted_jacobian
from grainmodes.protocols.pair_tracking.exceptional_points import Side, followed
from grainmodes.relaxation.equilibrium_state import EquilibriumState

FEW = 60
"""Degrees of freedom up to which all scalar products are told."""


class Products(NamedTuple):
    """Scalar products of a mode with every mode, (3N,), by λ_r; with itself it is 1."""

    strain: float
    mode: int
    product: np.ndarray


def path_of(pair: Side, states: list[EquilibriumState], around: int) -> list[Side]:
    """The plane of a pair in the states of a walk, γ ascending."""
    earlier = [state for state in states if state.packing.strain < pair.strain]
    later = [state for state in states if state.packing.strain > pair.strain]
    before, after = (list(_onwards(pair, way, around)) for way in (earlier[::-1], later))
    return [*before[::-1], pair, *after]


def _onwards(pair: Side, states: Iterable[EquilibriumState], around: int) -> Iterator[Side]:
    now, real = pair, 0
    for state in states:
        now = followed(now, state)
        if now is None:
            return
        yield now
        real = 0 if now.is_pair else real + 1
        if real == around:
            return


def products_along(pair: Side, states: list[EquilibriumState]) -> list[Products]:
    """C's scalar products of one mode with all others in every state with as many grains.

    The mode is that of a pair, by its number in the state where the pair was found.
    """
    if pair.plane.right.shape[0] > FEW:
        return []
    values, _ = _modes(pair.equilibrium)
    mode = int(np.argmin(np.abs(values - pair.plane.values[0].conj())))
    held = pair.equilibrium.backbone_mask
    return [_products(state, mode) for state in states if np.array_equal(state.backbone_mask, held)]


def _products(state: EquilibriumState, mode: int) -> Products:
    _, vectors = _modes(state)
    return Products(state.packing.strain, mode, np.abs(vectors[:, mode] @ vectors))


def _modes(state: EquilibriumState) -> tuple[np.ndarray, np.ndarray]:
    """All eigenvalues of K, λ_r ascending, with eigenvectors of norm 1."""
    matrix = mass_weighted_jacobian(state.matrix, state.backbone.mass)
    values, vectors = scipy.linalg.eig(matrix.toarray())
    order = np.lexsort((values.imag, values.real))
    return values[order], vectors[:, order]
