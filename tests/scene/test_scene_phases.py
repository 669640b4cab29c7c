"""At turn 0 a tooth of every first wheel, and every pin, is at its declared `phase`."""

from __future__ import annotations

from fractions import Fraction
from math import atan2, pi
from typing import Any

import pytest
from sampling import all_but
from test_scene_movement import Reader

from geartrain import load
from geartrain.scene import Scene, make_scene

# two pairs in series; a third whose first wheel is driven; a pin; a pair driven by the pin
CHAIN = """
links:
  frame: {{}}
  a: {{wheels: {{p: 20}}}}
  b: {{wheels: {{q: 31, s: 15}}}}
  c: {{wheels: {{r: 40, u: 18}}}}
  d: {{wheels: {{v: 25}}}}
  e: {{wheels: {{x: 22}}}}
  f: {{wheels: {{y: 30}}}}
revolutes:
  - {{pair: [frame, a], axis: A}}
  - {{pair: [frame, b], axis: B}}
  - {{pair: [frame, c], axis: C}}
  - {{pair: [frame, d], axis: D}}
  - {{pair: [frame, e], axis: E}}
  - {{pair: [frame, f], axis: F}}
gears:
  - {{pair: [p, q], phase: {0}}}
  - {{pair: [s, r], phase: {1}}}
  - {{pair: [v, u], phase: {2}}}
  - {{pair: [x, y], phase: {3}}}
couplings: [{{id: pin, kind: pin_and_slot, pin: d, slot: e, pin_radius: 9 mm, offset: 3 mm}}]
tooth_form: {{{form}}}
inputs: {{a: {speed}}}
outputs: {{b: , c: , d: , e: , f: }}
"""
FORMS = {
    "triangular": "form: triangular, half_angle: 30 deg, window: 0.5",
    "involute": "form: involute, backlash: 0.1",
    "circular arcs": "form: circular_arc",
}


def past_the_line(scene: Scene, angles: list[float], pair: Any) -> float:
    """Return how far a tooth of the first wheel is past the line of centres in its sense [pitches]."""
    wheel, mate = (scene.wheels[at] for at in pair.wheels)
    body = scene.bodies[wheel.body]
    x, y = (mate.centre[at] - wheel.centre[at] for at in (0, 1))
    reference = atan2(wheel.reference[1], wheel.reference[0])
    ahead = wheel.direction[2]
    tooth = reference + ahead * (wheel.turn + angles[wheel.body])
    way = [-1 if text.startswith("-") else 1 for text in (body.speed or "", scene.step)]
    forward = ahead * body.sense * way[0] * way[1]
    return forward * (tooth - atan2(y, x)) / (2 * pi / wheel.teeth) % 1


@pytest.mark.parametrize("speed", ["1", "-2/3"])
@pytest.mark.parametrize("form", all_but({"circular arcs"}, FORMS))
@pytest.mark.parametrize("phases", [(0, 0, 0, 0), (0.3, 0.8, 0.1, 0.45)])
def test_a_tooth_of_every_first_wheel_is_drawn_at_its_phase(phases: tuple[float, ...], form: str, speed: str) -> None:
    scene = make_scene(load(CHAIN.format(*phases, form=FORMS[form], speed=speed)))
    angles = Reader(scene).angles(0.0)
    assert len(scene.pairs) == 4
    for pair, phase in zip(scene.pairs, phases, strict=True):
        off = past_the_line(scene, angles, pair) - phase
        assert (off + 0.5) % 1 - 0.5 == pytest.approx(0, abs=1e-8), pair.id
    # pointers are at the positions for ideal teeth
    assert max(abs(each) for each in Reader(scene).errors(Fraction(0))) < 1e-8
