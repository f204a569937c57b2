"""The modes of a point, split into the rotational band (psi^R > 1/2) and the translational band.

If an ensemble holds counts in bins instead of eigenvalues, a bin of c modes with mean psi^R counts
as c psi^R rotational modes and c (1 - psi^R) translational ones, spread over the bin evenly in
log(omega). This is correct where the modes are of one kind, and resolved to the width of a bin. If
the bins have no psi^R and k_T/k_N is at most 1e-6, the gap between the bands separates them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from grainmodes.claims.claim import NotTested
from grainmodes.claims.samples import Samples
from grainmodes.dataset.padding import stack_padded
from grainmodes.statistics import averages
from grainmodes.statistics.estimates import Estimate, mean

if TYPE_CHECKING:
    import xarray as xr

SEPARABLE = "separable"
"""Name of the variable that marks samples with two bands."""

MAX_GAP_KAPPA = 1e-6
"""k_T/k_N up to which the gap separates the bands of a spectrum that was only counted."""

GAP_FREQUENCY = 3.0
"""omega / omega_R inside the gap: the rotational band of Hertzian grains ends below 1.5."""

MAX_KAPPA = {
    "psi_rotational": np.inf,
    "bin_psi_rotational": np.inf,
    "eigenvalue": 0.0,
    "bin_count": MAX_GAP_KAPPA,
}
"""Variable → k_T/k_N up to which it separates the bands."""

QUANTILES = np.linspace(0.1, 0.9, 9)
"""Quantiles at which two bands are compared; the ends of a band depend on single modes."""


class Modes(NamedTuple):
    """The vibrations of S samples, without zero modes: (S, M) each, NaN where there is no mode.

    `frequency` in 1/t_0, `psi_rotational` between 0 and 1.
    """

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


def separable(ensemble: xr.Dataset) -> xr.Dataset:
    """The ensemble with a variable `SEPARABLE`, 1 for samples whose two bands can be separated.

    Raises:
        NotTested: there is no such sample.
    """
    found = [
        _known(ensemble[name]) & (ensemble["kt"] <= max_kappa)
        for name, max_kappa in MAX_KAPPA.items()
        if name in ensemble
    ]
    if not any((known & (ensemble["kt"] > 0.0)).any() for known in found):
        raise NotTested("psi_rotational (observables.spectrum: modes, or binned_averages)")
    known = sum(found) > 0
    return ensemble.assign({SEPARABLE: known.where(known)})


def _known(values: xr.DataArray) -> xr.DataArray:
    """Whether a sample has values: at the first vibration of a spectrum of modes, or in any bin."""
    if "mode" in values.dims:
        return values.isel(mode=averages.TRANSLATIONS).notnull()
    return values.notnull().any("bin")


def modes(samples: Samples, phi: float, kappa: float) -> Modes:
    """The vibrations of one point; a sample that is not jammed is a row of NaN."""
    for spectrum, psi in (("eigenvalue", "psi_rotational"), ("bin_count", "bin_psi_rotational")):
        values = spectrum_at(samples, spectrum, phi, kappa)
        fractions = spectrum_at(samples, psi, phi, kappa)
        if values is not None and (
            fractions is not None or kappa == 0.0 or spectrum != "eigenvalue"
        ):
            break
    if spectrum == "eigenvalue":
        fractions = np.zeros_like(values) if fractions is None else fractions
        return Modes(averages.frequencies(values).frequency, fractions)
    edges = samples.values("bin_edge", phi, kappa)
    split = (edges[:, :-1] < GAP_FREQUENCY * np.sqrt(kappa)).astype(float)
    return _from_bins(edges, values, split if fractions is None else fractions)


def spectrum_at(samples: Samples, name: str, phi: float, kappa: float) -> np.ndarray | None:
    """A variable at one point, None where it has no value there."""
    values = samples.values(name, phi, kappa) if name in samples.ensemble else np.array(np.nan)
    return values if np.isfinite(values).any() else None


def frictionless(samples: Samples, phi: float) -> np.ndarray:
    """Frequencies (S, M) at k_T = 0, where every mode is translational."""
    return modes(samples, phi, 0.0).frequency


def _from_bins(edges: np.ndarray, count: np.ndarray, psi: np.ndarray) -> Modes:
    count = np.nan_to_num(count).astype(int)
    rows = [_spread(*row) for row in zip(edges, count, psi, strict=True)]
    return Modes(*(stack_padded(column, np.nan) for column in zip(*rows, strict=True)))


def _spread(edges: np.ndarray, count: np.ndarray, psi: np.ndarray) -> np.ndarray:
    """Frequencies and psi^R of one sample, (2, M); in a bin with both kinds the bands overlap."""
    filled = np.nonzero(count)[0]
    middles = [(np.arange(count[b]) + 0.5) / count[b] for b in filled]
    kinds = [(m > 1.0 - psi[b]).astype(float) for b, m in zip(filled, middles, strict=True)]
    steps = [
        edges[b] * (edges[b + 1] / edges[b]) ** m for b, m in zip(filled, middles, strict=True)
    ]
    return np.array([np.concatenate([[], *steps]), np.concatenate([[], *kinds])])


def per_sample(statistic, *bands: np.ndarray) -> np.ndarray:
    """A statistic of the frequencies of each sample: (S, ...), NaN where a band is empty.

    Args:
        statistic: function of as many arrays of frequencies, each ascending, as there are bands.
        bands: arrays (S, M), NaN where there is no mode.
    """
    values = []
    for rows in zip(*bands, strict=True):
        frequencies = [np.sort(row[np.isfinite(row)]) for row in rows]
        values.append(statistic(*frequencies) if all(map(len, frequencies)) else None)
    shape = np.shape(next((value for value in values if value is not None), np.nan))
    return np.array([np.full(shape, np.nan) if value is None else value for value in values])


def median_log(band: np.ndarray) -> np.ndarray:
    """log10 of the median frequency of each sample, (S,)."""
    return per_sample(lambda row: np.log10(np.median(row)), band)


def log_quantiles(band: np.ndarray, quantiles: np.ndarray = QUANTILES) -> np.ndarray:
    """log(omega) at the given quantiles of a band of each sample, (S, len(quantiles))."""
    return per_sample(lambda row: np.log(np.quantile(row, quantiles)), band)


def mean_in(values: np.ndarray, where: np.ndarray) -> Estimate:
    """Mean over samples of the mean over the modes `where` of (S, M) values."""
    with np.errstate(invalid="ignore"):
        total = np.where(where, values, 0.0).sum(axis=1)
        return mean(total / where.sum(axis=1))
