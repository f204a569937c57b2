"""A crystal: rows of touching grains, every second row shifted by half a spacing.

In a square box a regular hexagonal packing does not fit; the lattice has spacing a along the rows
and b between them, 2 b/a = √3 only nearly. Contacts: one per grain along the row (r = a), two to
the row above (r = √(a²/4 + b²), n = (±a/2, b)/r). Every grain is a centre of inversion, so nothing
moves off its affine place, and only a common spin ℓ answers a loaded step:

    Σ k (t·A + 2 ℓ) = 0,   t·A = n_y y,   k = k_T w(ξ)
    g_A  = (1/ab) Σ [ f' n_x² − (f/r) n_y² + k n_y² (loaded) ] y²
    g_NA = (1/ab) Σ k n_y 2ℓ y     (loaded),  0 (unloaded)

with the sums over the three contacts of a grain. As ξ → 0 and 2b/a → √3: √3/4 (k_N + k_T) loaded,
√3/4 k_N unloaded.

Its modes are waves: the 3 × 3 matrix of wave vector q is Σ K_c (e^(−iq·r_c) diag(1, 1, −1) − 1)
over the six contacts r_c of a grain.
"""

import numpy as np
import pytest

from example_packings import crystal, elastic
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import packing_spectrum

COLUMNS, ROWS = 7, 8
KTS = (0.0, 1e-8, 1e-2, 1.0, 2.0, 10.0)


def contact(normal: str, r: float, kt: float):
    """(f, f', k) of two grains of diameter 1 at distance r."""
    xi = 1.0 - r
    return (xi**1.5, 1.5 * xi**0.5, kt * xi**0.5) if normal == "hertz" else (xi, 1.0, kt)


def moduli(normal: str, a: float, b: float, kt: float, loaded: bool) -> tuple[float, float]:
    """(g_A, g_NA) by the formulas above."""
    branches = np.array([[a, 0.0], [a / 2, b], [-a / 2, b]])
    r = np.hypot(*branches.T)
    f, slope, k = (np.array(x) for x in zip(*(contact(normal, q, kt) for q in r), strict=True))
    k = np.broadcast_to(k, 3) * loaded
    nx, ny = (branches / r[:, None]).T
    y = branches[:, 1]
    twice_spin = -np.sum(k * ny * y) / np.sum(k) if np.any(k) else 0.0
    affine = np.sum((slope * nx**2 - f / r * ny**2 + k * ny**2) * y**2)
    return affine / (a * b), np.sum(k * ny * twice_spin * y) / (a * b)


@pytest.mark.parametrize("kt", KTS)
@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_moduli_of_the_crystal(normal, kt):
    packing = crystal(COLUMNS, ROWS, 0.95)
    interaction = elastic(normal, kt)
    assert max_force_and_torque(net_force(packing, interaction))[0] < 1e-14
    a, b = packing.box_length / COLUMNS, packing.box_length / ROWS
    found = rigidity(packing, interaction)
    for moduli_found, loaded in ((found.unloaded, False), (found.loaded, True)):
        affine, nonaffine = moduli(normal, a, b, kt, loaded)
        assert moduli_found.g_affine == pytest.approx(affine, rel=1e-11)
        assert moduli_found.g_nonaffine == pytest.approx(nonaffine, rel=1e-11, abs=1e-13)


@pytest.mark.parametrize("kt", KTS)
def test_regular_lattice_of_stiff_grains(kt):
    packing = crystal(26, 30, 0.9990)
    found = rigidity(packing, elastic("harmonic", kt))
    ideal = np.sqrt(3) / 4
    assert found.unloaded.g == pytest.approx(ideal, rel=5e-3)
    assert found.loaded.g == pytest.approx(ideal * (1 + kt), rel=5e-3)


@pytest.mark.parametrize("kt", KTS[2:])
def test_loading_never_stiffens_by_relaxing(kt):
    found = rigidity(crystal(COLUMNS, ROWS, 0.95), elastic("hertz", kt))
    assert found.loaded.g_nonaffine < 0.0
    assert found.loaded.g_affine > found.loaded.g > found.unloaded.g


def test_spectrum_is_degenerate_but_has_two_translations():
    found = packing_spectrum(crystal(COLUMNS, ROWS, 0.95), elastic("hertz", 0.5))
    assert np.sum(np.abs(found.eigenvalue) < 1e-12) == 2
    assert found.eigenvalue[2] > 1e-3
    assert np.sum(np.diff(found.eigenvalue) < 1e-10) > len(found.eigenvalue) / 3
    assert found.residual < 1e-13


def wave_vectors(a: float, b: float) -> np.ndarray:
    """The wave vectors of the box, one of each class of the reciprocal lattice; (N, 2)."""
    steps = 2 * np.pi / np.array([COLUMNS * a, ROWS * b])
    p, q = np.meshgrid(np.arange(2 * COLUMNS), np.arange(ROWS // 2), indexing="ij")
    return np.stack([p, q], axis=-1).reshape(-1, 2) * steps


def wave_matrix(normal: str, a: float, b: float, kt: float, q: np.ndarray) -> np.ndarray:
    """J of a wave u_j = U e^(iq·r_j), Hermitian (3, 3)."""
    total = np.zeros((3, 3), complex)
    for branch in np.array([[a, 0.0], [a / 2, b], [-a / 2, b]]):
        for r_c in (branch, -branch):
            r = np.hypot(*r_c)
            f, slope, k = contact(normal, r, kt)
            n, t = np.append(r_c / r, 0.0), np.array([r_c[1] / r, -r_c[0] / r, 1.0])
            across = np.array([t[0], t[1], 0.0])
            stiffness = -slope * np.outer(n, n) + f / r * np.outer(across, across)
            stiffness -= k * np.outer(t, t)
            total += stiffness @ (np.exp(-1j * q @ r_c) * np.diag([1, 1, -1]) - np.eye(3))
    return total


@pytest.mark.parametrize("kt", [1e-4, 1.0])
@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_modes_of_the_crystal_are_waves(normal, kt):
    packing = crystal(COLUMNS, ROWS, 0.95)
    a, b = packing.box_length / COLUMNS, packing.box_length / ROWS
    waves = [np.linalg.eigvalsh(wave_matrix(normal, a, b, kt, q)) for q in wave_vectors(a, b)]
    found = packing_spectrum(packing, elastic(normal, kt)).eigenvalue
    np.testing.assert_allclose(found, np.sort(np.ravel(waves)), atol=1e-13)
