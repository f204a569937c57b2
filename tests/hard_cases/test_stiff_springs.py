"""k_T/k_N = 10 and 1e3: the tangential band outgrows the normal one, and with it the rounding."""

import numpy as np
import pytest

from example_packings import ELASTIC, MINIMAL, elastic, reference
from grainmodes.kernels.damping import Drag
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import step_strain
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.response.mode_sum import mode_sum
from grainmodes.response.moduli import AffineStep, rigidity
from grainmodes.spectrum import Eigenproblem, dense, full_spectrum, packing_spectrum

PACKING = reference(ELASTIC[3])[1]
STIFF = pytest.mark.parametrize("kt", [10.0, 1e3, 1e6])


@pytest.mark.parametrize("kt", [1e3, 1e6])
def test_zero_modes_are_those_of_the_rounding_of_the_matrix(kt):
    """An absolute edge of 1e-14 takes translations of stiff grains for vibrations."""
    eigenproblem = Eigenproblem.from_packing(PACKING, elastic("hertz", kt))
    lapack = dense.eigenvalues(eigenproblem)
    assert np.count_nonzero(np.abs(lapack) < 1e-14) < 2
    found = full_spectrum(eigenproblem, choices=SpectrumChoices("slicing")).eigenvalue
    assert np.count_nonzero(found == 0.0) == 2
    np.testing.assert_allclose(
        found[2:], np.delete(lapack, np.argsort(np.abs(lapack))[:2]), rtol=1e-9
    )


@STIFF
def test_the_unloaded_step_is_no_quadratic_form(kt):
    """g_NA = −aᵀJ⁺a/L² ≤ 0 holds for a loaded step only; the unloaded g_NA is positive here."""
    interaction = elastic("hertz", kt)
    found = rigidity(PACKING, interaction)
    step = AffineStep(PACKING, interaction, loaded=False)
    form = -(step.force.ravel() @ found.unloaded.displacement.ravel()) / PACKING.box_length**2
    assert form < 0.0 < found.unloaded.g_nonaffine
    simulated = step_strain(PACKING, interaction, StepStrain())
    assert simulated.converged
    assert found.unloaded.g == pytest.approx(simulated.g, rel=1e-7)
    assert abs(found.unloaded.g_affine + form - simulated.g) > 0.1 * simulated.g


@STIFF
def test_the_sum_over_modes_is_the_solve(kt):
    interaction = elastic("hertz", kt)
    modes = packing_spectrum(PACKING, interaction)
    for loaded in (False, True):
        direct = getattr(rigidity(PACKING, interaction), "loaded" if loaded else "unloaded").g
        assert mode_sum(PACKING, interaction, modes, loaded=loaded).g == pytest.approx(
            direct, rel=1e-8
        )


def test_a_time_step_that_did_for_weak_springs_is_refused_for_stiff_ones():
    """Δt = 0.1 of B is stable at k_T = k_N, and 40 times the limit at 1e3."""
    packing = reference(MINIMAL[0])[1].sheared(1e-4)
    calm = relax_damped(packing, elastic("hertz", 1.0), Drag(1.0), 0.1, 1e-14, 10_000)
    assert calm.converged
    with pytest.raises(ArithmeticError, match=r"time_step = 0.1: take a shorter one"):
        relax_damped(packing, elastic("hertz", 1e3), Drag(1.0), 0.1, 1e-14, 10_000)
