"""Commands that compute: checkpoints of a compression, packings, and every stage of the table."""

from __future__ import annotations

from pathlib import Path

from grainmodes.cli.arguments import options
from grainmodes.cli.arguments.options import Commands
from grainmodes.parameters.law import NORMAL_LAWS, TANGENTIAL_LAWS
from grainmodes.parameters.spectra import SPECTRA
from grainmodes.parameters.stage import Stage
from grainmodes.parameters.stages import STAGES, responses


def define(commands: Commands) -> None:
    """Add these commands, in the order in which a sample runs through them."""
    _compress(commands)
    _equilibrate(commands)
    for stage in responses():
        _response(commands, stage)
    _point(commands)


def _compress(commands: Commands) -> None:
    command = options.command(commands, "compress", "stages:compress", STAGES["compress"].sentence)
    options.n(command)
    options.phi(command)
    options.seeds(command)
    command.add_argument(
        "--start",
        nargs="?",
        type=Path,
        metavar="FILE",
        help="the checkpoint below --phi; by default the grains are placed at random",
    )
    options.settings(command)
    options.output(command)


def _equilibrate(commands: Commands) -> None:
    sentence = STAGES["equilibrate"].sentence
    command = options.command(commands, "equilibrate", "stages:equilibrate", sentence)
    command.add_argument("start", type=Path, help="the checkpoint at or below --phi")
    options.phi(command)
    options.settings(command)
    options.output(command)


def _response(commands: Commands, stage: Stage) -> None:
    """The command of an entry of the table of stages."""
    read = STAGES[stage.reads]
    command = options.command(commands, stage.command, "stages:response", stage.sentence)
    help_text = f"file of `grainmodes {read.command}`"
    command.add_argument("block", type=Path, metavar=read.output, help=help_text)
    options.kt(command)
    options.settings(command)
    if stage.parallel:
        command.add_argument(
            "--processes",
            type=options.positive,
            default=1,
            help="processes that share the slices of a spectrum",
        )
    if stage.resumable:
        options.checkpoint_every(command)
    options.output(command)


def _point(commands: Commands) -> None:
    sentence = "Compute all observables of one point, starting from random placement, in one run."
    command = options.command(commands, "point", "stages:point", sentence)
    options.n(command)
    options.phi(command)
    options.kt(command)
    options.seeds(command)
    command.add_argument("--normal", choices=NORMAL_LAWS, help="normal law")
    command.add_argument("--tangential", choices=TANGENTIAL_LAWS, help="tangential law")
    command.add_argument(
        "--friction-coefficient", type=float, metavar="MU", help="Coulomb's friction coefficient"
    )
    command.add_argument("--spectrum", choices=SPECTRA, help="kind of spectrum to compute")
    options.settings(command)
    options.output(command)
