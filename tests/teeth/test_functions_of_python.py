"""Transmission functions of Python in place of teeth: what is accepted, what they change, and what is refused."""

from __future__ import annotations

import gc
import pickle
from collections.abc import Callable
from fractions import Fraction
from math import degrees, pi
from typing import Any

import numpy as np
import pytest
from models import pair

from geartrain import GearTrain, GearTrainError
from geartrain.teeth import PinToSlotTransmission

TRAIN = pair("inputs: {a: 1}\noutputs: {b: }\nloads: {b: 3}").with_teeth(w=30)


class Wave:
    """An error of one wave a turn."""

    ratio = Fraction(2, 3)
    period = 2 * pi

    def error(self, S: Any) -> Any:
        return 0.02 * np.sin(S)

    def speed(self, S: Any) -> Any:
        return 2 / 3 + 0.02 * np.cos(S)


class Kinked(Wave):
    """A parabola between the ends of each turn, with an efficiency."""

    def error(self, S: Any) -> Any:
        return 0.01 * np.mod(S, 2 * pi) * (np.mod(S, 2 * pi) - 2 * pi)

    def speed(self, S: Any) -> Any:
        return 2 / 3 + 0.02 * (np.mod(S, 2 * pi) - pi)

    def kinks(self) -> list[float]:
        return [0.0]

    def efficiency(self, S: Any) -> Any:
        return 0.9 + 0.05 * np.cos(S)


def test_motion_and_report_use_a_function_of_python() -> None:
    train = TRAIN.with_tooth_form(Wave(), pairs=["p~w"])
    turns = np.linspace(0, 3, 20)
    assert train.motion().at(turns).error[0] == pytest.approx(-0.02 * np.sin(2 * pi * turns))
    assert degrees(train.motion().run(turns=1, samples=100).statistics[0].peak_to_peak) == pytest.approx(degrees(0.04))
    assert "user-defined" in str(train.meshes[0].tooth_form.words)
    assert f"{degrees(0.04):.6g}" in str(train.report())


def test_a_function_refers_to_the_second_wheel_on_request() -> None:
    class Other(Wave):
        ratio = Fraction(3, 2)

        def speed(self, S: Any) -> Any:
            return 3 / 2 + 0.02 * np.cos(S)

    mesh = TRAIN.with_tooth_form(Other(), driver=2).meshes[0]
    assert float(mesh.reversed.error(1.0)) == pytest.approx(0.02 * np.sin(1))


def test_torques_follow_from_its_speed_and_efficiency() -> None:
    train = TRAIN.with_tooth_form(Kinked())
    S = (np.arange(100_000) + 0.5) / 100_000 * 2 * pi
    driver = 3 * np.mean(Kinked().speed(S) / Kinked().efficiency(S))
    assert float(train.torques().external["a"]) == pytest.approx(driver, rel=1e-9)
    assert train.torques(turns=1, samples=2000).mean == pytest.approx(driver, rel=1e-8)
    assert TRAIN.with_tooth_form(Wave(), efficiency="0.9").torques().external["a"] == pytest.approx(2 / 0.9)


def test_a_subclass_of_the_base_class_is_accepted() -> None:
    train = TRAIN.with_teeth(p=30).with_tooth_form(PinToSlotTransmission(9.6, 1.1))
    mesh = train.meshes[0]
    assert mesh.transmission.error_range() == pytest.approx(PinToSlotTransmission(9.6, 1.1).error_range(), abs=1e-12)
    assert mesh.transmission.speed_range() == pytest.approx(PinToSlotTransmission(9.6, 1.1).speed_range(), abs=1e-12)
    S = np.linspace(0, 2 * pi, 100_001)
    fall = -np.diff(PinToSlotTransmission(9.6, 1.1).speed(S)).min() / (S[1] - S[0])
    assert mesh.transmission.steepest_fall() == pytest.approx(fall, rel=1e-5)


def test_changes_of_the_train_keep_the_function_while_its_ratio_fits() -> None:
    train = TRAIN.with_tooth_form(Wave())
    kept = train.with_changes(title="changed", friction="0.1").with_teeth(p=40, w=60)
    assert float(kept.meshes[0].transmission.error(1.0)) == pytest.approx(0.02 * np.sin(1))
    with pytest.raises(GearTrainError, match="but this pair has 7/10"):
        _ = train.with_teeth(p=21).meshes


def test_a_declaration_with_a_function_can_be_pickled_but_not_read_from_text() -> None:
    train = TRAIN.with_tooth_form(Wave())
    copy = GearTrain(pickle.loads(pickle.dumps(train.declaration)))
    assert float(copy.meshes[0].transmission.error(1.0)) == pytest.approx(0.02 * np.sin(1))
    data = train.declaration.model_dump(mode="json", exclude_unset=True, by_alias=True)
    del train, copy
    gc.collect()
    with pytest.raises(GearTrainError, match="not a transmission function of this Python session"):
        GearTrain.declare(data)


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"ratio": Fraction(1, 2)}, "the ratio of 'Wrong' is 1/2, but this pair has 2/3"),
    ({"period": 1.0}, "3.18309886 pitches"),
    ({"period": float("nan")}, "pitches"),
    ({"error": lambda self, S: 0.01 * S}, "`error` of 'Wrong' changes"),
    ({"speed": lambda self, S: 2 / 3 + 0.02 * np.cos(S / 2)}, "`speed` of 'Wrong' changes"),
    ({"speed": lambda self, S: 2 / 3 + 0 * S}, "not the ratio plus the slope"),
    ({"error": lambda self, S: 0.0}, "does not return a finite number for each angle"),
    ({"error": lambda self, S: np.sqrt(np.sin(S))}, "does not return a finite number for each angle"),
    ({"error": lambda self, S: np.sin(S), "speed": lambda self, S: 2 / 3 + np.cos(S)}, "stops or turns back"),
    (
        {
            "error": lambda self, S: 0.01 * np.abs(np.sin(S)),
            "speed": lambda self, S: 2 / 3 + 0.01 * np.cos(S) * np.sign(np.sin(S)),
        },
        "return the angles of its kinks",
    ),
    ({"efficiency": lambda self, S: 1.1 + 0 * S}, "an efficiency of 'Wrong' is out of range"),
]


@pytest.mark.parametrize(("members", "message"), WRONG)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_functions_that_are_not_valid_are_refused(members: dict[str, Callable[..., Any]], message: str) -> None:
    wrong: Any = type("Wrong", (Wave,), members)
    with pytest.raises(GearTrainError, match=message):
        _ = TRAIN.with_tooth_form(wrong()).meshes


def test_an_object_without_the_members_is_refused() -> None:
    nothing: Any = object()
    with pytest.raises(GearTrainError, match="is not a transmission function"):
        TRAIN.with_tooth_form(nothing)
