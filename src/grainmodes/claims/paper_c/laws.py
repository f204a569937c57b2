"""Claims of paper C on other contact laws: C8 and C9, of harmonic grains.

symbol    name                                                              paper C
λ pairs   comparison_pairs_slipping, comparison_pairs_sticking, by law      Sec. VIII
ω_i       comparison_rate, by law                                           (12)
growth    comparison_growth of the released state, over ω_i                 (13), Fig. 12(b)

At Coulomb's threshold a sharp spring slips in one direction and sticks in the other, and J has a
different limit on each side. C counts no slip there ("the Hamiltonian remains valid"), which is the
sticking side.
"""

from __future__ import annotations

import numpy as np

from grainmodes.claims.claim import NotTested, Outcome, claim
from grainmodes.claims.part import Part
from grainmodes.claims.samples import Samples, best_sampled, label
from grainmodes.ensemble import normal_law
from grainmodes.statistics.estimates import Estimate, mean
from grainmodes.statistics.shares import share

MIN_SHARE = 0.5
"""Share of the samples from which on pairs are the rule."""

MAX_SHARE = 0.02
"""Share of states below which a sample counts as one without pairs."""

AGREEMENT_RANGE = (0.9, 1.1)
"""Range of the growth over ω_i that agrees with linear theory."""

MAX_GROWTH = 0.1
"""Growth over ω_i below which a state does not grow."""


@claim("C8", unit="1")
def smoothed_is_unstable(ensemble) -> Outcome:
    """Harmonic grains with the smoothed Coulomb law have the same instability (Sec. VIII, Fig. 12).

    These are the share of the sheared samples in which complex pairs are born, and the growth rate
    of released states over ω_i, averaged over the states of a sample.

    Asked of: every point at which laws are compared.

    Criterion: Pairs are born in more than one half of the samples, and released states grow at
    0.9 ... 1.1 ω_i.
    """
    samples, points = _harmonic(ensemble, "smoothed_coulomb")
    parts, notes = [], []
    for point in points:
        pairs = _by_state(samples, "pairs_slipping", "smoothed_coulomb", point)
        parts.append(Part(f"born, {label(*point)}", share(_born(pairs)), MIN_SHARE))
        parts.append(Part(f"growth, {label(*point)}", _growth(samples, point), *AGREEMENT_RANGE))
        notes.append(f"A state has {mean(np.nanmean(pairs, axis=1))} pairs at {label(*point)}.")
    return Outcome({"sheared samples": _resolved(parts)}, " ".join(notes))


@claim("C9", unit="1")
def sharp_is_stable(ensemble) -> Outcome:
    """Harmonic grains with the sharp Coulomb law do not have the instability (Sec. VIII).

    These are the share of the samples in which J has complex pairs in 2 % of the states or more if
    springs at their threshold stick, and the largest growth rate over ω_i among the released states
    of a sample that have pairs if these springs slip. Samples are counted, and not states: a pair
    lives through many states of a sample.

    Asked of: every point at which laws are compared.

    Criterion: In less than one half of the samples 2 % of the states or more have pairs if springs
    stick, and released states grow at less than 0.1 ω_i.
    """
    samples, points = _harmonic(ensemble, "sharp_coulomb")
    parts, notes = [], []
    for point in points:
        sticking, slipping = (
            _by_state(samples, name, "sharp_coulomb", point)
            for name in ("pairs_sticking", "pairs_slipping")
        )
        having = share((_share(sticking) >= MAX_SHARE).astype(float))
        parts.append(Part(f"sticking, {label(*point)}", having, high=MIN_SHARE))
        ratio = _ratio(samples, "sharp_coulomb", point)
        largest = np.where(np.isfinite(ratio), ratio, -np.inf).max(axis=1)
        growth = Part(
            f"growth, {label(*point)}", mean(largest[np.isfinite(largest)]), high=MAX_GROWTH
        )
        parts.append(growth)
        notes.append(
            f"At {label(*point)} the share of states with pairs is {mean(_share(slipping))} if "
            f"springs slip; of {np.isfinite(ratio).sum()} released states "
            f"{(ratio > MAX_GROWTH).sum()} grow."
        )
    return Outcome({"sheared samples": _resolved(parts)}, " ".join(notes))


def _harmonic(ensemble, law: str) -> tuple[Samples, list[tuple[float, float]]]:
    """The samples of harmonic grains, and the points at which they were sheared under this law.

    Raises:
        NotTested: the ensemble lacks the numbers, or its grains are not harmonic.
    """
    name = f"comparison_pairs_slipping_{law}"
    samples = best_sampled(ensemble, name, f"comparison_rate_{law}")
    if normal_law(ensemble) != "harmonic":
        raise NotTested("harmonic grains")
    return samples, samples.points(name)


def _by_state(samples: Samples, number: str, law: str, point: tuple[float, float]) -> np.ndarray:
    """A number (S, M) of the M states of every jammed sample that has one."""
    values = samples.values(f"comparison_{number}_{law}", *point)
    return values[np.isfinite(samples.values(f"comparison_rate_{law}", *point)).any(axis=1)]


def _born(pairs: np.ndarray) -> np.ndarray:
    """Whether a sample has pairs in any state; (S,) of 1 and 0."""
    return (np.nan_to_num(pairs) > 0).any(axis=1).astype(float)


def _share(pairs: np.ndarray) -> np.ndarray:
    """Share of the states of a sample that have pairs; (S,)."""
    return np.where(np.isfinite(pairs), pairs > 0, 0.0).sum(1) / np.isfinite(pairs).sum(1)


def _ratio(samples: Samples, law: str, point: tuple[float, float]) -> np.ndarray:
    """Growth over ω_i, NaN where there is no pair; (S, states)."""
    growth, rate = (_by_state(samples, name, law, point) for name in ("growth", "rate"))
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(rate > 0.0, growth / rate, np.nan)


def _growth(samples: Samples, point: tuple[float, float]) -> Estimate:
    """Mean growth over ω_i of the samples that have pairs."""
    ratio = _ratio(samples, "smoothed_coulomb", point)
    known = np.isfinite(ratio)
    having = known.any(axis=1)
    return mean(np.where(known, ratio, 0.0).sum(axis=1)[having] / known.sum(axis=1)[having])


def _resolved(parts: list[Part]) -> list[Part]:
    """The parts with a number: a sample without pairs has no growth."""
    return [part for part in parts if np.isfinite(part.measured.value)]
