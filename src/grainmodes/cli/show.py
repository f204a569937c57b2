"""The command `show`: what a netCDF file of a study holds."""

from __future__ import annotations

import json
from argparse import Namespace
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from grainmodes.dataset.files import opened_file
from grainmodes.dataset.library import netCDF4
from grainmodes.dataset.lost import KINDS

LAST = ("config", *KINDS)
"""Long attributes, which are shown below the variables."""


def show(arguments: Namespace) -> None:
    """Print dimensions, variables, provenance, converged samples and lost samples of a file."""
    with opened_file(arguments.file) as file:
        lines = [str(arguments.file), *_lines(file)]
    print("\n".join(lines))


def _lines(file: netCDF4.Dataset) -> Iterator[str]:
    attributes = {name: file.getncattr(name) for name in file.ncattrs()}
    yield from _table((name, attributes[name]) for name in attributes if name not in LAST)
    yield "\ndimensions"
    yield from _table((name, len(size)) for name, size in file.dimensions.items())
    yield "\nvariables"
    yield from _table(map(_variable, file.variables.values()))
    yield "\nsamples"
    yield from _table(_outcome(file))
    for name in LAST:
        yield f"\n{name}"
        yield from _tree(json.loads(attributes.get(name, "{}")) or {"none": ""})


def _variable(variable: netCDF4.Variable) -> tuple[str, ...]:
    shape = f"({', '.join(variable.dimensions)})"
    notes = [getattr(variable, name, "") for name in ("units", "long_name")]
    return variable.name, shape, *notes


def _outcome(file: netCDF4.Dataset) -> Iterator[tuple[str, str]]:
    for name in ("converged", "jammed"):
        if name in file.variables:
            values = np.ma.filled(file[name][...], -1)
            yield name, f"{np.count_nonzero(values == 1)} of {np.count_nonzero(values >= 0)}"


def _table(rows: Iterable[Sequence[object]]) -> Iterator[str]:
    lines = [[str(cell) for cell in row] for row in rows]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for row in lines:
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        yield f"  {'  '.join(cells)}".rstrip()


def _tree(value: dict, depth: int = 1) -> Iterator[str]:
    for key, item in value.items():
        if isinstance(item, dict):
            yield f"{'  ' * depth}{key}"
            yield from _tree(item, depth + 1)
        else:
            yield f"{'  ' * depth}{key}  {item}"
