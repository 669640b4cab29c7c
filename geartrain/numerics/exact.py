"""Fractions of long integers without the gcds that their making would cost, their multiples, and the nearest floats."""

from __future__ import annotations

import math
from collections.abc import Iterable
from fractions import Fraction


def coprime(numerator: int, denominator: int) -> Fraction:
    """A Fraction from a reduced pair with a positive denominator, without the gcd that Fraction() would take.

    The gcd of long integers costs the square of their length, and a walk along a train has reduced already.
    """
    value = Fraction()
    value._numerator = numerator  # type: ignore[attr-defined]
    value._denominator = denominator  # type: ignore[attr-defined]
    return value


def times(n: int, d: int, a: int, b: int) -> tuple[int, int]:
    """n/d times a/b, reduced, denominator positive. n/d is reduced; a and b are short, so the gcds stay cheap."""
    if b < 0:
        a, b = -a, -b
    common = math.gcd(a, b)
    if common > 1:
        a //= common
        b //= common
    left = math.gcd(n, b)
    if left > 1:
        n //= left
        b //= left
    right = math.gcd(a, d)
    if right > 1:
        a //= right
        d //= right
    return n * a, d * b


def whole_multiple(values: Iterable[Fraction | int]) -> list[int]:
    """The shortest multiple in whole numbers, with the same signs."""
    some = list(values)
    if all(abs(value) == 1 for value in some):
        return [int(value) for value in some]
    scale = math.lcm(*(value.denominator for value in some))
    whole = [int(value * scale) for value in some]
    common = math.gcd(*whole) or 1
    return [value // common for value in whole]


def log10(value: Fraction) -> float:
    """Decimal logarithm of |value| for numbers of any size; -inf for zero."""
    if not value:
        return -math.inf
    # of integers of any length; their quotient as a float may not exist
    return math.log10(abs(value.numerator)) - math.log10(value.denominator)


def as_float(value: Fraction | float) -> float | None:
    """The nearest float64, or None where float64 has none: 0 or infinity would be silently wrong."""
    try:
        number = float(value)
    except OverflowError:
        return None
    if value and abs(number) < 2.2250738585072014e-308:  # subnormal: its last digits are lost
        return None
    return number
