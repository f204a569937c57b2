"""Figures of one event: the plotted numbers against synthetic event details, and what is drawn."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure
from numpy.testing import assert_allclose, assert_array_equal

from grainmodes.dataset.files import Block, BlockError, write_block
from grainmodes.figures import draw
from grainmodes.figures.paper_b import (
    event_brackets,
    event_displacement,
    event_eigenvectors,
    event_rate,
    event_states,
    tangential_error,
)
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.figures import FIGURES
from pictures import numbers_of

OF_EVENTS = [name for name, figure in FIGURES.items() if figure.source == "event_detail"]
MAPS = {
    "event_eigenvectors": event_eigenvectors,
    "event_rate": event_rate,
    "event_displacement": event_displacement,
}
SERIES = {"event_states": event_states, "event_brackets": event_brackets}
LENGTHS = dict.fromkeys(MAPS, 36) | {
    "event_states": 14,
    "event_brackets": 5 + 4,
    "tangential_error": 5,
}
CRITICAL, RATTLER = 0.02, 3


def event_detail(n=36, phi=0.9, kt=1.0, jammed=True, event=True) -> Block:
    """Grains on a square lattice with random fields, and an event at `CRITICAL`."""
    draws = np.random.default_rng([n, round(phi * 100)])
    side = int(np.sqrt(n))
    lattice = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(1, n, 2)
    variables = {
        "seed": np.array([0]),
        "converged": np.array([1]),
        "jammed": np.array([int(jammed)]),
        "event_count": np.array([int(jammed and event)]),
        "path_count": np.array([5 if jammed and kt else 0]),
        "position": lattice + 0.25,
        "diameter": np.full((1, n), 0.9),
        "box_length": np.array([float(side)]),
        "strain": np.array([CRITICAL]),
    }
    if jammed and kt:
        variables |= _path()
    if jammed and event:
        variables |= _brackets() | _near() | _fields(n, kt, draws)
    config = {"law": {"normal": "harmonic"}, "rate": 1e-8, "slope": 1e-7}
    attributes = {"stage": "event_detail", "n": n, "phi": phi, "kt": kt, "config": config}
    return Block(variables, attributes)


def _path() -> dict:
    strain = 1e-4 * np.arange(1, 6)
    growing = {"error_largest": 0.7, "error_median": 0.25, "turn_median": 0.5}
    path = {f"path_{name}": factor * strain[None] for name, factor in growing.items()}
    path["path_strain"] = strain[None]
    path["path_error_increment"] = np.full((1, 5), 1e-16)
    path["path_length_median"] = 0.01 * strain[None] ** 2
    return path


def _brackets() -> dict:
    """Three walks: around the event, closer, and one that met none."""
    curve = np.full((1, 3, 5), np.nan)
    curve[0, 0] = CRITICAL + 1e-4 * np.array([-1.5, -0.5, 0.5, 1.5, 2.5])
    curve[0, 1, :4] = CRITICAL + 1e-5 * np.array([-1.5, -0.5, 0.5, 1.5])
    curve[0, 2, 0] = 0.5
    row = {
        "min_step": [1e-4, 1e-5, 1e-6],
        "kind": [1, 3, 0],
        "strain_before": [curve[0, 0, 1], curve[0, 1, 1], np.nan],
        "strain_after": [curve[0, 0, 2], curve[0, 1, 2], np.nan],
    }
    row = {f"bracket_{name}": np.array([values]) for name, values in row.items()}
    return row | {"bracket_curve_strain": curve, "bracket_curve_stress": 0.3 * curve}


def _near() -> dict:
    size = 10.0 ** np.arange(-10, -3)
    distance = np.concatenate([-size[::-1], size])
    g = np.where(distance < 0, 0.3, 0.2) + 2.0 * distance
    row = {
        "distance": distance,
        "strain": CRITICAL + distance,
        "lowest_eigenvalue": g / 10.0,
        "g": g,
        "g_numerical": g + 1e-8,
        "changes": np.zeros(14, int),
    }
    return {f"near_{name}": values[None] for name, values in row.items()}


def _fields(n: int, kt: float, draws) -> dict:
    names = ("lowest_mode_before", "lowest_mode_after", "rate", "rate_simulated")
    fields = {name: draws.normal(size=(1, n, 3)) for name in names}
    for field in fields.values():
        field[:, RATTLER] = np.nan
    fields["event_displacement"] = draws.normal(size=(1, 1, n, 3))
    if not kt:
        for field in fields.values():
            field[..., 2] = np.nan
    return fields | {
        "event_strain_before": np.array([[CRITICAL - 5e-6]]),
        "event_strain_after": np.array([[CRITICAL + 5e-6]]),
        "event_lowest_eigenvalue_before": np.array([[0.03]]),
        "event_lowest_eigenvalue_after": np.array([[0.02]]),
    }


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", OF_EVENTS)
def test_a_figure_is_a_picture_a_vector_picture_and_its_numbers(name, tmp_path):
    write_block(tmp_path / "one.nc", event_detail())
    draw(name, [tmp_path / "one.nc"], tmp_path / name, {})
    numbers = numbers_of(tmp_path, name)
    assert len(numbers) == LENGTHS[name]


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("sample", [{"jammed": False}, {"event": False, "kt": 0.0}], ids=str)
@pytest.mark.parametrize("name", OF_EVENTS)
def test_a_sample_without_an_event_still_has_its_figure(name, sample, tmp_path):
    write_block(tmp_path / "one.nc", event_detail(**sample))
    draw(name, [tmp_path / "one.nc"], tmp_path / name, {})
    assert (tmp_path / f"{name}.pdf").exists()
    assert pd.read_csv(tmp_path / f"{name}.csv", comment="#").empty


@pytest.mark.parametrize("name", OF_EVENTS)
def test_fields_are_no_event_details(name, tmp_path):
    attributes = event_detail().attributes | {"stage": "fields"}
    write_block(tmp_path / "one.nc", Block(event_detail().variables, attributes))
    with pytest.raises(BlockError, match="expected event details, got fields"):
        draw(name, [tmp_path / "one.nc"], tmp_path / name, {})


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize("name", [name for name in OF_EVENTS if name != "tangential_error"])
def test_without_friction_a_figure_is_drawn_too(name, tmp_path):
    write_block(tmp_path / "one.nc", event_detail(kt=0.0))
    draw(name, [tmp_path / "one.nc"], tmp_path / name, {})
    assert len(pd.read_csv(tmp_path / f"{name}.csv", comment="#")) == LENGTHS[name]


def test_states_are_held_against_those_at_the_edge_of_the_event():
    table = event_states.table([event_detail()], Options())
    assert_allclose(table["g_change"], 2.0 * (table["distance"].abs() - 1e-10), atol=1e-15)
    assert_allclose(table["eigenvalue_change"], table["g_change"] / 10.0, atol=1e-15)
    assert (table["law"] == "harmonic").all()


def test_brackets_are_bars_that_close_on_the_event():
    table = event_brackets.table([event_detail()], Options())
    table.loc[table["min_step"] == 1e-4, "distance"] += 3e-6
    figure = Figure()
    event_brackets.draw(figure, table)
    _, brackets, convergence = figure.axes
    bars = np.array(brackets.collections[0].get_segments())
    assert_allclose(bars[:, :, 0], [[1e-5, 1e-5], [1e-4, 1e-4]])
    assert_allclose(bars[:, :, 1], [[-0.05, 0.05], [-0.47, 0.53]], atol=1e-9)
    distance, line = convergence.lines
    assert_allclose(distance.get_xydata(), [[1e-4, 3e-6]], rtol=1e-6)
    assert_allclose(line.get_xydata(), [[1e-5, 5e-6], [1e-4, 5e-5]])
    assert (brackets.get_yscale(), convergence.get_yscale()) == ("linear", "log")


def test_brackets_know_their_ends_and_leave_out_walks_without_an_event():
    table = event_brackets.table([event_detail()], Options())
    assert list(table["min_step"].unique()) == [1e-4, 1e-5]
    ends = table[table["end"] != ""]
    assert list(ends["end"]) == ["before", "after"] * 2
    assert_allclose(ends["distance"], [-5e-5, 5e-5, -5e-6, 5e-6])
    assert_allclose(table["stress"], 0.3 * table["strain"])


def test_fields_are_those_of_the_sample():
    block = event_detail()
    field = event_rate.table([block], Options())
    for prefix, name in (("theory", "rate"), ("simulation", "rate_simulated")):
        columns = [f"{prefix}_{component}" for component in ("x", "y", "rotation")]
        assert_array_equal(field[columns], block.variables[name][0])
    assert set(field["strain_step"]) == {1e-8}
    modes = event_eigenvectors.table([block], Options())
    columns = ["after_x", "after_y", "after_rotation"]
    assert_allclose(modes[columns], 6.0 * block.variables["lowest_mode_after"][0])
    assert (set(modes["eigenvalue_before"]), set(modes["eigenvalue_after"])) == ({0.03}, {0.02})
    moved = event_displacement.table([block], Options())
    columns = ["event_x", "event_y", "event_rotation"]
    assert_array_equal(moved[columns], block.variables["event_displacement"][0, 0])
    assert_allclose(moved["width"], 1e-5)
    assert_allclose(moved["critical_strain"], CRITICAL)


@pytest.mark.parametrize("name", [*MAPS, *SERIES])
def test_each_figure_takes_the_size_nearest_to_the_papers(name):
    blocks = [event_detail(n=n, kt=kt) for n in (36, 144, 1024) for kt in (0.0, 1.0)]
    table = (MAPS | SERIES)[name].table(blocks, Options())
    assert set(table["n"]) == {1024 if name in MAPS else 144}
    assert set(table["kt"]) == {1.0}
    requested = (MAPS | SERIES)[name].table(blocks, Options(n=36, kt=(0.0,)))
    assert (set(requested["n"]), set(requested["kt"])) == ({36}, {0.0})


def test_err_is_that_of_a_sample_with_friction():
    table = tangential_error.table([event_detail(kt=0.0), event_detail(event=False)], Options())
    assert set(table["kt"]) == {1.0}
    assert_allclose(table["error_median"], table["turn_median"] / 2.0)
    figure = Figure()
    tangential_error.draw(figure, table)
    labels = [line.get_label() for line in figure.axes[0].get_lines()]
    assert labels[:2] == ["largest Err", "median Err"] and labels[-1].startswith("paper")
