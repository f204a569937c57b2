"""The unstable state that the tests release: the sheared reference packing and its fastest pair."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import scipy.linalg

from example_packings import SHEARED, reference, smoothed_coulomb
from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.release import Release
from grainmodes.protocols.release.release_run import ReleaseRun
from grainmodes.protocols.release.unstable_state import UnstableState
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.stages.rows import compute_block, stacked

SHORT = Release(duration=18.0, min_time=0.0, n_records=600, spectra=0)
"""Ten e-folds of the fastest pair from its start on; it ends before contacts change."""


@cache
def state() -> tuple[UnstableState, ContactLaw, Interaction]:
    """N = 50, μ = 10, γ = 0.02: ω = 1.0118 + 0.0017i, one of eight pairs."""
    data, packing = reference(SHEARED)
    law = smoothed_coulomb(data)
    interaction = Interaction.from_law(law)
    mass = generalized_mass(packing.mass).ravel()
    matrix = jacobian(packing, interaction).toarray() / mass[:, None]
    values, vectors = scipy.linalg.eig(matrix)
    fastest = np.argmax(np.sqrt(values).imag)
    turning = replace(packing, rotation=np.zeros(packing.n))
    return (
        UnstableState(turning, values[fastest], vectors[:, fastest].reshape(-1, 3)),
        law,
        interaction,
    )


def released(choices: Release = SHORT, drag: float = 0.0) -> ReleaseRun:
    """A whole release of this state."""
    start, _, interaction = state()
    run = ReleaseRun.from_state(start, interaction, choices, drag)
    while not run.done:
        run.advance()
    return run


def series(run: ReleaseRun, name: str) -> np.ndarray:
    """One quantity of all records."""
    return np.array([getattr(record, name) for record in run.records])


def sheared_equilibrium() -> EquilibriumState:
    """This state, as the shear leaves it."""
    start, _, interaction = state()
    return EquilibriumState.from_packing(start.packing, interaction)


def narrowed(equilibrium: EquilibriumState) -> EquilibriumState:
    """The weakest contact left with an overlap of 1e-9 d by a grain that is made smaller."""
    weakest = np.argmin(equilibrium.packing.contacts.overlap)
    diameter = equilibrium.packing.diameter.copy()
    diameter[equilibrium.packing.contacts.i[weakest]] -= 2.0 * (
        equilibrium.packing.contacts.overlap[weakest] - 1e-9
    )
    return EquilibriumState.from_packing(
        replace(equilibrium.packing, diameter=diameter), equilibrium.interaction
    )


def complex_pairs_block() -> Block:
    """A block as the stage `complex_pairs` leaves it: of two rates one has this state, and a sample
    that met none."""
    start, law, _ = state()
    packing, mode = start.packing, start.mode
    found = {
        "unstable_found": 1,
        "unstable_strain": packing.strain,
        "unstable_pair_count": 8,
        "unstable_fraction": packing.fraction.T,
        "unstable_rotation": packing.rotation,
        "unstable_contact_i": packing.history.i,
        "unstable_contact_j": packing.history.j,
        "unstable_spring_state": packing.history.spring_state,
        "unstable_eigenvalue_real": start.eigenvalue.real,
        "unstable_eigenvalue_imag": start.eigenvalue.imag,
        "unstable_mode_real": mode.real,
        "unstable_mode_imag": mode.imag,
        "unstable_path_strain": [packing.strain],
        "unstable_path_real_1": [start.eigenvalue.real],
        "unstable_path_real_2": [start.eigenvalue.real],
        "unstable_path_imaginary": [start.eigenvalue.imag],
    }
    row = {
        "converged": True,
        **stacked([{"unstable_found": 0}, found]),
        **{name: getattr(packing, name) for name in ("diameter", "mass", "box_length")},
    }
    point = {"n": packing.n, "phi": round(packing.phi, 12), "kt": law.kt, "stage": "complex_pairs"}
    return compute_block(
        range(2), [row, {"converged": True, "unstable_found": [0, 0]}].__getitem__, point
    )
