"""B's Err of single contacts, and along a shear."""

from types import SimpleNamespace

import numpy as np
import pytest

from first_events import LAWS, packing_for
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import Contacts
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.first_event import (
    accepted_steps,
)
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.protocols.shear.tangential_path import TangentialPath, normal_part

B = LAWS[1]


def contact(angle: float, s: float) -> SimpleNamespace:
    """A balance of two grains whose contact stands at an angle, with its s."""
    pair = np.array([1]), np.array([0])
    normal = np.array([[np.cos(angle), np.sin(angle)]])
    contacts = Contacts(*pair, normal, np.ones(1), np.full(1, 0.1), np.array([s]))
    return SimpleNamespace(packing=SimpleNamespace(contacts=contacts, strain=angle))


def test_a_contact_that_slides_while_it_turns_has_an_error_of_half_its_turn():
    path = TangentialPath(contact(0.3, 0.0))
    for part in np.linspace(0.0, 1.0, 1001)[1:]:
        found = path.follow(contact(0.3 + 0.4 * part, 0.01 * part))
    assert found.error_largest == pytest.approx(np.sin(0.2), rel=1e-6)
    assert found.turn_median == pytest.approx(0.4, rel=1e-12)
    assert found.length_median == pytest.approx(1.0 - np.sin(0.2) / 0.2, rel=1e-4)
    assert found.error_increment < 3e-16


def test_a_contact_that_slides_back_has_an_error_of_any_size():
    path = TangentialPath(contact(0.0, 0.0))
    path.follow(contact(0.2, 0.01))
    assert path.follow(contact(0.4, 0.0)).error_largest > 0.9


def test_a_contact_that_does_not_turn_has_none():
    path = TangentialPath(contact(1.0, 0.0))
    assert path.follow(contact(1.0, 0.01)).error_largest < 3e-16
    assert path.follow(contact(1.0, 0.003)).error_largest < 3e-16
    assert len(normal_part(np.zeros((2, 2)), np.zeros((2, 2)))) == 0


def errors(step: float) -> list:
    run = QuasistaticRun.from_packing(
        packing_for(B), Interaction.from_law(B), Shear(1e-3, step, step)
    )
    path = TangentialPath(run.state.equilibrium)
    return [path.follow(now.equilibrium) for _, now in accepted_steps(run)]


def test_the_integral_of_tangential_velocities_is_not_tangential():
    """Against B6: Err < 3e-16 holds for every increment, not for their sum."""
    coarse, fine = errors(1e-4), errors(5e-5)
    assert max(e.error_increment for e in coarse) < 3e-16
    for one, other in zip(coarse, fine[1::2], strict=True):
        assert one.strain == pytest.approx(other.strain, rel=1e-12)
        assert one.error_median == pytest.approx(other.error_median, rel=1e-2)
        assert one.error_median == pytest.approx(one.turn_median / 2.0, rel=0.05)
        assert one.length_median < 2.0 * one.error_median**2 + 1e-12
    assert coarse[9].error_median > 1e-4
