"""The keys of a scene file, read as YAML 1.2 (core schema).

YAML 1.1 takes the last of two equal keys, and reads `0100` as 64, `1:30` as 90, `no` as false,
`2024-01-01` as a date, `1_000` as 1000 and `1e-8` as a text. Here every key of a block stands once,
and a value is what its text shows: 100, the texts `1:30`, `no`, `2024-01-01` and `1_000`, and the
number 1e-8. There are no merge keys (`<<`); anchors and aliases are those of both versions.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, ClassVar

import yaml

from grainmodes.configuration.mistakes import ConfigurationError

MAX_BYTES = 200_000
"""Largest size of a scene file."""

MAX_VALUES, MAX_DEPTH = 100_000, 20
"""Largest number of values in a scene, and largest depth of its blocks, aliases written out."""

TAG = "tag:yaml.org,2002:"

CORE_SCHEMA = (
    ("null", r"~|null|Null|NULL|", ["~", "n", "N", ""]),
    ("bool", r"true|True|TRUE|false|False|FALSE", list("tTfF")),
    ("int", r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+", list("-+0123456789")),
    (
        "float",
        r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)",
        list("-+.0123456789"),
    ),
)
"""Type of a plain scalar, the texts that spell it, and their first characters."""


def read_config(path: str | Path) -> dict[str, Any]:
    """The keys of a YAML file, with text, numbers, booleans, lists and blocks as values.

    Raises:
        ConfigurationError: the file is missing, is too large, or is not YAML with keys at its top.
    """
    try:
        config = yaml.load(_text(Path(path)), Loader=_CoreLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        where = f"{path}, line {mark.line + 1}" if mark else path
        reason = " ".join(filter(None, (error.context, error.problem)))
        raise ConfigurationError(f"{where}: {reason}") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        reason = " ".join(str(error).split())
        raise ConfigurationError(f"{path}: expected YAML in UTF-8, got {reason}") from error
    except OSError as error:
        raise ConfigurationError(f"{path}: {(error.strerror or str(error)).lower()}") from error
    except RecursionError as error:
        raise ConfigurationError(_too_much(path)) from error
    if not isinstance(config, dict):
        raise ConfigurationError(f"{path}: expected the keys study and grids, got no keys")
    for count, depth in enumerate(_depths(config)):
        if count >= MAX_VALUES or depth > MAX_DEPTH:
            raise ConfigurationError(_too_much(path))
    return config


def scalar(text: str) -> Any:
    """The value that a plain text stands for, as in a scene file.

    >>> [scalar(text) for text in ("1e-8", "0100", "true", "no")]
    [1e-08, 100, True, 'no']
    """
    kinds = (kind for kind, pattern, _ in CORE_SCHEMA if re.fullmatch(pattern, text))
    return VALUES[next(kinds, "str")](text)


def _text(path: Path) -> str:
    with path.open("rb") as file:
        content = file.read(MAX_BYTES + 1)
    if len(content) > MAX_BYTES:
        raise ConfigurationError(
            f"{path}: expected a scene of at most {MAX_BYTES} bytes, got a longer file"
        )
    return content.decode("utf-8")


def _too_much(path: str | Path) -> str:
    return (
        f"{path}: expected at most {MAX_VALUES} values in blocks at most {MAX_DEPTH} deep, "
        "got more or deeper ones"
    )


def _depths(value: object, depth: int = 0) -> Iterator[int]:
    """The depth of every value, aliases written out; one too deep is not followed."""
    yield depth
    items = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    if depth <= MAX_DEPTH:
        for item in items:
            yield from _depths(item, depth + 1)


def _integer(text: str) -> int:
    return int(text, 0) if text[:2] in ("0o", "0x") else int(text)


def _float(text: str) -> float:
    return float(text.lower().replace(".inf", "inf").replace(".nan", "nan"))


VALUES: dict[str, Callable[[str], Any]] = {
    "null": lambda text: None,
    "bool": lambda text: text.lower() == "true",
    "int": _integer,
    "float": _float,
    "str": str,
}
"""Type of a scalar → its value from its text."""


class _CoreLoader(yaml.SafeLoader):
    """A loader of the core schema: no other tags, no merge keys, every key once."""

    yaml_implicit_resolvers: ClassVar[dict] = {}  # type: ignore[misc]
    yaml_constructors: ClassVar[dict] = {
        TAG + "map": yaml.SafeLoader.construct_yaml_map,
        TAG + "seq": yaml.SafeLoader.construct_yaml_seq,
        None: yaml.SafeLoader.construct_undefined,
    }

    def flatten_mapping(self, node: yaml.MappingNode) -> None:
        """Leave merge keys alone: YAML 1.2 has none."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict:
        """The block of a node.

        Raises:
            ConstructorError: a key is not a text, or stands twice.
        """
        seen: set[str] = set()
        for key, _ in node.value:
            name = self.construct_object(key, deep=True)
            if not isinstance(name, str):
                problem = f"expected a text as key, got {name!r}"
            elif name in seen:
                problem = f"expected every key of a block once, got {name!r} twice"
            else:
                seen.add(name)
                continue
            raise yaml.constructor.ConstructorError(None, None, problem, key.start_mark)
        return super().construct_mapping(node, deep)


def _scalar_of_type(kind: str) -> Callable[[_CoreLoader, yaml.ScalarNode], Any]:
    def construct(loader: _CoreLoader, node: yaml.ScalarNode) -> Any:
        text = str(loader.construct_scalar(node))
        try:
            return VALUES[kind](text)
        except ValueError:
            problem = f"expected a value of the type {kind}, got {text[:40]!r}"
            raise yaml.constructor.ConstructorError(None, None, problem, node.start_mark) from None

    return construct


for _kind in VALUES:
    _CoreLoader.add_constructor(TAG + _kind, _scalar_of_type(_kind))
for _kind, _pattern, _first in CORE_SCHEMA:
    _CoreLoader.add_implicit_resolver(TAG + _kind, re.compile(rf"^(?:{_pattern})$"), _first)
