"""Claims of paper A that compare two ways to compute a response: A1, A16, A17 and A21.

    symbol        name                   paper A
    G             g                      Eq. 17, theory (Eqs. 39-46)
    G, simulated  g_simulated            Eq. 16
                  g_forward_by_strain    Eq. 16, one forward step of each size
                  g_translational        the mode sum over psi^T > 1/2 alone
    kappa         kt = k_T/k_N

Both come from the same packings, seed by seed; an average here runs over jammed samples.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_a.ranges import (
    LARGE_KAPPA,
    LOG_TOLERANCE,
    MIN_PHI,
    SMALL_KAPPA,
    TOLERANCE,
    enough_grains,
)
from grainmodes.claims.part import Part
from grainmodes.claims.samples import ABOVE_ZERO, Samples, best_sampled, label
from grainmodes.statistics.estimates import (
    Estimate,
    log_relative_difference,
    mean,
    relative_difference,
)

if TYPE_CHECKING:
    import xarray as xr


@claim("A1", unit="1")
def theory_is_simulation(ensemble: xr.Dataset) -> Outcome:
    """The rigidity G of the theory equals that of the simulation at all φ and k_T/k_N (Fig. 4).

    This is the relative difference of g_simulated and g, paired by seed, at every point. The
    simulation relaxes by Newton's method. A's own damped dynamics relaxes a subset: forward steps
    at k_T/k_N ≥ 1, of which log10 of the size of the relative difference is averaged over seeds.

    Asked of: every point with a simulated rigidity, among them k_T/k_N ≤ 1e-4, k_T/k_N ≥ 1 and two
    φ; and damped dynamics at k_T/k_N ≥ 1.

    Criterion: The relative difference of the two is within ±1 % at every point, and its geometric
    mean below 1 % with damped dynamics.
    """
    samples = best_sampled(ensemble, "g", "g_simulated")
    limits = (-TOLERANCE, TOLERANCE)

    points = samples.points("g_simulated")
    parts = {
        p: Part(label(*p), _relative(samples, "g_simulated", "g", *p), *limits) for p in points
    }
    weak = samples.points("g_simulated", high=SMALL_KAPPA)
    strong = samples.points("g_simulated", LARGE_KAPPA)
    between = [point for point in points if point not in (*weak, *strong)]
    groups = {
        "a simulated rigidity at k_T/k_N ≤ 1e-4": [parts[point] for point in weak],
        "a simulated rigidity at k_T/k_N ≥ 1": [parts[point] for point in strong],
    }
    if between:
        groups["a simulated rigidity between"] = [parts[point] for point in between]
    if len(samples.phis("g_simulated")) < 2:
        groups["a simulated rigidity at two φ"] = []
    groups["g_forward_damped (claim_diagnostics at k_T/k_N ≥ 1)"] = _by_damped_dynamics(ensemble)
    return Outcome(groups, _contact_changes(samples))


def _by_damped_dynamics(ensemble: xr.Dataset) -> list[Part]:
    """Parts on steps that A's dynamics relaxed, at the N that has them."""
    if "g_forward_damped" not in ensemble:
        return []
    samples = best_sampled(ensemble, "g_forward_damped", "g")
    values = {
        p: (samples.values("g_forward_damped", *p), samples.values("g", *p))
        for p in samples.points("g_forward_damped", LARGE_KAPPA)
    }
    return [
        Part(
            f"damped, N = {samples.n}, {label(*point)}",
            log_relative_difference(*pair),
            high=LOG_TOLERANCE,
        )
        for point, pair in values.items()
    ]


def _relative(samples: Samples, name: str, reference: str, phi: float, kappa: float) -> Estimate:
    values = (samples.values(variable, phi, kappa) for variable in (name, reference))
    return relative_difference(*values)


def _contact_changes(samples: Samples) -> str:
    if "contact_changes" not in samples.ensemble:
        return ""
    counts = [samples.values("contact_changes", *p) for p in samples.points("contact_changes")]
    changed = sum(int((count > 0).sum()) for count in counts)
    total = sum(int(np.isfinite(count).sum()) for count in counts)
    return f"The step strain opened or closed contacts in {changed} of {total} samples."


@claim("A16", unit="1")
def independent_of_strain(ensemble: xr.Dataset) -> Outcome:
    """The simulated G does not depend on the step strain in 1e-6 ... 1e-4 (Sec. II).

    This is log10 of the size of the relative difference of G from forward steps to that of the
    smallest step, averaged over the seeds. Single packings near jamming have a G near 0 or below,
    so that a mean of the differences themselves would be that of one packing.

    Asked of: every point with steps of several sizes and φ ≥ 0.85, at N ≥ 256.

    Criterion: The geometric mean of the relative difference to G at the smallest step is below 1 %.
    """
    samples = best_sampled(ensemble, "g_forward_by_strain", "diagnostic_strain")
    parts = []
    for point in samples.points("g_forward_by_strain"):
        if point[0] < MIN_PHI:
            continue
        moduli = samples.values("g_forward_by_strain", *point).T
        steps = np.nanmean(samples.values("diagnostic_strain", *point), axis=0)
        for step, modulus in zip(steps[1:], moduli[1:], strict=True):
            parts.append(
                Part(
                    f"Δγ = {step:g}, {label(*point)}",
                    log_relative_difference(modulus, moduli[0]),
                    high=LOG_TOLERANCE,
                    needs=enough_grains(samples.n),
                )
            )
    return Outcome({"steps of several sizes at φ ≥ 0.85": parts})


@claim("A17", unit="1")
def translational_modes_suffice(ensemble: xr.Dataset) -> Outcome:
    """The translational modes alone give G at small k_T/k_N (abstract).

    This is the relative difference of the sum over the modes with ψ^T > 1/2 and g, paired by seed,
    at every point with k_T/k_N ≤ 1e-4.

    Asked of: every point with k_T/k_N ≤ 1e-4 that has the sum.

    Criterion: The relative difference of their sum and G is within ±1 % at k_T/k_N ≤ 1e-4.
    """
    samples = best_sampled(ensemble, "g_translational", "g")
    small = samples.points("g_translational", ABOVE_ZERO, SMALL_KAPPA)
    parts = [
        Part(
            label(*point),
            _relative(samples, "g_translational", "g", *point),
            -TOLERANCE,
            TOLERANCE,
        )
        for point in small
    ]
    above = [p for p in samples.points("g_translational", ABOVE_ZERO) if p not in small]
    differences = {p: _relative(samples, "g_translational", "g", *p) for p in above}
    listed = ", ".join(f"{value} at {label(*point)}" for point, value in differences.items())
    note = f"At larger k_T/k_N the difference is {listed}." if listed else ""
    return Outcome({"k_T/k_N ≤ 1e-4": parts}, note)


@claim("A21", unit="1")
def fields_agree(ensemble: xr.Dataset) -> Outcome:
    """The non-affine displacements of the theory are those of the simulation (Fig. 3).

    This is log10 of the norm of the difference of the two fields over that of the theory, all
    grains and components together, averaged over the seeds.

    Asked of: every point with both fields, among them k_T/k_N ≤ 1e-4 and k_T/k_N ≥ 1.

    Criterion: The geometric mean over the seeds is below 1 %.
    """
    samples = best_sampled(ensemble, "field_difference")
    groups = {
        "both fields at k_T/k_N ≤ 1e-4": samples.points("field_difference", 0.0, SMALL_KAPPA),
        "both fields at k_T/k_N ≥ 1": samples.points("field_difference", LARGE_KAPPA),
    }
    difference = {
        p: samples.values("field_difference", *p) for points in groups.values() for p in points
    }
    return Outcome(
        {
            need: [
                Part(label(*p), mean(np.log10(difference[p])), high=LOG_TOLERANCE) for p in points
            ]
            for need, points in groups.items()
        }
    )
