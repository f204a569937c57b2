"""Stress-strain curves of sheared samples, step by step: B, Sec. II and IV.

    σ = (σ_xy + σ_yx)/2,   g = (g_xy + g_yx)/2,   σ_th(γ + Δγ) = σ(γ) + g(γ) Δγ          B (51)

| a step is  | if                                                                             |
| ---------- | ------------------------------------------------------------------------------ |
| an event   | σ fell, or g fell by more than 1e-2 k_N: B, Sec. IV                            |
| changed    | contacts opened or closed, or the dynamics had to find the next force balance  |
| quiet      | neither: the same contacts with the same springs before and after              |
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
APPROACH_LENGTH = 2.5
"""Longest range of strain before an event that counts as its approach, in steps Δγ_in."""

LAST_EDGE_FACTOR = 1.0 + 1e-9
"""Factor on the largest strain for the last edge, so that the last state lies within the bins."""


class Approach(NamedTuple):
    """The states that lead up to an event without any change of contacts.

    `first` and `last` are indices of states; the event happens in the step after `last`.
    """

    first: int
    last: int

    @property
    def states(self) -> slice:
        """The indices of these states in the curve."""
        return slice(self.first, self.last + 1)


@dataclass(frozen=True)
class Curve:
    """M states of one sample, and what happened in each of its M − 1 steps.

    `strain` (M,); `stress` and `modulus` (M,), σ and g in k_N; `lowest_eigenvalue` (M,), λ_min in
    k_N d^(1/2); `event` and `changed` (M − 1,) bool. What the ensemble lacks is NaN.
    """

    strain: np.ndarray
    stress: np.ndarray
    modulus: np.ndarray
    lowest_eigenvalue: np.ndarray
    event: np.ndarray
    changed: np.ndarray

    @property
    def step(self) -> np.ndarray:
        """Δγ of every step, (M − 1,)."""
        return np.diff(self.strain)

    @property
    def stress_change(self) -> np.ndarray:
        """Change of σ in every step of the simulation, (M − 1,)."""
        return np.diff(self.stress)

    @property
    def predicted_change(self) -> np.ndarray:
        """Change of σ in every step by linear response, g Δγ, (M − 1,)."""
        return self.modulus[:-1] * self.step

    @property
    def deviation(self) -> np.ndarray:
        """σ(γ + Δγ) − σ_th(γ + Δγ) of every step, (M − 1,)."""
        return self.stress_change - self.predicted_change

    @property
    def quiet(self) -> np.ndarray:
        """Steps without an event and without a change, (M − 1,) bool."""
        return ~(self.event | self.changed)

    @property
    def longest_step(self) -> float:
        """Δγ_in, the longest step; 0 of a curve without steps."""
        return float(self.step.max(initial=0.0))

    def mean_slopes(self, stress_change: np.ndarray, edges: np.ndarray) -> np.ndarray:
        """Sum of Δσ over the sum of Δγ in every bin of strain, without the events.

        Args:
            stress_change: (M − 1,), `stress_change` or `predicted_change` of this curve.
            edges: (B + 1,) strains; a step belongs to the bin in which it begins.

        Returns:
            (B,) in k_N, NaN in a bin without steps.
        """
        kept = ~self.event
        bins = np.searchsorted(edges, self.strain[:-1][kept], side="right") - 1
        stress, strain = (
            np.bincount(bins, change[kept], minlength=len(edges) - 1)
            for change in (stress_change, self.step)
        )
        with np.errstate(invalid="ignore", divide="ignore"):
            return stress / strain

    @property
    def approaches(self) -> list[Approach]:
        """The approach to every event, in their order."""
        (changes,) = np.nonzero(~self.quiet)
        found = []
        for last in np.nonzero(self.event)[0].tolist():
            earlier = changes[changes < last]
            near = np.searchsorted(
                self.strain, self.strain[last] - APPROACH_LENGTH * self.longest_step
            )
            found.append(Approach(int(max(near, earlier[-1] + 1 if len(earlier) else 0)), last))
        return found


def points_with_curves(ensemble: xr.Dataset) -> list[tuple[int, float, float]]:
    """The points (n, phi, kt) with a curve of a converged and jammed sample, ascending.

    Raises:
        BlockError: the ensemble holds no curves.
    """
    states = variable(ensemble, "curve_count").where(_is_used(ensemble)).max("seed")
    axes = [states[name].to_numpy().tolist() for name in ("n", "phi", "kt")]
    places = zip(*np.nonzero(states.to_numpy() > 0), strict=True)
    return [tuple(axis[k] for axis, k in zip(axes, place, strict=True)) for place in places]


def _is_used(ensemble: xr.Dataset) -> xr.DataArray:
    return (ensemble["converged"] == 1) & (ensemble["jammed"] == 1)


def curves(ensemble: xr.Dataset, n: int, phi: float, kt: float) -> dict[int, Curve]:
    """Seed → curve of the converged and jammed samples of a point.

    Raises:
        BlockError: the ensemble holds no curves.
    """
    variable(ensemble, "curve_count")
    point = ensemble.sel(n=n, phi=phi, kt=kt)
    point = point.sel(seed=_is_used(point) & (point["curve_count"] > 0))
    rows = {name: _rows(point, f"curve_{name}", "state") for name in STATES}
    events, changes = (_rows(point, f"{axis}_strain_before", axis) for axis in ("event", "change"))
    seeds = point["seed"].to_numpy().tolist()
    return {
        seed: _curve({name: array[row] for name, array in rows.items()}, events[row], changes[row])
        for row, seed in enumerate(seeds)
    }


def even_bins(all_curves: Iterable[Curve], count: int) -> np.ndarray:
    """Edges (count + 1,) of bins of one width over the strain of the longest curve."""
    return np.linspace(
        0.0, max(curve.strain[-1] for curve in all_curves) * LAST_EDGE_FACTOR, count + 1
    )


def _rows(point: xr.Dataset, name: str, axis: str) -> np.ndarray:
    """A variable (S, length of the axis), NaN where the ensemble lacks it."""
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
