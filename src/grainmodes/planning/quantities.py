"""What is planned at one point of a pilot ensemble: G, and D(ω) bin by bin.

G is averaged as in A: over the converged samples, with G = 0 for those that are not jammed. D of a
bin is the mean of its counts (A, Eq. 23), in A's bins over the range of the pilot or in those of
the study. A bin with fewer than `MIN_MODES` modes in all pilot samples together is listed and not
planned: if its modes were independent, its mean would be known to `MIN_MODES`^(−1/2) = 22 %, and a
rarer bin may show no spread at all.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from grainmodes.ensemble import bin_density
from grainmodes.ensemble.reading import variable
from grainmodes.ensemble.spectra import ResolvedModes, shared_edges, spectrum
from grainmodes.planning.seeds import MIN_SEEDS, SeedEstimate, seeds_needed
from grainmodes.statistics.binning import BinnedModes

if TYPE_CHECKING:
    import xarray as xr

MIN_MODES = 20
"""Modes in all pilot samples together below which a bin is not planned."""

MAX_PILOT_ERROR = 1 / 3
"""Relative error of the mean of a pilot above which a plan carries a warning."""

PointCoordinates = tuple[int, float, float]
"""n, phi, k_T."""


class Plan(NamedTuple):
    """How many seeds a quantity needs at a point.

    `spectrum`: the kind of spectrum that it is taken from, "none" for G; `samples`: pilot seeds;
    `bin`: ω of its bin, from and to in 1/t_0, None for G.
    """

    quantity: str
    spectrum: str
    samples: int
    need: SeedEstimate
    bin: tuple[float, float] | None = None

    @property
    def is_uncertain(self) -> bool:
        """Whether the pilot determines the mean only roughly."""
        return bool(self.need.error > MAX_PILOT_ERROR)


class Remark(NamedTuple):
    """A sentence on what cannot be planned, or only roughly."""

    sentence: str


def plan_point(ensemble: xr.Dataset, point: PointCoordinates, target: float) -> list[Plan | Remark]:
    """The plans of a point, and remarks on what has none.

    Args:
        target: relative standard error, such as 0.01 for 1 %.

    Raises:
        BlockError: the ensemble holds neither g nor spectra.
    """
    has_spectra = "eigenvalue" in ensemble or "bin_count" in ensemble
    if "g" not in ensemble and not has_spectra:
        variable(ensemble, "g")
    samples = ensemble.sel(dict(zip(("n", "phi", "kt"), point, strict=True)))
    samples = samples.sel(seed=samples["converged"] == 1)
    converged = samples.sizes["seed"]
    if converged < MIN_SEEDS:
        return [
            Remark(f"expected at least {MIN_SEEDS} converged seeds for a spread, got {converged}")
        ]
    if not (samples["jammed"] == 1).any():
        return [Remark("no converged seed is jammed: means are 0 and have no relative error")]
    moduli = _rigidity(samples, target) if "g" in ensemble else [Remark("the ensemble holds no g")]
    densities = (
        _density(ensemble, point, target)
        if has_spectra
        else [Remark("the ensemble holds no spectra")]
    )
    found = [*moduli, *densities]
    uncertain = [plan for plan in found if isinstance(plan, Plan) and plan.is_uncertain]
    return [*found, *(_warning(plan) for plan in uncertain)]


def _warning(plan: Plan) -> Remark:
    return Remark(
        f"{plan.quantity}: the pilot determines its mean only to {plan.need.error:.0%}, "
        "and the number of seeds even less well"
    )


def _rigidity(samples: xr.Dataset, target: float) -> list[Plan | Remark]:
    values = samples["g"].to_numpy()
    values = values[np.isfinite(values)]
    try:
        return [Plan("G", "none", len(values), seeds_needed(values, target))]
    except ValueError as error:
        return [Remark(f"G: {error}")]


def _density(ensemble: xr.Dataset, point: PointCoordinates, target: float) -> list[Plan | Remark]:
    """Plans of the median bin and of the one that needs most seeds; a remark on bins too empty."""
    modes = spectrum(ensemble, *point)
    edges = shared_edges([modes], point[-1], bin_density(ensemble))
    counts = modes.in_bins(edges).count
    filled = counts.sum(axis=0) >= MIN_MODES
    remarks = [Remark(_bins_too_empty(edges, filled))] if not filled.all() else []
    if len(counts) < MIN_SEEDS or not filled.any():
        return [*remarks, Remark(f"D: no bin of two samples holds {MIN_MODES} modes")]
    need = seeds_needed(counts[:, filled], target)
    bins = np.stack([edges[:-1], edges[1:]], axis=1)[filled]
    order = np.argsort(need.seeds, kind="stable")
    chosen = {"D, median bin": order[(len(order) - 1) // 2], "D, worst bin": order[-1]}
    plans = []
    for name, k in chosen.items():
        need_of_bin = SeedEstimate(*(column[k] for column in need))
        plans.append(Plan(name, spectrum_kind(modes), len(counts), need_of_bin, tuple(bins[k])))
    return [*plans, *remarks]


def spectrum_kind(modes: ResolvedModes | BinnedModes) -> str:
    """The kind of spectrum of a pilot, as a grid of a scene names it."""
    if isinstance(modes, BinnedModes):
        return "binned_averages" if np.isfinite(modes.psi_rotational.total).any() else "counts"
    return "modes" if np.isfinite(modes.psi_rotational).any() else "eigenvalues"


def _bins_too_empty(edges: np.ndarray, filled: np.ndarray) -> str:
    """A sentence on the bins with too few modes; neighbouring bins are one range."""
    empty = np.concatenate([[False], ~filled, [False]])
    (ends,) = np.nonzero(empty[1:] != empty[:-1])
    ranges = [f"{edges[a]:.3g}–{edges[b]:.3g}" for a, b in ends.reshape(-1, 2).tolist()]
    count, where = int((~filled).sum()), ", ".join(ranges)
    return (
        f"D: {count} of {len(filled)} bins hold fewer than {MIN_MODES} modes: omega t_0 in {where}"
    )
