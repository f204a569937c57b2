"""The diagnostics of single claims; one that fails leaves the others as they are."""

import json
from dataclasses import replace

import numpy as np
import pytest

from example_packings import ELASTIC, crowd, elastic, reference
from grainmodes.cli import main
from grainmodes.dataset.files import Block, read_block, write_block
from grainmodes.kernels.damping import Dashpot, Undamped
from grainmodes.kernels.laws import Hertz
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.sheared_hessian import (
    hessian_shift_under_shear,
    spectral_shift,
)
from grainmodes.protocols.shear.step_strain import forward_rigidity
from grainmodes.relaxation.accuracy import step_orders
from grainmodes.response.mode_sum import ModeRigidity, mode_sum
from grainmodes.response.moduli import rigidity
from grainmodes.response.stability import count_complex_pairs
from grainmodes.spectrum import packing_spectrum
from grainmodes.stages import claim_diagnostics
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block

SMALL, HERTZ = "hertz_n16_phi0.900_seed1", "hertz_n64_phi0.900_seed1"
KT = 1.0


def block(*packed_packings: Packing) -> Block:
    """Hertzian packings as a block, like one of stage `packings`."""
    rows = [packing_row(p, Hertz(1.0)) | {"converged": True} for p in packed_packings]
    point = {"n": packed_packings[0].n, "phi": packed_packings[0].phi}
    return compute_block(range(len(rows)), rows.__getitem__, point | {"stage": "packings"})


def row(packing: Packing, kt: float, step: StepStrain | None = None) -> Block:
    law = ContactLaw("hertz", "elastic", kt)
    step = step or StepStrain()
    return claim_diagnostics.claim_diagnostics_block(block(packing), law, Rattlers(), step)


def loose(packing: Packing) -> Packing:
    """The packing in so large a box that nothing touches."""
    return packing.at(0.5)


@pytest.mark.parametrize("name", ELASTIC)
def test_a_forward_step_gives_the_rigidity_of_theory_but_for_its_slope(name):
    """g(Δγ) = g + g' Δγ/2, with g' from steps to both sides."""
    packing, interaction = reference(name)[1], elastic(name, KT)
    g = rigidity(packing, interaction).unloaded.g
    small, ahead, behind = (
        forward_rigidity(packing, interaction, StepStrain(strain=strain))
        for strain in (1e-6, 1e-5, -1e-5)
    )
    half_slope = (ahead - behind) / 2e-5
    assert small - g == pytest.approx(half_slope * 1e-6, rel=0.02, abs=5e-9 * g)


def test_a_forward_step_that_ends_without_balance_says_so():
    step = StepStrain(strain=1e-5, relaxation="damped", max_steps=40)
    with pytest.raises(ArithmeticError, match=r"expected .* after 40 iterations"):
        forward_rigidity(reference(SMALL)[1], elastic(SMALL, KT), step)


@pytest.mark.parametrize("name", [SMALL, HERTZ])
def test_translational_modes_give_the_rigidity_of_weak_friction(name):
    packing = reference(name)[1]
    for kt, accuracy in ((0.0, 1e-9), (1e-8, 1e-6), (1e-4, 1e-2)):
        interaction = elastic(name, kt)
        found = claim_diagnostics.translational_rigidity(packing, interaction, 2)
        assert found == pytest.approx(rigidity(packing, interaction).unloaded.g, rel=accuracy)
    strong = elastic(name, 1.0)
    g = rigidity(packing, strong).unloaded.g
    assert abs(claim_diagnostics.translational_rigidity(packing, strong, 2) / g - 1) > 1e-2


def test_two_halves_of_the_modes_add_up():
    packing, interaction = reference(SMALL)[1], elastic(SMALL, KT)
    found = packing_spectrum(packing, interaction)
    half = found.psi_rotational < 0.5
    by_mode = ModeRigidity(packing, interaction)
    shares = by_mode.contributions(packing_spectrum(packing, interaction, forces=by_mode.forces))
    whole = mode_sum(packing, interaction, found)
    assert 0 < half.sum() < len(half)
    assert shares.sum() == pytest.approx(whole.g_nonaffine, rel=1e-12)
    assert by_mode.g_affine == pytest.approx(whole.g_affine, rel=1e-14)
    translational = by_mode.g_affine + shares[half].sum()
    assert claim_diagnostics.translational_rigidity(packing, interaction, 2) == pytest.approx(
        translational, rel=1e-12
    )


@pytest.mark.parametrize("name", [SMALL, "harmonic_n64_phi0.900_seed1"])
@pytest.mark.parametrize("kt", [1e-8, 1.0])
def test_a_step_of_velocity_verlet_is_as_right_as_paper_a_says(name, kt):
    """Second order in q and first in q̇; second in both where no force depends on velocity."""
    packing, interaction = reference(name)[1], elastic(name, kt)
    orders = step_orders(packing, interaction, Dashpot(1.0))
    assert orders.position == pytest.approx(2.0, abs=0.02)
    assert orders.velocity == pytest.approx(1.0, abs=0.02)
    assert step_orders(packing, interaction, Undamped()).velocity == pytest.approx(2.0, abs=0.02)


def test_springs_at_rest_make_no_pairs_and_loaded_ones_do():
    packing, interaction = crowd(72, slip=0.8), elastic("hertz", 1.0)
    assert claim_diagnostics.pairs_at_rest(packing, interaction) > 0
    unsprung = replace(packing, history=None)
    assert claim_diagnostics.pairs_at_rest(unsprung, interaction) == 0
    assert count_complex_pairs(unsprung, interaction) == 0


def test_pairs_are_those_of_the_matrix_over_the_masses():
    packing, interaction = crowd(72, slip=0.8), elastic("hertz", 1.0)
    mass = np.repeat(packing.mass, 3) * np.tile([1.0, 1.0, 0.5], packing.n)
    matrix = jacobian(packing, interaction).toarray()
    values = np.linalg.eigvals(np.diag(1 / mass) @ matrix)
    assert count_complex_pairs(packing, interaction) == np.count_nonzero(values.imag > 1e-9) > 0
    assert count_complex_pairs(packing, interaction) != np.count_nonzero(
        np.linalg.eigvals(matrix).imag > 1e-9
    )


def test_the_row_of_a_jammed_packing():
    packing = reference(SMALL)[1]
    found = row(packing, KT)
    values = {name: array[0] for name, array in found.variables.items()}
    strains = [1e-6, 1e-5, 1e-4]
    np.testing.assert_array_equal(values["diagnostic_strain"], strains)
    steps = [forward_rigidity(packing, elastic(SMALL, KT), StepStrain(strain=x)) for x in strains]
    np.testing.assert_array_equal(values["g_forward_by_strain"], steps)
    assert values["hessian_difference"] < 1e-15 < 1.0 < values["hessian_printed_difference"]
    assert values["complex_pairs_at_rest"] == 0 and values["asymmetry_at_rest"] < 1e-15
    assert values["converged"] == 1 and found.attributes["failures"] == {}
    assert found.attributes["stage"] == "claim_diagnostics" and found.attributes["kt"] == KT


def test_without_friction_there_is_neither_verlet_nor_a_pair():
    found = row(reference(SMALL)[1], 0.0)
    absent = {"verlet_order_position", "complex_pairs_at_rest", "asymmetry_at_rest"}
    assert not absent & set(found.variables)
    g = rigidity(reference(SMALL)[1], elastic(SMALL, 0.0)).unloaded.g
    assert found.variables["g_translational"][0] == pytest.approx(g, rel=1e-9)


def test_damped_dynamics_gives_the_rigidity_of_the_theory():
    packing = reference(HERTZ)[1]
    found = row(packing, 1.0).variables
    g = rigidity(packing, elastic(HERTZ, 1.0)).unloaded.g
    assert found["g_forward_damped"][0] == pytest.approx(g, rel=1e-4)
    assert "g_forward_damped" not in row(packing, 1e-2).variables


@pytest.mark.parametrize("kt", [1e-8, 1.0])
def test_the_field_of_the_theory_is_that_of_the_simulation(kt):
    packing, interaction = reference(HERTZ)[1], elastic(HERTZ, kt)
    assert claim_diagnostics.field_difference(packing, interaction, StepStrain(), 2) < 1e-6
    large = claim_diagnostics.field_difference(packing, interaction, StepStrain(strain=1e-3), 2)
    assert large > 1e-5


def test_springs_under_shear_part_the_spectra_of_jacobian_and_hessian():
    packing, interaction = reference(HERTZ)[1], elastic(HERTZ, 1.0)
    assert spectral_shift(packing, interaction) < 1e-12
    shift = hessian_shift_under_shear(packing, interaction, claim_diagnostics.SHEAR)
    assert 1e-5 < shift < 1e-2


def test_large_packings_are_spared_dense_matrices(monkeypatch):
    monkeypatch.setattr(claim_diagnostics, "MAX_DENSE_GRAINS", 8)
    monkeypatch.setattr(claim_diagnostics, "MAX_PAIR_GRAINS", 8)
    found = row(reference(SMALL)[1], KT).variables
    assert "g_translational" not in found and "complex_pairs_at_rest" not in found
    assert found["verlet_order_position"][0] > 1.9


def test_an_unjammed_packing_has_no_rigidity():
    found = row(loose(reference(SMALL)[1]), KT).variables
    np.testing.assert_array_equal(found["g_forward_by_strain"], [[0.0, 0.0, 0.0]])
    for name in ("g_translational", "complex_pairs_at_rest"):
        assert found[name][0] == 0.0
    assert "hessian_difference" not in found and found["converged"][0] == 1


def test_a_diagnostic_that_fails_leaves_its_sentence_and_the_others(monkeypatch):
    def hopeless(*arguments):
        raise ArithmeticError("it did not end")

    monkeypatch.setattr(claim_diagnostics, "step_orders", hopeless)
    short = StepStrain(relaxation="damped", max_steps=40)
    found = row(reference(SMALL)[1], KT, short)
    sentence = found.attributes["failures"]["claim_diagnostics"]["0"]
    assert sentence.count("forward_rigidity: step strain") == 4
    assert sentence.count("hopeless: it did not end") == 1
    for name in ("g_forward_by_strain", "verlet_order_position", "verlet_order_velocity"):
        assert np.isnan(found.variables[name]).all()
    assert found.variables["g_translational"][0] > 0 and found.variables["converged"][0] == 1


def test_the_command_writes_what_the_function_finds(tmp_path):
    packings = block(reference(SMALL)[1])
    write_block(tmp_path / "packings.nc", packings)
    words = ["claim-diagnostics", str(tmp_path / "packings.nc"), "--kt", str(KT)]
    rattlers = json.dumps({"protocol": {"rattlers": {"threshold": 1}}})
    assert main([*words, "--settings", rattlers, "-o", str(tmp_path / "diagnostics.nc")]) == 0
    written = read_block(tmp_path / "diagnostics.nc")
    assert json.loads(written.attributes["config"])["rattlers"]["threshold"] == 1
    found = row(reference(SMALL)[1], KT).variables
    for name in found:
        np.testing.assert_array_equal(written.variables[name], found[name])
