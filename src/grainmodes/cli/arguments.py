"""The words of the command line: commands, options, and what they mean."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from grainmodes import __version__
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.grid import parse_seeds
from grainmodes.parameters.law import NORMAL_LAWS, TANGENTIAL_LAWS
from grainmodes.parameters.protocol import SPECTRA

DESCRIPTION = """\
Rigidity and vibrational modes of two-dimensional packings of frictional grains.

A study is run by `make study` or `snakemake`, which call these commands. By hand, one sample is

  grainmodes point --n 256 --phi 0.9 --kt 1e-4 --seed 3 -o point.nc
  grainmodes show point.nc

and step by step

  grainmodes compress --n 256 --phi 0.8 --seeds 0-7 -o 0.80.nc
  grainmodes compress --n 256 --phi 0.81 --seeds 0-7 --start 0.80.nc -o 0.81.nc
  grainmodes pack 0.81.nc --phi 0.815 -o packings.nc
  grainmodes rigidity packings.nc --kt 1e-4 -o rigidity.nc
"""

UNITS = "Units: k_N = m = d = 1, d being the diameter and m the mass of a large grain."


def parser() -> argparse.ArgumentParser:
    """The parser of every command; each sets `run` to its `module:function` in this package."""
    top = argparse.ArgumentParser(
        prog="grainmodes",
        description=DESCRIPTION,
        epilog=UNITS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action="version", version=__version__)
    top.add_argument("--debug", action="store_true", help="show the traceback of an error")
    commands = top.add_subparsers(dest="name", metavar="COMMAND", required=True)
    for define in (_compress, _pack, _rigidity, _step_strain, _spectrum, _fields, _probes, _point):
        define(commands)
    for define in (_gather, _ensemble, _figure, _claims, _show, _cost):
        define(commands)
    return top


def _command(commands, name: str, run: str, sentence: str) -> argparse.ArgumentParser:
    command = commands.add_parser(name, help=sentence, description=sentence, epilog=UNITS)
    command.set_defaults(run=run)
    return command


def _compress(commands) -> None:
    command = _command(
        commands, "compress", "stages:compress", "Compress grains to a checkpoint of a trajectory."
    )
    _n(command)
    _phi(command)
    _seeds(command)
    command.add_argument(
        "--start",
        nargs="?",
        type=Path,
        metavar="FILE",
        help="the checkpoint below; without it the grains start at random places",
    )
    _settings(command)
    _output(command)


def _pack(commands) -> None:
    sentence = "Bring a checkpoint to an area fraction, in force balance."
    command = _command(commands, "pack", "stages:pack", sentence)
    command.add_argument("start", type=Path, help="the checkpoint at or below --phi")
    _phi(command)
    _settings(command)
    _output(command)


def _rigidity(commands) -> None:
    sentence = "Rigidity of packings from linear response."
    _response(commands, "rigidity", "stages:rigidity", sentence)


def _step_strain(commands) -> None:
    sentence = "Rigidity of packings from a simulated step strain."
    _response(commands, "step-strain", "stages:step_strain", sentence)


def _spectrum(commands) -> None:
    sentence = "Eigenvalues of the Jacobian of packings, and what is measured on eigenvectors."
    command = _response(commands, "spectrum", "stages:spectrum", sentence)
    command.add_argument(
        "--variant",
        choices=("backbone", "rattlers", "hessian"),
        default="backbone",
        help="J without its rattlers, J with them, or the effective Hessian",
    )
    command.add_argument(
        "--processes", type=_positive, default=1, help="processes that share the windows of a J"
    )


def _probes(commands) -> None:
    sentence = "What single claims of paper A need, probed on packings."
    _response(commands, "probes", "stages:probes", sentence)


def _fields(commands) -> None:
    sentence = "Displacement fields and single eigenvectors of the first of some packings."
    _response(commands, "fields", "stages:fields", sentence)


def _response(commands, name: str, run: str, sentence: str) -> argparse.ArgumentParser:
    command = _command(commands, name, run, sentence)
    command.add_argument("packings", type=Path, help="file of `grainmodes pack`")
    _kt(command)
    _settings(command)
    _output(command)
    return command


def _point(commands) -> None:
    sentence = "Everything of one point of the grid, from random grains on, in one go."
    command = _command(commands, "point", "stages:point", sentence)
    _n(command)
    _phi(command)
    _kt(command)
    _seeds(command)
    command.add_argument("--normal", choices=NORMAL_LAWS, help="normal law")
    command.add_argument("--tangential", choices=TANGENTIAL_LAWS, help="tangential law")
    command.add_argument("--friction-coefficient", type=float, metavar="MU", help="Coulomb's mu")
    command.add_argument("--spectrum", choices=SPECTRA, help="what to compute of the spectrum")
    _settings(command)
    _output(command)


def _gather(commands) -> None:
    sentence = "Join all blocks of seeds and all observables of one point."
    command = _command(commands, "gather", "collections:gather", sentence)
    command.add_argument("blocks", type=Path, nargs="+", help="files of pack, rigidity, ...")
    _output(command)


def _ensemble(commands) -> None:
    sentence = "Join points into one file with dimensions (n, phi, kt, seed, mode)."
    command = _command(commands, "ensemble", "collections:ensemble", sentence)
    command.add_argument("points", type=Path, nargs="+", help="files of `grainmodes gather`")
    command.add_argument(
        "--config", type=_json, default={}, metavar="JSON", help="configuration to keep in the file"
    )
    _output(command)


def _figure(commands) -> None:
    sentence = "Draw a figure: PNG, PDF, and the plotted numbers as CSV."
    command = _command(commands, "figure", "collections:figure", sentence)
    command.add_argument("figure", choices=FIGURES, metavar="NAME", help=", ".join(FIGURES))
    command.add_argument(
        "data",
        type=Path,
        nargs="+",
        help="file of `grainmodes ensemble`, or of `grainmodes fields`",
    )
    command.add_argument("--n", type=int, help="the number of grains to show")
    command.add_argument("--phi", type=float, help="the area fraction to show")
    command.add_argument("--kt", type=float, nargs="+", help="the tangential stiffnesses to show")
    command.add_argument("--fineness", type=float, help="factor on the numbers of linear bins")
    _output(command, "path without suffix; .png, .pdf and .csv are written")


def _claims(commands) -> None:
    sentence = "Check the claims A1 to A19 of paper A on an ensemble."
    command = _command(commands, "claims", "collections:claims", sentence)
    command.add_argument("ensemble", type=Path, help="file of `grainmodes ensemble`")
    command.add_argument(
        "-o",
        "--outputs",
        type=Path,
        nargs="+",
        default=[],
        metavar="FILE",
        help="pages (.md) and tables (.csv) to write; without any, a table is printed",
    )


def _show(commands) -> None:
    sentence = "Say what a file holds: names, dimensions, units, provenance, failures."
    command = _command(commands, "show", "show:show", sentence)
    command.add_argument("file", type=Path, help="any netCDF file of a study")


def _cost(commands) -> None:
    sentence = "Say what a scene will cost before it runs: CPU hours, memory, disk."
    command = _command(commands, "cost", "scenes:cost", sentence)
    command.add_argument("config", type=Path, help="a scene, as config/default.yaml")
    command.add_argument("--cores", type=int, default=2, help="jobs at once; 2 if absent")
    command.add_argument(
        "--costs", type=Path, metavar="FILE", help="costs on another machine: `snakemake growth`"
    )


def _n(command) -> None:
    command.add_argument("--n", type=int, required=True, help="number of grains, even")


def _phi(command) -> None:
    command.add_argument("--phi", type=float, required=True, help="area fraction")


def _kt(command) -> None:
    command.add_argument(
        "--kt", type=float, required=True, help="tangential stiffness k_T / k_N; 0: frictionless"
    )


def _seeds(command) -> None:
    command.add_argument(
        "--seeds",
        "--seed",
        type=_seed_range,
        required=True,
        metavar="SEEDS",
        help="one seed, as 3, or a range with both ends, as 0-7",
    )


def _settings(command) -> None:
    command.add_argument(
        "--settings",
        type=_json,
        default={},
        metavar="JSON",
        help="a piece of a configuration: contact_law, observables, protocol (config/README.md)",
    )


def _output(command, meaning: str = "file to write") -> None:
    command.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=meaning)


def _seed_range(text: str) -> range:
    try:
        return parse_seeds(text if "-" in text else f"{text}-{text}")
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def _positive(text: str) -> int:
    if not (text.isdigit() and int(text) > 0):
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number above 0")
    return int(text)


def _json(text: str) -> dict:
    try:
        value = json.loads(text)
    except json.JSONDecodeError as error:
        raise argparse.ArgumentTypeError(f"{text!r} is not JSON ({error})") from error
    if not isinstance(value, dict):
        raise argparse.ArgumentTypeError(f"{text!r} is no JSON object, needed is one as {{}}")
    return value
