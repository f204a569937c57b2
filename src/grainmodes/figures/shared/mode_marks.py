"""The marks (a1), …, (b3), which tie the eigenvectors of A's Fig. 7 to its Figs. 8 and 9.

A letter belongs to a k_T/k_N and a number to a frequency, as in A's caption.
"""

from __future__ import annotations

from matplotlib.axes import Axes

from grainmodes.parameters.fields import field_frequencies

PAPER_KTS = (1e-8, 1e-4)
"""k_T/k_N of rows (a) and (b) of A, Fig. 7."""

SIDES = ("right", "left", "center")
"""How the label of each mark is aligned at its line, as the second lies close to the first."""

LETTERS = "abcdefgh"


def row_letters(kts: list[float]) -> list[str]:
    """The letter of each row of maps: A's for A's k_T/k_N, else in their order.

    >>> row_letters([1e-4]), row_letters([1e-6, 1e-4])
    (['b'], ['a', 'b'])
    """
    rows = PAPER_KTS if set(kts) <= set(PAPER_KTS) else kts
    return [LETTERS[rows.index(kt)] for kt in kts]


def marks_at(kt: float) -> dict[str, float]:
    """Mark → ω t_0 of the modes that A's Fig. 7 shows at a k_T/k_N; none at another one.

    >>> marks_at(1e-8)
    {'(a1)': 0.0001, '(a2)': 0.013, '(a3)': 1.0}
    """
    if kt not in PAPER_KTS:
        return {}
    letter = LETTERS[PAPER_KTS.index(kt)]
    return {f"({letter}{k})": omega for k, omega in enumerate(field_frequencies(kt), start=1)}


def draw_marks(axes: Axes, kt: float) -> None:
    """Draw the marks of one panel: a line through it, and its label between frame and title."""
    low, high = axes.get_xlim()
    shown = {mark: omega for mark, omega in marks_at(kt).items() if low < omega < high}
    above = axes.get_xaxis_transform()
    for (mark, omega), side in zip(shown.items(), SIDES, strict=False):
        axes.axvline(omega, color="0.6", lw=0.6, ls=":", zorder=0)
        axes.text(omega, 1.01, mark, fontsize=7, ha=side, va="bottom", transform=above)
    axes.set_title(axes.get_title("left"), loc="left", pad=15.0 if shown else None)
