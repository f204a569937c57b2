"""Commands that only tell: what a file holds, what a scene costs, what an accuracy needs."""

from __future__ import annotations

from argparse import ArgumentParser
from pathlib import Path

from grainmodes.cli.arguments import options
from grainmodes.cli.arguments.options import Commands


def define(commands: Commands) -> None:
    """Add these commands."""
    for add in (_show, _cost, _plan):
        add(commands)


def _show(commands: Commands) -> None:
    sentence = "Say what a file holds: names, dimensions, units, provenance, failures."
    command = options.command(commands, "show", "show:show", sentence)
    command.add_argument("file", type=Path, help="any netCDF file of a study")


def _cost(commands: Commands) -> None:
    sentence = "Say what a scene will cost before it runs: CPU hours, memory, disk."
    command = options.command(commands, "cost", "scenes:cost", sentence)
    command.add_argument("config", type=Path, help="a scene, as config/default.yaml")
    command.add_argument("--cores", type=int, default=2, help="jobs at once; 2 if absent")
    _costs(command)


def _plan(commands: Commands) -> None:
    sentence = "Say how many seeds and CPU hours an accuracy needs, from a pilot ensemble."
    command = options.command(commands, "plan", "scenes:plan", sentence)
    command.add_argument("ensemble", type=Path, help="file of `grainmodes ensemble`")
    command.add_argument(
        "--target-error",
        type=options.share,
        required=True,
        metavar="ERROR",
        help="relative standard error of G and of D per bin, as 1%% or 0.01",
    )
    _costs(command)


def _costs(command: ArgumentParser) -> None:
    command.add_argument(
        "--costs", type=Path, metavar="FILE", help="costs on another machine: `snakemake growth`"
    )
