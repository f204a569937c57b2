"""A scene against the schema: missing keys get their default, each mistake becomes one sentence.

`schemas/config.schema.yaml`, with a file of its own for every longer block, says type, range, unit
and meaning of every key, and its default where a key may be absent; a unit test holds these
defaults against those of `grainmodes.parameters`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from copy import deepcopy
from functools import cache
from pathlib import Path
from typing import Any

import yaml

from grainmodes.parameters.stages import observable_keys, responses

FOLDER = Path(__file__).with_name("schemas")

TYPES = {
    "integer": "a whole number",
    "number": "a number",
    "string": "a text",
    "boolean": "true or false",
    "object": "a block of keys",
}


@cache
def schema() -> dict:
    """The schema of a scene, as plain dictionaries; callers do not change it.

    The keys of `grids.observables` are those of the table of stages.
    """
    whole = _in_full({"$ref": "config.schema.yaml"})
    observables = whole["properties"]["grids"]["items"]["properties"]["observables"]
    observables["properties"] = observable_keys(responses())
    return whole


@cache
def settings_schema() -> dict:
    """The schema of the settings of a stage: its contact law, choices and observables."""
    keys = schema()["properties"]
    observables = keys["grids"]["items"]["properties"]["observables"]
    parts = {name: keys[name] for name in ("contact_law", "protocol")}
    return {
        "type": "object",
        "additionalProperties": False,
        "properties": parts | {"observables": observables},
    }


def point_rule(name: str) -> dict:
    """The rule of n, phi or kt of a single point."""
    return schema()["properties"]["grids"]["items"]["properties"][name]["items"]


def complete(value: Any, rule: dict) -> Any:
    """`value` with the defaults of its absent keys, and every number of the type of its key."""
    if isinstance(value, dict) and "properties" in rule:
        return _with_defaults(value, rule["properties"])
    if isinstance(value, list | tuple) and "items" in rule:
        return [complete(item, rule["items"]) for item in value]
    return _number(value, _types(rule))


def mistakes(value: object, rule: dict) -> list[str]:
    """One sentence per key that breaks its rule: the key, what is expected, its value."""
    from jsonschema import Draft202012Validator

    errors = Draft202012Validator(rule).iter_errors(value)
    ordered = sorted(errors, key=lambda error: [str(part) for part in error.absolute_path])
    return list(dict.fromkeys(line for error in ordered for line in _sentences(error)))


def expected(rule: dict) -> str:
    """What a rule expects, in words.

    >>> expected({"type": "number", "minimum": 0.0, "maximum": 10.0, "unit": "k_N"})
    'a number from 0.0 to 10.0 (k_N)'
    """
    if "enum" in rule:
        return f"one of {', '.join(map(str, rule['enum']))}"
    if "words" in rule:
        return rule["words"]
    if rule["type"] == "array":
        return f"a list, each item {expected(rule['items'])}"
    kind = " or ".join(TYPES[name] for name in _types(rule) if name != "null")
    if rule.get("multipleOf") == 2:
        kind = kind.replace("whole", "whole even")
    unit = f" ({rule['unit']})" if "unit" in rule else ""
    return f"{kind}{_range(rule)}{unit}"


def _in_full(rule: Any) -> Any:
    """A part of the schema with the file that `$ref` names in the place of every reference."""
    if not isinstance(rule, dict):
        return rule
    if "$ref" in rule:
        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
        return _in_full(yaml.load((FOLDER / rule["$ref"]).read_bytes(), Loader=loader))
    return {key: _in_full(item) for key, item in rule.items()}


def _with_defaults(value: dict, rules: dict) -> dict:
    defaults = {key: deepcopy(rule["default"]) for key, rule in rules.items() if "default" in rule}
    given = {key: item for key, item in value.items() if item is not None or key not in defaults}
    merged = defaults | given
    return {key: complete(item, rules.get(key, {})) for key, item in merged.items()}


def _types(rule: dict) -> list[str]:
    types = rule.get("type", [])
    return [types] if isinstance(types, str) else types


def _number(value: Any, types: list[str]) -> Any:
    """A number as the type that its rule wants; a value that is none, or is too large, as it is.

    A NaN becomes a text: it would pass every range, since all comparisons with it are false. Adding
    0 turns -0.0 into 0.0, so that both have the same path.
    """
    if not {"number", "integer"} & set(types) or not isinstance(value, int | float):
        return value
    if isinstance(value, bool) or ("integer" in types and isinstance(value, int)):
        return value
    try:
        number = float(value) + 0.0
    except OverflowError:
        return value
    if number != number:
        return "nan"
    return int(number) if "integer" in types and number.is_integer() else number


def _sentences(error: Any) -> Iterator[str]:
    key = _key(error.absolute_path)
    where = f"{key}: " if key else ""
    if error.validator == "additionalProperties":
        names = error.schema["properties"]
        for name in sorted(set(error.instance) - set(names), key=str):
            yield f"{where}unknown key {name!r}, expected one of {', '.join(names)}"
    elif error.validator == "required":
        for name in sorted(set(error.validator_value) - set(error.instance)):
            rule = error.schema["properties"][name]
            yield f"{where}key {name!r} is missing, expected {expected(rule)}"
    elif error.validator == "maxItems":
        yield f"{key}: expected at most {error.validator_value} items, got {len(error.instance)}"
    elif error.validator == "uniqueItems":
        twice = next(item for item in error.instance if error.instance.count(item) > 1)
        yield f"{where}duplicate value {twice!r}: values must be unique"
    else:
        what, got = expected(error.schema), _shown(error.instance)
        yield f"{key or 'the scene'}: expected {what}, got {got}"


def _key(path: Iterable[str | int]) -> str:
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return text.removeprefix(".")


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _range(rule: dict) -> str:
    low, high = rule.get("minimum"), rule.get("maximum")
    if "exclusiveMinimum" in rule:
        return f" above {rule['exclusiveMinimum']} and up to {high}"
    return "" if low is None else f" from {low} to {high}"
