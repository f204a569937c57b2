"""A trajectory of a compression as one row of a block of checkpoints, and back."""

from __future__ import annotations

from typing import Any

import numpy as np

from grainmodes.dataset.files import Block, BlockError
from grainmodes.packing.box import PackingError
from grainmodes.protocols.compression.trajectory import PHI_ROUNDING, Trajectory
from grainmodes.stages.packing_rows import grain_columns, packing_in_row


def trajectory_row(trajectory: Trajectory) -> dict[str, object]:
    """The row of a trajectory, from which it can go on later."""
    return grain_columns(trajectory.packing) | {
        "phi_jamming": trajectory.phi_jamming,
        "iterations": trajectory.iterations,
        "step": trajectory.step,
        "converged": True,
    }


def trajectory_in_row(block: Block, number: int) -> Trajectory:
    """The trajectory in a row of checkpoints.

    Raises:
        PackingError: a stored value is NaN or infinite.
    """
    row = {name: block.variables[name][number] for name in ("step", "phi_jamming", "iterations")}
    if not np.isfinite(row["phi_jamming"]):
        raise PackingError(
            f"phi_jamming of the checkpoint: expected a finite number, got {row['phi_jamming']}"
        )
    return Trajectory(
        packing_in_row(block, number),
        int(row["step"]),
        float(row["phi_jamming"]),
        int(row["iterations"]),
    )


def check_start(block: Block, config: dict[str, Any], phi: float) -> None:
    """Check that a compression with parameters `config` to φ can start from some checkpoints.

    Raises:
        BlockError: they lie above φ, or were made with other parameters.
    """
    made = block.mapping("config")
    if _kind(made) != _kind(config):
        raise BlockError(
            f"the checkpoints: expected those of a compression {_kind(config)}, got those of one "
            f"{_kind(made)}"
        )
    found, expected = _choices(made), _choices(config)
    parts = [
        f"expected {key} = {value}, got {found.get(key, 'none')}"
        for key, value in expected.items()
        if found.get(key) != value
    ]
    parts += [f"expected no {key}, got {found[key]}" for key in found if key not in expected]
    if parts:
        raise BlockError(f"the checkpoints belong to another compression: {'; '.join(parts)}")
    reached = float(block.attributes["phi"])
    if reached > phi + PHI_ROUNDING:
        raise BlockError(f"the checkpoints: expected a phi of at most {phi}, got {reached}")


def _kind(config: dict[str, Any]) -> str:
    """How grains are compressed with these parameters."""
    return "with friction" if "frictional_compression" in config else "without friction"


def _choices(config: dict[str, Any]) -> dict[str, Any]:
    """Every choice of a compression by its name; those of its parts side by side."""
    parts = (value if isinstance(value, dict) else {name: value} for name, value in config.items())
    return {name: value for part in parts for name, value in part.items()}


def check_samples(block: Block, n: int, seeds: range) -> None:
    """Check that some checkpoints hold the samples of these seeds with N grains.

    Raises:
        BlockError: the block holds other seeds or another number of grains.
    """
    found = block.variables["seed"].tolist()
    if found != list(seeds) or int(block.attributes["n"]) != n:
        raise BlockError(
            f"the checkpoints: expected {n} grains and seeds {list(seeds)}, "
            f"got {block.attributes['n']} grains and seeds {found}"
        )
