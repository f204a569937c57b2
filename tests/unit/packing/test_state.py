"""The state of a packing: exact fractions, contacts and rattlers against brute force."""

import pickle
from copy import copy
from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import naive
from example_packings import ELASTIC, contacts_and_pairs, crowd, few, pairs_of, reference
from grainmodes.packing import state
from grainmodes.packing.contacts import History
from grainmodes.packing.state import Packing, PackingError, find_contacts, rattlers

UNIT = 2.0**-64


def two(gap: float, box_length: float = 5.0) -> Packing:
    return Packing.from_positions([[1.0, 1.0], [1.0 + gap, 1.0]], [1.0, 1.0], box_length)


@few(30)
@given(seed=st.integers(0, 10**6), strain=st.floats(-0.5, 0.5), slip=st.sampled_from([0.0, 0.3]))
def test_contacts_are_those_of_brute_force(seed, strain, slip):
    contacts, pairs = contacts_and_pairs(crowd(seed, strain=strain, slip=slip))
    assert list(zip(contacts.i, contacts.j, strict=True)) == [(p.i, p.j) for p in pairs]
    branch = contacts.normal * contacts.distance[:, None]
    np.testing.assert_allclose(branch, [p.branch for p in pairs], atol=1e-14)
    np.testing.assert_allclose(
        contacts.overlap, [p.reach - naive.length(p.branch) for p in pairs], atol=1e-14
    )
    np.testing.assert_array_equal(contacts.springs, [p.slip for p in pairs])


def test_contacts_are_sorted_with_i_above_j():
    contacts = reference(ELASTIC[3])[1].contacts
    assert np.all(contacts.i > contacts.j)
    keys = contacts.i.astype(int) * 64 + contacts.j
    assert np.all(np.diff(keys) > 0)
    np.testing.assert_allclose(np.hypot(*contacts.normal.T), 1.0, atol=1e-15)
    np.testing.assert_allclose(np.sum(contacts.normal * contacts.tangent, axis=1), 0.0, atol=1e-16)


@pytest.mark.parametrize("name", ELASTIC)
def test_reference_packings_have_the_contacts_they_say(name):
    data, packing = reference(name)
    assert len(packing.contacts.i) == data.contacts
    assert not rattlers(packing, 2).any()


@pytest.mark.parametrize("strain", [-0.5, 0.0, 0.2])
def test_positions_survive_the_round_trip(strain):
    packing = crowd(5, strain=strain)
    assert np.all((packing.position >= 0) & (packing.position < packing.box_length))
    again = Packing.from_positions(
        packing.position, packing.diameter, packing.box_length, strain, packing.mass
    )
    np.testing.assert_allclose(again.position, packing.position, atol=1e-14)
    before, after = packing.contacts, again.contacts
    np.testing.assert_array_equal(before.i, after.i)
    np.testing.assert_allclose(before.overlap, after.overlap, atol=1e-14)


def test_a_history_may_come_in_any_order():
    packing = crowd(6, slip=0.3)
    h, shuffle = packing.history, np.random.default_rng(0).permutation(len(packing.history.i))
    swapped = History(h.j[shuffle], h.i[shuffle], h.spring_state[shuffle])
    again = Packing.from_positions(
        packing.position, packing.diameter, packing.box_length, 0.0, packing.mass, swapped
    )
    np.testing.assert_array_equal(again.contacts.springs, packing.contacts.springs)


def test_images_of_a_grain_are_one_grain():
    packing = crowd(2)
    far = packing.position + packing.box_length * np.arange(-8, 8)[:, None] * [1.0, -2.0]
    there = Packing.from_positions(far, packing.diameter, packing.box_length)
    # Subtracting 16 L loses four bits of a position.
    difference = (there.fraction - packing.fraction) * UNIT
    assert np.abs(difference).max() < 1e-14


def test_fractions_resolve_what_positions_cannot():
    packing = reference(ELASTIC[0])[1]
    step = np.zeros((packing.n, 2))
    step[0] = 1e-18
    moved = packing.displaced(step)
    assert np.all(moved.fraction[:, 0] != packing.fraction[:, 0])
    np.testing.assert_array_equal(moved.displaced(-step).fraction, packing.fraction)


@pytest.mark.parametrize("strain", [-0.5, 0.0, 0.3])
def test_displacement_is_in_the_frame_of_the_box(strain):
    packing, step = crowd(1, strain=strain), np.full((16, 2), [0.01, -0.02])
    moved = packing.displaced(step).position - packing.position
    shift = moved - step
    rows = np.rint(shift[:, 1] / packing.box_length)
    shift -= packing.box_length * rows[:, None] * [strain, 1.0]
    shift[:, 0] -= packing.box_length * np.rint(shift[:, 0] / packing.box_length)
    np.testing.assert_allclose(shift, 0.0, atol=1e-14)


def test_compression_and_shear_leave_the_fractions_alone():
    packing = crowd(0)
    denser = packing.at(0.95)
    assert denser.phi == pytest.approx(0.95, rel=1e-14)
    np.testing.assert_array_equal(denser.fraction, packing.fraction)
    np.testing.assert_array_equal(packing.sheared(0.3).fraction, packing.fraction)
    before, after = pairs_of(packing)[0], pairs_of(packing.sheared(0.01))[0]
    assert (before.i, before.j) == (after.i, after.j)
    affine = before.branch + 0.01 * np.array([before.branch[1], 0.0])
    np.testing.assert_allclose(after.branch, affine, atol=1e-14)


def test_mass_defaults_to_the_square_of_the_diameter():
    packing = Packing.from_positions([[0, 0], [2, 2]], [1.0, 1 / 1.4], 5.0)
    np.testing.assert_allclose(packing.mass, [1.0, 1 / 1.96])


def test_slip_follows_its_contact_and_new_contacts_have_none():
    packing = crowd(4, slip=0.3)
    contacts = packing.contacts
    h = packing.history
    fewer = replace(packing, history=History(h.i[1:], h.j[1:], h.spring_state[1:]))
    s = fewer.contacts.spring_state
    assert s[0] == 0.0
    np.testing.assert_array_equal(s[1:], contacts.spring_state[1:])
    nothing = np.zeros(0, np.int32)
    empty = replace(packing, history=History(nothing, nothing, np.zeros(0)))
    assert np.all(empty.contacts.spring_state == 0.0)


@few(30)
@given(seed=st.integers(0, 10**6), n=st.integers(5, 30), threshold=st.integers(0, 4))
def test_rattlers_are_those_of_brute_force(seed, n, threshold):
    draws = np.random.default_rng(seed)
    packing = Packing.from_positions(draws.uniform(0, 4, (n, 2)), np.ones(n), 4.0)
    found = set(np.flatnonzero(rattlers(packing, threshold)).tolist())
    assert found == naive.rattlers(pairs_of(packing), n, threshold)


def test_a_chain_unravels_to_the_last_grain():
    position = [[0.9 * k, 1.0] for k in range(8)]
    chain = Packing.from_positions(position, np.ones(8), 20.0)
    assert rattlers(chain, 1).all()
    assert not rattlers(chain, 0).any()


def test_grains_taken_out_are_really_out():
    packing = crowd(3)
    mask = np.arange(16) % 5 == 0
    left = packing.without(mask)
    assert left.n == 12
    np.testing.assert_array_equal(left.mass, packing.mass[~mask])
    kept = np.flatnonzero(~mask)
    expected = [(p.i, p.j) for p in pairs_of(packing) if not (mask[p.i] or mask[p.j])]
    contacts = left.contacts
    assert list(zip(kept[contacts.i], kept[contacts.j], strict=True)) == expected


def test_nothing_touches_at_exactly_the_contact_distance():
    assert len(two(1.0).contacts.i) == 0
    assert len(two(1.0 - 1e-12).contacts.i) == 1


def test_two_grains_in_one_place_are_refused_by_number():
    with pytest.raises(PackingError, match="grains 1 and 0"):
        _ = two(0.0).contacts


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"position": [[0.0, 0.0]]}, "for 2 diameters, got"),
        ({"position": [[0.0, 0.0], [np.nan, 0.0]]}, "position of grain 1"),
        ({"diameter": [1.0, -1.0]}, "diameter of grain 1"),
        ({"diameter": [np.inf, 1.0]}, "diameter of grain 0"),
        ({"mass": [1.0, 0.0]}, "mass of grain 1"),
        ({"mass": [1.0]}, "for 2 diameters, got"),
        ({"box_length": 2.0}, "two diameters"),
        ({"box_length": np.nan}, "box_length: expected a finite number, got nan"),
        ({"strain": np.inf}, "strain: expected a finite number, got inf"),
        ({"position": np.zeros((1, 2)), "diameter": [1.0]}, "at least 2 grains"),
    ],
)
def test_what_is_no_packing_is_refused(change, named):
    good = {"position": [[0.0, 0.0], [1.5, 1.5]], "diameter": [1.0, 1.0], "box_length": 5.0}
    with pytest.raises(PackingError, match=named):
        Packing.from_positions(**(good | change))


def test_springs_keep_their_contacts_when_grains_are_taken_out():
    packing = crowd(0, slip=0.2)
    gone = np.isin(np.arange(packing.n), [0, 3, 7])
    before, after = packing.contacts, packing.without(gone).contacts
    held = ~(gone[before.i] | gone[before.j])
    number = np.cumsum(~gone) - 1
    np.testing.assert_array_equal(number[before.i[held]], after.i)
    np.testing.assert_array_equal(number[before.j[held]], after.j)
    np.testing.assert_array_equal(before.springs[held], after.springs)
    assert np.any(after.springs != 0.0)


@pytest.mark.parametrize("strain", [-0.5, 0.5])
def test_a_small_sheared_box_is_refused_or_right(strain):
    """The touching image may lie outside the wrapped fractions unless L > 2 d √(1 + γ²)."""
    apart = 0.95 * np.array([0.894, -0.447 * np.sign(strain)])
    position = np.array([[1.5, 1.0], np.add([1.5, 1.0], apart)])
    try:
        packing = Packing.from_positions(position, np.ones(2), 2.05, strain)
    except PackingError:
        return
    assert len(packing.contacts.i) == len(pairs_of(packing)) == 1


def test_contacts_are_found_once_and_follow_every_change(monkeypatch):
    packing, calls = crowd(0, slip=0.2).without_contacts(), []
    monkeypatch.setattr(state, "find_contacts", lambda one: calls.append(one) or find_contacts(one))
    assert packing.contacts is packing.contacts and len(calls) == 1
    wider, smaller = packing.at(0.5 * packing.phi), packing.without(np.arange(packing.n) == 3)
    assert len(wider.contacts.i) < len(smaller.contacts.i) < len(packing.contacts.i)
    assert len(calls) == 2  # a smaller packing takes the contacts along
    for copied in (replace(packing), pickle.loads(pickle.dumps(packing)), copy(packing)):
        assert "contacts" not in vars(copied)
    assert len(pickle.dumps(packing)) == len(pickle.dumps(packing.without_contacts()))


@few(20)
@given(seed=st.integers(0, 10**6), strain=st.floats(-0.5, 0.5), slip=st.sampled_from([0.0, 0.3]))
def test_contacts_taken_along_are_those_found_anew_to_the_last_bit(seed, strain, slip):
    packing = crowd(seed, strain=strain, slip=slip)
    contacts = packing.contacts
    smaller = packing.without(np.random.default_rng(seed).random(packing.n) < 0.3)
    loaded = packing.with_springs(np.arange(1.0, 1.0 + len(contacts.i)))
    for changed in (smaller, loaded):
        anew = changed.without_contacts().contacts
        for field in fields(contacts):
            carried, found = getattr(changed.contacts, field.name), getattr(anew, field.name)
            assert (carried is None) == (found is None)
            if found is not None:
                np.testing.assert_array_equal(carried, found)
                assert carried.dtype == found.dtype
