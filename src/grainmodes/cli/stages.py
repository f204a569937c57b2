"""Commands that compute: read, call the stage's pure function, write."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path

from grainmodes.configuration import ConfigurationError, Scene, scene_of
from grainmodes.dataset.files import Block, BlockError, read_block, write_block
from grainmodes.parameters.fields import field_frequencies
from grainmodes.stages import packings as packing_stages

OPTIONS = {
    "grids[0].n[0]": "--n",
    "grids[0].phi[0]": "--phi",
    "grids[0].kt[0]": "--kt",
    "grids[0].n": "--n",
    "grids[0].observables": "observables",
    "contact_law.normal": "--normal",
    "contact_law.tangential": "--tangential",
    "contact_law.friction_coefficient": "--friction-coefficient",
}
"""Key of a configuration → the option that sets it here."""

ANY_POINT = {"n": [1024], "phi": [0.9], "kt": [0.0], "seeds": 1}
"""A valid grid, for commands that find the rest of their point in a file."""


def compress(arguments: Namespace) -> None:
    """Random grains, or the checkpoint below → a checkpoint."""
    scene = _scene(arguments.settings, n=arguments.n, phi=arguments.phi)
    opened = _opened(arguments.start, "trajectories") if arguments.start else nullcontext()
    with opened as start:
        block = packing_stages.compress_block(
            arguments.n,
            arguments.seeds,
            arguments.phi,
            scene.protocol.compression,
            scene.law.normal,
            start,
        )
    write_block(arguments.output, block)


def equilibrate(arguments: Namespace) -> None:
    """A checkpoint → packings."""
    scene = _scene(arguments.settings, phi=arguments.phi)
    compression, normal = scene.protocol.compression, scene.law.normal
    with _opened(arguments.start, "trajectories") as start:
        block = packing_stages.packing_block(start, arguments.phi, compression, normal)
    write_block(arguments.output, block)


def rigidity(arguments: Namespace) -> None:
    """Packings → rigidity."""
    scene = _scene(arguments.settings, kt=arguments.kt)
    law = scene.law_at(arguments.kt)
    with _opened(arguments.packings, "packings") as packings:
        block = packing_stages.rigidity_block(packings, law, scene.protocol.rattlers)
    write_block(arguments.output, block)


def step_strain(arguments: Namespace) -> None:
    """Packings → simulated rigidity."""
    scene = _scene(arguments.settings, kt=arguments.kt)
    law = scene.law_at(arguments.kt)
    with _opened(arguments.packings, "packings") as packings:
        block = packing_stages.step_strain_block(packings, law, scene.protocol.step_strain)
    write_block(arguments.output, block)


def spectrum(arguments: Namespace) -> None:
    """Packings → their spectra."""
    from grainmodes.stages.spectrum import hessian_block, rattlers_block, spectrum_block

    scene = _scene(arguments.settings, kt=arguments.kt)
    law, kind = scene.law_at(arguments.kt), scene.grids[0].observables.spectrum
    if kind == "none":
        raise ConfigurationError(
            "observables.spectrum: expected one of counts, binned_averages, eigenvalues, modes, "
            "got 'none'"
        )
    rattlers, choices = scene.protocol.rattlers, scene.protocol.spectrum
    processes = arguments.processes
    make = {
        "backbone": lambda of: spectrum_block(of, law, rattlers, kind, choices, processes),
        "rattlers": lambda of: rattlers_block(of, law, kind, choices, processes),
        "hessian": lambda of: hessian_block(of, law, rattlers, choices),
    }
    with _opened(arguments.packings, "packings") as packings:
        block = make[arguments.variant](packings)
    write_block(arguments.output, block)


def claim_diagnostics(arguments: Namespace) -> None:
    """Packings → what single claims need."""
    from grainmodes.stages.claim_diagnostics import claim_diagnostics_block

    scene = _scene(arguments.settings, kt=arguments.kt)
    with _opened(arguments.packings, "packings") as packings:
        block = claim_diagnostics_block(packings, scene.law_at(arguments.kt), scene.protocol)
    write_block(arguments.output, block)


def fields(arguments: Namespace) -> None:
    """Packings → fields of the first of them."""
    from grainmodes.stages.fields import fields_block

    scene = _scene(arguments.settings, kt=arguments.kt)
    law, protocol = scene.law_at(arguments.kt), scene.protocol
    frequencies = field_frequencies(arguments.kt)
    with _opened(arguments.packings, "packings") as packings:
        block = fields_block(packings, law, protocol.rattlers, protocol.step_strain, frequencies)
    write_block(arguments.output, block)


def shear(arguments: Namespace) -> None:
    """Packings → their curves of stress and strain, and their events."""
    from grainmodes.stages.checkpoints import CheckpointFiles, fingerprint, shear_progress
    from grainmodes.stages.shear import shear_block

    scene = _scene(arguments.settings, kt=arguments.kt)
    law, choices = scene.law_at(arguments.kt), scene.protocol.shear
    coarse_run = scene.grids[0].observables.coarse_run
    with _opened(arguments.packings, "packings") as packings:
        start = law, choices, fingerprint(packings)
        checkpoints = CheckpointFiles(
            arguments.output, start, arguments.checkpoint_every, shear_progress
        )
        block = shear_block(packings, law, choices, coarse_run, checkpoints)
    write_block(arguments.output, block)
    checkpoints.discard()


def event_detail(arguments: Namespace) -> None:
    """Packings → the first event of the first of them, looked at closely."""
    from grainmodes.stages.event_detail import event_detail_block

    scene = _scene(arguments.settings, kt=arguments.kt)
    law = scene.law_at(arguments.kt)
    with _opened(arguments.packings, "packings") as packings:
        block = event_detail_block(packings, law, scene.protocol.shear)
    write_block(arguments.output, block)


def complex_pairs(arguments: Namespace) -> None:
    """Packings → complex pairs along their shear."""
    from grainmodes.stages.complex_pairs import complex_pairs_block

    scene = _scene(arguments.settings, kt=arguments.kt)
    law, protocol = scene.law_at(arguments.kt), scene.protocol
    with _opened(arguments.packings, "packings") as packings:
        block = complex_pairs_block(packings, law, protocol.shear, protocol.complex_pairs)
    write_block(arguments.output, block)


def release(arguments: Namespace) -> None:
    """Samples with their complex pairs → what becomes of their unstable states."""
    from grainmodes.stages.checkpoints import CheckpointFiles, fingerprint, release_progress
    from grainmodes.stages.release import release_block

    scene = _scene(arguments.settings, kt=arguments.kt)
    law, choices = scene.law_at(arguments.kt), scene.protocol.release
    with _opened(arguments.pairs, "complex_pairs") as pairs:
        start = law, choices, fingerprint(pairs)
        every = arguments.checkpoint_every
        checkpoints = CheckpointFiles(arguments.output, start, every, release_progress)
        block = release_block(pairs, law, choices, checkpoints)
    write_block(arguments.output, block)
    checkpoints.discard()


def law_comparison(arguments: Namespace) -> None:
    """Packings → their complex pairs under every tangential law."""
    from grainmodes.stages.law_comparison import law_comparison_block

    scene = _scene(arguments.settings, kt=arguments.kt)
    law = scene.law_at(arguments.kt)
    with _opened(arguments.packings, "packings") as packings:
        block = law_comparison_block(packings, law, scene.protocol.shear)
    write_block(arguments.output, block)


def point(arguments: Namespace) -> None:
    """Everything of one point, without files between."""
    from grainmodes.stages.point import point_block

    settings = _with_options(arguments)
    scene = _scene(settings, n=arguments.n, phi=arguments.phi, kt=arguments.kt)
    block = point_block(
        arguments.n,
        arguments.phi,
        scene.law_at(arguments.kt),
        arguments.seeds,
        scene.protocol,
        scene.grids[0].observables.spectrum,
    )
    write_block(arguments.output, block)


def _with_options(arguments: Namespace) -> dict:
    """The settings, with the laws and the spectrum that options name."""
    law = {
        "normal": arguments.normal,
        "tangential": arguments.tangential,
        "friction_coefficient": arguments.friction_coefficient,
    }
    named = {key: value for key, value in law.items() if value is not None}
    observables = {"spectrum": arguments.spectrum} if arguments.spectrum else {}
    settings = arguments.settings
    return settings | {
        "contact_law": settings.get("contact_law", {}) | named,
        "observables": settings.get("observables", {}) | observables,
    }


@contextmanager
def _opened(path: Path, stage: str) -> Iterator[Block]:
    """The block in a file, if that stage made it; errors about its content name the file."""
    block = read_block(path)
    found = block.attributes.get("stage", "something else")
    if found != stage:
        raise BlockError(f"{path}: expected {stage}, got {found}")
    try:
        yield block
    except BlockError as error:
        raise BlockError(f"{path}: {error}") from error


def _scene(settings: dict, **point: float) -> Scene:
    """The scene of one point: the same defaults, ranges and messages as for a whole study."""
    grid = ANY_POINT | {name: [value] for name, value in point.items()}
    if "observables" in settings:
        grid["observables"] = settings["observables"]
    rest = {key: value for key, value in settings.items() if key != "observables"}
    try:
        return scene_of({**rest, "study": "by-hand", "grids": [grid]})
    except ConfigurationError as error:
        message = str(error)
        for key, option in OPTIONS.items():
            message = message.replace(key, option)
        raise ConfigurationError(message) from error
