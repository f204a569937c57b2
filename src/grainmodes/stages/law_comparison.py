"""The stage `law_comparison`: every packing of a block under every tangential law, side by side.

The laws share the normal law, k_T and μ of the scene; those without slip have no use for μ. They
see the same states of strain, of which one that a law did not reach is NaN there.
"""

from __future__ import annotations

from dataclasses import asdict, replace

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ELASTIC_LAWS, TANGENTIAL_LAWS, ContactLaw
from grainmodes.parameters.law_comparison import MAX_GRAINS
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.law_comparison.comparison import Seen, Variant, variant
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import jammed_packing


def law_comparison_block(packings: Block, law: ContactLaw, choices: Shear) -> Block:
    """Pairs, rates and growth of every packing under every law."""

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, Interaction.from_law(law))
        if not jammed:
            return {"comparison_count": 0, "jammed": False, "converged": True}
        if packing.n > MAX_GRAINS:
            raise ValueError(f"expected at most {MAX_GRAINS} grains, got {packing.n}")
        return row_of(variants(packing, law, choices))

    config = {"law": asdict(law), "shear": asdict(choices)}
    return response_block(packings, "law_comparison", config, law, sample)


def variants(packing: Packing, law: ContactLaw, choices: Shear) -> dict[str, Variant]:
    """The packing under every law, by the name of its tangential part."""
    return {
        name: variant(packing, Interaction.from_law(_with(law, name)), choices)
        for name in TANGENTIAL_LAWS
    }


def _with(law: ContactLaw, tangential: str) -> ContactLaw:
    mu = None if tangential in ELASTIC_LAWS else law.friction_coefficient
    return replace(law, tangential=tangential, friction_coefficient=mu)


def row_of(found: dict[str, Variant]) -> dict[str, object]:
    """All that was seen; not converged where a law ended before the last strain."""
    longest = max(found.values(), key=lambda of: len(of.seen))
    row: dict[str, object] = {"comparison_count": len(longest.seen)}
    row["comparison_strain"] = [seen.strain for seen in longest.seen]
    for name, of in found.items():
        for number in Seen._fields[1:]:
            column = np.full(len(longest.seen), np.nan)
            column[: len(of.seen)] = [getattr(seen, number) for seen in of.seen]
            row[f"comparison_{number}_{name}"] = column
    endings = [f"{name}: {of.ending}" for name, of in found.items() if of.ending]
    row |= {"jammed": True, "converged": not endings}
    return row | ({"failure": "; ".join(endings)} if endings else {})
