"""Slow twins of the package: plain Python and numpy, one formula per function, no grids, no lists.

Only the forces are written down. Whatever is a derivative in the package is taken here as a complex
step of those forces, Im f(q + ih)/h, exact to rounding, or as a central difference of them; so
nothing that could be derived wrongly is derived.

    r⃗ = r⃗_i − r⃗_j,  n = r⃗/r,  t = (n_y, −n_x),  ξ = (d_i + d_j)/2 − r > 0
    ds = t·dr⃗ + dℓ_i + dℓ_j,    f = f_N n + f_T t on i, −f on j,    f_T on both as scaled torque

Units k_N = m = d = 1. Laws are `ContactLaw`, read here from the table of the physics alone.
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np

from grainmodes.parameters.law import ContactLaw

COMPLEX_STEP = 1e-30
ON_J = np.array([-1.0, -1.0, 1.0])
"""How (x, y, ℓ) of grain j enter the contact, and the force on j."""


class Pair(NamedTuple):
    """A touching pair: r⃗ = r⃗_i − r⃗_j of the touching image, (d_i + d_j)/2, and s or h."""

    i: int
    j: int
    branch: np.ndarray
    reach: float
    slip: complex


def images(box_length: float, strain: float):
    """Vectors from the box to its images: n in y shifts x by n γ L."""
    for across, up in itertools.product(range(-2, 3), range(-1, 2)):
        yield box_length * np.array([across + strain * up, up])


def all_pairs(position, diameter, box_length, strain=0.0, skin=0.0, slip=None) -> list[Pair]:
    """Pairs i > j closer than (d_i + d_j)/2 + skin, by trying every image; s from {(i, j): s}."""
    shifts = np.array(list(images(box_length, strain)))
    branch = position[:, None, None] - position[None, :, None] + shifts
    reach = (diameter[:, None] + diameter[None, :]) / 2
    near = np.hypot(branch[..., 0], branch[..., 1]) < reach[..., None] + skin
    return [
        Pair(i, j, branch[i, j, k], reach[i, j], (slip or {}).get((i, j), 0.0))
        for i, j, k in np.argwhere(near).tolist()
        if i > j
    ]


def length(vector):
    """|r⃗|, also of a complex step."""
    return (vector[0] ** 2 + vector[1] ** 2) ** 0.5


def tangent(branch):
    """t = (n_y, −n_x)."""
    return np.array([branch[1], -branch[0]]) / length(branch)


def normal_force(law: ContactLaw, overlap):
    """f_N: ξ^(3/2) of Hertz, ξ of the harmonic law."""
    return overlap**1.5 if law.normal == "hertz" else overlap


def tangential_stiffness(law: ContactLaw, overlap):
    """Stiffness of the unslipped spring: k_T ξ^(1/2) of Hertz, k_T of the harmonic law."""
    return law.kt * overlap**0.5 if law.normal == "hertz" else law.kt


def remembers_force(law: ContactLaw) -> bool:
    """Whether the spring keeps a force h, f_T = −h, instead of a displacement s."""
    return law.tangential.endswith("_force")


def remembered(law: ContactLaw, overlap, slip):
    """What the spring keeps that was stretched to s at this overlap: s, or h = k s."""
    return tangential_stiffness(law, overlap) * slip if remembers_force(law) else slip


def threshold(law: ContactLaw, overlap):
    """What the spring of a Coulomb law keeps when it begins to slip: s* = μ ξ/k_T, or μ f_N."""
    if remembers_force(law):
        return law.friction_coefficient * normal_force(law, overlap)
    return law.friction_coefficient / law.kt * overlap


def tangential_force(law: ContactLaw, overlap, slip):
    """f_T of a spring that keeps s or h: elastic, smoothed Coulomb, sharp Coulomb."""
    elastic = -slip if remembers_force(law) else -tangential_stiffness(law, overlap) * slip
    if law.kt == 0.0 or law.friction_coefficient is None:
        return elastic
    sign = 1.0 if np.real(slip) > 0 else -1.0
    tau = sign * slip / threshold(law, overlap)
    if np.real(tau) >= 1.0:
        return -law.friction_coefficient * normal_force(law, overlap) * sign
    return elastic * (1 + tau - tau**2) if law.tangential == "smoothed_coulomb" else elastic


def pair_force(law: ContactLaw, pair: Pair) -> np.ndarray:
    """(f_x, f_y, scaled torque) on grain i."""
    distance = length(pair.branch)
    overlap = pair.reach - distance
    f_t = tangential_force(law, overlap, pair.slip)
    along = normal_force(law, overlap) * pair.branch / distance
    return np.append(along + f_t * tangent(pair.branch), f_t)


def moved(law: ContactLaw, pair: Pair, step) -> Pair:
    """The pair after a relative motion (δr⃗, δℓ): its spring follows, with t and ξ at the middle."""
    drift, spin = step[:2], step[2]
    middle = pair.branch + drift / 2
    overlap = pair.reach - length(middle)
    stretch = remembered(
        law, overlap if np.real(overlap) > 0 else 0.0, tangent(middle) @ drift + spin
    )
    return pair._replace(branch=pair.branch + drift, slip=pair.slip + stretch)


def jumped(pair: Pair, step) -> Pair:
    """The pair after a jump δr⃗ that its spring does not feel (A's step strain)."""
    return pair._replace(branch=pair.branch + step)


def all_moved(law: ContactLaw, pairs: list[Pair], u) -> list[Pair]:
    """Every pair after the grains moved by u (N, 3)."""
    return [moved(law, p, u[p.i] + ON_J * u[p.j]) for p in pairs]


def net_force(law: ContactLaw, pairs: list[Pair], n: int) -> np.ndarray:
    """F̃ = (F_x, F_y, 2T/d) of every grain, (N, 3)."""
    forces = [pair_force(law, pair) for pair in pairs]
    total = np.zeros((n, 3), np.result_type(float, *forces))
    for pair, force in zip(pairs, forces, strict=True):
        total[pair.i] += force
        total[pair.j] += ON_J * force
    return total


def stress(law: ContactLaw, pairs: list[Pair], box_length: float) -> np.ndarray:
    """σ_αβ = −(1/L²) Σ f^α r^β."""
    total = sum(np.outer(pair_force(law, p)[:2], p.branch) for p in pairs)
    return -total / box_length**2


def central_jacobian(law: ContactLaw, pairs: list[Pair], n: int, h: float = 1e-5) -> np.ndarray:
    """J = −∂F̃/∂q by central differences of the net forces, dense (3N, 3N).

    At s = 0 the smoothed Coulomb force goes as s |s|: the error of a difference begins with h, not
    h², so the differences over h, 2h and 4h are extrapolated as if both were there.
    """
    columns = []
    for grain, axis in itertools.product(range(n), range(3)):
        near = [p for p in pairs if grain in (p.i, p.j)]
        once, twice, fourfold = (difference(law, near, n, grain, axis, k * h) for k in (1, 2, 4))
        columns.append(-(8 * once - 6 * twice + fourfold).ravel() / 3)
    return np.array(columns).T


def difference(law, pairs, n, grain, axis, h) -> np.ndarray:
    """[F̃(q + h) − F̃(q − h)] / 2h for one coordinate of one grain."""
    u = np.zeros((n, 3))
    u[grain, axis] = h
    ahead, behind = (net_force(law, all_moved(law, pairs, way * u), n) for way in (1, -1))
    return (ahead - behind) / (2 * h)


def contact_stiffness(law: ContactLaw, pair: Pair) -> np.ndarray:
    """∂(f_x, f_y, f_T)/∂(r⃗, ℓ) of a contact by complex steps, (3, 3)."""
    steps = 1j * COMPLEX_STEP * np.eye(3)
    return np.array([pair_force(law, moved(law, pair, e)).imag / COMPLEX_STEP for e in steps]).T


def jacobian(law: ContactLaw, pairs: list[Pair], n: int) -> np.ndarray:
    """J from the stiffness of every contact, dense (3N, 3N), (x, y, ℓ) grain by grain."""
    blocks = np.zeros((n, 3, n, 3))
    for p in pairs:
        k = contact_stiffness(law, p)
        blocks[p.i, :, p.i, :] -= k
        blocks[p.i, :, p.j, :] -= k * ON_J
        blocks[p.j, :, p.i, :] -= ON_J[:, None] * k
        blocks[p.j, :, p.j, :] -= ON_J[:, None] * k * ON_J
    return blocks.reshape(3 * n, 3 * n)


def affine_steps(law: ContactLaw, pairs: list[Pair], loaded: bool) -> list[Pair]:
    """Every pair a complex step further along the affine shear r⃗ → r⃗ + γ (r_y, 0)."""
    steps = [1j * COMPLEX_STEP * np.array([p.branch[1], 0, 0]) for p in pairs]
    if loaded:
        return [moved(law, p, step) for p, step in zip(pairs, steps, strict=True)]
    return [jumped(p, step[:2]) for p, step in zip(pairs, steps, strict=True)]


def mode_sum(matrix: np.ndarray, force: np.ndarray, zero_modes: int) -> np.ndarray:
    """u = Σ' R_n (L_n·a) / λ_n, the `zero_modes` eigenvalues smallest in modulus left out."""
    symmetric = np.abs(matrix - matrix.T).max() < 1e-14
    values, right = np.linalg.eigh(matrix) if symmetric else np.linalg.eig(matrix)
    left = right.T if symmetric else np.linalg.inv(right)
    kept = np.argsort(np.abs(values))[zero_modes:]
    return (right[:, kept] @ ((left[kept] @ force) / values[kept])).real


def moduli(law: ContactLaw, pairs: list[Pair], n: int, box_length: float, loaded: bool):
    """(g_A, g_NA), each (2, 2) as dσ_αβ/dγ, by the sum over the modes of the dense Jacobian."""
    sheared = affine_steps(law, pairs, loaded)
    rate = net_force(law, sheared, n).imag / COMPLEX_STEP
    rotations = n if law.kt == 0.0 else 0
    u = mode_sum(jacobian(law, pairs, n), rate.ravel(), 2 + rotations).reshape(n, 3)
    affine = stress(law, sheared, box_length).imag / COMPLEX_STEP
    relaxed = all_moved(law, sheared, 1j * COMPLEX_STEP * u)
    total = stress(law, relaxed, box_length).imag / COMPLEX_STEP
    return affine, total - affine


def rattlers(pairs: list[Pair], n: int, threshold: int) -> set[int]:
    """Grains with at most `threshold` contacts, taken out one at a time until none is left."""
    gone: set[int] = set()
    while True:
        held = [p for p in pairs if p.i not in gone and p.j not in gone]
        count = {g: sum(g in (p.i, p.j) for p in held) for g in range(n) if g not in gone}
        loose = [g for g, contacts in count.items() if contacts <= threshold]
        if not loose:
            return gone
        gone.add(loose[0])
