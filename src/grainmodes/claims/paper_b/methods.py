"""Claims of paper B on its methods: B2, B5 and B6.

symbol          name                                              paper B
|J - Jᵀ|        event_asymmetry_after, over max|J|                App. C 2, D 3
complex pairs   event_complex_pairs_after, of M⁻¹J                Sec. III A: none
"""

from __future__ import annotations

import numpy as np

from grainmodes.claims.claim import NotAsked, Outcome, Part, claim
from grainmodes.claims.estimates import mean
from grainmodes.claims.paper_b.sheared import harmonic
from grainmodes.claims.samples import Samples, at

EXACT = -12.0
"""log10 of max|J - Jᵀ| / max|J| below which it is rounding."""

ZERO = 1e-17
"""What stands for no difference at all."""


@claim("B2", unit="1")
def independent_of_smallest_step(ensemble) -> Outcome:
    """Below γ = 0.08 the stress does not depend on Δγ_Th, above it does (Fig. 2).

    Criterion: |difference| of σ for Δγ_Th = 1e-4 and 1e-8 below 1 % of σ.
    """
    raise NotAsked("shear with a second Δγ_Th: one study has one")


@claim("B5", unit="1")
def critical_strain_converges(ensemble) -> Outcome:
    """The strain γ_c of an event converges for Δγ_Th ≤ 1e-6 (App. B, Fig. 12).

    Criterion: |γ_c(Δγ_Th) - γ_c(1e-10)| ≤ 1e-6.
    """
    raise NotAsked("γ_c of one event for several Δγ_Th")


@claim("B6", unit="1")
def symmetric_jacobian(ensemble) -> Outcome:
    """At any strain the Jacobian is symmetric, and the sum of slips tangential (App. A, C 2, D 3).

    Mean over the events of log10 of max|J - Jᵀ| / max|J| of the state after. The sum of slips is
    tangential here by construction, s being a number that turns with the contact.

    Criterion: below -12.
    """
    samples = harmonic(ensemble, "event_asymmetry_after")
    parts, notes = [], []
    for point in samples.points("event_asymmetry_after"):
        by_event = np.log10(np.maximum(samples.of("event_asymmetry_after", *point), ZERO))
        seen = np.isfinite(by_event).any(axis=1)
        parts.append(Part(at(*point), mean(np.nanmean(by_event[seen], axis=1)), high=EXACT))
        notes.append(_pairs(samples, point))
    return Outcome(parts, " ".join(notes))


def _pairs(samples: Samples, point: tuple[float, float]) -> str:
    """How many states have complex pairs, after events and at the last strain."""
    sentences = []
    for states, name in (
        ("states after events", "event_complex_pairs_after"),
        ("last states", "last_complex_pairs"),
    ):
        if name in samples.ensemble:
            pairs = samples.of(name, *point)
            known = np.isfinite(pairs)
            sentences.append(f"{(pairs[known] > 0).sum()} of {known.sum()} {states}")
    return f"M⁻¹J has complex pairs in {' and '.join(sentences)} at {at(*point)}." * bool(sentences)
