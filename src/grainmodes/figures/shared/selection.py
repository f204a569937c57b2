"""Which part of an ensemble a figure shows: what the study requests, else the choice of paper A."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from grainmodes.parameters.spectra import MIN_BIN_DENSITY

PAPER_PANEL_KTS = (1e-8, 1e-4, 1.0, 10.0)
"""k_T/k_N of the four panels of A, Figs. 8 and 9."""

PAPER_RATTLER_KTS = (1e-8, 1e-4)
"""k_T/k_N of the two panels of A, Figs. 13 and 14."""

PAPER_WEAK_KT = 1e-8
"""k_T/k_N of A, Figs. 11, 15 and 16."""

NAMES = ("n", "phi", "kt", "bin_density", "seed")
"""The options of a figure."""

MAX_CURVES = 8
"""Number of curves that can be told apart in one panel; of more values, evenly spread ones are
shown."""


@dataclass(frozen=True)
class Options:
    """What a study may request of a figure.

    `n`, `phi`: the value shown by figures that show one; None is the largest of the ensemble.
    `kt`: the values of k_T/k_N to show; None is the figure's own choice.
    `seed`: the sample shown by figures that show one; None is the first.
    `bin_density`: factor on the numbers of linear bins of A's spectra (500 and 100), below 1 where
    an ensemble has too few modes for them; None is the choice of the study. Spectra that were
    counted in bins keep these.
    """

    n: int | None = None
    phi: float | None = None
    kt: tuple[float, ...] | None = None
    bin_density: float | None = None
    seed: int | None = None
    used: set[str] = field(default_factory=set, init=False, repr=False, compare=False)

    def __getattribute__(self, name: str) -> Any:
        """The value of an option, which then counts as used."""
        if name in NAMES:
            object.__getattribute__(self, "used").add(name)
        return object.__getattribute__(self, name)

    @classmethod
    def read(cls, figure: str, given: dict) -> Options:
        """Options from a dictionary.

        Raises:
            ValueError: a key is unknown, or `bin_density` leaves less than a bin, or is above 1.
        """
        unknown = [key for key in given if key not in NAMES]
        if unknown:
            raise ValueError(
                f"figure {figure}: unknown option {unknown[0]!r}, "
                f"expected one of {', '.join(NAMES)}"
            )
        density = given.get("bin_density", 1.0)
        if not MIN_BIN_DENSITY <= density <= 1.0:
            raise ValueError(
                f"figure {figure}: expected a bin_density from {MIN_BIN_DENSITY} to 1, "
                f"got {density}"
            )
        return cls(**given)

    def check_used(self, figure: str) -> None:
        """Refuse what was requested of a figure that is drawn without it.

        Raises:
            ValueError: an option is given that the figure did not use.
        """
        values = {name: object.__getattribute__(self, name) for name in NAMES}
        for name, value in values.items():
            if value is not None and name not in self.used:
                raise ValueError(
                    f"figure {figure}: expected no {name}, because it shows no choice of it, "
                    f"got {value}"
                )

    def one_kt(self) -> float | None:
        """The k_T/k_N of a figure that shows one; None if none is requested.

        Raises:
            ValueError: several are requested.
        """
        if self.kt is not None and len(self.kt) > 1:
            raise ValueError(f"kt: expected one value for this figure, got {len(self.kt)}")
        return self.kt[0] if self.kt else None


def largest_or(requested: float | None, values: np.ndarray, name: str) -> float:
    """The requested value; the largest of `values` where none is requested.

    Raises:
        ValueError: the requested value is not one of `values`; the message calls it `name`.
    """
    return values.max().item() if requested is None else _existing(requested, values, name)


def smallest_or(requested: int | None, values: np.ndarray, name: str) -> int:
    """The requested value; the smallest of `values` where none is requested.

    Raises:
        ValueError: as `largest_or`.
    """
    return values.min().item() if requested is None else _existing(requested, values, name)


def choose_curves(
    requested: tuple[float, ...] | None, values: np.ndarray, name: str
) -> list[float]:
    """The requested values, else all of `values`, or evenly spread ones if there are too many.

    Raises:
        ValueError: as `largest_or`.
    """
    if requested is not None:
        return sorted(_existing(value, values, name) for value in requested)
    return _spread(values, MAX_CURVES)


def choose_panels(
    requested: tuple[float, ...] | None,
    values: np.ndarray,
    paper: tuple[float, ...] = PAPER_PANEL_KTS,
) -> list[float]:
    """k_T/k_N of the panels of a figure of spectra.

    The requested values, else those of the paper if the ensemble has all of them, else as many
    evenly spread ones.

    Raises:
        ValueError: as `largest_or`.
    """
    if requested is not None:
        return choose_curves(requested, values, "kt")
    found = [kt for kt in paper if len(_equal(values, kt))]
    return found if len(found) == len(paper) else _spread(values, len(paper))


def choose_weak(requested: float | None, values: np.ndarray) -> float:
    """The one k_T/k_N of a figure of weak friction: the requested one, A's, or the smallest.

    Raises:
        ValueError: as `largest_or`.
    """
    if requested is not None:
        return _existing(requested, values, "kt")
    paper = _equal(values, PAPER_WEAK_KT)
    return (paper if len(paper) else values)[0].item()


def positive_kts(values: np.ndarray, figure: str) -> np.ndarray:
    """The values of k_T/k_N that a logarithmic axis can show.

    Raises:
        ValueError: there is none.
    """
    if not (values > 0).any():
        raise ValueError(f"figure {figure}: expected an ensemble with a k_T > 0, got none")
    return values[values > 0]


def _existing(requested: float, values: np.ndarray, name: str) -> float:
    found = _equal(values, requested)
    if not len(found):
        existing = ", ".join(map(str, values))
        raise ValueError(f"{name}: expected one of {existing} in this ensemble, got {requested}")
    return found[0].item()


def _equal(values: np.ndarray, value: float) -> np.ndarray:
    """Those of the values that equal this one to rounding."""
    return values[np.isclose(values, value, rtol=1e-9, atol=0)]


def _spread(values: np.ndarray, most: int) -> list[float]:
    """All values, or so many evenly spread ones."""
    places = np.linspace(0, len(values) - 1, min(len(values), most))
    return [values[round(place)].item() for place in places]
