"""Samples that a scene requests and a figure lacks: how many, at which point, and why.

A sample is missing where it was lost in a stage of its point (`ensemble.lost`), and in averages of
sheared samples also where it is not jammed. A point belongs to a figure if each of its n, φ and k_T
is among those drawn; a point without any sample left also if one of them is not, because the figure
would have drawn it. Of a released sample some states may be lost and others not: it counts as used,
and it is said that it failed in part.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pandas as pd

from grainmodes.dataset.files import Block
from grainmodes.ensemble.lost import (
    LostSample,
    Point,
    lost_in_blocks,
    lost_samples,
    points_of_stages,
)
from grainmodes.figures.shared import labels
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.stages import STAGES, responses

if TYPE_CHECKING:
    import xarray as xr

MAX_POINTS = 3
"""Largest number of points that a figure names one by one."""

NOTHING = {
    "shear": "no jammed sample was sheared",
    "complex_pairs": "no jammed sample has a located birth or death of a complex pair",
    "law_comparison": "no jammed sample was sheared under the tangential laws",
    "release": "no sample has a complex pair that can be released",
    "event_detail": "no jammed sample has an event up to the last strain",
}
"""Observable of a figure → what an empty answer means, if no sample was lost."""

NOTHING_JAMMED = "no jammed sample to show"

NOT_JAMMED, NOT_COMPUTED = "not jammed", "not computed"
"""Reasons without a stage."""


class Shortage(NamedTuple):
    """A point with fewer samples than requested, and how many are missing for which reason."""

    point: Point
    used: int
    requested: int
    reasons: Counter[str]

    def __str__(self) -> str:
        n, phi, kt = self.point
        why = ", ".join(f"{count} {reason}" for reason, count in sorted(self.reasons.items()))
        place = f"N = {n}, φ = {labels.fraction(phi)}, $k_T/k_N = {labels.ratio(kt)}$"
        samples = "sample" if self.requested == 1 else "samples"
        return f"{place}: {self.used} of {self.requested} {samples} ({why})"


def shortages(name: str, source: xr.Dataset | list[Block]) -> list[Shortage]:
    """The points of an ensemble, or of files of single samples, that lack samples for a figure."""
    if isinstance(source, list):
        return _in_blocks(source)
    only_jammed = bool({*NOTHING} & {*FIGURES[name].observables})
    points = points_of_stages(source)
    drawn = set.intersection(*(points.get(stage, set()) for stage in _stages_of(name)))
    return [found for found in _in_ensemble(source, only_jammed) if found.point in drawn]


def _stages_of(name: str) -> set[str]:
    """The stages that a figure cannot do without."""
    words = {"spectrum" if word == "modes" else word for word in FIGURES[name].observables}
    return {stage.output for stage in responses() if stage.observable in words}


def notes(name: str, found: Iterable[Shortage], table: pd.DataFrame, empty: str = "") -> list[str]:
    """What a figure says of the samples that it lacks; of an empty one, why it is empty.

    Args:
        empty: what an empty table means where no sample was lost; by default `NOTHING`.
    """
    shown = [shortage for shortage in found if _belongs(shortage, table)]
    lines = [str(shortage) for shortage in shown[:MAX_POINTS]]
    if len(shown) > MAX_POINTS:
        lines.append(f"and {len(shown) - MAX_POINTS} more points with fewer samples than requested")
    if table.empty and not (shown and all(shortage.used == 0 for shortage in shown)):
        words = [NOTHING[word] for word in FIGURES[name].observables if word in NOTHING]
        lines.insert(0, empty or next(iter(words), NOTHING_JAMMED))
    return lines


def _belongs(shortage: Shortage, table: pd.DataFrame) -> bool:
    lost = {*shortage.reasons} != {NOT_JAMMED}
    if table.empty:
        return lost
    coordinates = zip(("n", "phi", "kt"), shortage.point, strict=True)
    absent = sum(value not in set(table[name]) for name, value in coordinates)
    if absent == 0:
        return lost or "samples" in table
    return lost and absent == 1 and shortage.used == 0


def _in_ensemble(ensemble: xr.Dataset, only_jammed: bool) -> list[Shortage]:
    gathered = {stage.output for stage in STAGES.values() if not stage.single_sample}
    lost = [sample for sample in lost_samples(ensemble) if sample.stage in gathered]
    converged = ensemble["converged"].transpose("n", "phi", "kt", "seed")
    requested, whole = converged.notnull().to_numpy(), (converged == 1).to_numpy()
    used = whole
    if only_jammed and "jammed" in ensemble:
        used = whole & (ensemble["jammed"].transpose(*converged.dims) == 1).to_numpy()
    grid = [ensemble[axis].to_numpy().tolist() for axis in ("n", "phi", "kt")]
    seeds, found = ensemble["seed"].to_numpy().tolist(), []
    for place in np.argwhere((requested & ~used).any(axis=-1)).tolist():
        point = tuple(axis[k] for axis, k in zip(grid, place, strict=True))
        reasons = _reasons(point, lost)
        missing = requested[tuple(place)] & ~used[tuple(place)]
        counts = Counter(
            NOT_JAMMED if whole[(*place, row)] else reasons.get(seeds[row], NOT_COMPUTED)
            for row in np.flatnonzero(missing).tolist()
        )
        left, asked = (int(part[tuple(place)].sum()) for part in (used, requested))
        found.append(Shortage(point, left, asked, counts))
    return found


def _in_blocks(blocks: list[Block]) -> list[Shortage]:
    lost = lost_in_blocks(blocks)
    rows: dict[Point, dict[int, int]] = {}
    for block in blocks:
        n, phi, kt = (float(block.attributes[name]) for name in ("n", "phi", "kt"))
        columns = (block.variables[name].tolist() for name in ("seed", "converged"))
        rows.setdefault((int(n), phi, kt), {}).update(zip(*columns, strict=True))
    found = []
    for point, converged in rows.items():
        reasons, used = _reasons(point, lost), sum(converged.values())
        counts = Counter(
            f"{reasons[seed]} in part" if whole else reasons.get(seed, NOT_COMPUTED)
            for seed, whole in converged.items()
            if not whole or seed in reasons
        )
        if counts:
            found.append(Shortage(point, used, len(converged), counts))
    return sorted(found)


def _reasons(point: Point, lost: Iterable[LostSample]) -> dict[int, str]:
    """Seed → in which stage and how it was lost at a point."""
    return {
        sample.seed: f"{sample.words} in {sample.stage}" for sample in lost if sample.point == point
    }
