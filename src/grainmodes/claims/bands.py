"""The modes of a point, split into the rotational band (psi^R > 1/2) and the translational band.

Where an ensemble holds counts in bins instead of eigenvalues, a bin of c modes with mean psi^R is
read as c psi^R rotational modes and the rest translational, spread over it evenly in log(omega):
right where modes are of one kind, and resolved to a bin.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes import statistics
from grainmodes.claims.claim import NotAsked
from grainmodes.claims.estimates import Estimate, mean
from grainmodes.claims.samples import Samples, sizes

SHARES = np.linspace(0.1, 0.9, 9)
"""Shares of a band at which two bands are compared: its ends hang on single modes."""


class Modes(NamedTuple):
    """Vibrations of S samples, (S, M), NaN where there is none; zero modes are left out."""

    frequency: np.ndarray
    psi_rotational: np.ndarray

    @property
    def rotational(self) -> np.ndarray:
        """Frequencies of the modes with psi^R > 1/2."""
        return np.where(self.psi_rotational > 0.5, self.frequency, np.nan)

    @property
    def translational(self) -> np.ndarray:
        """Frequencies of the modes with psi^R <= 1/2."""
        return np.where(self.psi_rotational <= 0.5, self.frequency, np.nan)


def kind(ensemble) -> tuple[str, str]:
    """The names of the spectrum and of psi^R that an ensemble holds, by mode or else by bin.

    Raises:
        NotAsked: it holds neither.
    """
    for names in (("eigenvalue", "psi_rotational"), ("bin_count", "bin_psi_rotational")):
        if all(name in ensemble for name in names):
            return names
    raise NotAsked("psi_rotational (observables.spectrum: modes, or bands)")


def with_modes(ensemble) -> list[Samples]:
    """The samples of every N that has spectra with psi^R, N ascending."""
    return sizes(ensemble, *kind(ensemble))


def modes(samples: Samples, phi: float, kappa: float) -> Modes:
    """The vibrations of one point; a sample that is not jammed is a row of NaN."""
    spectrum, psi = kind(samples.ensemble)
    psi_rotational = samples.of(psi, phi, kappa)
    if spectrum == "bin_count":
        edges = samples.of("bin_edge", phi, kappa)
        return _from_bins(edges, samples.of("bin_count", phi, kappa), psi_rotational)
    eigenvalue = samples.of("eigenvalue", phi, kappa)
    return Modes(statistics.frequencies(eigenvalue).frequency, psi_rotational)


def frictionless(samples: Samples, phi: float) -> np.ndarray:
    """Frequencies (S, M) at k_T = 0, where every mode is translational."""
    if kind(samples.ensemble)[0] == "eigenvalue":
        return statistics.frequencies(samples.of("eigenvalue", phi, 0.0)).frequency
    edges, count = (samples.of(name, phi, 0.0) for name in ("bin_edge", "bin_count"))
    return _from_bins(edges, count, np.zeros_like(count)).frequency


def _from_bins(edges: np.ndarray, count: np.ndarray, psi: np.ndarray) -> Modes:
    count = np.nan_to_num(count).astype(int)
    rows = [_spread(*row) for row in zip(edges, count, psi, strict=True)]
    longest = max(len(frequency) for frequency, _ in rows)
    padded = np.full((2, len(rows), longest), np.nan)
    for place, row in enumerate(rows):
        padded[:, place, : row.shape[1]] = row
    return Modes(*padded)


def _spread(edges: np.ndarray, count: np.ndarray, psi: np.ndarray) -> np.ndarray:
    """Frequencies and psi of one sample, (2, M); in a bin of both kinds the bands overlap."""
    filled = np.nonzero(count)[0]
    middles = [(np.arange(count[b]) + 0.5) / count[b] for b in filled]
    kinds = [(m > 1.0 - psi[b]).astype(float) for b, m in zip(filled, middles, strict=True)]
    steps = [
        edges[b] * (edges[b + 1] / edges[b]) ** m for b, m in zip(filled, middles, strict=True)
    ]
    return np.array([np.concatenate([[], *steps]), np.concatenate([[], *kinds])])


def per_sample(statistic, *bands: np.ndarray) -> np.ndarray:
    """A statistic of the frequencies of each sample, NaN where one band of it is empty: (S, ...).

    Args:
        statistic: function of one array of frequencies, ascending, for each of `bands`.
        bands: arrays (S, M), NaN where there is no mode.
    """
    rows = [[np.sort(row[np.isfinite(row)]) for row in rows] for rows in zip(*bands, strict=True)]
    empty = [any(not row.size for row in of) for of in rows]
    found = [None if none else statistic(*of) for of, none in zip(rows, empty, strict=True)]
    like = next((value for value in found if value is not None), np.nan)
    blank = np.full(np.shape(like), np.nan)
    return np.array([blank if value is None else value for value in found])


def median_log(band: np.ndarray) -> np.ndarray:
    """log10 of the median frequency of each sample, (S,)."""
    return per_sample(lambda row: np.log10(np.median(row)), band)


def log_shares(band: np.ndarray, shares: np.ndarray = SHARES) -> np.ndarray:
    """log(omega) below which the given shares of a band lie, (S, len(shares))."""
    return per_sample(lambda row: np.log(np.quantile(row, shares)), band)


def mean_in(values: np.ndarray, where: np.ndarray) -> Estimate:
    """Mean over samples of the mean of (S, M) values over the modes `where`."""
    with np.errstate(invalid="ignore"):
        total = np.where(where, values, 0.0).sum(axis=1)
        return mean(total / where.sum(axis=1))
