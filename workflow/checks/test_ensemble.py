"""Consistency checks that every ensemble must pass before its figures can be trusted.

They do not depend on the grid: no stage has failed for a sample, forces balance to the requested
tolerance, the parts of a modulus add up, theory equals simulation where the step strain changed no
contact, and fractions lie between 0 and 1.
"""

from __future__ import annotations

import numpy as np
import pytest

THEORY_AGAINST_SIMULATION = 1e-5
"""Largest difference of g and g_simulated where no contact changed, relative to g. Twice the stated
error of the simulation is added, which matters for the softest samples."""

MODE_SUM = 1e-8
"""Largest difference of g from all modes and g from one solve, relative to its affine part."""

SUM_OF_PARTS = 1e-10
"""Largest relative difference of a modulus and the sum of its parts."""

MIN_SHARE_CONVERGED = 0.5
"""Smallest share of the samples of a point that must have converged."""


MAX_LISTED = 20
"""Largest number of failed samples that a check lists."""


def _has(ensemble, *names: str) -> None:
    absent = [name for name in names if name not in ensemble]
    if absent:
        pytest.skip(f"no sample has {', '.join(absent)}")


def _all(condition) -> bool:
    return bool(np.all(condition))


def test_no_sample_failed(lost, stage):
    failed = [str(sample) for sample in lost if (sample.kind, sample.stage) == ("failures", stage)]
    listed = failed[:MAX_LISTED]
    if len(failed) > MAX_LISTED:
        listed.append(f"and {len(failed) - MAX_LISTED} more in the failures of the ensemble")
    if failed:
        pytest.fail("\n".join([f"{len(failed)} failed", *listed]), pytrace=False)


def test_most_samples_converged(ensemble, converged, requested):
    share = converged.where(requested).mean("seed")
    poor = share.where(share < MIN_SHARE_CONVERGED, drop=True)
    assert poor.size == 0, f"few samples converged at {poor.to_dataframe('share').dropna()}"


def test_forces_balance(ensemble, converged, protocol):
    _has(ensemble, "max_force")
    force = ensemble["max_force"].where(converged)
    if "compressed_with_friction" in ensemble:  # grains that carry no load creep without an end
        force = force.where((ensemble["compressed_with_friction"] == 0) | (ensemble["jammed"] == 1))
    assert not (force >= protocol["compression"]["force_tolerance"]).any()


def test_every_converged_sample_has_a_rigidity(ensemble, converged):
    _has(ensemble, "g")
    known = np.isfinite(ensemble["g"])
    assert _all(known | ~converged | ~known.any("seed"))


def test_unjammed_samples_are_not_rigid(ensemble, converged):
    _has(ensemble, "g", "jammed")
    loose = converged & (ensemble["jammed"] == 0)
    assert not (np.abs(ensemble["g"]) > 0.0).where(loose, False).any()


@pytest.mark.parametrize("suffix", ["", "_loaded"], ids=["unloaded", "loaded"])
def test_parts_add_up(ensemble, converged, suffix):
    names = [f"g{suffix}", f"g_affine{suffix}", f"g_nonaffine{suffix}"]
    _has(ensemble, *names)
    total, affine, nonaffine = (ensemble[name].where(converged) for name in names)
    scale = np.abs(affine) + np.abs(nonaffine)
    assert not (np.abs(total - affine - nonaffine) > SUM_OF_PARTS * scale).any()


def test_loaded_relaxation_softens(ensemble, converged):
    _has(ensemble, "g_nonaffine_loaded", "g_affine_loaded")
    rise = ensemble["g_nonaffine_loaded"].where(converged)
    assert not (rise > SUM_OF_PARTS * np.abs(ensemble["g_affine_loaded"])).any()


def test_theory_is_simulation(ensemble, converged):
    _has(ensemble, "g", "g_simulated", "g_simulated_error", "contact_changes")
    same_contacts = converged & (ensemble["contact_changes"] == 0) & (ensemble["g"] != 0.0)
    theory, simulation, error = (
        ensemble[name].where(same_contacts) for name in ("g", "g_simulated", "g_simulated_error")
    )
    allowed = THEORY_AGAINST_SIMULATION * np.abs(theory) + 2.0 * error
    assert not (np.abs(simulation - theory) > allowed).any()


def test_mode_sum_is_direct_solve(ensemble, converged):
    _has(ensemble, "g", "g_mode_sum", "g_affine")
    theory, modes, scale = (
        ensemble[name].where(converged) for name in ("g", "g_mode_sum", "g_affine")
    )
    assert not (np.abs(modes - theory) > MODE_SUM * np.abs(scale)).any()


@pytest.mark.parametrize("name", ["psi_rotational", "participation_ratio"])
def test_fractions(ensemble, converged, name):
    _has(ensemble, name)
    fraction = ensemble[name].where(converged)
    assert not ((fraction < -1e-12) | (fraction > 1.0 + 1e-12)).any()


def test_eigenvalues_ascend(ensemble, converged):
    _has(ensemble, "eigenvalue")
    step = ensemble["eigenvalue"].where(converged).diff("mode")
    assert not (step < 0.0).any()


def test_no_force_balance_is_unstable(ensemble, converged):
    _has(ensemble, "eigenvalue")
    eigenvalue = ensemble["eigenvalue"].where(converged)
    assert not (eigenvalue.min("mode") < -1e-10 * eigenvalue.max("mode")).any()
