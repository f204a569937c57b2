"""The stage `spectrum_rattlers`: the grain that moves most in a mode, and its contacts."""

import numpy as np

from example_packings import reference
from grainmodes.kernels.laws import Hertz, Interaction
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.spectrum import packing_spectrum
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block
from grainmodes.stages.spectrum import rattlers_block

NAME = "hertz_n64_phi0.860_seed2"


def test_contacts_of_the_grain_that_moves_most():
    packing, law = reference(NAME)[1], ContactLaw(kt=1e-4)
    row = packing_row(packing, Hertz(1.0)) | {"converged": True}
    point = {"n": packing.n, "phi": packing.phi, "stage": "packings"}
    packings = compute_block(range(1), [row].__getitem__, point)
    found = rattlers_block(packings, law, "modes", SpectrumChoices())
    modes = packing_spectrum(packing, Interaction.from_law(law), keep_rattlers=True).modes
    weight = (modes.reshape(-1, 3, modes.shape[1]) ** 2).sum(axis=1)
    touching = np.zeros((packing.n, packing.n), dtype=int)
    touching[packing.contacts.i, packing.contacts.j] = 1
    contacts = (touching + touching.T).sum(axis=1)
    values = found.variables["peak_contacts_rattlers"][0]
    np.testing.assert_array_equal(values, contacts[weight.argmax(axis=0)])
    assert len(set(values)) > 2
