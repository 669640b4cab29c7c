"""Viewer without a mouse: keys, focus, and names for screen readers."""

from __future__ import annotations

from fractions import Fraction

from viewing import ANTIKYTHERA, MOVING, SIMPLE, Opening, tab, turns, wait

CONTROLS = "button, select, input, summary, [tabindex='0'], a[href]"

RING = """() => {
  const { outlineStyle, outlineWidth } = getComputedStyle(document.activeElement);
  return outlineStyle + outlineWidth;
}"""

FAULTS = """(controls) => {
  const all = (selector) => [...document.querySelectorAll(selector)];
  const told = (each) => each.getAttribute('aria-label') || each.getAttribute('aria-hidden') === 'true';
  const named = (each) =>
    told(each) || each.textContent.trim() || each.title
    || [...(each.labels ?? [])].some((label) => label.textContent.trim())
    || document.getElementById(each.getAttribute('aria-labelledby'))?.textContent;
  const ids = all('[id]').map((each) => each.id);
  const ends = ['aria-controls', 'aria-labelledby', 'aria-describedby']
    .flatMap((name) => all(`[${name}]`).map((each) => each.getAttribute(name)));
  return [
    ...all(controls).filter((each) => !named(each)).map((each) => each.outerHTML),
    ...all('svg, canvas').filter((each) => !told(each)).map((each) => each.outerHTML),
    ...ids.filter((id, k) => ids.indexOf(id) !== k),
    ...ends.filter((id) => !ids.includes(id)),
  ];
}"""


def test_the_keyboard_alone_suffices(show: Opening) -> None:
    shown = show(ANTIKYTHERA, **MOVING)
    press = shown.page.keyboard.press
    press("ArrowRight")
    assert turns(shown) == Fraction(1, 72)
    press("Shift+ArrowRight")
    assert turns(shown) == Fraction(73, 72)
    press("PageDown")
    press("ArrowLeft")
    assert turns(shown) == 0
    press("g")
    shown.page.keyboard.type("235/19")
    press("Enter")
    assert turns(shown) == Fraction(235, 19)
    press("/")  # the key is part of the typed text
    assert shown.run("document.activeElement.value") == "235/19/"
    press("Escape")
    press("/")
    shown.page.keyboard.type("b1")
    press("Tab")
    press("Enter")
    assert "Wheel b1" in shown.page.locator(".detail").inner_text()
    press("Escape")
    assert shown.page.locator(".detail").is_hidden()
    press("?")
    assert shown.page.get_by_role("dialog").is_visible()
    press("Escape")
    assert shown.page.get_by_role("dialog").is_hidden()
    shown.page.get_by_role("tab", name="Wheels").focus()
    press("ArrowLeft")
    assert shown.run("document.activeElement.textContent") == "Readings"
    assert turns(shown) == Fraction(235, 19), "arrows among tabs turn nothing"
    shown.page.get_by_role("slider", name="crank").focus()
    press("Home")
    assert turns(shown) == 0
    press("Space")
    wait(shown, "!String(geartrain.turns).startsWith('0')")
    press("Space")
    assert shown.page.get_by_role("button", name="play", exact=True).is_visible()
    shown.run("document.activeElement.blur()")
    press("b")
    press("Space")
    wait(shown, "String(geartrain.turns).startsWith('-')")
    press("Space")
    press("b")
    assert shown.page.get_by_role("button", name="play backwards").get_attribute("aria-pressed") == "false"
    press("c")
    assert shown.page.get_by_label("Colours").input_value() == "speed"
    press("t")
    assert shown.page.get_by_label("Teeth").is_checked()
    press("3")
    assert shown.page.get_by_role("button", name="Side", exact=True).get_attribute("aria-pressed") == "true"


def test_tab_meets_every_control_once_and_shows_where_it_is(show: Opening) -> None:
    shown = show(SIMPLE)
    tab(shown, "Wheels")
    wanted = shown.run(
        f"""() => [...document.querySelectorAll("{CONTROLS}")].filter((each) => each.tabIndex >= 0 && !each.disabled
            && each.checkVisibility({{visibilityProperty: true}})).map((each, k) => (each.dataset.stop = String(k)))"""
    )
    shown.page.locator(".skip").focus()
    met, rings = [wanted[0]], []
    for _ in wanted[1:]:
        shown.page.keyboard.press("Tab")
        met.append(shown.run("document.activeElement.dataset.stop"))
        rings.append(shown.run(RING))
    assert met == wanted, "the order of focus is that of the page"
    assert set(rings) == {"solid3px"}


def test_every_control_has_a_name_and_every_reference_an_end(show: Opening) -> None:
    shown = show("planetary")
    assert shown.run(FAULTS, CONTROLS) == []
    counts = "['h1', 'main', 'header', 'aside', '[role=status]'].map((each) => document.querySelectorAll(each).length)"
    assert shown.run(counts) == [1, 1, 1, 1, 1]
    assert shown.run("document.documentElement.lang") == "en"
