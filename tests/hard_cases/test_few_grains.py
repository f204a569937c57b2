"""N = 2, 4, 10, a negative g, and packings that take ten times the usual iterations."""

import re
from dataclasses import asdict, replace

import numpy as np
import pytest

import naive_failures
from example_packings import elastic, pairs_of, quenched
from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Hertz
from grainmodes.packing.state import Packing, PackingError
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.strain import Shear, StepStrain
from grainmodes.protocols.compression.trajectory import (
    compress_along_grid,
    compress_to,
    place_at_random,
)
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.protocols.shear.step_strain import step_strain
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.response.moduli import rigidity
from grainmodes.stages.compression import compress_block, packing_block

COARSE = Compression(phi_step=1e-3)


@pytest.mark.parametrize("n", [2, 4])
def test_a_box_that_holds_a_grain_twice_is_refused(n):
    """A square lattice of spacing 0.95: every grain touches both images of its neighbour."""
    sites, side = np.array([[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5]])[:n], 1.9
    lattice = Packing.from_positions(2.1 * sites, np.ones(n), 2.1)
    small = replace(lattice, box_length=side)
    assert 2 * len(naive_failures.nearest_image(small)) == len(pairs_of(small))
    with pytest.raises(PackingError, match="meets two images of another"):
        Packing.from_positions(side * sites, np.ones(n), side)
    with pytest.raises(PackingError, match="meets two images of another"):
        lattice.at(small.phi)


@pytest.mark.parametrize("n", [2, 4])
def test_too_few_grains_are_failed_samples(n):
    block = compress_block(n, range(2), 0.7, COARSE, "hertz", None)
    assert not block.variables["converged"].any()
    assert all(
        "two images" in text for text in block.attributes["failures"]["trajectories"].values()
    )


@pytest.mark.parametrize("strain", [0.0, 0.5, -0.5])
def test_ten_grains_fit_at_every_strain(strain):
    """N = 10 of C: the box is 2.57 d wide, and at γ = 1/2 it has to be 2.24 d."""
    packing = quenched(10, 0.9)
    sheared = packing.sheared(strain)
    contacts = sheared.contacts
    assert list(zip(contacts.i, contacts.j, strict=True)) == [(p.i, p.j) for p in pairs_of(sheared)]
    with pytest.raises(PackingError, match="meets two images"):
        packing.sheared(0.9)
    interaction = elastic("hertz", 1e-2)
    simulated = step_strain(packing, interaction, StepStrain())
    assert rigidity(packing, interaction).unloaded.g == pytest.approx(simulated.g, rel=1e-6)


def test_a_stable_packing_may_have_a_negative_g():
    """σ then falls without an event: a rule that takes each fall for one finds one a step."""
    packing, interaction = quenched(64, 0.845), elastic("hertz", 1e-8)
    g = rigidity(packing, interaction).unloaded.g
    assert g < -1e-4 and not EquilibriumState.from_packing(packing, interaction).unstable
    assert g == pytest.approx(step_strain(packing, interaction, StepStrain()).g, rel=1e-6)
    choices = Shear(strain=3e-6, step=1e-6, min_step=1e-8)
    run = QuasistaticRun.from_packing(packing, interaction, choices)
    while not run.done:
        run.advance()
    sigma = [point.stress[0, 1] + point.stress[1, 0] for point in run.curve]
    assert np.all(np.diff(sigma) < 0.0)
    assert run.events == []


def test_a_seed_that_needs_ten_times_the_usual_iterations():
    """Sixteen grains at φ = 0.84, where half of the samples are jammed: 4207 beside 72."""
    normal = Hertz(1.0)

    def iterations(seed: int) -> int:
        start = compress_along_grid(place_at_random(16, seed, normal, COARSE), 0.84, normal, COARSE)
        relaxed = compress_to(start, 0.84, normal, COARSE)
        assert relaxed.converged and relaxed.max_force < 1e-14
        return relaxed.iterations - start.iterations

    usual = int(np.median([iterations(seed) for seed in range(9)]))
    assert iterations(21) > 10 * usual
    hasty = replace(COARSE, max_iterations=10 * usual)
    start = compress_block(16, range(20, 23), 0.84, COARSE, "hertz", None)
    config = start.attributes["config"] | {"compression": asdict(hasty)}
    begun = Block(start.variables, start.attributes | {"config": config})
    block = packing_block(begun, 0.84, hasty, "hertz")
    assert block.variables["converged"].tolist() == [1, 0, 1]
    assert re.search(r"max\|F\| < .* iterations", block.attributes["failures"]["packings"]["21"])
