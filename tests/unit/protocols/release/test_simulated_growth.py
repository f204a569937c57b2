"""The simulated growth rate against linear theory."""

import pytest

from example_packings import SHEARED, reference, smoothed_coulomb
from grainmodes.kernels.laws import Interaction
from grainmodes.protocols.release.simulated_growth import simulated_growth_rate
from grainmodes.protocols.shear.coulomb_threshold import (
    SLIPPING,
    fastest_pair,
)


def unstable():
    """The sheared state of the independent code, which has pairs."""
    data, packing = reference(SHEARED)
    return packing, Interaction.from_law(smoothed_coulomb(data))


def test_a_released_state_grows_as_linear_theory_says():
    packing, interaction = unstable()
    found = fastest_pair(packing, interaction, SLIPPING)
    assert simulated_growth_rate(packing, interaction, found) == pytest.approx(
        found.growth_rate, rel=2e-3
    )
