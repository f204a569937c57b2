"""J on both sides of Coulomb's threshold, and its complex pairs."""

from dataclasses import replace

import numpy as np
import pytest

from example_packings import LAWS, SHEARED, crowd, keeping, law_name, reference, smoothed_coulomb
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import forces_on_i, sliding
from grainmodes.packing.jacobian import jacobian, stiffness_of
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.protocols.shear.coulomb_threshold import (
    SLIPPING,
    STICKING,
    beside_threshold,
    fastest_mode,
    fastest_pair,
    slipping_contacts,
)
from grainmodes.relaxation.newton import apply_slip
from grainmodes.response.stability import count_complex_pairs

SHARP = [law for law in LAWS if law.tangential.startswith("sharp")]


def half_slipped(law: ContactLaw) -> Packing:
    """A packing with contacts some of which the law has cut."""
    return apply_slip(keeping(law, crowd(91, slip=2.5)), Interaction.from_law(law))


@pytest.mark.parametrize("law", SHARP, ids=law_name)
def test_only_springs_at_their_threshold_have_two_sides(law):
    interaction, contacts = Interaction.from_law(law), half_slipped(law).contacts
    at = slipping_contacts(contacts, interaction)
    assert 0 < at.sum() < len(at)
    slips, sticks = (
        stiffness_of(beside_threshold(contacts, side), interaction) for side in (SLIPPING, STICKING)
    )
    apart = np.abs(slips - sticks).max(axis=(1, 2))
    assert apart[~at].max() < 1e-7 < 1e-2 < apart[at].min()
    np.testing.assert_array_equal(slips[at, 2, 2], 0.0)
    assert np.all(sticks[at, 2, 2] < 0.0)


@pytest.mark.parametrize("law", SHARP, ids=law_name)
def test_contacts_slide_whose_tangential_force_is_coulombs(law):
    interaction, contacts = Interaction.from_law(law), half_slipped(law).contacts
    force = forces_on_i(contacts, interaction)[:, :2]
    normal, tangential = (
        np.abs(np.einsum("ca,ca->c", force, axis)) for axis in (contacts.normal, contacts.tangent)
    )
    at = tangential >= (1.0 - 1e-9) * law.friction_coefficient * normal
    assert 0 < at.sum() < len(at)
    np.testing.assert_array_equal(sliding(contacts, interaction), at)


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_forces_are_the_same_on_both_sides(law):
    interaction, contacts = Interaction.from_law(law), half_slipped(law).contacts
    whole = forces_on_i(contacts, interaction)
    for side in (SLIPPING, STICKING):
        beside = forces_on_i(beside_threshold(contacts, side), interaction)
        np.testing.assert_allclose(beside, whole, atol=1e-8)


def unstable():
    """The sheared state of the independent code, which has pairs."""
    data, packing = reference(SHEARED)
    return packing, Interaction.from_law(smoothed_coulomb(data))


def test_pairs_are_those_of_the_whole_matrix():
    packing, interaction = unstable()
    found = fastest_pair(packing, interaction, SLIPPING)
    assert found.pairs == count_complex_pairs(packing, interaction) > 0
    root = complex(found.frequency, found.growth_rate)
    assert root**2 == pytest.approx(found.eigenvalue, rel=1e-12)


def test_the_growing_mode_is_an_eigenvector():
    packing, interaction = unstable()
    value = fastest_pair(packing, interaction, SLIPPING).eigenvalue
    u = fastest_mode(packing, interaction, SLIPPING)
    off = (jacobian(packing, interaction) @ u.ravel()).reshape(u.shape)
    off = off / generalized_mass(packing.mass) - value * u
    assert np.abs(u).max() == pytest.approx(1.0)
    assert np.abs(off).max() < 1e-7


def test_without_history_nothing_oscillates():
    packing, interaction = unstable()
    still = replace(packing, history=None)
    found = fastest_pair(still, interaction, SLIPPING)
    assert (found.pairs, found.growth_rate, found.frequency) == (0, 0.0, 0.0)
