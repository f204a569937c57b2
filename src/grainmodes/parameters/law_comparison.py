"""How far the contact laws are compared side by side."""

from __future__ import annotations

MAX_GRAINS = 200
"""Grains up to which the dense eigenvalues of all states take seconds."""
