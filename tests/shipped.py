"""Shipped trains and their scenes, made once for all tests that only read them."""

from __future__ import annotations

from functools import cache

import geartrain
from geartrain import GearTrain
from geartrain.scene import Scene, make_scene


@cache
def train(name: str) -> GearTrain:
    """A shipped train."""
    return geartrain.load(name)


@cache
def scene(name: str, state: str | None = None) -> Scene:
    """Its scene."""
    return make_scene(train(name), state)
