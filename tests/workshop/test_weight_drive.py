"""The torque at the crank over a train's natural run, and a clock's weight against its drum."""

from __future__ import annotations

import pytest
from models import load

from geartrain.report import to_markdown
from geartrain.workshop import BudgetQuestion, describe_budget, find_budget

ASKED = BudgetQuestion(turns=1, samples=20, trials=4)
CLOCK = """
extends: longcase-clock
name: clock
gears:
  - {pair: [g96, c8], efficiency: 0.9}
  - {pair: [c60, t8], efficiency: 0.9}
  - {pair: [t56, e7], efficiency: 0.9}
"""
PULL = 5.9 * 9.80665 * 0.0127


def test_a_weight_gives_its_torque_at_the_drum_and_the_escape_wheel_gets_what_teeth_leave() -> None:
    weight = find_budget(load(CLOCK), ASKED).crank.weight
    assert weight is not None
    assert (weight.link, weight.wheel, weight.needed, weight.suffices) == ("great", "escape", None, None)
    assert weight.torque == pytest.approx(PULL, rel=1e-12)
    # 720 turns of the escape wheel to one of the drum's
    assert [weight.mean, weight.least] == pytest.approx([PULL / 720 * 0.9**3] * 2, rel=1e-12)
    assert weight.efficiency == pytest.approx(0.9**3, rel=1e-12)


@pytest.mark.parametrize(("drag", "enough"), [("0.6 N mm", True), ("0.8 N mm", False)])
def test_a_weight_is_set_against_what_the_train_needs(drag: str, enough: bool) -> None:
    found = find_budget(load(CLOCK + f"links: {{escape: {{bearing: {drag}}}}}"), ASKED)
    weight, over_turn = found.crank.weight, found.crank.over_turn
    assert weight is not None
    assert over_turn is not None
    assert weight.needed == over_turn.starting_torque == pytest.approx(float(drag[:3]) * 0.72 / 0.9**3, rel=1e-12)
    assert weight.suffices is enough
    page = to_markdown([describe_budget(found)])
    assert f"The weight gives {PULL:.4g} N m at 'great'." in page
    assert ("starts it everywhere" in page) == enough


def test_a_year_of_the_crank_stands_in_the_budget() -> None:
    """Saturn's bearing: on the mean over its period 2.07 times what the mean speed would take; in a year less."""
    train = load("extends: freeth-2021\nname: saturns\nlinks: {saturn: {bearing: 1 N mm}}\n")
    crank = find_budget(train, BudgetQuestion(("saturn",), turns=1, samples=20)).crank
    assert crank.over_turn is not None
    assert (crank.link, crank.over_turn.span, crank.weight) == ("a", 1, None)
    assert crank.over_turn.greatest_torque == pytest.approx(2.6959e-5, abs=5e-10)
