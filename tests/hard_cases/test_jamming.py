"""φ just above, at and below jamming: the mean contact force falls through F_Th = 1e-14.

A packing is loosened in ever smaller steps of φ until it no longer bears a load. Every relaxation
on the way reaches F_Th; in the last steps there are contacts and pressure on both sides.
"""

import numpy as np
import pytest

from example_packings import ELASTIC, reference
from grainmodes.kernels.laws import Hertz, Interaction
from grainmodes.packing.forces import max_force_and_torque, mean_contact_force, net_force, stress
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import step_strain
from grainmodes.relaxation.frictionless import relax_fire_large_steps, relax_fire_newton
from grainmodes.response.moduli import rigidity
from grainmodes.stages.packing_rows import is_jammed, packing_row
from grainmodes.stages.rigidity import rigidity_block
from grainmodes.stages.rows import compute_block

FREE = Interaction.from_law(ContactLaw())
LAW = ContactLaw(kt=1e-2)
BUDGET = 200_000


def jammed(packing: Packing) -> bool:
    return is_jammed(packing, FREE, max_force_and_torque(net_force(packing, FREE))[0])


def load(packing: Packing) -> float:
    """Mean contact force."""
    return mean_contact_force(packing, FREE)


def pressure(packing: Packing) -> float:
    return -float(np.trace(stress(packing, FREE)))


def loosened(finest: float) -> tuple[Packing, list[Packing]]:
    """The last packing that is jammed, to `finest` in φ, and those just below it, nearest last."""
    above, phi, step, below = reference(ELASTIC[2])[1], 0.86, 1e-3, []
    while step > 0.9 * finest:
        relaxed = relax_fire_newton(above.at(phi - step), Hertz(1.0), 1e-14, BUDGET)
        assert relaxed.converged
        if jammed(relaxed.packing):
            above, phi = relaxed.packing, phi - step
        else:
            below.append(relaxed.packing)
            step *= 0.1
    return above, below


@pytest.fixture(scope="module")
def around() -> tuple[Packing, list[Packing]]:
    return loosened(1e-9)


def test_just_above_jamming_the_balance_is_that_of_the_contacts():
    """An absolute 1e-10 is a thirteenth of f̄ here: the naive relaxation does not even start."""
    above = loosened(1e-5)[0]
    assert 1e-10 < load(above) < 1e-8
    denser = above.at(above.phi + 1e-7)
    naive = relax_fire_large_steps(denser, Hertz(1.0), 1e-10, 0.0, BUDGET)
    found = relax_fire_newton(denser, Hertz(1.0), 1e-14, BUDGET)
    assert naive.converged and naive.iterations == 0 and found.converged
    assert abs(load(naive.packing) / load(found.packing) - 1.0) > 0.005
    assert found.max_force < 1e-5 * load(found.packing)
    theory = rigidity(above, Interaction.from_law(LAW)).unloaded.g
    simulated = step_strain(above, Interaction.from_law(LAW), StepStrain()).g
    assert theory == pytest.approx(simulated, rel=1e-5)


def test_at_jamming_contacts_and_pressure_make_no_solid(around):
    """An isostatic number of contacts, P > 0, max|F| < F_Th: and yet only what a balance leaves."""
    last, below = around
    simulated = step_strain(last, Interaction.from_law(LAW), StepStrain()).g
    assert rigidity(last, Interaction.from_law(LAW)).unloaded.g == pytest.approx(
        simulated, rel=0.02
    )
    pressed = [packing for packing in below if pressure(packing) > 0.0]
    isostatic = [p for p in pressed if len(p.contacts.i) >= 2 * p.n - 3]
    assert len(pressed) >= 3 and isostatic
    assert not any(jammed(packing) for packing in pressed)
    rows = rigidity_block(as_block(pressed), LAW, Rattlers()).variables
    assert np.all(rows["g"] == 0.0) and np.all(rows["converged"]) and not np.any(rows["jammed"])


def test_below_jamming_nothing_touches(around):
    free = [packing for packing in around[1] if not len(packing.contacts.i)]
    assert free
    matrix = jacobian(free[0], Interaction.from_law(LAW)).toarray()
    with pytest.raises(np.linalg.LinAlgError):
        np.linalg.solve(matrix[2:, 2:], np.ones(len(matrix) - 2))
    rows = rigidity_block(as_block(free), LAW, Rattlers()).variables
    assert np.all(rows["g"] == 0.0) and np.all(rows["converged"]) and not np.any(rows["jammed"])


def as_block(packings: list[Packing]):
    rows = [packing_row(packing, Hertz(1.0)) | {"converged": True} for packing in packings]
    return compute_block(range(len(rows)), rows.__getitem__, {"n": packings[0].n, "phi": 0.833})
