"""A number and its standard error as one text, rounded together: 0.49987(30).

The error has two digits, which stand in parentheses in units of the last digit of the number:
0.49987(30) means 0.49987 ± 0.00030. Numbers below 1e-4 or from 1e6 on, and errors from 99.5 on,
have a common power of ten: 1.234(56)e-07 means (1.234 ± 0.056) 1e-7.
"""

from __future__ import annotations

import math
from decimal import Decimal

ROUND_OFF = 1e-12
"""An error below this part of the number is round-off, and is written as (0)."""

FIXED_POINT_EXPONENTS = range(-4, 6)
"""Decimal exponents of the first digit that are written without a power of ten."""


def value_with_error(value: float, error: float) -> str:
    """A number rounded to the second digit of its error, with this error in parentheses.

    An error of zero is written as (0) after six digits of the number, an infinite one as (inf)
    after three. Where the error is NaN, or the number is not finite, the number stands alone.

    Raises:
        ValueError: the error is negative.
    """
    if error < 0.0:
        raise ValueError(f"error of {value}: expected a standard error of 0 or more, got {error}")
    if not math.isfinite(value) or math.isnan(error):
        return f"{value:.3g}"
    if math.isinf(error):
        return _with_parentheses(f"{value:.3g}", "inf")
    if error <= ROUND_OFF * abs(value):
        return _with_parentheses(f"{value:.6g}", "0")
    two_digits = Decimal(f"{error:.1e}")
    last_digit = two_digits.adjusted() - 1
    rounded = Decimal(value).quantize(Decimal(1).scaleb(last_digit))
    exponent = max(rounded.adjusted() if rounded else last_digit, two_digits.adjusted())
    if exponent in FIXED_POINT_EXPONENTS and last_digit <= 0:
        exponent = 0
    mantissa = f"{rounded.scaleb(-exponent):z.{exponent - last_digit}f}"
    power = f"e{exponent:+03d}" if exponent else ""
    return f"{mantissa}({two_digits.scaleb(-last_digit):.0f}){power}"


def _with_parentheses(number: str, inside: str) -> str:
    mantissa, e, exponent = number.partition("e")
    return f"{mantissa}({inside}){e}{exponent}"
