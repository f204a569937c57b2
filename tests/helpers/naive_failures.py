"""Obvious methods that fail on a hard case; `hard_cases` shows where each of them fails."""

from __future__ import annotations

import numpy as np
import scipy.linalg

import naive
from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing
from grainmodes.response.moduli import AffineStep


def nearest_image(packing: Packing) -> list[naive.Pair]:
    """Touching pairs, one image each: a box too small for its grains holds more of them."""
    length, strain = packing.box_length, packing.strain
    branch = packing.position[:, None] - packing.position[None]
    rows = np.rint(branch[..., 1] / length)
    branch = branch - length * rows[..., None] * [strain, 1.0]
    branch[..., 0] -= length * np.rint(branch[..., 0] / length)
    reach = (packing.diameter[:, None] + packing.diameter) / 2
    near = np.argwhere(np.hypot(*np.moveaxis(branch, -1, 0)) < reach)
    return [naive.Pair(i, j, branch[i, j], reach[i, j], 0.0) for i, j in near.tolist() if i > j]


def in_absolute_doubles(packing: Packing) -> Packing:
    """The packing whose positions have once been stored as doubles in d."""
    return Packing.from_positions(
        packing.position, packing.diameter, packing.box_length, packing.strain, packing.mass
    )


def drifted(packing: Packing, step: float, steps: int) -> Packing:
    """The packing after `steps` steps along x, added up as doubles in d."""
    position = packing.position
    for _ in range(steps):
        position[:, 0] += step
    return Packing.from_positions(position, packing.diameter, packing.box_length)


def eigenpairs_near(shift: SymmetricShift, sigma: float, size: int, block: int):
    """Eigenpairs nearest σ by block Lanczos, each block orthogonalised against all others once."""
    start = np.random.default_rng(0).standard_normal((shift.size, block))
    basis, following = np.zeros((shift.size, 0)), np.linalg.qr(start)[0]
    shift.factor_at(sigma)
    while basis.shape[1] < size:
        basis = np.hstack([basis, following])
        image = shift.solve(following)
        following = np.linalg.qr(image - basis @ (basis.T @ image))[0]
    theta, y = scipy.linalg.eigh(basis.T @ shift.solve(basis))
    return sigma + 1.0 / theta, basis @ y


def with_all_grains(packing: Packing, interaction) -> tuple[float, float]:
    """(g, lowest eigenvalue) with every grain in J, loose or not; g is NaN where J is singular."""
    step = AffineStep(packing, interaction, loaded=False)
    matrix = jacobian(packing, interaction).toarray()
    try:
        u = np.linalg.solve(matrix[2:, 2:], step.force.ravel()[2:])
    except np.linalg.LinAlgError:
        return np.nan, np.linalg.eigvalsh(matrix)[0]
    return step.moduli(np.append(np.zeros(2), u)).g, np.linalg.eigvalsh(matrix)[0]


def rounds_removing(contacts, n: int, threshold: int, rounds: int) -> np.ndarray:
    """(N,) grains of at most `threshold` contacts, looked for in a fixed number of rounds."""
    gone = np.zeros(n, bool)
    for _ in range(rounds):
        held = ~(gone[contacts.i] | gone[contacts.j])
        degree = np.bincount(contacts.i[held], minlength=n)
        degree += np.bincount(contacts.j[held], minlength=n)
        gone = gone | (degree <= threshold)
    return gone
