"""Grains at one place, a crystal, an exceptional point, |s| = s*: where a formula has no answer."""

from dataclasses import replace

import numpy as np
import pytest

import naive
import naive_failures
from example_packings import crowd, crystal, elastic, quenched
from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Hertz, Interaction
from grainmodes.kernels.springs import clip_springs
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.forces import forces_on_i, sliding
from grainmodes.packing.jacobian import stiffness_of
from grainmodes.packing.state import PackingError
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.pair_tracking.exceptional_points import COALESCENCE, ExceptionalPoint
from grainmodes.protocols.pair_tracking.tracking import PairTracking
from grainmodes.relaxation.frictionless import relax_fire_newton
from grainmodes.spectrum import Eigenproblem, slice_eigenpairs, spectrum_slicing
from grainmodes.stages.compression import compress_block


def test_two_grains_at_one_place_have_no_normal():
    packing = crowd(3)
    packing.fraction[:, 5] = packing.fraction[:, 2]
    pair = naive.Pair(1, 0, np.zeros(2), 1.0, 0.0)
    with np.errstate(invalid="ignore"):
        assert np.isnan(naive.pair_force(ContactLaw(), pair)).any()
    with pytest.raises(PackingError, match="grains 5 and 2 lie at the same place"):
        _ = packing.contacts
    with pytest.raises(ArithmeticError, match="two grains may lie at the same place"):
        relax_fire_newton(packing, Hertz(1.0), 1e-14, 1000)
    apart = packing.displaced(np.where(np.arange(16) == 5, 1e-15, 0.0)[:, None] * [1.0, 0.0])
    assert relax_fire_newton(apart, Hertz(1.0), 1e-14, 100_000).converged


def test_a_sample_with_two_grains_at_one_place_fails_alone():
    protocol = Compression(phi_step=1e-2)
    start = compress_block(16, range(2), 0.7, protocol, "hertz", None)
    fraction = start.variables["fraction"].copy()
    fraction[0, 5] = fraction[0, 2]
    bad = Block(start.variables | {"fraction": fraction}, start.attributes)
    found = compress_block(16, range(2), 0.8, protocol, "hertz", bad)
    assert found.variables["converged"].tolist() == [0, 1]
    assert "same place" in found.attributes["failures"]["trajectories"]["0"]


def test_a_crystal_has_every_eigenvalue_as_often_as_it_is_counted():
    """Lanczos with one vector sees one mode of each multiplet of the waves ±q."""
    eigenproblem = Eigenproblem.from_packing(crystal(7, 8, 0.95), elastic("hertz", 0.5))
    shift = eigenproblem.symmetric_shift()
    low, high = 0.05, 0.35
    modes = shift.factor_at(high).n_below - shift.factor_at(low).n_below
    values, vectors = naive_failures.eigenpairs_near(shift, 0.2, 60, 1)
    sound = np.linalg.norm(eigenproblem.matrix @ vectors - vectors * values, axis=0) < 1e-8
    assert np.count_nonzero(sound & (values > low) & (values < high)) < 0.5 * modes
    found = slice_eigenpairs.eigenpairs_in_slice(
        shift, spectrum_slicing.SpectralSlice(low, high, modes)
    )
    lapack = np.linalg.eigvalsh(eigenproblem.matrix.toarray())
    inside = lapack[(lapack >= low) & (lapack < high)]
    np.testing.assert_allclose(found.values, inside, atol=1e-14)
    np.testing.assert_allclose(found.vectors.T @ found.vectors, np.eye(modes), atol=1e-12)


def born(bracket: float) -> ExceptionalPoint:
    """The first birth of a pair among sixteen grains under the law of C, μ = 10."""
    interaction = Interaction.from_law(ContactLaw("hertz", "smoothed_coulomb", 2 / 7, 10.0))
    tracking = PairTracking.start(
        quenched(16, 0.9),
        interaction,
        Shear(strain=4.5e-3, step=5e-4),
        PairChoices(bracket=bracket),
    )
    while not tracking.located:
        tracking.advance()
    return tracking.located[0].point


def test_an_exceptional_point_is_found_to_1e_12():
    """|λ1 − λ2| has a vertical tangent at γ_c: a straight line through it misses; D has none."""
    points = [born(bracket) for bracket in (1e-9, 1e-12, 1e-13)]
    assert all(point.kind == COALESCENCE for point in points)
    assert np.ptp([point.strain for point in points]) < 1e-12
    ends = points[0].neighbours[0], points[0].neighbours[-1]
    before, after = (np.sqrt(abs(end.subspace.discriminant)) for end in ends)
    straight = np.interp(0.0, [-before, after], [end.distance for end in ends])
    assert abs(straight) > 1e-9


@pytest.mark.parametrize("tangential", ["sharp_coulomb", "sharp_coulomb_force"])
@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_a_spring_at_its_threshold_slides(normal, tangential):
    """|s| = s* to rounding after a slip: a plain comparison takes some contacts for sticking."""
    law = ContactLaw(normal, tangential, 0.3, 0.4)
    overlap = np.random.default_rng(0).uniform(1e-6, 0.1, 1000)
    s = clip_springs(Interaction.from_law(law), overlap, np.full(1000, 1e3))
    np.testing.assert_allclose(s, naive.threshold(law, overlap), rtol=1e-14)
    normal_force = naive.normal_force(law, overlap)
    if normal == "hertz":
        held = s if tangential.endswith("force") else 0.3 * np.sqrt(overlap) * s
        assert np.mean(held < 0.4 * normal_force) > 0.05
    contacts = lying_along_x(overlap, s)
    assert sliding(contacts, Interaction.from_law(law)).all()
    np.testing.assert_array_equal(stiffness_of(contacts, Interaction.from_law(law))[:, 2, 2], 0.0)
    force = np.abs(forces_on_i(contacts, Interaction.from_law(law))[:, 2])
    np.testing.assert_allclose(force, 0.4 * normal_force, rtol=1e-15)


@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_a_smoothed_spring_has_one_stiffness_at_its_threshold(normal):
    """Both sides agree at s*; a difference across that of the sharp law is the mean of its two."""
    law, overlap = ContactLaw(normal, "smoothed_coulomb", 0.3, 0.4), np.full(3, 0.01)
    s = naive.threshold(law, overlap) * [1.0 - 1e-9, 1.0, 1.0 + 1e-9]
    stiffness = stiffness_of(lying_along_x(overlap, s), Interaction.from_law(law))
    np.testing.assert_allclose(stiffness[[0, 2]], stiffness[[1, 1]], atol=1e-8)
    sharp = replace(law, tangential="sharp_coulomb")
    ends = [naive.tangential_force(sharp, 0.01, s[1] * part) for part in (1.0 + 1e-3, 1.0 - 1e-3)]
    difference = (ends[0] - ends[1]) / (2e-3 * s[1])
    assert difference == pytest.approx(-0.5 * naive.tangential_stiffness(law, 0.01), rel=1e-2)


def lying_along_x(overlap: np.ndarray, s: np.ndarray) -> Contacts:
    """Contacts of grains of diameter 1."""
    i = np.arange(1, len(overlap) + 1, dtype=np.int32)
    normal = np.tile([1.0, 0.0], (len(overlap), 1))
    return Contacts(i, np.zeros_like(i), normal, 1.0 - overlap, overlap, s)
