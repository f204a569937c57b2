"""The works of the table of costs, each timed at one N, at φ = 0.90 and k_T/k_N = 1e-4.

Commands are timed as a study runs them, with reading and writing; a first run on few grains keeps
start-up and compilation out of the time. What takes less than `MIN_CPU_SECONDS` is repeated, and
the shortest run counts.
"""

from __future__ import annotations

import json
import resource
import time
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from grainmodes.cli import main
from grainmodes.cost.work import USUAL_STEP
from grainmodes.dataset.files import read_block, write_block
from grainmodes.parameters.grid import checkpoints_up_to
from grainmodes.protocols.compression.trajectory import compress_along_grid, place_at_random
from grainmodes.relaxation.frictionless import relax_fire_newton
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block
from measurements.benchmarks import cases
from measurements.benchmarks.cases import HERTZ, PROTOCOL

PHI, KT = 0.9, 1e-4

WARM_UP_N = 64
"""Number of grains of the first run of each work."""

TRAJECTORY_FORCE = 1e-5
"""Largest force on a grain that a trajectory leaves at φ = 0.90: 1e-3 of the mean contact force."""

SHEAR_STRAIN = 0.02
"""Strain to which a shear is timed."""

BIN_DENSITY = 0.01
"""Factor on the numbers of linear bins where edges are counted: 33 edges instead of 160."""

MIN_CPU_SECONDS, MAX_RUNS = 1.0, 5
"""A work is repeated until its runs together took so many CPU seconds, but at most so often."""

SPECTRA = {
    "dense_values": ("eigenvalues", "dense", "auto"),
    "dense_modes": ("modes", "dense", "auto"),
    "window_superlu": ("modes", "slicing", "superlu"),
    "window_pardiso": ("modes", "slicing", "pardiso"),
    "count_superlu": ("counts", "inertia_counts", "superlu"),
    "count_pardiso": ("counts", "inertia_counts", "pardiso"),
}
"""Name of a work → kind of the spectrum, method, factorisation."""


class TimedWork(NamedTuple):
    """CPU seconds of a work, the number of units it did, and the peak memory in MB."""

    seconds: float
    units: float
    megabytes: float


def timed(work: str, n: int, folder: Path) -> TimedWork:
    """One work at n grains, in this process; `folder` keeps packings for other works."""
    run = {
        "trajectory": lambda n: sum(climb(n)),
        "equilibrate": _balance,
        "complex_pairs": lambda n: cases.pairs_along(n, "continuation", SHEAR_STRAIN),
    }.get(work, lambda n: _respond(work, n, folder))
    run(WARM_UP_N)
    return TimedWork(_shortest(run, n), _units(work, n, folder), peak())


def _shortest(run: Callable[[int], float], n: int) -> float:
    seconds = [run(n)]
    while sum(seconds) < MIN_CPU_SECONDS and len(seconds) < MAX_RUNS:
        seconds.append(run(n))
    return min(seconds)


def climb(n: int) -> list[float]:
    """CPU seconds from random placement to the lowest checkpoint, then from each to the next."""
    now, clock = None, [time.process_time()]
    for phi in checkpoints_up_to(PHI):
        now = compress_along_grid(
            now or place_at_random(n, 0, HERTZ, PROTOCOL), phi, HERTZ, PROTOCOL
        )
        clock.append(time.process_time())
    return [after - before for before, after in pairwise(clock)]


def start_up() -> float:
    """CPU seconds of a job with next to nothing to do."""
    return cases.start_up(16)


def peak() -> float:
    """Largest resident memory of this process so far, in MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def bare(folder: Path) -> float:
    """Peak memory of a job on few grains, in MB."""
    _respond("rigidity", WARM_UP_N, folder)
    return peak()


def _balance(n: int) -> float:
    loose = cases.quenched(n, PHI, TRAJECTORY_FORCE)
    return cases.cpu(
        relax_fire_newton, loose, HERTZ, PROTOCOL.force_tolerance, PROTOCOL.max_iterations
    )


def _respond(work: str, n: int, folder: Path) -> float:
    """CPU seconds of the command of a response, its own processes included."""
    command = "spectrum" if work in SPECTRA else work.replace("_", "-")
    sheared = work == "shear"
    words = [command, str(_packings(n, folder, sheared)), "--kt", str(1.0 if sheared else KT)]
    words += ["--settings", json.dumps(_settings(work)), "-o", str(_output(work, n, folder))]
    before = _used()
    if main(words):
        raise RuntimeError(f"grainmodes {' '.join(words)} failed")
    return _used() - before


def _settings(work: str) -> dict:
    sheared = {"protocol": {"shear": {"strain": SHEAR_STRAIN}}}
    if work == "shear":
        return {"contact_law": {"normal": "harmonic"}} | sheared
    if work == "law_comparison":
        return sheared
    if work not in SPECTRA:
        return {}
    kind, method, factorisation = SPECTRA[work]
    choices = {"method": method, "factorisation": factorisation, "bin_density": BIN_DENSITY}
    return {"observables": {"spectrum": kind}, "protocol": {"spectrum": choices}}


def _used() -> float:
    own = time.process_time()
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return own + children.ru_utime + children.ru_stime


def _units(work: str, n: int, folder: Path) -> float:
    """Modes by slicing, edges of counts, steps or states of a shear; else one sample."""
    if work in ("shear", "law_comparison", "complex_pairs"):
        return SHEAR_STRAIN / USUAL_STEP
    names = {"window": "mode_count", "count": "bin_edge"}
    name = names.get(work.split("_")[0])
    if name is None:
        return 1.0
    variable = read_block(_output(work, n, folder)).variables[name]
    return float(variable[0]) if name == "mode_count" else float(variable.shape[1])


def _output(work: str, n: int, folder: Path) -> Path:
    return folder / f"{work}-{n}.nc"


def _packings(n: int, folder: Path, harmonic: bool) -> Path:
    """A file of one packing."""
    path = folder / f"packings-{n}{'-harmonic' * harmonic}.nc"
    if not path.exists():
        packing = cases.harmonic_at(n, PHI) if harmonic else cases.balanced_at(n, PHI)
        normal = cases.HARMONIC.normal if harmonic else HERTZ
        point = {"stage": "packings", "n": n, "phi": PHI}
        row = packing_row(packing, normal) | {"converged": True}
        write_block(path, compute_block([0], lambda _: row, point))
    return path
