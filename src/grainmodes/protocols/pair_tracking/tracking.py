"""Complex pairs along a quasistatic shear: born, followed, dead. C, Sec. V A.

From a frictionless balance, whose J is symmetric, the strain grows in steps Δγ. In every balance
the pairs are found and each is looked for among those of the step before (`pairs.following`). One
that was not there is born in this step; one that is no longer there has died in it.

| a birth or death is | where                                                                  |
| ------------------- | ---------------------------------------------------------------------- |
| a coalescence       | the contacts stayed what they were: J is analytic in γ, and two real    |
|                     | eigenvalues became a pair, or a pair two real ones                     |
| a jump              | the balance did not move on continuously                               |
| undecided           | contacts changed in the step, and it was not located                   |

The first ones are located (`exceptional_points`), which replaces this word by a measured one.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from grainmodes.complex_pairs.definition import DynamicalMatrix, translations
from grainmodes.complex_pairs.matching import matched
from grainmodes.packing.state import Packing
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.pair_tracking.detection import DETECTORS, Detector, Seen, seen_by
from grainmodes.protocols.pair_tracking.exceptional_points import (
    COALESCENCE,
    JUMP,
    LOST,
    NEVER,
    UNDECIDED,
    ExceptionalPoint,
    Side,
    located,
)
from grainmodes.protocols.pair_tracking.linear_range import Chosen, fastest_with_room
from grainmodes.protocols.shear.events import count_network_changes
from grainmodes.protocols.shear.strain_step import first_equilibrium, step_to
from grainmodes.relaxation.equilibrium_state import EquilibriumState


@dataclass
class Life:
    """A pair from its birth to its death; `largest` is the largest ω_i of all its states."""

    birth: tuple[float, float]
    birth_kind: int
    largest: float = 0.0
    death: tuple[float, float] = (np.nan, np.nan)
    death_kind: int = NEVER


class Located(NamedTuple):
    """A birth or death looked at closely: whose it is, and a state in which the pair is there."""

    life: int
    born: bool
    point: ExceptionalPoint
    pair: Side


class Count(NamedTuple):
    """One state of the walk in numbers: pairs of M⁻¹J and of J, the one of the largest ω_i.

    `of_jacobian` is NaN where it is not asked for; without a pair `fastest` is.
    """

    strain: float
    pairs: int
    of_jacobian: float
    fastest: complex
    condition: float
    dense: bool


@dataclass
class PairWalk:
    """How far a shear has come, and every pair on the way.

    `detector` looks for the pairs of K, `of_jacobian`, if there is one, for those of J.
    """

    now: Seen
    choices: Shear
    asked: PairChoices
    detector: Detector
    of_jacobian: Detector | None
    counts: list[Count] = field(default_factory=list)
    lives: list[Life] = field(default_factory=list)
    alive: list[int] = field(default_factory=list)
    located: list[Located] = field(default_factory=list)
    states: list[EquilibriumState] = field(default_factory=list)
    unstable: Chosen | None = None

    @classmethod
    def start(cls, packing: Packing, interaction, choices: Shear, asked: PairChoices) -> PairWalk:
        """A walk from a packing in balance.

        Raises:
            ArithmeticError: the packing has no stable balance.
        """
        equilibrium = first_equilibrium(packing, interaction, choices)
        detector, other = (DETECTORS[asked.detection]() for _ in range(2))
        of_jacobian = other if asked.jacobian else None
        walk = cls(seen_by(detector, equilibrium), choices, asked, detector, of_jacobian)
        walk.lives = [
            Life((np.nan, equilibrium.packing.strain), NEVER) for _ in walk.now.pairs.value
        ]
        walk.alive = list(range(len(walk.lives)))
        walk._count()
        return walk

    @property
    def done(self) -> bool:
        """Whether the last strain is reached."""
        return len(self.counts) > round(self.choices.strain / self.choices.step)

    def advance(self) -> None:
        """One step of the strain.

        Raises:
            ArithmeticError: no balance was found, or the eigensolver failed.
        """
        strain = len(self.counts) * self.choices.step
        equilibrium, jumped = step_to(strain, self.now.equilibrium, self.choices)
        before, self.now = self.now, seen_by(self.detector, equilibrium)
        self._follow(before, jumped)
        self._count()

    def _follow(self, before: Seen, jumped: bool) -> None:
        """Hand every life on to its pair in the new state; end some and begin some."""
        common = dict(matched(before.planes, self.now.planes))
        changed = any(count_network_changes(before.equilibrium, self.now.equilibrium))
        kind = JUMP if jumped else UNDECIDED if changed else COALESCENCE
        step = before.strain, self.now.strain
        heirs = {common[old]: life for old, life in enumerate(self.alive) if old in common}
        for old, life in enumerate(self.alive):
            if old not in common:
                self.lives[life].death, self.lives[life].death_kind = step, kind
                self._locate(life, before, old, self.now.equilibrium, jumped)
        for new in range(len(self.now.pairs.value)):
            if new not in heirs:
                heirs[new] = len(self.lives)
                self.lives.append(Life(step, kind))
                self._locate(heirs[new], self.now, new, before.equilibrium, jumped)
        self.alive = [heirs[new] for new in range(len(self.now.pairs.value))]

    def _locate(
        self, life: int, seen: Seen, place: int, other: EquilibriumState, jumped: bool
    ) -> None:
        """Look at a birth or death closely, if it is one of the first."""
        born = other.packing.strain < seen.strain
        known = sum(one.born == born for one in self.located)
        if jumped or known >= self.asked.max_located:
            return
        pair = seen.side(place)
        try:
            point = located(pair, other, self.choices, self.asked.bracket)
        except ArithmeticError:
            ends = sorted((pair.strain, other.packing.strain))
            point = ExceptionalPoint(LOST, *ends, float(np.mean(ends)))
        self.located.append(Located(life, born, point, pair))
        record, ends = self.lives[life], (point.below, point.above)
        if born:
            record.birth, record.birth_kind = ends, point.kind
        else:
            record.death, record.death_kind = ends, point.kind

    def _count(self) -> None:
        """Record the state."""
        self.states.append(self.now.equilibrium.without_factors())
        pairs = self.now.pairs
        growth = pairs.growth
        for life, rate in zip(self.alive, growth.tolist(), strict=True):
            self.lives[life].largest = max(self.lives[life].largest, rate)
        if not len(growth):
            self.counts.append(self._in_numbers(complex(np.nan, np.nan), np.nan))
            return
        place = int(np.argmax(growth))
        value, condition = complex(pairs.value[place]), float(pairs.condition[place])
        self.counts.append(self._in_numbers(value, condition))
        slower = self.unstable.growth if self.unstable else 0.0
        self.unstable = fastest_with_room(self.now, slower) or self.unstable

    def _in_numbers(self, fastest: complex, condition: float) -> Count:
        of_jacobian, equilibrium = np.nan, self.now.equilibrium
        if self.of_jacobian:
            null = translations(np.ones(equilibrium.backbone.n))
            loaded = DynamicalMatrix(equilibrium.matrix.tocsr(), null, equilibrium.backbone_mask)
            of_jacobian = len(self.of_jacobian.find(loaded).value)
        pairs, dense = len(self.now.pairs.value), self.detector.dense
        return Count(self.now.strain, pairs, of_jacobian, fastest, condition, dense)
