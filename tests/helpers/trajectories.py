"""Trajectories whose every bit is compared between processors, and the packings at their ends.

`python trajectories.py FILE` computes all of them and writes an npz file: "digest" holds a JSON
object of case → SHA-256 of all numbers that the trajectory has led to, before Newton's method has
touched them; "fraction/CASE", "box_length/CASE", "i/CASE", "j/CASE" are the packings after it.
"""

from __future__ import annotations

import hashlib
import json
import sys

import numpy as np

from grainmodes.kernels.damping import Dashpot
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.compression import Compression, FrictionalCompression
from grainmodes.parameters.law import ContactLaw
from grainmodes.protocols.compression import frictional_trajectory
from grainmodes.protocols.compression.frictional_trajectory import FrictionalPress
from grainmodes.protocols.compression.trajectory import (
    Trajectory,
    compress_along_grid,
    compress_to,
    place_at_random,
)
from grainmodes.relaxation.dynamics import relax_damped

PHI, FURTHER_PHI = 0.85, 0.852
"""Area fraction of the packings, and the one to which friction compresses them further."""

TIME_STEPS = 2000
"""Steps of the damped dynamics with friction."""

CASES = [(64, "hertz"), (64, "harmonic"), (256, "hertz"), (1024, "hertz")]
"""(N, normal law)."""

FRICTION = [ContactLaw("hertz", "elastic", 1.0), ContactLaw("hertz", "smoothed_coulomb", 1.0, 0.5)]

COMPRESSED = [FRICTION[1], ContactLaw("harmonic", "elastic", 1.0)]
"""Laws under which grains are compressed with friction from the beginning."""


def grid_state(n: int, normal: str, protocol: Compression) -> Trajectory:
    """Seed 0 compressed along the grid to PHI, by FIRE alone."""
    interaction = Interaction.from_law(ContactLaw(normal))
    start = place_at_random(n, 0, interaction.normal, protocol)
    return compress_along_grid(start, PHI, interaction.normal, protocol)


def with_friction(state: Packing, law: ContactLaw) -> Packing:
    """A state compressed further with friction, by damped dynamics for TIME_STEPS."""
    denser = state.at(FURTHER_PHI)
    interaction = Interaction.from_law(law)
    return relax_damped(denser, interaction, Dashpot(1.0), 1e-2, 1e-300, TIME_STEPS).packing


def compressed_with_friction(n: int, law: ContactLaw) -> Trajectory:
    """Seed 0 compressed with friction from the random placement to PHI, in coarse steps."""
    press = FrictionalPress(law, Compression(phi_step=1e-2), FrictionalCompression())
    start = place_at_random(n, 0, press.interaction.normal, press.compression)
    return frictional_trajectory.compress_along_grid(start, PHI, press)


def digest(packing: Packing, *numbers: float) -> str:
    """SHA-256 of all numbers of a packing, and of further ones."""
    found = hashlib.sha256(packing.fraction.tobytes())
    found.update(np.array([packing.box_length, *numbers]).tobytes())
    if packing.rotation is not None:
        found.update(packing.rotation.tobytes())
    if packing.history is not None:
        found.update(packing.history.i.tobytes() + packing.history.j.tobytes())
        found.update(packing.history.spring_state.tobytes())
    return found.hexdigest()


def main(path: str) -> None:
    """Compute all cases and write them to `path`."""
    protocol, digests, arrays = Compression(), {}, {}
    for n, normal in CASES:
        state = grid_state(n, normal, protocol)
        digests[f"{normal} {n}"] = digest(state.packing, state.iterations, state.phi_jamming)
        for law in FRICTION if normal == "hertz" else []:
            moved = with_friction(state.packing, law)
            digests[f"{normal} {n} {law.tangential}"] = digest(moved)
        hard = Interaction.from_law(ContactLaw(normal)).normal
        packing = compress_to(state, PHI, hard, protocol).packing
        for name, values in {
            "fraction": packing.fraction,
            "box_length": packing.box_length,
            "i": packing.contacts.i,
            "j": packing.contacts.j,
        }.items():
            arrays[f"{name}/{normal} {n}"] = np.asarray(values)
    for law in COMPRESSED:
        state = compressed_with_friction(64, law)
        case = f"{law.normal} 64 {law.tangential}, compressed"
        digests[case] = digest(state.packing, state.iterations, state.phi_jamming)
    np.savez(path, digest=json.dumps(digests), **arrays)


if __name__ == "__main__":
    main(sys.argv[1])
