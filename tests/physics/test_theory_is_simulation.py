"""g from one linear solve is g from a step strain relaxed with the full non-linear forces."""

from dataclasses import replace

import numpy as np
import pytest

from example_packings import ELASTIC, MINIMAL, elastic, every_kt_once, reference
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import stress
from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import step_strain
from grainmodes.relaxation.newton import newton
from grainmodes.response.moduli import rigidity

KTS = (0.0, 1e-8, 1e-4, 1e-2, 1.0, 2.0, 10.0)


@pytest.mark.parametrize(("name", "kt"), every_kt_once(KTS))
def test_unloaded_step(name, kt):
    packing, interaction = reference(name)[1], elastic(name, kt)
    simulated = step_strain(packing, interaction, StepStrain())
    assert simulated.converged and simulated.contact_changes == 0
    assert max(simulated.max_force, simulated.max_torque) < 1e-14
    theory = rigidity(packing, interaction).unloaded.g
    assert simulated.g == pytest.approx(theory, rel=1e-5)
    assert simulated.g_forward == pytest.approx(theory, rel=1e-2)
    assert abs(simulated.g - theory) <= max(10 * simulated.error, 1e-7 * abs(theory))


def continuously_sheared(packing: Packing, interaction, strain: float) -> Packing:
    """A step that the tangential springs feel, relaxed."""
    contacts = packing.contacts
    slide = contacts.normal[:, 1] * contacts.normal[:, 1] * contacts.distance * strain
    history = History(contacts.i, contacts.j, slide)
    relaxed = newton(replace(packing, history=history).sheared(strain), interaction, 1e-14, 40)
    assert relaxed.converged
    return relaxed.packing


@pytest.mark.parametrize(("name", "kt"), every_kt_once(KTS[1:]))
def test_loaded_step(name, kt):
    packing, interaction = reference(name)[1], elastic(name, kt)
    ends = [continuously_sheared(packing, interaction, step) for step in (1e-6, -1e-6)]
    sigma = [stress(end, interaction)[0, 1] for end in ends]
    simulated = (sigma[0] - sigma[1]) / 2e-6
    assert simulated == pytest.approx(rigidity(packing, interaction).loaded.g, rel=1e-5)


@pytest.mark.parametrize("strain", [1e-6, 1e-5, 1e-4])
def test_size_of_the_step_does_not_matter(strain):
    packing, interaction = reference(ELASTIC[3])[1], elastic("hertz", 1e-2)
    simulated = step_strain(packing, interaction, StepStrain(strain=strain))
    theory = rigidity(packing, interaction).unloaded.g
    assert simulated.converged
    assert simulated.g == pytest.approx(theory, rel=1e-5)
    assert simulated.g_forward == pytest.approx(theory, rel=1e-3)


@pytest.mark.parametrize("kt", [1.0, 10.0])
@pytest.mark.parametrize("name", MINIMAL)
def test_damped_dynamics_end_where_newton_does(name, kt):
    packing, interaction = reference(name)[1], elastic(name, kt)
    newtonian, damped = (
        step_strain(packing, interaction, StepStrain(relaxation=way))
        for way in ("newton", "damped")
    )
    assert damped.converged
    assert max(damped.max_force, damped.max_torque) < 1e-14
    assert newtonian.iterations < 30 < 1000 < damped.iterations
    assert damped.g == pytest.approx(newtonian.g, rel=1e-6)


def test_rattlers_do_not_disturb_a_step():
    packing = reference(MINIMAL[0])[1]
    with_guest = guest_in_a_gap(packing)
    interaction = elastic("hertz", 1.0)
    found = step_strain(with_guest, interaction, StepStrain())
    assert found.converged
    assert found.g == pytest.approx(step_strain(packing, interaction, StepStrain()).g, rel=1e-9)


def guest_in_a_gap(packing: Packing) -> Packing:
    """The packing with a small grain more, leaning on grain 0."""
    leaning = packing.position[0] + (packing.diameter[0] / 2 + 0.02) * np.array([1.0, 0.0])
    position = np.vstack([packing.position, leaning])
    return Packing.from_positions(position, np.append(packing.diameter, 0.05), packing.box_length)
