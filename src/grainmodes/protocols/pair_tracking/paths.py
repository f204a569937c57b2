"""Two modes along a whole shear: C, Figs. 1 to 3.

The invariant subspace of a pair is followed from the state in which it was found to earlier and to
later states, through birth and death, until it is lost or the two modes have been real for some
states. In small packings all scalar products of one mode with the others are recorded as well
(C, Fig. 2).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
import scipy.linalg

from grainmodes.linalg.failures import finite
from grainmodes.packing.mass_weighted import mass_weighted_jacobian
from grainmodes.protocols.pair_tracking.exceptional_points import TwoModeState, follow_modes
from grainmodes.relaxation.equilibrium_state import EquilibriumState

MAX_DEGREES_OF_FREEDOM = 60
"""Degrees of freedom up to which all scalar products are recorded."""


class ScalarProducts(NamedTuple):
    """|Σ u_j u'_j| of a mode with every mode, (3N,), λ_r ascending; with itself it is 1."""

    strain: float
    mode: int
    product: np.ndarray


def follow_along(
    pair: TwoModeState, states: list[EquilibriumState], n_real: int
) -> list[TwoModeState]:
    """The two modes of a pair in the states of a shear, γ ascending.

    On each side the path ends with the state in which they have been real `n_real` times in a row.
    """
    earlier = [state for state in states if state.packing.strain < pair.strain]
    later = [state for state in states if state.packing.strain > pair.strain]
    before, after = (list(_onwards(pair, way, n_real)) for way in (earlier[::-1], later))
    return [*before[::-1], pair, *after]


def _onwards(
    pair: TwoModeState, states: Iterable[EquilibriumState], n_real: int
) -> Iterator[TwoModeState]:
    now, real = pair, 0
    for state in states:
        followed = follow_modes(now, state)
        if followed is None:
            return
        now = followed
        yield now
        real = 0 if now.is_pair else real + 1
        if real == n_real:
            return


def scalar_products_along(
    pair: TwoModeState, states: list[EquilibriumState]
) -> list[ScalarProducts]:
    """C's scalar products of one mode with all others in every state with the same backbone.

    The mode is that of a pair, by its number in the state where the pair was found.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    if pair.subspace.right.shape[0] > MAX_DEGREES_OF_FREEDOM:
        return []
    values, _ = _all_modes(pair.equilibrium)
    mode = int(np.argmin(np.abs(values - pair.subspace.values[0].conj())))
    backbone = pair.equilibrium.backbone_mask
    return [
        _scalar_products(state, mode)
        for state in states
        if np.array_equal(state.backbone_mask, backbone)
    ]


def _scalar_products(state: EquilibriumState, mode: int) -> ScalarProducts:
    _, vectors = _all_modes(state)
    return ScalarProducts(state.packing.strain, mode, np.abs(vectors[:, mode] @ vectors))


def _all_modes(state: EquilibriumState) -> tuple[np.ndarray, np.ndarray]:
    """All eigenvalues of K, (M,), λ_r ascending, with eigenvectors (M, M) of norm 1."""
    matrix = mass_weighted_jacobian(state.matrix, state.backbone.mass)
    values, vectors = scipy.linalg.eig(finite(matrix.toarray()))
    order = np.lexsort((values.imag, values.real))
    return values[order], vectors[:, order]
