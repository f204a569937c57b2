"""Eigenpairs in slices: none missing, none twice, each by its residual and against LAPACK."""

import os
from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse

import exact
from example_packings import MINIMAL, elastic, kt_and_backend, quenched, reference
from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.runtime.failures import MachineError
from grainmodes.spectrum import Eigenproblem, dense, full_spectrum
from grainmodes.spectrum.slice_eigenpairs import (
    SliceError,
    eigenpairs_in_slice,
    measure_slices,
    nearest_eigenpairs,
)
from grainmodes.spectrum.spectrum_slicing import SpectralSlice, slice_spectrum

FLOOR = 1e-14


@pytest.mark.parametrize(("kt", "backend"), kt_and_backend(1e-8, 1e-4, 1.0, 10.0))
def test_slices_hold_every_mode_once(kt, backend):
    eigenproblem = Eigenproblem.from_packing(quenched(144, 0.90), elastic("hertz", kt))
    sliced = full_spectrum(eigenproblem, choices=SpectrumChoices("slicing", backend))
    whole = full_spectrum(eigenproblem, choices=SpectrumChoices("dense"))
    assert (sliced.method, sliced.factorisation) == ("slicing", backend)
    assert sliced.residual < 1e-9 * eigenproblem.bound
    np.testing.assert_allclose(sliced.eigenvalue, whole.eigenvalue, atol=2e-14)
    apart = isolated(whole.eigenvalue)
    assert apart.mean() > 0.6
    for name in ("psi_rotational", "participation_ratio"):
        one, other = (getattr(found, name)[apart] for found in (sliced, whole))
        np.testing.assert_allclose(one, other, atol=1e-7)


def isolated(values: np.ndarray) -> np.ndarray:
    """Vibrations whose direction is well defined for LAPACK."""
    gaps = np.diff(values, prepend=-np.inf, append=np.inf)
    nearest = np.minimum(gaps[:-1], gaps[1:])
    return (nearest > 1e-5 * np.abs(values)) & (nearest > 1e-9 * values.max()) & (values > FLOOR)


def test_eigenvectors_of_all_slices_are_orthonormal():
    eigenproblem = Eigenproblem.from_packing(quenched(256, 0.90), elastic("hertz", 1e-4))
    shift = SymmetricShift(eigenproblem.matrix)
    slices = slice_spectrum(shift, FLOOR, eigenproblem.bound)
    vectors = np.hstack([eigenpairs_in_slice(shift, interval).vectors for interval in slices])
    assert vectors.shape == (eigenproblem.size, eigenproblem.size - 2)
    np.testing.assert_allclose(vectors.T @ vectors, np.eye(eigenproblem.size - 2), atol=1e-9)


@pytest.mark.parametrize("kt", [1e-10, 1e-8])
def test_small_eigenvalues_keep_their_relative_accuracy(kt):
    """Exact counts at λ (1 ± 1e-10) differ by one; at k_T = 1e-10 LAPACK has an error of 1e-6."""
    eigenproblem = Eigenproblem.from_packing(reference(MINIMAL[0])[1], elastic(MINIMAL[0], kt))
    values = full_spectrum(eigenproblem, choices=SpectrumChoices("slicing")).eigenvalue
    for rank in (2, 9):
        bounds = values[rank] * (1 + np.array([-1e-10, 1e-10]))
        assert [exact.count_below(eigenproblem.matrix.toarray(), b) for b in bounds] == [
            rank,
            rank + 1,
        ]


def test_slices_do_not_depend_on_the_number_of_processes():
    eigenproblem = Eigenproblem.from_packing(quenched(256, 0.90), elastic("hertz", 1e-4))
    choices = SpectrumChoices("slicing")
    one, two = (full_spectrum(eigenproblem, choices=choices, processes=p) for p in (1, 2))
    for name in ("eigenvalue", "psi_rotational", "participation_ratio"):
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name))


def test_a_band_beside_a_gap_and_a_lonely_mode():
    values = np.concatenate([np.linspace(1.0, 1.1, 300), [2.0], np.linspace(50.0, 51.0, 40)])
    shift = SymmetricShift(sparse.csc_array(np.diag(values)))
    slices = slice_spectrum(shift, 0.5, 100.0)
    found = np.concatenate([eigenpairs_in_slice(shift, interval).values for interval in slices])
    np.testing.assert_allclose(found, values, rtol=1e-12)


def test_a_degenerate_eigenvalue_is_found_as_often_as_it_is_counted():
    values = np.concatenate([np.full(12, 1.0), np.linspace(2.0, 3.0, 50)])
    shift = SymmetricShift(sparse.csc_array(np.diag(values)))
    slices = slice_spectrum(shift, 0.5, 4.0)
    found = np.concatenate([eigenpairs_in_slice(shift, interval).values for interval in slices])
    np.testing.assert_allclose(found, values, rtol=1e-12)


def test_a_slice_with_too_high_a_count_is_refused():
    shift = SymmetricShift(sparse.csc_array(np.diag(np.arange(1.0, 40.0))))
    with pytest.raises(SliceError, match="expected 7 eigenpairs"):
        eigenpairs_in_slice(shift, SpectralSlice(1.5, 1.5 + 1e-13, 7))


def test_nearest_eigenpairs_are_those_of_lapack():
    eigenproblem = Eigenproblem.from_packing(quenched(256, 0.90), elastic("hertz", 1e-4))
    values = dense.eigenvalues(eigenproblem)
    found = nearest_eigenpairs(SymmetricShift(eigenproblem.matrix), 0.31, 10)
    expected = np.sort(values[np.argsort(np.abs(values - 0.31))[:10]])
    np.testing.assert_allclose(found.values, expected, rtol=1e-12)
    residual = eigenproblem.matrix @ found.vectors - found.vectors * found.values
    assert np.abs(residual).max() < 1e-10


def test_negative_eigenvalues_are_found_too():
    eigenproblem = Eigenproblem.from_packing(quenched(64, 0.90), elastic("hertz", 1.0))
    weak = Eigenproblem.from_packing(quenched(64, 0.90), elastic("hertz", 1e-4))
    unstable = replace(eigenproblem, matrix=(2.0 * weak.matrix - eigenproblem.matrix).tocsc())
    forces = np.random.default_rng(0).standard_normal((eigenproblem.size, 1))
    sliced, whole = (
        full_spectrum(unstable, forces=forces, choices=SpectrumChoices(method))
        for method in ("slicing", "dense")
    )
    assert np.count_nonzero(whole.eigenvalue < -0.1) > 10
    np.testing.assert_allclose(sliced.eigenvalue, whole.eigenvalue, atol=1e-13)
    apart = np.abs(whole.eigenvalue) > 1e-3
    for name in ("psi_rotational", "participation_ratio"):
        one, other = (getattr(found, name)[apart] for found in (sliced, whole))
        np.testing.assert_allclose(one, other, atol=1e-7)
    np.testing.assert_allclose(
        np.abs(sliced.projection[apart]), np.abs(whole.projection[apart]), atol=1e-6
    )


def die(values, vectors):
    os._exit(1)


def test_a_process_that_dies_fails_the_job():
    eigenproblem = Eigenproblem.from_packing(quenched(64, 0.90), elastic("hertz", 1e-4))
    slices = slice_spectrum(eigenproblem.symmetric_shift(), FLOOR, eigenproblem.bound)
    with pytest.raises(MachineError, match="killed"):
        measure_slices(eigenproblem, "superlu", slices, die, processes=2)
