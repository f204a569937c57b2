"""Mistaken scenes: one sentence per mistake, and all of them at once."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grainmodes.configuration import ConfigurationError, read_scene, scene_of
from grainmodes.configuration.grid_rules import AREA_PER_GRAIN
from scenes import GRID, scene_of_grids, scene_with

MISTAKES = [
    ("study", "a b", "study = 'a b': allowed is a name"),
    ("colour", 1, "unknown key 'colour', allowed are study, grids"),
    ("grid.phis", [1], "grids[0]: unknown key 'phis', allowed are n, phi, kt, seeds, observables"),
    ("grid.n", ..., "grids[0]: key 'n' is missing, needed is a list"),
    ("grid.n", [], "grids[0].n = []: allowed is a list, each item a whole even number"),
    ("grid.n", [15], "grids[0].n[0] = 15: allowed is a whole even number from 2"),
    ("grid.n", [0], "grids[0].n[0] = 0: allowed is a whole even number from 2"),
    ("grid.n", [64, 4], "grids[0].n = 4: at phi = 0.9 the box is 1.62 d wide"),
    ("grid.phi", [0.79], "grids[0].phi[0] = 0.79: allowed is a number from 0.8 to 1.2"),
    ("grid.phi", [float("nan")], "grids[0].phi[0] = 'nan': allowed is a number"),
    ("grid.phi", [float("inf")], "grids[0].phi[0] = inf: allowed is a number"),
    ("grid.phi", ["high"], "grids[0].phi[0] = 'high': allowed is a number"),
    ("grid.phi", [0.84, 0.9, "0.840"], "grids[0].phi: 0.84 stands there twice"),
    ("grid.kt", [-1], "grids[0].kt[0] = -1.0: allowed is a number from 0.0 to 1000.0 (k_N)"),
    ("grid.kt", [1, 1.0], "grids[0].kt: 1.0 stands there twice"),
    ("grid.kt", ..., "grids[0]: key 'kt' is missing"),
    ("grid.seeds", 0, "grids[0].seeds = 0: allowed is a whole number from 1"),
    ("grid.seeds", True, "grids[0].seeds = True: allowed is a whole number"),
    ("grid.seeds", 2.5, "grids[0].seeds = 2.5: allowed is a whole number"),
    ("grids", [], "grids = []: allowed is a list, each item a block of keys"),
    ("grids", {"n": [64]}, "allowed is a list, each item a block of keys"),
    ("grids", [1], "grids[0] = 1: allowed is a block of keys"),
    ("grid", GRID, "unknown key 'grid', allowed are study, grids"),
    ("grid.block", 2, "grids[0]: unknown key 'block', allowed are n"),
    ("block", 0, "block = 0: allowed is a whole number from 1"),
    ("effects.friction", "no", "effects.friction = 'no': allowed is true or false"),
    ("effects.friction", False, "grids[0].kt = [0.0001, 1.0]: effects.friction is false"),
    ("contact_law.normal", "linear", "'linear': allowed is one of hertz, harmonic"),
    ("contact_law.friction_coefficient", 0.5, "the tangential law 'elastic' has none"),
    ("contact_law.friction_coefficient", 0, "allowed is a number above 0.0 and up to 100.0"),
    ("contact_law.tangential", "sharp_coulomb", "friction_coefficient is missing"),
    (
        "grid.observables",
        {"spectrum": "all"},
        "grids[0].observables.spectrum = 'all': allowed is one of none, counts, bands, eigenvalues",
    ),
    ("grid.observables", {"g": 1}, "grids[0].observables: unknown key 'g', allowed are rigidity"),
    (
        "grid.observables",
        {"rattlers": True, "spectrum": "none"},
        "grids[0].observables.rattlers = True: observables.spectrum is none, "
        "allowed with rattlers are eigenvalues and modes",
    ),
    ("protocol.spectrum.method", "lanczos", "one of auto, dense, windows, counting"),
    ("protocol.spectrum.factorisation", "mumps", "one of auto, superlu, pardiso"),
    ("protocol.spectrum.fineness", 0, "allowed is a number above 0.0 and up to 1.0"),
    ("protocol.spectrum.modes_per_bin", 5, "allowed is a whole number from 6"),
    ("protocol.spectrum.substeps", 0, "allowed is a whole number from 1"),
    ("protocol.compression.phi_step", 3e-4, "allowed are steps that divide 0.01"),
    ("protocol.shear.strain", 0.50003, "allowed are whole numbers of steps of 0.0001"),
    ("protocol.shear.smallest_step", 3e-6, "allowed are 0.0001 and a tenth"),
    ("protocol.shear.smallest_step", 1e-3, "allowed are 0.0001 and a tenth"),
    ("protocol.compression.initial_phi", 0.60005, "a whole number of steps of 0.0001"),
    ("protocol.compression.relaxation", "slow", "allowed is one of fast, fire"),
    ("protocol.compression.large_diameter", 0, "allowed is a number from 0.5 to 2.0 (d)"),
    ("protocol.compression.masses", "unit", "allowed is one of area, equal"),
    ("protocol.rattlers.threshold", 3, "allowed is a whole number from 0 to 2"),
    ("figures", ["g_psi"], "unknown figure 'g_psi', allowed are g_phi"),
    ("figures", ["g_phi", "g_phi"], "figures: 'g_phi' stands there twice"),
]


@pytest.mark.parametrize(("path", "value", "sentence"), MISTAKES)
def test_a_mistake_is_one_sentence(path, value, sentence):
    with pytest.raises(ConfigurationError) as caught:
        scene_with(path, value)
    (line,) = str(caught.value).splitlines()
    assert sentence in line


def test_every_mistake_is_told_at_once():
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({"n": [3], "phi": [2]}, {"kt": [-1], "seeds": 0})
    assert len(str(caught.value).splitlines()) == 4


@pytest.mark.parametrize(
    "config", [{}, {"study": None, "grids": None}, {"study": 1, "grids": [{}]}]
)
def test_hardly_a_configuration(config):
    with pytest.raises(ConfigurationError):
        scene_of(config)


@pytest.mark.parametrize("text", ["", "- 1", "study: [", "\x00"])
def test_hardly_a_file(tmp_path, text):
    path = tmp_path / "scene.yaml"
    path.write_text(text)
    with pytest.raises(ConfigurationError, match=r"scene\.yaml: "):
        read_scene(path)


@given(st.integers(1, 40), st.floats(0.8, 1.2))
def test_a_box_holds_no_pair_twice(half, phi):
    wide_enough = (2 * half * AREA_PER_GRAIN / phi) ** 0.5 >= 2.0
    grid = {"n": [2 * half], "phi": [phi], "kt": [1.0], "seeds": 1}
    try:
        scene_of({"study": "box", "grids": [grid]})
    except ConfigurationError as error:
        assert not wide_enough
        assert "two images" in str(error)
    else:
        assert wide_enough


def test_a_point_lies_in_one_grid():
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({}, {"phi": [0.85]}, {"phi": [0.9, 0.91], "kt": [1.0, 2.0]})
    assert str(caught.value) == (
        "grids[2]: the point n = 16, phi = 0.9, kt = 1.0 also lies in grids[0], "
        "allowed is every point in one grid"
    )


def test_grids_of_one_n_share_their_files_of_seeds():
    apart = {"phi": [0.85], "n": [64, 128]}
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({}, apart | {"seeds": 3}, block=2)
    assert str(caught.value) == (
        "grids[1].seeds = 3: grids[0] has 4 samples of n = 64 and both share files of 2 (block), "
        "allowed are equal numbers, or the smaller one a whole number of blocks"
    )
    assert scene_of_grids({}, apart | {"seeds": 2}, block=2)
    assert scene_of_grids({"seeds": 3}, apart | {"seeds": 2}, block=2)
    assert scene_of_grids({"seeds": 3}, apart | {"seeds": 3}, block=2)
    assert scene_of_grids({}, {"n": [128], "seeds": 3}, block=2)
