# The folder of the workflow, and the validated scene of the study.
#
# Snakemake reads YAML 1.1, in which 0100 is 64, 1:30 is 90, 1e-8 is a text, and the last of two equal
# keys wins. So the scene is read once more from its files, as YAML 1.2; what Snakemake has read says
# only which part of them is the scene, where another workflow uses this one as a module.

import os
from pathlib import Path

from snakemake.common.configfile import load_configfile
from snakemake.exceptions import WorkflowError
from snakemake.utils import update_config

from grainmodes.configuration import ConfigurationError, read_config, scalar, scene_from
from grainmodes.cost import check_budget, read_table

# Results lie in the working directory; the sources, and the default scene, lie here.
ROOT = Path(str(workflow.current_basedir)).parents[1]
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))

# Snakemake would merge a scene of the command line into the default one, key by key.
if not workflow.config_settings.configfiles:

    configfile: str(ROOT / "config/default.yaml")


def keys_of_scene(loaded_by_snakemake):
    """The keys of the scene, read as YAML 1.2."""
    of_command_line = list(workflow.config_settings.configfiles)
    of_workflows = [file for file in workflow.configfiles if file not in of_command_line]
    loaded, read = {}, {}
    for file in [*of_workflows, *of_command_line]:
        update_config(loaded, load_configfile(file))
        update_config(read, read_config(file))
    overrides = dict(workflow.config_settings.config)
    update_config(loaded, overrides)
    update_config(read, plain(overrides))
    same = same_part(loaded_by_snakemake, loaded, read)
    return dict(loaded_by_snakemake) if same is None else same


def same_part(wanted, loaded, read):
    """The part of `read` at the place where `loaded` has what is wanted; None if it is nowhere."""
    if loaded == wanted:
        return read
    places = (key for key, part in loaded.items() if isinstance(part, dict))
    parts = (same_part(wanted, loaded[key], read[key]) for key in places)
    return next((part for part in parts if part is not None), None)


def plain(value):
    """Values of `--config`, of which Snakemake leaves those within lists and blocks as texts."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [plain(item) for item in value]
    return scalar(value) if isinstance(value, str) else value


COSTS = read_table()

try:
    scene = scene_from(keys_of_scene(config))
    check_budget(scene, COSTS)
except ConfigurationError as error:
    raise WorkflowError(f"The configuration has mistakes.\n{error}")
