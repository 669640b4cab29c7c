"""The viewer in light and dark, and on a phone."""

from __future__ import annotations

from typing import Any

import pytest
from viewing import ANTIKYTHERA, LOCKED, SIMPLE, Opening, rgb, tab

SMALL = """() => [...document.querySelectorAll('button, select, input:not([type=checkbox]), .tick, summary, .handle')]
  .filter((each) => each.checkVisibility())
  .map((each) => [each.outerHTML.slice(0, 80), each.getBoundingClientRect()])
  .filter(([, box]) => box.height < 43.9 || box.width < 43.9)
  .map(([text, box]) => [text, box.width, box.height])"""

# visible texts, edges of controls and hands of dials: [what, its colour, that behind it, the contrast it needs]
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
    if (text && each instanceof SVGElement) found.push([name, style(each).fill, face(each), 4.5]);
    if (text && each instanceof HTMLElement) found.push([name, style(each).color, ground(each), 4.5]);
    if (field || (text && each.matches('button:not(.plain, .copy, [role=tab], .grip)')))
      found.push([`${name} (edge)`, style(each).borderTopColor, ground(each.parentElement), 3]);
  }
  return found;
}"""

PHONE: dict[str, Any] = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}


def luminance(colour: tuple[float, float, float]) -> float:
    """Relative luminance, WCAG 2.2."""
    linear = [
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in (c / 255 for c in colour)
    ]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """Contrast ratio, WCAG 2.2."""
    dark, light = sorted((luminance(rgb(one)), luminance(rgb(other))))
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_and_edges_stand_out_in_both_themes(show: Opening, scheme: str) -> None:
    shown = show(ANTIKYTHERA, color_scheme=scheme, reduced_motion="reduce")
    assert shown.run("document.documentElement.dataset.theme") == scheme
    shown.page.get_by_label("Colours").select_option("status")
    shown.page.locator("[data-wheel='e5']").evaluate("(button) => button.click()")
    weak, count = [], 0
    for name in ("Dials", "Outputs", "Wheels", "About"):
        tab(shown, name)
        if name == "Outputs":
            shown.page.locator("tr[data-output='moon'] th button").click()
        for where, ink, ground, least in shown.run(TEXTS):
            count += 1
            if contrast(ink, ground) < least:
                weak.append((where, ink, ground, contrast(ink, ground)))
    assert weak == []
    assert count > 300


def test_what_is_wrong_stands_out_in_both_themes(show: Opening) -> None:
    for scheme in ("light", "dark"):
        shown = show(text=LOCKED, color_scheme=scheme, reduced_motion="reduce")
        for where, ink, ground, least in shown.run(TEXTS):
            assert contrast(ink, ground) >= least, (scheme, where, ink, ground)


def test_the_contrast_of_black_on_white_is_twenty_one() -> None:
    assert contrast("rgb(0, 0, 0)", "rgb(255, 255, 255)") == pytest.approx(21)
    assert contrast("rgb(119, 119, 119)", "rgb(255, 255, 255)") == pytest.approx(4.48, abs=0.01)  # the known failure


def test_the_reader_may_choose_a_theme(show: Opening) -> None:
    shown = show(SIMPLE, color_scheme="light")
    before = shown.run("getComputedStyle(document.body).backgroundColor")
    shown.page.get_by_label("theme").select_option("dark")
    after = shown.run("getComputedStyle(document.body).backgroundColor")
    assert luminance(rgb(before)) > 0.8 > 0.05 > luminance(rgb(after))
    clear = shown.run("geartrain.stages[0].renderer.getClearColor({ copy: (colour) => colour }).getHex()")
    assert clear < 0x303030


@pytest.mark.parametrize("compare", [False, True])
def test_a_phone_shows_one_column_without_scrolling_sideways(show: Opening, compare: bool) -> None:
    shown = show(*(("price-1974", ANTIKYTHERA) if compare else (ANTIKYTHERA,)), compare=compare, **PHONE)
    wide = "document.documentElement.scrollWidth"
    assert shown.run(wide) <= 390
    assert shown.page.get_by_role("tab", name="Dials").is_hidden()
    shown.page.get_by_text("Picture", exact=True).click()
    grip = shown.page.get_by_role("button", name="Open panels")
    grip.click()
    for name in ("Dials", "Outputs", "Wheels", "About"):
        tab(shown, name)
        assert shown.run(wide) <= 390, name
        small = shown.run(SMALL)
        assert small == [], name
    shown.page.get_by_role("button", name="Close panels").click()
    assert shown.page.get_by_role("tab", name="Dials").is_hidden()
    assert shown.errors == []
