"""What is recorded of a moving state, against sums over grains and contacts."""

from dataclasses import replace

import numpy as np
import pytest

from example_packings import crowd
from grainmodes.kernels.damping import Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import stress
from grainmodes.packing.state import nonaffine_motion
from grainmodes.parameters.law import ContactLaw
from grainmodes.protocols.release.record import (
    count_changed_contacts,
    grain_stress,
    record_motion,
)
from grainmodes.relaxation.dynamics import Motion, move
from released import state


def moved_state(size: float = 0.02):
    """The state some time after a fast release, when contacts have opened and closed."""
    start, _, interaction = state()
    velocity = start.initial_velocity(size)
    motion = move(start.packing, velocity, interaction, Undamped(), 0.05, Stop(0.0, 500))
    return start.packing, motion, interaction


def test_a_record_is_what_its_names_say():
    start, now, interaction = moved_state()
    found = record_motion(25.0, now, start, interaction)
    contacts, packing = now.packing.contacts, now.packing
    moved = nonaffine_motion(start, packing)
    m = sum(moved[i, 0] ** 2 + moved[i, 1] ** 2 for i in range(50)) / 50
    a = sum((2.0 * moved[i, 2] / packing.diameter[i]) ** 2 for i in range(50)) / 50
    np.testing.assert_allclose(found[1:3], (m, a), rtol=1e-12)
    sigma = stress(packing, interaction)
    np.testing.assert_allclose(
        found[3:6], (-(sigma[0, 0] + sigma[1, 1]) / 2, sigma[0, 1], sigma[1, 0])
    )
    v = now.velocity
    kinetic = sum(0.5 * (v[i, 0] ** 2 + v[i, 1] ** 2 + 0.5 * v[i, 2] ** 2) for i in range(50))
    assert found.kinetic_energy == pytest.approx(kinetic)
    assert found.contact_number == 2 * len(contacts.i) / 50
    first = start.contacts
    pairs = [set(zip(c.i.tolist(), c.j.tolist(), strict=True)) for c in (first, contacts)]
    assert found.changed == len(pairs[0] ^ pairs[1]) > 0


def test_sliding_contacts_are_those_beyond_the_threshold():
    for tangential in ("smoothed_coulomb", "sharp_coulomb"):
        packing = crowd(5, slip=1.0)
        interaction = Interaction.from_law(ContactLaw("hertz", tangential, 0.5, 0.3))
        contacts = packing.contacts
        over = np.abs(contacts.springs) >= 0.3 / 0.5 * contacts.overlap
        still = Motion(packing, np.zeros((16, 3)), 0, 0.0)
        turning = replace(packing, rotation=np.zeros(16))
        found = record_motion(0.0, replace(still, packing=turning), turning, interaction).sliding
        assert 0 < found == over.sum() < len(over)
    never = Interaction.from_law(ContactLaw("hertz", "elastic", 0.5))
    assert record_motion(0.0, replace(still, packing=turning), turning, never).sliding == 0


def test_the_pressures_of_the_grains_add_up():
    """C, Fig. 10: P = Σ_i P_i, whatever the tangential forces are."""
    start, now, interaction = moved_state()
    found = grain_stress(now.packing, interaction)
    assert found.pressure.sum() == pytest.approx(
        record_motion(0.0, now, start, interaction).pressure
    )
    assert found.binary.sum() / (2.0 * start.box_length**2) == pytest.approx(found.pressure.sum())
    assert found.contacts.sum() == 2 * len(found.binary)


def test_a_rattler_changes_no_contacts():
    start, _, interaction = state()
    packing, diameter = start.packing, start.packing.diameter.copy()
    diameter[-1] = 1e-3
    last_is_rattler = replace(packing, diameter=diameter)
    lost = len(packing.contacts.i) - len(last_is_rattler.contacts.i)
    assert count_changed_contacts(packing, last_is_rattler, interaction) == 0
    assert count_changed_contacts(last_is_rattler, packing, interaction) == lost > 0
