"""Complex pairs along a quasistatic shear: their births, tracks and deaths. C, Sec. V A.

The shear begins in a frictionless equilibrium, whose J is symmetric, and the strain grows in steps
Δγ. In every state all pairs are found and matched with those of the step before
(`complex_pairs.matching`). A pair without a partner in the step before was born in this step; a
pair of the step before without a partner in this one has died.

| a birth or death is | where                                                                  |
| ------------------- | ---------------------------------------------------------------------- |
| a coalescence       | the contacts stayed the same: J is analytic in γ, and two real          |
|                     | eigenvalues became a pair, or a pair two real ones                     |
| a jump              | the equilibrium did not move on continuously                           |
| undecided           | contacts changed in the step, and it was not located                   |

The first births and deaths are located as exceptional points (`exceptional_points`), which replaces
this kind by a measured one.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from grainmodes.complex_pairs.definition import DynamicalMatrix, translations
from grainmodes.complex_pairs.matching import match_pairs
from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.failures import NUMERICAL_ERRORS
from grainmodes.packing.state import Packing
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.pair_tracking.detection import (
    DETECTORS,
    Detector,
    PairState,
    detect_pairs,
)
from grainmodes.protocols.pair_tracking.exceptional_points import (
    COALESCENCE,
    FAILED,
    JUMP,
    NEVER,
    UNDECIDED,
    ExceptionalPoint,
    TwoModeState,
    locate_exceptional_point,
)
from grainmodes.protocols.pair_tracking.release_candidates import ReleaseCandidates
from grainmodes.protocols.shear.events import count_network_changes
from grainmodes.protocols.shear.strain_step import first_equilibrium, step_to
from grainmodes.relaxation.equilibrium_state import EquilibriumState


@dataclass
class PairTrack:
    """A pair from its birth to its death, each between two strains.

    `max_growth` is the largest ω_i of all its states, in 1/t_0.
    """

    birth: tuple[float, float]
    birth_kind: int
    max_growth: float = 0.0
    death: tuple[float, float] = (np.nan, np.nan)
    death_kind: int = NEVER


class LocatedPoint(NamedTuple):
    """The exceptional point of a birth (`born`) or death of a track, and a state with the pair."""

    track: int
    born: bool
    point: ExceptionalPoint
    pair: TwoModeState


class PairRecord(NamedTuple):
    """One state of the shear in numbers: pairs of M⁻¹J and of J, and the pair of the largest ω_i.

    `jacobian_pairs` is NaN unless requested; `fastest` and `condition` are NaN without a pair.
    """

    strain: float
    pairs: int
    jacobian_pairs: float
    fastest: complex
    condition: float
    dense: bool


@dataclass
class PairTracking:
    """The state that a shear has reached, and every pair on the way.

    `detector` finds the pairs of K, `jacobian_detector`, where there is one, those of J.
    """

    now: PairState
    shear: Shear
    choices: PairChoices
    detector: Detector
    jacobian_detector: Detector | None
    records: list[PairRecord] = field(default_factory=list)
    tracks: list[PairTrack] = field(default_factory=list)
    alive: list[int] = field(default_factory=list)
    located: list[LocatedPoint] = field(default_factory=list)
    states: list[EquilibriumState] = field(default_factory=list)
    candidates: ReleaseCandidates = field(default_factory=ReleaseCandidates)

    @classmethod
    def start(
        cls, packing: Packing, interaction: Interaction, shear: Shear, choices: PairChoices
    ) -> PairTracking:
        """The tracking in the first state of a shear, a packing in equilibrium.

        Raises:
            ArithmeticError: the packing has no stable equilibrium.
        """
        equilibrium = first_equilibrium(packing, interaction, shear)
        detector, other = (DETECTORS[choices.detection]() for _ in range(2))
        jacobian_detector = other if choices.jacobian else None
        now = detect_pairs(detector, equilibrium)
        tracking = cls(now, shear, choices, detector, jacobian_detector)
        tracking.candidates = ReleaseCandidates(choices.release_rates)
        tracking.tracks = [PairTrack((np.nan, now.strain), NEVER) for _ in now.pairs.value]
        tracking.alive = list(range(len(tracking.tracks)))
        tracking._record()
        return tracking

    @property
    def done(self) -> bool:
        """Whether the last strain is reached."""
        return len(self.records) > round(self.shear.strain / self.shear.step)

    def advance(self) -> None:
        """Take one step of the strain and record it.

        Raises:
            ArithmeticError: no equilibrium was found, or an iteration did not converge.
            numpy.linalg.LinAlgError: the dense eigensolver did not converge.
        """
        strain = len(self.records) * self.shear.step
        equilibrium, jumped = step_to(strain, self.now.equilibrium, self.shear)
        before, self.now = self.now, detect_pairs(self.detector, equilibrium)
        self._continue_tracks(before, jumped)
        self._record()

    def _continue_tracks(self, before: PairState, jumped: bool) -> None:
        """Continue every track with its pair in the new state; end some and begin some."""
        common = dict(match_pairs(before.projectors, self.now.projectors))
        changed = any(count_network_changes(before.equilibrium, self.now.equilibrium))
        kind = JUMP if jumped else UNDECIDED if changed else COALESCENCE
        step = before.strain, self.now.strain
        continued = {common[old]: track for old, track in enumerate(self.alive) if old in common}
        for old, track in enumerate(self.alive):
            if old not in common:
                self.tracks[track].death, self.tracks[track].death_kind = step, kind
                self._locate(track, before, old, self.now.equilibrium, jumped)
        for new in range(len(self.now.pairs.value)):
            if new not in continued:
                continued[new] = len(self.tracks)
                self.tracks.append(PairTrack(step, kind))
                self._locate(continued[new], self.now, new, before.equilibrium, jumped)
        self.alive = [continued[new] for new in range(len(self.now.pairs.value))]

    def _locate(
        self, track: int, state: PairState, place: int, other: EquilibriumState, jumped: bool
    ) -> None:
        """Locate a birth or death between a state with the pair and another, if it is among the
        first ones."""
        born = other.packing.strain < state.strain
        known = sum(one.born == born for one in self.located)
        if jumped or known >= self.choices.max_located:
            return
        pair = state.two_modes(place)
        try:
            point = locate_exceptional_point(pair, other, self.shear, self.choices.bracket)
        except NUMERICAL_ERRORS:
            point = ExceptionalPoint.between(FAILED, pair.strain, other.packing.strain)
        self.located.append(LocatedPoint(track, born, point, pair))
        record, ends = self.tracks[track], (point.below, point.above)
        if born:
            record.birth, record.birth_kind = ends, point.kind
        else:
            record.death, record.death_kind = ends, point.kind

    def _record(self) -> None:
        """Record the state and the growth of its tracks, and consider it for release."""
        self.states.append(self.now.equilibrium.without_factors())
        pairs = self.now.pairs
        growth = pairs.growth
        for track, rate in zip(self.alive, growth.tolist(), strict=True):
            self.tracks[track].max_growth = max(self.tracks[track].max_growth, rate)
        fastest, condition = complex(np.nan, np.nan), np.nan
        if len(growth):
            place = int(np.argmax(growth))
            fastest, condition = complex(pairs.value[place]), float(pairs.condition[place])
        self.candidates.consider(self.now)
        numbers = len(growth), self._count_jacobian_pairs(), fastest, condition
        self.records.append(PairRecord(self.now.strain, *numbers, self.detector.dense))

    def _count_jacobian_pairs(self) -> float:
        """Number of complex pairs of J; NaN unless requested."""
        if self.jacobian_detector is None:
            return np.nan
        equilibrium = self.now.equilibrium
        null = translations(np.ones(equilibrium.backbone.n))
        matrix = equilibrium.matrix.tocsr()
        problem = DynamicalMatrix(matrix, null, equilibrium.backbone_mask)
        return len(self.jacobian_detector.find(problem).value)
