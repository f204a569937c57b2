"""The growth of a pair under a drag: against LAPACK on the linearised problem, and closed forms."""

import numpy as np
import pytest
import scipy.linalg

from grainmodes.complex_pairs.damped_growth import DampedPair
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.mass_weighted import generalized_mass
from released import state


def reference():
    """J (3N, 3N), M (3N,), and λ' and vectors of the eight pairs of the reference state."""
    start, _, interaction = state()
    mass = generalized_mass(start.packing.mass).ravel()
    stiffness = jacobian(start.packing, interaction)
    values, vectors = scipy.linalg.eig(stiffness.toarray() / mass[:, None])
    found = np.flatnonzero(values.imag > 1e-9)
    return stiffness, mass, values[found], vectors[:, found]


def damped_mass(mass: np.ndarray, motion: str) -> np.ndarray:
    return mass * np.tile([1.0, 1.0, 0.0], len(mass) // 3) if motion == "translations" else mass


def pairs(motion: str) -> list[tuple[float, DampedPair]]:
    """ω_i and the damped pair of all eight."""
    stiffness, mass, values, vectors = reference()
    damped = damped_mass(mass, motion)
    return [
        (np.sqrt(value).imag, DampedPair(stiffness, mass, damped, value, vector))
        for value, vector in zip(values, vectors.T, strict=True)
    ]


def linearised(motion: str, drag: float) -> np.ndarray:
    """All s by LAPACK, from (q, q̇)˙ = (q̇, −M⁻¹J q − η_0 M⁻¹B q̇)."""
    stiffness, mass, _, _ = reference()
    zero, one = np.zeros_like(stiffness.toarray()), np.eye(len(mass))
    drags = np.diag(drag * damped_mass(mass, motion) / mass)
    return scipy.linalg.eigvals(
        np.block([[zero, one], [-stiffness.toarray() / mass[:, None], -drags]])
    )


@pytest.mark.parametrize("motion", ["translations", "all"])
def test_rates_are_those_of_the_linearised_problem(motion):
    for rate, pair in pairs(motion):
        for drag in (0.5 * rate, 3.0 * rate, 20.0 * rate):
            exponents = linearised(motion, drag)
            found = pair.rates(np.array([drag]))[0]
            assert np.abs(exponents.real - found).min() < 1e-10


def test_growth_at_the_rate_of_the_pair_and_its_end():
    """C's drag on translations leaves most of the growth; a drag on all motion leaves half."""
    for motion, growth, least, most, end in (
        ("translations", 0.728, 0.534, 0.839, 4.156),
        ("all", 0.5, 0.5, 0.5, 2.0),
    ):
        found = [
            (w, pair.rates(np.array([w]))[0] / w, pair.threshold() / w) for w, pair in pairs(motion)
        ]
        rates, at_rate, ends = np.array(found).T
        fastest = np.argmax(rates)
        assert at_rate[fastest] == pytest.approx(growth, abs=1e-3)
        assert (at_rate.min(), at_rate.max()) == pytest.approx((least, most), abs=1e-3)
        assert ends[fastest] == pytest.approx(end, abs=1e-3)


@pytest.mark.parametrize("times", [0.0, 0.5, 2.0, 10.0, 100.0])
def test_a_drag_on_all_motion_acts_as_the_quadratic_says(times):
    stiffness, mass, values, vectors = reference()
    rate = np.sqrt(values[0]).imag
    pair = DampedPair(stiffness, mass, mass, values[0], vectors[:, 0])
    roots = np.roots([1.0, times * rate, values[0]])
    found = pair.rates(np.array([times * rate]))[0]
    assert found == pytest.approx(roots.real.max(), rel=1e-7, abs=1e-12)


def test_the_threshold_is_where_the_rate_vanishes():
    rate, pair = pairs("translations")[0]
    end = pair.threshold()
    below, above = pair.rates(np.array([0.99 * end, 1.01 * end]))
    assert below > 0.0 > above
    assert abs(pair.rates(np.array([end]))[0]) < 1e-9 * rate + 1e-12


def test_a_mode_that_no_drag_acts_on_has_no_threshold():
    stiffness, mass, values, vectors = reference()
    pair = DampedPair(stiffness, mass, np.zeros_like(mass), values[0], vectors[:, 0])
    assert np.isnan(pair.threshold())
    rate = np.sqrt(values[0]).imag
    assert pair.rates(np.array([9.0 * rate]))[0] == pytest.approx(rate, rel=1e-6)


def test_a_root_that_is_lost_on_the_way_to_the_threshold_has_none(monkeypatch):
    """The release of the state goes on; the last steps are those of a bisection."""
    pair, found, largest = pairs("translations")[0][1], DampedPair._root, [0.0]

    def lost_below(self, start, drag):
        if drag < largest[0]:
            raise ArithmeticError("root lost")
        largest[0] = drag
        return found(self, start, drag)

    monkeypatch.setattr(DampedPair, "_root", lost_below)
    assert np.isnan(pair.threshold())
