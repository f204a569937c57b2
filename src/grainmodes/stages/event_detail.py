"""The stage `event_detail`: the first event of one sample in detail: B, Figs. 3-6 and 10-13.

The narrowest bracket, Δγ_Th = 1e-6 Δγ_in, gives the event whose states and fields are kept. A
sample without an event up to the last strain has `event_count` = 0 and none of these.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.dataset.padding import stack_padded
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.event_states import (
    RATE_STEP,
    SLOPE_STEP,
    lowest_mode_of,
    nonaffine_rate,
    simulated_nonaffine_rate,
    states_around,
)
from grainmodes.protocols.shear.events import PlasticEvent
from grainmodes.protocols.shear.first_event import Bracket, bracket_first_event, refined_steps
from grainmodes.protocols.shear.sheared_state import ShearedState
from grainmodes.stages.rows import loss, response_block
from grainmodes.stages.samples import first_sample, jammed_packing
from grainmodes.stages.shear_rows import (
    bracket_ends,
    bracket_failures,
    on_every_grain,
    path_errors_row,
    symmetric_shear,
)


def event_detail_block(packings: Block, law: ContactLaw, choices: Shear) -> Block:
    """The first event of the first sample of a block; `choices.min_step` is not used."""
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        row: dict[str, object] = {"event_count": 0, "path_count": 0}
        row |= {"jammed": jammed, "converged": True}
        if not jammed:
            return row | _grains(packing)
        brackets, refined = (
            bracket_first_event(packing, interaction, choices),
            refined_steps(choices),
        )
        narrowest, lost = brackets[-1], loss(bracket_failures(brackets))
        row |= _brackets(brackets) | path_errors_row(packing, interaction, refined[0])
        row |= {"converged": not lost, **lost}
        if narrowest.event is None or narrowest.after is None:
            return row | _grains(packing)
        return row | _event(narrowest, narrowest.event, narrowest.after, refined[-1])

    shear = {name: value for name, value in asdict(choices).items() if name != "min_step"}
    config = {"law": asdict(law), "shear": shear, "rate": RATE_STEP, "slope": SLOPE_STEP}
    return response_block(first_sample(packings), "event_detail", config, law, sample)


def _grains(packing: Packing) -> dict[str, object]:
    names = ("position", "diameter", "box_length", "strain")
    return {name: getattr(packing, name) for name in names}


def _brackets(brackets: Sequence[Bracket]) -> dict[str, object]:
    """Every bracket with its event, its ends and the curve around it."""
    names = ("stress_before", "stress_after", "kind", "opened", "closed")
    columns = zip(names, zip(*map(_bracket_values, brackets), strict=True), strict=True)
    curves = [bracket.curve for bracket in brackets]
    strain = [[point.strain for point in curve] for curve in curves]
    stress = [[symmetric_shear(point.stress) for point in curve] for curve in curves]
    return {
        **{f"bracket_{name}": values for name, values in columns},
        **bracket_ends(brackets),
        "bracket_curve_strain": stack_padded(strain, np.nan, float),
        "bracket_curve_stress": stack_padded(stress, np.nan, float),
    }


def _bracket_values(bracket: Bracket) -> tuple[float, float, int, int, int]:
    """Stress before and after the event, its kind, and the contacts opened and closed."""
    event, after = bracket.event, bracket.after
    if event is None or after is None:
        return np.nan, np.nan, 0, 0, 0
    return bracket.before.sigma, after.sigma, event.kind, event.opened, event.closed


def _event(
    bracket: Bracket, event: PlasticEvent, after: ShearedState, choices: Shear
) -> dict[str, object]:
    """The event, the states around it and its fields; grains where they are just after it."""
    before = bracket.before
    (mode_before, vector_before), (mode_after, vector_after) = map(lowest_mode_of, (before, after))
    overlap = np.nansum(vector_before * vector_after)
    return _grains(event.after) | {
        "event_count": 1,
        "event_kind": [event.kind],
        "event_strain_before": [before.strain],
        "event_strain_after": [after.strain],
        "event_lowest_eigenvalue_before": [mode_before.eigenvalue],
        "event_lowest_eigenvalue_after": [mode_after.eigenvalue],
        "event_displacement": on_every_grain(event.displacement)[None],
        "residual": max(mode_before.residual, mode_after.residual),
        "lowest_mode_before": vector_before,
        "lowest_mode_after": vector_after * (np.sign(overlap) or 1.0),
        "rate": nonaffine_rate(after),
        "rate_simulated": simulated_nonaffine_rate(after, choices),
        **_branches(bracket, choices),
    }


def _branches(bracket: Bracket, choices: Shear) -> dict[str, object]:
    """The states on both branches that meet at the event."""
    branches = states_around(bracket, choices)
    states = [one.state for one in branches]
    return {
        "near_distance": [one.distance for one in branches],
        "near_strain": [state.strain for state in states],
        "near_stress": [state.sigma for state in states],
        "near_lowest_eigenvalue": [state.lowest_eigenvalue for state in states],
        "near_g": [state.g for state in states],
        "near_g_numerical": [one.slope for one in branches],
        "near_changes": [one.changes for one in branches],
    }
