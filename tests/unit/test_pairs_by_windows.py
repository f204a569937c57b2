"""Complex pairs by windows of Arnoldi's method: those of LAPACK."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sparse

from grainmodes.kernels.laws import interaction
from grainmodes.pairs import by_windows
from grainmodes.pairs.by_windows import pairs_by_windows
from grainmodes.pairs.definition import dense_pairs, mass_weighted, translations
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.quasistatic import first_balance, step_to
from specimens import reference

CHOICES = Shear(step=1e-3, smallest_step=1e-3, force_tolerance=5e-14)


def sheared(coefficient: float) -> sparse.csr_array:
    """K of 64 grains of mass 1 at γ = 0.02."""
    rule = interaction(ContactLaw("hertz", "smoothed_coulomb", 2.0 / 7.0, coefficient))
    packing = reference("hertz_n64_phi0.900_seed1")[1]
    now = first_balance(replace(packing, mass=np.ones(packing.n)), rule, CHOICES)
    for step in range(1, 21):
        now, _ = step_to(1e-3 * step, now, CHOICES)
    return mass_weighted(now)


@pytest.mark.parametrize("coefficient", [0.5, 10.0])
def test_the_pairs_are_those_of_lapack(coefficient):
    matrix = sheared(coefficient)
    found = pairs_by_windows(matrix, translations(np.ones(matrix.shape[0] // 3)))
    expected = dense_pairs(matrix)
    assert len(expected.value) > 0
    np.testing.assert_allclose(found.value, expected.value, atol=1e-12)
    np.testing.assert_allclose(found.condition, expected.condition, rtol=1e-6)
    residual = matrix @ found.right - found.right * found.value
    assert np.abs(residual).max() < 1e-12
    left = matrix.T @ found.left.conj() - found.left.conj() * found.value
    assert np.abs(left).max() < 1e-11


def test_what_is_missing_is_seen(monkeypatch):
    matrix = sheared(10.0)
    monkeypatch.setattr(by_windows, "STEP", 5.0)
    monkeypatch.setattr(by_windows.Disc, "low", property(lambda self: -np.inf))
    with pytest.raises(ArithmeticError, match="eigenvalues were found"):
        pairs_by_windows(matrix, translations(np.ones(matrix.shape[0] // 3)))


def test_pairs_far_above_the_real_axis_are_found():
    tall = np.array([[0.5, 0.4], [-0.4, 0.5]])
    draws = np.random.default_rng(4)
    noise = 1e-3 * draws.standard_normal((402, 402))
    ladder = np.diag(np.linspace(0.1, 1.5, 400))
    matrix = sparse.csr_array(scipy.linalg.block_diag(ladder, tall) + noise + noise.T)
    found, expected = pairs_by_windows(matrix, np.zeros((402, 0))), dense_pairs(matrix)
    assert len(expected.value) == 1 and expected.value.imag[0] > 0.3
    np.testing.assert_allclose(found.value, expected.value, atol=1e-12)
    np.testing.assert_allclose(found.condition, expected.condition, rtol=1e-6)


def test_a_symmetric_matrix_has_no_pairs():
    matrix = sheared(10.0)
    found = pairs_by_windows(
        0.5 * (matrix + matrix.T).tocsr(), translations(np.ones(matrix.shape[0] // 3))
    )
    assert len(found.value) == 0 and found.right.shape == (matrix.shape[0], 0)
