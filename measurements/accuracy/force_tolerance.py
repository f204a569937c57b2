"""F_Th of a force balance: what is left of max|F| when a relaxation stops. A, Appendix A.

A packing is taken from one balance affinely to the next φ and relaxed until max|F| < F_Th: by A's
FIRE, or the fast way, which ends with Newton's method (`relaxation.frictionless`). The state is off
by u = J⁻¹ F, so errors fall as F_Th, faster at loose ones, where contacts still open and close;
Newton's last step squares what is left, and lands far below its F_Th. Near jamming, as here, J is
soft and contacts many that hardly touch: F_Th weighs most there.

    g             |g(F_Th) − g| / |g|
    eigenvalues   the largest |λ_n(F_Th) − λ_n| / λ_n of the ten lowest of J beside the translations
    contacts      those that only one of the two states has, in parts of all: mean over samples

Reference: the balance that the same relaxation leads to with F_Th = 1e-14, by Newton's method,
iterated until max|F| does not fall any more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import scipy.linalg

from grainmodes.kernels.laws import Frictionless, Interaction
from grainmodes.packing.contacts import rattlers
from grainmodes.packing.state import Packing, find_contacts
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.frictionless import relax_fire, relax_fire_newton
from grainmodes.relaxation.newton import newton
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import Eigenproblem
from grainmodes.stages.rows import SAMPLE_ERRORS
from grainmodes.statistics.averages import TRANSLATIONS
from measurements.accuracy.diagram import FAILED, Diagram, Row, Sample, Size, apart, of, row, timed
from measurements.accuracy.packings import HERTZ, compressed

PHI, STEP, INTERACTION = 0.85, 1e-3, Interaction.from_law(ContactLaw(kt=1.0))
"""φ of the balance, the step that led to it, and the law of its response, k_T = k_N."""

SHIPPED = Compression()
TOLERANCES = tuple(10.0**-k for k in range(4, 18))

RELAXATIONS = {"FIRE": relax_fire, "fast": relax_fire_newton}

CONTACTS = "of the contacts"
QUANTITIES = ("of g", "of the ten lowest eigenvalues", CONTACTS)

LOWEST = 10

MOST = 100_000
"""Iterations after which F_Th counts as out of reach: several times what 1e-14 takes."""

POLISHING = 20
"""Newton steps after which its balance cannot fall further."""


class Answers(NamedTuple):
    """What is asked of a balance: g, its lowest eigenvalues (10,), its contacts as pairs (i, j)."""

    g: float
    eigenvalues: np.ndarray
    contacts: set[tuple[int, int]]

    def errors(self, exact: Answers) -> tuple[float, float, float]:
        """The errors of `QUANTITIES`."""
        off = np.abs(self.eigenvalues - exact.eigenvalues) / np.abs(exact.eigenvalues)
        differing = len(self.contacts ^ exact.contacts) / len(exact.contacts)
        return abs(self.g / exact.g - 1.0), float(off.max()), differing


def answers(packing: Packing) -> Answers:
    """The answers of a packing, without its rattlers."""
    matrix = Eigenproblem.from_packing(packing, INTERACTION).matrix.toarray()
    values = scipy.linalg.eigvalsh(matrix)
    values = values[np.argsort(np.abs(values))][TRANSLATIONS:]
    g = rigidity(packing, INTERACTION).unloaded.g
    return Answers(g, np.sort(values[:LOWEST]), contacts_of(packing))


def contacts_of(packing: Packing) -> set[tuple[int, int]]:
    """The contacts between grains that are no rattlers, in the numbers of all."""
    contacts = find_contacts(packing)
    gone = rattlers(contacts, packing.n, threshold=2)
    held = ~(gone[contacts.i] | gone[contacts.j])
    return set(zip(contacts.i[held].tolist(), contacts.j[held].tolist(), strict=True))


def reference(relax: Callable, packing: Packing) -> Answers:
    """The answers of the balance that a relaxation leads to."""
    balance = relax(packing, HERTZ, SHIPPED.force_tolerance, MOST).packing
    gone = rattlers(find_contacts(balance), balance.n, threshold=2)
    interaction = Interaction(HERTZ, Frictionless())
    fraction = balance.fraction.copy()
    solved = newton(balance.without(gone), interaction, 0.0, POLISHING)
    fraction[:, ~gone] = solved.packing.fraction
    return answers(replace(balance, fraction=fraction))


def measure(size: Size) -> Iterator[Row]:
    """Three rows for every relaxation and F_Th, one per quantity."""
    for n in size.n:
        packings = [compressed(n, seed, PHI - STEP).at(PHI) for seed in range(size.seeds)]
        for name, relax in RELAXATIONS.items():
            exact = [reference(relax, packing) for packing in packings]
            for tolerance in TOLERANCES:
                done = apart(sampled, name, tolerance, packings, exact)
                default = (name, tolerance) == (SHIPPED.relaxation, SHIPPED.force_tolerance)
                for what, samples in zip(QUANTITIES, done.value, strict=True):
                    curve = f"{name}, {what}{of(n, size)}"
                    mean = what == CONTACTS
                    yield row(curve, tolerance, samples, done.megabytes, default, mean)


def sampled(
    name: str, tolerance: float, packings: list[Packing], exact: list[Answers]
) -> list[tuple[Sample, ...]]:
    """The samples of every quantity."""
    relax = RELAXATIONS[name]
    relax(packings[0], HERTZ, max(TOLERANCES), MOST)
    samples = [_samples(relax, tolerance, *of) for of in zip(packings, exact, strict=True)]
    return list(zip(*samples, strict=True))


def _samples(relax: Callable, tolerance: float, packing: Packing, exact: Answers) -> list[Sample]:
    relaxed, seconds = timed(relax, packing, HERTZ, tolerance, MOST)
    try:
        errors = answers(relaxed.packing).errors(exact)
    except SAMPLE_ERRORS:
        errors = ()
    if not (errors and relaxed.converged):
        return [FAILED] * len(QUANTITIES)
    return [Sample(seconds, error) for error in errors]


DIAGRAM = Diagram(
    title="Tolerance of a force balance, φ = 0.85; response at k_T/k_N = 1",
    setting=r"$F_{\rm Th} \,/\, k_N d^{3/2}$",
    unit="balance",
    error="relative error",
    reference="the same balance by Newton's method, to the floor",
    small=Size((256,), 8),
    large=Size((1024, 4096), 16),
    measure=measure,
)
