"""Properties of every packing that a compression makes, over N, φ, seed, law and protocol."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import naive
from example_packings import elastic, few, pairs_of
from grainmodes.packing.forces import max_force_and_torque, net_force, sum_over_contacts
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing, rattlers
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.compression.trajectory import compress_to, place_at_random
from grainmodes.protocols.shear.step_strain import step_strain
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import packing_spectrum

sizes = st.sampled_from([8, 10, 12, 16, 20, 24, 30])
dense = st.floats(0.87, 0.95)
seeds = st.integers(0, 10**6)
normals = st.sampled_from(["hertz", "harmonic"])
relaxations = st.sampled_from(["fire_newton", "fire"])
frictions = st.sampled_from([0.0, 1e-8, 1e-4, 1e-2, 1.0, 2.0, 10.0])


def compressed(
    n: int, phi: float, seed: int, normal="hertz", relaxation="fire_newton", **grains
) -> Packing:
    """A packing at φ, compressed in coarse steps."""
    protocol = Compression(relaxation=relaxation, phi_step=1e-2, **grains)
    normal_law = elastic(normal, 0.0).normal
    relaxed = compress_to(place_at_random(n, seed, normal_law, protocol), phi, normal_law, protocol)
    assert relaxed.converged
    return relaxed.packing


C_GRAINS = {"large_diameter": 1.4, "masses": "equal"}
"""Paper C, Sec. IV: diameters 1.4 and 1, every mass 1."""


def backbone(packing: Packing) -> Packing:
    return packing.without(rattlers(packing, 2))


def rigid(packing: Packing) -> bool:
    """Whether there is a backbone, and it has no zero mode but the translations."""
    core = backbone(packing)
    if core.n == 0:
        return False
    size = np.abs(packing_spectrum(core, elastic("hertz", 0.0), modes=False).eigenvalue)
    return bool(np.sort(size)[2] > 1e-6)


@few(40)
@given(n=sizes, phi=st.floats(0.6, 0.95), seed=seeds, normal=normals, relaxation=relaxations)
def test_every_packing_is_in_balance_at_its_density(n, phi, seed, normal, relaxation):
    packing = compressed(n, phi, seed, normal, relaxation)
    assert packing.phi == pytest.approx(phi, rel=1e-12)
    assert np.sum(packing.diameter == 1.0) == n // 2
    np.testing.assert_array_equal(packing.mass, packing.diameter**2)
    force = naive.net_force(ContactLaw(normal), pairs_of(packing), n)
    # The positions of the slow twin are rounded to 1e-16 of the box.
    assert np.abs(force).max() < 2e-14
    interaction = elastic(normal, 0.0)
    assert max_force_and_torque(net_force(packing, interaction))[0] < 1.1e-14


@few(10)
@given(n=sizes, phi=dense, seed=seeds, normal=normals)
def test_grains_of_paper_c(n, phi, seed, normal):
    packing = compressed(n, phi, seed, normal, **C_GRAINS)
    assert sorted(packing.diameter) == [1.0] * (n // 2) + [1.4] * (n // 2)
    assert packing.phi == pytest.approx(phi, rel=1e-12)
    np.testing.assert_array_equal(packing.mass, 1.0)
    force = net_force(packing, elastic(normal, 0.0))
    assert max_force_and_torque(force)[0] < 1.1e-14


@pytest.mark.parametrize("relaxation", ["fire_newton", "fire"])
def test_harmonic_grains_know_no_length(relaxation):
    """Equal numbers place the same grains, and k_N ξ is the same force in every unit of length."""
    grains = [C_GRAINS | {"large_diameter": diameter} for diameter in (1.0, 1.4)]
    both = [compressed(24, 0.9, 3, "harmonic", relaxation, **kind) for kind in grains]
    one, other = (packing.fraction for packing in both)
    assert np.abs(other - one).max() * 2.0**-64 < 1e-9
    assert both[1].box_length == pytest.approx(1.4 * both[0].box_length, rel=1e-12)


@few(20)
@given(n=sizes, phi=st.floats(0.6, 0.7), seed=seeds)
def test_dilute_grains_carry_no_force(n, phi, seed):
    """A contact may be left whose force, ξ^(3/2), is below the tolerance of the balance."""
    overlap = compressed(n, phi, seed).contacts.overlap
    assert np.all(overlap**1.5 < 1e-14)


@few(15)
@given(n=sizes, phi=dense, seed=seeds, normal=normals)
def test_same_seed_same_bytes(n, phi, seed, normal):
    one, two = (compressed(n, phi, seed, normal) for _ in range(2))
    np.testing.assert_array_equal(one.fraction, two.fraction)
    other = compressed(n, phi, seed + 1, normal)
    assert np.any(one.fraction != other.fraction)


@few(30)
@given(n=sizes, phi=dense, seed=seeds, normal=normals, kt=frictions)
def test_mode_sum_direct_solve_and_simulation_agree(n, phi, seed, normal, kt):
    packing = compressed(n, phi, seed, normal)
    if not rigid(packing):
        return
    law, core = ContactLaw(normal, "elastic", kt), backbone(packing)
    theory = rigidity(packing, elastic(normal, kt))
    pairs = pairs_of(core)
    for moduli, loaded in ((theory.unloaded, False), (theory.loaded, True)):
        affine, nonaffine = naive.moduli(law, pairs, core.n, core.box_length, loaded)
        np.testing.assert_allclose(moduli.affine, affine, rtol=1e-8, atol=1e-10)
        np.testing.assert_allclose(moduli.nonaffine, nonaffine, rtol=1e-8, atol=1e-8)
    simulated = step_strain(packing, elastic(normal, kt), StepStrain(strain=1e-7))
    if simulated.converged and simulated.contact_changes == 0:
        scale = theory.unloaded.g_affine
        assert simulated.g == pytest.approx(theory.unloaded.g, rel=1e-5, abs=1e-5 * scale)


@few(30)
@given(n=sizes, phi=dense, seed=seeds, normal=normals, kt=frictions)
def test_spectrum_of_every_packing(n, phi, seed, normal, kt):
    packing = compressed(n, phi, seed, normal)
    interaction, core = elastic(normal, kt), backbone(packing)
    if core.n == 0:
        return
    found = packing_spectrum(packing, interaction)
    assert len(found.eigenvalue) == (3 if kt else 2) * core.n
    assert np.all(np.diff(found.eigenvalue) >= 0)
    assert found.residual < 1e-13 * max(1.0, kt)
    matrix = jacobian(core, interaction)
    assert found.eigenvalue.sum() == pytest.approx(matrix.trace(), rel=1e-12)
    # A packing is a minimum, and friction that is not loaded only stiffens it.
    assert found.eigenvalue[0] > -1e-12 * max(1.0, kt)
    if rigid(packing):
        size = np.sort(np.abs(found.eigenvalue))
        assert size[1] < 1e-13 * max(1.0, kt) < size[2]


@few(30)
@given(n=sizes, phi=dense, seed=seeds, normal=normals, kt=frictions.filter(bool))
def test_loaded_response_is_minimal_energy(n, phi, seed, normal, kt):
    """−L² g_NA = aᵀ J⁺ a ≥ 0: relaxing a loaded step gives energy away."""
    packing = compressed(n, phi, seed, normal)
    if not rigid(packing):
        return
    loaded = rigidity(packing, elastic(normal, kt)).loaded
    core = backbone(packing)
    matrix = jacobian(core, elastic(normal, kt))
    u = loaded.displacement.ravel()
    assert loaded.g_nonaffine * core.box_length**2 == pytest.approx(-u @ (matrix @ u), rel=1e-9)
    if packing_spectrum(core, elastic(normal, kt), modes=False).eigenvalue[0] > -1e-12:
        assert loaded.g_nonaffine <= 0.0


@few(20)
@given(n=sizes, phi=dense, seed=seeds, shift=st.integers(-(2**63), 2**63 - 1))
def test_response_does_not_see_the_origin_or_the_numbering(n, phi, seed, shift):
    packing = compressed(n, phi, seed)
    if not rigid(packing):
        return
    order = np.random.default_rng(seed).permutation(n)
    other = Packing(
        packing.fraction[:, order] + np.int64(shift),
        packing.diameter[order],
        packing.mass[order],
        packing.box_length,
    )
    interaction = elastic("hertz", 1e-2)
    here, there = rigidity(packing, interaction), rigidity(other, interaction)
    for way in ("unloaded", "loaded"):
        g, h = getattr(here, way).g, getattr(there, way).g
        assert g == pytest.approx(h, rel=1e-9, abs=1e-12)


def test_sum_of_forces_on_grains_is_zero_for_any_contact_force():
    packing = compressed(16, 0.9, 3)
    contacts = packing.contacts
    rate = np.random.default_rng(0).normal(size=(len(contacts.i), 3))
    np.testing.assert_allclose(
        sum_over_contacts(contacts, rate, 16)[:, :2].sum(axis=0), 0.0, atol=1e-13
    )
