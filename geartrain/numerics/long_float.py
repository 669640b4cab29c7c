"""Floats with an unbounded exponent: a float64 mantissa and an integer power of two."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from numbers import Rational
from typing import Any, Self

from geartrain.numerics.exact import decimal

LOWEST, HIGHEST = -1021, 1024
"""Range of exponents for which float64 represents mantissas from 1/2 to 1 with all 53 bits."""


@dataclass(frozen=True, slots=True, eq=False)
class LongFloat(Rational):
    """Number mantissa * 2**exponent with 53 bits, whose exponent exceeds the range of float64.

    Arithmetic rounds in the same way as for floats, and returns a float if float64 can represent the result. Operands
    may also be floats, integers and Fractions. `Fraction(value)` returns the exact value of the rounded number.

    Examples
    --------
    >>> number = LongFloat(0.75, 5000)
    >>> print(number, number / number)
    1.059350274e+1505 1.0
    """

    mantissa: float
    """Mantissa, from 1/2 (included) to 1 (excluded), or the negative of such a number."""
    exponent: int
    """Exponent of two."""

    @classmethod
    def make(cls, mantissa: float, exponent: int) -> Any:
        """Return the number mantissa * 2**exponent, as a float if float64 can represent it.

        Parameters
        ----------
        mantissa : float
            Any finite number.
        exponent : int
            Exponent of two.
        """
        return scaled(mantissa, exponent)

    @property
    def numerator(self) -> int:
        """Numerator of the value in lowest terms."""
        top, bottom = self.mantissa.as_integer_ratio()
        shift = self.exponent - (bottom.bit_length() - 1)
        return top << max(shift, 0)

    @property
    def denominator(self) -> int:
        """Denominator of the value in lowest terms."""
        _, bottom = self.mantissa.as_integer_ratio()
        return 1 << max(bottom.bit_length() - 1 - self.exponent, 0)

    def __add__(self, other: Any) -> Any:
        parts = _parts(other)
        if parts is None:
            return NotImplemented
        # larger exponent first: the other number is shifted down, which cannot overflow
        (high, top), (low, bottom) = sorted(((self.mantissa, self.exponent), parts), key=lambda each: -each[1])
        if not high or not low:  # the exponent of a zero is meaningless
            return self.make(low or high, top if high else bottom)
        return self.make(
            high + math.ldexp(low, max(bottom - top, -1000)), top
        )  # beyond 1000 bits the smaller number has no effect

    __radd__ = __add__

    def __neg__(self) -> Self:
        return type(self)(-self.mantissa, self.exponent)

    def __sub__(self, other: Any) -> Any:
        return NotImplemented if _parts(other) is None else self + -other

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        parts = _parts(other)
        if parts is None:
            return NotImplemented
        return self.make(self.mantissa * parts[0], self.exponent + parts[1])

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        parts = _parts(other)
        if parts is None:
            return NotImplemented
        return self.make(self.mantissa / parts[0], self.exponent - parts[1])

    def __rtruediv__(self, other: Any) -> Any:
        parts = _parts(other)
        if parts is None:
            return NotImplemented
        return self.make(parts[0] / self.mantissa, parts[1] - self.exponent)

    def __abs__(self) -> Self:
        return type(self)(abs(self.mantissa), self.exponent)

    def __bool__(self) -> bool:
        return self.mantissa != 0

    def __eq__(self, other: object) -> bool:
        return _parts(other) == (self.mantissa, self.exponent) and Fraction(self) == other

    def __hash__(self) -> int:  # type: ignore[override]
        return hash(Fraction(self))

    def __lt__(self, other: Any) -> bool:
        return bool(Fraction(self) < other)

    def __le__(self, other: Any) -> bool:
        return bool(Fraction(self) <= other)

    def __gt__(self, other: Any) -> bool:
        return bool(Fraction(self) > other)

    def __ge__(self, other: Any) -> bool:
        return bool(Fraction(self) >= other)

    def __pos__(self) -> Self:
        return self

    def __trunc__(self) -> int:
        return math.trunc(Fraction(self))

    def __floor__(self) -> int:
        return math.floor(Fraction(self))

    def __ceil__(self) -> int:
        return math.ceil(Fraction(self))

    def __round__(self, digits: int | None = None) -> Any:
        return round(Fraction(self), digits) if digits is not None else round(Fraction(self))

    def __floordiv__(self, other: Any) -> Any:
        return Fraction(self) // Fraction(other)

    def __rfloordiv__(self, other: Any) -> Any:
        return Fraction(other) // Fraction(self)

    def __mod__(self, other: Any) -> Any:
        return rounded(Fraction(self) % Fraction(other))

    def __rmod__(self, other: Any) -> Any:
        return rounded(Fraction(other) % Fraction(self))

    def __pow__(self, power: Any) -> Any:
        return rounded(Fraction(self) ** power) if isinstance(power, int) else NotImplemented

    def __rpow__(self, base: Any) -> Any:
        raise OverflowError(f"the exponent {self} is out of range")

    def __float__(self) -> float:
        raise OverflowError(f"{self} is out of the range of float64")

    def __str__(self) -> str:
        return format(self, ".10g")

    def __format__(self, spec: str) -> str:
        """Format the number like a float, with an optional sign and number of digits."""
        found = re.fullmatch(r"(\+?)(?:\.(\d+))?([eg]?)", spec)
        if found is None:
            raise ValueError(f"'{spec}' is not a format for long floats; use one such as '.10g'")
        digits = int(found[2] or 10) + (found[3] == "e")
        return ("+" if found[1] and self.mantissa > 0 else "") + decimal(Fraction(self), digits)


Real = float | LongFloat
"""Number with 53 bits and any exponent."""


def scaled(mantissa: float, exponent: int) -> Real:
    """Return mantissa * 2**exponent, as a float if float64 can represent it, else as a `LongFloat`."""
    if not exponent:
        return mantissa
    part, shift = math.frexp(mantissa)
    if not part:
        return 0.0
    power = shift + exponent
    return math.ldexp(part, power) if LOWEST <= power <= HIGHEST else LongFloat(part, power)


def rounded(value: Fraction) -> Real:
    """Return the nearest number with 53 bits."""
    part, power = split(value)
    return scaled(part, power)


def split(value: Fraction | int) -> tuple[float, int]:
    """Return the nearest mantissa, 1/2 to 1, and the exponent of two of an exact number; (0, 0) for 0."""
    top, bottom = value.numerator, value.denominator
    power = top.bit_length() - bottom.bit_length()
    # shifted to equal length, the quotient is between 1/2 and 2, and Python rounds a quotient of integers only once
    part, shift = math.frexp((top << max(-power, 0)) / (bottom << max(power, 0)))
    return part, (power + shift if part else 0)


def as_plain(value: Real | None) -> float | None:
    """Return a value if it is a float; None for a `LongFloat` or None."""
    return value if isinstance(value, float) else None


def _parts(value: Any) -> tuple[float, int] | None:
    if isinstance(value, LongFloat):
        return value.mantissa, value.exponent
    if isinstance(value, float):
        return math.frexp(value) if math.isfinite(value) else None
    return split(value) if isinstance(value, Fraction | int) else None
