"""The reference ensembles that come with the package, from which figures and claims can be made.

A reference holds what a finished study gave, reduced to a few megabytes: long series (modes, states
of a shear, frames of a release) are rounded to DIGITS significant digits and compressed, numbers
of one per sample are kept as they are. The index says which scene and which code made it, and the
SHA-256 of every file, which is checked before a file is read.
"""

from __future__ import annotations

import hashlib
import shutil
from dataclasses import asdict, dataclass
from pathlib import Path

import yaml

from grainmodes.dataset.checksum import NAME as CHECKSUM
from grainmodes.dataset.files import BlockError, new_file, opened_file
from grainmodes.dataset.library import netCDF4
from grainmodes.runtime.atomic import replaced

FOLDER = Path(__file__).with_name("references")
"""Folder of the package that holds the references."""

INDEX = "index.yaml"

DIGITS = 5
"""Significant digits of long series: finer than a hundredth of a bin of any figure."""

SERIES_LENGTH = 10
"""Length of the last axis of an array from which it is a long series."""


@dataclass(frozen=True)
class Reference:
    """A study among the references.

    `files` maps a source ("ensemble", or a stage of single samples) to file → SHA-256; `figures`
    are those that the study's scene asks for.
    """

    study: str
    scene: str
    code_version: str
    figures: list[str]
    files: dict[str, dict[str, str]]


def references() -> dict[str, Reference]:
    """Study → reference, in the order of the index; empty where there is no index."""
    index = FOLDER / INDEX
    if not index.is_file():
        return {}
    entries = yaml.safe_load(index.read_text(encoding="utf-8")) or {}
    return {study: Reference(study, **entry) for study, entry in entries.items()}


def reference_with(figure: str, study: str | None = None) -> Reference:
    """The requested reference, or the first one whose study draws a figure.

    Raises:
        ValueError: there is none.
    """
    found = references()
    if study is not None:
        return reference_named(study)
    for reference in found.values():
        if figure in reference.figures:
            return reference
    raise ValueError(f"no reference ensemble draws the figure {figure}: there are {_list(found)}")


def reference_named(study: str) -> Reference:
    """The reference of a study.

    Raises:
        ValueError: there is none.
    """
    found = references()
    if study not in found:
        raise ValueError(f"reference: expected one of {_list(found)}, got {study!r}")
    return found[study]


def files_of(reference: Reference, source: str) -> list[Path]:
    """The files of a source, after their SHA-256 has been checked.

    Raises:
        BlockError: the reference has no such files, or one of them is not what the index says.
    """
    listed = reference.files.get(source, {})
    if not listed:
        raise BlockError(f"the reference {reference.study} holds no {source}")
    for name, expected in listed.items():
        path = FOLDER / reference.study / name
        if not path.is_file():
            raise BlockError(f"{path}: no such file, although {INDEX} lists it")
        if _sha256(path) != expected:
            raise BlockError(f"{path}: expected the SHA-256 {expected}, got {_sha256(path)}")
    return [FOLDER / reference.study / name for name in listed]


def write_reference(scene: Path, figures: list[str], sources: dict[str, list[Path]]) -> Reference:
    """Reduce the files of a finished study, and enter it into the index.

    Args:
        scene: the study's YAML file, of which a copy is kept.
        figures: names of the figures that the study draws.
        sources: "ensemble" or a stage of single samples → its files.

    Raises:
        BlockError: a file cannot be read, or is damaged.
        OSError: a file cannot be written.
    """
    study = yaml.safe_load(scene.read_text(encoding="utf-8"))["study"]
    home, new = FOLDER / study, FOLDER / f".{study}.partial"
    shutil.rmtree(new, ignore_errors=True)
    files: dict[str, dict[str, str]] = {}
    for source, paths in sources.items():
        for number, path in enumerate(paths):
            name = f"{source}.nc" if source == "ensemble" else f"{source}_{number}.nc"
            reduce(path, new / name)
            files.setdefault(source, {})[name] = _sha256(new / name)
    shutil.copyfile(scene, new / "scene.yaml")
    with opened_file(sources["ensemble"][0]) as ensemble:
        code_version = str(ensemble.code_version)
    shutil.rmtree(home, ignore_errors=True)
    new.replace(home)
    made = Reference(study, "scene.yaml", code_version, sorted(figures), files)
    entries = references() | {study: made}
    index = {
        name: {k: v for k, v in asdict(entry).items() if k != "study"}
        for name, entry in sorted(entries.items())
    }
    with replaced(FOLDER / INDEX) as partial:
        partial.write_text(yaml.safe_dump(index, sort_keys=True), encoding="utf-8")
    return made


def reduce(source: Path, target: Path) -> None:
    """Copy a netCDF file, its long series rounded to DIGITS digits, all of it compressed."""
    with opened_file(source) as old, new_file(target) as new:
        for name, dimension in old.dimensions.items():
            new.createDimension(name, len(dimension))
        for name, variable in old.variables.items():
            variable.set_auto_maskandscale(False)
            _copy(variable, new, name)
        kept = [name for name in old.ncattrs() if name != CHECKSUM]
        new.setncatts({name: old.getncattr(name) for name in kept})


def _copy(variable: netCDF4.Variable, file: netCDF4.Dataset, name: str) -> None:
    is_long = variable.ndim > 1 and variable.shape[-1] >= SERIES_LENGTH
    storage: dict = {}
    if variable.ndim:
        storage |= {"zlib": True, "complevel": 9, "shuffle": True}
    if is_long and variable.dtype.kind == "f":
        storage |= {"significant_digits": DIGITS, "quantize_mode": "GranularBitRound"}
    attributes = {key: variable.getncattr(key) for key in variable.ncattrs()}
    fill = attributes.pop("_FillValue", None)
    copy = file.createVariable(
        name, variable.dtype, variable.dimensions, fill_value=fill, **storage
    )
    copy.set_auto_maskandscale(False)
    copy.setncatts(attributes)
    copy[...] = variable[...]


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _list(found: dict[str, Reference]) -> str:
    return ", ".join(found) if found else "none"
