"""Which contact laws make oscillations grow: C, Sec. VIII, and what a spring remembers."""

from functools import cache

import numpy as np
import pytest

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.compression.trajectory import compress_to, place_at_random
from grainmodes.protocols.law_comparison.comparison import ComparedState, shear_under_law

KT = 2 / 7
CHOICES = Shear(strain=0.012, step=2e-4)
SEED = {"hertz": 1, "harmonic": 1}

pytestmark = pytest.mark.slow


@cache
def grains_of_c(normal: str) -> Packing:
    """64 grains of diameters 1 and 1.4, every mass 1."""
    protocol = Compression(phi_step=1e-2, large_diameter=1.4, masses="equal")
    normal_law = Interaction.from_law(ContactLaw(normal)).normal
    return compress_to(
        place_at_random(64, SEED[normal], normal_law, protocol), 0.9, normal_law, protocol
    ).packing


@cache
def seen(normal: str, tangential: str, mu: float | None = None) -> list[ComparedState]:
    """The states along the way under a law."""
    interaction = Interaction.from_law(ContactLaw(normal, tangential, KT, mu))
    found = shear_under_law(grains_of_c(normal), interaction, CHOICES)
    assert found.failure is None
    return found.states


def growth_over_rate(states: list[ComparedState]) -> np.ndarray:
    return np.array([state.growth / state.rate for state in states if state.pairs_slipping])


@pytest.mark.parametrize(
    ("normal", "tangential", "mu"),
    [
        ("hertz", "elastic", None),
        ("hertz", "smoothed_coulomb", 0.5),
        ("harmonic", "smoothed_coulomb", 0.5),
    ],
)
def test_smooth_laws_that_couple_spring_and_overlap_grow(normal, tangential, mu):
    states = seen(normal, tangential, mu)
    assert sum(state.pairs_slipping > 0 for state in states) >= 5
    assert all(state.pairs_slipping == state.pairs_sticking for state in states)
    np.testing.assert_allclose(growth_over_rate(states), 1.0, atol=0.01)


@pytest.mark.parametrize(
    ("normal", "tangential"), [("harmonic", "elastic"), ("hertz", "elastic_force")]
)
def test_without_that_coupling_there_is_no_pair(normal, tangential):
    assert not any(state.pairs_slipping for state in seen(normal, tangential))


@pytest.mark.parametrize(
    ("normal", "tangential"), [("harmonic", "sharp_coulomb"), ("hertz", "sharp_coulomb_force")]
)
def test_springs_that_slip_sharply_make_pairs_that_do_not_grow(normal, tangential):
    states = seen(normal, tangential, 0.5)
    assert not any(state.pairs_sticking for state in states)
    ratio = growth_over_rate(states)
    assert len(ratio) >= 3
    assert np.abs(ratio).max() < 0.1


def test_a_harmonic_spring_may_remember_either():
    by_s, by_force = (
        seen("harmonic", name, 0.5) for name in ("sharp_coulomb", "sharp_coulomb_force")
    )
    assert [s.pairs_slipping for s in by_s] == [s.pairs_slipping for s in by_force]
