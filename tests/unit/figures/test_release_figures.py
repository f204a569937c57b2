"""Figures of released states: the plotted numbers against the block, and what is drawn."""

import matplotlib.image
import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from PIL import Image

from grainmodes.cli import main
from grainmodes.dataset.files import Block, BlockError, write_block
from grainmodes.figures import draw
from grainmodes.figures.paper_c import (
    film,
    release_contacts,
    release_damping,
    release_growth,
    release_outcome,
    release_pair,
    release_pressure,
    release_spectrum,
    release_spirals,
    release_times,
)
from grainmodes.figures.shared.release_rows import growing_records
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.release import Release
from grainmodes.stages.release import release_block
from pictures import numbers_of
from released import complex_pairs_block, state

OF_RELEASES = [name for name, figure in FIGURES.items() if figure.source == "release"]
CHOICES = Release(duration=22.0, min_time=0.0, dampings=(1.0, 4.0), n_records=300, spectra=4)


@pytest.fixture(scope="module")
def release() -> Block:
    return release_block(complex_pairs_block(), state()[1], CHOICES)


@pytest.fixture(scope="module")
def path(release, tmp_path_factory):
    path = tmp_path_factory.mktemp("release") / "release.nc"
    write_block(path, release)
    return path


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", OF_RELEASES)
def test_a_figure_is_a_picture_a_vector_picture_and_its_numbers(name, path, tmp_path):
    draw(name, [path], tmp_path / name, {})
    assert len(numbers_of(tmp_path, name))
    picture = matplotlib.image.imread(tmp_path / f"{name}.png")[..., :3]
    assert (picture.min(axis=2) < 0.5).mean() > 5e-3


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", OF_RELEASES)
def test_a_study_without_an_unstable_state_still_has_its_figures(name, tmp_path):
    pairs = complex_pairs_block()
    pairs.variables["unstable_found"][:] = 0
    write_block(tmp_path / "none.nc", release_block(pairs, state()[1], CHOICES))
    draw(name, [tmp_path / "none.nc"], tmp_path / name, {})
    assert (tmp_path / f"{name}.pdf").exists()


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("lacking", ["release_spectrum", "release_spectrum release_pair"])
@pytest.mark.parametrize("name", ["release_spectrum", "release_times"])
def test_figures_of_runs_without_spectra(name, lacking, release, tmp_path):
    """Large systems have no spectra, and with `spectra: 0` the pair is not followed either."""
    prefixes = (*lacking.split(), *(["release_death"] if "pair" in lacking else []))
    kept = {
        key: values for key, values in release.variables.items() if not key.startswith(prefixes)
    }
    write_block(tmp_path / "block.nc", Block(kept, release.attributes))
    draw(name, [tmp_path / "block.nc"], tmp_path / name, {})
    assert (tmp_path / f"{name}.pdf").exists()


def test_growth_shows_records_and_the_laws_through_them(release):
    rows, values = release_growth.table([release], Options()), release.variables
    known = np.isfinite(values["release_time"][0, 1, 0])
    assert_array_equal(rows["m"], values["release_mean_square_displacement"][0, 1, 0, known])
    linear = rows[(rows["m"] > 1e-18) & (rows["m"] < 1e-11)]
    for column in ("m", "a"):
        assert_allclose(linear[f"{column}_fit"], linear[column], rtol=0.02)
    assert abs(rows["growth_error"].iloc[0]) < 0.01


def test_a_growth_is_shown_until_a_little_after_its_end():
    table = pd.DataFrame({"time": np.arange(0.0, 30.0), "end_time": 10.0})
    assert_array_equal(growing_records(table)["time"], np.arange(1.0, 13.0))
    assert len(growing_records(table.assign(end_time=np.nan))) == 29


def test_spirals_end_where_the_film_does(release):
    rows, values = release_spirals.table([release], Options()), release.variables
    frames, n = values["release_film"].shape[2:4]
    assert len(rows) == frames * n
    last = rows.tail(n)
    assert_allclose(last[["dx", "dy"]], values["release_film"][0, 1, -1, :, :2])
    assert_allclose(last[["x", "y"]], values["release_start_position"][0, 1])
    paths = release_spirals.trajectories(rows)
    moved = paths[-1] - values["release_start_position"][0, 1]
    assert_allclose(moved, rows["factor"].iloc[0] * last[["dx", "dy"]].to_numpy(), atol=1e-12)


def test_the_fate_has_every_sample_and_the_spectrum_every_pair(release):
    assert release_outcome.table([release], Options())["seed"].unique().tolist() == [0]
    rows, values = release_spectrum.table([release], Options()), release.variables
    pairs = values["release_spectrum_pairs"][0, 1]
    spectra = rows[rows["kind"] == "spectrum"]
    assert len(spectra) == pairs.sum()
    assert spectra.drop_duplicates("time")["pairs"].tolist() == pairs.tolist()
    released = rows[rows["kind"] == "released"]
    assert_array_equal(released["imaginary"], values["release_pair_imaginary"][0, 1])


def test_shares_of_grains_and_mean_pressures_are_those_of_the_grains(release):
    values = release.variables
    grains = release_contacts.table([release], Options()).query("kind == 'grains'")
    for side in ("before", "after"):
        z = values[f"release_contacts_{side}"][0, 1]
        assert_allclose((grains["z"] * grains[side]).sum(), z.mean())
        rows = release_pressure.table([release], Options()).query(f"side == '{side}'")
        of_z = rows[rows["kind"] == "grains"]
        total = values[f"release_grain_pressure_{side}"][0, 1].sum()
        assert_allclose((of_z["pressure"] * of_z["count"]).sum(), total)
        bins = rows[rows["kind"] == "contacts"]
        width = np.diff(bins["binary"]).mean()
        assert_allclose((bins["density"] * width).sum(), 1.0)
        assert (
            bins["count"].sum()
            == np.isfinite(values[f"release_binary_pressure_{side}"][0, 1]).sum()
        )


def test_damping_shows_every_run_with_its_rate(release):
    table = release_damping.table([release], Options())
    rows = table[table["kind"] == "record"].drop_duplicates("damping")
    assert_allclose(rows["damping"] / rows["rate"], [0.0, 1.0, 4.0])
    assert_allclose(rows["rate_damped"] / rows["rate"], [1.0, 0.728, 0.032], atol=1e-3)
    theory = table[table["kind"] == "theory"]
    at = np.interp(rows["damping"], theory["damping"], theory["rate_damped"])
    assert_allclose(at, rows["rate_damped"], rtol=1e-3)


def test_the_first_turns_follow_the_sine_of_the_paper(release):
    rows = release_growth.table([release], Options())
    for column in ("m", "a"):
        early = rows[rows[f"{column}_early"].notna()]
        assert len(early) > 100
        error = (early[column] - early[f"{column}_early"]).abs().max()
        assert error < 0.1 * early[f"{column}_early"].max()


def test_of_several_states_the_one_nearest_to_the_paper_s_rate_is_shown(release):
    """One of two states grows at about C's rate; Fig. 7 has both, the fast one first."""
    values = {name: array.copy() for name, array in release.variables.items()}
    for name, array in values.items():
        if name.startswith("release_"):
            array[0, 0] = array[0, 1]
    values["release_rate_linear"][0, 0] = 3e-5
    both = Block(values, release.attributes)
    assert release_growth.table([both], Options())["rate"].unique().tolist() == [3e-5]
    rates = release_outcome.table([both], Options())["rate"].unique()
    assert_allclose(rates, [values["release_rate_linear"][0, 1], 3e-5])
    assert len(release_times.table([both], Options())) == 2


def test_the_pair_along_the_shear_stands_beside_its_growth(release):
    rows = release_pair.table([release], Options())
    shear = rows[rows["kind"] == "shear"]
    assert shear["strain"].tolist() == rows["released_strain"].unique().tolist()
    assert_allclose(shear["imaginary"], release.variables["release_path_imaginary"][0, 1])


def test_what_is_not_there_is_refused(release):
    with pytest.raises(ValueError, match=r"seed: expected .* got 7"):
        release_growth.table([release], Options(seed=7))
    with pytest.raises(ValueError, match=r"n: expected .* got 51"):
        release_outcome.table([release], Options(n=51))


def test_two_files_of_the_same_samples_are_refused(path, tmp_path):
    with pytest.raises(BlockError, match="duplicate n, phi and kt"):
        draw("release_outcome", [path, path], tmp_path / "x", {})


def test_the_film_moves_and_is_written_by_a_command(release, tmp_path, monkeypatch):
    monkeypatch.setattr(film, "DOTS_PER_INCH", 40)
    names = ("release_film", "release_frame_time")
    short = {name: release.variables[name][:, :, :12] for name in names}
    write_block(tmp_path / "x.nc", Block(release.variables | short, release.attributes))
    assert main(["film", str(tmp_path / "x.nc"), "-o", str(tmp_path / "spirals.gif")]) == 0
    with Image.open(tmp_path / "spirals.gif") as movie:
        assert movie.n_frames == 11
        first = np.asarray(movie.convert("L"), float)
        movie.seek(10)
        assert np.abs(np.asarray(movie.convert("L"), float) - first).max() > 50
    assert {entry.name for entry in tmp_path.iterdir()} == {"spirals.gif", "x.nc"}
