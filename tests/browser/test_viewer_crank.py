"""The crank of the viewer in a browser: typed, stepped, dragged, played."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
import shipped
from viewing import ANTIKYTHERA, MOVING, PLAN, SIMPLE, Opening, tab, turns, wait


def test_a_number_of_turns_is_typed_exactly_and_nonsense_is_refused(show: Opening) -> None:
    shown = show(SIMPLE, **PLAN)
    place = shown.page.get_by_label("Go to turn")
    for text, value in (("235/19", Fraction(235, 19)), ("1e6", Fraction(10**6)), ("-2.5", Fraction(-5, 2))):
        place.fill(text)
        place.press("Enter")
        assert turns(shown) == value
        assert shown.page.get_by_role("alert").is_hidden()
    for text in ("twelve", "1/0", "", "1e999999999", "<b>1</b>"):
        place.fill(text)
        place.press("Enter")
        assert turns(shown) == Fraction(-5, 2), text
        assert "not a number of turns" in shown.page.get_by_role("alert").inner_text()
        assert place.get_attribute("aria-invalid") == "true"


def test_a_step_is_one_unit_of_the_input(show: Opening) -> None:
    shown = show("clock-10000-years", **PLAN)
    step = Fraction(shipped.built("clock-10000-years").step)
    shown.page.get_by_label("one unit of the input forward").click(click_count=3)
    assert turns(shown) == 3 * step
    shown.page.get_by_label("one unit of the input back").click()
    assert turns(shown) == 2 * step


def test_play_turns_and_pause_holds_and_tells_the_pointers(show: Opening) -> None:
    shown = show(ANTIKYTHERA, **MOVING, **PLAN)
    shown.page.get_by_role("button", name="play", exact=True).click()
    wait(shown, "!String(geartrain.turns).startsWith('0')")
    shown.page.get_by_role("button", name="pause", exact=True).click()
    held = turns(shown)
    wait(
        shown,
        "/turns; sun .*°, [A-Z][a-z]+, degree [0-9]+.*moon/.test(document.querySelector('[role=status]').textContent)",
    )
    assert turns(shown) == held > 0


def test_reduced_motion_moves_by_jumps_of_a_second(show: Opening) -> None:
    shown = show(SIMPLE, **PLAN)
    moves = shown.run(
        """async () => {
          const at = []; const began = performance.now(); let before = String(geartrain.turns);
          document.querySelector('.round').click();
          while (performance.now() - began < 2600) {
            await new Promise(requestAnimationFrame);
            const now = String(geartrain.turns);
            if (now !== before) at.push(performance.now() - began);
            before = now;
          }
          document.querySelector('.round').click();
          return at; }"""
    )
    assert 1 <= len(moves) <= 2
    assert moves[0] >= 950


def test_what_is_shown_after_a_drag_is_what_the_package_says_of_these_turns(show: Opening) -> None:
    for name in (SIMPLE, "worm", "longcase-clock"):
        shown = show(name, **PLAN)
        box = shown.page.get_by_role("slider", name="crank").bounding_box()
        x, y, reach = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, 0.36 * box["width"]
        shown.page.mouse.move(x, y - reach)
        shown.page.mouse.down()
        for step in range(1, 18):  # slightly more than a turn
            angle = 0.4 * step
            shown.page.mouse.move(x + reach * math.sin(angle), y - reach * math.cos(angle))
        shown.page.mouse.up()
        made = turns(shown)
        shown.page.mouse.move(x - reach, y)
        assert turns(shown) == made, "the hand has let go"
        assert float(made) == pytest.approx(0.4 * 17 / (2 * math.pi) / gearing(name), rel=1e-2)
        told = shown.page.locator(".turns").inner_text().split(" = ")[0].replace("\u202f", "").replace("\u2212", "-")
        assert float(told) == pytest.approx(float(made), abs=5.1e-5)
        tab(shown, "Readings")
        pointers = {pointer.output: pointer for pointer in shipped.scene(name).pointers}
        lead = next(iter(shipped.train(name).declaration.case(None).inputs.values()))
        for output, result in shipped.train(name).solve().outputs.items():
            text = shown.page.locator(f"[data-angle='{output}']").text_content().partition("\u00b0")[0]
            turned = pointers[output].sense * Fraction(result.speed) / lead * made % 1 * 360
            assert (float(text) - float(turned) + 180) % 360 - 180 == pytest.approx(0, abs=0.0051), (name, output)


def gearing(name: str) -> float:
    """Return turns of the hand per turn of the driving link: those of the declared crank if a hand can turn it."""
    scene = shipped.scene(name)
    speed = 1.0 if scene.crank is None else abs(float(Fraction(scene.bodies[scene.crank].speed or 1)))
    return speed if 0.05 <= speed <= 20 else 1.0


@pytest.mark.parametrize("name", ["carman-thorndike-evans-2012", "al-biruni-box-of-the-moon"])
def test_a_crank_does_not_stand_before_a_dial_about_its_axis(show: Opening, name: str) -> None:
    """It would hide the hands, or pass through them."""
    before = show(name).run("""() => {
      const [{world}] = geartrain.stages, [scene] = geartrain.scenes, {point} = scene.bodies[scene.crank];
      const coaxial = scene.dials.filter(({centre}) => Math.hypot(centre[0] - point[0], centre[1] - point[1]) < 1e-6);
      return coaxial.map(({centre, normal}) => Math.sign((world.crank.end.z - centre[2]) * normal[2]));
    }""")
    assert before == [-1]
