"""The stage `pairs`: complex pairs of every packing of a block along its shear, C, Sec. V.

A row holds every state in numbers, every pair from birth to death, the exceptional points that were
located with the states around them, the two modes of each along the walk, and whole the state from
which the dynamics is released (C, Sec. VI): that of the fastest pair with room to grow (`room`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

import numpy as np

from grainmodes.complex_pairs.definition import on_all_grains
from grainmodes.complex_pairs.plane import plane_near
from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.mass_weighted import mass_weighted_jacobian, root_mass
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.pair_tracking.exceptional_points import COALESCENCE, Side
from grainmodes.protocols.pair_tracking.linear_range import Chosen
from grainmodes.protocols.pair_tracking.paths import path_of, products_along
from grainmodes.protocols.pair_tracking.tracking import Life, Located, PairWalk
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import jammed_packing


def complex_pairs_block(
    packings: Block, law: ContactLaw, shear: Shear, choices: PairChoices
) -> Block:
    """The complex pairs of every packing up to the last strain of `shear`."""
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        if not jammed:
            return {"pair_state_count": 0, "jammed": False, "converged": True}
        walk = PairWalk.start(packing, interaction, shear, choices)
        ending = _walked(walk)
        return row_of(walk) | ({} if walk.done else {"failure": ending})

    used = {name: value for name, value in asdict(shear).items() if name not in NOT_USED}
    config = {"law": asdict(law), "shear": used, "complex_pairs": asdict(choices)}
    return response_block(packings, "complex_pairs", config, law, sample)


NOT_USED = ("min_step", "lowest_eigenvalue")
"""Choices of a shear that this stage does not follow."""


def _walked(walk: PairWalk) -> str:
    """Go on to the last strain, or to where no balance is found; then why."""
    try:
        while not walk.done:
            walk.advance()
    except ArithmeticError as error:
        return str(error)
    return ""


def row_of(walk: PairWalk) -> dict[str, object]:
    """All that was recorded on the way; not converged where it ended before the last strain."""
    packing = walk.now.balance.packing
    still = {name: getattr(packing, name) for name in ("diameter", "mass", "box_length")}
    return {
        **still,
        **_states(walk),
        **_lives(walk.lives),
        **_located(walk),
        **_unstable(walk.unstable),
        "jammed": True,
        "converged": walk.done,
    }


def _states(walk: PairWalk) -> dict[str, object]:
    fastest = np.array([count.fastest for count in walk.counts])
    frequency = np.sqrt(fastest)
    return {
        "pair_state_count": len(walk.counts),
        "pair_strain": [count.strain for count in walk.counts],
        "pair_count": [count.pairs for count in walk.counts],
        "pair_count_jacobian": [count.of_jacobian for count in walk.counts],
        "pair_growth": frequency.imag,
        "pair_frequency": frequency.real,
        "pair_condition": [count.condition for count in walk.counts],
        "pair_dense": [count.dense for count in walk.counts],
    }


def _lives(lives: list[Life]) -> dict[str, object]:
    row: dict[str, object] = {"track_count": len(lives)}
    if not lives:
        return row
    for event in ("birth", "death"):
        ends = np.array([getattr(life, event) for life in lives])
        row |= {f"track_{event}_before": ends[:, 0], f"track_{event}_after": ends[:, 1]}
        row[f"track_{event}_kind"] = [getattr(life, f"{event}_kind") for life in lives]
    return row | {"track_growth": [life.largest for life in lives]}


def _located(walk: PairWalk) -> dict[str, object]:
    """The exceptional points, and the two modes near them and along the walk."""
    row: dict[str, object] = {"exceptional_point_count": len(walk.located)}
    if not walk.located:
        return row
    points = [one.point for one in walk.located]
    row |= {
        "exceptional_point_track": [one.life for one in walk.located],
        "exceptional_point_birth": [one.born for one in walk.located],
        "exceptional_point_kind": [point.kind for point in points],
        "exceptional_point_before": [point.below for point in points],
        "exceptional_point_after": [point.above for point in points],
        "exceptional_point_strain": [point.strain for point in points],
    }
    for name, real in (("real", True), ("pair", False)):
        exponents = [point.exponent(real) for point in points]
        row[f"exceptional_point_exponent_{name}"] = [exponent.value for exponent in exponents]
        row[f"exceptional_point_exponent_{name}_error"] = [exponent.error for exponent in exponents]
    return row | _near(walk.located) | _followed(walk) | _products(walk)


def _near(located: Sequence[Located]) -> dict[str, object]:
    rows = [
        (place, near.distance, plane.sum, plane.discriminant, plane.product, plane.condition, error)
        for place, one in enumerate(located)
        for near in one.point.near
        for plane in [near.plane]
        for error in [plane.residual]
    ]
    names = ("point", "distance", "sum", "discriminant", "product", "condition", "residual")
    return _columns("neighbour", names, rows)


def _followed(walk: PairWalk) -> dict[str, object]:
    rows = [
        (place, side.strain, *_two(side))
        for place, one in enumerate(walk.located)
        if one.point.kind == COALESCENCE
        for side in path_of(one.pair, walk.states, walk.asked.track_beyond)
    ]
    names = ("point", "strain", "real_1", "real_2", "imaginary", "product")
    return _columns("followed", names, rows)


def _two(side: Side) -> tuple[float, ...]:
    one, two = side.plane.values
    return one.real, two.real, one.imag, side.plane.product


def _products(walk: PairWalk) -> dict[str, object]:
    """Of the first coalescence among few grains."""
    first = [one.pair for one in walk.located if one.point.kind == COALESCENCE][:1]
    found = [products for pair in first for products in products_along(pair, walk.states)]
    rows = [
        (products.strain, products.mode, other, product)
        for products in found
        for other, product in enumerate(products.product.tolist())
        if other != products.mode
    ]
    return _columns("product", ("strain", "mode", "other", "value"), rows)


def _columns(of: str, names: Sequence[str], rows: list[tuple]) -> dict[str, object]:
    """Rows as columns `of_name`; none without a row."""
    columns = zip(*rows, strict=True) if rows else ()
    return {f"{of}_{name}": values for name, values in zip(names, columns, strict=bool(rows))}


def _unstable(unstable: Chosen | None) -> dict[str, object]:
    """The state to release, its pair sharpened to the last digits."""
    if unstable is None:
        return {"unstable_found": False}
    balance = unstable.state.balance
    packing, side = balance.packing, unstable.state.side(unstable.place)
    plane = plane_near(mass_weighted_jacobian(balance.matrix, balance.backbone.mass), side.plane)
    mode = mode_of(Side(balance, plane))
    return {
        "unstable_found": True,
        "unstable_strain": packing.strain,
        "unstable_fraction": packing.fraction.T,
        "unstable_rotation": packing.rotation,
        "unstable_contact_i": packing.history.i,
        "unstable_contact_j": packing.history.j,
        "unstable_spring_state": packing.history.spring_state,
        "unstable_eigenvalue_real": plane.values[0].real,
        "unstable_eigenvalue_imag": plane.values[0].imag,
        "unstable_condition": plane.condition,
        "unstable_residual": plane.residual,
        "unstable_linear_range": unstable.room,
        "unstable_mode_real": mode.real,
        "unstable_mode_imag": mode.imag,
    }


def mode_of(side: Side) -> np.ndarray:
    """q = M^(−1/2) u of λ1 on all grains, (N, 3) complex, of norm 1, its largest component real."""
    balance = side.balance
    scale = 1.0 / root_mass(balance.backbone.mass).ravel()
    q = on_all_grains(scale[:, None] * side.plane.vectors[:, :1], balance.held).reshape(-1, 3)
    top = q.ravel()[np.argmax(np.abs(q))]
    return q * (abs(top) / top / np.linalg.norm(q))
