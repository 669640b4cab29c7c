"""Texts of the viewer about trains: states, comparison of two trains, verdicts, and safe HTML."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import pytest
import shipped
from commands import call
from viewing import ANTIKYTHERA, LOCKED, PLAN, SIMPLE, Opening, go, rgb, tab, turns, wait

from geartrain import load

if TYPE_CHECKING:
    from playwright.sync_api import Dialog

EVIL = """
name: <script>alert(1)</script>
title: </script><img src=x onerror="alert(2)">
note: <b>bold</b> {{note}}
sources: {"<i>": {cite: "<svg onload=alert(3)>", url: "javascript:alert(4)"}}
frame: frame
links:
  frame: {}
  "<a>": {wheels: {"<w>": {teeth: 20, source: "<i>"}}}
  b: {wheels: {"</script>": 30}}
revolutes: [{pair: [frame, "<a>"], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: ["<w>", "</script>"]}]
inputs: {"<a>": 1}
outputs: {"b": {note: "<script>alert(5)</script>"}}
"""


def test_links_lead_only_to_the_web(show: Opening) -> None:
    shown = show(text=LOCKED, **PLAN)
    tab(shown, "About")
    links = shown.run("[...document.querySelectorAll('.page a')].map((each) => each.href)")
    assert links == ["https://example.org/a"]
    assert "javascript:alert(1)" in shown.page.locator(".sources").inner_text()


SVG = "{http://www.w3.org/2000/svg}"


def test_without_webgl_a_plan_turns_in_place_of_the_picture(show: Opening) -> None:
    shown = show(SIMPLE, **PLAN)
    assert "has no 3D graphics" in shown.page.locator(".nothing").inner_text()
    places = """Object.fromEntries([...document.querySelectorAll('.plan .wheel')].map((wheel) => {
      const [x, y] = /M([^L]+)L/.exec(wheel.querySelector('.spoke').getAttribute('d'))[1].split(' ').map(Number);
      const [u, v] = wheel.querySelector('.spoke').getAttribute('d').split('L')[1].split(' ').map(Number);
      return [wheel.dataset.wheel, [x, -y, Math.atan2(y - v, u - x)]]; }))"""
    before = shown.run(places)
    go(shown, "1/7")
    wait(shown, f"Math.abs(({places}).s[2] - {before['s'][2]}) > 0.1")  # drawn in the next frame
    after = shown.run(places)
    solved = shipped.train(SIMPLE).solve()
    speeds = {"s": solved.speeds["sun"], "p": solved.speeds["planet"], "ring": 0}
    for wheel, speed in speeds.items():
        turned = (after[wheel][2] - before[wheel][2]) / (2 * math.pi) - float(Fraction(speed) / 7)
        assert turned - round(turned) == pytest.approx(0, abs=1e-4), wheel
    reach = math.hypot(before["p"][0] - before["s"][0], before["p"][1] - before["s"][1])
    borne = math.atan2(before["p"][1], before["p"][0]) + 2 * math.pi * 2 / 7 / 7  # 2/7 of the sun
    assert after["p"][:2] == pytest.approx([reach * math.cos(borne), reach * math.sin(borne)], abs=1e-2)
    shown.page.locator(".plan [data-wheel='p'] .disc").click()
    assert "Wheel p" in shown.page.locator(".detail").inner_text()
    shown.page.get_by_label("Colours").select_option("speed")
    assert len(set(shown.run("[...document.querySelectorAll('.plan .disc')].map((d) => d.getAttribute('fill'))"))) == 3
    tab(shown, "Readings")
    shown.page.locator("tr[data-output='carrier'] th button").click()
    assert shown.page.locator("[data-angle='carrier']").inner_text() == f"{360 - 360 * 2 / 49:.2f}\u00b0"
    shown.page.keyboard.press("e")
    assert [error for error in shown.errors if "three dimensions" not in error and "WebGL context" not in error] == []


def test_without_webgl_the_plan_is_saved_as_a_drawing_that_needs_no_style_sheet(show: Opening, tmp_path: Path) -> None:
    shown = show(SIMPLE, **PLAN)
    with shown.page.expect_download() as download:
        shown.page.get_by_role("button", name="Save picture").click()
    assert download.value.suggested_filename == f"{SIMPLE}.svg"
    download.value.save_as(tmp_path / "saved.svg")
    sheet = ElementTree.parse(tmp_path / "saved.svg").getroot()
    assert sheet.tag == f"{SVG}svg"
    discs = {
        node.get("data-wheel"): node.find(f"{SVG}path") for node in sheet.iter(f"{SVG}g") if node.get("data-wheel")
    }
    assert set(discs) == {"s", "p", "ring"}
    for name, disc in discs.items():
        style = shown.run(
            "(name) => getComputedStyle(document.querySelector(`.plan [data-wheel='${name}'] .disc`)).fill", name
        )
        assert f"fill: {style}" in disc.get("style", ""), name
        assert "fill-opacity: 0.55" in disc.get("style", ""), "which a style sheet says on the page"


def test_a_train_that_asks_for_nothing_opens_on_its_links(show: Opening, tmp_path: Path) -> None:
    path = tmp_path / "sphere.yaml"
    done = call("sphere", "cuboctahedron", "--teeth", "4=20,3=13", "-o", path)
    assert done.exit_code in (0, 1)  # 1 if the teeth do not mesh, which the page does not require
    train = load(str(path))
    assert not train.declaration.outputs
    shown = show(text=path.read_text(encoding="utf-8"))
    panel = shown.page.get_by_role("tabpanel", name="Readings")
    assert "declares no outputs; its links are listed" in panel.inner_text()
    assert panel.locator(".dial").count() == 0
    rows = "[...document.querySelectorAll('.outputs tr[data-output]')]"
    told = shown.run(f"{rows}.map((row) => [row.dataset.output, row.querySelector('.copy').textContent])")
    solved = train.solve()
    assert {link: text.replace("\u2212", "-") for link, text in told} == {
        link: str(speed) for link, speed in solved.speeds.items() if link != "frame"
    }
    assert set(solved.speeds.values()) == {0, 1, Fraction(-20, 13)}
    shown.page.locator("tr .plain").last.click()
    assert shown.page.locator(".path [data-pair]").count() > 0


def test_states_are_chosen_and_stand_beside_each_other(show: Opening) -> None:
    shown = show("planetary")
    names = list(shipped.train("planetary").declaration.states)
    assert shown.page.locator(".view:visible").count() == 1
    shown.page.get_by_label("State").select_option(label=names[1])
    assert shown.page.locator("figcaption .caption").nth(1).text_content() == names[1]
    assert shown.page.locator(".view").nth(1).is_visible()
    shown.page.get_by_label("Beside").select_option(label=names[0])
    assert shown.page.locator(".view:visible").count() == 2
    assert shown.errors == []


def test_two_trains_turn_in_step_and_their_difference_is_exact(show: Opening) -> None:
    shown = show("price-1974", ANTIKYTHERA, compare=True, **PLAN)
    solved = [shipped.train(name).solve() for name in ("price-1974", ANTIKYTHERA)]
    tab(shown, "Readings")
    shown.page.get_by_label("one unit of the input forward").click(click_count=2)
    assert turns(shown) == 2
    assert shown.run("geartrain.machines.map(({turns}) => String(turns))") == ["2", "2"]
    both = set(solved[0].outputs) & set(solved[1].outputs)
    gaps = dict(
        shown.run(
            "[...document.querySelectorAll('[data-gap]')].map((g) => [g.closest('tr').dataset.output, g.dataset.gap])"
        )
    )
    expected = {name: str(Fraction(solved[1][name]) - Fraction(solved[0][name])) for name in both}
    assert gaps == {name: gap for name, gap in expected.items() if gap != "0"}
    assert gaps


def test_a_locked_train_names_its_loop_in_red_and_shows_it(show: Opening) -> None:
    shown = show(text=LOCKED)
    verdict = shown.page.locator(".verdict")
    assert verdict.get_attribute("data-verdict") == "locked"
    red, green, blue = rgb(verdict.evaluate("(v) => getComputedStyle(v).color"))
    assert red > 2 * max(green, blue)
    loop = shown.page.locator("button.loop")
    assert "a20~b30" in loop.inner_text()
    loop.click()
    lit = shown.run("[...geartrain.stages[0].world.looks.chosen.wheels].map((k) => geartrain.scenes[0].wheels[k].id)")
    assert set(lit) == {"a20", "b30", "c40"}
    assert shown.page.get_by_role("button", name="play", exact=True).is_disabled()
    assert shown.errors == []


def test_markup_in_a_train_stays_text(show: Opening) -> None:
    shown = show(text=EVIL)
    dialogs: list[str] = []

    def met(dialog: Dialog) -> None:
        dialogs.append(dialog.message)
        dialog.dismiss()

    shown.page.on("dialog", met)
    assert shown.page.locator("h1").inner_text() == '</script><img src=x onerror="alert(2)">'
    assert shown.page.locator(".names").inner_text() == "<b>bold</b> {{note}}"
    for name in ("Readings", "Wheels", "About"):
        tab(shown, name)
    assert "<svg onload=alert(3)>" in shown.page.locator(".sources").inner_text()
    tab(shown, "Wheels")
    shown.page.locator(".wheels button").first.click()
    shown.page.locator("tr[data-output='b'] button.plain").evaluate("(button) => button.click()")
    assert shown.run("document.querySelectorAll('body img, body b, body i, svg[onload], body script').length") == 2
    assert dialogs == []
    assert shown.errors == []
