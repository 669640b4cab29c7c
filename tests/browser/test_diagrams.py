"""Diagrams of the documentation in a browser: each is dragged, and its numbers equal those of the package."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, pairwise
from math import asin, atan2, cos, degrees, hypot, pi, sin
from pathlib import Path
from typing import Any

import diagram_data
import diagrams
import make_diagrams
import pytest
from conftest import OpenWindow
from playwright.sync_api import Locator, Page
from viewing import listen

import geartrain

ROOT = Path(__file__).parent.parent.parent
TURN = 2 * pi
KINDS = diagrams.KINDS
DRAGGED = [kind for kind in KINDS if kind != "circuits"]  # the other diagrams respond to pointing
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
GROUND, ARM = "relative to the frame", "relative to the carrier"


@dataclass
class Drawn:
    """Diagram on its own page, with the errors and requests of the page."""

    page: Page
    wrong: list[str]

    def handle(self, label: str) -> Locator:
        return self.page.get_by_role("slider", name=label, exact=True)

    def number(self, of: str, as_: str) -> str:
        """Return a number of the table, by the name of its row and the head of its column."""
        found = self.page.locator(f'td[data-of="{of}"][data-as="{as_}"]').inner_text()
        return found.replace("\N{MINUS SIGN}", "-")

    def fraction(self, of: str, as_: str) -> Fraction:
        return Fraction(self.number(of, as_))

    @property
    def remark(self) -> str:
        return self.page.locator(".gd-remark").inner_text().replace("\N{MINUS SIGN}", "-")

    def place(self, x: float, y: float, within: str = ".gd-plane") -> tuple[float, float]:
        """Return the position on the page [px] of a point of the picture's plane."""
        script = """([within, x, y]) => {
          const at = new DOMPoint(x, y).matrixTransform(document.querySelector(within).getScreenCTM());
          return [at.x, at.y];
        }"""
        left, top = self.page.evaluate(script, [within, x, y])
        return float(left), float(top)

    def drag(self, path: list[tuple[float, float]]) -> None:
        """Drag along points of the page."""
        mouse = self.page.mouse
        mouse.move(*path[0])
        mouse.down()
        for point in path[1:]:
            mouse.move(*point)
        mouse.up()

    def drag_round(self, radius: float, turns: float, start: float = 0.0, centre: tuple[float, float] = (0, 0)) -> None:
        """Drag around a point of the plane, from an angle [turns], in steps of less than 1/12 turn."""
        steps = 1 + int(abs(turns) * 24)
        angles = [TURN * (start + turns * n / steps) for n in range(steps + 1)]
        self.drag([self.place(centre[0] + radius * cos(a), centre[1] + radius * sin(a)) for a in angles])

    def choose(self, text: str, among: str) -> None:
        self.page.locator("fieldset", has_text=among).get_by_text(text, exact=True).click()


Opening = Callable[..., Drawn]


@pytest.fixture
def draw(open_window: OpenWindow, tmp_path: Path) -> Opening:
    """Function that opens a diagram as on the site, from disk and without a network."""

    def opened(kind: str, **window: Any) -> Drawn:
        script, style = (path.read_text(encoding="utf-8") for path in diagrams.files().values())
        still = '<img alt="still" src="data:,">'
        text = f"<style>{style}</style>{diagrams.element(kind, still)}<script>{script}</script>"
        (tmp_path / "page.html").write_text(f'<!DOCTYPE html><meta charset="utf-8">{text}', encoding="utf-8")
        page = open_window(**({"viewport": {"width": 700, "height": 1100}, "offline": True} | window))
        drawn = Drawn(page, listen(page, "file:", "data:"))
        drawn.page.goto((tmp_path / "page.html").as_uri())
        drawn.page.wait_for_selector(".gd-alive" if window.get("java_script_enabled", True) else "gear-diagram")
        return drawn

    return opened


# ------------------------------------------------------------------------------------------------------------ of all


def test_every_kind_stands_in_a_page_above_its_still_and_every_page_that_explains_has_one() -> None:
    found = set()
    pages = {path.stem: path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs").glob("*.md"))}
    for page in pages.values():
        for kind, text in re.findall(r"<!-- diagram: (\w+) -->\n!\[(.*?)\]\(images/diagram-\1\.svg\)", page, re.DOTALL):
            assert len(text) > 60
            found.add(kind)
        assert len(re.findall(r"<!-- diagram: ", page)) == len(re.findall(r"\(images/diagram-", page))
    assert found == set(KINDS)
    explaining = ("theory", "torques", "motion", "tutorial", "for-historians", "for-makers", "for-engineers")
    assert all("<!-- diagram: " in pages[name] for name in explaining)


# bounding boxes of the picture and of the text in it
WORDS = """() => {
  const box = (each) => (({left, right, top, bottom}) => [left, right, top, bottom])(each.getBoundingClientRect());
  const all = [...document.querySelectorAll('.gd-text')];
  return [box(document.querySelector('.gd-picture')), all.map((each) => [each.textContent, ...box(each)])];
}"""


@pytest.mark.parametrize("kind", KINDS)
def test_a_diagram_is_its_still_until_scripts_run_and_in_print_and_its_words_do_not_overlap(
    draw: Opening, kind: str
) -> None:
    still = draw(kind, java_script_enabled=False).page.locator("gear-diagram > img")
    assert still.is_visible()
    drawn = draw(kind)
    page, still = drawn.page, drawn.page.locator("gear-diagram > img")
    assert (page.locator(".gd-picture").is_visible(), still.is_visible()) == (True, False)
    for choice in page.locator("input + span").all() or [page.locator(".gd-hint")]:
        choice.click()
        (left, right, top, bottom), words = page.evaluate(WORDS)
        for (text, *a), (other, *b) in combinations(words, 2):
            across, down = min(a[1], b[1]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[2], b[2])
            assert across < 1 or down < 4, f"{text} meets {other}"  # boxes include space above letters
        assert all(left <= a and b <= right and top <= c and d <= bottom for _, a, b, c, d in words)
    page.emulate_media(media="print")
    assert (page.locator(".gd-live").is_visible(), still.is_visible()) == (False, True)
    page.emulate_media(media="screen")
    assert make_diagrams.still(page, kind) == (ROOT / f"docs/images/diagram-{kind}.svg").read_text("utf-8")
    assert drawn.wrong == []


@pytest.mark.parametrize("kind", KINDS)
def test_handles_have_names_and_turn_by_keys_and_are_seen_with_their_numbers(draw: Opening, kind: str) -> None:
    drawn = draw(kind, viewport={"width": 704, "height": 700})  # the width of a page of the site
    sides = """[...document.querySelectorAll('.gd-live, .gd-side, .gd-reading, .gd-remark')].map((each) => {
      const {left, right, top, bottom} = each.getBoundingClientRect();
      return [left, right, top, bottom];
    })"""
    (left, right, top, bottom), *inside = drawn.page.evaluate(sides)
    assert bottom - top < 600
    assert all(left < a and b < right and top < c and d < bottom for a, b, c, d in inside)
    moved = 0
    for handle in drawn.page.locator(".gd-handle:visible").all():
        before = handle.get_attribute("aria-valuetext")
        assert handle.get_attribute("aria-label")
        assert before
        handle.focus()
        handle.press("ArrowRight")
        if handle.get_attribute("aria-valuetext") == before:  # it may be at its maximum
            handle.press("ArrowLeft")
        moved += handle.get_attribute("aria-valuetext") != before
    assert (moved > 0) == (kind in DRAGGED)
    assert drawn.wrong == []


@pytest.mark.parametrize("kind", KINDS)
def test_a_diagram_fits_a_phone_and_leaves_fingers_to_its_handles(draw: Opening, kind: str) -> None:
    drawn = draw(kind, **PHONE)
    assert drawn.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    touch = "[...document.querySelectorAll('.gd-handle')].map((each) => getComputedStyle(each).touchAction)"
    assert set(drawn.page.evaluate(touch)) == ({"none"} if kind in DRAGGED else set())
    heights = "[...document.querySelectorAll('.gd-text')].map((each) => each.getBoundingClientRect().height)"
    assert all(height >= 11 for height in drawn.page.evaluate(heights))


def test_a_finger_drags_on_a_phone(draw: Opening) -> None:
    drawn = draw("willis", **PHONE)
    before = drawn.fraction("ring", ARM)
    path = [drawn.place(32.5 * cos(2 + n / 10), 32.5 * sin(2 + n / 10)) for n in range(9)]
    drawn.choose(ARM, among="Seen")
    finger = drawn.page.context.new_cdp_session(drawn.page)
    for kind, points in (("touchStart", path[:1]), *(("touchMove", [point]) for point in path[1:]), ("touchEnd", [])):
        finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]})
    assert abs(float(drawn.fraction("ring", ARM) - before) - 0.8 / TURN) < 0.01


# --------------------------------------------------------------------------------------------------- Willis' inversion


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


# ----------------------------------------------------------------------------------------------------- the differential


def test_the_crown_of_a_differential_turns_as_the_package_says_of_both_sides(draw: Opening) -> None:
    drawn = draw("differential")
    drawn.drag([drawn.place(14.2, y) for y in (-3, -1, 1, 3)])
    drawn.drag([drawn.place(6.3, y) for y in (3, 0, -3.5)])
    left, right = (drawn.fraction(side, "turns") for side in ("left", "right"))
    assert float(left) == pytest.approx(1 / 8 + 6 / (TURN * 8), abs=0.005), "a wheel of 8 mm, dragged by 6"
    assert float(right) == pytest.approx(-6.5 / (TURN * 8), abs=0.005)
    inputs = f"inputs: {{left: {left}, right: {right}}}\n"
    speeds = geartrain.load(diagram_data.DIFFERENTIAL + inputs).solve().speeds
    assert drawn.fraction("crown", "turns") == speeds["crown"] == (left + right) / 2
    assert drawn.fraction("spider on the crown", "turns") == speeds["spider"] - speeds["crown"]
    assert drawn.wrong == []


# ----------------------------------------------------------------------------------------------------------- circuits


@pytest.mark.parametrize(("name", "title"), diagram_data.GRAPHS.items())
def test_each_gear_pair_lights_up_its_circuit_carrier_and_equation(draw: Opening, name: str, title: str) -> None:
    drawn = draw("circuits")
    drawn.choose(title, among="Train")
    train = geartrain.load(name)
    rows = train.equations(train.declaration.state_or_first(None)).text()
    joined = {frozenset(joint.pair) for joint in train.declaration.revolutes}
    for circuit in train.circuits:
        drawn.page.get_by_role("button", name=f"Gear pair {circuit.id}", exact=True).focus()
        assert re.search(rf"^{re.escape(circuit.id)} +{re.escape(drawn.remark.replace(chr(0x2212), '-'))}$", rows, re.M)
        assert drawn.number("carrier", circuit.id) == circuit.carrier
        assert drawn.fraction("relative ratio", circuit.id) == circuit.ratio
        links = drawn.number("circuit", circuit.id).split(" \N{EN DASH} ")
        assert (links[0], links[-2], links[-1]) == (circuit.i, circuit.j, circuit.i)
        assert all(frozenset(pair) in joined for pair in pairwise(links[:-1]))
        assert circuit.carrier in links
        assert drawn.page.locator(".gd-lit").count() == len(links) - 1
        assert drawn.page.locator(".gd-carrier").get_attribute("data-link") == circuit.carrier
    assert drawn.wrong == []


def test_pointing_at_a_gear_pair_lights_it_up(draw: Opening) -> None:
    drawn = draw("circuits")
    drawn.page.get_by_text("p~ring", exact=True).hover()
    assert drawn.page.locator('[aria-pressed="true"]').get_attribute("aria-label") == "Gear pair p~ring"


# -------------------------------------------------------------------------------------------------------------- teeth


@pytest.mark.parametrize("name", diagram_data.TEETH)
def test_the_speed_ratio_of_teeth_dragged_is_that_of_their_transmission(draw: Opening, name: str) -> None:
    drawn = draw("teeth")
    drawn.choose(diagram_data.TEETH[name], among="Teeth")
    (transmission,) = (mesh.transmission for mesh in geartrain.load("sorge-pairs").meshes if mesh.name == name)
    phases = set()
    for pitches in (0.4, 0.3, 0.23, -1.37):
        before = drawn.fraction("driver, in pitches", "now")
        drawn.drag_round(0.85, -pitches / transmission.sizes.z1)
        passed = drawn.fraction("driver, in pitches", "now")
        assert float(passed - before) == pytest.approx(pitches, abs=0.03)
        angle = float(passed % 1) * transmission.period
        assert float(drawn.number("speed ratio", "now")) == pytest.approx(float(transmission.speed(angle)), abs=1e-6)
        ahead = float(drawn.number("driven ahead by", "now").rstrip("\N{DEGREE SIGN}"))
        assert ahead == pytest.approx(degrees(float(transmission.error(angle))), abs=1e-5)
        x, y = (float(drawn.page.locator(".gd-plane circle").get_attribute(key) or "nan") for key in ("cx", "cy"))
        recess = drawn.remark.startswith("Recess")
        phases.add(recess)
        apex = (
            hypot(x, y) / transmission.sizes.R1
            if recess
            else hypot(transmission.sizes.D - x, y) / transmission.sizes.R2
        )
        assert apex == pytest.approx(1, abs=1e-8), "the apex that touches is on its tip circle"
    assert drawn.fraction("mean ratio", "now") == Fraction(transmission.sizes.z1, transmission.sizes.z2)
    assert name != "5a" or phases == {True, False}


# --------------------------------------------------------------------------------------------------------------- pins


def test_the_slot_is_where_a_triangle_of_pin_and_axes_puts_it(draw: Opening) -> None:
    drawn = draw("pin")
    for turns in (0.21, -0.55, 0.83):
        before = Fraction(drawn.number("pin, in degrees", "now")) / 360
        drawn.drag_round(6, turns)
        pin = Fraction(drawn.number("pin, in degrees", "now")) / 360
        assert float(pin - before) == pytest.approx(turns, abs=0.01)
        x, y = 9.6 * cos(TURN * float(pin)) - 1.1, 9.6 * sin(TURN * float(pin))
        slot = float(drawn.number("slot, in degrees", "now"))
        assert (slot / 360 - atan2(y, x) / TURN + 0.5) % 1 == pytest.approx(0.5, abs=1e-8)
        ahead = float(drawn.number("ahead by", "now"))
        assert ahead == pytest.approx(slot - 360 * float(pin), abs=2e-6)
        assert abs(ahead) <= float(drawn.number("maximum", "now")) == pytest.approx(degrees(asin(1.1 / 9.6)), abs=1e-6)


# ------------------------------------------------------------------------------------------------------------ closure


@pytest.mark.parametrize("sun", [22, 24, 25])
def test_a_planet_dragged_misses_by_what_closure_says(draw: Opening, sun: int) -> None:
    drawn = draw("closure")
    drawn.choose(str(sun), among="Teeth of the sun")
    drawn.choose("3", among="Equally spaced")
    radius, fits = (sun + diagram_data.PLANET) / 2, set()
    drawn.drag_round(radius, 0.09, start=1 / 3)
    for _ in range(4):
        apart = drawn.fraction("planet 2", "at (turn)")
        off = drawn.fraction("planet 2", "off by (pitch)")
        (loop,) = diagram_data.two_planets(sun, apart).closure.loops
        assert isinstance(loop.residue, Fraction)
        assert loop.residue % 1 in (off % 1, -off % 1)
        node = drawn.page.locator('[aria-label="Move the second planet"]')
        assert ("gd-fits" in (node.get_attribute("class") or "")) == (loop.residue % 1 == 0)
        fits.add(off == 0)
        for _ in range(3 if off else 1):
            node.press("ArrowRight")
    drawn.choose("2", among="Equally spaced")
    assert drawn.fraction("planet 2", "off by (pitch)") == 0, "sun and ring are even together"
    assert float(apart) > 0.4
    assert drawn.wrong == []


@pytest.mark.parametrize("number", [2, 3, 4, 5, 6])
def test_planets_equally_spaced_all_fit_where_their_number_divides_sun_and_ring(draw: Opening, number: int) -> None:
    drawn = draw("closure")
    drawn.choose(str(number), among="Equally spaced")
    off = [drawn.fraction(f"planet {n + 1}", "off by (pitch)") for n in range(number)]
    assert all(each == 0 for each in off) == ((24 + 60) % number == 0)
    assert off == [
        ((Fraction(84 * n, number) + Fraction(1, 2)) % 1 or Fraction(1)) - Fraction(1, 2) for n in range(number)
    ]


# -------------------------------------------------------------------------------------------------------- self-locking


def test_what_arrives_is_what_the_balance_of_torques_gives_and_the_set_locks_where_theory_says(draw: Opening) -> None:
    drawn = draw("locking")
    declared = diagram_data.block("torques.md", "near.yaml")
    at = drawn.fraction("each mesh", "efficiency")
    seen = set()
    for wanted in (Fraction("0.97"), Fraction("0.984"), Fraction("0.9905"), Fraction("0.92")):
        path = [46 + 410 * (float(each) - 0.9) / 0.1 for each in (at, wanted)]
        drawn.drag([drawn.place(x, 250, ".gd-picture") for x in path])
        at = drawn.fraction("each mesh", "efficiency")
        assert abs(at - wanted) <= Fraction(1, 1000)
        gears = [{**gear, "efficiency": float(at)} for gear in declared["gears"]]
        for way, load in (("sun drives arm", -1), ("arm drives sun", 1)):
            found = geartrain.GearTrain.declare({**declared, "gears": gears, "loads": {"arm": load}}).torques()
            shown = drawn.number(way, "efficiency")
            locks = way == "sun drives arm" and at**2 <= Fraction(30 * 30, 29 * 32)  # (9): i0 <= 1/e
            assert (shown == "locks") == locks == (found.verdict.kind == "self-locking")
            assert locks or float(shown) == pytest.approx(float(found.efficiency), abs=1e-6)
            seen.add(locks)
    assert seen == {True, False}
    assert drawn.wrong == []
