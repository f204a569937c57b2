"""How often chance gives a wrong verdict, counted on synthetic ensembles.

A claim of three parts is judged in 2000 ensembles. In a true claim every part is true, though only
just: the number that the samples estimate lies on the limit. In a false claim one of them is as
false as that. Either way the wrong verdict is due to chance, and no other case is worse.
"""

import numpy as np
import pytest

from grainmodes.claims.part import CONTRADICTED, HOLDS, Part, verdicts_of
from grainmodes.statistics.averages import average
from grainmodes.statistics.estimates import Estimate
from grainmodes.statistics.medians import Median
from grainmodes.statistics.shares import Share, pooled_share

TRIALS, PARTS = 2000, 3
SIZES = (4, 8, 10, 30)
MOST = 0.05
LIMIT = 1.0


def normal(draws, shape):
    return draws.normal(size=shape)


def long_tails(draws, shape):
    """Student's t with three degrees of freedom: one sample in 200 lies six widths away."""
    return draws.standard_t(3, size=shape)


def one_outlier(draws, shape):
    """One sample of every ensemble is ten widths off, to either side."""
    values = draws.normal(size=shape)
    values[..., 0] += 10.0 * draws.choice([-1.0, 1.0], size=shape[:-1])
    return values


def skewed(draws, shape):
    """A tail to one side only, with a skewness of 0.7; with 1 it is 5.2 % at S = 8."""
    return draws.gamma(8.0, size=shape) / 8.0 - 1.0


SAMPLES = (normal, long_tails, one_outlier, skewed)


def in_trials(measurements, **interval):
    """The share of trials in which the claim is contradicted, and in which it holds.

    Args:
        measurements: TRIALS lists of PARTS measurements.
    """
    found = [
        verdicts_of([Part("", number, **interval) for number in trial]) for trial in measurements
    ]
    contradicted = np.mean([CONTRADICTED in verdicts for verdicts in found])
    holds = np.mean([set(verdicts) == {HOLDS} for verdicts in found])
    return contradicted, holds


def estimates(values):
    """TRIALS lists of PARTS means of samples (TRIALS, PARTS, S)."""
    found = average(values, np.isfinite(values))
    freedom = values.shape[-1] - 1
    return [
        [Estimate(*number, freedom) for number in zip(*trial, strict=True)]
        for trial in zip(found.mean.tolist(), found.standard_error.tolist(), strict=True)
    ]


def drawn(distribution, size):
    draws = np.random.default_rng([size, SAMPLES.index(distribution)])
    return LIMIT + distribution(draws, (TRIALS, PARTS, size))


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("distribution", SAMPLES)
def test_a_claim_on_means_is_rarely_judged_wrongly(distribution, size):
    values = drawn(distribution, size)
    assert in_trials(estimates(values), high=LIMIT)[0] <= MOST
    assert in_trials(estimates(values), low=LIMIT)[0] <= MOST
    assert in_trials(estimates(values), low=LIMIT - 0.5, high=LIMIT)[0] <= MOST
    values[:, 1:] -= 100.0
    assert in_trials(estimates(values), high=LIMIT)[1] <= MOST
    assert in_trials(estimates(-values), low=-LIMIT)[1] <= MOST


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("distribution", (normal, long_tails, one_outlier))
def test_a_claim_on_medians_is_rarely_judged_wrongly(distribution, size):
    values = np.sort(drawn(distribution, size), axis=-1)
    medians = [[Median(tuple(part)) for part in trial] for trial in values.tolist()]
    contradicted, _ = in_trials(medians, high=LIMIT)
    assert contradicted <= MOST
    one = [trial[:1] for trial in medians]
    assert in_trials(one, high=LIMIT)[1] <= MOST


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("limit", (0.5, 0.9))
def test_a_claim_on_shares_is_rarely_judged_wrongly(size, limit):
    having = np.random.default_rng(size).binomial(size, limit, (TRIALS, PARTS))
    shares = [[Share(count, size) for count in trial] for trial in having.tolist()]
    assert in_trials(shares, low=limit)[0] <= MOST
    assert in_trials([trial[:1] for trial in shares], low=limit)[1] <= MOST


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("limit", (0.5, 0.9))
@pytest.mark.parametrize("correlation", (0.0, 0.1))
def test_a_claim_on_shares_of_events_is_rarely_judged_wrongly(size, limit, correlation):
    """Samples have 1 to some 30 events, whose probability varies from sample to sample."""
    draws = np.random.default_rng([size, int(10 * correlation)])
    shape = (TRIALS, PARTS, size)
    events = 1 + draws.poisson(15, shape)
    width = (1.0 - correlation) / max(correlation, 1e-9)
    having = draws.binomial(events, draws.beta(limit * width, (1.0 - limit) * width, shape))
    shares = [
        [pooled_share(map(of_events, *part)) for part in zip(*trial, strict=True)]
        for trial in zip(having, events, strict=True)
    ]
    contradicted, _ = in_trials(shares, low=limit)
    one = [trial[:1] for trial in shares]
    assert contradicted <= MOST
    assert in_trials(one, low=limit)[1] <= MOST
    assert in_trials(one, high=limit)[1] <= MOST


def of_events(having, events):
    """(E,) of 1 and 0."""
    return (np.arange(events) < having).astype(float)


@pytest.mark.parametrize("size", SIZES)
def test_a_claim_on_the_size_of_differences_is_rarely_judged_wrongly(size):
    """The logarithm of a normal difference has a long tail to small ones."""
    draws = np.random.default_rng(size)
    values = np.log10(np.abs(draws.normal(size=(TRIALS, PARTS, size))))
    values += LIMIT - np.log10(np.exp(-0.5 * (np.log(2.0) + np.euler_gamma)))
    assert in_trials(estimates(values), high=LIMIT)[0] <= MOST
    values[:, 1:] -= 100.0
    assert in_trials(estimates(values), high=LIMIT)[1] <= MOST


@pytest.mark.parametrize("size", SIZES)
def test_samples_that_agree_by_chance_are_rarely_judged_wrongly(size):
    """Two values on either side of the limit: a mean of four often has no scatter at all."""
    below = np.random.default_rng(size).random((TRIALS, PARTS, size)) < 0.5
    values = np.where(below, LIMIT - 1.0, LIMIT + 1.0)
    assert in_trials(estimates(values), high=LIMIT)[0] <= MOST
    assert in_trials([trial[:1] for trial in estimates(values)], low=LIMIT)[1] <= MOST


@pytest.mark.parametrize("size", SIZES[1:])
def test_a_claim_that_is_clearly_true_or_false_is_decided(size):
    """The other side: a verdict that is never wrong because there is none would be of no use."""
    values = drawn(normal, size) - 3.0
    assert in_trials(estimates(values), high=LIMIT)[1] > 0.95
    values[:, 0] += 7.0
    assert in_trials(estimates(values), high=LIMIT)[0] > 0.95


@pytest.mark.parametrize("size", SIZES)
def test_the_levels_are_those_stated(size):
    """In normal samples a part on the limit holds in 2 % and is contradicted in 0.5 %."""
    one = [trial[:1] for trial in estimates(drawn(normal, size))]
    contradicted, holds = in_trials(one, high=LIMIT)
    assert 0.001 < contradicted < 0.011
    assert 0.012 < holds < 0.029
