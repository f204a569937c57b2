"""The released states that the claims of paper C judge, decade by decade of their growth rate.

A scene lists growth rates, and every sample has one state near each of them. States of one listed
rate are compared over the samples; a part names them by their median ω_i.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from grainmodes.claims.claim import NotTested
from grainmodes.claims.part import MIN_SAMPLES
from grainmodes.claims.samples import best_sampled, label

if TYPE_CHECKING:
    import xarray as xr

RATE = "rate_linear"


class Released(NamedTuple):
    """The states of one listed growth rate at one point.

    `where` names them; `values` has the variables `release_…` by name, (S, …), NaN where a sample
    has no such state.
    """

    where: str
    values: dict[str, np.ndarray]

    @property
    def rate(self) -> np.ndarray:
        """ω_i of every sample, (S,)."""
        return self.values[RATE]

    def undamped(self, name: str) -> np.ndarray:
        """A value of the run without damping of every sample, (S,)."""
        return self.values[name][:, 0]


def released(ensemble: xr.Dataset, *names: str) -> Iterator[Released]:
    """The released states of every point and every listed rate with enough samples.

    Raises:
        NotTested: the ensemble lacks one of the variables, or released states.
    """
    for where, values in _points(ensemble, *names):
        for place in range(values[RATE].shape[1]):
            rates = values[RATE][:, place]
            if np.isfinite(rates).sum() < MIN_SAMPLES:
                continue
            name = f"ω_i ≈ {np.nanmedian(rates):.1e}, {where}"
            yield Released(name, {key: value[:, place] for key, value in values.items()})


def all_rates(ensemble: xr.Dataset, *names: str) -> Iterator[Released]:
    """The released states of every point with all listed rates together, (S, rates, …).

    Raises:
        NotTested: the ensemble lacks one of the variables, or released states.
    """
    for where, values in _points(ensemble, *names):
        yield Released(where, values)


def _points(ensemble: xr.Dataset, *names: str) -> Iterator[tuple[str, dict[str, np.ndarray]]]:
    names = (RATE, *names)
    absent = [f"release_{name}" for name in names if f"release_{name}" not in ensemble]
    if absent:
        raise NotTested(", ".join(absent))
    samples = best_sampled(ensemble, f"release_{RATE}")
    for point in samples.points(f"release_{RATE}"):
        values = {name: samples.values(f"release_{name}", *point) for name in names}
        yield f"N = {samples.n}, {label(*point)}", values
