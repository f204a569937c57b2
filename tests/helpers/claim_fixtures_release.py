"""The ensemble of `claim_fixtures` with released states, on which the claims on them hold.

Every sample has three states, whose ω_i are a decade apart, and five runs of each.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

import claim_fixtures

PLACE = {"n": claim_fixtures.NS[-1], "phi": 0.90, "kt": 1.0}
DAMPINGS = np.array([0.0, 0.1, 1.0, 3.0, 100.0])
"""η_0 of the runs, in units of ω_i."""

RATES = np.array([2e-3, 2e-4, 2e-5])
"""ω_i of the states of a sample, in 1/t_0."""

THRESHOLD = 4.0
"""η_0 at which the growth ends, in units of ω_i."""

DIMENSIONS = {
    **dict.fromkeys(("pressure_by_z_before", "pressure_by_z_after"), "contacts_of_grain"),
}
"""Variables with another second dimension than the dampings."""


def ensemble() -> xr.Dataset:
    """The dataset, as `open_ensemble` would return it; every variable is writable."""
    dataset = claim_fixtures.ensemble()
    rows = [
        [_state(seed, place) for place in range(len(RATES))] for seed in range(claim_fixtures.SEEDS)
    ]
    for name in rows[0][0]:
        values = np.array([[state[name] for state in states] for states in rows], float)
        dims = ("seed", "release_state", DIMENSIONS.get(name, "damping"))[: values.ndim]
        dataset[f"release_{name}"] = xr.DataArray(values, dims=dims).expand_dims(
            {key: [value] for key, value in PLACE.items()}
        )
    return dataset


def _state(seed: int, place: int) -> dict[str, object]:
    factor = np.random.default_rng([seed, place, 5]).normal(1.0, 0.05)
    rate, frequency = RATES[place] * factor, 0.7 * factor
    grows = DAMPINGS < THRESHOLD
    damped = rate * (1.0 - DAMPINGS / THRESHOLD)
    fitted = np.where(grows, damped, np.nan)
    nothing = np.where(DAMPINGS < 0.5, 1.0, np.nan)
    change = 17.0 / rate * nothing
    pressures = 6e-3 * factor * np.array([np.nan, np.nan, 0.5, 1.0, 1.5, np.nan])
    return {
        "rate_linear": rate,
        "frequency_linear": frequency,
        "damping": rate * DAMPINGS,
        "rate_damped": damped,
        "threshold": THRESHOLD * rate,
        "noise_rate": rate * (1.0 + 5e-3 * factor),
        "noise_frequency": frequency * (1.0 + 1e-4 * factor),
        "start_pairs": 3 + seed % 2,
        "spiral_misfit": 1e-4 * factor,
        "spiral_overlap": 1.0 - 1e-6 * factor,
        "spiral_opening": 0.25 * factor,
        **{
            f"{field}_rate": fitted * (1.0 + 1e-3 * factor)
            for field in ("displacement", "rotation")
        },
        **{
            f"{field}_frequency": np.where(grows, frequency * (1.0 + 4e-4), np.nan)
            for field in ("displacement", "rotation")
        },
        "displacement_depth": 0.2 * factor * nothing,
        "rotation_depth": 0.3 * factor * nothing,
        "change_square": 1e-7 * factor * nothing,
        "change_time": change,
        "end_square": 2e-7 * factor * nothing,
        "end_time": change + 0.8 * factor / rate,
        "death_time": change[0] + 0.5 * factor / rate,
        "second_time": change + 30.0 * factor / rate,
        "largest_square": np.select([DAMPINGS < 0.5, grows], [0.1, 1e-6], 1e-22) * factor,
        "growth_sliding": (2 + seed % 3) * nothing,
        "diffusion_exponent": factor * nothing,
        "start_pressure": 6e-3 * factor,
        "start_stress_xy": 4e-4,
        "start_contact_number": 4.8,
        "start_sliding": 1.0,
        "after_pressure": 8e-3 * factor * nothing,
        "after_stress_xy": 1e-5 * factor * nothing,
        "after_contact_number": 4.2 * nothing,
        "after_sliding": 9.0 * factor * nothing,
        "after_mean_square_displacement": 3.0 * factor * nothing,
        "binary_tail_before": 0.02 * factor,
        "binary_tail_after": 0.05 * factor**2,
        "pressure_by_z_before": pressures,
        "pressure_by_z_after": 1.5 * factor * pressures,
    }
