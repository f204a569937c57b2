"""What each effect costs at each stage: the rows of `effects.py`.

A row prepares a state of N grains at φ = 0.90 and returns the work that is timed. Three states of
the springs: without friction (2N unknowns), friction never loaded, s = 0 (3N, J symmetric), and
loaded by a strain of 1e-5, s ≠ 0 (3N, J not symmetric).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.damping import Dashpot, Drag, Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.fire import FireSettings, fire
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import net_force
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing, backbone
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.relaxation.dynamics import move
from grainmodes.relaxation.frictionless import (
    NO_TIME_STEP_LIMIT,
    SKIN,
    STABILITY_FRACTION,
    relax_fire_large_steps,
)
from grainmodes.relaxation.newton import newton
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import Eigenproblem, average_in_bins, full_spectrum
from grainmodes.statistics.binning import fixed_edges
from measurements.benchmarks.cases import HERTZ, balanced_at, quenched

KT = 1e-2
FRICTIONLESS, ELASTIC = ContactLaw(), ContactLaw(kt=KT)
SMOOTHED = ContactLaw("hertz", "smoothed_coulomb", KT, 0.5)
SHARP = ContactLaw("hertz", "sharp_coulomb", KT, 0.5)

SMALL_SIZES, LARGE_SIZES = (256, 1024), (256, 1024, 4096)

Work = Callable[[], object]


class EffectRow(NamedTuple):
    """An effect at a stage: `prepare(n)` gives the work, which takes `steps` steps."""

    stage: str
    effect: str
    prepare: Callable[[int], Work]
    sizes: tuple[int, ...]
    steps: int = 1


@cache
def unloaded(n: int) -> Packing:
    """A balance whose springs were never loaded, without its rattlers."""
    return backbone(balanced_at(n, 0.9), 2)


@cache
def loaded(n: int) -> Packing:
    """A balance after a small strain: every spring is stretched."""
    relaxed = newton(unloaded(n).sheared(1e-5), Interaction.from_law(ELASTIC), 1e-13, 40)
    if not relaxed.converged:
        raise ArithmeticError(f"no balance near a strain of 1e-5 among {n} grains")
    return relaxed.packing


STATES = (
    ("frictionless, 2N", unloaded, FRICTIONLESS),
    ("friction, s = 0", unloaded, ELASTIC),
    ("friction, s ≠ 0", loaded, ELASTIC),
)


def fire_steps(strain: float, n: int) -> Work:
    """400 steps of FIRE near balance."""
    start = quenched(n, 0.9, 1e-5).sheared(strain)
    packing = relax_fire_large_steps(start, HERTZ, 1e-5, 0.0, 20_000).packing
    settings = FireSettings(1e-30, 0.0, NO_TIME_STEP_LIMIT, STABILITY_FRACTION, SKIN, 400)

    def work():
        x, y = packing.fraction.copy()
        box = packing.box_length, packing.strain
        fire(x, y, packing.diameter, np.ones(n), *box, HERTZ, settings)

    return work


def dynamics_steps(law: ContactLaw, damping, n: int) -> Work:
    """200 steps of dynamics with springs, after a strain of 1e-4."""
    packing, interaction = unloaded(n).sheared(1e-4), Interaction.from_law(law)
    rest = np.zeros((packing.n, 3))
    return lambda: move(packing, rest, interaction, damping, 1e-2, Stop(0.0, 200))


def forces(state, law: ContactLaw, n: int) -> Work:
    """Net forces from the contacts."""
    packing, interaction = state(n), Interaction.from_law(law)
    _ = packing.contacts
    return lambda: net_force(packing, interaction)


def assembly(state, law: ContactLaw, n: int) -> Work:
    """J from the contacts."""
    packing, interaction = state(n), Interaction.from_law(law)
    _ = packing.contacts
    return lambda: jacobian(packing, interaction)


def moduli(state, law: ContactLaw, n: int) -> Work:
    """g, g_A, g_NA from the packing."""
    packing, interaction = state(n), Interaction.from_law(law)
    return lambda: rigidity(packing, interaction)


def sheared(law: ContactLaw, n: int) -> Work:
    """Ten steps of quasistatic shear, no bracket narrower than a step."""
    packing, interaction = unloaded(n), Interaction.from_law(law)

    def work():
        run = QuasistaticRun.from_packing(packing, interaction, Shear(1e-3, 1e-4, 1e-4))
        while not run.done and run.advance():
            pass

    return work


def bands(averages: bool, law: ContactLaw, n: int) -> Work:
    """The default bins: counts alone, or with ψ^R and p."""
    eigenproblem = Eigenproblem.from_packing(unloaded(n), Interaction.from_law(law))
    edges = fixed_edges(law.kt, 0.2)
    return lambda: average_in_bins(eigenproblem, edges, averages)


def eigen(modes: bool, state, law: ContactLaw, n: int) -> Work:
    """All eigenvalues, or all modes with ψ^R and p."""
    eigenproblem = Eigenproblem.from_packing(state(n), Interaction.from_law(law))
    return lambda: full_spectrum(eigenproblem, modes)


def rows() -> list[EffectRow]:
    """All rows, stage by stage."""
    return [*_kernels(), *_responses(), *_spectra()]


def _kernels() -> list[EffectRow]:
    fires = [
        EffectRow(
            "FIRE, a step",
            f"frictionless, γ = {strain:g}",
            partial(fire_steps, strain),
            LARGE_SIZES,
            400,
        )
        for strain in (0.0, 0.1)
    ]
    kinds = (
        ("elastic, no damping", ELASTIC, Undamped()),
        ("elastic, dashpots", ELASTIC, Dashpot(1.0)),
        ("elastic, drag", ELASTIC, Drag(1.0)),
        ("smoothed Coulomb, no damping", SMOOTHED, Undamped()),
        ("sharp Coulomb, no damping", SHARP, Undamped()),
    )
    return fires + [
        EffectRow("dynamics, a step", name, partial(dynamics_steps, law, damping), LARGE_SIZES, 200)
        for name, law, damping in kinds
    ]


def _responses() -> list[EffectRow]:
    found = [
        EffectRow(stage, name, partial(function, state, law), sizes)
        for stage, function, sizes in (
            ("net forces", forces, LARGE_SIZES),
            ("J", assembly, LARGE_SIZES),
            ("g", moduli, LARGE_SIZES),
        )
        for name, state, law in STATES
    ]
    walks = (
        ("frictionless, 2N", FRICTIONLESS),
        ("elastic", ELASTIC),
        ("smoothed Coulomb", SMOOTHED),
    )
    return found + [
        EffectRow("shear, a step", name, partial(sheared, law), SMALL_SIZES, 10)
        for name, law in walks
    ]


def _spectra() -> list[EffectRow]:
    found = [
        EffectRow(stage, name, partial(bands, averages, law), sizes)
        for stage, averages, sizes in (
            ("counts", False, LARGE_SIZES),
            ("binned_averages", True, SMALL_SIZES),
        )
        for name, _, law in STATES[:2]
    ]
    return found + [
        EffectRow(stage, name, partial(eigen, modes, state, law), SMALL_SIZES)
        for stage, modes in (("eigenvalues", False), ("modes", True))
        for name, state, law in STATES
    ]
