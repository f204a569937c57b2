"""Commands that collect: blocks, points, and what is drawn and judged from an ensemble."""

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
    sentence = "Join all blocks of seeds and all observables of one point."
    command = options.command(commands, "gather", "collections:gather", sentence)
    command.add_argument("blocks", type=Path, nargs="+", help="files of pack, rigidity, ...")
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
        help="configuration to keep in the file",
    )
    options.output(command)


def _figure(commands: Commands) -> None:
    sentence = "Draw a figure: PNG, PDF, and the plotted numbers as CSV."
    command = options.command(commands, "figure", "collections:figure", sentence)
    command.add_argument("figure", choices=FIGURES, metavar="NAME", help=", ".join(FIGURES))
    command.add_argument(
        "data",
        type=Path,
        nargs="+",
        help="file of `grainmodes ensemble`, or files of `fields`, `event-detail` or `release`",
    )
    _shown(command)
    command.add_argument("--bin_density", type=float, help="factor on the numbers of linear bins")
    options.output(command, "path without suffix; .png, .pdf and .csv are written")


def _film(commands: Commands) -> None:
    sentence = "Draw the spirals of a released sample as a film (GIF)."
    command = options.command(commands, "film", "collections:film", sentence)
    command.add_argument("data", type=Path, nargs="+", help="files of `grainmodes release`")
    _shown(command)
    options.output(command)


def _shown(command: ArgumentParser) -> None:
    command.add_argument("--n", type=int, help="the number of grains to show")
    command.add_argument("--phi", type=float, help="the area fraction to show")
    command.add_argument("--kt", type=float, nargs="+", help="the tangential stiffnesses to show")
    command.add_argument("--seed", type=int, help="the sample to show")


def _claims(commands: Commands) -> None:
    sentence = "Check the claims of the papers on an ensemble."
    command = options.command(commands, "claims", "collections:claims", sentence)
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
