"""Sums in fixed lanes: the order of the additions is the one that is written down."""

import numpy as np
import pytest
from numba.core.errors import TypingError

from grainmodes.kernels.compiler import FLAGS
from grainmodes.kernels.lanes import LANES, lane_sum


def written_out(values) -> float:
    """The sum in the order that `lanes` states."""
    whole = len(values) - len(values) % LANES
    lanes = [0.0] * LANES
    for k in range(whole):
        lanes[k % LANES] += values[k]
    a, b, c, d, e, f, g, h = lanes
    found = ((a + e) + (c + g)) + ((b + f) + (d + h))
    for value in values[whole:]:
        found += value
    return found


@pytest.mark.parametrize("n", [0, 1, 7, 8, 9, 64, 1003])
def test_a_sum_is_added_up_as_written(n):
    values = np.random.default_rng(n).normal(size=n) * 10.0 ** (np.arange(n) % 13)
    assert lane_sum(values) == written_out([float(v) for v in values])


def test_the_order_matters():
    """Otherwise the test above would accept any sum."""
    arrays = np.random.default_rng(0).normal(size=(20, 1003))
    assert any(lane_sum(values) != sum(float(v) for v in values) for values in arrays)


def test_an_array_with_gaps_is_refused():
    with pytest.raises(TypingError, match="contiguous array of float64"):
        lane_sum(np.ones(32)[::2])


def test_no_kernel_may_reorder_or_contract():
    assert "fastmath" not in FLAGS
