"""Dials of the viewer in a browser: readings of hands, pins on spirals, and directions."""

from __future__ import annotations

from fractions import Fraction
from math import hypot, pi

import pytest
import shipped
from viewing import PLAN, Opening

ANTIKYTHERA = "freeth-2008"

# position of the pin of a hand on a spiral, right and up, relative to the radius of the dial
PIN = """(name) => {
  const [stage] = geartrain.stages, [scene] = geartrain.scenes, {poses} = stage.world;
  stage.world.turn();
  const index = scene.pointers.findIndex(({output}) => output === name);
  const dial = scene.dials[scene.pointers[index].dial];
  const Vector = stage.camera.position.constructor;
  const [centre, zero, normal] = [dial.centre, dial.zero, dial.normal].map((v) => new Vector(...v));
  const pin = centre.clone().addScaledVector(zero, dial.scale.inner * dial.radius);
  const off = pin.applyMatrix4(poses.nodes[poses.slide(index)].matrixWorld).sub(centre);
  const right = zero.clone().cross(normal);
  return [off.dot(right) / dial.radius, off.dot(zero) / dial.radius];
}"""


def test_pins_follow_their_spirals_and_are_set_back_at_the_end(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    for output, turns, period in (("metonic", 5, Fraction(19)), ("saros", 4, Fraction(4237, 235))):
        for share in (Fraction(0), Fraction(3, 10), Fraction(999, 1000), Fraction(1), Fraction(13, 8)):
            shown.run("(t) => geartrain.setTurns(t)", str(share * period))
            along = float(share * turns % turns)
            x, y = shown.run(PIN, output)
            assert hypot(x, y) == pytest.approx(0.55 + 0.45 * along / turns, abs=1e-6), (output, share)
            angle = 2 * 3.141592653589793 * along
            ahead = shown.run("(a) => [Math.sin(a), Math.cos(a)]", angle)
            assert (x / hypot(x, y), y / hypot(x, y)) == pytest.approx(ahead, abs=1e-6), (output, share)


@pytest.mark.parametrize("name", [ANTIKYTHERA, "longcase-clock", "prague-orloj", "al-biruni-box-of-the-moon"])
def test_hands_are_told_to_show_what_python_says(show: Opening, name: str) -> None:
    shown = show(name, **PLAN)
    train = shipped.train(name)
    solved, declared = train.solve(), train.declaration
    scene = shipped.scene(name)
    at = Fraction(1003, 17)
    shown.run("(t) => geartrain.setTurns(t)", str(at))
    told = shown.run(
        "Object.fromEntries([...document.querySelectorAll('[data-angle]')].map((cell) => "
        "[cell.dataset.angle, cell.textContent]))"
    )
    checked = 0
    for pointer in scene.pointers:
        if pointer.dial is None or pointer.output == "moon":  # its pins cause errors
            continue
        scale = scene.dials[pointer.dial].scale
        of, base = declared.outputs[pointer.output].links(pointer.output, declared.frame)
        lead = scene.bodies[scene.driving_link or 0].id
        speed = Fraction(solved[pointer.output]) / Fraction(solved.speeds[lead])
        assert of != base
        start = Fraction((scene.bodies[pointer.body].start - scene.bodies[pointer.base].start) / (2 * pi))
        words = scale.reading_text(pointer.sense * scale.way * (speed * at + start))
        assert told[pointer.output].partition(", ")[2] == words, pointer.output
        checked += 1
    assert checked >= 3


def test_what_is_engraved_stands_on_the_page_stroke_by_stroke(show: Opening) -> None:
    shown = show(ANTIKYTHERA, **PLAN)
    drawn = shown.run(
        "[...document.querySelectorAll('.dial')].map((d) => [d.getAttribute('aria-label'), "
        "[...d.querySelectorAll('.letters')].map((p) => (p.getAttribute('d').match(/M/g) ?? []).length)"
        ".reduce((sum, each) => sum + each, 0)])"
    )
    for label, strokes in drawn:
        face = next(each for each in shipped.scene(ANTIKYTHERA).dials if f"dial {each.id}" == label)
        letters = [lines for kind, _, lines in face.engraving if kind == "letters"]
        assert strokes == sum(map(len, letters)) > 0, label


def test_the_ground_is_below_all_that_turns_and_grows_as_layers_part(show: Opening) -> None:
    shown = show("planetary-24-18-60")
    script = """(share) => {
      const [stage] = geartrain.stages, {world} = stage;
      stage.explode(share);
      const low = Math.min(...world.outline().map(({y}) => y));
      const {low: ground, half_wide: wide} = world.ground.uniforms;
      return [low, ground.value, wide.value[1]];
    }"""
    low, ground, deep = shown.run(script, 0)
    assert ground < low
    assert shown.run(script, 1)[2] > 1.5 * deep


def test_one_hand_of_an_arbor_is_read_on_both_dials_under_it(show: Opening) -> None:
    """The picture has one hand, and both dials show it in its colour."""
    shown = show("prague-orloj")
    hands = "geartrain.stages[0].world.parts.filter(({dial, plate, colour}) => dial !== undefined && !plate)"
    outputs = [shown.run(f"geartrain.scenes[0].bodies[{body}].id") for body in shown.run(f"{hands}.map((e) => e.body)")]
    # a hand can have several parts
    assert [*dict.fromkeys(outputs)] == ["sun", "zodiac", "moon"]
    classes = shown.run(
        "Object.fromEntries([...document.querySelectorAll('.card .hand')]"
        ".map((hand) => [hand.dataset.output, hand.getAttribute('class')]))"
    )
    assert classes["sun in zodiac"] == classes["sun"] != classes["zodiac"]
    assert classes["sidereal month"] == classes["moon"] not in (classes["sun"], classes["zodiac"])


def test_dials_without_a_declared_place_say_that_their_layout_is_computed(show: Opening) -> None:
    cards = "[...document.querySelectorAll('.card')].map((each) => /layout computed/.test(each.textContent))"
    assert not any(show(ANTIKYTHERA, **PLAN).run(cards))
    assert show("longcase-clock", **PLAN).run(cards) == [True] * 3
