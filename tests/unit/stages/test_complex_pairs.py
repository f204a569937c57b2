"""The stage of complex pairs: what it holds, that LAPACK finds the same, and the same bytes."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from example_packings import quenched
from grainmodes.dataset.files import Block, write_block
from grainmodes.kernels.laws import Hertz, Interaction
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.packing.state import Packing
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.pair_tracking.exceptional_points import COALESCENCE, NEVER
from grainmodes.stages.complex_pairs import complex_pairs_block
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block

LAW = ContactLaw("hertz", "smoothed_coulomb", 2 / 7, 10.0)
SHEAR = Shear(strain=0.01, step=2e-4, force_tolerance=5e-14)
ASKED = PairChoices(max_located=2, track_beyond=5, jacobian=True)


def packings(*some: Packing) -> Block:
    """Hertzian packings as a block of stage `packings`."""
    rows = [packing_row(p, Hertz(1.0)) | {"converged": True} for p in some]
    point = {"n": some[0].n, "phi": some[0].phi, "stage": "packings"}
    return compute_block(range(len(rows)), rows.__getitem__, point)


@pytest.fixture(scope="module")
def packing() -> Packing:
    made = quenched(32, 0.9, seed=1)
    return replace(made, mass=np.ones(made.n))


@pytest.fixture(scope="module")
def found(packing) -> Block:
    """One sample with pairs, one that is not jammed."""
    return complex_pairs_block(packings(packing, packing.at(0.5)), LAW, SHEAR, ASKED)


def test_every_state_is_there_from_none_to_some_pairs(found):
    values = found.variables
    assert values["pair_state_count"].tolist() == [51, 0]
    assert values["pair_strain"][0, -1] == pytest.approx(0.01)
    assert values["pair_count"][0, 0] == values["pair_count_jacobian"][0, 0] == 0
    assert values["pair_count"][0].max() >= 1
    some = values["pair_count"][0] > 0
    assert np.array_equal(np.isfinite(values["pair_growth"][0]), some)
    assert np.all(values["pair_condition"][0, some] >= 1.0)
    assert found.attributes["failures"] == {}


def test_tracks_add_up_to_the_pairs_of_every_state(found):
    values = {name: array[0] for name, array in found.variables.items()}
    size = values["track_count"]
    born, died = values["track_birth_after"][:size], values["track_death_after"][:size]
    for strain, count in zip(values["pair_strain"], values["pair_count"], strict=True):
        alive = (born <= strain + 1e-12) & ~(died <= strain + 1e-12)
        assert alive.sum() == count
    assert np.array_equal(np.isnan(died), values["track_death_kind"][:size] == NEVER)


def test_a_birth_has_its_exceptional_point(found):
    values = {name: array[0] for name, array in found.variables.items()}
    met = values["exceptional_point_kind"] == COALESCENCE
    assert met.any()
    assert np.all(
        values["exceptional_point_after"][met] - values["exceptional_point_before"][met] <= 1e-9
    )
    for side in ("real", "pair"):
        exponents = values[f"exceptional_point_exponent_{side}"][met]
        assert_allclose(exponents, 0.5, atol=2e-3)
    near = np.isfinite(values["neighbour_distance"])
    assert np.all(values["neighbour_residual"][near] < 1e-12)
    closest = near & (np.abs(values["neighbour_distance"]) < 2e-8)
    assert np.all(values["neighbour_product"][closest] > 0.99)


def test_lapack_finds_the_same_pairs(packing, found):
    dense = complex_pairs_block(packings(packing), LAW, SHEAR, replace(ASKED, detection="dense"))
    for name in ("pair_count", "pair_count_jacobian", "track_birth_kind", "exceptional_point_kind"):
        assert np.array_equal(dense.variables[name][0], found.variables[name][0]), name
    assert_allclose(dense.variables["pair_growth"], found.variables["pair_growth"][:1], atol=1e-6)
    assert dense.variables["pair_dense"].all()
    assert found.variables["pair_dense"][0].sum() < 10


def test_a_disc_sweep_finds_the_same_pairs(packing, found):
    asked = replace(ASKED, detection="discs")
    other = complex_pairs_block(packings(packing), LAW, SHEAR, asked).variables
    assert np.array_equal(other["pair_count"][0], found.variables["pair_count"][0])
    assert_allclose(other["pair_growth"], found.variables["pair_growth"][:1], atol=1e-6)


def test_the_condition_of_the_fastest_pair_is_that_of_lapack(packing, found):
    dense = complex_pairs_block(packings(packing), LAW, SHEAR, replace(ASKED, detection="dense"))
    ours, theirs = (block.variables["pair_condition"] for block in (found, dense))
    assert (ours[np.isfinite(ours)] > 1.0).all()
    assert_allclose(ours[:1], theirs, rtol=0.02)


def test_the_state_that_grows_fastest_is_whole(packing, found):
    values = {name: array[0] for name, array in found.variables.items()}
    values |= {name: array[0] for name, array in values.items() if name.startswith("unstable_")}
    assert values["unstable_found"] == 1
    names = ("contact_i", "contact_j", "spring_state")
    held = values["unstable_contact_i"] >= 0
    state = replace(
        packing,
        fraction=np.ascontiguousarray(values["unstable_fraction"].T),
        strain=float(values["unstable_strain"]),
        history=History.from_pairs(*(values[f"unstable_{name}"][held] for name in names)),
    )
    interaction = Interaction.from_law(LAW)
    assert max(max_force_and_torque(net_force(state, interaction))) < 5e-14
    q = (values["unstable_mode_real"] + 1j * values["unstable_mode_imag"]).ravel()
    value = values["unstable_eigenvalue_real"] + 1j * values["unstable_eigenvalue_imag"]
    mass = generalized_mass(state.mass).ravel()
    assert_allclose(jacobian(state, interaction) @ q / mass, value * q, atol=1e-11)
    assert np.linalg.norm(q) == pytest.approx(1.0)
    growth = np.sqrt(value).imag
    assert growth == pytest.approx(np.nanmax(values["pair_growth"]), abs=1e-5)


def test_states_of_listed_rates_are_whole_and_have_the_path_of_their_pair(packing):
    slow = replace(ASKED, release_rates=(1e-3, 1e-9))
    values = complex_pairs_block(packings(packing), LAW, SHEAR, slow).variables
    assert values["unstable_found"].tolist() == [[1, 0]]
    value = values["unstable_eigenvalue_real"][0, 0] + 1j * values["unstable_eigenvalue_imag"][0, 0]
    rate = np.sqrt(value).imag
    nearest = np.nanmin(np.abs(np.log10(values["pair_growth"] / 1e-3)))
    assert abs(np.log10(rate / 1e-3)) == pytest.approx(nearest, rel=1e-6)
    path = {name: values[f"unstable_path_{name}"][0, 0] for name in ("strain", "imaginary")}
    here = path["strain"] == values["unstable_strain"][0, 0]
    assert path["imaginary"][here] == pytest.approx(value.imag, rel=1e-6)
    assert (path["imaginary"] == 0.0).any()
    count = values["pair_count"][0][values["pair_strain"][0] == values["unstable_strain"][0, 0]]
    assert values["unstable_pair_count"][0, 0] == count


def test_a_sample_that_is_not_jammed_has_no_states(found):
    values = found.variables
    assert values["jammed"].tolist() == [1, 0]
    assert values["converged"].tolist() == [1, 1]
    assert np.isnan(values["pair_strain"][1]).all()


def test_the_same_packing_gives_the_same_bytes(packing, tmp_path):
    short = replace(SHEAR, strain=2e-3)
    for name in ("one", "other"):
        write_block(tmp_path / name, complex_pairs_block(packings(packing), LAW, short, ASKED))
    assert (tmp_path / "one").read_bytes() == (tmp_path / "other").read_bytes()
