"""Complex pairs against LAPACK and against two degrees of freedom in closed form."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse
from numpy.testing import assert_allclose

from dense_continuation import DenseContinuation, dense_eigensystem
from example_packings import SHEARED, reference, smoothed_coulomb
from grainmodes.complex_pairs import continuation, partitioning
from grainmodes.complex_pairs.continuation import EigenbasisContinuation
from grainmodes.complex_pairs.definition import (
    ComplexPairs,
    DynamicalMatrix,
    dense_pairs,
    translations,
)
from grainmodes.complex_pairs.invariant_subspaces import Subspaces
from grainmodes.complex_pairs.inverse_iteration import (
    INVARIANCE_TOLERANCE,
    nearest_subspace,
    subspace_spanned_by,
)
from grainmodes.complex_pairs.matching import PairProjectors, match_pairs, projector_overlap
from grainmodes.complex_pairs.partitioning import (
    Eigensystem,
    partitioned_eigensystem,
    strongly_coupled,
)
from grainmodes.complex_pairs.refinement import (
    RESIDUAL_TOLERANCE,
    Eigenbasis,
    near_degenerate,
    refined_subspaces,
)
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.mass_weighted import mass_weighted_jacobian
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.pair_tracking.exceptional_points import fit_exponent
from grainmodes.protocols.shear.strain_step import first_equilibrium, step_to
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.response.stability import count_complex_pairs


def problem(matrix: sparse.csr_array, backbone: np.ndarray | None = None) -> DynamicalMatrix:
    """K without zero modes, on the whole packing unless a backbone is given."""
    backbone = np.ones(matrix.shape[0] // 3, bool) if backbone is None else backbone
    return DynamicalMatrix(matrix, np.zeros((matrix.shape[0], 0)), backbone)


@pytest.fixture(scope="module")
def sheared() -> EquilibriumState:
    """A state of an independent code with history."""
    data, packing = reference(SHEARED)
    return EquilibriumState.from_packing(packing, Interaction.from_law(smoothed_coulomb(data)))


@pytest.fixture(scope="module")
def matrix(sheared) -> sparse.csr_array:
    return mass_weighted_jacobian(sheared.matrix, sheared.backbone.mass)


def path(size: int, asymmetry: float, steps: int = 8) -> list[sparse.csr_array]:
    """Matrices with more and more pairs: a ladder, a random symmetric and a random skew part."""
    draws = np.random.default_rng(size)
    noise = draws.standard_normal((size, size)) / np.sqrt(size)
    even, skew = noise + noise.T, noise - noise.T
    ladder = np.diag(np.sort(draws.uniform(0.1, 2.0, size)))
    times = np.linspace(0.0, 1.0, steps)
    return [sparse.csr_array(ladder + asymmetry * t * (0.3 * even + skew)) for t in times]


def two(strain: float) -> sparse.csr_array:
    """C (18): D = 4 (γ² − 1), a pair for |γ| < 1, λ1 + λ2 = 4 + γ."""
    return sparse.csr_array([[2.0 + 1.5 * strain, 1.0], [-1.0, 2.0 - 0.5 * strain]])


def test_the_pairs_of_a_state_are_eigenpairs(sheared, matrix):
    found = dense_pairs(matrix)
    assert len(found.value) == count_complex_pairs(sheared.backbone, sheared.interaction) > 0
    assert np.all(found.value.imag > 0.0)
    assert_allclose(matrix @ found.right, found.right * found.value, atol=1e-13)
    assert_allclose(matrix.T @ found.left, found.left * found.value.conj(), atol=1e-12)
    assert_allclose(np.einsum("np,np->p", found.left.conj(), found.right), 1.0)
    assert_allclose(found.growth, np.sqrt(found.value).imag)


def test_a_condition_is_what_an_error_grows_by(matrix):
    found = dense_pairs(matrix)
    place = int(np.argmax(found.condition))
    size, (left, right) = 1e-9, (side[:, place] for side in (found.left, found.right))
    worst = np.outer(left, right.conj()) / np.linalg.norm(left)
    shifted = np.linalg.eigvals(matrix.toarray() + size * worst)
    moved = np.abs(shifted - found.value[place]).min()
    assert moved == pytest.approx(size * found.condition[place], rel=1e-3)


def test_a_symmetric_jacobian_has_no_pair():
    _, packing = reference("hertz_n64_phi0.900_seed1")
    at_rest = EquilibriumState.from_packing(
        packing, Interaction.from_law(smoothed_coulomb(reference(SHEARED)[0]))
    )
    detector = EigenbasisContinuation()
    matrix = mass_weighted_jacobian(at_rest.matrix, at_rest.backbone.mass)
    assert [len(detector.find(problem(matrix)).value) for _ in range(2)] == [0, 0]
    assert not detector.dense
    assert len(dense_pairs(matrix).value) == 0


@pytest.mark.parametrize("strain", [-3.0, -1.001, -0.999, 0.0, 0.5, 0.999999, 1.000001, 2.0])
def test_a_plane_knows_two_modes_on_both_sides_of_their_meeting(strain):
    plane = subspace_spanned_by(two(strain), np.eye(2), np.eye(2))
    assert plane.sum == pytest.approx(4.0 + strain)
    assert plane.discriminant == pytest.approx(4.0 * (strain**2 - 1.0), rel=1e-9)
    expected = np.linalg.eigvals(two(strain).toarray())
    assert_allclose(np.sort_complex(plane.values), np.sort_complex(expected), atol=1e-9)
    vectors = plane.vectors
    assert_allclose(two(strain) @ vectors, vectors * plane.values, atol=1e-12)
    product = 1.0 if abs(strain) < 1.0 else 1.0 / abs(strain)
    assert plane.product == pytest.approx(product, abs=1e-9)
    condition = 1.0 / np.sqrt(1.0 - min(abs(strain), 1.0 / max(abs(strain), 1e-9)) ** 2)
    assert plane.condition == pytest.approx(condition, rel=1e-6)


def test_at_the_exceptional_point_the_condition_is_infinite():
    plane = subspace_spanned_by(two(1.0), np.eye(2), np.eye(2))
    assert plane.discriminant == pytest.approx(0.0, abs=1e-14)
    assert plane.product == pytest.approx(1.0, abs=1e-7)
    assert plane.condition > 1e6


def test_the_exponent_of_a_square_root_is_a_half():
    distance = np.logspace(-8, -5, 10)
    for sign in (1.0, -1.0):
        discriminant = np.abs([plane_at(1.0 + sign * d) for d in distance])
        exponent = fit_exponent(distance, discriminant)
        assert exponent.value == pytest.approx(0.5, abs=1e-6)
        assert exponent.error < 1e-6
    linear = fit_exponent(distance, distance**2)
    assert linear.value == pytest.approx(1.0)
    assert np.isnan(fit_exponent(distance[:4], distance[:4]).value)


def plane_at(strain: float) -> float:
    return subspace_spanned_by(two(strain), np.eye(2), np.eye(2)).discriminant


def test_another_singularity_nearby_is_left_out_of_a_fit():
    distance = np.logspace(-8, -5, 10)
    bent = distance * (1.0 + np.sqrt(distance / 1e-7) * (distance > 5e-7))
    exponent = fit_exponent(distance, bent)
    assert exponent.n_states < 10
    assert exponent.value == pytest.approx(0.5, abs=0.05)


def test_a_plane_is_found_again_from_nearby(matrix):
    found = dense_pairs(matrix)
    draws = np.random.default_rng(1)
    for place in range(len(found.value)):
        right, left = (
            np.stack([side[:, place].real, side[:, place].imag], axis=1)
            for side in (found.right, found.left)
        )
        rough = [side + 1e-3 * draws.standard_normal(side.shape) for side in (right, left)]
        plane = nearest_subspace(matrix, subspace_spanned_by(matrix, *rough))
        assert plane.residual <= INVARIANCE_TOLERANCE
        assert plane.values[0] == pytest.approx(found.value[place], abs=1e-12)
        assert plane.condition == pytest.approx(found.condition[place], rel=1e-6)
        assert plane.product == pytest.approx(1.0)


def test_pairs_are_the_same_ones_in_any_order(matrix):
    found = dense_pairs(matrix)
    order = np.random.default_rng(0).permutation(len(found.value))
    turned = found.right[:, order] * np.exp(0.7j)
    other = ComplexPairs(found.value[order], turned, found.left[:, order] * np.exp(0.7j))
    found, other = PairProjectors.from_pairs(found), PairProjectors.from_pairs(other)
    assert sorted(match_pairs(found, other)) == [(order[k], k) for k in np.argsort(order)]
    assert_allclose(projector_overlap(found, found), np.eye(len(order)), atol=1e-5)
    nothing = PairProjectors(found.right[:0], found.left[:0])
    assert match_pairs(found, nothing) == match_pairs(nothing, found) == []


def test_a_nearly_diagonal_matrix_is_solved_window_by_window():
    size = 150
    draws = np.random.default_rng(3)
    diagonal = np.sort(draws.uniform(0.0, 2.0, size))
    change = 8e-4 * draws.standard_normal((size, size))
    b = np.diag(diagonal) + change - np.diag(np.diag(change))
    found = partitioned_eigensystem(
        diagonal, (change - np.diag(np.diag(change))).astype(np.float32)
    )
    expected = np.linalg.eigvals(b)
    assert np.count_nonzero(expected.imag) > 10
    nearest = np.abs(found.values[:, None] - expected).min(axis=1)
    assert nearest.max() < 3e-5
    assert np.count_nonzero(found.values.imag) == np.count_nonzero(expected.imag)
    (pair,) = np.nonzero(found.values.imag > 0.0)
    vectors = found.rows.astype(complex)
    vectors[pair] += 1j * found.rows[pair + 1]
    vectors[pair + 1] = vectors[pair].conj()
    residual = vectors @ b.T - found.values[:, None] * vectors
    assert np.abs(residual).max() < 1e-3


def test_a_pair_far_from_the_real_axis_has_its_part_outside_the_window():
    size = 150
    b = 1e-3 * np.random.default_rng(3).standard_normal((size, size))
    b[[75, 76], [76, 75]] = 0.3, -0.3
    np.fill_diagonal(b, 0.0)
    diagonal = np.linspace(0.0, 2.0, size)
    found, b = partitioned_eigensystem(diagonal, b.astype(np.float32)), b + np.diag(diagonal)
    place = int(np.argmax(found.values.imag))
    vector = found.rows[place] + 1j * found.rows[place + 1]
    assert found.values[place].imag == pytest.approx(0.3, abs=1e-3)
    assert np.abs(b @ vector - found.values[place] * vector).max() < 1e-4


def test_two_eigenvalues_are_in_doubt_as_far_as_their_coupling_reaches():
    values = np.array([0.1, 0.3, 0.31, 0.5 + 4e-3j, 0.5 - 4e-3j, 0.7, 0.9])
    assert near_degenerate(values, np.full(7, 0.01)).tolist() == []
    assert near_degenerate(values, np.full(7, 0.25)).tolist() == [[3, 4], [1, 2]]


def test_what_is_not_nearly_diagonal_is_not_solved():
    size = 150
    draws = np.random.default_rng(3)
    assert (
        partitioned_eigensystem(np.zeros(size), draws.standard_normal((size, size), np.float32))
        is None
    )


def test_modes_that_couple_to_all_others_stand_in_every_window(monkeypatch):
    size, hubs = 200, [50, 150]
    draws = np.random.default_rng(4)
    diagonal = np.sort(draws.uniform(0.0, 2.0, size))
    change = 1e-4 * draws.standard_normal((size, size))
    change[hubs] += 5e-3 * draws.standard_normal((2, size))
    change[:, hubs] = change[hubs].T
    np.fill_diagonal(change, 0.0)
    single = change.astype(np.float32)
    found = partitioned_eigensystem(diagonal, single)
    expected = np.linalg.eigvals(np.diag(diagonal) + change)
    assert sorted(strongly_coupled(single, single.T).tolist()) == hubs
    assert np.median(np.abs(found.values[:, None] - expected).min(axis=0)) < 1e-7
    monkeypatch.setattr(partitioning, "MAX_STRONG", 0)
    assert np.median(found.coupling) < 0.5 * np.median(
        partitioned_eigensystem(diagonal, single).coupling
    )


def test_subspaces_know_their_pairs_and_residuals(matrix):
    expected = dense_pairs(matrix)
    planes = (
        np.stack([side.real.T, side.imag.T], axis=1) for side in (expected.right, expected.left)
    )
    right, left = planes
    found = Subspaces.spanned_by(matrix, right[::-1], left[::-1])
    assert found.residual.max() < 1e-12
    assert_allclose(found.pairs.value, expected.value, atol=1e-12)
    assert_allclose(found.pairs.condition, expected.condition, rtol=1e-8)
    assert_allclose(matrix @ found.pairs.right, found.pairs.right * found.pairs.value, atol=1e-12)
    assert_allclose(np.einsum("np,np->p", found.pairs.left.conj(), found.pairs.right), 1.0)
    size = 1e-3 * np.abs(matrix.data).max()
    right[0] += size * np.random.default_rng(0).standard_normal(right[0].shape)
    assert Subspaces.spanned_by(matrix, right, left).residual.argmax() == 0


@pytest.mark.parametrize("imaginary", [1e-5, 1e-3, 0.1])
def test_a_pair_between_other_modes_is_refined_subspaces(imaginary):
    size, draws = 60, np.random.default_rng(2)
    values = np.sort(draws.uniform(0.5, 1.5, size)) + 0j
    values[[20, 21]] = values[20].real + imaginary * np.array([1j, -1j])
    values[[40, 41]] = values[40].real + 0.05 * np.array([1j, -1j])
    blocks = np.diag(values.real)
    for one in (20, 40):
        blocks[one, one + 1], blocks[one + 1, one] = values[one].imag, values[one + 1].imag
    exact = np.eye(size) + 0.2 * draws.standard_normal((size, size)) / np.sqrt(size)
    matrix = sparse.csr_array(exact @ blocks @ np.linalg.inv(exact))
    basis = Eigenbasis.from_vectors(exact + 1e-3 * exact @ draws.standard_normal((size, size)))
    found = Eigensystem(values, np.eye(size, dtype=np.float32), np.full(size, 0.02), 0.0)
    at = np.array([[20, 21], [40, 41]])
    rough = Subspaces.spanned_by(
        matrix, basis.vectors.T[at].astype(float), basis.inverse[at].astype(float)
    )
    subspaces, expected = refined_subspaces(matrix, basis, found), dense_pairs(matrix)
    assert rough.residual.min() > 10 * RESIDUAL_TOLERANCE
    assert subspaces.residual.max() < RESIDUAL_TOLERANCE
    assert_allclose(subspaces.pairs.value, expected.value, atol=1e-6)
    assert_allclose(subspaces.pairs.condition, expected.condition, rtol=2e-2)


def test_continued_pairs_are_those_of_lapack():
    detector, seen = EigenbasisContinuation(), 0
    for matrix in path(120, 0.03):
        found, expected = detector.find(problem(matrix)), dense_pairs(matrix)
        assert len(found.value) == len(expected.value)
        assert_allclose(found.value, expected.value, atol=1e-6)
        assert_allclose(found.condition, expected.condition, rtol=0.02)
        left = np.linalg.norm(matrix.T @ found.left - found.left * found.value.conj(), axis=0)
        right = np.linalg.norm(matrix @ found.right - found.right * found.value, axis=0)
        worst = RESIDUAL_TOLERANCE * np.abs(matrix.data).max()
        assert np.all(right < 2.0 * worst)
        assert np.all(left < 2.0 * worst * found.condition)
        seen += not detector.dense
    assert seen >= 5
    assert len(expected.value) > 3


@pytest.mark.parametrize("refused", [1, 2])
def test_what_is_too_far_is_reached_on_the_way(monkeypatch, refused):
    first, then = path(120, 0.03)[:2]
    detector, asked, believed = EigenbasisContinuation(), [], []

    def too_far(diagonal, perturbation):
        asked.append(np.abs(perturbation).max())
        far = len(asked) <= refused
        return None if far else partitioned_eigensystem(diagonal, perturbation)

    def watched(*arguments):
        believed.append(len(asked))
        return refined_subspaces(*arguments)

    detector.find(problem(first))
    monkeypatch.setattr(continuation, "partitioned_eigensystem", too_far)
    monkeypatch.setattr(continuation, "refined_subspaces", watched)
    found, expected = detector.find(problem(then)), dense_pairs(then)
    assert not detector.dense
    assert_allclose(asked[: refused + 1], asked[0] * 0.5 ** np.arange(refused + 1))
    assert min(believed) > refused + 1
    assert_allclose(found.value, expected.value, atol=1e-6)


def test_lapack_solves_what_cannot_be_continued(monkeypatch):
    first, *_, last = path(120, 0.03)
    detector = EigenbasisContinuation()
    detector.find(problem(first))
    monkeypatch.setattr(continuation, "MAX_PASSES", 0)
    assert_allclose(detector.find(problem(last)).value, dense_pairs(last).value, atol=1e-12)
    assert detector.dense


@pytest.mark.parametrize("joins", [True, False])
def test_lapack_solves_a_state_whose_backbone_has_changed(joins):
    some = np.arange(40) != 17
    strength = np.where(np.repeat(some, 3), 1.0, 0.03)
    whole = path(120, 0.03)[-1] * np.outer(strength, strength)
    inside = whole[np.ix_(*2 * [np.flatnonzero(strength == 1.0)])]
    states = [problem(sparse.csr_array(inside), some), problem(sparse.csr_array(whole))]
    first, then = states if joins else states[::-1]
    detector = EigenbasisContinuation()
    detector.find(first)
    for dense in (True, False):
        found, expected = detector.find(then), dense_pairs(then.matrix)
        assert detector.dense == dense
        assert_allclose(found.value, expected.value, atol=1e-6)
        assert_allclose(found.condition, expected.condition, rtol=0.02)


def test_a_partitioning_is_the_dense_eigensystem():
    size, draws = 150, np.random.default_rng(3)
    diagonal = np.sort(draws.uniform(0.0, 2.0, size))
    perturbation = 8e-4 * draws.standard_normal((size, size))
    np.fill_diagonal(perturbation, 0.0)
    found = partitioned_eigensystem(diagonal, perturbation.astype(np.float32))
    expected = dense_eigensystem(diagonal, perturbation)
    assert np.count_nonzero(expected.values.imag) > 4
    nearest = np.abs(found.values[:, None] - expected.values).argmin(axis=1)
    assert np.unique(nearest).size == size
    assert_allclose(found.values, expected.values[nearest], atol=3e-5)
    assert abs(found.trace_defect) < 1e-3 and expected.trace_defect < 1e-4
    upper = np.flatnonzero(found.values.imag > 0.0)
    single = np.setdiff1d(np.arange(size), np.concatenate([upper, upper + 1]))
    one, two = found.rows[single], expected.rows[nearest[single]]
    overlap = np.abs((one * two).sum(axis=1)) / np.linalg.norm(one, axis=1)
    assert np.median(overlap) > 0.999


def walk(coefficient: float, steps: int) -> list[DynamicalMatrix]:
    """K of 64 grains of mass 1 in the states of a shear to γ = 1e-3 `steps`."""
    interaction = Interaction.from_law(
        ContactLaw("hertz", "smoothed_coulomb", 2.0 / 7.0, coefficient)
    )
    choices = Shear(step=1e-3, min_step=1e-3, force_tolerance=5e-14)
    packing = reference("hertz_n64_phi0.900_seed1")[1]
    state, states = (
        first_equilibrium(replace(packing, mass=np.ones(packing.n)), interaction, choices),
        [],
    )
    for step in range(1, steps + 1):
        state, _ = step_to(1e-3 * step, state, choices)
        matrix = mass_weighted_jacobian(state.matrix, state.backbone.mass)
        states.append(
            DynamicalMatrix(matrix, translations(state.backbone.mass), state.backbone_mask)
        )
    return states


@pytest.mark.parametrize("coefficient", [0.5, 10.0])
def test_along_a_shear_continuation_is_its_dense_twin_and_lapack(coefficient):
    fast, twin, number, continued = EigenbasisContinuation(), DenseContinuation(), 0, 0
    for state in walk(coefficient, 15):
        found, slow, expected = fast.find(state), twin.find(state), dense_pairs(state.matrix)
        assert len(found.value) == len(slow.value) == len(expected.value)
        assert_allclose(slow.value, expected.value, atol=1e-11)
        assert_allclose(found.value, expected.value, atol=1e-6)
        assert_allclose(found.condition, slow.condition, rtol=0.05)
        number += len(expected.value)
        continued += not fast.dense
    assert number > 10
    assert continued > 5
