"""Curves of sheared samples as they are drawn, against the numbers they were made from."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure
from numpy.testing import assert_allclose

import claim_fixtures_shear
import synthetic
from grainmodes.ensemble import open_ensemble
from grainmodes.ensemble.curves import curves, points_with_curves
from grainmodes.figures.paper_b import (
    rigidity_mean,
    rigidity_strain,
    stress_brackets,
    stress_drop,
    stress_strain,
)
from grainmodes.figures.shared.appearance import RED
from grainmodes.figures.shared.selection import Options


@pytest.fixture(scope="module")
def sheared(tmp_path_factory):
    """Three samples each of two points, one of them not jammed."""
    stages = ("packings", "shear")
    folder = tmp_path_factory.mktemp("sheared")
    path = synthetic.ensemble(folder, phis=(0.83, 0.9), kts=(1e-4, 1.0), seeds=3, stages=stages)
    with open_ensemble(path) as dataset:
        yield dataset


def test_a_curve_knows_what_happened_in_its_steps(sheared):
    assert points_with_curves(sheared) == [(16, 0.9, 1e-4), (16, 0.9, 1.0)]
    by_seed = curves(sheared, 16, 0.9, 1.0)
    assert sorted(by_seed) == [0, 1, 2]
    curve = by_seed[1]
    assert len(curve.strain) == 13
    assert curve.strain[:-1][curve.event] == 4.01e-3
    assert curve.strain[:-1][curve.changed] == 8e-3
    assert curve.quiet.sum() == 10
    assert_allclose(curve.deviation, np.where(curve.event, -1e-3, 0.0), atol=1e-15)
    (approach,) = curve.approaches
    assert_allclose(curve.strain[approach.states], [2e-3, 3e-3, 4e-3, 4.01e-3])


def test_a_failed_sample_has_no_curve(sheared):
    failed = sheared.assign(converged=sheared["converged"].where(sheared["seed"] != 1, 0))
    assert sorted(curves(failed, 16, 0.9, 1.0)) == [0, 2]


def test_an_approach_begins_after_the_last_change():
    curve = curves(claim_fixtures_shear.ensemble(), claim_fixtures_shear.N, 0.9, 1.0)[0]
    for first, last in curve.approaches:
        assert curve.event[last]
        assert curve.quiet[first:last].all()
        assert curve.strain[last] - curve.strain[first] <= 2.5 * curve.longest_step


def test_slopes_leave_events_out(sheared):
    curve = curves(sheared, 16, 0.9, 1.0)[0]
    edges = np.array([0.0, 5e-3, 1.1e-2, 2e-2])
    assert_allclose(curve.mean_slopes(curve.stress_change, edges), [0.3, 0.3, np.nan])
    assert_allclose(curve.mean_slopes(curve.predicted_change, edges), [0.3, 0.3, np.nan])


def test_stress_of_theory_is_that_of_the_state_before(sheared):
    table = stress_strain.table(sheared, Options(seed=2, kt=(1e-4,)))
    assert set(table["seed"]) == {2}
    assert set(table["kt"]) == {1e-4}
    assert table["event"].sum() == 1
    fallen = table[table["event"] == 1].iloc[0]
    assert fallen["stress_theory"] - fallen["stress"] == pytest.approx(1e-3)
    others = table[table["event"] == 0].iloc[1:]
    assert_allclose(others["stress_theory"], others["stress"], rtol=1e-12)


def test_slope_of_the_stress_is_left_out_in_events(sheared):
    table = rigidity_strain.table(sheared, Options())
    assert table["strain"].max() == pytest.approx(5e-3)
    assert_allclose(table["rigidity_simulated"].dropna(), 0.3)
    assert table.loc[table["event"] == 1, "rigidity_simulated"].isna().all()
    assert_allclose(table["lowest_eigenvalue"].iloc[[0, -1]], [0.2, 0.15])


def crowd(event: int) -> pd.DataFrame:
    """200 states of one sample in steps of 1e-4, with an event in the step after state 150."""
    state = np.arange(200)
    point = {"n": 64, "phi": 0.9, "kt": 1.0, "seed": 0, "law": "harmonic"}
    after = (state > 150) * event
    columns = {"rigidity": 0.3 - 0.1 * after, "lowest_eigenvalue": 0.2 - 0.1 * after}
    columns |= {"rigidity_simulated": 0.3, "event": (state == 150) * event}
    return pd.DataFrame(point | {"strain": 1e-4 * state} | columns)


def test_symbols_do_not_merge_and_every_state_around_an_event_is_shown():
    figure = Figure()
    rigidity_strain.draw(figure, crowd(event=1))
    assert len(figure.axes) == 4
    whole, close_up = figure.axes[:2]
    line, symbols, dots = whole.lines[:3]
    assert (len(line.get_xdata()), len(symbols.get_xdata())) == (200, 40)
    assert_allclose(symbols.get_xdata(), dots.get_xdata())
    assert_allclose(close_up.lines[1].get_xdata(), 1e-4 * np.arange(145, 156))
    bars = [bar.get_xdata()[0] for bar in close_up.lines if bar.get_color() == RED]
    assert bars == pytest.approx([0.015])
    quiet = Figure()
    rigidity_strain.draw(quiet, crowd(event=0))
    assert len(quiet.axes) == 2


def test_a_few_known_eigenvalues_are_all_shown():
    table = crowd(event=1)
    known = table.index.isin([149, 150, 151])
    table["lowest_eigenvalue"] = table["lowest_eigenvalue"].where(known)
    figure = Figure()
    rigidity_strain.draw(figure, table)
    assert_allclose(figure.axes[2].lines[1].get_xdata(), [0.0149, 0.015, 0.0151])


def test_mean_rigidity_is_that_of_theory_where_nothing_is_missing(sheared):
    table = rigidity_mean.table(sheared, Options())
    means = table.pivot(index="strain", columns="kind", values="rigidity")
    assert_allclose(means["simulation"], means["theory"])
    assert set(table["samples"]) == {3}


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (Options(seed=9), "seed: expected one of 0, 1, 2 in this ensemble, got 9"),
        (Options(phi=0.83), r"phi: expected one of 0\.9 in this ensemble, got 0\.83"),
        (Options(kt=(1.0, 2.0)), "kt: expected one value for this figure, got 2"),
    ],
)
def test_a_sample_that_is_not_there_is_refused(sheared, options, sentence):
    with pytest.raises(ValueError, match=sentence):
        stress_strain.table(sheared, options)


def test_both_stresses_stand_on_the_grid():
    ensemble = claim_fixtures_shear.ensemble()
    table = stress_brackets.table(ensemble, Options(n=claim_fixtures_shear.N))
    states = np.round(table["strain"] / claim_fixtures_shear.STEP)
    np.testing.assert_array_equal(states, np.arange(len(table)))
    ratio = table["coarse_run"] / table["bracketed"]
    early = table["strain"] <= 0.08
    np.testing.assert_allclose(ratio[early][1:], 1.0, atol=2e-4)
    np.testing.assert_allclose(ratio[~early], 1.05, atol=5e-3)
    assert set(table.columns) == set(stress_brackets.COLUMNS)


def test_the_largest_drop_of_all_samples_is_shown_with_the_states_around_it():
    ensemble = claim_fixtures_shear.ensemble()
    place = claim_fixtures_shear.PLACE | {"seed": 3}
    strain = claim_fixtures_shear.strains()
    for name in ("curve_stress_xy", "curve_stress_yx"):
        ensemble[name].loc[place] -= 0.02 * (strain > claim_fixtures_shear.EVENTS[2])
    table = stress_drop.table(ensemble, Options())
    assert set(table["seed"]) == {3}
    critical = table["strain"] - table["distance"]
    np.testing.assert_allclose(critical, claim_fixtures_shear.EVENTS[2], atol=1e-6)
    assert table["distance"].abs().max() <= 2.5 * claim_fixtures_shear.STEP
    before, after = (table[sign * table["distance"] > 0] for sign in (-1.0, 1.0))
    assert len(before) > 3 and before["stress"].iloc[-1] - after["stress"].iloc[0] > 0.02
    assert set(table.columns) == set(stress_drop.COLUMNS)


def test_a_sample_without_an_event_has_no_drop(sheared):
    calm = sheared.assign(event_strain_before=sheared["event_strain_before"] * np.nan)
    assert stress_drop.table(calm, Options()).empty


def test_the_sample_with_the_earliest_event_is_shown_unless_another_is_requested(sheared):
    early = sheared["event_strain_before"].where(sheared["seed"] != 2, 1e-3)
    moved = sheared.assign(event_strain_before=early)
    for figure in (stress_strain, rigidity_strain):
        assert set(figure.table(sheared, Options())["seed"]) == {0}
        assert set(figure.table(moved, Options())["seed"]) == {2}
        assert set(figure.table(moved, Options(seed=1))["seed"]) == {1}
