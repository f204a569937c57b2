"""N = 65536 to max|F| < 1e-14, and grains that cross the boundary of the box a million times."""

import numpy as np
import pytest

import naive_failures
from example_packings import MINIMAL, elastic, quenched, reference
from grainmodes.kernels.damping import Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Hertz, Interaction
from grainmodes.kernels.neighbours import FRACTION_UNIT
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.packing.state import Packing, PackingError
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.dynamics import move
from grainmodes.relaxation.frictionless import relax_fire_newton
from grainmodes.response.moduli import rigidity

COPIES = 64
INTERACTION = Interaction.from_law(ContactLaw(kt=1e-4))


def rest(packing: Packing) -> float:
    return max_force_and_torque(net_force(packing, elastic("hertz", 0.0)))[0]


def at_rest() -> Packing:
    """Sixteen grains in balance to 1e-15."""
    relaxed = relax_fire_newton(reference(MINIMAL[0])[1], Hertz(1.0), 1e-15, 10_000)
    assert relaxed.converged
    return relaxed.packing


def tiled(packing: Packing, copies: int) -> Packing:
    """`copies`² images of a periodic packing as one: in balance as it is."""
    step = (2**64 // copies) * np.arange(copies)
    small = packing.fraction.astype(object) // copies
    x, y = (small[axis][None] + step[:, None] for axis in (0, 1))
    every = [np.tile(x[:, None], (1, copies, 1)), np.tile(y[None], (copies, 1, 1))]
    wrapped = np.array([(total.ravel() + 2**63) % 2**64 - 2**63 for total in every]).astype(
        np.int64
    )
    many = copies * copies
    diameter, mass = np.tile(packing.diameter, many), np.tile(packing.mass, many)
    return Packing(wrapped, diameter, mass, copies * packing.box_length)


def test_fractions_hold_a_balance_that_positions_lose():
    large = tiled(at_rest(), COPIES)
    assert large.n == 65536
    assert rest(naive_failures.in_absolute_doubles(large)) > 1e-14
    assert rest(large) < 1e-15


@pytest.mark.slow
def test_sixty_five_thousand_grains_come_to_rest():
    packing = quenched(65536, 0.9)
    assert rest(packing) < 1e-14 < rest(naive_failures.in_absolute_doubles(packing))
    assert rigidity(packing, INTERACTION).unloaded.g == pytest.approx(0.02, abs=0.002)


@pytest.mark.parametrize("crossings", [1_000, pytest.param(1_000_000, marks=pytest.mark.slow)])
def test_a_balance_that_crosses_the_boundary_again_and_again_stays_one(crossings):
    """All grains drift together by 0.45 L a step; the common motion drops out of the integers."""
    packing, time_step = at_rest(), 1e-3
    step, steps = 0.45 * packing.box_length, int(crossings / 0.45)
    velocity = np.tile([step / time_step, 0.0, 0.0], (packing.n, 1))
    end = move(packing, velocity, INTERACTION, Undamped(), time_step, Stop(0.0, steps)).packing
    moved = (end.fraction - packing.fraction) * FRACTION_UNIT
    assert abs(moved[0, 0]) > 0.01
    assert np.ptp(moved, axis=1).max() < 1e-13
    assert rest(end) < 1e-14
    assert rest(naive_failures.drifted(packing, step, steps)) > 3e-14


@pytest.mark.parametrize("boxes", [0.3, 0.5, -0.75, 1.0, 12.25, 2.0**40])
def test_a_step_of_any_number_of_boxes_is_taken_whole(boxes):
    """A plain cast to 64 bits takes less than half a box; the longest ones all end at −1/2."""
    packing, step = at_rest(), np.zeros((16, 2))
    step[3] = boxes * packing.box_length
    with np.errstate(invalid="raise"):
        moved = (packing.displaced(step).fraction - packing.fraction)[:, 3] * FRACTION_UNIT
    expected = (boxes + 0.5) % 1.0 - 0.5
    np.testing.assert_allclose(moved, expected, atol=1e-15)
    with np.errstate(invalid="ignore"):
        cast = np.rint(boxes / FRACTION_UNIT).astype(np.int64) * FRACTION_UNIT
    assert (cast == pytest.approx(expected, abs=1e-15)) == (abs(boxes) <= 0.5)
    step[3] = np.nan
    with pytest.raises(PackingError, match="the step of grain 3"):
        packing.displaced(step)
