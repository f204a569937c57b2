"""Compression with friction: force balance, springs, resumption, and what it must survive."""

from dataclasses import replace

import numpy as np
import pytest

import naive
from example_packings import pairs_of
from grainmodes.dataset.files import Block, BlockError, read_block, write_block
from grainmodes.packing.contact_count import may_be_rigid
from grainmodes.packing.forces import mean_contact_force
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import rattlers
from grainmodes.parameters.compression import Compression, FrictionalCompression
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.strain import Shear, StepStrain
from grainmodes.protocols.compression.frictional_trajectory import FrictionalPress, compress_to
from grainmodes.protocols.compression.trajectory import place_at_random
from grainmodes.relaxation.result import RelaxationResult
from grainmodes.response.stability import asymmetry
from grainmodes.stages.frictional_compression import (
    frictional_compress_block,
    frictional_packing_block,
)
from grainmodes.stages.law_comparison import law_comparison_block
from grainmodes.stages.rigidity import rigidity_block
from grainmodes.stages.samples import jammed_packing
from grainmodes.stages.shear import shear_block
from grainmodes.stages.step_strain import step_strain_block

COARSE = Compression(phi_step=0.01)
HARMONIC = ContactLaw("harmonic", "elastic", 1.0)
COULOMB = ContactLaw("hertz", "smoothed_coulomb", 1.0, 0.5)


def press_of(law: ContactLaw, **choices) -> FrictionalPress:
    return FrictionalPress(law, COARSE, FrictionalCompression(**choices))


def compressed(law: ContactLaw, n: int = 16, phi: float = 0.9, seed: int = 0) -> RelaxationResult:
    press = press_of(law)
    start = place_at_random(n, seed, press.interaction.normal, COARSE)
    return compress_to(start, phi, press)


def packings(law: ContactLaw, phi: float = 0.9, n: int = 16) -> Block:
    """Two samples by way of the checkpoint at 0.80."""
    choices = (law, COARSE, FrictionalCompression())
    start = frictional_compress_block(n, range(2), 0.8, *choices, None)
    return frictional_packing_block(start, phi, *choices)


@pytest.mark.parametrize(
    "law",
    [
        HARMONIC,
        ContactLaw("hertz", "elastic", 0.1),
        ContactLaw("harmonic", "elastic_force", 1.0),
        COULOMB,
        ContactLaw("harmonic", "sharp_coulomb", 1.0, 0.3),
    ],
    ids=lambda law: f"{law.normal}-{law.tangential}",
)
def test_the_balance_is_that_of_the_slow_twin_and_springs_are_loaded(law):
    found = compressed(law)
    packing = found.packing
    assert found.converged and packing.phi == pytest.approx(0.9, rel=1e-12)
    assert max(found.max_force, found.max_torque) < 1e-14
    # The positions of the slow twin are rounded to 1e-16 of the box.
    assert np.abs(naive.net_force(law, pairs_of(packing), packing.n)).max() < 3e-14
    assert np.abs(packing.contacts.springs).max() > 1e-4
    assert may_be_rigid(packing)
    backbone = packing.without(rattlers(packing, 1))
    assert asymmetry(jacobian(backbone, press_of(law).interaction)) > 1e-5


@pytest.mark.parametrize("kt", [1e-8, 1e-4, 10.0, 1000.0])
@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_weak_and_stiff_springs(normal, kt):
    found = compressed(ContactLaw(normal, "elastic", kt), phi=0.92)
    assert max(found.max_force, found.max_torque) < 1e-14
    assert mean_contact_force(found.packing, press_of(replace(HARMONIC, kt=kt)).interaction) > 1e-3


@pytest.mark.parametrize("n", [8, 10, 14])
def test_few_grains(n):
    for seed in range(4):
        found = compressed(HARMONIC, n, 0.85, seed)
        if may_be_rigid(found.packing):
            assert max(found.max_force, found.max_torque) < 1e-14


def test_friction_matters_for_where_the_grains_lie():
    """A law that never loads its springs would pass every test of balance."""
    one, other = (compressed(replace(HARMONIC, kt=kt)).packing for kt in (1.0, 1e-8))
    assert np.abs(one.fraction - other.fraction).max() * 2.0**-64 > 1e-4


def test_a_branch_does_not_depend_on_the_checkpoints_it_came_through(tmp_path):
    """In one go, and through files at 0.80 and 0.81, a packing has the same bytes."""
    choices = (HARMONIC, COARSE, FrictionalCompression())
    first = frictional_compress_block(16, range(1), 0.8, *choices, None)
    write_block(tmp_path / "first.nc", first)
    second = frictional_compress_block(
        16, range(1), 0.81, *choices, read_block(tmp_path / "first.nc")
    )
    write_block(tmp_path / "second.nc", second)
    row = frictional_packing_block(read_block(tmp_path / "second.nc"), 0.815, *choices).variables
    unbroken = compressed(HARMONIC, phi=0.815).packing
    np.testing.assert_array_equal(row["fraction"][0].T, unbroken.fraction)
    np.testing.assert_array_equal(row["spring_state"][0], unbroken.contacts.springs)


def test_a_checkpoint_of_another_friction_is_refused():
    choices = (COARSE, FrictionalCompression())
    start = frictional_compress_block(16, range(1), 0.8, HARMONIC, *choices, None)
    with pytest.raises(BlockError, match=r"expected kt = 0.5, got 1.0"):
        frictional_packing_block(start, 0.9, replace(HARMONIC, kt=0.5), *choices)
    other = FrictionalCompression(drag=2.0)
    with pytest.raises(BlockError, match=r"expected drag = 2.0, got 1.0"):
        frictional_packing_block(start, 0.9, HARMONIC, COARSE, other)


def test_without_friction_there_is_nothing_to_compress_with():
    with pytest.raises(ValueError, match=r"expected kt above 0, got 0.0"):
        _ = press_of(ContactLaw("hertz")).interaction


def test_a_dilute_packing_is_not_jammed():
    law = replace(HARMONIC, kt=1e-6)
    block = packings(law, 0.8, n=64)
    assert not block.variables["jammed"].any() and block.variables["converged"].all()
    packing, jammed = jammed_packing(block, 0, press_of(law).interaction)
    assert not jammed and packing.n == 64
    assert (rigidity_block(block, law, Rattlers()).variables["g"] == 0.0).all()


def test_a_step_that_is_cut_off_says_so():
    press = press_of(HARMONIC, max_steps=20)
    packing = compressed(HARMONIC).packing.at(0.91)
    cut = press.relax_step(packing)
    assert not cut.converged and cut.iterations == 20
    whole = press_of(HARMONIC).relax_step(packing)
    left = max(whole.max_force, whole.max_torque)
    assert whole.converged and left < 1e-2 * mean_contact_force(whole.packing, press.interaction)


def test_theory_is_simulation_although_grains_with_two_contacts_carry_load():
    """Z_Th = 2 of the scene would remove grains that friction holds."""
    block = packings(HARMONIC, 0.8, n=24)
    theory = rigidity_block(block, HARMONIC, Rattlers(2))
    simulation = step_strain_block(block, HARMONIC, Rattlers(), StepStrain())
    assert theory.attributes["failures"] == {} == simulation.attributes["failures"]
    made = [jammed_packing(block, number, press_of(HARMONIC).interaction)[0] for number in (0, 1)]
    assert any(np.any(rattlers(p, 2) & ~rattlers(p, 1)) for p in made)
    np.testing.assert_allclose(
        simulation.variables["g_simulated"], theory.variables["g"], rtol=1e-5, atol=1e-8
    )


def test_the_stages_know_under_which_law_the_packings_were_made():
    block = packings(HARMONIC)
    with pytest.raises(BlockError, match=r"kt: expected 1.0, with which these samples were made"):
        rigidity_block(block, replace(HARMONIC, kt=0.5), Rattlers())


def test_a_shear_starts_from_the_loaded_springs():
    block = packings(HARMONIC)
    sheared = shear_block(block, HARMONIC, Shear(strain=2e-4, min_step=1e-6)).variables
    theory = rigidity_block(block, HARMONIC, Rattlers()).variables["g"]
    assert sheared["curve_g_xy"][0, 0] == pytest.approx(theory[0], rel=1e-9)
    assert sheared["last_asymmetry"][0] > 1e-5


def test_laws_cannot_be_compared_where_one_of_them_made_the_packing():
    block = packings(COULOMB)
    with pytest.raises(BlockError, match="springs at rest"):
        law_comparison_block(block, COULOMB, Shear(strain=1e-4))
