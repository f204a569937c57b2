"""One packing under one law: which states are compared, and where it ends."""

import numpy as np

from example_packings import reference
from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.law_comparison import comparison
from grainmodes.protocols.law_comparison.comparison import shear_under_law

C8 = ContactLaw("harmonic", "smoothed_coulomb", 0.3, 0.5)
BRIEF = Shear(strain=2e-3, step=1e-4)


def test_states_are_spread_over_the_way(monkeypatch):
    monkeypatch.setattr(comparison, "N_STATES", 4)
    packing = reference("harmonic_n16_phi0.900_seed1")[1]
    seen = shear_under_law(packing, Interaction.from_law(C8), BRIEF).states
    np.testing.assert_allclose([state.strain for state in seen], [5e-4, 1e-3, 1.5e-3, 2e-3])


def test_a_way_that_ends_keeps_what_was_seen(monkeypatch):
    def step_to(strain, equilibrium, choices):
        if strain > 1.05e-3:
            raise ArithmeticError("lost")
        return equilibrium, False

    monkeypatch.setattr(comparison, "step_to", step_to)
    found = shear_under_law(
        reference("harmonic_n16_phi0.900_seed1")[1], Interaction.from_law(C8), BRIEF
    )
    assert (len(found.states), str(found.failure)) == (10, "lost")
