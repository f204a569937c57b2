"""Single or double precision where there is a choice: forces of FIRE, velocities of dynamics.

Positions are integers of 64 bits in any case, so that a difference of two is exact. In numbers of
p bits a distance r ~ d is rounded to 2^-p d, and so is the overlap ξ = (d_i + d_j)/2 − r, whose
relative error 2^-p d/ξ becomes that of the force. Three kernels are tried in the loop of FIRE:

| curve                     | r, ξ   | forces, velocities | p of the forces |
| ------------------------- | ------ | ------------------ | --------------- |
| FIRE                      | single | single             | 24              |
| FIRE                      | double | double             | 53, as shipped  |
| FIRE with double overlaps | double | single             | 24              |

and the shipped kernel of frictional dynamics, with velocities, rotations and net forces kept in
either precision (contacts are computed, and springs kept, in double). Measured are

    forces     root mean square of F − F_exact over grains, / f̄ (mean contact force)
    max|F|     its value when it no longer falls, / f̄, evaluated in double
    g          |g/g_ref − 1| of the state so reached; dynamics: of a simulated step strain

Reference: forces in extended precision; the balance, or the step, by Newton's method to 1e-14.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Frictionless, Interaction
from grainmodes.packing.forces import max_force_and_torque, mean_contact_force, net_force, stress
from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import forward_rigidity
from grainmodes.response.moduli import rigidity
from grainmodes.stages.packing_rows import is_jammed
from measurements.accuracy.diagram import (
    Diagram,
    DiagramRow,
    Size,
    TimedError,
    in_fresh_process,
    size_suffix,
    summarise,
    timed,
)
from measurements.accuracy.loops import ROUGH, Precision, after_dynamics, after_fire, exact_forces
from measurements.accuracy.packings import HERTZ, compressed

PHI_DENSE, PHI_NEAR_JAMMING = 0.9, 0.85
"""φ far from jamming and near it, where overlaps are small."""

SMOOTH = Interaction(HERTZ, Frictionless())

START_DISPLACEMENT = 1e-6
"""Random displacement from a balance in d, at which FIRE starts."""

STRAIN = 1e-4
"""Step strain after which dynamics relaxes."""

N_STEPS = 50_000
"""Steps after which max|F| no longer falls."""


class Errors(NamedTuple):
    """CPU seconds of 10⁹ grain steps, and the errors; `forces` is NaN where it is not measured."""

    seconds: float
    forces: float
    floor: float
    g: float


def fire_errors(packing: Packing, precision: Precision) -> Errors:
    """Errors of FIRE that returns to a balance from a small random displacement."""
    beside = packing.displaced(
        START_DISPLACEMENT * np.random.default_rng(0).standard_normal((packing.n, 2))
    )
    unit = mean_contact_force(packing, SMOOTH)
    _, seen = after_fire(beside, precision, 0)
    wrong = np.sqrt(np.mean((seen - exact_forces(beside)) ** 2))
    (after, _), seconds = timed(after_fire, beside, precision, N_STEPS)
    exact, found = (rigidity(state, ROUGH).unloaded.g for state in (packing, after))
    return _errors(seconds, wrong / unit, residual(after, SMOOTH) / unit, found / exact, packing.n)


def dynamics_errors(packing: Packing, precision: Precision) -> Errors:
    """Errors of damped dynamics after a step strain, as A simulates g."""
    unit = mean_contact_force(packing, SMOOTH)
    after, seconds = timed(after_dynamics, packing.sheared(STRAIN), precision.force, N_STEPS)
    exact = forward_rigidity(packing, ROUGH, StepStrain(strain=STRAIN))
    before, strained = (stress(p, ROUGH)[0, 1] for p in (packing, after))
    found = (strained - before) / STRAIN
    return _errors(seconds, math.nan, residual(after, ROUGH) / unit, found / exact, packing.n)


def _errors(seconds: float, forces: float, floor: float, ratio: float, n: int) -> Errors:
    return Errors(seconds / (N_STEPS * n) * 1e9, float(forces), floor, abs(ratio - 1.0))


def residual(packing: Packing, interaction: Interaction) -> float:
    """max|F̃| in double precision."""
    return max(max_force_and_torque(net_force(packing, interaction)))


SINGLE, DOUBLE = Precision(np.float32, np.float32), Precision(np.float64, np.float64)
MIXED = Precision(np.float64, np.float32)


class LoopTest(NamedTuple):
    """A loop to try, at which φ, in which precisions, and which errors are shown."""

    errors: Callable[[Packing, Precision], Errors]
    phi: float
    precisions: tuple[Precision, ...]
    quantities: tuple[str, ...]


ALL_QUANTITIES = ("forces", "floor", "g")
QUANTITY_NAMES = {"forces": "forces", "floor": "max|F|", "g": "g"}
LOOP_TESTS = {
    "FIRE": LoopTest(fire_errors, PHI_DENSE, (SINGLE, DOUBLE), ALL_QUANTITIES),
    "FIRE near jamming": LoopTest(fire_errors, PHI_NEAR_JAMMING, (SINGLE, DOUBLE), ALL_QUANTITIES),
    "FIRE with double overlaps": LoopTest(fire_errors, PHI_DENSE, (MIXED,), ALL_QUANTITIES),
    "dynamics": LoopTest(dynamics_errors, PHI_DENSE, (SINGLE, DOUBLE), ("floor", "g")),
}


def measure(size: Size) -> Iterator[DiagramRow]:
    """The errors of every loop in every precision."""
    for n in size.n:
        for name, loop in LOOP_TESTS.items():
            for precision in loop.precisions:
                done = in_fresh_process(errors_of_packings, name, precision, n, size.seeds)
                for quantity in loop.quantities:
                    samples = [TimedError(e.seconds, getattr(e, quantity)) for e in done.value]
                    curve = f"{name}, {QUANTITY_NAMES[quantity]}{size_suffix(n, size)}"
                    default = precision == DOUBLE
                    yield summarise(curve, precision.bits, samples, done.megabytes, default)


def errors_of_packings(name: str, precision: Precision, n: int, seeds: int) -> list[Errors]:
    """The errors of every packing; NaN where it is not jammed."""
    loop = LOOP_TESTS[name]
    packings = [compressed(n, seed, loop.phi) for seed in range(seeds)]
    loop.errors(packings[0], precision)
    return [
        loop.errors(packing, precision) if jammed(packing) else Errors(*[math.nan] * 4)
        for packing in packings
    ]


def jammed(packing: Packing) -> bool:
    """Whether a rigid backbone carries the load."""
    return is_jammed(packing, SMOOTH, residual(packing, SMOOTH))


DIAGRAM = Diagram(
    title="Single and double precision, φ = 0.90, near jamming 0.85",
    setting="significant bits of a force",
    unit="$10^9$ grain steps",
    error=r"error: $F$, $\max|F|$ in $\bar f$; $g$ relative",
    reference="forces in extended precision; the balance by Newton's method",
    small=Size((256,), 8),
    large=Size((1024, 4096), 16),
    measure=measure,
)
