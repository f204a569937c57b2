"""The samples that an ensemble, or single samples, have lost: by stage, by point, and in words."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

from grainmodes.dataset.files import Block
from grainmodes.dataset.lost import KINDS, WORDS

if TYPE_CHECKING:
    import xarray as xr

Point = tuple[int, float, float]
"""n, φ, k_T/k_N."""


class LostSample(NamedTuple):
    """A sample without a whole result in a stage; `kind` is one of `dataset.lost.KINDS`."""

    kind: str
    stage: str
    n: int
    phi: float
    kt: float
    seed: int
    reason: str

    @property
    def point(self) -> Point:
        """Its n, φ and k_T/k_N."""
        return self.n, self.phi, self.kt

    @property
    def words(self) -> str:
        """What happened to it, in a word or two."""
        return WORDS[self.kind]

    def __str__(self) -> str:
        place = f"n = {self.n}, phi = {self.phi:g}, kt = {self.kt:g}, seed {self.seed}"
        return f"{place}: {self.reason}"


def point_name(n: int, phi: float, kt: float) -> str:
    """The name of a point in the attributes of an ensemble: "16,0.85,0.0001"."""
    return f"{n},{phi},{kt}"


def sample_name(n: int, phi: float, kt: float, seed: int) -> str:
    """The name of a sample in the attributes of an ensemble: "16,0.85,0.0001,3"."""
    return f"{point_name(n, phi, kt)},{seed}"


def points_of_stages(ensemble: xr.Dataset) -> dict[str, set[Point]]:
    """Stage → the points at which an ensemble requested it."""
    found = {}
    for stage, names in json.loads(ensemble.attrs.get("stages", "{}")).items():
        rows = (name.split(",") for name in names)
        found[stage] = {(int(n), float(phi), float(kt)) for n, phi, kt in rows}
    return found


def lost_samples(ensemble: xr.Dataset) -> list[LostSample]:
    """The samples that an ensemble has lost, stage by stage."""
    found = []
    for kind in KINDS:
        for stage, samples in json.loads(ensemble.attrs.get(kind, "{}")).items():
            for name, reason in samples.items():
                n, phi, kt, seed = name.split(",")
                place = int(n), float(phi), float(kt), int(seed)
                found.append(LostSample(kind, stage, *place, reason))
    return sorted(found)


def lost_in_blocks(blocks: Iterable[Block]) -> list[LostSample]:
    """The samples that blocks of one stage have lost, there or before."""
    found = set()
    for block in blocks:
        n, phi, kt = (block.attributes[name] for name in ("n", "phi", "kt"))
        for kind in KINDS:
            for stage, samples in block.mapping(kind).items():
                for seed, reason in samples.items():
                    place = int(n), float(phi), float(kt), int(seed)
                    found.add(LostSample(kind, stage, *place, reason))
    return sorted(found)


def lost_in_words(lost: Iterable[LostSample]) -> str:
    """How many samples were lost in which stage, with the first of each; nothing without any.

    >>> first = LostSample("failures", "shear", 16, 0.9, 1.0, 3, "no balance")
    >>> lost_in_words([first, first._replace(seed=4)])
    'Lost samples: 2 failed in shear (n = 16, phi = 0.9, kt = 1, seed 3: no balance; ...).'
    """
    found: dict[str, list[LostSample]] = {}
    for sample in lost:
        found.setdefault(f"{sample.words} in {sample.stage}", []).append(sample)
    parts = [
        f"{len(samples)} {words} ({samples[0]}{'; ...' if len(samples) > 1 else ''})"
        for words, samples in found.items()
    ]
    return f"Lost samples: {'; '.join(parts)}." if parts else ""
