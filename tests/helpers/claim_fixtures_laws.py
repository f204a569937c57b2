"""Sheared harmonic grains under several tangential laws, on which C8 and C9 hold.

Under the smoothed law every second state has pairs that grow with ω_i; under the sharp one such
states have pairs only if springs at their threshold slip, and do not grow.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

import claim_fixtures
import claim_fixtures_shear

STATES = 10
RATE = 0.01
NUMBERS = {
    "smoothed_coulomb": {"pairs_slipping": 3.0, "pairs_sticking": 3.0, "growth": RATE},
    "sharp_coulomb": {"pairs_slipping": 2.0, "pairs_sticking": 0.0, "growth": 0.0},
}


def ensemble() -> xr.Dataset:
    """The dataset, as `open_ensemble` would return it; every variable is writable."""
    dataset = claim_fixtures_shear.ensemble()
    having = np.arange(STATES) % 2 == 1
    for law, numbers in NUMBERS.items():
        rate = np.where(having, RATE, 0.0)
        _add(dataset, f"comparison_rate_{law}", rate)
        for name, value in numbers.items():
            by_state = np.where(having, value, np.nan if name == "growth" else 0.0)
            _add(dataset, f"comparison_{name}_{law}", by_state)
    return dataset


def _add(dataset: xr.Dataset, name: str, states: np.ndarray) -> None:
    noise = np.random.default_rng(len(name)).normal(1.0, 0.01, (claim_fixtures.SEEDS, 1))
    rows = xr.DataArray(noise * states, dims=("seed", "comparison_state"))
    place = {key: [value] for key, value in claim_fixtures_shear.PLACE.items()}
    dataset[name] = rows.expand_dims(place)
