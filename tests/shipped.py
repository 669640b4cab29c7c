"""Shipped trains, their reports, layouts and scenes, computed once for all tests that only read them.

A property of every shipped train is checked on twelve trains of different kinds, and on all others with `--slow`:
`@pytest.mark.parametrize("name", shipped.every_train())`.
"""

from __future__ import annotations

from collections.abc import Container, Iterable
from functools import cache
from typing import Any

import pytest

import geartrain
from geartrain import GearTrain
from geartrain.report import Document, TrainReport, collect_report
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
    """Return the names of the shipped trains."""
    return list(geartrain.shipped())


def every_train(names: Iterable[str] | None = None, dear: Container[str] = (), step: int = 1) -> list[Any]:
    """Return test parameters: shipped trains of different kinds, and with `--slow` all others, or every third of them
    if `step` is 3.

    Trains in `dear` take seconds each and run only with `--slow`.
    """
    known = trains() if names is None else list(names)
    others = [each for each in known if each not in KINDS][::step]
    kept = [each for each in known if each in KINDS or each in others]
    return [pytest.param(each, marks=[] if each in KINDS and each not in dear else [pytest.mark.slow]) for each in kept]


@cache
def train(name: str) -> GearTrain:
    """Return a shipped train."""
    return geartrain.load(name)


@cache
def report(name: str) -> TrainReport:
    """Return the data of the report on a train."""
    return collect_report(train(name))


@cache
def document(name: str) -> Document:
    """Return the report on a train as a document."""
    return train(name).report()


@cache
def layout(name: str) -> Layout:
    """Return the positions of its axes and wheels."""
    return lay_out(train(name))


def scene(name: str, state: str | None = None) -> Scene:
    """Return its scene in a state, by default the first."""
    return _scene(name, train(name).declaration.state_or_first(state))


def built(name: str, state: str | None = None) -> Scene:
    """Return its scene with solid parts, as pages show it, in a state, by default the first."""
    return _built(name, train(name).declaration.state_or_first(state))


@cache
def _scene(name: str, state: str | None) -> Scene:
    return make_scene(train(name), state, layout(name))


@cache
def _built(name: str, state: str | None) -> Scene:
    return build_scene(train(name), state)
