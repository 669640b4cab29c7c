"""Julian days of dates and dates of Julian days, by chapter 7 of J. Meeus, Astronomical Algorithms, 1998."""

from __future__ import annotations

import re
from fractions import Fraction
from math import floor

REFORM = (1582, 10, 15)


def julian_day(text: str) -> Fraction:
    """Return the Julian day of a date such as `-204-05-12 18:30`, by default at noon; Julian before the reform."""
    found = re.fullmatch(r"(-?\d+)-(\d+)-(\d+)(?: (\d+):(\d+))?", text)
    assert found is not None, text
    year, month, day = (int(each) for each in found.groups()[:3])
    century = floor((year - (month <= 2)) / 100)
    leap = 2 - century + century // 4 if (year, month, day) >= REFORM else 0
    if month <= 2:
        year, month = year - 1, month + 12
    whole = floor(Fraction(1461, 4) * (year + 4716)) + floor(Fraction(306001, 10000) * (month + 1)) + day + leap
    hour, minute = (int(each) for each in found.groups()[3:]) if found[4] else (12, 0)
    return whole - Fraction("1524.5") + Fraction(60 * hour + minute, 1440)


def date_of(day: Fraction) -> tuple[int, int, int, Fraction]:
    """Return year, month, day and the part of the day of a Julian day; Julian before the reform."""
    whole, part = divmod(day + Fraction(1, 2), 1)
    if whole >= 2299161:
        century = floor((whole - Fraction("1867216.25")) / Fraction("36524.25"))
        whole += 1 + century - century // 4
    b = int(whole) + 1524
    c = floor((b - Fraction("122.1")) / Fraction("365.25"))
    d = floor(Fraction("365.25") * c)
    e = floor((b - d) / Fraction("30.6001"))
    month = e - 1 if e < 14 else e - 13
    return c - 4716 if month > 2 else c - 4715, month, b - d - floor(Fraction("30.6001") * e), part
