"""How spectra are computed, and which kinds there are."""

from __future__ import annotations

from dataclasses import dataclass

SPECTRA = ("none", "counts", "binned_averages", "eigenvalues", "modes")
SPECTRUM_METHODS = ("auto", "dense", "slicing", "inertia_counts")

DENSE_COUNTS_UP_TO = 2000
"""Degrees of freedom up to which LAPACK's eigenvalues are cheaper than counts at edges."""

DENSE_MODES_UP_TO = 5000
"""Degrees of freedom up to which LAPACK finds all modes faster than spectrum slicing does, and
binned averages faster than inertia counts do."""

LOGARITHMIC_BINS = 50
HIGHEST_BINS = 10
HIGHEST_DIVISIONS = 500
ROTATIONAL_DIVISIONS = 100
"""Paper A's bins, see `statistics.binning`: intervals of the whole range, how many of the highest
are divided anew, into how many, and divisions around the rotational band."""

MIN_BIN_DENSITY = 0.01
"""Smallest factor on the numbers 500 and 100 of A's linear bins: it leaves one of the latter."""

MAX_DENSE_GRAINS = 20_000
"""Largest N of a dense spectrum: its matrix of 3 N by 3 N takes 29 GB, and LAPACK several."""

BINNED = ("counts", "binned_averages")
"""Kinds of spectrum that hold bins rather than modes."""


@dataclass(frozen=True)
class SpectrumChoices:
    """How a spectrum is computed; "auto" takes the cheapest method that delivers what is requested.

    `bin_density` is a factor on the numbers of A's linear bins. Of a bin with more modes than
    `modes_per_bin` the participation ratio is sampled on so many, and psi^R is counted in
    `cells_per_bin` cells.
    """

    method: str = "auto"
    factorisation: str = "auto"
    bin_density: float = 0.2
    modes_per_bin: int = 60
    cells_per_bin: int = 2
