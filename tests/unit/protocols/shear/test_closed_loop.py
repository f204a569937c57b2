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


def test_the_springs_come_back_but_for_a_part_in_proportion_to_the_step(monkeypatch):
    packing = packing_for(B)
    loops = []
    for halvings in range(3):
        monkeypatch.setattr(module, "MAX_STEPS", 10 * 2**halvings)
        step = 1e-5 / 2**halvings
        loops.append(closed_loop(packing, INTERACTION, replace(CHOICES, step=step, min_step=step)))
    assert {round(loop.strain, 12) for loop in loops} == {5e-5}
    parts = np.array([loop.left / loop.slide for loop in loops])
    np.testing.assert_allclose(parts[1:] / parts[:-1], 0.5, rtol=0.05)
    assert parts[0] < 1e-4


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
