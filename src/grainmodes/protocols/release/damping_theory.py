"""What linear theory says of a release under a drag: growth rates and threshold: C, Sec. VII."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.release import Release
from grainmodes.protocols.release.unstable_state import UnstableState

CURVE = np.linspace(0.0, 6.0, 25)
"""η_0 / ω_i of the states of a curve."""


class DampingTheory(NamedTuple):
    """Growth rates in 1/t_0; NaN where the root of the quadratic eigenproblem is lost.

    `rates` are those of the runs, the first of them undamped; `threshold` is the η_0 at which the
    growth ends; `curve` holds the rates at `CURVE`.
    """

    rates: np.ndarray
    threshold: float
    curve: np.ndarray

    @classmethod
    def from_state(
        cls, start: UnstableState, interaction: Interaction, choices: Release
    ) -> DampingTheory:
        """The theory of a state under the dampings of a scene."""
        pair = start.under_drag(interaction, choices.damped_motion)
        dampings = np.array([0.0, *choices.dampings])
        order, unit = np.argsort(dampings), start.growth_rate
        rates = np.full(len(dampings), np.nan)
        rates[order] = pair.rates(dampings[order] * unit)
        return cls(rates, pair.threshold(), pair.rates(CURVE * unit))
