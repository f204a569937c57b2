"""Captions: the numbers that were drawn, the contact law, and a text for every figure."""

from importlib import import_module

import pandas as pd
import pytest
import xarray as xr

from grainmodes.dataset.files import Block
from grainmodes.figures import draw
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.captions import WIDTH, Caption, caption_text
from grainmodes.figures.shared.sample_files import compressed_with_friction
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.law import TANGENTIAL_LAWS, ContactLaw
from pictures import caption_of

ELASTIC = ContactLaw()
SLIDING = ContactLaw("harmonic", "smoothed_coulomb", friction_coefficient=0.5)


def rows(**columns) -> pd.DataFrame:
    """A table of one point, but for these columns."""
    point = {"n": [64], "phi": [0.9], "kt": [2.0 / 7.0], "seed": [3]}
    length = max([len(values) for values in columns.values()], default=1)
    return pd.DataFrame({name: values * length for name, values in point.items()} | columns)


def drawn(table: pd.DataFrame, law: ContactLaw) -> str:
    """The paragraph of a caption that says what was drawn, in one line."""
    text = caption_text("Title", Caption("what", "where"), table, law)
    return " ".join(text.split("\n\n")[2].split())


@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_says_what_it_shows_and_what_to_look_at(name):
    module = import_module(f"grainmodes.figures.{FIGURES[name].room}.{name}")
    table = pd.DataFrame({column: ["with"] for column in module.COLUMNS})
    table = table.assign(**{name: [1.0] for name in ("rigidity", "phi", "kt") if name in table})
    shows, look_at = module.caption(table)
    assert len(shows) > 80
    assert len(look_at) > 30
    assert shows.endswith(".")
    assert look_at.endswith(".")


def test_a_caption_states_point_samples_and_law():
    assert drawn(rows(), ELASTIC) == (
        "Drawn: N = 64; φ = 0.90; k_T/k_N = 2/7; the sample of seed 3; "
        "Hertzian contacts, f_N = k_N ξ^(3/2); elastic tangential springs without slip."
    )
    assert drawn(rows(), SLIDING).endswith("f_N = k_N ξ; smoothed Coulomb friction, μ = 0.5.")
    assert drawn(rows(kt=[0.0]), ELASTIC).endswith("f_N = k_N ξ^(3/2), no friction.")


def test_a_caption_lists_values_and_counts_samples():
    assert "N = 8, 64;" in drawn(rows(n=[64, 8]), ELASTIC)
    assert "φ = 0.80 to 0.90 (11 values)" in drawn(
        rows(phi=[0.8 + 0.01 * k for k in range(11)]), ELASTIC
    )
    assert "k_T/k_N = 10⁻⁸, 3 × 10⁻², 1;" in drawn(rows(kt=[1.0, 1e-8, 0.03]), ELASTIC)
    assert "; 6–8 samples;" in drawn(rows(samples=[8, 6, float("nan")]), ELASTIC)
    assert "; 3 samples;" in drawn(rows(seed=[0, 1, 1, 2]), ELASTIC)


def test_a_comparison_of_laws_names_them_all():
    words = drawn(rows(tangential=["elastic", "sharp_coulomb"]), SLIDING)
    assert "elastic tangential springs without slip, sharp Coulomb friction, μ = 0.5." in words
    for law in TANGENTIAL_LAWS:
        assert len(drawn(rows(tangential=[law]), SLIDING)) > 100


def test_lines_are_short(path, tmp_path):
    draw("g_phi", path, tmp_path / "g_phi", {})
    text = (tmp_path / "g_phi.txt").read_text(encoding="utf-8")
    assert max(map(len, text.splitlines())) <= WIDTH
    assert "N = 16; φ = 0.83, 0.86, 0.90; k_T/k_N = 10⁻⁸, 10⁻⁴, 1, 10; 4 samples" in " ".join(
        caption_of(tmp_path, "g_phi")
    )


@pytest.mark.parametrize(
    ("kt", "formula", "text"),
    [
        (2.0 / 7.0, "2/7", "2/7"),
        (0.2857142857142857, "2/7", "2/7"),
        (1e-8, "10^{-8}", "10⁻⁸"),
        (0.03, r"3\times 10^{-2}", "3 × 10⁻²"),
        (0.25, "0.25", "0.25"),
        (1.0, "1", "1"),
        (0.123456789, "0.123457", "0.123457"),
    ],
)
def test_a_stiffness_ratio_is_written_as_one(kt, formula, text):
    assert labels.ratio(kt) == formula
    assert labels.plain(formula) == text


def test_a_caption_says_how_the_packings_were_compressed():
    text = caption_text("Title", Caption("what", "where"), rows(), ELASTIC, (), True)
    assert "compressed with friction" in text
    assert "compressed" not in drawn(rows(), ELASTIC)
    flags = xr.DataArray([[1.0], [0.0]], {"n": [64, 256]}, dims=("n", "seed"))
    ensemble = xr.Dataset({"compressed_with_friction": flags})
    assert compressed_with_friction(ensemble, rows())
    assert not compressed_with_friction(ensemble, rows(n=[256]))
    assert not compressed_with_friction(xr.Dataset(), rows())
    block = Block({}, {"n": 64, "config": {"frictional_compression": {}}})
    assert compressed_with_friction([block], rows())
    assert not compressed_with_friction([block], rows(n=[256]))
