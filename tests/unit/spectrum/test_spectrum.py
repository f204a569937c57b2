"""Spectra against the reference files and against what an eigenpair must be."""

import numpy as np
import pytest

import naive
from example_packings import (
    ELASTIC,
    KTS,
    MINIMAL,
    SHEARED,
    contacts_and_pairs,
    elastic,
    every_kt_once,
    reference,
    smoothed_coulomb,
)
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.spectrum import packing_spectrum
from grainmodes.spectrum.measures import participation_ratio, rotational_fraction

GAP = 1e-6
"""Relative gap to both neighbours above which the direction of a mode is well defined."""


@pytest.mark.parametrize(("name", "kt"), every_kt_once(KTS))
def test_reference_eigenvalues_and_rotational_fractions(name, kt):
    data, packing = reference(name)
    data, found = data.sel(kt=kt), packing_spectrum(packing, elastic(name, kt))
    np.testing.assert_allclose(found.eigenvalue, data["eigenvalue"], rtol=0, atol=1e-10)
    apart = isolated(found.eigenvalue)
    assert apart.mean() > 0.9
    difference = (found.psi_rotational - data["psi_rotational"].values)[apart]
    assert np.abs(difference).max() < 1e-8


def isolated(values: np.ndarray) -> np.ndarray:
    """Modes whose eigenvalue lies apart from its neighbours', and from rounding."""
    gaps = np.diff(values, prepend=-np.inf, append=np.inf)
    nearest = np.minimum(gaps[:-1], gaps[1:])
    return nearest > GAP * np.maximum(np.abs(values), 1e-12 / GAP)


def test_sheared_reference_eigenvalues():
    data, packing = reference(SHEARED)
    matrix = jacobian(packing, Interaction.from_law(smoothed_coulomb(data)))
    inverse_inertia = np.tile([1.0, 1.0, 2.0], packing.n)
    found = np.linalg.eigvals(inverse_inertia[:, None] * matrix.toarray())
    real, imag = (data[f"dynamical_eigenvalue_{part}"].values for part in ("real", "imag"))
    assert np.abs(sorted_pairs(found) - sorted_pairs(real + 1j * imag)).max() < 1e-10


def sorted_pairs(values: np.ndarray) -> np.ndarray:
    """Ordered by real part, conjugate pairs by the sign of the imaginary part."""
    return values[np.lexsort((values.imag, np.round(values.real, 10)))]


def test_slip_makes_a_general_spectrum():
    data, packing = reference(SHEARED)
    interaction = Interaction.from_law(smoothed_coulomb(data))
    found, alone = (
        packing_spectrum(packing, interaction),
        packing_spectrum(packing, interaction, modes=False),
    )
    matrix = jacobian(packing, interaction).toarray()
    assert found.residual < 1e-13
    np.testing.assert_allclose(matrix @ found.modes, found.modes * found.eigenvalue, atol=1e-13)
    np.testing.assert_allclose(
        sorted_pairs(found.eigenvalue + 0j), sorted_pairs(alone.eigenvalue + 0j), atol=1e-10
    )
    assert found.eigenvalue.sum().real == pytest.approx(np.trace(matrix), rel=1e-12)
    assert np.all(np.diff(found.eigenvalue.real) >= 0)


@pytest.mark.parametrize("kt", [0.0, 1e-8, 1.0])
@pytest.mark.parametrize("name", MINIMAL)
def test_every_mode_by_a_directional_difference_of_the_slow_forces(name, kt):
    packing, law = reference(name)[1], ContactLaw(name.split("_")[0], "elastic", kt)
    found = packing_spectrum(packing, Interaction.from_law(law))
    pairs = contacts_and_pairs(packing)[1]
    for value, mode in zip(found.eigenvalue, found.modes.T, strict=True):
        u = np.zeros((packing.n, 3))
        u[:, : 3 if kt else 2] = mode.reshape(packing.n, -1)
        step = naive.COMPLEX_STEP
        ahead = naive.all_moved(law, pairs, 1j * step * u)
        slope = naive.net_force(law, ahead, packing.n).imag / step
        np.testing.assert_allclose(-slope, value * u, atol=1e-13)


@pytest.mark.parametrize("kt", [0.0, 1e-4, 1.0])
def test_modes_are_orthonormal_and_fractions_are_theirs(kt):
    packing = reference(ELASTIC[3])[1]
    found = packing_spectrum(packing, elastic("hertz", kt))
    size = (3 if kt else 2) * packing.n
    np.testing.assert_allclose(found.modes.T @ found.modes, np.eye(size), atol=1e-13)
    weight = found.modes.reshape(packing.n, -1, size) ** 2
    by_grain = weight.sum(axis=1)
    p = [1.0 / (packing.n * np.sum(w**2)) for w in by_grain.T]
    np.testing.assert_allclose(found.participation_ratio, p, rtol=1e-12)
    rotation = weight[:, 2].sum(axis=0) if kt else np.zeros(size)
    np.testing.assert_allclose(found.psi_rotational, rotation, rtol=1e-12)


def test_eigenvalues_alone_are_the_same_and_nothing_else():
    packing, interaction = reference(MINIMAL[0])[1], elastic("hertz", 0.1)
    alone, full = (
        packing_spectrum(packing, interaction, modes=False),
        packing_spectrum(packing, interaction),
    )
    np.testing.assert_allclose(alone.eigenvalue, full.eigenvalue, atol=1e-14)
    nothing = (alone.psi_rotational, alone.participation_ratio, alone.residual, alone.modes)
    assert nothing == (None,) * 4


def test_rattlers_are_left_out_unless_requested():
    position = [[1.0, 1.0], [1.95, 1.0], [1.475, 1.8], [5.0, 5.0], [5.0, 2.0]]
    packing = Packing.from_positions(position, np.ones(5), 8.0)
    interaction = elastic("hertz", 0.5)
    assert len(packing_spectrum(packing, interaction, threshold=1).eigenvalue) == 9
    kept = packing_spectrum(packing, interaction, threshold=1, keep_rattlers=True)
    assert len(kept.eigenvalue) == 15
    assert np.sum(kept.eigenvalue == 0.0) == 6
    assert len(packing_spectrum(packing, interaction, threshold=2).eigenvalue) == 0


def test_participation_of_one_grain_and_of_all():
    one, every = np.zeros((10, 3, 1)), np.full((10, 3, 1), 1 / 30)
    one[4, 2] = 1.0
    assert participation_ratio(one) == pytest.approx(0.1)
    assert participation_ratio(every) == pytest.approx(1.0)
    assert rotational_fraction(one) == 1.0
    assert rotational_fraction(every) == pytest.approx(1 / 3)
    assert rotational_fraction(one[:, :2]) == 0.0


def test_the_grain_that_moves_most_is_named_by_both_methods():
    packing, interaction = (
        reference("hertz_n64_phi0.900_seed1")[1],
        elastic("hertz_n64_phi0.900_seed1", 1e-4),
    )
    dense = packing_spectrum(packing, interaction)
    sliced = packing_spectrum(packing, interaction, choices=SpectrumChoices(method="slicing"))
    grains = np.abs(dense.modes.reshape(-1, 3, len(dense.eigenvalue))) ** 2
    expected = grains.sum(axis=1).argmax(axis=0)
    np.testing.assert_array_equal(dense.peak_grain, expected)
    np.testing.assert_array_equal(sliced.peak_grain[2:], expected[2:])
