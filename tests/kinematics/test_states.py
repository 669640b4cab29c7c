"""Brakes, locks, clutches and states."""

from __future__ import annotations

from fractions import Fraction

import pytest
from models import pair, refusal

from geartrain import GearTrainError, load

FREE_SET = """
links:
  frame: {{}}
  sun: {{wheels: {{s: 24}}}}
  ring: {{wheels: {{r: {{teeth: 60, internal: true}}}}}}
  planet: {{wheels: {{p: 18}}}}
  arm: {{}}
revolutes: {{main: [frame, sun, ring, arm], planet: [arm, planet]}}
gears: [{{pair: [s, p]}}, {{pair: [p, r]}}]
{rest}
"""


@pytest.mark.parametrize(
    ("rest", "arm"),
    [
        ("inputs: {sun: 1}\nfixed: [ring]", Fraction(2, 7)),
        ("inputs: {ring: 1}\nfixed: [sun]", Fraction(5, 7)),
        ("inputs: {sun: 1}\nlocks: [[sun, ring]]", Fraction(1)),
        ("inputs: {sun: 7, ring: -7}", Fraction(-3)),
    ],
)
def test_brakes_and_locks_choose_what_a_planetary_does(rest: str, arm: Fraction) -> None:
    assert load(FREE_SET.format(rest=rest)).solve()["arm"] == arm


STATES = """
inputs: {sun: 1}
fixed: [ring]
outputs: {arm: {expect: 2/7}, sun: {}}
clutches: {B: {fixes: sun}, C: {locks: [sun, arm]}}
states:
  low: {}
  high: {fixed: [sun], inputs: {ring: 1}, outputs: {arm: {expect: 5/7}}}
  high by clutch: {fixed: [], inputs: {ring: 1}, engaged: [B], outputs: {arm: {expect: 5/7}}}
  direct: {fixed: [], engaged: [C], outputs: {arm: {expect: 1}, rest: {of: ring, expect: 1}}}
"""


def test_a_state_replaces_what_is_prescribed_and_merges_its_outputs() -> None:
    train = load(FREE_SET.format(rest=STATES))
    answers = {answer.state: answer for answer in train.answers()}
    assert list(answers) == ["low", "high", "high by clutch", "direct"]
    assert all(answers.values())
    assert [answer["arm"] for answer in answers.values()] == [Fraction(2, 7), Fraction(5, 7), Fraction(5, 7), 1]
    assert set(answers["low"].outputs) == {"arm", "sun"}
    assert set(answers["direct"].outputs) == {"arm", "sun", "rest"}


def test_engaged_clutches_add_to_what_is_fixed() -> None:
    rest = "fixed: [ring]\nclutches: {B: {fixes: sun}}\nstates: {tied up: {inputs: {arm: 1}, engaged: [B]}}"
    verdict = load(FREE_SET.format(rest=rest)).solve("tied up").verdict
    assert verdict.kind == "locked"
    assert "input 'arm' is locked to the frame" in verdict.text
    assert set(verdict.prescriptions) >= {"'sun' is fixed by B", "'ring' is fixed"}


def test_a_train_with_states_must_be_requested_for_one_of_them() -> None:
    train = load(FREE_SET.format(rest=STATES))
    with pytest.raises(GearTrainError, match="give one of these states: low, high"):
        train.solve()
    with pytest.raises(GearTrainError, match="has no state 'medium'"):
        train.solve("medium")
    with pytest.raises(GearTrainError, match="has no state"):
        pair().solve("low")


@pytest.mark.parametrize(
    ("rest", "said"),
    [
        ("fixed: [rung]", "did you mean 'ring'"),
        ("locks: [[sun, moon]]", "no link 'moon'"),
        ("locks: [[sun]]", "locks"),
        ("clutches: {B: {fixes: sun, locks: [sun, arm]}}", "a clutch needs exactly one of its keys"),
        ("clutches: {B: {}}", "a clutch needs exactly one of its keys"),
        ("clutches: {B: {fixes: moon}}", "no link 'moon'"),
        ("clutches: {B: {fixes: sun}}\nstates: {one: {engaged: [C]}}", "no clutch 'C'"),
        ("states: {one: {fixed: [moon]}}", "no link 'moon'"),
        ("states: {one: {inputs: {frame: 1}}}", "the frame 'frame' is an input"),
        ("states: {one: {gears: []}}", "unknown key 'gears'"),
    ],
)
def test_states_that_point_nowhere_are_refused(rest: str, said: str) -> None:
    assert said in refusal(FREE_SET.format(rest=rest))
