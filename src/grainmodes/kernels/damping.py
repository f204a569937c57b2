"""How motion is damped. A damping is a type, so that terms that a scene does not use cost nothing.

Dashpot             −η (v_N + v_T) on touching pairs         A (7), (8)
Drag                −m η ṙ and −I η θ̇ on every grain         B
TranslationalDrag   −m η ṙ on every grain                    C, Sec. IV and VII
Undamped            nothing: Newtonian dynamics              C
"""

from __future__ import annotations

from typing import NamedTuple

from grainmodes.kernels.compiler import implements


class Dashpot(NamedTuple):
    """Viscous force −η (v_N + v_T) on touching pairs, η in (m k_N)^(1/2) d^(1/4) (A)."""

    viscosity: float


class Drag(NamedTuple):
    """Background drag −m η ṙ and −I η θ̇, η in 1/t_0 (B)."""

    rate: float


class TranslationalDrag(NamedTuple):
    """Background drag −m η ṙ that leaves rotations alone, η in 1/t_0 (C, Sec. IV and VII)."""

    rate: float


class Undamped(NamedTuple):
    """Newtonian dynamics (C)."""


def pair_viscosity(damping):
    """η of touching pairs."""
    raise NotImplementedError("called from compiled code only")


def drag_rate(damping):
    """η of the background, of translations."""
    raise NotImplementedError("called from compiled code only")


def rotational_drag_rate(damping):
    """η of the background, of rotations."""
    raise NotImplementedError("called from compiled code only")


@implements(pair_viscosity, Dashpot)
def _dashpot_pairs(damping):
    return damping.viscosity


@implements(pair_viscosity, Drag)
def _drag_pairs(damping):
    return 0.0


@implements(pair_viscosity, TranslationalDrag)
def _translational_drag_pairs(damping):
    return 0.0


@implements(pair_viscosity, Undamped)
def _no_pairs(damping):
    return 0.0


@implements(drag_rate, Dashpot)
def _dashpot_drag(damping):
    return 0.0


@implements(drag_rate, Drag)
def _drag_drag(damping):
    return damping.rate


@implements(drag_rate, TranslationalDrag)
def _translational_drag_drag(damping):
    return damping.rate


@implements(drag_rate, Undamped)
def _no_drag(damping):
    return 0.0


@implements(rotational_drag_rate, Dashpot)
def _dashpot_rotation(damping):
    return 0.0


@implements(rotational_drag_rate, Drag)
def _drag_rotation(damping):
    return damping.rate


@implements(rotational_drag_rate, TranslationalDrag)
def _translational_drag_rotation(damping):
    return 0.0


@implements(rotational_drag_rate, Undamped)
def _no_rotation(damping):
    return 0.0
