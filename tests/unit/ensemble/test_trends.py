"""κ*, where G_NA changes its sign, and exponents of G, against those that were put in."""

import numpy as np
import pytest

import claim_fixtures
from grainmodes.dataset.files import BlockError
from grainmodes.ensemble import trends

N = claim_fixtures.NS[-1]


@pytest.fixture(scope="module")
def ensemble():
    return claim_fixtures.ensemble()


def test_the_sign_changes_where_it_was_made_to(ensemble):
    found = trends.sign_changes(ensemble, N, 4)
    assert {phi: zero.value for phi, zero in found.items()} == pytest.approx(
        {0.86: 2.2, 0.88: 2.1, 0.90: 2.0}
    )
    assert trends.sign_changes(ensemble, N, 17) == {}
    assert trends.sign_change(ensemble.sel(kt=[1e-8, 1.0]), N, 0.90) is None
    assert trends.sign_change(ensemble.sel(kt=[10.0]), N, 0.90) is None


def test_exponents_of_a_power_law_are_exact_and_dropped_samples_counted(ensemble):
    power = ensemble.copy(deep=True)
    power["g"] = 3.0 * (power["phi"] - claim_fixtures.JAMMING) ** 0.7 * power["jammed"]
    assert trends.exponent(power, N, 1.0)[:2] == pytest.approx((0.7, 0.0), abs=1e-12)
    assert trends.exponent_between(power, N, 1.0, 0.86, 0.90).value == pytest.approx(0.7)
    power["g"].loc[{"phi": 0.88, "seed": 3}] = -1.0
    found = trends.exponent(power, N, 1.0)
    assert (found.left_out, found.samples) == (1, 15)


def test_samples_that_are_not_jammed_are_left_out(ensemble):
    loose = ensemble.copy(deep=True)
    loose["jammed"].loc[{"seed": 0}] = 0.0
    values = trends.jammed_values(loose, "g", N)
    assert np.isnan(values.sel(seed=0)).all() and np.isfinite(values.sel(seed=1)).all()
    with pytest.raises(BlockError, match="g_other"):
        trends.jammed_values(loose, "g_other", N)
