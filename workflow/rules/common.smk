# The paths of the files of the scene, and the sources behind each stage.

import os
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

from grainmodes.parameters.figures import FIGURES, FORMS
from grainmodes.parameters.grid import (
    CHECKPOINT_SPACING,
    LOWEST_CHECKPOINT,
    checkpoint_at_or_below,
    format_value,
)
from grainmodes.parameters.stages import STAGES, responses
from grainmodes.runtime.failures import MACHINE_ERRORS, sentence
from grainmodes.runtime.provenance import script_sources, stage_sources
from grainmodes.runtime.workflow_run import name_to_jobs, start_run
from measurements.accuracy import NAMES

# A run claims its folder before it plans; what only looks (-n, --summary) has no cores, and does not.
if not workflow.subprocess_exec:
    name_to_jobs()
resources_given = workflow.resource_settings.cores or workflow.resource_settings.nodes
if workflow.is_main_process and resources_given and not workflow.output_settings.dryrun:
    try:
        start_run(Path("results") / scene.study)
    except MACHINE_ERRORS as error:
        raise WorkflowError(sentence(error))

# The command `grainmodes` of the Python that runs Snakemake, with its environment active or not.
os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])

STUDY = f"results/{scene.study}"
BLOCK = "n~{n}/phi~{phi}/seeds~{seeds}.nc"
RESPONSE = "n~{n}/phi~{phi}/kt~{kt}/seeds~{seeds}.nc"
POINT = "n~{n}/phi~{phi}/kt~{kt}.nc"
AT_POINT = "n = {wildcards.n}, phi = {wildcards.phi}, k_T = {wildcards.kt}"
AT = f"{AT_POINT}, seeds {{wildcards.seeds}}"
NUMBER = r"\d+(\.\d+)?(e[+-]?\d+)?"


wildcard_constraints:
    n=r"\d+",
    phi=NUMBER,
    kt=NUMBER,
    seeds=r"\d+-\d+",


def sources(*entries):
    """Files whose edit changes what a stage computes, written as a user would."""
    return as_written(stage_sources(*entries))


def as_written(paths):
    """Paths as a user would write them."""
    here = Path.cwd()
    return [str(p.relative_to(here) if p.is_relative_to(here) else p) for p in paths]


def source(path):
    """A file of the workflow as a user would write it, wherever the workflow was started."""
    return as_written([ROOT / path])[0]


def sources_of_accuracy(*modules):
    """Files whose edit changes what modules of `measurements/accuracy` do."""
    return as_written(
        script_sources(
            ROOT / "measurements/machine.py",
            *(ROOT / f"measurements/accuracy/{name}.py" for name in modules),
        )
    )


def sources_of_figure(wildcards):
    """What all figures share, and the module of this one."""
    room = FIGURES[wildcards.figure].room
    return sources("grainmodes.figures", f"grainmodes.figures.{room}.{wildcards.figure}")


def data_of_figure(wildcards):
    """What a figure is drawn from: the ensemble, or a stage's files of single samples."""
    source = FIGURES[wildcards.figure].source
    return rules.ensemble.output if source == "ensemble" else samples_of(source)


def stem_of_outputs(wildcards, output):
    """The path of pictures without their suffixes."""
    return output[0].rpartition(".")[0]


def checkpoint_below(wildcards, file=BLOCK):
    """The checkpoint that a checkpoint starts from; none for the lowest."""
    below = round(float(wildcards.phi) - CHECKPOINT_SPACING, 12)
    return [] if below < LOWEST_CHECKPOINT else checkpoint(wildcards, below, file)


def checkpoint_for(wildcards, file=BLOCK):
    """The checkpoint that packings start from."""
    return checkpoint(wildcards, checkpoint_at_or_below(float(wildcards.phi)), file)


def frictional_checkpoint_below(wildcards):
    """The same for a compression with friction, whose files belong to one k_T."""
    return checkpoint_below(wildcards, RESPONSE)


def frictional_checkpoint_for(wildcards):
    """The same for packings compressed with friction."""
    return checkpoint_for(wildcards, RESPONSE)


def checkpoint(wildcards, phi, file):
    names = dict(wildcards.items()) | {"phi": format_value(phi)}
    return f"{STUDY}/trajectories/{file}".format(**names)


def packings_file(wildcards):
    """The packings of a point: those compressed with friction belong to one k_T."""
    frictional = scene.preparation_of(*point_of(wildcards)) == "frictional"
    return f"{STUDY}/packings/{RESPONSE if frictional else BLOCK}"


def point_of(wildcards):
    """n, phi and k_T of a path."""
    return int(wildcards.n), float(wildcards.phi), float(wildcards.kt)


def blocks_of_point(wildcards):
    """Packings and responses of a point, all blocks of seeds, and its files of single samples."""
    point, names = point_of(wildcards), dict(wildcards.items())
    stages = [STAGES[stage] for stage in scene.responses(*point)]
    folders = [stage.output for stage in stages if not stage.single_sample]
    files = [packings_file(wildcards), *(f"{STUDY}/{folder}/{RESPONSE}" for folder in folders)]
    single = [f"{STUDY}/{stage.output}/{POINT}" for stage in stages if stage.single_sample]
    return expand(files, seeds=scene.blocks_of(*point), **names) + expand(single, **names)


def block_read_by(stage):
    """What a stage takes: the block of the same seeds, or the first one for a single sample."""
    read = STAGES[stage.reads]

    def block(wildcards):
        responses = f"{STUDY}/{read.output}/{RESPONSE}"
        path = responses if read.observable else packings_file(wildcards)
        first = {"seeds": scene.blocks_of(*point_of(wildcards))[0]} if stage.single_sample else {}
        return path.format(**dict(wildcards.items()) | first)

    return block


def output_of(stage):
    """The file of a rule: one for each block of seeds, or one for each point."""
    return f"{STUDY}/{stage.output}/{file_of(stage)}"


def file_of(stage):
    """The name of that file within the folder of its stage."""
    return POINT if stage.single_sample else RESPONSE


def message_of(stage):
    """What a job says when it starts."""
    return f"{stage.title} at {AT_POINT if stage.single_sample else AT}."


def settings_of(stage):
    """The settings of a stage, those of the point's grid where it depends on observables."""
    if not stage.parts("observables"):
        return scene.settings(stage.name)
    return lambda wildcards: scene.settings(stage.name, point_of(wildcards))


def files_of(room, points):
    """One file in a room of the study for each of these points."""
    names = ({key: format_value(value) for key, value in vars(p).items()} for p in points)
    return [f"{STUDY}/{room}/{POINT}".format(**name) for name in names]


def samples_of(name):
    """The files of a stage that single samples are drawn from: of every point that requests it."""
    return [f"{STUDY}/{path}" for path in scene.files_of(name)]


def figures():
    """Every file of every figure that the scene asks for."""
    films = [f"{STUDY}/figures/release_spirals.gif"] if "release_spirals" in scene.figures else []
    return films + [f"{STUDY}/figures/{name}.{form}" for name in scene.figures for form in FORMS]
