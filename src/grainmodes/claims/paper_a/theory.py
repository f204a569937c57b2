"""Claims of paper A that compare two ways to compute a modulus: A1, A16 and A17.

    symbol        name                   paper A
    G             g                      Eq. 17, theory (Eqs. 39-46)
    G, simulated  g_simulated            Eq. 16
                  g_forward_by_strain    Eq. 16, one forward step of each size
                  g_translational        the mode sum over psi^T > 1/2 alone
    kappa         kt = k_T/k_N

Both come from the same packings, seed by seed; an average here runs over jammed samples.
"""

from __future__ import annotations

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_a.ranges import SMALL_KAPPA, TOLERANCE
from grainmodes.claims.part import Part
from grainmodes.claims.samples import ABOVE_ZERO, Samples, best_sampled, label
from grainmodes.statistics.estimates import Estimate, relative_difference


@claim("A1", unit="1")
def theory_is_simulation(ensemble) -> Outcome:
    """The rigidity G of the theory equals that of the simulation at all φ and k_T/k_N (Fig. 4).

    This is the relative difference of g_simulated and g, paired by seed, at every point.

    Asked of: every point of the ensemble.

    Criterion: The relative difference of the two is within ±1 % at every point.
    """
    samples = best_sampled(ensemble, "g", "g_simulated")
    parts = [
        Part(
            label(*point),
            _relative(samples, "g_simulated", "g", *point),
            -TOLERANCE,
            TOLERANCE,
        )
        for point in samples.points("g_simulated")
    ]
    return Outcome({"a simulated rigidity": parts}, _contact_changes(samples))


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
def independent_of_strain(ensemble) -> Outcome:
    """The simulated G does not depend on the step strain in 1e-6 ... 1e-4 (Sec. II).

    This is the relative difference of G from forward steps to that of the smallest step, paired by
    seed, at every point.

    Asked of: every point of the ensemble.

    Criterion: The relative difference to G at the smallest step is within ±1 % at every point.
    """
    samples = best_sampled(ensemble, "g_forward_by_strain", "diagnostic_strain")
    parts = []
    for point in samples.points("g_forward_by_strain"):
        moduli = samples.values("g_forward_by_strain", *point).T
        steps = np.nanmean(samples.values("diagnostic_strain", *point), axis=0)
        for step, modulus in zip(steps[1:], moduli[1:], strict=True):
            difference = relative_difference(modulus, moduli[0])
            parts.append(
                Part(
                    f"Δγ = {step:g}, {label(*point)}",
                    difference,
                    -TOLERANCE,
                    TOLERANCE,
                )
            )
    return Outcome({"steps of several sizes": parts})


@claim("A17", unit="1")
def translational_modes_suffice(ensemble) -> Outcome:
    """The translational modes alone give G at small k_T/k_N (abstract).

    This is the relative difference of the sum over the modes with ψ^T > 1/2 and g, paired by seed,
    at every point with k_T/k_N ≤ 1e-4.

    Asked of: every point of the ensemble.

    Criterion: The relative difference of their sum and G is within ±1 % at k_T/k_N ≤ 1e-4.
    """
    samples = best_sampled(ensemble, "g_translational", "g")
    parts = [
        Part(
            label(*point),
            _relative(samples, "g_translational", "g", *point),
            -TOLERANCE,
            TOLERANCE,
        )
        for point in samples.points("g_translational", ABOVE_ZERO, SMALL_KAPPA)
    ]
    above = samples.points("g_translational", 2.0 * SMALL_KAPPA)
    differences = {p: _relative(samples, "g_translational", "g", *p) for p in above}
    listed = ", ".join(f"{value} at {label(*point)}" for point, value in differences.items())
    note = f"At larger k_T/k_N the difference is {listed}." if listed else ""
    return Outcome({"k_T/k_N ≤ 1e-4": parts}, note)
