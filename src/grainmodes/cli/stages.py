"""Commands that compute: read a block, call the stage's function, write its block."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path

from grainmodes.configuration import ConfigurationError, check_point, stage_settings
from grainmodes.dataset.files import Block, BlockError, content_of, read_block, write_block
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.stage import Stage
from grainmodes.parameters.stages import STAGES
from grainmodes.stages import load


def compress(arguments: Namespace) -> None:
    """Random grains, or the checkpoint below → a checkpoint."""
    stage, keywords = _compression(arguments)
    keywords |= {name: getattr(arguments, name) for name in ("n", "seeds", "phi")}
    opened = _opened(arguments.start, stage) if arguments.start else nullcontext()
    with opened as start:
        block = load(stage.function)(start=start, **keywords)
    write_block(arguments.output, block)


def equilibrate(arguments: Namespace) -> None:
    """A checkpoint → packings."""
    stage, keywords = _compression(arguments)
    with _opened(arguments.start, STAGES[stage.reads]) as start:
        block = load(stage.function)(start=start, phi=arguments.phi, **keywords)
    write_block(arguments.output, block)


def _compression(arguments: Namespace) -> tuple[Stage, dict[str, object]]:
    """A stage of a compression, and the law and the choices that it takes."""
    stage = _stage(arguments)
    kt = arguments.kt if stage.needs_friction else 0.0
    check_point(getattr(arguments, "n", None), arguments.phi, kt)
    settings = stage_settings(arguments.settings, kt)
    law = {"law": settings.law} if stage.needs_friction else {"normal": settings.law.normal}
    return stage, law | stage.keywords(settings.protocol, settings.observables)


def _stage(arguments: Namespace) -> Stage:
    """The stage of a command."""
    return STAGES[arguments.name.replace("-", "_")]


def response(arguments: Namespace) -> None:
    """A block → the block of a stage of `parameters.stages`."""
    stage = _stage(arguments)
    check_point(kt=arguments.kt)
    if stage.needs_friction and not arguments.kt > 0.0:
        raise ConfigurationError(f"--kt: expected a number above 0, got {arguments.kt:g}")
    settings = stage_settings(arguments.settings, arguments.kt)
    keywords = stage.keywords(settings.protocol, settings.observables)
    kinds = STAGES["spectrum"].kinds
    if keywords.get("kind") == kinds[0]:
        expected = ", ".join(kinds[1:])
        raise ConfigurationError(f"observables.spectrum: expected one of {expected}, got 'none'")
    if stage.parallel:
        keywords["processes"] = arguments.processes
    with _opened(arguments.block, STAGES[stage.reads]) as block:
        if stage.resumable:
            _resume(stage, block, settings.law, keywords, arguments)
        else:
            write_block(arguments.output, load(stage.function)(block, settings.law, **keywords))


def _resume(
    stage: Stage, block: Block, law: ContactLaw, keywords: dict[str, object], arguments: Namespace
) -> None:
    """Compute a stage of long samples from its checkpoints, if there are any."""
    from grainmodes.stages.checkpoints import CheckpointFiles, fingerprint

    start = (law, keywords["choices"], fingerprint(block))
    every = arguments.checkpoint_every
    checkpoints: CheckpointFiles = CheckpointFiles(arguments.output, start, every)
    made = load(stage.function)(block, law, checkpoints=checkpoints, **keywords)
    write_block(arguments.output, made)
    checkpoints.discard()


def point(arguments: Namespace) -> None:
    """All observables of one point, without files between the stages."""
    from grainmodes.stages.point import point_block

    check_point(arguments.n, arguments.phi, arguments.kt)
    settings = stage_settings(_with_options(arguments), arguments.kt)
    block = point_block(
        arguments.n,
        arguments.phi,
        settings.law,
        arguments.seeds,
        settings.protocol,
        settings.observables,
        arguments.preparation,
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
def _opened(path: Path, stage: Stage) -> Iterator[Block]:
    """The block in a file, if that stage made it; errors about its content name the file."""
    block = read_block(path)
    if block.attributes.get("stage") != stage.output:
        raise BlockError(f"{path}: expected {stage.output}, got {content_of(block)}")
    try:
        yield block
    except BlockError as error:
        raise BlockError(f"{path}: {error}") from error
