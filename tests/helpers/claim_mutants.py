"""Changes of `claim_fixtures.ensemble()`, each of which fails one claim of paper A and no other."""

import numpy as np

import claim_fixtures


def theory_off(ensemble):
    ensemble["g_simulated"] = 1.05 * ensemble["g_simulated"]


def proportional(ensemble):
    distance, kt = ensemble["phi"] - claim_fixtures.JAMMING, ensemble["kt"]
    much = kt / (1 + kt)
    g = distance**1.5 * (1 - much) + distance * 0.3 * much
    claim_fixtures.set_moduli(ensemble, g.where(kt < 0.5, distance) * claim_fixtures.ones(ensemble))


def not_flat(ensemble):
    step = 1.0 + 0.05 * (ensemble["kt"] == 1e-4) * claim_fixtures.noise(ensemble, 0.2)
    claim_fixtures.set_moduli(ensemble, without_noise(ensemble) * step)


def jump(ensemble):
    step = 1.0 + 0.05 * (ensemble["kt"] > 0)
    claim_fixtures.set_moduli(ensemble, without_noise(ensemble) * step)


def product(ensemble):
    distance, kt = ensemble["phi"] - claim_fixtures.JAMMING, ensemble["kt"]
    claim_fixtures.set_moduli(ensemble, distance**0.5 * (1 + kt) * claim_fixtures.ones(ensemble))


def without_noise(ensemble):
    return ensemble["g"] / claim_fixtures.noise(ensemble, 0.05)


def crossing_at(kappa):
    return lambda ensemble: cross_at(ensemble, kappa)


def cross_at(ensemble, kappa):
    logarithm = np.log(ensemble["kt"].clip(1e-12) / kappa)
    shifted = (
        (ensemble["phi"] - claim_fixtures.JAMMING)
        * logarithm
        * claim_fixtures.noise(ensemble, 0.05)
    )
    ensemble["g_nonaffine"] = (shifted * claim_fixtures.ones(ensemble)).transpose(
        *claim_fixtures.POINT
    )


def mixed_modes(ensemble):
    psi = ensemble["psi_rotational"]
    small = (ensemble["kt"] > 0) & (ensemble["kt"] < 1e-3)
    ensemble["psi_rotational"] = psi.where(~(small & (psi > 0.5)), 0.75)


def sound_in_the_band(ensemble):
    eigenvalue = ensemble["eigenvalue"]
    sound = abs(eigenvalue / claim_fixtures.SOUND**2 - 1.0) < 1e-6
    low = (ensemble["kt"] > 0) & (ensemble["kt"] <= 1e-8)
    ensemble["eigenvalue"] = eigenvalue.where(~(sound & low), ensemble["kt"])
    claim_fixtures.count_hessian(ensemble)


def peak_elsewhere(ensemble):
    rotational = ensemble["psi_rotational"] > 0.5
    ensemble["eigenvalue"] = ensemble["eigenvalue"].where(
        ~rotational, ensemble["eigenvalue"] * 0.4**2
    )
    claim_fixtures.count_hessian(ensemble)


def fewer_rotations(ensemble):
    psi, x = ensemble["psi_rotational"], np.sqrt(ensemble["eigenvalue"] / ensemble["kt"])
    upper = (ensemble["kt"] == 1e-2) & (psi > 0.5) & (x > 1.2)
    ensemble["psi_rotational"] = psi.where(~upper)


def other_frictionless(ensemble):
    ensemble["eigenvalue"].loc[{"kt": 0.0}] *= 1.21
    claim_fixtures.count_hessian(ensemble)


def other_hessian(ensemble):
    ensemble["bin_count_hessian"] = ensemble["bin_count_hessian_printed"]


def spread_rattlers(ensemble):
    ensemble["participation_ratio_rattlers"][..., -2:] *= 10.0


def size_matters(ensemble):
    place = {"n": claim_fixtures.NS[0], "kt": 1e-8}
    translational = ensemble["psi_rotational"].loc[place] <= 0.5
    values = ensemble["eigenvalue"].loc[place]
    ensemble["eigenvalue"].loc[place] = values.where(~translational, values * 1.44)


def no_way_down(ensemble):
    reference = ensemble["eigenvalue"].sel(phi=0.90)
    ensemble["eigenvalue"] = (reference + 0 * ensemble["phi"]).transpose(
        *claim_fixtures.POINT, "mode"
    )
    ensemble["eigenvalue"].loc[{"phi": 0.86}] *= 1.1
    claim_fixtures.count_hessian(ensemble)


def strain_matters(ensemble):
    ensemble["g_forward_by_strain"][..., -1] *= 1.05


def rotations_needed(ensemble):
    ensemble["g_translational"] = 0.9 * ensemble["g_translational"]


def other_order(ensemble):
    ensemble["verlet_order_velocity"] = 2.0 * ensemble["verlet_order_velocity"]


def no_pairs(ensemble):
    ensemble["complex_pairs_at_rest"] = 0.0 * ensemble["complex_pairs_at_rest"]


def on_loaded_grains(ensemble):
    ensemble["peak_contacts_rattlers"] = ensemble["peak_contacts_rattlers"] + 1.0


def moving_plateau(ensemble):
    translational = ensemble["psi_rotational"] <= 0.5
    moved = translational & (ensemble["kt"] == 1e-2)
    ensemble["eigenvalue"] = ensemble["eigenvalue"].where(~moved, 1.3 * ensemble["eigenvalue"])
    claim_fixtures.count_hessian(ensemble)


def other_field(ensemble):
    ensemble["field_difference"] = 1e5 * ensemble["field_difference"]


def other_participation(ensemble):
    ratio = ensemble["participation_ratio"]
    ensemble["participation_ratio"] = ratio.where(ratio["kt"] != 1e-4, 1.5 * ratio)


MUTANTS = {
    "A1": theory_off,
    "A2": proportional,
    "A3": not_flat,
    "A4": jump,
    "A5": product,
    "A6": crossing_at(20.0),
    "A7": mixed_modes,
    "A8": sound_in_the_band,
    "A9": peak_elsewhere,
    "A10": fewer_rotations,
    "A11": other_frictionless,
    "A12": other_hessian,
    "A13": on_loaded_grains,
    "A14": size_matters,
    "A15": no_way_down,
    "A16": strain_matters,
    "A17": rotations_needed,
    "A18": other_order,
    "A19": no_pairs,
    "A20": moving_plateau,
    "A21": other_field,
    "A22": other_participation,
}


def no_growth(ensemble):
    ensemble["g_nonaffine"] = ensemble["g_nonaffine"] / (ensemble["phi"] - claim_fixtures.JAMMING)


def positive_from_the_start(ensemble):
    cross_at(ensemble, 0.1)


def no_overlap(ensemble):
    values = ensemble["eigenvalue"]
    sound = abs(values / claim_fixtures.SOUND**2 - 1.0) < 1e-6
    ensemble["eigenvalue"] = values.where(~sound, values * 3e4)
    claim_fixtures.count_hessian(ensemble)


def no_collapse(ensemble):
    values, psi = ensemble["eigenvalue"], ensemble["psi_rotational"]
    one = (ensemble["kt"] == 1e-6) & (psi > 0.5)
    ensemble["eigenvalue"] = values.where(~one, values * 0.6)
    claim_fixtures.count_hessian(ensemble)


def other_position_order(ensemble):
    ensemble["verlet_order_position"] = 0.5 * ensemble["verlet_order_position"]


def other_dynamics(ensemble):
    ensemble["g_forward_damped"] = 1.05 * ensemble["g_forward_damped"]


def other_hessian_under_shear(ensemble):
    ensemble["hessian_shift_sheared"] = 200.0 * ensemble["hessian_shift_sheared"]


SECOND_MUTANTS = [
    ("A1", other_dynamics),
    ("A6", no_growth),
    ("A6", positive_from_the_start),
    ("A9", no_collapse),
    ("A12", other_hessian_under_shear),
    ("A18", other_position_order),
]
"""Claims, and changes that fail another of their statements."""
