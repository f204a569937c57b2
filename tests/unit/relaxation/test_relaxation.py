"""Relaxations against their slow twins, step by step, and against the balance they must reach."""

import numpy as np
import pytest

import naive
import naive_dynamics as slow
from example_packings import (
    ELASTIC,
    LAWS,
    MINIMAL,
    crowd,
    elastic,
    every_kt_once,
    law_name,
    reference,
)
from grainmodes.kernels.damping import Dashpot, Drag, TranslationalDrag, Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.dynamics import move
from grainmodes.relaxation.frictionless import relax_fire, relax_fire_large_steps, relax_fire_newton
from grainmodes.relaxation.newton import apply_slip, displace_with_springs, newton

NORMAL = {name: elastic(name, 0.0).normal for name in ("hertz", "harmonic")}
PATIENT = 1_000_000


def drift(after: Packing, before: Packing) -> np.ndarray:
    """Displacement of every grain relative to the mean, (N, 2) in the sheared frame."""
    y = np.mod((after.fraction[1] - before.fraction[1]) * 2.0**-64 + 0.5, 1.0) - 0.5
    x = np.mod((after.fraction[0] - before.fraction[0]) * 2.0**-64 + 0.5, 1.0) - 0.5
    step = np.stack([x + before.strain * y, y], axis=1) * before.box_length
    return step - step.mean(axis=0)


def shaken(packing: Packing, size: float) -> Packing:
    return packing.displaced(np.random.default_rng(0).normal(0.0, size, (packing.n, 2)))


def rest(packing: Packing, normal: str) -> float:
    """max|F| without friction."""
    return max_force_and_torque(net_force(packing, elastic(normal, 0.0)))[0]


@pytest.mark.parametrize("strain", [0.0, 0.3])
@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_fire_is_that_of_paper_a_step_by_step(normal, strain):
    packing, steps = crowd(31, strain=strain), 120
    law = ContactLaw(normal)

    def force(position):
        return slow.repulsion(law, position, packing.diameter, packing.box_length, strain)

    now = slow.Fire(packing.position, np.zeros((packing.n, 2)))
    for _ in range(steps):
        now = slow.fire_step(now, force, packing.mass)
    found = relax_fire(packing, NORMAL[normal], 1e-300, steps)
    twin = Packing.from_positions(
        now.position, packing.diameter, packing.box_length, strain, packing.mass
    )
    start = Packing.from_positions(
        packing.position, packing.diameter, packing.box_length, strain, packing.mass
    )
    assert found.iterations == steps and not found.converged
    went = drift(found.packing, packing)
    assert np.abs(went).max() > 0.01
    np.testing.assert_allclose(went, drift(twin, start), atol=1e-9)


@pytest.mark.parametrize("relax", [relax_fire, relax_fire_newton])
@pytest.mark.parametrize("name", [MINIMAL[0], *ELASTIC[2:4]])
def test_a_shaken_packing_comes_back(name, relax):
    packing = reference(name)[1]
    normal = name.split("_")[0]
    relaxed = relax(shaken(packing, 1e-5), NORMAL[normal], 1e-14, PATIENT)
    assert relaxed.converged and relaxed.max_force < 1e-14
    assert relaxed.max_force == pytest.approx(rest(relaxed.packing, normal), abs=1e-17)
    assert np.abs(drift(relaxed.packing, packing)).max() < 1e-10


@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_a_crowd_comes_to_rest(normal):
    for relax in (relax_fire, relax_fire_newton):
        relaxed = relax(crowd(32), NORMAL[normal], 1e-14, PATIENT)
        # The two orders of summation differ by the rounding of forces of order 0.1.
        assert relaxed.converged and rest(relaxed.packing, normal) < 1.1e-14


def test_grains_that_touch_nothing_are_at_rest():
    packing = crowd(33).at(0.3)
    for relax in (relax_fire, relax_fire_newton):
        relaxed = relax(packing, NORMAL["hertz"], 1e-14, PATIENT)
        assert (relaxed.converged, relaxed.iterations, relaxed.max_force) == (True, 0, 0.0)
        np.testing.assert_array_equal(relaxed.packing.fraction, packing.fraction)


def test_too_few_steps_are_reported():
    for relax in (relax_fire, relax_fire_newton):
        relaxed = relax(crowd(34), NORMAL["hertz"], 1e-14, 10)
        assert not relaxed.converged
        assert relaxed.iterations == 10
        # FIRE sums the contacts of a grain in the order of its neighbours.
        assert relaxed.max_force == pytest.approx(rest(relaxed.packing, "hertz"), rel=1e-14)
        assert relaxed.max_force > 1e-14


def test_a_rough_balance_is_relative_to_the_mean_force():
    relaxed = relax_fire_large_steps(crowd(35), NORMAL["hertz"], 1e-14, 1e-3, PATIENT)
    force = naive.net_force(ContactLaw("hertz"), naive_pairs(relaxed.packing), relaxed.packing.n)
    assert 1e-14 < np.abs(force).max() < 1e-4


def naive_pairs(packing: Packing):
    return naive.all_pairs(packing.position, packing.diameter, packing.box_length, packing.strain)


def test_rattlers_are_detached():
    packing = reference(ELASTIC[3])[1]
    touched = packing.position[0] + (packing.diameter[0] / 2 + 0.04) * np.array([0.6, 0.8])
    crowded = Packing.from_positions(
        np.vstack([packing.position, touched]), np.append(packing.diameter, 0.1), packing.box_length
    )
    relaxed = relax_fire_newton(crowded, NORMAL["hertz"], 1e-14, PATIENT)
    assert relaxed.converged and rest(relaxed.packing, "hertz") < 1e-14
    assert packing.n not in relaxed.packing.contacts.i


@pytest.mark.parametrize(("name", "kt"), every_kt_once((0.0, 1e-8, 1e-2, 10.0)))
def test_newton_is_quadratic_near_a_balance(name, kt):
    packing = reference(name)[1]
    relaxed = newton(shaken(packing, 1e-7), elastic(name, kt), 1e-14)
    assert relaxed.converged and relaxed.iterations <= 3
    assert max(relaxed.max_force, relaxed.max_torque) < 1e-14
    if kt == 0.0:
        assert np.abs(drift(relaxed.packing, packing)).max() < 1e-10


@pytest.mark.parametrize("kt", [0.0, 0.1])
def test_newton_never_ends_worse_than_it_began(kt):
    interaction, lost = elastic("hertz", kt), 0
    for seed in range(12):
        packing = crowd(seed, slip=0.2 if kt else 0.0)
        relaxed = newton(packing, interaction, 1e-14, 3)
        lost += not relaxed.converged
        force = max_force_and_torque(net_force(relaxed.packing, interaction))
        assert (relaxed.max_force, relaxed.max_torque) == force
        assert relaxed.converged == (max(force) < 1e-14)
        assert max(force) <= max(max_force_and_torque(net_force(packing, interaction)))
    assert lost > 0


def test_newton_gives_up_on_grains_that_touch_nothing():
    packing = crowd(37).at(0.3)
    relaxed = newton(packing, elastic("hertz", 0.0), 1e-14)
    np.testing.assert_array_equal(relaxed.packing.fraction, packing.fraction)


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_springs_slip_as_far_as_their_law_requires(law):
    packing = crowd(40, slip=4.0)
    before = packing.contacts
    after = apply_slip(packing, Interaction.from_law(law))
    expected = before.springs
    if law.tangential.startswith("sharp_coulomb"):
        limit = naive.threshold(law, before.overlap)
        assert np.any(np.abs(expected) > limit)
        expected = np.clip(expected, -limit, limit)
    np.testing.assert_allclose(after.contacts.springs, expected, rtol=1e-13)
    np.testing.assert_array_equal(after.history.spring_state, after.contacts.springs)


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_a_small_displacement_advances_the_springs(law):
    packing = crowd(38, strain=0.3, slip=0.4)
    u = np.random.default_rng(1).normal(0.0, 1e-4, (packing.n, 3))
    contacts = packing.contacts
    moved = displace_with_springs(packing, Interaction.from_law(law), u)
    pairs = naive.all_moved(
        law,
        naive.all_pairs(
            packing.position,
            packing.diameter,
            packing.box_length,
            packing.strain,
            slip=dict(zip(zip(contacts.i, contacts.j, strict=True), contacts.springs, strict=True)),
        ),
        u,
    )
    np.testing.assert_allclose(moved.contacts.springs, [p.slip for p in pairs], atol=1e-13)
    np.testing.assert_array_equal(moved.rotation, u[:, 2])


DAMPINGS = {
    "dashpot": (Dashpot(0.7), {"viscosity": 0.7}),
    "drag": (Drag(0.5), {"drag": 0.5}),
    "translational drag": (TranslationalDrag(0.5), {"drag": 0.5, "drags_rotation": False}),
    "undamped": (Undamped(), {}),
}
BY_LAW = [(law, "undamped") for law in LAWS]
BY_DAMPING = [(law, damping) for law in (LAWS[1], LAWS[5]) for damping in list(DAMPINGS)[:3]]


@pytest.mark.parametrize(
    ("law", "damping"),
    [*BY_LAW, *BY_DAMPING],
    ids=lambda value: value if isinstance(value, str) else law_name(value),
)
def test_dynamics_are_those_of_the_slow_twin_step_by_step(law, damping):
    packing, steps, dt = crowd(39, strain=0.3), 60, 0.01
    fast, constants = DAMPINGS[damping]
    scene = slow.Scene(
        law, packing.diameter, packing.mass, packing.box_length, packing.strain, **constants
    )
    now = slow.released(scene, packing.position, np.zeros((packing.n, 3)))
    for _ in range(steps):
        now = slow.verlet_step(scene, now, dt)
    found = move(
        packing, np.zeros((packing.n, 3)), Interaction.from_law(law), fast, dt, Stop(0.0, steps)
    )
    assert found.steps == steps
    np.testing.assert_allclose(found.velocity, now.velocity, atol=1e-9)
    assert np.abs(found.velocity[:, 2]).max() > 1e-4
    contacts = found.packing.contacts
    pairs = slow.pairs_at(scene, now.position, now.slip)
    assert [(p.i, p.j) for p in pairs] == list(zip(contacts.i, contacts.j, strict=True))
    np.testing.assert_allclose(contacts.springs, [p.slip for p in pairs], atol=1e-9)
