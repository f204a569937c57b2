"""Which code made a result: the sources behind a stage, and fingerprints of the code.

Snakemake does not notice an edit in an imported module, and numba's cache on disk does not notice
one in a function that is called from another file. This module finds the sources that matter for
both. It reads the text of the sources and follows their import statements, also those inside
functions; nothing is imported.
"""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from grainmodes import __version__

PACKAGE = Path(__file__).resolve().parents[1]
"""The folder of the package `grainmodes`."""

DATA = (".mplstyle", ".yaml")
"""Suffixes of the data files in the folders of packages."""


def source_hash() -> str:
    """Fingerprint of every Python file of the package: 12 hexadecimal digits."""
    return _fingerprint(PACKAGE.rglob("*.py"))


def kernel_hash() -> str:
    """Fingerprint of all code that numba compiles: the kernels and the constants they may freeze.

    An edit elsewhere, such as in a figure, does not change it, so that the kernels are not compiled
    again.
    """
    return _fingerprint([*(PACKAGE / "kernels").rglob("*.py"), PACKAGE / "parameters" / "law.py"])


def code_version() -> str:
    """Version of the package and fingerprint of its sources, such as `0.1.0+3f2a90c1d4e5`."""
    return f"{__version__}+{source_hash()}"


def stage_sources(*entries: str) -> list[Path]:
    """The files whose edit can change what a stage computes, sorted.

    Args:
        entries: `package.module`, or `package.module:function`. Of the module of a function, only
            the imports that the function can reach count; of every other module all imports count,
            and of a package also the data files in its folder.

    Raises:
        ModuleNotFoundError: an entry names no module of the package.
        AttributeError: an entry names a function that its module does not define.
    """
    found: set[Path] = set()
    for entry in entries:
        module, _, function = entry.partition(":")
        path = _file(module)
        if path is None:
            raise ModuleNotFoundError(f"{entry}: expected a module in {PACKAGE}, got {module}")
        nodes = _reached(path, function) if function else [_tree(path)]
        found |= _closure(_imports(nodes)) | set(_files(module))
    return _with_data(found)


def script_sources(*scripts: Path) -> list[Path]:
    """Scripts outside the package, and the files of it whose edit can change what they do."""
    found = _closure(_imports(_tree(script) for script in scripts))
    return [*scripts, *_with_data(found)]


def _with_data(found: set[Path]) -> list[Path]:
    return sorted(found | {data for path in found for data in _data_of(path)})


def _fingerprint(paths: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for path in sorted(paths):
        digest.update(f"{path.relative_to(PACKAGE).as_posix()}\0".encode())
        digest.update(path.read_bytes() + b"\0")
    return digest.hexdigest()[:12]


def _closure(start: set[Path]) -> set[Path]:
    found, waiting = set(start), list(start)
    while waiting:
        new = _imports_of_module(waiting.pop()) - found
        found |= new
        waiting += new
    return found


@cache
def _imports_of_module(path: Path) -> frozenset[Path]:
    return frozenset(_imports([_tree(path)]))


def _imports(nodes: Iterable[ast.AST]) -> set[Path]:
    """Files of the package that the import statements within `nodes` execute."""
    modules = [name for node in nodes for name in _imported_names(node)]
    return {path for module in modules for path in _files(module)}


def _imported_names(node: ast.AST) -> Iterator[str]:
    for child in ast.walk(node):
        if isinstance(child, ast.Import):
            yield from (alias.name for alias in child.names)
        elif isinstance(child, ast.ImportFrom) and child.module:
            # `from package import name` executes package/name.py where there is one.
            yield from (f"{child.module}.{alias.name}" for alias in child.names)


def _files(module: str) -> Iterator[Path]:
    """Files of this package that `import module` executes: the module's and its parents'."""
    parts = module.split(".")
    paths = (_file(".".join(parts[:depth])) for depth in range(1, len(parts) + 1))
    return (path for path in paths if path is not None)


def _file(module: str) -> Path | None:
    top, *rest = module.split(".")
    base = PACKAGE.joinpath(*rest)
    candidates = (base / "__init__.py", base.with_name(f"{base.name}.py"))
    return next((path for path in candidates if top == PACKAGE.name and path.is_file()), None)


def _data_of(path: Path) -> Iterator[Path]:
    beside = path.parent.iterdir() if path.name == "__init__.py" else ()
    return (other for other in beside if other.suffix in DATA)


@cache
def _tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


def _reached(path: Path, function: str) -> list[ast.stmt]:
    """Top-level statements of a module that `function` depends on, including imports and itself."""
    definitions: dict[str, list[ast.stmt]] = {}
    for statement in _tree(path).body:
        for name in _bound_names(statement):
            definitions.setdefault(name, []).append(statement)
    if function not in definitions:
        raise AttributeError(f"{path}: expected a definition of {function}, got none")
    reached: list[ast.stmt] = []
    waiting = list(definitions[function])
    while waiting:
        statement = waiting.pop()
        if statement not in reached:
            reached.append(statement)
            names = {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
            waiting += [other for name in sorted(names) for other in definitions.get(name, ())]
    return reached


def _bound_names(statement: ast.stmt) -> set[str]:
    """Names that a top-level statement of a module binds."""
    if isinstance(statement, ast.FunctionDef | ast.ClassDef):
        return {statement.name}
    if isinstance(statement, ast.Import | ast.ImportFrom):
        return {(alias.asname or alias.name).split(".")[0] for alias in statement.names}
    return {
        node.id
        for node in ast.walk(statement)
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
