"""The stage of the law comparison: every law side by side in a block."""

import numpy as np
import pytest

from example_packings import reference
from grainmodes.dataset import VARIABLES
from grainmodes.dataset.files import Block, BlockError
from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.law import TANGENTIAL_LAWS, ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.law_comparison.comparison import ComparedState, LawRun
from grainmodes.stages import law_comparison
from grainmodes.stages.packing_rows import packing_row

C8 = ContactLaw("harmonic", "smoothed_coulomb", 0.3, 0.5)
BRIEF = Shear(strain=2e-3, step=1e-4)


def block_of(name: str) -> Block:
    """A block of one packing."""
    packing = reference(name)[1]
    row = packing_row(packing, Interaction.from_law(C8).normal) | {"converged": 1, "seed": 0}
    variables = {key: np.asarray(value)[None] for key, value in row.items()}
    return Block(variables, {"n": packing.n, "phi": 0.9})


def test_a_block_holds_every_law_side_by_side():
    block = law_comparison.law_comparison_block(block_of("harmonic_n16_phi0.900_seed1"), C8, BRIEF)
    variables = block.variables
    assert set(variables) <= set(VARIABLES)
    assert variables["converged"][0] == variables["jammed"][0] == 1
    assert variables["comparison_count"][0] == 20
    for law in TANGENTIAL_LAWS:
        pairs = variables[f"comparison_pairs_slipping_{law}"][0]
        growth = variables[f"comparison_growth_{law}"][0]
        assert np.isfinite(pairs).all()
        np.testing.assert_array_equal(np.isfinite(growth), pairs > 0)


def test_harmonic_springs_cannot_tell_what_they_remember():
    block = law_comparison.law_comparison_block(block_of("harmonic_n16_phi0.900_seed1"), C8, BRIEF)
    for kind in ("elastic", "sharp_coulomb"):
        for number in ("pairs_slipping", "pairs_sticking", "slipping"):
            one, other = (
                block.variables[f"comparison_{number}_{law}"] for law in (kind, f"{kind}_force")
            )
            np.testing.assert_array_equal(other, one)


def test_a_law_that_ended_early_is_told():
    seen = [ComparedState(strain, 1, 0, 2, 0.1, 0.0) for strain in (1e-3, 2e-3)]
    found = dict.fromkeys(TANGENTIAL_LAWS, LawRun(seen))
    found["sharp_coulomb"] = LawRun(seen[:1], ArithmeticError("lost"))
    row = law_comparison.comparison_row(found)
    assert row["failures"] == "sharp_coulomb: ArithmeticError: lost" and not row["converged"]
    np.testing.assert_array_equal(row["comparison_strain"], [1e-3, 2e-3])
    np.testing.assert_array_equal(row["comparison_rate_sharp_coulomb"], [0.1, np.nan])
    np.testing.assert_array_equal(row["comparison_rate_elastic"], [0.1, 0.1])


def test_too_many_grains_are_refused(monkeypatch):
    monkeypatch.setattr(law_comparison, "MAX_GRAINS", 10)
    with pytest.raises(BlockError, match="expected at most 10 grains, got 16"):
        law_comparison.law_comparison_block(block_of("harmonic_n16_phi0.900_seed1"), C8, BRIEF)
