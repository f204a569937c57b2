"""Which variables a point gathers."""

from grainmodes.dataset import VARIABLES
from grainmodes.dataset.variable import is_gathered

OF_GRAINS = ("position", "contact_i", "unstable_rotation", "event_contact_i_before")
OF_A_RUN = ("release_time", "release_spectrum_time", "release_binary_pressure_before")
OF_A_SAMPLE = ("seed", "g", "eigenvalue", "bin_count", "curve_strain", "track_growth")


def test_a_point_gathers_numbers_of_samples_and_leaves_grains_and_runs_in_their_files():
    assert not any(is_gathered(VARIABLES[name]) for name in (*OF_GRAINS, *OF_A_RUN))
    assert all(is_gathered(VARIABLES[name]) for name in OF_A_SAMPLE)
