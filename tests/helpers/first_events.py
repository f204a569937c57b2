"""The first event of a small harmonic packing, without friction and with it, in every bracket."""

from __future__ import annotations

from functools import cache

import pytest

from example_packings import law_name, reference
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.first_event import Bracket, bracket_first_event

LAWS = [ContactLaw("harmonic"), ContactLaw("harmonic", "elastic", 1.0)]
SMALL_STRAIN = Shear(strain=0.012)
each_law = pytest.mark.parametrize("law", LAWS, ids=law_name)


def packing_for(law: ContactLaw) -> Packing:
    """A packing of 64 grains in balance under the normal law."""
    return reference(f"{law.normal}_n64_phi0.860_seed2")[1]


@cache
def all_brackets(law: ContactLaw) -> list[Bracket]:
    """The first event at every Δγ_Th."""
    return bracket_first_event(packing_for(law), Interaction.from_law(law), SMALL_STRAIN)


def narrowest(law: ContactLaw) -> Bracket:
    """The first event at Δγ_Th = 1e-10."""
    return all_brackets(law)[-1]
