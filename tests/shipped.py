"""Shipped trains, their reports, layouts and scenes, made once for all tests that only read them."""

from __future__ import annotations

from functools import cache

import geartrain
from geartrain import GearTrain
from geartrain.report import TrainReport, collect_report
from geartrain.scene import Layout, Scene, build_scene, lay_out, make_scene


def trains() -> list[str]:
    """Names of the shipped trains."""
    return list(geartrain.shipped())


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


@cache
def scene(name: str, state: str | None = None) -> Scene:
    """Its scene."""
    return make_scene(train(name), state, layout(name))


@cache
def built(name: str, state: str | None = None) -> Scene:
    """Its scene as it is built, which pages show."""
    return build_scene(train(name), state)
