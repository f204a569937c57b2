"""Errors in the printed formulas: each shown to be one, beside what the forces say instead."""

import numpy as np
import pytest

import naive
import printed_formulas
from example_packings import (
    ELASTIC,
    SHEARED,
    contacts_and_pairs,
    crowd,
    elastic,
    pairs_of,
    reference,
    smoothed_coulomb,
)
from grainmodes.kernels.fire import FireState, advance
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import stress
from grainmodes.packing.hessian import effective_hessian
from grainmodes.packing.jacobian import jacobian, stiffness_of
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.newton import newton
from grainmodes.response.moduli import Moduli, rigidity
from grainmodes.spectrum import packing_spectrum

HERTZ, HARMONIC = ELASTIC[3], ELASTIC[5]
KT = 1.0


def ours(packing: Packing, interaction) -> np.ndarray:
    """J of the package, (N, 3, N, 3)."""
    matrix = jacobian(packing, interaction).toarray()
    return matrix.reshape(packing.n, 3, packing.n, 3)


def unloaded(name: str) -> tuple[Packing, list[naive.Pair], Moduli]:
    packing = reference(name)[1]
    return packing, pairs_of(packing), rigidity(packing, elastic(name, KT)).unloaded


def response(blocks: np.ndarray, force: np.ndarray) -> np.ndarray:
    """u with J u = force, without the two modes nearest zero, without drift."""
    n = len(blocks)
    u = naive.mode_sum(blocks.reshape(3 * n, 3 * n), force.ravel(), 2).reshape(n, 3)
    u[:, :2] -= u[:, :2].mean(axis=0)
    return u


def strained(packing: Packing, interaction, strain: float) -> Packing:
    """The packing after a step strain, relaxed by the full forces."""
    relaxed = newton(packing.sheared(packing.strain + strain), interaction, 1e-15, 40)
    assert max(relaxed.max_force, relaxed.max_torque) < 1e-14
    return relaxed.packing


def simulated_displacement(packing: Packing, interaction, strain: float = 1e-6) -> np.ndarray:
    """The non-affine displacement per unit strain that a simulated step shows, (N, 3)."""
    after, before = strained(packing, interaction, strain), strained(packing, interaction, -strain)
    step = (after.fraction - before.fraction).T * 2.0**-64 * packing.box_length
    u = np.column_stack([step, after.rotation - before.rotation]) / (2 * strain)
    u[:, :2] -= u[:, :2].mean(axis=0)
    return u


def error(u: np.ndarray, truth: np.ndarray) -> float:
    return float(np.linalg.norm(u - truth) / np.linalg.norm(truth))


@pytest.mark.parametrize("name", [ELASTIC[0], ELASTIC[2], HERTZ])
def test_affine_rigidity_of_paper_a_has_the_wrong_sign(name):
    """A (40) and (46) give −g_A; (44) with J for J̃ keeps the sign of g_NA, so that (39) mixes."""
    packing, pairs, moduli = unloaded(name)
    area = packing.box_length**2
    assert moduli.g_affine > 0
    assert printed_formulas.affine_rigidity(pairs, packing.box_length) == pytest.approx(
        -moduli.g_affine
    )
    assert np.sum(height_times_xi(pairs)) / area == pytest.approx(-moduli.g_affine)
    theta = printed_formulas.theta_vector(pairs, packing.n, KT)
    assert -np.sum(theta * moduli.displacement) / area == pytest.approx(moduli.g_nonaffine)


def height_times_xi(pairs: list[naive.Pair]) -> list[float]:
    """⟨Y|Ξ⟩ of A (46), contact by contact, so that no image is met the wrong way."""
    return [p.branch[1] * printed_formulas.normal_block(p)[0] @ [p.branch[1], 0, 0] for p in pairs]


def test_affine_rigidity_of_paper_b_has_the_wrong_sign():
    """B (43) gives −g_A of the symmetrised stress, less the term that it drops."""
    packing, pairs, moduli = unloaded(HARMONIC)
    sigma = stress(packing, elastic(HARMONIC, KT))
    kept = (moduli.affine[0, 1] + moduli.affine[1, 0] - sigma[1, 1]) / 2
    found = printed_formulas.harmonic_affine_rigidity(pairs, packing.box_length)
    assert found == pytest.approx(-kept)


def test_without_slip_the_printed_jacobian_of_paper_a_is_right():
    packing = reference(HERTZ)[1]
    blocks = printed_formulas.jacobian(pairs_of(packing), packing.n, KT)
    np.testing.assert_allclose(blocks, ours(packing, elastic(HERTZ, KT)), atol=1e-12)


@pytest.mark.parametrize("name", [HERTZ, HARMONIC])
def test_jacobian_with_a_tilde_is_wrong(name):
    """A (36), (37); B (39), (40): not symmetric, not translation invariant, wrong displacements."""
    packing, _, moduli = unloaded(name)
    interaction = elastic(name, KT)
    right, wrong = ours(packing, interaction), printed_formulas.tilde(ours(packing, interaction))
    for blocks, holds in ((right, True), (wrong, False)):
        flat = blocks.reshape(3 * packing.n, -1)
        push = np.abs(blocks[:, :, :, :2].sum(axis=2)).max()
        assert (push < 1e-13) == holds
        assert (np.abs(flat - flat.T).max() < 1e-13) == holds
    truth = simulated_displacement(packing, interaction)
    assert error(moduli.displacement, truth) < 1e-4
    force = np.einsum("iajb,jb->ia", right, moduli.displacement)
    assert error(response(right, force), truth) < 1e-4
    assert error(response(wrong, force), truth) > 0.3


def test_jacobian_of_paper_b_has_the_wrong_sign_off_the_diagonal():
    """B (D29), (D32)–(D34) are those of J_ji; with them even J breaks translation invariance."""
    packing, pairs, moduli = unloaded(HARMONIC)
    right = ours(packing, elastic(HARMONIC, KT))
    wrong = printed_formulas.harmonic_jacobian(pairs, packing.n, KT)
    grains = np.arange(packing.n)
    np.testing.assert_allclose(wrong[grains, :, grains], right[grains, :, grains], atol=1e-12)
    np.testing.assert_allclose(wrong[:, :2, :, :2], right[:, :2, :, :2], atol=1e-12)
    flipped = wrong.copy()
    flipped[:, :2, :, 2] *= -1
    flipped[:, 2, :, :2] *= -1
    flipped[grains, :, grains] = right[grains, :, grains]
    np.testing.assert_allclose(flipped, right, atol=1e-12)
    assert np.abs(wrong[:, :, :, :2].sum(axis=2)).max() > 0.1
    force = np.einsum("iajb,jb->ia", right, moduli.displacement)
    assert error(response(printed_formulas.tilde(wrong), force), moduli.displacement) > 0.1


def test_tangential_force_of_paper_a_pushes_the_wrong_way():
    """A (D2) drives the slip on; its own derivative, A (D13), has the other sign."""
    law, h = ContactLaw("hertz", "elastic", KT), naive.COMPLEX_STEP
    packing = crowd(41, slip=0.4)
    for pair in contacts_and_pairs(packing)[1]:
        overlap = pair.reach - naive.length(pair.branch)
        assert printed_formulas.tangential_force(law, overlap, pair.slip) * pair.slip > 0
        assert naive.tangential_force(law, overlap, pair.slip) * pair.slip < 0
        d13 = -(overlap**0.5)
        assert printed_formulas.tangential_force(law, overlap, 1j * h).imag / h == pytest.approx(
            -d13
        )
        assert naive.tangential_force(law, overlap, 1j * h).imag / h == pytest.approx(d13)
    k = stiffness_of(packing.contacts, elastic("hertz", KT))
    assert np.all(k[:, 2, 2] < 0)


def test_slip_terms_of_paper_a_stand_in_the_wrong_rows():
    """A (F4), (F6), (F8), (F12) transpose the block of ∂f_T/∂ξ; (D12), (D13), (D23) are right.

    −∂f_T/∂ξ nᵀ belongs into the torque row, columns x and y, not into column ℓ, and −∂f_T/∂ξ t nᵀ
    into the force rows, not n tᵀ.
    """
    law, packing = ContactLaw("hertz", "elastic", KT), crowd(42, slip=0.4)
    for pair in pairs_of(packing):
        block = printed_formulas.normal_block(pair) + printed_formulas.tangential_block(pair, KT)
        n, _, r, xi = printed_formulas.parts(pair)
        by_xi = -KT * pair.slip / (2 * xi**0.5)
        f_t = naive.tangential_force(law, xi, pair.slip)
        wrong = block - naive.contact_stiffness(law, pair) * [1, 1, -1]
        t = naive.tangent(pair.branch)
        np.testing.assert_allclose(wrong[:2, 2], by_xi * n, atol=1e-12)
        np.testing.assert_allclose(wrong[2, :2], by_xi * n, atol=1e-12)
        # Besides, A leaves out the rotation of the tangent.
        transposed = by_xi * (np.outer(t, n) - np.outer(n, t))
        rotation = f_t / r * np.outer(n, t)
        np.testing.assert_allclose(wrong[:2, :2], transposed + rotation, atol=1e-12)


def test_diagonal_blocks_of_paper_a_do_not_follow_from_the_others():
    """A (F24) lacks k_T, the second term of (F30) has the wrong sign."""
    kt = 0.3
    for pair in pairs_of(crowd(43, slip=0.4)):
        n, _, _, xi = printed_formulas.parts(pair)
        term = -pair.slip / (2 * xi**0.5) * n
        off = printed_formulas.tangential_block(pair, kt)[:2, 2]
        difference = printed_formulas.tangential_diagonal(pair, kt)[:2, 2] - off
        np.testing.assert_allclose(difference, [(1 - kt) * term[0], -2 * kt * term[1]], atol=1e-13)


@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_tangent_rotates_with_the_contact(normal):
    """A (App. D, F) and B (App. D3) miss −(f_T/r) n tᵀ: B's J does not even depend on ξ_T."""
    law = ContactLaw(normal, "elastic", KT)
    packing = crowd(44, slip=0.4)
    k = stiffness_of(packing.contacts, Interaction.from_law(law))
    for pair, found in zip(pairs_of(packing), k, strict=True):
        still = naive.contact_stiffness(law, pair._replace(slip=0.0))
        n, _, r, xi = printed_formulas.parts(pair)
        f_t = naive.tangential_force(law, xi, pair.slip)
        turning = np.zeros((3, 3))
        turning[:2, :2] = -f_t / r * np.outer(n, naive.tangent(pair.branch))
        if normal == "harmonic":
            np.testing.assert_allclose(found, still + turning, atol=1e-13)
        assert np.abs(found - still).max() > 1e-4


def test_symmetrised_stress_needs_the_force_along_the_shear():
    """B (E8)–(E11), (43)–(44) drop f_y y_ij: g_yx is off by −σ_yy."""
    data, packing = reference(SHEARED)
    interaction = Interaction.from_law(smoothed_coulomb(data))
    moduli = rigidity(packing, interaction).unloaded
    g_yx = moduli.affine[1, 0] + moduli.nonaffine[1, 0]
    sigma = [
        stress(p, interaction) for p in (strained(packing, interaction, s) for s in (1e-6, -1e-6))
    ]
    simulated = ((sigma[0] - sigma[1]) / 2e-6)[1, 0]
    assert g_yx == pytest.approx(simulated, rel=1e-5)
    dropped = g_yx - stress(packing, interaction)[1, 1]
    assert dropped == pytest.approx(float(data.g_yx - data.sigma_yy), rel=1e-8)
    assert abs(dropped / simulated - 1) > 0.1


def test_imaginary_part_of_an_eigenpair():
    """C (25) reads J u_i = λ_i u_r + λ_r u_i, not + λ_r u_r."""
    data, packing = reference(SHEARED)
    interaction = Interaction.from_law(smoothed_coulomb(data))
    matrix = jacobian(packing, interaction)
    found = packing_spectrum(packing, interaction)
    pair = np.argmax(found.eigenvalue.imag)
    value, mode = found.eigenvalue[pair], found.modes[:, pair]
    assert value.imag > 1e-4
    right = value.imag * mode.real + value.real * mode.imag
    np.testing.assert_allclose(matrix @ mode.imag, right, atol=1e-13)
    wrong = value.imag * mode.real + value.real * mode.real
    assert np.abs(matrix @ mode.imag - wrong).max() > 0.01


@pytest.mark.parametrize(("name", "ratio"), [(HERTZ, 2.397), (HARMONIC, 1.0)])
def test_constant_stiffnesses_of_the_effective_hessian_are_those_of_harmonic_grains(name, ratio):
    """A (H2) with k_N and k_T to the letter is too stiff for Hertzian grains; slopes give D."""
    packing, interaction = reference(name)[1], elastic(name, KT)
    right, tangent, constant = (
        np.sqrt(np.linalg.eigvalsh(matrix.toarray())[2:])
        for matrix in (
            jacobian(packing, interaction),
            effective_hessian(packing, interaction),
            effective_hessian(packing, interaction, "printed"),
        )
    )
    np.testing.assert_allclose(tangent, right, rtol=1e-11)
    assert constant[-1] / right[-1] == pytest.approx(ratio, abs=1e-3)


def test_mixing_of_fire_in_paper_a_steers_away_from_the_force():
    """A (A7) adds χ (v̂ − F)|v|: a velocity across the force ends up against it."""
    force, velocity, mixing = np.array([0.0, 2.0]), np.array([3.0, 0.0]), 0.1
    speed = np.linalg.norm(velocity)
    printed = velocity + mixing * (velocity / speed - force) * speed
    ours = mixed(velocity, force, mixing)
    assert printed @ force < 0.0 < ours @ force
    np.testing.assert_allclose(ours, [(1 - mixing) * 3.0, mixing * speed])


def mixed(velocity: np.ndarray, force: np.ndarray, mixing: float) -> np.ndarray:
    """The velocity after the mixing of our FIRE, without any kick."""
    steer = mixing * np.linalg.norm(velocity) / np.linalg.norm(force)
    state = FireState(0.0, mixing, 1, 1.0 - mixing, steer, 0.0)
    vx, vy, fx, fy = (np.array([value]) for value in (*velocity, *force))
    x, y = np.zeros(1, np.int64), np.zeros(1, np.int64)
    advance(x, y, vx, vy, fx, fy, np.ones(1), state, 1.0, 0.0)
    return np.array([vx[0], vy[0]])
