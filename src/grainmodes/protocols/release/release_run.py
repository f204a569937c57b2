"""The release of an unstable state: its dynamics without or with a drag: C, Sec. VI and VII.

    M q̈ = F̃(q, s) − η_0 B q̇,   q(0) in balance,   q̇(0) along ü^m of C (28), or at random, or 0

B damps translations alone (C, Sec. VII) or all motion. Velocity Verlet runs from one record to the
next. A state is recorded

- in even intervals, `n_records` of them during the growth and as many longer ones to the end of the
  run, and whenever the time has grown by a tenth;
- densely in the first `EARLY_TURNS` turns of 2π/ω_r (C, Fig. 6 (a), (b)), and again once M has
  reached 1e-16 d², for `DENSE_TURNS` turns, `RECORDS_PER_TURN` times a turn;
- in a film of `FRAMES` frames (C, Fig. 5), which starts at M = 1e-16 d² too and is about 2 / ω_i
  long. Some whole turns and a 24th of a turn pass between two frames, so that the film shows how
  the spirals turn, however many turns the growth takes; less than a 24th where it takes less than
  ten turns;
- with all eigenvalues of M⁻¹J at times that are even on a logarithmic axis from 0.3 / ω_i on (C,
  Fig. 8), and with those of the pair alone, followed from the start, at more such times.

Verlet turns a mode of frequency Ω at (2/Δt) arcsin(ΩΔt/2), so that ω_i is too large by the part
(ω_r Δt)²/8 and ω_r by (ω_r Δt)²/24; at Δt = 0.1 that is 1e-3 and less.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from grainmodes.kernels.damping import Drag, TranslationalDrag, Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import nonaffine_motion
from grainmodes.parameters.release import DENSE_RECORDS_ONSET, Release
from grainmodes.protocols.release.followed_pair import FollowedPair
from grainmodes.protocols.release.record import MotionRecord, record_motion
from grainmodes.protocols.release.unstable_state import UnstableState
from grainmodes.relaxation.dynamics import Damping, Motion, move
from grainmodes.response.stability import mass_weighted_eigenvalues
from grainmodes.runtime.progress import Progress

DRAGS: dict[str, Callable[[float], Damping]] = {"translations": TranslationalDrag, "all": Drag}
"""What is damped → the type of the damping."""

EARLY_TURNS, DENSE_TURNS, RECORDS_PER_TURN = 6, 12, 24
"""Turns of 2π/ω_r that are recorded densely, and the number of records in each."""

FRAMES, FILM_GROWTH_TIMES = 240, 2.0
"""Number of frames of the film, and its length in 1/ω_i."""

MAX_SPECTRUM_DOF = 1500
"""Degrees of freedom up to which all eigenvalues are computed on the way, in 3 s each time."""

SPECTRA_ONSET = 0.3
"""Time of the first spectrum after the start, in 1/ω_i."""

FOLLOWS_PER_SPECTRUM = 5
"""How often the pair is followed between two spectra."""


@dataclass
class ReleaseRun:
    """A release on its way, with everything recorded so far.

    `drag` is η_0 in 1/t_0. `film` holds (step, Δq (N, 3) in d) of every frame, `spectra` (step,
    eigenvalues of M⁻¹J (3N,)), `pair` the pair followed along the run. The steps of a plan are
    those that are still to come; `is_dense` says whether M has reached `DENSE_RECORDS_ONSET`.
    """

    start: UnstableState
    interaction: Interaction
    choices: Release
    drag: float
    motion: Motion
    stop_beyond: float = np.inf
    steps: int = 0
    records: list[MotionRecord] = field(default_factory=list)
    film: list[tuple[int, np.ndarray]] = field(default_factory=list)
    spectra: list[tuple[int, np.ndarray]] = field(default_factory=list)
    pair: FollowedPair | None = None
    is_dense: bool = False
    planned_steps: list[int] = field(default_factory=list)
    frame_steps: frozenset[int] = frozenset()
    spectrum_steps: frozenset[int] = frozenset()
    follow_steps: frozenset[int] = frozenset()

    @classmethod
    def from_state(
        cls, start: UnstableState, interaction: Interaction, choices: Release, drag: float = 0.0
    ) -> ReleaseRun:
        """A release along ü^m that has not moved yet; without a drag it also takes spectra.

        Raises:
            ArithmeticError: it would take more than `choices.max_steps` steps.
        """
        velocity = start.initial_velocity(choices.initial_velocity)
        run = cls._at_rest(start, interaction, choices, drag, velocity)
        run._plan(run._turns(EARLY_TURNS))
        if not drag and choices.spectra:
            run._plan_spectra()
        run._record()
        return run

    @classmethod
    def from_noise(
        cls,
        start: UnstableState,
        interaction: Interaction,
        choices: Release,
        seed: int,
        stop_beyond: float,
    ) -> ReleaseRun:
        """A release with random velocities, which ends once M has grown beyond `stop_beyond`.

        Raises:
            ArithmeticError: it would take more than `choices.max_steps` steps.
        """
        velocity = start.random_velocity(choices.initial_velocity, seed)
        run = cls._at_rest(start, interaction, choices, 0.0, velocity)
        run.stop_beyond = stop_beyond
        run._record()
        return run

    @classmethod
    def _at_rest(
        cls,
        start: UnstableState,
        interaction: Interaction,
        choices: Release,
        drag: float,
        velocity: np.ndarray,
    ) -> ReleaseRun:
        run = cls(start, interaction, choices, drag, Motion(start.packing, velocity, 0, np.inf))
        if run.last_step > choices.max_steps:
            raise ArithmeticError(
                f"release at omega_i = {start.growth_rate:.1e}: expected at most "
                f"{choices.max_steps} steps, got {run.last_step}"
            )
        return run

    @property
    def last_step(self) -> int:
        """The step with which the run ends at the latest."""
        return self._late_interval * self.choices.n_records

    @property
    def done(self) -> bool:
        """Whether the run has ended."""
        beyond = self.records[-1].mean_square_displacement > self.stop_beyond
        return self.steps >= self.last_step or beyond

    restartable = True
    """The state of a run between two records alone determines what follows."""

    @property
    def progress(self) -> Progress:
        """How far the release is."""
        square = self.records[-1].mean_square_displacement
        words = f"{self.steps} of {self.last_step} steps, M = {square:.1e}"
        return Progress(self.steps / self.last_step, words, self.steps, "steps")

    def advance(self) -> bool:
        """Go on to the next record, which is always possible: True.

        Raises:
            ArithmeticError: the motion grew beyond all bounds: the time step is too long.
        """
        next_step = self._next_step()
        damping = DRAGS[self.choices.damped_motion](self.drag) if self.drag else Undamped()
        self.motion = move(
            self.motion.packing,
            self.motion.velocity,
            self.interaction,
            damping,
            self.choices.time_step,
            Stop(0.0, next_step - self.steps),
        )
        self.steps = next_step
        self._record()
        return True

    @property
    def _growth_interval(self) -> int:
        """Steps between two even records during the growth."""
        growth_steps = self.choices.duration / (self.start.growth_rate * self.choices.time_step)
        return max(1, round(growth_steps / self.choices.n_records))

    @property
    def _late_interval(self) -> int:
        """Steps between two even records after the growth, a multiple of those during it."""
        interval = self._growth_interval
        least = self.choices.min_time / self.choices.time_step
        return interval * max(1, math.ceil(least / (interval * self.choices.n_records)))

    def _next_step(self) -> int:
        """The step of the next record."""
        growing = self.steps < self._growth_interval * self.choices.n_records
        interval = self._growth_interval if growing else self._late_interval
        even = (self.steps // interval + 1) * interval
        return min([even, self.steps + max(1, self.steps // 10), *self.planned_steps[:1]])

    def _record(self) -> None:
        """Record the present state, with what else is due at this step."""
        time, packing = self.steps * self.choices.time_step, self.start.packing
        record = record_motion(time, self.motion, packing, self.interaction)
        self.records.append(record)
        if self.planned_steps[:1] == [self.steps]:
            del self.planned_steps[0]
        if not self.is_dense and record.mean_square_displacement > DENSE_RECORDS_ONSET:
            self.is_dense = True
            self._plan_film()
        if self.steps in self.frame_steps:
            self.film.append((self.steps, nonaffine_motion(packing, self.motion.packing)))
        if self.steps in self.spectrum_steps:
            self.spectra.append(
                (self.steps, mass_weighted_eigenvalues(self.motion.packing, self.interaction))
            )
        if self.pair is not None and self.steps in self.follow_steps:
            self.pair.follow(self.steps, self.motion.packing, self.interaction)

    def _plan(self, steps: np.ndarray) -> None:
        """Record at further steps, each of them later than the present one."""
        later = steps[steps > self.steps].tolist()
        self.planned_steps = sorted({*self.planned_steps, *later})

    @property
    def _turn(self) -> float:
        """Steps in a turn of 2π/ω_r."""
        return float(2.0 * np.pi / (self.start.frequency * self.choices.time_step))

    def _turns(self, number: int) -> np.ndarray:
        """Steps of the dense records of some turns from the present step on."""
        parts = np.arange(1, number * RECORDS_PER_TURN + 1)
        return self.steps + np.rint(self._turn / RECORDS_PER_TURN * parts).astype(int)

    def _plan_spectra(self) -> None:
        """Plan the steps of the spectra and of the pair that is followed, the first of them now."""
        first = SPECTRA_ONSET / (self.start.growth_rate * self.choices.time_step)
        last, number = self.last_step, self.choices.spectra
        follows, spectra = (
            np.rint(np.geomspace(min(first, last), last, count)).astype(int)
            for count in (FOLLOWS_PER_SPECTRUM * (number - 1) + 1, number)
        )
        if 3 * self.start.packing.n <= MAX_SPECTRUM_DOF:
            self.spectrum_steps = frozenset([0, *spectra.tolist()])
        self.follow_steps = frozenset([0, *follows.tolist()])
        self.pair = FollowedPair.from_state(self.start, self.interaction)
        self._plan(np.array(sorted(self.spectrum_steps | self.follow_steps)))

    def _plan_film(self) -> None:
        """Plan the steps of the dense records and of the film, from the present step on."""
        film_steps = FILM_GROWTH_TIMES / (self.start.growth_rate * self.choices.time_step)
        whole_turns = self._turn * round(film_steps / FRAMES / self._turn)
        apart = whole_turns + min(self._turn / RECORDS_PER_TURN, film_steps / FRAMES)
        frames = self.steps + np.rint(apart * np.arange(1, FRAMES + 1)).astype(int)
        self.frame_steps = frozenset(frames.tolist())
        self._plan(np.concatenate([self._turns(DENSE_TURNS), frames]))
