"""The settings of a single stage, as its command gets them: a piece of a configuration.

    {"contact_law": {"normal": "harmonic"}, "protocol": {"rattlers": {"threshold": 1}}}

They have the defaults, ranges and messages that they have in a scene. What a stage does not depend
on may be there, and is checked all the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from grainmodes.configuration.choice_rules import choice_conflicts
from grainmodes.configuration.grid_rules import narrow_box
from grainmodes.configuration.mistakes import ConfigurationError
from grainmodes.configuration.schema import complete, mistakes, point_rule, settings_schema
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.stage import Observables


@dataclass(frozen=True)
class StageSettings:
    """A contact law, all numerical choices, and all observables."""

    law: ContactLaw
    protocol: Protocol
    observables: Observables


def stage_settings(given: Mapping, kt: float = 0.0) -> StageSettings:
    """The settings that a piece of a configuration gives at a tangential stiffness k_T/k_N.

    Raises:
        ConfigurationError: with a line for every mistake: the key, what is expected, its value.
    """
    full = complete(dict(given), settings_schema())
    found = mistakes(full, settings_schema()) or list(choice_conflicts(full, [kt]))
    if found:
        raise ConfigurationError("\n".join(found))
    law = ContactLaw(**full["contact_law"], kt=kt)
    return StageSettings(law, Protocol.from_config(full["protocol"]), full["observables"])


def check_point(n: int | None = None, phi: float | None = None, kt: float | None = None) -> None:
    """Refuse options `--n`, `--phi`, `--kt` that no scene may have; what is None is not checked.

    Raises:
        ConfigurationError: with a line for every mistake.
    """
    given = {"n": n, "phi": phi, "kt": kt}
    options = {f"--{name}": value for name, value in given.items() if value is not None}
    rules = {option: point_rule(option.removeprefix("--")) for option in options}
    rule = {"type": "object", "properties": rules}
    found = mistakes(complete(options, rule), rule)
    if not found and n is not None and phi is not None:
        found = list(narrow_box("--n", n, phi))
    if found:
        raise ConfigurationError("\n".join(found))
