"""Make a finished study a reference ensemble of the package: `make reference CONFIG=…`.

Its ensemble and its files of single samples are reduced and entered into the index with the scene,
the version of the code, and their SHA-256.
"""

from __future__ import annotations

import sys
from pathlib import Path

import yaml

from grainmodes.configuration import ConfigurationError, scene_from
from grainmodes.ensemble.reference import FOLDER, write_reference
from grainmodes.parameters.figures import FIGURES


def main(path: str) -> None:
    """Reduce the results of one scene.

    Raises:
        SystemExit: the scene has mistakes, or its study is not finished.
    """
    try:
        scene = scene_from(yaml.safe_load(Path(path).read_text(encoding="utf-8")))
    except ConfigurationError as error:
        raise SystemExit(f"{path}: the configuration has mistakes.\n{error}") from error
    results = Path("results") / scene.study
    if not (results / "ensemble.nc").is_file():
        raise SystemExit(f"{results}: expected a finished study, got no ensemble.nc")
    stages = {FIGURES[name].source for name in scene.figures} - {"ensemble"}
    sources = {"ensemble": [results / "ensemble.nc"]}
    sources |= {stage: sorted((results / stage).rglob("*.nc")) for stage in sorted(stages)}
    made = write_reference(Path(path), list(scene.figures), sources)
    size = sum(file.stat().st_size for file in (FOLDER / made.study).iterdir())
    print(f"{FOLDER / made.study}: {size / 1e6:.1f} MB, by {made.code_version}")


if __name__ == "__main__":
    main(sys.argv[1])
