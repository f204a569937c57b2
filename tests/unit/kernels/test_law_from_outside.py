"""A contact law that the package does not know: its functions, and all else follows."""

import math
import os
import subprocess
import sys
from typing import NamedTuple

import numpy as np
import pytest

from example_packings import crowd, quenched
from grainmodes.kernels import laws
from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws import (
    Elastic,
    Frictionless,
    Hertz,
    Interaction,
    normal_response,
    tangential_response,
    tangential_scale,
)
from grainmodes.packing.forces import forces_on_i, net_force
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import step_strain
from grainmodes.relaxation.newton import displace_with_springs, newton
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import Eigenproblem, packing_spectrum


class Logistic(NamedTuple):
    """f_T = −μ f_N tanh x, x = k_T w(ξ) s / μ f_N: Coulomb's force along a logistic curve."""

    stiffness: float
    friction_coefficient: float


@implements(tangential_response, Logistic)
def _logistic(tangential, normal, overlap, displacement):
    force, slope = normal_response(normal, overlap)
    scale, bend = tangential_scale(normal, overlap)
    limit = tangential.friction_coefficient * force
    x = tangential.stiffness * scale * displacement / limit
    curve, steepness = math.tanh(x), 1.0 - math.tanh(x) ** 2
    by_overlap = -limit * steepness * x * (bend / scale - slope / force)
    by_overlap -= tangential.friction_coefficient * slope * curve
    return -limit * curve, -tangential.stiffness * scale * steepness, by_overlap


class Sticky(NamedTuple):
    """f_N = k_N ξ^(3/2) − a ξ^(3/4): Hertz's force with an adhesion as in JKR's."""

    stiffness: float
    adhesion: float


@implements(normal_response, Sticky)
def _sticky(normal, overlap):
    root, glue = math.sqrt(overlap), normal.adhesion * math.sqrt(math.sqrt(overlap))
    slope = 1.5 * normal.stiffness * root - 0.75 * glue / root
    return normal.stiffness * overlap * root - glue * root, slope


@implements(tangential_scale, Sticky)
def _sticky_scale(normal, overlap):
    return math.sqrt(overlap), 0.5 / math.sqrt(overlap)


def logistic_force(overlap, s):
    """(f_N, f_T) of the first law below, the slow way."""
    return overlap**1.5, -0.4 * overlap**1.5 * (2 / (1 + np.exp(-1.5 * s / overlap)) - 1)


def sticky_force(overlap, s):
    """(f_N, f_T) of the second."""
    return overlap**1.5 - 1e-3 * overlap**0.75, -0.3 * overlap**0.5 * s


OUTSIDE = {
    "logistic": (Interaction(Hertz(1.0), Logistic(0.3, 0.4)), logistic_force),
    "sticky": (Interaction(Sticky(1.0, 1e-3), Elastic(0.3)), sticky_force),
}
each_law = pytest.mark.parametrize("name", OUTSIDE)
each_slip = pytest.mark.parametrize("slip", [0.0, 1.0])


def differences(packing: Packing, interaction: Interaction, h: float = 1e-6) -> np.ndarray:
    """−∂F̃/∂q, dense (3N, 3N), by central differences of the net forces."""
    columns = []
    for u in np.eye(3 * packing.n).reshape(-1, packing.n, 3):
        ahead, behind = (
            displace_with_springs(packing, interaction, way * h * u) for way in (1, -1)
        )
        forces = (net_force(each, interaction) for each in (ahead, behind))
        columns.append(-np.subtract(*forces).ravel() / (2 * h))
    return np.array(columns).T


def balanced(interaction: Interaction, strain: float) -> Packing:
    """A packing in balance under the law, its springs loaded by a strain if there is one."""
    relaxed = newton(quenched(36, 0.92), Interaction(interaction.normal, Frictionless()), 1e-14)
    if strain:
        relaxed = newton(relaxed.packing.sheared(strain), interaction, 1e-14, 40)
    assert relaxed.converged
    return relaxed.packing


@each_law
@each_slip
def test_its_forces_are_those_written_down(name, slip):
    interaction, formula = OUTSIDE[name]
    contacts = crowd(51, slip=slip).contacts
    f_n, f_t = formula(contacts.overlap, contacts.springs)
    written = f_n[:, None] * contacts.normal + f_t[:, None] * contacts.tangent
    np.testing.assert_allclose(forces_on_i(contacts, interaction), np.c_[written, f_t], rtol=1e-12)


@each_law
@each_slip
def test_its_jacobian_is_central_differences_of_the_forces(name, slip):
    interaction, packing = OUTSIDE[name][0], crowd(52, strain=0.2, slip=slip)
    matrix = jacobian(packing, interaction).toarray()
    np.testing.assert_allclose(matrix, differences(packing, interaction), atol=2e-9)
    assert (np.abs(matrix - matrix.T).max() > 1e-3) == (slip > 0.0)


@each_law
@each_slip
def test_its_spectrum_is_that_of_the_differences(name, slip):
    interaction, packing = OUTSIDE[name][0], crowd(53, slip=slip)
    found = packing_spectrum(packing, interaction, keep_rattlers=True)
    expected = np.sort_complex(np.linalg.eigvals(differences(packing, interaction)))
    np.testing.assert_allclose(np.sort_complex(found.eigenvalue), expected, atol=1e-7)
    assert found.residual < 1e-13
    if not slip:
        below = (
            Eigenproblem.from_packing(packing, interaction, keep_rattlers=True)
            .symmetric_shift()
            .factor_at(0.25)
            .n_below
        )
        assert below == np.count_nonzero(expected.real < 0.25)


@each_law
@pytest.mark.parametrize("strain", [0.0, 1e-3])
def test_its_rigidity_is_that_of_a_step_strain(name, strain):
    interaction = OUTSIDE[name][0]
    packing = balanced(interaction, strain)
    # With friction a grain of two contacts carries a load.
    simulated = step_strain(packing, interaction, StepStrain(), threshold=1)
    assert simulated.converged
    assert rigidity(packing, interaction, threshold=1).unloaded.g == pytest.approx(
        simulated.g, rel=1e-8
    )


def test_a_line_in_the_table_names_it(monkeypatch):
    monkeypatch.setitem(laws.TANGENTIAL, "logistic", Logistic)
    interaction = Interaction.from_law(ContactLaw("hertz", "logistic", 0.3, 0.4))
    assert interaction == OUTSIDE["logistic"][0] and type(interaction.tangential) is Logistic


EDITED = """
from typing import NamedTuple
import numpy as np
from grainmodes.kernels.compiler import implements
from grainmodes.kernels.contacts import contact_forces
from grainmodes.kernels.laws import Hertz, Interaction, tangential_response

class Spring(NamedTuple):
    stiffness: float

@implements(tangential_response, Spring)
def _spring(tangential, normal, overlap, displacement):
    return -{factor} * displacement, -{factor}, 0.0

one = np.ones(1)
print(contact_forces(Interaction(Hertz(1.0), Spring(1.0)), np.eye(2)[:1], one, one)[0, 2])
"""


def test_an_edit_of_it_is_seen_by_the_next_run(tmp_path):
    """numba's cache on disk knows a law by its name alone."""
    path = os.pathsep.join([str(tmp_path), *sys.path])
    variables = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "cache"), "PYTHONPATH": path}
    for factor in ("1.0", "5.0"):
        (tmp_path / "law.py").write_text(EDITED.format(factor=factor))
        run = [sys.executable, "-c", "import law"]
        said = subprocess.run(run, env=variables, capture_output=True, text=True, check=True)
        assert float(said.stdout) == -float(factor)
