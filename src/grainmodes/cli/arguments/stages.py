"""Commands that compute: checkpoints of a compression, packings, and every stage of the table."""

from __future__ import annotations

from pathlib import Path

from grainmodes.cli.arguments import options
from grainmodes.cli.arguments.options import Commands
from grainmodes.parameters.compression import PREPARATIONS
from grainmodes.parameters.law import NORMAL_LAWS, TANGENTIAL_LAWS
from grainmodes.parameters.spectra import SPECTRA
from grainmodes.parameters.stage import Stage
from grainmodes.parameters.stages import STAGES, packings_stage, responses


def define(commands: Commands) -> None:
    """Add these commands, in the order in which a sample runs through them."""
    for name in ("compress", "compress_with_friction"):
        _compress(commands, STAGES[name])
    for preparation in PREPARATIONS:
        _equilibrate(commands, packings_stage(preparation))
    for stage in responses():
        _response(commands, stage)
    _point(commands)


def _compress(commands: Commands, stage: Stage) -> None:
    command = options.command(commands, stage.command, "stages:compress", stage.sentence)
    options.n(command)
    options.phi(command)
    if stage.needs_friction:
        options.kt(command)
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


def _equilibrate(commands: Commands, stage: Stage) -> None:
    command = options.command(commands, stage.command, "stages:equilibrate", stage.sentence)
    command.add_argument("start", type=Path, help="the checkpoint at or below --phi")
    options.phi(command)
    if stage.needs_friction:
        options.kt(command)
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
        "--friction-coefficient",
        type=options.number,
        metavar="MU",
        help="Coulomb's friction coefficient",
    )
    command.add_argument(
        "--preparation",
        choices=PREPARATIONS,
        default=PREPARATIONS[0],
        help="whether the packings are compressed without friction (paper A) or with it (paper B)",
    )
    command.add_argument("--spectrum", choices=SPECTRA, help="kind of spectrum to compute")
    options.settings(command)
    options.output(command)
