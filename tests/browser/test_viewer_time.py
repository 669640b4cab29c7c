"""Dates of the crank and targets of pointers in a browser, compared with the package's dates and fractions."""

from __future__ import annotations

import math
import random
from datetime import date
from fractions import Fraction
from math import cos, pi
from typing import TYPE_CHECKING

import pytest
import shipped
from julian_days import date_of, julian_day
from viewing import ANTIKYTHERA, MOVING, PLAN, SIMPLE, Opening, go, tab, turns, unfold, wait

from geartrain import GearTrain
from geartrain.drawing.dial_faces import pointer_readings
from geartrain.scene import make_scene
from geartrain.train import period_table

if TYPE_CHECKING:
    from conftest import Shown

YEAR = period_table()["year_tropical_J2000"].value
LUNAR = julian_day("-204-05-12")  # the full Moon of month 1, half a month after the Saros pointer's start
SET = Fraction(19, 470)  # turns at the epoch, at which the pointers of the zodiac are set
START = LUNAR - SET * YEAR
# mean longitude of the Sun at the epoch [turns]: J. Meeus, Astronomical Algorithms, 2nd edition, 1998, equation (25.2);
# Terrestrial Time is 13,089 s ahead (Morrison and Stephenson 2004)
CENTURIES = (LUNAR + Fraction(13_089, 86_400) - 2451545) / 36525
MEAN_SUN = (Fraction("280.46646") + Fraction("36000.76983") * CENTURIES + Fraction("0.0003032") * CENTURIES**2) / 360

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


def told(at: Fraction) -> str:
    """Return the text of a Julian day."""
    year, month, day, part = date_of(at)
    minutes = math.floor(part * 1440)
    words = f"{1 - year} BC" if year < 1 else f"{year} AD" if year < 1000 else str(year)
    return f"{day} {MONTHS[month - 1]} {words}, {minutes // 60:02d}:{minutes % 60:02d}"


def test_the_crank_tells_the_date_of_its_turns(show: Opening) -> None:
    shown = show(ANTIKYTHERA, **PLAN)
    told_by = shown.page.locator(".date")
    assert told_by.inner_text() == told(START)
    draw = random.Random(0)
    for at in [Fraction(19, 470), *(Fraction(draw.randrange(-4 * 10**6, 10**7), 1000) for _ in range(12))]:
        go(shown, at)
        assert told_by.inner_text() == told(START + at * YEAR), at


def test_a_date_that_is_typed_is_reached_exactly(show: Opening) -> None:
    shown = show(ANTIKYTHERA, **PLAN)
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
        wanted = julian_day(same)
        assert turns(shown) == (wanted - START) / YEAR, text
        assert shown.page.locator(".date").inner_text() == told(wanted)
    before = turns(shown)
    for text in ("1582-10-10", "2001-02-29", "soon", "235/19", "12 Foo 205 BC", "2000-01-01 25:00", ""):
        day.fill(text)
        day.press("Enter")
        assert turns(shown) == before, text
        assert "This is not a date" in shown.page.get_by_role("alert").inner_text()


def test_the_page_turns_to_a_date_in_motion_and_at_once_for_users_who_prefer_it(show: Opening) -> None:
    for window, text in ((MOVING, "1592-10-15"), ({}, "1600-02-29")):
        shown = show(text=CALENDAR, **PLAN, **window)
        shown.page.get_by_label("Go to date").fill(text)
        shown.page.get_by_role("button", name="Run").click()
        wanted = str((date.fromisoformat(text) - date(1582, 10, 15)).days)
        if window:
            wait(shown, f"!['0', '{wanted}'].includes(String(geartrain.turns))")
        wait(shown, f"String(geartrain.turns) === '{wanted}'")
        assert shown.page.get_by_role("button", name="play", exact=True).is_visible()


def test_targets_stand_beside_pointers_and_the_error_is_exact(show: Opening) -> None:
    shown = show(ANTIKYTHERA, **PLAN)
    at = Fraction(100_003, 7)
    go(shown, at)
    unfold(shown, "Comparison")
    assert "Carman and Evans" in shown.page.locator(".epoch").inner_text()
    assert "true geocentric longitude" in shown.page.locator(".tells").inner_text()
    rows = shown.run(
        """[...document.querySelectorAll('.sky tr[data-target]')].map((row) => [row.dataset.pointer, row.dataset.target,
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
        assert Fraction(exact) == (own - goal) * (at - SET), (output, target)
        declared = train.declaration.outputs[output]
        face = train.declaration.dials[declared.dial].face if declared.dial else "front"
        sense = clockwise if (face == "front") != (output == "games") else -clockwise  # Games: counted backwards
        for text, speed in ((pointer, own), (sky, goal)):
            # texts are rounded to 0.01 degree; pointers with errors of pins are checked elsewhere
            if output in ("sun", "metonic", "games", "callippic", "saros", "exeligmos"):
                mean = MEAN_SUN if output == "sun" else own * SET
                off = (
                    float(text.removesuffix("\u00b0")) - float((sense * (speed * (at - SET)) + sense * mean) % 1) * 360
                )
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
    assert marks["metonic"] == pytest.approx(float((5 * YEAR / month * (at - SET) + SET * 5 / 19) % 5), abs=1e-9)


def sky(shown: Shown) -> dict[str, list[float]]:
    """Return the pointer, the sky and their difference [deg] in the Sky tab, by output."""
    rows = shown.run(
        "[...document.querySelectorAll('[data-heaven]')].map((row) => [row.dataset.heaven, "
        "...[...row.querySelectorAll('.angle')].slice(0, 3).map((cell) => cell.textContent)])"
    )
    number = [
        (name, [float(text.removesuffix("\u00b0").replace("\u2212", "-")) for text in texts]) for name, *texts in rows
    ]
    return dict(number)


def same_angle(one: float, other: float) -> float:
    """Return the difference of two angles [deg], -180 to 180."""
    return (one - other + 180) % 360 - 180


@pytest.mark.parametrize("date", ["-204-05-12", "2026-11-28 18:30"])
def test_pointers_set_to_the_sky_agree_with_a_train_whose_epoch_is_that_date(show: Opening, date: str) -> None:
    shown = show("freeth-2021", **PLAN)
    day = julian_day(date)
    shown.page.get_by_label("Go to date").fill(date)
    shown.page.keyboard.press("Enter")
    unfold(shown, "Comparison")
    shown.page.get_by_role("button", name="Set at the displayed date").click()
    declared = shipped.train("freeth-2021").declaration
    epoch = declared.epoch.changed(date=date, turns=str((day - START) / YEAR))
    scene = make_scene(GearTrain(declared.changed(epoch=epoch)))
    found = shown.run("geartrain.scenes[0]")
    for one, other in zip(found["bodies"], scene.bodies, strict=True):
        assert cos(one["start"] - other.start) == pytest.approx(1, abs=1e-12), other.id
    for one, other in zip(found["couplings"], scene.couplings, strict=True):
        assert cos(one["slot_turn"] - other.slot_turn) == pytest.approx(1, abs=1e-12), other.id
    for one, other in zip(found["movement"]["sources"], scene.movement.sources, strict=True):
        assert cos(one["start"] - other.start) == pytest.approx(1, abs=1e-12), other.pair
    readings = {each.output: 360 * float(each.at) for each in pointer_readings(scene, (day - START) / YEAR)}
    assert len(sky(shown)) == 9
    for output, (pointer, heaven, ahead) in sky(shown).items():
        assert same_angle(pointer, readings[output]) == pytest.approx(0, abs=0.006), output
        assert same_angle(pointer - heaven, ahead) == pytest.approx(0, abs=0.02), output
    assert misfits(shown) == pytest.approx([0] * 37, abs=1e-6)


def misfits(shown: Shown) -> list[float]:
    """Return the distance of a tooth from the middle of its space [pitch] at 0 turns, for all pairs of spur wheels."""
    scene = shown.run("geartrain.scenes[0]")
    angles = shown.run("geartrain.scenes[0].bodies.map((_, body) => geartrain.machines[0].angle(body, 0))")
    found = []
    for pair in scene["pairs"]:
        wheels = [scene["wheels"][at] for at in pair["wheels"]]
        if any(wheel["cone"] for wheel in wheels):
            continue
        x, y = (wheels[1]["centre"][at] - wheels[0]["centre"][at] for at in (0, 1))
        past = 0.0
        for wheel, away in zip(wheels, (0, pi), strict=True):
            first = math.atan2(wheel["reference"][1], wheel["reference"][0]) + wheel["turn"]
            seen = first + angles[wheel["body"]] - angles[pair["carrier"]] - math.atan2(y, x) - away
            past += seen * wheel["teeth"] / (2 * pi)
        found.append((past + 1) % 1 - 0.5)
    return found


def test_today_sets_the_pointers_to_the_sky_of_the_clock(show: Opening) -> None:
    shown = show("freeth-2021", **PLAN)
    shown.page.clock.set_fixed_time("2026-11-28T12:00:00Z")
    shown.page.get_by_role("button", name="Today").click()
    assert shown.page.locator(".date").inner_text() == "28 November 2026, 12:00"
    assert turns(shown) == (julian_day("2026-11-28") - START) / YEAR
    unfold(shown, "Comparison")
    found = sky(shown)
    # geocentric longitudes of that day by VSOP87 and ELP-2000/82 (PyMeeus 0.5.12)
    published = {"sun": 246.26, "mercury": 228.49, "venus": 206.68, "mars": 150.99, "jupiter": 146.68}
    published |= {"saturn": 8.07, "moon": 120.39}
    for output, longitude in published.items():
        assert same_angle(found[output][1], longitude) == pytest.approx(0, abs=0.35), output
        assert abs(same_angle(found[output][0], longitude)) < 7, output
    names = shown.run("[...document.querySelectorAll('tr[data-output]')].map((row) => row.textContent)")
    signs = {"sun": "Sagittarius", "jupiter": "Leo", "saturn": "Aries"}
    assert [sign for output, sign in signs.items() if any(output in text and sign in text for text in names)] == [
        *signs.values()
    ]


def test_a_zodiac_without_positions_has_no_date(show: Opening) -> None:
    unset = CALENDAR.replace("outputs: {week: {", "dials: {z: {names: zodiac}}\noutputs: {week: {dial: z, ")
    shown = show(text=unset, **PLAN)
    assert shown.page.locator(".date").inner_text() == "not set to the sky"
    assert shown.page.get_by_label("Go to date").count() == 0
    unfold(shown, "Comparison")
    assert "not set to the sky" in shown.page.locator("[data-heaven=week]").inner_text()
    shown = show(text=unset.replace("dial: z, ", "dial: z, at_epoch: 33.1 deg, "), **PLAN)
    assert shown.page.locator(".date").inner_text() == "15 October 1582, 12:00"
    go(shown, "7/2")
    reading = shown.page.locator("[data-angle=week]").inner_text()
    assert reading == "213.10\u00b0, Scorpio, degree 4"  # half a turn later


def test_the_speed_is_in_days_a_second_where_there_are_dates(show: Opening) -> None:
    shown = show(text=CALENDAR, **PLAN, **MOVING)
    shown.page.clock.install(time="2026-01-01T00:00:00Z")
    shown.page.clock.pause_at("2026-01-01T01:00:00Z")
    shown.page.get_by_label("days a second").fill("50")
    shown.page.get_by_role("button", name="play", exact=True).click()
    shown.page.clock.run_for(2000)
    assert float(turns(shown)) == pytest.approx(100, rel=0.03)
    shown = show(SIMPLE, **PLAN)
    assert shown.page.get_by_label("turns a second").count() == 1


def test_errors_of_very_long_times_stay_in_their_column(show: Opening) -> None:
    shown = show(ANTIKYTHERA, **PLAN)
    unfold(shown, "Comparison")
    for at in ("1e18", "1/1000000"):
        go(shown, at)
        texts = shown.run("[...document.querySelectorAll('.sky .copy')].map((each) => each.textContent)")
        assert max(map(len, texts)) <= 11, at
        assert shown.run("document.querySelector('.sky').scrollWidth <= document.querySelector('.sky').clientWidth + 1")


def test_a_target_has_its_sense_and_a_calendar_is_kept(show: Opening) -> None:
    shown = show(text=CALENDAR, **PLAN)
    assert shown.page.locator(".date").inner_text() == "15 October 1582, 12:00"
    go(shown, "-1")
    assert shown.page.locator(".date").inner_text() == "14 October 1582, 12:00"  # in the Gregorian calendar
    unfold(shown, "Comparison")
    exact = shown.run("[...document.querySelectorAll('.sky .copy')].map((each) => each.dataset.exact)")
    assert exact == ["0", "1/56"]  # (-1/7 + 1/8) turns per day, one day earlier
    shown = show(SIMPLE, **PLAN)
    assert shown.page.get_by_role("tab", name="Sky").count() == 0
    assert shown.page.get_by_label("Go to date").count() == 0
