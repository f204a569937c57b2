"""Numbers that an edit must not change unknowingly.

Each was stable to 1e-12 when the start was disturbed in its last twelve bits: the small packings
below end in the same minimum whatever the order of a sum.
"""

import numpy as np
import pytest

from example_packings import ELASTIC, elastic, reference
from grainmodes.packing.forces import stress
from grainmodes.packing.state import rattlers
from grainmodes.parameters.compression import Compression
from grainmodes.protocols.compression.trajectory import compress_to, place_at_random
from grainmodes.response.moduli import rigidity
from grainmodes.spectrum import packing_spectrum

COMPRESSED = [
    # n, seed, pressure, g unloaded, g loaded
    (16, 0, 0.007065890715878573, 0.029673310200804603, 0.03026541967993228),
    (16, 1, 0.004846188985157067, 0.0006624904147354768, 0.0014209462416758037),
    (16, 3, 0.007351231575492357, 0.030319039789567286, 0.03094463306967627),
    (32, 0, 0.005479651611359687, 0.01930166674734244, 0.019841881193797685),
    (32, 4, 0.006828259624356301, -0.012935013568747822, -0.01215867295273168),
]
"""Hertz, φ = 0.9 in steps of 0.01, fast protocol, k_T = 0.01."""


@pytest.mark.parametrize(("n", "seed", "pressure", "g", "g_loaded"), COMPRESSED)
def test_seeds_keep_their_packings(n, seed, pressure, g, g_loaded):
    interaction, protocol = elastic("hertz", 1e-2), Compression(phi_step=1e-2)
    packing = compress_to(
        place_at_random(n, seed, interaction.normal, protocol), 0.9, interaction.normal, protocol
    ).packing
    sigma, moduli = (
        stress(packing, interaction),
        rigidity(packing, interaction),
    )
    found = [-np.trace(sigma) / 2, moduli.unloaded.g, moduli.loaded.g]
    np.testing.assert_allclose(found, [pressure, g, g_loaded], rtol=1e-10)


STORED = {
    # pressure, contacts, trace of J at k_T = 1, mean participation ratio at k_T = 1
    "hertz_n16_phi0.900_seed1": (0.00521225336079, 36, 34.9679351233, 0.515552873731),
    "harmonic_n16_phi0.900_seed1": (0.0299920621432, 38, 226.257585384, 0.588663325773),
    "hertz_n64_phi0.860_seed2": (0.00114319863275, 137, 84.8600421961, 0.433983572892),
    "hertz_n64_phi0.900_seed1": (0.00653660580711, 153, 165.616040754, 0.463462013356),
    "harmonic_n64_phi0.860_seed2": (0.0093977202669, 137, 819.78485652, 0.452648725375),
    "harmonic_n64_phi0.900_seed1": (0.0318008995283, 154, 916.595624039, 0.467994526169),
}


@pytest.mark.parametrize("name", ELASTIC)
def test_stored_packings_keep_their_numbers(name):
    packing, interaction = reference(name)[1], elastic(name, 1.0)
    contacts = packing.contacts
    assert not rattlers(packing, 2).any()
    found = packing_spectrum(packing, interaction)
    pressure = -np.trace(stress(packing, interaction)) / 2
    numbers = [pressure, len(contacts.i), found.eigenvalue.sum(), found.participation_ratio.mean()]
    np.testing.assert_allclose(numbers, STORED[name], rtol=1e-6)
