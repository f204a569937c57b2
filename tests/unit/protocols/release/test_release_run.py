"""Whole releases: growth as linear theory says, the film, the end, conserved quantities."""

from dataclasses import replace

import numpy as np
import pytest

from example_packings import reference
from grainmodes.kernels.damping import Drag, Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Elastic, Hertz, Interaction
from grainmodes.packing.forces import energy
from grainmodes.packing.state import Packing
from grainmodes.parameters.release import Release
from grainmodes.protocols.release.followed_pair import MAX_LOSSES, FollowedPair
from grainmodes.protocols.release.growth_fit import fit_growth
from grainmodes.protocols.release.outcome import release_outcome
from grainmodes.protocols.release.release_run import (
    EARLY_TURNS,
    FILM_GROWTH_TIMES,
    FRAMES,
    RECORDS_PER_TURN,
    ReleaseRun,
)
from grainmodes.relaxation.dynamics import Motion, move
from released import SHORT, released, series, state


def test_drag_acts_in_every_piece_of_a_run_from_its_first_step_on():
    """Free grains in pieces of one step slow down as e^(−ηt)."""
    packing = Packing.from_positions([[1.0, 1.0], [4.0, 4.0]], [1.0, 0.7], 6.0)
    interaction, motion = state()[2], Motion(packing, np.full((2, 3), 0.01), 0, np.inf)
    for _ in range(100):
        motion = move(motion.packing, motion.velocity, interaction, Drag(0.8), 1e-2, Stop(0.0, 1))
    np.testing.assert_allclose(motion.velocity, 0.01 * np.exp(-0.8), rtol=1e-2)


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
        time, square = series(run, "time")[used], series(run, quantity)[used]
        fit = fit_growth(time, square, start.growth_rate, start.frequency)
        error = (start.frequency * dt) ** 2
        assert fit.rate / start.growth_rate - 1 == pytest.approx(error / 8, rel=0.1)
        assert fit.frequency / start.frequency - 1 == pytest.approx(error / 24, rel=0.1)
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
    length = (steps[-1] - steps[0]) * SHORT.time_step
    assert length * start.growth_rate == pytest.approx(2.0, abs=0.8)


def test_the_film_of_a_fast_growth_is_no_longer_than_that_of_a_slow_one():
    start, _, interaction = state()
    fast = replace(start, eigenvalue=(0.24 + 0.06j) ** 2)
    run = ReleaseRun.from_state(fast, interaction, SHORT)
    run._plan_film()
    taken = np.array(sorted(run.frame_steps)) * SHORT.time_step
    assert len(taken) == FRAMES
    assert taken[-1] * fast.growth_rate == pytest.approx(FILM_GROWTH_TIMES, rel=0.02)


@pytest.mark.parametrize(
    ("motion", "times"),
    [
        ("translations", 1.0),
        ("translations", 3.0),
        ("translations", 5.0),
        ("all", 1.0),
        ("all", 2.2),
    ],
)
def test_growth_under_a_drag_is_that_of_the_quadratic_eigenproblem(motion, times):
    """0.73 ω_i at η_0 = ω_i where C damps, translations alone; 0.5 ω_i where all is damped."""
    start, _, interaction = state()
    choices = replace(SHORT, damped_motion=motion)
    drag = times * start.growth_rate
    run = released(choices, drag=drag)
    time, square = series(run, "time"), series(run, "mean_square_displacement")
    means = [
        np.log(square[(time >= a * time[-1]) & (time <= (a + 0.1) * time[-1])].mean())
        for a in (0.4, 0.8)
    ]
    rate = start.under_drag(interaction, motion).rates(np.array([drag]))[0]
    assert (means[1] - means[0]) / (0.8 * time[-1]) == pytest.approx(
        rate, abs=0.03 * start.growth_rate
    )


def test_a_state_that_leaves_too_slowly_is_refused():
    start, _, interaction = state()
    with pytest.raises(ArithmeticError, match="omega_i"):
        ReleaseRun.from_state(start, interaction, Release(max_steps=1000))


def test_every_run_goes_on_to_the_end_of_the_plateau():
    choices = Release(duration=0.05, min_time=400.0, n_records=10, spectra=5)
    free, damped = released(choices), released(choices, 0.1 * state()[0].growth_rate)
    growth = choices.duration / state()[0].growth_rate
    time = series(free, "time")
    assert series(damped, "time")[-1] == time[-1]
    assert 400.0 <= time[-1] < 400.0 + 2.0 * growth
    assert np.isclose(time[:, None], np.linspace(0.0, time[-1], 11)).any(axis=0).all()
    assert np.isclose(time[:, None], np.linspace(0.0, growth, 11), atol=0.5).any(axis=0).all()
    assert not damped.spectra and damped.pair is None


def test_spectra_are_even_on_a_logarithmic_axis():
    start, _, _ = state()
    choices = Release(duration=3.0, min_time=0.0, n_records=10, spectra=7)
    run = released(choices)
    times = np.array([step for step, _ in run.spectra]) * choices.time_step * start.growth_rate
    np.testing.assert_allclose(times, [0.0, *np.geomspace(0.3, 3.0, 7)], rtol=0.01)
    followed = np.array([step for step, _ in run.pair.imaginary])
    assert len(followed) == 1 + 6 * 5 + 1
    assert set(followed) >= {step for step, _ in run.spectra}


def test_the_released_pair_is_followed_while_it_grows():
    start, _, interaction = state()
    run = released(Release(duration=3.0, min_time=0.0, n_records=10, spectra=4))
    imaginary = [value for _, value in run.pair.imaginary]
    np.testing.assert_allclose(imaginary, start.eigenvalue.imag, rtol=1e-5)
    packing = start.packing
    open_ = replace(packing, diameter=0.97 * packing.diameter)
    pair = FollowedPair.from_state(start, interaction)
    for step in range(MAX_LOSSES + 1):
        pair.follow(step, open_, interaction)
    assert [value for _, value in pair.imaginary] == [0.0] * (MAX_LOSSES + 1)
    assert pair.is_lost


def test_a_pair_has_died_with_the_first_of_five_states_without_it():
    values = [1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    pair = FollowedPair(None, [(10 * step, value) for step, value in enumerate(values)])
    assert pair.death_step == 40
    assert FollowedPair(None, pair.imaginary[:8]).death_step is None
    assert not pair.is_lost


def test_the_first_turns_are_those_of_the_paper_s_sine():
    """C, Fig. 6 (a): M ∝ e^(2ω_i t) sin²(ω_r t), back to 0 twice a turn."""
    start, _, _ = state()
    run = released(replace(SHORT, duration=0.1))
    time, square = series(run, "time"), series(run, "mean_square_displacement")
    early = time <= EARLY_TURNS * 2 * np.pi / start.frequency
    assert early.sum() >= EARLY_TURNS * RECORDS_PER_TURN
    shape = np.exp(2 * start.growth_rate * time) * np.sin(start.frequency * time) ** 2
    size = shape[early] @ square[early] / (shape[early] @ shape[early])
    assert np.abs(square[early] - size * shape[early]).max() < 0.1 * size
    half_turns = np.isclose(np.sin(start.frequency * time[early]), 0.0, atol=0.04)
    assert half_turns.sum() >= EARLY_TURNS
    assert square[early][half_turns].max() < 0.01 * square[early].max()


def test_from_noise_the_fastest_pair_grows_out_of_all_modes():
    """C, Sec. VI B: the dynamics is dominated by the mode with the largest ω_i, one of eight."""
    start, _, interaction = state()
    choices = replace(SHORT, duration=40.0, n_records=2000)
    run = ReleaseRun.from_noise(start, interaction, choices, 3, 1e-10)
    speed = np.sqrt((run.motion.velocity[:, :2] ** 2).sum(axis=1).mean())
    assert speed == pytest.approx(choices.initial_velocity)
    while not run.done:
        run.advance()
    assert run.steps < run.last_step
    fit = release_outcome(run, start.growth_rate).displacement
    assert fit.rate == pytest.approx(start.growth_rate, rel=0.05)
    assert fit.frequency == pytest.approx(start.frequency, rel=2e-3)


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
        totals.append(kinetic + energy(motion.packing, interaction))
        motion = move(
            motion.packing, motion.velocity, interaction, Undamped(), dt, Stop(0.0, round(2 / dt))
        )
    return np.abs(np.array(totals) - totals[0]).max()
