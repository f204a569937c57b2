"""From a configuration file to a validated scene.

A configuration is a dictionary with the keys of `schemas/config.schema.yaml`. `complete` fills in
the defaults, the schema and then `rules` judge it, and what passes becomes a frozen `Scene`.
"""

from __future__ import annotations

from pathlib import Path

from grainmodes.configuration import rules
from grainmodes.configuration.grids import Grid
from grainmodes.configuration.mistakes import ConfigurationError
from grainmodes.configuration.scene import Scene
from grainmodes.configuration.schema import complete, mistakes, schema
from grainmodes.configuration.stage_settings import StageSettings, check_point, stage_settings

__all__ = [
    "ConfigurationError",
    "Grid",
    "Scene",
    "StageSettings",
    "check_point",
    "read_scene",
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
        ConfigurationError: the file is missing or is not YAML, or what `scene_from` raises.
    """
    import yaml

    try:
        config = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        reason = " ".join(str(error).split())
        raise ConfigurationError(f"{path}: not a readable YAML file ({reason})") from error
    if not isinstance(config, dict):
        raise ConfigurationError(f"{path}: expected the keys study and grids, got no keys")
    return scene_from(config)
