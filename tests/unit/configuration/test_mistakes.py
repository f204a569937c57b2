"""Mistaken scenes: one sentence per mistake, and all of them at once."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grainmodes.configuration import ConfigurationError, read_scene, scene_from
from grainmodes.configuration.grid_rules import AREA_PER_GRAIN
from scenes import GRID, scene_of_grids, scene_with

MISTAKES = [  # key, value, parts of the message with " … " for what lies between
    ("study", "a b", "study: expected a name … got 'a b'"),
    ("study", "t\n", "study: expected a name … got 't\\n'"),
    ("study", "a" * 101, "study: expected a name of at most 100 letters"),
    ("study", "../up", "study: expected a name … the first a letter or a digit, got '../up'"),
    ("colour", 1, "unknown key 'colour', expected one of study, grids"),
    (
        "grid.phis",
        [1],
        "grids[0]: unknown key 'phis', expected one of n, phi, kt, preparation, seeds, observables",
    ),
    ("grid.n", ..., "grids[0]: key 'n' is missing, expected a list"),
    ("grid.n", [], "grids[0].n: expected a list, each item a whole even number … got []"),
    ("grid.n", [15], "grids[0].n[0]: expected a whole even number from 2 … got 15"),
    ("grid.n", [0], "grids[0].n[0]: expected a whole even number from 2 … got 0"),
    (
        "grid.n",
        [64, 4],
        "grids[0].n: expected at least 8 grains, because at … got 4 grains in a box of 1.62 d",
    ),
    ("grid.phi", [0.79], "grids[0].phi[0]: expected a number from 0.8 to 1.2 … got 0.79"),
    ("grid.phi", [float("nan")], "grids[0].phi[0]: expected a number … got 'nan'"),
    ("grid.phi", [float("inf")], "grids[0].phi[0]: expected a number … got inf"),
    ("grid.phi", ["high"], "grids[0].phi[0]: expected a number … got 'high'"),
    ("grid.phi", [0.84, 0.9, 0.840], "grids[0].phi: duplicate value 0.84: values must be unique"),
    ("grid.phi", ["0.9"], "grids[0].phi[0]: expected a number … got '0.9'"),
    ("grid.phi", [10**400], "grids[0].phi[0]: expected a number from 0.8 to 1.2, got 1000"),
    ("grid.phi", [0.9, 0.9 + 1e-10], "phi: expected values that differ, got 0.9 and 0.9000000001"),
    ("grid.kt", [1e-4, 1e-4 * (1 + 1e-12)], "grids[0].kt: expected values that differ, got 0.0001"),
    ("grid.kt", [0.5 * k for k in range(1001)], "grids[0].kt: expected at most 1000 items, got 10"),
    ("grid.kt", [0.0, -0.0], "grids[0].kt: duplicate value 0.0: values must be unique"),
    ("grid.kt", [-1], "grids[0].kt[0]: expected a number from 0.0 to 1000.0 (k_N), got -1.0"),
    ("grid.kt", [1, 1.0], "grids[0].kt: duplicate value 1.0: values must be unique"),
    ("grid.kt", ..., "grids[0]: key 'kt' is missing"),
    ("grid.seeds", 0, "grids[0].seeds: expected a whole number from 1 … got 0"),
    ("grid.seeds", True, "grids[0].seeds: expected a whole number … got True"),
    ("grid.seeds", 2.5, "grids[0].seeds: expected a whole number … got 2.5"),
    ("grids", [], "grids: expected a list, each item a block of keys, got []"),
    ("grids", {"n": [64]}, "expected a list, each item a block of keys"),
    ("grids", [1], "grids[0]: expected a block of keys, got 1"),
    ("grid", GRID, "unknown key 'grid', expected one of study, grids"),
    ("grid.block", 2, "grids[0]: unknown key 'block', expected one of n"),
    ("seeds_per_job", 0, "seeds_per_job: expected a whole number from 1 … got 0"),
    ("effects.friction", "no", "effects.friction: expected true or false, got 'no'"),
    (
        "effects.friction",
        False,
        "grids[0].kt: expected no key kt because effects.friction is false, got [0.0001, 1.0]",
    ),
    (
        "contact_law.normal",
        "linear",
        "contact_law.normal: expected one of hertz, harmonic, got 'linear'",
    ),
    ("contact_law.friction_coefficient", 0.5, "expected none for the tangential law 'elastic'"),
    ("contact_law.friction_coefficient", 0, "expected a number above 0.0 and up to 100.0"),
    (
        "contact_law.tangential",
        "sharp_coulomb",
        "friction_coefficient: expected a number above 0 for the tangential law",
    ),
    (
        "grid.observables",
        {"spectrum": "all"},
        "grids[0].observables.spectrum: expected one of none, counts, binned_averages, … got 'all'",
    ),
    (
        "grid.observables",
        {"g": 1},
        "grids[0].observables: unknown key 'g', expected one of rigidity",
    ),
    (
        "grid.observables",
        {"rigidity": False, "step_strain": False, "spectrum": "none"},
        "grids[0].observables: expected at least one observable, got none",
    ),
    (
        "grid.observables",
        {"coarse_run": True},
        "grids[0].observables.shear: expected true because observables.coarse_run is true",
    ),
    (
        "grid.observables",
        {"rattlers": True, "spectrum": "none"},
        "grids[0].observables.spectrum: expected eigenvalues or modes because "
        "observables.rattlers is true, got none",
    ),
    ("protocol.spectrum.method", "lanczos", "one of auto, dense, slicing, inertia_counts"),
    ("protocol.spectrum.factorisation", "mumps", "one of auto, superlu, pardiso"),
    ("protocol.spectrum.bin_density", 0.009, "expected a number from 0.01 to 1.0"),
    ("protocol.spectrum.bin_density", "1e-1", "expected a number from 0.01 to 1.0, got '1e-1'"),
    ("protocol.spectrum.modes_per_bin", 5, "expected a whole number from 6"),
    ("protocol.spectrum.cells_per_bin", 0, "expected a whole number from 1"),
    (
        "protocol.compression.phi_step",
        3e-4,
        "expected a step that divides 0.01, such as 1e-4, got 0.0003",
    ),
    ("protocol.shear.strain", 0.50003, "expected a whole number of steps of 0.0001, got 0.50003"),
    ("protocol.shear.min_step", 3e-6, "expected 0.0001 divided by 1, 10, 100"),
    ("protocol.shear.min_step", 1e-3, "expected 0.0001 divided by 1, 10, 100"),
    ("protocol.compression.initial_phi", 0.60005, "a whole number of steps of 0.0001"),
    ("protocol.compression.relaxation", "slow", "expected one of fire_newton, fire"),
    ("protocol.compression.large_diameter", 0, "expected a number from 0.5 to 2.0 (d)"),
    ("protocol.compression.masses", "unit", "expected one of area, equal"),
    (
        "protocol.frictional_compression.time_step",
        0.2,
        "expected a number from 1e-06 to 0.15 (t_0)",
    ),
    (
        "grid.preparation",
        "elastic",
        "grids[0].preparation: expected one of frictionless, frictional",
    ),
    ("protocol.rattlers.threshold", 3, "expected a whole number from 0 to 2"),
    ("figures", ["g_psi"], "unknown figure 'g_psi', expected one of g_phi"),
    ("figures", [], "figures: expected a list, each item a text, got []"),
    ("figures", ["g_phi", "g_phi"], "figures: duplicate value 'g_phi': values must be unique"),
]


@pytest.mark.parametrize(("path", "value", "sentence"), MISTAKES)
def test_a_mistake_is_one_sentence(path, value, sentence):
    with pytest.raises(ConfigurationError) as caught:
        scene_with(path, value)
    (line,) = str(caught.value).splitlines()
    assert all(part in line for part in sentence.split(" … "))


def test_all_mistakes_are_reported_at_once():
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({"n": [3], "phi": [2]}, {"kt": [-1], "seeds": 0})
    assert len(str(caught.value).splitlines()) == 4


@pytest.mark.parametrize(
    "config", [{}, {"study": None, "grids": None}, {"study": 1, "grids": [{}]}]
)
def test_hardly_a_configuration(config):
    with pytest.raises(ConfigurationError):
        scene_from(config)


@pytest.mark.parametrize("text", ["", "- 1", "study: [", "\x00"])
def test_hardly_a_file(tmp_path, text):
    path = tmp_path / "scene.yaml"
    path.write_text(text)
    with pytest.raises(ConfigurationError, match=r"scene\.yaml(, line 1)?: "):
        read_scene(path)


@given(st.integers(1, 40), st.floats(0.8, 1.2))
def test_a_box_holds_no_pair_twice(half, phi):
    wide_enough = (2 * half * AREA_PER_GRAIN / phi) ** 0.5 >= 2.0
    grid = {"n": [2 * half], "phi": [phi], "kt": [1.0], "seeds": 1}
    try:
        scene_from({"study": "box", "grids": [grid]})
    except ConfigurationError as error:
        assert not wide_enough
        assert "two images" in str(error)
    else:
        assert wide_enough


def test_a_point_lies_in_one_grid():
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({}, {"phi": [0.85]}, {"phi": [0.9, 0.91], "kt": [1.0, 2.0]})
    assert str(caught.value) == (
        "grids[2]: expected every point in one grid only, got n = 16, phi = 0.9, kt = 1.0, "
        "which also lies in grids[0]"
    )


def test_grids_of_one_n_share_their_files_of_seeds():
    apart = {"phi": [0.85], "n": [64, 128]}
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({}, apart | {"seeds": 3}, seeds_per_job=2)
    assert str(caught.value) == (
        "grids[1].seeds: expected 4 as in grids[0], or the smaller of both a multiple of "
        "seeds_per_job = 2, because both share the files of n = 64, got 3"
    )
    assert scene_of_grids({}, apart | {"seeds": 2}, seeds_per_job=2)
    assert scene_of_grids({"seeds": 3}, apart | {"seeds": 2}, seeds_per_job=2)
    assert scene_of_grids({"seeds": 3}, apart | {"seeds": 3}, seeds_per_job=2)
    assert scene_of_grids({}, {"n": [128], "seeds": 3}, seeds_per_job=2)


FRICTIONAL = {"preparation": "frictional", "observables": {"spectrum": "none"}}


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"kt": [0.0, 1.0]}, "preparation: expected 'frictionless' at kt = 0, got 'frictional'"),
        (
            {"observables": {"spectrum": "counts"}},
            "observables.spectrum: expected none, eigenvalues or modes because preparation is "
            "'frictional' and loads the springs, got counts",
        ),
        (
            {"observables": {"spectrum": "none", "fields": True}},
            "observables.fields: expected false because preparation is 'frictional' and loads the "
            "springs",
        ),
    ],
)
def test_what_compression_with_friction_excludes(change, sentence):
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids(FRICTIONAL | change)
    assert str(caught.value) == f"grids[0].{sentence}"


def test_grids_of_one_n_share_their_preparation():
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({}, FRICTIONAL | {"phi": [0.95]})
    assert str(caught.value) == (
        "grids[1].preparation: expected 'frictionless' as in grids[0], because both hold n = 16, "
        "got 'frictional'"
    )
    scene = scene_of_grids({}, FRICTIONAL | {"n": [128]})
    assert scene.preparation_of(128, 0.9, 1.0) == "frictional"
    assert scene.preparation_of(16, 0.9, 1.0) == "frictionless"


PAIRS = {"rigidity": False, "step_strain": False, "spectrum": "none", "complex_pairs": True}


@pytest.mark.parametrize(
    ("kt", "sentence"),
    [
        (
            [0.0],
            "expected a number above 0 because observables.complex_pairs is true, and does not "
            "exist without friction, got only 0",
        ),
        (
            [-0.0, 1.0],
            "expected numbers above 0, because none of the observables of this grid exists without "
            "friction, got 0.0",
        ),
    ],
)
def test_a_point_that_asks_for_nothing(kt, sentence):
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({"kt": kt, "observables": PAIRS})
    assert str(caught.value) == f"grids[0].kt: {sentence}"
    assert scene_of_grids({"kt": [0.0, 1.0], "observables": PAIRS | {"rigidity": True}})


def test_a_scene_without_friction_that_asks_for_pairs():
    grid = {key: value for key, value in GRID.items() if key != "kt"}
    scene = {"study": "f", "grids": [grid | {"observables": PAIRS}]}
    with pytest.raises(ConfigurationError, match="does not exist without friction, got only 0"):
        scene_from(scene | {"effects": {"friction": False}})


def test_values_that_differ_by_rounding_in_two_grids():
    """Grids of other n may have them: no curve holds both."""
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({"phi": [0.9]}, {"phi": [0.85, 0.9 + 5e-10]})
    assert str(caught.value).startswith(
        "grids[1].phi: expected values that differ, got 0.9 and 0.9"
    )
    assert scene_of_grids({"phi": [0.9]}, {"phi": [0.9 + 5e-10], "n": [128]})


@pytest.mark.parametrize("spectrum", ["counts", "modes"])
def test_a_dense_spectrum_has_its_size(spectrum):
    grid = {"n": [20_002], "observables": {"spectrum": spectrum}}
    dense = {"protocol": {"spectrum": {"method": "dense"}}}
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids(grid, **dense)
    assert str(caught.value) == (
        "protocol.spectrum.method: expected auto, slicing or inertia_counts for spectra of more "
        "than 20000 grains, got dense and grids[0].n = 20002"
    )
    assert scene_of_grids(grid | {"n": [20_000]}, **dense)
    assert scene_of_grids(grid | {"observables": {"spectrum": "none"}}, **dense)


def test_a_scene_of_too_many_files():
    many = {"phi": [0.8 + k * 1e-4 for k in range(1000)], "kt": [1.0 + k for k in range(200)]}
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids(many, {"n": [128]}, seeds_per_job=1)
    assert str(caught.value).startswith("grids[0]: expected at most 200000 files of seeds in the")
    assert len(str(caught.value).splitlines()) == 1


def test_keys_of_several_types_are_refused():
    with pytest.raises(ConfigurationError) as caught:
        scene_from({"study": "s", "grids": [GRID], 1: 2, "colour": 3, None: 4})
    assert len(str(caught.value).splitlines()) == 3
