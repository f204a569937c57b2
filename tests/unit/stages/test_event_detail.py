"""One event in detail: brackets, the branches that meet there, and B's Err."""

from functools import cache
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from example_packings import law_name, reference
from grainmodes.dataset.files import Block, write_block
from grainmodes.kernels.laws import Harmonic, Interaction
from grainmodes.linalg.pinned_factor import PinnedFactor
from grainmodes.packing.contacts import Contacts
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.event_states import (
    branch_distances,
    lowest_mode_of,
    nonaffine_rate,
    simulated_nonaffine_rate,
    states_around,
)
from grainmodes.protocols.shear.first_event import (
    CURVE_MARGIN,
    Bracket,
    accepted_steps,
    bracket_first_event,
    refined_steps,
    run_to_first_event,
)
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.protocols.shear.tangential_path import TangentialPath, normal_part
from grainmodes.response.stability import SMALL, lowest_mode
from grainmodes.stages.event_detail import event_detail_block
from grainmodes.stages.rows import block_of
from grainmodes.stages.samples import packed

LAWS = [ContactLaw("harmonic"), ContactLaw("harmonic", "elastic", 1.0)]
B = LAWS[1]
SMALL_STRAIN = Shear(strain=0.012)
each_law = pytest.mark.parametrize("law", LAWS, ids=law_name)


def packing_for(law: ContactLaw):
    return reference(f"{law.normal}_n64_phi0.860_seed2")[1]


@cache
def all_brackets(law: ContactLaw) -> list[Bracket]:
    """The first event at every Δγ_Th."""
    return bracket_first_event(packing_for(law), Interaction.from_law(law), SMALL_STRAIN)


def narrowest(law: ContactLaw) -> Bracket:
    """The first event at Δγ_Th = 1e-10."""
    return all_brackets(law)[-1]


@cache
def block(law: ContactLaw, strain: float = 0.012) -> Block:
    """The stage on a block of two packings."""
    row = packed(packing_for(law), Harmonic(1.0)) | {"converged": True}
    attributes = {"stage": "packings", "n": 64, "phi": 0.86}
    packings = block_of((2, 5), lambda _: row, {}, attributes)
    return event_detail_block(packings, law, Shear(strain))


def test_brackets_without_friction_lie_within_each_other():
    brackets = all_brackets(LAWS[0])
    for coarse, fine in pairwise(brackets):
        assert fine.before.strain > coarse.before.strain - 1e-13
        assert fine.after.strain < coarse.after.strain + 1e-13
    widths = [b.after.strain - b.before.strain for b in brackets]
    assert_allclose(widths, 10.0 ** -np.arange(4, 11), rtol=1e-5)
    assert {b.event.kind for b in brackets} == {2}


@each_law
def test_every_bracket_is_that_of_a_run_of_its_own(law):
    choices = refined_steps(SMALL_STRAIN)[3]
    run = QuasistaticRun.from_packing(packing_for(law), Interaction.from_law(law), choices)
    alone = run_to_first_event(run)
    shared = all_brackets(law)[3]
    for side in ("before", "after"):
        one, other = getattr(alone, side), getattr(shared, side)
        assert one.strain == pytest.approx(other.strain, rel=1e-14)
        assert one.sigma == pytest.approx(other.sigma, rel=1e-10)
    assert len(alone.curve) == len(shared.curve)


@each_law
def test_a_curve_surrounds_its_event(law):
    bracket = narrowest(law)
    strains = np.array([point.strain for point in bracket.curve])
    assert {bracket.before.strain, bracket.after.strain} <= set(strains)
    assert (np.diff(strains) > 0.0).all()
    reach = CURVE_MARGIN * 1e-4
    assert np.abs(strains - bracket.after.strain).max() < 1.01 * reach
    assert strains[0] < bracket.after.strain - 0.5 * reach
    assert strains[-1] > bracket.after.strain + 0.5 * reach


@each_law
def test_the_branches_go_on_from_both_ends(law):
    bracket, choices = narrowest(law), refined_steps(SMALL_STRAIN)[-1]
    near = states_around(bracket, choices)
    distance = np.array([n.distance for n in near])
    distances = branch_distances(choices)
    assert_allclose(distance, [-d for d in distances[::-1]] + distances)
    ends = near[6], near[7]
    assert (ends[0].state, ends[1].state) == (bracket.before, bracket.after)
    origin = np.where(distance < 0, bracket.after.strain, bracket.before.strain)
    assert_allclose([n.state.strain for n in near], origin + distance, rtol=0, atol=1e-13)
    same = [n for n in near if not n.changes]
    assert_allclose([n.slope for n in same], [n.state.g for n in same], rtol=0, atol=2e-7)


@each_law
def test_harmonic_grains_show_no_precursor(law):
    """Both come to the event in a straight line: B3, B4."""
    near = states_around(narrowest(law), refined_steps(SMALL_STRAIN)[-1])
    before = [n for n in near if n.distance < 0]
    end, rest = before[-1].state, before[:-2]
    assert all(n.changes == 0 for n in before)
    for name in ("lowest_eigenvalue", "g"):
        left = [abs(getattr(n.state, name) - getattr(end, name)) for n in rest]
        assert_allclose(np.array(left[:-1]) / left[1:], 10.0, rtol=0.02)
        assert max(left) < 0.01 * abs(getattr(end, name))


def test_a_fold_is_seen_as_one():
    """With Hertz's law and friction λ vanishes as (γ_c − γ)^(1/2), and g grows as its inverse."""
    law, choices = ContactLaw("hertz", "elastic", 1.0), Shear(0.11, 1e-3, 1e-7)
    run = QuasistaticRun.from_packing(packing_for(law), Interaction.from_law(law), choices)
    before, after = next(pair for pair in accepted_steps(run) if run.events)
    fold = Bracket(choices.min_step, before, run.curve, run.events[0], after)
    towards = [n.state for n in states_around(fold, choices) if -1e-4 < n.distance < -2e-7]
    ratios = [a.lowest_eigenvalue / b.lowest_eigenvalue for a, b in pairwise(towards)]
    assert_allclose(ratios, np.sqrt(10.0), rtol=0.1)
    assert towards[-1].g > 1.2 * towards[0].g


@each_law
@pytest.mark.parametrize("side", ["before", "after"])
def test_the_lowest_mode_is_that_of_a_dense_spectrum(law, side):
    state = getattr(narrowest(law), side)
    mode, field = lowest_mode_of(state)
    matrix, held = state.balance.matrix.toarray(), state.balance.backbone_mask
    values = np.linalg.eigvals(matrix)
    values = values[np.argsort(np.abs(values))]
    assert mode.eigenvalue == pytest.approx(values[2].real, rel=1e-9)
    assert mode.eigenvalue == pytest.approx(state.lowest_eigenvalue, rel=1e-10)
    assert mode.residual < 1e-13
    vector = field[held][:, : 3 if law.frictional else 2].ravel()
    assert np.linalg.norm(vector) == pytest.approx(1.0, rel=1e-12)
    assert np.abs(matrix @ vector - mode.eigenvalue * vector).max() < 1e-13
    assert vector[np.argmax(np.abs(vector))] > 0.0
    assert np.isnan(field[~held]).all()


def test_few_grains_have_the_same_lowest_mode(monkeypatch):
    balance = narrowest(B).after.balance
    modes = []
    for small in (SMALL, 1000):
        monkeypatch.setattr("grainmodes.response.stability.SMALL", small)
        factor = PinnedFactor(balance.matrix, symmetric=False)
        modes.append(lowest_mode(balance.matrix, factor, 3))
    assert_allclose(modes[1].vector, modes[0].vector, rtol=0, atol=1e-9)
    assert modes[1].eigenvalue == pytest.approx(modes[0].eigenvalue, rel=1e-10)


@each_law
def test_the_simulated_rate_is_that_of_linear_response(law):
    state = narrowest(law).after
    finest = refined_steps(SMALL_STRAIN)[-1]
    theory, simulation = nonaffine_rate(state), simulated_nonaffine_rate(state, finest)
    size = np.nanmax(np.abs(theory))
    assert_allclose(simulation, theory, rtol=0, atol=2e-7 * size)
    assert np.isnan(theory[:, 2]).all() == (not law.frictional)


def contact(angle: float, s: float) -> SimpleNamespace:
    """A balance of two grains whose contact stands at an angle, with its s."""
    pair = np.array([1]), np.array([0])
    normal = np.array([[np.cos(angle), np.sin(angle)]])
    contacts = Contacts(*pair, normal, np.ones(1), np.full(1, 0.1), np.array([s]))
    return SimpleNamespace(contacts=contacts, packing=SimpleNamespace(n=2, strain=angle))


def test_a_contact_that_slides_while_it_turns_has_an_error_of_half_its_turn():
    path = TangentialPath(contact(0.3, 0.0))
    for part in np.linspace(0.0, 1.0, 1001)[1:]:
        found = path.follow(contact(0.3 + 0.4 * part, 0.01 * part))
    assert found.error_largest == pytest.approx(np.sin(0.2), rel=1e-6)
    assert found.turn_median == pytest.approx(0.4, rel=1e-12)
    assert found.length_median == pytest.approx(1.0 - np.sin(0.2) / 0.2, rel=1e-4)
    assert found.error_increment < 3e-16


def test_a_contact_that_slides_back_has_an_error_of_any_size():
    path = TangentialPath(contact(0.0, 0.0))
    path.follow(contact(0.2, 0.01))
    assert path.follow(contact(0.4, 0.0)).error_largest > 0.9


def test_a_contact_that_does_not_turn_has_none():
    path = TangentialPath(contact(1.0, 0.0))
    assert path.follow(contact(1.0, 0.01)).error_largest < 3e-16
    assert path.follow(contact(1.0, 0.003)).error_largest < 3e-16
    assert len(normal_part(np.zeros((2, 2)), np.zeros((2, 2)))) == 0


def errors(step: float) -> list:
    run = QuasistaticRun.from_packing(
        packing_for(B), Interaction.from_law(B), Shear(1e-3, step, step)
    )
    path = TangentialPath(run.state.balance)
    return [path.follow(now.balance) for _, now in accepted_steps(run)]


def test_the_integral_of_tangential_velocities_is_not_tangential():
    """Against B6: Err < 3e-16 holds for every increment, not for their sum."""
    coarse, fine = errors(1e-4), errors(5e-5)
    assert max(e.error_increment for e in coarse) < 3e-16
    for one, other in zip(coarse, fine[1::2], strict=True):
        assert one.strain == pytest.approx(other.strain, rel=1e-12)
        assert one.error_median == pytest.approx(other.error_median, rel=1e-2)
        assert one.error_median == pytest.approx(one.turn_median / 2.0, rel=0.05)
        assert one.length_median < 2.0 * one.error_median**2 + 1e-12
    assert coarse[9].error_median > 1e-4


@each_law
def test_a_block_holds_the_first_sample_and_its_first_event(law):
    found = block(law).variables
    assert_array_equal(found["seed"], [2])
    assert (found["converged"][0], found["event_count"][0]) == (1, 1)
    bracket = narrowest(law)
    for side in ("before", "after"):
        strain = getattr(bracket, side).strain
        assert found[f"event_strain_{side}"][0, 0] == strain
        assert found[f"bracket_strain_{side}"][0, -1] == strain
        assert found[f"bracket_stress_{side}"][0, -1] == getattr(bracket, side).sigma
    assert_array_equal(found["event_displacement"][0, 0, :, :2], bracket.event.displacement[:, :2])
    assert np.isnan(found["rate"][0, :, 2]).all() == (not law.frictional)
    assert np.nansum(found["lowest_mode_before"] * found["lowest_mode_after"]) > 0.5
    assert found["residual"][0] < 1e-13
    assert bool(found["path_count"][0]) == law.frictional


@each_law
def test_without_an_event_there_is_nothing_to_look_at(law, tmp_path):
    found = block(law, 1e-3).variables
    assert (found["event_count"][0], found["converged"][0]) == (0, 1)
    assert not found["bracket_kind"].any() and np.isnan(found["bracket_strain_after"]).all()
    assert "near_g" not in found and "rate" not in found
    write_block(tmp_path / "event_detail.nc", block(law, 1e-3))


def test_the_same_packing_gives_the_same_bytes(tmp_path):
    write_block(tmp_path / "one", block(LAWS[0]))
    write_block(tmp_path / "two", block.__wrapped__(LAWS[0]))
    assert (tmp_path / "one").read_bytes() == (tmp_path / "two").read_bytes()
