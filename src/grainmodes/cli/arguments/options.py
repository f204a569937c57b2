"""Parts that many commands share: how one is added, common options, and checks of their values."""

from __future__ import annotations

import argparse
import json
import re
from argparse import ArgumentParser
from pathlib import Path
from typing import Any, TypeAlias

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
    command.add_argument("--n", type=whole, required=True, help="number of grains, an even number")


def phi(command: ArgumentParser) -> None:
    """`--phi`, required."""
    command.add_argument("--phi", type=number, required=True, help="area fraction")


def kt(command: ArgumentParser) -> None:
    """`--kt`, required."""
    command.add_argument(
        "--kt", type=number, required=True, help="tangential stiffness k_T / k_N; 0 is frictionless"
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


def whole(text: str) -> int:
    """A whole number, in digits alone."""
    if not re.fullmatch(r"[-+]?[0-9]{1,100}", text):
        raise argparse.ArgumentTypeError(f"expected a whole number, got {_shown(text)}")
    return int(text)


def positive(text: str) -> int:
    """A whole number above 0."""
    if not re.fullmatch(r"[0-9]{1,100}", text) or int(text) == 0:
        raise argparse.ArgumentTypeError(f"expected a whole number above 0, got {_shown(text)}")
    return int(text)


def number(text: str) -> float:
    """A number; -0.0 is 0.0, so that both give the same files."""
    try:
        return _float(text) + 0.0
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"expected a number, got {_shown(text)}") from error


def _float(text: str) -> float:
    """The number that a text spells; Python alone takes 1_000 and the digits of every script."""
    if "_" in text or not text.isascii():
        raise ValueError(text)
    return float(text)


def seconds(text: str) -> float:
    """A time above 0."""
    try:
        value = _float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"expected a number of seconds above 0, got {text!r}")
    return value


def share(text: str) -> float:
    """A fraction between 0 and 1, such as 1% or 0.01."""
    digits, percent, rest = text.partition("%")
    try:
        value = _float(digits) / (100.0 if percent else 1.0)
    except ValueError:
        value = 0.0
    if rest or not 0.0 < value < 1.0:
        raise argparse.ArgumentTypeError(
            f"expected a fraction between 0 and 1, such as 1% or 0.01, got {text!r}"
        )
    return value


def json_object(text: str) -> dict:
    """A JSON object with every key once."""
    try:
        value = json.loads(text, object_pairs_hook=_every_key_once)
    except (ValueError, RecursionError) as error:
        raise argparse.ArgumentTypeError(f"expected JSON, got {_shown(text)} ({error})") from error
    if not isinstance(value, dict):
        raise argparse.ArgumentTypeError(f"expected a JSON object such as {{}}, got {_shown(text)}")
    return value


def _every_key_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """The object of these keys and values.

    Raises:
        ValueError: a key stands twice.
    """
    found = dict(pairs)
    if len(found) < len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise ValueError(f"expected every key of an object once, got {twice!r} twice")
    return found


def _shown(text: str) -> str:
    """A text in a message, cut where it is long."""
    return repr(text) if len(text) <= 60 else f"{text[:57]!r}..."
