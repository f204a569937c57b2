"""The linear range of a growing pair: C, Sec. VI.

    Δq(t) = Re(a u e^(−iω_r t)),   |n·(Δr_i − Δr_j)| ≤ |a| |n·(u_i − u_j)|, once in a period
    M = |a|² ⟨|u_i|²⟩ / 2,   of (x, y) alone, mean over all grains and over a period          C (30)

To first order a contact opens where its largest excursion equals its overlap, and two grains that
nearly touch meet where it equals their gap. M at the first of these events is the linear range of
the pair of modes. As along the shear, only contacts between grains that carry load are counted: a
loose grain is placed with next to no gap to its neighbours, bears next to no force from them and
exerts none.

| symbol          | name          | shape, unit                            |
| --------------- | ------------- | -------------------------------------- |
| u               | motions       | (N, 3, P) complex128, of q, any norm   |
| n_ij            | normal        | (C, 2), contacts and near contacts     |
| overlap or gap  | margin        | (C,), d                                |
| |n·(u_i − u_j)| | excursion     | (C, P)                                 |
| M at the first  | linear range  | (P,), d²                               |
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from grainmodes.relaxation.equilibrium_state import EquilibriumState

MAX_GAP = 0.1
"""Largest gap of a near contact, in d. Two grains further apart do not meet below M = 1e-11 d² in
a packing of less than 1e8 grains, even if they alone move; and contacts overlap by less."""


def linear_ranges(equilibrium: EquilibriumState, motions: np.ndarray) -> np.ndarray:
    """M of the first change of contacts along motions (N, 3, P), (P,) in d²."""
    packing, backbone = equilibrium.packing, equilibrium.backbone_mask
    larger = replace(packing, diameter=packing.diameter + MAX_GAP, history=None)
    near = larger.contacts
    loaded = backbone[near.i] & backbone[near.j]
    margin = np.abs(near.overlap - MAX_GAP)[loaded]
    translation = motions[:, :2]
    relative = translation[near.i[loaded]] - translation[near.j[loaded]]
    excursion = np.abs(np.einsum("ca,cap->cp", near.normal[loaded], relative))
    amplitude = 1.0 / (excursion / margin[:, None]).max(axis=0)
    mean_square = (np.abs(translation) ** 2).sum(axis=1).mean(axis=0)
    return np.asarray(amplitude**2 * mean_square / 2.0)
