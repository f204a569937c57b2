"""J on both sides of Coulomb's threshold, released states, and laws side by side in a block."""

from dataclasses import replace

import numpy as np
import pytest

from example_packings import LAWS, SHEARED, crowd, keeping, law_name, reference, smoothed_coulomb
from grainmodes.dataset import VARIABLES
from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import forces_on_i, sliding
from grainmodes.packing.jacobian import jacobian, stiffness_of
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.packing.state import find_contacts
from grainmodes.parameters.law import TANGENTIAL_LAWS, ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.law_comparison import comparison
from grainmodes.protocols.law_comparison.comparison import Seen, Variant, variant
from grainmodes.protocols.release.simulated_growth import simulated_growth_rate
from grainmodes.protocols.shear.coulomb_threshold import (
    SLIPPING,
    STICKING,
    beside_threshold,
    fastest_mode,
    fastest_pair,
    slipping_contacts,
)
from grainmodes.relaxation.newton import apply_slip
from grainmodes.response.stability import complex_pairs
from grainmodes.stages import law_comparison
from grainmodes.stages.samples import packed

SHARP = [law for law in LAWS if law.tangential.startswith("sharp")]
C8 = ContactLaw("harmonic", "smoothed_coulomb", 0.3, 0.5)
BRIEF = Shear(strain=2e-3, step=1e-4)


def half_slipped(law: ContactLaw):
    """Contacts some of which the law has cut, and the packing."""
    return apply_slip(keeping(law, crowd(91, slip=2.5)), Interaction.from_law(law))


@pytest.mark.parametrize("law", SHARP, ids=law_name)
def test_only_springs_at_their_threshold_have_two_sides(law):
    interaction, (_, contacts) = Interaction.from_law(law), half_slipped(law)
    at = slipping_contacts(contacts, interaction)
    assert 0 < at.sum() < len(at)
    slips, sticks = (
        stiffness_of(beside_threshold(contacts, side), interaction) for side in (SLIPPING, STICKING)
    )
    apart = np.abs(slips - sticks).max(axis=(1, 2))
    assert apart[~at].max() < 1e-7 < 1e-2 < apart[at].min()
    np.testing.assert_array_equal(slips[at, 2, 2], 0.0)
    assert np.all(sticks[at, 2, 2] < 0.0)


@pytest.mark.parametrize("law", SHARP, ids=law_name)
def test_contacts_slide_whose_tangential_force_is_coulombs(law):
    interaction, (_, contacts) = Interaction.from_law(law), half_slipped(law)
    force = forces_on_i(contacts, interaction)[:, :2]
    normal, tangential = (
        np.abs(np.einsum("ca,ca->c", force, axis)) for axis in (contacts.normal, contacts.tangent)
    )
    at = tangential >= (1.0 - 1e-9) * law.friction_coefficient * normal
    assert 0 < at.sum() < len(at)
    np.testing.assert_array_equal(sliding(contacts, interaction), at)


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_forces_are_the_same_on_both_sides(law):
    interaction, (_, contacts) = Interaction.from_law(law), half_slipped(law)
    whole = forces_on_i(contacts, interaction)
    for side in (SLIPPING, STICKING):
        beside = forces_on_i(beside_threshold(contacts, side), interaction)
        np.testing.assert_allclose(beside, whole, atol=1e-8)


def unstable():
    """The sheared state of the independent code, which has pairs."""
    data, packing = reference(SHEARED)
    return packing, Interaction.from_law(smoothed_coulomb(data))


def test_pairs_are_those_of_the_whole_matrix():
    packing, interaction = unstable()
    found = fastest_pair(packing, find_contacts(packing), interaction, SLIPPING)
    assert found.pairs == complex_pairs(packing, interaction) > 0
    root = complex(found.frequency, found.growth_rate)
    assert root**2 == pytest.approx(found.eigenvalue, rel=1e-12)


def test_the_growing_mode_is_an_eigenvector():
    packing, interaction = unstable()
    contacts = find_contacts(packing)
    value = fastest_pair(packing, contacts, interaction, SLIPPING).eigenvalue
    u = fastest_mode(packing, contacts, interaction, SLIPPING)
    off = (jacobian(packing, contacts, interaction) @ u.ravel()).reshape(u.shape)
    off = off / generalized_mass(packing.mass) - value * u
    assert np.abs(u).max() == pytest.approx(1.0)
    assert np.abs(off).max() < 1e-7


def test_without_history_nothing_oscillates():
    packing, interaction = unstable()
    still = replace(packing, history=None)
    found = fastest_pair(still, find_contacts(still), interaction, SLIPPING)
    assert (found.pairs, found.growth_rate, found.frequency) == (0, 0.0, 0.0)


def test_a_released_state_grows_as_linear_theory_says():
    packing, interaction = unstable()
    found = fastest_pair(packing, find_contacts(packing), interaction, SLIPPING)
    assert simulated_growth_rate(packing, interaction, found) == pytest.approx(
        found.growth_rate, rel=2e-3
    )


def test_states_are_spread_over_the_way(monkeypatch):
    monkeypatch.setattr(comparison, "STATES", 4)
    packing = reference("harmonic_n16_phi0.900_seed1")[1]
    seen = variant(packing, Interaction.from_law(C8), BRIEF).seen
    np.testing.assert_allclose([state.strain for state in seen], [5e-4, 1e-3, 1.5e-3, 2e-3])


def test_a_way_that_ends_keeps_what_was_seen(monkeypatch):
    def step_to(strain, balance, choices):
        if strain > 1.05e-3:
            raise ArithmeticError("lost")
        return balance, False

    monkeypatch.setattr(comparison, "step_to", step_to)
    found = variant(reference("harmonic_n16_phi0.900_seed1")[1], Interaction.from_law(C8), BRIEF)
    assert (len(found.seen), found.ending) == (10, "lost")


def block_of(name: str) -> Block:
    """A block of one packing."""
    packing = reference(name)[1]
    row = packed(packing, Interaction.from_law(C8).normal) | {"converged": 1, "seed": 0}
    variables = {key: np.asarray(value)[None] for key, value in row.items()}
    return Block(variables, {"n": packing.n, "phi": 0.9})


def test_a_block_holds_every_law_side_by_side():
    block = law_comparison.law_comparison_block(block_of("harmonic_n16_phi0.900_seed1"), C8, BRIEF)
    variables = block.variables
    assert set(variables) <= set(VARIABLES)
    assert variables["converged"][0] == variables["jammed"][0] == 1
    assert variables["comparison_count"][0] == 20
    for law in TANGENTIAL_LAWS:
        pairs = variables[f"comparison_pairs_slipping_{law}"][0]
        growth = variables[f"comparison_growth_{law}"][0]
        assert np.isfinite(pairs).all()
        np.testing.assert_array_equal(np.isfinite(growth), pairs > 0)


def test_harmonic_springs_cannot_tell_what_they_remember():
    block = law_comparison.law_comparison_block(block_of("harmonic_n16_phi0.900_seed1"), C8, BRIEF)
    for kind in ("elastic", "sharp_coulomb"):
        for number in ("pairs_slipping", "pairs_sticking", "slipping"):
            one, other = (
                block.variables[f"comparison_{number}_{law}"] for law in (kind, f"{kind}_force")
            )
            np.testing.assert_array_equal(other, one)


def test_a_law_that_ended_early_is_told():
    seen = [Seen(strain, 1, 0, 2, 0.1, 0.0) for strain in (1e-3, 2e-3)]
    found = dict.fromkeys(TANGENTIAL_LAWS, Variant(seen))
    found["sharp_coulomb"] = Variant(seen[:1], "lost")
    row = law_comparison.comparison_row(found)
    assert row["failure"] == "sharp_coulomb: lost" and not row["converged"]
    np.testing.assert_array_equal(row["comparison_strain"], [1e-3, 2e-3])
    np.testing.assert_array_equal(row["comparison_rate_sharp_coulomb"], [0.1, np.nan])
    np.testing.assert_array_equal(row["comparison_rate_elastic"], [0.1, 0.1])


def test_too_many_grains_are_refused(monkeypatch):
    monkeypatch.setattr(law_comparison, "MAX_GRAINS", 10)
    block = law_comparison.law_comparison_block(block_of("harmonic_n16_phi0.900_seed1"), C8, BRIEF)
    assert block.variables["converged"][0] == 0
    assert "expected at most 10 grains, got 16" in block.attributes["failures"]["0"]
