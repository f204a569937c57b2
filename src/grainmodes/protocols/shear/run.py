"""Athermal quasistatic shear from event to event: B, Sec. II, IV and Appendix B.

The strain grows in steps Δγ_in. A step in which something happens is taken back, state and history,
and tried again with a tenth of its length, down to Δγ_Th: there the event stands between two saved
states, γ_c in a bracket no wider than Δγ_Th. After it the steps return to the grid of Δγ_in.
Strains are whole numbers of Δγ_Th, so that they are the same on every path.

| an event is      | when                                                           |
| ---------------- | -------------------------------------------------------------- |
| a stress drop    | σ falls, by more than a negative g explains B, Sec. IV (i)     |
| a rigidity drop  | g falls by more than 1e-2 k_N               B, Sec. IV (ii)    |

σ = (σ_xy + σ_yx)/2 and g = dσ/dγ of the loading protocol in use, with the f_y y_ij that B (43)
drops.
Beside the events stand the smaller changes, each within the step it happens in: contacts that open
or close, and jumps, where the balance did not move on continuously (`quasistatic`).
"""

from __future__ import annotations

from dataclasses import dataclass, field

from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.quasistatic import first_balance, step_to
from grainmodes.protocols.shear.state import Change, Event, Point, State, network_changes

RIGIDITY_DROP = 1e-2
"""Fall of g, in k_N, that makes a step plastic: B, Sec. IV (ii)."""

STRESS_FELL, RIGIDITY_FELL = 1, 2
"""What an event is: one of these, or their sum."""


@dataclass
class Walk:
    """How far a shear has come, and how it goes on.

    `size` is the next step tried, in Δγ_Th; below the grid it is kept until `until` is reached.
    `ending` says what kept the last step that failed from finding a balance.
    """

    now: State
    choices: Shear
    size: int
    until: int = 0
    curve: list[Point] = field(default_factory=list)
    changes: list[Change] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    ending: str = ""

    @classmethod
    def start(cls, packing: Packing, interaction, choices: Shear) -> Walk:
        """A shear from a packing in balance.

        Raises:
            ArithmeticError: the packing has no stable balance.
        """
        balance = first_balance(packing, interaction, choices)
        now = State(balance, round(packing.strain / choices.min_step), choices.loaded)
        walk = cls(now, choices, steps_per_grid(choices))
        walk.curve.append(walk._point())
        return walk

    @property
    def done(self) -> bool:
        """Whether the last strain is reached."""
        return self.now.units >= self._last

    @property
    def restartable(self) -> bool:
        """Whether the state alone, without factors of earlier ones, goes on to the same bytes."""
        return self.now.balance.handed_on.age == 1

    @property
    def _last(self) -> int:
        return round(self.choices.strain / self.choices.min_step)

    def advance(self) -> bool:
        """Try the next step: take it, or try a shorter one next time; False if there is none.

        A packing that has lost its rigidity has no stable balance, however short the step.
        """
        size = self._next_size()
        try:
            after = self._stepped(size)
            kind = kind_of(self.now, after)
        except ArithmeticError as error:
            after, kind, self.ending = None, 0, str(error)
        if size > 1 and (after is None or kind):
            self.size, self.until = largest_power_of_ten_below(size), self.now.units + size
        elif after is not None:
            self._take(after, kind)
        return after is not None or size > 1

    def _next_size(self) -> int:
        grid = steps_per_grid(self.choices)
        target = min((self.now.units // grid + 1) * grid, self._last)
        return min(self.size, target - self.now.units)

    def _stepped(self, size: int) -> State:
        units = self.now.units + size
        strain = units * self.choices.min_step
        balance, by_dynamics = step_to(strain, self.now.balance, self.choices)
        return State(
            balance, units, self.choices.loaded, by_dynamics, self.now.response.displacement
        )

    def _take(self, after: State, kind: int) -> None:
        opened, closed = network_changes(self.now.balance, after.balance)
        if opened or closed or after.jumped:
            change = Change(self.now.strain, after.strain, opened, closed, after.jumped)
            self.changes.append(change)
        if kind:
            self.events.append(Event.between(self.now, after, kind, opened, closed))
        if kind or after.units >= self.until:
            self.size = steps_per_grid(self.choices)
        self.now = after
        self.curve.append(self._point())

    def _point(self) -> Point:
        return self.now.point(with_lowest=self.choices.lowest_eigenvalue == "states")


def kind_of(before: State, after: State) -> int:
    """What happened between two states: 0, or the sum of B's two signs of a plastic event."""
    smoothly = min(0.0, before.g, after.g) * (after.strain - before.strain)
    fell = after.sigma - before.sigma < 2.0 * smoothly
    softened = before.g - after.g > RIGIDITY_DROP
    return STRESS_FELL * fell + RIGIDITY_FELL * softened


def steps_per_grid(choices: Shear) -> int:
    """Δγ_in in units of Δγ_Th."""
    return round(choices.step / choices.min_step)


def largest_power_of_ten_below(size: int) -> int:
    """The next shorter step.

    >>> [largest_power_of_ten_below(size) for size in (10000, 9700, 1000, 12, 10)]
    [1000, 1000, 100, 10, 1]
    """
    return 10 ** (len(str(size - 1)) - 1)
