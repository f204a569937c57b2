"""Is the integral of tangential velocities tangential? B, Eq. (10), (A1) and Fig. 10.

    V = ∫ v_T dt = ∫ t ds,    t = (n_y, −n_x) at each instant,    ds = t·dr + dℓ_i + dℓ_j
    Err = |V·n| / |V|                                                                   B (A1)

With φ the angle of the contact and φ_e its angle in the end, V·n = ± ∫ sin(φ_e − φ) ds. Hence

| holds                                        | how well                                    |
| -------------------------------------------- | ------------------------------------------- |
| every increment is tangential, t ds · n = 0  | exactly, whatever the motion                |
| V is tangential, Err = 0                     | to zeroth order in the rotation of contacts |
| V is as long as s                            | to first order                              |

A contact that slides evenly while it turns by α has Err = sin(α/2). One whose s has gone forth and
back has an Err of any size up to 1, as |V| passes 0 while V·n does not. So the second term of
B (10) does not vanish. s itself turns with the contact and needs no such term.

V is summed along the steps of a shear, with t in the middle between both ends of each step, to
second order in the step. Where a law lets springs slip, ds is the part that the springs keep.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.first_event import accepted_steps
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.relaxation.equilibrium_state import EquilibriumState


class PathError(NamedTuple):
    """Err and related numbers over all contacts with V ≠ 0 of one state; NaN if there are none.

    | field           | meaning                                                             |
    | --------------- | ------------------------------------------------------------------- |
    | error_increment | the largest Err of the last step alone, against n in its middle     |
    | turn_median     | the angle between n now and n when the contact closed               |
    | length_median   | ||V| − |s|| / |s|                                                   |
    """

    strain: float
    error_largest: float
    error_median: float
    error_increment: float
    turn_median: float
    length_median: float


class TangentialPath:
    """V of every contact along a shear, (C, 2) in d; it starts as s t of the first equilibrium."""

    def __init__(self, equilibrium: EquilibriumState):
        contacts = equilibrium.packing.contacts
        self._keys, self._contacts = contacts.key, contacts
        self._path = contacts.springs[:, None] * contacts.tangent
        self._first_normal = contacts.normal

    def follow(self, equilibrium: EquilibriumState) -> PathError:
        """Go on to the next state; a contact that has closed begins with V = 0."""
        contacts = equilibrium.packing.contacts
        keys = contacts.key
        _, new, old = np.intersect1d(keys, self._keys, assume_unique=True, return_indices=True)
        middle, slide = contacts.normal.copy(), contacts.springs.copy()
        middle[new] += self._contacts.normal[old]
        middle /= np.hypot(*middle.T)[:, None]
        slide[new] -= self._contacts.springs[old]
        step = slide[:, None] * np.stack([middle[:, 1], -middle[:, 0]], axis=1)
        path, first_normal = step.copy(), contacts.normal.copy()
        path[new] += self._path[old]
        first_normal[new] = self._first_normal[old]
        self._keys, self._contacts = keys, contacts
        self._path, self._first_normal = path, first_normal
        return PathError(
            equilibrium.packing.strain,
            *_largest_and_median(normal_part(path, contacts.normal)),
            _largest_and_median(normal_part(step, middle))[0],
            _largest_and_median(_turn(first_normal, contacts.normal))[1],
            _largest_and_median(_length_difference(path, contacts))[1],
        )


def normal_part(path: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Err = |V·n| / |V| of every contact with V ≠ 0, for V (C, 2) and n (C, 2): B (A1)."""
    length = np.hypot(*path.T)
    moved = length > 0.0
    error: np.ndarray = np.abs(np.sum(path * normal, axis=1))[moved] / length[moved]
    return error


def _turn(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Angle between two normals (C, 2) of every contact, (C,)."""
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    angle: np.ndarray = np.abs(np.arctan2(cross, np.sum(before * after, axis=1)))
    return angle


def _length_difference(path: np.ndarray, contacts: Contacts) -> np.ndarray:
    """||V| − |s|| / |s| of every contact with s ≠ 0."""
    s = np.abs(contacts.springs)
    difference: np.ndarray = np.abs(np.hypot(*path.T) - s)[s > 0.0] / s[s > 0.0]
    return difference


def _largest_and_median(values: np.ndarray) -> tuple[float, float]:
    return (float(values.max()), float(np.median(values))) if len(values) else (np.nan, np.nan)


def path_errors(packing: Packing, interaction: Interaction, choices: Shear) -> list[PathError]:
    """Err of every state along a shear in whole steps Δγ_in, up to its first event.

    Raises:
        ArithmeticError: the packing has no stable equilibrium.
    """
    whole_steps = replace(choices, min_step=choices.step)
    run = QuasistaticRun.from_packing(packing, interaction, whole_steps)
    path, errors = TangentialPath(run.state.equilibrium), []
    for _, state in accepted_steps(run):
        if run.events:
            break
        errors.append(path.follow(state.equilibrium))
    return errors
