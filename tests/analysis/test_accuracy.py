"""Error against run time of a user's own train: errors are those that other ways find. Times are never judged."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction
from math import degrees
from typing import Any

import numpy as np
import pytest
from commands import LOCKED, RIGHT, call
from dynamics.test_uncounted_losses import PIN

from geartrain import GearTrain, load
from geartrain.analysis.accuracy import find_accuracy

SPEEDS, MOTION, TORQUES = "speeds", "motion", "torques"

PAIR: dict[str, Any] = {
    "links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 40}}},
    "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    "gears": [{"pair": ["p", "w"]}],
    "inputs": {"a": 1},
}


def row_of(found: Any, stage: str, method: str) -> Any:
    (row,) = (row for row in found.methods if (row.stage, row.method) == (stage, method))
    return row


@pytest.fixture(scope="module", autouse=True)
def _once() -> Iterator[None]:
    """Each method runs once, for its time is not judged."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("geartrain.analysis.accuracy._ENOUGH", 0.0)
        patch.setattr("geartrain.analysis.accuracy._LONG", 0.0)
        yield


@pytest.fixture(scope="module")
def moon() -> Any:
    return find_accuracy(load("moon-triangular"), positions=500)


def test_every_time_is_over_that_of_the_fastest_method_of_its_stage(moon: Any) -> None:
    for stage in (SPEEDS, MOTION):
        rows = [row for row in moon.methods if row.stage == stage]
        minimum = min(row.seconds for row in rows)
        assert minimum > 0
        assert [row.ratio for row in rows] == [row.seconds / minimum for row in rows]
        assert all(row.reference for row in rows)


def test_floats_are_as_far_off_as_a_third_of_a_turn_is() -> None:
    data = PAIR | {"links": PAIR["links"] | {"b": {"wheels": {"w": 60}}}}
    found = find_accuracy(GearTrain.declare(data))
    assert row_of(found, SPEEDS, "exact").error is None
    third = abs(Fraction(1 / 3) * 3 - 1)
    assert row_of(found, SPEEDS, "floats").error == pytest.approx(float(third), rel=1e-6)
    assert set(found.neglected) == {MOTION, TORQUES}


def test_motion_is_off_as_a_sum_of_the_transmissions_themselves_is(moon: Any) -> None:
    """Superposition by hand, each law asked at the angle its driver has on average, against the composition."""
    train = load("moon-triangular")
    motion = train.motion(outputs=["moon"])
    turns = np.arange(500) * (20.0 / 500)
    total = np.zeros(500)
    for source in motion._forward.used:
        S = float(source.cycles) * turns * source.transmission.period + source.phase
        seen = motion._forward.outputs[0]
        total += (
            source.sense
            * motion._forward.spread.sensitivity(seen.of, seen.base)[source.pair]
            * source.transmission.error(S)
        )
    off = degrees(np.abs(total - motion._unset.at(turns).error[0]).max())
    assert row_of(moon, MOTION, "superposed").error == pytest.approx(off, rel=1e-6)
    assert 1e-9 < row_of(moon, MOTION, "superposed with lag").error < off


def test_teeth_whose_transmission_is_their_ratio_have_nothing_to_measure_and_it_is_said_so() -> None:
    found = find_accuracy(load("planetary-24-18-60-involute"), positions=10)
    assert "no transmission error" in found.neglected[MOTION]
    assert {row.stage for row in found.methods} == {SPEEDS, TORQUES}


def test_the_balance_of_torques_is_exact_with_losses_of_pairs_and_of_bearings() -> None:
    links = PAIR["links"] | {"b": {"wheels": {"w": 40}, "bearing": 0.1}}
    data = PAIR | {"links": links, "gears": [{"pair": ["p", "w"], "efficiency": 0.9}], "loads": {"b": 1}}
    assert row_of(find_accuracy(GearTrain.declare(data)), TORQUES, "balance with losses").error == 0


def test_a_train_that_does_not_turn_says_so_and_measures_nothing(train_file: object) -> None:
    path = train_file(LOCKED)  # type: ignore[operator]
    done = call("inspect", "bench", path, "--json")
    assert done.exit_code == 1
    (found,) = json.loads(done.stdout)["states"]
    assert found["methods"] == []
    assert set(found["neglected"]) == {SPEEDS, MOTION, TORQUES}


def test_the_command_has_a_table_for_each_stage_and_one_answer_for_each_state(train_file: object) -> None:
    done = call("inspect", "bench", "moon-triangular", "--samples", 100)
    assert done.exit_code == 0
    for stage in (SPEEDS, MOTION):
        assert f"\n{stage}\n{'-' * len(stage)}\n" in done.stdout
    assert "torques: no loads are declared" in done.stdout
    states = RIGHT.replace("inputs: {a: 1}", "states: {one: {inputs: {a: 1}}, other: {inputs: {b: 1}}}")
    path = train_file(states.replace("{expect: 1/2}", "{}"))  # type: ignore[operator]
    assert [each["state"] for each in json.loads(call("inspect", "bench", path, "--json").stdout)["states"]] == [
        "one",
        "other",
    ]


def test_torque_over_a_turn_is_measured_by_its_samples() -> None:
    """A pin in a slot with friction: the mean has converged long before the most samples."""
    rows = {row.method: row for row in find_accuracy(load(PIN), positions=20).methods if row.stage == "torques"}
    over = [row for method, row in rows.items() if method.startswith("over 1 turns")]
    assert [row.method.split(", ")[1] for row in over] == [f"{n} samples" for n in (20_000, 2_000, 200, 20)]
    assert [row.error is None for row in over] == [True, False, False, False]
    assert all(row.error < 1e-6 for row in over if row.error is not None)
