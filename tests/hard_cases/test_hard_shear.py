"""Newton's method beyond a plastic event, γ = ±1/2 and ten images, a time step far too long."""

from dataclasses import replace

import numpy as np
import pytest

import naive_dynamics as slow
from example_packings import MINIMAL, crowd, pairs_of, reference
from grainmodes.kernels.damping import Drag
from grainmodes.kernels.laws import Hertz, Interaction
from grainmodes.kernels.neighbours import FRACTION_UNIT
from grainmodes.packing.forces import energy, net_force, stress
from grainmodes.packing.state import Packing, PackingError
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.strain import Shear, StepStrain
from grainmodes.protocols.shear import strain_step
from grainmodes.protocols.shear.first_event import accepted_steps
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.protocols.shear.strain_step import (
    first_equilibrium,
    step_to,
    strained_affinely,
)
from grainmodes.relaxation import dynamic_equilibrium
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.equilibrium_search import find_equilibrium
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.relaxation.newton import newton
from grainmodes.relaxation.result import RelaxationResult
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block, loss
from grainmodes.stages.step_strain import step_strain_block

FRICTION = Interaction.from_law(ContactLaw("harmonic", "elastic", 1.0))
FREE = Interaction.from_law(ContactLaw("harmonic"))
CHOICES = Shear(0.1, 1e-3, 1e-6)


def before_the_first_event(name: str, interaction) -> EquilibriumState:
    """The last balance before the first plastic event, which is 1e-6 away."""
    run = QuasistaticRun.from_packing(reference(name)[1], interaction, CHOICES)
    return next(before for before, _ in accepted_steps(run) if run.events).equilibrium


def sigma(packing: Packing, interaction) -> float:
    return float(stress(packing, interaction)[0, 1])


def test_newton_from_beyond_an_event_is_not_believed():
    """It converges in three steps to 4e-16, past a contact that opened under load."""
    before = before_the_first_event(MINIMAL[1], FRICTION)
    strain = before.packing.strain + 3e-3
    direct = newton(strained_affinely(before, strain, False), FRICTION, 1e-14)
    assert direct.converged
    found, jumped = step_to(strain, before, CHOICES)
    assert jumped and found.residual < 1e-14 and not found.unstable
    slow, _ = step_to(strain, before, replace(CHOICES, relaxation="damped"))
    expected = sigma(slow.packing, FRICTION)
    assert abs(sigma(direct.packing, FRICTION) / expected - 1.0) > 0.05
    assert sigma(found.packing, FRICTION) == pytest.approx(expected, rel=1e-4)


def test_a_saddle_beyond_an_event_is_left():
    before = before_the_first_event("harmonic_n64_phi0.860_seed2", FREE)
    strain = before.packing.strain + 1e-4
    saddle = find_equilibrium(strained_affinely(before, strain, False), FREE, 1e-14)
    assert saddle is not None and saddle.residual < 1e-14 and saddle.unstable
    found, jumped = step_to(strain, before, CHOICES)
    assert jumped and not found.unstable and found.residual < 1e-14
    assert energy(found.packing, FREE) < energy(saddle.packing, FREE)


def image_of(packing: Packing, number: int) -> Packing:
    """The packing at γ + n: s_x → s_x + n s_y, in integers."""
    x, y = packing.fraction
    return replace(packing, fraction=np.stack([x + number * y, y]))


@pytest.mark.parametrize("strain", [0.5, -0.5, 0.3])
def test_ten_images_further_every_contact_is_found(strain):
    """γ + 10 with the old fractions misses contacts; it is refused, and its image is exact."""
    interaction, packing = (
        Interaction.from_law(ContactLaw("hertz", "elastic", 0.3)),
        crowd(3, strain=strain),
    )
    for number in range(1, 11):
        further = image_of(packing, number)
        far, there = replace(packing, strain=strain + number).contacts, further.contacts
        assert len(far.i) <= len(there.i) == len(pairs_of(further))
        affine = packing.position + packing.box_length * number * np.outer(
            packing.fraction[1] * FRACTION_UNIT + 0.5, [1.0, 0.0]
        )
        twin = Packing.from_positions(affine, packing.diameter, packing.box_length, strain)
        np.testing.assert_allclose(
            net_force(further, interaction),
            net_force(twin, interaction),
            atol=1e-13,
        )
    assert len(far.i) < len(there.i)
    with pytest.raises(PackingError, match="box_length: expected more than"):
        packing.sheared(strain + 10)
    np.testing.assert_array_equal(image_of(further, -10).fraction, packing.fraction)


@pytest.mark.parametrize("time_step", [1.0, 1e3, 1e12])
def test_a_time_step_far_too_long_is_refused(time_step):
    """The plain scheme throws all grains out and calls it rest: NaN has no maximum."""
    law, packing = ContactLaw("hertz", "elastic", 1.0), reference(MINIMAL[0])[1].sheared(1e-4)
    scene = slow.Scene(law, packing.diameter, packing.mass, packing.box_length, 1e-4, drag=1.0)
    now = slow.released(scene, packing.position, np.zeros((16, 3)))
    with np.errstate(all="ignore"):
        for _ in range(200):
            now = slow.verlet_step(scene, now, time_step)
    assert np.nanmax(np.abs(now.velocity), initial=0.0) < 1e-14
    assert not np.abs(now.position - packing.position).max() < packing.box_length
    with pytest.raises(ArithmeticError, match=f"time_step = {time_step}: take a shorter one"):
        relax_damped(packing, Interaction.from_law(law), Drag(1.0), time_step, 1e-14, 10_000)


def test_a_sample_whose_dynamics_breaks_down_is_a_failed_row():
    rows = [
        packing_row(reference(name)[1], Hertz(1.0)) | {"converged": True} for name in MINIMAL[:1]
    ]
    packings = compute_block(range(1), rows.__getitem__, {"n": 16, "phi": 0.9})
    step = StepStrain(relaxation="damped", time_step=1.0)
    found = step_strain_block(packings, ContactLaw(kt=1.0), Rattlers(), step)
    assert found.variables["converged"].tolist() == [0]
    assert "take a shorter one" in found.attributes["failures"]["step_strain"]["0"]


def test_a_packing_that_unjams_is_not_rigid_and_did_not_fail(monkeypatch):
    packing, interaction = reference(MINIMAL[0])[1], Interaction.from_law(ContactLaw(kt=1.0))
    before = first_equilibrium(packing, interaction, CHOICES)
    damped = replace(CHOICES, relaxation="damped")

    def lost_after(packing: Packing) -> dict[str, str]:
        relaxed = RelaxationResult(packing, False, 100, 1e-9)
        monkeypatch.setattr(strain_step, "_run_dynamics", lambda *arguments: relaxed)
        with pytest.raises(ArithmeticError) as found:
            step_to(1e-4, before, damped)
        return loss({"": found.value})

    assert "zero modes" in lost_after(packing.at(0.5))["not_rigid"]
    monkeypatch.setattr(dynamic_equilibrium, "find_equilibrium", lambda *arguments: None)
    assert "no stable equilibrium" in lost_after(packing)["failures"]
