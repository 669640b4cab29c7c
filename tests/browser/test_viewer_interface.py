"""The interface of the viewer in a browser: panels, crank, dials, keys, themes, narrow pages, careful text."""

from __future__ import annotations

import time
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from geartrain import load
from geartrain.scene import make_scene
from geartrain.viewer import page

if TYPE_CHECKING:
    from conftest import OpenPage, Shown
    from playwright.sync_api import Dialog

SIMPLE, ANTIKYTHERA = "planetary-24-18-60", "freeth-2008"
PHONE: dict[str, Any] = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
DESK: dict[str, Any] = {"viewport": {"width": 1000, "height": 620}}
CONTROLS = "button, select, input, summary, [tabindex='0'], a[href]"

LOCKED = """
name: locked
title: Three wheels in a ring
sources: {bad: {cite: A book, url: "javascript:alert(1)"}, good: {cite: Another, url: "https://example.org/a"}}
frame: frame
links: {frame: {}, a: {wheels: {a20: {teeth: 20, source: bad}}}, b: {wheels: {b30: {teeth: 30, source: good}}},
  c: {wheels: {c40: 40}}, d: {wheels: {d10: 10}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C},
  {pair: [frame, d], axis: D}]
gears: [{pair: [a20, b30]}, {pair: [b30, c40]}, {pair: [c40, a20]}, {pair: [a20, d10]}]
inputs: {a: 1}
outputs: {b: {}, c: {}}
"""

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

# what the page is asked, in its own language

PAINTED = """geartrain.scenes[0].wheels.map(({ status }, k) => {
  const [red, green, blue] = geartrain.stages[0].world.base[k].match(/[0-9a-f]{2}/g).map((part) => parseInt(part, 16));
  return [status, `rgb(${red}, ${green}, ${blue})`];
})"""

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

Opening = Callable[..., "Shown"]


@pytest.fixture
def show(open_page: OpenPage, tmp_path: Path) -> Opening:
    """Opens the page of shipped trains, or of a declaration, in all their states."""

    def opened(*names: str, text: str | None = None, compare: bool = False, **window: Any) -> Shown:
        if text is not None:
            (tmp_path / "train.yaml").write_text(text, encoding="utf-8")
            names = (str(tmp_path / "train.yaml"),)
        trains = [load(name) for name in names]
        states = [(train, state) for train in trains for state in train.states or (None,)]
        path = tmp_path / "page.html"
        path.write_text(page([make_scene(*each) for each in states], compare=compare, teeth=False), encoding="utf-8")
        return open_page(path, **(DESK | window))

    return opened


def tab(shown: Shown, name: str) -> None:
    shown.page.get_by_role("tab", name=name).click()


def wait(shown: Shown, expression: str) -> None:
    """Until an expression in the page is true."""
    end = time.monotonic() + 30
    while not shown.run(expression):
        assert time.monotonic() < end, expression
        time.sleep(0.02)


def turns(shown: Shown) -> Fraction:
    """Where the crank stands, exactly."""
    return Fraction(str(shown.run("String(geartrain.turns)")))


# --- the crank ---


def test_a_number_of_turns_is_typed_exactly_and_nonsense_is_refused(show: Opening) -> None:
    shown = show(SIMPLE)
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
        assert "no number of turns" in shown.page.get_by_role("alert").inner_text()
        assert place.get_attribute("aria-invalid") == "true"
    assert shown.errors == []


def test_a_step_is_one_unit_of_the_input(show: Opening) -> None:
    shown = show("clock-10000-years")
    step = Fraction(make_scene(load("clock-10000-years")).step)
    shown.page.get_by_label("one unit of the input forward").click(click_count=3)
    assert turns(shown) == 3 * step
    shown.page.get_by_label("one unit of the input back").click()
    assert turns(shown) == 2 * step


def test_dragging_the_wheel_turns_the_crank_as_far_as_the_hand_went(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    box = shown.page.get_by_role("slider", name="crank").bounding_box()
    assert box is not None
    x, y, reach = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, 0.36 * box["width"]
    shown.page.mouse.move(x, y - reach)
    shown.page.mouse.down()
    for dx, dy in ((0.7071, -0.7071), (1, 0), (0.7071, 0.7071), (0, 1)):
        shown.page.mouse.move(x + dx * reach, y + dy * reach)
    shown.page.mouse.up()
    made = turns(shown)
    shown.page.mouse.move(x - reach, y)
    assert turns(shown) == made, "the hand has let go"
    assert float(made) == pytest.approx(0.5 * 48 / 223, abs=2e-4)  # half a turn of a, clockwise


def test_play_turns_and_pause_holds_and_tells_the_pointers(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    shown.page.get_by_role("button", name="play", exact=True).click()
    wait(shown, "!String(geartrain.turns).startsWith('0')")
    shown.page.get_by_role("button", name="pause", exact=True).click()
    held = turns(shown)
    wait(shown, "/turns; sun .*°, cell .*moon/.test(document.querySelector('[role=status]').textContent)")
    assert turns(shown) == held > 0


def test_reduced_motion_moves_by_jumps_of_a_second(show: Opening) -> None:
    shown = show(SIMPLE, reduced_motion="reduce")
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


# --- outputs, path, dials ---


def needed(name: str, output: str, folder: Path) -> set[str]:
    """Gears and couplings without which an output is not determined: each left out in turn, and all solved anew."""
    declared = load(name).declaration
    found = set()
    for kind, ids in (
        ("gears", [gear.id or "~".join(gear.pair) for gear in declared.gears]),
        ("couplings", [c.id for c in declared.couplings]),
    ):
        for each in ids:
            path = folder / "without.yaml"
            path.write_text(f"name: without\nextends: {name}\nremove: {{{kind}: ['{each}']}}\n", encoding="utf-8")
            if load(str(path)).solve().outputs[output].speed is None:
                found.add(str(each))
    return found


@pytest.mark.parametrize("output", ["moon", "exeligmos"])
def test_the_path_is_exactly_what_the_output_cannot_do_without(show: Opening, tmp_path: Path, output: str) -> None:
    shown = show(ANTIKYTHERA)
    tab(shown, "Outputs")
    shown.page.locator(f"tr[data-output='{output}'] th button").click()
    listed = shown.run("[...document.querySelectorAll('.path [data-pair]')].map((each) => each.dataset.pair)")
    expected = needed(ANTIKYTHERA, output, tmp_path)
    assert len(listed) == len(set(listed))
    assert set(listed) == expected
    wheels = {
        str(wheel)
        for gear in load(ANTIKYTHERA).declaration.gears
        if (gear.id or "~".join(gear.pair)) in expected
        for wheel in gear.pair
    }
    lit = shown.run("[...geartrain.stages[0].world.chosen.wheels].map((k) => geartrain.scenes[0].wheels[k].id)")
    assert set(lit) == wheels
    shown.page.keyboard.press("Escape")
    assert shown.run("geartrain.stages[0].world.chosen") is None
    assert shown.page.locator(".path").is_hidden()


def test_dials_read_clockwise_what_fractions_say(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    train = load(ANTIKYTHERA)
    solved = train.solve()
    at = Fraction(100_003, 7)
    shown.page.get_by_label("Go to turn").fill(str(at))
    shown.page.keyboard.press("Enter")
    hands = shown.run(
        "Object.fromEntries([...document.querySelectorAll('.dial .hand')].map((h) => [h.dataset.output, "
        "[Number(h.dataset.turns), Number(/rotate\\(([^)]+)/.exec(h.getAttribute('transform'))[1])]]))"
    )
    positive = 1 if train.declaration.view.positive == "clockwise" else -1
    # the frame's front is seen as the view says; on the back all turns the other way about
    for output in ("sun", "metonic", "games", "callippic", "saros", "exeligmos"):
        dial = train.declaration.dials[str(train.declaration.outputs[output].dial)]
        sense = positive if dial.face == "front" else -positive
        read = sense * Fraction(solved[output]) * at % dial.turns
        made, rotated = hands[output]
        assert made == pytest.approx(float(read), abs=1e-9), output
        assert rotated == pytest.approx(float(read % 1) * 360, abs=1e-5), output


def test_an_exact_value_is_copied_by_a_click(show: Opening) -> None:
    shown = show(ANTIKYTHERA, permissions=["clipboard-read", "clipboard-write"])
    tab(shown, "Outputs")
    shown.page.locator("tr[data-output='apsides'] button.copy").click()
    wait(shown, "document.querySelector('[role=status]').textContent === '-477/4237 copied'")
    assert shown.run("navigator.clipboard.readText()") == "-477/4237"


# --- wheels, colours, states ---


def test_the_wheel_panel_tells_all_that_is_declared(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    tab(shown, "Wheels")
    shown.page.get_by_label("find a wheel").fill("e5")
    assert shown.page.locator(".wheels li:visible").count() == 1
    shown.page.locator("[data-wheel='e5']").click()
    text = shown.page.locator(".detail").inner_text()
    for part in ("Wheel e5", "50", "surviving", "e5~k1", "e_table", "Nature 444", "\u2212254/19", "\u221213.368421"):
        assert part in text, part
    assert shown.run("geartrain.scenes[0].wheels[geartrain.stages[0].world.selected].id") == "e5"


def test_a_wheel_picked_in_the_picture_is_shown_in_the_panel(show: Opening) -> None:
    shown = show(SIMPLE)
    shown.run("geartrain.stages[0].onPick(1)")
    wheel = make_scene(load(SIMPLE)).wheels[1]
    assert f"Wheel {wheel.id}" in shown.page.locator(".detail").inner_text()


def test_links_lead_only_to_the_web(show: Opening) -> None:
    shown = show(text=LOCKED)
    tab(shown, "About")
    links = shown.run("[...document.querySelectorAll('.page a')].map((each) => each.href)")
    assert links == ["https://example.org/a"]
    assert "javascript:alert(1)" in shown.page.locator(".sources").inner_text()


def test_the_legend_of_the_status_counts_every_wheel_and_shows_its_colour(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    shown.page.get_by_label("Colours").select_option("status")
    declared = [wheel.status for link in load(ANTIKYTHERA).declaration.links.values() for wheel in link.wheels.values()]
    rows = shown.page.locator(".legend li")
    told = {
        row.inner_text(): row.locator(".swatch").evaluate("(s) => getComputedStyle(s).backgroundColor")
        for row in rows.all()
    }
    painted = shown.run(PAINTED)
    for status in ("surviving", "reconstructed"):
        words = f"{status} ({declared.count(status)})"
        assert {colour for each, colour in painted if each == status} == {told[words]}


def test_losses_are_told_where_they_are_known(show: Opening) -> None:
    shown = show("norton-compound")
    shown.page.get_by_label("Colours").select_option("loss")
    assert "of the power put in" in shown.page.locator(".legend").inner_text()
    tab(shown, "Wheels")
    wheel = next(wheel for wheel in make_scene(load("norton-compound")).wheels if wheel.loss)
    shown.page.locator(f"[data-wheel='{wheel.id}']").click()
    assert f"{100 * float(wheel.loss or 0):.3g} % of the power put in" in shown.page.locator(".detail").inner_text()
    shown = show(SIMPLE)
    shown.page.get_by_label("Colours").select_option("loss")
    assert "declares no loads" in shown.page.locator(".legend").inner_text()


def test_without_webgl_all_but_the_picture_is_there(show: Opening) -> None:
    shown = show(SIMPLE)
    shown.page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    shown.page.reload()
    assert shown.run("geartrain.stages[0] === null")
    assert "no 3D picture" in shown.page.locator(".nothing").inner_text()
    tab(shown, "Outputs")
    shown.page.locator("tr[data-output='carrier'] th button").click()
    shown.page.get_by_label("one unit of the input forward").click()
    assert shown.page.locator("[data-angle='carrier']").inner_text() == f"{360 - 360 * 2 / 7:.2f}\u00b0"


def test_states_are_chosen_and_stand_beside_each_other(show: Opening) -> None:
    shown = show("planetary")
    names = list(load("planetary").declaration.states)
    assert shown.page.locator(".view:visible").count() == 1
    shown.page.get_by_label("State").select_option(label=names[1])
    assert shown.page.locator("figcaption .caption").nth(1).text_content() == names[1]
    assert shown.page.locator(".view").nth(1).is_visible()
    shown.page.get_by_label("Beside").select_option(label=names[0])
    assert shown.page.locator(".view:visible").count() == 2
    assert shown.errors == []


def test_two_trains_turn_in_step_and_their_difference_is_exact(show: Opening) -> None:
    shown = show("price-1974", ANTIKYTHERA, compare=True)
    solved = [load(name).solve() for name in ("price-1974", ANTIKYTHERA)]
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
    red, green, blue = _rgb(verdict.evaluate("(v) => getComputedStyle(v).color"))
    assert red > 2 * max(green, blue)
    loop = shown.page.locator("button.loop")
    assert "a20~b30" in loop.inner_text()
    loop.click()
    lit = shown.run("[...geartrain.stages[0].world.chosen.wheels].map((k) => geartrain.scenes[0].wheels[k].id)")
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


# --- keyboard and readers ---


def test_the_keyboard_alone_suffices(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
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
    press("/")  # belongs to the text that is typed
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
    assert shown.run("document.activeElement.textContent") == "Outputs"
    assert turns(shown) == Fraction(235, 19), "arrows among tabs turn nothing"
    shown.page.get_by_role("slider", name="crank").focus()
    press("Home")
    assert turns(shown) == 0
    press("Space")
    wait(shown, "!String(geartrain.turns).startsWith('0')")
    press("Space")
    assert shown.page.get_by_role("button", name="play", exact=True).is_visible()
    shown.run("document.activeElement.blur()")
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


# --- light, dark, narrow ---


def _rgb(text: str) -> tuple[float, float, float]:
    red, green, blue = (float(part) for part in text.removeprefix("rgb(").rstrip(")").split(","))
    return red, green, blue


def luminance(colour: tuple[float, float, float]) -> float:
    """Relative luminance, WCAG 2.2."""
    linear = [
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in (c / 255 for c in colour)
    ]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """Contrast ratio, WCAG 2.2."""
    dark, light = sorted((luminance(_rgb(one)), luminance(_rgb(other))))
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
    assert luminance(_rgb(before)) > 0.8 > 0.05 > luminance(_rgb(after))
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
