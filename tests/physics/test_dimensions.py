"""Every stored number moves by the powers of k_N, d and m that its unit states.

Each stage runs on one packing of 16 grains in units of k_N = m = d = 1, and once more after k_N, d
or m alone has become larger (`rescaled`).
"""

from dataclasses import replace
from functools import cache
from importlib import import_module
from unittest.mock import patch

import numpy as np
import pytest

from grainmodes.dataset import VARIABLES
from grainmodes.dataset.files import Block
from grainmodes.dataset.units import NUMBER
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.stages import STAGES
from rescaled import TO_A_PAIR, TO_AN_EVENT, RescaledSystem

WITHOUT_MASS = {"bin_edge", "frequency_requested", "frequency_found"}
"""J knows no masses: these are frequencies of grains whose mass is the unit of mass."""

PRINTED = {"bin_count_hessian_printed", "hessian_printed_difference"}
"""(H2) as printed adds k_N to stiffnesses; they have one unit under the harmonic law alone."""

COORDINATES = {"n", "phi", "kt", "mode"}
TRAJECTORY = {"phi_jamming", "iterations", "step"}
NUMBERS = COORDINATES | TRAJECTORY
"""Numbers of a point and of a trajectory, all of unit 1, that no block here holds."""

FROM_ELSEWHERE = {"spring_state"}
"""Only packings compressed with friction, and of other codes, have it; its unit is that of
`event_spring_state_before`."""

ROUND_OFF = {"rate_difference": 1e-6}
"""Largest value of numbers that are the error of a method, and so have no digit of their own."""

RTOL = 0.2
"""A wrong power changes a number by a factor of 2 at least; a released state is chaotic."""

FROM_PACKINGS = {name for name, stage in STAGES.items() if not stage.observable}
"""Stages that make packings; their rows are those of `packings` here."""

CASES = {
    "packings": "",
    **{name: name for name in STAGES if name not in FROM_PACKINGS},
    "spectrum, slicing": "spectrum",
    "spectrum, averages": "spectrum",
    "spectrum with springs": "spectrum",
    "shear, springs of forces": "shear",
    "claim_diagnostics, damped": "claim_diagnostics",
}
"""What is compared → the stage that computes it."""

STRAINED = {
    **dict.fromkeys(("shear", "shear, springs of forces", "event_detail"), TO_AN_EVENT),
    **dict.fromkeys(("complex_pairs", "law_comparison"), dict.fromkeys(TO_AN_EVENT, TO_A_PAIR)),
}
OBSERVABLES = {
    "spectrum": "modes",
    "coarse_run": True,
}


def springs(system: RescaledSystem) -> Block:
    """The state to release of `complex_pairs` as a packing with springs."""
    row = {name: array[0] for name, array in block(system, "complex_pairs").variables.items()}
    names = ("fraction", "strain", "contact_i", "contact_j", "spring_state")
    state = {name: row[f"unstable_{name}"][0] for name in names}
    grains = {name: row[name] for name in ("diameter", "mass", "box_length")}
    return system.block(state | grains)


def block(system: RescaledSystem, case: str) -> Block:
    """What a case computes."""
    if case == "packings":
        return system.packings()
    stage = STAGES[CASES[case]]
    protocol = system.protocol(*STRAINED.get(case, {}).get(system.law.normal, ()))
    observables = OBSERVABLES
    if case == "spectrum, slicing":
        protocol = replace(protocol, spectrum=replace(protocol.spectrum, method="slicing"))
    if case == "spectrum, averages":
        protocol = replace(protocol, spectrum=replace(protocol.spectrum, method="inertia_counts"))
        observables = observables | {"spectrum": "binned_averages"}
    if stage.reads == "complex_pairs":
        start = block(system, "complex_pairs")
    else:
        start = springs(system) if case == "spectrum with springs" else system.packings()
    module, _, function = stage.function.partition(":")
    run = getattr(import_module(module), function)
    return run(start, system.law, **stage.keywords(protocol, observables))


@cache
def computed(normal: str, case: str, scale: str) -> tuple[RescaledSystem, Block]:
    """The block of a case, and the system that it belongs to."""
    system = RescaledSystem(ContactLaw(normal, "smoothed_coulomb", 0.3, 10.0), scale)
    if case == "shear, springs of forces":
        system.law = ContactLaw(normal, "elastic_force", 0.3)
    if case == "claim_diagnostics, damped":  # which strong friction alone can afford
        system.law = replace(system.law, kt=1.0)
    with system.in_force(), patch("grainmodes.protocols.law_comparison.comparison.N_STATES", 1):
        found = block(system, case)
    assert found.variables["converged"].all(), found.attributes["failures"]
    return system, found


@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("scale", ["k_N", "d", "m"])
def test_numbers_move_as_their_units_state(normal, case, scale):
    _, plain = computed(normal, case, "none")
    system, rescaled = computed(normal, case, scale)
    assert set(rescaled.variables) == set(plain.variables)
    for name, values in plain.variables.items():
        if name in PRINTED and normal == "hertz":
            continue
        unit, found = VARIABLES[name].unit, rescaled.variables[name]
        if unit.symbol == "2^-64 L":
            found, values = found * 2.0**-64, values * 2.0**-64
        expected = values * system.factor(unit, mass=name not in WITHOUT_MASS)
        largest = np.max(np.abs(expected), where=np.isfinite(expected), initial=0.0)
        rounding = ROUND_OFF.get(name, 1e-12) if unit == NUMBER else 0.0
        np.testing.assert_allclose(
            found, expected, rtol=0.0, atol=RTOL * largest + rounding, err_msg=name
        )


def test_every_variable_is_covered():
    blocks = [computed(normal, case, "none")[1] for normal in TO_AN_EVENT for case in CASES]
    found = {name for block in blocks for name in block.variables}
    assert set(VARIABLES) - found == NUMBERS | FROM_ELSEWHERE
    assert all(VARIABLES[name].unit == NUMBER for name in NUMBERS)
    assert VARIABLES["spring_state"].unit == VARIABLES["event_spring_state_before"].unit
