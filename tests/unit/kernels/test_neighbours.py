"""The cell list against all pairs: boxes of one cell to many, sheared or not, grains anywhere."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import naive
from example_packings import few, pairs_of
from grainmodes.kernels.neighbours import cells_per_side, find_neighbours
from grainmodes.packing.state import Packing


def listed(packing: Packing, skin: float):
    x, y = packing.fraction
    return find_neighbours(x, y, packing.diameter, packing.box_length, packing.strain, skin)


def scattered(seed: int, n: int, box_length: float, strain: float) -> Packing:
    """Grains of three sizes thrown anywhere, many of them on top of each other."""
    draws = np.random.default_rng(seed)
    position = draws.uniform(0, box_length, (n, 2))
    return Packing.from_positions(
        position, draws.choice([0.5, 1 / 1.4, 1.0], n), box_length, strain
    )


@few(60)
@given(
    seed=st.integers(0, 10**6),
    n=st.integers(2, 30),
    box_length=st.floats(2.6, 9.0),
    strain=st.floats(-0.5, 0.5),
    skin=st.floats(0.0, 0.25),
)
def test_every_pair_once_and_no_other(seed, n, box_length, strain, skin):
    packing = scattered(seed, n, box_length, strain)
    pairs = listed(packing, skin)
    found = sorted(zip(pairs.right.tolist(), pairs.left.tolist(), strict=True))
    assert found == sorted((p.i, p.j) for p in pairs_of(packing, skin))


@pytest.mark.parametrize("strain", [-0.5, 0.0, 0.3])
def test_list_is_sorted_and_indexed_by_the_left_grain(strain):
    packing = scattered(3, 40, 6.0, strain)
    pairs = listed(packing, 0.2)
    assert pairs.first[0] == 0 and pairs.first[-1] == len(pairs.left) == len(pairs.contact_distance)
    for i in range(packing.n):
        assert np.all(pairs.left[pairs.first[i] : pairs.first[i + 1]] == i)
    assert np.all(pairs.right > pairs.left)
    mean = (packing.diameter[pairs.left] + packing.diameter[pairs.right]) / 2
    np.testing.assert_array_equal(pairs.contact_distance, mean)


@pytest.mark.parametrize("cells", [1, 2, 3, 4, 7])
def test_every_number_of_cells(cells):
    box_length = max(2.6, 1.2 * cells + 0.05)
    packing = scattered(cells, 12 * cells, box_length, 0.0)
    skin = box_length / cells - 1.0 - 1e-6
    assert cells_per_side(box_length, 1.0 + skin, 0.0) == cells
    pairs = listed(packing, min(skin, 0.2))
    assert len(pairs.left) == len(pairs_of(packing, min(skin, 0.2)))


def test_a_crowded_cell_does_not_overflow():
    draws = np.random.default_rng(0)
    position = np.full((300, 2), 5.0) + draws.uniform(-0.05, 0.05, (300, 2))
    packing = Packing.from_positions(position, np.ones(300), 10.0)
    assert len(listed(packing, 0.0).left) == 300 * 299 // 2


@pytest.mark.parametrize("shift", [0, 1, -1, 2**62, -(2**63)])
def test_list_does_not_depend_on_where_the_box_begins(shift):
    packing = scattered(7, 30, 5.0, 0.2)
    moved = packing.fraction + np.int64(shift)
    there = find_neighbours(*moved, packing.diameter, 5.0, 0.2, 0.1)
    here = listed(packing, 0.1)
    pairs = [set(zip(p.left.tolist(), p.right.tolist(), strict=True)) for p in (here, there)]
    assert pairs[0] == pairs[1]


def test_touching_across_the_sheared_boundary():
    box_length, strain = 5.0, 0.4
    position = np.array([[1.0, 4.9], [1.0 + 0.3 - strain * box_length, 0.4]])
    packing = Packing.from_positions(position, np.ones(2), box_length, strain)
    (pair,) = pairs_of(packing)
    assert naive.length(pair.branch) == pytest.approx(np.hypot(0.3, 0.5))
    assert len(listed(packing, 0.0).left) == 1
