"""Integers and Fractions of any length: products with few gcds, nearest floats, multiples of pi, and full or abridged
text.

Python's limit on the number of digits in conversions to text is neither exceeded nor changed.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from decimal import MAX_EMAX, Context, Decimal, localcontext
from fractions import Fraction


def coprime(numerator: int, denominator: int) -> Fraction:
    """Return a Fraction from coprime numerator and positive denominator, without the gcd of long integers."""
    value = Fraction()
    value._numerator = numerator  # type: ignore[attr-defined]
    value._denominator = denominator  # type: ignore[attr-defined]
    return value


def times(n: int, d: int, a: int, b: int) -> tuple[int, int]:
    """Return the product of n/d and a/b as numerator and positive denominator without common factors, as in n and d."""
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
    """Return the smallest integers that are proportional to the values and have the same signs."""
    some = list(values)
    if all(abs(value) == 1 for value in some):
        return [int(value) for value in some]
    scale = math.lcm(*(value.denominator for value in some))
    whole = [int(value * scale) for value in some]
    common = math.gcd(*whole) or 1
    return [value // common for value in whole]


def log10(value: Fraction) -> float:
    """Return the decimal logarithm of the magnitude of a number of any size; -inf for zero."""
    if not value:
        return -math.inf
    # logarithms of long integers are floats, even if their quotient overflows
    return math.log10(abs(value.numerator)) - math.log10(value.denominator)


def as_float(value: Fraction | float) -> float | None:
    """Return the nearest float64; None if the value overflows or is subnormal."""
    try:
        number = float(value)
    except OverflowError:
        return None
    if value and abs(number) < 2.2250738585072014e-308:  # subnormal: it has fewer than 53 significant bits
        return None
    return number


def nearest_float(value: Fraction) -> float:
    """Return the nearest float64; beyond its range, return 0 or an infinity with the sign of the value."""
    number = as_float(value)
    if number is not None:
        return number
    return math.copysign(0.0 if abs(value) < 1 else math.inf, -1 if value < 0 else 1)


def decimal(value: Fraction, digits: int = 10) -> str:
    """Format a number of any size in decimal notation.

    Parameters
    ----------
    value : Fraction
        Number to format.
    digits : int
        Number of significant digits.

    Returns
    -------
    str
        Number, formatted as a float is by the format specifier `g`.

    Examples
    --------
    >>> from fractions import Fraction
    >>> decimal(Fraction(254, 19), 6), decimal(Fraction(-1, 3) ** 700, 4)
    ('13.3684', '1.035e-334')
    """
    number = as_float(value)
    if number is not None:
        return f"{number:.{digits}g}"
    # a quotient of Decimals is rounded correctly, whatever the length of its terms
    with localcontext(Context(prec=digits, Emax=MAX_EMAX, Emin=-MAX_EMAX)):
        return f"{Decimal(value.numerator) / Decimal(value.denominator):.{digits - 1}e}"


_PLAIN, _SHORT = 2000, 600
"""Maximum bit length and maximum number of decimal digits of an integer that is converted with `str` or `int`. Python's
own limit is at least 640 digits, so it is never reached.
"""


def fraction_text(value: Fraction | int) -> str:
    """Format an integer or Fraction of any size with all digits, as `str` does.

    By default, Python does not convert integers with more than 4300 digits. This function does not change that limit.

    >>> fraction_text(Fraction(-254, 19)), len(fraction_text(7**20_000))
    ('-254/19', 16902)
    """
    top, bottom = value.numerator, value.denominator
    return _digits(top) if bottom == 1 else f"{_digits(top)}/{_digits(bottom)}"


def read_fraction(text: str) -> Fraction:
    """Parse a number of any size from text in the format of `fraction_text`.

    >>> read_fraction("-254/19"), read_fraction(fraction_text(7**20_000)) == 7**20_000
    (Fraction(-254, 19), True)
    """
    top, _, bottom = text.partition("/")
    if max(len(top), len(bottom)) <= _SHORT:
        return Fraction(text)
    return coprime(int(Decimal(top)), int(Decimal(bottom or "1")))


def abridged_text(value: Fraction | int) -> str:
    """Format a number with all its digits if they fit in 40 characters. For a longer number, give only the number of
    digits.

    >>> abridged_text(Fraction(11, 10) ** 5), abridged_text(Fraction(11, 10) ** 5000)
    ('161051/100000', '(5207 digits)/(5001 digits)')
    """
    if is_short(value, 40):
        return fraction_text(value)
    top, bottom = value.numerator, value.denominator
    return f"({count_digits(top)} digits)" + (f"/({count_digits(bottom)} digits)" if bottom != 1 else "")


_PREFIXES = ((1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"))  # SI prefixes; below 1e-6 nano is used


def watts_text(power: float) -> str:
    """Format a power [W] with a suitable SI prefix and four digits.

    >>> watts_text(0.0025), watts_text(0)
    ('2.5 mW', '0 W')
    """
    for size, prefix in _PREFIXES:
        if abs(power) >= size:
            return f"{power / size:.4g} {prefix}W"
    return f"{power * 1e9:.4g} nW" if power else "0 W"


def percent_text(part: Fraction | float, digits: int = 4) -> str:
    """Format a ratio as a percentage, or as a multiple if its magnitude is 10 or more.

    >>> percent_text(Fraction(46, 47)), percent_text(Fraction(2588, 10))
    ('97.87 %', '258.8 times')
    """
    return f"{float(100 * part):.{digits}g} %" if abs(float(part)) < 10 else f"{float(part):.{digits}g} times"


def percent_of_text(part: Fraction, whole: str) -> str:
    """Format a ratio as a percentage of a named whole, or as a multiple if its magnitude is 10 or more.

    >>> percent_of_text(Fraction(1, 2), "the power in"), percent_of_text(Fraction(2588, 10), "the power in")
    ('50 % of the power in', '258.8 times the power in')
    """
    return f"{percent_text(part)} of {whole}" if abs(part) < 10 else f"{percent_text(part)} {whole}"


def plural(count: int, noun: str) -> str:
    """Return a count with its noun in singular or plural form: `1 loop`, `2 loops`."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def is_short(value: Fraction | int, most: int) -> bool:
    """Return True if all digits of a number fit in `most` characters."""
    bits = value.numerator.bit_length() + value.denominator.bit_length()
    return bits < 4 * most + 8 and len(fraction_text(value)) <= most


def count_digits(number: int) -> int:
    """Count the decimal digits of an integer without converting it to text."""
    number = abs(number)
    if number < 10:
        return 1
    power = math.log10(number)
    nearest = round(power)
    if abs(power - nearest) > 1e-9:  # the relative error of the logarithm is 1e-15, also for a million digits
        return math.floor(power) + 1
    ten: int = 10**nearest
    return nearest + (number >= ten)


def _digits(number: int) -> str:
    # Decimals have no limit on their number of digits, and their constructor never rounds
    return str(number) if number.bit_length() <= _PLAIN else str(Decimal(number))


# ------------------------------------------------------------------------------------------------------ multiples of pi

# travel per revolution of a rack or a drum is a multiple of pi: exact speeds are computed with a rational substitute,
# and a result contains pi if it changes when another substitute is used
PI = Fraction(3141592654841143, 1000000000398317)
"""Quotient of two primes that differs from pi by a factor of 1 + 1.7e-19, less than the rounding error of float64.

The primes exceed every tooth count, so that identities in pi are preserved and no other number cancels by coincidence.
"""

OTHER_PI = Fraction(3141592654637417, 1000000000333469)
"""Second quotient of two primes, which differs from pi by a factor of 1 - 3e-19."""

_LONGEST = 24  # characters of the rational factor: longer factors are not printed as multiples of pi


def touches_pi(value: Fraction) -> bool:
    """Return True if a number has a prime factor of `PI`; all rational multiples of `PI` have one."""
    parts = value.numerator, value.denominator
    return bool(value) and any(part % prime == 0 for part in parts for prime in (PI.numerator, PI.denominator))


def _factor(value: Fraction) -> tuple[Fraction, int]:
    """Return factor and power (1 or -1) of a rational multiple of pi or 1/pi; the number and 0 for other numbers."""
    if value and value.numerator % PI.numerator == 0 and value.denominator % PI.denominator == 0:
        return value / PI, 1
    if value and value.numerator % PI.denominator == 0 and value.denominator % PI.numerator == 0:
        return value * PI, -1
    return value, 0


def with_other_pi(value: Fraction) -> Fraction:
    """Return a multiple of pi or 1/pi with pi approximated by `OTHER_PI`; return other numbers unchanged."""
    factor, power = _factor(value)
    return factor * OTHER_PI**power


def integer_factors(number: int, pi: str = "π") -> list[str]:
    """Return the factors of a positive coefficient as strings: an integer, unless it is 1, and the letter pi.

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
    """Format an exact number. Short multiples of pi or 1/pi are written with the letter, other numbers with a factor of
    `PI` as decimals.

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
