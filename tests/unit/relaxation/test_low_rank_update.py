"""Factors of an earlier J, updated for contacts that have opened, closed or changed since."""

import numpy as np
import pytest
import scipy.linalg

from example_packings import law_name, reference, with_slip
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.relaxation.low_rank_update import MAX_CHANGED_CONTACTS

PACKING = "hertz_n64_phi0.900_seed1"
LAWS = [
    ContactLaw("hertz"),
    ContactLaw("harmonic", "elastic", 1.0),
    ContactLaw("hertz", "smoothed_coulomb", 2.0 / 7.0, 0.5),
]


def shaken(law: ContactLaw, size: float, seed: int = 0, squeezed: float = 0.95) -> EquilibriumState:
    """A packing whose grains are moved at random, so that contacts open and close."""
    draws, packing = np.random.default_rng(seed), reference(PACKING)[1].at(squeezed)
    if law.frictional:
        packing = with_slip(packing, draws, 0.01)
    return EquilibriumState.from_packing(moved(packing, draws, size), Interaction.from_law(law))


def moved(packing: Packing, draws, size: float) -> Packing:
    return packing.displaced(draws.normal(0.0, size, (packing.n, 2)))


def updated(old: EquilibriumState, new: EquilibriumState):
    assert np.array_equal(old.backbone_mask, new.backbone_mask)
    return old.base_factor.updated(new.backbone.contacts, lambda: new.stiffness)


def test_an_update_corrects_for_the_contacts_that_changed():
    """Its error is less than a tenth of that of the old factors alone."""
    old, new = (shaken(LAWS[1], size, squeezed=0.9) for size in (0.0, 6e-3))
    assert 0 < len(np.setxor1d(old.contact_keys, new.contact_keys)) <= MAX_CHANGED_CONTACTS
    force = np.random.default_rng(1).standard_normal(new.force.size)
    exact = new.factor.solve(force)
    error = np.abs(updated(old, new).solve(force) - exact).max()
    assert error < 0.1 * np.abs(old.factor.solve(force) - exact).max()


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_one_contact_more_or_less_is_solved_exactly(law):
    """J with a contact and without it, each by an update of the factors of the other."""
    old = shaken(law, 0.0)
    less = without_contact(old, 7)
    force = np.random.default_rng(1).standard_normal(old.force.size)
    for one, other in ((old, less), (less, old)):
        update = one.base_factor.updated(
            other.backbone.contacts, lambda other=other: other.stiffness
        )
        exact = other.factor.solve(force)
        np.testing.assert_allclose(update.solve(force), exact, atol=1e-9 * np.abs(exact).max())


def without_contact(equilibrium: EquilibriumState, place: int) -> EquilibriumState:
    """The same state, one contact left out of its list."""
    kept = np.arange(len(equilibrium.packing.contacts.i)) != place
    contacts = equilibrium.packing.contacts
    s = contacts.spring_state
    less = type(contacts)(
        *(getattr(contacts, name)[kept] for name in ("i", "j", "normal", "distance", "overlap")),
        None if s is None else s[kept],
    )
    packing = equilibrium.packing.without_contacts()._with_contacts(less)
    return EquilibriumState(packing, equilibrium.backbone_mask, equilibrium.interaction)


def test_an_eigenvalue_that_passes_zero_is_noticed():
    """One contact after the other is taken out of a packing with hardly enough of them."""
    old = shaken(ContactLaw("hertz"), 0.0, squeezed=0.9)
    sign_changes = []
    for place in range(0, len(old.packing.contacts.i), 2):
        less = without_contact(old, place)
        update = old.base_factor.updated(less.backbone.contacts, lambda less=less: less.stiffness)
        sign_changes.append(negative(less) != negative(old))
        assert update.may_change_signs == sign_changes[-1]
    assert 0 < sum(sign_changes) < len(sign_changes)


def negative(equilibrium: EquilibriumState) -> int:
    return np.count_nonzero(scipy.linalg.eigvals(equilibrium.matrix.toarray()).real < -1e-9)


def test_there_is_no_update_for_too_many_changes():
    old, new = shaken(LAWS[1], 0.0), shaken(LAWS[1], 0.03)
    changed = np.setxor1d(old.contact_keys, new.contact_keys)
    assert len(changed) > MAX_CHANGED_CONTACTS
    assert updated(old, new) is None


def test_reused_factors_recognise_a_saddle():
    """A state with the factors of another one has the stability that its own factors say."""
    law = ContactLaw("harmonic", "elastic", 0.1)
    for seed in range(4):
        old, new = (shaken(law, size, seed, 1.3) for size in (0.02, 0.021))
        assert new.with_factors_of(old).unstable == (negative(new) > 0)
