"""Forces are the slopes of the energies that contacts store."""

import numpy as np
import pytest

import naive
from example_packings import FRICTIONLESS, LAWS, crowd, law_name
from grainmodes.kernels.energies import contact_energies
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.forces import energy, forces_on_i

OVERLAPS = np.array([1e-6, 0.01, 0.1, 0.3])
STEP = 1e-6


def slope(interaction, overlap, displacement, by):
    """Central difference of the energy by the overlap (0) or the displacement (1)."""
    shift = STEP * np.array([overlap, np.maximum(np.abs(displacement), overlap)])[by]
    there = [overlap + shift * (by == 0), displacement + shift * (by == 1)]
    back = [overlap - shift * (by == 0), displacement - shift * (by == 1)]
    return (contact_energies(interaction, *there) - contact_energies(interaction, *back)) / (
        2.0 * shift
    )


def forces(interaction, overlap, displacement):
    """f_N and f_T of contacts along x."""
    size = len(overlap)
    along = np.tile([1.0, 0.0], (size, 1))
    nothing = np.zeros(size, np.int32)
    contacts = Contacts(nothing, nothing, along, np.ones(size), overlap, displacement)
    on_i = forces_on_i(contacts, interaction)
    return on_i[:, 0], on_i[:, 2] if on_i.shape[1] == 3 else np.zeros(size)


@pytest.mark.parametrize("law", [*FRICTIONLESS, *LAWS], ids=law_name)
def test_the_normal_force_is_the_slope_by_the_overlap(law):
    interaction = Interaction.from_law(law)
    f_n, _ = forces(interaction, OVERLAPS, np.zeros(4))
    np.testing.assert_allclose(slope(interaction, OVERLAPS, np.zeros(4), by=0), f_n, rtol=1e-8)


@pytest.mark.parametrize("part", [-3.0, -0.4, 0.9, 3.0])
@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_the_tangential_force_is_the_slope_by_the_displacement(law, part):
    """Beyond the threshold too, but for sharp Coulomb, whose spring is never longer."""
    if law.tangential.startswith("sharp_coulomb") and abs(part) > 1.0:
        return
    interaction, s = Interaction.from_law(law), part * OVERLAPS
    if law.friction_coefficient:
        s = part * naive.threshold(law, OVERLAPS)
    _, f_t = forces(interaction, OVERLAPS, s)
    by_displacement = naive.remembered(law, OVERLAPS, 1.0) * slope(interaction, OVERLAPS, s, by=1)
    np.testing.assert_allclose(by_displacement, -f_t, rtol=1e-6)


def test_the_energy_of_a_packing_is_that_of_its_contacts():
    packing, interaction = crowd(2, slip=0.2), Interaction.from_law(LAWS[0])
    contacts = packing.contacts
    one_by_one = [
        contact_energies(interaction, contacts.overlap[c : c + 1], contacts.springs[c : c + 1])[0]
        for c in range(len(contacts.i))
    ]
    assert energy(packing, interaction) == pytest.approx(sum(one_by_one), rel=1e-14)
