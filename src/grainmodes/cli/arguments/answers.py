"""Commands that print something: what a file holds, what a scene costs, what an accuracy needs."""

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
    sentence = "Print what a file holds: names, dimensions, units, provenance and failures."
    command = options.command(commands, "show", "show:show", sentence)
    command.add_argument("file", type=Path, help="any netCDF file of a study")


def _cost(commands: Commands) -> None:
    sentence = "Estimate what a scene will cost before it runs: CPU hours, memory and disk."
    command = options.command(commands, "cost", "scenes:cost", sentence)
    command.add_argument("config", type=Path, help="a scene, such as config/default.yaml")
    command.add_argument(
        "--cores", type=options.positive, default=2, help="number of jobs at a time; default 2"
    )
    _costs(command)


def _plan(commands: Commands) -> None:
    sentence = "Estimate from a pilot ensemble how many seeds and CPU hours an accuracy needs."
    command = options.command(commands, "plan", "scenes:plan", sentence)
    command.add_argument("ensemble", type=Path, help="file of `grainmodes ensemble`")
    command.add_argument(
        "--target-error",
        type=options.share,
        required=True,
        metavar="ERROR",
        help="relative standard error of G and of D per bin, such as 1%% or 0.01",
    )
    _costs(command)


def _costs(command: ArgumentParser) -> None:
    command.add_argument(
        "--costs",
        type=Path,
        metavar="FILE",
        help="table of costs of another machine, written by `snakemake growth`",
    )
