"""Rigidity by the sparse solve: reference files, the slow mode sum, what is refused."""

import numpy as np
import pytest

import naive
from example_packings import (
    ELASTIC,
    KTS,
    LAWS,
    MINIMAL,
    SHEARED,
    contacts_and_pairs,
    elastic,
    every_kt_once,
    keeping,
    law_name,
    reference,
    smoothed_coulomb,
)
from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.pinned_factor import FloppyError, PinnedFactor
from grainmodes.packing.forces import sum_over_contacts
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.response.mode_sum import ModeRigidity, elastic_modes, mode_sum
from grainmodes.response.moduli import affine_displacement, relative_displacement, rigidity
from grainmodes.spectrum import packing_spectrum

PARTS = ("g_affine", "g_nonaffine")
MODE_SUM_KTS = (0.0, 1e-8, 1e-4, 1e-2, 1.0, 2.0, 10.0)


@pytest.mark.parametrize(("name", "kt"), every_kt_once(KTS))
def test_reference_moduli(name, kt):
    data, packing = reference(name)
    found, expected = rigidity(packing, elastic(name, kt)), data.sel(kt=kt)
    for part in PARTS:
        assert getattr(found.unloaded, part) == pytest.approx(float(expected[part]), rel=1e-8)
        loaded = float(expected[f"{part}_loaded"])
        assert getattr(found.loaded, part) == pytest.approx(loaded, rel=1e-8)


def test_sheared_reference_moduli():
    data, packing = reference(SHEARED)
    step = rigidity(packing, Interaction.from_law(smoothed_coulomb(data))).unloaded
    total = step.affine + step.nonaffine
    np.testing.assert_allclose([total[0, 1], total[1, 0]], [data.g_xy, data.g_yx], rtol=1e-8)


@pytest.mark.parametrize("kt", MODE_SUM_KTS)
@pytest.mark.parametrize("name", MINIMAL)
def test_mode_sum_is_the_direct_solve(name, kt):
    packing = reference(name)[1]
    law = ContactLaw(name.split("_")[0], "elastic", kt)
    found = rigidity(packing, Interaction.from_law(law))
    pairs = contacts_and_pairs(packing)[1]
    for loaded, moduli in ((False, found.unloaded), (True, found.loaded)):
        affine, nonaffine = naive.moduli(law, pairs, packing.n, packing.box_length, loaded)
        np.testing.assert_allclose(moduli.affine, affine, rtol=1e-9, atol=1e-11)
        np.testing.assert_allclose(moduli.nonaffine, nonaffine, rtol=1e-8, atol=1e-11)


@pytest.mark.parametrize("loaded", [False, True])
def test_mode_sum_is_the_direct_solve_with_slip(loaded):
    data, packing = reference(SHEARED)
    law = smoothed_coulomb(data)
    pairs = contacts_and_pairs(packing)[1]
    twin = naive.moduli(law, pairs, packing.n, packing.box_length, loaded)
    found = rigidity(packing, Interaction.from_law(law))
    found = found.loaded if loaded else found.unloaded
    np.testing.assert_allclose((found.affine, found.nonaffine), twin, rtol=1e-8, atol=1e-11)


@pytest.mark.parametrize("loaded", [False, True])
@pytest.mark.parametrize(("name", "kt"), every_kt_once(MODE_SUM_KTS))
def test_sum_over_the_modes_of_the_spectrum(name, kt, loaded):
    packing, interaction = reference(name)[1], elastic(name, kt)
    direct = rigidity(packing, interaction)
    direct = direct.loaded if loaded else direct.unloaded
    summed = mode_sum(packing, interaction, packing_spectrum(packing, interaction), loaded=loaded)
    np.testing.assert_array_equal(summed.affine, direct.affine)
    np.testing.assert_allclose(summed.nonaffine, direct.nonaffine, rtol=1e-8, atol=1e-11)
    # The eigenvalues of the rotational band, and with them its spins, are right to 1e-16 / kt.
    np.testing.assert_allclose(summed.displacement[:, :2], direct.displacement[:, :2], atol=1e-8)


def test_the_two_translations_are_left_out_wherever_they_stand():
    eigenvalue = np.array([-0.3, -1e-9, 1e-17, -2e-16, 1e-9, 0.2])
    assert elastic_modes(eigenvalue).tolist() == [0, 1, 4, 5]


def test_parts_add_up_and_are_those_of_sigma_xy():
    moduli = rigidity(reference(MINIMAL[0])[1], elastic("hertz", 1.0)).unloaded
    assert moduli.g == moduli.g_affine + moduli.g_nonaffine
    assert moduli.g_affine == moduli.affine[0, 1]
    assert moduli.g_nonaffine == moduli.nonaffine[0, 1]


@pytest.mark.parametrize("kt", [0.0, 1e-4, 1.0])
def test_displacement_solves_the_balance_and_does_not_drift(kt):
    packing = reference(ELASTIC[3])[1]
    interaction, contacts = elastic("hertz", kt), packing.contacts
    u = rigidity(packing, interaction).loaded.displacement
    assert u.shape == (packing.n, 3 if kt else 2)
    np.testing.assert_allclose(u[:, :2].mean(axis=0), 0.0, atol=1e-14)
    matrix = jacobian(packing, interaction)
    rate = -matrix @ u.ravel()
    sheared = affine_displacement(contacts, u.shape[1], True)
    pairs = contacts_and_pairs(packing)[1]
    twin_law = ContactLaw("hertz", "elastic", kt)
    twin = naive.net_force(twin_law, naive.affine_steps(twin_law, pairs, True), packing.n).imag
    np.testing.assert_allclose(
        rate.reshape(u.shape), -twin[:, : u.shape[1]] / naive.COMPLEX_STEP, atol=1e-11
    )
    np.testing.assert_allclose(sheared[:, 0], [p.branch[1] for p in pairs], atol=1e-14)


def test_without_friction_loading_means_nothing():
    found = rigidity(reference(MINIMAL[0])[1], elastic("hertz", 0.0))
    assert found.loaded is found.unloaded


@pytest.mark.parametrize("name", ELASTIC)
def test_weak_friction_is_continuous_with_none(name):
    packing = reference(name)[1]
    bare = rigidity(packing, elastic(name, 0.0)).unloaded
    weak = rigidity(packing, elastic(name, 1e-10)).unloaded
    assert weak.g == pytest.approx(bare.g, rel=1e-5)
    assert weak.g_affine == pytest.approx(bare.g_affine, rel=1e-12)


def test_rattlers_carry_nothing():
    packing = reference(ELASTIC[3])[1]
    hole = free_place(packing)
    position = np.vstack([packing.position, hole])
    crowded = Packing.from_positions(position, np.append(packing.diameter, 0.1), packing.box_length)
    interaction = elastic("hertz", 0.1)
    alone, beside = rigidity(packing, interaction), rigidity(crowded, interaction)
    assert beside.unloaded.g == pytest.approx(alone.unloaded.g, rel=1e-11)
    assert beside.unloaded.displacement.shape == alone.unloaded.displacement.shape


def free_place(packing: Packing) -> np.ndarray:
    """A point where a grain of diameter 0.1 touches nothing, or only its host's neighbours' air."""
    draws = np.random.default_rng(0)
    for point in draws.uniform(0, packing.box_length, (10_000, 2)):
        with_guest = np.vstack([packing.position, point])
        size = np.append(packing.diameter, 0.1)
        pairs = naive.all_pairs(with_guest, size, packing.box_length)
        if all(p.i != packing.n for p in pairs):
            return point
    raise AssertionError("no hole")


TWO_TRIANGLES = [[1.0, 1.0], [1.95, 1.0], [1.475, 1.8], [5.0, 5.0], [5.9, 5.0], [5.5, 5.8]]
TWO_PAIRS = [[1.0, 1.0], [1.95, 1.0], [5.0, 5.0], [5.9, 5.0]]


@pytest.mark.parametrize("kt", [0.0, 0.1])
@pytest.mark.parametrize("position", [TWO_TRIANGLES, TWO_PAIRS], ids=["triangles", "pairs"])
def test_a_floppy_packing_is_refused(position, kt):
    packing = Packing.from_positions(position, np.ones(len(position)), 8.5)
    with pytest.raises(FloppyError):
        rigidity(packing, elastic("hertz", kt), threshold=0)


def test_a_packing_of_rattlers_is_refused():
    pair = Packing.from_positions([[1.0, 1.0], [1.95, 1.0]], np.ones(2), 8.0)
    with pytest.raises(FloppyError):
        rigidity(pair, elastic("hertz", 0.1))


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_factor_solves_general_jacobians(law):
    packing = keeping(law, reference(SHEARED)[1])
    matrix = jacobian(packing, Interaction.from_law(law))
    wanted = np.random.default_rng(1).normal(size=(packing.n, 3))
    wanted[:, :2] -= wanted[:, :2].mean(axis=0)
    u = PinnedFactor(matrix, symmetric=False).solve(wanted)
    assert np.all(u[:2] == 0.0)
    np.testing.assert_allclose(matrix @ u, wanted.ravel(), atol=1e-9)


def test_relative_and_net_are_each_others_transpose():
    contacts = reference(MINIMAL[0])[1].contacts
    draws = np.random.default_rng(0)
    u, rate = draws.normal(size=(16, 3)), draws.normal(size=(len(contacts.i), 3))
    assert np.sum(relative_displacement(contacts, u) * rate) == pytest.approx(
        np.sum(u * sum_over_contacts(contacts, rate, 16)), rel=1e-12
    )


def test_a_sum_over_modes_that_are_not_known_is_refused():
    """Slicing gives modes below the lowest safe edge an eigenvalue 0, as at k_T/k_N = 1e-15."""
    packing, interaction = reference(MINIMAL[0])[1], elastic("hertz", 1e-15)
    by_mode = ModeRigidity(packing, interaction)
    choices = SpectrumChoices("slicing")
    found = packing_spectrum(packing, interaction, forces=by_mode.forces, choices=choices)
    with pytest.raises(ArithmeticError, match="below the lowest safe edge"):
        by_mode.contributions(found)


@pytest.mark.parametrize("kt", [1e-8, 1.0])
def test_windows_and_dense_modes_give_the_same_sum(kt):
    packing, interaction = reference(ELASTIC[3])[1], elastic("hertz", kt)
    by_mode = ModeRigidity(packing, interaction)
    sums = [
        by_mode.contributions(
            packing_spectrum(
                packing, interaction, forces=by_mode.forces, choices=SpectrumChoices(method)
            )
        ).sum()
        for method in ("dense", "slicing")
    ]
    assert sums[1] == pytest.approx(sums[0], rel=1e-9)
    exact = rigidity(packing, interaction).unloaded
    assert by_mode.g_affine + sums[1] == pytest.approx(exact.g, rel=1e-9)
