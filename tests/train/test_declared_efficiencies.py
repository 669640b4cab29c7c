"""Efficiencies as declared: a part of the power or a percentage, never more than all of it."""

from __future__ import annotations

from fractions import Fraction

import pytest
from models import PAIR, refusal

from geartrain import load


@pytest.mark.parametrize(
    ("efficiency", "forward", "backward"),
    [
        ("0.98", "0.98", "0.98"),
        ("98 %", "0.98", "0.98"),
        ("98%", "0.98", "0.98"),
        ("49/50", "0.98", "0.98"),
        ("1", "1", "1"),
        ("100 %", "1", "1"),
        ("{forward: 70 %, backward: 0.6}", "0.7", "0.6"),
        ("{forward: 0.4, backward: -0.5}", "0.4", "-0.5"),
        ("{forward: 0, backward: 40 %}", "0", "0.4"),
    ],
)
def test_an_efficiency_is_a_part_or_a_percentage(efficiency: str, forward: str, backward: str) -> None:
    text = PAIR.format(rest="inputs: {a: 1}\nloads: {b: -6}").replace("[p, w]", f"[p, w], efficiency: {efficiency}")
    train = load(text)
    found = train.declaration.gears[0].efficiency
    assert (found.forward.base, found.backward.base) == (Fraction(forward), Fraction(backward))


@pytest.mark.parametrize(
    ("efficiency", "said", "fix"),
    [
        ("98", "an efficiency of 98 is above 1", "98 %"),
        ("1.5", "an efficiency of 1.5 is above 1", "for example, write 0.98"),
        ("101 %", "an efficiency of 101 % is above 1", "for example, write 0.98"),
        ("{forward: 0.9, backward: 90}", "an efficiency of 90 is above 1", "90 %"),
        ("{forward: 1000001 ppm, backward: 0.9}", "is above 1", "for example, write 0.98"),
        ("0", "transmits no power in either direction", "98 %"),
        ("-0.5", "transmits no power in either direction", "above 0"),
        ("0 %", "transmits no power in either direction", "above 0"),
        ("{forward: 0, backward: -1}", "transmits no power in either direction", "above 0"),
        ("0.98 rpm", "is a speed, but a fraction is required", "%"),
    ],
)
def test_no_efficiency_makes_power_or_passes_none(efficiency: str, said: str, fix: str) -> None:
    told = refusal(PAIR.format(rest="inputs: {a: 1}").replace("[p, w]", f"[p, w], efficiency: {efficiency}"))
    assert said in told
    assert fix in told


def test_a_percentage_loses_what_it_says() -> None:
    text = PAIR.format(rest="inputs: {a: 1}\nloads: {b: 6}")
    for written in ("0.75", "75 %", "{forward: 75 %, backward: 1}"):
        found = load(text.replace("[p, w]", f"[p, w], efficiency: {written}")).torques()
        # b turns backwards at a third of a turn: 2 go out there, and a hand gives 2 / 0.75
        assert found.external["a"] == Fraction(8, 3)
