"""The force balance near another state, the reuse of factors, and stability."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg

from example_packings import LAWS, MINIMAL, crowd, law_name, quenched, reference, with_slip
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.packing.state import nonaffine_motion, rattlers
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.strain_step import first_equilibrium, step_to
from grainmodes.relaxation.equilibrium_search import find_equilibrium
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.relaxation.released_force import force_released_on_opening
from grainmodes.relaxation.reused_factor import MAX_REUSES

B = Interaction.from_law(ContactLaw("harmonic", "elastic", 1.0))
HERTZIAN = Interaction.from_law(ContactLaw("hertz", "elastic", 1.0))
WEAK = Interaction.from_law(ContactLaw("harmonic", "elastic", 0.1))
PACKING = "harmonic_n64_phi0.900_seed1"


def slipping(seed: int, slip: float, squeezed: float = 0.9) -> EquilibriumState:
    """A compressed and shaken packing, its springs stretched at random: not in balance."""
    draws, packing = np.random.default_rng(seed), reference(MINIMAL[1])[1].at(squeezed)
    shaken = packing.displaced(draws.normal(0.0, 0.1 * (squeezed - 0.9), (packing.n, 2)))
    return EquilibriumState.from_packing(with_slip(shaken, draws, slip), WEAK)


def sheared(steps: int, size: float = 1e-4, interaction=B, name: str = PACKING) -> EquilibriumState:
    """The balance after some steps of strain from where friction was switched on."""
    now = find_equilibrium(reference(name)[1], interaction, 1e-14)
    for _ in range(steps):
        strain = now.packing.strain + size
        now = find_equilibrium(now.packing.sheared(strain), interaction, 1e-14, now)
    return now


@pytest.mark.parametrize("law", [ContactLaw("harmonic"), ContactLaw("hertz"), *LAWS], ids=law_name)
def test_forces_balance_and_rattlers_touch_nothing(law):
    interaction = Interaction.from_law(law)
    now = sheared(3, size=1e-6, interaction=interaction, name=f"{law.normal}_n64_phi0.860_seed2")
    contacts = now.packing.contacts
    assert max(max_force_and_torque(net_force(now.packing, interaction))) < 1e-14
    rattler = rattlers(now.packing, 1 if law.frictional else 2)
    np.testing.assert_array_equal(now.backbone_mask, ~rattler)
    assert not np.any(rattler[contacts.i] | rattler[contacts.j])


def test_a_rattler_pushed_against_the_others_is_detached():
    """It carries no load: the others stay where they are, and it touches none of them."""
    packing, interaction = quenched(256, 0.86), HERTZIAN
    rattler = np.flatnonzero(rattlers(packing, 1))[0]
    apart = packing.position - packing.position[rattler]
    apart -= packing.box_length * np.round(apart / packing.box_length)
    gap = np.hypot(*apart.T) - 0.5 * (packing.diameter + packing.diameter[rattler])
    gap[rattler] = np.inf
    nearest = np.argmin(gap)
    push = np.zeros((packing.n, 2))
    push[rattler] = apart[nearest] / np.hypot(*apart[nearest]) * (gap[nearest] + 1e-4)
    pushed = packing.displaced(push)
    assert rattler in np.concatenate([pushed.contacts.i, pushed.contacts.j])
    found = find_equilibrium(pushed, interaction, 1e-14)
    contacts = found.packing.contacts
    assert rattler not in np.concatenate([contacts.i, contacts.j])
    moved = nonaffine_motion(packing, found.packing)
    assert np.abs(np.delete(moved, rattler, axis=0)).max() < 1e-9


def test_reused_factors_solve_as_well_as_new_ones():
    now = sheared(4, size=1e-6)
    assert now.reused is not None
    force = np.random.default_rng(0).standard_normal(now.force.shape)
    force -= force.mean(axis=0) * [1.0, 1.0, 0.0]
    u, fresh = now.solve(force), replace(now, reused=None).solve(force)
    np.testing.assert_allclose(u, fresh, rtol=1e-9, atol=1e-11 * np.abs(fresh).max())


def test_factors_are_renewed_after_a_number_of_states():
    ages = [
        sheared(steps, size=1e-7).factors_for_next.age for steps in (1, MAX_REUSES - 1, MAX_REUSES)
    ]
    assert ages == [2, MAX_REUSES, 1]


def test_factors_of_a_very_different_matrix_are_not_used():
    near, far = sheared(1, size=1e-6), sheared(40, size=1e-3)
    mixed = replace(far, reused=near.factors_for_next)
    force = np.ones(far.force.shape) - [1.0, 1.0, 0.0]
    assert far.backbone_mask.all() and near.backbone_mask.all()
    np.testing.assert_allclose(mixed.solve(force), far.factor.solve(force), rtol=1e-8, atol=1e-9)


def test_the_force_of_a_contact_that_opens_is_reported():
    """Only a harmonic spring without slip still bears a force when its contact opens."""
    packing = crowd(5, slip=0.2)
    contacts = packing.contacts
    apart = packing.at(0.5 * packing.phi)
    s = np.abs(contacts.springs).max()
    for law, force in ((LAWS[3], 0.3 * s), (LAWS[0], 0.0), (LAWS[1], 0.0), (LAWS[5], 0.0)):
        found = force_released_on_opening(apart, Interaction.from_law(law))
        assert found == pytest.approx(force, rel=1e-12, abs=1e-30), law
    assert force_released_on_opening(packing, Interaction.from_law(LAWS[3])) == 0.0


def negative_eigenvalues(state: EquilibriumState) -> int:
    """Number of negative eigenvalues of the dense J."""
    values = scipy.linalg.eigvals(state.matrix.toarray())
    return np.count_nonzero((values.real < -1e-9) & (np.abs(values.imag) < 1e-12))


def test_a_state_with_negative_eigenvalues_is_unstable():
    """With springs stretched at random J has one or several of them; in balance it has none."""
    numbers = []
    for seed in range(12):
        state = slipping(seed, 1.0, squeezed=1.4)
        numbers.append(negative_eigenvalues(state))
        assert state.unstable == (numbers[-1] > 0)
    assert {1, 2} <= set(numbers)
    assert not slipping(0, 1.0, squeezed=0.9).unstable
    assert not sheared(2).unstable


def test_negative_pivots_of_an_asymmetric_matrix_need_not_mean_instability():
    """Hertz contacts about to open: ∂f_T/∂ξ is large, the pivots of a stable J are negative."""
    choices = Shear(step=1e-3)
    now = first_equilibrium(reference("hertz_n64_phi0.860_seed2")[1], HERTZIAN, choices)
    for step in range(1, 41):
        now, _ = step_to(1e-3 * step, now, choices)
    assert now.factor._factor.n_below == 2
    assert negative_eigenvalues(now) == 0
    assert np.linalg.eigvalsh((now.matrix + now.matrix.T).toarray())[0] < -0.1
    assert not now.unstable
