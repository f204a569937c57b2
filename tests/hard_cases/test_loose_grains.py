"""Rattlers with no contact, one, two; pairs of them; chains: none may be seen in g.

With friction, two contacts may hold a grain; what counts as loose is `threshold` (A, App. E).
"""

import numpy as np
import pytest

import naive_failures
from example_packings import ELASTIC, elastic, reference
from grainmodes.kernels.laws import Hertz
from grainmodes.packing.state import Packing, rattlers
from grainmodes.relaxation import rattlers as rattlers_out
from grainmodes.relaxation.frictionless import relax_fire_newton
from grainmodes.relaxation.newton import newton
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import Eigenproblem

SOLID = reference(ELASTIC[3])[1]
SMALL = 0.05
"""Diameter of the grains that are added."""


def void() -> np.ndarray:
    """The place farthest from all grains."""
    side = np.linspace(0.0, SOLID.box_length, 200, endpoint=False)
    places = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 1, 2)
    away = places - SOLID.position
    away -= SOLID.box_length * np.rint(away / SOLID.box_length)
    gap = np.hypot(*np.moveaxis(away, -1, 0)) - SOLID.diameter / 2
    return places[np.argmax(gap.min(axis=1)), 0]


def cusp() -> np.ndarray:
    """A place that touches both grains of a contact, on one side of it."""
    contacts = SOLID.contacts
    i, j = contacts.i[0], contacts.j[0]
    r_i, r_j = (0.5 * SOLID.diameter[g] + 0.48 * SMALL for g in (i, j))
    r = contacts.distance[0]
    along = (r**2 + r_i**2 - r_j**2) / (2.0 * r)
    aside = np.sqrt(r_i**2 - along**2)
    return SOLID.position[i] - along * contacts.normal[0] + aside * contacts.tangent[0]


def on_the_surface() -> tuple[np.ndarray, np.ndarray]:
    """A place that touches the grain nearest to the void, and the way from there into it."""
    away = void() - SOLID.position
    away -= SOLID.box_length * np.rint(away / SOLID.box_length)
    gap = np.hypot(*away.T) - SOLID.diameter / 2
    near = np.argmin(gap)
    direction = away[near] / np.hypot(*away[near])
    return SOLID.position[near] + (SOLID.diameter[near] / 2 + 0.48 * SMALL) * direction, direction


def crowded(*places: np.ndarray) -> Packing:
    """The solid with small grains at these places."""
    position = np.vstack([SOLID.position, *places])
    diameter = np.append(SOLID.diameter, np.full(len(places), SMALL))
    return Packing.from_positions(position, diameter, SOLID.box_length)


SURFACE, OUT = on_the_surface()
CASES = {
    "no contact": [void()],
    "one contact": [SURFACE],
    "two contacts": [cusp()],
    "a pair by itself": [void(), np.add(void(), [0.98 * SMALL, 0.0])],
    "a chain": [SURFACE + 0.97 * k * SMALL * OUT for k in range(3)],
}


@pytest.mark.parametrize("kt", [0.0, 0.1])
@pytest.mark.parametrize("places", CASES.values(), ids=CASES.keys())
def test_what_is_loose_does_not_change_g(places, kt):
    interaction, packing = elastic("hertz", kt), crowded(*places)
    contacts = packing.contacts
    degree = np.bincount(np.append(contacts.i, contacts.j), minlength=packing.n)[SOLID.n :]
    assert degree.max() <= 2
    expected = rigidity(SOLID, interaction).unloaded.g
    g, lowest = naive_failures.with_all_grains(packing, interaction)
    assert np.isnan(g) or lowest < -1e-6 or abs(g / expected - 1.0) > 1e-5
    assert Eigenproblem.from_packing(packing, interaction).size == (3 if kt else 2) * SOLID.n
    assert rigidity(packing, interaction).unloaded.g == pytest.approx(expected, rel=1e-13)


def test_a_chain_is_taken_off_grain_by_grain():
    packing = crowded(*CASES["a chain"])
    contacts = packing.contacts
    loose = np.arange(packing.n) >= SOLID.n
    once = naive_failures.rounds_removing(contacts, packing.n, threshold=1, rounds=1)
    assert once.sum() == 1
    np.testing.assert_array_equal(rattlers(packing, threshold=1), loose)


@pytest.mark.parametrize("places", [CASES["one contact"], CASES["a pair by itself"]])
def test_a_loose_contact_is_let_go_at_once(places, monkeypatch):
    """Newton's method takes a lone Hertz contact from ξ to ξ/3 a step."""
    packing = crowded(*places)
    monkeypatch.setattr(rattlers_out, "MAX_MOVES", 3)
    assert not newton(packing, elastic("hertz", 0.0), 1e-14).converged
    relaxed = relax_fire_newton(packing, Hertz(1.0), 1e-14, 100_000)
    assert relaxed.converged and relaxed.max_force < 1e-14
    assert relaxed.packing.contacts.i.max() < SOLID.n


def test_two_contacts_may_hold_a_grain_by_friction():
    """At a threshold of 1 the grain in the cusp stays, and adds its three modes."""
    interaction, packing = elastic("hertz", 0.1), crowded(*CASES["two contacts"])
    assert Eigenproblem.from_packing(packing, interaction, threshold=1).size == 3 * (SOLID.n + 1)
    lowest = np.linalg.eigvalsh(
        Eigenproblem.from_packing(packing, interaction, threshold=1).matrix.toarray()
    )[2]
    assert lowest > 1e-3
