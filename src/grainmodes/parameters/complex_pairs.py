"""How complex pairs of eigenvalues are found and followed."""

from __future__ import annotations

from dataclasses import dataclass

DETECTIONS = ("continuation", "dense", "discs")


@dataclass(frozen=True)
class PairChoices:
    """Complex pairs along a quasistatic shear (C, Sec. V).

    `detection`: "continuation" takes the eigenvectors of the state before to a nearly diagonal J,
    "dense" solves every state anew, "discs" too, without a dense general solve.
    The first `max_located` births and as many deaths are bracketed to `bracket`, and their two
    modes are followed over `track_beyond` steps to both sides.
    `release_rates` are ω_i in 1/t_0: for each the state whose fastest pair grows at the nearest
    rate is kept for release. Without any it is the state of the fastest pair of the whole shear.
    """

    detection: str = "continuation"
    max_located: int = 4
    bracket: float = 1e-9
    track_beyond: int = 20
    jacobian: bool = False
    release_rates: tuple[float, ...] = ()
