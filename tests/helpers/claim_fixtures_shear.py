"""The ensemble of `claim_fixtures` with sheared harmonic grains: every claim of paper B holds.

every step raises σ by g Δγ - Δγ², so that σ_th is right to order Δγ²
an event every 0.0125, bracketed to Δγ_Th in tenths of Δγ_in, in which σ falls and λ_min and g jump
a change without event every 0.1, in which a contact opens
"""

from __future__ import annotations

import json

import numpy as np
import xarray as xr

import claim_fixtures

N, PHI, KT = claim_fixtures.NS[0], 0.90, 1.0
PLACE = {"n": N, "phi": PHI, "kt": KT}
STEP, SMALLEST, STRAIN = 1e-3, 1e-7, 0.4
EVENTS = np.arange(0.0053, STRAIN, 0.0125)
"""γ_c of the events, the same in every sample."""
CHANGES = EVENTS[:-1:8] + 0.005
DROP = 1e-3
JUMPS = 3e-4 * np.arange(1, len(EVENTS) + 1)
"""Fall of g in every event."""
UNITS = round(STEP / SMALLEST)


def ensemble() -> xr.Dataset:
    """The dataset, as `open_ensemble` would return it; every variable is writable."""
    dataset = claim_fixtures.ensemble()
    dataset.attrs["config"] = json.dumps({"contact_law": {"normal": "harmonic"}})
    rows = [_sample(seed) for seed in range(claim_fixtures.SEEDS)]
    for name in rows[0]:
        axis = name.partition("_")[0].replace("curve", "state")
        values = np.stack([np.asarray(row[name], float) for row in rows])
        dims = ("seed", axis)[: values.ndim]
        dataset[name] = xr.DataArray(values, dims=dims).expand_dims(
            {key: [value] for key, value in PLACE.items()}
        )
    return dataset


def strains() -> np.ndarray:
    """The grid of Δγ_in, and before every event steps of a tenth, a hundredth and so on."""
    units = set(range(0, round(STRAIN / SMALLEST) + 1, UNITS))
    for critical in EVENTS:
        now, target = critical // STEP * UNITS, round(critical / SMALLEST)
        size = UNITS // 10
        while size:
            while now + size <= target:
                now += size
                units.add(round(now))
            size //= 10
        units.add(target + 1)
    return np.array(sorted(units)) * SMALLEST


def stress_of(strain: np.ndarray, g: np.ndarray) -> np.ndarray:
    """σ of a curve without events."""
    step = np.diff(strain)
    return np.concatenate([[0.0], np.cumsum(g[:-1] * step - step**2)])


def add_stress(dataset: xr.Dataset, added: np.ndarray) -> None:
    """Raise both components of the stress of every sample by (M,) or (S, M)."""
    for name in ("curve_stress_xy", "curve_stress_yx"):
        dataset[name].loc[PLACE] += added
    dataset["coarse_stress"].loc[PLACE] += added[..., on_grid(strains())]


def on_grid(strain: np.ndarray) -> np.ndarray:
    """Which states lie on the grid of Δγ_in."""
    return np.abs(strain / STEP - np.round(strain / STEP)) < 1e-9


def _sample(seed: int) -> dict[str, object]:
    strain = strains()
    factor = np.random.default_rng([seed, 3]).normal(1.0, 0.02)
    before = np.searchsorted(strain, EVENTS + 0.5 * SMALLEST) - 1
    passed = np.searchsorted(before, np.arange(len(strain)), side="left")
    g = factor * (0.3 - 0.2 * strain - 0.0003 * passed)
    stress = stress_of(strain, g) - DROP * passed
    lowest = factor * (0.2 - 0.1 * strain) * 0.98**passed
    changes = np.searchsorted(strain, CHANGES)
    grid = on_grid(strain)
    one, width = np.ones(len(before)), STEP / 10.0 ** np.arange(7)
    return {
        "curve_count": len(strain),
        "curve_strain": strain,
        "curve_stress_xy": stress - 1e-3,
        "curve_stress_yx": stress + 1e-3,
        "curve_g_xy": g,
        "curve_g_yx": g,
        "curve_lowest_eigenvalue": lowest,
        "coarse_strain": strain[grid],
        "coarse_stress": (stress * (1.0 + np.where(strain > 0.08, 0.05, 1e-4) * factor))[grid],
        "event_kind": one,
        "event_strain_before": strain[before],
        "event_stress_before": stress[before],
        "event_stress_after": stress[before + 1],
        "event_g_before": g[before],
        "event_g_after": g[before] - JUMPS * factor,
        "event_opened": one,
        "event_closed": 0.0 * one,
        "event_reopened": 0.0 * one,
        "event_asymmetry_after": 0.0 * one,
        "event_complex_pairs_after": 0.0 * one,
        "event_quadrupole": 0.5 * factor * one,
        "event_quadrupole_rank": 0.005 * one,
        "event_other_multipoles": 0.02 * one,
        "bracket_min_step": width,
        "bracket_strain_before": EVENTS[0] - 0.5 * width,
        "bracket_strain_after": EVENTS[0] + 0.5 * width + 0.2 * factor * width,
        "last_complex_pairs": 0.0,
        "last_path_error": 1e-16 * factor,
        "last_path_increment": 1e-16 * factor,
        "last_path_turn": 1e-4,
        "loop_strain": 0.002,
        "loop_slide": 1e-4 * factor,
        "loop_left": 1e-9 * factor,
        "rate_difference": 1e-6 * factor,
        "change_strain_before": strain[changes],
    }
