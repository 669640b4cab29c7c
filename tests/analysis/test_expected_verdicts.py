"""A state may say that it is free, or locked: neutral and park are no failures, and a driven neutral is one."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from commands import call

import geartrain
from geartrain.errors import DeclarationError

Write = Callable[..., Path]

STATES = """
name: box
extends: simpson-set
states:
  N: {engaged: [], expect: free}
  P: {engaged: [low, band, forward], expect: locked}
"""


def test_neutral_and_park_are_as_expected(train_file: Write) -> None:
    file = train_file(STATES)
    train = geartrain.load(str(file))
    found = {answer.state: (answer.verdict.kind, bool(answer)) for answer in train.answers()}
    assert found["N"] == ("free", True)
    assert found["P"] == ("locked", True)
    assert call("check", file).exit_code == 0
    assert call("gearbox", file).exit_code == 0
    assert call("solve", file, "--state", "N").exit_code == 0


@pytest.mark.parametrize(("state", "wrong"), [("N", "locked"), ("N", "determined"), ("P", "free"), ("1", "free")])
def test_another_verdict_than_the_expected_one_fails(state: str, wrong: str, train_file: Write) -> None:
    said = {"N": "expect: free", "P": "expect: locked"}
    text = STATES + f"  {state}: {{expect: {wrong}}}\n" if state not in said else STATES
    result = call("check", train_file(text.replace(said.get(state, "nothing"), f"expect: {wrong}")))
    assert result.exit_code == 1
    assert wrong == "determined" or f"where `expect` says {wrong}" in result.output


def test_a_train_says_it_for_all_its_states() -> None:
    train = geartrain.load("""
name: idle
extends: simpson-set
remove: {states: ['1', '2', '3', R]}
states: {N: {}, M: {}}
expect: free
""")
    assert [(answer.verdict.kind, bool(answer)) for answer in train.answers()] == [("free", True)] * 2


def test_an_open_differential_is_free_and_statics_tells_its_torques() -> None:
    train = geartrain.load("""
name: open
extends: bevel-differential
remove: {states: [straight, turn, one wheel held, crown held]}
inputs: {crown: 1}
loads: {left: -1, right: -1}
solve_for: crown
expect: free
""")
    assert train.solve()
    torques = train.torques()
    assert torques.verdict
    assert torques.external["crown"] == 2


def test_no_other_word_is_a_verdict() -> None:
    with pytest.raises(DeclarationError, match="expect"):
        geartrain.load("name: x\nextends: simpson-set\nstates: {N: {engaged: [], expect: neutral}}\n")
