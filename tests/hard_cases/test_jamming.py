"""φ just above, at and below jamming: the mean contact force falls through F_Th = 1e-14.

A packing is loosened in ever smaller steps of φ until it no longer bears a load. On the last steps
every relaxation reaches F_Th, and pressures are positive on both sides.
"""

import pytest

from grainmodes.forces import largest, mean_contact_force, net_force
from grainmodes.kernels.laws import Hertz, interaction
from grainmodes.packing import Packing, find_contacts
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.frictionless import relax_fast
from grainmodes.samples import is_jammed
from specimens import ELASTIC, reference

FREE = interaction(ContactLaw())
LAW = ContactLaw(kt=1e-2)
BUDGET = 200_000


def jammed(packing: Packing) -> bool:
    contacts = find_contacts(packing)
    force = largest(net_force(packing, contacts, FREE))[0]
    return is_jammed(packing, contacts, FREE, force)


def load(packing: Packing) -> float:
    """Mean contact force."""
    return mean_contact_force(find_contacts(packing), FREE)


def loosened(finest: float) -> tuple[Packing, list[Packing]]:
    """The last packing that is jammed, to `finest` in φ, and those just below it, nearest last."""
    above, phi, step, below = reference(ELASTIC[2])[1], 0.86, 1e-3, []
    while step > 0.9 * finest:
        relaxed = relax_fast(above.at(phi - step), Hertz(1.0), 1e-14, BUDGET)
        assert relaxed.converged
        if jammed(relaxed.packing):
            above, phi = relaxed.packing, phi - step
        else:
            below.append(relaxed.packing)
            step *= 0.1
    return above, below


@pytest.fixture(scope="module")
def states() -> tuple[Packing, list[Packing]]:
    return loosened(1e-9)
