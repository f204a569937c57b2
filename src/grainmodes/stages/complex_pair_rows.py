"""What the tracking of complex pairs leaves behind, as values of one row by the dataset's names."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from grainmodes.complex_pairs.definition import vectors_on_all_grains
from grainmodes.complex_pairs.inverse_iteration import nearest_subspace
from grainmodes.packing.mass_weighted import mass_weighted_jacobian, root_mass
from grainmodes.protocols.pair_tracking.exceptional_points import COALESCENCE, TwoModeState
from grainmodes.protocols.pair_tracking.paths import follow_along, scalar_products_along
from grainmodes.protocols.pair_tracking.release_candidates import ReleaseCandidate
from grainmodes.protocols.pair_tracking.tracking import LocatedPoint, PairTrack, PairTracking
from grainmodes.stages.rows import stacked


def tracking_row(tracking: PairTracking) -> dict[str, object]:
    """Everything recorded along a shear; not converged where it ended before the last strain."""
    packing = tracking.now.equilibrium.packing
    return {
        **{name: getattr(packing, name) for name in ("diameter", "mass", "box_length")},
        **_states(tracking),
        **_tracks(tracking.tracks),
        **_exceptional_points(tracking),
        **_unstable_states(tracking),
        "jammed": True,
        "converged": tracking.done,
    }


def _states(tracking: PairTracking) -> dict[str, object]:
    """Every state of the shear in numbers, with ω_r + iω_i of its fastest pair."""
    states = tracking.records
    root = np.sqrt(np.array([state.fastest for state in states]))
    return {
        "pair_state_count": len(states),
        "pair_strain": [state.strain for state in states],
        "pair_count": [state.pairs for state in states],
        "pair_count_jacobian": [state.jacobian_pairs for state in states],
        "pair_growth": root.imag,
        "pair_frequency": root.real,
        "pair_condition": [state.condition for state in states],
        "pair_dense": [state.dense for state in states],
    }


def _tracks(tracks: Sequence[PairTrack]) -> dict[str, object]:
    """Every pair with the strains between which it was born and died."""
    row: dict[str, object] = {"track_count": len(tracks)}
    if not tracks:
        return row
    for event in ("birth", "death"):
        strains = np.array([getattr(track, event) for track in tracks])
        row[f"track_{event}_before"] = strains[:, 0]
        row[f"track_{event}_after"] = strains[:, 1]
        row[f"track_{event}_kind"] = [getattr(track, f"{event}_kind") for track in tracks]
    return row | {"track_growth": [track.max_growth for track in tracks]}


def _exceptional_points(tracking: PairTracking) -> dict[str, object]:
    """The exceptional points, and the two modes near them and along the shear."""
    located = tracking.located
    row: dict[str, object] = {"exceptional_point_count": len(located)}
    if not located:
        return row
    points = [one.point for one in located]
    row |= {
        "exceptional_point_track": [one.track for one in located],
        "exceptional_point_birth": [one.born for one in located],
        "exceptional_point_kind": [point.kind for point in points],
        "exceptional_point_before": [point.below for point in points],
        "exceptional_point_after": [point.above for point in points],
        "exceptional_point_strain": [point.strain for point in points],
    }
    for name, real in (("real", True), ("pair", False)):
        exponents = [point.exponent(real) for point in points]
        row[f"exceptional_point_exponent_{name}"] = [exponent.value for exponent in exponents]
        row[f"exceptional_point_exponent_{name}_error"] = [exponent.error for exponent in exponents]
    return row | _neighbours(located) | _two_modes(tracking) | _products(tracking)


def _neighbours(located: Sequence[LocatedPoint]) -> dict[str, object]:
    """The states near every exceptional point, with numbers of the subspace of its two modes."""
    names = ("sum", "discriminant", "product", "condition", "residual")
    rows = [
        (place, near.distance, *(getattr(near.subspace, name) for name in names))
        for place, one in enumerate(located)
        for near in one.point.neighbours
    ]
    return _columns("neighbour", ("point", "distance", *names), rows)


def _two_modes(tracking: PairTracking) -> dict[str, object]:
    """The two modes of every coalescence along the shear."""
    beyond = tracking.choices.track_beyond
    rows = []
    for place, one in enumerate(tracking.located):
        if one.point.kind != COALESCENCE:
            continue
        for side in follow_along(one.pair, tracking.states, beyond):
            first, second = side.subspace.values
            product = side.subspace.product
            rows.append((place, side.strain, first.real, second.real, first.imag, product))
    names = ("point", "strain", "real_1", "real_2", "imaginary", "product")
    return _columns("followed", names, rows)


def _products(tracking: PairTracking) -> dict[str, object]:
    """Scalar products of a mode of the first coalescence with all others, among few grains."""
    pairs = [one.pair for one in tracking.located if one.point.kind == COALESCENCE]
    states = scalar_products_along(pairs[0], tracking.states) if pairs else []
    rows = [
        (state.strain, state.mode, other, product)
        for state in states
        for other, product in enumerate(state.product.tolist())
        if other != state.mode
    ]
    return _columns("product", ("strain", "mode", "other", "value"), rows)


def _columns(
    prefix: str, names: Sequence[str], rows: Sequence[tuple[object, ...]]
) -> dict[str, object]:
    """The columns of some rows as `prefix_name`; nothing if there is no row."""
    if not rows:
        return {}
    columns = zip(names, zip(*rows, strict=True), strict=True)
    return {f"{prefix}_{name}": values for name, values in columns}


def _unstable_states(tracking: PairTracking) -> dict[str, object]:
    """The states to release, one after the other along the axis `release_state`."""
    states = [
        _unstable_state(candidate, tracking) if candidate else {"unstable_found": False}
        for candidate in tracking.candidates.found
    ]
    return dict(stacked(states))


def _unstable_state(chosen: ReleaseCandidate, tracking: PairTracking) -> dict[str, object]:
    """A state to release, its pair refined to the last digits and followed along the shear."""
    equilibrium = chosen.state.equilibrium
    packing, side = equilibrium.packing, chosen.state.two_modes(chosen.place)
    springs = packing.history
    assert springs is not None  # without them J is symmetric and has no complex pair
    subspace = nearest_subspace(
        mass_weighted_jacobian(equilibrium.matrix, equilibrium.backbone.mass), side.subspace
    )
    pair = TwoModeState(equilibrium, subspace)
    mode = motion_of(pair)
    path = follow_along(pair, tracking.states, tracking.choices.track_beyond)
    values = np.array([state.subspace.values for state in path])
    return {
        "unstable_found": True,
        "unstable_strain": packing.strain,
        "unstable_pair_count": len(chosen.state.pairs.value),
        "unstable_fraction": packing.fraction.T,
        "unstable_rotation": packing.rotation,
        "unstable_contact_i": springs.i,
        "unstable_contact_j": springs.j,
        "unstable_spring_state": springs.spring_state,
        "unstable_eigenvalue_real": subspace.values[0].real,
        "unstable_eigenvalue_imag": subspace.values[0].imag,
        "unstable_condition": subspace.condition,
        "unstable_residual": subspace.residual,
        "unstable_linear_range": chosen.linear_range,
        "unstable_mode_real": mode.real,
        "unstable_mode_imag": mode.imag,
        "unstable_path_strain": [state.strain for state in path],
        "unstable_path_real_1": values[:, 0].real,
        "unstable_path_real_2": values[:, 1].real,
        "unstable_path_imaginary": values[:, 0].imag,
    }


def motion_of(side: TwoModeState) -> np.ndarray:
    """q = M^(−1/2) u of the first mode of a pair on all grains, (N, 3) complex.

    Its norm is 1 and its largest component real.
    """
    equilibrium = side.equilibrium
    scale = 1.0 / root_mass(equilibrium.backbone.mass).ravel()
    q = vectors_on_all_grains(
        scale[:, None] * side.subspace.vectors[:, :1], equilibrium.backbone_mask
    ).reshape(-1, 3)
    largest = q.ravel()[np.argmax(np.abs(q))]
    motion: np.ndarray = q * (abs(largest) / largest / np.linalg.norm(q))
    return motion
