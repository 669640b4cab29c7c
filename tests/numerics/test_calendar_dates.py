"""Dates and Julian days against published ones, against the standard library and against each other."""

from __future__ import annotations

from datetime import date
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from geartrain.train.periods import date_of, julian_day, read_date

REFORM = Fraction("2299160.5")  # 1582-10-15

# J. Meeus, Astronomical Algorithms, 2nd edition, 1998, p. 61 f.; the decimals are those of the day
MEEUS = [
    ("2000-01-01", "1.5", "2451545.0"),
    ("1999-01-01", "1.0", "2451179.5"),
    ("1987-01-27", "27.0", "2446822.5"),
    ("1987-06-19", "19.5", "2446966.0"),
    ("1988-01-27", "27.0", "2447187.5"),
    ("1988-06-19", "19.5", "2447332.0"),
    ("1957-10-04", "4.81", "2436116.31"),
    ("1900-01-01", "1.0", "2415020.5"),
    ("1600-01-01", "1.0", "2305447.5"),
    ("1600-12-31", "31.0", "2305812.5"),
    ("0837-04-10", "10.3", "2026871.8"),
    ("0333-01-27", "27.5", "1842713.0"),
    ("-123-12-31", "31.0", "1676496.5"),
    ("-122-01-01", "1.0", "1676497.5"),
    ("-1000-07-12", "12.5", "1356001.0"),
    ("-1000-02-29", "29.0", "1355866.5"),
    ("-1001-08-17", "17.9", "1355671.4"),
    ("-4712-01-01", "1.5", "0.0"),
]


@pytest.mark.parametrize(("text", "day", "published"), MEEUS)
def test_julian_days_are_those_printed_by_meeus(text: str, day: str, published: str) -> None:
    read = read_date(text)
    assert julian_day(read) - read.part + Fraction(day) % 1 == Fraction(published)
    assert date_of(Fraction(published)).day == read.day


def test_a_date_without_an_hour_is_noon_and_the_reform_leaves_out_ten_days() -> None:
    assert julian_day(read_date("-204-05-12")) == julian_day(read_date("-0204-5-12 12:00"))
    assert julian_day(read_date("1582-10-15 00:00")) == REFORM
    assert julian_day(read_date("1582-10-04 00:00")) == REFORM - 1
    assert str(date_of(REFORM - 1)) == "1582-10-04"
    for text in ("1582-10-10", "1582-10-14", "1581-02-29", "2000-02-30", "2000-13-01", "2000-00-01", "2000-01-00"):
        with pytest.raises(ValueError, match="does not exist"):
            read_date(text)
    for text in ("", "soon", "2000", "2000-01-01 24:00", "2000-01-01 12", "99999999999-01-01", "12 May 205 BC"):
        with pytest.raises(ValueError, match="is not a date"):
            read_date(text)
    assert julian_day(read_date("1582-10-10", "gregorian")) == julian_day(read_date("1582-09-30", "julian"))


@given(st.dates())
def test_gregorian_days_are_those_of_the_standard_library(day: date) -> None:
    read = read_date(f"{day.isoformat()} 00:00", "gregorian")
    assert julian_day(read) - Fraction("1721424.5") == day.toordinal()  # whose day 1 is 0001-01-01


@given(st.fractions(-(10**9), 10**9), st.sampled_from(["julian", "gregorian", None]))
def test_a_day_is_that_of_its_date(day: Fraction, calendar: str | None) -> None:
    found = date_of(day, calendar)  # type: ignore[arg-type]
    assert julian_day(found) == day
    assert 0 <= found.part < 1


@given(st.integers(-(10**6), 10**6))
def test_a_julian_year_has_a_leap_day_in_every_fourth(year: int) -> None:
    first, next_ = (julian_day(read_date(f"{each}-01-01", "julian")) for each in (year, year + 1))
    assert next_ - first == (366 if year % 4 == 0 else 365)
    first, next_ = (julian_day(read_date(f"{each}-01-01", "gregorian")) for each in (year, year + 1))
    assert next_ - first == (366 if year % 4 == 0 and (year % 100 != 0 or year % 400 == 0) else 365)
