"""Unstable states let go: the kick, what is looked at, and linear theory as long as it holds."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from example_packings import crowd, reference
from grainmodes.kernels.damping import Drag, Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Elastic, Hertz, Interaction
from grainmodes.packing.forces import energy, stress
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.packing.state import Packing, find_contacts, nonaffine_motion
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.release import Release
from grainmodes.protocols.release.growth_fit import MIN_RECORDS, fit_growth
from grainmodes.protocols.release.outcome import release_outcome
from grainmodes.protocols.release.record import (
    MotionRecord,
    count_changed_contacts,
    grain_stress,
    record_motion,
)
from grainmodes.protocols.release.release_run import FRAMES, ReleaseRun
from grainmodes.protocols.release.spirals import fit_spirals
from grainmodes.relaxation.dynamics import Motion, move
from released import SHORT, released, series, state


def test_the_state_has_the_pair_that_it_says():
    start, _, interaction = state()
    assert start.residual(interaction) < 1e-12
    assert (start.frequency + 1j * start.growth_rate) ** 2 == pytest.approx(start.eigenvalue)
    worse = replace(start, mode=np.roll(start.mode, 1))
    assert worse.residual(interaction) > 0.1


def test_the_kick_goes_along_the_paper_s_vector_and_moves_no_centre():
    """C (27), (28): both columns of [u_r u_i] times the rotation and scaling, added."""
    start, _, _ = state()
    real, imaginary = start.eigenvalue.real, start.eigenvalue.imag
    plane = np.stack([start.mode.real.ravel(), start.mode.imag.ravel()], axis=1)
    columns = plane @ np.array([[real, imaginary], [-imaginary, real]])
    along = columns.sum(axis=1)
    kick = start.initial_velocity(1e-3)
    cosine = along @ kick.ravel() / np.linalg.norm(along) / np.linalg.norm(kick)
    assert cosine == pytest.approx(1.0, abs=1e-12)
    assert np.sqrt((kick[:, :2] ** 2).sum(axis=1).mean()) == pytest.approx(1e-3)
    assert np.abs(start.packing.mass @ kick[:, :2]).max() < 1e-15


@pytest.mark.parametrize("times", [0.0, 0.5, 2.0, 10.0, 1e3, 1e4])
def test_a_drag_slows_the_growth_as_the_quadratic_says(times):
    start, _, _ = state()
    drag = times * start.growth_rate
    roots = np.roots([1.0, drag, start.eigenvalue])
    assert start.damped_growth_rate(drag) == pytest.approx(roots.real.max(), rel=1e-9, abs=1e-12)


def test_a_kicked_state_moves_as_linear_theory_says():
    start, _, interaction = state()
    steps, dt, size = 4000, 0.01, 1e-9
    motion = move(
        start.packing, start.initial_velocity(size), interaction, Undamped(), dt, Stop(0.0, steps)
    )
    moved = nonaffine_motion(start.packing, motion.packing)
    omega = start.frequency + 1j * start.growth_rate
    weight = start.eigenvalue.real + start.eigenvalue.imag
    weight += 1j * (start.eigenvalue.imag - start.eigenvalue.real)
    field = weight * start.mode
    scale = size / np.sqrt((field.real[:, :2] ** 2).sum(axis=1).mean())
    expected = scale * (field * np.sin(omega * steps * dt) / omega).real
    assert np.abs(moved - expected).max() < 1e-3 * np.abs(expected).max()


def test_drag_acts_in_every_piece_of_a_run_from_its_first_step_on():
    """Free grains in pieces of one step slow down as e^(−ηt)."""
    packing = Packing.from_positions([[1.0, 1.0], [4.0, 4.0]], [1.0, 0.7], 6.0)
    interaction, motion = state()[2], Motion(packing, np.full((2, 3), 0.01), 0, np.inf)
    for _ in range(100):
        motion = move(motion.packing, motion.velocity, interaction, Drag(0.8), 1e-2, Stop(0.0, 1))
    np.testing.assert_allclose(motion.velocity, 0.01 * np.exp(-0.8), rtol=1e-2)


def moved_state(size: float = 0.02):
    """The state some time after a hard kick, contacts gone and made."""
    start, _, interaction = state()
    motion = move(
        start.packing, start.initial_velocity(size), interaction, Undamped(), 0.05, Stop(0.0, 500)
    )
    return start.packing, motion, interaction


def test_a_record_is_what_its_names_say():
    start, now, interaction = moved_state()
    found = record_motion(25.0, now, start, interaction)
    contacts, packing = find_contacts(now.packing), now.packing
    moved = nonaffine_motion(start, packing)
    m = sum(moved[i, 0] ** 2 + moved[i, 1] ** 2 for i in range(50)) / 50
    a = sum((2.0 * moved[i, 2] / packing.diameter[i]) ** 2 for i in range(50)) / 50
    np.testing.assert_allclose(found[1:3], (m, a), rtol=1e-12)
    sigma = stress(packing, contacts, interaction)
    np.testing.assert_allclose(
        found[3:6], (-(sigma[0, 0] + sigma[1, 1]) / 2, sigma[0, 1], sigma[1, 0])
    )
    v = now.velocity
    kinetic = sum(0.5 * (v[i, 0] ** 2 + v[i, 1] ** 2 + 0.5 * v[i, 2] ** 2) for i in range(50))
    assert found.kinetic_energy == pytest.approx(kinetic)
    assert found.contact_number == 2 * len(contacts.i) / 50
    first = find_contacts(start)
    pairs = [set(zip(c.i.tolist(), c.j.tolist(), strict=True)) for c in (first, contacts)]
    assert found.changed == len(pairs[0] ^ pairs[1]) > 0


def test_sliding_contacts_are_those_beyond_the_threshold():
    for tangential in ("smoothed_coulomb", "sharp_coulomb"):
        packing = crowd(5, slip=1.0)
        interaction = Interaction.from_law(ContactLaw("hertz", tangential, 0.5, 0.3))
        contacts = find_contacts(packing)
        over = np.abs(contacts.displacement) >= 0.3 / 0.5 * contacts.overlap
        still = Motion(packing, np.zeros((16, 3)), 0, 0.0)
        turning = replace(packing, rotation=np.zeros(16))
        found = record_motion(0.0, replace(still, packing=turning), turning, interaction).sliding
        assert 0 < found == over.sum() < len(over)
    never = Interaction.from_law(ContactLaw("hertz", "elastic", 0.5))
    assert record_motion(0.0, replace(still, packing=turning), turning, never).sliding == 0


def test_the_pressures_of_the_grains_add_up():
    """C, Fig. 10: P = Σ_i P_i, whatever the tangential forces are."""
    start, now, interaction = moved_state()
    found = grain_stress(now.packing, interaction)
    assert found.pressure.sum() == pytest.approx(
        record_motion(0.0, now, start, interaction).pressure
    )
    assert found.binary.sum() / (2.0 * start.box_length**2) == pytest.approx(found.pressure.sum())
    assert found.contacts.sum() == 2 * len(found.binary)


@pytest.mark.parametrize("rate", [1e-3, -2e-4, 0.0])
def test_a_fit_is_found_from_a_wrong_guess(rate):
    """ω_r off by half a per cent, a hundred turns of phase over the window."""
    frequency, depth, phase = 0.7, 0.4, 1.1
    even = np.arange(0.0, 1e4, 29.0)
    close = 3000.0 + np.arange(288) * 2 * np.pi / frequency / 24
    time = np.sort(np.concatenate([even, close]))
    square = 3e-20 * np.exp(2 * rate * time)
    square *= 1 + depth * np.cos(2 * frequency * time - phase)
    fit = fit_growth(time, square, 1.2 * rate + 1e-5, 1.005 * frequency)
    assert fit.rate == pytest.approx(rate, abs=1e-9)
    assert fit.frequency == pytest.approx(frequency, rel=1e-7)
    assert (fit.size, fit.depth) == pytest.approx((3e-20, depth), rel=1e-5)
    assert fit.phase == pytest.approx(phase, abs=1e-4)
    assert fit.misfit < 1e-6
    np.testing.assert_allclose(fit.at(time), square, rtol=1e-4)


def test_errors_of_a_fit_are_those_of_noise():
    draws = np.random.default_rng(4)
    time = np.arange(0.0, 400.0, 0.25)
    clean = np.exp(2e-3 * time) * (1 + 0.5 * np.cos(1.4 * time))
    fits = [
        fit_growth(time, clean * (1 + 1e-2 * draws.standard_normal(len(time))), 1e-3, 0.7)
        for _ in range(60)
    ]
    for name in ("rate", "frequency"):
        spread = np.std([getattr(fit, name) for fit in fits])
        assert np.mean([getattr(fit, f"{name}_error") for fit in fits]) == pytest.approx(
            spread, rel=0.35
        )


def test_too_few_records_have_no_fit():
    time = np.arange(MIN_RECORDS - 1.0)
    assert np.isnan(fit_growth(time, np.exp(time), 0.5, 1.0)).all()


def window(run: ReleaseRun) -> np.ndarray:
    square = series(run, "mean_square_displacement")
    return (square > 1e-19) & (square < 1e-11)


@pytest.mark.parametrize("quantity", ["mean_square_displacement", "mean_square_rotation"])
def test_growth_and_frequency_are_those_of_the_pair_to_order_dt_squared(quantity):
    """Measured in units of what Verlet makes of a mode: (ω_r Δt)²/8 of ω_i, /24 of ω_r."""
    start, _, _ = state()
    for dt in (0.2, 0.1):
        run = released(replace(SHORT, time_step=dt))
        used = window(run)
        fit = fit_growth(
            series(run, "time")[used],
            series(run, quantity)[used],
            start.growth_rate,
            start.frequency,
        )
        assert fit.rate / start.growth_rate - 1 == pytest.approx(
            (start.frequency * dt) ** 2 / 8, rel=0.1
        )
        assert fit.frequency / start.frequency - 1 == pytest.approx(
            (start.frequency * dt) ** 2 / 24, rel=0.1
        )
        assert fit.misfit < 1e-3


def test_round_off_alone_grows_alike():
    start, _, _ = state()
    run = released(
        Release(initial_velocity=0.0, duration=26.0, min_time=0.0, n_records=900, spectra=0)
    )
    assert series(run, "mean_square_displacement")[:30].max() < 1e-29
    used = window(run)
    fit = fit_growth(
        series(run, "time")[used],
        series(run, "mean_square_displacement")[used],
        start.growth_rate,
        start.frequency,
    )
    assert fit.rate == pytest.approx(start.growth_rate, rel=1e-2)
    assert fit.frequency == pytest.approx(start.frequency, rel=1e-2)


def test_a_film_shows_every_grain_a_part_of_a_turn_apart():
    start, _, _ = state()
    run = released()
    assert len(run.film) == FRAMES
    steps = np.array([step for step, _ in run.film])
    turns = np.diff(steps) * SHORT.time_step * start.frequency / (2 * np.pi)
    np.testing.assert_allclose(turns - np.rint(turns), 1 / 24, atol=0.02)
    assert (steps[-1] - steps[0]) * SHORT.time_step * start.growth_rate == pytest.approx(
        2.0, abs=0.8
    )


def test_the_film_of_a_fast_growth_is_no_longer_than_that_of_a_slow_one():
    start, _, interaction = state()
    fast = replace(start, eigenvalue=(0.24 + 0.06j) ** 2)
    run = ReleaseRun.from_state(fast, interaction, SHORT)
    run._plan_dense_records()
    taken = np.array(sorted(run.frame_steps)) * SHORT.time_step
    assert len(taken) == FRAMES
    assert taken[-1] * fast.growth_rate == pytest.approx(1.5, rel=0.02)


def test_a_loose_grain_draws_no_spiral():
    run = released()
    fit = release_outcome(run).displacement
    still = [(step, moved * (np.arange(50) != 7)[:, None]) for step, moved in run.film]
    loose = SimpleNamespace(film=still, choices=run.choices, start=run.start)
    assert fit_spirals(loose, fit).axis_ratio == pytest.approx(
        fit_spirals(run, fit).axis_ratio, rel=0.1
    )


@pytest.mark.parametrize("times", [1.8, 2.2])
def test_growth_stops_at_a_drag_of_twice_its_rate(times):
    """Not at ω_i: s² + ηs + λ' = 0 has Re s = ω_i − η/2."""
    start, _, _ = state()
    run = released(SHORT, drag=times * start.growth_rate)
    time, square = series(run, "time"), series(run, "mean_square_displacement")
    means = [
        np.log(square[(time >= a * time[-1]) & (time <= (a + 0.1) * time[-1])].mean())
        for a in (0.2, 0.8)
    ]
    expected = 2.0 * (1.0 - 0.5 * times) * start.growth_rate * 0.6 * time[-1]
    assert means[1] - means[0] == pytest.approx(expected, rel=0.1, abs=0.05)


def test_the_outcome_of_a_run_is_found_from_its_records():
    """A made-up run: growth, contacts change at 5e-8, a plateau from 1e-7 on, a second rise."""
    start, _, _ = state()
    rate, turn = start.growth_rate, 2 * np.pi / start.frequency
    even = np.arange(0.0, 60.0, 0.05) / rate
    time = np.unique(np.concatenate([even, 7.0 / rate + turn / 24 * np.arange(288)]))
    growth = 1e-22 * np.exp(2 * rate * time)
    square = np.minimum(growth * (1 + 0.2 * np.cos(2 * start.frequency * time)), 1e-7)
    overlap = find_contacts(start.packing).overlap.mean()
    square[time > 40.0 / rate] = 0.8 * overlap**2
    square[time > 50.0 / rate] = 1.2 * overlap**2
    blank = np.zeros(len(MotionRecord._fields))
    records = [
        MotionRecord(*(t, m, m), *blank[3:])._replace(changed=int(m > 5e-8))
        for t, m in zip(time, square, strict=True)
    ]
    outcome = release_outcome(SimpleNamespace(start=start, drag=0.0, records=records))
    grown = np.log(1e-7 / 1e-22) / 2
    assert outcome.displacement.rate == pytest.approx(rate, rel=1e-6)
    assert outcome.displacement.depth == pytest.approx(0.2, rel=1e-3)
    assert outcome.rotation == pytest.approx(outcome.displacement)
    assert outcome.end.time * rate == pytest.approx(grown + 0.5 * np.log(2.0), abs=0.2)
    assert outcome.end.square == pytest.approx(2e-7, rel=0.3)
    assert outcome.change.time * rate == pytest.approx(grown + 0.5 * np.log(0.5), abs=0.2)
    assert 5e-8 < outcome.change.square <= 1e-7
    assert outcome.second == (pytest.approx(50.05 / rate, rel=1e-3), 1.2 * overlap**2)
    assert outcome.largest == outcome.second.square
    assert outcome.after.mean_square_displacement == pytest.approx(outcome.largest)


def test_what_does_not_happen_has_no_moment():
    outcome = release_outcome(released(SHORT, drag=10.0 * state()[0].growth_rate))
    assert np.isnan([*outcome.displacement, *outcome.end, *outcome.change, *outcome.second]).all()


def test_equation_25_needs_the_other_vector_in_its_last_term():
    """J u_i = λ_i u_r + λ_r u_i; printed is λ_r u_r."""
    start, _, interaction = state()
    matrix = jacobian(start.packing, find_contacts(start.packing), interaction)
    mass = generalized_mass(start.packing.mass).ravel()
    u_r, u_i = start.mode.real.ravel(), start.mode.imag.ravel()
    found, value = matrix @ u_i / mass, start.eigenvalue
    right, printed = (value.imag * u_r + value.real * vector for vector in (u_i, u_r))
    assert np.abs(found - right).max() < 1e-13
    assert np.abs(found - printed).max() > 0.01


def test_a_state_that_leaves_too_slowly_is_refused():
    start, _, interaction = state()
    with pytest.raises(ArithmeticError, match="omega_i"):
        ReleaseRun.from_state(start, interaction, Release(max_steps=1000))


def test_only_a_run_without_damping_goes_on_to_the_end_of_its_plateau():
    choices = Release(duration=0.05, min_time=400.0, n_records=10, spectra=5)
    free, damped = released(choices), released(choices, 0.1 * state()[0].growth_rate)
    growth = choices.duration / state()[0].growth_rate
    assert series(damped, "time")[-1] == pytest.approx(growth, rel=0.02)
    time = series(free, "time")
    assert 400.0 <= time[-1] < 400.0 + 2.0 * growth
    assert np.isclose(time[:, None], np.linspace(0.0, time[-1], 11)).any(axis=0).all()
    assert np.isclose(time[:, None], np.linspace(0.0, growth, 11), atol=0.5).any(axis=0).all()
    assert len(free.spectra) == 6


def test_momentum_is_kept_to_round_off():
    run = released()
    velocity = run.motion.velocity[:, :2]
    assert np.abs(state()[0].packing.mass @ velocity).max() < 1e-11 * np.abs(velocity).max()


def test_without_friction_the_energy_oscillates_by_dt_squared():
    """Drift and swing of the total energy fall by four when Δt is halved."""
    packing = reference("hertz_n64_phi0.900_seed1")[1]
    interaction = Interaction(Hertz(1.0), Elastic(0.0))
    start = np.random.default_rng(2).normal(0.0, 1e-4, (64, 3))
    off = [energy_error(packing, start, interaction, dt) for dt in (0.2, 0.1, 0.05)]
    np.testing.assert_allclose(np.log2(np.divide(off[:-1], off[1:])), 2.0, atol=0.3)


def energy_error(packing, start, interaction, dt: float) -> float:
    inertia = packing.mass[:, None] * np.array([1.0, 1.0, 0.5])
    motion, totals = Motion(packing, start, 0, np.inf), []
    for _ in range(100):
        kinetic = 0.5 * (inertia * motion.velocity**2).sum()
        totals.append(kinetic + energy(find_contacts(motion.packing), interaction))
        motion = move(
            motion.packing, motion.velocity, interaction, Undamped(), dt, Stop(0.0, round(2 / dt))
        )
    return np.abs(np.array(totals) - totals[0]).max()


def test_a_loose_grain_changes_no_contacts():
    start, _, interaction = state()
    n, contacts = start.packing.n, find_contacts(start.packing)
    without_last = contacts.among(np.arange(n) < n - 1)
    assert count_changed_contacts(contacts, without_last, n, interaction) == 0
    assert (
        count_changed_contacts(without_last, contacts, n, interaction)
        == len(contacts.i) - len(without_last.i)
        > 0
    )
