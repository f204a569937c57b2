"""What a quasistatic shear leaves behind, as values of one row by the names of the dataset."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from grainmodes.dataset.padding import stack_padded
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import is_frictionless
from grainmodes.packing.state import Packing, nan_on_rattlers
from grainmodes.parameters.strain import MAX_PAIR_DOF, Shear
from grainmodes.protocols.shear.closed_loop import closed_loop
from grainmodes.protocols.shear.event_multipoles import rotational_multipoles
from grainmodes.protocols.shear.event_states import nonaffine_rate, simulated_nonaffine_rate
from grainmodes.protocols.shear.events import NetworkChange, PlasticEvent, count_reopened
from grainmodes.protocols.shear.first_event import Bracket
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.protocols.shear.sheared_state import CurvePoint
from grainmodes.protocols.shear.tangential_path import PathError, path_errors
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.response.stability import asymmetry, count_complex_pairs


def run_row(run: QuasistaticRun) -> dict[str, object]:
    """Everything recorded along a shear."""
    equilibrium = run.state.equilibrium
    packing, interaction = equilibrium.packing, equilibrium.interaction
    return {
        **{name: getattr(packing, name) for name in ("diameter", "mass", "box_length")},
        **_curve(run.curve),
        **_events(run.events, interaction),
        "last_asymmetry": asymmetry(equilibrium.matrix),
        "last_complex_pairs": _count_pairs(equilibrium),
        **_network_changes(run.network_changes),
        "jammed": True,
    }


def coarse_run_row(run: QuasistaticRun) -> dict[str, object]:
    """The stress-strain curve of a run whose events are not bracketed."""
    return {
        "coarse_strain": [point.strain for point in run.curve],
        "coarse_stress": [symmetric_shear(point.stress) for point in run.curve],
    }


def bracket_ends(brackets: Sequence[Bracket]) -> dict[str, object]:
    """Both ends of the bracket of the first event at every Δγ_Th; NaN where there is no event."""
    return {
        "bracket_min_step": [b.min_step for b in brackets],
        "bracket_strain_before": [b.before.strain if b.after else np.nan for b in brackets],
        "bracket_strain_after": [b.after.strain if b.after else np.nan for b in brackets],
    }


def bracket_failures(brackets: Sequence[Bracket]) -> dict[str, Exception | None]:
    """Which brackets found no event because their run ended early → why, for `rows.loss`."""
    return {f"first event within {b.min_step:.0e}": b.failure for b in brackets if b.failure}


def path_errors_row(
    packing: Packing, interaction: Interaction, choices: Shear
) -> dict[str, object]:
    """B's Err along a shear in whole steps, up to its first event; nothing without friction."""
    if is_frictionless(interaction):
        return {}
    errors = path_errors(packing, interaction, choices)
    if not errors:
        return {"path_count": 0}
    columns = zip(PathError._fields, zip(*errors, strict=True), strict=True)
    return {"path_count": len(errors)} | {f"path_{name}": values for name, values in columns}


def last_path_row(packing: Packing, interaction: Interaction, choices: Shear) -> dict[str, object]:
    """B's Err in the last state before the first event; nothing without friction."""
    if is_frictionless(interaction):
        return {}
    errors = path_errors(packing, interaction, choices)
    if not errors:
        return {}
    last = errors[-1]
    return {
        "last_path_error": last.error_largest,
        "last_path_increment": last.error_increment,
        "last_path_turn": last.turn_median,
    }


def history_row(packing: Packing, interaction: Interaction, choices: Shear) -> dict[str, object]:
    """What a closed loop of strain leaves of the springs; nothing without friction."""
    if is_frictionless(interaction):
        return {}
    loop = closed_loop(packing, interaction, choices)
    return {f"loop_{name}": value for name, value in loop._asdict().items()}


def rate_row(narrowest: Bracket, choices: Shear) -> dict[str, object]:
    """How far dq̊/dγ of linear response and of the simulation differ after the first event."""
    if narrowest.after is None:
        return {"rate_difference": np.nan}
    rate = nonaffine_rate(narrowest.after)
    difference = simulated_nonaffine_rate(narrowest.after, choices) - rate
    known = np.isfinite(difference)
    size = np.linalg.norm(rate[known])
    return {"rate_difference": float(np.linalg.norm(difference[known]) / size)}


def symmetric_shear(tensor: np.ndarray) -> float:
    """The shear component (T_xy + T_yx)/2 of a tensor (2, 2)."""
    return float(tensor[0, 1] + tensor[1, 0]) / 2.0


def _curve(points: Sequence[CurvePoint]) -> dict[str, object]:
    stress = np.array([point.stress for point in points])
    modulus = np.array([point.modulus for point in points])
    return {
        "curve_count": len(points),
        "curve_strain": [point.strain for point in points],
        "curve_stress_xy": stress[:, 0, 1],
        "curve_stress_yx": stress[:, 1, 0],
        "curve_pressure": -np.trace(stress, axis1=1, axis2=2) / 2.0,
        "curve_g_xy": modulus[:, 0, 1],
        "curve_g_yx": modulus[:, 1, 0],
        "curve_energy": [point.energy for point in points],
        "curve_contact_number": [point.contact_number for point in points],
        "curve_lowest_eigenvalue": [point.lowest_eigenvalue for point in points],
    }


def _events(events: Sequence[PlasticEvent], interaction: Interaction) -> dict[str, object]:
    """The events, and the states before and after each of them."""
    if not events:
        return {"event_count": 0}
    fields = [event.displacement for event in events]
    multipoles = [rotational_multipoles(event.after, event.displacement) for event in events]
    quadrupole, others, rank = zip(*multipoles, strict=True)
    before, after = (
        [EquilibriumState.from_packing(packing, interaction) for packing in packings]
        for packings in ([event.before for event in events], [event.after for event in events])
    )
    return {
        "event_count": len(events),
        "event_kind": [event.kind for event in events],
        "event_opened": [event.opened for event in events],
        "event_closed": [event.closed for event in events],
        "event_displacement": np.stack([on_every_grain(field) for field in fields]),
        "event_quadrupole": quadrupole,
        "event_other_multipoles": others,
        "event_quadrupole_rank": rank,
        "event_reopened": [count_reopened(e.before, e.after, interaction) for e in events],
        **_states("before", before, [event.points[0] for event in events]),
        **_states("after", after, [event.points[1] for event in events]),
        "event_complex_pairs_after": [_count_pairs(equilibrium) for equilibrium in after],
    }


def on_every_grain(field: np.ndarray) -> np.ndarray:
    """A field (N, k) with all three components, (N, 3); the rotation is NaN without friction."""
    return nan_on_rattlers(field, np.ones(len(field), bool))


def _count_pairs(equilibrium: EquilibriumState) -> float:
    """Number of complex pairs of M⁻¹J, 0 for a symmetric J; NaN where the matrix is too large."""
    if is_frictionless(equilibrium.interaction):
        return 0.0
    if equilibrium.matrix.shape[0] > MAX_PAIR_DOF:
        return np.nan
    return float(count_complex_pairs(equilibrium.backbone, equilibrium.interaction))


def _states(
    side: str, equilibria: Sequence[EquilibriumState], points: Sequence[CurvePoint]
) -> dict[str, object]:
    """The states on one side of all events, with their grains and springs."""
    packings = [equilibrium.packing for equilibrium in equilibria]
    row = {
        "stress": [symmetric_shear(point.stress) for point in points],
        "g": [symmetric_shear(point.modulus) for point in points],
        "strain": [point.strain for point in points],
        "energy": [point.energy for point in points],
        "lowest_eigenvalue": [point.lowest_eigenvalue for point in points],
        "asymmetry": [asymmetry(equilibrium.matrix) for equilibrium in equilibria],
        "fraction": np.stack([packing.fraction.T for packing in packings]),
        **_springs(packings),
    }
    return {f"event_{name}_{side}": values for name, values in row.items()}


def _springs(packings: Sequence[Packing]) -> dict[str, object]:
    """Rotations and springs of several packings, nothing without friction."""
    if packings[0].rotation is None:
        return {}
    histories = [packing.history for packing in packings if packing.history is not None]
    rotations = [packing.rotation for packing in packings if packing.rotation is not None]
    return {
        "rotation": np.stack(rotations),
        "contact_i": stack_padded([history.i for history in histories], -1),
        "contact_j": stack_padded([history.j for history in histories], -1),
        "spring_state": stack_padded([history.spring_state for history in histories], np.nan),
    }


def _network_changes(changes: Sequence[NetworkChange]) -> dict[str, object]:
    if not changes:
        return {"change_count": 0}
    columns = zip(NetworkChange._fields, zip(*changes, strict=True), strict=True)
    return {"change_count": len(changes)} | {f"change_{name}": values for name, values in columns}
