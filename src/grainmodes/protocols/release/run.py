"""An unstable state let go: Newtonian dynamics, or with a drag, and what it does: C, VI and VII.

    M q̈ = F̃(q, s) − η_0 M q̇,   q(0) in balance,   q̇(0) along ü^m of C (28), or 0: round-off alone

Velocity Verlet in pieces from look to look. It is looked at

    in even intervals, `records` of them while it grows and as many, longer ones to the end of the
    plateau; before the first as often as time grows by a tenth;
    closely, once M has reached 1e-16 d²: over `TURNS` turns of 2π/ω_r, to see them, and
    `FRAMES` times within about 1.5 / ω_i, each a 24th of a turn further than the one before: a
    film in which the spirals turn, however many turns the growth takes (C, Fig. 5); less than a
    24th where the growth takes less than six turns.

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
from grainmodes.parameters.release import Release
from grainmodes.protocols.release.record import Record, record
from grainmodes.protocols.shear.unstable import Unstable
from grainmodes.relaxation.dynamics import Motion, move
from grainmodes.response.stability import eigenvalues

VISIBLE = 1e-16
"""M, in d², from which a run is looked at closely: far above round-off, far below the overlaps."""

TURNS, LOOKS_A_TURN = 12, 24
"""Turns of 2π/ω_r that are looked at closely, and how often each."""

FRAMES, FILMED = 144, 1.5
"""Frames of the film, and how long it is in 1/ω_i."""

MOST_FOR_SPECTRA = 1500
"""Degrees of freedom up to which eigenvalues are found on the way, in 3 s a time."""


@dataclass
class Run:
    """A release on its way; all that it has seen.

    `film` holds (step, Δq (N, 3)) of its frames, `spectra` (step, eigenvalues of M⁻¹J (3N,));
    `close` the steps still to be looked at closely, `frames` those of them that are frames.
    """

    start: Unstable
    interaction: Interaction
    choices: Release
    drag: float
    motion: Motion
    steps: int = 0
    records: list[Record] = field(default_factory=list)
    film: list[tuple[int, np.ndarray]] = field(default_factory=list)
    spectra: list[tuple[int, np.ndarray]] = field(default_factory=list)
    close: list[int] | None = None
    frames: frozenset[int] = frozenset()

    @classmethod
    def begin(
        cls, start: Unstable, interaction: Interaction, choices: Release, drag: float = 0.0
    ) -> Run:
        """A release that has not moved yet; `drag` is η_0 in 1/t_0.

        Raises:
            ArithmeticError: it would take more than `choices.max_steps` steps.
        """
        motion = Motion(start.packing, start.kick(choices.initial_velocity), 0, np.inf)
        run = cls(start, interaction, choices, drag, motion)
        if run.last > choices.max_steps:
            raise ArithmeticError(
                f"omega_i = {start.rate:.1e}: expected a run of at most {choices.max_steps} steps, "
                f"got one of {run.last}"
            )
        run._look()
        return run

    @property
    def last(self) -> int:
        """The step with which it ends."""
        return self._later * self.choices.n_records

    @property
    def done(self) -> bool:
        """Whether it has ended."""
        return self.steps >= self.last

    restartable = True
    """A run goes on to the same bytes from between any two looks."""

    def advance(self) -> None:
        """Move on to the next look, and look."""
        upcoming = self._next()
        damping = Drag(self.drag) if self.drag else Undamped()
        self.motion = move(
            self.motion.packing,
            self.motion.velocity,
            self.interaction,
            damping,
            self.choices.time_step,
            Stop(0.0, upcoming - self.steps),
        )
        self.steps = upcoming
        self._look()

    @property
    def _interval(self) -> int:
        """Steps between two even looks during the growth."""
        whole = self.choices.duration / (self.start.rate * self.choices.time_step)
        return max(1, round(whole / self.choices.n_records))

    @property
    def _later(self) -> int:
        """The same from then on, a multiple of them."""
        least = 0.0 if self.drag else self.choices.min_time / self.choices.time_step
        return self._interval * max(1, math.ceil(least / (self._interval * self.choices.n_records)))

    def _next(self) -> int:
        growing = self.steps < self._interval * self.choices.n_records
        interval = self._interval if growing else self._later
        even = (self.steps // interval + 1) * interval
        return min([even, self.steps + max(1, self.steps // 10), *(self.close or [])[:1]])

    def _look(self) -> None:
        time, packing = self.steps * self.choices.time_step, self.start.packing
        now = record(time, self.motion, packing, self.interaction)
        self.records.append(now)
        if self.close is None and now.mean_square_displacement > VISIBLE:
            self._look_closely()
        elif self.close and self.close[0] == self.steps:
            del self.close[0]
        if self.steps in self.frames:
            self.film.append((self.steps, nonaffine_motion(packing, self.motion.packing)))
        if self._wants_spectrum():
            found = eigenvalues(self.motion.packing, self.interaction)
            self.spectra.append((self.steps, found))

    def _wants_spectrum(self) -> bool:
        every = self._later * max(1, self.choices.n_records // max(self.choices.spectra, 1))
        asked = self.choices.spectra > 0 and not self.drag
        return asked and 3 * self.start.packing.n <= MOST_FOR_SPECTRA and self.steps % every == 0

    def _look_closely(self) -> None:
        """Plan the close looks."""
        turn = 2.0 * np.pi / (self.start.frequency * self.choices.time_step)
        part = turn / LOOKS_A_TURN
        looks = self.steps + np.rint(part * np.arange(1, TURNS * LOOKS_A_TURN + 1)).astype(int)
        growth = FILMED / (self.start.rate * self.choices.time_step)
        skipped = turn * round(growth / FRAMES / turn)
        apart = skipped + min(part, growth / FRAMES)
        frames = self.steps + np.rint(apart * np.arange(1, FRAMES + 1)).astype(int)
        self.close = np.unique([*looks, *frames]).tolist()
        self.frames = frozenset(frames.tolist())
