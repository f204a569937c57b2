"""Commands that join blocks and points, draw figures, and check claims."""

from __future__ import annotations

from argparse import ArgumentParser
from pathlib import Path

from grainmodes.cli.arguments import options
from grainmodes.cli.arguments.options import Commands
from grainmodes.parameters.figures import FIGURES


def define(commands: Commands) -> None:
    """Add these commands."""
    for add in (_gather, _ensemble, _figure, _film, _claims):
        add(commands)


def _gather(commands: Commands) -> None:
    sentence = "Join all observables and all blocks of seeds of one point into one file."
    command = options.command(commands, "gather", "collections:gather", sentence)
    command.add_argument(
        "blocks",
        type=Path,
        nargs="+",
        help="files of `equilibrate`, `rigidity` and other stages of one point",
    )
    options.output(command)


def _ensemble(commands: Commands) -> None:
    sentence = "Join points into one file with dimensions (n, phi, kt, seed, mode)."
    command = options.command(commands, "ensemble", "collections:ensemble", sentence)
    command.add_argument("points", type=Path, nargs="+", help="files of `grainmodes gather`")
    command.add_argument(
        "--config",
        type=options.json_object,
        default={},
        metavar="JSON",
        help="configuration to store in the file",
    )
    options.output(command)


def _figure(commands: Commands) -> None:
    sentence = "Draw a figure as PNG and PDF, and write the plotted numbers as CSV."
    command = options.command(commands, "figure", "collections:figure", sentence)
    command.add_argument(
        "figure", choices=FIGURES, metavar="NAME", help=f"one of {', '.join(FIGURES)}"
    )
    command.add_argument(
        "data",
        type=Path,
        nargs="*",
        help="a file of `ensemble`, or files of `fields`, `event-detail` or `release`",
    )
    _reference(command, "draw from a reference ensemble of the package, by default the first one")
    _shown(command)
    density = "factor on the numbers of linear bins"
    command.add_argument("--bin-density", type=options.number, help=density)
    options.output(command, "path, to which the suffixes .png, .pdf, .csv and .txt are added")


def _film(commands: Commands) -> None:
    sentence = "Draw the spirals of a released sample as a film (GIF)."
    command = options.command(commands, "film", "collections:film", sentence)
    command.add_argument("data", type=Path, nargs="+", help="files of `grainmodes release`")
    _shown(command)
    options.output(command)


def _shown(command: ArgumentParser) -> None:
    command.add_argument("--n", type=options.whole, help="number of grains to show")
    command.add_argument("--phi", type=options.number, help="area fraction to show")
    command.add_argument(
        "--kt", type=options.number, nargs="+", help="tangential stiffnesses k_T / k_N to show"
    )
    command.add_argument("--seed", type=options.whole, help="seed of the sample to show")


def _reference(command: ArgumentParser, sentence: str) -> None:
    command.add_argument("--reference", nargs="?", const="", metavar="STUDY", help=sentence)


def _claims(commands: Commands) -> None:
    sentence = "Check the claims of the papers on an ensemble."
    command = options.command(commands, "claims", "collections:claims", sentence)
    command.add_argument("ensemble", type=Path, nargs="?", help="file of `grainmodes ensemble`")
    _reference(command, "judge by a reference ensemble of the package, by default by all of them")
    command.add_argument(
        "-o",
        "--outputs",
        type=Path,
        nargs="+",
        default=[],
        metavar="FILE",
        help="pages (.md) and tables (.csv) to write; by default a table is printed",
    )
