"""Motion in a scene: data of a page, poses of slides and sliders, belts, elliptical wheels, and phases of teeth."""

from __future__ import annotations

import json
import struct
from base64 import b64decode
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import chain
from math import atan2, cos, dist, floor, pi, sin, sqrt
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shipped
from commands import call
from sampling import all_but

import geartrain
from geartrain import GearTrain
from geartrain.scene import Scene, make_scene, scene_pose
from geartrain.scene.pose import body_errors

TURNS = np.array([0.0, 1 / 3, 17.25, 1234.5678, 98765.4321, 1e6])
AGREE = 1e-9  # rad


class Reader:
    """Reader of the angles of the bodies of a scene; with `back`, for negative turns."""

    def __init__(self, scene: Scene, back: bool = False) -> None:
        self.scene = replace(scene, movement=scene.back) if back and scene.back else scene

    def errors(self, turns: Fraction) -> list[float]:
        return list(body_errors(self.scene, turns))

    def angles(self, turns: float) -> list[float]:
        """Return the angle of every body about its direction [rad]."""
        return list(scene_pose(self.scene, Fraction(turns)).angles)


def pointer_angle(scene: Scene, angles: Sequence[float], pointer: Any) -> float:
    """Return the angle of a pointer about its declared axis [rad]."""
    return scene.bodies[pointer.body].sense * (angles[pointer.body] - angles[pointer.base])


@cache
def drawn(train: GearTrain) -> Scene:
    """Return a scene, cached for both directions."""
    return make_scene(train)


def off(a: float, b: float) -> float:
    """Return the difference of two angles modulo one turn."""
    return abs((a - b + pi) % (2 * pi) - pi)


def compared(train: GearTrain, back: bool = False) -> float:
    """Return the maximum difference of any output between the scene's data and the train's motion [rad].

    A scene counts about declared axes; motion counts turns and angles in the sense of the driving link.

    back   for runs of negative turns
    """
    scene = drawn(train)
    way = -1 if Fraction(scene.step) < 0 else 1
    reader = Reader(scene, back)
    motion, worst = train.motion()._with_angles({body.id: body.start for body in scene.bodies}), 0.0
    runs = [motion._stretches(stretch, 6, first=1) for stretch in (-0.8125, -1234.5)] if back else [[motion.at(TURNS)]]
    for passage in chain.from_iterable(runs):
        for column, t in enumerate(passage.turns):
            angles = reader.angles(way * float(t))
            for row, (pointer, tally) in enumerate(zip(scene.pointers, motion._statistics(), strict=True)):
                mean = tally.ratio * Fraction(float(t))
                wanted = (
                    motion._start_angles[row] + 2 * pi * float(mean - floor(mean)) + float(passage.error[row, column])
                )
                worst = max(worst, off(pointer_angle(scene, angles, pointer), way * wanted))
    return worst


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("name", ["freeth-2021", "freeth-2021-teeth", "pennestri-2002-teeth", "sorge-pairs"])
def test_the_plain_data_move_every_pointer_as_the_train_does(name: str, back: bool) -> None:
    assert compared(shipped.train(name), back) < AGREE


TRIANGULAR = "form: triangular, half_angle: 30 deg, clearance_factor: 1.01"
PAIRS = """
links:
  frame: {{}}
  a: {{wheels: {{p: 24}}, angle: 17 deg}}
  b: {{wheels: {{q: 60, s: 31}}, angle: -3 deg}}
  c: {{wheels: {{r: 17}}}}
axes: {{A: {{}}, B: {{direction: [0, 0, -1]}}, C: {{}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}, {{pair: [frame, c], axis: C}}]
gears: [{{pair: [p, q], phase: 0.3, driver: {driver}}}, {{pair: [s, r], phase: 0.8}}]
tooth_form: {{{form}}}
inputs: {{a: {speed}}}
outputs: {{a: , b: , c: {{relative_to: a}}}}
"""


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("speed", ["1", "-3/7"])
@pytest.mark.parametrize("driver", ["p", "q"])
@pytest.mark.parametrize("form", [TRIANGULAR, "form: involute, backlash: 0.1"])
def test_backlash_phases_starting_angles_and_opposed_axes_are_kept(
    form: str, driver: str, speed: str, back: bool
) -> None:
    assert compared(geartrain.load(PAIRS.format(form=form, driver=driver, speed=speed)), back) < AGREE


def test_the_scene_of_a_train_that_is_declared_to_turn_backwards_is_the_mirror_image() -> None:
    text = PAIRS.format(form=TRIANGULAR, driver="p", speed="1")
    mirrored = text.replace("inputs: {a: 1}", "inputs: {a: -1}")
    mirrored = mirrored.replace("angle: 17 deg", "angle: -17 deg").replace("angle: -3 deg", "angle: 3 deg")
    ahead, back = drawn(geartrain.load(text)), drawn(geartrain.load(mirrored))
    for other in (False, True):
        readers = Reader(ahead, back=other), Reader(back, back=other)
        for turns in (Fraction(0), Fraction(1, 3), Fraction(17, 7)):
            forth, mirror = (reader.errors(way * turns) for way, reader in zip((1, -1), readers, strict=True))
            assert mirror == pytest.approx([-each for each in forth], abs=1e-13)


def test_the_way_back_is_written_only_where_it_differs() -> None:
    """Pins in slots move equally in both directions; teeth with backlash drive with their coast flanks."""
    assert shipped.scene("freeth-2021").back is None
    assert make_scene(geartrain.load("price-1974")).back is None
    teeth = make_scene(geartrain.load("moon-triangular"))
    assert teeth.back is not None
    forwards, backwards = (Reader(teeth, back).angles(0.3) for back in (False, True))
    assert max(map(off, forwards, backwards)) > 1e-4


def test_transmissions_alike_are_written_once() -> None:
    scene = shipped.scene("freeth-2021-teeth")
    kinds = {
        (source.transmission, scene.movement.transmissions[source.transmission].period)
        for source in scene.movement.sources
    }
    assert len(kinds) == len(scene.movement.transmissions) < len(scene.movement.sources)
    for transmission in scene.movement.transmissions:
        assert transmission.breaks[0] == 0
        assert transmission.breaks[-1] == transmission.period
        assert (np.diff(transmission.breaks) > 0).all()
        assert len(transmission.breaks) == len(transmission.coefficients) + 1


def test_everything_stands_as_before_after_the_period() -> None:
    scene = make_scene(geartrain.load("moon-triangular"))
    period = Fraction(scene.movement.period or 0)
    for body in scene.bodies:
        assert (Fraction(body.speed or 0) * period).denominator == 1
    reader = Reader(scene)
    once, again = reader.errors(Fraction(1, 3)), reader.errors(Fraction(1, 3) + period)
    assert once == again


def test_a_loop_of_real_teeth_moves_in_the_mean_and_says_why() -> None:
    loop = """
links: {frame: {}, a: {wheels: {wa: 20}}, b: {wheels: {wb: 30}}, c: {wheels: {wc: 40}}, d: {wheels: {wd: 50}}}
revolutes: {A: [frame, a], B: [frame, b], C: [frame, c], D: [frame, d]}
gears: [wa ~ wb, wb ~ wc, wc ~ wd, wd ~ wa]
tooth_form: {form: triangular, half_angle: 30 deg, clearance_factor: 1.01}
inputs: {a: 1}
"""
    scene = make_scene(geartrain.load(loop))
    assert scene.movement.kind == "mean"
    assert "loop" in scene.movement.why
    assert any(notice["what"] in scene.movement.why for notice in scene.notices)
    assert [body.speed for body in scene.bodies] == ["0", "1", "-2/3", "1/2", "-2/5"]


def test_a_pin_stands_where_its_transmission_has_it() -> None:
    """The slot, which is drawn towards the pin in the zero pose and turns with its body, always contains the pin."""
    train = geartrain.load(
        """
links: {frame: {}, pin: {angle: 40 deg}, slot: {angle: 10 deg}}
axes: {P: {position: [0 mm, 0 mm, 0 mm]}, S: {position: [1.1 mm, 0.4 mm, 0 mm]}}
revolutes: [{pair: [frame, pin], axis: P}, {pair: [frame, slot], axis: S}]
couplings: [{id: k, kind: pin_and_slot, pin: pin, slot: slot, pin_radius: 9.6 mm, offset: 1.1704699910719626 mm}]
inputs: {pin: 1}
"""
    )
    scene = make_scene(train)
    reader, (k,) = Reader(scene), scene.couplings
    axis = complex(*scene.bodies[k.pin].point[:2])
    at, of = complex(*k.pin_at[:2]), complex(*k.slot_at[:2])
    assert abs(at - axis) == pytest.approx(9.6)
    for turns in (0.0, 0.21, 0.5, 7.83):
        angles = reader.angles(turns)
        pin = axis + (at - axis) * np.exp(1j * angles[k.pin])
        slot = (at - of) * np.exp(1j * (angles[k.slot] + k.slot_turn))
        assert abs(np.angle((pin - of) / slot)) < 1e-9


def test_tables_are_written_as_little_endian_numbers_row_by_row() -> None:
    scene = shipped.scene("freeth-2021-teeth")
    for table, data in zip(scene.movement.transmissions, scene.to_dict()["movement"]["transmissions"], strict=True):
        assert (np.frombuffer(b64decode(data["breaks"]), "<f8") == table.breaks).all()
        assert (np.frombuffer(b64decode(data["coefficients"]), "<f8") == table.coefficients.ravel()).all()


def body(scene: Scene, link: str) -> int:
    return next(at for at, each in enumerate(scene.bodies) if each.id == link)


def test_a_carriage_takes_its_pinion_along_which_turns_by_the_rack() -> None:
    scene = make_scene(shipped.train("lathe-thread"))
    carriage, pinion = body(scene, "carriage"), body(scene, "pinion")
    # 1.25 mm a turn towards the headstock; the pinion of 24 pi mm rolls back by that travel
    pose = scene_pose(scene, Fraction(48))
    assert pose.moved[carriage] == pytest.approx([0, 0, -60])
    assert pose.turned[carriage] == pytest.approx(np.eye(3))
    axis = np.array(scene.bodies[pinion].point)
    assert pose.point(pinion, axis) == pytest.approx(axis + np.array([0, 0, -60]))
    turn = 2 * pi * 60 / (24 * pi)
    assert pose.way(pinion, [1, 0, 0]) == pytest.approx([cos(turn), sin(turn), 0], abs=1e-9)
    assert scene.bodies[carriage].shown == "-5/4 mm"
    assert scene.bodies[pinion].shown == "5/(96 π)"
    assert scene.bodies[pinion].base == body(scene, "bed")


def test_a_slider_is_where_the_transmission_function_puts_it_at_every_angle() -> None:
    train = geartrain.load("""
links: {frame: {}, crank: {}, s: {}}
revolutes: {A: [frame, crank]}
slides: {R: [frame, s]}
couplings: [{kind: crank_slider, turns: crank, slides: s, radius: 20 mm, rod: 60 mm}]
inputs: {crank: 1}
""")
    scene = make_scene(train)
    places = [scene_pose(scene, Fraction(at, 12)).moved[body(scene, "s")][0] for at in range(13)]
    S = [2 * pi * at / 12 for at in range(13)]
    expected = np.array([20 * cos(each) + sqrt(60**2 - (20 * sin(each)) ** 2) for each in S])
    # travel counts from the outer dead centre
    assert np.array(places) == pytest.approx(expected - 80, abs=1e-6)


def test_a_screw_that_rises_with_its_ram_is_carried_without_turning_more() -> None:
    scene = make_scene(shipped.train("screw-jack"))
    pose = scene_pose(scene, Fraction(5, 4))
    for link in ("ram", "screw"):
        assert pose.moved[body(scene, link)][2] == pytest.approx(10)
    assert pose.way(body(scene, "screw"), [1, 0, 0]) == pytest.approx([0, 1, 0], abs=1e-12)


def test_a_slide_is_translated_in_the_animation_of_a_file(tmp_path: Path) -> None:
    call("export", "lathe-thread", "-o", str(tmp_path / "lathe.glb"), "--turns", "8")
    data = (tmp_path / "lathe.glb").read_bytes()
    (size,) = struct.unpack_from("<I", data, 12)
    content = json.loads(data[20 : 20 + size])
    (animation,) = content["animations"]
    ways = {content["nodes"][each["target"]["node"]]["name"]: each for each in animation["channels"]}
    assert {name: each["target"]["path"] for name, each in ways.items()} == {
        **dict.fromkeys(("spindle", "idler", "leadscrew", "pinion", "handwheel"), "rotation"),
        "carriage": "translation",
    }
    output = content["accessors"][animation["samplers"][ways["carriage"]["sampler"]]["output"]]
    view = content["bufferViews"][output["bufferView"]]
    start = 28 + size + view.get("byteOffset", 0) + output.get("byteOffset", 0)
    keys = np.frombuffer(data, "<f4", 3 * output["count"], start).reshape(-1, 3)
    assert keys[-1] - keys[0] == pytest.approx([0, 0, -10], abs=1e-4)


@pytest.mark.parametrize(("crossed", "length"), [("", 597.13104546), ("b", 616.04460768)])
def test_the_parts_of_a_belt_have_the_length_of_an_open_or_a_crossed_belt(crossed: str, length: float) -> None:
    scene = make_scene(
        geartrain.load(f"""
links: {{frame: {{}}, a: {{}}, b: {{}}}}
axes: {{A: {{position: [0, 0, 0]}}, B: {{position: [200 mm, 0, 0]}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
couplings: [{{kind: belt, around: {{a: 50 mm, b: 75 mm}}, reversed: [{crossed}]}}]
inputs: {{a: 1}}
""")
    )
    total = 0.0
    for part in (part for part in scene.shapes if part.kind == "belt"):
        outline = np.reshape(part.outlines[0], (-1, 2))
        half = len(outline) // 2
        if len(outline) == 4:
            start, end = (np.mean(outline[at : at + 2], axis=0) for at in (0, 2))
            total += dist(start, end)
        else:
            middle = (np.array(outline[:half]) + np.array(outline[half:])[::-1]) / 2
            total += float(np.hypot(*np.diff(middle, axis=0).T).sum())
    # arcs are drawn by chords of at most 5 degrees, which are shorter by up to 0.03 %
    assert total == pytest.approx(length, rel=5e-4)


@pytest.mark.parametrize("turns", [Fraction(0), Fraction(1, 7), Fraction(2, 5), Fraction(5, 6)])
def test_elliptical_wheels_touch_on_the_line_of_centres(turns: Fraction) -> None:
    scene = make_scene(shipped.train("elliptical-gears"))
    pose = scene_pose(scene, turns)
    coupling = [part for part in scene.shapes if part.kind == "wheel"][:2]
    centres = [np.array(part.place)[:2] for part in coupling]
    between = centres[1] - centres[0]
    reach = 0.0
    for part, centre, way in zip(coupling, centres, (between, -between), strict=True):
        flat = np.reshape(part.outlines[0], (-1, 2))
        plane = np.array([part.across, np.cross(part.direction, part.across)])
        points = pose.point(part.body, np.array(part.place) + flat @ plane)[:, :2] - centre
        angle = np.arctan2(points[:, 1], points[:, 0]) - np.arctan2(way[1], way[0])
        order = np.argsort((angle + np.pi) % (2 * np.pi))
        angle = ((angle + np.pi) % (2 * np.pi) - np.pi)[order]
        reach += float(np.interp(0, angle, np.hypot(*points[order].T), period=2 * np.pi))
    assert reach == pytest.approx(float(np.hypot(*between)), rel=2e-4)


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
revolutes: {{A: [frame, a], B: [frame, b], C: [frame, c], D: [frame, d], E: [frame, e], F: [frame, f]}}
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
    scene = make_scene(geartrain.load(CHAIN.format(*phases, form=FORMS[form], speed=speed)))
    angles = Reader(scene).angles(0.0)
    assert len(scene.pairs) == 4
    for pair, phase in zip(scene.pairs, phases, strict=True):
        off = past_the_line(scene, angles, pair) - phase
        assert (off + 0.5) % 1 - 0.5 == pytest.approx(0, abs=1e-8), pair.id
    # pointers are at the positions for ideal teeth
    assert max(abs(each) for each in Reader(scene).errors(Fraction(0))) < 1e-8
