"""What a contact law answers, as functions that each law implements for its own type.

| function            | returns                                        | default        |
| ------------------- | ---------------------------------------------- | -------------- |
| normal_response     | (f_N, ∂f_N/∂ξ)                                 | none           |
| tangential_scale    | (w, ∂w/∂ξ): tangential stiffness k_T w(ξ)      | none           |
| normal_energy       | energy stored since first touch                | none           |
| tangential_response | (f_T, ∂f_T/∂s, ∂f_T/∂ξ)                        | none           |
| advance_spring      | spring state after a slide ds                  | s + ds         |
| slip_threshold      | |s| or |h| from which the contact slides       | ∞: no sliding  |
| clip_to_coulomb     | spring state, cut where the law lets it slip   | left unchanged |
| tangential_energy   | energy of the spring, at this overlap          | none           |

`spring_state` is what the spring remembers: a displacement s in d, or a force h in k_N d^(3/2).
"""

from __future__ import annotations

import math
from typing import Protocol

from grainmodes.kernels.compiler import otherwise

SLIDING_FRACTION = 1.0 - 1e-12
"""Fraction of s* from which a contact slides: a spring that has slipped is at s* to rounding."""


class NormalLaw(Protocol):
    """Type of a normal law: a NamedTuple whose first field is k_N."""

    @property
    def stiffness(self) -> float:
        """k_N."""
        ...


class TangentialLaw(Protocol):
    """Type of a tangential law: a NamedTuple whose first field is k_T; Frictionless has none."""

    @property
    def stiffness(self) -> float:
        """k_T."""
        ...


def normal_response(normal: NormalLaw, overlap: float) -> tuple[float, float]:
    """(f_N, ∂f_N/∂ξ) of a contact."""
    raise NotImplementedError("called from compiled code only")


def tangential_scale(normal: NormalLaw, overlap: float) -> tuple[float, float]:
    """(w, ∂w/∂ξ) where the tangential stiffness is k_T w(ξ)."""
    raise NotImplementedError("called from compiled code only")


def normal_energy(normal: NormalLaw, overlap: float) -> float:
    """Energy of the normal spring."""
    raise NotImplementedError("called from compiled code only")


def tangential_response(
    tangential: TangentialLaw, normal: NormalLaw, overlap: float, spring_state: float
) -> tuple[float, float, float]:
    """(f_T, ∂f_T/∂s, ∂f_T/∂ξ) of a contact."""
    raise NotImplementedError("called from compiled code only")


def advance_spring(
    tangential: TangentialLaw, normal: NormalLaw, overlap: float, spring_state: float, slide: float
) -> float:
    """Spring state after a slide ds, with ξ at the middle of the step."""
    raise NotImplementedError("called from compiled code only")


def slip_threshold(tangential: TangentialLaw, normal: NormalLaw, overlap: float) -> float:
    """Size of the spring state from which the contact slides."""
    raise NotImplementedError("called from compiled code only")


def clip_to_coulomb(
    tangential: TangentialLaw, normal: NormalLaw, overlap: float, spring_state: float
) -> float:
    """Spring state after slip: sharp Coulomb laws cut it at the slip threshold."""
    raise NotImplementedError("called from compiled code only")


def tangential_energy(
    tangential: TangentialLaw, normal: NormalLaw, overlap: float, spring_state: float
) -> float:
    """Energy of the tangential spring."""
    raise NotImplementedError("called from compiled code only")


@otherwise(advance_spring)
def _advance_displacement(tangential, normal, overlap, spring_state, slide):
    return spring_state + slide


@otherwise(slip_threshold)
def _never_slides(tangential, normal, overlap):
    return math.inf


@otherwise(clip_to_coulomb)
def _no_slip(tangential, normal, overlap, spring_state):
    return spring_state
