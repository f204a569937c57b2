"""Athermal quasistatic shear from event to event: B, Sec. II, IV and Appendix B.

The strain grows in steps Δγ_in. A step that contains an event (`events`) is taken back, state and
history, and tried again with a tenth of its length, down to Δγ_Th. Then the event lies between two
saved states, in a bracket no wider than Δγ_Th. After the event the steps return to the grid of
Δγ_in. Strains are whole multiples of Δγ_Th, so that they are the same on every path.

The smaller changes are recorded as well, each with the step in which it happens: contacts that open
or close, and jumps, where the equilibrium did not move on continuously (`strain_step`).

| B      | name                          |
| ------ | ----------------------------- |
| Δγ_in  | choices.step                  |
| Δγ_Th  | choices.min_step         |
"""

from __future__ import annotations

from dataclasses import dataclass, field

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.failures import NUMERICAL_ERRORS
from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.events import (
    NetworkChange,
    PlasticEvent,
    count_network_changes,
    event_kind,
)
from grainmodes.protocols.shear.sheared_state import CurvePoint, ShearedState
from grainmodes.protocols.shear.strain_step import first_equilibrium, step_to
from grainmodes.runtime.progress import Progress


@dataclass
class QuasistaticRun:
    """A shear on its way, with everything recorded so far.

    `step_units` is the length of the next step in units of Δγ_Th. Once it has been shortened it
    stays short until the strain reaches `refine_until`, in the same units. `failure` is why the
    last failed step did not find an equilibrium.
    """

    state: ShearedState
    choices: Shear
    step_units: int
    refine_until: int = 0
    curve: list[CurvePoint] = field(default_factory=list)
    network_changes: list[NetworkChange] = field(default_factory=list)
    events: list[PlasticEvent] = field(default_factory=list)
    failure: Exception | None = None

    @classmethod
    def from_packing(
        cls, packing: Packing, interaction: Interaction, choices: Shear
    ) -> QuasistaticRun:
        """A shear that starts at a packing in balance.

        Raises:
            ArithmeticError: the packing has no stable equilibrium.
        """
        equilibrium = first_equilibrium(packing, interaction, choices)
        units = round(packing.strain / choices.min_step)
        run = cls(
            ShearedState(equilibrium, units, choices.loaded), choices, units_per_step(choices)
        )
        run._record_point()
        return run

    @property
    def done(self) -> bool:
        """Whether the last strain is reached."""
        return self.state.strain_units >= self._last_units

    @property
    def progress(self) -> Progress:
        """How far the shear is."""
        strain, last = self.state.strain, self.choices.strain
        words = f"strain {strain:.4f} of {last:g}, {len(self.events)} events"
        return Progress(strain / last, words, len(self.curve), "states")

    @property
    def restartable(self) -> bool:
        """Whether the state alone, without factors of earlier states, leads to the same bytes."""
        return self.state.equilibrium.factors_for_next.age == 1

    @property
    def _last_units(self) -> int:
        return round(self.choices.strain / self.choices.min_step)

    def advance(self) -> bool:
        """Try one step: accept it, or shorten the next one. False if no step is possible.

        A packing that has lost its rigidity has no stable equilibrium, however short the step is.
        """
        units = self._next_units()
        try:
            after = self._state_after(units)
            kind = event_kind(self.state, after)
        except NUMERICAL_ERRORS as error:
            after, kind, self.failure = None, 0, error
        if units > 1 and (after is None or kind):
            self.step_units = largest_power_of_ten_below(units)
            self.refine_until = self.state.strain_units + units
        elif after is not None:
            self._accept(after, kind)
        return after is not None or units > 1

    def _next_units(self) -> int:
        """Length of the next step, which ends at the grid of Δγ_in or before."""
        grid, current = units_per_step(self.choices), self.state.strain_units
        grid_point = min((current // grid + 1) * grid, self._last_units)
        return min(self.step_units, grid_point - current)

    def _state_after(self, units: int) -> ShearedState:
        units_after = self.state.strain_units + units
        strain = units_after * self.choices.min_step
        equilibrium, jumped = step_to(strain, self.state.equilibrium, self.choices)
        guess = self.state.response.displacement
        return ShearedState(equilibrium, units_after, self.choices.loaded, jumped, guess)

    def _accept(self, after: ShearedState, kind: int) -> None:
        """Go on to the next state, and record what happened on the way."""
        before = self.state
        opened, closed = count_network_changes(before.equilibrium, after.equilibrium)
        if opened or closed or after.jumped:
            change = NetworkChange(before.strain, after.strain, opened, closed, after.jumped)
            self.network_changes.append(change)
        if kind:
            self.events.append(PlasticEvent.from_states(before, after, kind, opened, closed))
        if kind or after.strain_units >= self.refine_until:
            self.step_units = units_per_step(self.choices)
        self.state = after
        self._record_point()

    def _record_point(self) -> None:
        with_lowest = self.choices.lowest_eigenvalue == "states"
        self.curve.append(self.state.curve_point(with_lowest))


def units_per_step(choices: Shear) -> int:
    """Δγ_in in units of Δγ_Th."""
    return round(choices.step / choices.min_step)


def largest_power_of_ten_below(units: int) -> int:
    """The length of the next shorter step.

    >>> [largest_power_of_ten_below(units) for units in (10000, 9700, 1000, 12, 10)]
    [1000, 1000, 100, 10, 1]
    """
    return int(10 ** (len(str(units - 1)) - 1))
