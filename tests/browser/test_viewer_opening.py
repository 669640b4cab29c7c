"""Opening of the viewer: motion, purpose, names of parts, and tours."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any

import pytest
import shipped
from conftest import Shown
from viewing import ANTIKYTHERA, LOCKED, MOVING, PLAN, SIMPLE, Opening, tab, turns, wait

from geartrain import load
from geartrain.errors import DeclarationError
from geartrain.scene import build_scene
from geartrain.viewer import page

TOURS = (
    "freeth-2021",
    "freeth-2008",
    "pennestri-2002",
    "huygens-planetarium-1682",
    "south-pointing-chariot",
    "longcase-clock",
    "planetary-24-18-60",
)


def exact_turns(shown: Shown, train: str) -> dict[str, float]:
    """Return the part of a turn that each output of a train without teeth or pins has made, from exact speeds."""
    solved = shipped.train(train).solve()
    made = turns(shown)
    return {output: float(Fraction(each.speed or 0) * made % 1) for output, each in solved.outputs.items()}


def test_a_page_opens_in_motion(show: Opening) -> None:
    shown = show(SIMPLE, opening=True, **MOVING)
    first = turns(shown)
    wait(shown, f"String(geartrain.turns) !== '{first}'")
    shown.page.get_by_role("button", name="pause", exact=True).click()
    assert shown.errors == shown.requests == []


@pytest.mark.parametrize("name", ["huygens-planetarium-1682", "prague-orloj", SIMPLE])
def test_a_page_opens_with_its_pointers_apart_and_at_rest_for_users_who_prefer_it(show: Opening, name: str) -> None:
    shown = show(name, opening=True, **PLAN)
    first = turns(shown)
    shown.page.wait_for_timeout(300)
    assert turns(shown) == first != 0
    assert shown.page.get_by_role("button", name="play", exact=True).is_visible()
    dials = {output: each.dial for output, each in shipped.train(name).declaration.outputs.items()}
    made = exact_turns(shown, name)
    for dial in {each for each in dials.values() if each is not None} or {None}:
        places = sorted({0.0, 1.0, *(part for output, part in made.items() if dials[output] == dial)})
        assert min(after - before for before, after in pairwise(places)) > 0.02, dial


def test_a_script_that_sets_the_turns_ends_the_opening_motion(show: Opening) -> None:
    shown = show(SIMPLE, **MOVING)
    shown.page.wait_for_timeout(400)
    assert turns(shown) == 0


def test_the_second_line_is_the_purpose_and_only_an_unusual_verdict_is_shown(show: Opening) -> None:
    shown = show(SIMPLE, **PLAN)
    note = str(shipped.train(SIMPLE).declaration.note)
    assert shown.page.locator(".names").inner_text() == note
    assert "determined" not in shown.page.locator(".head").inner_text()
    tab(shown, "About")
    assert "determined: every speed follows from sun" in shown.page.locator("article").inner_text()
    assert show("worm", **PLAN).page.locator(".names").inner_text() == "screw drives wheel."
    assert "locked" in show(text=LOCKED, **PLAN).page.locator(".head").inner_text()


def test_one_list_has_each_output_once_and_dials_come_first(show: Opening) -> None:
    shown = show(ANTIKYTHERA, **PLAN)
    tabs = shown.page.get_by_role("tab").all_inner_texts()
    assert tabs[0] == "Readings"
    assert not {"Dials", "Outputs", "Sky"} & set(tabs)
    listed = shown.run("[...document.querySelectorAll('.outputs tr[data-output]')].map((row) => row.dataset.output)")
    outputs = shipped.train(ANTIKYTHERA).declaration.outputs
    read = [name for name, output in outputs.items() if output.dial]
    assert sorted(listed) == sorted(outputs)
    assert sorted(listed[: len(read)]) == sorted(read)
    assert shown.page.locator("tr[data-output='lunar anomaly']").is_hidden(), "outputs without a dial are folded"
    assert show("worm", **PLAN).page.locator(".dial").count() == 0


@pytest.mark.parametrize("name", ["prague-orloj", "huygens-planetarium-1682"])
def test_readings_are_exact_turns(show: Opening, name: str) -> None:
    shown = show(name, **PLAN)
    shown.run("geartrain.setTurns('1234567/89')")
    wait(shown, "document.querySelector('[data-angle]').textContent !== ''")
    cells = "[...document.querySelectorAll('[data-angle]')].map((cell) => [cell.dataset.angle, cell.textContent])"
    texts = dict(shown.run(cells))
    scene = shipped.scene(name)
    way = {each.output: 1 if each.dial is None else scene.dials[each.dial].scale.way for each in scene.pointers}
    sense = {each.output: each.sense * way[each.output] for each in scene.pointers}
    for output, part in exact_turns(shown, name).items():
        read = float(texts[output].partition("\u00b0")[0])
        assert (read - sense[output] * 360 * part + 180) % 360 - 180 == pytest.approx(0, abs=0.0051), output


# ---------------------------------------------------------------------------------------------------------------- names

BOXES = """[...document.querySelectorAll('.callouts g:not([hidden]) text')].map((text) => {
  const {left, right, top, bottom} = text.getBoundingClientRect();
  return [text.textContent, left, right, top, bottom];
})"""


@pytest.mark.parametrize("name", ["freeth-2021", "clock-10000-years"])
def test_names_do_not_overlap_and_can_be_switched_off(show: Opening, name: str) -> None:
    shown = show(name, viewport={"width": 1280, "height": 800})
    wait(shown, f"({BOXES}).length > 5")
    boxes = shown.run(BOXES)
    for at, (one, left, right, top, bottom) in enumerate(boxes):
        assert left >= 0, one
        for other, left2, right2, top2, bottom2 in boxes[:at]:
            apart = right <= left2 or right2 <= left or bottom <= top2 + 1 or bottom2 <= top + 1
            assert apart, (one, other)
    shown.page.get_by_label("Names").uncheck()
    assert shown.page.locator(".callouts").is_hidden()


TIP = """(name) => {
  const [stage] = geartrain.stages, label = [...document.querySelectorAll('.callouts g')]
    .find((group) => group.textContent === name);
  return label.querySelector('path').getAttribute('d').split('L')[1].split(' ').map(Number);
}"""


def test_a_line_ends_at_the_part_of_its_name(show: Opening) -> None:
    """From the front, the end of the Sun's line turns as the Sun's pointer does."""
    shown = show(ANTIKYTHERA, viewport={"width": 1280, "height": 800})
    shown.run("geartrain.stages[0].look('front')")
    ends = []
    for made in ("1/8", "3/8", "5/8", "7/8"):
        shown.run("(t) => { geartrain.setTurns(t); geartrain.stages[0].render(); }", made)
        ends.append(complex(*shown.run(TIP, "sun")))
    middle = sum(ends) / 4
    for before, after in pairwise(ends):  # clockwise by a quarter of a turn, y downwards
        assert abs((after - middle) / (before - middle) - 1j) < 0.02


# ----------------------------------------------------------------------------------------------------------------- tour


def test_a_tour_names_parts_of_its_train() -> None:
    for name in TOURS:
        tour = shipped.train(name).declaration.tour
        assert len(tour) == 5, name
        assert [each.name for each in shipped.scene(name).tour] == [each.look_at for each in tour]
    text = f"extends: {SIMPLE}\ntour: [{{look_at: suns, text: none}}]\n"
    with pytest.raises(DeclarationError, match=r"(?s)no output, link, wheel, dial or coupling 'suns'.*'sun'"):
        load(text)
    child = load(f"extends: {SIMPLE}\n")
    assert child.declaration.tour == (), "a tour is not inherited"


SEEN = """(name) => {
  const [stage] = geartrain.stages, [scene] = geartrain.scenes;
  const wheel = scene.wheels.find(({id}) => id === name);
  stage.camera.updateMatrixWorld();
  const centre = new stage.camera.position.constructor(...wheel.centre);
  return stage.world.placed(centre, wheel.body).project(stage.camera).toArray();
}"""


def test_steps_move_the_camera_to_their_parts(show: Opening) -> None:
    shown = show(SIMPLE)
    steps: Any = shipped.train(SIMPLE).declaration.tour
    shown.page.get_by_role("button", name="Tour").click()
    text, back = shown.page.locator(".tour p"), shown.page.locator(".tour").get_by_role("button", name="Back")
    whole = shown.run("geartrain.stages[0].controls.getDistance()")
    assert text.inner_text() == f"1/5 {steps[0].text}"
    x, y, _ = shown.run(SEEN, "s")
    assert max(abs(x), abs(y)) < 0.15, "the sun is in the middle of the picture"
    assert shown.run("[...geartrain.stages[0].world.looks.chosen.wheels]") == [1]
    shown.page.get_by_role("button", name="Next").click()
    assert text.inner_text() == f"2/5 {steps[1].text}"
    assert shown.run("geartrain.stages[0].controls.getDistance()") > 1.3 * whole, "the ring is larger"
    back.click()
    assert text.inner_text() == f"1/5 {steps[0].text}"
    assert back.is_disabled()
    shown.page.get_by_role("button", name="End").click()
    assert shown.page.locator(".tour p").is_hidden()
    assert shown.run("geartrain.stages[0].world.looks.chosen") is None
    assert shown.errors == shown.requests == []


def test_a_part_behind_the_front_is_seen_from_behind(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    shown.page.get_by_role("button", name="Tour").click()
    shown.page.get_by_role("button", name="Next").click(click_count=2)
    assert "slot of wheel k2" in shown.page.locator(".tour p").inner_text()
    assert shown.run("geartrain.stages[0].camera.position.z * geartrain.scenes[0].front") < 0


@pytest.mark.parametrize("name", [ANTIKYTHERA, "freeth-2021-teeth"])
def test_the_largest_pages_are_below_1_1_megabytes(name: str) -> None:
    scene = build_scene(shipped.train(name), formulas=True)
    assert len(page([scene]).encode()) < 1.1e6
