"""Viewer in the light and the dark theme, and on a phone."""

from __future__ import annotations

import re
from typing import Any

import pytest
from viewing import ANTIKYTHERA, LOCKED, MOVING, SIMPLE, Opening, contrast, go, luminance, tab, unfold, wait

SMALL = """() => [...document.querySelectorAll('button, select, input:not([type=checkbox]), .tick, summary, .handle')]
  .filter((each) => each.checkVisibility())
  .map((each) => [each.outerHTML.slice(0, 80), each.getBoundingClientRect()])
  .filter(([, box]) => box.height < 43.9 || box.width < 43.9)
  .map(([text, box]) => [text, box.width, box.height])"""

# visible texts, edges of controls and hands of dials: [name, colour, background, required contrast]
TEXTS = """() => {
  const style = (node) => getComputedStyle(node);
  const ground = (node) => {
    if (!node) return 'rgb(255, 255, 255)';
    const { backgroundColor } = style(node);
    return /rgba\\(.*, 0\\)/.test(backgroundColor) ? ground(node.parentElement) : backgroundColor;
  };
  const face = (node) => style(node.ownerSVGElement.querySelector('.face')).fill;
  const found = [];
  for (const each of document.querySelectorAll('body *')) {
    if (!each.checkVisibility() || each.closest('script, noscript, :disabled')) continue;
    const field = each.matches('input[type=text], input[type=search], select');
    const text = field || [...each.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
    const name = each.outerHTML.slice(0, 90);
    if (each.matches('.dial .hand')) found.push([name, style(each).color, face(each), 3]);
    const under = (node) => (node.closest('.dial') ? face(node) : style(node).stroke); // names have an outline
    if (text && each instanceof SVGElement) found.push([name, style(each).fill, under(each), 4.5]);
    if (text && each instanceof HTMLElement) found.push([name, style(each).color, ground(each), 4.5]);
    if (field || (text && each.matches('button:not(.plain, .copy, [role=tab], .grip)')))
      found.push([`${name} (edge)`, style(each).borderTopColor, ground(each.parentElement), 3]);
  }
  return found;
}"""

PHONE: dict[str, Any] = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


# pressed buttons: [name, colour, background]
PRESSED = """() => [...document.querySelectorAll('[data-look], .wheels button')].map((button) => {
  button.click();
  const { color, backgroundColor } = getComputedStyle(button);
  return [button.outerHTML.slice(0, 90), button.getAttribute('aria-pressed'), color, backgroundColor];
})"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_and_edges_stand_out_in_both_themes(show: Opening, scheme: str) -> None:
    shown = show(ANTIKYTHERA, color_scheme=scheme)
    assert shown.run("document.documentElement.dataset.theme") == scheme
    shown.page.get_by_label("Colours").select_option("status")
    shown.page.locator("[data-wheel='e5']").evaluate("(button) => button.click()")
    weak, count = [], 0
    for name in ("Readings", "Wheels", "About"):
        tab(shown, name)
        if name == "Readings":
            unfold(shown, "without a dial")
            unfold(shown, "Comparison")
            shown.page.locator("tr[data-output='moon'] th button").click()
        for where, ink, ground, minimum in shown.run(TEXTS):
            count += 1
            if contrast(ink, ground) < minimum:
                weak.append((where, ink, ground, contrast(ink, ground)))
    assert weak == []
    assert count > 300


def test_what_is_wrong_stands_out_in_both_themes(show: Opening) -> None:
    for scheme in ("light", "dark"):
        shown = show(text=LOCKED, color_scheme=scheme)
        for where, ink, ground, minimum in shown.run(TEXTS):
            assert contrast(ink, ground) >= minimum, (scheme, where, ink, ground)


def test_the_contrast_of_black_on_white_is_twenty_one() -> None:
    assert contrast("rgb(0, 0, 0)", "rgb(255, 255, 255)") == pytest.approx(21)
    assert contrast("rgb(119, 119, 119)", "rgb(255, 255, 255)") == pytest.approx(4.48, abs=0.01)  # a known fault


def test_the_reader_may_choose_a_theme(show: Opening) -> None:
    shown = show(SIMPLE, color_scheme="light")
    before = shown.run("getComputedStyle(document.body).backgroundColor")
    shown.page.get_by_label("theme").select_option("dark")
    after = shown.run("getComputedStyle(document.body).backgroundColor")
    assert luminance(before) > 0.8 > 0.05 > luminance(after)
    clear = shown.run("geartrain.stages[0].renderer.getClearColor({ copy: (colour) => colour }).getHex()")
    assert clear < 0x303030


@pytest.mark.parametrize("compare", [False, True])
def test_a_phone_shows_one_column_without_scrolling_sideways(show: Opening, compare: bool) -> None:
    shown = show(*(("price-1974", ANTIKYTHERA) if compare else (ANTIKYTHERA,)), compare=compare, **PHONE)
    wide = "document.documentElement.scrollWidth"
    assert shown.run(wide) <= 390
    assert shown.page.get_by_role("tab", name="Readings").is_hidden()
    shown.page.get_by_text("Picture", exact=True).click()
    grip = shown.page.get_by_role("button", name="Open panels")
    grip.click()
    for name in ("Readings", "Wheels", "About"):
        tab(shown, name)
        assert shown.run(wide) <= 390, name
        small = shown.run(SMALL)
        assert small == [], name
    shown.page.get_by_role("button", name="Close panels").click()
    assert shown.page.get_by_role("tab", name="Readings").is_hidden()
    assert shown.errors == []


def test_the_head_of_a_phone_leaves_the_screen_to_the_picture(show: Opening) -> None:
    """States and clutches are in one row; rarely used controls are folded, and keys are listed only with a keyboard."""
    shown = show("ravigneaux-set", **PHONE)
    top = "document.querySelector('.view canvas').getBoundingClientRect().top"
    assert shown.run(top) < PHONE["viewport"]["height"] / 4
    state = shown.page.get_by_label("State")
    rows = [part.bounding_box() for part in (state, *shown.page.locator(".element").all())]
    assert len({box["y"] + box["height"] / 2 for box in rows if box}) == 1
    assert shown.page.get_by_role("button", name="Keys").is_hidden()
    shown.page.get_by_role("button", name="Open panels").click()
    tab(shown, "About")
    assert shown.page.get_by_text("pinch or scroll to zoom").locator("visible=true").count() == 1
    shown.page.get_by_role("button", name="Close panels").click()
    shown.page.get_by_text("Picture", exact=True).click()
    shown.page.get_by_label("Beside").select_option(index=2)
    shown.page.get_by_label("Theme").select_option("dark")
    assert shown.run("document.documentElement.dataset.theme") == "dark"
    assert shown.page.locator(".view:visible").count() == 2
    assert shown.run("document.documentElement.scrollWidth") <= 390


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_pressed_button_can_be_read_at_once(show: Opening, scheme: str) -> None:
    shown = show(SIMPLE, color_scheme=scheme, **MOVING)
    shown.page.locator("[data-look='front']").hover()
    tab(shown, "Wheels")
    pressed = shown.run(PRESSED)
    assert [state for _, state, _, _ in pressed] == ["true"] * (4 + 3)
    for what, _, ink, ground in pressed:
        assert contrast(ink, ground) >= 4.5, (what, ink, ground)


@pytest.mark.parametrize("name", [ANTIKYTHERA, "zf-8hp70"])
def test_a_phone_that_lies_has_crank_picture_and_panels_at_once(show: Opening, name: str) -> None:
    parts = (".handle", ".round", ".turns", ".where .quiet", ".view canvas", "[role=tablist]", ".page .outputs")
    shown = show(name, **PHONE | {"viewport": {"width": 844, "height": 390}})
    for width, height in ((844, 390), (667, 375), (568, 320)):
        shown.page.set_viewport_size({"width": width, "height": height})
        wait(shown, f"document.querySelector('.view canvas').getBoundingClientRect().bottom <= {height}")
        for part in parts:
            box = shown.page.locator(part).locator("visible=true").first.bounding_box()
            inside = box["x"] >= 0 and box["x"] + box["width"] <= width + 1 and box["y"] >= 0
            assert inside, (width, part, box)
            assert box["y"] + (0 if part == ".page .outputs" else box["height"]) <= height, (width, part, box)
        canvas = shown.page.locator(".view canvas").bounding_box()
        assert canvas["width"] > 0.3 * width
        assert canvas["height"] > 0.5 * height
        assert shown.run("[document.documentElement.scrollWidth, document.documentElement.scrollHeight]") == [
            width,
            height,
        ]
        assert shown.run(SMALL) == [], width
    go(shown, "5/2")
    assert shown.page.locator(".turns").inner_text() == "2.5 = 5/2"


def test_a_printed_page_is_complete_and_has_the_picture(show: Opening) -> None:
    """Folded parts are opened before the pages are counted; a drawing context is not printed."""
    shown = show(ANTIKYTHERA)
    printed = shown.page.pdf(format="A4")
    shown.page.emulate_media(media="print")
    wait(shown, "document.querySelectorAll('.more:not([open])').length === 0")
    pages = [len(re.findall(rb"/Type /Page\b", each)) for each in (printed, shown.page.pdf(format="A4"))]
    assert pages[0] == pages[1] > 3
    assert b"/Subtype /Image" in printed


def test_on_paper_are_picture_readings_and_sources_and_nothing_to_press(show: Opening) -> None:
    shown = show(SIMPLE, viewport={"width": 718, "height": 1040})
    shown.run("geartrain.setTurns('1/4')")
    assert not shown.page.locator(".outputs").is_visible()
    shown.page.emulate_media(media="print")
    wait(shown, "document.querySelector('[data-angle=carrier]').textContent !== ''")
    for seen in (".view canvas.copy", ".outputs", ".sources"):
        assert shown.page.locator(seen).first.is_visible(), seen
    for pressed in (".tour", ".tools", ".go", ".grip", "[role=tablist]", ".wheels"):
        assert not shown.page.locator(pressed).first.is_visible(), pressed
    # a quarter turn of the sun, and 2/7 of it
    assert shown.page.locator("[data-angle=carrier]").inner_text() == f"{360 - 90 * 2 / 7:.2f}\u00b0"
    assert shown.run("document.documentElement.scrollWidth") <= 718
