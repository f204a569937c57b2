"""Changes of `claim_fixtures_release.ensemble()`, each of which fails one claim."""


def changed(name: str, factor: float, added: float = 0.0):
    """Multiply and shift one variable."""

    def mutate(ensemble):
        ensemble[f"release_{name}"] = factor * ensemble[f"release_{name}"] + added

    return mutate


def grows_though_damped(ensemble):
    """The run with η_0 = 100 ω_i grows as far as the undamped one."""
    largest = ensemble["release_largest_square"]
    ensemble["release_largest_square"] = largest.where(largest["damping"] != 4, 0.1)


def suppressed_by_little(ensemble):
    """The run with η_0 = 0.1 ω_i does not grow."""
    largest = ensemble["release_largest_square"]
    ensemble["release_largest_square"] = largest.where(largest["damping"] != 1, 1e-22)


def grows_at_another_rate_under_drag(ensemble):
    """The run with η_0 = ω_i grows at half of the rate, as under a drag on all motion."""
    rate = ensemble["release_displacement_rate"]
    ensemble["release_displacement_rate"] = rate.where(rate["damping"] != 2, rate * 0.5 / 0.75)


def ends_after_one_time(ensemble):
    """All growth ends, and all pairs die, at the time of the slowest."""
    for name in ("end_time", "change_time", "second_time", "death_time"):
        values = ensemble[f"release_{name}"]
        ensemble[f"release_{name}"] = values * (ensemble["release_rate_linear"] / 2e-5) ** 0.5


def pressure_falls_at_one_z(ensemble):
    """P_i of the grains with three contacts falls."""
    after = ensemble["release_pressure_by_z_after"]
    ensemble["release_pressure_by_z_after"] = after.where(
        after["contacts_of_grain"] != 3, after / 3
    )


def no_contact_begins_to_slide(ensemble):
    """As the growth ends as many contacts slide as at the start."""
    start = ensemble["release_start_sliding"]
    ensemble["release_growth_sliding"] = 0.0 * ensemble["release_growth_sliding"] + start


MUTANTS = [
    ("C4", changed("spiral_misfit", 1e3)),
    ("C4", changed("spiral_overlap", 0.9)),
    ("C4", changed("spiral_opening", 0.1)),
    ("C5", changed("displacement_frequency", 1.03)),
    ("C5", changed("rotation_rate", 0.97)),
    ("C5", changed("rotation_frequency", 0.97)),
    ("C6", changed("after_pressure", 0.5)),
    ("C6", changed("after_stress_xy", 100.0)),
    ("C6", changed("after_contact_number", 1.0, 1.0)),
    ("C7", grows_though_damped),
    ("C7", suppressed_by_little),
    ("C7", grows_at_another_rate_under_drag),
    ("C11", changed("death_time", 1.6)),
    ("C11", changed("death_time", 0.4)),
    ("C12", changed("noise_rate", 0.9)),
    ("C12", changed("noise_frequency", 1.1)),
    ("C13", changed("diffusion_exponent", 0.5)),
    ("C13", changed("diffusion_exponent", 2.0)),
    ("C14", changed("binary_tail_after", 0.1)),
    ("C15", pressure_falls_at_one_z),
    ("C16", changed("growth_sliding", 0.0)),
    ("C16", changed("after_sliding", 0.0)),
    ("C16", changed("after_sliding", 0.0, 2.0)),
    ("C16", no_contact_begins_to_slide),
]
"""A claim and a change that fails it, at least one for each part of the claim."""
