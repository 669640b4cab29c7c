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


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("unit: {per: 1 d}\nepoch: 1582-10-10", "there is no 1582-10-10"),
        ("unit: {per: 1 d}\nepoch: soon", "'soon' is no date"),
        ("unit: {per: 1 d}\nepoch: {date: 2000-01-01, source: T}", "no source 'T'"),
        ("unit: {per: 1 d}\nepoch: {day: 2000-01-01}", "day"),
        ("epoch: 2000-01-01", "an epoch without a unit of time"),
        ("unit: {per: 18 ft}\nepoch: 2000-01-01", "18 ft is no time"),
    ],
)
def test_what_cannot_be_a_date_is_refused_with_its_line(more: str, said: str) -> None:
    with pytest.raises(DeclarationError, match=said):
        read(more)
