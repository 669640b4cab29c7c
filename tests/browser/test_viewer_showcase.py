"""Picture with three buttons, in frames of other pages and on a museum's screen."""

from __future__ import annotations

import re
from collections.abc import Callable
from math import pi
from pathlib import Path
from typing import Any, Literal

import pytest
import shipped
from conftest import OpenPage, OpenWindow, Shown
from viewing import LOCKED, MOVING, SIMPLE, wait

import geartrain
from geartrain.scene import make_scene
from geartrain.viewer import page
from geartrain.viewer.viewer_page import frame_of

Showing = Callable[..., Shown]
Way = Literal["page", "embed", "kiosk"]
CAMERA = "geartrain.stages.find(Boolean).camera.position.toArray()"


@pytest.fixture
def showcase(open_page: OpenPage, tmp_path: Path) -> Showing:
    """Function that opens the page of a train with three buttons."""

    def opened(way: Way, name: str = SIMPLE, mark: str = "", before: str = "", **window: Any) -> Shown:
        path = tmp_path / "page.html"
        scene = shipped.scene(name) if "\n" not in name else make_scene(geartrain.load(name))
        path.write_text(page([scene], teeth=False, shown=way), encoding="utf-8")
        return open_page(path, before + (f"location.hash = '{mark}';" if mark else ""), **({"opening": True} | window))

    return opened


def names(shown: Shown) -> list[str]:
    return [each.inner_text() for each in shown.page.get_by_role("button").all()]


@pytest.mark.parametrize(("way", "mark"), [("embed", ""), ("kiosk", ""), ("page", "embed"), ("page", "kiosk")])
def test_there_are_a_few_buttons_and_nothing_to_type_into(showcase: Showing, way: Way, mark: str) -> None:
    shown = showcase(way, mark=mark, viewport={"width": 390, "height": 600})
    kiosk = "kiosk" in (way, mark)
    expected = ["Turn", "Other side", "Take apart"]
    assert names(shown) == (["Tour in 5 steps", "Stop", *expected[1:], "Names"] if kiosk else expected)
    assert shown.run("document.querySelectorAll('input, select, textarea, a, [contenteditable]').length") == 0
    assert "A simple planetary" in shown.page.get_by_role("heading").inner_text()
    inside = (
        "[...document.querySelectorAll('button, h1')].every((each) => each.getBoundingClientRect().right <= innerWidth)"
    )
    assert shown.run(inside)
    assert shown.run("document.documentElement.scrollWidth <= innerWidth")
    assert shown.errors == shown.requests == []


def test_it_turns_by_itself_until_it_is_stopped(showcase: Showing) -> None:
    shown = showcase("embed", **MOVING)
    wait(shown, "Number(geartrain.machines[0].turns) > 0.02")
    assert names(shown)[0] == "Stop"
    shown.page.get_by_role("button", name="Stop").click()
    stopped = shown.run("String(geartrain.turns)")
    shown.page.wait_for_timeout(400)
    assert shown.run("String(geartrain.turns)") == stopped
    shown.page.get_by_role("button", name="Turn").click()
    wait(shown, f"String(geartrain.turns) !== '{stopped}'")


def test_where_less_motion_is_wanted_it_waits_for_its_reader(showcase: Showing) -> None:
    shown = showcase("embed")
    first = shown.run("String(geartrain.turns)")
    shown.page.wait_for_timeout(500)
    assert shown.run("String(geartrain.turns)") == first
    assert names(shown)[0] == "Turn"


def test_the_buttons_show_the_other_side_and_take_apart(showcase: Showing) -> None:
    shown = showcase("embed")
    free = shown.run(CAMERA)
    shown.page.get_by_role("button", name="Other side").click()
    front = shown.run(CAMERA)
    assert abs(front[0]) < 1e-6 * front[2], "from the front"
    assert front != free
    shown.page.get_by_role("button", name="Take apart").click()
    assert shown.run("geartrain.stages.find(Boolean).world.poses.share") == 1
    shown.page.get_by_role("button", name="Together").click()
    assert shown.run("geartrain.stages.find(Boolean).world.poses.share") == 0


def test_a_kiosk_left_alone_goes_on_by_itself_and_looks_round(showcase: Showing) -> None:
    shown = showcase("kiosk", mark="kiosk=1", **MOVING)
    shown.page.get_by_role("button", name="Stop").click()
    shown.page.get_by_role("button", name="Take apart").click()
    assert names(shown)[1:4:2] == ["Turn", "Together"]
    wait(shown, "document.querySelector('[aria-label=Stop]')")
    assert names(shown)[3] == "Take apart"
    before = shown.run(CAMERA)
    wait(shown, f"Math.hypot(...{CAMERA}.map((each, at) => each - {before}[at])) > 1e-3 * Math.hypot(...{before})")


def test_the_first_touch_of_a_kiosk_fills_the_screen(showcase: Showing) -> None:
    requested = (
        "Element.prototype.requestFullscreen = function () { globalThis.filled = true; return Promise.resolve(); };"
    )
    shown = showcase("kiosk", before=requested)
    assert not shown.run("Boolean(globalThis.filled)")
    shown.page.get_by_role("button", name="Other side").click()
    assert shown.run("globalThis.filled")


def test_a_train_that_cannot_turn_says_why(showcase: Showing) -> None:
    shown = showcase("embed", LOCKED)
    assert shown.page.get_by_role("button", name="Turn").is_disabled()
    assert "does not close" in shown.page.locator("header").inner_text()


def test_a_page_of_somebody_else_shows_the_train_in_a_frame(open_page: OpenPage, tmp_path: Path) -> None:
    (tmp_path / "a train.html").write_text(page([shipped.scene(SIMPLE)], teeth=False, shown="embed"), encoding="utf-8")
    outer = tmp_path / "outer.html"
    ready = "<script>globalThis.geartrain = {ready: true}</script>"
    frame_line = frame_of("a train.html", 'A "train"')
    outer.write_text(f"<title>mine</title>{ready}{frame_line}", encoding="utf-8")
    shown = open_page(outer)
    frame = shown.page.frame_locator("iframe[title='A \"train\"']")
    frame.get_by_role("button", name="Turn").wait_for()
    assert frame.locator("canvas").bounding_box()["width"] > 300  # type: ignore[index]


def test_the_element_of_the_guide_shows_any_page_of_a_train(open_window: OpenWindow, tmp_path: Path) -> None:
    guide = (Path(__file__).parents[2] / "docs/viewer.md").read_text(encoding="utf-8")
    (block,) = [each for each in re.findall(r"```html\n(.*?)```", guide, re.DOTALL) if "customElements" in each]
    for name in ("worm", SIMPLE):
        (tmp_path / f"{name}.html").write_text(page([shipped.scene(name)], teeth=False), encoding="utf-8")
    (tmp_path / "own.html").write_text(f"<!doctype html><title>Mine</title>{block}", encoding="utf-8")
    sheet = open_window(viewport={"width": 800, "height": 600})
    sheet.goto((tmp_path / "own.html").as_uri())
    frame = sheet.locator("gear-train iframe")
    assert (frame.get_attribute("title"), frame.bounding_box()) == (
        "Two-start worm, sixty teeth",
        {"x": 8, "y": 8, "width": 784, "height": 320},
    )
    inside = sheet.frame_locator("gear-train iframe")
    inside.get_by_role("button", name="Other side").wait_for()
    assert "worm" in inside.get_by_role("heading").inner_text()
    sheet.evaluate("(src) => document.querySelector('gear-train').setAttribute('src', src)", f"{SIMPLE}.html")
    inside.get_by_role("heading", name="A simple planetary").wait_for()
    sheet.evaluate("document.querySelector('gear-train').removeAttribute('src')")
    assert frame.count() == 0


def test_a_kiosk_tells_the_date_and_outputs_as_it_turns(showcase: Showing) -> None:
    shown = showcase("kiosk", "freeth-2021", viewport={"width": 390, "height": 844})
    year = float(shown.run("new Date().getUTCFullYear()"))  # type: ignore[arg-type]
    assert abs(float(shown.page.locator("header .date").inner_text().partition(",")[0].split()[-1]) - year) <= 1
    shown.run("(turns) => geartrain.setTurns(turns)", str(shipped.scene("freeth-2021").epoch.turns))  # type: ignore[union-attr]
    date = "header .date"
    wait(shown, f"document.querySelector('{date}').textContent.includes('205 BC')")
    read = shown.page.locator("header .read > div")
    assert read.count() == 6
    shown.run("geartrain.setTurns('7/3')")
    # set to the sky of today: the Sun turns as b from its mean longitude of this moment (tested with its time)
    start = float(shown.run("geartrain.scenes[0].bodies.find(({ id }) => id === 'b').start"))  # type: ignore[arg-type]
    degrees = (start * 180 / pi + 840) % 360
    wait(shown, f"Math.abs(Number.parseFloat(document.querySelector('.read dd').textContent) - {degrees}) < 0.01")
    assert read.first.inner_text().split()[0] == "sun"
    fits = "document.querySelector('.read').scrollWidth <= innerWidth"
    assert shown.run(fits)
    assert shown.errors == shown.requests == []


def test_a_frame_in_another_page_tells_turns_only(showcase: Showing) -> None:
    shown = showcase("embed")
    assert shown.page.locator("header .read, header .date").count() == 0
