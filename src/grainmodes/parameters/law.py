"""The contact law of a scene, and which grains it calls rattlers."""

from __future__ import annotations

from dataclasses import dataclass

NORMAL_LAWS = ("hertz", "harmonic")
ELASTIC_LAWS = ("elastic", "elastic_force")
COULOMB_LAWS = ("smoothed_coulomb", "sharp_coulomb", "sharp_coulomb_force")
TANGENTIAL_LAWS = ELASTIC_LAWS + COULOMB_LAWS


@dataclass(frozen=True)
class ContactLaw:
    """The force between two touching grains; `kt = 0` is frictionless, whatever `tangential`."""

    normal: str = "hertz"
    tangential: str = "elastic"
    kt: float = 0.0
    friction_coefficient: float | None = None

    @property
    def frictional(self) -> bool:
        """Whether rotation and tangential force exist at all."""
        return self.kt > 0.0


@dataclass(frozen=True)
class Rattlers:
    """A grain with at most `threshold` contacts is a rattler (Z_Th of A, App. E)."""

    threshold: int = 2

    def largest(self, law: ContactLaw, springs_at_rest: bool = True) -> int:
        """Most contacts of a rattler.

        Without friction two contacts carry no load, whatever is asked. Where friction has loaded
        the springs, two contacts can hold a grain, which then is not a rattler.
        """
        if not springs_at_rest:
            return min(self.threshold, 1)
        return self.threshold if law.frictional else max(self.threshold, 2)
