"""Diagrams of the documentation in a browser: each is dragged, and the numbers it shows are the package's."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import cos, pi, sin
from pathlib import Path
from typing import Any

import diagrams
import make_diagrams
import pytest
from playwright.sync_api import Browser, Locator, Page

import geartrain

ROOT = Path(__file__).parent.parent.parent
TURN = 2 * pi
KINDS = diagrams.KINDS


@dataclass
class Drawn:
    """A diagram on a sheet of its own, and what went wrong on it: errors, and requests of any kind."""

    page: Page
    wrong: list[str]

    def handle(self, label: str) -> Locator:
        return self.page.get_by_role("slider", name=label, exact=True)

    def number(self, of: str, as_: str) -> str:
        """A number of the table, by the name of its row and the head of its column."""
        found = self.page.locator(f'td[data-of="{of}"][data-as="{as_}"]').inner_text()
        return found.replace("\N{MINUS SIGN}", "-")

    def fraction(self, of: str, as_: str) -> Fraction:
        return Fraction(self.number(of, as_))

    @property
    def remark(self) -> str:
        return self.page.locator(".gd-remark").inner_text().replace("\N{MINUS SIGN}", "-")

    def place(self, x: float, y: float, within: str = ".gd-plane") -> tuple[float, float]:
        """Where a point of the picture's plane stands on the sheet."""
        script = """([within, x, y]) => {
          const at = new DOMPoint(x, y).matrixTransform(document.querySelector(within).getScreenCTM());
          return [at.x, at.y];
        }"""
        left, top = self.page.evaluate(script, [within, x, y])
        return float(left), float(top)

    def drag(self, path: list[tuple[float, float]]) -> None:
        """Along points of the sheet."""
        mouse = self.page.mouse
        mouse.move(*path[0])
        mouse.down()
        for point in path[1:]:
            mouse.move(*point)
        mouse.up()

    def drag_round(self, radius: float, turns: float, start: float = 0.0, centre: tuple[float, float] = (0, 0)) -> None:
        """Round a point of the plane, from an angle (turns), in steps of less than a twelfth."""
        steps = 1 + int(abs(turns) * 24)
        angles = [TURN * (start + turns * n / steps) for n in range(steps + 1)]
        self.drag([self.place(centre[0] + radius * cos(a), centre[1] + radius * sin(a)) for a in angles])

    def choose(self, text: str, among: str) -> None:
        self.page.locator("fieldset", has_text=among).get_by_text(text, exact=True).click()


Opening = Callable[..., Drawn]


@pytest.fixture
def draw(browser: Browser, tmp_path: Path) -> Iterator[Opening]:
    """A diagram as the site has it, from disk and without a network."""
    contexts = []

    def opened(kind: str, **window: Any) -> Drawn:
        settings = {"viewport": {"width": 700, "height": 1100}, "offline": True, "reduced_motion": "reduce"}
        context = browser.new_context(**(settings | window))
        contexts.append(context)
        script, style = (path.read_text(encoding="utf-8") for path in diagrams.files().values())
        still = '<img alt="still" src="data:,">'
        text = f"<style>{style}</style>{diagrams.element(kind, still)}<script>{script}</script>"
        (tmp_path / "page.html").write_text(f'<!DOCTYPE html><meta charset="utf-8">{text}', encoding="utf-8")
        drawn = Drawn(context.new_page(), [])
        drawn.page.on("console", lambda said: drawn.wrong.append(said.text))
        drawn.page.on("pageerror", lambda error: drawn.wrong.append(str(error)))
        drawn.page.goto((tmp_path / "page.html").as_uri())
        drawn.page.wait_for_selector(".gd-alive" if window.get("java_script_enabled", True) else "gear-diagram")
        return drawn

    yield opened
    for context in contexts:
        context.close()


# ------------------------------------------------------------------------------------------------------------ of all


def test_every_kind_stands_in_a_page_above_its_still() -> None:
    pages = "".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs").glob("*.md")))
    for kind in KINDS:
        _, found, rest = pages.partition(f"<!-- diagram: {kind} -->\n![")
        assert found, kind
        assert f"](images/diagram-{kind}.svg)" in rest.split("\n\n")[0].replace("\n", " ")
    assert pages.count("<!-- diagram: ") == len(KINDS)


@pytest.mark.parametrize("kind", KINDS)
def test_a_diagram_is_the_still_until_scripts_run_and_again_in_print(draw: Opening, kind: str) -> None:
    without = draw(kind, java_script_enabled=False)
    assert without.page.locator("gear-diagram > img").is_visible()
    drawn = draw(kind)
    assert drawn.page.locator(".gd-picture").is_visible()
    assert not drawn.page.locator("gear-diagram > img").is_visible()
    drawn.page.emulate_media(media="print")
    assert drawn.page.locator("gear-diagram > img").is_visible()
    assert not drawn.page.locator(".gd-live").is_visible()
    assert drawn.wrong == []


@pytest.mark.parametrize("kind", KINDS)
def test_the_still_is_what_the_diagram_draws(draw: Opening, kind: str) -> None:
    drawn = draw(kind)
    assert make_diagrams.still(drawn.page, kind) == (ROOT / "docs" / "images" / f"diagram-{kind}.svg").read_text(
        "utf-8"
    )


@pytest.mark.parametrize("kind", KINDS)
def test_every_handle_has_a_name_and_turns_by_keys(draw: Opening, kind: str) -> None:
    drawn = draw(kind)
    handles = drawn.page.locator(".gd-handle:visible")
    assert handles.count() > 0
    moved = 0
    for handle in handles.all():
        before = handle.get_attribute("aria-valuetext")
        assert handle.get_attribute("aria-label")
        assert before
        handle.focus()
        handle.press("ArrowRight")
        if handle.get_attribute("aria-valuetext") == before:  # it may stand at its end
            handle.press("ArrowLeft")
        moved += handle.get_attribute("aria-valuetext") != before
    assert moved > 0
    assert drawn.wrong == []


@pytest.mark.parametrize("kind", KINDS)
def test_a_diagram_fits_a_phone_and_a_finger_drags_it(draw: Opening, kind: str) -> None:
    drawn = draw(kind, viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    assert drawn.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert drawn.page.evaluate("getComputedStyle(document.querySelector('.gd-handle')).touchAction") == "none"
    smallest = "Math.min(...[...document.querySelectorAll('.gd-text')].map((e) => e.getBoundingClientRect().height))"
    assert drawn.page.evaluate(f"document.querySelector('.gd-text') === null || {smallest} >= 11")


def test_pages_of_the_site_have_their_diagrams_in_light_and_dark(site: Path, browser: Browser) -> None:
    for path in sorted((ROOT / "docs").glob("*.md")):
        if count := path.read_text(encoding="utf-8").count("<!-- diagram: "):
            page = browser.new_page(offline=True)
            wrong = list[str]()
            page.on("pageerror", lambda error, wrong=wrong: wrong.append(str(error)))
            page.goto((site / f"{path.stem}.html").as_uri())
            assert page.locator("gear-diagram.gd-alive").count() == count, path.stem
            paper = "getComputedStyle(document.querySelector('.gd-live')).backgroundColor"
            colours = set()
            for scheme in ("default", "slate"):
                page.evaluate("(scheme) => document.body.setAttribute('data-md-color-scheme', scheme)", scheme)
                colours.add(page.evaluate(paper))
            assert len(colours) == 2
            assert wrong == []
            page.close()


# --------------------------------------------------------------------------------------------------- Willis' inversion

GROUND, ARM = "from the ground", "from the carrier"


@pytest.mark.parametrize("held", ["ring", "sun", "carrier"])
def test_turns_of_a_planetary_are_the_packages_from_the_ground_and_from_the_carrier(draw: Opening, held: str) -> None:
    drawn = draw("willis")
    drawn.choose(held, among="Held")
    grip = {"ring": ("carrier", 10.5), "sun": ("ring", 32.5), "carrier": ("sun", 6.0)}[held]
    before = drawn.fraction(grip[0], GROUND)
    drawn.drag_round(grip[1], 0.35, start=float(before) if held == "ring" else 0.2)
    made = drawn.fraction(grip[0], GROUND)
    assert abs(made - before - Fraction("0.35")) < Fraction(1, 100)
    assert (360 * made).denominator == 1
    solved = geartrain.load("planetary").solve(f"{held} fixed").speeds
    for link in ("sun", "planet", "ring", "carrier"):
        assert drawn.fraction(link, GROUND) == made * solved[link] / solved[grip[0]]
        assert drawn.fraction(link, ARM) == made * (solved[link] - solved["carrier"]) / solved[grip[0]]
    assert drawn.remark.count("= -5/2,") == 1, "minus the teeth of the ring over those of the sun"


def test_seen_from_the_carrier_the_carrier_stands_and_what_is_dragged_moves_against_it(draw: Opening) -> None:
    drawn = draw("willis")
    drawn.choose(ARM, among="Seen")
    place = (
        "(({x, y, width, height}) => [x, y, width, height])(document.querySelector('.gd-arm').getBoundingClientRect())"
    )
    before = drawn.page.evaluate(place)
    drawn.drag_round(32.5, -0.25, start=0.1)
    assert drawn.page.evaluate(place) == pytest.approx(before, abs=0.5)
    assert abs(drawn.fraction("ring", ARM) + Fraction(1, 12) + Fraction("0.25")) < Fraction(1, 100)
    assert drawn.fraction("ring", GROUND) == 0
