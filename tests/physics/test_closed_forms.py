"""Two grains and three, by hand.

Two grains a distance r apart, n = (1, 0), t = (0, −1), f = ξ^(3/2), k = k_T ξ^(1/2):

    force on i (f, k s), scaled torque −k s on both
    K = | −f'              f_T/r       0 |     f_T = −k s
        | ∂f_T/∂ξ          f/r − k     k |
        | −∂f_T/∂ξ         k          −k |

Three grains at the corners of a triangle of side r, s = 0, per degree of freedom of its symmetry:

    translations 0, 0;    breathing 3 f'
    rotation and spin     | 3 (k − f/r)   −2√3 k |
                          | −2√3 k         4 k   |
    shear and spin, twice | 3 (f' + k − f/r)/2    √(3/2) k |
                          | √(3/2) k              k        |
"""

import numpy as np
import pytest

from example_packings import elastic
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import forces_on_i, net_force
from grainmodes.packing.jacobian import jacobian, stiffness_of
from grainmodes.packing.state import Packing
from grainmodes.spectrum import packing_spectrum

R, KT, S = 0.91, 0.3, 0.02
XI = 1.0 - R
BOX = 6.0


def force(normal: str) -> tuple[float, float, float]:
    """(f, f', k) of a contact of overlap XI."""
    if normal == "hertz":
        return XI**1.5, 1.5 * XI**0.5, KT * XI**0.5
    return XI, 1.0, KT


def pair(angle: float, s: float | None = None) -> Packing:
    """Grain 1 seen from grain 0 under an angle, across both boundaries of the box."""
    one = np.array([0.02, BOX - 0.03])
    direction = np.array([np.cos(angle), np.sin(angle)])
    history = None if s is None else History(np.array([1]), np.array([0]), np.array([s]))
    return Packing.from_positions([one, one + R * direction], np.ones(2), BOX, history=history)


def turned(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def triangle(angle: float) -> Packing:
    corners = angle + 2 * np.pi / 3 * np.arange(3)
    position = R / np.sqrt(3) * np.stack([np.cos(corners), np.sin(corners)], axis=1)
    return Packing.from_positions(position, np.ones(3), BOX)


ANGLES = (0.0, 0.4, np.pi / 2, 2.5, -1.1)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_force_and_torque_of_two_grains(normal, angle):
    f, _, k = force(normal)
    packing = pair(angle, S)
    interaction, contacts = elastic(normal, KT), packing.contacts
    on_i = turned(angle) @ [f, k * S, -k * S]
    np.testing.assert_allclose(forces_on_i(contacts, interaction), [on_i], atol=1e-14)
    expected = [[-on_i[0], -on_i[1], on_i[2]], on_i]
    np.testing.assert_allclose(net_force(packing, interaction), expected, atol=1e-14)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_stiffness_of_two_grains(normal, angle):
    f, slope, k = force(normal)
    by_xi = -KT * S / (2 * XI**0.5) if normal == "hertz" else 0.0
    by_hand = np.array([[-slope, -k * S / R, 0.0], [by_xi, f / R - k, k], [-by_xi, k, -k]])
    contacts = pair(angle, S).contacts
    found = stiffness_of(contacts, elastic(normal, KT))[0]
    expected = turned(angle) @ by_hand @ turned(angle).T
    np.testing.assert_allclose(found, expected, atol=1e-13)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_spectrum_of_two_grains(normal, angle):
    f, slope, k = force(normal)
    roll = 2 * np.array([[k - f / R, -k], [-k, k]])
    by_hand = np.sort([0.0, 0.0, 0.0, 2 * slope, *np.linalg.eigvalsh(roll)])
    found = packing_spectrum(pair(angle), elastic(normal, KT), keep_rattlers=True)
    np.testing.assert_allclose(found.eigenvalue, by_hand, atol=1e-14)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_spectrum_of_a_triangle(normal, angle):
    f, slope, k = force(normal)
    spin = np.array([[3 * (k - f / R), -2 * np.sqrt(3) * k], [-2 * np.sqrt(3) * k, 4 * k]])
    coupling = np.sqrt(1.5) * k
    shear = np.array([[1.5 * (slope + k - f / R), coupling], [coupling, k]])
    doublet = np.linalg.eigvalsh(shear)
    by_hand = [0.0, 0.0, 3 * slope, *np.linalg.eigvalsh(spin), *doublet, *doublet]
    found = packing_spectrum(triangle(angle), elastic(normal, KT), threshold=1)
    np.testing.assert_allclose(found.eigenvalue, np.sort(by_hand), atol=1e-14)


@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_spectrum_of_a_frictionless_triangle(normal):
    f, slope, _ = force(normal)
    shear = 1.5 * (slope - f / R)
    found = packing_spectrum(triangle(0.3), elastic(normal, 0.0), threshold=1)
    by_hand = np.sort([0.0, 0.0, 3 * slope, -3 * f / R, shear, shear])
    np.testing.assert_allclose(found.eigenvalue, by_hand, atol=1e-14)


def test_only_friction_couples_rotation():
    packing = triangle(0.3)
    blocks = jacobian(packing, elastic("hertz", KT)).toarray()
    blocks = blocks.reshape(3, 3, 3, 3)
    bare = jacobian(packing, elastic("hertz", 0.0)).toarray()
    weak = jacobian(packing, elastic("hertz", 1e-12)).toarray()
    assert np.abs(blocks[:, 2]).max() > 0.01
    weak = weak.reshape(3, 3, 3, 3)[:, :2, :, :2].reshape(6, 6)
    np.testing.assert_allclose(weak, bare, atol=1e-11)
