"""The stage of one event in detail: what a block holds, and the same bytes."""

from functools import cache

import numpy as np
from numpy.testing import assert_array_equal

from first_events import LAWS, each_law, narrowest, packing_for
from grainmodes.dataset.files import Block, write_block
from grainmodes.kernels.laws import Harmonic
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.stages.event_detail import event_detail_block
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block


@cache
def block(law: ContactLaw, strain: float = 0.012) -> Block:
    """The stage on a block of two packings."""
    row = packing_row(packing_for(law), Harmonic(1.0)) | {"converged": True}
    attributes = {"stage": "packings", "n": 64, "phi": 0.86}
    packings = compute_block((2, 5), lambda _: row, attributes)
    return event_detail_block(packings, law, Shear(strain))


@each_law
def test_a_block_holds_the_first_sample_and_its_first_event(law):
    found = block(law).variables
    assert_array_equal(found["seed"], [2])
    assert (found["converged"][0], found["event_count"][0]) == (1, 1)
    bracket = narrowest(law)
    for side in ("before", "after"):
        strain = getattr(bracket, side).strain
        assert found[f"event_strain_{side}"][0, 0] == strain
        assert found[f"bracket_strain_{side}"][0, -1] == strain
        assert found[f"bracket_stress_{side}"][0, -1] == getattr(bracket, side).sigma
    assert_array_equal(found["event_displacement"][0, 0, :, :2], bracket.event.displacement[:, :2])
    assert np.isnan(found["rate"][0, :, 2]).all() == (not law.frictional)
    assert np.nansum(found["lowest_mode_before"] * found["lowest_mode_after"]) > 0.5
    assert found["residual"][0] < 1e-13
    assert bool(found["path_count"][0]) == law.frictional


@each_law
def test_without_an_event_there_is_nothing_to_look_at(law, tmp_path):
    found = block(law, 1e-3).variables
    assert (found["event_count"][0], found["converged"][0]) == (0, 1)
    assert not found["bracket_kind"].any() and np.isnan(found["bracket_strain_after"]).all()
    assert "near_g" not in found and "rate" not in found
    write_block(tmp_path / "event_detail.nc", block(law, 1e-3))


def test_a_shear_that_ends_early_is_no_shear_without_an_event(monkeypatch):
    def end(run):
        run.failure = ArithmeticError("no balance")
        return False

    monkeypatch.setattr(QuasistaticRun, "advance", end)
    found = block.__wrapped__(LAWS[0], 1e-3)
    assert (found.variables["event_count"][0], found.variables["converged"][0]) == (0, 0)
    assert "no balance" in found.attributes["failures"]["event_detail"]["2"]


def test_the_same_packing_gives_the_same_bytes(tmp_path):
    write_block(tmp_path / "one", block(LAWS[0]))
    write_block(tmp_path / "two", block.__wrapped__(LAWS[0]))
    assert (tmp_path / "one").read_bytes() == (tmp_path / "two").read_bytes()
