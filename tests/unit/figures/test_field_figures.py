"""Figures of single samples: the plotted numbers against synthetic fields, and what is drawn."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.collections import EllipseCollection
from matplotlib.figure import Figure
from matplotlib.quiver import Quiver
from numpy.testing import assert_allclose, assert_array_equal

from grainmodes.dataset.files import Block, BlockError, write_block
from grainmodes.figures import draw
from grainmodes.figures.paper_a import affine_fields, eigenvectors, nonaffine_field
from grainmodes.figures.shared.grain_maps import MAX_OUTLINED_GRAINS, draw_map
from grainmodes.figures.shared.grain_rows import grain_rows
from grainmodes.figures.shared.map_scale import Scale
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.figures import FIGURES
from pictures import numbers_of

OF_FIELDS = [name for name, figure in FIGURES.items() if figure.source == "fields"]
MODULES = {
    "affine_fields": affine_fields,
    "nonaffine_field": nonaffine_field,
    "eigenvectors": eigenvectors,
}
RATTLER = 3


def fields(n=36, phi=0.9, kt=1e-4, jammed=True, modes=3, **changes) -> Block:
    """Grains on a square lattice, all fields random; grain `RATTLER` has none."""
    draws = np.random.default_rng([n, round(phi * 100)])
    side = int(np.sqrt(n))
    lattice = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(1, n, 2)
    names = ("nonaffine_field", "nonaffine_field_mode_sum", "nonaffine_field_simulated")
    random = {name: draws.normal(size=(1, n, 3)) for name in names}
    vectors = draws.normal(size=(1, modes, n, 3))
    for array in (*random.values(), vectors):
        array[..., RATTLER, :] = np.nan
    vectors /= np.sqrt(np.nansum(vectors**2, axis=(2, 3), keepdims=True))
    grid = {
        "seed": np.array([0]),
        "converged": np.array([1]),
        "jammed": np.array([int(jammed)]),
        "position": lattice + 0.25,
        "diameter": np.full((1, n), 0.9),
        "box_length": np.array([float(side)]),
        "strain": np.array([0.0]),
        "affine_field": np.pad(lattice[..., 1:] - side / 2, ((0, 0), (0, 0), (0, 2))),
    }
    answers = random | {
        "frequency_requested": np.array([[1e-4, 1.3e-2, 1.0][:modes]]),
        "frequency_found": np.array([[1.1e-4, 1.2e-2, 0.99][:modes]]),
        "eigenvector": vectors,
    }
    variables = grid | (answers if jammed else {}) | changes
    config = {"step_strain": {"strain": 1e-6}}
    attributes = {"stage": "fields", "n": n, "phi": phi, "kt": kt, "config": config}
    return Block({k: v for k, v in variables.items() if v is not None}, attributes)


@pytest.fixture
def paths(tmp_path):
    """Files of two k_T."""
    files = [tmp_path / "small.nc", tmp_path / "large.nc"]
    for path, kt in zip(files, (1e-8, 1e-4), strict=True):
        write_block(path, fields(kt=kt))
    return files


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", OF_FIELDS)
def test_a_figure_is_a_picture_a_vector_picture_and_its_numbers(name, paths, tmp_path):
    draw(name, paths, tmp_path / name, {})
    numbers = numbers_of(tmp_path, name)
    assert len(numbers) == (36 if name != "eigenvectors" else 2 * 3 * 36)


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", OF_FIELDS)
def test_a_sample_that_is_not_jammed_still_has_its_figure(name, tmp_path):
    write_block(tmp_path / "fields.nc", fields(jammed=False))
    draw(name, [tmp_path / "fields.nc"], tmp_path / name, {})
    assert (tmp_path / f"{name}.pdf").exists()
    assert pd.read_csv(tmp_path / f"{name}.csv", comment="#").empty


def test_the_affine_figure_shows_both_parts_of_the_simulated_step():
    block = fields()
    table = affine_fields.table([block], Options())
    assert_array_equal(table["grain"], np.arange(36))
    assert_array_equal(table[["x", "y"]], block.variables["position"][0])
    for prefix, name in (("affine", "affine_field"), ("nonaffine", "nonaffine_field_simulated")):
        columns = [f"{prefix}_{component}" for component in ("x", "y", "rotation")]
        assert_array_equal(table[columns], block.variables[name][0])
    assert np.isnan(table.loc[RATTLER, "nonaffine_x"])
    assert set(table["strain_step"]) == {1e-6}


def test_the_non_affine_figure_holds_the_mode_sum_against_the_simulation():
    block = fields()
    table = nonaffine_field.table([block], Options())
    for prefix in ("theory", "simulation"):
        name = {"theory": "mode_sum", "simulation": "simulated"}[prefix]
        columns = [f"{prefix}_{component}" for component in ("x", "y", "rotation")]
        expected = block.variables[f"nonaffine_field_{name}"][0]
        assert_array_equal(table[columns], expected)
        assert_array_equal(nonaffine_field._in_order(table, prefix), expected.ravel())


def test_eigenvectors_are_scaled_by_the_number_of_grains():
    block = fields()
    table = eigenvectors.table([block], Options())
    assert list(table["omega_asked"].unique()) == [1e-4, 1.3e-2, 1.0]
    assert list(table["omega"].unique()) == [1.1e-4, 1.2e-2, 0.99]
    for mode, (_, rows) in enumerate(table.groupby("omega")):
        vector = block.variables["eigenvector"][0, mode]
        columns = ["mode_x", "mode_y", "mode_rotation"]
        assert_allclose(rows[columns], 6.0 * vector)
        assert_allclose(rows["psi_rotational"], np.nansum(vector[:, 2] ** 2))


@pytest.mark.parametrize(
    ("name", "shown"), [("affine_fields", 144), ("nonaffine_field", 1024), ("eigenvectors", 4096)]
)
def test_each_figure_takes_the_size_nearest_to_the_papers(name, shown):
    blocks = [fields(n=n, modes=1) for n in (36, 144, 1024, 4096)]
    assert set(MODULES[name].table(blocks, Options())["n"]) == {shown}
    assert set(MODULES[name].table(blocks, Options(n=36))["n"]) == {36}


@pytest.mark.parametrize("name", ["affine_fields", "nonaffine_field"])
def test_a_displacement_figure_shows_the_densest_and_most_frictional_sample(name):
    blocks = [fields(phi=phi, kt=kt) for phi in (0.9, 0.86) for kt in (1e-4, 1.0)]
    table = MODULES[name].table(blocks, Options())
    assert (set(table["phi"]), set(table["kt"])) == ({0.9}, {1.0})
    requested = MODULES[name].table(blocks, Options(phi=0.86, kt=(1e-4,)))
    assert (set(requested["phi"]), set(requested["kt"])) == ({0.86}, {1e-4})
    with pytest.raises(ValueError, match=r"kt: expected one of 0\.0001, 1\.0 .* got 3\.0"):
        MODULES[name].table(blocks, Options(kt=(3.0,)))


def test_eigenvectors_are_those_of_the_papers_stiffnesses_where_there_are_any():
    blocks = [fields(kt=kt) for kt in (1.0, 1e-4, 0.0, 1e-6, 1e-8)]
    assert list(eigenvectors.table(blocks, Options())["kt"].unique()) == [1e-8, 1e-4]
    assert list(eigenvectors.table(blocks[:1], Options())["kt"].unique()) == [1.0]
    requested = eigenvectors.table(blocks, Options(kt=(1.0,)))
    assert list(requested["kt"].unique()) == [1.0]
    with pytest.raises(ValueError, match="with a k_T > 0, got none"):
        eigenvectors.table([fields(kt=0.0)], Options())


def test_what_a_figure_needs_is_named(tmp_path):
    path = tmp_path / "fields.nc"
    write_block(path, fields(nonaffine_field_mode_sum=None))
    with pytest.raises(BlockError, match="no sample holds nonaffine_field_mode_sum"):
        draw("nonaffine_field", [path], tmp_path / "figure", {})
    with pytest.raises(
        BlockError, match=r"fields\.nc: duplicate n, phi and kt, .*fields.* holds them too"
    ):
        draw("affine_fields", [path, path], tmp_path / "figure", {})
    write_block(path, Block(fields().variables, {"stage": "packings", "n": 36}))
    with pytest.raises(BlockError, match=r"fields\.nc: expected fields, got packings"):
        draw("affine_fields", [path], tmp_path / "figure", {})
    assert [entry.name for entry in tmp_path.iterdir()] == ["fields.nc"]


def drawn(block: Block, prefix: str) -> tuple[EllipseCollection, Quiver]:
    """Circles and arrows of the map of one field."""
    table = affine_fields.table([block], Options())
    axes = Figure().subplots()
    scale = Scale(size=3.0, length=1.5, keys=(1.0,), limit=0.5)
    arrows = draw_map(axes, table, prefix, scale)
    return axes.collections[0], arrows


def test_a_map_draws_every_grain_at_its_place_and_its_arrow_to_scale():
    block = fields()
    circles, arrows = drawn(block, "nonaffine")
    assert_array_equal(circles.get_offsets()[:36], block.variables["position"][0])
    field = block.variables["nonaffine_field_simulated"][0]
    assert_array_equal(np.flatnonzero(arrows.Umask), [RATTLER])
    for component, lengths in enumerate((arrows.U, arrows.V)):
        expected = 0.5 * np.delete(field[:, component], RATTLER)
        assert_allclose(np.delete(lengths, RATTLER), expected)
    assert arrows.scale == 1.0


def test_colours_are_symmetric_and_a_rattler_has_none():
    block = fields()
    spins = block.variables["nonaffine_field_simulated"][0, :, 2]
    spins[:3] = -0.2, 0.0, 0.2
    face = drawn(block, "nonaffine")[0].get_facecolor()
    blue, white, red = face[:3]
    assert blue[2] > blue[0] and red[0] > red[2]
    assert np.ptp(white[:3]) < 0.02
    assert face[RATTLER, 3] == 0.0
    assert (np.delete(face[:36], RATTLER, axis=0)[:, 3] == 1.0).all()


def test_a_grain_across_the_edge_is_drawn_on_both_sides():
    block = fields()
    circles, _ = drawn(block, "affine")
    images = circles.get_offsets()[36:]
    # Every grain of the lowest line and the leftmost column (0.25 - 0.45 < 0) sticks out.
    assert len(images) == 6 + 6 + 1
    assert {tuple(place) for place in images.round(9)} >= {(6.25, 0.25), (0.25, 6.25), (6.25, 6.25)}


def test_a_crowd_is_pixels_and_a_few_grains_are_outlines():
    few, many = (drawn(fields(n=n), "nonaffine")[0] for n in (36, 1156))
    assert 36 < MAX_OUTLINED_GRAINS < 1156
    assert (few.get_rasterized(), many.get_rasterized()) == (False, True)
    assert (len(few.get_edgecolor()), len(many.get_edgecolor())) == (1, 0)


@pytest.mark.parametrize("rotates", [True, False])
def test_a_colour_bar_stands_where_something_turns(rotates):
    block = fields(kt=1e-4 if rotates else 0.0)
    if not rotates:
        block.variables["nonaffine_field_simulated"][..., 2] = np.nan
    figure = Figure()
    affine_fields.draw(figure, affine_fields.table([block], Options()))
    assert len(figure.axes) == (3 if rotates else 2)


def test_rows_say_where_a_grain_is():
    row = grain_rows(fields()).iloc[7]
    assert (row["n"], row["phi"], row["kt"], row["box_length"]) == (36, 0.9, 1e-4, 6.0)
    assert (row["x"], row["y"], row["diameter"]) == (1.25, 1.25, 0.9)
