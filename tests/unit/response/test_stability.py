"""The lowest eigenvalue of a sheared packing, against the dense matrix."""

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sparse

from example_packings import reference
from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.equilibrium_search import find_equilibrium
from grainmodes.response.stability import lowest_eigenvalue

LAW = ContactLaw("harmonic", "elastic", 1.0)


@pytest.mark.parametrize("name", ["harmonic_n64_phi0.900_seed1", "harmonic_n16_phi0.900_seed1"])
def test_the_lowest_eigenvalue_is_that_of_the_dense_matrix(name):
    state = find_equilibrium(reference(name)[1], Interaction.from_law(LAW), 1e-14)
    for strain in 1e-4 * np.arange(1, 6):
        sheared = state.packing.sheared(strain)
        state = find_equilibrium(sheared, state.interaction, 1e-14, state)
    values = scipy.linalg.eigvals(state.matrix.toarray())
    values = values[np.argsort(np.abs(values))]
    assert np.abs(values[1]) < 1e-12 < 1e-4 < np.abs(values[2])
    found = lowest_eigenvalue(state.matrix, state.factor, 3)
    assert found == pytest.approx(values[2].real, rel=1e-9)


def test_a_matrix_of_two_translations_alone_has_no_lowest_eigenvalue():
    empty = sparse.csc_array((2, 2))
    assert np.isnan(lowest_eigenvalue(empty, None, 2))
