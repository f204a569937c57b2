"""A synthetic ensemble, made of formulas, on which every claim of paper A holds.

    G(φ, κ)   = A(φ) [1 + 10 κ] / [1 + κ] style interpolation of two power laws of φ - φ_c
    G_NA      ∝ (φ - φ_c) log(κ / κ*), which rises through 0 at κ* = 2 + 5 (0.90 - φ)
    rotations at ω = ω_R x, x peaked at 1 for φ = 0.90, moving down as (φ - φ_c)^(1/4)
    translations over a plateau that widens towards φ_c, and one sound wave at ω = 3e-4

Each number has a noise that depends on its seed only, like that of one packing at all k_T.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

NS, PHIS = (256, 4096), (0.86, 0.88, 0.90)
GRAINS = (256, 288)
"""Number of grains that have modes, so that a system of A's size is small."""

KTS = (0.0, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 2.0, 10.0)
SEEDS = 16
JAMMING = 0.84
SOUND = 3e-4
FRICTIONAL_N = 128
POINT = ("n", "phi", "kt", "seed")
STRAINS = (1e-6, 1e-5, 1e-4)


def ensemble() -> xr.Dataset:
    """The dataset, as `open_ensemble` would return it; every variable is writable."""
    coordinates = {"n": list(NS), "phi": list(PHIS), "kt": list(KTS), "seed": np.arange(SEEDS)}
    dataset = xr.Dataset(coords=coordinates, attrs={"config": "{}"})
    for build in (_samples, _moduli, _spectra, _rattlers, count_hessian, _probes):
        build(dataset)
    return _with_frictional_packings(dataset)


def set_moduli(dataset: xr.Dataset, g: xr.DataArray) -> None:
    """Set g and all moduli equal to it, so that a change of g affects only claims on g itself."""
    g = (g * noise(dataset, 0.05)).transpose(*POINT)
    dataset["g"], dataset["g_simulated"], dataset["g_translational"] = g, g * (1 + 1e-6), g.copy()
    steps = xr.DataArray(1.0 + np.array(STRAINS), dims="diagnostic")
    dataset["g_forward_by_strain"] = g * steps
    dataset["g_forward_damped"] = g.where(dataset["kt"] >= 1.0)


def bins_of(dataset: xr.Dataset, size: int = 2000) -> xr.Dataset:
    """The same ensemble with counts in fine bins instead of eigenvalues."""
    edges = np.geomspace(1e-7, 10.0, size + 1)
    frequency = np.sqrt(np.where(dataset["eigenvalue"] > 1e-13, dataset["eigenvalue"], np.nan))
    rows = zip(
        frequency.reshape(-1, frequency.shape[-1]),
        dataset["psi_rotational"].to_numpy().reshape(-1, frequency.shape[-1]),
        strict=True,
    )
    counts, psi = zip(*(_binned(*row, edges) for row in rows), strict=True)
    shape = frequency.shape[:-1]
    dataset = dataset.drop_vars(
        [name for name in dataset if {"mode", "bin"} & {*dataset[name].dims}]
    )
    dataset["bin_edge"] = (*POINT, "edge"), np.broadcast_to(edges, (*shape, size + 1)).copy()
    dataset["bin_count"] = (*POINT, "bin"), np.reshape(counts, (*shape, size))
    dataset["bin_psi_rotational"] = (*POINT, "bin"), np.reshape(psi, (*shape, size))
    return dataset


def _binned(frequency: np.ndarray, psi: np.ndarray, edges: np.ndarray):
    known = np.isfinite(frequency)
    count = np.histogram(frequency[known], edges)[0].astype(float)
    total = np.histogram(frequency[known], edges, weights=np.nan_to_num(psi[known]))[0]
    with np.errstate(invalid="ignore"):
        return count, total / count


def ones(dataset: xr.Dataset) -> xr.DataArray:
    """1 for every sample."""
    return xr.DataArray(np.ones([dataset.sizes[name] for name in POINT]), dims=POINT)


def noise(dataset: xr.Dataset, size: float) -> xr.DataArray:
    """Factors close to 1, one for each seed."""
    draws = np.random.default_rng(1).normal(1.0, size, SEEDS)
    return xr.DataArray(draws, dims="seed")


def _distance(dataset: xr.Dataset) -> xr.DataArray:
    return dataset["phi"] - JAMMING


def _samples(dataset: xr.Dataset) -> None:
    for name in ("converged", "jammed"):
        dataset[name] = ones(dataset)
    dataset["phi_jamming"] = JAMMING * ones(dataset)
    dataset["contact_changes"] = 0 * ones(dataset)


def _moduli(dataset: xr.Dataset) -> None:
    """G ∝ φ - φ_c without friction, ∝ (φ - φ_c)^(1/2) with much of it."""
    distance, kt = _distance(dataset), dataset["kt"]
    g = (distance + (1.0 - np.exp(-3.0 * kt)) * 0.4 * distance**0.5) * ones(dataset)
    set_moduli(dataset, g)
    logarithm = np.log(np.maximum(kt, 1e-12) / (2.0 + 5.0 * (0.90 - dataset["phi"])))
    nonaffine = distance * logarithm * noise(dataset, 0.05)
    dataset["g_nonaffine"] = (nonaffine * ones(dataset)).transpose(*POINT)
    loaded = -distance * (1 + kt) * noise(dataset, 0.05)
    dataset["g_nonaffine_loaded"] = (loaded * ones(dataset)).transpose(*POINT)


def _spectra(dataset: xr.Dataset) -> None:
    shape = [dataset.sizes[name] for name in POINT]
    eigenvalue = np.full((*shape, 3 * GRAINS[-1]), np.nan)
    psi = np.full_like(eigenvalue, np.nan)
    for place in np.ndindex(*shape):
        n, phi, kt = GRAINS[place[0]], PHIS[place[1]], KTS[place[2]]
        values, kind = _modes(n, phi, kt, seed=place[3])
        eigenvalue[(*place, slice(len(values)))] = values
        psi[(*place, slice(len(values)))] = kind
    dataset["eigenvalue"] = (*POINT, "mode"), eigenvalue
    dataset["psi_rotational"] = (*POINT, "mode"), psi
    scaled = np.sqrt(
        np.abs(eigenvalue) / np.maximum(dataset["kt"].to_numpy(), 1e-12)[:, None, None]
    )
    dataset["participation_ratio"] = (*POINT, "mode"), 0.2 + 0.1 * np.minimum(scaled, 2.0)


def _modes(n: int, phi: float, kt: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues, two zeros among them, and psi^R of one sample."""
    shares = (np.arange(n) + 0.5) / n
    wobble = np.random.default_rng([seed, 7]).normal(1.0, 0.01)
    rotational = _around_one(shares) * ((phi - JAMMING) / 0.06) ** 0.25 * wobble * np.sqrt(kt)
    lowest = 2.0 * (phi - JAMMING)
    plateau = lowest + (1.4 - lowest) * (np.arange(2 * n - 3) + 0.5) / (2 * n - 3)
    translational = np.concatenate([[SOUND], plateau * wobble])
    zeros = [1e-17, 2e-17]
    values = np.concatenate([zeros, rotational**2 if kt > 0 else [], translational**2])
    kind = np.concatenate([[0, 0], np.full(n if kt > 0 else 0, 0.99), np.full(2 * n - 2, 0.01)])
    order = values.argsort()
    return values[order], kind[order]


def _around_one(shares: np.ndarray) -> np.ndarray:
    """Quantiles of a band of x in 0.4 ... 1.6 whose density peaks at 1."""
    return 1.0 + 0.6 * np.sign(shares - 0.5) * np.abs(2 * shares - 1) ** 1.5


def _rattlers(dataset: xr.Dataset) -> None:
    """Two modes of single grains at ω = 0.1 ω_R below the band."""
    eigenvalue, shape = dataset["eigenvalue"], dataset["eigenvalue"].shape[:-1]
    contacts = np.full((*shape, eigenvalue.shape[-1] + 2), 4.0)
    contacts[..., -2:] = 2.0
    dataset["peak_contacts_rattlers"] = (*POINT, "mode_rattlers"), contacts
    kept = np.concatenate([eigenvalue.to_numpy(), np.full((*shape, 2), np.nan)], axis=-1)
    kept[..., -2:] = (0.01 * dataset["kt"].to_numpy())[None, None, :, None, None]
    ratio = np.full(kept.shape, 0.5)
    ratio[..., -2:] = 1.0 / np.array(NS)[:, None, None, None, None]
    dataset["mode_count"] = dataset["eigenvalue"].notnull().sum("mode").astype(float)
    dataset["mode_count_rattlers"] = dataset["mode_count"] + 2.0
    dataset["eigenvalue_rattlers"] = (*POINT, "mode_rattlers"), kept
    dataset["participation_ratio_rattlers"] = (*POINT, "mode_rattlers"), ratio


def count_hessian(dataset: xr.Dataset) -> None:
    """Counts of the Hessian in bins: those of the Jacobian, and others with printed constants."""
    edges = np.geomspace(1e-7, 10.0, 51)
    frequency = np.sqrt(np.where(dataset["eigenvalue"] > 1e-13, dataset["eigenvalue"], np.nan))
    count = np.apply_along_axis(lambda row: np.histogram(row, edges)[0], -1, frequency)
    shape = count.shape[:-1]
    dataset["bin_edge"] = (*POINT, "edge"), np.broadcast_to(edges, (*shape, 51)).copy()
    dataset["bin_count_hessian"] = (*POINT, "bin"), count.astype(float)
    dataset["bin_count_hessian_printed"] = (*POINT, "bin"), np.roll(count, 5, -1).astype(float)


def _probes(dataset: xr.Dataset) -> None:
    one = ones(dataset)
    dataset["field_difference"] = 1e-6 * noise(dataset, 0.01) * one
    dataset["hessian_shift_sheared"] = 1e-3 * noise(dataset, 0.01) * one
    dataset["diagnostic_strain"] = one * xr.DataArray(np.array(STRAINS), dims="diagnostic")
    dataset["verlet_order_position"] = 2.0 * noise(dataset, 0.01) * one
    dataset["verlet_order_velocity"] = 1.0 * noise(dataset, 0.01) * one


def _with_frictional_packings(dataset: xr.Dataset) -> xr.Dataset:
    """The dataset with packings of another N, compressed with friction; they have complex pairs."""
    dataset["compressed_with_friction"] = 0.0 * ones(dataset)
    dataset["complex_pairs_at_rest"] = 0.0 * ones(dataset)
    whole = dataset.reindex(n=[*NS, FRICTIONAL_N])
    there = {"n": FRICTIONAL_N, "phi": PHIS[-1], "kt": 1.0}
    for name in ("converged", "jammed", "compressed_with_friction"):
        whole[name].loc[there] = 1.0
    whole["complex_pairs_at_rest"].loc[there] = 3.0
    return whole
