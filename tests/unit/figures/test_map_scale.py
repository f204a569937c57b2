"""Scales of maps: lengths of arrows, colours of rotations, and which grains have arrows."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure
from matplotlib.offsetbox import AnchoredOffsetbox, TextArea
from matplotlib.patches import FancyArrow
from numpy.testing import assert_allclose

from grainmodes.figures.shared.grain_maps import add_keys, draw_map
from grainmodes.figures.shared.map_scale import (
    ARROWS_PER_SIDE,
    MAX_ARROWS,
    Scale,
    arrow_note,
    grains_with_arrows,
    one_digit,
)


def lattice(side: int) -> pd.DataFrame:
    """Grains on a square lattice of distance 1, with a field u that points along x."""
    x, y = (line.ravel() + 0.5 for line in np.meshgrid(np.arange(side), np.arange(side)))
    fields = {"u_x": x, "u_y": 0.0 * x, "u_rotation": -x / 9.5}
    box = {"box_length": float(side), "strain": 0.0, "diameter": 0.9, "grain": np.arange(side**2)}
    return pd.DataFrame({"x": x, "y": y} | fields | box)


def test_a_scale_fits_all_but_a_few_arrows():
    table = lattice(10)
    scale = Scale.from_fields(table, ("u",), arrow=1.5)
    assert scale.lengths(np.quantile(table["u_x"], 0.95)) == pytest.approx(1.5)
    assert (scale.keys, scale.limit) == ((10.0,), 1.0)
    assert_allclose(
        scale.lengths(np.array([1.0, 2.0, 0.0])), np.array([1.0, 2.0, 0.0]) * 1.5 / scale.size
    )
    nothing_turns = Scale.from_fields(table.assign(u_rotation=np.nan), ("u",), arrow=1.0)
    assert nothing_turns.limit == 0.0


def test_a_compressed_scale_shows_two_decades_and_saturates_nowhere():
    table = lattice(10).assign(u_x=np.logspace(-6, -1, 100), u_rotation=np.linspace(-0.3, 0.1, 100))
    scale = Scale.compressed(table, "u", arrow=2.0)
    longest, tenth, hundredth, tiny = scale.lengths(np.array([0.1, 0.01, 0.001, 0.00001]))
    assert longest == pytest.approx(2.0)
    assert 1.0 < tenth < 1.3
    assert 0.3 < hundredth < 0.4
    assert tiny == pytest.approx(0.01 * hundredth, rel=0.2)
    assert scale.keys == (0.1, 0.001)
    colours = scale.colour_range()
    assert (colours.vmin, colours.vmax) == (-0.3, 0.3)
    assert_allclose(colours([-0.3, 0.0, 0.3]), [0.0, 0.5, 1.0], atol=1e-12)
    assert colours(0.03) > 0.75
    assert scale.colour_ticks() == pytest.approx([-0.1, -0.01, 0.0, 0.01, 0.1])


def test_many_grains_share_arrows_spread_evenly():
    few, many = lattice(33), lattice(72)
    assert len(grains_with_arrows(few)) == 33**2 < MAX_ARROWS
    assert (arrow_note(few), arrow_note(many)[:32]) == ("", "; one grain in each cell of 24 ×")
    shown = grains_with_arrows(many)
    assert len(shown) == ARROWS_PER_SIDE**2
    assert set(np.diff(np.unique(shown["x"]))) == {3.0}
    scale = Scale.from_fields(many, ("u",), arrow=1.0)
    assert scale.length == 3.0
    axes = Figure().subplots()
    arrows = draw_map(axes, many, "u", scale)
    assert len(arrows.U) == ARROWS_PER_SIDE**2
    assert len(axes.collections[0].get_offsets()) >= 72**2


def test_keys_are_arrows_as_long_as_those_of_the_map():
    axes = Figure().subplots()
    axes.set(xlim=(0.0, 10.0), ylim=(0.0, 10.0))
    scale = Scale.compressed(lattice(10), "u", arrow=2.0)
    add_keys(axes, scale, "$\\,d$")
    (box,) = (artist for artist in axes.artists if isinstance(artist, AnchoredOffsetbox))
    words = [text.get_text() for text in box.findobj(TextArea)]
    assert words == ["$10$$\\,d$", "$0.1$$\\,d$"]
    lengths = [np.ptp(arrow.get_xy()[:, 0]) for arrow in box.findobj(FancyArrow)]
    assert_allclose(lengths, scale.lengths(np.array(scale.keys)))


@pytest.mark.parametrize(
    ("value", "digit"), [(0.0437, 0.04), (9.7, 10.0), (1.0, 1.0), (250.0, 200.0), (0.0, 0.0)]
)
def test_keys_have_one_digit(value, digit):
    assert one_digit(value) == pytest.approx(digit)
