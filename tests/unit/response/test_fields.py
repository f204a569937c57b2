"""Fields of a packing in theory and simulation, and its single modes, against dense spectra."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from example_packings import (
    MINIMAL,
    SHEARED,
    elastic,
    every_kt_once,
    reference,
    smoothed_coulomb,
)
from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import relaxed_steps
from grainmodes.protocols.shear.step_strain_field import simulated_field
from grainmodes.response.fields import affine_field, mode_sum_field, nearest_modes, nonaffine_field
from grainmodes.spectrum import full, packing_spectrum
from grainmodes.stages import fields
from grainmodes.stages.fields import fields_block
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block

KTS = (0.0, 1e-8, 1e-4, 1e-2, 1.0, 10.0)
HERTZ = "hertz_n64_phi0.860_seed2"


def with_rattler(packing: Packing) -> Packing:
    """The packing with a small grain more, which leans on grain 0 and is the first of all."""
    leaning = packing.position[0] + (packing.diameter[0] / 2 + 0.02) * np.array([1.0, 0.0])
    position = np.vstack([leaning, packing.position])
    return Packing.from_positions(position, np.append(0.05, packing.diameter), packing.box_length)


@pytest.mark.parametrize(("name", "kt"), every_kt_once(KTS))
def test_the_sum_over_the_modes_is_the_direct_solve(name, kt):
    packing, interaction = reference(name)[1], elastic(name, kt)
    direct, summed = nonaffine_field(packing, interaction), mode_sum_field(packing, interaction)
    size = np.nanmax(np.abs(direct))
    assert_allclose(summed[:, :2], direct[:, :2], rtol=0, atol=1e-10 * size)
    # λ of the rotational band, and with it the spins, is right to 1e-16 / kt.
    spins = max(1e-10, 1e-15 / kt) if kt else 0.0
    assert_allclose(summed[:, 2], direct[:, 2], rtol=0, atol=spins * size)


@pytest.mark.parametrize(("name", "kt"), every_kt_once(KTS))
def test_the_simulation_is_the_theory(name, kt):
    packing, interaction = reference(name)[1], elastic(name, kt)
    direct, simulated = (
        nonaffine_field(packing, interaction),
        simulated_field(packing, interaction, StepStrain()),
    )
    assert_allclose(simulated, direct, rtol=0, atol=1e-6 * np.nanmax(np.abs(direct)))


def test_the_sum_over_the_modes_has_its_vectors_at_every_size(monkeypatch):
    packing, interaction = reference(MINIMAL[0])[1], elastic("hertz", 1e-2)
    expected = mode_sum_field(packing, interaction)
    monkeypatch.setattr(full, "DENSE_MODES_UP_TO", 0)
    assert_array_equal(mode_sum_field(packing, interaction), expected)


def test_the_error_of_the_simulation_is_of_second_order():
    packing, interaction = reference(HERTZ)[1], elastic("hertz", 1e-4)
    direct = nonaffine_field(packing, interaction)
    large, small = (
        np.abs(simulated_field(packing, interaction, StepStrain(strain=strain)) - direct).max()
        for strain in (1e-5, 1e-6)
    )
    assert large / small == pytest.approx(100.0, rel=0.05)


def test_the_simulated_field_is_what_positions_say():
    packing, interaction, protocol = (
        reference(HERTZ)[1],
        elastic("hertz", 1e-2),
        StepStrain(strain=1e-5),
    )
    forward, backward = (step.packing for step in relaxed_steps(packing, interaction, protocol))
    length = packing.box_length
    moved = (forward.position - backward.position + length / 2) % length - length / 2
    nonaffine = moved / 2e-5
    nonaffine[:, 0] -= packing.position[:, 1]
    field = simulated_field(packing, interaction, protocol)
    # Of each position 1e-15 L is lost, and as γ differs, 1e-5 of what y moved.
    assert_allclose(field[:, :2], nonaffine - nonaffine.mean(axis=0), atol=1e-8)
    assert_allclose(field[:, 2], (forward.rotation - backward.rotation) / 2e-5, rtol=1e-12)


@pytest.mark.parametrize("kt", [0.0, 1e-2])
def test_fields_hold_no_translation(kt):
    packing, interaction = reference(HERTZ)[1], elastic("hertz", kt)
    for field in (
        nonaffine_field(packing, interaction),
        mode_sum_field(packing, interaction),
        simulated_field(packing, interaction, StepStrain()),
    ):
        assert np.abs(field[:, :2]).max() > 1.0
        assert_allclose(field[:, :2].mean(axis=0), 0.0, atol=1e-12)


def test_the_affine_field_is_the_motion_of_the_box():
    packing = reference(HERTZ)[1]
    moved = packing.sheared(1e-3).position - packing.position
    moved = (moved + packing.box_length / 2) % packing.box_length - packing.box_length / 2
    field = affine_field(packing)
    assert_allclose(field[:, 0] + packing.box_length / 2, moved[:, 0] / 1e-3, atol=1e-11)
    assert_array_equal(field[:, 1:], 0.0)
    assert abs(field[:, 0].mean()) < packing.box_length / 10


def test_nothing_turns_without_friction():
    packing, interaction = reference(MINIMAL[0])[1], elastic("hertz", 0.0)
    modes = nearest_modes(packing, interaction, (1.0,))
    for field in (nonaffine_field(packing, interaction), modes.eigenvector[0]):
        assert np.isnan(field[:, 2]).all()
        assert np.isfinite(field[:, :2]).all()


def test_rattlers_have_no_field_and_change_none():
    packing, interaction = reference(MINIMAL[0])[1], elastic("hertz", 1.0)
    beside = with_rattler(packing)
    for field in (
        nonaffine_field,
        mode_sum_field,
        lambda p, interaction: simulated_field(p, interaction, StepStrain()),
        lambda p, interaction: nearest_modes(p, interaction, (1.0,)).eigenvector[0],
    ):
        found = field(beside, interaction)
        assert np.isnan(found[0]).all()
        assert_allclose(found[1:], field(packing, interaction), atol=1e-8)


@pytest.mark.parametrize(("name", "kt"), list(zip([MINIMAL[0], HERTZ] * 3, KTS, strict=True)))
def test_single_modes_are_those_of_the_dense_spectrum(name, kt):
    packing, interaction = reference(name)[1], elastic(name, kt)
    frequencies = (1e-4, 1.3e-2, 0.5, 1.0)
    found, dense = (
        nearest_modes(packing, interaction, frequencies),
        packing_spectrum(packing, interaction),
    )
    elastic_ones = np.argsort(np.abs(dense.eigenvalue))[2:]
    for mode, frequency in enumerate(frequencies):
        distance = np.abs(dense.eigenvalue[elastic_ones] - frequency**2)
        nearest = elastic_ones[np.argmin(distance)]
        assert_allclose(found.frequency[mode] ** 2, dense.eigenvalue[nearest], atol=1e-14)
        vector = found.eigenvector[mode][:, : 3 if kt else 2].ravel()
        assert abs(vector @ dense.modes[:, nearest]) == pytest.approx(1.0, abs=1e-6)
        assert vector[np.argmax(np.abs(vector))] > 0.0
        assert vector @ vector == pytest.approx(1.0, abs=1e-12)
    assert found.residual.max() < 1e-11


def test_residuals_tell_what_is_no_mode(monkeypatch):
    packing, interaction = reference(MINIMAL[0])[1], elastic("hertz", 1.0)
    exact = nearest_modes(packing, interaction, (0.5,))

    def shifted(eigenproblem, shift):
        return shift, np.eye(eigenproblem.size)[0]

    monkeypatch.setattr("grainmodes.response.fields._nearest", shifted)
    assert nearest_modes(packing, interaction, (0.5,)).residual[0] > 1e8 * exact.residual[0]


def test_the_same_modes_come_every_time():
    packing, interaction = reference(HERTZ)[1], elastic("hertz", 1e-4)
    first, second = (nearest_modes(packing, interaction, (1e-2, 1.0)) for _ in range(2))
    assert_array_equal(first.eigenvector, second.eigenvector)


def test_loaded_springs_are_refused():
    data, packing = reference(SHEARED)
    interaction = Interaction.from_law(smoothed_coulomb(data))
    for field in (mode_sum_field, lambda p, interaction: nearest_modes(p, interaction, (1.0,))):
        with pytest.raises(ValueError, match="symmetric"):
            field(packing, interaction)


def test_a_relaxation_that_stops_short_is_refused():
    packing, interaction = reference(MINIMAL[0])[1], elastic("hertz", 1.0)
    with pytest.raises(ArithmeticError, match=r"step strain .* iterations"):
        simulated_field(packing, interaction, StepStrain(force_tolerance=1e-30))


LAW = ContactLaw("hertz", "elastic", 1e-2)


def packings(*members: Packing, failures=None):
    """A block of packings; `failures` of its trajectories by seed."""
    attributes = {"stage": "packings", "n": members[0].n, "phi": 0.9, "config": {}}
    rows = [
        packing_row(member, Interaction.from_law(LAW).normal) | {"converged": True}
        for member in members
    ]
    earlier = Block({}, {"failures": {"trajectories": failures or {}}})
    return compute_block(range(len(members)), rows.__getitem__, attributes, earlier)


def test_a_block_holds_the_fields_of_its_first_sample():
    packing = reference(MINIMAL[0])[1]
    block = fields_block(
        packings(packing, packing, failures={"1": "was bad"}),
        LAW,
        Rattlers(),
        StepStrain(),
    )
    assert block.variables["seed"].tolist() == [0]
    assert (block.attributes["stage"], block.attributes["kt"]) == ("fields", 1e-2)
    assert (block.attributes["failures"], block.variables["converged"].tolist()) == ({}, [1])
    interaction = Interaction.from_law(LAW)
    fields = {
        "affine_field": affine_field(packing),
        "nonaffine_field": nonaffine_field(packing, interaction),
        "nonaffine_field_mode_sum": mode_sum_field(packing, interaction),
        "nonaffine_field_simulated": simulated_field(packing, interaction, StepStrain()),
    }
    for name, field in fields.items():
        assert_allclose(block.variables[name][0], field, atol=1e-8)
    assert_array_equal(block.variables["frequency_requested"], [[0.013, 0.1, 1.0]])
    assert block.variables["eigenvector"].shape == (1, 3, 16, 3)
    assert block.variables["residual"][0] < 1e-13
    assert_array_equal(block.variables["position"][0], packing.position)


def test_all_modes_are_left_out_where_they_would_take_hours(monkeypatch):
    monkeypatch.setattr(fields, "MOST_FOR_ALL_MODES", 15)
    block = fields_block(packings(reference(MINIMAL[0])[1]), LAW, Rattlers(), StepStrain())
    assert "nonaffine_field_mode_sum" not in block.variables
    assert "nonaffine_field_simulated" in block.variables


def test_what_is_not_jammed_has_places_only():
    packing = reference(MINIMAL[0])[1]
    apart = replace(packing, box_length=2 * packing.box_length)
    assert len(apart.contacts.i) == 0
    block = fields_block(packings(apart), LAW, Rattlers(), StepStrain())
    assert (block.variables["jammed"][0], block.variables["converged"][0]) == (0, 1)
    assert "position" in block.variables and "nonaffine_field" not in block.variables


def test_a_sample_that_fails_says_why():
    step = StepStrain(force_tolerance=1e-30)
    block = fields_block(packings(reference(MINIMAL[0])[1]), LAW, Rattlers(), step)
    assert block.variables["converged"][0] == 0
    assert "step strain" in block.attributes["failures"]["fields"]["0"]
