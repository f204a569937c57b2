"""Single or double precision, where that is a choice: the forces of FIRE, the state of dynamics.

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
    max|F|     what is left when it no longer falls, / f̄, evaluated in double
    g          |g/g_ref − 1| of the state so reached; dynamics: of a simulated step strain

Reference: forces in extended precision; the balance, or the step, by Newton's method to 1e-14.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Frictionless, Interaction
from grainmodes.packing.forces import largest, mean_contact_force, net_force, stress
from grainmodes.packing.state import Packing, find_contacts
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import forward_rigidity
from grainmodes.response.moduli import rigidity
from grainmodes.stages.samples import is_jammed
from measurements.accuracy.diagram import Diagram, Row, Sample, Size, apart, of, row, timed
from measurements.accuracy.loops import ROUGH, Precision, descended, exact_forces, moved
from measurements.accuracy.packings import HERTZ, compressed

DENSE, LOOSE = 0.9, 0.85
"""φ far from jamming and near it, where overlaps are small."""

SMOOTH = Interaction(HERTZ, Frictionless())

AWAY = 1e-6
"""Random displacement from a balance in d, at which FIRE starts."""

STRAIN = 1e-4
"""Step strain after which dynamics relaxes."""

STEPS = 50_000
"""Steps to the floor."""


class Errors(NamedTuple):
    """CPU seconds of 10⁹ grain steps, and the errors; `forces` NaN where they are not looked at."""

    seconds: float
    forces: float
    floor: float
    g: float


def of_fire(packing: Packing, precision: Precision) -> Errors:
    """FIRE from a little beside a balance back to it."""
    beside = packing.displaced(AWAY * np.random.default_rng(0).standard_normal((packing.n, 2)))
    unit = mean_contact_force(find_contacts(packing), SMOOTH)
    _, seen = descended(beside, precision, 0)
    wrong = np.sqrt(np.mean((seen - exact_forces(beside)) ** 2))
    (after, _), seconds = timed(descended, beside, precision, STEPS)
    exact, found = (rigidity(state, ROUGH).unloaded.g for state in (packing, after))
    return _errors(seconds, wrong / unit, residual(after, SMOOTH) / unit, found / exact, packing.n)


def of_dynamics(packing: Packing, precision: Precision) -> Errors:
    """Damped dynamics after a step strain, as A simulates g."""
    unit = mean_contact_force(find_contacts(packing), SMOOTH)
    after, seconds = timed(moved, packing.sheared(STRAIN), precision.force, STEPS)
    exact = forward_rigidity(packing, ROUGH, StepStrain(strain=STRAIN))
    before, strained = (stress(p, find_contacts(p), ROUGH)[0, 1] for p in (packing, after))
    found = (strained - before) / STRAIN
    return _errors(seconds, math.nan, residual(after, ROUGH) / unit, found / exact, packing.n)


def _errors(seconds: float, forces: float, floor: float, ratio: float, n: int) -> Errors:
    return Errors(seconds / (STEPS * n) * 1e9, float(forces), floor, abs(ratio - 1.0))


def residual(packing: Packing, interaction: Interaction) -> float:
    """max|F̃| in double precision."""
    return max(largest(net_force(packing, find_contacts(packing), interaction)))


SINGLE, DOUBLE = Precision(np.float32, np.float32), Precision(np.float64, np.float64)
MIXED = Precision(np.float64, np.float32)


class Way(NamedTuple):
    """A loop to try, at which φ, in which precisions, and what is looked at."""

    errors: Callable[[Packing, Precision], Errors]
    phi: float
    precisions: tuple[Precision, ...]
    looked_at: tuple[str, ...]


ALL = ("forces", "floor", "g")
NAMES = {"forces": "forces", "floor": "max|F|", "g": "g"}
WAYS = {
    "FIRE": Way(of_fire, DENSE, (SINGLE, DOUBLE), ALL),
    "FIRE near jamming": Way(of_fire, LOOSE, (SINGLE, DOUBLE), ALL),
    "FIRE with double overlaps": Way(of_fire, DENSE, (MIXED,), ALL),
    "dynamics": Way(of_dynamics, DENSE, (SINGLE, DOUBLE), ("floor", "g")),
}


def measure(size: Size) -> Iterator[Row]:
    """The errors of every loop in every precision."""
    for n in size.n:
        for name, way in WAYS.items():
            for precision in way.precisions:
                done = apart(sampled, name, precision, n, size.seeds)
                for what in way.looked_at:
                    samples = [Sample(e.seconds, getattr(e, what)) for e in done.value]
                    curve = f"{name}, {NAMES[what]}{of(n, size)}"
                    default = precision == DOUBLE
                    yield row(curve, precision.bits, samples, done.megabytes, default)


def sampled(name: str, precision: Precision, n: int, seeds: int) -> list[Errors]:
    """The errors of every packing; NaN where it is not jammed."""
    way = WAYS[name]
    packings = [compressed(n, seed, way.phi) for seed in range(seeds)]
    way.errors(packings[0], precision)
    return [
        way.errors(packing, precision) if jammed(packing) else Errors(*[math.nan] * 4)
        for packing in packings
    ]


def jammed(packing: Packing) -> bool:
    """Whether a rigid backbone carries the load."""
    contacts = find_contacts(packing)
    return is_jammed(packing, contacts, SMOOTH, residual(packing, SMOOTH))


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
