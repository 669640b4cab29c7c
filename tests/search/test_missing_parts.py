"""The lost wheels of Table 6 of Pennestri, Valentini and Petti (2002): every solution, by loops over all counts."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache
from itertools import product
from typing import Any

import pytest
from places import DOCS

from geartrain import GearTrain, load
from geartrain.search import TrainFindings, search_train

F = Fraction
Row = tuple[int, int, int]
PAGE = DOCS / "which-counts.md"
YEAR = F("365.242190402")
# days, as NASA's and JPL's mean motions give them; the saros is 223 mean lunations
PERIODS = {"venus": F("583.9214"), "mars": F("779.9363"), "jupiter": F("398.8821"), "saros": F("6585.3213")}
LETTERS = {"venus": "V", "mars": "M", "jupiter": "J", "saros": "S"}
COUNTS = {"venus": 80, "mars": 140, "jupiter": 15, "saros": 20}
# O1, O2, X as printed, with the error of the period in per cent
TABLE_6: dict[str, dict[Row, str]] = {
    "venus": {(32, 50, 40): "+0.080", (31, 52, 43): "+0.215", (32, 48, 41): "+6.856"},
    "mars": {(30, 50, 57): "+0.099", (31, 48, 53): "+0.184"},
    "jupiter": {(30, 48, 28): "+0.151", (32, 53, 29): "+0.205"},
}
PRINTED = [(planet, row) for planet, rows in TABLE_6.items() for row in rows]
RIGHT = [(planet, row) for planet, row in PRINTED if row != (32, 48, 41)]


def error_of(planet: str, row: Row) -> Fraction:
    """Error of the speed: N makes a quarter turn a year and has 64 teeth."""
    o1, o2, x = row
    return F(1, 4) * F(64, o1) * F(o2, x) * PERIODS[planet] / YEAR - 1


@cache
def brute(planet: str) -> dict[Row, Fraction]:
    """Every set within the tolerance, with its error, by a loop over all counts."""
    low, high, tolerance = (15, 127, F(1, 10**4)) if planet == "saros" else (28, 60, F(1, 400))
    wanted, found = float(YEAR / PERIODS[planet]), {}
    for o1, o2 in product(range(low, high + 1), repeat=2):
        for x in range(low, high + 1):
            if abs(16 * o2 / (o1 * x) / wanted - 1) < float(tolerance) * 1.01:
                error = error_of(planet, (o1, o2, x))
                if abs(error) <= tolerance:
                    found[o1, o2, x] = error
    return found


@pytest.fixture(scope="module")
def train() -> GearTrain:
    return load("pennestri-2002-missing")


@pytest.fixture(scope="module")
def found(train: GearTrain) -> TrainFindings:
    return search_train(train.declaration, best=1000)


def part_of(found: TrainFindings, planet: str) -> Any:
    (part,) = [part for part in found.parts if part.outputs == (planet,)]
    return part


def with_row(planet: str, row: Row) -> GearTrain:
    letter, (o1, o2, x) = LETTERS[planet], row
    return load(
        f"extends: pennestri-2002-missing\nlinks:\n  {planet} arbor: {{wheels: {{{letter}O1: {{teeth: {o1}}}, "
        f"{letter}O2: {{teeth: {o2}}}}}}}\n  {planet}: {{wheels: {{{letter}X: {{teeth: {x}}}}}}}\n"
    )


@pytest.mark.parametrize(("planet", "row"), [*PRINTED, ("venus", (30, 48, 41)), ("saros", (89, 29, 94))])
def test_the_arrangement_of_figure_4_turns_x_by_the_two_meshes_behind_wheel_n(planet: str, row: Row) -> None:
    result = with_row(planet, row).solve().outputs[planet]
    assert result.speed == F(16 * row[1], row[0] * row[2])
    assert result.targets[0].error == error_of(planet, row)
    assert result.targets[0].met is ((planet, row) not in PRINTED or (planet, row) in RIGHT)


@pytest.mark.parametrize(("planet", "row"), PRINTED)
def test_printed_rows_miss_the_synodic_period_by_what_the_notes_say(planet: str, row: Row) -> None:
    assert f"{100 * float(1 / (1 + error_of(planet, row)) - 1):+.3f}" == TABLE_6[planet][row]


@pytest.mark.parametrize("planet", ["venus", "mars", "jupiter"])
def test_the_shipped_train_stands_with_the_first_printed_row(train: GearTrain, planet: str) -> None:
    letter, (first, *_) = LETTERS[planet], TABLE_6[planet]
    wheels = train.declaration.wheels
    assert tuple(wheels[letter + name][1].count for name in ("O1", "O2", "X")) == first
    assert train.solve().outputs[planet].targets[0].met


def test_the_three_planets_and_the_saros_are_four_searches_that_do_not_touch(found: TrainFindings) -> None:
    assert found.complete
    assert {part.outputs for part in found.parts} == {(planet,) for planet in LETTERS}
    assert found.count == 80 * 140 * 15 * 20


@pytest.mark.parametrize("planet", LETTERS)
def test_every_solution_is_found_and_no_other(found: TrainFindings, planet: str) -> None:
    part, right = part_of(found, planet), brute(planet)
    assert part.complete
    assert part.count == len(right) == COUNTS[planet]
    got = {tuple(one.teeth.values()): one.outputs[planet].error for one in part.solutions}
    assert got == right
    errors = [abs(one.outputs[planet].error) for one in part.solutions]
    assert errors == sorted(errors)


@pytest.mark.parametrize(("planet", "row"), RIGHT)
def test_a_printed_row_stands_behind_those_that_are_nearer(found: TrainFindings, planet: str, row: Row) -> None:
    letter = LETTERS[planet]
    (standing,) = found.standing(dict(zip((f"{letter}O1", f"{letter}O2", f"{letter}X"), row, strict=True)))
    nearer = sum(abs(error) < abs(error_of(planet, row)) for error in brute(planet).values())
    assert not standing.refused
    assert standing.rank == nearer + 1
    assert nearer > 0, "something does better than what is printed"


def test_the_third_venus_row_is_refused_and_one_count_alone_mends_it(found: TrainFindings) -> None:
    (standing,) = found.standing({"VO1": 32, "VO2": 48, "VX": 41})
    assert standing.refused
    mended = [row for row in brute("venus") if sum(a != b for a, b in zip(row, (32, 48, 41), strict=True)) == 1]
    assert mended == [(30, 48, 41)]
    assert f"{100 * float(1 / (1 + error_of('venus', mended[0])) - 1):+.2f}" == "+0.18"


def test_nothing_printed_is_among_the_nearest() -> None:
    nearest = {
        planet: {row for row, error in brute(planet).items() if abs(error) == min(map(abs, brute(planet).values()))}
        for planet in TABLE_6
    }
    assert nearest["venus"] == {(35, 52, 38), (38, 52, 35)}
    assert nearest["jupiter"] == {(31, 55, 31)}
    assert {F(16 * o2, o1 * x) for o1, o2, x in nearest["mars"]} == {F(96, 205)}
    assert not any(set(nearest[planet]) & set(TABLE_6[planet]) for planet in TABLE_6)


def test_wheels_of_28_to_60_cannot_show_the_saros_and_the_search_says_why() -> None:
    assert round(float(F("6585.32") / (4 * F("365.2422"))), 4) == 4.5075
    assert F(60 * 60, 64 * 28) < F("2.01")  # the most that two meshes behind 64 teeth slow down
    free = "{teeth: {value: 60, search: [28, 60]}}"
    small = load(
        "extends: pennestri-2002-missing\nremove: {links: [venus, mars, jupiter, venus arbor, mars arbor, "
        "jupiter arbor], outputs: [venus, mars, jupiter]}\n"
        f"links:\n  saros arbor: {{wheels: {{SO1: {free}, SO2: {free}}}}}\n  saros: {{wheels: {{SX: {free}}}}}\n"
    )
    (part,) = search_train(small.declaration).parts
    assert part.complete
    assert (part.count, part.considered) == (0, 33**3)
    assert sum(part.shortfall.removed.values()) == 33**3
    assert part.shortfall.nearest
    assert part.shortfall.advice


def test_the_page_prints_the_number_of_solutions_the_ranks_and_the_misprint() -> None:
    text = PAGE.read_text(encoding="utf-8").split("## 2. Missing wheels")[1].split("\n## ")[0]
    numbers = re.findall(r"^(\d+) of \S+ assignments are solutions \(complete search\)\.$", text, re.M)
    assert [int(number) for number in numbers] == list(COUNTS.values())
    ranks = text.split("Ranks of the given assignments")[1]
    printed = re.findall(r"^VO1 = (\d+), VO2 = (\d+), VX = .*? (\d+|-)(?:  .*)?\n(\d+)", ranks, re.M)
    errors = brute("venus")
    for o1, o2, rank, x in printed:
        row = (int(o1), int(o2), int(x))
        assert (rank == "-") is (row not in errors)
        if rank != "-":
            nearer = sum(abs(error) < abs(errors[row]) for error in errors.values())
            assert int(rank) > nearer
    assert [row[2] == "-" for row in printed] == [False, True, False]
