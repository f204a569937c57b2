"""Net forces and stresses against the slow twins, for every law, with and without slip."""

import numpy as np
import pytest

import naive
from example_packings import (
    ELASTIC,
    FRICTIONLESS,
    LAWS,
    SHEARED,
    crowd,
    elastic,
    law_name,
    pairs_of,
    reference,
    smoothed_coulomb,
)
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import (
    forces_on_i,
    is_frictionless,
    max_force_and_torque,
    mean_contact_force,
    net_force,
    stress,
)
from grainmodes.packing.state import Packing


@pytest.mark.parametrize(("slip", "strain"), [(0.0, -0.5), (0.5, 0.0), (3.0, 0.3)])
@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_net_force_and_stress_are_those_of_the_slow_twin(law, slip, strain):
    packing = crowd(11, strain=strain, slip=slip)
    pairs = pairs_of(packing)
    force = net_force(packing, Interaction.from_law(law))
    np.testing.assert_allclose(force, naive.net_force(law, pairs, packing.n), atol=1e-14)
    np.testing.assert_allclose(
        stress(packing, Interaction.from_law(law)),
        naive.stress(law, pairs, packing.box_length),
        atol=1e-15,
    )


@pytest.mark.parametrize("law", FRICTIONLESS, ids=law_name)
def test_without_friction_there_is_no_torque(law):
    packing = crowd(11, strain=0.3)
    pairs = pairs_of(packing)
    force = net_force(packing, Interaction.from_law(law))
    assert force.shape == (packing.n, 2)
    twin = naive.net_force(law, pairs, packing.n)
    np.testing.assert_allclose(force, twin[:, :2], atol=1e-14)
    assert max_force_and_torque(force)[1] == 0.0
    assert is_frictionless(Interaction.from_law(law))


@pytest.mark.parametrize("law", LAWS + FRICTIONLESS, ids=law_name)
def test_forces_cancel_in_the_sum(law):
    packing = crowd(8, strain=-0.2, slip=0.7)
    force = net_force(packing, Interaction.from_law(law))
    np.testing.assert_allclose(force[:, :2].sum(axis=0), 0.0, atol=1e-14)


def test_torque_of_a_sliding_pair_has_one_sign():
    packing = crowd(8, slip=0.5)
    contacts = packing.contacts
    interaction = Interaction.from_law(LAWS[0])
    on_i = forces_on_i(contacts, interaction)
    np.testing.assert_allclose(
        on_i[:, 2], np.sum(on_i[:, :2] * contacts.tangent, axis=1), atol=1e-15
    )
    assert np.all(on_i[:, 2] * contacts.springs < 0.0)
    total = net_force(packing, interaction)[:, 2]
    assert total.sum() == pytest.approx(2.0 * on_i[:, 2].sum(), abs=1e-14)


@pytest.mark.parametrize("name", ELASTIC)
def test_friction_switched_on_in_a_balance_changes_nothing(name):
    data, packing = reference(name)
    without = net_force(packing, elastic(name, 0.0))
    for kt in data.kt.values:
        with_friction = net_force(packing, elastic(name, kt))
        np.testing.assert_array_equal(with_friction[:, :2], without)
        assert max_force_and_torque(with_friction)[1] == 0.0
    assert max_force_and_torque(without)[0] < 1.5e-14


def test_sheared_reference_is_in_balance_and_has_its_stress():
    data, packing = reference(SHEARED)
    interaction = Interaction.from_law(smoothed_coulomb(data))
    assert max(max_force_and_torque(net_force(packing, interaction))) < 5e-15
    sigma = stress(packing, interaction)
    expected = [data.sigma_xy, data.sigma_yx, data.sigma_yy]
    np.testing.assert_allclose([sigma[0, 1], sigma[1, 0], sigma[1, 1]], expected, rtol=1e-10)


def test_mean_force_and_largest_force():
    position = [[1.0, 1.0], [1.91, 1.0], [4.0, 4.0], [4.0, 4.96]]
    packing = Packing.from_positions(position, np.ones(4), 8.0)
    interaction = elastic("harmonic", 0.0)
    assert mean_contact_force(packing, interaction) == pytest.approx((0.09 + 0.04) / 2)
    assert max_force_and_torque(net_force(packing, interaction)) == (pytest.approx(0.09), 0.0)
    alone = Packing.from_positions(position[1:3], np.ones(2), 8.0)
    assert mean_contact_force(alone, interaction) == 0.0
    assert max_force_and_torque(np.zeros((0, 3))) == (0.0, 0.0)
    assert max_force_and_torque(np.array([[0.1, -0.3, 0.2], [0.2, 0.0, -0.5]])) == (0.3, 0.5)
