"""A number and its error as one text: examples, and what the text says when it is read back."""

import math
import re
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grainmodes.statistics.rounding import ROUND_OFF, value_with_error


@pytest.mark.parametrize(
    ("value", "error", "expected"),
    [
        (0.4998712, 0.000297, "0.49987(30)"),
        (1.2341e-7, 5.6e-9, "1.234(56)e-07"),
        (0.9999999, 1e-5, "1.000000(10)"),
        (0.5, 0.0003, "0.50000(30)"),
        (-5.18e-8, 6e-8, "-5.2(60)e-08"),
        (3.26, 0.6, "3.26(60)"),
        (3.26, 0.0996, "3.26(10)"),
        (12.3, 9.96, "12(10)"),
        (1234.0, 56.0, "1234(56)"),
        (1234.0, 99.6, "1.23(10)e+03"),
        (123456.7, 0.56, "123456.70(56)"),
        (1234567.0, 1.0, "1.2345670(10)e+06"),
        (9.96e-8, 1e-10, "9.960(10)e-08"),
        (0.0, 0.25, "0.00(25)"),
        (-0.001, 0.25, "0.00(25)"),
        (0.0, 1e-9, "0.0(10)e-09"),
        (1e-3, 5.0, "0.0(50)"),
        (2.0, 0.0, "2(0)"),
        (0.0, 0.0, "0(0)"),
        (-0.125, 0.0, "-0.125(0)"),
        (1.25e-9, 0.0, "1.25(0)e-09"),
        (2.0, 1e-16, "2(0)"),
        (0.12345, math.nan, "0.123"),
        (0.12345, math.inf, "0.123(inf)"),
        (1.2345e-9, math.inf, "1.23(inf)e-09"),
        (math.nan, 0.1, "nan"),
        (math.nan, math.nan, "nan"),
        (-math.inf, 0.1, "-inf"),
        (1e300, 1e295, "1.000000(10)e+300"),
        (5e-324, 5e-324, "4.9(49)e-324"),
    ],
)
def test_examples(value, error, expected):
    assert value_with_error(value, error) == expected


def test_a_negative_error_is_refused():
    with pytest.raises(ValueError, match=r"error of 2.0: expected .* 0 or more, got -0.1"):
        value_with_error(2.0, -0.1)


def parsed(text: str) -> tuple[Fraction, Fraction, Fraction]:
    """The number, its error and a unit of the last digit, exactly."""
    sign, whole, digits, inside, power = re.fullmatch(
        r"(-?)(\d+)\.?(\d*)\((\d+)\)(?:e([+-]\d+))?", text
    ).groups()
    unit = Fraction(10) ** (int(power or 0) - len(digits))
    return int(sign + whole + digits) * unit, int(inside) * unit, unit


FINITE = st.floats(allow_nan=False, allow_infinity=False)


@given(FINITE, FINITE.map(abs))
def test_the_text_lies_within_half_a_unit_of_the_last_digit(value, error):
    read, read_error, unit = parsed(value_with_error(value, error))
    assert abs(read - Fraction(value)) <= unit / 2
    if error > ROUND_OFF * abs(value):
        assert abs(read_error - Fraction(error)) <= unit / 2
        assert 10 <= read_error / unit <= 99
    else:
        assert read_error == 0


@given(FINITE, FINITE.map(abs))
def test_a_power_of_ten_follows_a_single_digit(value, error):
    text = value_with_error(value, error)
    if "e" in text:
        assert re.match(r"-?\d(\.\d+)?\(", text)


@given(FINITE, FINITE.map(abs))
def test_the_sign_is_that_of_what_is_left_of_the_number(value, error):
    text = value_with_error(value, error)
    read, _, _ = parsed(text)
    assert text.startswith("-") == (read < 0) or error <= ROUND_OFF * abs(value)
    assert value_with_error(-value, error).lstrip("-") == text.lstrip("-")
