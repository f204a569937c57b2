"""Rows of the figures of the spectrum: one per bin of frequency, for each curve.

Modes without a place in a bin (zero, negative, beyond the edges) are counted in every row, so that
the bins and `modes_outside` are all modes.
"""

from __future__ import annotations

import pandas as pd

from grainmodes.ensemble import bin_density
from grainmodes.ensemble.spectra import shared_edges, spectrum
from grainmodes.figures.shared.selection import Options
from grainmodes.statistics import averages, binning
from grainmodes.statistics.binning import BinnedModes

BINS = {
    "n": ("1", "number of grains N"),
    "phi": ("1", "area fraction"),
    "kt": ("k_N", "tangential stiffness k_T"),
    "omega": ("1/t_0", "geometric middle of the bin"),
    "omega_low": ("1/t_0", "lower edge of the bin"),
    "omega_high": ("1/t_0", "upper edge of the bin"),
    "samples": ("1", "number of converged samples"),
    "modes": ("1", "modes in the bin, all samples together"),
    "modes_outside": ("1", "modes in no bin (zero, negative, beyond), mean per sample"),
}
DENSITY = {
    "density": ("t_0", "density of states D, A Eq. 23; unjammed samples count as 0"),
    "density_standard_error": ("t_0", "standard error of D over samples"),
}
FRACTION = {
    "psi_translational": ("1", "psi^T, A Eq. 51; no value in an empty bin"),
    "psi_rotational": ("1", "psi^R, A Eq. 52; no value in an empty bin"),
    "psi_standard_error": ("1", "standard error of both, over samples, or stated if larger"),
}
PARTICIPATION = {
    "participation_ratio": ("1", "participation ratio p, A Eq. E2; no value in an empty bin"),
    "participation_ratio_standard_error": ("1", "standard error of p, as that of psi"),
}
COLUMNS = BINS | DENSITY | FRACTION | PARTICIPATION


Point = tuple[int, float, float]
"""n, phi, k_T."""


def rows(ensemble, options: Options, points: list[Point]) -> pd.DataFrame:
    """The bins of several points below each other, with all columns `COLUMNS`.

    Each point has bins of its own. One without any vibration (no jammed sample) has no rows.
    """
    return stacked([compared(ensemble, options, {"": (point, "")}) for point in points])


def compared(ensemble, options: Options, kinds: dict[str, tuple[Point, str]]) -> pd.DataFrame:
    """Several spectra below each other, with all columns and `kind`.

    All are in the same bins, but for those that the study counted: these keep their own.

    Args:
        kinds: word for the column `kind` → point, and ending of the names in the ensemble.
    """
    spectra = {kind: spectrum(ensemble, *point, ending) for kind, (point, ending) in kinds.items()}
    kappa = max(point[-1] for point, _ in kinds.values())
    chosen = bin_density(ensemble) if options.bin_density is None else options.bin_density
    edges = shared_edges(list(spectra.values()), kappa, chosen)
    parts = [of_bins(of.in_bins(edges), kinds[kind][0], kind) for kind, of in spectra.items()]
    return stacked(parts)


def of_bins(modes: BinnedModes, point: Point, kind: str) -> pd.DataFrame:
    """The rows of one spectrum, with all columns and `kind`."""
    n, phi, kappa = point
    density = averages.density_of_states(modes.count, n, modes.edges)
    psi = averages.mode_average(modes.count, modes.psi_rotational)
    participation = averages.mode_average(modes.count, modes.participation_ratio)
    return pd.DataFrame(
        {
            "n": n,
            "phi": phi,
            "kt": kappa,
            "omega": binning.bin_centres(modes.edges),
            "omega_low": modes.edges[:-1],
            "omega_high": modes.edges[1:],
            "samples": density.samples,
            "modes": modes.count.sum(axis=0).astype(int),
            "modes_outside": modes.outside.sum() / max(1, len(modes.outside)),
            "density": density.mean,
            "density_standard_error": density.standard_error,
            "psi_translational": 1.0 - psi.mean,
            "psi_rotational": psi.mean,
            "psi_standard_error": psi.standard_error,
            "participation_ratio": participation.mean,
            "participation_ratio_standard_error": participation.standard_error,
            "kind": kind,
        }
    )


def stacked(parts: list[pd.DataFrame]) -> pd.DataFrame:
    """Tables below each other, without those that hold no mode."""
    filled = [part for part in parts if part["modes"].any()]
    return pd.concat(filled or [parts[0][:0]], ignore_index=True)
