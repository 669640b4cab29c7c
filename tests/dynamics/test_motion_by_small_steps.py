"""The composed motion is the limit of small steps: measured orders of convergence, located collisions and not."""

from __future__ import annotations

from functools import cache
from math import log, pi

import numpy as np
import pytest
from marching import JammedError, Pair, Slot, Teeth, Train, declared, march

from geartrain import GearTrainError, load

FRAME, QUARTER, ARM = "frame", 0.5 * pi, "arm"
PLACES, LOCATED, NOTICED = 9, [16, 32, 64], [16, 32, 64, 128, 256]
SETS = {"left": (FRAME, "A"), "right": (FRAME, "A"), ARM: (FRAME, "A"), "planet": (ARM, "P")}


def teeth(z1: int, z2: int, clearance: float = 1.02) -> Teeth:
    return Teeth(z1, z2, clearance)


SUNS = (Pair("left", "planet", ARM, teeth(40, 20)), Pair("planet", "right", ARM, teeth(18, 44)))
TRAINS = {
    "the Moon": Train(
        {"crank": (FRAME, "A"), "sun": (FRAME, "B"), "c": (FRAME, "C"), "d": (FRAME, "D"), "moon": (FRAME, "E")},
        (
            Pair("crank", "sun", FRAME, teeth(45, 225, 1.01)),
            Pair("sun", "c", FRAME, teeth(64, 38, 1.01)),
            Pair("c", "d", FRAME, teeth(48, 24, 1.01)),
            Pair("d", "moon", FRAME, teeth(127, 32, 1.01)),
        ),
        {"crank": 1.0},
    ),
    "two inputs": Train(SETS, SUNS, {"left": 1.0, ARM: 1 / 3}),
    "two suns, one held": Train(
        SETS,
        (Pair("left", "planet", ARM, teeth(30, 60)), Pair("planet", "right", ARM, teeth(40, 60))),
        {"left": 1.0, "right": 0.0},
    ),
    "two planets that mesh": Train(
        SETS | {"other": (ARM, "Q")},
        (
            Pair("left", "planet", ARM, teeth(36, 24)),
            Pair("planet", "other", ARM, teeth(30, 25)),
            Pair("other", "right", ARM, teeth(20, 45)),
        ),
        {"left": 1.0, ARM: -0.5},
    ),
    "an arm turned by its own planet": Train(
        SETS | {"lay": (FRAME, "B")},
        (*SUNS, Pair("right", "lay", FRAME, teeth(50, 40)), Pair("lay", ARM, FRAME, teeth(30, 60))),
        {"left": 1.0},
    ),
    "pin and slot on an arm": Train(
        SETS | {"crank": (FRAME, "C"), "other": (ARM, "Q")},
        (
            Pair("crank", ARM, FRAME, teeth(30, 60)),
            Pair("left", "planet", ARM, teeth(50, 40)),
            Pair("planet", "other", ARM, Slot(9.6, 2.2)),
            Pair("other", "right", ARM, teeth(40, 50)),
        ),
        {"crank": 1.0, "left": -0.25},
    ),
}


@cache
def composed(name: str, turned: float, samples: int) -> np.ndarray:
    """Angles of all links by composition, (positions, links), the frame last."""
    found = load(declared(TRAINS[name])).motion().transmission_errors(turned / (2 * pi), samples)
    angle = next(iter(found.values())).angle
    columns = [found[link].mean * angle + found[link].error for link in TRAINS[name].bases]
    return np.stack([*columns, np.zeros_like(angle)], axis=1)


def off(name: str, turned: float, places: int, steps: int, method: str, locate: bool = True) -> np.ndarray:
    """Greatest difference of any link's angle from the composition, at each place on the way."""
    path = np.array(list(march(TRAINS[name], turned, (places - 1) * steps, method, locate)))[::steps]
    return np.abs(path - composed(name, turned, places)).max(axis=1)


def order(errors: list[float], steps: list[int]) -> float:
    """Slope of the logarithm of the error over that of the step, by least squares."""
    slope, _ = np.polyfit([-log(step) for step in steps], [log(error) for error in errors], 1)
    return float(slope)


@pytest.mark.parametrize("name", TRAINS)
def test_all_pairs_touch_at_the_start_where_the_composition_has_them(name: str) -> None:
    setting = load(declared(TRAINS[name])).motion().pointer_offsets
    hung = np.array([-setting[link] for link in TRAINS[name].bases])
    assert np.abs(TRAINS[name].lag[:-1] - hung).max() < 2e-14
    assert np.abs(hung).max() > 1e-3
    # and there the pointers show what ideal teeth would
    assert np.abs(composed(name, QUARTER, PLACES)[0]).max() < 1e-15


@pytest.mark.parametrize("name", TRAINS)
@pytest.mark.parametrize(
    ("method", "minimum", "most", "left"),
    [("Euler", 0.8, 1.2, 1e-2), ("midpoint", 1.85, 2.15, 1e-4), ("Runge-Kutta", 3.7, 4.3, 1e-8)],
)
def test_with_collisions_located_each_method_has_its_own_order(
    name: str, method: str, minimum: float, most: float, left: float
) -> None:
    errors = [off(name, QUARTER, PLACES, steps, method) for steps in LOCATED]
    assert minimum < order([error.mean() for error in errors], LOCATED) < most
    assert minimum < order([error.max() for error in errors], LOCATED) < most
    # at the last place too the difference falls as it should, to the error that the order allows
    expected = (LOCATED[0] / LOCATED[-1]) ** minimum
    assert errors[-1][-1] < 1.5 * expected * errors[0].max()
    assert errors[-1].max() < left


@pytest.mark.parametrize("name", TRAINS)
def test_across_collisions_that_are_only_noticed_all_is_of_first_order(name: str) -> None:
    errors = [off(name, QUARTER, PLACES, steps, "Runge-Kutta", locate=False) for steps in NOTICED]
    assert 0.75 < order([error.mean() for error in errors], NOTICED) < 1.25


@pytest.mark.parametrize(("name", "left"), [("two inputs", 1e-12), ("pin and slot on an arm", 1e-12)])
def test_the_limit_is_the_composition_to_rounding(name: str, left: float) -> None:
    assert off(name, QUARTER, PLACES, 256, "Runge-Kutta").max() < left


@pytest.mark.long
@pytest.mark.parametrize("name", TRAINS)
def test_the_limit_over_ten_turns_is_the_composition(name: str) -> None:
    assert off(name, 20 * pi, 41, 1000, "Runge-Kutta").max() < 1e-9


def test_where_small_steps_jam_there_is_no_composition() -> None:
    """Two suns, one held: the product of both ratios passes 1, and the arm pushes back on the sun that turns it."""
    train = Train(SETS, SUNS, {"left": 1.0, "right": 0.0})
    with pytest.raises(JammedError):
        list(march(train, QUARTER, 4000, "midpoint"))
    with pytest.raises(GearTrainError, match="coupled pairs"):
        load(declared(train)).motion().transmission_errors(0.25, 101)
