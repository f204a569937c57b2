"""Changes of `claim_fixtures_release.ensemble()`, each of which fails one claim of C4 to C7."""


def changed(name: str, factor: float, added: float = 0.0):
    """Multiply and shift one variable."""

    def mutate(ensemble):
        ensemble[f"release_{name}"] = factor * ensemble[f"release_{name}"] + added

    return mutate


def grows_though_damped(ensemble):
    """The run with η_0 = 3 ω_i grows as far as the undamped one."""
    largest = ensemble["release_largest_square"]
    ensemble["release_largest_square"] = largest.where(largest["damping"] != 3, 0.1)


def suppressed_by_little(ensemble):
    """The run with η_0 = 0.1 ω_i does not grow."""
    largest = ensemble["release_largest_square"]
    ensemble["release_largest_square"] = largest.where(largest["damping"] != 1, 1e-22)


MUTANTS = [
    ("C4", changed("spiral_misfit", 1e3)),
    ("C4", changed("spiral_overlap", 0.9)),
    ("C4", changed("spiral_opening", 0.1)),
    ("C5", changed("displacement_rate", 1.03)),
    ("C5", changed("rotation_rate", 0.97)),
    ("C5", changed("displacement_frequency", 1.03)),
    ("C5", changed("rotation_frequency", 0.97)),
    ("C5", changed("change_square", 1e3)),
    ("C6", changed("second_time", 1.0, -1.6e5)),
    ("C6", changed("after_pressure", 0.5)),
    ("C6", changed("after_stress_xy", 100.0)),
    ("C6", changed("after_contact_number", 1.0, 1.0)),
    ("C7", grows_though_damped),
    ("C7", suppressed_by_little),
]
"""A claim and a change that fails it, at least one for each part of the claim."""
