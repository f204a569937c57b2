"""Packings for the tests: reference files of an independent code, and dense random arrangements."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import xarray as xr
from hypothesis import HealthCheck, settings

import naive
from grainmodes.kernels.laws import Hertz, Interaction
from grainmodes.packing.contacts import Contacts, History
from grainmodes.packing.state import Packing
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.protocols.compression.trajectory import (
    compress_along_grid,
    compress_to,
    place_at_random,
)
from grainmodes.relaxation.frictionless import relax_fire_large_steps, relax_fire_newton

DATA = Path(__file__).parents[1] / "data"
KTS = (1e-8, 1e-4, 1e-2, 1.0, 2.0, 10.0)
"""k_T of the reference files."""

MINIMAL = ("hertz_n16_phi0.900_seed1", "harmonic_n16_phi0.900_seed1")
ELASTIC = (
    *MINIMAL,
    "hertz_n64_phi0.860_seed2",
    "hertz_n64_phi0.900_seed1",
    "harmonic_n64_phi0.860_seed2",
    "harmonic_n64_phi0.900_seed1",
)


def every_kt_once(kts) -> list[tuple[str, float]]:
    """(file, k_T): every k_T with one Hertzian and one harmonic file, the files in turn."""
    by_law = [[name for name in ELASTIC if name.startswith(law)] for law in ("hertz", "harmonic")]
    return [(names[k % len(names)], kt) for k, kt in enumerate(kts) for names in by_law]


SHEARED = "smoothed_coulomb_n50_mu10_seed1"

REMEMBERING_DISPLACEMENT = (
    ("elastic", None),
    ("smoothed_coulomb", 0.4),
    ("sharp_coulomb", 0.4),
)
REMEMBERING_FORCE = (("elastic_force", None), ("sharp_coulomb_force", 0.4))
LAWS = [
    ContactLaw(normal, tangential, 0.3, coefficient)
    for kinds in (REMEMBERING_DISPLACEMENT, REMEMBERING_FORCE)
    for normal in ("hertz", "harmonic")
    for tangential, coefficient in kinds
]
"""Every frictional law."""

FRICTIONLESS = [ContactLaw("hertz"), ContactLaw("harmonic")]


def law_name(law: ContactLaw) -> str:
    """How pytest shows a law."""
    return f"{law.normal}-{law.tangential if law.frictional else 'frictionless'}-{law.kt:g}"


def few(examples: int):
    """A property tried on a few examples, the same in every run."""
    return settings(
        max_examples=examples,
        deadline=None,
        derandomize=True,
        database=None,
        suppress_health_check=list(HealthCheck),
    )


def reference(name: str) -> tuple[xr.Dataset, Packing]:
    """A file of tests/data and the packing in it, its tangential history included."""
    data = xr.load_dataset(DATA / f"{name}.nc")
    box_length, strain = float(data.box_length), float(data.attrs.get("strain", 0.0))
    mass = data["mass"].values if "mass" in data else None
    history = _history(data) if "contact_i" in data else None
    position, diameter = data["position"].values, data["diameter"].values
    packing = Packing.from_positions(position, diameter, box_length, strain, mass, history)
    return data, packing


def _history(data: xr.Dataset) -> History:
    i, j = data["contact_i"].values.astype(np.int32), data["contact_j"].values.astype(np.int32)
    order = np.lexsort((j, i))
    return History(i[order], j[order], data["tangential_displacement"].values[order])


def elastic(name: str, kt: float) -> Interaction:
    """The interaction of a reference file at one of its k_T."""
    return Interaction.from_law(ContactLaw(name.split("_")[0], "elastic", kt))


def smoothed_coulomb(data: xr.Dataset) -> ContactLaw:
    """The law of the sheared reference file."""
    return ContactLaw("hertz", "smoothed_coulomb", float(data.kt), float(data.mu))


def crowd(seed: int, n: int = 16, strain: float = 0.0, slip: float = 0.0) -> Packing:
    """Grains squeezed onto a jittered square lattice, so that every overlap is large.

    No pair is within 4e-3 of just touching: a finite difference never comes near the edge of a
    contact. s is drawn from ± `slip` times the overlap, and |s| is never below a tenth of that.
    """
    draws = np.random.default_rng([seed, n])
    side = int(np.sqrt(n))
    while True:
        lattice = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
        diameter = draws.permutation(np.where(np.arange(n) % 2, 1.1, 0.9))
        position = 0.88 * (lattice + draws.uniform(-0.08, 0.08, (n, 2)))
        mass = draws.uniform(0.5, 2.0, n)
        packing = Packing.from_positions(position, diameter, 0.88 * side, strain, mass)
        if _nothing_just_touches(packing):
            return with_slip(packing, draws, slip) if slip else packing


def _nothing_just_touches(packing: Packing) -> bool:
    pairs = pairs_of(packing, skin=4e-3)
    return all(p.reach - naive.length(p.branch) > 4e-3 for p in pairs)


def with_slip(packing: Packing, draws, slip: float) -> Packing:
    """The packing with random tangential springs, 0.1 … 1 times `slip` times the overlap."""
    contacts = packing.contacts
    size = len(contacts.i)
    s = slip * contacts.overlap * draws.uniform(0.1, 1.0, size) * draws.choice([-1.0, 1.0], size)
    return replace(packing, history=History(contacts.i, contacts.j, s))


def crystal(columns: int, rows: int, spacing: float) -> Packing:
    """Rows of grains of diameter 1, `spacing` apart, every second row shifted by half of it."""
    box_length = columns * spacing
    row, column = np.divmod(np.arange(columns * rows), columns)
    x = (column + 0.5 * (row % 2)) * spacing
    position = np.stack([x, row * box_length / rows], axis=1)
    return Packing.from_positions(position + 0.123, np.ones(columns * rows), box_length)


def keeping(law: ContactLaw, packing: Packing) -> Packing:
    """The packing with what the law remembers of its springs: s, or h = k s."""
    contacts = packing.contacts
    kept = naive.remembered(law, contacts.overlap, contacts.springs)
    return replace(packing, history=History(contacts.i, contacts.j, kept))


def pairs_of(packing: Packing, skin: float = 0.0) -> list[naive.Pair]:
    """The pairs of a packing by brute force, with its s."""
    slip = {}
    if packing.history is not None:
        h = packing.history
        keys = zip(h.i.tolist(), h.j.tolist(), strict=True)
        slip = dict(zip(keys, h.spring_state, strict=True))
    return naive.all_pairs(
        packing.position, packing.diameter, packing.box_length, packing.strain, skin, slip
    )


def contacts_and_pairs(packing: Packing) -> tuple[Contacts, list[naive.Pair]]:
    """Contacts as the package sees them, and as the slow twin does."""
    return packing.contacts, pairs_of(packing)


BACKENDS = ["superlu", *(["pardiso"] if find_spec("pypardiso") else [])]
"""The factorisations of this environment."""


def kt_and_backend(*kts: float) -> list[tuple[float, str]]:
    """Every k_T with SuperLU, and the last one with every factorisation."""
    return [*((kt, BACKENDS[0]) for kt in kts), *((kts[-1], name) for name in BACKENDS[1:])]


@cache
def quenched(n: int, phi: float, seed: int = 0) -> Packing:
    """A packing in balance straight from random placement; near jamming it is compressed to φ."""
    normal, protocol = Hertz(1.0), Compression(phi_step=1e-3)
    start = place_at_random(n, seed, normal, protocol)
    if phi < 0.87:
        return compress_to(
            compress_along_grid(start, phi, normal, protocol), phi, normal, protocol
        ).packing
    loose = relax_fire_large_steps(start.packing.at(phi), normal, 1e-7, 0.0, 100_000).packing
    return relax_fire_newton(loose, normal, 1e-14, 1_000_000).packing
