"""The stages that a release goes through, and the spirals of its grains."""

from types import SimpleNamespace

import numpy as np
import pytest

from grainmodes.protocols.release.outcome import release_outcome
from grainmodes.protocols.release.record import (
    MotionRecord,
)
from grainmodes.protocols.release.spirals import fit_spirals
from released import SHORT, released, state


def test_a_rattler_draws_no_spiral():
    run = released()
    fit = release_outcome(run, run.start.growth_rate).displacement
    still = [(step, moved * (np.arange(50) != 7)[:, None]) for step, moved in run.film]
    resting = SimpleNamespace(film=still, choices=run.choices, start=run.start)
    ratios = [fit_spirals(one, fit).axis_ratio for one in (resting, run)]
    assert ratios[0] == pytest.approx(ratios[1], rel=0.1)


def test_the_outcome_of_a_run_is_found_from_its_records():
    """A made-up run: growth, contacts change at 5e-8, a plateau from 1e-7 on, a second rise."""
    start, _, _ = state()
    rate, turn = start.growth_rate, 2 * np.pi / start.frequency
    even = np.arange(0.0, 60.0, 0.05) / rate
    time = np.unique(np.concatenate([even, 7.0 / rate + turn / 24 * np.arange(288)]))
    growth = 1e-22 * np.exp(2 * rate * time)
    square = np.minimum(growth * (1 + 0.2 * np.cos(2 * start.frequency * time)), 1e-7)
    overlap = start.packing.contacts.overlap.mean()
    square[time > 40.0 / rate] = 0.8 * overlap**2
    square[time > 50.0 / rate] = 1.2 * overlap**2
    blank = np.zeros(len(MotionRecord._fields))
    records = [
        MotionRecord(*(t, m, m), *blank[3:])._replace(changed=int(m > 5e-8))
        for t, m in zip(time, square, strict=True)
    ]
    outcome = release_outcome(SimpleNamespace(start=start, records=records), 1.1 * rate)
    grown = np.log(1e-7 / 1e-22) / 2
    assert outcome.displacement.rate == pytest.approx(rate, rel=1e-6)
    assert outcome.displacement.depth == pytest.approx(0.2, rel=1e-3)
    assert outcome.rotation == pytest.approx(outcome.displacement)
    assert outcome.end.time * rate == pytest.approx(grown + 0.5 * np.log(2.0), abs=0.2)
    assert outcome.end.square == pytest.approx(2e-7, rel=0.3)
    assert outcome.change.time * rate == pytest.approx(grown + 0.5 * np.log(0.5), abs=0.2)
    assert 5e-8 < outcome.change.square <= 1e-7
    assert outcome.second == (pytest.approx(50.05 / rate, rel=1e-3), 1.2 * overlap**2)
    assert outcome.largest == outcome.second.square
    assert outcome.after.mean_square_displacement == pytest.approx(outcome.largest)


def test_what_does_not_happen_has_no_onset():
    outcome = release_outcome(released(SHORT, drag=10.0 * state()[0].growth_rate), -1e-3)
    assert np.isnan([*outcome.displacement, *outcome.end, *outcome.change, *outcome.second]).all()
