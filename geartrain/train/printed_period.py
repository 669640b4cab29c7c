"""Period of an output as a source prints it: a time such as "27.32 d", "24 h 50 min 28.4 s" or "29 y 157 d".

A printed period is accurate to half a unit of its last digit. A year (y) is the train's unit of speed, because years
have several lengths.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction

from geartrain.numerics.exact import nearest_float
from geartrain.numerics.quantity import Figure, bad, scale

_NAMES = {"years": "y", "year": "y", "days": "d", "day": "d", "hours": "h", "hour": "h"}
_YEAR = "y"
_UNITS = (_YEAR, "d", "h", "min", "s")  # descending
_PART = re.compile(r"(\d+(?:\.\d*)?|\.\d+)\s*([a-z]+)\s*", re.ASCII)
_YEARS = 365, 366  # range of all astronomical and calendar years [d]
_EXTRA_DIGITS = 2  # of a computed period, more than the source prints


@dataclass(frozen=True, slots=True)
class PrintedPeriod(Figure):
    """Time as printed in a source. Its `value` [s] and `half` [s] do not include its years.

    Examples
    --------
    >>> printed = PrintedPeriod.parse("24 h 50 min 28.4 s")
    >>> printed.value, printed.half, printed.text_of(Fraction(89428378, 1000), None)
    (Fraction(447142, 5), Fraction(1, 20), '24 h 50 min 28.378 s')
    """

    years: Fraction
    """Number of years, which is 0 if none is printed."""
    units: tuple[str, ...]
    """Units of the parts: y, d, h, min, s, in descending order."""
    decimals: int
    """Number of printed decimals of the last part."""

    @property
    def above_zero(self) -> bool:
        """True if the time is not 0."""
        return self.value > 0 or self.years > 0

    @classmethod
    def parse(cls, raw: object) -> PrintedPeriod:
        """Parse a time with its units in descending order.

        Raises
        ------
        ValueError
            If `raw` is not such a time.
        """
        if isinstance(raw, PrintedPeriod):
            return raw
        text = str(raw).strip()
        parts = [(number, _NAMES.get(unit, unit)) for number, unit in _PART.findall(text[:100])]
        units = tuple(unit for _, unit in parts)
        ordered = units == tuple(unit for unit in _UNITS if unit in units)
        whole = all(number.isdigit() for number, _ in parts[:-1])
        if not parts or _PART.sub("", text) or not ordered or not whole:
            fix = "write a time such as 27.32 d, 24 h 50 min 28.4 s or 29 y 157 d; units: " + ", ".join(_UNITS)
            raise bad("period", f"'{text[:40]}' is not a period", fix)
        sizes = {unit: Fraction(number) for number, unit in parts}
        years = sizes.pop(_YEAR, Fraction(0))
        seconds = sum((size * scale(unit)[1] for unit, size in sizes.items()), Fraction(0))
        decimals = len(parts[-1][0].partition(".")[2])
        last = Fraction(0) if units == (_YEAR,) else scale(units[-1])[1]
        return cls(seconds, last / 10**decimals / 2, text, years, units, decimals)

    def in_seconds(self, year: Fraction | None) -> Figure:
        """Return the time and half a unit of its last digit [s].

        year   length of a year [s], which is used only if the time has years
        """
        length = year or Fraction(0)
        half = length / 10**self.decimals / 2 if self.units == (_YEAR,) else self.half
        return Figure(self.value + self.years * length, half, self.text)

    def text_of(self, seconds: Fraction, year: Fraction | None) -> str:
        """Return another time [s] in the units of this one, with more digits than are printed."""
        decimals = max(self.decimals + _EXTRA_DIGITS, 3)
        sizes = [(unit, (year or Fraction(1)) if unit == _YEAR else scale(unit)[1]) for unit in self.units]
        last = sizes[-1][1]
        rest = round(seconds / last, decimals) * last  # rounded first, so that no part reaches the unit above it
        words = []
        for unit, size in sizes[:-1]:
            count, rest = divmod(rest, size)
            words.append(f"{count} {unit}")
        return " ".join(
            [*words, f"{nearest_float(rest / last):.{decimals}f}".rstrip("0").rstrip(".") + f" {sizes[-1][0]}"]
        )


def is_printed_period(raw: object) -> bool:
    """Return True if a value is a text such as "29.53 d", which `PrintedPeriod` reads."""
    try:
        return isinstance(raw, str) and bool(PrintedPeriod.parse(raw))
    except ValueError:
        return False


def year_seconds(unit: Fraction | None) -> Fraction | None:
    """Return a unit of time [s] if it is a year; None for any other unit."""
    return unit if unit is not None and _YEARS[0] <= unit / 86400 <= _YEARS[1] else None
