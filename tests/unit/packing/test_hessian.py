"""The effective Hessian against differences of its potential, and against the Jacobian."""

import numpy as np
import pytest

import naive_hessian
from example_packings import ELASTIC, FRICTIONLESS, LAWS, crowd, law_name, pairs_of, reference
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.hessian import STIFFNESSES, effective_hessian
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw


def dense(packing: Packing, law: ContactLaw, stiffness: str = "tangent") -> np.ndarray:
    return effective_hessian(packing, Interaction.from_law(law), stiffness).toarray()


def dynamical(packing: Packing, law: ContactLaw) -> np.ndarray:
    return jacobian(packing, Interaction.from_law(law)).toarray()


@pytest.mark.parametrize(
    ("slip", "stiffness"),
    [(0.0, "tangent"), (0.5, "tangent"), (3.0, "tangent"), (0.5, "printed")],
)
@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_every_law_against_differences_of_the_potential(law, slip, stiffness):
    packing = crowd(51, strain=0.3, slip=slip)
    twin = naive_hessian.effective_hessian(
        law, pairs_of(packing), packing.n, stiffness == "printed"
    )
    np.testing.assert_allclose(dense(packing, law, stiffness), twin, rtol=0, atol=1e-13)


@pytest.mark.parametrize("stiffness", STIFFNESSES)
@pytest.mark.parametrize("law", FRICTIONLESS, ids=law_name)
def test_without_friction_against_differences_of_the_potential(law, stiffness):
    packing = crowd(52, strain=-0.3)
    twin = naive_hessian.effective_hessian(
        law, pairs_of(packing), packing.n, stiffness == "printed"
    )
    blocks = twin.reshape(packing.n, 3, packing.n, 3)
    assert np.all(blocks[:, 2] == 0.0)
    twin = blocks[:, :2, :, :2].reshape(2 * packing.n, -1)
    np.testing.assert_allclose(dense(packing, law, stiffness), twin, rtol=0, atol=1e-13)


@pytest.mark.parametrize("law", LAWS + FRICTIONLESS, ids=law_name)
def test_without_slip_it_is_the_jacobian(law):
    packing = crowd(53, strain=0.3)
    np.testing.assert_allclose(dense(packing, law), dynamical(packing, law), rtol=0, atol=1e-15)


@pytest.mark.parametrize(("name", "kt"), list(zip(ELASTIC[:4], (0.0, 1e-8, 1.0, 0.0), strict=True)))
def test_in_force_balance_it_is_the_jacobian(name, kt):
    packing, law = reference(name)[1], ContactLaw(name.split("_")[0], "elastic", kt)
    np.testing.assert_allclose(dense(packing, law), dynamical(packing, law), rtol=0, atol=1e-15)


@pytest.mark.parametrize("law", LAWS, ids=law_name)
def test_slip_makes_the_jacobian_lose_its_symmetry_and_not_the_hessian(law):
    packing = crowd(54, slip=0.5)
    matrix, other = dense(packing, law), dynamical(packing, law)
    np.testing.assert_allclose(matrix, matrix.T, rtol=0, atol=1e-15)
    assert np.abs(other - other.T).max() > 1e-3
    assert np.abs(matrix - other).max() > 1e-3


@pytest.mark.parametrize("printed", [False, True])
def test_the_printed_sign_of_rotations_changes_no_eigenvalue(printed):
    law, packing = LAWS[0], crowd(55)
    matrices = [
        naive_hessian.effective_hessian(law, pairs_of(packing), packing.n, printed, turn)
        for turn in (1.0, -1.0)
    ]
    assert np.abs(matrices[0] - matrices[1]).max() > 0.1
    values = [np.linalg.eigvalsh(matrix) for matrix in matrices]
    np.testing.assert_allclose(*values, rtol=0, atol=1e-13)


def test_an_unknown_stiffness_is_refused():
    with pytest.raises(ValueError, match="expected one of tangent, printed, got"):
        dense(crowd(56), LAWS[0], "secant")
