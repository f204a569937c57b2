"""Contact laws against their slow twins; their slopes against complex steps of the twins."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import naive
from example_packings import FRICTIONLESS, LAWS, few, law_name
from grainmodes.configuration.schema import schema
from grainmodes.kernels import laws
from grainmodes.kernels.compiler import kernel
from grainmodes.kernels.contacts import contact_forces, normal_slope
from grainmodes.kernels.laws import (
    Elastic,
    ElasticForce,
    Frictionless,
    Harmonic,
    Hertz,
    Interaction,
    SharpCoulomb,
    SharpCoulombForce,
    SmoothedCoulomb,
    clip_to_coulomb,
    tangential_response,
)
from grainmodes.parameters.law import (
    COULOMB_LAWS,
    ELASTIC_LAWS,
    NORMAL_LAWS,
    TANGENTIAL_LAWS,
    ContactLaw,
)

RIGHT = np.array([[1.0, 0.0]])
overlaps = st.floats(1e-6, 0.3)
ratios = st.floats(-3.0, 3.0).filter(lambda r: abs(abs(r) - 1.0) > 1e-3 and r != 0.0)


@kernel
def response(tangential, normal, overlap, displacement):
    return tangential_response(tangential, normal, overlap, displacement)


@kernel
def kept(tangential, normal, overlap, displacement):
    return clip_to_coulomb(tangential, normal, overlap, displacement)


def threshold(law: ContactLaw, overlap: float) -> float:
    """Where the Coulomb laws begin to slip; an arbitrary scale for the elastic ones."""
    return naive.threshold(law, overlap) if law.friction_coefficient else overlap / law.kt


@pytest.mark.parametrize("law", LAWS, ids=law_name)
@few(50)
@given(overlap=overlaps, ratio=ratios)
def test_forces_are_those_of_the_slow_twin(law, overlap, ratio):
    s = ratio * threshold(law, overlap)
    forces = contact_forces(Interaction.from_law(law), RIGHT, np.array([overlap]), np.array([s]))
    f_n, f_t = naive.normal_force(law, overlap), naive.tangential_force(law, overlap, s)
    np.testing.assert_allclose(forces, [[f_n, -f_t, f_t]], rtol=1e-13)


@pytest.mark.parametrize("law", LAWS, ids=law_name)
@few(50)
@given(overlap=overlaps, ratio=ratios)
def test_slopes_are_complex_steps_of_the_force(law, overlap, ratio):
    s, h = ratio * threshold(law, overlap), naive.COMPLEX_STEP
    interaction = Interaction.from_law(law)
    _, by_s, by_overlap = response(interaction.tangential, interaction.normal, overlap, s)
    slid = s + naive.remembered(law, overlap, 1j * h)
    exact_by_s = naive.tangential_force(law, overlap, slid).imag / h
    exact_by_overlap = np.imag(naive.tangential_force(law, overlap + 1j * h, s)) / h
    assert by_s == pytest.approx(exact_by_s, rel=1e-11, abs=1e-14)
    assert by_overlap == pytest.approx(exact_by_overlap, rel=1e-11, abs=1e-14)


@pytest.mark.parametrize("law", FRICTIONLESS, ids=law_name)
def test_normal_slope_is_a_complex_step_of_the_force(law):
    overlap, h = np.array([1e-9, 1e-4, 0.02, 0.3]), naive.COMPLEX_STEP
    slope = normal_slope(Interaction.from_law(law).normal, overlap)
    exact = [naive.normal_force(law, xi + 1j * h).imag / h for xi in overlap]
    np.testing.assert_allclose(slope, exact, rtol=1e-13)


@pytest.mark.parametrize("law", [law for law in LAWS if law.friction_coefficient], ids=law_name)
@few(50)
@given(overlap=overlaps, ratio=st.floats(-5.0, 5.0))
def test_coulomb_laws_obey_coulomb(law, overlap, ratio):
    interaction = Interaction.from_law(law)
    f_t, _, _ = response(
        interaction.tangential, interaction.normal, overlap, ratio * threshold(law, overlap)
    )
    limit = law.friction_coefficient * naive.normal_force(law, overlap)
    assert abs(f_t) <= limit * (1 + 1e-12)
    if abs(ratio) > 1.0:
        assert f_t == pytest.approx(-np.sign(ratio) * limit, rel=1e-12)


@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_smoothed_coulomb_meets_the_coulomb_force_with_slope_zero(normal, sign):
    law, overlap = ContactLaw(normal, "smoothed_coulomb", 0.3, 0.4), 0.05
    interaction, s = Interaction.from_law(law), sign * threshold(law, overlap)
    below, above = (
        response(interaction.tangential, interaction.normal, overlap, s * (1 + side))
        for side in (-1e-10, 1e-10)
    )
    np.testing.assert_allclose(below, above, rtol=1e-7, atol=1e-9)
    assert above[1] == 0.0


@pytest.mark.parametrize("normal", ["hertz", "harmonic"])
def test_only_sharp_coulomb_gives_displacement_away(normal):
    overlap = 0.05
    for law in (law for law in LAWS if law.normal == normal):
        interaction, limit = Interaction.from_law(law), threshold(law, overlap)
        sharp = law.tangential.startswith("sharp_coulomb")
        for s in (-2 * limit, -0.5 * limit, 0.0, 0.9 * limit, 3 * limit):
            expected = float(np.clip(s, -limit, limit)) if sharp else s
            left = kept(interaction.tangential, interaction.normal, overlap, s)
            assert left == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize(
    ("law", "normal", "tangential"),
    [
        (ContactLaw("hertz", "elastic", 0.1), Hertz(1.0), Elastic(0.1)),
        (ContactLaw("harmonic", "elastic", 2), Harmonic(1.0), Elastic(2.0)),
        (ContactLaw("hertz", "smoothed_coulomb", 0.1, 9), Hertz(1.0), SmoothedCoulomb(0.1, 9.0)),
        (ContactLaw("harmonic", "sharp_coulomb", 1, 0.5), Harmonic(1.0), SharpCoulomb(1.0, 0.5)),
        (ContactLaw("hertz", "elastic_force", 0.1), Hertz(1.0), ElasticForce(0.1)),
        (ContactLaw("hertz", "sharp_coulomb_force", 1, 2), Hertz(1.0), SharpCoulombForce(1.0, 2.0)),
    ],
)
def test_a_law_is_a_type(law, normal, tangential):
    interaction = Interaction.from_law(law)
    # Named tuples of different types are equal if their numbers are: compare the types as well.
    assert (type(interaction.normal), interaction.normal) == (type(normal), normal)
    assert (type(interaction.tangential), interaction.tangential) == (type(tangential), tangential)


@pytest.mark.parametrize("tangential", TANGENTIAL_LAWS)
def test_no_stiffness_is_no_friction(tangential):
    assert (
        type(Interaction.from_law(ContactLaw("hertz", tangential, 0.0)).tangential) is Frictionless
    )


@pytest.mark.parametrize(
    ("law", "named"),
    [
        (ContactLaw("hooke"), "hooke"),
        (ContactLaw("hertz", "glue", 1.0), "glue"),
        (ContactLaw("hertz", "elastic", -1e-8), "-1e-08"),
        (ContactLaw("hertz", "elastic", float("nan")), "nan"),
        (ContactLaw("hertz", "sharp_coulomb", 1.0), "None"),
        (ContactLaw("hertz", "smoothed_coulomb", 1.0, 0.0), "0.0"),
        (ContactLaw("hertz", "smoothed_coulomb", 1.0, float("nan")), "nan"),
    ],
)
def test_a_law_that_is_none_is_refused_by_name(law, named):
    with pytest.raises(ValueError, match=named):
        Interaction.from_law(law)


def test_the_names_of_scenes_are_those_of_the_types():
    def coulomb(name):
        return "friction_coefficient" in laws.TANGENTIAL[name]._fields

    assert set(laws.NORMAL) == set(NORMAL_LAWS)
    assert {name for name in laws.TANGENTIAL if coulomb(name)} == set(COULOMB_LAWS)
    assert {name for name in laws.TANGENTIAL if not coulomb(name)} == set(ELASTIC_LAWS)
    keys = schema()["properties"]["contact_law"]["properties"]
    assert keys["normal"]["enum"] == list(NORMAL_LAWS)
    assert keys["tangential"]["enum"] == list(TANGENTIAL_LAWS)
