"""`geartrain feasibility`: what it prints and draws, what it refuses, and that workers change nothing."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from commands import call

pytestmark = pytest.mark.usefixtures("here")

PAIR = """
    name: pair
    links: {frame: {}, a: {wheels: {p: {teeth: 20, module: 1 mm}}}, b: {wheels: {w: {teeth: 30, module: 1 mm}}}}
    revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
    gears: [{pair: [p, w]}]
    inputs: {a: 1}
    outputs: {b: {}}
    tooth_form: {form: triangular, half_angle: 30 deg, clearance_factor: 1.02}
    cutting: {pitch_deviation: {normal: 3 %}}
    friction: {sliding: 0.2, range: [0.1, 0.3]}
    loads: {b: 30 N mm}
    thickness: 2 mm
    material: ancient-bronze
    drive: {hand: {torque: 24 N mm, range: [18 N mm, 30 N mm], handle: 30 mm}}
"""
Write = Callable[..., Path]


def ask(*words: object) -> Any:
    return call("feasibility", *words)


def test_text_and_json_have_the_same_outcomes_for_any_number_of_workers(train_file: Write) -> None:
    train = train_file(PAIR)
    text = ask(train, "--trials", 40, "--accuracy", "0.1:2:2", "--workers", 1)
    assert text.exit_code == 0, text.output
    for part in ("Outcome", "too stiff", "Crank torque", "at the handle", "Accuracy", "once per workshop"):
        assert part in text.stdout
    one, two = (ask(train, "--trials", 40, "--json", "--workers", count).stdout for count in (1, 2))
    assert one == two
    outcomes = json.loads(one)["outcomes"]
    assert sum(each["count"] for each in outcomes.values()) == 40
    assert outcomes["too stiff"]["count"] > 0
    assert not [*Path().glob("*.partial.jsonl")]


def test_a_draw_for_each_part_is_named(train_file: Write) -> None:
    found = ask(train_file(PAIR), "--trials", 4, "--per-part", "--turns", 1)
    assert "once per part" in " ".join(found.stdout.split())
    assert "maximum over 1 revolutions" in " ".join(found.stdout.split())


@pytest.mark.needs("matplotlib")
def test_the_curve_is_drawn(train_file: Write) -> None:
    found = ask(train_file(PAIR), "--trials", 8, "--accuracy", "0.1:2:3", "--plot", "curve.svg")
    assert found.exit_code == 0, found.output
    assert 'id="turns"' in Path("curve.svg").read_text(encoding="utf-8")
