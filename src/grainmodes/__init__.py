"""Rigidity and vibrational modes of two-dimensional packings of frictional grains."""

__version__ = "0.1.0"
