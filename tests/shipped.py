"""Shipped trains, their reports, layouts and scenes, made once for all tests that only read them.

A law that every shipped train satisfies is checked on twelve trains that differ in kind, and on all others with
`--slow`: `@pytest.mark.parametrize("name", shipped.every_train())`.
"""

from __future__ import annotations

from collections.abc import Container, Iterable
from functools import cache
from typing import Any

import pytest

import geartrain
from geartrain import GearTrain
from geartrain.report import TrainReport, collect_report
from geartrain.scene import Layout, Scene, build_scene, lay_out, make_scene

# together they have nearly every key of a declaration, every kind of wheel and coupling, and four tooth forms
KINDS = {
    "freeth-2021": "the largest: pins in slots and followers, contrate wheels, dials, an epoch, a train it extends",
    "pennestri-2002-missing": "tooth counts that are searched for, published speeds, errata",
    "longcase-clock-loaded": "a weight, an escapement, material and loads; the input is solved for",
    "bevel-differential-involute": "bevel wheels, several equal planets, involute teeth, states",
    "gm-4t60": "clutches and brakes, rings, published ratios of several states",
    "huygens-planetarium-1682": "a worm; axes with positions in space",
    "crossed-helical": "helical wheels on crossed axes",
    "cycloidal-reducer": "a pin ring with an eccentric disc, and pins in holes",
    "strain-wave": "a flexible wheel, and a coupling of parallel axes",
    "norton-compound": "a fixed link, efficiencies in both directions, a load",
    "moon-triangular-inertia": "triangular teeth, a pin in a slot, inertia, bearings",
    "lantern-mill": "a lantern with its wheel, friction",
}


def trains() -> list[str]:
    """Names of the shipped trains."""
    return list(geartrain.shipped())


def every_train(names: Iterable[str] | None = None, dear: Container[str] = ()) -> list[Any]:
    """Parameters of a test: some shipped trains, or all.

    Those outside `KINDS`, and dear ones, which take seconds each, only run with `--slow`.
    """
    known = trains() if names is None else names
    return [
        pytest.param(each, marks=[] if each in KINDS and each not in dear else [pytest.mark.slow]) for each in known
    ]


@cache
def train(name: str) -> GearTrain:
    """A shipped train."""
    return geartrain.load(name)


@cache
def report(name: str) -> TrainReport:
    """All that a report on it holds."""
    return collect_report(train(name))


@cache
def layout(name: str) -> Layout:
    """Where its axes and wheels stand."""
    return lay_out(train(name))


def scene(name: str, state: str | None = None) -> Scene:
    """Its scene in a state, by default the first."""
    return _scene(name, train(name).declaration.state_or_first(state))


def built(name: str, state: str | None = None) -> Scene:
    """Its scene as it is built, which pages show, in a state, by default the first."""
    return _built(name, train(name).declaration.state_or_first(state))


@cache
def _scene(name: str, state: str | None) -> Scene:
    return make_scene(train(name), state, layout(name))


@cache
def _built(name: str, state: str | None) -> Scene:
    return build_scene(train(name), state)
