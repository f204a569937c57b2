"""What a scene does not call for is neither computed nor stored."""

import re

import numpy as np
import pytest
import scipy.linalg

from example_packings import BACKENDS, quenched
from grainmodes.kernels.dynamics import integrate
from grainmodes.kernels.fire import fire
from grainmodes.kernels.laws import Hertz, Interaction
from grainmodes.kernels.neighbours import find_neighbours
from grainmodes.kernels.repulsion import add_forces
from grainmodes.linalg import pinned_factor
from grainmodes.packing import forces, jacobian
from grainmodes.packing.contacts import Contacts, History
from grainmodes.packing.forces import net_force
from grainmodes.packing.hessian import effective_hessian
from grainmodes.packing.state import Packing
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.parameters.strain import Shear, StepStrain
from grainmodes.protocols.compression.trajectory import (
    compress_along_grid,
    compress_to,
    place_at_random,
)
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.protocols.shear.step_strain import step_strain
from grainmodes.relaxation import newton
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import (
    Eigenproblem,
    average_in_bins,
    dense,
    full_spectrum,
    slice_eigenpairs,
)

NO_FRICTION = Interaction.from_law(ContactLaw())
FRICTION = Interaction.from_law(ContactLaw(kt=1e-2))
EDGES = np.array([1e-6, 0.1, 0.5, 1.0, 3.0])
PLACES = {"x", "y", "vx", "vy", "fx", "fy", "origin_x", "origin_y", "diameter", "inverse_mass"}
"""Arrays of FIRE over the grains."""

PAIRS = {"left", "right", "contact_distance"}
"""Arrays of its inner loop over the pairs."""


def refuse(monkeypatch, *places) -> None:
    """Let every attribute (owner, name) raise when it is called."""

    def refused(*arguments, **names):
        raise AssertionError("not called for")

    for owner, name in places:
        monkeypatch.setattr(owner, name, refused)


def arrays_of(kernel) -> set[str]:
    """Names of the arrays in the compiled code of a kernel, whatever types it was compiled for."""
    code = "".join(str(each.type_annotation) for each in kernel.overloads.values())
    made_or_passed = r"#\s+(\w+)(?:\.\d+)? = .* :: (?:\(.*\) -> )?array\("
    return set(re.findall(made_or_passed, code))


def test_fire_holds_no_rotation_torque_or_history():
    compress_along_grid(
        place_at_random(16, 0, Hertz(1.0), Compression()), 0.8, Hertz(1.0), Compression()
    )
    assert arrays_of(fire) == PLACES
    laws = {str(types[6]) for types in fire.overloads}
    assert laws <= {"Hertz(float64 x 1)", "Harmonic(float64 x 1)"}


def test_frictionless_forces_read_positions_and_pairs_and_write_forces():
    packing, force = quenched(16, 0.9), np.zeros((2, 16))
    state = *packing.fraction, packing.diameter, packing.box_length, 0.0
    pairs = find_neighbours(*state, 0.2)
    add_forces(*packing.fraction, packing.box_length, None, pairs, Hertz(1.0), *force)
    assert arrays_of(add_forces) == {"x", "y", "force_x", "force_y"} | PAIRS


def test_the_look_into_compiled_code_sees_a_history():
    run = QuasistaticRun.from_packing(quenched(16, 0.9), FRICTION, Shear(1e-4, relaxation="damped"))
    run.advance()
    assert "spring" in arrays_of(integrate)


TANGENTIAL = (
    (History, "__init__"),
    (forces, "contact_forces"),
    (jacobian, "contact_stiffness"),
    (newton, "advance_springs"),
    (newton, "clip_springs"),
)


def test_without_friction_nothing_tangential_is_touched(monkeypatch):
    refuse(monkeypatch, *TANGENTIAL)
    normal, protocol = Hertz(1.0), Compression(phi_step=1e-3)
    start = compress_along_grid(place_at_random(16, 1, normal, protocol), 0.9, normal, protocol)
    packing = compress_to(start, 0.9, normal, protocol).packing
    assert net_force(packing, NO_FRICTION).shape == (16, 2)
    assert rigidity(packing, NO_FRICTION).unloaded.displacement.shape[1] == 2
    assert step_strain(packing, NO_FRICTION, StepStrain()).converged
    assert Eigenproblem.from_packing(packing, NO_FRICTION).k == 2
    run = QuasistaticRun.from_packing(packing, NO_FRICTION, Shear(1e-3))
    while not run.done:
        run.advance()
    for state in (packing, run.state.equilibrium.packing):
        assert state.rotation is None and state.history is None


def test_springs_never_loaded_are_not_stored_and_take_the_symmetric_way(monkeypatch):
    packing = quenched(36, 0.92)
    general = ((pinned_factor, "_GeneralFactor"), (scipy.linalg, "eig"), (scipy.linalg, "eigvals"))
    refuse(monkeypatch, (History, "__init__"), *general)
    monkeypatch.setattr(Contacts, "springs", property(None))
    contacts = packing.contacts
    assert contacts.spring_state is None
    assert net_force(packing, FRICTION).shape == (36, 3)
    assert np.isfinite(rigidity(packing, FRICTION).loaded.g)
    eigenproblem = Eigenproblem.from_packing(packing, FRICTION)
    assert eigenproblem.symmetric and eigenproblem.k == 3
    for modes in (False, True):
        assert full_spectrum(eigenproblem, modes).eigenvalue.dtype == float
    assert effective_hessian(packing, FRICTION).shape == (108, 108)


def test_a_packing_is_its_places_and_sizes():
    packing = quenched(36, 0.92)
    assert bytes_of(packing) == 32 * 36
    assert packing.rotation is None and packing.history is None


def bytes_of(packing: Packing) -> int:
    held = (packing.fraction, packing.diameter, packing.mass)
    return sum(array.nbytes for array in held)


VECTORS = (
    (dense, "eigenpairs"),
    (slice_eigenpairs, "eigenpairs_in_slice"),
    (slice_eigenpairs, "nearest_eigenpairs"),
)


@pytest.mark.parametrize("interaction", [NO_FRICTION, FRICTION], ids=["frictionless", "frictional"])
@pytest.mark.parametrize("method", ["dense", "inertia_counts"])
@pytest.mark.parametrize("backend", BACKENDS)
def test_counts_need_no_eigenvector(monkeypatch, interaction, method, backend):
    eigenproblem, choices = (
        Eigenproblem.from_packing(quenched(36, 0.92), interaction),
        SpectrumChoices(method, backend),
    )
    by_vectors = average_in_bins(eigenproblem, EDGES, True, choices).count
    refuse(monkeypatch, *VECTORS)
    found = average_in_bins(eigenproblem, EDGES, False, choices)
    np.testing.assert_array_equal(found.count, by_vectors)
    assert found.psi_rotational is None and found.participation_ratio is None
    with pytest.raises(AssertionError, match="not called for"):
        average_in_bins(eigenproblem, EDGES, True, choices)


def test_eigenvalues_need_no_eigenvector(monkeypatch):
    eigenproblem = Eigenproblem.from_packing(quenched(36, 0.92), FRICTION)
    refuse(monkeypatch, *VECTORS)
    found = full_spectrum(eigenproblem, modes=False)
    assert len(found.eigenvalue) == eigenproblem.size
    assert found.modes is None and found.psi_rotational is None
