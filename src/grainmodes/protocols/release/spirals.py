"""The spirals of the grains in a film of a release: C (13), (28), Fig. 5.

    Δq_i(t) = e^(ω_i t) Re(z_i e^(−iω_r t)),   z (N, 3) complex, by least squares

with the ω_i and ω_r of the fit of M(t). In linear theory z is a multiple of u^m. In a turn a grain
draws an ellipse, up to the growth. The ratio of its axes distinguishes spirals (up to 1) from
motion on a line (0), where the two real vectors of the (x, y) part of z are parallel.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.protocols.release.growth_fit import GrowthFit
from grainmodes.protocols.release.release_run import ReleaseRun


class Spirals(NamedTuple):
    """How well the film is described by spirals; all NaN without a film.

    `misfit` is the root mean square of what the spirals leave over, relative to that of
    Δq e^(−ω_i t). `overlap` is |⟨u^m | z⟩| / (|u^m| |z|). `axis_ratio` is the median over the
    grains that move.
    """

    misfit: float
    overlap: float
    axis_ratio: float


def fit_spirals(run: ReleaseRun, fit: GrowthFit) -> Spirals:
    """Fit spirals to the film of a run whose M follows `fit`."""
    if not run.film or not np.isfinite(fit.rate):
        return Spirals(np.nan, np.nan, np.nan)
    time = np.array([step for step, _ in run.film]) * run.choices.time_step
    time -= time[0]
    motion = np.stack([field.ravel() for _, field in run.film])
    flat = motion * np.exp(-fit.rate * time)[:, None]
    turn = fit.frequency * time
    terms = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    parts = np.linalg.lstsq(terms, flat, rcond=None)[0]
    rest = flat - terms @ parts
    amplitude, mode = parts[0] + 1j * parts[1], run.start.mode.ravel()
    norms = np.linalg.norm(mode) * np.linalg.norm(amplitude)
    overlap = np.abs(np.vdot(mode, amplitude)) / norms
    misfit = np.sqrt((rest**2).sum() / (flat**2).sum())
    return Spirals(float(misfit), float(overlap), float(np.median(_axis_ratios(amplitude))))


def _axis_ratios(amplitude: np.ndarray) -> np.ndarray:
    """Ratio of the axes of the ellipse of every moving grain; a rattler draws none."""
    plane = amplitude.reshape(-1, 3)[:, :2]
    long, short = np.linalg.svd(np.stack([plane.real, plane.imag], axis=1), compute_uv=False).T
    moving = long > 0.0
    ratios: np.ndarray = short[moving] / long[moving]
    return ratios
