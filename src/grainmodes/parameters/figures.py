"""The table of figures: what each shows, and what a study must ask for to draw it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Figure:
    """What a figure shows, what its study must ask for, and what it is drawn from.

    `room` is the package of `grainmodes.figures` that holds its module; `observables` are words of
    `configuration.grids`; `source` is "ensemble", or the stage of the files of single samples:
    "fields", "event_detail", "release".
    """

    room: str
    title: str
    observables: tuple[str, ...]
    source: str = "ensemble"


FORMS = ("png", "pdf", "csv", "txt")
"""Suffixes of the files of a figure: picture, vectors, plotted numbers, caption."""


def files_of_stem(stem: Path) -> list[Path]:
    """The files of a figure, one for each form; a suffix of `stem` that is a form is left out.

    >>> [path.name for path in files_of_stem(Path("dos_n~64.png"))]
    ['dos_n~64.png', 'dos_n~64.pdf', 'dos_n~64.csv', 'dos_n~64.txt']
    """
    name = stem.stem if stem.suffix.removeprefix(".") in FORMS else stem.name
    return [stem.with_name(f"{name}.{form}") for form in FORMS]


FIGURES = {
    "g_phi": Figure("paper_a", "Rigidity against area fraction (paper A, Fig. 4)", ("rigidity",)),
    "g_kt": Figure(
        "paper_a",
        "Rigidity against tangential stiffness (paper A, Fig. 5)",
        ("rigidity", "friction"),
    ),
    "g_nonaffine": Figure(
        "paper_a",
        "Non-affine rigidity, unloaded and loaded step strain (paper A, Fig. 6)",
        ("rigidity",),
    ),
    "participation": Figure(
        "paper_a",
        "Translational and rotational fractions of the modes (paper A, Fig. 8)",
        ("modes", "friction"),
    ),
    "dos": Figure("paper_a", "Density of states (paper A, Fig. 9)", ("spectrum",)),
    "dos_scaled": Figure(
        "paper_a",
        "Density of states, scaled by omega_R (paper A, Fig. 10)",
        ("spectrum", "friction"),
    ),
    "affine_fields": Figure(
        "paper_a",
        "Affine and non-affine displacements of a step strain (paper A, Fig. 2)",
        ("fields",),
        "fields",
    ),
    "nonaffine_field": Figure(
        "paper_a",
        "Non-affine displacements, theory and simulation (paper A, Fig. 3)",
        ("fields", "all_modes"),
        "fields",
    ),
    "eigenvectors": Figure(
        "paper_a",
        "Eigenvectors as displacements and rotations (paper A, Fig. 7)",
        ("fields", "friction"),
        "fields",
    ),
    "dos_frictionless": Figure(
        "paper_a",
        "Density of states at weak friction and without friction (paper A, Fig. 11)",
        ("spectrum", "friction", "frictionless"),
    ),
    "dos_hessian": Figure(
        "paper_a",
        "Density of states of the Jacobian and of the effective Hessian (paper A, Fig. 12)",
        ("spectrum", "friction", "hessian"),
    ),
    "dos_rattlers": Figure(
        "paper_a",
        "Density of states with and without rattlers (paper A, Fig. 13)",
        ("spectrum", "friction", "rattlers"),
    ),
    "participation_ratio": Figure(
        "paper_a", "Participation ratio of the modes (paper A, Fig. 14)", ("modes", "friction")
    ),
    "dos_n": Figure(
        "paper_a",
        "Density of states for several N (paper A, Fig. 15)",
        ("spectrum", "friction", "several_n"),
    ),
    "dos_phi": Figure(
        "paper_a",
        "Density of states towards jamming (paper A, Fig. 16)",
        ("spectrum", "friction", "several_phi"),
    ),
    "stress_strain": Figure(
        "paper_b", "Stress against strain in one sample (paper B, Figs. 1, 8)", ("shear",)
    ),
    "stress_brackets": Figure(
        "paper_b",
        "Stress against strain with events bracketed and without brackets (paper B, Fig. 2)",
        ("shear", "coarse_run"),
    ),
    "stress_drop": Figure(
        "paper_b",
        "Smallest eigenvalue, rigidity and stress around the largest stress drop (paper B, Fig. 3)",
        ("shear",),
    ),
    "rigidity_strain": Figure(
        "paper_b", "Rigidity and smallest eigenvalue at small strain (paper B, Fig. 7)", ("shear",)
    ),
    "rigidity_mean": Figure(
        "paper_b", "Mean rigidity against strain (paper B, Fig. 9)", ("shear",)
    ),
    "event_states": Figure(
        "paper_b",
        "Smallest eigenvalue and rigidity close to an event (paper B, Fig. 13)",
        ("event_detail",),
        "event_detail",
    ),
    "event_eigenvectors": Figure(
        "paper_b",
        "Eigenvector of the smallest eigenvalue before and after an event (paper B, Fig. 4)",
        ("event_detail",),
        "event_detail",
    ),
    "event_rate": Figure(
        "paper_b",
        "Non-affine displacement rate after an event, theory and simulation (paper B, Fig. 5)",
        ("event_detail",),
        "event_detail",
    ),
    "event_displacement": Figure(
        "paper_b",
        "Non-affine displacement in an event (paper B, Fig. 6)",
        ("event_detail",),
        "event_detail",
    ),
    "tangential_error": Figure(
        "paper_b",
        "Normal part of the integral of tangential velocities (paper B, Fig. 10)",
        ("event_detail", "friction"),
        "event_detail",
    ),
    "event_brackets": Figure(
        "paper_b",
        "Stress and strain of an event in closer and closer brackets (paper B, Figs. 11 and 12)",
        ("event_detail",),
        "event_detail",
    ),
    "pair_birth": Figure(
        "paper_c",
        "Two real eigenvalues become a complex pair (paper C, Fig. 1)",
        ("complex_pairs", "friction"),
    ),
    "pair_overlap": Figure(
        "paper_c",
        "Scalar products of eigenvectors around a complex pair (paper C, Figs. 2 and 3)",
        ("complex_pairs", "friction"),
    ),
    "pair_exponent": Figure(
        "paper_c",
        "Difference of two eigenvalues against the distance to gamma_c (paper C, Fig. 4)",
        ("complex_pairs", "friction"),
    ),
    "release_spirals": Figure(
        "paper_c",
        "Trajectories of the grains in a released complex pair (paper C, Fig. 5)",
        ("release", "friction"),
        "release",
    ),
    "release_growth": Figure(
        "paper_c",
        "Growth of M(t) and A(t) in the linear regime (paper C, Fig. 6)",
        ("release", "friction"),
        "release",
    ),
    "release_outcome": Figure(
        "paper_c",
        "Outcome of released states at long times (paper C, Fig. 7)",
        ("release", "friction"),
        "release",
    ),
    "release_spectrum": Figure(
        "paper_c",
        "Complex pairs along a release (paper C, Fig. 8)",
        ("release", "friction"),
        "release",
    ),
    "release_contacts": Figure(
        "paper_c", "Contacts along a release (paper C, Fig. 9)", ("release", "friction"), "release"
    ),
    "release_pressure": Figure(
        "paper_c",
        "Pressures of contacts and grains before and after a release (paper C, Fig. 10)",
        ("release", "friction"),
        "release",
    ),
    "release_damping": Figure(
        "paper_c", "Release under damping (paper C, Fig. 11)", ("release", "friction"), "release"
    ),
    "release_times": Figure(
        "paper_c",
        "When the growth of released states ends (paper C, Sec. VI B)",
        ("release", "friction"),
        "release",
    ),
    "release_pair": Figure(
        "paper_c",
        "The pair of a released state along the shear, and its growth (paper C, Fig. 12)",
        ("release", "friction"),
        "release",
    ),
    "law_comparison": Figure(
        "paper_c",
        "Complex pairs under several tangential laws (paper C, Sec. VIII)",
        ("law_comparison",),
    ),
    "nonaffine_crossing": Figure(
        "own",
        "Change of sign of the non-affine rigidity with tangential stiffness (claim G1)",
        ("rigidity", "friction"),
    ),
    "rigidity_exponent": Figure(
        "own",
        "Rigidity against the distance to jamming at strong friction (claim G4)",
        ("rigidity", "friction"),
    ),
}
"""Every figure. `rigidity` figures show the simulated step strain as well where a study has it;
`modes` stands for a spectrum with eigenvectors or binned averages, `friction` for a k_T above 0,
`frictionless` for k_T = 0 beside it, `rattlers` and `hessian` for these other spectra,
`all_modes` for an N whose modes can all be summed, `several_n` and `several_phi` for spectra at
more than one N or φ."""
