"""How rotations are arranged around the centre of an event."""

import numpy as np
import pytest

from grainmodes.packing.state import Packing
from grainmodes.protocols.shear.event_multipoles import PERMUTATIONS, rotational_multipoles

N, LENGTH = 4000, 60.0


def scattered(strain: float = 0.0) -> tuple[Packing, np.ndarray, np.ndarray]:
    """Points at random, the first of them the centre; their polar angles and distances."""
    draws = np.random.default_rng(0)
    position = draws.uniform(0.0, LENGTH, (N, 2))
    packing = Packing.from_positions(position, np.ones(N), LENGTH, strain)
    apart = position - position[0]
    apart[:, 0] -= strain * LENGTH * np.round(apart[:, 1] / LENGTH)
    apart[:, 1] -= LENGTH * np.round(apart[:, 1] / LENGTH)
    apart[:, 0] -= LENGTH * np.round((apart[:, 0] - strain * apart[:, 1]) / LENGTH)
    return packing, np.arctan2(apart[:, 1], apart[:, 0]), np.hypot(*apart.T)


def event(turns: np.ndarray) -> np.ndarray:
    field = np.zeros((N, 3))
    field[0, 0], field[:, 2] = 1.0, turns
    return field


@pytest.mark.parametrize("strain", [0.0, 0.3])
def test_four_domains_are_a_quadrupole(strain):
    packing, angle, distance = scattered(strain)
    near = (distance > 0.0) & (distance < LENGTH / 2.0)
    four, others, rank = rotational_multipoles(packing, event(np.cos(2.0 * angle) * near))
    assert four == pytest.approx((np.pi / 4.0) ** 2, rel=0.05)
    assert others < 0.01
    assert rank == 1.0 / (1 + PERMUTATIONS)


def test_other_domains_and_none_are_no_quadrupole():
    packing, angle, _ = scattered()
    four, others, rank = rotational_multipoles(packing, event(np.cos(3.0 * angle)))
    assert four < 0.01 and others == pytest.approx((np.pi / 4.0) ** 2 / 3.0, rel=0.05)
    assert rank > 0.05
    at_random = np.random.default_rng(1).standard_normal(N)
    assert max(rotational_multipoles(packing, event(at_random))[:2]) < 20.0 / N
    assert np.isnan(rotational_multipoles(packing, event(np.zeros(N)))).all()
    assert np.isnan(rotational_multipoles(packing, event(at_random)[:, :2])).all()


def test_rotations_at_random_have_every_rank():
    """One in twenty is among the first twentieth."""
    packing, *_ = scattered()
    draws = np.random.default_rng(2).standard_normal((60, N))
    ranks = np.array([rotational_multipoles(packing, event(turns)).rank for turns in draws])
    assert 0.35 < ranks.mean() < 0.65
    assert (ranks <= 0.05).sum() < 10
