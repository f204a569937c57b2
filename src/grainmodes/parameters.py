"""What a sample is made of: the point of the grid, the contact law, the protocols.

Frozen dataclasses of plain numbers, and the one formatter that turns a value into the text that
stands in a path and back. Standard library only, so that the Snakefile can import it cheaply.

Units everywhere: k_N = m = d = 1, with d the diameter of the large grains and m their mass;
forces in k_N d^(3/2) (Hertz) or k_N d (harmonic), time in t_0.
"""

from __future__ import annotations

from dataclasses import dataclass, field

NORMAL_LAWS = ("hertz", "harmonic")
TANGENTIAL_LAWS = ("elastic", "smoothed_coulomb", "sharp_coulomb")
RELAXATIONS = ("fast", "fire")
STRAIN_RELAXATIONS = ("newton", "damped")
SPECTRA = ("none", "counts", "bands", "eigenvalues", "modes")
SPECTRUM_METHODS = ("auto", "dense", "windows", "counting")
FACTORISATIONS = ("auto", "superlu", "pardiso")

CHECKPOINT_SPACING = 0.01
"""Spacing in φ of the states along a compression from which every packing is reached."""

TRANSLATIONAL_FREQUENCIES = (1.3e-2, 1.0)
"""ω t_0 of A, Fig. 7, that does not depend on k_T."""

LOWEST_CHECKPOINT = 0.80
"""First checkpoint: the first job of a trajectory compresses from random placement to here."""


@dataclass(frozen=True)
class ContactLaw:
    """The force between two touching grains; `kt = 0` is frictionless, whatever `tangential`."""

    normal: str = "hertz"
    tangential: str = "elastic"
    kt: float = 0.0
    friction_coefficient: float | None = None

    @property
    def frictional(self) -> bool:
        """Whether rotation and tangential force exist at all."""
        return self.kt > 0.0


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

    A step with a plastic event is taken back and divided by ten, down to `smallest_step`.
    """

    strain: float = 0.5
    step: float = 1e-4
    smallest_step: float = 1e-8
    relaxation: str = "newton"
    loaded: bool = False
    force_tolerance: float = 1e-14
    time_step: float = 1e-2
    drag: float = 1.0
    max_steps: int = 20_000_000


@dataclass(frozen=True)
class Rattlers:
    """A grain with at most `threshold` contacts is a rattler (Z_Th of A, App. E)."""

    threshold: int = 2

    def largest(self, law: ContactLaw) -> int:
        """Most contacts of a rattler; without friction two carry no load whatever is asked."""
        return self.threshold if law.frictional else max(self.threshold, 2)


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
    spectrum: SpectrumChoices = field(default_factory=SpectrumChoices)


@dataclass(frozen=True)
class Point:
    """One point of a grid."""

    n: int
    phi: float
    kt: float


def format_value(value: float | int) -> str:
    """The text of a number in a path: the shortest that reads back as the same number.

    >>> [format_value(v) for v in (256, 0.84, 1e-08, 0.0, 10.0)]
    ['256', '0.84', '1e-08', '0.0', '10.0']
    """
    return repr(int(value)) if isinstance(value, int) else repr(float(value))


def format_seeds(first: int, last: int) -> str:
    """The text of a block of seeds, both ends included: `0000-0007`."""
    return f"{first:04d}-{last:04d}"


def parse_seeds(text: str) -> range:
    """The seeds of a block name.

    Raises:
        ValueError: `text` is not `first-last` with 0 <= first <= last.
    """
    first, _, last = text.partition("-")
    if not (first.isdigit() and last.isdigit() and int(first) <= int(last)):
        raise ValueError(
            f"seeds {text!r}: expected first-last with first <= last, such as 0000-0007"
        )
    return range(int(first), int(last) + 1)


def seed_blocks(count: int, size: int) -> list[str]:
    """Names of the blocks that hold seeds 0 … count − 1, every block but the last `size` long.

    >>> seed_blocks(10, 4)
    ['0000-0003', '0004-0007', '0008-0009']
    """
    return [format_seeds(a, min(a + size, count) - 1) for a in range(0, count, size)]


def phi_at_step(initial_phi: float, phi_step: float, step: int) -> float:
    """φ after `step` steps of the compression grid, free of accumulated rounding."""
    return round(initial_phi + step * phi_step, 12)


def checkpoint_at_or_below(phi: float) -> float:
    """The highest checkpoint of a trajectory that does not exceed φ.

    >>> [checkpoint_at_or_below(p) for p in (0.80, 0.845, 0.9)]
    [0.8, 0.84, 0.9]
    """
    return round(int(round(phi / CHECKPOINT_SPACING, 6)) * CHECKPOINT_SPACING, 12)


def checkpoints_up_to(phi: float) -> list[float]:
    """The checkpoints on the way to φ, the lowest first.

    >>> checkpoints_up_to(0.825)
    [0.8, 0.81, 0.82]
    """
    count = round((checkpoint_at_or_below(phi) - LOWEST_CHECKPOINT) / CHECKPOINT_SPACING)
    return [round(LOWEST_CHECKPOINT + k * CHECKPOINT_SPACING, 12) for k in range(count + 1)]


def field_frequencies(kt: float) -> tuple[float, ...]:
    """Frequencies in 1/t_0 whose eigenvectors are kept at k_T/k_N: those of A, Fig. 7.

    ω_R = (k_T/k_N)^(1/2) lies in the band of rotations, 1.3e-2 at the lower end of the translations
    of 4096 grains, 1 in their middle.

    >>> field_frequencies(1e-8)
    (0.0001, 0.013, 1.0)
    """
    return tuple(sorted({kt**0.5, *TRANSLATIONAL_FREQUENCIES} - {0.0}))


@dataclass(frozen=True)
class Figure:
    """What a figure shows, what its study must ask for, and what it is drawn from.

    `observables` are words of `configuration.grids`; `source` is "ensemble", or "fields" for the
    files of single samples.
    """

    title: str
    observables: tuple[str, ...]
    source: str = "ensemble"


FIGURES = {
    "g_phi": Figure("Rigidity against area fraction (paper A, Fig. 4)", ("rigidity",)),
    "g_kt": Figure(
        "Rigidity against tangential stiffness (paper A, Fig. 5)", ("rigidity", "friction")
    ),
    "g_nonaffine": Figure(
        "Non-affine rigidity, unloaded and loaded step strain (paper A, Fig. 6)", ("rigidity",)
    ),
    "participation": Figure(
        "Translational and rotational fractions of the modes (paper A, Fig. 8)",
        ("modes", "friction"),
    ),
    "dos": Figure("Density of states (paper A, Fig. 9)", ("spectrum",)),
    "dos_scaled": Figure(
        "Density of states, scaled by omega_R (paper A, Fig. 10)", ("spectrum", "friction")
    ),
    "affine_fields": Figure(
        "Affine and non-affine displacements of a step strain (paper A, Fig. 2)",
        ("fields",),
        "fields",
    ),
    "nonaffine_field": Figure(
        "Non-affine displacements, theory and simulation (paper A, Fig. 3)", ("fields",), "fields"
    ),
    "eigenvectors": Figure(
        "Eigenvectors as displacements and rotations (paper A, Fig. 7)",
        ("fields", "friction"),
        "fields",
    ),
    "dos_frictionless": Figure(
        "Density of states at weak friction and without (paper A, Fig. 11)",
        ("spectrum", "friction", "frictionless"),
    ),
    "dos_hessian": Figure(
        "Density of states of the Jacobian and of the effective Hessian (paper A, Fig. 12)",
        ("spectrum", "friction", "hessian"),
    ),
    "dos_rattlers": Figure(
        "Density of states with and without rattlers (paper A, Fig. 13)",
        ("spectrum", "friction", "rattlers"),
    ),
    "participation_ratio": Figure(
        "Participation ratio of the modes (paper A, Fig. 14)", ("modes", "friction")
    ),
    "dos_n": Figure(
        "Density of states for several N (paper A, Fig. 15)",
        ("spectrum", "friction", "several_n"),
    ),
    "dos_phi": Figure(
        "Density of states towards jamming (paper A, Fig. 16)",
        ("spectrum", "friction", "several_phi"),
    ),
}
"""Every figure. `rigidity` figures show the simulated step strain as well where a study has it;
`modes` stands for a spectrum with eigenvectors or band averages, `friction` for a k_T above 0,
`frictionless` for k_T = 0 beside it, `rattlers` and `hessian` for these variants of the spectrum,
`several_n` and `several_phi` for spectra at more than one N or φ."""
