"""F_Th of a force balance: the max|F| below which a relaxation stops. A, Appendix A.

A packing is taken from one balance affinely to the next φ and relaxed until max|F| < F_Th: by A's
FIRE, or by FIRE and then Newton's method (`relaxation.frictionless`). The state is displaced by
u = J⁻¹ F from the balance, so that errors are proportional to F_Th; at large F_Th, where contacts
still open and close, they fall faster. The last step of Newton's method squares the error and ends
far below F_Th. Near jamming, as here, J is soft and many contacts hardly touch, and F_Th
matters most.

    g             |g(F_Th) − g| / |g|
    eigenvalues   the largest |λ_n(F_Th) − λ_n| / λ_n of the ten lowest of J but its translations
    contacts      fraction of the contacts that only one of the two states has, mean over samples

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
from grainmodes.packing.state import Packing, rattlers
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.frictionless import relax_fire, relax_fire_newton
from grainmodes.relaxation.newton import newton
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import Eigenproblem
from grainmodes.stages.rows import SAMPLE_ERRORS
from grainmodes.statistics.averages import TRANSLATIONS
from measurements.accuracy.diagram import (
    FAILED,
    Diagram,
    DiagramRow,
    Size,
    TimedError,
    in_fresh_process,
    size_suffix,
    summarise,
    timed,
)
from measurements.accuracy.packings import HERTZ, compressed

PHI, STEP, INTERACTION = 0.85, 1e-3, Interaction.from_law(ContactLaw(kt=1.0))
"""φ of the balance, the step that led to it, and the law of its response, k_T = k_N."""

DEFAULT = Compression()
TOLERANCES = tuple(10.0**-k for k in range(4, 18))

RELAXATIONS = {"FIRE": relax_fire, "FIRE + Newton": relax_fire_newton}
NAMES = {"fire": "FIRE", "fire_newton": "FIRE + Newton"}
"""Relaxation of a scene → its name here."""

CONTACTS = "of the contacts"
QUANTITIES = ("of g", "of the ten lowest eigenvalues", CONTACTS)

N_EIGENVALUES = 10

MAX_ITERATIONS = 100_000
"""Iterations after which a relaxation has failed: several times as many as 1e-14 takes."""

MAX_NEWTON_STEPS = 20
"""Newton steps after which max|F| cannot fall further."""


class Response(NamedTuple):
    """g of a balance, its lowest eigenvalues (10,), its contacts as pairs (i, j)."""

    g: float
    eigenvalues: np.ndarray
    contacts: set[tuple[int, int]]

    def errors(self, exact: Response) -> tuple[float, float, float]:
        """The errors of `QUANTITIES`."""
        off = np.abs(self.eigenvalues - exact.eigenvalues) / np.abs(exact.eigenvalues)
        differing = len(self.contacts ^ exact.contacts) / len(exact.contacts)
        return abs(self.g / exact.g - 1.0), float(off.max()), differing


def find_response(packing: Packing) -> Response:
    """The response of a packing without its rattlers."""
    matrix = Eigenproblem.from_packing(packing, INTERACTION).matrix.toarray()
    values = scipy.linalg.eigvalsh(matrix)
    values = values[np.argsort(np.abs(values))][TRANSLATIONS:]
    g = rigidity(packing, INTERACTION).unloaded.g
    return Response(g, np.sort(values[:N_EIGENVALUES]), backbone_contacts(packing))


def backbone_contacts(packing: Packing) -> set[int]:
    """The keys of the contacts between grains that are not rattlers, in the numbers of all."""
    contacts = packing.contacts
    is_rattler = rattlers(packing, threshold=2)
    between = ~(is_rattler[contacts.i] | is_rattler[contacts.j])
    return set(contacts.key[between].tolist())


def reference(relax: Callable, packing: Packing) -> Response:
    """The response of the balance that a relaxation leads to."""
    balance = relax(packing, HERTZ, DEFAULT.force_tolerance, MAX_ITERATIONS).packing
    gone = rattlers(balance, threshold=2)
    interaction = Interaction(HERTZ, Frictionless())
    fraction = balance.fraction.copy()
    solved = newton(balance.without(gone), interaction, 0.0, MAX_NEWTON_STEPS)
    fraction[:, ~gone] = solved.packing.fraction
    return find_response(replace(balance, fraction=fraction))


def measure(size: Size) -> Iterator[DiagramRow]:
    """Three rows for every relaxation and F_Th, one per quantity."""
    for n in size.n:
        packings = [compressed(n, seed, PHI - STEP).at(PHI) for seed in range(size.seeds)]
        for name, relax in RELAXATIONS.items():
            exact = [reference(relax, packing) for packing in packings]
            for tolerance in TOLERANCES:
                done = in_fresh_process(timed_errors, name, tolerance, packings, exact)
                default = (name, tolerance) == (NAMES[DEFAULT.relaxation], DEFAULT.force_tolerance)
                for quantity, samples in zip(QUANTITIES, done.value, strict=True):
                    curve = f"{name}, {quantity}{size_suffix(n, size)}"
                    mean = quantity == CONTACTS
                    yield summarise(curve, tolerance, samples, done.megabytes, default, mean)


def timed_errors(
    name: str, tolerance: float, packings: list[Packing], exact: list[Response]
) -> list[tuple[TimedError, ...]]:
    """The samples of every quantity."""
    relax = RELAXATIONS[name]
    relax(packings[0], HERTZ, max(TOLERANCES), MAX_ITERATIONS)
    samples = [_timed_errors(relax, tolerance, *pair) for pair in zip(packings, exact, strict=True)]
    return list(zip(*samples, strict=True))


def _timed_errors(
    relax: Callable, tolerance: float, packing: Packing, exact: Response
) -> list[TimedError]:
    relaxed, seconds = timed(relax, packing, HERTZ, tolerance, MAX_ITERATIONS)
    try:
        errors = find_response(relaxed.packing).errors(exact)
    except SAMPLE_ERRORS:
        errors = ()
    if not (errors and relaxed.converged):
        return [FAILED] * len(QUANTITIES)
    return [TimedError(seconds, error) for error in errors]


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
