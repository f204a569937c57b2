"""Claims of paper C on the birth and death of complex pairs: C1 to C3.

    symbol        name                                                         paper C
    γ_c           PairSample.exceptional_points["strain"], where D = 0         (20)
    λ1 − λ2       the root of PairSample.neighbours["discriminant"]            (21)
    ⟨u1|u2⟩       PairSample.neighbours["product"]                             Figs. 2 and 3

Averages run over the exceptional points of each sample first, and then over the samples.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pandas as pd

from grainmodes.claims.claim import NotTested, Outcome, claim
from grainmodes.claims.part import MIN_SAMPLES, Part
from grainmodes.claims.samples import label, samples_by_size
from grainmodes.ensemble.exceptional import PairSample, pair_samples
from grainmodes.statistics.estimates import Estimate, mean
from grainmodes.statistics.shares import share

EXPONENT, EXPONENT_TOLERANCE = 0.5, 0.01
"""The exponent of C (21), and the largest difference of a measured one to it."""

HALF = 0.5

MIN_PRODUCT = 0.999
"""Scalar product above which two eigenvectors count as parallel; C's figures resolve less."""


@claim("C1", unit="1")
def born_under_shear(ensemble) -> Outcome:
    """Complex pairs are born under quasistatic shear from states that have none (Fig. 1).

    These are the share of the samples with a pair in the first state, and of those in which pairs
    are born: one such sample shows that they exist. The note has the births per unit of strain and
    per grain for every N.

    Asked of: every N and point with tracks of complex pairs.

    Criterion: The first state has a pair in less than one half of the samples, and pairs are born
    in some of them.
    """
    parts, notes = [], []
    for samples in samples_by_size(ensemble, "pair_count", "track_count", "pair_strain"):
        for point in samples.points("pair_count"):
            pairs, strain = (samples.values(f"pair_{n}", *point) for n in ("count", "strain"))
            births = samples.values("track_count", *point)
            where = f"N = {samples.n}, {label(*point)}"
            parts.append(Part(f"first state, {where}", share(_flags(pairs[:, 0])), high=HALF))
            parts.append(Part(f"samples with births, {where}", share(_flags(births)), low=0.0))
            per_strain = mean(births / np.fmax.reduce(strain, axis=1) / samples.n)
            notes.append(
                f"At {where} a sample has {per_strain} births per unit of strain and grain; the "
                f"last state has {mean(_last(pairs))} pairs."
            )
    return Outcome({"tracks of complex pairs": parts}, " ".join(notes))


def _flags(counts: np.ndarray) -> np.ndarray:
    """Whether a sample has any, (S,) of 1 and 0, NaN where it is not known."""
    return np.where(np.isfinite(counts), counts > 0, np.nan)


def _last(pairs: np.ndarray) -> np.ndarray:
    """Pairs in the last state of every sample."""
    known = np.isfinite(pairs)
    last = np.where(known.any(axis=1), known.cumsum(axis=1).argmax(axis=1), 0)
    return np.take_along_axis(pairs, last[:, None], axis=1)[:, 0]


@claim("C2", unit="1")
def square_root(ensemble) -> Outcome:
    """|λ1 − λ2| grows as |γ − γ_c|^(1/2) at births and at deaths, on both sides (Fig. 4).

    The exponent is fitted by least squares; the number of a sample is the median over its births or
    deaths.

    Asked of: births and deaths, on the sides of real modes and of pairs, where four samples
    have them.

    Criterion: The exponent lies within 0.49 ... 0.51.
    """
    low, high = EXPONENT - EXPONENT_TOLERANCE, EXPONENT + EXPONENT_TOLERANCE
    parts = []
    for where, group in _grouped(ensemble):
        for birth, event in ((1, "births"), (0, "deaths")):
            for side in ("real", "pair"):
                found = _over(group, lambda s, b=birth, k=side: _exponent(s, b, k))
                if np.isfinite(found.error):
                    parts.append(Part(f"{event}, {side}, {where}", found, low, high))
    counted = sum(len(sample.exceptional_points) for sample in pair_samples(ensemble))
    return Outcome(
        {"births and deaths": parts}, f"The fits are those at {counted} exceptional points."
    )


def _exponent(sample: PairSample, birth: int, side: str) -> float:
    points = sample.exceptional_points
    return float(points.loc[points["birth"] == birth, f"exponent_{side}"].median())


@claim("C3", unit="1")
def parallel_eigenvectors(ensemble) -> Outcome:
    """The scalar product of two real eigenvectors tends to 1 at γ_c (Figs. 2 and 3).

    The product is extrapolated to γ_c along a straight line through the two nearest states with
    real modes, because 1 minus the product is proportional to |γ − γ_c|, and averaged over the
    births and deaths of a sample.

    Asked of: every N and point where four samples have births or deaths.

    Criterion: The extrapolated product is above 0.999.
    """
    parts, notes = [], []
    for where, group in _grouped(ensemble):
        found = _over(group, _at_the_point)
        if np.isfinite(found.error):
            parts.append(Part(where, found, MIN_PRODUCT))
            far = _over(group, lambda s: float(_real(s).groupby("point")["product"].last().mean()))
            notes.append(f"In the farthest state, {where}, the product is {far}.")
    return Outcome({"births and deaths": parts}, " ".join(notes))


def _real(sample: PairSample) -> pd.DataFrame:
    """The states around γ_c with two real modes, |γ − γ_c| ascending."""
    near = sample.neighbours[sample.neighbours["discriminant"] > 0.0]
    return near.assign(size=near["distance"].abs()).sort_values("size")


def _at_the_point(sample: PairSample) -> float:
    """The product at γ_c, averaged over the exceptional points with at least two states."""
    pairs = [states.iloc[:2] for _, states in _real(sample).groupby("point") if len(states) > 1]
    return float(np.mean([_extrapolated(*pair["size"], *pair["product"]) for pair in pairs]))


def _extrapolated(near: float, far: float, product: float, other: float) -> float:
    """The value at distance 0 of a straight line through two states."""
    return (far * product - near * other) / (far - near)


def _grouped(ensemble) -> Iterator[tuple[str, list[PairSample]]]:
    """The name of every point, and its samples with exceptional points, if there are enough.

    Raises:
        NotTested: the ensemble lacks them.
    """
    if "exceptional_point_kind" not in ensemble:
        raise NotTested("exceptional_point_kind, exceptional points of complex pairs")
    groups: dict[tuple, list[PairSample]] = {}
    for sample in pair_samples(ensemble):
        place = sample.coordinates
        groups.setdefault((place["n"], place["phi"], place["kt"]), []).append(sample)
    for (n, phi, kt), group in groups.items():
        if len(group) >= MIN_SAMPLES:
            yield f"N = {n}, {label(phi, kt)}", group


def _over(group: list[PairSample], number: Callable[[PairSample], float]) -> Estimate:
    """Mean over the samples of a number of each; NaN leaves a sample out."""
    return mean(np.array([number(sample) for sample in group]))
