"""Formulas of a scene, compared with the package's answers for other counts."""

from __future__ import annotations

import random
from fractions import Fraction
from math import prod
from pathlib import Path
from typing import Any

import pytest
import shipped

from geartrain import load
from geartrain.scene import make_scene

NAMES = ("freeth-2021", "nrel-grc-750", "bevel-differential", "ravigneaux-set", "humpage", "worm", "planetary-24-18-60")


def total(terms: list[Any], counts: list[int]) -> int:
    return sum(int(c) * prod(z**power for z, power in zip(counts, powers, strict=True)) for c, powers in terms)


def value(formula: dict[str, Any], counts: list[int]) -> Fraction:
    own = [counts[at] for at in formula["wheels"]]
    return Fraction(total(formula["numerator"], own), total(formula["denominator"], own))


@pytest.mark.parametrize("name", NAMES)
def test_every_speed_of_a_scene_is_its_formula_at_any_counts(name: str) -> None:
    train = shipped.train(name)
    draw = random.Random(name)
    for state in (train.states or (None,))[:3]:
        scene = make_scene(train, state, shipped.layout(name), formulas=True).to_dict()
        told = scene["formulas"]
        declared = train.declaration.wheels
        counts = [max(1, (declared[wheel][1].count or 1) + draw.randint(-3, 3)) for wheel in told["wheels"]]
        changed = train.with_teeth(dict(zip(told["wheels"], counts, strict=True)))
        answer = changed.unfolded.solve(state, method="exact")
        for body, at in zip(scene["bodies"], told["bodies"], strict=True):
            if at is not None:
                assert value(told["formulas"][at], counts) == answer.speeds[body["id"]], body["id"]
            else:
                assert body["parent"] is None
        for pointer, at in zip(scene["pointers"], told["pointers"], strict=True):
            assert value(told["formulas"][at], counts) == answer.outputs[pointer["output"]].speed, pointer["output"]
        for wheel, at in zip(scene["wheels"], told["count"], strict=True):
            assert wheel["teeth"] == declared[told["wheels"][at]][1].count


def test_what_a_changed_train_extends_is_the_file_it_came_from(tmp_path: Path) -> None:
    text = "name: {name}\nextends: planetary-24-18-60\n"
    for name, parent in (("mine", "some.yaml"), ("worm", "some.yaml")):
        (tmp_path / "some.yaml").write_text(text.format(name=name), encoding="utf-8")
        formulas = make_scene(load(str(tmp_path / "some.yaml")), formulas=True).formulas
        assert formulas is not None
        assert formulas.parent == parent
    formulas = make_scene(load(text.format(name="mine")), formulas=True).formulas
    assert formulas is not None
    assert formulas.parent == "mine.yaml"


def test_a_scene_has_formulas_only_where_they_are_requested_for_and_can_be_had() -> None:
    assert make_scene(shipped.train("worm")).formulas is None
    idle = load("name: idle\nframe: f\nlinks: {f: {}, a: {wheels: {p: 10}}}\nrevolutes: {A: [f, a]}\ninputs: {}\n")
    assert make_scene(idle, formulas=True).formulas is None
