"""Which part of an ensemble a figure shows: what is asked for, else the choice of paper A."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

PAPER_PANELS = (1e-8, 1e-4, 1.0, 10.0)
"""k_T/k_N of the four panels of A, Figs. 8 and 9."""

PAPER_RATTLERS = (1e-8, 1e-4)
"""k_T/k_N of the two panels of A, Figs. 13 and 14."""

PAPER_WEAK = 1e-8
"""k_T/k_N of A, Figs. 11, 15 and 16."""

MOST_CURVES = 8
"""Curves that stay apart in one panel; of more values, evenly spread ones are shown."""


@dataclass(frozen=True)
class Options:
    """What a study may ask of a figure.

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

    @classmethod
    def read(cls, figure: str, given: dict) -> Options:
        """Options from a dictionary.

        Raises:
            ValueError: a key is unknown, or `bin_density` is not in (0, 1].
        """
        known = [field.name for field in fields(cls)]
        unknown = [key for key in given if key not in known]
        if unknown:
            raise ValueError(
                f"figure {figure}: unknown option {unknown[0]!r}, "
                f"expected one of {', '.join(known)}"
            )
        options = cls(**given)
        if options.bin_density is not None and not 0.0 < options.bin_density <= 1.0:
            raise ValueError(
                f"figure {figure}: expected a bin_density in (0, 1], got {options.bin_density}"
            )
        return options


def largest_or(asked: float | None, values: np.ndarray, name: str) -> float:
    """The value that is asked for, or the largest.

    Raises:
        ValueError: the value asked for is none of `values`, the error calls it `name`.
    """
    return values.max().item() if asked is None else _existing(asked, values, name)


def first_or(asked: int | None, values: np.ndarray, name: str) -> int:
    """The value that is asked for, or the smallest.

    Raises:
        ValueError: as `largest_or`.
    """
    return values.min().item() if asked is None else _existing(asked, values, name)


def curves(asked: tuple[float, ...] | None, values: np.ndarray, name: str) -> list[float]:
    """The values asked for, or all of `values`, or evenly spread ones where they are too many."""
    if asked is not None:
        return sorted(_existing(value, values, name) for value in asked)
    places = np.linspace(0, len(values) - 1, min(len(values), MOST_CURVES))
    return [values[round(place)].item() for place in places]


def panels(
    asked: tuple[float, ...] | None, values: np.ndarray, paper: tuple[float, ...] = PAPER_PANELS
) -> list[float]:
    """k_T/k_N of the panels of a spectral figure: those asked for, A's, or at most as many."""
    if asked is not None:
        return curves(asked, values, "kt")
    found = [kappa for kappa in paper if np.isclose(values, kappa, rtol=1e-9, atol=0).any()]
    if len(found) == len(paper):
        return found
    places = np.linspace(0, len(values) - 1, min(len(values), len(paper)))
    return [values[round(place)].item() for place in places]


def positive(values: np.ndarray, figure: str) -> np.ndarray:
    """The values of k_T/k_N that a logarithmic axis can show.

    Raises:
        ValueError: there is none.
    """
    if not (values > 0).any():
        raise ValueError(f"figure {figure}: expected an ensemble with a k_T > 0, got none")
    return values[values > 0]


def weak(asked: tuple[float, ...] | None, values: np.ndarray) -> float:
    """The one k_T/k_N of a figure of weak friction: the one asked for, A's, or the smallest.

    Raises:
        ValueError: several are asked for, or one that is none of `values`.
    """
    if asked is not None and len(asked) > 1:
        raise ValueError(f"kt: expected one value for this figure, got {len(asked)}")
    paper = values[np.isclose(values, PAPER_WEAK, rtol=1e-9, atol=0)]
    default = (paper if len(paper) else values)[0].item()
    return default if asked is None else _existing(asked[0], values, "kt")


def _existing(asked: float, values: np.ndarray, name: str) -> float:
    found = values[np.isclose(values, asked, rtol=1e-9, atol=0)]
    if not len(found):
        raise ValueError(
            f"{name}: expected one of {', '.join(map(str, values))} in this ensemble, got {asked}"
        )
    return found[0].item()
