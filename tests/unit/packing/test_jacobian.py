"""J against central differences of the slow forces: every law, s of every size, every boundary."""

from dataclasses import replace

import numpy as np
import pytest

import naive
from example_packings import (
    ELASTIC,
    FRICTIONLESS,
    LAWS,
    SHEARED,
    contacts_and_pairs,
    crowd,
    elastic,
    keeping,
    law_name,
    reference,
    smoothed_coulomb,
)
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import History
from grainmodes.packing.jacobian import assemble, jacobian, stiffness_of
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw

STRAINS = (-0.5, -0.3, 0.0, 0.3, 0.5)
COULOMB = [law for law in LAWS if law.friction_coefficient]


def dense(packing: Packing, law) -> np.ndarray:
    return jacobian(packing, Interaction.from_law(law)).toarray()


def close(matrix: np.ndarray, twin: np.ndarray, accuracy: float) -> None:
    """Equal to `accuracy`, relative to each entry, and to the largest one where it is small."""
    np.testing.assert_allclose(matrix, twin, rtol=accuracy, atol=accuracy * np.abs(twin).max())


def crosses_the_boundary(packing: Packing, pairs) -> bool:
    direct = [packing.position[p.i] - packing.position[p.j] for p in pairs]
    hops = np.array([p.branch - d for p, d in zip(pairs, direct, strict=True)])
    return bool(np.any(np.abs(hops[:, 1]) > 1.0) and np.any(np.abs(hops[:, 0]) > 1.0))


@pytest.mark.parametrize("slip", [0.0, 0.5])
@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_every_law_against_central_differences(law, slip):
    strain = STRAINS[LAWS.index(law) % len(STRAINS)]
    packing = keeping(law, crowd(21, strain=strain, slip=slip))
    pairs = contacts_and_pairs(packing)[1]
    assert crosses_the_boundary(packing, pairs)
    close(dense(packing, law), naive.central_jacobian(law, pairs, packing.n), 1e-8)


@pytest.mark.parametrize("law", FRICTIONLESS, ids=law_name)
@pytest.mark.parametrize("strain", [-0.5, 0.3])
def test_frictionless_against_central_differences(law, strain):
    packing = crowd(22, strain=strain)
    twin = naive.central_jacobian(law, contacts_and_pairs(packing)[1], packing.n)
    blocks = twin.reshape(packing.n, 3, packing.n, 3)
    assert np.all(blocks[:, 2] == 0.0) and np.all(blocks[:, :, :, 2] == 0.0)
    twin = blocks[:, :2, :, :2].reshape(2 * packing.n, -1)
    close(dense(packing, law), twin, 1e-8)


@pytest.mark.parametrize("ratio", [0.98, 1.02, -0.98, -1.02])
@pytest.mark.parametrize("law", COULOMB, ids=law_name)
def test_both_sides_of_the_coulomb_threshold(law, ratio):
    packing = crowd(23, strain=0.3)
    contacts = packing.contacts
    s = ratio * naive.threshold(law, contacts.overlap)
    packing = replace(packing, history=History(contacts.i, contacts.j, s))
    pairs = contacts_and_pairs(packing)[1]
    close(dense(packing, law), naive.central_jacobian(law, pairs, packing.n), 1e-8)


@pytest.mark.parametrize("slip", [0.0, 0.5, 3.0])
@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_every_law_against_complex_steps(law, slip):
    packing = keeping(law, crowd(24, strain=-0.3, slip=slip))
    twin = naive.jacobian(law, contacts_and_pairs(packing)[1], packing.n)
    close(dense(packing, law), twin, 1e-13)


def test_the_slow_twins_agree():
    packing = crowd(25, strain=0.2, slip=0.5)
    pairs = contacts_and_pairs(packing)[1]
    exact = naive.jacobian(LAWS[1], pairs, packing.n)
    close(naive.central_jacobian(LAWS[1], pairs, packing.n), exact, 1e-9)


@pytest.mark.parametrize(
    ("name", "kt"), list(zip(ELASTIC[:4], (1e-8, 1e-2, 10.0, 1e-8), strict=True))
)
def test_reference_packings_against_complex_steps(name, kt):
    packing = reference(name)[1]
    law = ContactLaw(name.split("_")[0], "elastic", kt)
    twin = naive.jacobian(law, contacts_and_pairs(packing)[1], packing.n)
    # Overlaps of 1e-4 amplify the rounding of a position in the square root.
    close(dense(packing, law), twin, 1e-11)


def test_sheared_reference_jacobian():
    data, packing = reference(SHEARED)
    matrix = dense(packing, smoothed_coulomb(data))
    np.testing.assert_allclose(matrix, data["jacobian"].values, rtol=0, atol=1e-12)


@pytest.mark.parametrize("law", LAWS + FRICTIONLESS, ids=law_name)
def test_symmetric_without_slip(law):
    matrix = dense(crowd(26, strain=0.3), law)
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-15)


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_not_symmetric_with_slip(law):
    matrix = dense(keeping(law, crowd(26, slip=0.5)), law)
    assert np.abs(matrix - matrix.T).max() > 1e-3


@pytest.mark.parametrize("law", LAWS, ids=law_name)
@pytest.mark.parametrize("slip", [0.0, 0.5, 3.0])
def test_translations_cost_nothing_and_no_force_is_left_over(law, slip):
    packing = keeping(law, crowd(27, strain=0.3, slip=slip))
    matrix = dense(packing, law).reshape(16, 3, 16, 3)
    for axis in (0, 1):
        np.testing.assert_allclose(matrix[:, :, :, axis].sum(axis=2), 0.0, atol=1e-13)
        np.testing.assert_allclose(matrix[:, axis].sum(axis=0), 0.0, atol=1e-13)


def test_slip_seen_only_through_the_history():
    packing = crowd(28)
    contacts = packing.contacts
    zero = History(contacts.i, contacts.j, np.zeros(len(contacts.i)))
    still = replace(packing, history=zero)
    np.testing.assert_array_equal(dense(packing, LAWS[0]), dense(still, LAWS[0]))


def test_stiffness_has_the_size_of_the_law():
    contacts = crowd(29).contacts
    size = len(contacts.i)
    assert stiffness_of(contacts, elastic("hertz", 0.0)).shape == (size, 2, 2)
    assert stiffness_of(contacts, elastic("hertz", 1e-8)).shape == (size, 3, 3)


def test_blocks_of_a_pair_go_where_they_belong():
    k = np.arange(1.0, 10.0).reshape(1, 3, 3)
    matrix = assemble(k, np.array([2]), np.array([0]), 3).toarray().reshape(3, 3, 3, 3)
    on_j = np.array([-1.0, -1.0, 1.0])
    np.testing.assert_array_equal(matrix[2, :, 2], -k[0])
    np.testing.assert_array_equal(matrix[2, :, 0], -k[0] * on_j)
    np.testing.assert_array_equal(matrix[0, :, 2], -k[0] * on_j[:, None])
    np.testing.assert_array_equal(matrix[0, :, 0], -k[0] * on_j * on_j[:, None])
    assert np.all(matrix[1] == 0.0) and np.all(matrix[:, :, 1] == 0.0)
