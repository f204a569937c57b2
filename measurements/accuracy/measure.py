"""Measure a diagram: `python -m measurements.accuracy.measure strain_step --size small -o FILE`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from grainmodes.runtime.environment import prepare
from measurements.accuracy import NAMES

if TYPE_CHECKING:
    from measurements.accuracy.diagram import DiagramRow

SIZES = ("small", "large")


def measured(name: str, size: str, output: Path) -> None:
    """Measure a diagram and write its table; every row is printed as soon as it is measured.

    Raises:
        OSError: the table cannot be written.
    """
    prepare()  # for the processes that measure, and before numpy is imported here
    from measurements.accuracy.table import table_of, write

    diagram = import_module(f"measurements.accuracy.{name}").DIAGRAM
    grains = getattr(diagram, size)
    write(output, table_of(diagram, grains, list(_print_rows(diagram.measure(grains)))))


def _print_rows(rows: Iterator[DiagramRow]) -> Iterator[DiagramRow]:
    for row in rows:
        cost = f"{row.seconds:9.2e} s {row.megabytes:6.0f} MB"
        kept = f"{row.samples} samples, {row.failed} failed{', default' * row.default}"
        error = f"{row.error:9.2e} +- {row.spread:8.1e}"
        print(f"{row.curve:44} {row.setting:9.2e} {cost} {error}  {kept}", flush=True)
        yield row


def main() -> int:
    """Read the command line; returns 0, or 1 where the file cannot be written."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("name", choices=NAMES)
    parser.add_argument("--size", choices=SIZES, default="small", help="minutes, or hours")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="CSV")
    arguments = parser.parse_args()
    try:
        measured(arguments.name, arguments.size, arguments.output)
    except OSError as error:
        print(f"measure.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
