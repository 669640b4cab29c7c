"""Rational stand-in for pi in exact arithmetic, and the text of exact numbers that contain it.

Travel per revolution of a rack or a drum is a multiple of pi. Exact speeds are computed with a fixed rational number in
place of pi. Its numerator and denominator are primes above every tooth count, so that identities in pi are preserved
and no other number cancels by coincidence. A result contains pi if it changes when another such number is used.
"""

from __future__ import annotations

from fractions import Fraction

from geartrain.numerics.exact import abridged_text, is_short

PI = Fraction(3141592654841143, 1000000000398317)
"""Quotient of two primes that differs from pi by a factor of 1 + 1.7e-19, less than the rounding error of float64."""

OTHER_PI = Fraction(3141592654637417, 1000000000333469)
"""Second quotient of two primes, which differs from pi by a factor of 1 - 3e-19."""

_LONGEST = 24  # characters of the rational factor: longer factors are not printed as multiples of pi


def has_pi(value: Fraction | int) -> bool:
    """Return True if a number is a rational multiple of `PI` or of its inverse."""
    value = Fraction(value)
    return bool(value) and any(
        top % PI.numerator == 0 and bottom % PI.denominator == 0
        for top, bottom in ((value.numerator, value.denominator), (value.denominator, value.numerator))
    )


def with_other_pi(multiple: Fraction) -> Fraction:
    """Return a multiple of pi, or a number without pi, computed with `OTHER_PI` instead of `PI`."""
    if not has_pi(multiple):
        return multiple
    return multiple / PI * OTHER_PI if multiple.numerator % PI.numerator == 0 else multiple * PI / OTHER_PI


def pi_text(value: Fraction) -> str:
    """Format an exact number; a multiple of pi or of 1/pi is written with the letter.

    >>> pi_text(36 * PI), pi_text(-PI), pi_text(5 / (96 * PI)), pi_text(Fraction(5, 4))
    ('36 π', '-π', '5/(96 π)', '5/4')
    """
    if not has_pi(value):
        return abridged_text(value)
    up = value.numerator % PI.numerator == 0
    factor = value / PI if up else value * PI
    if not is_short(factor, _LONGEST):
        return abridged_text(value)
    sign, top, bottom = "-" if factor < 0 else "", abs(factor.numerator), factor.denominator
    if up:
        head = "π" if top == 1 else f"{top} π"
        return f"{sign}{head}" + (f"/{bottom}" if bottom > 1 else "")
    return f"{sign}{top}/" + (f"({bottom} π)" if bottom > 1 else "π")
