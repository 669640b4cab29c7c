"""Extremes over a run: the same at any number of samples, at jumps too, and never passed by a sample."""

from __future__ import annotations

import re
from math import asin, degrees

import numpy as np
import pytest

from geartrain import load
from geartrain.dynamics import Motion, MotionRun

FREETH = ("moon", "mars", "saturn", "draconic month", "mercury")


def finished(motion: Motion, turns: float, samples: int) -> MotionRun:
    run = MotionRun(motion, turns, samples)
    run.run()
    return run


def extremes(motion: Motion, turns: float, samples: int) -> np.ndarray:
    run = finished(motion, turns, samples)
    assert all(tally.searched for tally in run.statistics)
    return np.array([(t.most, t.minimum, t.fast, t.slow) for t in run.statistics])


@pytest.mark.parametrize(
    ("name", "outputs", "turns"),
    [
        ("moon-triangular", ("moon",), 20),
        ("longcase-clock-bs978", None, 2),
        ("freeth-2021-teeth", FREETH, 0.6),
        ("pennestri-2002-teeth", ("5",), 0.5),
        pytest.param("freeth-2021-teeth", FREETH, 20, marks=pytest.mark.long),
    ],
)
def test_extremes_do_not_depend_on_the_samples(name: str, outputs: tuple[str, ...] | None, turns: float) -> None:
    motion = load(name).motion() if outputs is None else load(name).motion(outputs=outputs)
    found = [extremes(motion, turns, samples) for samples in (200, 5_001)]
    size = np.abs(found[0]).max(axis=1, keepdims=True) + 1e-12
    assert max(np.ptp([each / size for each in found], axis=0).ravel()) < 1e-9


@pytest.mark.parametrize("name", ["moon-triangular", "longcase-clock-bs978", "pennestri-2002-teeth"])
@pytest.mark.parametrize("way", [1, -1])
def test_no_sample_is_beyond_them_and_samples_at_corners_reach_them(name: str, way: int) -> None:
    motion = load(name).motion(outputs=["5"]) if name.startswith("pennestri") else load(name).motion()
    end = 0.37 * way
    composition = motion._forward if way > 0 else motion._backward
    low, high = sorted((0.0, end))
    found = extremes(motion, end, 50)
    corners = motion.kink_positions(0, end).turns
    near = [np.clip(corners + side * offset, low, high) for side in (-1, 1) for offset in (1e-12, 1e-9, 1e-7)]
    turns = np.concatenate([np.linspace(low, high, 20_001), *near])
    parts = [composition.at(turns[at : at + composition.chunk]) for at in range(0, len(turns), composition.chunk)]
    top = np.max([(part.error.max(axis=1), part.rate.max(axis=1)) for part in parts], axis=0)
    bottom = np.min([(part.error.min(axis=1), part.rate.min(axis=1)) for part in parts], axis=0)
    beyond = np.stack([top - found[:, [0, 2]].T, found[:, [1, 3]].T - bottom]) / (top - bottom + 1e-9)
    assert beyond.max() < 2e-9
    assert beyond.min() > -2e-4


def test_of_a_pin_alone_they_are_those_of_its_formula() -> None:
    (tally,) = finished(load("freeth-2021").motion(outputs=["mars"]), 40, 30).statistics
    r, e = 10.00, 6.58
    assert tally.peak_to_peak == pytest.approx(2 * asin(e / r), rel=1e-8)


def test_of_one_pair_they_are_those_of_its_transmission() -> None:
    train = load("moon-triangular")
    (tally,) = finished(train.motion(outputs=["sun"]), 3, 30).statistics
    transmission = train.meshes[0].transmission
    assert tally.peak_to_peak == pytest.approx(np.ptp(transmission.error_range()), rel=1e-10)
    slow, fast = transmission.speed_range()
    mean = float(transmission.ratio)
    assert sorted(tally.speeds) == pytest.approx([slow / mean, fast / mean], rel=1e-7)


def test_a_run_too_long_to_be_searched_has_sampled_extremes_and_a_bound() -> None:
    run = finished(load("freeth-2021-teeth").motion(outputs=["moon"]), 5_000, 2_000)
    (tally,) = run.statistics
    assert not tally.searched
    bound = float(re.search(r"at most moon ([\d.]+) deg", " ".join(str(run).split()))[1])
    (whole,) = finished(load("freeth-2021-teeth").motion(outputs=["moon"]), 2, 2_000).statistics
    assert degrees(tally.peak_to_peak) < degrees(whole.peak_to_peak) < bound
