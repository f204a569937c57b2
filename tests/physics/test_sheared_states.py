"""What is recorded of sheared states beside stress and rigidity: lost springs, lost symmetry."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse

from example_packings import reference
from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.events import count_reopened
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.protocols.shear.strain_step import step_to
from grainmodes.response.stability import asymmetry
from grainmodes.stages.shear_rows import run_row

B = ContactLaw("harmonic", "elastic", 1.0)
CHOICES = Shear(strain=1e-3, step=1e-4, min_step=1e-8)


@pytest.fixture(scope="module")
def run():
    """A sheared packing, its springs loaded."""
    run = QuasistaticRun.from_packing(
        reference("harmonic_n64_phi0.900_seed1")[1], Interaction.from_law(B), CHOICES
    )
    while not run.done and run.advance():
        pass
    return run


def test_only_springs_that_start_anew_have_reopened(run):
    before = run.state.equilibrium
    after, _ = step_to(before.packing.strain + 1e-5, before, CHOICES)
    history, loads = after.packing.history, np.abs(before.packing.history.spring_state)
    assert np.array_equal(history.i, before.packing.history.i)
    assert count_reopened(before.packing, after.packing, Interaction.from_law(B)) == 0
    for count in (1, 3):
        s = history.spring_state.copy()
        s[np.argsort(loads)[-count:]] = 0.0
        renewed = replace(after.packing, history=replace(history, spring_state=s))
        assert count_reopened(before.packing, renewed, Interaction.from_law(B)) == count


def test_loaded_springs_cost_the_jacobian_its_symmetry(run):
    """Of max|J − Jᵀ| no more than −(f_T/r) n tᵀ of all contacts of a grain."""
    equilibrium = run.state.equilibrium
    row, whole = run_row(run), equilibrium.matrix.toarray()
    contacts = equilibrium.backbone.contacts
    bent = np.abs(B.kt * contacts.springs / contacts.distance)
    difference = np.abs(whole - whole.T).max()
    assert row["last_asymmetry"] == pytest.approx(difference / np.abs(whole).max())
    assert 0.0 < difference <= 6.0 * bent.max()
    assert row["last_complex_pairs"] >= 0


def test_the_asymmetry_of_symmetric_and_empty_matrices_is_zero():
    assert asymmetry(sparse.csc_array(np.array([[2.0, 1.0], [1.0, 0.0]]))) == 0.0
    assert asymmetry(sparse.csc_array(np.array([[2.0, 1.0], [0.0, 0.0]]))) == 0.5
    assert asymmetry(sparse.csc_array((4, 4))) == 0.0
