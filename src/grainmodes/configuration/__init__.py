"""From a configuration file to a validated scene.

A configuration is a dictionary with the keys of `schemas/config.schema.yaml`. `complete` fills in
the defaults, the schema and then `rules` judge it, and what passes becomes a frozen `Scene`.
"""

from __future__ import annotations

from pathlib import Path

from grainmodes.configuration import rules
from grainmodes.configuration.grids import Grid
from grainmodes.configuration.mistakes import ConfigurationError
from grainmodes.configuration.reading import read_config, scalar
from grainmodes.configuration.scene import Scene
from grainmodes.configuration.schema import complete, mistakes, schema
from grainmodes.configuration.stage_settings import StageSettings, check_point, stage_settings

__all__ = [
    "ConfigurationError",
    "Grid",
    "Scene",
    "StageSettings",
    "check_point",
    "read_config",
    "read_scene",
    "scalar",
    "scene_from",
    "stage_settings",
]


def scene_from(config: dict) -> Scene:
    """The scene that a configuration describes.

    Raises:
        ConfigurationError: with a line for every mistake: the key, what is expected, its value.
    """
    full = complete(config, schema())
    found = mistakes(full, schema()) or list(rules.conflicts(full))
    if found:
        raise ConfigurationError("\n".join(found))
    return Scene.from_config(full)


def read_scene(path: str | Path) -> Scene:
    """The scene of a YAML file.

    Raises:
        ConfigurationError: what `read_config` or `scene_from` raises.
    """
    return scene_from(read_config(path))
