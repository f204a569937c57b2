"""Grains on the move: what is conserved, what may only fall, and how fast steps converge."""

import numpy as np
import pytest

import naive_dynamics as slow
from example_packings import crowd, pairs_of, reference
from grainmodes.kernels.damping import Dashpot, Drag, Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Elastic, Hertz, Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.dynamics import Motion, move, relax_damped

HARMONIC = ContactLaw("harmonic", "elastic", 0.5)
BARE = ContactLaw("hertz")
LAWS = {
    "harmonic elastic": (HARMONIC, Interaction.from_law(HARMONIC)),
    "frictionless Hertz": (BARE, Interaction(Hertz(1.0), Elastic(0.0))),
}
"""The laws that have an energy: the slow twin's, and the package's with torque and history."""


def energy(law: ContactLaw, motion: Motion) -> float:
    packing = motion.packing
    scene = slow.Scene(law, packing.diameter, packing.mass, packing.box_length, packing.strain)
    slip = {(p.i, p.j): p.slip for p in pairs_of(packing)}
    return slow.energy(scene, slow.Moving(packing.position, motion.velocity, None, slip))


def record(packing: Packing, velocity, interaction, damping, dt: float, looks: int, between: int):
    """The motion now and then."""
    motion = Motion(packing, velocity, 0, np.inf)
    yield motion
    for _ in range(looks):
        motion = move(motion.packing, motion.velocity, interaction, damping, dt, Stop(0.0, between))
        yield motion


def stirred(n: int, size: float) -> np.ndarray:
    return np.random.default_rng(2).normal(0.0, size, (n, 3))


@pytest.mark.parametrize("damping", [Dashpot(0.5), Drag(0.5)])
@pytest.mark.parametrize("name", LAWS)
def test_energy_never_rises_in_damped_dynamics(name, damping):
    law, interaction = LAWS[name]
    packing = crowd(61, strain=0.3)
    history = [
        energy(law, m)
        for m in record(
            packing, stirred(16, 0.1), interaction, damping, 2e-3, looks=120, between=10
        )
    ]
    assert history[-1] < 0.7 * history[0]
    assert np.diff(history).max() < 1e-7 * history[0]


@pytest.mark.parametrize("name", LAWS)
def test_energy_is_kept_without_damping(name):
    law, interaction = LAWS[name]
    packing = reference("harmonic_n64_phi0.900_seed1")[1]
    if name != "harmonic elastic":
        packing = reference("hertz_n64_phi0.900_seed1")[1]
    start = stirred(packing.n, 1e-4)
    rest = energy(law, Motion(packing, 0 * start, 0, 0.0))
    history = [
        energy(law, m) - rest
        for m in record(packing, start, interaction, Undamped(), 2e-3, looks=20, between=50)
    ]
    np.testing.assert_allclose(history, history[0], rtol=2e-2)


@pytest.mark.parametrize("damping", [Dashpot(0.5), Undamped()])
def test_momentum_is_kept(damping):
    packing, start = crowd(62), stirred(16, 0.1)
    end = move(packing, start, Interaction.from_law(HARMONIC), damping, 1e-2, Stop(0.0, 300))
    before, after = (packing.mass @ v[:, :2] for v in (start, end.velocity))
    np.testing.assert_allclose(after, before, atol=1e-13)


def head_on(overlap: float) -> Packing:
    position = [[2.0, 3.0], [2.0 + 1.0 - overlap, 3.0]]
    return Packing.from_positions(position, np.ones(2), 6.0)


def bounce(viscosity: float, overlap: float, rate: float, t: float) -> tuple[float, float]:
    """(ξ, ξ') of two grains of mass 1 after t, from ξ'' = −2 ξ − 2η ξ'."""
    omega = np.sqrt(2 - viscosity**2)
    sine = (rate + viscosity * overlap) / omega
    decay, c, s = np.exp(-viscosity * t), np.cos(omega * t), np.sin(omega * t)
    xi = decay * (overlap * c + sine * s)
    return xi, decay * omega * (sine * c - overlap * s) - viscosity * xi


def bounced(viscosity: float, rate: float, t: float, steps: int) -> tuple[float, float]:
    """Errors of (ξ, ξ') of two grains pressed together at `rate`."""
    overlap = 0.05
    start = np.array([[rate / 2, 0.0, 0.0], [-rate / 2, 0.0, 0.0]])
    damping = Dashpot(viscosity) if viscosity else Undamped()
    interaction = Interaction.from_law(HARMONIC)
    end = move(head_on(overlap), start, interaction, damping, t / steps, Stop(0.0, steps))
    xi, speed = bounce(viscosity, overlap, rate, t)
    found = end.packing.contacts.overlap[0]
    return abs(found - xi), abs(end.velocity[0, 0] - end.velocity[1, 0] - speed)


@pytest.mark.parametrize(("viscosity", "order"), [(0.0, 2), (0.4, 1)])
def test_two_grains_bounce_as_a_damped_oscillator(viscosity, order):
    errors = np.array([bounced(viscosity, 0.0, 0.8, steps) for steps in (100, 200, 400)])
    assert errors[-1].max() < (1e-6 if order == 2 else 1e-4)
    np.testing.assert_allclose(np.log2(errors[:-1] / errors[1:]), order, atol=0.1)


@pytest.mark.parametrize(("viscosity", "orders"), [(0.0, (4, 3)), (0.4, (3, 2))])
def test_one_step_is_of_the_order_that_paper_a_says(viscosity, orders):
    """A, App. B 1: with velocity in the forces, right to Δt² in q and to Δt in q̇."""
    rate = 0.03 if viscosity else 0.0
    errors = np.array([bounced(viscosity, rate, dt, 1) for dt in (0.04, 0.02, 0.01)])
    np.testing.assert_allclose(np.log2(errors[:-1] / errors[1:]), [orders] * 2, atol=0.1)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_drag_slows_every_motion_alike(axis):
    packing = Packing.from_positions([[1.0, 1.0], [4.0, 4.0]], [1.0, 0.7], 6.0)
    start = np.zeros((2, 3))
    start[:, axis] = 0.3
    end = move(packing, start, Interaction.from_law(HARMONIC), Drag(0.8), 1e-3, Stop(0.0, 1000))
    np.testing.assert_allclose(end.velocity[:, axis], 0.3 * np.exp(-0.8), rtol=1e-3)


def test_dashpots_act_on_spin_as_on_sliding():
    """Two grains that roll on each other feel no friction; two that spin alike do."""
    packing, interaction = head_on(1e-6), Interaction.from_law(HARMONIC)
    for spins, slows in (((0.1, -0.1), False), ((0.1, 0.1), True)):
        start = np.zeros((2, 3))
        start[:, 2] = spins
        end = move(packing, start, interaction, Dashpot(1.0), 1e-3, Stop(0.0, 20))
        assert np.all(np.abs(end.velocity[:, 2]) < 0.0999) == slows


def test_slip_is_forgotten_when_a_contact_opens():
    packing, interaction = head_on(0.02), Interaction.from_law(HARMONIC)
    start = np.zeros((2, 3))
    start[:, 2] = 0.05
    touching = move(packing, start, interaction, Undamped(), 1e-2, Stop(0.0, 20))
    assert abs(touching.packing.contacts.springs[0]) > 1e-3
    apart = move(touching.packing, touching.velocity, interaction, Undamped(), 1e-2, Stop(0.0, 300))
    assert len(apart.packing.contacts.i) == 0
    assert len(apart.packing.history.i) == 0


def test_a_long_way_does_not_lose_neighbours():
    """Two grains that meet far from where the list of neighbours was made."""
    packing = Packing.from_positions([[1.0, 3.0], [5.0, 3.2]], np.ones(2), 8.0)
    start = np.array([[0.5, 0.0, 0.0], [-0.5, 0.0, 0.0]])
    end = move(packing, start, Interaction.from_law(HARMONIC), Undamped(), 1e-2, Stop(0.0, 600))
    assert end.velocity[0, 0] < 0.4
    kinetic = np.sum(end.velocity[:, :2] ** 2) / 2 + np.sum(end.velocity[:, 2] ** 2) / 4
    assert kinetic < 0.25 + 1e-6


def test_damped_relaxation_is_told_apart_from_running_out_of_steps():
    packing, interaction = (
        reference("hertz_n16_phi0.900_seed1")[1].sheared(1e-4),
        LAWS["harmonic elastic"][1],
    )
    interaction = Interaction.from_law(ContactLaw("hertz", "elastic", 1.0))
    short = relax_damped(packing, interaction, Dashpot(1.0), 1e-2, 1e-14, 100)
    assert not short.converged and short.iterations == 100 and short.max_force > 1e-14
    long = relax_damped(packing, interaction, Dashpot(1.0), 1e-2, 1e-14, 1_000_000)
    assert long.converged and max(long.max_force, long.max_torque) < 1e-14
