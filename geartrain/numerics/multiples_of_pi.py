"""Rational substitute of pi in exact arithmetic, and the text of exact numbers that contain it.

Travel per revolution of a rack or a drum is a multiple of pi. Exact speeds are computed with a fixed rational number in
place of pi. Its numerator and denominator are primes above every tooth count, so that identities in pi are preserved
and no other number cancels by coincidence. A result contains pi if it changes when another such number is used.
"""

from __future__ import annotations

from fractions import Fraction

from geartrain.numerics.exact import abridged_text, decimal, fraction_text, is_short

PI = Fraction(3141592654841143, 1000000000398317)
"""Quotient of two primes that differs from pi by a factor of 1 + 1.7e-19, less than the rounding error of float64."""

OTHER_PI = Fraction(3141592654637417, 1000000000333469)
"""Second quotient of two primes, which differs from pi by a factor of 1 - 3e-19."""

_LONGEST = 24  # characters of the rational factor: longer factors are not printed as multiples of pi


def touches_pi(value: Fraction) -> bool:
    """Return True if a number has a prime factor of `PI`, as all of its rational multiples have."""
    parts = value.numerator, value.denominator
    return bool(value) and any(part % prime == 0 for part in parts for prime in (PI.numerator, PI.denominator))


def _factor(value: Fraction) -> tuple[Fraction, int]:
    """Return the rational factor of a multiple of a power of pi, 1 or -1, and the power; (value, 0) for others."""
    if value and value.numerator % PI.numerator == 0 and value.denominator % PI.denominator == 0:
        return value / PI, 1
    if value and value.numerator % PI.denominator == 0 and value.denominator % PI.numerator == 0:
        return value * PI, -1
    return value, 0


def with_other_pi(value: Fraction) -> Fraction:
    """Return a multiple of pi or 1/pi computed with `OTHER_PI` instead of `PI`; other numbers are unchanged."""
    factor, power = _factor(value)
    return factor * OTHER_PI**power


def integer_factors(number: int, pi: str = "π") -> list[str]:
    """Return the factors of a positive coefficient as texts: an integer, unless it is 1, and the letter pi.

    In a quotient of polynomials with powers of `PI`, all terms have the same total number of factors that are its
    numerator or denominator, so that the denominator can be omitted.

    >>> integer_factors(36 * PI.numerator), integer_factors(PI.denominator), integer_factors(6)
    (['36', 'π'], [], ['6'])
    """
    letters: list[str] = []
    for prime, letter in ((PI.numerator, [pi]), (PI.denominator, [])):
        while number >= prime and number % prime == 0:
            number, letters = number // prime, letters + letter
    return [fraction_text(number)] * (number != 1) + letters


def pi_text(value: Fraction) -> str:
    """Format an exact number; a multiple of pi or of 1/pi with a short factor is written with the letter, other numbers
    with a factor of `PI` as decimals.

    >>> pi_text(36 * PI), pi_text(-PI), pi_text(5 / (96 * PI)), pi_text(Fraction(5, 4)), pi_text(1 + PI)
    ('36 π', '-π', '5/(96 π)', '5/4', '≈ 4.14159265359')
    """
    if not touches_pi(value):
        return abridged_text(value)
    factor, power = _factor(value)
    if not power or not is_short(factor, _LONGEST):
        return f"≈ {decimal(value, 12)}"
    sign, top, bottom = "-" if factor < 0 else "", abs(factor.numerator), factor.denominator
    if power > 0:
        return f"{sign}{'' if top == 1 else f'{top} '}π" + (f"/{bottom}" if bottom > 1 else "")
    return f"{sign}{top}/" + (f"({bottom} π)" if bottom > 1 else "π")
