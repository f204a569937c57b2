"""What fails a sample is a row; what fails the machine ends the job."""

import numpy as np
import pytest
from scipy.sparse.linalg import ArpackError, ArpackNoConvergence

from example_packings import quenched
from grainmodes.kernels.laws import Hertz
from grainmodes.linalg.factorisation import ZeroPivotError
from grainmodes.linalg.failures import FactorisationError, finite
from grainmodes.linalg.pinned_factor import FloppyError
from grainmodes.packing.box import PackingError
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.pair_tracking import tracking
from grainmodes.protocols.pair_tracking.exceptional_points import FAILED
from grainmodes.runtime.failures import MachineError
from grainmodes.stages.complex_pairs import complex_pairs_block
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block

LAW = ContactLaw("hertz", "smoothed_coulomb", 2 / 7, 10.0)

OF_THE_SAMPLE = [
    ArithmeticError("no balance"),
    ZeroDivisionError("float division by zero"),
    ZeroPivotError("a pivot is zero"),
    np.linalg.LinAlgError("SVD did not converge"),
    ArpackNoConvergence("No convergence", np.zeros(0), np.zeros((0, 0))),
    ArpackError(-9999),
    PackingError("position: expected finite numbers"),
]

OF_THE_MACHINE = [
    MemoryError("Unable to allocate 69.2 MiB"),
    ImportError("libmkl_rt.so: cannot open"),
    OSError(28, "No space left on device"),
    FactorisationError("PARDISO is missing"),
    MachineError("a process was killed"),
    KeyboardInterrupt(),
    TypeError("a mistake in the code"),
]


def failing_with(error: BaseException):
    """A block of two samples of which the second fails."""

    def sample(number: int) -> dict[str, object]:
        if number:
            raise error
        return {"converged": True}

    return compute_block(range(2), sample, {"stage": "rigidity"})


@pytest.mark.parametrize("error", OF_THE_SAMPLE, ids=lambda error: type(error).__name__)
def test_a_failure_of_the_sample_is_its_row(error):
    block = failing_with(error)
    assert list(block.attributes["failures"]["rigidity"]) == ["1"]


def test_a_packing_that_is_not_rigid_is_no_failure():
    block = failing_with(FloppyError("a zero mode"))
    assert list(block.attributes["not_rigid"]["rigidity"]) == ["1"]


@pytest.mark.parametrize("error", OF_THE_MACHINE, ids=lambda error: type(error).__name__)
def test_a_failure_of_the_machine_ends_the_job(error):
    with pytest.raises(type(error)):
        failing_with(error)


def test_a_matrix_that_is_not_finite_is_a_failure_of_the_sample():
    with pytest.raises(ArithmeticError, match="expected finite numbers"):
        finite(np.array([1.0, np.nan]))


@pytest.fixture(scope="module")
def packings():
    """A sample that has pairs before a strain of 0.01."""
    row = packing_row(quenched(32, 0.9, seed=1), Hertz(1.0)) | {"converged": True}
    return compute_block([0], lambda number: row, {"n": 32, "phi": 0.9, "stage": "packings"})


def test_states_before_an_eigensolver_that_fails_are_kept(packings, monkeypatch):
    advance = tracking.PairTracking.advance

    def fails_at_the_fourth(self):
        if len(self.records) == 3:
            raise np.linalg.LinAlgError("Eigenvalues did not converge")
        advance(self)

    monkeypatch.setattr(tracking.PairTracking, "advance", fails_at_the_fourth)
    found = complex_pairs_block(packings, LAW, Shear(strain=0.01, step=2e-4), PairChoices())
    assert found.variables["pair_state_count"].tolist() == [3]
    assert "LinAlgError" in found.attributes["failures"]["complex_pairs"]["0"]


@pytest.mark.parametrize("error", [ArithmeticError("none"), np.linalg.LinAlgError("none")])
def test_a_point_whose_search_fails_is_not_called_lost(packings, monkeypatch, error):
    def fails(*arguments):
        raise error

    monkeypatch.setattr(tracking, "locate_exceptional_point", fails)
    shear = Shear(strain=0.01, step=2e-4, force_tolerance=5e-14)
    found = complex_pairs_block(packings, LAW, shear, PairChoices(max_located=1))
    kinds = found.variables["exceptional_point_kind"][0]
    assert len(kinds) and set(kinds) == {FAILED}
    assert found.variables["converged"][0]


def test_memory_that_ends_while_a_point_is_searched_ends_the_job(packings, monkeypatch):
    def fails(*arguments):
        raise MemoryError("Unable to allocate 1 GiB")

    monkeypatch.setattr(tracking, "locate_exceptional_point", fails)
    shear = Shear(strain=0.01, step=2e-4, force_tolerance=5e-14)
    with pytest.raises(MemoryError):
        complex_pairs_block(packings, LAW, shear, PairChoices(max_located=1))
