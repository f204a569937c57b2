"""Which figures a scene allows: what they need, and the grids that have it."""

import pytest

from grainmodes.configuration import ConfigurationError, scene_from
from grainmodes.configuration.grids import TOGETHER, lacking
from grainmodes.configuration.rules import NEEDED
from grainmodes.parameters.figures import FIGURES, Figure
from scenes import (
    FRICTIONLESS,
    GRID,
    ONLY_G,
    ONLY_SPECTRA,
    WITH_HESSIAN,
    WITH_RATTLERS,
    scene_of_grids,
    scene_with,
)


def test_figures_follow_the_observables():
    nothing = {"spectrum": "none"}
    of_g = ("g_phi", "g_kt", "g_nonaffine", "nonaffine_crossing", "rigidity_exponent")
    assert scene_with("grid.observables", nothing).figures == of_g
    assert "participation" not in scene_with("grid.observables", {"spectrum": "counts"}).figures
    assert (
        "participation" in scene_with("grid.observables", {"spectrum": "binned_averages"}).figures
    )
    config = {"study": "s", "grids": [GRID | {"observables": nothing}], "figures": ["dos"]}
    with pytest.raises(ConfigurationError, match=r"'dos' needs observables\.spectrum"):
        scene_from(config)


def test_every_need_of_a_figure_has_its_words():
    assert {need for figure in FIGURES.values() for need in figure.observables} <= set(NEEDED)


@pytest.mark.parametrize(
    ("needs", "grids", "missing"),
    [
        ("spectrum", [ONLY_G, ONLY_SPECTRA | FRICTIONLESS], []),
        ("spectrum friction", [ONLY_G, ONLY_SPECTRA | FRICTIONLESS], ["friction"]),
        ("spectrum frictionless", [ONLY_G | FRICTIONLESS, ONLY_SPECTRA], ["frictionless"]),
        ("spectrum friction frictionless", [ONLY_SPECTRA, ONLY_SPECTRA | FRICTIONLESS], []),
        ("modes friction", [ONLY_SPECTRA], ["modes"]),
        ("fields all_modes", [ONLY_G | {"n": [2048]}], ["fields"]),
        ("spectrum all_modes", [ONLY_SPECTRA | {"n": [2048]}], []),
        ("spectrum all_modes", [ONLY_SPECTRA | {"n": [4096]}], ["all_modes"]),
        ("spectrum several_n", [ONLY_SPECTRA], []),
        ("spectrum several_n", [ONLY_SPECTRA | {"n": [16]}], ["several_n"]),
        ("spectrum several_n", [ONLY_SPECTRA | {"n": [16]}, ONLY_SPECTRA | {"n": [64]}], []),
        ("spectrum several_n", [ONLY_SPECTRA | {"n": [16]}, ONLY_G | {"n": [64]}], ["several_n"]),
        ("rigidity several_phi", [ONLY_G | {"phi": [0.9]}], ["several_phi"]),
        ("rattlers friction", [WITH_RATTLERS], []),
        ("rattlers hessian", [WITH_RATTLERS, WITH_HESSIAN], ["rattlers", "hessian"]),
        ("fields", [WITH_RATTLERS], ["fields"]),
    ],
)
def test_observables_meet_in_one_grid_and_the_rest_in_those_that_have_them(
    monkeypatch, needs, grids, missing
):
    monkeypatch.setitem(FIGURES, "new", Figure("paper_a", "New", tuple(needs.split())))
    kept = [grid | {"phi": [0.8 + 0.02 * k, 0.9 + 0.02 * k]} for k, grid in enumerate(grids)]
    kept = kept if "several_phi" not in needs else grids
    assert lacking("new", scene_of_grids(*kept).grids) == missing
    assert set(missing) <= set(NEEDED)
    assert set(TOGETHER) <= set(NEEDED)
