"""Choices of a compression with friction: what each of them changes in the packings that come out.

Harmonic grains with k_T = k_N are compressed by damped dynamics (B, Sec. II). One choice at a time
differs from the default:

    Φ     step of φ
    b     max|F̃| after a step, relative to the mean contact force
    Δt    time step of the dynamics, in t_0
    n     time steps after which a step of φ is cut off
    η_D   background drag, in 1/t_0

The compression is chaotic, so that another choice leads to other packings of an ensemble. What
counts is whether the ensemble is another one:

    (m² + e²)^(1/2) / σ     for x = P, Z, G and log10 of max|J − Jᵀ|/max|J|

as in `compression_step`. The reference is finer than the default in Φ, b, Δt and n.
Two ensembles of S packings that have nothing in common lie (2/S)^(1/2) apart: that is the floor.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import backbone
from grainmodes.parameters.compression import Compression, FrictionalCompression
from grainmodes.parameters.law import ContactLaw
from grainmodes.protocols.compression.frictional_trajectory import FrictionalPress, compress_to
from grainmodes.protocols.compression.trajectory import place_at_random
from grainmodes.response.moduli import rigidity
from grainmodes.response.stability import asymmetry
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import SAMPLE_ERRORS
from measurements.accuracy.diagram import Diagram, DiagramRow, Size, in_fresh_process, size_suffix
from measurements.accuracy.packings import shift_of_mean

PHI, LAW = 0.90, ContactLaw("harmonic", "elastic", 1.0)

DEFAULT = FrictionalPress(LAW, Compression(phi_step=1e-3), FrictionalCompression())
"""The steps of φ of the small scenes."""

SETTINGS = {
    r"$\Phi$": ("compression", "phi_step", (1e-2, 1e-3, 2e-4)),
    "b": ("choices", "balance", (1e-1, 1e-2, 1e-3)),
    r"$\Delta t$": ("choices", "time_step", (0.1, 0.05)),
    "n": ("choices", "max_steps", (2_000, 20_000, 100_000)),
    r"$\eta_D$": ("choices", "drag", (0.3, 1.0, 3.0)),
}
"""Symbol → where the choice stands, its name, and the values that are tried."""

REFERENCE = FrictionalPress(
    LAW,
    Compression(phi_step=5e-4),
    FrictionalCompression(balance=1e-3, time_step=0.05, max_steps=100_000),
)

QUANTITIES = ("P", "Z", "G", r"$\log |J - J^T|$")


class Ensemble(NamedTuple):
    """P, Z, G and log10 of the asymmetry of every sample, (S, 4), NaN where it failed; CPU seconds
    of one."""

    samples: np.ndarray
    seconds: float


def ensemble(n: int, seeds: int, press: FrictionalPress) -> Ensemble:
    """All packings of a choice; those of one seed start from the same random placement."""
    _sample(n, 0, replace(press, compression=replace(press.compression, phi_step=1e-2)))
    start = time.process_time()
    samples = np.array([_sample(n, seed, press) for seed in range(seeds)])
    return Ensemble(samples, (time.process_time() - start) / seeds)


def _sample(n: int, seed: int, press: FrictionalPress) -> tuple[float, float, float, float]:
    interaction = press.interaction
    try:
        start = place_at_random(n, seed, interaction.normal, press.compression)
        packing = compress_to(start, PHI, press).packing
        g = rigidity(packing, interaction, threshold=1).unloaded.g
    except SAMPLE_ERRORS:
        return (np.nan,) * 4
    row = packing_row(packing, *interaction)
    skew = asymmetry(jacobian(backbone(packing, threshold=1), interaction))
    return row["pressure"], row["contact_number"], g, float(np.log10(skew))


def measure(size: Size) -> Iterator[DiagramRow]:
    """The shifts of every choice."""
    for n in size.n:
        exact = in_fresh_process(ensemble, n, size.seeds, REFERENCE).value.samples
        for symbol, (part, name, values) in SETTINGS.items():
            for value in values:
                changed = replace(getattr(DEFAULT, part), **{name: value})
                press = replace(DEFAULT, **{part: changed})
                done = in_fresh_process(ensemble, n, size.seeds, press)
                found, seconds = done.value
                counted = np.isfinite(found).all(axis=1) & np.isfinite(exact).all(axis=1)
                counts = int(counted.sum()), int((~counted).sum())
                for column, quantity in enumerate(QUANTITIES):
                    error = shift_of_mean(found[counted, column], exact[counted, column])
                    curve = f"{symbol}, {quantity}{size_suffix(n, size)}"
                    point = value, seconds, done.megabytes, *error
                    yield DiagramRow(curve, *point, *counts, press == DEFAULT)


DIAGRAM = Diagram(
    title="Compression with friction, harmonic grains, k_T = k_N, φ = 0.90",
    setting="value of the choice",
    unit="packing",
    error="shift / σ",
    reference="Φ = 5e-4, b = 1e-3, Δt = 0.05, n = 1e5, from the same random placements",
    small=Size((32,), 12),
    large=Size((128,), 32),
    measure=measure,
)
