"""Samples for which a stage has no whole result, and why.

| attribute   | a sample stands in it if                                                         |
| ----------- | -------------------------------------------------------------------------------- |
| `failures`  | a numerical method did not reach what was requested                              |
| `not_rigid` | the grains are not rigid, or lose their rigidity, so that the result does not    |
|             | exist                                                                            |

Both map stage → sample → reason, with the name of the stage in which the sample was lost. A sample
is its seed in a block and in a point, and "n,phi,kt,seed" in an ensemble. A block carries what the
blocks that it was computed from have lost. A sample that is not jammed from the start, or has no
event or no complex pair, is not lost: this is its result.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

KINDS = ("failures", "not_rigid")
"""The attributes."""

WORDS = {"failures": "failed", "not_rigid": "not rigid"}
"""Attribute → what a caption or a table says of such a sample."""

Lost = dict[str, dict[str, str]]
"""Stage → sample → reason."""


def merge_lost(parts: Iterable[Mapping[str, Mapping[str, str]]]) -> Lost:
    """The entries of several blocks together; what was carried from block to block stands once."""
    merged: Lost = {}
    for part in parts:
        for stage, samples in part.items():
            merged.setdefault(stage, {}).update(samples)
    return merged


def of_samples(lost: Mapping[str, Mapping[str, str]], samples: Iterable[str]) -> Lost:
    """The entries of these samples alone."""
    kept = set(samples)
    chosen = {
        stage: {sample: reason for sample, reason in entries.items() if sample in kept}
        for stage, entries in lost.items()
    }
    return {stage: entries for stage, entries in chosen.items() if entries}
