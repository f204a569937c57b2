"""Eigenvalues and modes of the Jacobian."""

from grainmodes.spectrum.dense import Spectrum, spectrum

__all__ = ["Spectrum", "spectrum"]
