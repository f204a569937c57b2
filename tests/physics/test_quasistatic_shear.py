"""Quasistatic shear against what must hold for any forces, and against B's damped dynamics."""

import pickle
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from example_packings import LAWS, crowd, law_name, quenched, reference
from grainmodes.kernels.laws import Harmonic, Interaction
from grainmodes.packing.forces import net_force
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing, nonaffine_motion
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.events import RIGIDITY_DROP
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.protocols.shear.sheared_state import ShearedState
from grainmodes.protocols.shear.strain_step import first_equilibrium, step_to
from grainmodes.relaxation.frictionless import relax_fire_newton
from grainmodes.stages.shear_rows import run_row

B = ContactLaw("harmonic", "elastic", 1.0)
FRICTIONLESS = [ContactLaw("harmonic"), ContactLaw("hertz")]
SMALL = "harmonic_n64_phi0.900_seed1"


def sheared(packing: Packing, law: ContactLaw, choices: Shear) -> QuasistaticRun:
    """A shear to its end."""
    run = QuasistaticRun.from_packing(packing, Interaction.from_law(law), choices)
    while not run.done and run.advance():
        pass
    return run


@cache
def harmonic(n: int, seed: int) -> Packing:
    """A harmonic packing in balance at φ = 0.90, from a Hertzian one."""
    return relax_fire_newton(quenched(n, 0.90, seed), Harmonic(1.0), 1e-14, 1_000_000).packing


def state_at(packing: Packing, law: ContactLaw, choices: Shear) -> ShearedState:
    """A state whose springs are loaded: a few steps away from where friction was switched on."""
    return sheared(packing, law, replace(choices, strain=5 * choices.step)).state


@pytest.mark.parametrize("loaded", [False, True], ids=["unloaded", "loaded"])
@pytest.mark.parametrize("law", [*FRICTIONLESS, *LAWS], ids=law_name)
def test_rigidity_is_the_slope_of_both_stress_components(law, loaded):
    """Central differences of relaxed states, whose error falls as the square of the step."""
    packing = reference(f"{law.normal}_n64_phi0.900_seed1")[1]
    choices = Shear(step=1e-5, min_step=1e-10, loaded=loaded)
    now, slopes = state_at(packing, law, choices), []
    for size in (2e-7, 1e-7):
        there, back = (
            ShearedState(equilibrium, 0, loaded).stress
            for equilibrium, _ in (
                step_to(now.strain + d, now.equilibrium, choices) for d in (size, -size)
            )
        )
        slopes.append((there - back) / (2.0 * size))
    extrapolated = (4.0 * slopes[1] - slopes[0]) / 3.0
    np.testing.assert_allclose(extrapolated, now.modulus, rtol=1e-6, atol=1e-6 * abs(now.g))


@pytest.mark.parametrize("law", [ContactLaw("harmonic"), ContactLaw("hertz"), B], ids=law_name)
def test_work_is_the_change_of_energy_between_events(law):
    """dE = L² σ_xy dγ, by the trapezoid rule: frictionless, or harmonic with springs loaded."""
    packing = reference(f"{law.normal}_n64_phi0.900_seed1")[1]
    missing = []
    for step in (2e-5, 1e-5):
        choices = Shear(strain=4e-5, step=step, min_step=1e-9, loaded=True)
        curve = sheared(packing, law, choices).curve
        work = sum(
            0.5 * (a.stress[0, 1] + b.stress[0, 1]) * (b.strain - a.strain)
            for a, b in pairwise(curve)
        )
        gain = curve[-1].energy - curve[0].energy
        missing.append(abs(packing.box_length**2 * work - gain) / abs(gain))
    assert missing[1] < 1e-7
    assert missing[1] < 0.35 * missing[0] or missing[0] < 1e-10


def test_work_is_not_the_change_of_energy_where_the_affine_step_leaves_the_springs_alone():
    packing = reference(SMALL)[1]
    now = state_at(packing, B, Shear(step=1e-3, min_step=1e-3))
    run = QuasistaticRun(now, Shear(strain=now.strain + 1e-4, step=1e-4, min_step=1e-4), 1)
    run.state = replace(now, strain_units=round(now.strain / 1e-4))
    run.advance()
    after = run.curve[-1]
    work = 0.5 * (now.stress[0, 1] + after.stress[0, 1]) * 1e-4 * packing.box_length**2
    gain = after.energy - now.curve_point(False).energy
    assert abs(work - gain) > 1e-3 * abs(gain)


@pytest.mark.parametrize("law", [B, ContactLaw("hertz", "elastic", 1.0)], ids=law_name)
def test_forward_and_back_leads_home(law):
    choices = Shear(step=1e-5, min_step=1e-9)
    now = state_at(reference(f"{law.normal}_n64_phi0.900_seed1")[1], law, choices)
    there, _ = step_to(now.strain + 1e-6, now.equilibrium, choices)
    back, _ = step_to(now.strain, there, choices)
    assert np.abs(nonaffine_motion(now.equilibrium.packing, there.packing)).max() > 1e-8
    moved = nonaffine_motion(now.equilibrium.packing, back.packing)
    moved[:, :2] -= moved[:, :2].mean(axis=0)
    assert np.abs(moved).max() < 1e-12
    difference = back.packing.contacts.springs - now.equilibrium.packing.contacts.springs
    assert np.abs(difference).max() < 1e-12


@pytest.mark.parametrize("seed", range(10))
def test_newton_and_damped_dynamics_agree_between_events(seed):
    """At Δγ = 1e-4 to 1e-6 of σ, while the network stays as it is."""
    packing, sigma = harmonic(32, seed), {}
    for relaxation in ("newton", "damped"):
        choices = Shear(
            strain=4e-4, step=1e-4, min_step=1e-4, relaxation=relaxation, time_step=1e-2
        )
        run = sheared(packing, B, choices)
        free = all(c.opened == c.closed == 0 for c in run.network_changes)
        sigma[relaxation] = [0.5 * (p.stress[0, 1] + p.stress[1, 0]) for p in run.curve]
    if free:
        np.testing.assert_allclose(sigma["newton"], sigma["damped"], rtol=1e-6)
    else:
        np.testing.assert_allclose(sigma["newton"], sigma["damped"], atol=1e-4)


def test_the_difference_to_damped_dynamics_falls_as_the_square_of_the_step():
    """The dynamics leads s along a bent path, and what that adds is the area it encloses."""
    packing, differences = harmonic(32, 3), []
    for step in (4e-4, 2e-4, 1e-4):
        sigma = []
        for relaxation in ("newton", "damped"):
            choices = Shear(step, step, step, relaxation, time_step=1e-2)
            sigma.append(sheared(packing, B, choices).state.sigma)
        differences.append(abs(sigma[0] - sigma[1]))
    orders = -np.diff(np.log2(differences))
    assert np.all(np.abs(orders - 2.0) < 0.1)


def hexagonal() -> tuple[Packing, float]:
    """Rows of equal grains, and the strain at which all contacts of one direction open.

    Every grain is a centre of inversion, so every affine strain is in balance.
    """
    columns, rows, length = 7, 8, 6.9
    a, h = length / columns, length / rows
    sites = [(a * (i + 0.5 * (j % 2)), h * j) for j in range(rows) for i in range(columns)]
    packing = Packing.from_positions(np.array(sites), np.ones(len(sites)), length)
    return packing, (np.sqrt(1.0 - h * h) - 0.5 * a) / h


def test_contacts_of_a_lattice_open_at_the_strain_of_pencil_and_paper():
    packing, critical = hexagonal()
    choices = Shear(strain=0.02, step=1e-3, min_step=1e-9)
    assert 1e-3 < critical < 0.02
    run = sheared(packing, B, choices)
    event = run.events[0]
    low, high = (point.strain for point in event.points)
    assert low < critical <= high
    assert high - low == pytest.approx(1e-9, rel=1e-6)
    assert event.kind & RIGIDITY_DROP
    assert (event.opened, event.closed) == (packing.n, 0)
    assert np.abs(event.displacement).max() < 1e-9


@pytest.mark.parametrize("law", [ContactLaw("harmonic"), ContactLaw("hertz")], ids=law_name)
def test_the_critical_strain_does_not_depend_on_the_first_step(law):
    """Where a jump cannot come before; to the width of the bracket."""
    packing = reference(f"{law.normal}_n64_phi0.860_seed2")[1]
    brackets = []
    for step in (1e-3, 1e-4):
        run = QuasistaticRun.from_packing(
            packing, Interaction.from_law(law), Shear(0.2, step, 1e-8)
        )
        while not run.events and not run.done and run.advance():
            pass
        brackets.append([point.strain for point in run.events[0].points])
    assert np.ptp(brackets, axis=0).max() <= 1.5e-8
    assert np.diff(brackets, axis=1) == pytest.approx(1e-8, rel=1e-6)


@pytest.mark.parametrize("law", [B, ContactLaw("harmonic")], ids=law_name)
def test_a_walk_taken_up_again_ends_with_the_same_bytes(law):
    packing = reference("harmonic_n64_phi0.860_seed2")[1]
    choices = Shear(strain=0.01, step=1e-4, min_step=1e-7)
    whole = run_row(sheared(packing, law, choices))
    run, stops = QuasistaticRun.from_packing(packing, Interaction.from_law(law), choices), 0
    while not run.done and run.advance():
        if run.restartable:
            run, stops = pickle.loads(pickle.dumps(run)), stops + 1
    assert stops >= 2
    again = run_row(run)
    assert whole.keys() == again.keys()
    for name, value in whole.items():
        assert np.asarray(value).tobytes() == np.asarray(again[name]).tobytes(), name


def test_a_box_at_one_half_is_the_box_at_minus_one_half():
    """One image further, γ = 1/2 and −1/2 are the same state: s_x → s_x + s_y."""
    packing = crowd(3, strain=0.5, slip=0.3)
    x, y = packing.fraction
    other = replace(packing, fraction=np.stack([x + y, y]), strain=-0.5)
    interaction = Interaction.from_law(LAWS[0])
    one, two = (state.contacts for state in (packing, other))
    np.testing.assert_array_equal(one.i, two.i)
    np.testing.assert_allclose(one.normal, two.normal, atol=1e-14)
    forces = [net_force(packing, interaction) for contacts in (one, two)]
    np.testing.assert_allclose(*forces, atol=1e-13)
    stiff = [jacobian(packing, interaction).toarray() for contacts in (one, two)]
    np.testing.assert_allclose(*stiff, atol=1e-13)


def test_the_first_equilibrium_must_be_stable():
    with pytest.raises(ArithmeticError, match="no stable equilibrium near the packing"):
        first_equilibrium(crowd(1), Interaction.from_law(B), Shear())
