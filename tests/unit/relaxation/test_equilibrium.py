"""The balance next to another one, its factors handed on, and what it tells of stability."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sparse

from example_packings import LAWS, MINIMAL, crowd, law_name, quenched, reference, with_slip
from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.permutations import is_odd
from grainmodes.linalg.factorisation import ZeroPivotError
from grainmodes.linalg.pinned_factor import PinnedFactor
from grainmodes.linalg.superlu import SuperLU
from grainmodes.packing.forces import largest, net_force
from grainmodes.packing.state import nonaffine_motion, rattlers
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.strain_step import first_equilibrium, step_to
from grainmodes.relaxation.equilibrium_search import find_equilibrium
from grainmodes.relaxation.equilibrium_state import (
    MAX_REUSES,
    EquilibriumState,
    force_released_on_opening,
)
from grainmodes.response.stability import lowest_eigenvalue

B = Interaction.from_law(ContactLaw("harmonic", "elastic", 1.0))
HERTZIAN = Interaction.from_law(ContactLaw("hertz", "elastic", 1.0))
WEAK = Interaction.from_law(ContactLaw("harmonic", "elastic", 0.1))
PACKING = "harmonic_n64_phi0.900_seed1"


def slipping(seed: int, slip: float, squeezed: float = 0.9) -> EquilibriumState:
    """A packing squeezed and shaken, its springs stretched at random: no balance."""
    draws, packing = np.random.default_rng(seed), reference(MINIMAL[1])[1].at(squeezed)
    shaken = packing.displaced(draws.normal(0.0, 0.1 * (squeezed - 0.9), (packing.n, 2)))
    return EquilibriumState.from_packing(with_slip(shaken, draws, slip), WEAK)


def sheared(steps: int, size: float = 1e-4, interaction=B, name: str = PACKING) -> EquilibriumState:
    """A balance some steps of strain away from where friction was switched on."""
    now = find_equilibrium(reference(name)[1], interaction, 1e-14)
    for _ in range(steps):
        strain = now.packing.strain + size
        now = find_equilibrium(now.packing.sheared(strain), interaction, 1e-14, now)
    return now


@pytest.mark.parametrize("law", [ContactLaw("harmonic"), ContactLaw("hertz"), *LAWS], ids=law_name)
def test_a_balance_is_one_and_its_loose_grains_touch_nothing(law):
    interaction = Interaction.from_law(law)
    now = sheared(3, size=1e-6, interaction=interaction, name=f"{law.normal}_n64_phi0.860_seed2")
    contacts = now.packing.contacts
    assert max(largest(net_force(now.packing, interaction))) < 1e-14
    loose = rattlers(now.packing, 1 if law.frictional else 2)
    np.testing.assert_array_equal(now.backbone_mask, ~loose)
    assert not np.any(loose[contacts.i] | loose[contacts.j])


def test_a_loose_grain_pushed_against_the_others_is_let_go():
    """It bears nothing: the others stay where they are, and it touches none of them."""
    packing, interaction = (
        quenched(256, 0.86),
        Interaction.from_law(ContactLaw("hertz", "elastic", 1.0)),
    )
    loose = np.flatnonzero(rattlers(packing, 1))[0]
    apart = packing.position - packing.position[loose]
    apart -= packing.box_length * np.round(apart / packing.box_length)
    gap = np.hypot(*apart.T) - 0.5 * (packing.diameter + packing.diameter[loose])
    gap[loose] = np.inf
    nearest = np.argmin(gap)
    push = np.zeros((packing.n, 2))
    push[loose] = apart[nearest] / np.hypot(*apart[nearest]) * (gap[nearest] + 1e-4)
    pushed = packing.displaced(push)
    assert loose in np.concatenate([pushed.contacts.i, pushed.contacts.j])
    found = find_equilibrium(pushed, interaction, 1e-14)
    contacts = found.packing.contacts
    assert loose not in np.concatenate([contacts.i, contacts.j])
    moved = nonaffine_motion(packing, found.packing)
    assert np.abs(np.delete(moved, loose, axis=0)).max() < 1e-9


def test_factors_are_handed_on_and_solve_as_well_as_new_ones():
    now = sheared(4, size=1e-6)
    assert now.reused is not None
    force = np.random.default_rng(0).standard_normal(now.force.shape)
    force -= force.mean(axis=0) * [1.0, 1.0, 0.0]
    u, fresh = now.solve(force), replace(now, reused=None).solve(force)
    np.testing.assert_allclose(u, fresh, rtol=1e-9, atol=1e-11 * np.abs(fresh).max())


def test_factors_grow_old():
    ages = [
        sheared(steps, size=1e-7).factors_for_next.age for steps in (1, MAX_REUSES - 1, MAX_REUSES)
    ]
    assert ages == [2, MAX_REUSES, 1]


def test_factors_of_another_matrix_are_not_believed():
    near, far = sheared(1, size=1e-6), sheared(40, size=1e-3)
    mixed = replace(far, reused=near.factors_for_next)
    force = np.ones(far.force.shape) - [1.0, 1.0, 0.0]
    assert (
        far.backbone_mask.all() == near.backbone_mask.all() is np.True_ or far.backbone_mask.all()
    )
    np.testing.assert_allclose(mixed.solve(force), far.factor.solve(force), rtol=1e-8, atol=1e-9)


def test_a_contact_lost_under_load_is_noticed():
    """Only the harmonic spring without slip still bears a force when it opens."""
    packing = crowd(5, slip=0.2)
    contacts = packing.contacts
    apart = packing.at(0.5 * packing.phi)
    s = np.abs(contacts.displacement).max()
    for law, force in ((LAWS[3], 0.3 * s), (LAWS[0], 0.0), (LAWS[1], 0.0), (LAWS[5], 0.0)):
        found = force_released_on_opening(apart, Interaction.from_law(law))
        assert found == pytest.approx(force, rel=1e-12, abs=1e-30), law
    assert force_released_on_opening(packing, Interaction.from_law(LAWS[3])) == 0.0


def negative_eigenvalues(state: EquilibriumState) -> int:
    """Of the dense J."""
    values = scipy.linalg.eigvals(state.matrix.toarray())
    return np.count_nonzero((values.real < -1e-9) & (np.abs(values.imag) < 1e-12))


def test_a_state_with_negative_eigenvalues_is_unstable():
    """One or several of the dense J, for springs stretched at random; and a balance has none."""
    numbers = []
    for seed in range(12):
        state = slipping(seed, 1.0, squeezed=1.4)
        numbers.append(negative_eigenvalues(state))
        assert state.unstable == (numbers[-1] > 0)
    assert {1, 2} <= set(numbers)
    assert not slipping(0, 1.0, squeezed=0.9).unstable
    assert not sheared(2).unstable
    turned = PinnedFactor(-sheared(1).matrix, symmetric=False)
    assert turned.unstable and turned._factor.n_below == 64 * 3 - 2


def test_negative_pivots_of_a_lopsided_matrix_are_no_instability():
    """Hertz contacts about to open: ∂f_T/∂ξ is large, the pivots of a stable J are negative."""
    choices = Shear(step=1e-3)
    now = first_equilibrium(reference("hertz_n64_phi0.860_seed2")[1], HERTZIAN, choices)
    for step in range(1, 41):
        now, _ = step_to(1e-3 * step, now, choices)
    assert now.factor._factor.n_below == 2
    assert negative_eigenvalues(now) == 0
    assert np.linalg.eigvalsh((now.matrix + now.matrix.T).toarray())[0] < -0.1
    assert not now.unstable


@pytest.mark.parametrize("size", [1, 2, 5, 40])
def test_a_permutation_is_odd_where_its_matrix_has_determinant_minus_one(size):
    for seed in range(10):
        order = np.random.default_rng(seed).permutation(size)
        assert is_odd(order) == (np.linalg.det(np.eye(size)[order]) < 0.0)


def test_pivots_are_sought_where_elimination_in_order_fails(monkeypatch):
    state = slipping(1, 0.5)
    force = np.random.default_rng(1).standard_normal(state.force.size)
    expected = PinnedFactor(state.matrix, symmetric=False)

    def fail(self, values):
        raise ZeroPivotError("a pivot of the factorisation is zero")

    monkeypatch.setattr(SuperLU, "refactor", fail)
    pivoted = PinnedFactor(state.matrix, symmetric=False, reuse_ordering_of=expected)
    assert pivoted.unstable == expected.unstable
    np.testing.assert_allclose(pivoted.solve(force), expected.solve(force), rtol=1e-8, atol=1e-9)
    again = PinnedFactor(state.matrix, symmetric=False, reuse_ordering_of=pivoted)
    np.testing.assert_allclose(again.solve(force), pivoted.solve(force), rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("name", [PACKING, "harmonic_n16_phi0.900_seed1"])
def test_the_lowest_eigenvalue_is_that_of_the_dense_matrix(name):
    state = sheared(5, size=1e-4, name=name)
    values = scipy.linalg.eigvals(state.matrix.toarray())
    values = values[np.argsort(np.abs(values))]
    assert np.abs(values[1]) < 1e-12 < 1e-4 < np.abs(values[2])
    found = lowest_eigenvalue(state.matrix, state.factor, 3)
    assert found == pytest.approx(values[2].real, rel=1e-9)


def test_a_matrix_of_two_translations_alone_has_no_lowest_eigenvalue():
    nothing = sparse.csc_array((2, 2))
    assert np.isnan(lowest_eigenvalue(nothing, None, 2))
