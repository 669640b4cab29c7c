"""Dates of the crank and targets of pointers in a browser, compared with the package's dates and fractions."""

from __future__ import annotations

import math
import random
from datetime import date
from fractions import Fraction

import pytest
import shipped
from viewing import ANTIKYTHERA, SIMPLE, Opening, go, tab, turns, unfold, wait

from geartrain.train import date_of, julian_day, period_table, read_date

YEAR = period_table()["year_tropical_J2000"].value
LUNAR = read_date("-204-05-12")  # the full Moon of month 1, half a month after the Saros pointer's start
START = julian_day(LUNAR) - Fraction(19, 470) * YEAR

MONTHS = [date(2000, month, 1).strftime("%B") for month in range(1, 13)]

CALENDAR = """
name: days
frame: frame
unit: {per: 1 d}
epoch: {date: 1582-10-15, calendar: gregorian}
links: {frame: {}, day: {wheels: {d: 10}}, week: {wheels: {w: 70}}}
revolutes: {A: [frame, day], B: [frame, week]}
gears: [d ~ w]
inputs: {day: 1}
outputs: {week: {targets: [{period: 7 d, sense: retrograde}, {speed: -1/8}]}}
"""


def told(day: Fraction, calendar: str | None = None) -> str:
    """Return the text of a Julian day, from the package's date."""
    found = date_of(day, calendar)  # type: ignore[arg-type]
    minutes = math.floor(found.part * 1440)
    year = f"{1 - found.year} BC" if found.year < 1 else f"{found.year} AD" if found.year < 1000 else str(found.year)
    return f"{found.day} {MONTHS[found.month - 1]} {year}, {minutes // 60:02d}:{minutes % 60:02d}"


def test_the_crank_tells_the_date_of_its_turns(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    told_by = shown.page.locator(".date")
    assert told_by.inner_text() == told(START)
    draw = random.Random(0)
    for at in [Fraction(19, 470), *(Fraction(draw.randrange(-(10**7), 10**7), 1000) for _ in range(12))]:
        go(shown, at)
        assert told_by.inner_text() == told(START + at * YEAR), at
    assert shown.errors == []


def test_a_date_that_is_typed_is_reached_exactly(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    day = shown.page.get_by_label("Go to date")
    for text, same in (
        ("-204-05-12", "-204-05-12"),
        ("12 May 205 BC", "-204-05-12"),
        ("2000-01-01 12:00", "2000-01-01"),
        ("28 may 585 bc, 18:30", "-584-05-28 18:30"),
        ("1582-10-04", "1582-10-04"),
        ("15 October 1582 00:00", "1582-10-15 00:00"),
        ("1 Jan 1 BC", "0000-01-01"),
    ):
        day.fill(text)
        day.press("Enter")
        wanted = julian_day(read_date(same))
        assert turns(shown) == (wanted - START) / YEAR, text
        assert shown.page.locator(".date").inner_text() == told(wanted)
    before = turns(shown)
    for text in ("1582-10-10", "2001-02-29", "soon", "235/19", "12 Foo 205 BC", "2000-01-01 25:00", ""):
        day.fill(text)
        day.press("Enter")
        assert turns(shown) == before, text
        assert "This is not a date" in shown.page.get_by_role("alert").inner_text()


def test_the_page_turns_to_a_date_and_back_and_stops_there(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    for text in ("1901-01-01", "-204-05-12"):
        began = turns(shown)
        shown.page.get_by_label("Go to date").fill(text)
        shown.page.get_by_role("button", name="Run").click()
        wait(shown, f"String(geartrain.turns) !== '{began}'")
        wanted = (julian_day(read_date(text)) - START) / YEAR
        wait(shown, f"String(geartrain.turns) === '{wanted}'")
        assert shown.page.get_by_role("button", name="play", exact=True).is_visible()


def test_targets_stand_beside_pointers_and_the_error_is_exact(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    at = Fraction(100_003, 7)
    go(shown, at)
    unfold(shown, "Comparison")
    assert "Carman and Evans" in shown.page.locator(".epoch").inner_text()
    assert "Mean motion" in shown.page.locator(".tells").inner_text()
    rows = shown.run(
        """[...document.querySelectorAll('.sky tbody tr')].map((row) => [row.dataset.pointer, row.dataset.target,
          ...[...row.querySelectorAll('.angle')].map((cell) => cell.textContent),
          row.querySelector('.copy').dataset.exact])"""
    )
    train = shipped.train(ANTIKYTHERA)
    solved = train.solve()
    clockwise = 1 if train.declaration.view.positive == "clockwise" else -1
    checked = set()
    for output, target, pointer, sky, _, _, exact in rows:
        row = period_table()[target.partition(" turns in ")[2] or target]
        turned = Fraction(target.partition(" turns in ")[0]) if " turns in " in target else Fraction(1)
        goal = turned * (YEAR / row.value if row.kind == "period" else abs(row.value))
        own = Fraction(solved[output])
        goal = -goal if own < 0 else goal
        assert Fraction(exact) == (own - goal) * at, (output, target)
        declared = train.declaration.outputs[output]
        face = train.declaration.dials[declared.dial].face if declared.dial else "front"
        sense = clockwise if (face == "front") != (output == "games") else -clockwise  # Games: counted backwards
        for text, speed in ((pointer, own), (sky, goal)):
            # texts are rounded to 0.01 degree; pointers with errors of pins are checked elsewhere
            if output in ("sun", "metonic", "games", "callippic", "saros", "exeligmos"):
                off = float(text.removesuffix("\u00b0")) - float(sense * speed * at % 1) * 360
                assert abs((off + 180) % 360 - 180) <= 0.0051, (output, target)
                checked.add(output)
    assert len(checked) == 6
    assert len(rows) == sum(len(output.targets) for output in train.declaration.outputs.values())
    tab(shown, "Readings")
    marks = dict(
        shown.run(
            "[...document.querySelectorAll('.dial .target')].map((m) => [m.dataset.output, Number(m.dataset.turns)])"
        )
    )
    month = period_table()["metonic_235_synodic_modern"].value
    assert marks["metonic"] == pytest.approx(float(5 * YEAR / month * at % 5), abs=1e-9)


def test_errors_of_very_long_times_stay_in_their_column(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    unfold(shown, "Comparison")
    for at in ("1e18", "1/1000000"):
        go(shown, at)
        texts = shown.run("[...document.querySelectorAll('.sky .copy')].map((each) => each.textContent)")
        assert max(map(len, texts)) <= 11, at
        assert shown.run("document.querySelector('.sky').scrollWidth <= document.querySelector('.sky').clientWidth + 1")


def test_a_target_has_its_sense_and_a_calendar_is_kept(show: Opening) -> None:
    shown = show(text=CALENDAR)
    assert shown.page.locator(".date").inner_text() == "15 October 1582, 12:00"
    go(shown, "-1")
    assert shown.page.locator(".date").inner_text() == "14 October 1582, 12:00"  # in the Gregorian calendar
    unfold(shown, "Comparison")
    exact = shown.run("[...document.querySelectorAll('.sky .copy')].map((each) => each.dataset.exact)")
    assert exact == ["0", "1/56"]  # (-1/7 + 1/8) turns per day, one day earlier
    shown = show(SIMPLE)
    assert shown.page.get_by_role("tab", name="Sky").count() == 0
    assert shown.page.get_by_label("Go to date").count() == 0
