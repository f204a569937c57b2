"""What no schema can say of the contact law and the numerical choices of a scene or a stage."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from grainmodes.parameters.grid import CHECKPOINT_SPACING, LOWEST_CHECKPOINT
from grainmodes.parameters.law import COULOMB_LAWS, ELASTIC_LAWS
from grainmodes.runtime import pardiso


def choice_conflicts(config: dict, stiffnesses: Iterable[float]) -> Iterator[str]:
    """One sentence per conflict in complete blocks `contact_law` and `protocol`.

    `stiffnesses` are the k_T/k_N at which they are used.
    """
    for rule in (_coulomb, _steps, _shear, _pardiso):
        yield from rule(config)
    if config["protocol"]["step_strain"]["relaxation"] == "damped" and 0.0 in stiffnesses:
        yield (
            "protocol.step_strain.relaxation: expected 'newton' because at kt = 0 grains do not "
            "rotate, got 'damped'"
        )


def _coulomb(config: dict) -> Iterator[str]:
    law = config["contact_law"]
    name, mu = law["tangential"], law["friction_coefficient"]
    if name in ELASTIC_LAWS and mu is not None:
        yield (
            f"contact_law.friction_coefficient: expected none for the tangential law {name!r} "
            f"(only {', '.join(COULOMB_LAWS)} have one), got {mu}"
        )
    if name in COULOMB_LAWS and mu is None:
        yield (
            "contact_law.friction_coefficient: expected a number above 0 for the tangential law "
            f"{name!r}, got none"
        )


def _steps(config: dict) -> Iterator[str]:
    compression = config["protocol"]["compression"]
    step, start = compression["phi_step"], compression["initial_phi"]
    if not _whole(CHECKPOINT_SPACING / step):
        yield (
            "protocol.compression.phi_step: expected a step that divides "
            f"{CHECKPOINT_SPACING}, such as 1e-4, got {step}"
        )
    elif not _whole((LOWEST_CHECKPOINT - start) / step):
        yield (
            "protocol.compression.initial_phi: expected a value that lies a whole number of "
            f"steps of {step} below {LOWEST_CHECKPOINT}, got {start}"
        )


def _shear(config: dict) -> Iterator[str]:
    shear = config["protocol"]["shear"]
    strain, step, smallest = shear["strain"], shear["step"], shear["min_step"]
    if not _whole(strain / step):
        yield f"protocol.shear.strain: expected a whole number of steps of {step}, got {strain}"
    if step < smallest or not _whole(math.log10(step / smallest)):
        yield (
            f"protocol.shear.min_step: expected {step} divided by 1, 10, 100 and so on, "
            f"got {smallest}"
        )


def _pardiso(config: dict) -> Iterator[str]:
    """A library that is missing is a mistake of the scene on this machine, before it starts."""
    if config["protocol"]["spectrum"]["factorisation"] == "pardiso" and pardiso.problem():
        yield f"protocol.spectrum.factorisation: {pardiso.problem()}"


def _whole(ratio: float) -> bool:
    return abs(ratio - round(ratio)) < 1e-6 * max(ratio, 1.0)
