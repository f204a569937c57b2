"""The ensemble of `claim_fixtures` with complex pairs: every claim of paper C on pairs holds.

no pair in the first of five states, then one, two, three, four
a birth and a death in every sample, (λ1 − λ2)² proportional to γ − γ_c, exponents 1/2
1 − scalar product proportional to γ − γ_c
"""

from __future__ import annotations

import numpy as np
import xarray as xr

import claim_fixtures

PLACE = {"n": claim_fixtures.NS[-1], "phi": 0.90, "kt": 1.0}
DELTA = np.logspace(-8, -5, 4)
STEEP = 1e2
"""(1 − product) / (γ − γ_c)."""


def ensemble() -> xr.Dataset:
    """The dataset, as `open_ensemble` would return it; every variable is writable."""
    dataset = claim_fixtures.ensemble()
    rows = [_sample(seed) for seed in range(claim_fixtures.SEEDS)]
    for name in rows[0]:
        axes = {"pair": "pair_state", "neighbour": "neighbour_state", "track": "track"}
        axis = axes.get(name.partition("_")[0], "exceptional_point")
        values = np.stack([np.asarray(row[name], float) for row in rows])
        dims = ("seed", axis)[: values.ndim]
        dataset[name] = xr.DataArray(values, dims=dims).expand_dims(
            {key: [value] for key, value in PLACE.items()}
        )
    return dataset


def _sample(seed: int) -> dict[str, object]:
    noise = np.random.default_rng([seed, 5]).normal(0.0, 1e-3, 2)
    distance = np.tile(np.concatenate([-DELTA[::-1], DELTA]), 2)
    sign = np.repeat([-1.0, 1.0], len(distance) // 2)
    discriminant = 1e-2 * sign * distance
    return {
        "pair_state_count": 5,
        "pair_count": np.arange(5),
        "pair_strain": 1e-3 * np.arange(5),
        "track_count": 4 + seed % 2,
        "track_birth_kind": [1],
        "track_death_kind": [1],
        "exceptional_point_track": [0, 0],
        "exceptional_point_birth": [1, 0],
        "exceptional_point_kind": [1, 1],
        "exceptional_point_strain": [1e-3, 3e-3],
        "exceptional_point_exponent_real": 0.5 + noise,
        "exceptional_point_exponent_pair": 0.5 - noise,
        "neighbour_point": np.repeat([0, 1], len(distance) // 2),
        "neighbour_distance": distance,
        "neighbour_sum": 0.4 + 0.0 * distance,
        "neighbour_discriminant": discriminant,
        "neighbour_product": 1.0 - STEEP * np.where(discriminant > 0.0, np.abs(distance), 0.0),
        "neighbour_condition": 1.0 / np.sqrt(np.abs(discriminant)),
    }
