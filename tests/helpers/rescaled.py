"""A packing, a contact law and a protocol in units of other k_N, d and m.

In the units of the package k_N = m = d = 1. A system whose k_N is four times as large is given with
a fourfold k_N, and with everything else that contains k_N rescaled: tolerances, time steps, and the
constants of the code that have a unit (`CONSTANTS`).
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, replace
from importlib import import_module
from unittest.mock import patch

import numpy as np

from example_packings import reference
from grainmodes.dataset.files import Block
from grainmodes.dataset.units import (
    AREA,
    FORCE,
    HALF,
    LENGTH,
    MASS,
    MODULUS,
    RATE,
    SQUARED_RATE,
    TIME,
    Laws,
    Unit,
)
from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.release import Release
from grainmodes.parameters.stages import STAGES
from grainmodes.parameters.strain import Shear, StepStrain
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block

for stage in STAGES.values():
    import_module(stage.function.partition(":")[0])  # all constants are bound before any is patched

SCALES = {"none": {}, "k_N": {"k_N": 4}, "d": {"d": 16}, "m": {"m": 4}}
"""What is rescaled → the new k_N, d and m. All their roots that occur are powers of two, so that
rescaled numbers have the digits of the plain ones."""

VELOCITY = Unit(HALF, HALF, -HALF)
VISCOSITY = Unit(HALF, -HALF, HALF)
CURVATURE = Unit(length=-1)

CONSTANTS = {
    ("protocols.shear.events", "MIN_RIGIDITY_DROP"): MODULUS,
    ("protocols.shear.events", "PATH_CURVATURE"): CURVATURE,
    ("response.stability", "REAL_TOLERANCE"): SQUARED_RATE,
    ("parameters.release", "GROWTH_RANGE"): AREA,
    ("parameters.release", "DENSE_RECORDS_ONSET"): AREA,
    ("protocols.pair_tracking.linear_range", "MAX_GAP"): LENGTH,
    ("protocols.release.simulated_growth", "AMPLITUDE"): LENGTH,
    ("relaxation.accuracy", "TIME_STEP"): TIME,
    ("relaxation.accuracy", "AMPLITUDE"): LENGTH,
    ("spectrum.full", "ZERO_MODE_CUTOFF"): MODULUS,
}
"""Numerical choices of the code that have a unit."""

FREQUENCIES_OF_J = (
    ("grainmodes.stages.spectrum", "fixed_edges"),
    ("grainmodes.stages.fields", "field_frequencies"),
)
"""Functions that return frequencies (λ / m)^(1/2), with m the unit of mass."""

TO_AN_EVENT = {"hertz": (0.25, 5e-3), "harmonic": (0.03, 1e-3)}
"""A strain up to which the packing has an event, and the step."""

TO_A_PAIR = (0.024, 1e-3)
"""The same for complex pairs."""


class RescaledSystem:
    """The reference packing of 16 grains under a contact law, in units of other k_N, d and m."""

    def __init__(self, law: ContactLaw, scale: str):
        self.law, self.scale = law, {"k_N": 1, "d": 1, "m": 1} | SCALES[scale]

    def factor(self, unit: Unit, mass: bool = True) -> float:
        """The factor on numbers of this unit; without `mass` the unit of mass is left alone."""
        laws = Laws(self.law.normal, self.law.tangential)
        powers = unit.under(laws).powers(laws.normal)
        scale = self.scale if mass else self.scale | {"m": 1}
        return float(np.prod([float(scale[name]) ** float(powers[name]) for name in powers]))

    @contextmanager
    def in_force(self) -> Iterator[None]:
        """A context in which interactions and the constants of the code have these units."""
        with ExitStack() as patches:
            patches.enter_context(patch.object(Interaction, "from_law", self._interaction()))
            for home, name in FREQUENCIES_OF_J:
                module = import_module(home)
                scaled = self._frequencies(getattr(module, name))
                patches.enter_context(patch.object(module, name, scaled))
            for (home, name), unit in CONSTANTS.items():
                value = getattr(import_module(f"grainmodes.{home}"), name)
                scaled = np.multiply(value, self.factor(unit))
                for module in _modules_with(name, value):
                    patches.enter_context(patch.object(module, name, scaled))
            yield

    def _interaction(self):
        plain, k_n = Interaction.from_law, self.scale["k_N"]

        def stiffened(part):
            return part._replace(stiffness=part.stiffness * k_n) if part._fields else part

        return lambda law: Interaction(*map(stiffened, plain(law)))

    def _frequencies(self, function):
        factor = self.factor(RATE, mass=False)
        return lambda *arguments: np.multiply(function(*arguments), factor)

    def packings(self) -> Block:
        """The block of the reference packing."""
        packing = reference(f"{self.law.normal}_n16_phi0.900_seed1")[1]
        scaled = replace(
            packing,
            diameter=packing.diameter * self.factor(LENGTH),
            mass=packing.mass * self.factor(MASS),
            box_length=packing.box_length * self.factor(LENGTH),
        )
        return self.block(packing_row(scaled, Interaction.from_law(self.law).normal))

    def block(self, row: dict[str, object]) -> Block:
        """A block of one packing."""
        config = {"compression": asdict(self.compression())}
        point = {"n": len(row["diameter"]), "phi": 0.9, "stage": "packings", "config": config}
        return compute_block([0], lambda number: row | {"converged": True}, point)

    def compression(self) -> Compression:
        """F_Th in these units."""
        return Compression(force_tolerance=1e-14 * self.factor(FORCE))

    def protocol(self, strain: float = 0.0, step: float = 1e-3) -> Protocol:
        """Every numerical choice in these units; short runs."""
        force, time, rate = (self.factor(unit) for unit in (FORCE, TIME, RATE))
        return Protocol(
            compression=self.compression(),
            step_strain=StepStrain(
                force_tolerance=1e-14 * force,
                time_step=1e-2 * time,
                damping=self.factor(VISCOSITY),
            ),
            shear=Shear(
                strain,
                step,
                1e-3 * step,
                force_tolerance=1e-14 * force,
                time_step=0.1 * time,
                drag=rate,
                lowest_eigenvalue="states",
            ),
            complex_pairs=PairChoices(jacobian=True, max_located=1, track_beyond=2),
            release=Release(
                time_step=0.1 * time,
                duration=24.0,
                min_time=0.0,
                initial_velocity=1e-11 * self.factor(VELOCITY),
                dampings=(0.1,),
                n_records=200,
                spectra=4,
            ),
        )


def _modules_with(name: str, value: object) -> list:
    """The modules of the package that hold this constant."""
    return [
        module
        for key, module in list(sys.modules.items())
        if key.startswith("grainmodes.") and vars(module).get(name) is value
    ]
