"""Blocks → point → ensemble → averages: nothing is lost, nothing is invented."""

import json

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from numpy.testing import assert_allclose, assert_array_equal

import synthetic
from grainmodes.dataset.files import Block, BlockError, read_block, write_block
from grainmodes.ensemble import (
    gather_point,
    merge_blocks,
    normal_law,
    open_ensemble,
    write_ensemble,
)
from grainmodes.ensemble.averages import averages
from grainmodes.ensemble.lost import LostSample, lost_samples
from grainmodes.ensemble.spectra import spectrum

POINT = {"n": 16, "phi": 0.9, "kt": 1.0}


def block(stage, first, stop, /, **changes):
    return synthetic.block(stage, 16, 0.9, 1.0, range(first, stop), **changes)


def test_merge_orders_seeds_and_keeps_what_belongs_to_a_sample():
    merged = merge_blocks(
        {
            "b": block("packings", 2, 4),
            "a": block("packings", 0, 2),
            "d": block("rigidity", 2, 4),
            "c": block("rigidity", 0, 2),
        }
    )
    assert_array_equal(merged.variables["seed"], [0, 1, 2, 3])
    first, second = block("rigidity", 0, 2), block("rigidity", 2, 4)
    expected = np.concatenate([first.variables["g"], second.variables["g"]])
    assert_array_equal(merged.variables["g"], expected)
    assert "pressure" in merged.variables
    assert "position" not in merged.variables
    assert {name: merged.attributes[name] for name in POINT} == POINT


def test_merge_does_not_depend_on_the_order_of_the_files():
    blocks = {
        "a": block("packings", 0, 2),
        "b": block("rigidity", 0, 1),
        "c": block("rigidity", 1, 2),
    }
    forward, backward = merge_blocks(blocks), merge_blocks(dict(reversed(blocks.items())))
    assert forward.attributes == backward.attributes
    assert list(forward.variables) == list(backward.variables)
    for name, array in forward.variables.items():
        assert_array_equal(array, backward.variables[name])


def test_series_of_different_lengths_are_filled_up():
    first, second = (synthetic.block("rigidity", 8, 0.9, 1.0, range(s, s + 1)) for s in (0, 1))
    for block, length in ((first, 3), (second, 5)):
        block.variables["curve_strain"] = np.arange(length, dtype=float)[None]
        block.variables["event_kind"] = np.ones((1, length), np.int8)
    for order in ({"a": first, "b": second}, {"b": second, "a": first}):
        merged = merge_blocks(order).variables
        np.testing.assert_array_equal(
            merged["curve_strain"], [[0, 1, 2, np.nan, np.nan], [0, 1, 2, 3, 4]]
        )
        np.testing.assert_array_equal(merged["event_kind"], [[1, 1, 1, 0, 0], [1, 1, 1, 1, 1]])


def test_an_ensemble_holds_several_numbers_of_every_run_of_every_state(tmp_path):
    """Two released states with three runs at one point, one state with two runs at another."""
    damping = {0.5: np.arange(6.0).reshape(1, 2, 3), 1.0: np.array([[[7.0, 8.0]]])}
    paths = []
    for kt, values in damping.items():
        released = synthetic.block("rigidity", 8, 0.9, kt, range(1))
        released.variables["release_damping"] = values
        paths.append(tmp_path / f"{kt}.nc")
        write_block(paths[-1], merge_blocks({"a": released}))
    write_ensemble(paths, tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        found = dataset["release_damping"].transpose("kt", "release_state", "damping", ...)
        assert_array_equal(found.to_numpy().squeeze()[0], damping[0.5][0])
        none = np.nan
        expected = [[7.0, 8.0, none], [none, none, none]]
        assert_array_equal(found.to_numpy().squeeze()[1], expected)


def test_converged_is_true_only_where_every_observable_is():
    merged = merge_blocks(
        {
            "a": block("packings", 0, 3, converged=np.array([1, 1, 0], dtype=np.int8)),
            "b": block("rigidity", 0, 3, converged=np.array([1, 0, 1], dtype=np.int8)),
        }
    )
    assert_array_equal(merged.variables["converged"], [1, 0, 0])


def test_the_first_observable_wins_a_name():
    merged = merge_blocks(
        {
            "a": block("rigidity", 0, 2, jammed=np.array([0, 0], dtype=np.int8)),
            "b": block("packings", 0, 2, jammed=np.array([1, 1], dtype=np.int8)),
        }
    )
    assert_array_equal(merged.variables["jammed"], [1, 1])


def test_a_seed_that_an_observable_lacks_is_not_converged_and_not_dropped():
    merged = merge_blocks({"a": block("packings", 0, 3), "b": block("step_strain", 0, 2)})
    assert_array_equal(merged.variables["seed"], [0, 1, 2])
    assert_array_equal(merged.variables["converged"], [1, 1, 0])
    assert np.isnan(merged.variables["g_simulated"][2])
    assert merged.variables["contact_changes"][2] == 0
    assert np.isfinite(merged.variables["pressure"]).all()


def test_failures_keep_the_observable_in_which_they_began():
    packings = {"packings": {"1": "no balance"}}
    merged = merge_blocks(
        {
            "a": block("packings", 0, 2, failures=packings),
            "b": block("rigidity", 0, 2, failures=packings | {"rigidity": {"0": "singular"}}),
            "c": block("spectrum", 0, 2, failures=packings | {"spectrum": {"0": "no memory"}}),
        }
    )
    expected = {"rigidity": {"0": "singular"}, "spectrum": {"0": "no memory"}}
    assert merged.attributes["failures"] == packings | expected


@pytest.mark.parametrize(
    ("first", "second", "sentence"),
    [
        (block("rigidity", 0, 2), block("rigidity", 1, 3), "duplicate seed 1 of rigidity"),
        (
            block("rigidity", 0, 2),
            block("rigidity", 2, 3, phi=0.8),
            "expected phi = 0.9 as in there, got 0.8",
        ),
        (block("rigidity", 0, 2), block("rigidity", 2, 3, config={"k": 2}), "expected config = "),
        (
            block("rigidity", 0, 2),
            block("packings", 2, 3, stage="soup"),
            "expected a block of one of packings, .* got soup",
        ),
    ],
)
def test_blocks_that_do_not_belong_together_are_refused(first, second, sentence):
    with pytest.raises(BlockError, match=f"here: .*{sentence}"):
        merge_blocks({"there": first, "here": second})


def test_ensemble_opens_with_xarray_and_describes_itself(tmp_path):
    path = synthetic.ensemble(tmp_path)
    with xr.open_dataset(path) as dataset:
        assert dict(dataset.sizes) == {"n": 1, "phi": 3, "kt": 4, "seed": 4, "mode": 48}
        assert set(dataset.coords) == {"n", "phi", "kt", "seed", "mode"}
        assert dataset["eigenvalue"].dims == ("n", "phi", "kt", "seed", "mode")
        for variable in dataset.variables.values():
            assert {"units", "long_name"} <= set(variable.attrs)
        assert json.loads(dataset.attrs["config"]) == {"scene": "synthetic"}
        assert dataset.attrs["code_version"] == "0.1"


def test_ensemble_holds_the_numbers_of_its_points(tmp_path):
    path = synthetic.ensemble(tmp_path)
    point = read_block(tmp_path / "16-0.86-0.0001.nc")
    with open_ensemble(path) as dataset:
        here = dataset.sel(n=16, phi=0.86, kt=1e-4)
        for name in ("g", "eigenvalue", "rattler_count", "max_force"):
            assert_array_equal(here[name].to_numpy(), point.variables[name])


def test_bytes_depend_neither_on_the_order_of_points_nor_on_the_run(tmp_path):
    first = synthetic.ensemble(tmp_path).read_bytes()
    points = [
        path
        for path in tmp_path.glob("16-*.nc")
        if path.stem.count("-") - path.stem.count("e-") == 2
    ]
    write_ensemble(points[::-1], tmp_path / "again.nc", {"scene": "synthetic"})
    assert len(points) == 12
    assert (tmp_path / "again.nc").read_bytes() == first


def test_points_that_the_grid_lacks_are_missing_not_zero(tmp_path):
    points = [
        synthetic.point(tmp_path, 16, 0.86, 1.0, seeds=2),
        synthetic.point(tmp_path, 8, 0.90, 0.5, seeds=3),
    ]
    write_ensemble(points, tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        assert dict(dataset.sizes) == {"n": 2, "phi": 2, "kt": 2, "seed": 3, "mode": 48}
        assert int(dataset["converged"].notnull().sum()) == 5
        assert int(dataset["g"].notnull().sum()) == 5
        assert np.isnan(dataset["rattler_count"].sel(n=16, phi=0.86, kt=1.0, seed=2))
        small = dataset["eigenvalue"].sel(n=8, phi=0.90, kt=0.5)
        assert_array_equal(small.notnull().sum("mode"), [24, 24, 24])


def test_failures_of_an_ensemble_name_point_and_seed(tmp_path):
    stages = [
        block("packings", 0, 2),
        block("rigidity", 0, 2, failures={"rigidity": {"1": "singular"}}),
    ]
    write_block(tmp_path / "point.nc", merge_blocks(dict(zip("ab", stages, strict=True))))
    write_ensemble([tmp_path / "point.nc"], tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        assert json.loads(dataset.attrs["failures"]) == {"rigidity": {"16,0.9,1.0,1": "singular"}}
        assert lost_samples(dataset) == [
            LostSample("failures", "rigidity", 16, 0.9, 1.0, 1, "singular")
        ]


def test_a_failing_point_leaves_no_ensemble_and_keeps_the_old_one(tmp_path):
    path = synthetic.ensemble(tmp_path)
    before, broken = path.read_bytes(), tmp_path / "16-0.9-1.0.nc"
    broken.write_bytes(broken.read_bytes()[:-100])
    with pytest.raises(BlockError, match="truncated"):
        write_ensemble([tmp_path / "16-0.86-1.0.nc", broken], path, {})
    assert path.read_bytes() == before
    assert not list(tmp_path.glob(".*"))


def test_ensembles_of_nothing_of_blocks_and_of_one_point_twice_are_refused(tmp_path):
    point = synthetic.point(tmp_path, 16, 0.9, 1.0, seeds=2)
    out = tmp_path / "ensemble.nc"
    with pytest.raises(BlockError, match="at least one point"):
        write_ensemble([], out, {})
    with pytest.raises(BlockError, match="gather its blocks first"):
        write_ensemble([tmp_path / "16-0.9-1.0-rigidity.nc"], out, {})
    with pytest.raises(BlockError, match="duplicate point"):
        write_ensemble([point, point], out, {})
    assert not out.exists()


def test_open_ensemble_says_what_is_wrong(tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.9,), kts=(1.0,))
    with pytest.raises(BlockError, match="no such file"):
        open_ensemble(tmp_path / "nothing.nc")
    with pytest.raises(
        BlockError, match="expected an ensemble, got a file without the dimension n"
    ):
        open_ensemble(tmp_path / "16-0.9-1.0.nc")
    path.write_bytes(path.read_bytes()[:5000])
    with pytest.raises(BlockError, match=f"{path.name}: not a readable netCDF file"):
        open_ensemble(path)


def test_averages_count_unjammed_samples_as_zero_and_leave_out_failed_ones(tmp_path):
    jammed = np.array([1, 0, 1, 1], dtype=np.int8)
    stages = {
        "a": block("packings", 0, 4, jammed=jammed),
        "b": block(
            "rigidity",
            0,
            4,
            g=np.array([0.3, 0.0, 0.6, np.nan]),
            converged=np.array([1, 1, 1, 0], dtype=np.int8),
        ),
    }
    write_block(tmp_path / "point.nc", merge_blocks(stages))
    write_ensemble([tmp_path / "point.nc"], tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        (row,) = averages(dataset, ["g"]).to_dict("records")
    assert {name: row[name] for name in POINT} == POINT
    assert_allclose(row["g"], 0.3)
    assert_allclose(row["g_standard_error"], np.sqrt((0 + 0.09 + 0.09) / 6))
    assert row["g_samples"] == 3
    assert_allclose(row["fraction_jammed"], 2 / 3)


def test_averages_agree_with_pandas(tmp_path):
    with open_ensemble(synthetic.ensemble(tmp_path)) as dataset:
        table = averages(dataset, ["g"])
        frame = dataset["g"].to_dataframe()["g"].groupby(level=["n", "phi", "kt"])
    pd.testing.assert_series_equal(
        table.set_index(["n", "phi", "kt"])["g_standard_error"], frame.sem(), check_names=False
    )
    assert_allclose(table["g"], frame.mean().to_numpy())


def test_an_observable_that_was_not_asked_for_is_named(tmp_path):
    path = synthetic.ensemble(tmp_path, stages=("packings", "rigidity"))
    with open_ensemble(path) as dataset:
        with pytest.raises(BlockError, match=r"ensemble\.nc: holds no g_simulated"):
            averages(dataset, ["g_simulated"])
        with pytest.raises(BlockError, match=r"ensemble\.nc: holds no eigenvalue"):
            spectrum(dataset, 16, 0.9, 1.0)


def test_spectrum_has_a_row_per_converged_sample(tmp_path):
    stages = {
        "a": block("packings", 0, 3, jammed=np.array([1, 0, 1], dtype=np.int8)),
        "b": block("spectrum", 0, 3, converged=np.array([1, 1, 0], dtype=np.int8)),
    }
    write_block(tmp_path / "point.nc", merge_blocks(stages))
    write_ensemble([tmp_path / "point.nc"], tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        found = spectrum(dataset, 16, 0.9, 1.0)
    assert found.eigenvalue.shape == (2, 48)
    assert_array_equal(found.eigenvalue[0], stages["b"].variables["eigenvalue"][0])
    assert np.isnan(found.eigenvalue[1]).all()


def test_gather_point_reads_files(tmp_path):
    paths = [tmp_path / f"{stage}.nc" for stage in ("packings", "spectrum")]
    for path in paths:
        write_block(path, block(path.stem, 0, 2))
    gathered = gather_point(paths)
    assert gathered.attributes["config"]["spectrum"] == {"force_tolerance": 1e-14}
    assert gathered.variables["eigenvalue"].shape == (2, 48)


def test_without_a_scene_the_law_of_the_points_gives_the_units(tmp_path):
    path = synthetic.point(tmp_path, 16, 0.86, 1.0, 2)
    made = read_block(path)
    config = {"rigidity": {"law": {"normal": "harmonic", "tangential": "elastic"}}}
    write_block(path, Block(made.variables, made.attributes | {"config": config}))
    write_ensemble([path], tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as opened:
        assert opened["g"].attrs["units"] == "k_N"
        assert normal_law(opened) == "harmonic"


def test_a_stage_of_single_samples_leaves_its_failures_and_no_numbers():
    packings = block("packings", 0, 1)
    failed = {"stage": "fields", "kt": 1.0, "failures": {"fields": {"0": "no mode"}}}
    variables = {"seed": np.array([0]), "converged": np.array([0]), "residual": np.array([1e-3])}
    fields = Block(variables, packings.attributes | failed)
    merged = merge_blocks({"a": block("packings", 0, 2), "b": fields})
    assert merged.attributes["failures"] == {"fields": {"0": "no mode"}}
    assert_array_equal(merged.variables["converged"], [1, 1])
    assert "residual" not in merged.variables
    assert "fields" in merged.attributes["config"]


@pytest.mark.parametrize(
    ("name", "words"),
    [("law", "contact law"), ("compression", "settings of the compression")],
)
def test_stages_of_a_point_share_their_law_and_their_packings(name, words):
    first, second = (
        block(stage, 0, 2, config={name: {"kt": 1.0, "normal": normal}})
        for stage, normal in (("rigidity", "hertz"), ("spectrum", "harmonic"))
    )
    with pytest.raises(BlockError, match=f"b: expected the {words} .*hertz.* as in a, got .*harm"):
        merge_blocks({"a": first, "b": second})


def test_a_file_given_twice_is_not_dropped_in_silence(tmp_path):
    path = tmp_path / "rigidity.nc"
    write_block(path, block("rigidity", 0, 2))
    with pytest.raises(BlockError, match=r"rigidity\.nc: expected every file once, got it 2 times"):
        gather_point([path, path])


def test_lost_samples_are_listed_with_stage_place_and_reason(tmp_path):
    point = synthetic.point(tmp_path, 16, 0.9, 1.0, 2)
    made = read_block(point)
    lost = {"failures": {"shear": {"1": "no balance"}}, "not_rigid": {"shear": {"0": "floppy"}}}
    write_block(point, Block(made.variables, made.attributes | lost))
    write_ensemble([point], tmp_path / "ensemble.nc", {})
    with open_ensemble(tmp_path / "ensemble.nc") as dataset:
        failed, floppy = lost_samples(dataset)
    assert (failed.kind, failed.stage, failed.point, failed.seed) == (
        "failures",
        "shear",
        (16, 0.9, 1.0),
        1,
    )
    assert str(failed) == "n = 16, phi = 0.9, kt = 1, seed 1: no balance"
    assert (floppy.words, floppy.reason) == ("not rigid", "floppy")
    with open_ensemble(synthetic.ensemble(tmp_path, phis=(0.9,))) as dataset:
        assert lost_samples(dataset) == []
