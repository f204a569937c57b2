"""How far a pair may grow before contacts change: against brute force, and against a release."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from grainmodes.packing.state import nonaffine_motion
from grainmodes.parameters.release import Release
from grainmodes.protocols.pair_tracking.linear_range import linear_ranges
from grainmodes.protocols.release.outcome import release_outcome
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from released import narrowed, released, sheared_equilibrium, state

TURN = np.exp(-2j * np.pi * np.arange(60) / 60)
"""Phases of a turn."""


def motions(equilibrium: EquilibriumState) -> np.ndarray:
    """The unstable mode of the state, and some at random."""
    draws = np.random.default_rng(5).standard_normal((3, 2, equilibrium.packing.n, 3))
    return np.stack([state()[0].mode, *(draws[:, 0] + 1j * draws[:, 1])], axis=2)


def keys(packing) -> set[tuple[int, int]]:
    contacts = packing.contacts
    return set(zip(contacts.i.tolist(), contacts.j.tolist(), strict=True))


def first_changing(packing, mode: np.ndarray, sizes: np.ndarray) -> tuple[float, float]:
    """The two neighbours among the sizes of the circle between which the contacts first change."""
    before = keys(packing)
    for low, high in pairwise(sizes):
        size = high / np.abs(mode).max()
        if any(keys(packing.displaced((size * mode * p).real[:, :2])) != before for p in TURN):
            return low, high
    raise AssertionError("no contact changed")


def first_change(packing, mode: np.ndarray) -> tuple[float, bool]:
    """M of the first change, the mode turned through growing circles; whether a contact opened."""
    low, high = first_changing(packing, mode, np.geomspace(1e-8, 1.0, 100))
    before = keys(packing)
    for size in np.geomspace(low, high, 30) / np.abs(mode).max():
        turned = [packing.displaced((size * mode * phase).real[:, :2]) for phase in TURN]
        if any(keys(one) != before for one in turned):
            moved = [nonaffine_motion(packing, one)[:, :2] for one in turned]
            square = np.mean([(motion**2).sum(axis=1).mean() for motion in moved])
            return float(square), any(before - keys(one) for one in turned)
    raise AssertionError("no contact changed")


@pytest.mark.parametrize("opens", [True, False])
def test_the_linear_range_is_where_contacts_change_first(opens):
    equilibrium = sheared_equilibrium() if opens else nearly_closed(sheared_equilibrium())
    modes = motions(equilibrium)
    found = [first_change(equilibrium.packing, mode) for mode in np.moveaxis(modes, 2, 0)]
    np.testing.assert_allclose(
        linear_ranges(equilibrium, modes), [square for square, _ in found], rtol=0.03
    )
    assert {opened for _, opened in found} == {opens}


def nearly_closed(equilibrium: EquilibriumState) -> EquilibriumState:
    """The narrowest gap left with 1e-6 d by a grain that is made larger."""
    i, j = np.tril_indices(equilibrium.packing.n, -1)
    away = equilibrium.packing.position[i] - equilibrium.packing.position[j]
    box = equilibrium.packing.box_length
    up = np.rint(away[:, 1] / box)
    away -= box * np.stack([equilibrium.packing.strain * up, up], axis=1)
    away[:, 0] -= box * np.rint(away[:, 0] / box)
    gap = np.hypot(*away.T) - 0.5 * (
        equilibrium.packing.diameter[i] + equilibrium.packing.diameter[j]
    )
    gap[gap < 0.0] = np.inf
    diameter = equilibrium.packing.diameter.copy()
    diameter[i[np.argmin(gap)]] += 2.0 * (gap.min() - 1e-6)
    return EquilibriumState.from_packing(
        replace(equilibrium.packing, diameter=diameter), equilibrium.interaction
    )


def test_the_linear_range_depends_on_a_direction_and_not_on_its_norm():
    equilibrium = sheared_equilibrium()
    modes = motions(equilibrium)
    np.testing.assert_allclose(
        linear_ranges(equilibrium, 1e-7 * np.exp(0.3j) * modes), linear_ranges(equilibrium, modes)
    )


def test_a_loose_grain_does_not_limit_the_linear_range():
    """A grain that only one contact holds is put down at zero overlap."""
    equilibrium = sheared_equilibrium()
    weakest = np.argmin(equilibrium.packing.contacts.overlap)
    grain = equilibrium.packing.contacts.i[weakest]
    held = np.arange(equilibrium.packing.n) != grain
    shrunk = narrowed(equilibrium)
    assert linear_ranges(shrunk, motions(equilibrium)).max() < 1e-15
    assert linear_ranges(replace(shrunk, backbone_mask=held), motions(equilibrium)).min() > 1e-12


def test_a_release_changes_its_contacts_where_linear_theory_says():
    """Within a factor of three of M: it is looked at now and then, and M swings."""
    start, _, _ = state()
    expected = linear_ranges(sheared_equilibrium(), start.mode[:, :, None])[0]
    outcome = release_outcome(
        released(Release(duration=22.0, min_time=0.0, n_records=2000, spectra=0)),
        start.growth_rate,
    )
    assert expected / 3.0 < outcome.change.square < 3.0 * expected
