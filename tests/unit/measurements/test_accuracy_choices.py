"""A tiny measurement of each numerical choice of packings, spectra, ensembles and kernels."""

from dataclasses import replace

import numpy as np
import pytest

import exact
from example_packings import quenched
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import net_force
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.spectrum import Eigenproblem, dense
from measurements.accuracy import (
    compression_step,
    frictional_compression,
    kernel_polynomial,
    loops,
    precision,
    spectrum,
)
from measurements.accuracy import seeds as seeds_module
from measurements.accuracy.diagram import ProcessResult, Size
from measurements.accuracy.refined_modes import refined_eigenpairs

COARSE_STEPS = Compression(phi_step=1e-2)


def errors_of(rows) -> dict[tuple[str, float], float]:
    """(curve, setting) → error."""
    return {(row.curve, row.setting): row.error for row in rows}


@pytest.fixture(autouse=True)
def here(monkeypatch):
    """Nothing is measured in a process of its own, nor more than once."""
    for module in (compression_step, frictional_compression, precision, seeds_module, spectrum):
        monkeypatch.setattr(
            module, "in_fresh_process", lambda find, *given: ProcessResult(find(*given), 0.0, 1.0)
        )
    monkeypatch.setattr(spectrum, "MIN_CPU_SECONDS", 0.0)


def problem_at(kt: float, n: int = 16):
    """The eigenproblem of a small packing."""
    return Eigenproblem.from_packing(quenched(n, 0.9), Interaction.from_law(ContactLaw(kt=kt)))


def test_a_coarse_compression_jams_at_a_lower_grid_point(monkeypatch):
    monkeypatch.setattr(compression_step, "STEPS", (0.03, 1e-4))
    monkeypatch.setattr(compression_step, "BALANCES", (Compression().intermediate_balance,))
    monkeypatch.setattr(compression_step, "REFERENCE", Compression(phi_step=5e-5))
    rows = list(compression_step.measure(Size((16,), 4)))
    error, curve = errors_of(rows), "b = 0.001, {}".format
    for name in (r"mean $\phi_J$", r"KS of $\phi_J$"):
        assert error[curve(name), 1e-4] < 0.5 * error[curve(name), 0.03]
    assert error[curve(r"mean $\phi_J$"), 1e-4] < 0.05
    assert {row.setting for row in rows if row.default} == {1e-4}
    assert {(row.samples, row.failed) for row in rows} == {(4, 0)}


def test_only_friction_that_is_cut_off_makes_another_ensemble(monkeypatch):
    """The reference is the default here, so that the default is off by nothing."""
    module = frictional_compression
    monkeypatch.setattr(module, "DEFAULT", replace(module.DEFAULT, compression=COARSE_STEPS))
    monkeypatch.setattr(module, "REFERENCE", module.DEFAULT)
    monkeypatch.setattr(module, "SETTINGS", {"n": ("choices", "max_steps", (20, 20_000))})
    rows = list(module.measure(Size((16,), 4)))
    error = errors_of(rows)
    assert error["n, P", 20_000] == 0.0 < error["n, P", 20]
    assert {row.setting for row in rows if row.default} == {20_000}
    assert {row.curve for row in rows} == {f"n, {name}" for name in module.QUANTITIES}


def test_a_compression_that_fails_is_counted(monkeypatch):
    monkeypatch.setattr(compression_step, "STEPS", (0.03,))
    monkeypatch.setattr(compression_step, "BALANCES", (1e-3,))
    monkeypatch.setattr(compression_step, "REFERENCE", Compression(max_iterations=10))
    rows = list(compression_step.measure(Size((16,), 2)))
    assert {(row.samples, row.failed) for row in rows} == {(0, 2)}
    assert all(np.isnan(row.error) for row in rows)


def test_shift_and_share_of_known_samples():
    before = np.array([1.0, 2.0, 3.0, 4.0])
    shift, error = compression_step.shift_of_mean(np.array([1.5, 2.5, 3.5, 4.7]), before)
    assert shift == pytest.approx(np.hypot(0.55, 0.05) / before.std(ddof=1))
    assert error == pytest.approx(0.05 / before.std(ddof=1))
    one, _ = compression_step.shift_of_one(np.array([0.5, 2.4, 2.6, 9.0]), before)
    assert one == pytest.approx(0.45 / before.std(ddof=1))
    other = compression_step.other_packings(np.array([1.0, 2.0, 3.001, 4.0]), before)
    assert other == (0.25, pytest.approx(0.1875**0.5 / 2))


@pytest.mark.parametrize("kt", [1e-8, 1.0])
def test_the_reference_eigenvalues_are_right_to_rounding(kt):
    eigenproblem = problem_at(kt)
    values, _ = refined_eigenpairs(eigenproblem)
    matrix = eigenproblem.matrix.toarray()
    for rank in (2, 3, eigenproblem.size // 3, eigenproblem.size - 1):
        assert exact.count_below(matrix, values[rank] * (1.0 - 4e-16)) == rank
        assert exact.count_below(matrix, values[rank] * (1.0 + 4e-16)) == rank + 1


def test_the_reference_eigenvectors_are_sharper_than_those_of_lapack():
    eigenproblem = problem_at(1e-8)
    assert mixing(eigenproblem, dense.eigenpairs(eigenproblem)[1]) > 1e-9
    vectors = refined_eigenpairs(eigenproblem)[1]
    assert mixing(eigenproblem, vectors) < 1e-12
    assert np.abs(vectors.T @ vectors - np.eye(eigenproblem.size)).max() < 1e-13


def mixing(eigenproblem, vectors: np.ndarray) -> float:
    """Largest part of another mode in a vector, translations left out; in extended precision."""
    exact_vectors = vectors[:, 2:].astype(np.longdouble)
    product = exact_vectors.T @ (eigenproblem.matrix.astype(np.longdouble) @ exact_vectors)
    values = np.diag(product)
    overlap = exact_vectors.T @ exact_vectors
    gap = values[None, :] - values[:, None] + np.eye(len(values))
    wrong = (product - overlap * values) / gap
    return float(np.abs(wrong - np.diag(np.diag(wrong))).max())


def test_moments_of_a_kernel_polynomial_count_modes():
    eigenproblem = problem_at(1.0, 64)
    mu = kernel_polynomial.moments(eigenproblem, 400)
    ends = kernel_polynomial.below(mu.all, mu, np.array([mu.low, mu.high]))
    assert ends == pytest.approx([0.0, eigenproblem.size], abs=1e-6)
    assert mu.rotational[0] == pytest.approx(eigenproblem.size / 3)
    edges = np.linspace(0.2, 2.0, 5)
    counted = np.linalg.eigvalsh(eigenproblem.matrix.toarray()).searchsorted(edges)
    assert (
        np.abs(kernel_polynomial.below(mu.all, mu, edges) - counted).max()
        < 0.02 * eigenproblem.size
    )


def test_methods_for_spectra():
    rows = list(spectrum.measure(Size((64,), 1)))
    error = errors_of(rows)
    of_density = {name: e for name, e in error.items() if name[0].endswith(r"$D(\omega)$")}
    modes = next(setting for curve, setting in error if curve == "slicing, $D(\\omega)$")
    assert error["slicing, $D(\\omega)$", modes] < 1e-12
    assert 1e-12 < error["dense symmetric, $D(\\omega)$", modes] < 1e-7
    assert error["dense general, $\\psi^R$", modes] < 1e-12
    assert error["counts, $D(\\omega)$", 2.0] < 0.1 * error["counts, $D(\\omega)$", 0.02]
    assert (
        error["counted twice, $\\psi^R$", 8]
        < 0.02
        < 0.1
        < min(e for (curve, _), e in of_density.items() if curve.startswith("kernel"))
    )
    assert {row.curve for row in rows if row.default} == {
        "dense symmetric, $D(\\omega)$",
        "dense symmetric, $\\psi^R$",
    }


def test_errors_of_means_fall_as_the_root_of_the_seeds_and_are_those_stated():
    draws = np.random.default_rng(0).normal(2.0, 0.1, (4096, 3))
    for seeds in (4, 64):
        for error, own in np.concatenate(seeds_module.errors_of_means(draws, seeds)):
            assert error == pytest.approx(0.05 / np.sqrt(seeds), abs=4.0 * own)
            assert own < 0.2 * error
    far = draws + 0.1 * np.repeat(np.arange(64), 64)[:, None]
    found, stated = seeds_module.errors_of_means(far, 64)
    assert (found > 5.0 * stated).all()


def test_seeds():
    rows = list(seeds_module.measure(Size((16,), 32)))
    assert [row.setting for row in rows if row.curve == "stated, G"] == [2, 4, 8]
    assert {row.setting for row in rows if row.default} == {8}
    assert {(row.samples, row.failed) for row in rows} == {(32, 0)}
    error = errors_of(rows)
    for name in ("found", "stated"):
        assert 0.0 < error[rf"{name}, $D(\omega)$", 8] < 0.8 * error[rf"{name}, $D(\omega)$", 2]


def test_forces_in_extended_precision_are_the_forces():
    beside = quenched(16, 0.9).displaced(np.random.default_rng(0).normal(0.0, 1e-3, (16, 2)))
    double = net_force(beside, precision.SMOOTH)
    assert 0.0 < np.abs(loops.exact_forces(beside) - double).max() < 1e-15


def test_precisions(monkeypatch):
    monkeypatch.setattr(precision, "N_STEPS", 60_000)
    rows = list(precision.measure(Size((16,), 1)))
    error = errors_of(rows)
    for what in ("FIRE, forces", "FIRE, max|F|", "dynamics, max|F|"):
        assert error[what, 53] < 1e-3 * error[what, 24]
    assert error["FIRE, forces", 53] < 1e-13 < 1e-7 < error["FIRE, forces", 24]
    mixed = error["FIRE with double overlaps, forces", 24]
    assert 1e-9 < mixed < 0.2 * error["FIRE, forces", 24]
    assert {row.setting for row in rows if row.default} == {53}
