"""What a tangential spring remembers, a displacement or a force, and how it comes and goes."""

import numpy as np
import pytest

import naive
from example_packings import LAWS, crowd, keeping, law_name
from grainmodes.kernels.damping import Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.springs import advance_by_slide, clip_springs
from grainmodes.packing.forces import forces_on_i
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.dynamics import move

FORCE_LAWS = [law for law in LAWS if naive.remembers_force(law)]
OVERLAP = np.array([1e-4, 0.02, 0.3])


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_a_spring_advances_by_what_its_law_makes_of_the_slide(law):
    had, slide = np.array([0.0, 1e-3, -2e-3]), np.array([1e-5, -2e-4, 3e-3])
    after = advance_by_slide(Interaction.from_law(law), OVERLAP, had, slide)
    expected = had + naive.remembered(law, OVERLAP, slide)
    np.testing.assert_allclose(after, expected, rtol=1e-14)


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_a_contact_that_closes_on_the_way_loads_no_force_before(law):
    interaction, had, slide = Interaction.from_law(law), np.zeros(1), np.array([1e-3])
    if law.normal == "hertz" and naive.remembers_force(law):
        assert advance_by_slide(interaction, np.array([-0.1]), had, slide)[0] == 0.0
    else:
        assert advance_by_slide(interaction, np.array([-0.1]), had, slide)[0] != 0.0


@pytest.mark.parametrize("law", FORCE_LAWS, ids=law_name)
def test_a_remembered_force_does_not_feel_the_overlap(law):
    """At a fixed history ∂f_T/∂ξ = 0, until Coulomb cuts it."""
    interaction, h = Interaction.from_law(law), np.full(3, 1e-9)
    forces = [-naive.tangential_force(law, overlap, h[0]) / h[0] for overlap in (1e-4, 0.02, 0.3)]
    np.testing.assert_array_equal(forces, 1.0)
    np.testing.assert_array_equal(clip_springs(interaction, OVERLAP, h), h)


@pytest.mark.parametrize("tangential", ["elastic", "sharp_coulomb"])
def test_harmonic_contacts_cannot_tell_what_is_remembered(tangential):
    coefficient = 0.4 if tangential != "elastic" else None
    by_s = ContactLaw("harmonic", tangential, 0.3, coefficient)
    by_force = ContactLaw("harmonic", f"{tangential}_force", 0.3, coefficient)
    packing = crowd(81, slip=1.2)
    states = [(keeping(law, packing), Interaction.from_law(law)) for law in (by_s, by_force)]
    one, other = (forces_on_i(state.contacts, interaction) for state, interaction in states)
    np.testing.assert_allclose(other, one, rtol=1e-14)
    matrices = [jacobian(state, interaction).toarray() for state, interaction in states]
    np.testing.assert_allclose(matrices[1], matrices[0], atol=1e-14)


def pressed(overlap: float) -> Packing:
    return Packing.from_positions([[2.0, 3.0], [3.0 - overlap, 3.0]], np.ones(2), 6.0)


def spun(law: ContactLaw, steps: int):
    """Two grains pressed together that turn against each other, after some steps."""
    start = np.zeros((2, 3))
    start[:, 2] = 0.05
    return move(pressed(0.02), start, Interaction.from_law(law), Undamped(), 1e-2, Stop(0.0, steps))


@pytest.mark.parametrize("law", FORCE_LAWS, ids=law_name)
def test_a_force_is_forgotten_when_a_contact_opens_and_starts_anew(law):
    interaction, touching = Interaction.from_law(law), spun(law, 20)
    assert abs(touching.packing.contacts.springs[0]) > 1e-5
    apart = move(
        touching.packing, touching.velocity, interaction, Undamped(), 1e-2, Stop(0.0, 1500)
    )
    assert len(apart.packing.contacts.i) == len(apart.packing.history.i) == 0
    gap = np.subtract(*apart.packing.position)
    towards = 0.2 * gap / np.hypot(*gap)
    back = np.array([[*-towards, 0.01], [*towards, 0.01]])
    again, steps = apart.packing, 0
    while not len(again.contacts.i):
        before, steps = again, steps + 1
        again = move(before, back, interaction, Undamped(), 1e-2, Stop(0.0, 1)).packing
    contacts = again.contacts
    h, overlap = contacts.springs[0], contacts.overlap[0]
    assert steps > 1
    assert 0.0 <= h <= naive.remembered(law, overlap, 0.02 * 1e-2) * (1 + 1e-6)


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_a_motion_goes_on_where_it_stopped(law):
    """Packing and velocity are the whole state but for the force, whose last bit is summed anew."""
    interaction, start = Interaction.from_law(law), np.zeros((16, 3))
    whole = move(crowd(82), start, interaction, Undamped(), 1e-2, Stop(0.0, 200))
    half = move(crowd(82), start, interaction, Undamped(), 1e-2, Stop(0.0, 100))
    rest = move(half.packing, half.velocity, interaction, Undamped(), 1e-2, Stop(0.0, 100))
    np.testing.assert_allclose(rest.velocity, whole.velocity, atol=1e-11)
    one, other = (m.packing.contacts for m in (whole, rest))
    np.testing.assert_array_equal(other.i, one.i)
    np.testing.assert_allclose(other.springs, one.springs, atol=1e-11)
    assert np.abs(one.springs).max() > 1e-4
