"""Blocks and ensembles that look like those of a study, without any grain behind them.

Two translations at round-off, a rotational band at omega ~ (k_T)^(1/2), a translational band at
omega ~ 1, G growing with phi and k_T; below `JAMMING` nothing is jammed.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from grainmodes.dataset import Block, write_block
from grainmodes.ensemble import gather_point, write_ensemble
from grainmodes.parameters import format_value

JAMMING = 0.845


def block(stage: str, n: int, phi: float, kt: float, seeds: range, /, **changes) -> Block:
    """One block of a stage; `changes` replaces variables or, where there is none, attributes."""
    draws = np.random.default_rng([n, round(phi * 1e4), seeds.start])
    variables = {
        "seed": np.arange(seeds.start, seeds.stop),
        "converged": np.ones(len(seeds), dtype=np.int8),
    }
    variables |= _VARIABLES[stage](n, phi, kt, len(seeds), draws)
    attributes = {
        "stage": stage,
        "n": n,
        "phi": phi,
        "code_version": "0.1",
        "config": {"force_tolerance": 1e-14},
        "failures": {},
    }
    attributes |= {} if stage == "packings" else {"kt": kt}
    for name, value in changes.items():
        (variables if name in variables else attributes)[name] = value
    return Block(variables, attributes)


def ensemble(
    folder: Path,
    ns=(16,),
    phis=(0.83, 0.86, 0.90),
    kts=(1e-8, 1e-4, 1.0, 10.0),
    seeds=4,
    stages=None,
) -> Path:
    """Write an ensemble into `folder`, by way of blocks and points; return its path."""
    points = []
    for n in ns:
        for phi in phis:
            for kt in kts:
                points.append(point(folder, n, phi, kt, seeds, stages or tuple(_VARIABLES)))
    write_ensemble(points, folder / "ensemble.nc", {"scene": "synthetic"})
    return folder / "ensemble.nc"


def point(folder: Path, n: int, phi: float, kt: float, seeds: int, stages=None) -> Path:
    """Write the blocks of one point and the point; return the path of the point."""
    stem = folder / "-".join(map(format_value, (n, phi, kt)))
    paths = []
    for stage in stages or tuple(_VARIABLES):
        paths.append(stem.with_name(f"{stem.name}-{stage}.nc"))
        write_block(paths[-1], block(stage, n, phi, kt, range(seeds)))
    write_block(stem.with_name(f"{stem.name}.nc"), gather_point(paths))
    return stem.with_name(f"{stem.name}.nc")


def _packings(n, phi, kt, size, draws):
    return {
        "position": draws.random((size, n, 2)),
        "pressure": np.maximum(phi - JAMMING, 0.0) * np.ones(size),
        "jammed": np.full(size, phi > JAMMING, dtype=np.int8),
        "max_force": np.full(size, 5e-15),
        "rattler_count": draws.integers(0, 3, size),
        "iterations": draws.integers(1000, 2000, size),
    }


def _rigidity(n, phi, kt, size, draws):
    distance = max(phi - JAMMING, 0.0)
    spread = draws.normal(1.0, 0.05, size)
    affine = 2.0 * np.sqrt(distance) * np.minimum(distance * 10, 1.0) * spread
    nonaffine = affine * 0.3 * (kt - 2.0) / (kt + 2.0)
    return {
        "g": affine + nonaffine,
        "g_affine": affine,
        "g_nonaffine": nonaffine,
        "g_loaded": affine * (1 + kt) / (1 + 0.3 * kt),
        "g_nonaffine_loaded": -affine * (0.3 + kt),
        "jammed": np.full(size, phi > JAMMING, dtype=np.int8),
    }


def _step_strain(n, phi, kt, size, draws):
    theory = _rigidity(n, phi, kt, size, draws)["g"]
    return {"g_simulated": theory * (1 + 1e-6), "contact_changes": np.zeros(size, dtype=int)}


def _spectrum(n, phi, kt, size, draws):
    if phi <= JAMMING:
        missing = np.full((size, 3 * n), np.nan)
        return {"eigenvalue": missing, "psi_rotational": missing, "mode_count": np.zeros(size, int)}
    rotational = kt * draws.uniform(0.1, 1.5, (size, n))
    translational = draws.uniform(0.02, 1.4, (size, 2 * n - 2)) ** 2
    values = np.hstack([draws.normal(0, 1e-16, (size, 2)), rotational, translational])
    kind = np.hstack([np.zeros((size, 2)), np.ones((size, n)), np.zeros((size, 2 * n - 2))])
    order = values.argsort(axis=1)
    return {
        "eigenvalue": np.take_along_axis(values, order, axis=1),
        "psi_rotational": np.take_along_axis(kind, order, axis=1),
        "mode_count": np.full(size, 3 * n),
        "residual": np.full(size, 1e-15),
    }


_VARIABLES = {
    "packings": _packings,
    "rigidity": _rigidity,
    "step_strain": _step_strain,
    "spectrum": _spectrum,
}
