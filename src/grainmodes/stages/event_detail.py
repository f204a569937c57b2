"""The stage `event_detail`: the first event of one sample in detail: B, Figs. 3-6 and 10-13.

The closest bracket, Δγ_Th = 1e-6 Δγ_in, gives the event whose states and fields are kept. A sample
without an event up to the last strain has `event_count` = 0 and none of these.
"""

from __future__ import annotations

from dataclasses import asdict

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import is_frictionless
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.event_states import (
    RATE_STEP,
    SLOPE_STEP,
    lowest_mode_of,
    on_all,
    rate_of,
    simulated_rate,
    states_around,
)
from grainmodes.protocols.shear.first_event import Bracket, bracket_ends, brackets, closer, steps
from grainmodes.protocols.shear.run import Walk
from grainmodes.protocols.shear.tangential_path import PathError, TangentialPath
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import first_sample, jammed_packing

SIDES = ("before", "after")


def event_detail_block(packings: Block, law: ContactLaw, choices: Shear) -> Block:
    """The first event of the first sample of a block; `choices.min_step` is not used."""
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        row = {"event_count": 0, "path_count": 0, "jammed": jammed, "converged": True}
        if not jammed:
            return row | _grains(packing)
        *_, closest = found = brackets(packing, interaction, choices)
        row |= _brackets(found) | _paths(packing, interaction, closer(choices)[0])
        if closest.event is None:
            return row | _grains(packing)
        return row | _event(closest, closer(choices)[-1])

    shear = {name: value for name, value in asdict(choices).items() if name != "min_step"}
    config = {"law": asdict(law), "shear": shear, "rate": RATE_STEP, "slope": SLOPE_STEP}
    return response_block(first_sample(packings), "event_detail", config, law, sample)


def _grains(packing: Packing) -> dict[str, object]:
    names = ("position", "diameter", "box_length", "strain")
    return {name: getattr(packing, name) for name in names}


def _brackets(found: list[Bracket]) -> dict[str, object]:
    """Every bracket with the curve around it."""
    sides = {f"stress_{side}": np.nan for side in SIDES}
    columns = sides | {"kind": 0, "opened": 0, "closed": 0}
    values = [columns | (_ends(b) if b.event else {}) for b in found]
    row = {f"bracket_{name}": [value[name] for value in values] for name in columns}
    longest = max(len(b.curve) for b in found)
    strain, stress = (np.full((len(found), longest), np.nan) for _ in range(2))
    for place, bracket in enumerate(found):
        strain[place, : len(bracket.curve)] = [p.strain for p in bracket.curve]
        stress[place, : len(bracket.curve)] = [_mean(p.stress) for p in bracket.curve]
    return (
        row | bracket_ends(found) | {"bracket_curve_strain": strain, "bracket_curve_stress": stress}
    )


def _ends(bracket: Bracket) -> dict[str, float]:
    event, ends = bracket.event, (bracket.before, bracket.after)
    return {
        **{f"stress_{side}": state.sigma for side, state in zip(SIDES, ends, strict=True)},
        **{name: getattr(event, name) for name in ("kind", "opened", "closed")},
    }


def _event(bracket: Bracket, choices: Shear) -> dict[str, object]:
    """The event, the states around it and its fields; grains where they are just after it."""
    event, after = bracket.event, bracket.after
    modes = [lowest_mode_of(state) for state in (bracket.before, after)]
    overlap = np.nansum(modes[0][1] * modes[1][1])
    moved = on_all(event.displacement, np.ones(len(event.displacement), bool))
    return _grains(event.after) | {
        "event_count": 1,
        "event_kind": [event.kind],
        "event_strain_before": [bracket.before.strain],
        "event_strain_after": [after.strain],
        "event_lowest_eigenvalue_before": [modes[0][0].eigenvalue],
        "event_lowest_eigenvalue_after": [modes[1][0].eigenvalue],
        "event_displacement": moved[None],
        "residual": max(mode.residual for mode, _ in modes),
        "lowest_mode_before": modes[0][1],
        "lowest_mode_after": modes[1][1] * (np.sign(overlap) or 1.0),
        "rate": rate_of(after),
        "rate_simulated": simulated_rate(after, choices),
        **_near(bracket, choices),
    }


def _near(bracket: Bracket, choices: Shear) -> dict[str, object]:
    near = states_around(bracket, choices)
    return {
        "near_distance": [n.distance for n in near],
        "near_strain": [n.state.strain for n in near],
        "near_stress": [n.state.sigma for n in near],
        "near_lowest_eigenvalue": [n.state.lowest for n in near],
        "near_g": [n.state.g for n in near],
        "near_g_numerical": [n.slope for n in near],
        "near_changes": [n.changes for n in near],
    }


def _paths(packing: Packing, interaction: Interaction, choices: Shear) -> dict[str, object]:
    """B's Err along the walk in whole steps, up to its first event."""
    if is_frictionless(interaction):
        return {}
    walk = Walk.start(packing, interaction, choices)
    path, errors = TangentialPath(walk.now.balance), []
    for _, now in steps(walk):
        if walk.events:
            break
        errors.append(path.follow(now.balance))
    row = {f"path_{name}": [getattr(e, name) for e in errors] for name in PathError._fields}
    return {"path_count": len(errors)} | (row if errors else {})


def _mean(tensor: np.ndarray) -> float:
    return float(tensor[0, 1] + tensor[1, 0]) / 2.0
