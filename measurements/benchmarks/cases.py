"""What is timed: each case prepares, runs once to compile, and returns seconds of CPU time.

CPU time of one thread. The number in brackets in a name is N. A case runs in a process of its own,
so that the peak memory is its own too.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from grainmodes.dataset.files import write_block
from grainmodes.kernels.damping import Dashpot, Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.fire import FireSettings, fire
from grainmodes.kernels.laws import Hertz, Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.grid import checkpoints_up_to, phi_at_step
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.compression.trajectory import (
    compress_along_grid,
    compress_to,
    place_at_random,
)
from grainmodes.protocols.pair_tracking.detection import DETECTORS, detect_pairs
from grainmodes.protocols.pair_tracking.tracking import PairTracking
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.protocols.shear.strain_step import first_equilibrium, step_to
from grainmodes.relaxation.dynamics import move
from grainmodes.relaxation.frictionless import relax_fire_large_steps, relax_fire_newton
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import Eigenproblem, SpectrumChoices, full_spectrum, packing_spectrum
from grainmodes.spectrum.inertia_counts import count_below, rotational_sums
from grainmodes.stages.compression import compress_block, packing_block

HERTZ = Hertz(1.0)
PROTOCOL = Compression()


def cpu(work, *arguments) -> float:
    """CPU seconds of one call."""
    start = time.process_time()
    work(*arguments)
    return time.process_time() - start


def quenched(n: int, phi: float, tolerance: float = 1e-7) -> Packing:
    """A packing at φ straight from random placement, which is good enough to time kernels."""
    packing = place_at_random(n, 0, HERTZ, PROTOCOL).packing.at(phi)
    return relax_fire_large_steps(packing, HERTZ, tolerance, 0.0, 20_000).packing


def balanced_at(n: int, phi: float) -> Packing:
    """A packing at φ in final balance, without a compression before."""
    return relax_fire_newton(quenched(n, phi), HERTZ, 1e-14, 1_000_000).packing


def compression_in_large_steps(n: int) -> float:
    """φ 0.80 → 0.90 in 100 steps of 1e-3, each to max|F| < 1e-10."""
    start = compress_along_grid(
        place_at_random(n, 0, HERTZ, PROTOCOL), 0.8, HERTZ, PROTOCOL
    ).packing

    def climb(packing, steps):
        for k in range(1, steps + 1):
            packing = relax_fire_newton(
                packing.at(phi_at_step(0.8, 1e-3, k)), HERTZ, 1e-10, 10_000_000
            ).packing

    climb(start, 1)
    return cpu(climb, start, 100)


def fire_step(n: int) -> float:
    """Force and update of FIRE per grain and step, in ns, near balance at φ = 0.90."""
    packing = quenched(n, 0.9, 1e-5)
    steps = max(400, 4_000_000 // n)

    def run(count):
        x, y = packing.fraction.copy()
        settings = FireSettings(1e-30, 0.0, 1e3, 0.9, 0.2, count)
        fire(x, y, packing.diameter, np.ones(n), packing.box_length, 0.0, HERTZ, settings)

    run(1)
    return (cpu(run, steps + 1) - cpu(run, 1)) / steps / n * 1e9


def frictional_step(n: int) -> float:
    """Damped dynamics with tangential history per grain and step, in ns, at φ = 0.90."""
    return _step(n, ContactLaw(kt=1.0), Dashpot(1.0), 1e-2)


def newtonian_step(n: int) -> float:
    """The same without damping for C's smoothed Coulomb law, as in a release."""
    return _step(n, ContactLaw("hertz", "smoothed_coulomb", 2 / 7, 10.0), Undamped(), 0.1)


def _step(n: int, law: ContactLaw, damping, time_step: float) -> float:
    packing, interaction = quenched(n, 0.9).sheared(1e-4), Interaction.from_law(law)
    steps = 4_000_000 // n

    def run(count):
        move(packing, np.zeros((n, 3)), interaction, damping, time_step, Stop(0.0, count))

    run(1)
    return (cpu(run, steps + 1) - cpu(run, 1)) / steps / n * 1e9


def trajectory(n: int) -> float:
    """One trajectory with all eight φ of 0.83 … 0.90, each packing to 1e-14."""
    compress_to(place_at_random(16, 0, HERTZ, PROTOCOL), 0.9, HERTZ, PROTOCOL)

    def climb():
        now = place_at_random(n, 0, HERTZ, PROTOCOL)
        for phi in np.round(np.arange(0.83, 0.905, 0.01), 2):
            now = compress_along_grid(now, phi, HERTZ, PROTOCOL)
            assert compress_to(now, phi, HERTZ, PROTOCOL).converged

    return cpu(climb)


def moduli(n: int) -> float:
    """g, g_A, g_NA, unloaded and loaded, from a packing."""
    packing, interaction = balanced_at(n, 0.9), Interaction.from_law(ContactLaw(kt=1e-4))
    rigidity(packing, interaction)
    return cpu(rigidity, packing, interaction)


def all_modes(n: int) -> float:
    """All eigenvalues with ψ and p."""
    packing, interaction = balanced_at(n, 0.9), Interaction.from_law(ContactLaw(kt=1e-4))
    packing_spectrum(quenched(16, 0.9), interaction)
    return cpu(packing_spectrum, packing, interaction)


def density_of_states(n: int, backend: str = "auto") -> float:
    """Modes in 159 bins from counts at 160 edges, ω t_0 = 1e-6 … 3."""
    shift = weakly_frictional(n).symmetric_shift(backend)
    count_below(shift, np.array([0.5]))
    return cpu(count_below, shift, np.geomspace(1e-6, 3.0, 160))


def density_of_states_superlu(n: int) -> float:
    """`density_of_states` by SciPy alone."""
    return density_of_states(n, "superlu")


def rotational_share(n: int) -> float:
    """ψ^R with its error in 20 bins over both bands, counts included."""
    eigenproblem = weakly_frictional(n)
    shift = eigenproblem.symmetric_shift()
    count_below(shift, np.array([0.5]))
    edges = np.concatenate([np.linspace(1e-3, 2e-2, 9), np.linspace(0.1, 1.3, 13)[1:]])

    def measure():
        below = count_below(shift, edges)
        found = rotational_sums(shift, below, edges, eigenproblem.k, cells_per_bin=1)
        print(
            "rotational_share: largest error of a mean", _largest_error(found.error, np.diff(below))
        )

    return cpu(measure)


def _largest_error(error: np.ndarray, count: np.ndarray) -> float:
    many = count > 60
    return float((error[many] / count[many]).max())


def all_eigenpairs(n: int) -> float:
    """All eigenpairs with ψ and p, by spectrum slicing with certified counts."""
    eigenproblem = weakly_frictional(n)
    return cpu(lambda: full_spectrum(eigenproblem, choices=SpectrumChoices("slicing")))


def weakly_frictional(n: int) -> Eigenproblem:
    """The eigenproblem at φ = 0.90, k_T/k_N = 1e-4."""
    return Eigenproblem.from_packing(balanced_at(n, 0.9), Interaction.from_law(ContactLaw(kt=1e-4)))


INTERACTION_OF_C = Interaction.from_law(ContactLaw("hertz", "smoothed_coulomb", 2.0 / 7.0, 10.0))
SHEAR_OF_C = Shear(0.02, force_tolerance=5e-14)


def packing_of_c(n: int) -> Packing:
    """A frictionless packing of C's grains at φ = 0.90, in balance."""
    return replace(balanced_at(n, 0.9), mass=np.ones(n))


def pairs_along(n: int, detection: str, strain: float = 0.02) -> float:
    """Complex pairs of every state of a shear in steps of 1e-4, C's grains and law, μ = 10."""
    choices = replace(SHEAR_OF_C, strain=strain)
    pair_choices = PairChoices(detection, max_located=0)
    run = PairTracking.start(packing_of_c(n), INTERACTION_OF_C, choices, pair_choices)

    def follow():
        while not run.done:
            run.advance()

    return cpu(follow)


def pairs_by_continuation(n: int) -> float:
    """The same by continuation of the eigenvectors of the state before."""
    return pairs_along(n, "continuation")


def pairs_by_lapack(n: int) -> float:
    """The same by a dense general eigensolver at every state."""
    return pairs_along(n, "dense")


def pairs_in_discs(n: int) -> float:
    """Every complex pair at γ = 0.01, disc by disc."""
    return pairs_of_one_state(n, "discs")


def pairs_of_one_state_by_lapack(n: int) -> float:
    """The same by a dense general eigensolver."""
    return pairs_of_one_state(n, "dense")


def pairs_of_one_state(n: int, detection: str) -> float:
    """Complex pairs of the state at γ = 0.01 alone."""
    now = first_equilibrium(packing_of_c(n), INTERACTION_OF_C, SHEAR_OF_C)
    for step in range(1, 101):
        now, _ = step_to(step * SHEAR_OF_C.step, now, SHEAR_OF_C)
    return cpu(detect_pairs, DETECTORS[detection](), now)


HARMONIC = Interaction.from_law(ContactLaw("harmonic", "elastic", 1.0))


def harmonic_at(n: int, phi: float) -> Packing:
    """A harmonic packing in final balance, from a Hertzian one."""
    return relax_fire_newton(balanced_at(n, phi), HARMONIC.normal, 1e-14, 10_000_000).packing


def shear_by_newton(n: int) -> float:
    """γ = 0 to 0.02, Δγ = 1e-4, Δγ_Th = 1e-8, harmonic, k_T = k_N, φ = 0.90."""
    return _sheared(n, Shear(0.02))


def shear_by_dynamics(n: int) -> float:
    """The same by B's damped dynamics alone, Δt = 0.01 t_0, to the same balance."""
    return _sheared(n, Shear(0.02, relaxation="damped", time_step=0.01))


def shear_step(n: int) -> float:
    """A step Δγ = 1e-4 without brackets, in ms."""
    packing, steps = harmonic_at(n, 0.9), 50
    _shear(packing, Shear(2e-4, 1e-4, 1e-4))
    return 1e3 / steps * cpu(_shear, packing, Shear(steps * 1e-4, 1e-4, 1e-4))


def _sheared(n: int, choices: Shear) -> float:
    packing = harmonic_at(n, 0.9)
    _shear(packing, choices)
    return cpu(_shear, packing, choices)


def _shear(packing: Packing, choices: Shear) -> None:
    run = QuasistaticRun.from_packing(packing, HARMONIC, choices)
    while not run.done and run.advance():
        pass


def start_up(n: int) -> float:
    """A job on few grains: interpreter, imports, cached kernels."""
    start = None
    for phi in checkpoints_up_to(0.9):
        start = compress_block(n, range(1), phi, PROTOCOL, "hertz", start)
    with tempfile.TemporaryDirectory() as folder:
        packings = Path(folder) / "packings.nc"
        write_block(packings, packing_block(start, 0.9, PROTOCOL, "hertz"))
        command = ["rigidity", str(packings), "--kt", "1e-4", "-o", str(Path(folder) / "g.nc")]
        return min(_cpu_of_job(command) for _ in range(3))


def _cpu_of_job(command: list[str]) -> float:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([Path(sys.executable).with_name("grainmodes"), *command], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
