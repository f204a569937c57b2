"""The release of an unstable state: its dynamics without or with a drag: C, Sec. VI and VII.

    M q̈ = F̃(q, s) − η_0 M q̇,   q(0) in balance,   q̇(0) along ü^m of C (28), or 0: round-off alone

Velocity Verlet runs from one record to the next. A state is recorded

- in even intervals, `records` of them during the growth and as many longer ones to the end of the
  plateau; before the first of them whenever the time has grown by a tenth;
- densely, once M has reached 1e-16 d²: `RECORDS_PER_TURN` times a turn for `DENSE_TURNS` turns of
  2π/ω_r, to resolve them;
- in a film of `FRAMES` frames (C, Fig. 5), which starts there too and is about 1.5 / ω_i long. Some
  whole turns and a 24th of a turn pass between two frames, so that the film shows how the spirals
  turn, however many turns the growth takes; less than a 24th where it takes less than six turns.

Verlet turns a mode of frequency Ω at (2/Δt) arcsin(ΩΔt/2), so that ω_i is too large by the part
(ω_r Δt)²/8 and ω_r by (ω_r Δt)²/24; at Δt = 0.1 that is 1e-3 and less.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from grainmodes.kernels.damping import Drag, Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import nonaffine_motion
from grainmodes.parameters.release import DENSE_RECORDS_ONSET, Release
from grainmodes.protocols.release.record import MotionRecord, record_motion
from grainmodes.protocols.release.unstable_state import UnstableState
from grainmodes.relaxation.dynamics import Motion, move
from grainmodes.response.stability import mass_weighted_eigenvalues
from grainmodes.runtime.progress import Progress

DENSE_TURNS, RECORDS_PER_TURN = 12, 24
"""Turns of 2π/ω_r that are recorded densely, and the number of records in each."""

FRAMES, FILM_GROWTH_TIMES = 144, 1.5
"""Number of frames of the film, and its length in 1/ω_i."""

MAX_SPECTRUM_DOF = 1500
"""Degrees of freedom up to which all eigenvalues are computed on the way, in 3 s each time."""


@dataclass
class ReleaseRun:
    """A release on its way, with everything recorded so far.

    `drag` is η_0 in 1/t_0. `film` holds (step, Δq (N, 3) in d) of every frame, and `spectra`
    (step, eigenvalues of M⁻¹J (3N,)). `dense_steps` are the steps that are still to be recorded
    densely, None before M has reached `DENSE_RECORDS_ONSET`; `frame_steps` are those of frames.
    """

    start: UnstableState
    interaction: Interaction
    choices: Release
    drag: float
    motion: Motion
    steps: int = 0
    records: list[MotionRecord] = field(default_factory=list)
    film: list[tuple[int, np.ndarray]] = field(default_factory=list)
    spectra: list[tuple[int, np.ndarray]] = field(default_factory=list)
    dense_steps: list[int] | None = None
    frame_steps: frozenset[int] = frozenset()

    @classmethod
    def from_state(
        cls, start: UnstableState, interaction: Interaction, choices: Release, drag: float = 0.0
    ) -> ReleaseRun:
        """A release that has not moved yet.

        Raises:
            ArithmeticError: it would take more than `choices.max_steps` steps.
        """
        motion = Motion(start.packing, start.initial_velocity(choices.initial_velocity), 0, np.inf)
        run = cls(start, interaction, choices, drag, motion)
        if run.last_step > choices.max_steps:
            raise ArithmeticError(
                f"release at omega_i = {start.growth_rate:.1e}: expected at most "
                f"{choices.max_steps} steps, got {run.last_step}"
            )
        run._record()
        return run

    @property
    def last_step(self) -> int:
        """The step with which the run ends."""
        return self._late_interval * self.choices.n_records

    @property
    def done(self) -> bool:
        """Whether the run has ended."""
        return self.steps >= self.last_step

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
        damping = Drag(self.drag) if self.drag else Undamped()
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
        least = 0.0 if self.drag else self.choices.min_time / self.choices.time_step
        interval = self._growth_interval
        return interval * max(1, math.ceil(least / (interval * self.choices.n_records)))

    def _next_step(self) -> int:
        """The step of the next record."""
        growing = self.steps < self._growth_interval * self.choices.n_records
        interval = self._growth_interval if growing else self._late_interval
        even = (self.steps // interval + 1) * interval
        dense = (self.dense_steps or [])[:1]
        return min([even, self.steps + max(1, self.steps // 10), *dense])

    def _record(self) -> None:
        """Record the present state, with a frame of the film and a spectrum where they are due."""
        time, packing = self.steps * self.choices.time_step, self.start.packing
        record = record_motion(time, self.motion, packing, self.interaction)
        self.records.append(record)
        if self.dense_steps is None and record.mean_square_displacement > DENSE_RECORDS_ONSET:
            self._plan_dense_records()
        elif self.dense_steps and self.dense_steps[0] == self.steps:
            del self.dense_steps[0]
        if self.steps in self.frame_steps:
            self.film.append((self.steps, nonaffine_motion(packing, self.motion.packing)))
        if self._spectrum_is_due():
            self.spectra.append(
                (self.steps, mass_weighted_eigenvalues(self.motion.packing, self.interaction))
            )

    def _spectrum_is_due(self) -> bool:
        choices, few = self.choices, 3 * self.start.packing.n <= MAX_SPECTRUM_DOF
        every = self._late_interval * max(1, choices.n_records // max(choices.spectra, 1))
        return choices.spectra > 0 and not self.drag and few and self.steps % every == 0

    def _plan_dense_records(self) -> None:
        """Plan the steps of the dense records and of the film, from the present step on."""
        turn = 2.0 * np.pi / (self.start.frequency * self.choices.time_step)
        part = turn / RECORDS_PER_TURN
        numbers = np.arange(1, DENSE_TURNS * RECORDS_PER_TURN + 1)
        dense = self.steps + np.rint(part * numbers).astype(int)
        film_steps = FILM_GROWTH_TIMES / (self.start.growth_rate * self.choices.time_step)
        whole_turns = turn * round(film_steps / FRAMES / turn)
        apart = whole_turns + min(part, film_steps / FRAMES)
        frames = self.steps + np.rint(apart * np.arange(1, FRAMES + 1)).astype(int)
        self.dense_steps = np.unique([*dense, *frames]).tolist()
        self.frame_steps = frozenset(frames.tolist())
