"""Panels of spectra: error bars within a logarithmic frame, and the marks of A's Fig. 7."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from numpy.testing import assert_allclose

import synthetic
from grainmodes.ensemble import open_ensemble
from grainmodes.figures.paper_a import (
    dos,
    dos_frictionless,
    dos_hessian,
    dos_rattlers,
    dos_scaled,
    participation,
    participation_ratio,
)
from grainmodes.figures.shared import appearance, mode_marks
from grainmodes.figures.shared.selection import Options

LOGARITHMIC = (
    dos,
    dos_frictionless,
    dos_hessian,
    dos_rattlers,
    dos_scaled,
    participation_ratio,
)


def picture(module, ensemble, **options) -> Figure:
    figure = Figure()
    module.draw(figure, module.table(ensemble, Options(**options)))
    return figure


def bars_of(axes) -> np.ndarray:
    """Heights of the ends (2 M,) of all error bars of a panel."""
    bars = [bar for line in axes.collections for bar in line.get_segments() if len(bar)]
    ends = np.concatenate([np.asarray(bar)[:, 1] for bar in bars])
    return ends[np.isfinite(ends)]


def test_bars_on_a_logarithmic_axis_are_as_long_below_as_above():
    mean, error = np.array([1.0, 2.0, 3.0]), np.array([1e-6, 2.0, np.nan])
    lower, upper = appearance.logarithmic_bars(mean, error)
    assert_allclose(np.log(mean + upper) - np.log(mean), np.log(mean) - np.log(mean - lower))
    assert_allclose(upper, error)
    assert lower[0] == pytest.approx(1e-6, rel=1e-5)


@pytest.mark.parametrize("module", LOGARITHMIC)
def test_no_bar_runs_out_of_a_logarithmic_frame(module, whole_ensemble):
    for axes in picture(module, whole_ensemble).axes:
        low, high = axes.get_ylim()
        ends = bars_of(axes)
        assert len(ends) > 3
        assert low < ends.min() and ends.max() < high


def labels_of(axes) -> list[str]:
    return [text.get_text() for text in axes.texts]


@pytest.mark.parametrize("module", [dos, participation])
def test_panels_have_marks_at_the_modes_of_the_papers_eigenvectors(module, whole_ensemble):
    panels = picture(module, whole_ensemble).axes
    assert [labels_of(axes) for axes in panels] == [
        ["(a1)", "(a2)", "(a3)"],
        ["(b1)", "(b2)", "(b3)"],
        [],
        [],
    ]
    assert [text.get_position()[0] for text in panels[0].texts] == [1e-4, 1.3e-2, 1.0]
    assert [text.get_position()[0] for text in panels[1].texts] == [1e-2, 1.3e-2, 1.0]
    assert panels[0].get_title("left").startswith("(a) $k_T / k_N = 10^{-8}$")


def test_a_mark_beyond_the_frame_is_left_out(tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.9,), kts=(1e-8,), seeds=1)
    with open_ensemble(path) as dataset:
        table = dos.table(dataset, Options())
    figure = Figure()
    dos.draw(figure, table[table["omega"] < 0.5])
    assert labels_of(figure.axes[0]) == ["(a1)", "(a2)"]


def test_rows_of_maps_have_the_letters_of_the_paper():
    assert mode_marks.row_letters([1e-8, 1e-4]) == ["a", "b"]
    assert mode_marks.row_letters([1e-4]) == ["b"]
    assert mode_marks.row_letters([1e-6, 1e-4]) == ["a", "b"]
    assert mode_marks.marks_at(1.0) == {}
