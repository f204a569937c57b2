"""Which states of a shear are kept for release: the fastest of all, or those of listed rates."""

from types import SimpleNamespace

import numpy as np
import pytest

from grainmodes.parameters.release import GROWTH_RANGE
from grainmodes.protocols.pair_tracking import release_candidates
from grainmodes.protocols.pair_tracking.detection import DenseDetector, PairState, detect_pairs
from grainmodes.protocols.pair_tracking.linear_range import linear_ranges
from grainmodes.protocols.pair_tracking.release_candidates import (
    ReleaseCandidates,
    fastest_candidate,
)
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from released import narrowed, sheared_equilibrium, state


def pair_state(equilibrium: EquilibriumState) -> PairState:
    return detect_pairs(DenseDetector(), equilibrium)


def test_a_state_next_to_a_change_of_contacts_is_passed_over():
    wide, narrow = pair_state(sheared_equilibrium()), pair_state(narrowed(sheared_equilibrium()))
    assert len(narrow.pairs.value) > 0
    chosen = fastest_candidate(wide, 0.0)
    assert chosen.growth == wide.pairs.growth.max() == wide.pairs.growth[chosen.place]
    assert chosen.growth == pytest.approx(state()[0].growth_rate)
    assert chosen.linear_range > GROWTH_RANGE[1]
    assert fastest_candidate(narrow, 0.0) is None
    assert fastest_candidate(wide, chosen.growth) is None


def test_the_candidate_is_the_fastest_pair_with_a_sufficient_range(monkeypatch):
    start = pair_state(sheared_equilibrium())
    motions_of_pairs = start.motions(np.arange(len(start.pairs.value)))
    growth, ranges = start.pairs.growth, linear_ranges(start.equilibrium, motions_of_pairs)
    fastest = np.argmax(growth)
    assert ranges[fastest] < ranges.max()
    monkeypatch.setattr(
        "grainmodes.protocols.pair_tracking.release_candidates.GROWTH_RANGE", (0.0, ranges[fastest])
    )
    chosen = fastest_candidate(start, 0.0)
    assert chosen.growth == growth[ranges > ranges[fastest]].max()
    assert chosen.linear_range == ranges[chosen.place]


@pytest.fixture
def shear(monkeypatch):
    """States with pairs of given ω_i, all of a sufficient linear range but for ω_i = 7e-4."""

    def ranges(equilibrium, motions):
        return np.where(motions == 7e-4, 0.0, 1.0)

    monkeypatch.setattr(release_candidates, "linear_ranges", ranges)

    def made(*growth: float) -> SimpleNamespace:
        rates = np.array(growth)
        pairs = SimpleNamespace(growth=rates)
        return SimpleNamespace(pairs=pairs, equilibrium=None, motions=lambda p: rates[p])

    return [made(), made(2e-5), made(9e-5, 3e-6), made(7e-4), made(4e-3, 2e-4), made(0.3, 1e-3)]


def chosen(rates: tuple[float, ...], shear) -> list[float | None]:
    """ω_i of the candidates of a shear."""
    candidates = ReleaseCandidates(rates)
    for state_ in shear:
        candidates.consider(state_)
    return [one.growth if one else None for one in candidates.found]


def test_every_listed_rate_has_the_nearest_state(shear):
    """A slower pair of a state does not count, nor one without a linear range."""
    assert chosen((2.3e-5, 2e-4, 2e-3), shear) == [2e-5, 9e-5, 4e-3]


def test_a_rate_without_a_state_within_half_a_decade_has_none(shear):
    assert chosen((1e-6, 8e-4, 2e-2), shear) == [None, None, None]


def test_without_a_list_the_fastest_of_all_is_kept(shear):
    assert chosen((), shear) == [0.3]
    assert chosen((), shear[3:4]) == [None]
