"""Complex pairs by a disc sweep: those of LAPACK."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sparse

from example_packings import reference
from grainmodes.complex_pairs import disc_sweep
from grainmodes.complex_pairs.arnoldi_discs import RADIUS_PER_HEIGHT, Disc, DiscSolver
from grainmodes.complex_pairs.definition import (
    dense_pairs,
    select_pairs,
    translations,
    with_rayleigh_quotients,
)
from grainmodes.complex_pairs.disc_sweep import _shifts_above, pairs_by_disc_sweep
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.mass_weighted import mass_weighted_jacobian
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.strain_step import first_equilibrium, step_to

CHOICES = Shear(step=1e-3, min_step=1e-3, force_tolerance=5e-14)


def sheared(coefficient: float) -> sparse.csr_array:
    """K of 64 grains of mass 1 at γ = 0.02."""
    interaction = Interaction.from_law(
        ContactLaw("hertz", "smoothed_coulomb", 2.0 / 7.0, coefficient)
    )
    packing = reference("hertz_n64_phi0.900_seed1")[1]
    now = first_equilibrium(replace(packing, mass=np.ones(packing.n)), interaction, CHOICES)
    for step in range(1, 21):
        now, _ = step_to(1e-3 * step, now, CHOICES)
    return mass_weighted_jacobian(now.matrix, now.backbone.mass)


@pytest.mark.parametrize("coefficient", [0.5, 10.0])
def test_the_pairs_are_those_of_lapack(coefficient):
    matrix = sheared(coefficient)
    found = pairs_by_disc_sweep(matrix, translations(np.ones(matrix.shape[0] // 3)))
    expected = dense_pairs(matrix)
    assert len(expected.value) > 0
    np.testing.assert_allclose(found.value, expected.value, atol=1e-13)
    np.testing.assert_allclose(found.condition, expected.condition, rtol=1e-6)
    residual = matrix @ found.right - found.right * found.value
    assert np.abs(residual).max() < 1e-11
    left = matrix.T @ found.left.conj() - found.left.conj() * found.value
    assert np.abs(left).max() < 1e-10


def test_what_is_missing_is_seen(monkeypatch):
    matrix = sheared(10.0)
    monkeypatch.setattr(disc_sweep, "SHIFT_SPACING", 5.0)
    monkeypatch.setattr(disc_sweep.Disc, "low", property(lambda self: -np.inf))
    with pytest.raises(ArithmeticError, match="eigenvalues, got"):
        pairs_by_disc_sweep(matrix, translations(np.ones(matrix.shape[0] // 3)))


def with_tall_pairs(*pairs: complex) -> sparse.csr_array:
    """400 real eigenvalues from 0.1 to 1.5 and some pairs, all mixed a little."""
    tall = [np.array([[pair.real, pair.imag], [-pair.imag, pair.real]]) for pair in pairs]
    size = 400 + 2 * len(pairs)
    noise = 1e-3 * np.random.default_rng(4).standard_normal((size, size))
    ladder = np.diag(np.linspace(0.1, 1.5, 400))
    return sparse.csr_array(scipy.linalg.block_diag(ladder, *tall) + noise + noise.T)


def test_pairs_far_above_the_real_axis_are_found():
    matrix = with_tall_pairs(0.5 + 0.4j, 0.9 + 0.1j)
    found, expected = pairs_by_disc_sweep(matrix, np.zeros((404, 0))), dense_pairs(matrix)
    assert len(expected.value) == 2 and expected.value.imag.max() > 0.3
    np.testing.assert_allclose(found.value, expected.value, atol=1e-12)
    np.testing.assert_allclose(found.condition, expected.condition, rtol=1e-6)


@pytest.mark.parametrize("place", [0.1, 0.45, 0.79])
@pytest.mark.parametrize("angle", [-0.5, 0.3, 1.2])
def test_a_disc_above_the_axis_reaches_far(place, angle):
    """All within 0.8 of its height in one sweep, at a height of a hundred gaps on the axis."""
    shift = 0.8 + 0.3j
    pair = shift + 0.3 * place * np.exp(1j * angle)
    disc = DiscSolver(with_tall_pairs(pair), np.zeros((402, 0))).above_axis(shift)
    assert np.abs(disc.value - pair).min() < 0.01
    assert disc.radius == pytest.approx(0.24)


def test_a_left_vector_that_arnoldi_does_not_find_comes_from_inverse_iteration():
    matrix = with_tall_pairs(0.5 + 0.4j)
    solver, expected = DiscSolver(matrix, np.zeros((402, 0))), dense_pairs(matrix)
    far = Disc(0.9 + 0.01j, 1.0, expected.value, expected.right)
    left = solver.left_vectors(far)
    overlap = np.abs(left.conj().T @ expected.left) / np.linalg.norm(expected.left)
    assert overlap == pytest.approx(np.linalg.norm(left))


def test_rows_of_discs_leave_no_gap_above_those_on_the_axis():
    """Discs of radius 1, 1.8 apart, as they are on the axis; everything up to a height of 40."""
    shifts = 1.8 * np.arange(200)
    cuts = 0.5 * (shifts[1:] + shifts[:-1])
    above = np.array([*_shifts_above([-1.0, *cuts, shifts[-1] + 1.0], 40.0)])
    across, up = np.meshgrid(np.linspace(100.0, 260.0, 321), np.geomspace(0.01, 40.0, 200))
    points = (across + 1j * up).ravel()[:, None]
    seen = np.abs(points - shifts).min(axis=1) < 1.0
    for part in np.array_split(above, 10):
        seen |= (np.abs(points - part) < RADIUS_PER_HEIGHT * part.imag).any(axis=1)
    assert seen.all()
    assert len(above) < 1.6 * len(shifts)


def test_a_symmetric_matrix_has_no_pairs():
    matrix = sheared(10.0)
    found = pairs_by_disc_sweep(
        0.5 * (matrix + matrix.T).tocsr(), translations(np.ones(matrix.shape[0] // 3))
    )
    assert len(found.value) == 0 and found.right.shape == (matrix.shape[0], 0)


def test_quotients_are_right_to_the_square_of_what_vectors_are():
    matrix = sheared(10.0)
    exact, draws = dense_pairs(matrix), np.random.default_rng(6)
    right, left = (side + 1e-6 * draws.standard_normal(side.shape) for side in exact[1:])
    roughly = select_pairs(exact.value + 1e-3, right, left)
    np.testing.assert_allclose(
        with_rayleigh_quotients(matrix, roughly).value, exact.value, atol=1e-8
    )
