"""What the viewer says of trains: their states, two at once, verdicts, careful text."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import shipped
from viewing import ANTIKYTHERA, LOCKED, SIMPLE, Opening, rgb, tab, turns

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
    shown = show(text=LOCKED)
    tab(shown, "About")
    links = shown.run("[...document.querySelectorAll('.page a')].map((each) => each.href)")
    assert links == ["https://example.org/a"]
    assert "javascript:alert(1)" in shown.page.locator(".sources").inner_text()


def test_without_webgl_all_but_the_picture_is_there(show: Opening) -> None:
    shown = show(SIMPLE, before="HTMLCanvasElement.prototype.getContext = () => null")
    assert shown.run("geartrain.stages[0] === null")
    assert "no 3D picture" in shown.page.locator(".nothing").inner_text()
    tab(shown, "Outputs")
    shown.page.locator("tr[data-output='carrier'] th button").click()
    shown.page.get_by_label("one unit of the input forward").click()
    assert shown.page.locator("[data-angle='carrier']").inner_text() == f"{360 - 360 * 2 / 7:.2f}\u00b0"


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
    shown = show("price-1974", ANTIKYTHERA, compare=True)
    solved = [shipped.train(name).solve() for name in ("price-1974", ANTIKYTHERA)]
    tab(shown, "Outputs")
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
    assert shown.page.locator(".names").inner_text() == "<script>alert(1)</script>"
    for name in ("Outputs", "Wheels", "About"):
        tab(shown, name)
    assert "<svg onload=alert(3)>" in shown.page.locator(".sources").inner_text()
    tab(shown, "Wheels")
    shown.page.locator(".wheels button").first.click()
    shown.page.locator("tr[data-output='b'] button.plain").evaluate("(button) => button.click()")
    assert shown.run("document.querySelectorAll('body img, body b, body i, svg[onload], body script').length") == 2
    assert dialogs == []
    assert shown.errors == []
