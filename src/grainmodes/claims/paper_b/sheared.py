"""The sheared samples of harmonic grains that the claims of paper B are about."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from grainmodes.claims.claim import NotTested
from grainmodes.claims.part import Part
from grainmodes.claims.samples import Samples, best_sampled, label
from grainmodes.ensemble import normal_law
from grainmodes.ensemble.curves import Curve, curves
from grainmodes.statistics.estimates import Estimate, mean

MIN_SHARE = 0.9
"""Share of the events that counts as all; the lowest mode may belong to another place."""

LARGEST = 0.1
"""Share of the events of a sample that are its largest drops."""

TOLERANCE = 0.01
"""Relative difference of two numbers that is not visible in a figure of B."""


def harmonic(ensemble, *names: str) -> Samples:
    """The samples of the N that has all the variables at most points, for harmonic grains.

    Raises:
        NotTested: the ensemble lacks one of the variables, or its grains are not harmonic.
    """
    samples = best_sampled(ensemble, *names, with_friction=None)
    if normal_law(ensemble) != "harmonic":
        raise NotTested("harmonic grains")
    return samples


def sheared(ensemble, *names: str) -> Iterator[tuple[str, list[Curve]]]:
    """The name of every point with sheared samples, and their curves.

    Raises:
        NotTested: as `harmonic`.
    """
    samples = harmonic(ensemble, "curve_strain", *names)
    for point in samples.points("curve_strain"):
        found = curves(ensemble, samples.n, *point).values()
        if moved := [curve for curve in found if len(curve.step)]:
            yield label(*point), moved


def over_samples(curves_of_samples: list[Curve], number: Callable[[Curve], float]) -> Estimate:
    """Mean over the samples of a number of each curve; NaN leaves a sample out."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return mean(np.array([number(curve) for curve in curves_of_samples]))


def measured(parts: list[Part]) -> list[Part]:
    """The parts that have a number."""
    return [part for part in parts if np.isfinite(part.measured.value)]


def large_drop(drops: np.ndarray) -> float:
    """The drop of σ from which an event is among the largest tenth of its sample; else ∞."""
    known = drops[np.isfinite(drops)]
    return float(np.quantile(known, 1.0 - LARGEST)) if len(known) else np.inf
