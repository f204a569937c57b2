"""Rows of the figures of the spectrum: one per bin of frequency, for each curve.

Modes in no bin (zero, negative, beyond the edges) are counted in every row, so that the bins and
`modes_outside` together are all modes.
"""

from __future__ import annotations

import pandas as pd

from grainmodes.ensemble import bin_density
from grainmodes.ensemble.spectra import shared_edges, spectrum
from grainmodes.figures.shared.columns import POINT
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.spectral_points import Coordinates
from grainmodes.statistics import averages, binning
from grainmodes.statistics.binning import BinnedModes

BINS = {
    **POINT,
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


def bin_rows(ensemble, options: Options, points: list[Coordinates]) -> pd.DataFrame:
    """The bins of several points below each other, with all columns `COLUMNS`.

    Each point has its own bins. A point without any vibration (no jammed sample) has no rows.
    """
    return stack([compare_spectra(ensemble, options, {"": (point, "")}) for point in points])


def compare_spectra(
    ensemble, options: Options, kinds: dict[str, tuple[Coordinates, str]]
) -> pd.DataFrame:
    """Several spectra in the same bins below each other, with all columns and `kind`.

    Spectra that the study counted in bins keep these.

    Args:
        kinds: word for the column `kind` → point, and ending of the names in the ensemble.
    """
    spectra = {kind: spectrum(ensemble, *point, ending) for kind, (point, ending) in kinds.items()}
    largest_kt = max(point[-1] for point, _ in kinds.values())
    chosen = bin_density(ensemble) if options.bin_density is None else options.bin_density
    edges = shared_edges(list(spectra.values()), largest_kt, chosen)
    return stack(
        [
            rows_of_bins(modes.in_bins(edges), kinds[kind][0], kind)
            for kind, modes in spectra.items()
        ]
    )


def rows_of_bins(modes: BinnedModes, point: Coordinates, kind: str) -> pd.DataFrame:
    """The rows of one spectrum, with all columns and `kind`."""
    n, phi, kt = point
    density = averages.density_of_states(modes.count, n, modes.edges)
    psi = averages.mode_average(modes.count, modes.psi_rotational)
    participation = averages.mode_average(modes.count, modes.participation_ratio)
    return pd.DataFrame(
        {
            "n": n,
            "phi": phi,
            "kt": kt,
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


def stack(parts: list[pd.DataFrame]) -> pd.DataFrame:
    """Tables below each other, without those that hold no mode."""
    filled = [part for part in parts if part["modes"].any()]
    return pd.concat(filled or [parts[0][:0]], ignore_index=True)
