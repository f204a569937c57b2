"""The own claim on what a tangential spring remembers: G3.

    name                                        law
    comparison_pairs_sticking_elastic           f_T = -k_T ξ^(1/2) s: keeps its displacement s
    comparison_pairs_sticking_elastic_force     df_T = -k_T ξ^(1/2) ds: keeps its force
    ..._sharp_coulomb, ..._sharp_coulomb_force  the same with sharp Coulomb friction

Both are readings of Mindlin's law. Only the first lets f_T follow a change of ξ while the contact
sticks, and gives J the entries ∂f_T/∂ξ that make it non-symmetric.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import NotTested, Outcome, claim
from grainmodes.claims.part import Part
from grainmodes.claims.samples import Samples, best_sampled, label
from grainmodes.ensemble import normal_law
from grainmodes.statistics.shares import share

if TYPE_CHECKING:
    import xarray as xr

KEEP_DISPLACEMENT = ("elastic", "sharp_coulomb")
KEEP_FORCE = ("elastic_force", "sharp_coulomb_force")

HALF = 0.5
"""Share of the samples above which a law counts as unstable."""


@claim("G3", unit="1")
def memory_of_springs_decides(ensemble: xr.Dataset) -> Outcome:
    """C's instability exists if a Hertzian contact's spring remembers its displacement, not force.

    The figure is `law_comparison`. This is the share of the samples with a complex pair in any
    state along the shear while springs at their threshold stick, under each law.

    Asked of: Hertzian grains at every point where laws are compared.

    Criterion: Pairs are born in more than one half of the samples under laws that keep the
    displacement, and in less than one half under laws that keep the force.
    """
    laws = (*KEEP_DISPLACEMENT, *KEEP_FORCE)
    samples = best_sampled(ensemble, *(_name(law) for law in laws))
    if normal_law(ensemble) != "hertz":
        raise NotTested("Hertzian grains")
    points = samples.points(_name(laws[0]))
    groups = {
        "springs that keep their displacement": [
            Part(f"{law}, {label(*p)}", share(_born(samples, law, p)), low=HALF)
            for p in points
            for law in KEEP_DISPLACEMENT
        ],
        "springs that keep their force": [
            Part(f"{law}, {label(*p)}", share(_born(samples, law, p)), high=HALF)
            for p in points
            for law in KEEP_FORCE
        ],
    }
    return Outcome(groups)


def _name(law: str) -> str:
    return f"comparison_pairs_sticking_{law}"


def _born(samples: Samples, law: str, point: tuple[float, float]) -> np.ndarray:
    """Whether a sample has a pair in any state, (S,), NaN where it was not sheared."""
    pairs = samples.values(_name(law), *point)
    known = np.isfinite(pairs).any(axis=1)
    return np.where(known, (np.nan_to_num(pairs) > 0).any(axis=1), np.nan)
