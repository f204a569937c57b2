"""Step Φ of a compression, and how far each step is relaxed: which packings come out.

Grains are compressed in steps φ → φ + Φ (A, App. A). After each the forces are relaxed until

    max|F| < b f̄,     f̄ the mean contact force, b the intermediate balance

and only the packing asked for gets its final balance. A compression is chaotic: a contact that
opens at another moment may lead to another packing of the same ensemble, so that two protocols are
judged on the same random placements, sample by sample, in two ways:

    other packings     the share of samples that end in another packing than the reference's
    mean of x          (m² + e²)^(1/2) / σ, for x = φ_J, P, Z, G: m the mean of x − x_ref, e its
                       standard error, σ the standard deviation of x_ref: what m may well be

    one φ_J             the median of |φ_J − φ_J,ref| / σ: a sample that has not gone astray

Where a protocol only moves samples about within the ensemble, m stays below e, and e falls with the
share of other packings: one or two of them that jam elsewhere decide it, so that it may change many
times over when rounding does. The Kolmogorov–Smirnov distance of φ_J stands beside its mean.

φ_J is the last grid point without a mean contact force of 1e-10: a coarse grid rounds it down.
Reference: a fifth of the smallest Φ with the smallest b of all.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.stats import ks_2samp

from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.protocols.compression.trajectory import (
    compress_along_grid,
    compress_to,
    place_at_random,
)
from grainmodes.response.moduli import rigidity
from grainmodes.stages.rows import SAMPLE_ERRORS
from grainmodes.stages.samples import packed
from measurements.accuracy.diagram import Apart, Diagram, Row, Size, apart, of
from measurements.accuracy.packings import HERTZ

PHI, INTERACTION = 0.87, Interaction.from_law(ContactLaw(kt=1e-4))

STEPS = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4)
BALANCES = (1e-1, 1e-2, 1e-3, 1e-4)
SHIPPED = Compression()
REFERENCE = Compression(phi_step=2e-5, intermediate_balance=1e-5)

SAME = 1e-6
"""Relative difference of P up to which two packings are one."""

PHI_J, P, Z, G = range(4)
"""Columns of an ensemble."""

EQUAL_ENSEMBLES = 0.37
"""Standard deviation of the distance of two independent samples of S each, in S^(-1/2)."""


class Ensemble(NamedTuple):
    """φ_J, P, Z, G of every sample, (S, 4), NaN where it failed; mean CPU seconds of one."""

    samples: np.ndarray
    seconds: float


def ensemble(n: int, seeds: int, protocol: Compression) -> Ensemble:
    """All packings of a protocol at φ; those of one seed start from the same random placement."""
    _sample(n, 0, replace(protocol, phi_step=1e-2))
    start = time.process_time()
    samples = np.array([_sample(n, seed, protocol) for seed in range(seeds)])
    return Ensemble(samples, (time.process_time() - start) / seeds)


def _sample(n: int, seed: int, protocol: Compression) -> tuple[float, float, float, float]:
    try:
        grid = compress_along_grid(place_at_random(n, seed, HERTZ, protocol), PHI, HERTZ, protocol)
        packing = compress_to(grid, PHI, HERTZ, protocol).packing
        g = rigidity(packing, INTERACTION).unloaded.g
    except SAMPLE_ERRORS:
        return (np.nan,) * 4
    row = packed(packing, HERTZ)
    return grid.phi_jamming, row["pressure"], row["contact_number"], g


def measure(size: Size) -> Iterator[Row]:
    """The errors of every b and Φ."""
    for n in size.n:
        exact = apart(ensemble, n, size.seeds, REFERENCE).value.samples
        for balance in BALANCES:
            for step in STEPS:
                protocol = Compression(phi_step=step, intermediate_balance=balance)
                done = apart(ensemble, n, size.seeds, protocol)
                yield from _rows(done, exact, protocol, of(n, size))


def _rows(done: Apart, exact: np.ndarray, protocol: Compression, suffix: str) -> Iterator[Row]:
    """The share of other packings and φ_J; everything at the default b."""
    found, seconds = done.value
    counted = np.isfinite(found).all(axis=1) & np.isfinite(exact).all(axis=1)
    counts = int(counted.sum()), int((~counted).sum())
    measures = ALL if protocol.intermediate_balance == SHIPPED.intermediate_balance else FEW
    for name, (measure, columns) in measures.items():
        of_both = found[counted, columns], exact[counted, columns]
        error = measure(*of_both) if counts[0] > 1 else (np.nan, np.nan)
        curve = f"b = {protocol.intermediate_balance:g}, {name}{suffix}"
        point = protocol.phi_step, seconds, done.megabytes, *error
        yield Row(curve, *point, *counts, protocol == SHIPPED)


def other_packings(found: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """Share of the samples whose P (S,) is another one, and its standard error."""
    share = float(np.mean(np.abs(found / exact - 1.0) > SAME))
    return share, float(np.sqrt(share * (1.0 - share) / len(found)))


def shift_of_mean(found: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """What the mean of x − x_ref may well be, and its standard error, both / σ; of (S,) samples."""
    unit, difference = exact.std(ddof=1), found - exact
    error = difference.std(ddof=1) / np.sqrt(len(found))
    return float(np.hypot(difference.mean(), error) / unit), float(error / unit)


def shift_of_one(found: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """Median of |x − x_ref| / σ over (S,) samples, and half its interquartile range."""
    low, middle, high = np.quantile(np.abs(found - exact), [0.25, 0.5, 0.75]) / exact.std(ddof=1)
    return float(middle), float(0.5 * (high - low))


def distance(found: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """Kolmogorov–Smirnov distance of two samples (S,), and what equal ensembles scatter by."""
    return float(ks_2samp(found, exact).statistic), float(EQUAL_ENSEMBLES / np.sqrt(len(found)))


FEW = {
    "other packings": (other_packings, P),
    r"mean $\phi_J$": (shift_of_mean, PHI_J),
    r"one $\phi_J$": (shift_of_one, PHI_J),
}
ALL = FEW | {
    "mean P": (shift_of_mean, P),
    "mean Z": (shift_of_mean, Z),
    "mean G": (shift_of_mean, G),
    r"KS of $\phi_J$": (distance, PHI_J),
}
"""What is measured, and on which column."""

DIAGRAM = Diagram(
    title="Compression step and intermediate balance, φ = 0.87",
    setting=r"$\Phi$",
    unit="packing",
    error="share, shift / σ, or KS distance",
    reference="Φ = 2e-5, b = 1e-5, from the same random placements",
    small=Size((64,), 32),
    large=Size((256, 1024), 32),
    measure=measure,
)
