"""The chance of each count of a wheel in doubt: one for all who ask, a posterior and a reconstruction alike."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from geartrain.search import infer_counts
from geartrain.search.reconstruct import evidence_question
from geartrain.train import Teeth, declare

THIRDS = Fraction(1, 3)


@pytest.mark.parametrize(
    ("teeth", "probabilities"),
    [
        ({"value": 20, "range": [19, 21]}, {19: THIRDS, 20: THIRDS, 21: THIRDS}),
        ({"value": 20, "range": [19, 21], "weights": [0, 1, 3]}, {20: Fraction(1, 4), 21: Fraction(3, 4)}),
        ({"value": 20, "choices": [22, 20, 22], "weights": [1, "2", "0.5"]}, {20: Fraction(4, 7), 22: Fraction(3, 7)}),
        ({"value": 20, "choices": [22, 20, 22]}, {20: THIRDS, 22: 2 * THIRDS}),
        ({"search": [30, 31]}, {30: Fraction(1, 2), 31: Fraction(1, 2)}),
        ({"search": [60, 19, 57, 19]}, {19: THIRDS, 57: THIRDS, 60: THIRDS}),
        ({"value": 30, "range": [30, 31], "search": [40, 50]}, {30: Fraction(1, 2), 31: Fraction(1, 2)}),
        ({"value": 20}, {}),
    ],
)
def test_chances_are_what_weights_say(teeth: dict[str, Any], probabilities: dict[int, Fraction]) -> None:
    assert Teeth.model_validate(teeth).probabilities == probabilities
    assert list(Teeth.model_validate(teeth).probabilities) == sorted(probabilities)


def test_a_posterior_and_a_reconstruction_begin_with_the_same_chances() -> None:
    teeth = {"value": 20, "choices": [22, 20, 22], "weights": [1, 2, "0.5"]}
    parts: dict[str, Any] = {
        "name": "doubt",
        "links": {"frame": {}, "a": {"wheels": {"p": 30}}, "b": {"wheels": {"q": {"teeth": teeth}}}},
        "inputs": {"a": 1},
        "outputs": {"b": {"expect": "-3/2"}},
    }
    joints = {"revolutes": {"A": ["frame", "a"], "B": ["frame", "b"]}, "gears": ["p ~ q"]}
    prior = infer_counts(declare({**parts, **joints})).posteriors["q"].uncertainty
    requested = evidence_question(declare({**parts, "reconstruct": {}})).problem
    assert dict(zip(prior.counts, prior.priors, strict=True)) == dict(requested.arbors[0].wheels[0].counts)
    assert dict(requested.arbors[0].wheels[0].counts) == {20: Fraction(4, 7), 22: Fraction(3, 7)}


@pytest.mark.parametrize(
    ("weights", "fault"), [((1, -1), "one weight is negative"), ((0, 0), "all weights are 0"), ((0, 1), None)]
)
def test_what_is_wrong_with_weights(weights: tuple[int, int], fault: str | None) -> None:
    assert Teeth.model_validate({"value": 20, "range": [20, 21], "weights": weights}).fault_of_weights == fault
