"""Counts changed on a page in a browser, compared with the package's answer for the train with these counts."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
import shipped
from test_viewer_themes import TEXTS
from viewing import DESK, PLAN, contrast, go, tab, wait

from geartrain import GearTrain, load
from geartrain.scene import make_scene
from geartrain.viewer import page

if TYPE_CHECKING:
    from conftest import OpenPage, Shown

    from geartrain import Answer

# two pairs between two arbors, which form a loop
LOOP = """
name: loop
frame: frame
links: {frame: {}, a: {wheels: {a1: 20, a2: 30}}, b: {wheels: {b1: 40, b2: 60}}, c: {wheels: {c1: 25}}}
revolutes: {A: [frame, a], B: [frame, b], C: [frame, c]}
gears: [a1 ~ b1, a2 ~ b2, b1 ~ c1]
inputs: {a: 1}
outputs: {b: {}, c: {}}
"""

# the speed of the arm has a pole at t1 = s1, where both suns have the same ratio to the planet
POLE = """
name: pole
frame: frame
links: {frame: {}, s: {wheels: {s1: 30}}, t: {wheels: {t1: 31}}, p: {wheels: {p1: 20, p2: 20}}, arm: {}}
revolutes: {M: [frame, s, t, arm], P: [arm, p]}
gears: [s1 ~ p1, t1 ~ p2]
inputs: {s: 0, t: 1}
outputs: {arm: {}}
"""

SPEEDS = """(scene) => Object.fromEntries(geartrain.scenes[scene].bodies.map(({ id, shown }) => [id, shown]))"""
ROWS = """Object.fromEntries([...document.querySelectorAll('.outputs tr[data-output]')].map((row) =>
  [row.dataset.output, (row.querySelector('.copy') ?? row.querySelector('.quiet')).textContent]))"""


@pytest.fixture
def opened(show_html: OpenPage) -> Any:
    """Function that opens the page of a train in all its states, on which counts can be changed."""

    def show(train: GearTrain, **window: Any) -> Shown:
        scenes = [make_scene(train, state, formulas=True) for state in train.states or (None,)]
        return show_html(page(scenes, teeth=False), **(PLAN | window))

    return show


def give(shown: Shown, wheel: str, count: int) -> None:
    """Type another count of a wheel into the field of its panel."""
    tab(shown, "Wheels")
    shown.page.locator(f"button[data-wheel='{wheel}']").click()
    field = shown.page.get_by_label(f"teeth of {wheel}", exact=True)
    field.fill(str(count))
    field.press("Enter")
    shown.page.get_by_role("button", name="Close", exact=True).click()


def told(text: str) -> str:
    return text.replace("\u2212", "-")


def expected(answer: Answer) -> dict[str, str | None]:
    return {name: None if each.speed is None else str(each.speed) for name, each in answer.outputs.items()}


def agree(shown: Shown, scene: int, answer: Answer) -> None:
    """Assert that all outputs in the table and all links of the scene have the speeds of an answer of the package."""
    tab(shown, "Readings")
    rows = {name: told(text) for name, text in shown.run(ROWS).items()}
    assert rows == {name: speed or "not determined" for name, speed in expected(answer).items()}
    speeds = shown.run(SPEEDS, scene)
    assert {link: speed for link, speed in speeds.items() if link in answer.speeds} == {
        link: None if speed is None else str(speed) for link, speed in answer.speeds.items() if link in speeds
    }


def drawn(seed: int, train: GearTrain, times: int) -> Iterator[Mapping[str, int]]:
    """Yield counts near the declared ones, for one wheel, then for more."""
    draw = random.Random(seed)
    counts = {name: wheel.count for name, (_, wheel) in train.declaration.wheels.items() if wheel.count}
    for number in range(1, times + 1):
        chosen = draw.sample(sorted(counts), min(number, len(counts)))
        yield {name: max(1, counts[name] + draw.choice([-2, -1, 1, 2, 7])) for name in chosen}


@pytest.mark.parametrize(
    "name",
    ["freeth-2008", "planetary-24-18-60", "humpage", "bevel-differential", "zf-8hp70", "prius-power-split", "worm"],
)
def test_all_speeds_are_those_of_the_train_with_these_counts(opened: Any, name: str) -> None:
    train = shipped.train(name)
    shown = opened(train)
    states = train.states or (None,)
    for counts in drawn(1, train, 3):
        for wheel, count in counts.items():
            give(shown, wheel, count)
        changed = train.with_teeth(counts)
        for state in dict.fromkeys((states[0], states[-1])):
            at = states.index(state)
            if len(states) > 1:
                shown.page.get_by_label("State").select_option(index=at)
            agree(shown, at, changed.solve(state, method="exact"))
        assert shown.page.locator(".changed").count() == 1
        tab(shown, "Change")
        shown.page.get_by_role("button", name="All as declared").click()
        agree(shown, states.index(states[-1]), train.solve(states[-1], method="exact"))
    assert shown.page.locator(".changed").count() == 0


def test_a_step_is_one_tooth_and_pointers_follow(opened: Any) -> None:
    train = shipped.train("planetary-24-18-60")
    shown = opened(train)
    tab(shown, "Wheels")
    more = shown.page.get_by_role("button", name="one tooth more on s", exact=True)
    more.click()
    more.click()
    shown.page.get_by_role("button", name="one tooth less on p", exact=True).click()
    assert shown.run("document.activeElement.getAttribute('aria-label')") == "one tooth less on p"
    changed = train.with_teeth(s=26, p=17)
    at = Fraction(100_003, 7)
    go(shown, at)
    for output, result in changed.solve().outputs.items():
        angle = shown.run("(name) => geartrain.pointer(0, name).angle / (2 * Math.PI)", output)
        off = angle - float(Fraction(result.speed) * at % 1)
        assert off - round(off) == pytest.approx(0, abs=1e-9), output
    tab(shown, "Change")
    changes = shown.page.locator(".change").inner_text()
    assert "s: 24 \u2192 26 teeth" in changes
    # axis distances are (24 + 18)/2 and (60 - 18)/2 modules; these counts require (26 + 17)/2 and (60 - 17)/2
    assert "s~p: needs axes 1/2 of a module further apart" in changes
    assert "p~ring: needs axes 1/2 of a module further apart" in changes
    give(shown, "s", 24)
    give(shown, "p", 18)
    assert shown.page.locator(".changed").count() == 0
    for text in ("0", "-3", "2.5", "many", "9999999999999"):
        tab(shown, "Wheels")
        shown.page.locator("button[data-wheel='s']").click()
        field = shown.page.get_by_label("teeth of s", exact=True)
        field.fill(text)
        field.press("Enter")
        assert field.input_value() == "24", text


def test_meshes_tell_by_how_much_they_miss_their_axes(opened: Any) -> None:
    shown = opened(load(LOOP))
    for counts, said in (
        ({"a1": 22, "b1": 38}, ["b1~c1: needs axes 1 module closer together"]),
        ({"c1": 28}, ["b1~c1: needs axes 3/2 of a module further apart"]),
        ({"b1": 39, "c1": 26}, ["a1~b1: needs axes 1/2 of a module closer together"]),
    ):
        for wheel, count in counts.items():
            give(shown, wheel, count)
        tab(shown, "Change")
        texts = shown.page.locator(".misfits li").all_inner_texts()
        assert [text.partition(" (")[0] for text in texts] == said
        size = {wheel.id: wheel.module for wheel in make_scene(load(LOOP)).wheels}["b1"]
        modules = float(Fraction(said[0].split("axes ")[1].split(" ")[0]))
        millimetres = float(texts[0].split("(")[1].split(" mm")[0])
        assert millimetres == pytest.approx(modules * size, rel=5e-3)
        shown.page.get_by_role("button", name="All as declared").click()
    give(shown, "a1", 22)
    give(shown, "b1", 38)
    give(shown, "c1", 27)
    tab(shown, "Change")
    assert "All meshes still fit their axes" in shown.page.locator(".change").inner_text()


def test_meshes_of_other_axes_are_judged_by_what_they_have(opened: Any) -> None:
    for name, wheel, more, said in (
        ("worm", "w60", 2, "needs axes 1 module further apart"),
        ("worm", "w2", 1, None),  # an additional start does not change the diameter of a worm
        ("bevel-differential", "pinion", 1, "its axes intersect, so its wheels must be redesigned and repositioned"),
        ("crossed-helical", "w20", 1, " mm further apart (as drawn)"),
    ):
        train = shipped.train(name)
        shown = opened(train)
        give(shown, wheel, (train.declaration.wheels[wheel][1].count or 0) + more)
        tab(shown, "Change")
        texts = shown.page.locator(".change").inner_text()
        assert (said or "All meshes still fit their axes") in texts, name
        shown.page.get_by_role("button", name="All as declared").click()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_what_is_changed_can_be_read(opened: Any, scheme: str) -> None:
    shown = opened(shipped.train("planetary-24-18-60"), before="")
    shown.page.get_by_label("theme").select_option(scheme)
    give(shown, "s", 26)
    for name in ("Change", "Wheels"):
        tab(shown, name)
        for where, ink, ground, minimum in shown.run(TEXTS):
            assert contrast(ink, ground) >= minimum, (where, ink, ground)


def test_a_loop_that_no_longer_closes_locks_the_train(opened: Any) -> None:
    train = load(LOOP)
    shown = opened(train)
    give(shown, "a1", 21)
    answer = train.with_teeth(a1=21).solve()
    assert answer.verdict.kind == "locked"
    verdict = shown.page.locator(".verdict")
    assert verdict.get_attribute("data-verdict") == "locked"
    assert "loop a - b no longer closes: its wheels lock each other" in verdict.inner_text()
    tab(shown, "Readings")
    assert set(shown.run(ROWS).values()) == {"not determined"}
    assert shown.page.get_by_role("button", name="play", exact=True).is_disabled()
    give(shown, "b1", 42)  # the loop closes again
    assert shown.page.get_by_role("button", name="play", exact=True).is_enabled()
    agree(shown, 0, train.with_teeth(a1=21, b1=42).solve())


def test_counts_at_which_nothing_is_determined_are_told(opened: Any) -> None:
    train = load(POLE)
    shown = opened(train)
    agree(shown, 0, train.solve())
    give(shown, "t1", 30)
    answer = train.with_teeth(t1=30).solve()
    assert answer.verdict.kind != "determined"
    tab(shown, "Readings")
    assert shown.run(ROWS) == {"arm": "not determined"}
    assert shown.page.locator(".verdict").get_attribute("data-verdict") == "not determined"
    assert "locked or free" in shown.page.locator(".verdict").inner_text()


def test_where_there_is_no_webgl_the_plan_has_the_new_count(open_page: OpenPage, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    path.write_text(page([make_scene(shipped.train("planetary-24-18-60"), formulas=True)]), encoding="utf-8")
    shown = open_page(path, **PLAN, **DESK)
    length = "document.querySelector('.plan [data-wheel=s] .spoke').getTotalLength()"
    before = shown.run(length)
    give(shown, "s", 30)
    wait(shown, f"Math.abs({length} / {before} - 1) > 0.1")
    assert shown.run(length) / before == pytest.approx(30 / 24, rel=1e-3)


@pytest.mark.parametrize("name", ["freeth-2021", "nrel-grc-750"])
def test_what_is_saved_loads_and_solves_to_the_same(opened: Any, tmp_path: Path, name: str) -> None:
    train = shipped.train(name)
    shown = opened(train)
    counts = next(iter(drawn(2, train, 5)))
    counts = {**counts, **dict(list(drawn(3, train, 4))[-1])}
    for wheel, count in counts.items():
        give(shown, wheel, count)
    tab(shown, "Change")
    with shown.page.expect_download() as download:
        shown.page.get_by_role("button", name="Save YAML").click()
    assert download.value.suggested_filename == f"{name}-changed.yaml"
    path = tmp_path / "changed.yaml"
    download.value.save_as(path)
    saved = load(str(path))
    assert saved.declaration.name == f"{name}-changed"
    assert {wheel: saved.declaration.wheels[wheel][1].count for wheel in counts} == counts
    agree(shown, 0, saved.solve(method="exact"))


def test_the_picture_has_the_new_teeth_which_meet_gaps(opened: Any) -> None:
    shown = opened(shipped.train("planetary-24-18-60"), before="")
    give(shown, "s", 26)
    wait(shown, "geartrain.stages[0].world.wheels.find(({ wheel }) => wheel.id === 's').wheel.teeth === 26")
    before, after = (
        {wheel["id"]: wheel for wheel in wheels}
        for wheels in (
            make_scene(shipped.train("planetary-24-18-60")).to_dict()["wheels"],
            shown.run("geartrain.scenes[0].wheels"),
        )
    )
    assert after["s"]["radius"] == pytest.approx(before["s"]["radius"] * 26 / 24)
    assert after["s"]["tip"] - after["s"]["radius"] == pytest.approx(before["s"]["tip"] - before["s"]["radius"])
    for one, other in (("s", "p"), ("p", "ring")):
        wheel, mate = after[one], after[other]
        inside = other == "ring"
        # distance of a tooth of each wheel past the pitch point [pitches]; all centres are on the x axis
        own = tooth_at(wheel, 0.0)
        theirs = tooth_at(mate, 0.0 if inside else math.pi)
        off = (own - theirs if inside else own + theirs) - 0.5  # half a pitch apart: a tooth is in a space
        assert off - round(off) == pytest.approx(0, abs=1e-6), (one, other)
    assert shown.errors == []


def tooth_at(wheel: Mapping[str, Any], angle: float) -> float:
    """Return the distance of the first tooth of a wheel past an angle about z [rad], in pitches."""
    x, y, _ = wheel["reference"]
    return (math.atan2(y, x) + wheel["turn"] - angle) * float(wheel["teeth"]) / (2 * math.pi)
