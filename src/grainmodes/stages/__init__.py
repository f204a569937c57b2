"""Stages: pure functions that take a block of samples and return a block of samples.

    random grains → checkpoint → packing → { rigidity, step strain, spectrum, shear → … }

No function here touches a file or knows a path, but for the checkpoints of long samples. A block
says what made it: the parameters (attribute `config`), the version of the code, and the sentence of
every sample that failed. The table of all stages is `grainmodes.parameters.stages`. Only `point`,
which computes them all, reads it here, so that a new entry makes no old result again.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module


def load(function: str) -> Callable:
    """The function of an entry of the table of stages, from its `module:function`."""
    module, _, name = function.partition(":")
    return getattr(import_module(module), name)
