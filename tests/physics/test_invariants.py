"""What no choice of coordinates, numbering or k_T may change."""

from dataclasses import replace

import numpy as np
import pytest

from example_packings import (
    ELASTIC,
    KTS,
    LAWS,
    SHEARED,
    crowd,
    elastic,
    every_kt_once,
    law_name,
    reference,
    smoothed_coulomb,
)
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import net_force, stress
from grainmodes.packing.state import Packing
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import packing_spectrum


@pytest.mark.parametrize(("name", "kt"), every_kt_once(KTS))
def test_exactly_two_zero_modes(name, kt):
    packing = reference(name)[1]
    found = packing_spectrum(packing, elastic(name, kt))
    size, zero = np.abs(found.eigenvalue), np.argsort(np.abs(found.eigenvalue))[:2]
    assert size[zero].max() < 1e-14 * max(1.0, size.max())
    assert np.sort(size)[2] > 1e-3 * min(kt, 1.0)
    assert found.psi_rotational[zero].max() < 1e-6
    moved = found.modes[:, zero].reshape(packing.n, 3, 2)[:, :2]
    assert np.ptp(moved, axis=0).max() < 1e-6


@pytest.mark.parametrize("name", ELASTIC)
def test_vanishing_friction_leaves_n_rotations(name):
    packing, kt = reference(name)[1], 1e-10
    weak, bare = (
        packing_spectrum(packing, elastic(name, kt)),
        packing_spectrum(packing, elastic(name, 0.0)),
    )
    rotations = weak.psi_rotational > 0.99
    assert rotations.sum() == packing.n
    assert np.abs(weak.eigenvalue[rotations]).max() < 100 * kt
    assert np.all(weak.psi_rotational[~rotations] < 1e-5)
    np.testing.assert_allclose(weak.eigenvalue[~rotations], bare.eigenvalue, atol=1e-8)


@pytest.mark.parametrize("kt", [1e-8, 1e-2, 1.0])
def test_fractions_of_every_mode_add_up(kt):
    packing = reference(ELASTIC[4])[1]
    found = packing_spectrum(packing, elastic("harmonic", kt))
    translation = np.sum(found.modes.reshape(packing.n, 3, -1)[:, :2] ** 2, axis=(0, 1))
    np.testing.assert_allclose(translation + found.psi_rotational, 1.0, atol=1e-12)
    assert found.psi_rotational.sum() == pytest.approx(packing.n, abs=1e-9)
    assert np.all((found.psi_rotational >= 0) & (found.psi_rotational <= 1 + 1e-12))
    p = found.participation_ratio
    assert np.all((p >= 1 / packing.n - 1e-12) & (p <= 1 + 1e-12))


@pytest.mark.parametrize(("name", "kt"), every_kt_once(KTS))
def test_relaxing_a_loaded_step_only_softens(name, kt):
    found = rigidity(reference(name)[1], elastic(name, kt))
    assert found.loaded.g_nonaffine <= 0.0
    assert found.loaded.g <= found.loaded.g_affine


@pytest.mark.parametrize("name", ELASTIC)
def test_friction_only_stiffens_a_loaded_step(name):
    """The loaded g is a minimum over u of an energy that grows with k_T for every u."""
    packing = reference(name)[1]
    loaded = [rigidity(packing, elastic(name, kt)).loaded.g for kt in (0.0, *KTS)]
    assert np.all(np.diff(loaded) >= -1e-12)


@pytest.mark.parametrize("name", ELASTIC)
def test_no_friction_loaded_or_not_only_softens(name):
    assert rigidity(reference(name)[1], elastic(name, 0.0)).unloaded.g_nonaffine <= 0.0


def everything(packing: Packing, interaction) -> dict[str, np.ndarray]:
    """All that a block would hold of a packing."""
    contacts, moduli, modes = (
        packing.contacts,
        rigidity(packing, interaction),
        packing_spectrum(packing, interaction),
    )
    return {
        "stress": stress(packing, interaction),
        "overlap": np.sort(contacts.overlap),
        "eigenvalue": modes.eigenvalue,
        "unloaded": moduli.unloaded.affine + moduli.unloaded.nonaffine,
        "loaded": moduli.loaded.affine + moduli.loaded.nonaffine,
        "affine": moduli.loaded.affine,
    }


def same(left: dict, right: dict, names=None) -> None:
    for name in names or left:
        np.testing.assert_allclose(left[name], right[name], rtol=1e-8, atol=1e-11, err_msg=name)


def slipped() -> tuple[Packing, object]:
    data, packing = reference(SHEARED)
    return packing, Interaction.from_law(smoothed_coulomb(data))


def packings_and_laws() -> list:
    still = [
        pytest.param(reference(name)[1], elastic(name, kt), id=f"{name[:12]}-{kt:g}")
        for name in ELASTIC[1:3]
        for kt in (0.0, 2.0)
    ]
    return [*still, pytest.param(*slipped(), id="slipped")]


def rearranged(packing: Packing, order: np.ndarray) -> Packing:
    """Grain k is now the grain order[k]; the springs go with their contacts."""
    h, history = packing.history, None
    if h is not None:
        rank = np.argsort(order)
        i, j = np.maximum(rank[h.i], rank[h.j]), np.minimum(rank[h.i], rank[h.j])
        sort = np.lexsort((j, i))
        history = History(i[sort], j[sort], h.spring_state[sort])
    return replace(
        packing,
        fraction=np.ascontiguousarray(packing.fraction[:, order]),
        diameter=packing.diameter[order],
        mass=packing.mass[order],
        history=history,
    )


@pytest.mark.parametrize(("packing", "interaction"), packings_and_laws())
def test_order_of_the_grains_does_not_matter(packing, interaction):
    order = np.random.default_rng(0).permutation(packing.n)
    same(everything(packing, interaction), everything(rearranged(packing, order), interaction))


@pytest.mark.parametrize(("packing", "interaction"), packings_and_laws())
def test_origin_does_not_matter(packing, interaction):
    offset = np.array([[2**62 + 12345], [-(2**63)]], dtype=np.int64)
    same(
        everything(packing, interaction),
        everything(replace(packing, fraction=packing.fraction + offset), interaction),
    )


@pytest.mark.parametrize(("packing", "interaction"), packings_and_laws())
def test_half_a_turn_changes_nothing(packing, interaction):
    same(
        everything(packing, interaction),
        everything(replace(packing, fraction=-packing.fraction), interaction),
    )


def mirrored(packing: Packing) -> Packing:
    """x → −x: the strain changes sign, and so does the sense of every slip."""
    h = packing.history
    history = None if h is None else replace(h, spring_state=-h.spring_state)
    fraction = packing.fraction * np.array([[-1], [1]])
    return replace(packing, fraction=fraction, strain=-packing.strain, history=history)


@pytest.mark.parametrize(("packing", "interaction"), packings_and_laws())
def test_a_mirror_changes_no_modulus(packing, interaction):
    left, right = everything(packing, interaction), everything(mirrored(packing), interaction)
    same(left, right, ["overlap", "eigenvalue"])
    for name in ("unloaded", "loaded", "affine"):
        np.testing.assert_allclose(np.diag(right[name][::-1]), np.diag(left[name][::-1]), rtol=1e-8)
        np.testing.assert_allclose(
            np.diag(right[name]), -np.diag(left[name]), rtol=1e-7, atol=1e-11
        )


def quarter_turn(packing: Packing) -> Packing:
    """(x, y) → (−y, x), of a box without shear."""
    return replace(packing, fraction=np.stack([-packing.fraction[1], packing.fraction[0]]))


@pytest.mark.parametrize("kt", [0.0, 1e-2, 2.0])
@pytest.mark.parametrize("name", ELASTIC[1:3])
def test_a_quarter_turn_keeps_the_modes_and_turns_the_stress(name, kt):
    packing, interaction = reference(name)[1], elastic(name, kt)
    left, right = everything(packing, interaction), everything(quarter_turn(packing), interaction)
    same(left, right, ["overlap", "eigenvalue"])
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    np.testing.assert_allclose(right["stress"], turn @ left["stress"] @ turn.T, atol=1e-13)


@pytest.mark.parametrize("name", ELASTIC)
def test_shear_along_y_is_shear_along_x_and_a_rotation(name):
    """Without friction dσ_xy/d(∂u_y/∂x) = g + σ_xx − σ_yy, which a quarter turn measures."""
    packing, interaction = reference(name)[1], elastic(name, 0.0)
    sigma = stress(packing, interaction)
    here, there = (rigidity(p, interaction).unloaded.g for p in (packing, quarter_turn(packing)))
    assert there == pytest.approx(here + sigma[0, 0] - sigma[1, 1], rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_one_row_of_the_box_higher_is_one_shear_to_the_side(law):
    """The box at γ = 1/2 is that at γ = −1/2, and both hold the same forces."""
    packing = crowd(51, strain=0.5, slip=0.5)
    position = packing.position
    other = Packing.from_positions(
        position, packing.diameter, packing.box_length, -0.5, packing.mass, packing.history
    )
    forces = [net_force(p, Interaction.from_law(law)) for p in (packing, other)]
    np.testing.assert_allclose(forces[0], forces[1], atol=1e-13)
