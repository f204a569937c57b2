"""k_T/k_N = 0, 1e-16, 1e-12, 1e-10: rotations at 1e-11 and less beside ‖J‖ ~ 1.

Eigenvalues of LAPACK carry 1e-16 ‖J‖, and so does a Krylov space that mixes both bands. At 1e-8 and
1e-10 see also `unit/spectrum/test_spectrum_slicing.py` and `unit/linalg/test_symmetric_shift.py`.
"""

import numpy as np
import pytest

import exact
import naive
import naive_failures
from example_packings import ELASTIC, MINIMAL, elastic, pairs_of, quenched, reference
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.jacobian import stiffness_of
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import (
    Eigenproblem,
    dense,
    full_spectrum,
    slice_eigenpairs,
    spectrum_slicing,
)

SMALL = reference(MINIMAL[0])[1]
SLICING = SpectrumChoices("slicing")


def sure(matrix: np.ndarray, value: float, rank: int, part: float) -> bool:
    """Whether the eigenvalue of this rank is `value` to a relative `part`, by exact counts."""
    ends = value * (1.0 + np.array([-part, part]))
    return [exact.count_below(matrix, end) for end in ends] == [rank, rank + 1]


@pytest.mark.parametrize(("kt", "lapack"), [(1e-10, 1e-9), (1e-12, 1e-7)])
def test_soft_eigenvalues_keep_ten_digits(kt, lapack):
    eigenproblem = Eigenproblem.from_packing(SMALL, elastic("hertz", kt))
    matrix, rank = eigenproblem.matrix.toarray(), 2
    assert not sure(matrix, dense.eigenvalues(eigenproblem)[rank], rank, lapack)
    assert sure(matrix, full_spectrum(eigenproblem, choices=SLICING).eigenvalue[rank], rank, 1e-10)


def test_a_space_that_exhausts_a_band_beside_a_gap_stays_orthogonal():
    """63 rotations at 1e-12, the next modes at 1e-3: W falls by 1e9 within a block."""
    eigenproblem = Eigenproblem.from_packing(quenched(64, 0.9), elastic("hertz", 1e-12))
    shift = eigenproblem.symmetric_shift()
    interval = spectrum_slicing.SpectralSlice(1.07e-12, 6.9e-12, 13)
    values, vectors = naive_failures.eigenpairs_near(shift, 4e-12, 112, 16)
    inside = (values > interval.low) & (values < interval.high)
    assert residual(eigenproblem, values[inside], vectors[:, inside]) > 1e-6
    found = slice_eigenpairs.eigenpairs_in_slice(shift, interval)
    assert residual(eigenproblem, *found) < 1e-13
    np.testing.assert_allclose(found.vectors.T @ found.vectors, np.eye(13), atol=1e-12)


def residual(eigenproblem, values, vectors) -> float:
    """Largest ‖J R − λ R‖."""
    return float(np.linalg.norm(eigenproblem.matrix @ vectors - vectors * values, axis=0).max())


def test_rotations_below_the_lowest_safe_edge_are_counted_as_zero_modes():
    eigenproblem = Eigenproblem.from_packing(SMALL, elastic("hertz", 1e-16))
    lapack = dense.eigenvalues(eigenproblem)
    assert np.count_nonzero(lapack < 0.0) > 2
    found = full_spectrum(eigenproblem, choices=SLICING).eigenvalue
    assert np.count_nonzero(found == 0.0) == 2 + 16
    np.testing.assert_allclose(found[18:], lapack[18:], rtol=1e-10)


@pytest.mark.parametrize("kt", [1e-16, 1e-12, 1e-10])
def test_rotations_of_a_step_have_a_limit(kt):
    """A pseudo-inverse cuts soft rotations off; as k_T → 0 they go to those of any small k_T."""
    interaction = elastic("hertz", kt)
    limit = rigidity(SMALL, elastic("hertz", 1e-7)).loaded.displacement
    found = rigidity(SMALL, interaction).loaded
    eigenproblem = Eigenproblem.from_packing(SMALL, interaction)
    cut = np.linalg.pinv(eigenproblem.matrix.toarray(), rcond=1e-8, hermitian=True)
    spins = (cut @ (eigenproblem.matrix @ found.displacement.ravel()))[2::3]
    assert np.abs(limit[:, 2]).max() > 0.9 and np.abs(spins).max() < 1e-8
    np.testing.assert_allclose(found.displacement, limit, atol=1e-5)


@pytest.mark.parametrize("name", [MINIMAL[0], ELASTIC[3]])
def test_g_without_friction_needs_no_rotation(name):
    """3N rows with k_T = 0 have N zero modes; without rotation there are 2N rows and none."""
    packing, law = reference(name)[1], ContactLaw("hertz", "elastic", 0.0)
    pairs = pairs_of(packing)
    matrix = naive.jacobian(law, pairs, packing.n)
    with pytest.raises(np.linalg.LinAlgError):
        np.linalg.solve(matrix[2:, 2:], np.ones(3 * packing.n - 2))
    found = rigidity(packing, elastic("hertz", 0.0)).unloaded.g
    expected = np.add(*naive.moduli(law, pairs, packing.n, packing.box_length, False))[0, 1]
    assert found == pytest.approx(expected, rel=1e-10)
    for kt in (1e-16, 1e-12):
        weak = rigidity(packing, elastic("hertz", kt)).unloaded.g
        assert weak == pytest.approx(found, rel=1e-9)


@pytest.mark.parametrize("overlap", [2.0**-30, 2.0**-44])
def test_a_contact_about_to_open_has_an_exact_stiffness(overlap):
    """Hertz: ∂f_T/∂ξ = −k_T s / (2 ξ^(1/2)); a difference over h > ξ steps over the opening."""
    law, one, zero = ContactLaw("hertz", "elastic", 0.3), np.ones(1, int), np.zeros(1, int)
    pair = naive.Pair(1, 0, np.array([1.0 - overlap, 0.0]), 1.0, 0.1)
    contact = Contacts(
        one,
        zero,
        np.array([[1.0, 0.0]]),
        np.array([1.0 - overlap]),
        np.array([overlap]),
        np.array([pair.slip]),
    )
    found = stiffness_of(contact, elastic("hertz", law.kt))[0]
    assert found[2, 0] == pytest.approx(0.5 * law.kt * pair.slip / np.sqrt(overlap), rel=1e-12)
    np.testing.assert_allclose(found, naive.contact_stiffness(law, pair), rtol=1e-12, atol=1e-12)
    steps = 1e-5 * np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    with np.errstate(invalid="ignore"):
        ahead, behind = (naive.pair_force(law, naive.moved(law, pair, step)) for step in steps)
    assert not np.allclose((ahead - behind) / 2e-5, found[:, 0], rtol=0.1)
