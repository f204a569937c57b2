"""Synthetic blocks and ensembles, made of formulas, that look like those of a study.

Two translations at round-off, a rotational band at omega ~ (k_T)^(1/2), a translational band at
omega ~ 1, G growing with phi and k_T; below `JAMMING` nothing is jammed. `spectrum_bins` counts the
modes of `spectrum`, in `spectrum_rattlers` the three highest belong to a rattler, and the Hessian
with the printed constants has every mode one bin too high.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from grainmodes.dataset.files import Block, write_block
from grainmodes.ensemble import gather_point, write_ensemble
from grainmodes.parameters.grid import format_value
from grainmodes.parameters.law import TANGENTIAL_LAWS

JAMMING = 0.845
STAGES = ("packings", "rigidity", "step_strain", "spectrum")
WHOLE = (
    *STAGES,
    "spectrum_rattlers",
    "spectrum_hessian",
    "shear",
    "complex_pairs",
    "law_comparison",
)


def block(stage: str, n: int, phi: float, kt: float, seeds: range, /, **changes) -> Block:
    """One block of a stage; `changes` replaces variables or, where there is none, attributes."""
    draws = np.random.default_rng([n, round(phi * 1e4), seeds.start])
    variables = {
        "seed": np.arange(seeds.start, seeds.stop),
        "converged": np.ones(len(seeds), dtype=np.int8),
    }
    variables |= _VARIABLES[stage](n, phi, kt, len(seeds), draws)
    attributes = {
        "stage": "spectrum" if stage == "spectrum_bins" else stage,
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
                points.append(point(folder, n, phi, kt, seeds, stages or STAGES))
    write_ensemble(points, folder / "ensemble.nc", {"scene": "synthetic"})
    return folder / "ensemble.nc"


def point(folder: Path, n: int, phi: float, kt: float, seeds: int, stages=None) -> Path:
    """Write the blocks of one point and the point; return the path of the point."""
    stem = folder / "-".join(map(format_value, (n, phi, kt)))
    paths = []
    for stage in stages or STAGES:
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
        "phi_jamming": np.full(size, JAMMING),
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
    rotations = n if kt else 0
    columns = 2 * n + rotations
    names = ("eigenvalue", "psi_rotational", "participation_ratio")
    if phi <= JAMMING:
        return dict.fromkeys(names, np.full((size, columns), np.nan)) | {
            "mode_count": np.zeros(size, int)
        }
    rotational = kt * draws.uniform(0.1, 1.5, (size, rotations))
    translational = draws.uniform(0.02, 1.4, (size, 2 * n - 2)) ** 2
    values = np.hstack([draws.normal(0, 1e-16, (size, 2)), rotational, translational])
    kind = np.hstack([np.zeros((size, 2)), np.ones((size, rotations)), np.zeros((size, 2 * n - 2))])
    measured = (values, kind, draws.uniform(0.2, 0.6, (size, columns)))
    order = values.argsort(axis=1)
    modes = (np.take_along_axis(quantity, order, axis=1) for quantity in measured)
    return dict(zip(names, modes, strict=True)) | {
        "mode_count": np.full(size, columns),
        "residual": np.full(size, 1e-15),
    }


def edges(kt):
    """The bins of every sample at k_T, around all its modes."""
    lowest, highest = min(0.01, 0.2 * np.sqrt(kt or 1.0)), max(1.6, 1.3 * np.sqrt(kt))
    return np.concatenate([np.geomspace(lowest, 0.1, 12)[:-1], np.linspace(0.1, highest, 40)])


def _spectrum_bins(n, phi, kt, size, draws):
    modes = _spectrum(n, phi, kt, size, draws)
    inside = _in_bin(modes["eigenvalue"], edges(kt))
    count = inside.sum(axis=1)
    names = ("psi_rotational", "participation_ratio")
    with np.errstate(invalid="ignore"):
        means = [np.nansum(modes[name][:, :, None] * inside, axis=1) / count for name in names]
    row = {"bin_edge": np.tile(edges(kt), (size, 1)), "bin_count": count}
    row |= {"mode_count": modes["mode_count"], "modes_below": modes["mode_count"] - count.sum(1)}
    for name, mean, error in zip(names, means, (0.01, 0.02), strict=True):
        row |= {f"bin_{name}": mean, f"bin_{name}_error": error + 0 * mean}
    return row


def _spectrum_rattlers(n, phi, kt, size, draws):
    modes = _spectrum(n, phi, kt, size, draws)
    lone = {"eigenvalue": [0.0, 0.0, 0.01 * kt], "psi_rotational": 1, "participation_ratio": 1 / n}
    if phi > JAMMING:
        for name, value in lone.items():
            modes[name][:, -3:] = value
    return {f"{name}_rattlers": modes[name] for name in (*lone, "mode_count")}


def _spectrum_hessian(n, phi, kt, size, draws):
    modes = _spectrum(n, phi, kt, size, draws)
    count = _in_bin(modes["eigenvalue"], edges(kt)).sum(axis=1)
    return {
        "bin_edge": np.tile(edges(kt), (size, 1)),
        "bin_count_hessian": count,
        "bin_count_hessian_printed": np.roll(count, 1, axis=1),
    }


def _shear(n, phi, kt, size, draws):
    """σ rises by 0.3 Δγ in steps of 1e-3 and falls by 1e-3 in an event in step 5, within 1e-5."""
    if phi <= JAMMING:
        return {"curve_count": np.zeros(size, int), "jammed": np.zeros(size, np.int8)}
    strain = np.append(np.arange(11) * 1e-3, 4.01e-3 + np.array([0.0, 1e-5]))
    strain.sort()
    one, after = np.ones((size, 1)), strain > 4.015e-3
    stress = one * (0.3 * strain - 1e-3 * after)
    g = 0.3 * one * np.ones(len(strain))
    return {
        "curve_count": np.full(size, len(strain)),
        "curve_strain": one * strain,
        "curve_stress_xy": stress + 1e-4,
        "curve_stress_yx": stress - 1e-4,
        "coarse_strain": one * strain,
        "coarse_stress": stress + 1e-5,
        "curve_g_xy": g,
        "curve_g_yx": g,
        "curve_lowest_eigenvalue": one * (0.2 - 0.05 * after),
        "event_strain_before": one * 4.01e-3,
        "change_strain_before": one * 8e-3,
        "jammed": np.ones(size, np.int8),
    }


def _variants(n, phi, kt, size, draws):
    """A pair every second state, ω_i = 0.01, which grows unless a sharp spring had to slip."""
    if phi <= JAMMING:
        return {"comparison_count": np.zeros(size, int), "jammed": np.zeros(size, np.int8)}
    one, pairs = np.ones((size, 1)), np.arange(5) % 2
    row = {"comparison_count": np.full(size, 5), "jammed": np.ones(size, np.int8)}
    row["comparison_strain"] = one * np.arange(1, 6) * 1e-3
    for law in TANGENTIAL_LAWS:
        sharp = law.startswith("sharp")
        found = pairs * (law != "elastic_force")
        row[f"comparison_pairs_slipping_{law}"] = one * found
        row[f"comparison_pairs_sticking_{law}"] = one * found * (not sharp)
        row[f"comparison_slipping_{law}"] = one * found * sharp
        row[f"comparison_rate_{law}"] = 0.01 * one * found
        row[f"comparison_growth_{law}"] = np.where(one * found > 0, 0.0 if sharp else 0.01, np.nan)
    return row


def _pairs(n, phi, kt, size, draws):
    """A pair from γ = 4e-3 to 8e-3, (λ1 − λ2)² = (γ − 4e-3)(γ − 8e-3) and 1e-2 (λ1 − λ2)² near it.

    The scalar product is 1 for a pair and 1 − (λ1 − λ2)²/1e-5 else; N = 8 tells all products.
    """
    if phi <= JAMMING or kt == 0.0:
        return {"pair_state_count": np.zeros(size, int), "jammed": np.zeros(size, np.int8)}
    one, strain = np.ones((size, 1)), np.arange(13) * 1e-3
    squared = (strain - 4e-3) * (strain - 8e-3)
    half = 0.5 * np.sqrt(squared.astype(complex))
    ends, delta = np.array([4e-3, 8e-3]), np.logspace(-8, -5, 4)
    distance = np.concatenate([-delta[::-1], delta])
    near = np.concatenate([-1e-2 * distance, 1e-2 * distance])
    row = {
        "pair_state_count": np.full(size, len(strain)),
        "pair_strain": one * strain,
        "pair_count": one * (squared < 0.0),
        "track_birth_kind": one * [1],
        "track_death_kind": one * [1],
        "exceptional_point_track": one * [0, 0],
        "exceptional_point_birth": one * [1, 0],
        "exceptional_point_kind": one * [1, 1],
        "exceptional_point_strain": one * ends,
        "exceptional_point_exponent_real": one * [0.5, 0.5],
        "exceptional_point_exponent_pair": one * [0.5, 0.5],
        "neighbour_point": one * np.repeat([0, 1], len(distance)),
        "neighbour_distance": one * np.tile(distance, 2),
        "neighbour_sum": one * np.full(len(near), 0.4),
        "neighbour_discriminant": one * near,
        "neighbour_product": one * (1.0 - near.clip(0.0) / 1e-5),
        "neighbour_condition": one / np.abs(near),
        "followed_point": one * np.zeros(len(strain)),
        "followed_strain": one * strain,
        "followed_real_1": one * (0.2 + half.real),
        "followed_real_2": one * (0.2 - half.real),
        "followed_imaginary": one * half.imag,
        "followed_product": one * (1.0 - squared.clip(0.0) / 1e-4),
        "jammed": np.ones(size, np.int8),
    }
    return row | (_products(strain, squared, one) if n == 8 else {})


def _products(strain, squared, one):
    """Those of mode 3: with mode 4 as above, with all others 0.1."""
    other = np.tile([0, 1, 2, 4], len(strain))
    value = np.where(other == 4, np.repeat(1.0 - squared.clip(0.0) / 1e-4, 4), 0.1)
    return {
        "product_strain": one * np.repeat(strain, 4),
        "product_mode": one * np.full(len(other), 3),
        "product_other": one * other,
        "product_value": one * value,
    }


def _in_bin(eigenvalue, edges):
    """Whether a mode lies in a bin: (samples, modes, bins)."""
    squared = edges**2
    above = eigenvalue[:, :, None] >= squared[:-1]
    return above & (eigenvalue[:, :, None] < squared[1:])


_VARIABLES = {
    "packings": _packings,
    "rigidity": _rigidity,
    "step_strain": _step_strain,
    "spectrum": _spectrum,
    "spectrum_bins": _spectrum_bins,
    "spectrum_rattlers": _spectrum_rattlers,
    "spectrum_hessian": _spectrum_hessian,
    "shear": _shear,
    "law_comparison": _variants,
    "complex_pairs": _pairs,
}
