"""Eigenvalues and modes of the Jacobian."""

from grainmodes.spectrum.dense import NO_MODES, Spectrum, spectrum

__all__ = ["NO_MODES", "Spectrum", "spectrum"]
