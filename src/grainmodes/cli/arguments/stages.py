"""Commands that compute: grains to checkpoints to packings, and what is measured on these."""

from __future__ import annotations

import argparse
from pathlib import Path

from grainmodes.cli.arguments import options
from grainmodes.parameters.law import NORMAL_LAWS, TANGENTIAL_LAWS
from grainmodes.parameters.spectra import SPECTRA


def define(commands) -> None:
    """Add these commands, in the order in which a sample passes them."""
    for add in (
        _compress,
        _pack,
        _rigidity,
        _step_strain,
        _spectrum,
        _fields,
        _probes,
        _shear,
        _event_detail,
        _pairs,
        _release,
        _variants,
        _point,
    ):
        add(commands)


def _compress(commands) -> None:
    command = options.command(
        commands, "compress", "stages:compress", "Compress grains to a checkpoint of a trajectory."
    )
    options.n(command)
    options.phi(command)
    options.seeds(command)
    command.add_argument(
        "--start",
        nargs="?",
        type=Path,
        metavar="FILE",
        help="the checkpoint below; without it the grains start at random places",
    )
    options.settings(command)
    options.output(command)


def _pack(commands) -> None:
    sentence = "Bring a checkpoint to an area fraction, in force balance."
    command = options.command(commands, "equilibrate", "stages:equilibrate", sentence)
    command.add_argument("start", type=Path, help="the checkpoint at or below --phi")
    options.phi(command)
    options.settings(command)
    options.output(command)


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
        "--processes",
        type=options.positive,
        default=1,
        help="processes that share the windows of a J",
    )


def _fields(commands) -> None:
    sentence = "Displacement fields and single eigenvectors of the first of some packings."
    _response(commands, "fields", "stages:fields", sentence)


def _probes(commands) -> None:
    sentence = "What single claims of paper A need, probed on packings."
    _response(commands, "claim-diagnostics", "stages:claim_diagnostics", sentence)


def _shear(commands) -> None:
    sentence = "Quasistatic shear of packings, with every event between two states."
    options.checkpoint_every(_response(commands, "shear", "stages:shear", sentence))


def _event_detail(commands) -> None:
    sentence = "The first event in the shear of the first of some packings, looked at closely."
    _response(commands, "event-detail", "stages:event_detail", sentence)


def _pairs(commands) -> None:
    sentence = "Complex pairs of eigenvalues along the shear of packings, born, followed, dead."
    _response(commands, "complex-pairs", "stages:complex_pairs", sentence)


def _release(commands) -> None:
    sentence = "Dynamics from the unstable states of sheared samples, without damping and with."
    command = options.command(commands, "release", "stages:release", sentence)
    command.add_argument("pairs", type=Path, help="file of `grainmodes complex-pairs`")
    options.kt(command)
    options.settings(command)
    options.checkpoint_every(command)
    options.output(command)


def _variants(commands) -> None:
    sentence = "Complex pairs of sheared packings under every tangential law, side by side."
    _response(commands, "law-comparison", "stages:law_comparison", sentence)


def _response(commands, name: str, run: str, sentence: str) -> argparse.ArgumentParser:
    command = options.command(commands, name, run, sentence)
    command.add_argument("packings", type=Path, help="file of `grainmodes equilibrate`")
    options.kt(command)
    options.settings(command)
    options.output(command)
    return command


def _point(commands) -> None:
    sentence = "Everything of one point of the grid, from random grains on, in one go."
    command = options.command(commands, "point", "stages:point", sentence)
    options.n(command)
    options.phi(command)
    options.kt(command)
    options.seeds(command)
    command.add_argument("--normal", choices=NORMAL_LAWS, help="normal law")
    command.add_argument("--tangential", choices=TANGENTIAL_LAWS, help="tangential law")
    command.add_argument("--friction-coefficient", type=float, metavar="MU", help="Coulomb's mu")
    command.add_argument("--spectrum", choices=SPECTRA, help="what to compute of the spectrum")
    options.settings(command)
    options.output(command)
