"""Δt of velocity Verlet: its order with and without forces that depend on the velocity. A, App. B.

    Q̇ = q̇ + Δt f̃(q, Q̇)/2,   q → q + Δt Q̇,   q̇ → Q̇ + Δt f̃(q, Q̇)/2           A (B7)–(B9)

According to A a step is right to order Δt² in q and Δt in q̇ (A18): its errors are of order Δt³ and
Δt². Over a given time the errors of all steps add up, to order Δt in both. Without damping f does
not depend on q̇, a step is right to one more order in q̇, and a motion has order 2. Beyond the limit
Δt = 2/ω_max a mode grows in every step; a setting whose error exceeds the motion itself has failed.

    q, q̇        |Δq| and |Δq̇| in units of |q|, |q̇| at the start, after `DURATION` or after one step
    growth      |ω_i(Δt)/ω_i − 1| of an unstable state of C (`growth`)

Reference of a motion: the same with a Δt 32 times shorter than the shortest, of a step: 64 steps
within it; of the growth: ω_i of M⁻¹J by LAPACK.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.damping import Dashpot, Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.neighbours import FRACTION_UNIT
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.release import Release
from grainmodes.parameters.strain import StepStrain
from grainmodes.relaxation.dynamics import Motion, move
from grainmodes.stages.rows import SAMPLE_ERRORS
from measurements.accuracy.diagram import (
    FAILED,
    Diagram,
    DiagramRow,
    Size,
    TimedError,
    in_fresh_process,
    size_suffix,
    summarise,
    timed,
)
from measurements.accuracy.growth_rate import UnstableState, unstable_state
from measurements.accuracy.packings import compressed

PHI, INTERACTION = 0.9, Interaction.from_law(ContactLaw(kt=1.0))

TIME_STEPS = (2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)
DURATION = 10.0

REFERENCE_REFINEMENT, STEPS_WITHIN_STEP = 32, 64
"""Factors by which the Δt of the reference is shorter, for a motion and for a single step."""

AMPLITUDE = 1e-6
"""Size of displacements and velocities at the start, in d and d/t_0; no contact opens."""

DAMPINGS = {"no damping": Undamped(), "dashpots": Dashpot(StepStrain().damping)}
DEFAULTS = {"no damping": Release().time_step, "dashpots": StepStrain().time_step}
UNSTABLE_N = 32
"""Number of grains of an unstable state, which LAPACK finds among 200 states."""

QUANTITIES = ("$q$", r"$\dot q$")
SPANS = (f"{DURATION:g} $t_0$", "one step")


class Start(NamedTuple):
    """A moving packing, with velocities (N, 3) in d/t_0."""

    packing: Packing
    velocity: np.ndarray

    def after(self, damping, time_step: float, steps: int) -> Motion:
        """The motion after so many steps."""
        return move(self.packing, self.velocity, INTERACTION, damping, time_step, Stop(0.0, steps))


def perturbed(n: int, seed: int) -> Start:
    """A packing slightly out of balance, whose grains move slowly."""
    packing = compressed(n, seed, PHI)
    kick = AMPLITUDE * np.random.default_rng(seed).standard_normal((2, n, 3))
    return Start(replace(packing.displaced(kick[0, :, :2]), rotation=kick[0, :, 2]), kick[1])


def errors(motion: Motion, exact: Motion) -> tuple[float, float]:
    """|Δq| and |Δq̇| between two ends of a motion, root mean squares in units of `AMPLITUDE`."""
    length = motion.packing.box_length * FRACTION_UNIT
    step = (motion.packing.fraction - exact.packing.fraction) * length
    turn = motion.packing.rotation - exact.packing.rotation
    off = np.concatenate([step.ravel(), turn]), motion.velocity - exact.velocity
    position, velocity = (float(np.sqrt(np.mean(part**2))) / AMPLITUDE for part in off)
    return position, velocity


def measure(size: Size) -> Iterator[DiagramRow]:
    """Rows for every damping, span, quantity and Δt, then for the growth of unstable states."""
    for n in size.n:
        starts = [perturbed(n, seed) for seed in range(size.seeds)]
        for name, damping in DAMPINGS.items():
            steps = round(DURATION * REFERENCE_REFINEMENT / min(TIME_STEPS))
            exact = [start.after(damping, DURATION / steps, steps) for start in starts]
            for time_step in TIME_STEPS:
                done = in_fresh_process(timed_errors, name, time_step, starts, exact)
                for (span, what), samples in done.value.items():
                    default = span == SPANS[0] and time_step == DEFAULTS[name]
                    curve = f"{name}, {what} after {span}{size_suffix(n, size)}"
                    yield summarise(curve, time_step, samples, done.megabytes, default)
    yield from growth(size.seeds)


def growth(seeds: int) -> Iterator[DiagramRow]:
    """Rows of the growth rate for every Δt, over the seeds that have an unstable state."""
    states = [
        state for state in (unstable_state(UNSTABLE_N, seed) for seed in range(seeds)) if state
    ]
    for time_step in TIME_STEPS:
        done = in_fresh_process(growth_errors, time_step, states)
        default = time_step == DEFAULTS["no damping"]
        yield summarise("no damping, growth rate", time_step, done.value, done.megabytes, default)


def timed_errors(name: str, time_step: float, starts: list[Start], exact: list[Motion]) -> dict:
    """(span, quantity) → a sample for every start."""
    starts[0].after(DAMPINGS[name], time_step, 1)
    samples = [
        _timed_errors(start, DAMPINGS[name], time_step, end)
        for start, end in zip(starts, exact, strict=True)
    ]
    return {key: [sample[key] for sample in samples] for key in product(SPANS, QUANTITIES)}


def _timed_errors(start: Start, damping, time_step: float, exact: Motion) -> dict:
    """(span, quantity) → the sample of one start."""
    steps = round(DURATION / time_step)
    seconds, whole = np.nan, (np.inf, np.inf)
    with suppress(*SAMPLE_ERRORS):
        motion, seconds = timed(start.after, damping, time_step, steps)
        whole = errors(motion, exact)
    seconds /= DURATION * start.packing.n
    once = start.after(damping, time_step, 1)
    often = start.after(damping, time_step / STEPS_WITHIN_STEP, STEPS_WITHIN_STEP)
    found = [*whole, *errors(once, often)]
    samples = [_unless_beyond_motion(TimedError(seconds, error)) for error in found]
    return dict(zip(product(SPANS, QUANTITIES), samples, strict=True))


def growth_errors(time_step: float, states: list[UnstableState]) -> list[TimedError]:
    """The error of ω_i of every state."""
    states[0].rate(max(TIME_STEPS))
    return [_growth_error(time_step, state) for state in states]


def _growth_error(time_step: float, state: UnstableState) -> TimedError:
    try:
        rate, seconds = timed(state.rate, time_step)
    except SAMPLE_ERRORS:
        return FAILED
    seconds /= state.duration * state.packing.n
    return _unless_beyond_motion(TimedError(seconds, abs(rate / state.omega.imag - 1.0)))


def _unless_beyond_motion(sample: TimedError) -> TimedError:
    """The sample; it has failed if its error exceeds the motion itself."""
    return sample if sample.error < 1.0 else FAILED


DIAGRAM = Diagram(
    title="Time step of velocity Verlet, φ = 0.90, k_T/k_N = 1; growth: law of C, N = 32",
    setting=r"$\Delta t \,/\, t_0$",
    unit="$t_0$ and grain",
    error="relative error",
    reference="motions and steps: a far shorter Δt; growth rate: $M^{-1}J$",
    small=Size((64,), 8),
    large=Size((256, 1024), 32),
    measure=measure,
)
