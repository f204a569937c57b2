"""What is planned at one point of a pilot ensemble: G, and D(ω) bin by bin.

G is averaged as in A: over the converged samples, those that are not jammed with G = 0. D of a bin
is the mean of its counts (A, Eq. 23), in A's bins over the range of the pilot or in those of the
study. A bin with fewer than `FEW` modes in all pilot samples together is named and not planned:
were modes independent, its mean would be known to `FEW`^(−1/2) = 22 %, and a rarer bin may show no
spread at all.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from grainmodes.ensemble import bin_density
from grainmodes.ensemble.reading import variable
from grainmodes.ensemble.spectra import shared_edges, spectrum
from grainmodes.planning.seeds import LEAST, Need, needed
from grainmodes.statistics.binning import Binned

if TYPE_CHECKING:
    import xarray as xr

FEW = 20
"""Modes below which a bin is not planned."""

UNSURE = 1 / 3
"""Relative error of a pilot beyond which its mean, hence the number of seeds, is hardly known."""

Point = tuple[int, float, float]
"""n, phi, k_T."""


class Plan(NamedTuple):
    """What a quantity needs at a point.

    `kind`: of the spectrum behind it, "none" for G; `place`: ω of the bin that drives it, from and
    to in 1/t_0; `samples`: pilot seeds.
    """

    quantity: str
    kind: str
    samples: int
    need: Need
    place: tuple[float, float] | None = None

    @property
    def unsure(self) -> bool:
        """Whether the pilot hardly knows the mean."""
        return bool(self.need.error > UNSURE)


class Left(NamedTuple):
    """A sentence on what cannot be planned."""

    sentence: str


def planned(ensemble: xr.Dataset, point: Point, target: float) -> list[Plan | Left]:
    """The plans of a point, and sentences on what has none.

    Raises:
        BlockError: the ensemble holds neither g nor spectra.
    """
    spectral = [name for name in ("eigenvalue", "bin_count") if name in ensemble]
    if "g" not in ensemble and not spectral:
        variable(ensemble, "g")
    of = ensemble.sel(dict(zip(("n", "phi", "kt"), point, strict=True)))
    of = of.sel(seed=of["converged"] == 1)
    if of.sizes["seed"] < LEAST:
        return [
            Left(f"expected at least {LEAST} converged seeds for a spread, got {of.sizes['seed']}")
        ]
    if not (of["jammed"] == 1).any():
        return [Left("no converged seed is jammed: means are 0 and have no relative error")]
    moduli = _rigidity(of, target) if "g" in ensemble else [Left("the ensemble holds no g")]
    densities = _density(ensemble, point, target) if spectral else [Left("it holds no spectra")]
    found = [*moduli, *densities]
    return [*found, *(_unsure(of) for of in found if isinstance(of, Plan) and of.unsure)]


def _unsure(of: Plan) -> Left:
    return Left(
        f"{of.quantity}: the pilot knows its mean to {of.need.error:.0%} only, its seeds less"
    )


def _rigidity(of: xr.Dataset, target: float) -> list[Plan | Left]:
    values = of["g"].to_numpy()
    values = values[np.isfinite(values)]
    try:
        return [Plan("G", "none", len(values), needed(values, target))]
    except ValueError as error:
        return [Left(f"G: {error}")]


def _density(ensemble: xr.Dataset, point: Point, target: float) -> list[Plan | Left]:
    """The median bin and the one that needs most, with the bins that hold too few modes."""
    modes = spectrum(ensemble, *point)
    edges = shared_edges([modes], point[-1], bin_density(ensemble))
    counts = modes.in_bins(edges).count
    filled = counts.sum(axis=0) >= FEW
    left = [Left(_few(edges, filled))] if not filled.all() else []
    if len(counts) < LEAST or not filled.any():
        return [*left, Left("D: no bin of two samples has modes enough")]
    need = needed(counts[:, filled], target)
    bins = np.stack([edges[:-1], edges[1:]], axis=1)[filled]
    order = np.argsort(need.seeds, kind="stable")
    chosen = {"D, median bin": order[(len(order) - 1) // 2], "D, worst bin": order[-1]}
    plans = [
        Plan(name, kind_of(modes), len(counts), Need(*(of[k] for of in need)), tuple(bins[k]))
        for name, k in chosen.items()
    ]
    return [*plans, *left]


def kind_of(modes) -> str:
    """The kind of spectrum that a pilot has, as a grid of a scene asks for it."""
    if isinstance(modes, Binned):
        return "binned_averages" if np.isfinite(modes.psi_rotational.total).any() else "counts"
    return "modes" if np.isfinite(modes.psi_rotational).any() else "eigenvalues"


def _few(edges: np.ndarray, filled: np.ndarray) -> str:
    """Which bins hold too few modes, neighbours as one range."""
    empty = np.concatenate([[False], ~filled, [False]])
    (ends,) = np.nonzero(empty[1:] != empty[:-1])
    ranges = [f"{edges[a]:.3g}–{edges[b]:.3g}" for a, b in ends.reshape(-1, 2).tolist()]
    count = int((~filled).sum())
    where = ", ".join(ranges)
    return f"D: {count} of {len(filled)} bins hold fewer than {FEW} modes: omega t_0 in {where}"
