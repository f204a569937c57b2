"""Number of seeds: how accurate the ensemble averages of G and of D(ω) are.

S seeds give a mean x̄ with a standard error s/S^(1/2) (`statistics`), as long as the samples are
independent and the distribution is not too broad. An ensemble of T seeds is cut into groups of S:

    found     root mean square over groups of x̄_group − x̄_others
    stated    root mean square over groups of the standard error that a group states for itself

both relative to the mean of all. Where the two agree, error bars mean what they say. D(ω) is
considered in the bins in which an average spectrum has at least one mode; the median of these bins
is shown.

Reference: x̄_others, the T − S seeds of all other groups, S ≤ T/4, whose own error adds at most a
sixth.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import Eigenproblem, average_in_bins
from grainmodes.stages.rows import SAMPLE_ERRORS
from grainmodes.statistics.averages import average
from grainmodes.statistics.binning import fixed_edges
from measurements.accuracy.diagram import Diagram, DiagramRow, Size, in_fresh_process, size_suffix
from measurements.accuracy.packings import compressed

PHI, KT = 0.9, 1e-4
INTERACTION = Interaction.from_law(ContactLaw(kt=KT))

DEFAULT_SEEDS = 8
"""Seeds of the scene in config/default.yaml."""

MIN_GROUPS = 4
"""Smallest number of groups."""

MIN_MODES_PER_BIN = 1.0
"""Smallest mean number of modes in a bin that is considered."""


def measure(size: Size) -> Iterator[DiagramRow]:
    """Errors of ensembles of 2, 4, 8 … seeds, to a quarter of all."""
    for n in size.n:
        done = in_fresh_process(ensemble, n, size.seeds)
        found = done.value[np.isfinite(done.value).all(axis=1)]
        failed = len(done.value) - len(found)
        cost = done.seconds / len(done.value)
        occupied = np.append(True, found[:, 1:].mean(axis=0) >= MIN_MODES_PER_BIN)
        for seeds in ensemble_sizes(len(found)):
            errors = errors_of_means(found[:, occupied], seeds)
            for name, (g, *density) in zip(("found", "stated"), errors, strict=True):
                for quantity, error in (("G", g), (r"$D(\omega)$", np.median(density, axis=0))):
                    curve = f"{name}, {quantity}{size_suffix(n, size)}"
                    point = seeds * cost, done.megabytes, *map(float, error)
                    yield DiagramRow(
                        curve, seeds, *point, len(found), failed, seeds == DEFAULT_SEEDS
                    )


def ensemble_sizes(total: int) -> list[int]:
    """2, 4, 8 … up to `total` / `MIN_GROUPS`."""
    return [2**k for k in range(1, 64) if MIN_GROUPS * 2**k <= total]


def ensemble(n: int, seeds: int) -> np.ndarray:
    """G, and the modes in A's bins, of every seed, (T, 1 + B); NaN where a packing failed."""
    edges = fixed_edges(KT, SpectrumChoices().bin_density)
    found = np.full((seeds, len(edges)), np.nan)
    for seed in range(seeds):
        try:
            packing = compressed(n, seed, PHI)
            g = rigidity(packing, INTERACTION).unloaded.g
            modes = average_in_bins(
                Eigenproblem.from_packing(packing, INTERACTION), edges, averages=False
            ).count
        except SAMPLE_ERRORS:
            continue
        found[seed] = np.append(g, modes)
    return found


def errors_of_means(samples: np.ndarray, seeds: int) -> tuple[np.ndarray, np.ndarray]:
    """(found, stated) error of the means of S seeds, relative to the mean of all.

    Args:
        samples: (T, Q), T at least 2 S.

    Returns:
        arrays (Q, 2): each error with its own standard error over the groups.
    """
    groups = len(samples) // seeds
    parts = samples[: groups * seeds].reshape(groups, seeds, -1)
    mean, error, _ = average(np.moveaxis(parts, 1, 2), np.ones((groups, 1, seeds), bool))
    others = (samples.sum(axis=0) - seeds * mean) / (len(samples) - seeds)
    mean_of_all = samples.mean(axis=0)
    return tuple(_root_mean_square(x / mean_of_all) for x in (mean - others, error))


def _root_mean_square(values: np.ndarray) -> np.ndarray:
    """Over the groups (groups, Q), with its standard error; (Q, 2)."""
    root = np.sqrt((values**2).mean(axis=0))
    scatter = (values**2).std(axis=0, ddof=1) / np.sqrt(len(values))
    return np.stack([root, 0.5 * scatter / root], axis=1)


DIAGRAM = Diagram(
    title="Number of seeds, φ = 0.90, $k_T/k_N = 10^{-4}$",
    setting="seeds",
    unit="ensemble",
    error="relative error of a mean",
    reference="the mean of all other seeds of 512",
    small=Size((64,), 512),
    large=Size((256, 1024), 512),
    measure=measure,
)
