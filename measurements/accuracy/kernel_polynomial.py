"""The kernel polynomial method: integrated densities from random vectors. Only measured, not used.

With λ = c + a x, |x| < 1, Chebyshev polynomials T_m, and random vectors z of signs ±1,

    μ_m = <z · P T_m(X) z> ≈ tr [P T_m(X)],     X = (J − c) / a
    N(λ) = (1/π) [μ_0 (π − θ) − 2 Σ_m g_m μ_m sin(mθ) / m],     x = cos θ

is the number of modes below λ, each weighted by its part in P: P = 1, or the rotations alone. The
Jackson factors g_m keep the density positive, and spread a mode over π a / m (Weisse et al. 2006).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.spectrum.eigenproblem import Eigenproblem

N_VECTORS = 32
"""Number of random vectors."""

MARGIN = 0.01
"""Margin of the interval on either side of the spectrum, in units of its width."""


class Moments(NamedTuple):
    """μ_m of all modes and of their rotations, (K,) each, and the interval of λ they belong to."""

    all: np.ndarray
    rotational: np.ndarray
    low: float
    high: float


def moments(eigenproblem: Eigenproblem, count: int, seed: int = 0) -> Moments:
    """The first `count` moments of a symmetric J, estimated by `N_VECTORS` vectors."""
    low, high = -MARGIN * eigenproblem.bound, (1.0 + MARGIN) * eigenproblem.bound
    centre, half = 0.5 * (high + low), 0.5 * (high - low)
    z = np.random.default_rng(seed).choice([-1.0, 1.0], (eigenproblem.size, N_VECTORS))
    rotation = np.arange(eigenproblem.size) % eigenproblem.k == 2
    found = np.empty((2, count))
    before, now = (eigenproblem.matrix @ z - centre * z) / half, z
    for m in range(count):
        weight = z * now
        found[:, m] = weight.sum(), weight[rotation].sum()
        ahead = 2.0 / half * (eigenproblem.matrix @ now - centre * now) - before
        before, now = now, ahead
    return Moments(*found / N_VECTORS, low, high)


def jackson(count: int) -> np.ndarray:
    """g_m for m = 0 … count − 1."""
    m, q = np.arange(count), np.pi / (count + 1)
    return ((count - m + 1) * np.cos(m * q) + np.sin(m * q) / np.tan(q)) / (count + 1)


def below(mu: np.ndarray, moments: Moments, eigenvalue: np.ndarray) -> np.ndarray:
    """N(λ) from the moments `mu` (K,), all or rotational, at λ (E,); (E,) float."""
    x = (2.0 * eigenvalue - moments.low - moments.high) / (moments.high - moments.low)
    theta = np.arccos(np.clip(x, -1.0, 1.0))
    m = np.arange(1, len(mu))
    weight = (jackson(len(mu)) * mu)[1:] / m
    waves = np.array([np.sin(m * angle) @ weight for angle in theta])
    return (mu[0] * (np.pi - theta) - 2.0 * waves) / np.pi
