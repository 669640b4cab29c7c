"""Chains of pairs with triangular teeth: how preparation and run grow with their number."""

from __future__ import annotations

import math
import random
import time
from statistics import median
from typing import Any

import numpy as np

from geartrain.analysis.gear_train import GearTrain
from geartrain.bench.motion_records import GrowthRecord
from geartrain.teeth.triangular import clearance_window as _meshing
from geartrain.teeth.triangular import triangular_transmission as _laws

TEETH = {"form": "triangular", "half_angle": "30 deg", "window": 0.5}
_GROWN = 4_000  # positions of the chains


def chain_of_pairs(pairs: int, seed: int = 1) -> dict[str, Any]:
    """An ordinary train of so many pairs with triangular teeth, two wheels on each arbor, the whole ratio near 1.

    Of each pair drawn, the wheel drives that brings the ratio back. Ten tooth numbers make a hundred kinds of pairs.
    """
    draw, log = random.Random(seed), 0.0
    links: dict[str, Any] = {"frame": {}, "g0": {"wheels": {}}}
    gears = []
    for at in range(1, pairs + 1):
        driver, driven = draw.randrange(40, 80, 4), draw.randrange(40, 80, 4)
        if (driver > driven) == (log > 0):
            driver, driven = driven, driver
        log += math.log(driver / driven)
        links[f"g{at - 1}"]["wheels"][f"a{at}"] = driver
        links[f"g{at}"] = {"wheels": {f"b{at}": driven}}
        gears.append({"pair": (f"a{at}", f"b{at}")})
    return {
        "links": links,
        "revolutes": [{"pair": ("frame", f"g{at}"), "axis": f"A{at}"} for at in range(pairs + 1)],
        "gears": gears,
        "inputs": {"g0": 1},
        "outputs": {f"g{pairs}": {}},
        "tooth_form": TEETH,
    }


def grown(pairs: int, rounds: int) -> GrowthRecord:
    """Preparation and run of a chain; the medians of some rounds, fewer where they take more than half a minute."""
    found: list[GrowthRecord] = []
    start = time.perf_counter()
    while len(found) < rounds and (not found or (time.perf_counter() - start) * (1 + 1 / len(found)) < 30):
        found.append(_grow(pairs))
    medians = {key: median(getattr(each, key) for each in found) for key in _TIMES}
    return GrowthRecord(pairs, _GROWN, found[0].chunk, **medians)


_TIMES = ("declared", "windows", "prepared", "seconds")


def _grow(pairs: int) -> GrowthRecord:
    forget()
    data = chain_of_pairs(pairs)
    marks = [time.perf_counter()]
    train = GearTrain.declare(data)
    _ = train.circuits
    marks.append(time.perf_counter())
    _ = train.meshes
    marks.append(time.perf_counter())
    built = train.motion()
    built.at(np.zeros(1))
    marks.append(time.perf_counter())
    for _passage in built.passages(1.0, _GROWN):
        pass
    marks.append(time.perf_counter())
    took = dict(zip(_TIMES, np.diff(marks).tolist(), strict=True))
    return GrowthRecord(pairs, _GROWN, built.ahead.chunk, **took)


def forget() -> None:
    """Drop the windows and paths that earlier trains left behind, so that preparing finds its own."""
    _laws._contact.cache_clear()
    _meshing._window.cache_clear()
