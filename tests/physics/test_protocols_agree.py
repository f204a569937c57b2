"""Fast ways against reference ways, on ensembles: minutes of physics."""

import numpy as np
import pytest
from scipy.stats import ks_2samp

from example_packings import elastic
from grainmodes.kernels.damping import Dashpot
from grainmodes.packing.forces import stress
from grainmodes.packing.state import Packing, rattlers
from grainmodes.parameters.compression import Compression
from grainmodes.protocols.compression.trajectory import (
    compress_along_grid,
    compress_to,
    place_at_random,
)
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.newton import newton
from grainmodes.response.moduli import rigidity

pytestmark = pytest.mark.slow

N, PHI, SEEDS = 64, 0.87, 32
NORMAL = elastic("hertz", 0.0).normal


def ensemble(relaxation: str) -> dict[str, np.ndarray]:
    """φ_J, pressure, contact number and G of every seed, and whether it came to rest."""
    protocol = Compression(relaxation=relaxation, phi_step=1e-3)
    rows = [sample(seed, protocol) for seed in range(SEEDS)]
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def sample(seed: int, protocol: Compression) -> dict[str, float]:
    start = compress_along_grid(place_at_random(N, seed, NORMAL, protocol), 0.80, NORMAL, protocol)
    grid = compress_along_grid(start, PHI, NORMAL, protocol)
    relaxed = compress_to(grid, PHI, NORMAL, protocol)
    core = backbone(relaxed.packing)
    contacts = core.contacts
    return {
        "converged": relaxed.converged and relaxed.max_force < 1e-14,
        "phi_jamming": grid.phi_jamming,
        "pressure": -np.trace(stress(core, elastic("hertz", 0.0))) / 2,
        "contact_number": 2 * len(contacts.i) / core.n,
        "g": rigidity(core, elastic("hertz", 0.0)).unloaded.g,
    }


def backbone(packing: Packing) -> Packing:
    return packing.without(rattlers(packing, 2))


@pytest.fixture(scope="module")
def ensembles():
    return {way: ensemble(way) for way in ("fire_newton", "fire")}


@pytest.mark.parametrize("way", ["fire_newton", "fire"])
def test_every_packing_comes_to_rest(ensembles, way):
    assert ensembles[way]["converged"].all()


@pytest.mark.parametrize("name", ["phi_jamming", "pressure", "contact_number", "g"])
def test_distributions_do_not_depend_on_the_protocol(ensembles, name):
    fast, reference = ensembles["fire_newton"][name], ensembles["fire"][name]
    assert ks_2samp(fast, reference).pvalue > 0.01
    error = np.sqrt((fast.var(ddof=1) + reference.var(ddof=1)) / SEEDS)
    assert abs(fast.mean() - reference.mean()) < 3 * error


@pytest.mark.parametrize("kt", [1e-2, 1.0, 10.0])
def test_damped_dynamics_and_newton_reach_the_same_state(kt):
    """Twenty packings, stepped by 1e-6: the same places, spins and slips."""
    protocol, interaction = Compression(phi_step=1e-2), elastic("hertz", kt)
    for seed in range(20):
        core = backbone(
            compress_to(place_at_random(24, seed, NORMAL, protocol), 0.9, NORMAL, protocol).packing
        )
        stepped = core.sheared(1e-6)
        quick = newton(stepped, interaction, 1e-14, 40)
        slow = relax_damped(stepped, interaction, Dashpot(1.0), 1e-2, 1e-14, 50_000_000)
        assert quick.converged and slow.converged
        same_state(quick.packing, slow.packing)


def same_state(one: Packing, two: Packing) -> None:
    apart = (one.fraction - two.fraction) * 2.0**-64 * one.box_length
    apart -= apart.mean(axis=1, keepdims=True)
    assert np.abs(apart).max() < 1e-10
    assert np.abs(one.rotation - two.rotation).max() < 1e-10
    slips = [p.contacts.springs for p in (one, two)]
    np.testing.assert_allclose(*slips, atol=1e-10)
