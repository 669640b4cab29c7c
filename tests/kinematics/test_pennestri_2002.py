"""The Antikythera train of Pennestri, Valentini and Petti (2002): structure, circuits, speeds, misprints."""

from __future__ import annotations

from fractions import Fraction

import pytest
from commands import TWENTY
from pennestri import TABLES_1_TO_3

from geartrain import GearTrain, load

TABLE_4 = {
    1: "0", 2: "5", 3: "-1", 4: "-1", 5: "13.3684", 6: "1.7777", 7: "-1", 8: "0.2500", 9: "-0.5000", 10: "1.6842",
    11: "-3.3684", 12: "-13.3684", 13: "-2.5921", 14: "-13.3684", 15: "1", 16: "24.7368", 17: "-12.3684",
    18: "4.1228", 19: "-1.0307", 20: "-6.1842",
}  # fmt: skip


@pytest.fixture(scope="module")
def train() -> GearTrain:
    return load("pennestri-2002")


def test_all_twenty_speeds_are_exact(train: GearTrain) -> None:
    # from the circuits of Tables 1 to 3 by hand; the paper prints four decimals
    assert dict(train.solve().speeds) == {str(at): Fraction(speed) for at, speed in enumerate(TWENTY, 1)}


@pytest.mark.parametrize("link", TABLE_4)
def test_speeds_agree_with_table_4_at_the_digits_printed(train: GearTrain, link: int) -> None:
    speed, printed = Fraction(train.solve()[str(link)]), TABLE_4[link]
    digits = len(printed.partition(".")[2])
    if link == 6:  # 16/9 is cut off in the paper, not rounded
        assert Fraction(int(speed * 10**4), 10**4) == Fraction(printed)
    else:
        assert abs(speed - Fraction(printed)) <= Fraction(1, 2 * 10**digits)


def test_circuits_carriers_and_wheels_are_those_of_tables_1_to_3(train: GearTrain) -> None:
    rows = [line.split() for line in TABLES_1_TO_3.strip().splitlines()]
    assert [[c.id, c.i, c.j, c.carrier, *c.wheels] for c in train.circuits] == rows


def test_every_circuit_reverses_in_the_ratio_of_its_teeth(train: GearTrain) -> None:
    ratios = {circuit.id: circuit.ratio for circuit in train.circuits}
    # tau = -z_j/z_i, all pairs being external: three of them from the tooth list of the paper
    assert ratios["G1"] == Fraction(-225, 45)
    assert ratios["G6"] == Fraction(-127, 32)
    assert ratios["G14"] == Fraction(-192, 48)
    assert all(ratio < 0 for ratio in ratios.values())


def test_nineteen_turning_pairs_less_eighteen_gear_pairs_leave_one_degree_of_freedom(train: GearTrain) -> None:
    mobility = train.mobility
    assert (mobility.links, mobility.turning_pairs, mobility.gear_pairs) == (20, 19, 18)
    assert mobility.by_count == 19 - 18 == mobility.by_rank == 1
    assert mobility.redundant == 0
    assert mobility.loops == ()


def test_fifteen_teeth_on_link_18_do_not_give_the_printed_speeds() -> None:
    changed = load("extends: pennestri-2002\nlinks:\n  18: {wheels: {Z18: {teeth: 15}}}\n").solve()
    assert abs(float(changed["18"]) - 4.1228) > 1
    assert changed["18"] == Fraction(-235, 19) * Fraction(-20, 15)
    assert {output.name for output in changed.failures} == {"18", "19"}


def test_the_declared_expectations_hold_and_the_errata_are_carried(train: GearTrain) -> None:
    answer = train.solve()
    assert answer
    assert answer.failures == ()
    printed = [erratum.printed for erratum in train.declaration.errata]
    assert any("z18 = 15" in text for text in printed)
    assert any("236/19" in text for text in printed)


def test_price_train_has_235_synodic_months_in_nineteen_years(train: GearTrain) -> None:
    answer = train.solve()
    months = answer["moon"] + answer["sun"]  # sun and moon turn against each other here: the sum of signed speeds
    assert months == Fraction(235, 19) != Fraction(236, 19)


def test_the_moon_misses_the_month_by_what_table_5_says(train: GearTrain) -> None:
    (against,) = train.solve().outputs["17"].targets
    # 235/19 synodic months a year of 365.242190402 d, against the month of 29.530588853 d
    error = Fraction(235, 19) * Fraction("29.530588853") / Fraction("365.242190402") - 1
    assert against.error == error
    assert against.ppm == pytest.approx(12.5026, abs=1e-4)
