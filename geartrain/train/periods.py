"""Astronomical periods, speeds and counts with their sources (`periods.csv`); calendar dates and Julian days.

Years are astronomical: 0 is 1 BC, -204 is 205 BC. The Julian and the Gregorian calendar are both proleptic: their rules
apply to every year.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from importlib import resources
from types import MappingProxyType
from typing import Literal, cast

from geartrain.errors import suggest

Calendar = Literal["julian", "gregorian"]

REFORM = Fraction(4598321, 2)
"""Julian day of 1582-10-15 (Gregorian) at midnight, the day that followed 1582-10-04 (Julian)."""

MOST_YEARS = 10**9
_MARCH = {"julian": Fraction(3442235, 2), "gregorian": Fraction(3442239, 2)}
"""Julian day of midnight at the beginning of March 1 of the year 0, for each calendar."""
_PATTERN = re.compile(r"([+-]?\d{1,10})-(\d{1,2})-(\d{1,2})(?:[T ](\d{1,2}):(\d{2})(?::(\d{2}))?)?")


@dataclass(frozen=True, slots=True)
class CalendarDate:
    """Date in the Julian or Gregorian calendar, including the elapsed fraction of the day."""

    year: int
    """Astronomical year; the year 0 is 1 BC."""
    month: int
    """Number of the month, 1 to 12."""
    day: int
    """Number of the day in the month, beginning with 1."""
    part: Fraction
    """Elapsed fraction of the day, in [0, 1); 1/2 is noon."""
    calendar: Calendar
    """Name of the proleptic calendar, whose rules apply to all years."""

    def __str__(self) -> str:
        sign = "-" if self.year < 0 else ""
        return f"{sign}{abs(self.year):04d}-{self.month:02d}-{self.day:02d}"


def julian_day(date: CalendarDate) -> Fraction:
    """Return the Julian day of a date [d]. Day 31 of a month with 30 days means the first day of the next month."""
    # years begin in March here, so that a leap day is the last day of its year
    month = (date.month - 3) % 12
    year = date.year - (date.month < 3)
    days = 365 * year + year // 4 + (153 * month + 2) // 5 + date.day - 1
    if date.calendar == "gregorian":
        days += year // 400 - year // 100
    return _MARCH[date.calendar] + days + date.part


def date_of(day: Fraction, calendar: Calendar | None = None) -> CalendarDate:
    """Return the calendar date of a Julian day, by default in the calendar that was in use on that day."""
    calendar = calendar or ("julian" if day < REFORM else "gregorian")
    since = day - _MARCH[calendar]
    whole = since // 1
    year, rest = _split_gregorian(whole) if calendar == "gregorian" else _split_julian(whole)
    # inverse of (153 month + 2) // 5, the number of days before a month, counted from March
    month = (5 * rest + 2) // 153
    return CalendarDate(
        year + (month > 9), (month + 2) % 12 + 1, rest - (153 * month + 2) // 5 + 1, since - whole, calendar
    )


def read_date(text: str, calendar: Calendar | None = None) -> CalendarDate:
    """Parse a date from text, such as `-204-05-12` or `2000-01-01 18:30`."""
    found = _PATTERN.fullmatch(text.strip())
    if found is None:
        raise ValueError(f"'{text[:40]}' is not a date")
    year, month, day = (int(found[at]) for at in (1, 2, 3))
    hour, minute, second = (int(found[at] or 0) for at in (4, 5, 6))
    if abs(year) > MOST_YEARS or hour > 23 or minute > 59 or second > 59:
        raise ValueError(f"'{text}' is not a date")
    part = Fraction(3600 * hour + 60 * minute + second, 86400) if found[4] else Fraction(1, 2)
    chosen = calendar or ("julian" if (year, month, day) < (1582, 10, 15) else "gregorian")
    date = CalendarDate(year, month, day, part, chosen)
    # a date that does not exist is not preserved by conversion to a Julian day and back
    if date_of(julian_day(date), calendar) != date:
        raise ValueError(f"{date} does not exist in the {chosen} calendar{' of its time' if calendar is None else ''}")
    return date


def _split_julian(days: int) -> tuple[int, int]:
    """Return the number of whole Julian years in a number of days since 1 March, and the remaining days."""
    fours, rest = divmod(days, 1461)
    years = min(rest // 365, 3)
    return 4 * fours + years, rest - 365 * years


def _split_gregorian(days: int) -> tuple[int, int]:
    """Return the whole Gregorian years in a number of days since 1 March of the year 0, and the remaining days."""
    rounds, rest = divmod(days, 146097)
    hundreds = min(rest // 36524, 3)
    year, rest = _split_julian(rest - 36524 * hundreds)
    return 400 * rounds + 100 * hundreds + year, rest


@dataclass(frozen=True, slots=True)
class Period:
    """Row of the table of periods: an astronomical period, speed or count, with its source."""

    name: str
    """Name by which `unit` and `targets` of a declaration refer to this value."""
    kind: Literal["period", "speed", "count"]
    """Kind of the value: a period [d], a speed [turns per year], or a count."""
    value: Fraction
    """Exact value: a fraction as given by the source, or the decimal number as printed."""
    what: str
    """Subject of the motion or count; for a period that is used as a unit, its name in prose. It may be empty."""
    source: str
    """Source of the value."""
    confidence: str
    """Confidence in the value: "high" or "medium"."""


@cache
def period_table() -> Mapping[str, Period]:
    """Return all astronomical periods, speeds and counts that a declaration can refer to.

    Returns
    -------
    mapping of str to Period
        Periods by name.

    Examples
    --------
    >>> float(period_table()["month_synodic_J2000"].value)
    29.530588853
    """
    text = resources.files(__package__).joinpath("periods.csv").read_text(encoding="utf-8")
    rows = {}
    for row in csv.DictReader(text.splitlines()):
        value, kind = Fraction(row["exact"] or row["value"]), cast(Literal["period", "speed", "count"], row["kind"])
        rows[row["name"]] = Period(row["name"], kind, value, row["what"], row["source"], row["confidence"])
    return MappingProxyType(rows)


def suggested_period(name: str) -> str:
    """Return a suggestion of known periods for an unknown name."""
    return suggest(name, period_table(), otherwise="`geartrain periods` lists the names", wide=True)
