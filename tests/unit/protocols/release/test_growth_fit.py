"""Fits of a growing oscillation, from records made up for it."""

import numpy as np
import pytest

from grainmodes.protocols.release.growth_fit import MIN_RECORDS, fit_growth


@pytest.mark.parametrize("rate", [1e-3, -2e-4, 0.0])
def test_a_fit_is_found_from_a_wrong_guess(rate):
    """ω_r off by half a per cent, a hundred turns of phase over the window."""
    frequency, depth, phase = 0.7, 0.4, 1.1
    even = np.arange(0.0, 1e4, 29.0)
    close = 3000.0 + np.arange(288) * 2 * np.pi / frequency / 24
    time = np.sort(np.concatenate([even, close]))
    square = 3e-20 * np.exp(2 * rate * time)
    square *= 1 + depth * np.cos(2 * frequency * time - phase)
    fit = fit_growth(time, square, 1.2 * rate + 1e-5, 1.005 * frequency)
    assert fit.rate == pytest.approx(rate, abs=1e-9)
    assert fit.frequency == pytest.approx(frequency, rel=1e-7)
    assert (fit.size, fit.depth) == pytest.approx((3e-20, depth), rel=1e-5)
    assert fit.phase == pytest.approx(phase, abs=1e-4)
    assert fit.misfit < 1e-6
    np.testing.assert_allclose(fit.at(time), square, rtol=1e-4)


def test_errors_of_a_fit_are_those_of_noise():
    draws = np.random.default_rng(4)
    time = np.arange(0.0, 400.0, 0.25)
    clean = np.exp(2e-3 * time) * (1 + 0.5 * np.cos(1.4 * time))
    fits = [
        fit_growth(time, clean * (1 + 1e-2 * draws.standard_normal(len(time))), 1e-3, 0.7)
        for _ in range(60)
    ]
    for name in ("rate", "frequency"):
        spread = np.std([getattr(fit, name) for fit in fits])
        assert np.mean([getattr(fit, f"{name}_error") for fit in fits]) == pytest.approx(
            spread, rel=0.35
        )


def test_too_few_records_have_no_fit():
    time = np.arange(MIN_RECORDS - 1.0)
    assert np.isnan(fit_growth(time, np.exp(time), 0.5, 1.0)).all()
