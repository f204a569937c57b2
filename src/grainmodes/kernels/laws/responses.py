"""What a contact law answers, as functions that each law implements for its own type.

| function            | returns                                      | where a law says nothing |
| ------------------- | -------------------------------------------- | ------------------------ |
| normal_response     | (f_N, ∂f_N/∂ξ)                               | –                        |
| tangential_scale    | (w, ∂w/∂ξ): tangential stiffness k_T w(ξ)    | –                        |
| normal_energy       | energy stored since first touch              | –                        |
| tangential_response | (f_T, ∂f_T/∂s, ∂f_T/∂ξ)                      | –                        |
| advanced            | what the spring remembers after a slide ds   | s + ds                   |
| threshold           | |s| or |h| from which the contact slides     | ∞: it never slides       |
| admissible          | what the law lets the spring keep            | all                      |
| tangential_energy   | energy of the spring, at this overlap        | –                        |

`displacement` is what the spring remembers, s or a force h.
"""

from __future__ import annotations

import math

from grainmodes.kernels.compiler import otherwise

AT_THRESHOLD = 1.0 - 1e-12
"""Part of s* from which a contact slides: a spring that has slipped is held at s* to rounding."""


def normal_response(normal, overlap):
    """(f_N, ∂f_N/∂ξ) of a contact."""
    raise NotImplementedError("called from compiled code only")


def tangential_scale(normal, overlap):
    """(w, ∂w/∂ξ) where the tangential stiffness is k_T w(ξ)."""
    raise NotImplementedError("called from compiled code only")


def normal_energy(normal, overlap):
    """Energy of the normal spring."""
    raise NotImplementedError("called from compiled code only")


def tangential_response(tangential, normal, overlap, displacement):
    """(f_T, ∂f_T/∂s, ∂f_T/∂ξ) of a contact."""
    raise NotImplementedError("called from compiled code only")


def advanced(tangential, normal, overlap, displacement, slide):
    """What a spring remembers after it has slid by ds, with ξ at the middle of the step."""
    raise NotImplementedError("called from compiled code only")


def threshold(tangential, normal, overlap):
    """What a spring remembers where its contact begins to slide."""
    raise NotImplementedError("called from compiled code only")


def admissible(tangential, normal, overlap, displacement):
    """What the law lets the spring keep: sharp Coulomb lets the rest slip."""
    raise NotImplementedError("called from compiled code only")


def tangential_energy(tangential, normal, overlap, displacement):
    """Energy of the tangential spring."""
    raise NotImplementedError("called from compiled code only")


@otherwise(advanced)
def _displacement_advances(tangential, normal, overlap, displacement, slide):
    return displacement + slide


@otherwise(threshold)
def _never_slides(tangential, normal, overlap):
    return math.inf


@otherwise(admissible)
def _keeps_all(tangential, normal, overlap, displacement):
    return displacement
