"""All points of a study in one file, with the dimensions n, phi, kt, seed, and those of a series.

Points are written one after the other, so that the memory is that of one point, for any size of the
study; a spectrum is one chunk. Missing values and missing points are NaN; integers have the fill
value -1, which xarray shows as NaN. The bytes of the file depend neither on the order of the points
nor on the time.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from grainmodes.dataset import VARIABLES
from grainmodes.dataset.files import Block, BlockError, content_of, new_file, read_block
from grainmodes.dataset.library import netCDF4
from grainmodes.dataset.lost import KINDS, Lost
from grainmodes.dataset.units import Laws, laws_of
from grainmodes.ensemble.lost import point_name, sample_name
from grainmodes.ensemble.point import STAGES

GRID = ("n", "phi", "kt")
INTEGER_FILL = -1


class Layout(NamedTuple):
    """The structure of the file: values of the coordinates, lengths of the series, variables, and
    the points at which each stage was computed, as "n,phi,kt"."""

    coordinates: dict[str, np.ndarray]
    lengths: dict[str, int]
    names: list[str]
    stages: dict[str, list[str]]
    code_version: str


def write_ensemble(point_paths: list[str | Path], out_path: str | Path, config: dict) -> None:
    """Write one ensemble file, all of it or nothing.

    Args:
        point_paths: files of `gather_point`, in any order.
        out_path: netCDF file to write.
        config: the study's configuration, kept as JSON in the attribute `config`; where it states
            no contact law, that of the points is kept.

    Raises:
        BlockError: no point is given, a file is not a point, or a point occurs twice.
        OSError: the file cannot be written; an older file of this name stays as it was.
    """
    paths = _in_grid_order(point_paths)
    law = laws_of(read_block(paths[0]).mapping("config"))
    config = ({"contact_law": law._asdict()} if law.normal else {}) | config
    layout = _layout(paths)
    with new_file(out_path) as file:
        _define(file, layout, laws_of(config))
        file.title = "Ensemble of jammed packings: response, spectra and provenance, by sample"
        file.code_version = layout.code_version
        file.config = json.dumps(config, sort_keys=True)
        file.stages = json.dumps(layout.stages)
        for kind, lost in _fill(file, layout, paths).items():
            file.setncattr(kind, json.dumps(lost, sort_keys=True))


def _in_grid_order(paths: list[str | Path]) -> list[Path]:
    if not paths:
        raise BlockError("an ensemble: expected at least one point, got none")
    found: dict[tuple, Path] = {}
    for path, block in _points(paths):
        point = _coordinates(block)
        if point in found:
            raise BlockError(
                f"{path}: duplicate point (n, phi, kt) = {point}, {found[point]} holds it too"
            )
        found[point] = path
    return [found[point] for point in sorted(found)]


def _points(paths: list[str | Path]) -> Iterator[tuple[Path, Block]]:
    for path in map(Path, paths):
        block = read_block(path)
        if block.attributes.get("stage") != "point":
            raise BlockError(
                f"{path}: expected a point, got {content_of(block)}; gather its blocks first"
            )
        yield path, block


def _coordinates(block: Block) -> tuple[int, float, float]:
    values = block.attributes
    return int(values["n"]), float(values["phi"]), float(values["kt"])


def _layout(paths: list[Path]) -> Layout:
    stages: dict[str, list[str]] = {stage: [] for stage in STAGES}
    grid, seeds, names, versions, lengths = set(), set(), set(), set(), {"mode": 0}
    for _, block in _points(paths):
        grid.add(_coordinates(block))
        seeds.update(block.variables["seed"].tolist())
        names.update(name for name in block.variables if name != "seed")
        for stage in block.mapping("config"):
            stages.setdefault(stage, []).append(point_name(*_coordinates(block)))
        versions.add(str(block.attributes["code_version"]))
        for name, array in block.variables.items():
            own = zip(VARIABLES[name].dimensions[1:], array.shape[1:], strict=True)
            for dimension, length in own:
                lengths[dimension] = max(lengths.get(dimension, 0), length)
    coordinates = {
        name: np.unique([point[axis] for point in grid]) for axis, name in enumerate(GRID)
    }
    coordinates |= {"seed": np.array(sorted(seeds)), "mode": np.arange(lengths.pop("mode"))}
    in_table_order = [name for name in VARIABLES if name in names]
    computed = {stage: points for stage, points in stages.items() if points}
    return Layout(coordinates, lengths, in_table_order, computed, ", ".join(sorted(versions)))


def _define(file: netCDF4.Dataset, layout: Layout, laws: Laws) -> None:
    for name, values in layout.coordinates.items():
        file.createDimension(name, len(values))
        _describe(file.createVariable(name, VARIABLES[name].dtype, (name,)), name, laws)
        file[name][...] = values
    for name, length in sorted(layout.lengths.items()):
        file.createDimension(name, length)
    for name in layout.names:
        row = VARIABLES[name]
        variable = file.createVariable(
            name,
            row.dtype,
            (*GRID, *row.dimensions),
            fill_value=np.nan if row.dtype.startswith("f") else INTEGER_FILL,
            **_storage(layout, row.dimensions),
        )
        _describe(variable, name, laws)


def _describe(variable: netCDF4.Variable, name: str, laws: Laws) -> None:
    variable.units = VARIABLES[name].unit.text(laws)
    variable.long_name = VARIABLES[name].long_name


def _storage(layout: Layout, dimensions: tuple[str, ...]) -> dict[str, object]:
    if len(dimensions) < 2:
        return {}
    lengths = layout.lengths | {"mode": len(layout.coordinates["mode"])}
    chunk = (1, 1, 1, 1, *(lengths[dimension] for dimension in dimensions[1:]))
    return {"chunksizes": chunk, "zlib": True, "complevel": 1, "shuffle": True}


def _fill(file: netCDF4.Dataset, layout: Layout, paths: list[Path]) -> dict[str, Lost]:
    """Write every point; return attribute → the lost samples, as "n,phi,kt,seed"."""
    lost: dict[str, Lost] = {kind: {} for kind in KINDS}
    for _, block in _points(paths):
        point = _coordinates(block)
        place = tuple(
            int(np.searchsorted(layout.coordinates[name], value))
            for name, value in zip(GRID, point, strict=True)
        )
        rows = np.searchsorted(layout.coordinates["seed"], block.variables["seed"])
        for name in layout.names:
            if name in block.variables:
                _fill_rows(file[name], place, rows, block.variables[name])
        for kind in KINDS:
            for stage, samples in block.mapping(kind).items():
                entries = lost[kind].setdefault(stage, {})
                entries |= {sample_name(*point, int(seed)): why for seed, why in samples.items()}
    return lost


def _fill_rows(
    variable: netCDF4.Variable, place: tuple[int, ...], rows: np.ndarray, array: np.ndarray
) -> None:
    for row, values in zip(rows, array, strict=True):
        rest = tuple(slice(0, length) for length in array.shape[1:])
        variable[(*place, int(row), *rest)] = values
