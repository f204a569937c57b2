"""Stress-strain curves of sheared samples, step by step: B, Sec. II and IV.

    σ = (σ_xy + σ_yx)/2,   g = (g_xy + g_yx)/2,   σ_th(γ + Δγ) = σ(γ) + g(γ) Δγ          B (51)

| a step is  | where                                                                          |
| ---------- | ------------------------------------------------------------------------------ |
| an event   | σ fell, or g by more than 1e-2 k_N: B, Sec. IV                                 |
| changed    | contacts opened or closed, or the dynamics had to find the balance             |
| quiet      | neither: the contacts stayed what they were, each with its spring              |
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from grainmodes.ensemble.reading import variable

if TYPE_CHECKING:
    import xarray as xr

STATES = ("strain", "stress_xy", "stress_yx", "g_xy", "g_yx", "lowest_eigenvalue")
NEAR = 2.5
"""How far before an event its approach begins, in steps Δγ_in."""


BEYOND = 1.0 + 1e-9
"""Factor on the last strain, which is to lie in the last bin."""


class Approach(NamedTuple):
    """The states before an event on the same contacts, from `first` to `last`, its bracket's."""

    first: int
    last: int

    @property
    def states(self) -> slice:
        """Where they stand in the curve."""
        return slice(self.first, self.last + 1)


@dataclass(frozen=True)
class Curve:
    """M states of a sample; `event` and `changed` say what happened in each of its M − 1 steps.

    `lowest` is λ_min. What the ensemble lacks is NaN.
    """

    strain: np.ndarray
    stress: np.ndarray
    modulus: np.ndarray
    lowest: np.ndarray
    event: np.ndarray
    changed: np.ndarray

    @property
    def step(self) -> np.ndarray:
        """Δγ of every step."""
        return np.diff(self.strain)

    @property
    def rise(self) -> np.ndarray:
        """Change of σ in every step, simulated."""
        return np.diff(self.stress)

    @property
    def predicted(self) -> np.ndarray:
        """The same in theory, g Δγ."""
        return self.modulus[:-1] * self.step

    @property
    def missing(self) -> np.ndarray:
        """σ(γ + Δγ) − σ_th(γ + Δγ) of every step."""
        return self.rise - self.predicted

    @property
    def quiet(self) -> np.ndarray:
        """Steps in which nothing happened."""
        return ~(self.event | self.changed)

    @property
    def longest(self) -> float:
        """Δγ_in."""
        return float(self.step.max(initial=0.0))

    def slopes(self, rises: np.ndarray, edges: np.ndarray) -> np.ndarray:
        """Sum of `rise` or `predicted` over that of Δγ in bins (B,), without the events."""
        kept = ~self.event
        bins = np.searchsorted(edges, self.strain[:-1][kept], side="right") - 1
        rise, strain = (
            np.bincount(bins, of[kept], minlength=len(edges) - 1) for of in (rises, self.step)
        )
        with np.errstate(invalid="ignore", divide="ignore"):
            return rise / strain

    @property
    def approaches(self) -> list[Approach]:
        """One for every event."""
        (loud,) = np.nonzero(~self.quiet)
        found = []
        for last in np.nonzero(self.event)[0].tolist():
            earlier = loud[loud < last]
            near = np.searchsorted(self.strain, self.strain[last] - NEAR * self.longest)
            found.append(Approach(int(max(near, earlier[-1] + 1 if len(earlier) else 0)), last))
        return found


def points_with_curves(ensemble: xr.Dataset) -> list[tuple[int, float, float]]:
    """(n, phi, kt) with a curve of a converged and jammed sample, ascending.

    Raises:
        BlockError: the ensemble holds no curves.
    """
    states = variable(ensemble, "curve_count").where(_used(ensemble)).max("seed")
    axes = [states[name].to_numpy().tolist() for name in ("n", "phi", "kt")]
    places = zip(*np.nonzero(states.to_numpy() > 0), strict=True)
    return [tuple(axis[k] for axis, k in zip(axes, place, strict=True)) for place in places]


def _used(ensemble: xr.Dataset) -> xr.DataArray:
    return (ensemble["converged"] == 1) & (ensemble["jammed"] == 1)


def curves(ensemble: xr.Dataset, n: int, phi: float, kt: float) -> dict[int, Curve]:
    """Seed → curve of the converged and jammed samples of a point.

    Raises:
        BlockError: the ensemble holds no curves.
    """
    variable(ensemble, "curve_count")
    point = ensemble.sel(n=n, phi=phi, kt=kt)
    point = point.sel(seed=_used(point) & (point["curve_count"] > 0))
    rows = {name: _rows(point, f"curve_{name}", "state") for name in STATES}
    events, changes = (_rows(point, f"{of}_strain_before", of) for of in ("event", "change"))
    seeds = point["seed"].to_numpy().tolist()
    return {
        seed: _curve({name: of[row] for name, of in rows.items()}, events[row], changes[row])
        for row, seed in enumerate(seeds)
    }


def even_bins(of: Iterable[Curve], count: int) -> np.ndarray:
    """Edges of bins of one width over the strain of the longest curve."""
    return np.linspace(0.0, max(curve.strain[-1] for curve in of) * BEYOND, count + 1)


def _rows(point: xr.Dataset, name: str, axis: str) -> np.ndarray:
    """A variable by sample, NaN where the ensemble lacks it."""
    if name not in point:
        return np.full((point.sizes["seed"], point.sizes.get(axis, 0)), np.nan)
    return point[name].transpose("seed", axis).to_numpy()


def _curve(row: dict[str, np.ndarray], events: np.ndarray, changes: np.ndarray) -> Curve:
    states = int(np.isfinite(row["strain"]).sum())
    row = {name: values[:states] for name, values in row.items()}
    strain = row["strain"]
    return Curve(
        strain,
        (row["stress_xy"] + row["stress_yx"]) / 2.0,
        (row["g_xy"] + row["g_yx"]) / 2.0,
        row["lowest_eigenvalue"],
        np.isin(strain[:-1], events),
        np.isin(strain[:-1], changes),
    )
