"""Parts that many commands share: how one is added, common options, and checks of their values."""

from __future__ import annotations

import argparse
import json
from argparse import ArgumentParser
from pathlib import Path
from typing import TypeAlias

from grainmodes.parameters.grid import parse_seeds

Commands: TypeAlias = "argparse._SubParsersAction[ArgumentParser]"
"""The object to which commands of a parser are added."""

UNITS = "Units: k_N = m = d = 1, where d and m are the diameter and the mass of a large grain."


def command(commands: Commands, name: str, run: str, sentence: str) -> ArgumentParser:
    """A command that runs `module:function` of `grainmodes.cli`."""
    command = commands.add_parser(name, help=sentence, description=sentence, epilog=UNITS)
    command.set_defaults(run=run)
    return command


def n(command: ArgumentParser) -> None:
    """`--n`, required."""
    command.add_argument("--n", type=int, required=True, help="number of grains, an even number")


def phi(command: ArgumentParser) -> None:
    """`--phi`, required."""
    command.add_argument("--phi", type=float, required=True, help="area fraction")


def kt(command: ArgumentParser) -> None:
    """`--kt`, required."""
    command.add_argument(
        "--kt", type=float, required=True, help="tangential stiffness k_T / k_N; 0 is frictionless"
    )


def seeds(command: ArgumentParser) -> None:
    """`--seeds`, required: one or a range."""
    command.add_argument(
        "--seeds",
        "--seed",
        type=_seed_range,
        required=True,
        metavar="SEEDS",
        help="one seed, such as 3, or a range that includes both ends, such as 0-7",
    )


def settings(command: ArgumentParser) -> None:
    """`--settings`: the settings that differ from the defaults."""
    command.add_argument(
        "--settings",
        type=json_object,
        default={},
        metavar="JSON",
        help="settings that differ from the defaults, such as "
        '{"contact_law": {"normal": "harmonic"}}; keys: contact_law, observables, protocol '
        "(config/README.md)",
    )


def checkpoint_every(command: ArgumentParser) -> None:
    """`--checkpoint-every`: how often checkpoints of long samples are saved."""
    command.add_argument(
        "--checkpoint-every",
        type=seconds,
        default=120.0,
        metavar="SECONDS",
        help="time between checkpoints of a long sample, kept beside the output file; default 120",
    )


def output(command: ArgumentParser, meaning: str = "file to write") -> None:
    """`--output`, required."""
    command.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help=meaning)


def _seed_range(text: str) -> range:
    try:
        return parse_seeds(text if "-" in text else f"{text}-{text}")
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def positive(text: str) -> int:
    """A whole number above 0."""
    if not (text.isdigit() and int(text) > 0):
        raise argparse.ArgumentTypeError(f"expected a whole number above 0, got {text!r}")
    return int(text)


def seconds(text: str) -> float:
    """A time above 0."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"expected a number of seconds above 0, got {text!r}")
    return value


def share(text: str) -> float:
    """A fraction between 0 and 1, such as 1% or 0.01."""
    number, percent, rest = text.partition("%")
    try:
        value = float(number) / (100.0 if percent else 1.0)
    except ValueError:
        value = 0.0
    if rest or not 0.0 < value < 1.0:
        raise argparse.ArgumentTypeError(
            f"expected a fraction between 0 and 1, such as 1% or 0.01, got {text!r}"
        )
    return value


def json_object(text: str) -> dict:
    """A JSON object."""
    try:
        value = json.loads(text)
    except json.JSONDecodeError as error:
        raise argparse.ArgumentTypeError(f"expected JSON, got {text!r} ({error})") from error
    if not isinstance(value, dict):
        raise argparse.ArgumentTypeError(f"expected a JSON object such as {{}}, got {text!r}")
    return value
