"""The numerical choices of a scene, each with its default."""

from __future__ import annotations

from dataclasses import dataclass, field

from grainmodes.parameters.law import Rattlers

RELAXATIONS = ("fast", "fire")
STRAIN_RELAXATIONS = ("newton", "damped")
SPECTRA = ("none", "counts", "bands", "eigenvalues", "modes")
SPECTRUM_METHODS = ("auto", "dense", "windows", "counting")
FACTORISATIONS = ("auto", "superlu", "pardiso")

DENSE_BINS_UP_TO = 2000
"""Degrees of freedom up to which LAPACK's whole spectrum is cheaper than counts at edges."""

DENSE_MODES_UP_TO = 5000
"""Degrees of freedom up to which LAPACK finds all eigenvalues faster than windows do."""

PARDISO_FROM = 3000
"""Rows from which PARDISO, where it is installed, is worth its start-up time."""

BINNED = ("counts", "bands")
"""Kinds of spectrum that hold bins rather than modes."""


@dataclass(frozen=True)
class Compression:
    """Random placement at φ = `initial_phi`, then steps of `phi_step`, each relaxed (A, App. A).

    `intermediate_balance` is the largest force left after a step, relative to the mean contact
    force (`fast` only: `fire` brings every step to `force_tolerance`, as paper A does).
    """

    relaxation: str = "fast"
    initial_phi: float = 0.6
    phi_step: float = 1e-4
    intermediate_balance: float = 1e-3
    force_tolerance: float = 1e-14
    max_iterations: int = 20_000_000


@dataclass(frozen=True)
class StepStrain:
    """The simulated rigidity: a step `strain`, relaxed to `force_tolerance` (A, Sec. II)."""

    strain: float = 1e-6
    relaxation: str = "newton"
    force_tolerance: float = 1e-14
    time_step: float = 1e-2
    damping: float = 1.0
    max_steps: int = 50_000_000


@dataclass(frozen=True)
class Shear:
    """Athermal quasistatic shear from 0 to `strain` in steps of `step` (B, Sec. II, App. B).

    A step with an event is taken back and divided by ten, down to `smallest_step`. `newton` leaves
    to the damped dynamics, with `time_step` and `drag`, only what it cannot decide. The lowest
    eigenvalue of J is found on both sides of "events", or of all "states".
    """

    strain: float = 0.5
    step: float = 1e-4
    smallest_step: float = 1e-8
    relaxation: str = "newton"
    loaded: bool = False
    force_tolerance: float = 1e-14
    time_step: float = 0.1
    drag: float = 1.0
    max_steps: int = 20_000_000
    lowest_eigenvalue: str = "events"


@dataclass(frozen=True)
class SpectrumChoices:
    """How a spectrum is computed; "auto" takes the cheapest method that delivers what is asked.

    `fineness` is a factor on the numbers of A's linear bins. Of a bin with more modes than
    `modes_per_bin` the participation ratio is sampled on so many, and psi^R is counted in
    `substeps` cells.
    """

    method: str = "auto"
    factorisation: str = "auto"
    fineness: float = 0.2
    modes_per_bin: int = 60
    substeps: int = 2


@dataclass(frozen=True)
class Protocol:
    """Every numerical choice of a study, with its default."""

    compression: Compression = field(default_factory=Compression)
    step_strain: StepStrain = field(default_factory=StepStrain)
    rattlers: Rattlers = field(default_factory=Rattlers)
    shear: Shear = field(default_factory=Shear)
    spectrum: SpectrumChoices = field(default_factory=SpectrumChoices)
