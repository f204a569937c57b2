"""The eigenpair nearest a shift, inside a band, next to one, and across a gap."""

import numpy as np
import pytest

from example_packings import elastic, quenched
from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.spectrum import Eigenproblem, dense
from grainmodes.spectrum.nearest_eigenpair import nearest_eigenpair
from grainmodes.spectrum.slice_eigenpairs import SliceError, nearest_eigenpairs

GAP = 1.3e-2**2
"""A's lower frequency of Fig. 7; at k_T/k_N = 1e-8 no mode of 256 grains is within a decade."""


@pytest.fixture(scope="module")
def eigenproblem() -> Eigenproblem:
    return Eigenproblem.from_packing(quenched(256, 0.90), elastic("hertz", 1e-8))


@pytest.mark.parametrize("sigma", [1e-8, GAP, 3e-3, 0.3, 100.0])
def test_the_nearest_pair_is_that_of_lapack(eigenproblem, sigma):
    (value,), vector = nearest_eigenpair(
        SymmetricShift(eigenproblem.matrix, null_space=eigenproblem.translations),
        sigma,
        eigenproblem.bound,
    )
    eigenvalues = dense.eigenvalues(eigenproblem)[2:]
    nearest = eigenvalues[np.argmin(np.abs(eigenvalues - sigma))]
    assert value == pytest.approx(nearest, rel=1e-6)
    assert np.linalg.norm(eigenproblem.matrix @ vector - value * vector) < 1e-9 * max(sigma, 1.0)


def test_a_krylov_space_alone_fails_across_the_gap(eigenproblem):
    """The reason for this module; where it no longer fails, the module can go."""
    with pytest.raises(SliceError):
        nearest_eigenpairs(SymmetricShift(eigenproblem.matrix), GAP, 1)
