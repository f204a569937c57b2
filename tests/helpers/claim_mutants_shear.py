"""Changes of `claim_fixtures_shear.ensemble()`, each of which fails one claim of paper B."""

import numpy as np

import claim_fixtures_shear


def theory_off(ensemble):
    """Steps of σ are alternately 5 % too large and 5 % too small, with the same mean."""
    step = np.diff(claim_fixtures_shear.strains())
    sign = np.where(np.arange(len(step)) % 2, 1.0, -1.0)
    off = np.concatenate([[0.0], np.cumsum(0.3 * 0.05 * sign * step)])
    claim_fixtures_shear.add_stress(ensemble, off)


def trend_before_events(ensemble):
    """λ_min falls to 0 as (γ_c - γ)^(1/2) over the steps before every event."""
    strain = ensemble["curve_strain"]
    for critical in claim_fixtures_shear.EVENTS:
        left = (critical + 0.5 * claim_fixtures_shear.SMALLEST - strain) / (
            2.0 * claim_fixtures_shear.STEP
        )
        near = (left > 0.0) & (left < 1.0)
        lowest = ensemble["curve_lowest_eigenvalue"]
        ensemble["curve_lowest_eigenvalue"] = lowest.where(~near, lowest * np.sqrt(abs(left)))


def singular_rigidity(ensemble):
    """g has a singular term of a few per cent at the last state before an event; σ follows g."""
    strain, half = claim_fixtures_shear.strains(), 0.5 * claim_fixtures_shear.SMALLEST
    term = np.zeros(len(strain))
    for critical in claim_fixtures_shear.EVENTS:
        left = critical + half - strain
        near = (left > 0.0) & (left < 3.0 * claim_fixtures_shear.STEP)
        term[near] -= 0.02 * np.sqrt(half / left[near])
    for name in ("curve_g_xy", "curve_g_yx"):
        ensemble[name].loc[claim_fixtures_shear.PLACE] += term
    rise = np.concatenate([[0.0], np.cumsum(term[:-1] * np.diff(strain))])
    claim_fixtures_shear.add_stress(ensemble, rise)


def turned_out(ensemble):
    ensemble["last_path_error"] = 1e-3 * ensemble["last_path_turn"]


def other_rate(ensemble):
    ensemble["rate_difference"] = ensemble["rate_difference"] + 0.05


def remembering(ensemble):
    ensemble["loop_left"] = 0.1 * ensemble["loop_slide"]


def jumps_of_one_size(ensemble):
    early = ensemble["event_strain_before"] < 0.05
    ensemble["event_g_after"] = ensemble["event_g_after"] - 0.1 * early


def skewed(ensemble):
    ensemble["event_asymmetry_after"] = ensemble["event_asymmetry_after"] + 0.003


def softer_in_changes(ensemble):
    """σ falls a little in every change, too little for a figure of σ."""
    strain = claim_fixtures_shear.strains()
    starts = strain[np.searchsorted(strain, claim_fixtures_shear.CHANGES)]
    drops = (strain[:, None] > starts).sum(axis=1)
    claim_fixtures_shear.add_stress(ensemble, -1.2e-3 * drops)


def no_contact_changes(ensemble):
    ensemble["event_opened"] = 0.0 * ensemble["event_opened"]


def other_without_brackets(ensemble):
    ensemble["coarse_stress"] = 1.05 * ensemble["coarse_stress"]


def wandering(ensemble):
    """γ_c of every bracket is that of another event."""
    ensemble["bracket_strain_after"] = ensemble["bracket_strain_after"] + 1e-5 * np.arange(7)


def turning_as_one(ensemble):
    ensemble["event_quadrupole"] = 0.01 * ensemble["event_quadrupole"]


MUTANTS = {
    "B1": theory_off,
    "B2": other_without_brackets,
    "B3": trend_before_events,
    "B4": singular_rigidity,
    "B5": wandering,
    "B6": turned_out,
    "B7": turning_as_one,
    "B8": softer_in_changes,
    "B9": no_contact_changes,
    "B11": skewed,
    "B12": other_rate,
    "B13": remembering,
    "B14": jumps_of_one_size,
}
"""Claims that fail alone; B10 is A1 for harmonic grains and fails with it."""


def no_jump(ensemble):
    strain = ensemble["curve_strain"]
    ensemble["curve_lowest_eigenvalue"] = 0.2 - 0.1 * strain


def disordered(ensemble):
    """Rotations whose p_2 is that of a permutation."""
    ensemble["event_quadrupole_rank"] = ensemble["event_quadrupole_rank"] + 0.5


SECOND_MUTANTS = {"B3": no_jump, "B7": disordered}
"""Changes that fail the second statement of a claim that makes two."""
