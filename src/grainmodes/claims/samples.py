"""The samples of an ensemble at one N, seed by seed.

The rows of every array are the seeds of the ensemble, NaN where a sample is not converged or not
jammed, so that two arrays of one N belong to the same packings row by row.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import NotTested
from grainmodes.claims.part import MIN_SAMPLES

if TYPE_CHECKING:
    import xarray as xr

FEW_SAMPLES = f"No claim is asked of points with fewer than {MIN_SAMPLES} jammed samples:"

SAMPLE_DIMENSIONS = ("phi", "kt", "seed")
"""Dimensions of a number per sample, at one N."""

ABOVE_ZERO = 1e-300
"""Lower end of "every k_T > 0"."""

RANGE_TOLERANCE = 1.000001
"""Factor by which a k_T of the grid may lie beyond the end of a range, because of round-off."""


@dataclass(frozen=True)
class Samples:
    """The samples of `n` grains."""

    ensemble: xr.Dataset
    n: int

    def values(self, name: str, phi: float, kappa: float) -> np.ndarray:
        """A variable at one point: (S,), or (S, ...) with its further dimensions.

        NaN for samples that are not converged or not jammed.
        """
        place = {"phi": self._place("phi", phi), "kt": self._place("kt", kappa)}
        rows = self._rows(name).isel(place).transpose("seed", ...)
        return rows.where(self._used().isel(place)).to_numpy()

    def points(
        self, name: str, low: float = 0.0, high: float = np.inf
    ) -> list[tuple[float, float]]:
        """The (phi, kappa) with four samples of a variable and kappa in [low, high], ascending."""
        rows = self._rows(name)
        known = rows.notnull().any([axis for axis in rows.dims if axis not in SAMPLE_DIMENSIONS])
        enough = (known & self._used()).sum("seed").transpose("phi", "kt").to_numpy() >= MIN_SAMPLES
        phi, kappa = (self.ensemble[axis].to_numpy().tolist() for axis in ("phi", "kt"))
        found = [(phi[i], kappa[j]) for i, j in zip(*np.nonzero(enough), strict=True)]
        return [
            point for point in found if low / RANGE_TOLERANCE <= point[1] <= high * RANGE_TOLERANCE
        ]

    def phis(self, name: str, kappa: float | None = None) -> list[float]:
        """Area fractions at which a variable has samples, at one k_T or any; ascending."""
        return sorted({phi for phi, here in self.points(name) if kappa in (None, here)})

    def kappas(
        self, name: str, phi: float | None = None, low: float = 0.0, high: float = np.inf
    ) -> list[float]:
        """Values of k_T/k_N in [low, high] with samples, at one φ or any; ascending."""
        return sorted(
            {kappa for here, kappa in self.points(name, low, high) if phi in (None, here)}
        )

    def common_kappas(self, name: str, phis: tuple[float, float], low: float = 0.0) -> list[float]:
        """Values of k_T/k_N, at least `low`, with samples of a variable at both φ; ascending."""
        first, last = (self.kappas(name, phi, low) for phi in phis)
        return [kappa for kappa in first if kappa in last]

    def _rows(self, name: str) -> xr.Variable:
        # A Variable has no coordinates. Aligning them would take most of the time.
        return self.ensemble[name].variable.isel(n=self._place("n", self.n))

    def with_friction(self) -> bool:
        """Whether the packings were compressed with friction, as paper B does it."""
        name = "compressed_with_friction"
        return name in self.ensemble and bool((self._rows(name) == 1).any())

    def _used(self) -> xr.Variable:
        return (self._rows("converged") == 1) & (self._rows("jammed") == 1)

    def _place(self, axis: str, value: float) -> int:
        return self.ensemble[axis].to_numpy().tolist().index(value)


def best_sampled(ensemble: xr.Dataset, *names: str, with_friction: bool | None = False) -> Samples:
    """The samples of the N that has all the variables at most points; of several, the largest N.

    Args:
        with_friction: as in `samples_by_size`.

    Raises:
        NotTested: the ensemble lacks one of the variables, or samples of them.
    """

    def shared(samples: Samples) -> tuple[int, int]:
        points = set.intersection(*(set(samples.points(name)) for name in names))
        return len(points), samples.n

    return max(samples_by_size(ensemble, *names, with_friction=with_friction), key=shared)


def samples_by_size(
    ensemble: xr.Dataset, *names: str, with_friction: bool | None = False
) -> list[Samples]:
    """The samples of every N that has all the variables, N ascending.

    Args:
        with_friction: whether the packings were compressed with friction; None: either way. All
            packings of one N are of one kind.

    Raises:
        NotTested: the ensemble lacks one of the variables, or samples of them.
    """
    absent = [name for name in names if name not in ensemble]
    if absent:
        raise NotTested(", ".join(absent))
    found = [Samples(ensemble, n) for n in ensemble["n"].to_numpy().tolist()]
    found = [samples for samples in found if all(samples.points(name) for name in names)]
    if with_friction is not None:
        found = [samples for samples in found if samples.with_friction() == with_friction]
    if not found:
        kind = {None: "", False: "", True: " compressed with friction"}[with_friction]
        raise NotTested(f"jammed samples{kind} with {', '.join(names)}")
    return found


def points_left_out(ensemble: xr.Dataset) -> str:
    """A sentence on the points at which fewer than four samples are jammed; empty if none is."""
    jammed = ((ensemble["converged"] == 1) & (ensemble["jammed"] == 1)).sum("seed")
    computed = ensemble["converged"].notnull().any("seed")
    few = jammed.where(computed & (jammed < MIN_SAMPLES)).max("kt")
    places = few.to_series().dropna().astype(int)
    listed = ", ".join(f"N = {n}, φ = {phi:g} ({count})" for (n, phi), count in places.items())
    return f"{FEW_SAMPLES} {listed}." if listed else ""


def label(phi: float | None = None, kappa: float | None = None) -> str:
    """How an explanation names a point, such as "φ = 0.9, κ = 1e-08"."""
    words = {"φ": phi, "κ": kappa}
    return ", ".join(f"{name} = {value:g}" for name, value in words.items() if value is not None)
