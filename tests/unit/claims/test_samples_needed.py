"""The number of samples that would settle an open part: counted with as many samples.

A part is measured with few samples. Then whole studies of the number of samples that it names are
drawn from the distribution that was measured, and it is counted how many of them settle the part.
"""

import numpy as np
import pytest

from grainmodes.claims.part import NOT_RESOLVED, Part, verdicts_of
from grainmodes.statistics.estimates import mean
from grainmodes.statistics.medians import median
from grainmodes.statistics.sample_sizes import fewest_samples
from grainmodes.statistics.shares import PooledShare, Share, pooled_share, share

TRIALS, POWER = 400, 0.8
SPREAD = 0.1
"""Two standard errors of a share of `TRIALS`, and what a design effect of 1 leaves out."""


def normal(value, size=8):
    """Eight samples with the mean `value` and the standard deviation 1, and more of the kind."""
    scores = np.linspace(-1.0, 1.0, size)
    first = value + (scores - scores.mean()) / scores.std(ddof=1)
    return mean(first), lambda draws, samples: mean(draws.normal(value, 1.0, samples))


def of_two_values(having, size):
    return (
        Share(having, size),
        lambda draws, samples: share((draws.random(samples) < having / size).astype(float)),
    )


def sign(beyond, size):
    """So many samples above 1 and the others below -1."""
    values = np.where(np.arange(size) < beyond, 2.0, -2.0)
    return (
        median(values),
        lambda draws, samples: median(np.where(draws.random(samples) < beyond / size, 2.0, -2.0)),
    )


def pooled(having, events, size):
    each, ratio = events // size, having / events
    return (
        PooledShare(having, events, size),
        lambda draws, samples: pooled_share((draws.random((samples, each)) < ratio).astype(float)),
    )


CASES = [
    (normal(0.5), {"low": 0.0}),
    (normal(-0.7), {"low": 0.0}),
    (normal(0.2), {"low": -0.6, "high": 3.0}),
    (normal(1.0), {"low": 0.0, "high": 0.5, "outside": True}),
    (of_two_values(6, 8), {"low": 0.5}),
    (of_two_values(2, 8), {"low": 0.5}),
    (of_two_values(1, 8), {"high": 0.5}),
    (sign(7, 8), {"low": 0.0}),
    (sign(2, 8), {"low": 0.0}),
    (pooled(93, 96, 8), {"low": 0.9}),
    (pooled(84, 96, 8), {"low": 0.9}),
]


def settled(draw, interval, samples, judged):
    """The share of studies of so many samples in which the part is settled."""
    draws = np.random.default_rng(samples)
    others = [Part("", Share(30, 30), low=0.5)] * (judged - 1)
    found = [
        verdicts_of([Part("", draw(draws, samples), **interval), *others])[0] for _ in range(TRIALS)
    ]
    return np.mean([verdict != NOT_RESOLVED for verdict in found])


@pytest.mark.parametrize("judged", [1, 9])
@pytest.mark.parametrize(("measured", "interval"), CASES)
def test_as_many_samples_settle_it_in_four_of_five_studies(measured, interval, judged):
    number, draw = measured
    part = Part("", number, **interval)
    assert verdicts_of([part])[0] == NOT_RESOLVED
    needed = int(part.samples_needed(judged))
    assert settled(draw, interval, needed, judged) > POWER - SPREAD
    assert settled(draw, interval, needed // 2, judged) < POWER - SPREAD


@pytest.mark.parametrize(
    ("number", "judged", "fewest"),
    [(Share(4, 4), 1, 6), (Share(0, 7), 1, 8), (Share(0, 8), 9, 11), (median(np.ones(4)), 1, 6)],
)
def test_samples_that_agree_need_the_fewest_that_decide(number, judged, fewest):
    assert Part("", number, low=0.5).samples_needed(judged) == fewest


def test_a_number_on_its_limit_is_never_settled():
    for number in (mean(np.array([0.0, 1.0])), Share(1, 2), median(np.array([0.0, 1.0]))):
        assert Part("", number, low=0.5).samples_needed(1) == np.inf
    assert fewest_samples(lambda sizes: sizes < 0) == np.inf
    assert fewest_samples(lambda sizes: sizes > 0) == 2
