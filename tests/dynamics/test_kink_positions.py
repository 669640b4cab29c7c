"""Positions of the input at which a pair is at a corner of its law: closed forms, dense sampling, jumps of speed."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from test_motion import REVERSED_PIN

from geartrain import GearTrainError, load
from geartrain.dynamics import KinkPositions, Motion
from geartrain.teeth import TransmissionFunction

ROCKING = REVERSED_PIN.replace("KIND", "pin_follower").replace("RADIUS", "4")
ROCKING = ROCKING.replace("x: 30}", "x: 300}").replace("[x, y]}", "[x, y], driver: x}")


def of(kinks: KinkPositions, pair: str) -> np.ndarray:
    return kinks.turns[kinks.pair == kinks.pairs.index(pair)]


def dense_passages(S: np.ndarray, transmission: TransmissionFunction) -> int:
    """How often a driver's angle passes a corner either way, from many samples of it."""
    found = 0
    for kink in np.unique(np.mod(transmission.kinks(), transmission.period)):
        found += int(np.abs(np.diff(np.floor((S - kink) / transmission.period))).sum())
    return found


def driver_angle(motion: Motion, transmission: TransmissionFunction, link: str, turns: np.ndarray) -> np.ndarray:
    """Of a driver on the frame: mean motion and error; a tooth of it is on the line of centres at 0."""
    at = list(motion.outputs).index(link)
    mean = float(motion._problem.ratio(link))
    return np.sign(mean or 1) * (2 * pi * mean * turns + motion.at(turns).error[at])


def test_the_first_pair_is_at_its_kink_once_a_pitch_of_the_input() -> None:
    train = load("moon-triangular")
    transmission = train.meshes[0].transmission
    found = of(train.motion(outputs=["moon"]).kink_positions(0.5, 2), "a~b1")
    every = (transmission.kinks()[0] + np.arange(-5, 200) * transmission.period) / (2 * pi)
    assert np.allclose(found, every[(every >= 0.5) & (every <= 2)], rtol=0, atol=1e-14)


def test_along_a_train_each_driver_stands_at_the_kink_of_its_transmission() -> None:
    train = load("moon-triangular")
    motion = train.motion(outputs=["sun", "c", "d", "moon"])
    kinks = motion.kink_positions(0, 3)
    assert (np.diff(kinks.turns) >= 0).all()
    for name, link, mesh in zip(kinks.pairs[1:], ["sun", "c", "d"], train.meshes[1:], strict=True):
        transmission = mesh.transmission
        found = of(kinks, name)
        pitches = (driver_angle(motion, transmission, link, found) - transmission.kinks()[0]) / transmission.period
        assert np.abs(pitches - np.rint(pitches)).max() < 1e-10
        assert len(found) == dense_passages(
            driver_angle(motion, transmission, link, np.linspace(0, 3, 100_001)), transmission
        )


@pytest.mark.parametrize("name", ["longcase-clock-bs978", "pennestri-2002-teeth"])
def test_speeds_jump_at_kinks_alone(name: str) -> None:
    motion = load(name).motion()
    turns = np.linspace(0.01, 0.06, 100_001)
    rate = motion.at(turns).rate
    scale = np.ptp(rate, axis=1) + 1e-12
    jumps = (np.abs(np.diff(rate, axis=1)) > 0.02 * scale[:, None]).any(axis=0)
    kinks = motion.kink_positions(turns[0], turns[-1]).turns
    held = np.searchsorted(kinks, turns[1:] + 1e-12) > np.searchsorted(kinks, turns[:-1] - 1e-12)
    assert jumps.sum() > 3
    assert held[jumps].all()


def test_a_driver_that_rocks_passes_its_kinks_both_ways() -> None:
    motion = load(ROCKING).motion()
    transmission = next(source.transmission for source in motion._forward.used if source.id == "x~y")
    found = of(motion.kink_positions(0, 1.5), "x~y")
    dense = driver_angle(motion, transmission, "out", np.linspace(0, 1.5, 200_001))
    assert len(found) == dense_passages(dense, transmission) > 150
    pitches = (
        driver_angle(motion, transmission, "out", found) - np.array(transmission.kinks())[:, None]
    ) / transmission.period
    assert np.abs(pitches - np.rint(pitches)).min(axis=0).max() < 1e-9


def test_turned_back_the_kinks_are_those_of_the_other_flanks() -> None:
    train = load("moon-triangular")
    motion = train.motion(outputs=["moon"])
    back = motion.kink_positions(0, -2)
    transmission = train.meshes[0].transmission.reversed_motion()
    pitches = (2 * pi * of(back, "a~b1") - transmission.kinks()[0]) / transmission.period
    assert np.abs(pitches - np.rint(pitches)).max() < 1e-12
    assert back.turns.min() >= -2
    assert back.turns.max() <= 0


def test_a_stretch_in_two_parts_has_the_kinks_of_the_whole() -> None:
    motion = load("moon-triangular").motion(outputs=["moon"])
    whole = motion.kink_positions(0, 250.25)
    parts = [motion.kink_positions(0, 131.7), motion.kink_positions(131.7, 250.25)]
    assert np.allclose(np.concatenate([part.turns for part in parts]), whole.turns, rtol=0, atol=1e-12)


def test_a_train_of_even_motion_has_none_and_too_many_are_not_listed() -> None:
    assert len(load("pennestri-2002").motion().kink_positions(0, 1).turns) == 0
    with pytest.raises(GearTrainError, match="kinks"):
        load("moon-triangular").motion().kink_positions(0, 1e9)
