"""The epoch of a declaration: read, judged, and what it means."""

from __future__ import annotations

from fractions import Fraction

import pytest

from geartrain import load
from geartrain.errors import DeclarationError

TRAIN = """
name: days
sources: {S: A book}
frame: frame
links: {{frame: {{}}, a: {{wheels: {{x: 10}}}}, b: {{wheels: {{y: 20}}}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
gears: [x ~ y]
inputs: {{a: 1}}
{more}
"""


def read(more: str) -> object:
    return load(TRAIN.replace("{S: A book}", "{{S: A book}}").format(more=more)).declaration.epoch


def test_a_bare_date_is_the_epoch_at_no_turns() -> None:
    epoch = read("unit: {per: 1 d}\nepoch: 2000-01-01")
    assert (epoch.julian_day, epoch.turns.value, epoch.calendar) == (2451545, 0, None)  # type: ignore[attr-defined]


def test_a_date_has_an_hour_a_calendar_and_turns() -> None:
    epoch = read("unit: {per: 1 d}\nepoch: {date: -4712-01-01 18:00, calendar: julian, turns: 19/470, source: S}")
    assert epoch.julian_day == Fraction(1, 4)  # type: ignore[attr-defined]
    assert epoch.turns.value == Fraction(19, 470)  # type: ignore[attr-defined]


def test_the_epoch_of_the_saros_dial_is_a_full_moon() -> None:
    epoch = load("freeth-2008").declaration.epoch
    # mean phases of the Moon: J. Meeus, Astronomical Algorithms, 2nd edition, 1998, equation (49.1); k + 1/2 is full
    k = Fraction(-54511, 2)
    century = k / Fraction("1236.85")
    full = Fraction("2451550.09766") + Fraction("29.530588861") * k + Fraction("0.00015437") * century**2
    assert abs(full - epoch.julian_day) < Fraction(1, 2)  # the true one is up to 14 h from the mean
    assert epoch.turns.value == Fraction(1, 2) / Fraction(235, 19)  # half of one of 235 months in 19 years
    assert load("freeth-2021").declaration.epoch == epoch
    assert load("voulgaris-2022").declaration.epoch is None


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("unit: {per: 1 d}\nepoch: 1582-10-10", "1582-10-10 does not exist"),
        ("unit: {per: 1 d}\nepoch: soon", "'soon' is not a date"),
        ("unit: {per: 1 d}\nepoch: {date: 2000-01-01, source: T}", "no source 'T'"),
        ("unit: {per: 1 d}\nepoch: {day: 2000-01-01}", "day"),
        ("epoch: 2000-01-01", "the epoch needs a unit of time"),
        ("unit: {per: 18 ft}\nepoch: 2000-01-01", "18 ft is not a time"),
    ],
)
def test_what_cannot_be_a_date_is_refused_with_its_line(more: str, said: str) -> None:
    with pytest.raises(DeclarationError, match=said):
        read(more)
