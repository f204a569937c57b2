"""Factors of an earlier J, fitted to contacts that have opened, closed or changed since."""

import numpy as np
import pytest
import scipy.linalg

from example_packings import law_name, reference, with_slip
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.balance import Balance
from grainmodes.relaxation.low_rank_update import MOST_CHANGED

PACKING = "hertz_n64_phi0.900_seed1"
LAWS = [
    ContactLaw("hertz"),
    ContactLaw("harmonic", "elastic", 1.0),
    ContactLaw("hertz", "smoothed_coulomb", 2.0 / 7.0, 0.5),
]


def shaken(law: ContactLaw, size: float, seed: int = 0, squeezed: float = 0.95) -> Balance:
    """A packing whose grains are moved at random, so that contacts open and close."""
    draws, packing = np.random.default_rng(seed), reference(PACKING)[1].at(squeezed)
    if law.frictional:
        packing = with_slip(packing, draws, 0.01)
    return Balance.of(moved(packing, draws, size), Interaction.from_law(law))


def moved(packing: Packing, draws, size: float) -> Packing:
    return packing.displaced(draws.normal(0.0, size, (packing.n, 2)))


def fitted(old: Balance, new: Balance):
    assert np.array_equal(old.held, new.held)
    return old.origin.fitted(new.backbone_contacts, lambda: new.stiffness)


def test_fitted_factors_know_the_contacts_that_changed():
    """What is left is small, so that iterating gains a decade more than the old factors do."""
    old, new = (shaken(LAWS[1], size, squeezed=0.9) for size in (0.0, 6e-3))
    assert 0 < len(np.setxor1d(old.network, new.network)) <= MOST_CHANGED
    force = np.random.default_rng(1).standard_normal(new.force.size)
    exact = new.factor.solve(force)
    error = np.abs(fitted(old, new).solve(force) - exact).max()
    assert error < 0.1 * np.abs(old.factor.solve(force) - exact).max()


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_one_contact_more_or_less_is_solved_exactly(law):
    """The same J but for a contact that is taken out: both ways."""
    old = shaken(law, 0.0)
    less = without_contact(old, 7)
    force = np.random.default_rng(1).standard_normal(old.force.size)
    for one, other in ((old, less), (less, old)):
        fit = one.origin.fitted(other.backbone_contacts, lambda other=other: other.stiffness)
        exact = other.factor.solve(force)
        np.testing.assert_allclose(fit.solve(force), exact, atol=1e-9 * np.abs(exact).max())


def without_contact(balance: Balance, place: int) -> Balance:
    """As it is, one contact left out of its list."""
    kept = np.arange(len(balance.contacts.i)) != place
    contacts = balance.contacts
    s = contacts.spring_state
    less = type(contacts)(
        *(getattr(contacts, name)[kept] for name in ("i", "j", "normal", "distance", "overlap")),
        None if s is None else s[kept],
    )
    return Balance(balance.packing, less, balance.held, balance.interaction)


def test_an_eigenvalue_that_passes_zero_is_noticed():
    """As contact after contact is taken out of a packing that is held by hardly enough."""
    old = shaken(ContactLaw("hertz"), 0.0, squeezed=0.9)
    turned = []
    for place in range(0, len(old.contacts.i), 2):
        less = without_contact(old, place)
        fit = old.origin.fitted(less.backbone_contacts, lambda less=less: less.stiffness)
        turned.append(negative(less) != negative(old))
        assert fit.turned == turned[-1]
    assert 0 < sum(turned) < len(turned)


def negative(balance: Balance) -> int:
    return np.count_nonzero(scipy.linalg.eigvals(balance.matrix.toarray()).real < -1e-9)


def test_too_many_changes_are_not_fitted():
    old, new = shaken(LAWS[1], 0.0), shaken(LAWS[1], 0.03)
    changed = np.setxor1d(old.network, new.network)
    assert len(changed) > MOST_CHANGED
    assert fitted(old, new) is None


def test_a_saddle_is_told_by_inherited_factors_too():
    """A balance with the factors of another one judges its stability as its own factors do."""
    law = ContactLaw("harmonic", "elastic", 0.1)
    for seed in range(4):
        old, new = (shaken(law, size, seed, 1.3) for size in (0.02, 0.021))
        assert new.heir_of(old).unstable == (negative(new) > 0)
