"""The error that a wrong configuration raises."""

from __future__ import annotations


class ConfigurationError(ValueError):
    """A configuration with mistakes: one sentence, one line, for each."""
