"""The sparse factorisations there are, and when the optional one is taken."""

from __future__ import annotations

FACTORISATIONS = ("auto", "superlu", "pardiso")

PARDISO_FROM = 3000
"""Rows from which PARDISO, where it is installed, is worth its start-up time."""
