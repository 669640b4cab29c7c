"""Shared functions of the tests of the viewer: cached pages of trains, and common actions."""

from __future__ import annotations

import io
import time
from base64 import b64decode
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import shipped
from PIL import Image

from geartrain import load
from geartrain.scene import build_scene
from geartrain.viewer import page

if TYPE_CHECKING:
    from conftest import Shown
    from playwright.sync_api import Page

    from geartrain.scene import Scene

SIMPLE, ANTIKYTHERA = "planetary-24-18-60", "freeth-2008"
GALLERY = ("worm", "longcase-clock", "south-pointing-chariot")  # trains in the gallery of tests
DESK: dict[str, Any] = {"viewport": {"width": 1000, "height": 620}}
MOVING: dict[str, Any] = {"reduced_motion": "no-preference"}  # window of a test of motion
# window without WebGL, for tests of readings: no train is drawn in three dimensions
PLAN: dict[str, Any] = {"before": "HTMLCanvasElement.prototype.getContext = () => null"}

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
    """Return the HTML page of shipped trains, or of declarations, in all their states."""
    scenes = [scene for train in trains for scene in _scenes(train)]
    return page(scenes, compare=compare, teeth=teeth)


def _scenes(train: str) -> list[Scene]:
    """Return the scenes of a declaration as text, or of a shipped train (cached)."""
    if "\n" in train:
        declared = load(train)
        return [build_scene(declared, state) for state in declared.states or (None,)]
    return [shipped.built(train, state) for state in shipped.train(train).states or (None,)]


def tab(shown: Shown, name: str) -> None:
    shown.page.get_by_role("tab", name=name).click()


def unfold(shown: Shown, name: str) -> None:
    """Open a folded part of the readings."""
    tab(shown, "Readings")
    part = shown.page.locator(".more", has=shown.page.locator("summary", has_text=name))
    if part.get_attribute("open") is None:
        part.locator("summary").click()


def go(shown: Shown, turn: object) -> None:
    """Type a number of turns of the crank."""
    shown.page.get_by_label("Go to turn").fill(str(turn))
    shown.page.keyboard.press("Enter")


def wait(shown: Shown, expression: str) -> None:
    """Wait until an expression in the page is true."""
    end = time.monotonic() + 60
    while not shown.run(expression):
        assert time.monotonic() < end, expression
        time.sleep(0.02)


def turns(shown: Shown) -> Fraction:
    """Return the exact turns of the crank."""
    return Fraction(str(shown.run("String(geartrain.turns)")))


def rgb(text: str) -> tuple[float, float, float]:
    red, green, blue = (float(part) for part in text.removeprefix("rgb(").rstrip(")").split(","))
    return red, green, blue


def luminance(colour: str) -> float:
    """Return the relative luminance of WCAG 2.2."""
    parts = [part / 255 for part in rgb(colour)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """Return the contrast ratio of WCAG 2.2."""
    dark, light = sorted((luminance(one), luminance(other)))
    return (light + 0.05) / (dark + 0.05)


def picture(data: str | bytes) -> np.ndarray:
    """Return a picture from a file or a data URL, shape (height, width, 3), from 0 to 255."""
    file = data if isinstance(data, bytes) else b64decode(data.partition(",")[2])
    return np.asarray(Image.open(io.BytesIO(file)).convert("RGB"), dtype=int)


def listen(page: Page, *own: str) -> list[str]:
    """Return a list to which errors, dialogs, and requests to addresses without one of the given prefixes are added."""
    wrong = list[str]()
    page.on("console", lambda said: wrong.append(said.text) if said.type == "error" else None)
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.on("dialog", lambda dialog: wrong.append(dialog.message))
    page.on("request", lambda requested: None if requested.url.startswith(own) else wrong.append(requested.url))
    return wrong
