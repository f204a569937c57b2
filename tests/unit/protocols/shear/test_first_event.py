"""The first event in every bracket, the branches that meet there, its modes and rates."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose

from first_events import LAWS, SMALL_STRAIN, all_brackets, each_law, narrowest, packing_for
from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.pinned_factor import PinnedFactor
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
    refined_steps,
    run_to_first_event,
)
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.response.stability import MAX_DENSE_SIZE, lowest_mode

B = LAWS[1]


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
    matrix, held = state.equilibrium.matrix.toarray(), state.equilibrium.backbone_mask
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
    equilibrium = narrowest(B).after.equilibrium
    modes = []
    for small in (MAX_DENSE_SIZE, 1000):
        monkeypatch.setattr("grainmodes.response.stability.MAX_DENSE_SIZE", small)
        factor = PinnedFactor(equilibrium.matrix, symmetric=False)
        modes.append(lowest_mode(equilibrium.matrix, factor, 3))
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
