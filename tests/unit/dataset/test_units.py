"""Units: their powers under each normal law, their texts, and where the law is read from."""

from fractions import Fraction

import pytest

from example_packings import REMEMBERING_DISPLACEMENT, REMEMBERING_FORCE
from grainmodes.dataset import VARIABLES, units
from grainmodes.dataset.units import FORCE_EXPONENT, FORCE_SPRINGS, Laws, laws_of
from grainmodes.parameters.law import NORMAL_LAWS, TANGENTIAL_LAWS


@pytest.mark.parametrize(
    ("unit", "hertz", "harmonic", "unknown"),
    [
        (units.FORCE, "k_N d^(3/2)", "k_N d", "f_0"),
        (units.MODULUS, "k_N d^(1/2)", "k_N", "f_0 d^-1"),
        (units.ENERGY, "k_N d^(5/2)", "k_N d^2", "f_0 d"),
        (units.AREA, "d^2", "d^2", "d^2"),
        (units.NUMBER, "1", "1", "1"),
        (units.RATE, "1/t_0", "1/t_0", "1/t_0"),
        (units.SPRING_STATE, "d or k_N d^(3/2)", "d or k_N d", "d or f_0"),
    ],
)
def test_a_unit_is_written_as_its_law_demands(unit, hertz, harmonic, unknown):
    assert [unit.text(Laws(law)) for law in ("hertz", "harmonic", "")] == [hertz, harmonic, unknown]


@pytest.mark.parametrize(("normal", "power"), [("hertz", Fraction(-1, 4)), ("harmonic", 0)])
def test_time_follows_from_force_mass_and_length(normal, power):
    half = Fraction(1, 2)
    assert units.TIME.powers(normal) == {"k_N": -half, "d": power, "m": half}


def test_what_a_spring_remembers_has_the_unit_of_its_law():
    for name, _ in REMEMBERING_DISPLACEMENT:
        assert units.SPRING_STATE.text(Laws("hertz", name)) == "d"
    for name, _ in REMEMBERING_FORCE:
        assert units.SPRING_STATE.text(Laws("hertz", name)) == "k_N d^(3/2)"
    names = {name for name, _ in (*REMEMBERING_DISPLACEMENT, *REMEMBERING_FORCE)}
    assert names == set(TANGENTIAL_LAWS)
    assert set(FORCE_SPRINGS) == {name for name, _ in REMEMBERING_FORCE}


def test_every_normal_law_has_a_unit_of_force():
    assert set(FORCE_EXPONENT) == set(NORMAL_LAWS)


def test_symbols_name_one_unit_each():
    symbols = {}
    for variable in VARIABLES.values():
        unit = variable.unit
        if unit.symbol:
            assert symbols.setdefault(unit.symbol, unit) == unit


@pytest.mark.parametrize(
    ("config", "laws"),
    [
        ({}, Laws()),
        ({"normal": "harmonic", "compression": {"masses": "area"}}, Laws("harmonic")),
        (
            {"normal": "hertz", "law": {"normal": "hertz", "tangential": "elastic"}},
            Laws("hertz", "elastic"),
        ),
        ({"contact_law": {"normal": "harmonic"}, "protocol": {"shear": {}}}, Laws("harmonic")),
        (
            {
                "packings": {"normal": "hertz"},
                "shear": {"law": {"normal": "hertz", "tangential": "elastic_force"}},
            },
            Laws("hertz", "elastic_force"),
        ),
    ],
)
def test_the_laws_are_those_of_the_configuration(config, laws):
    assert laws_of(config) == laws
