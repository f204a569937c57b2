"""The arguments and help texts of all commands; a module per theme."""

from __future__ import annotations

import argparse

from grainmodes import __version__
from grainmodes.cli.arguments import answers, collections, stages
from grainmodes.cli.arguments.options import UNITS

DESCRIPTION = """\
Rigidity and vibrational modes of two-dimensional packings of frictional grains.

`make study` or `snakemake` runs a study by calling these commands. To compute one sample by hand:

  grainmodes point --n 256 --phi 0.9 --kt 1e-4 --seed 3 -o point.nc
  grainmodes show point.nc

The same step by step:

  grainmodes compress --n 256 --phi 0.8 --seeds 0-7 -o 0.80.nc
  grainmodes compress --n 256 --phi 0.81 --seeds 0-7 --start 0.80.nc -o 0.81.nc
  grainmodes equilibrate 0.81.nc --phi 0.815 -o packings.nc
  grainmodes rigidity packings.nc --kt 1e-4 -o rigidity.nc
"""


def parser() -> argparse.ArgumentParser:
    """The parser of every command; each sets `run` to its `module:function` in `cli`."""
    top = argparse.ArgumentParser(
        prog="grainmodes",
        description=DESCRIPTION,
        epilog=UNITS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action="version", version=__version__)
    top.add_argument("--debug", action="store_true", help="show the traceback of an error")
    commands = top.add_subparsers(dest="name", metavar="COMMAND", required=True)
    for theme in (stages, collections, answers):
        theme.define(commands)
    return top
