"""Eigenvalues and modes of the Jacobian: counted in bins, by spectrum slicing, or all at once."""

from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.spectrum.binned_averages import BinnedAverages, average_in_bins
from grainmodes.spectrum.eigenproblem import Eigenproblem
from grainmodes.spectrum.full import FullSpectrum, full_spectrum, packing_spectrum

__all__ = [
    "BinnedAverages",
    "Eigenproblem",
    "FullSpectrum",
    "SpectrumChoices",
    "average_in_bins",
    "full_spectrum",
    "packing_spectrum",
]
