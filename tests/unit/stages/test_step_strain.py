"""The stage `step_strain`: what it hands on to the simulation."""

import pytest

from example_packings import reference
from grainmodes.kernels.laws import Hertz
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import step_strain
from grainmodes.stages import step_strain as stage
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block


@pytest.mark.parametrize("threshold", [0, 1, 2])
def test_the_rattlers_are_those_of_the_scene(monkeypatch, threshold):
    seen = []

    def observed(packing: Packing, interaction, step, most_contacts):
        seen.append(most_contacts)
        return step_strain(packing, interaction, step, most_contacts)

    monkeypatch.setattr(stage, "step_strain", observed)
    row = packing_row(reference("hertz_n16_phi0.900_seed1")[1], Hertz(1.0)) | {"converged": True}
    packings = compute_block([1], lambda _: row, {"n": 16, "phi": 0.9, "stage": "packings"})
    found = stage.step_strain_block(packings, ContactLaw(kt=1.0), Rattlers(threshold), StepStrain())
    assert seen == [threshold]
    assert found.mapping("config")["rattlers"] == {"threshold": threshold}
