"""Step Φ of a compression, and how far each step is relaxed: which packings come out.

Grains are compressed in steps φ → φ + Φ (A, App. A). After each the forces are relaxed until

    max|F| < b f̄,     f̄ the mean contact force, b the intermediate balance

and only the requested packing gets its final balance. A compression is chaotic: a contact that
opens at another moment may lead to another packing of the same ensemble. So two protocols are
compared on the same random placements, sample by sample:

    other packings     fraction of the samples that end in another packing than the reference
    mean of x          (m² + e²)^(1/2) / σ, for x = φ_J, P, Z, G: m the mean of x − x_ref, e its
                       standard error, σ the standard deviation of x_ref; a bound of |m|
    one φ_J            median of |φ_J − φ_J,ref| / σ: a typical sample

Where a protocol only exchanges packings within the ensemble, m stays below e, and e falls with the
fraction of other packings. One or two packings that jam at another φ decide it, so that it may
change by a large factor with the rounding. The Kolmogorov–Smirnov distance of φ_J is shown as well.

φ_J is the last grid point with a mean contact force below 1e-10: a coarse grid rounds it down.
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
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import SAMPLE_ERRORS
from measurements.accuracy.diagram import (
    Diagram,
    DiagramRow,
    ProcessResult,
    Size,
    in_fresh_process,
    size_suffix,
)
from measurements.accuracy.packings import HERTZ, shift_of_mean

PHI, INTERACTION = 0.87, Interaction.from_law(ContactLaw(kt=1e-4))

STEPS = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4)
BALANCES = (1e-1, 1e-2, 1e-3, 1e-4)
DEFAULT = Compression()
REFERENCE = Compression(phi_step=2e-5, intermediate_balance=1e-5)

PRESSURE_TOLERANCE = 1e-6
"""Relative difference of P up to which two packings count as the same."""

PHI_J, P, Z, G = range(4)
"""Columns of an ensemble."""

KS_SCATTER = 0.37
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
    row = packing_row(packing, HERTZ)
    return grid.phi_jamming, row["pressure"], row["contact_number"], g


def measure(size: Size) -> Iterator[DiagramRow]:
    """The errors of every b and Φ."""
    for n in size.n:
        exact = in_fresh_process(ensemble, n, size.seeds, REFERENCE).value.samples
        for balance in BALANCES:
            for step in STEPS:
                protocol = Compression(phi_step=step, intermediate_balance=balance)
                done = in_fresh_process(ensemble, n, size.seeds, protocol)
                yield from _rows(done, exact, protocol, size_suffix(n, size))


def _rows(
    done: ProcessResult, exact: np.ndarray, protocol: Compression, suffix: str
) -> Iterator[DiagramRow]:
    """The fraction of other packings and φ_J; all measures at the default b."""
    found, seconds = done.value
    counted = np.isfinite(found).all(axis=1) & np.isfinite(exact).all(axis=1)
    counts = int(counted.sum()), int((~counted).sum())
    measures = (
        MEASURES_AT_DEFAULT
        if protocol.intermediate_balance == DEFAULT.intermediate_balance
        else MEASURES
    )
    for name, (measure, columns) in measures.items():
        both = found[counted, columns], exact[counted, columns]
        error = measure(*both) if counts[0] > 1 else (np.nan, np.nan)
        curve = f"b = {protocol.intermediate_balance:g}, {name}{suffix}"
        point = protocol.phi_step, seconds, done.megabytes, *error
        yield DiagramRow(curve, *point, *counts, protocol == DEFAULT)


def other_packings(found: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """Fraction of the samples whose P (S,) differs, and its standard error."""
    share = float(np.mean(np.abs(found / exact - 1.0) > PRESSURE_TOLERANCE))
    return share, float(np.sqrt(share * (1.0 - share) / len(found)))


def shift_of_one(found: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """Median of |x − x_ref| / σ over (S,) samples, and half its interquartile range."""
    low, middle, high = np.quantile(np.abs(found - exact), [0.25, 0.5, 0.75]) / exact.std(ddof=1)
    return float(middle), float(0.5 * (high - low))


def distance(found: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """Kolmogorov–Smirnov distance of two samples (S,), and its scatter for equal ensembles."""
    return float(ks_2samp(found, exact).statistic), float(KS_SCATTER / np.sqrt(len(found)))


MEASURES = {
    "other packings": (other_packings, P),
    r"mean $\phi_J$": (shift_of_mean, PHI_J),
    r"one $\phi_J$": (shift_of_one, PHI_J),
}
MEASURES_AT_DEFAULT = MEASURES | {
    "mean P": (shift_of_mean, P),
    "mean Z": (shift_of_mean, Z),
    "mean G": (shift_of_mean, G),
    r"KS of $\phi_J$": (distance, PHI_J),
}
"""Name → measure, and the column it is applied to."""

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
