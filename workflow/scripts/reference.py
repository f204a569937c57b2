"""Make a finished study a reference ensemble of the package: `make reference CONFIG=…`.

Its ensemble and its files of single samples are reduced and entered into the index with the scene,
the version of the code, and their SHA-256.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import yaml

from grainmodes.configuration import ConfigurationError, Scene, scene_from
from grainmodes.dataset.files import opened_file
from grainmodes.ensemble import reference
from grainmodes.parameters.figures import FIGURES, FORMS


def main(arguments: list[str]) -> None:
    """Reduce the results of one scene.

    Raises:
        SystemExit: no scene is given, the scene has mistakes, or its study is not finished.
    """
    if len(arguments) != 1:
        raise SystemExit("make reference: expected CONFIG=config/<scene>.yaml")
    path = Path(arguments[0])
    try:
        scene = scene_from(yaml.safe_load(path.read_text(encoding="utf-8")))
    except OSError as error:
        raise SystemExit(f"{path}: {error.strerror}") from error
    except (yaml.YAMLError, ConfigurationError) as error:
        raise SystemExit(f"{path}: the configuration has mistakes.\n{error}") from error
    results = Path("results") / scene.study
    stages = sorted({FIGURES[name].source for name in scene.figures} - {"ensemble"})
    sources = {"ensemble": [results / "ensemble.nc"]}
    sources |= {stage: [results / file for file in scene.files_of(stage)] for stage in stages}
    check_finished(scene, results, [file for files in sources.values() for file in files])
    made = reference.write_reference(path, list(scene.figures), sources)
    folder = reference.FOLDER / made.study
    size = sum(file.stat().st_size for file in folder.iterdir())
    print(f"{folder}: {size / 1e6:.1f} MB, by {made.code_version}")


def check_finished(scene: Scene, results: Path, files: list[Path]) -> None:
    """Check that a study has all its results, and that they belong to the scene.

    Raises:
        SystemExit: a file is missing, or the ensemble was made with other settings.
    """
    pictures = [results / f"figures/{name}.{form}" for name in scene.figures for form in FORMS]
    for file in [*files, results / "checks.txt", results / "claims.md", *pictures]:
        if not file.is_file():
            raise SystemExit(f"{results}: expected a finished study, got no {file}")
    with opened_file(results / "ensemble.nc") as ensemble:
        if json.loads(ensemble.config) != json.loads(scene.summary()):
            raise SystemExit(f"{results}: expected results of this scene, got those of another one")


if __name__ == "__main__":
    main(sys.argv[1:])
