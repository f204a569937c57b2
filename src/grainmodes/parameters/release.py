"""How an unstable state is released."""

from __future__ import annotations

from dataclasses import dataclass

GROWTH_RANGE = (1e-19, 1e-11)
"""M, in d², between which growth is fitted: above round-off, below what changes the forces."""

DENSE_RECORDS_ONSET = 1e-16
"""M, in d², from which a run is recorded densely: far above round-off, far below the overlaps."""


DAMPED_MOTIONS = ("translations", "all")
"""What a background drag damps: translations alone (C, Sec. VII), or rotations as well (B)."""


@dataclass(frozen=True)
class Release:
    """Newtonian dynamics from a state with a complex pair λ' = (ω_r + iω_i)² (C, Sec. VI and VII).

    A run takes `duration` / ω_i, and at least `min_time`, in t_0: a plateau lasts some 1e5 t_0,
    however fast the pair grew before. It is recorded in `n_records` even intervals, and more often
    where it matters. `initial_velocity` is the root mean square velocity at the start, in d/t_0,
    along ü^m; at 0 round-off alone starts the growth. Each of `dampings`, η_0 in units of ω_i, is a
    further run besides the undamped one; it damps `damped_motion`. At `spectra` times of the
    undamped run all eigenvalues of M⁻¹J are computed. A state that needs more than `max_steps` is
    not released.
    """

    time_step: float = 0.1
    duration: float = 80.0
    min_time: float = 3e5
    initial_velocity: float = 1e-11
    damped_motion: str = "translations"
    dampings: tuple[float, ...] = (0.1, 1.0, 3.0, 10.0, 100.0)
    n_records: int = 2000
    spectra: int = 40
    max_steps: int = 50_000_000
