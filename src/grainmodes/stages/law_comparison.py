"""The stage `law_comparison`: every packing of a block under every tangential law, side by side.

The laws share the normal law, k_T and μ of the scene; those without slip do not use μ. All of them
are compared at the same strains; what a law did not reach is NaN.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace

import numpy as np

from grainmodes.dataset.files import Block, BlockError
from grainmodes.dataset.padding import stack_padded
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ELASTIC_LAWS, TANGENTIAL_LAWS, ContactLaw
from grainmodes.parameters.law_comparison import MAX_GRAINS
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.law_comparison.comparison import ComparedState, LawRun, shear_under_law
from grainmodes.stages.rows import loss, response_block
from grainmodes.stages.samples import jammed_packing


def law_comparison_block(packings: Block, law: ContactLaw, choices: Shear) -> Block:
    """Numbers of pairs and growth rates of every packing under every tangential law."""

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, Interaction.from_law(law))
        if not jammed:
            return {"comparison_count": 0, "jammed": False, "converged": True}
        if packing.history is not None:
            raise BlockError("comparison of laws: expected springs at rest, got loaded ones")
        if packing.n > MAX_GRAINS:
            raise BlockError(f"expected at most {MAX_GRAINS} grains, got {packing.n}")
        return comparison_row(shear_under_all_laws(packing, law, choices))

    config = {"law": asdict(law), "shear": asdict(choices)}
    return response_block(packings, "law_comparison", config, law, sample)


def shear_under_all_laws(packing: Packing, law: ContactLaw, choices: Shear) -> dict[str, LawRun]:
    """Shear a packing under every tangential law; the result by the name of the law."""
    found = {}
    for name in TANGENTIAL_LAWS:
        friction = None if name in ELASTIC_LAWS else law.friction_coefficient
        other = replace(law, tangential=name, friction_coefficient=friction)
        found[name] = shear_under_law(packing, Interaction.from_law(other), choices)
    return found


def comparison_row(runs: Mapping[str, LawRun]) -> dict[str, object]:
    """Everything recorded under every law; not converged where one ended before the last strain."""
    longest = max((run.states for run in runs.values()), key=len)
    row: dict[str, object] = {"comparison_count": len(longest)}
    row["comparison_strain"] = [state.strain for state in longest]
    columns = {
        quantity: stack_padded(
            [[getattr(state, quantity) for state in run.states] for run in runs.values()],
            np.nan,
            float,
        )
        for quantity in ComparedState._fields[1:]
    }
    for place, name in enumerate(runs):
        for quantity, column in columns.items():
            row[f"comparison_{quantity}_{name}"] = column[place]
    lost = loss({name: run.failure for name, run in runs.items()})
    return row | {"jammed": True, "converged": not lost} | lost
