"""The growth of a complex pair under a background drag: C, Sec. VII.

A drag −η_0 B q̇ beside M q̈ = −J q makes the eigenproblem quadratic. With q = u e^(st)

    (s² M + s η_0 B + J) u = 0,   s = −iΩ,  Ω = ω_r + iω_i at η_0 = 0                     C (12)

    B = diag(m, m, 0)      translations are damped: C adds −m η_0 ṙ to its Eq. (9) alone
    B = M = diag(m, m, m/2)    all motion is damped, as in B: s² + η_0 s + λ' = 0, so that the
                           growth rate Re s is ω_i − η_0/2 where η_0 ≪ ω_r

The root is followed from η_0 = 0 in small steps. In each step Newton's method for T(s) u = 0,
T(s) = s² M + s η_0 B + J, T'(s) = 2 s M + η_0 B, improves root and vector together:

    T(s) x = T'(s) u,   s ← s − uᴴu / uᴴx,   u ← x / |x|

| symbol | name          | shape, unit                                  |
| ------ | ------------- | -------------------------------------------- |
| J      | stiffness     | (3N, 3N) sparse, its pattern symmetric       |
| M      | mass          | (3N,)                                        |
| B      | damped_mass   | (3N,)                                        |
| η_0    | drag          | 1/t_0                                        |
| s      | exponent      | complex, 1/t_0; Re s is the growth rate      |
| u      | mode          | (3N,) complex                                |
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse
from scipy.optimize import brentq

from grainmodes.linalg.failures import NUMERICAL_ERRORS
from grainmodes.linalg.general_shift import GeneralShift

DRAG_STEP, DRAG_FACTOR = 0.25, 1.25
"""A step of η_0 is 0.25 ω_i, or a quarter of η_0 where this is more."""

MAX_NEWTON_STEPS = 20
"""Newton steps for one root; from the root of the drag before it takes three or four."""

NEWTON_TOLERANCE = 1e-12
"""Change of s, relative to |s|, below which a root is found."""

MAX_THRESHOLD = 50.0
"""Drag, in units of ω_i, up to which the end of the growth is looked for."""


@dataclass(frozen=True)
class DampedMode:
    """A root s of the quadratic eigenproblem at one drag η_0, and its vector u (3N,) of norm 1."""

    drag: float
    exponent: complex
    mode: np.ndarray

    @property
    def growth_rate(self) -> float:
        """Re s, in 1/t_0; negative where the mode decays."""
        return float(self.exponent.real)


class DampedPair:
    """A complex pair of M⁻¹J under a growing drag.

    Args:
        stiffness: J, (3N, 3N).
        mass: M, (3N,).
        damped_mass: B, (3N,).
        eigenvalue: λ' of the pair, Im λ' > 0.
        mode: its right eigenvector of M⁻¹J, (3N,).
    """

    def __init__(
        self,
        stiffness: sparse.sparray,
        mass: np.ndarray,
        damped_mass: np.ndarray,
        eigenvalue: complex,
        mode: np.ndarray,
    ):
        self._stiffness, self._mass, self._damped_mass = stiffness, mass, damped_mass
        exponent = -1j * np.sqrt(complex(eigenvalue))
        self._undamped = DampedMode(0.0, exponent, mode / np.linalg.norm(mode))

    def rates(self, drags: np.ndarray) -> np.ndarray:
        """Growth rates under drags (K,) in ascending order, both in 1/t_0.

        NaN from the drag on at which the root is lost.
        """
        found, now = np.full(len(drags), np.nan), self._undamped
        for place, drag in enumerate(drags):
            try:
                now = self._follow(now, float(drag))
            except NUMERICAL_ERRORS:
                break
            found[place] = now.growth_rate
        return found

    def threshold(self) -> float:
        """The drag at which the growth ends, in 1/t_0; NaN if it does not up to 50 ω_i, or if the
        root is lost before."""
        now = before = self._undamped
        last = MAX_THRESHOLD * now.growth_rate
        try:
            while now.growth_rate > 0.0 and now.drag < last:
                before, now = now, self._follow(now, self._next_drag(now))
            if now.growth_rate > 0.0:
                return np.nan
            ends = before.drag, now.drag
            rates = [self._root(before, drag).growth_rate for drag in ends]
            if not rates[0] > 0.0 >= rates[1]:
                return np.nan  # Newton's method has left the root
            return float(brentq(lambda drag: self._root(before, drag).growth_rate, *ends))
        except NUMERICAL_ERRORS:
            return np.nan

    def _next_drag(self, now: DampedMode) -> float:
        step = DRAG_STEP * self._undamped.growth_rate
        return max(now.drag + step, DRAG_FACTOR * now.drag)

    def _follow(self, now: DampedMode, drag: float) -> DampedMode:
        """The root at a larger drag, followed in small steps."""
        while now.drag < drag:
            now = self._root(now, min(drag, self._next_drag(now)))
        return now

    def _root(self, start: DampedMode, drag: float) -> DampedMode:
        """The root at one drag to which Newton's method leads from `start`.

        Raises:
            ArithmeticError: it did not converge.
        """
        s, u = start.exponent, start.mode
        for _ in range(MAX_NEWTON_STEPS):
            diagonal = s**2 * self._mass + s * drag * self._damped_mass
            matrix = GeneralShift(self._stiffness + sparse.diags_array(diagonal, format="csr"))
            x = matrix.factor_at(0j).solve((2.0 * s * self._mass + drag * self._damped_mass) * u)
            change = np.vdot(u, u) / np.vdot(u, x)
            s, u = s - change, x / np.linalg.norm(x)
            if abs(change) <= NEWTON_TOLERANCE * abs(s):
                return DampedMode(drag, complex(s), u)
        raise ArithmeticError(
            f"root of the damped pair: expected a change below {NEWTON_TOLERANCE} of |s|, "
            f"got {abs(change) / abs(s):.1e}"
        )
