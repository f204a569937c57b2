"""Benchmarks: `snakemake benchmarks` prints this table.

| column   | meaning                                                          |
| -------- | ---------------------------------------------------------------- |
| measured | CPU time of one thread, best of one run unless the case says so  |
| to reach | what the project aims at                                 |
| peak     | largest resident memory of the process of that case              |
"""

from __future__ import annotations

import argparse
import platform
import resource
from multiprocessing import get_context

import numpy as np

from grainmodes.runtime.environment import prepare
from measurements.machine import default_factorisation

CASES = (
    ("phi 0.80 -> 0.90 in 100 steps, each to 1e-10", "compression_in_large_steps", 1024, 5.0, "s"),
    ("FIRE, per grain and step", "fire_step", 1024, 25.0, "ns"),
    ("FIRE, per grain and step", "fire_step", 4096, 25.0, "ns"),
    ("FIRE, per grain and step", "fire_step", 16384, 25.0, "ns"),
    ("FIRE, per grain and step", "fire_step", 65536, 25.0, "ns"),
    ("frictionless forces, in those written by hand", "forces_in_twins", 1024, 1.05, "x"),
    ("frictionless forces, in those written by hand", "forces_in_twins", 4096, 1.05, "x"),
    ("frictionless forces, in those written by hand", "forces_in_twins", 16384, 1.05, "x"),
    ("frictionless forces, in those written by hand", "forces_in_twins", 65536, 1.05, "x"),
    ("frictional dynamics with history, per grain and step", "frictional_step", 4096, 50.0, "ns"),
    ("Newtonian dynamics of paper C, per grain and step", "newtonian_step", 4096, 60.0, "ns"),
    ("trajectory with eight phi, each to 1e-14", "trajectory", 4096, 300.0, "s"),
    ("g, g_A, g_NA from a packing", "moduli", 4096, 0.25, "s"),
    ("g, g_A, g_NA from a packing", "moduli", 65536, 3.0, "s"),
    ("all eigenvalues with psi", "all_modes", 1024, 9.0, "s"),
    ("all eigenpairs with psi and p, by slicing", "all_eigenpairs", 4096, 320.0, "s"),
    ("density of states on 160 edges", "density_of_states", 4096, 6.0, "s"),
    ("the same, SciPy alone", "density_of_states_superlu", 4096, 25.0, "s"),
    ("density of states on 160 edges", "density_of_states", 65536, 240.0, "s"),
    ("psi^R in 20 bins, with its error", "rotational_share", 65536, 120.0, "s"),
    ("shear to 0.02, events bracketed to 1e-8", "shear_by_newton", 128, 0.5, "s"),
    ("the same by damped dynamics", "shear_by_dynamics", 128, np.inf, "s"),
    ("a step of shear", "shear_step", 128, np.inf, "ms"),
    ("a step of shear", "shear_step", 1024, np.inf, "ms"),
    ("a step of shear", "shear_step", 4096, np.inf, "ms"),
    ("complex pairs of 200 states to 0.02", "pairs_by_continuation", 500, np.inf, "s"),
    ("the same, each state by LAPACK", "pairs_by_lapack", 500, np.inf, "s"),
    ("complex pairs of one state, disc by disc", "pairs_in_discs", 1000, np.inf, "s"),
    ("the same by LAPACK", "pairs_of_one_state_by_lapack", 1000, np.inf, "s"),
    ("complex pairs of one state, disc by disc", "pairs_in_discs", 4096, np.inf, "s"),
    ("start-up of a sample job", "start_up", 16, 1.0, "s"),
)


def run_case(name: str, n: int) -> tuple[float, float]:
    """Time and peak memory in MB of a case, in this process."""
    from measurements.benchmarks import cases, twin

    value = {**vars(cases), **vars(twin)}[name](n)
    return value, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def main() -> None:
    """Run every case in a fresh process and print its row as soon as it is measured."""
    argparse.ArgumentParser(description=__doc__.partition(":")[0]).parse_args()
    prepare()  # for the processes that measure
    python = f"Python {platform.python_version()}"
    print(f"{platform.machine()}, {python}, one thread, {default_factorisation()}", flush=True)
    print(f"{'work':54} {'N':>6} {'measured':>10} {'to reach':>9}      {'peak':>8}", flush=True)
    for title, name, n, target, unit in CASES:
        with get_context("spawn").Pool(1) as pool:
            value, memory = pool.apply(run_case, (name, n))
        numbers = f"{n:6d} {value:10.3g} {target:9.3g} {unit:3} {memory:6.0f} MB"
        print(f"{title:54} {numbers}", flush=True)


if __name__ == "__main__":
    main()
