"""Claims of paper A on the rigidity: A1 to A6, A16 and A17.

    symbol        name                   paper A
    G             g                      Eq. 17, theory (Eqs. 39-46)
    G, simulated  g_simulated            Eq. 16
    G_NA          g_nonaffine            Eq. 41
    phi_c         phi_jamming            of the frictionless packing
    kappa         kt = k_T/k_N

Every comparison is paired: at all k_T the packings of one seed are the same. An average here runs
over jammed samples.
"""

from __future__ import annotations

import numpy as np

from grainmodes.claims.claim import NotAsked, Outcome, Part, claim, every, text
from grainmodes.claims.estimates import Estimate, crossing, mean, relative_difference
from grainmodes.claims.samples import TINY, Samples, at, richest

SMALL = 1e-4
"""k_T/k_N up to which A finds no influence of k_T (Fig. 5)."""

LARGE = 1.0
"""k_T/k_N from which on A's bands are one; "large" where A says so without a number."""

SAME = 0.01
"""Relative difference of two moduli that a figure of A does not show."""

LIMIT = 0.001
"""Relative difference to the frictionless G that counts as its limit."""

CROSSING = (1.6, 2.5)
"""Range of k_T/k_N that is 2 on A's grid, whose neighbours of 2 are 1 and 5."""

FEWEST_PHI = 3
"""Area fractions without which an exponent has no meaning."""


@claim("A1", unit="1")
def theory_is_simulation(ensemble) -> Outcome:
    """The rigidity G of the theory is that of the simulation at all φ and k_T/k_N (Fig. 4).

    Relative difference of g_simulated and g, paired by seed, at every point.

    Criterion: |G_simulated - G| < 1 % of G.
    """
    samples = richest(ensemble, "g", "g_simulated")
    parts = [
        Part(at(*point), _relative(samples, "g_simulated", "g", *point), -SAME, SAME)
        for point in samples.points("g_simulated")
    ]
    return Outcome(parts, _contact_changes(samples))


def _relative(samples: Samples, name: str, reference: str, phi: float, kappa: float) -> Estimate:
    of = (samples.of(variable, phi, kappa) for variable in (name, reference))
    return relative_difference(*of)


def _contact_changes(samples: Samples) -> str:
    if "contact_changes" not in samples.ensemble:
        return ""
    counts = [samples.of("contact_changes", *p) for p in samples.points("contact_changes")]
    changed = sum(int((count > 0).sum()) for count in counts)
    total = sum(int(np.isfinite(count).sum()) for count in counts)
    return f"The step strain opened or closed contacts in {changed} of {total} samples."


@claim("A2", unit="1")
def not_proportional_to_distance(ensemble) -> Outcome:
    """G is not proportional to φ - φ_c at large k_T/k_N (Sec. IV A).

    Exponent β of G ∝ (φ - φ_c)^β, the slope of log G for each seed with its own φ_c; measured
    is β - 1.

    Criterion: |β - 1| > 0.1 at every k_T/k_N ≥ 1.
    """
    samples = richest(ensemble, "g", "phi_jamming")
    enough = [k for k in samples.kappas("g") if len(samples.phis("g", k)) >= FEWEST_PHI]
    if not enough:
        raise NotAsked(f"{FEWEST_PHI} area fractions with jammed samples")
    exponents = {kappa: _exponent(samples, kappa) for kappa in enough}
    parts = [
        Part(at(kappa=kappa), Estimate(abs(beta.value - 1.0), beta.error), 0.1)
        for kappa, beta in exponents.items()
        if kappa >= LARGE
    ]
    listed = ", ".join(f"{text(beta)} at κ = {kappa:g}" for kappa, beta in exponents.items())
    return Outcome(parts, f"β is {listed}.")


def _exponent(samples: Samples, kappa: float) -> Estimate:
    """Mean over seeds of d log G / d log(φ - φ_c), from at least three φ of a seed."""
    phis = samples.phis("g", kappa)
    distance = np.array([phi - samples.of("phi_jamming", phi, kappa) for phi in phis])
    moduli = np.array([samples.of("g", phi, kappa) for phi in phis])
    with np.errstate(invalid="ignore", divide="ignore"):
        x, y = np.log(distance), np.log(moduli)
    return mean(np.array([_slope(*column) for column in zip(x.T, y.T, strict=True)]))


def _slope(x: np.ndarray, y: np.ndarray) -> float:
    known = np.isfinite(x) & np.isfinite(y)
    return np.polyfit(x[known], y[known], 1)[0] if known.sum() >= FEWEST_PHI else np.nan


@claim("A3", unit="1")
def flat_at_small_stiffness(ensemble) -> Outcome:
    """G hardly depends on k_T/k_N for k_T/k_N ≤ 1e-4 (Fig. 5).

    Relative difference of G to that at the smallest k_T > 0, paired by seed, at every φ.

    Criterion: |difference| < 1 %.
    """
    samples = richest(ensemble, "g")
    parts, errors = [], {}
    for phi in samples.phis("g"):
        lowest, *others = samples.kappas("g", phi, TINY, SMALL) or [None]
        reference = samples.of("g", phi, lowest) if others else None
        for kappa in others:
            difference = relative_difference(samples.of("g", phi, kappa), reference)
            parts.append(Part(at(phi, kappa), difference, -SAME, SAME))
        if others:
            errors[phi] = mean(reference).error / np.nanmean(reference)
    listed = ", ".join(f"{error:.2g} at {at(phi)}" for phi, error in errors.items())
    return Outcome(parts, f"For comparison, the relative standard error of G itself: {listed}.")


@claim("A4", unit="1")
def frictionless_limit(ensemble) -> Outcome:
    """G goes to its frictionless value as k_T → 0, without a jump (Sec. IV A).

    Relative difference of G at the smallest k_T > 0 and at k_T = 0, paired by seed, at every φ.

    Criterion: |difference| < 0.1 % at a k_T/k_N ≤ 1e-6.
    """
    samples = richest(ensemble, "g")
    with_limit = [phi for phi in samples.phis("g", 0.0) if samples.kappas("g", phi, TINY, 1e-6)]
    if not with_limit:
        raise NotAsked("k_T = 0 and a k_T/k_N ≤ 1e-6")
    parts = [
        Part(at(phi, kappa), _to_frictionless(samples, phi, kappa), -LIMIT, LIMIT)
        for phi in with_limit
        for kappa in samples.kappas("g", phi, TINY, 1e-6)[:1]
    ]
    phi = with_limit[-1]
    approach = {k: _to_frictionless(samples, phi, k) for k in samples.kappas("g", phi, TINY, 1.0)}
    listed = ", ".join(f"{text(value)} at κ = {kappa:g}" for kappa, value in approach.items())
    return Outcome(parts, f"The difference at {at(phi)} is {listed}.")


def _to_frictionless(samples: Samples, phi: float, kappa: float) -> Estimate:
    return relative_difference(samples.of("g", phi, kappa), samples.of("g", phi, 0.0))


@claim("A5", unit="1")
def no_factorisation(ensemble) -> Outcome:
    """G(φ, k_T/k_N) is no product G_0(φ) 𝒢(k_T/k_N) at large k_T/k_N (Sec. IV A, footnote 2).

    log of G(κ)/G(0) at the lowest φ minus that at the highest φ, paired by seed; a product gives 0.
    A seed with G ≤ 0, as small systems have, has no logarithm and is left out.

    Criterion: |difference| > 0.05 at every k_T/k_N ≥ 1.
    """
    samples = richest(ensemble, "g")
    phis = samples.phis("g", 0.0)
    if len(phis) < 2:
        raise NotAsked("k_T = 0 at two area fractions with jammed samples")
    parts, ends = [], (phis[0], phis[-1])
    for kappa in _common(samples, "g", ends, LARGE):
        low, high = (_log_gain(samples, phi, kappa) for phi in ends)
        change = mean(low - high)
        parts.append(Part(at(kappa=kappa), Estimate(abs(change.value), change.error), 0.05))
    return Outcome(parts, _gains(samples, ends))


def _common(
    samples: Samples, name: str, phis: tuple[float, float], low: float = 0.0
) -> list[float]:
    """Values of k_T/k_N from `low` on at which a variable has samples at both φ."""
    first, last = (samples.kappas(name, phi, low) for phi in phis)
    return [kappa for kappa in first if kappa in last]


def _log_gain(samples: Samples, phi: float, kappa: float) -> np.ndarray:
    with np.errstate(invalid="ignore"):
        return np.log(samples.of("g", phi, kappa) / samples.of("g", phi, 0.0))


def _gains(samples: Samples, phis: tuple[float, float]) -> str:
    """G(κ)/G(0) at the largest κ, at two area fractions."""
    kappa = samples.kappas("g", phis[-1])[-1]
    gains = {phi: _to_frictionless(samples, phi, kappa) for phi in phis}
    listed = (f"{text(Estimate(g.value + 1, g.error))} at {at(phi)}" for phi, g in gains.items())
    return f"G(κ = {kappa:g}) / G(0) is {' and '.join(listed)}."


@claim("A6", unit="1")
def nonaffine_sign_change(ensemble) -> Outcome:
    """G_NA is negative for k_T/k_N < 2 and positive above; |G_NA| grows with φ (Fig. 6).

    k_T/k_N at which the mean of g_nonaffine (unloaded step) rises through 0, at every φ, linear
    in log k_T between points of the grid, its error the jackknife over seeds; and the
    relative difference of |G_NA| at the highest and the lowest φ, at the smallest and the largest
    k_T, paired by seed.

    Criterion: the crossing lies within 1.6 ... 2.5 at every φ, and |G_NA| is larger at the
    highest φ.
    """
    samples = richest(ensemble, "g_nonaffine", "g_nonaffine_loaded")
    phis = samples.phis("g_nonaffine")
    zeros = {phi: _zero(samples, phi) for phi in phis if _ends_around_two(samples, phi)}
    parts = {
        "k_T/k_N on both sides of 2": [
            Part(f"crossing at {at(phi)}", zero, *CROSSING) for phi, zero in zeros.items()
        ],
        "two area fractions": [
            _growth(samples, kappa, phis) for kappa in _ends(samples, phis) if len(phis) > 1
        ],
    }
    return Outcome(every(parts), f"{_crossings(zeros)} {_loading(samples)}")


def _ends(samples: Samples, phis: list[float]) -> list[float]:
    """The smallest and the largest k_T with samples at the lowest and at the highest φ."""
    kappas = _common(samples, "g_nonaffine", (phis[0], phis[-1]))
    return [kappas[0], kappas[-1]] if kappas else []


def _ends_around_two(samples: Samples, phi: float) -> bool:
    kappas = samples.kappas("g_nonaffine", phi, TINY)
    return bool(kappas) and kappas[0] < CROSSING[0] and kappas[-1] > CROSSING[1]


def _zero(samples: Samples, phi: float) -> Estimate:
    kappas = samples.kappas("g_nonaffine", phi, TINY)
    rows = np.array([samples.of("g_nonaffine", phi, kappa) for kappa in kappas])
    return crossing(np.array(kappas), rows.T)


def _growth(samples: Samples, kappa: float, phis: list[float]) -> Part:
    low, high = (np.abs(samples.of("g_nonaffine", phi, kappa)) for phi in (phis[0], phis[-1]))
    return Part(f"growth at {at(kappa=kappa)}", relative_difference(high, low), 0.0)


def _crossings(zeros: dict[float, Estimate]) -> str:
    listed = ", ".join(f"{text(zero)} at {at(phi)}" for phi, zero in zeros.items())
    return f"The unloaded G_NA crosses 0 at κ = {listed}."


def _loading(samples: Samples) -> str:
    """What becomes of the sign once the step loads the tangential springs."""
    points = samples.points("g_nonaffine_loaded", TINY)
    loaded = np.array([samples.of("g_nonaffine_loaded", *point) for point in points])
    (phi, kappa), last = points[-1], samples.of("g_nonaffine", *points[-1])
    return (
        "The sign belongs to the step, which does not load the tangential springs: with springs "
        "loaded g_NA = -aᵀJ⁺a/L² ≤ 0, positive in "
        f"{int((loaded > 0).sum())} of {int(np.isfinite(loaded).sum())} samples, and G_NA at "
        f"{at(phi, kappa)} is {text(mean(loaded[-1]))} loaded, {text(mean(last))} unloaded."
    )


@claim("A16", unit="1")
def independent_of_strain(ensemble) -> Outcome:
    """The simulated G does not depend on the step strain in 1e-6 ... 1e-4 (Sec. II).

    Relative difference of G from forward steps to that of the smallest step, paired by seed, at
    every point.

    Criterion: |difference| < 1 %.
    """
    samples = richest(ensemble, "g_forward_by_strain", "probe_strain")
    parts = []
    for point in samples.points("g_forward_by_strain"):
        moduli = samples.of("g_forward_by_strain", *point).T
        steps = np.nanmean(samples.of("probe_strain", *point), axis=0)
        for step, of in zip(steps[1:], moduli[1:], strict=True):
            difference = relative_difference(of, moduli[0])
            parts.append(Part(f"Δγ = {step:g}, {at(*point)}", difference, -SAME, SAME))
    return Outcome(parts)


@claim("A17", unit="1")
def translational_modes_suffice(ensemble) -> Outcome:
    """The translational modes alone give G at small k_T/k_N (abstract).

    Relative difference of the sum over modes with ψ^T > 1/2 and of g, paired by seed, at every
    point with k_T/k_N ≤ 1e-4.

    Criterion: |difference| < 1 %.
    """
    samples = richest(ensemble, "g_translational", "g")
    parts = [
        Part(at(*point), _relative(samples, "g_translational", "g", *point), -SAME, SAME)
        for point in samples.points("g_translational", TINY, SMALL)
    ]
    above = samples.points("g_translational", 2.0 * SMALL)
    differences = {p: _relative(samples, "g_translational", "g", *p) for p in above}
    listed = ", ".join(f"{text(value)} at {at(*point)}" for point, value in differences.items())
    return Outcome(parts, f"Above, the difference is {listed}." if listed else "")
