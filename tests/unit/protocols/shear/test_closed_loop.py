"""Closed loops of strain: springs come back as long as no contact changes."""

from dataclasses import replace

import numpy as np
import pytest

from first_events import LAWS, packing_for
from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear import closed_loop as module
from grainmodes.protocols.shear.closed_loop import closed_loop

B = LAWS[1]
INTERACTION = Interaction.from_law(B)
CHOICES = Shear(step=1e-5)


def test_the_springs_come_back_to_second_order_in_the_step():
    packing = packing_for(B)
    coarse, fine = (
        closed_loop(packing, INTERACTION, replace(CHOICES, step=step)) for step in (1e-4, 1e-5)
    )
    for loop in (coarse, fine):
        assert loop.strain > 0.0
        assert 0.0 < loop.left < 1e-3 * loop.slide
    assert 0.0 < fine.strain <= 10 * 1e-5


def test_the_loop_is_closed_and_not_a_way_out(monkeypatch):
    """A loop that stayed at its far end would leave all of the slide."""
    packing = packing_for(B)
    whole = closed_loop(packing, INTERACTION, CHOICES)
    monkeypatch.setattr(module, "step_to", lambda strain, before, choices: (before, False))
    stuck = closed_loop(packing, INTERACTION, CHOICES)
    assert stuck.left == stuck.slide == pytest.approx(whole.slide)


def test_a_packing_without_a_quiet_step_has_no_loop():
    loop = closed_loop(packing_for(B), INTERACTION, replace(CHOICES, step=1e-2))
    assert loop.strain == 0.0 and np.isnan(loop.left) and np.isnan(loop.slide)
