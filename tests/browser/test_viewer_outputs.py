"""Outputs of the viewer in a browser: paths, dials and exact values."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest
import shipped
from viewing import ANTIKYTHERA, PLAN, Opening, go, tab, unfold, wait

from geartrain import load

# visible area and colour of each wheel, by name
DRAWN = """geartrain.scenes[0].wheels.map(({ id }, k) => {
  const { palette, wheels } = geartrain.stages[0].world;
  const { opacity, colour } = palette.looks[wheels[k].own];
  return [id, opacity, colour.getHexString()];
})"""


def needed(name: str, output: str, folder: Path) -> set[str]:
    """Return the gears and couplings without which an output is not determined, by solving the train without each."""
    declared = shipped.train(name).declaration
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


def test_brakes_and_clutches_are_named_and_a_click_shows_what_they_hold(show: Opening) -> None:
    shown = show("zf-8hp70")
    declared = shipped.train("zf-8hp70").declaration
    for at, state in enumerate(declared.states):
        shown.page.get_by_label("State").select_option(index=at)
        closed = shown.run("[...document.querySelectorAll('.element.closed')].map((each) => each.textContent)")
        assert set(closed) == set(declared.states[state].engaged)
    assert shown.run("[...document.querySelectorAll('.element')].map((each) => each.textContent)") == list(
        declared.clutches
    )
    for name, clutch in declared.clutches.items():
        shown.page.locator(".element", has_text=name).click()
        lit = shown.run("[...geartrain.stages.find(Boolean).world.looks.chosen.wheels]")
        held = clutch.locks or (clutch.fixes or "",)
        assert lit == [at for at, (link, _) in enumerate(declared.wheels.values()) if link in held]


@pytest.mark.parametrize("output", ["moon", "exeligmos"])
def test_the_path_is_exactly_what_the_output_cannot_do_without(show: Opening, tmp_path: Path, output: str) -> None:
    shown = show(ANTIKYTHERA)
    tab(shown, "Readings")
    plain = {colour for _, _, colour in shown.run(DRAWN)}
    shown.page.locator(f"tr[data-output='{output}'] th button").click()
    listed = shown.run("[...document.querySelectorAll('.path [data-pair]')].map((each) => each.dataset.pair)")
    expected = needed(ANTIKYTHERA, output, tmp_path)
    assert len(listed) == len(set(listed))
    assert set(listed) == expected
    wheels = {
        str(wheel)
        for gear in shipped.train(ANTIKYTHERA).declaration.gears
        if (gear.id or "~".join(gear.pair)) in expected
        for wheel in gear.pair
    }
    lit = shown.run("[...geartrain.stages[0].world.looks.chosen.wheels].map((k) => geartrain.scenes[0].wheels[k].id)")
    assert set(lit) == wheels
    drawn = shown.run(DRAWN)
    assert {wheel for wheel, opacity, _ in drawn if opacity == 1} == wheels, "all else is half seen"
    assert {colour for wheel, _, colour in drawn if wheel in wheels}.isdisjoint(plain)
    shown.page.keyboard.press("Escape")
    assert shown.run("geartrain.stages[0].world.looks.chosen") is None
    assert {opacity for _, opacity, _ in shown.run(DRAWN)} == {1}
    assert shown.page.locator(".path").is_hidden()


HANDS = (
    "Object.fromEntries([...document.querySelectorAll('.dial .hand')].map((h) => [h.dataset.output, "
    "[Number(h.dataset.turns), Number(/rotate\\(([^)]+)/.exec(h.getAttribute('transform'))[1])]]))"
)
"""Turns and rotation [deg] of each hand in the list of readings."""


def test_dials_read_clockwise_what_fractions_say(show: Opening) -> None:
    shown = show(ANTIKYTHERA, **PLAN)
    train = shipped.train(ANTIKYTHERA)
    solved = train.solve()
    at = Fraction(100_003, 7)
    go(shown, Fraction(0))
    first = shown.run(HANDS)
    go(shown, at)
    hands = shown.run(HANDS)
    positive = 1 if train.declaration.view.positive == "clockwise" else -1
    # the front is seen as the view declares; on the back all senses are reversed
    for output in ("sun", "metonic", "games", "callippic", "saros", "exeligmos"):
        dial = train.declaration.dials[str(train.declaration.outputs[output].dial)]
        sense = positive if dial.face == "front" else -positive
        way = -1 if output == "games" else 1  # only its years are counted in the opposite direction
        # only pointers that the declaration sets to the sky start elsewhere than at their zero mark
        assert (first[output][0] == 0) == (train.declaration.outputs[output].at_epoch is None)
        read = (first[output][0] + float(sense * way * Fraction(solved[output]) * at % dial.turns)) % dial.turns
        made, rotated = hands[output]
        assert made == pytest.approx(float(read), abs=1e-9), output
        assert rotated == pytest.approx(float(way * (read % 1)) * 360, abs=1e-5), output


def test_an_exact_value_is_copied_by_a_click(show: Opening) -> None:
    shown = show(ANTIKYTHERA, permissions=["clipboard-read", "clipboard-write"], **PLAN)
    unfold(shown, "without a dial")
    shown.page.locator("tr[data-output='apsides'] button.copy").click()
    wait(shown, "document.querySelector('[role=status]').textContent === '-477/4237 copied'")
    assert shown.run("navigator.clipboard.readText()") == "-477/4237"
