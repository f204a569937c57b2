"""Names of the rigidity, in theory and in simulation."""

from __future__ import annotations

from grainmodes.dataset.units import FORCE, MODULUS, NUMBER
from grainmodes.dataset.variable import BLOCK, Variable

NAMES = {
    # rigidity, theory
    "g": Variable(BLOCK, "f8", MODULUS, "rigidity under an unloaded step strain"),
    "g_affine": Variable(BLOCK, "f8", MODULUS, "affine part of g"),
    "g_nonaffine": Variable(BLOCK, "f8", MODULUS, "non-affine part of g"),
    "g_loaded": Variable(
        BLOCK, "f8", MODULUS, "rigidity when the affine step strain loads the tangential springs"
    ),
    "g_affine_loaded": Variable(BLOCK, "f8", MODULUS, "affine part of g_loaded"),
    "g_nonaffine_loaded": Variable(BLOCK, "f8", MODULUS, "non-affine part of g_loaded"),
    # rigidity, simulation
    "g_simulated": Variable(
        BLOCK, "f8", MODULUS, "rigidity from relaxed step strains forward and backward"
    ),
    "g_simulated_forward": Variable(
        BLOCK, "f8", MODULUS, "rigidity from the forward step strain alone, as in paper A"
    ),
    "g_simulated_error": Variable(
        BLOCK,
        "f8",
        MODULUS,
        "difference between g_simulated and its value for a step ten times larger",
    ),
    "strain_simulated": Variable(BLOCK, "f8", NUMBER, "size of the step strain of g_simulated"),
    "iterations_simulated": Variable(
        BLOCK, "i8", NUMBER, "iterations of the relaxation of the step strains"
    ),
    "max_force_simulated": Variable(
        BLOCK, "f8", FORCE, "largest force component left after the step strains"
    ),
    "max_torque_simulated": Variable(
        BLOCK, "f8", FORCE, "largest scaled torque 2 T / d left after the step strains"
    ),
    "contact_changes": Variable(
        BLOCK, "i8", NUMBER, "number of contacts that the relaxed step strain opened or closed"
    ),
}
