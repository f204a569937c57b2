"""The ensemble of `claim_fixtures` with released samples, on which the claims C4 to C7 hold."""

from __future__ import annotations

import numpy as np
import xarray as xr

import claim_fixtures

PLACE = {"n": 64, "phi": 0.90, "kt": 1.0}
DAMPINGS = np.array([0.0, 0.1, 1.0, 3.0, 100.0])
"""η_0 of the runs, in units of ω_i."""


def ensemble() -> xr.Dataset:
    """The dataset, as `open_ensemble` would return it; every variable is writable."""
    dataset = claim_fixtures.ensemble()
    rows = [_sample(seed) for seed in range(claim_fixtures.SEEDS)]
    for name in rows[0]:
        values = np.stack([np.asarray(row[name], float) for row in rows])
        dims = ("seed", "damping")[: values.ndim]
        dataset[f"release_{name}"] = xr.DataArray(values, dims=dims).expand_dims(
            {key: [value] for key, value in PLACE.items()}
        )
    return dataset


def _sample(seed: int) -> dict[str, object]:
    factor = np.random.default_rng([seed, 5]).normal(1.0, 0.05)
    rate, frequency = 2e-4 * factor, 0.7 * factor
    grows = DAMPINGS < 2.0
    damped = np.where(grows, rate * (1.0 - 0.5 * DAMPINGS), np.nan)
    nothing = np.where(DAMPINGS < 0.5, 1.0, np.nan)
    change = 17.0 / rate * nothing
    return {
        "rate_linear": rate,
        "frequency_linear": frequency,
        "damping": rate * DAMPINGS,
        "spiral_misfit": 1e-4 * factor,
        "spiral_overlap": 1.0 - 1e-6 * factor,
        "spiral_opening": 0.25 * factor,
        **{
            f"{field}_rate": damped * (1.0 + 1e-3 * factor)
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
        "end_time": change + 0.8 * factor / rate,
        "second_time": change + 30.0 * factor / rate,
        "largest_square": np.select([DAMPINGS < 0.5, grows], [0.1, 1e-6], 1e-22) * factor,
        "start_pressure": 6e-3 * factor,
        "start_stress_xy": 4e-4,
        "start_contact_number": 4.8,
        "after_pressure": 8e-3 * factor * nothing,
        "after_stress_xy": 1e-5 * factor * nothing,
        "after_contact_number": 4.2 * nothing,
    }
