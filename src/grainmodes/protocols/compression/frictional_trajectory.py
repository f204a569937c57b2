"""Compression with friction from a random placement to a packing in force balance: B, Sec. II.

The start and the grid φ_k = φ_0 + k Φ are those of a compression without friction (`trajectory`).
Each step shrinks the box affinely. Then the grains relax by B's equations of motion, with friction:

    m_i r̈_i = F_i − m_i η_D ṙ_i,   I_i θ̈_i = T_i − I_i η_D θ̇_i        B (2)–(10)

The springs remember what happened on the way: s ≠ 0, and J is not symmetric. A target φ is reached
on a branch of its own. There the dynamics goes on towards F_Th, and Newton's method refines what it
has chosen (`relaxation.dynamic_equilibrium`).

Between the steps the balance need not be that accurate: max|F̃| is a part `balance` of the mean
contact force. Below jamming the grains creep, the longer the weaker their springs are. A step of φ
is therefore cut off after `max_steps`. docs/accuracy.md shows what these choices change.

Without slip grains jam early, at φ near 0.75 for k_T = k_N: a contact that never slides bears any
tangential force.

| symbol | name                | unit        |
| ------ | ------------------- | ----------- |
| Φ      | phi_step            | 1           |
| η_D    | choices.drag        | 1/t_0; B: 1 |
| Δt     | time_step           | t_0         |
| F_Th   | force_tolerance     | k_N d^(3/2) |
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from grainmodes.kernels.damping import Drag
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contact_count import may_be_rigid
from grainmodes.packing.forces import max_force_and_torque, mean_contact_force, net_force
from grainmodes.packing.state import Packing
from grainmodes.parameters.compression import Compression, FrictionalCompression
from grainmodes.parameters.grid import phi_at_step
from grainmodes.parameters.law import ContactLaw
from grainmodes.protocols.compression.trajectory import PHI_ROUNDING, Trajectory
from grainmodes.relaxation.dynamic_equilibrium import equilibrium_by_dynamics
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.frictionless import UNJAMMED_FORCE
from grainmodes.relaxation.result import RelaxationResult

LAST_PATIENCE = 50
"""Times `max_steps` after which a packing at its target φ counts as creeping, and not as jammed."""


@dataclass(frozen=True)
class FrictionalPress:
    """What compresses: the contact law, and the choices of steps and of the dynamics."""

    law: ContactLaw
    compression: Compression
    choices: FrictionalCompression

    @property
    def interaction(self) -> Interaction:
        """The compiled law.

        Raises:
            ValueError: the law is unknown or has no friction.
        """
        if not self.law.frictional:
            raise ValueError(f"compression with friction: expected kt above 0, got {self.law.kt}")
        return Interaction.from_law(self.law)

    def relax(self, packing: Packing, tolerance: float, max_steps: int) -> RelaxationResult:
        """Damped dynamics from rest until max|F̃| < `tolerance`, in at most so many time steps."""
        # Unlike a power, a square root is rounded in the same way everywhere.
        time_step = self.choices.time_step / math.sqrt(max(1.0, self.law.kt))
        drag = Drag(self.choices.drag)
        return relax_damped(packing, self.interaction, drag, time_step, tolerance, max_steps)

    def relax_step(self, packing: Packing, patience: int = 1) -> RelaxationResult:
        """Damped dynamics until max|F̃| is the part `balance` of the mean contact force.

        `converged` is False where it was cut off, after `patience` times `max_steps`.
        """
        steps, most = 0, patience * self.choices.max_steps
        while True:
            relaxed = self.relax(packing, self._allowed(packing), most - steps)
            packing, steps = relaxed.packing, steps + relaxed.iterations
            left = max(relaxed.max_force, relaxed.max_torque)
            converged = left < self._allowed(packing)
            if converged or steps >= most:
                return replace(relaxed, converged=converged, iterations=steps)

    def _allowed(self, packing: Packing) -> float:
        return max(
            self.choices.balance * mean_contact_force(packing, self.interaction), UNJAMMED_FORCE
        )


def compress_along_grid(start: Trajectory, phi: float, press: FrictionalPress) -> Trajectory:
    """Compress to the highest grid point that is not above φ.

    Raises:
        ArithmeticError: the motion grew beyond all bounds.
    """
    current, compression = start, press.compression
    while True:
        next_phi = phi_at_step(compression.initial_phi, compression.phi_step, current.step + 1)
        if next_phi > phi + PHI_ROUNDING:
            return current
        relaxed = press.relax_step(current.packing.at(next_phi))
        packing = replace(relaxed.packing, rotation=None)
        phi_jamming = current.phi_jamming if may_be_rigid(packing) else next_phi
        iterations = current.iterations + relaxed.iterations
        current = Trajectory(packing, current.step + 1, phi_jamming, iterations)


def compress_to(start: Trajectory, phi: float, press: FrictionalPress) -> RelaxationResult:
    """The packing at φ in its final balance, max|F̃| < F_Th, on a branch from the grid.

    A packing that has too few contacts to be rigid, or whose grains creep on without an end, is not
    jammed: it has no balance to be found, and is returned as it is. `iterations` count all time
    steps since the random placement.

    Raises:
        ArithmeticError: the dynamics found no balance.
    """
    grid = compress_along_grid(start, phi, press)
    relaxed = press.relax_step(grid.packing.at(phi), LAST_PATIENCE)
    iterations = grid.iterations + relaxed.iterations
    if not (relaxed.converged and may_be_rigid(relaxed.packing)):
        return replace(relaxed, converged=True, iterations=iterations)
    interaction, compression = press.interaction, press.compression
    tolerance, most = compression.force_tolerance, compression.max_iterations
    found, steps = equilibrium_by_dynamics(
        relaxed.packing, interaction, press.relax, tolerance, most
    )
    max_force, max_torque = max_force_and_torque(net_force(found.packing, interaction))
    return RelaxationResult(found.packing, True, iterations + steps, max_force, max_torque)
