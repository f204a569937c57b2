"""How complex pairs of eigenvalues are found and followed."""

from __future__ import annotations

from dataclasses import dataclass

DETECTIONS = ("carried", "dense", "windows")


@dataclass(frozen=True)
class PairChoices:
    """Complex pairs along a quasistatic shear (C, Sec. V).

    `detection`: "carried" takes the eigenvectors of the state before to a nearly diagonal J,
    "dense" solves every state anew, "windows" too, without a dense general solve.
    The first `located` births and as many deaths are bracketed to `bracket`, and their two modes
    are followed over `around` steps to both sides.
    """

    detection: str = "carried"
    located: int = 4
    bracket: float = 1e-9
    around: int = 20
    jacobian: bool = False
