"""Names of fields: (x, y, l) of every grain, NaN for a rattler."""

from __future__ import annotations

from grainmodes.dataset.units import LENGTH, NUMBER, RATE
from grainmodes.dataset.variable import Variable

GRAINS = ("seed", "grain", "component")

NAMES = {
    "affine_field": Variable(
        GRAINS, "f8", LENGTH, "affine displacement per unit strain, (x, y, l)"
    ),
    "nonaffine_field": Variable(GRAINS, "f8", LENGTH, "non-affine displacement per unit strain"),
    "nonaffine_field_mode_sum": Variable(
        GRAINS, "f8", LENGTH, "nonaffine_field as a sum over the modes"
    ),
    "nonaffine_field_simulated": Variable(
        GRAINS, "f8", LENGTH, "nonaffine_field from relaxed step strains"
    ),
    "frequency_requested": Variable(
        ("seed", "frequency"),
        "f8",
        RATE,
        "requested frequency, near which one eigenvector is computed",
    ),
    "frequency_found": Variable(
        ("seed", "frequency"), "f8", RATE, "frequency of the mode nearest to frequency_requested"
    ),
    "eigenvector": Variable(
        ("seed", "frequency", "grain", "component"),
        "f8",
        NUMBER,
        "eigenvector of the mode at frequency_found, of norm 1",
    ),
}
