"""What tests of the viewer share: pages of trains, written once, and what a reader does first."""

from __future__ import annotations

import time
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

import shipped

from geartrain import load
from geartrain.scene import build_scene
from geartrain.viewer import page

if TYPE_CHECKING:
    from conftest import Shown

    from geartrain.scene import Scene

SIMPLE, ANTIKYTHERA = "planetary-24-18-60", "freeth-2008"
GALLERY = ("worm", "longcase-clock", "zf-8hp70", "south-pointing-chariot")  # what of the gallery is made for tests
DESK: dict[str, Any] = {"viewport": {"width": 1000, "height": 620}}

LOCKED = """
name: locked
title: Three wheels in a ring
sources: {bad: {cite: A book, url: "javascript:alert(1)"}, good: {cite: Another, url: "https://example.org/a"}}
frame: frame
links: {frame: {}, a: {wheels: {a20: {teeth: 20, source: bad}}}, b: {wheels: {b30: {teeth: 30, source: good}}},
  c: {wheels: {c40: 40}}, d: {wheels: {d10: 10}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C},
  {pair: [frame, d], axis: D}]
gears: [{pair: [a20, b30]}, {pair: [b30, c40]}, {pair: [c40, a20]}, {pair: [a20, d10]}]
inputs: {a: 1}
outputs: {b: {}, c: {}}
"""

Opening = Callable[..., "Shown"]


@cache
def html_of(trains: tuple[str, ...], compare: bool = False, teeth: bool = False) -> str:
    """The page of shipped trains, or of declarations, in all their states."""
    scenes = [scene for train in trains for scene in _scenes(train)]
    return page(scenes, compare=compare, teeth=teeth)


def _scenes(train: str) -> list[Scene]:
    """Of a declaration as text, or of a shipped train, whose scenes other tests may have made."""
    if "\n" in train:
        declared = load(train)
        return [build_scene(declared, state) for state in declared.states or (None,)]
    return [shipped.built(train, state) for state in shipped.train(train).states or (None,)]


def tab(shown: Shown, name: str) -> None:
    shown.page.get_by_role("tab", name=name).click()


def wait(shown: Shown, expression: str) -> None:
    """Until an expression in the page is true."""
    end = time.monotonic() + 60
    while not shown.run(expression):
        assert time.monotonic() < end, expression
        time.sleep(0.02)


def turns(shown: Shown) -> Fraction:
    """Where the crank stands, exactly."""
    return Fraction(str(shown.run("String(geartrain.turns)")))


def rgb(text: str) -> tuple[float, float, float]:
    red, green, blue = (float(part) for part in text.removeprefix("rgb(").rstrip(")").split(","))
    return red, green, blue
