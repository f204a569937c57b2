"""Units as powers of force, length and mass, and their text under each normal law.

Every number in a file is in units of k_N = m = d = 1. What k_N measures depends on the normal law,
and with it the units of force f_0 and of time t_0:

    law        force               f_0            t_0 = (m d / f_0)^(1/2)
    hertz      f_N = k_N ξ^(3/2)   k_N d^(3/2)    (m / k_N)^(1/2) d^(-1/4)
    harmonic   f_N = k_N ξ         k_N d          (m / k_N)^(1/2)

A modulus in two dimensions is a force per length: k_N d^(1/2) or k_N.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

HALF = Fraction(1, 2)

FORCE_EXPONENT = {"hertz": Fraction(3, 2), "harmonic": Fraction(1)}
"""Normal law → a in f_0 = k_N d^a."""

FORCE_SPRINGS = ("elastic_force", "sharp_coulomb_force")
"""Tangential laws whose springs remember a force rather than a displacement."""


class Laws(NamedTuple):
    """Names of the laws on which units depend; empty where a file does not state them."""

    normal: str = ""
    tangential: str = ""


UNKNOWN = Laws()


@dataclass(frozen=True)
class Unit:
    """f_0^force d^length m^mass.

    `symbol` is its text under every law, for units that have a name of their own. `of_forces` is
    the unit that takes its place under the laws of `FORCE_SPRINGS`.
    """

    force: Fraction | int = 0
    length: Fraction | int = 0
    mass: Fraction | int = 0
    symbol: str = ""
    of_forces: Unit | None = None

    def under(self, laws: Laws) -> Unit:
        """The unit of a number that is stored under these laws."""
        return self.of_forces if self.of_forces and laws.tangential in FORCE_SPRINGS else self

    def text(self, laws: Laws = UNKNOWN) -> str:
        """How the unit is written: in k_N, d and m, or in f_0 where the normal law is unknown.

        >>> MODULUS.text(Laws("hertz")), MODULUS.text(Laws("harmonic")), MODULUS.text()
        ('k_N d^(1/2)', 'k_N', 'f_0 d^-1')
        """
        unit = self.under(laws)
        if unit.of_forces and not laws.tangential:
            return f"{unit._product(laws)} or {unit.of_forces.text(laws)}"
        return unit.symbol or unit._product(laws)

    def powers(self, normal: str) -> dict[str, Fraction]:
        """The powers of k_N, d and m in this unit.

        >>> {name: str(power) for name, power in TIME.powers("hertz").items()}
        {'k_N': '-1/2', 'd': '-1/4', 'm': '1/2'}
        """
        length = self.length + FORCE_EXPONENT[normal] * self.force
        powers: dict[str, Fraction | int] = {"k_N": self.force, "d": length, "m": self.mass}
        return {name: Fraction(power) for name, power in powers.items()}

    def _product(self, laws: Laws) -> str:
        powers: Mapping[str, Fraction | int]
        if laws.normal in FORCE_EXPONENT:
            powers = self.powers(laws.normal)
        else:
            powers = {"f_0": self.force, "d": self.length, "m": self.mass}
        return " ".join(_power(name, power) for name, power in powers.items() if power) or "1"


def _power(name: str, power: Fraction | int) -> str:
    if power == 1:
        return name
    return f"{name}^{power}" if Fraction(power).denominator == 1 else f"{name}^({power})"


def laws_of(config: dict) -> Laws:
    """The laws that the attribute `config` of a block, a point or an ensemble states.

    A block has `law`, or `normal` alone while there is no friction; an ensemble has `contact_law`;
    a point has the configuration of every stage by its name.
    """
    law = config.get("law") or config.get("contact_law") or {}
    normal = law.get("normal") or config.get("normal", "")
    if normal:
        return Laws(normal, law.get("tangential", ""))
    parts = (laws_of(part) for part in config.values() if isinstance(part, dict))
    return max(parts, key=lambda laws: sum(map(bool, laws)), default=Laws())


NUMBER = Unit(symbol="1")
ANGLE = Unit(symbol="rad")
SQUARED_ANGLE = Unit(symbol="rad^2")
BOX_FRACTION = Unit(symbol="2^-64 L")
LENGTH = Unit(length=1)
AREA = Unit(length=2)
MASS = Unit(mass=1)
FORCE = Unit(force=1)
MODULUS = Unit(force=1, length=-1)
ENERGY = Unit(force=1, length=1)
TIME = Unit(-HALF, HALF, HALF, symbol="t_0")
RATE = Unit(HALF, -HALF, -HALF, symbol="1/t_0")
SQUARED_RATE = Unit(1, -1, -1, symbol="1/t_0^2")
FOURTH_POWER_OF_RATE = Unit(2, -2, -2, symbol="1/t_0^4")
SPRING_STATE = Unit(length=1, of_forces=FORCE)
"""What a tangential spring remembers: its displacement, or its force."""
