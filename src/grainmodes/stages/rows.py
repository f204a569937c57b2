"""Samples as rows of a block: a sample that fails is a row without numbers; the others go on."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from grainmodes.dataset import VARIABLES
from grainmodes.dataset.files import Block, BlockError
from grainmodes.dataset.padding import stack_padded
from grainmodes.parameters.law import ContactLaw
from grainmodes.runtime.provenance import code_version

SAMPLE_ERRORS = (ArithmeticError, ValueError, np.linalg.LinAlgError, MemoryError)
"""Errors of a single sample; any other error is a mistake in the code and stops the job."""

Sample = Callable[[int], dict[str, Any]]
"""Row number → values of the row by name."""

FILL = {"f8": np.nan, "i8": 0, "i4": -1, "i1": 0}
"""Value that stands for a number that does not exist, by its type."""


def compute_block(
    seeds: Iterable[int],
    sample: Sample,
    known_failures: dict[str, str],
    attributes: dict[str, object],
) -> Block:
    """Compute a row for every seed, and stack the rows.

    Args:
        seeds: one row each, in this order.
        sample: takes the number of a row and returns its values by name. It raises one of
            `SAMPLE_ERRORS` where it fails; where it fails but has values, it returns them with the
            reason under "failure".
        known_failures: seed → sentence of samples that failed in an earlier stage.
        attributes: attributes of the block besides the code version and the failures.
    """
    seeds, failures, rows = list(seeds), dict(known_failures), []
    for number, seed in enumerate(seeds):
        row: dict[str, Any] = {}
        if str(seed) not in failures:
            try:
                row = sample(number)
            except SAMPLE_ERRORS as error:
                failures[str(seed)] = f"{type(error).__name__}: {error}"
        if "failure" in row:
            failures[str(seed)] = str(row.pop("failure"))
        rows.append(row)
    variables = {"seed": np.array(seeds)} | _stacked(rows)
    made_by = {"code_version": code_version(), "failures": failures}
    return Block(variables, attributes | made_by)


def response_block(
    packings: Block,
    stage: str,
    config: dict[str, Any],
    law: ContactLaw,
    sample: Sample,
) -> Block:
    """The block of an observable of `packings`, with the parameters of the packings.

    Args:
        config: the parameters of the stage.
        sample: as in `compute_block`.

    Raises:
        BlockError: the packings have no attribute n or phi.
    """
    absent = [name for name in ("n", "phi") if name not in packings.attributes]
    if absent:
        raise BlockError(
            f"the packings: expected the attributes n and phi, got no {' and no '.join(absent)}"
        )
    point = {name: packings.attributes[name] for name in ("n", "phi")} | {"kt": law.kt}
    attributes = stage_attributes(stage, packings.mapping("config") | config, **point)
    failures = packings.mapping("failures")
    return compute_block(packings.variables["seed"], sample, failures, attributes)


def stage_attributes(stage: str, config: dict[str, Any], **point: object) -> dict[str, object]:
    """The attributes of a block of a stage."""
    return {"title": f"grainmodes: {stage}", "stage": stage, "config": config, **point}


def _stacked(rows: list[dict[str, Any]]) -> dict[str, np.ndarray]:
    """Arrays over all rows; shorter rows, and rows without a name, are filled up."""
    names = list(dict.fromkeys(name for row in rows for name in row)) or ["converged"]
    dtypes = {name: VARIABLES[name].dtype for name in names}
    return {
        name: stack_padded([row.get(name) for row in rows], FILL[dtype], dtype)
        for name, dtype in dtypes.items()
    }
