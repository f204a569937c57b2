"""The spirals of the grains in a film of a release: C (13), (28), Fig. 5.

    Δq_i(t) = e^(ω_i t) Re(z_i e^(−iω_r t)),   z (N, 3) complex, by least squares

with the ω_i and ω_r that M(t) has. In linear theory z is a multiple of u^m. A grain whose (x, y)
part of z has its two real vectors parallel moves on a line; its opening, the ratio of the axes of
the ellipse that it draws in a turn, tells spirals (up to 1) from lines (0).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.protocols.release.growth import Law
from grainmodes.protocols.release.run import Run


class Spirals(NamedTuple):
    """`misfit`: root mean square of what the spirals leave over, in parts of Δq e^(−ω_i t).

    `overlap`: |⟨u^m | z⟩| / (|u^m| |z|). `opening`: median over the grains. NaN without a film.
    """

    misfit: float
    overlap: float
    opening: float


def spirals_of(run: Run, law: Law) -> Spirals:
    """The spirals in the film of a run whose M follows `law`."""
    if not run.film or not np.isfinite(law.rate):
        return Spirals(np.nan, np.nan, np.nan)
    time = np.array([step for step, _ in run.film]) * run.choices.time_step
    time -= time[0]
    moved = np.stack([field.ravel() for _, field in run.film])
    flat = moved * np.exp(-law.rate * time)[:, None]
    turn = law.frequency * time
    terms = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    parts = np.linalg.lstsq(terms, flat, rcond=None)[0]
    left = flat - terms @ parts
    wave, mode = parts[0] + 1j * parts[1], run.start.mode.ravel()
    overlap = np.abs(np.vdot(mode, wave)) / (np.linalg.norm(mode) * np.linalg.norm(wave))
    misfit = np.sqrt((left**2).sum() / (flat**2).sum())
    return Spirals(float(misfit), float(overlap), float(np.median(_openings(wave))))


def _openings(wave: np.ndarray) -> np.ndarray:
    """Ratio of the axes of every moving grain's ellipse; a loose grain draws none."""
    plane = wave.reshape(-1, 3)[:, :2]
    long, short = np.linalg.svd(np.stack([plane.real, plane.imag], axis=1), compute_uv=False).T
    moving = long > 0.0
    return short[moving] / long[moving]
