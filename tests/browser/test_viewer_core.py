"""Viewer in a browser: exact motion, a self-contained file, and pictures."""

from __future__ import annotations

import os
from collections.abc import Iterator
from fractions import Fraction
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
import shipped
from matplotlib.image import imsave
from viewing import PLAN, SIMPLE, Opening, picture, wait

from geartrain import load
from geartrain.scene import build_scene

if TYPE_CHECKING:
    from conftest import Shown

TURN = 2 * pi
DRAWN = """() => new Promise((done) => {
  let frames = 20;
  const next = () => { frames -= 1; if (frames) requestAnimationFrame(next); else done(); };
  next();
})"""
"""Until the browser has had twenty occasions to draw: what was begun is done, and what never rests is seen."""
PICTURES = Path(__file__).parent / "pictures"
THREE = """
links: {frame: {}, a: {wheels: {x: 20}}, b: {wheels: {y: 30}}, c: {wheels: {z: 40}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
"""


def apart(one: float, other: float) -> float:
    """Return the angle between two directions [rad]."""
    return abs((one - other + pi) % TURN - pi)


def directions(name: str, turns: Fraction) -> Iterator[tuple[str, float]]:
    """Yield outputs with their mean directions after some turns of the first input, computed with Fractions."""
    train = shipped.train(name)
    case = train.declaration
    state = train.states[0] if train.states else None
    inputs = case.inputs if state is None else case.states[state].inputs or case.inputs
    lead = next(link for link, speed in inputs.items() if speed)
    solved = train.solve(state)
    for output, requested in case.outputs.items():
        of, base = requested.of or output, requested.relative_to or case.frame
        ratio = (solved.speeds[of] - solved.speeds[base]) / solved.speeds[lead]
        part = ratio * turns
        yield output, TURN * float(part - part.numerator // part.denominator)


def test_a_page_opens_from_disk_without_errors_or_requests(show: Opening) -> None:
    shown = show("bevel-differential")
    shown.run(DRAWN)
    assert shown.errors == []
    assert shown.requests == []
    assert shown.run("geartrain.stages[0] !== null"), "no WebGL"


@pytest.mark.parametrize("name", ["price-1974", "prague-orloj", "gosper-2005", "humpage"])
def test_pointers_of_ideal_trains_stand_where_fractions_say(show: Opening, name: str) -> None:
    texts = ("0", "1", "-3/7", "235/19", "1000000", "123456789/254", "1e15", "987654321987654321987/1000003")
    outputs = list(shipped.train(name).declaration.outputs)
    turns = (*texts, 0.1, -2.7, 1e9 + 0.1, 123456.789)  # a float is converted exactly
    for each, angles in zip(turns, show(name, **PLAN).angles(turns, outputs), strict=True):
        expected = dict(directions(name, Fraction(each)))
        for output, angle in zip(outputs, angles, strict=True):
            assert apart(angle, expected[output]) < 1e-12, (output, each)


# distance by which a part protrudes from the face in which it ends [mm], from intersections of a ray along its axis
OUT = """([wheel, post]) => {
  const [stage] = geartrain.stages, {world} = stage, part = world.wheels[wheel];
  stage.cut();
  stage.showTeeth(true);
  const Vector = stage.camera.position.constructor, Ray = stage.hands.ray.ray.constructor;
  const {direction, thickness, radius} = part.wheel;
  const along = new Vector(...direction);
  const {points} = part.profile;
  const mean = (which) => points.reduce((sum, point) => sum + point[which], 0) / points.length;
  const [r, angle] = [mean(0) * radius, mean(1)];
  const off = new Vector(r * Math.cos(angle), r * Math.sin(angle), 0).applyMatrix4(part.matrix);
  const from = (post ? new Vector(...post) : off).addScaledVector(along, 2 * thickness);
  const [ray, still] = [() => new Ray(from.clone(), along.clone().negate()), () => new Vector()];
  const met = world.castings.slice(0, 2).flatMap((casting) => [...casting.met(ray, still)]);
  const [first, next] = met.map(([distance]) => distance).sort((one, other) => one - other);
  return next - first;
}"""


@pytest.mark.parametrize(
    ("name", "wheel", "end"), [("cycloidal-reducer", "ring", (31.3, 0.2, 0)), ("lantern-mill", "nut20", None)]
)
def test_ends_of_pins_stand_out_of_the_faces_in_which_they_end(
    show: Opening, name: str, wheel: str, end: tuple[float, float, float] | None
) -> None:
    """Coplanar faces flicker."""
    shown = show(name)
    at = [each.id for each in shipped.built(name).wheels].index(wheel)
    assert 0.02 < shown.run(OUT, [at, end]) < 0.1


def test_a_dial_about_two_axes_has_a_face_for_each(show: Opening) -> None:
    """They are distinguished by their outputs; the single hand of each has the first colour."""
    unplaced = "outputs: {lunar year: {dial: lower}}\ndials: {lower: {centre: null, diameter: null}}\n"
    shown = show(f"name: two-faces\nextends: price-1974\n{unplaced}")
    faces = shown.run("[...document.querySelectorAll('.card')].map((each) => each.querySelector('strong').textContent)")
    assert faces == ["zodiac", "lower (synodic month)", "lower (lunar year)", "upper"]
    hands = shown.run(
        "[...document.querySelectorAll('.card')].map((card) => [...card.querySelectorAll('.hand')]"
        ".map((hand) => [hand.dataset.output, hand.matches('.hand-0')]))"
    )
    assert hands[1:] == [[["synodic month", True]], [["lunar year", True]], [["four years", True]]]


@pytest.mark.parametrize(
    "name", ["freeth-2008", "freeth-2021", "moon-triangular", "freeth-2021-teeth", "pennestri-2002-teeth"]
)
def test_pins_and_real_teeth_move_as_the_motion_says(show: Opening, name: str) -> None:
    motion = shipped.train(name).motion()._with_angles({body.id: body.start for body in shipped.scene(name).bodies})
    turns = np.array([0.0, 0.4140625, 3.25, 1000.0, 76543.21875, 1e6 + 0.8125])
    errors = motion.at(turns).error
    shown = show(name, **PLAN)
    angles = shown.angles(turns.tolist(), motion.outputs)
    for at, turn in enumerate(turns):
        mean = dict(directions(name, Fraction(turn)))
        for row, output in enumerate(motion.outputs):
            expected = mean[output] + motion._start_angles[row] + errors[row, at]
            assert apart(angles[at][row], expected) < 1e-9, (output, turn)
    assert np.abs(errors).max() > 1e-3, "nothing rippled: this asks nothing"


def test_backwards_the_other_flanks_drive(show: Opening) -> None:
    """Negative turns are compared with a run backwards; in forward motion the positions differ by the backlash."""
    name = "pennestri-2002-teeth"
    motion = shipped.train(name).motion()
    shown = show(name, **PLAN)
    differ = 0.0
    for passage in motion._stretches(-37.6875, 5, first=1):
        forwards = motion.at(passage.turns).error
        angles = shown.angles(passage.turns.tolist(), motion.outputs)
        for at, turn in enumerate(passage.turns):
            mean = dict(directions(name, Fraction(float(turn))))
            for row, output in enumerate(motion.outputs):
                expected = mean[output] + motion._start_angles[row] + passage.error[row, at]
                assert apart(angles[at][row], expected) < 1e-9, (output, turn)
                differ = max(differ, abs(passage.error[row, at] - forwards[row, at]))
    assert differ > 1e-4, "the way back is the way forth: this asks nothing"


def canvas_of(shown: Shown, size: tuple[int, int] = (240, 180)) -> np.ndarray:
    """Return the picture of the first stage in a given size, shape (height, width, 3), from 0 to 1."""
    script = """([width, height]) => {
      const [stage] = geartrain.stages;
      const place = {position: 'fixed', left: 0, top: 0, width: `${width}px`, height: `${height}px`};
      Object.assign(stage.canvas.style, place);
      stage.theme({background: '#f4f1ea'});
      stage.resize(); stage.look('free'); stage.setTurns('1/7'); stage.render();
      return stage.canvas.toDataURL('image/png');
    }"""
    return picture(shown.run(script, list(size))) / 255


@pytest.mark.parametrize("name", ["planetary-24-18-60", "bevel-differential"])
def test_the_picture_is_the_one_that_was_looked_at_and_approved(show: Opening, name: str) -> None:
    """Within a tolerance; with GEARTRAIN_NEW_PICTURES=1 the new picture is stored for approval."""
    drawn = canvas_of(show(name, teeth=True))
    stored = PICTURES / f"{name}.png"
    if os.environ.get("GEARTRAIN_NEW_PICTURES"):
        imsave(stored, drawn)
    approved = picture(stored.read_bytes()) / 255
    assert drawn.shape == approved.shape
    assert drawn.std() > 0.05, "the picture is blank"
    coarse = [each.reshape(45, 4, 60, 4, 3).mean(axis=(1, 3)) for each in (drawn, approved)]
    off = np.abs(coarse[0] - coarse[1])
    assert off.mean() < 0.01
    assert np.quantile(off, 0.99) < 0.15


def test_dragging_the_crank_turns_the_train(show: Opening) -> None:
    """A quarter turn about the arbor, counter-clockwise as seen, is a quarter turn of the sun."""
    shown = show(SIMPLE, teeth=True)
    script = """() => {
      const [stage] = geartrain.stages, {crank, root} = stage.world;
      stage.look('front'); stage.render(); root.updateMatrixWorld(true);
      const box = stage.canvas.getBoundingClientRect();
      const seen = p => { p.project(stage.camera);
        return [box.left + (p.x + 1) / 2 * box.width, box.top + (1 - p.y) / 2 * box.height]; };
      const placed = p => p.clone().applyMatrix4(stage.world.nodes[crank.body].matrixWorld);
      return [seen(placed(crank.at)), seen(placed(crank.knob))];
    }"""
    (x, y), (u, v) = shown.run(script)
    reach, start = np.hypot(u - x, v - y), np.arctan2(y - v, u - x)
    assert reach > 20
    shown.page.mouse.move(u, v)
    shown.page.mouse.down()
    for angle in start + np.linspace(0, pi / 2, 19)[1:]:
        shown.page.mouse.move(x + reach * np.cos(angle), y - reach * np.sin(angle))
    shown.page.mouse.up()
    turned = float(Fraction(str(shown.run("String(geartrain.turns)"))))
    assert turned == pytest.approx(0.25, abs=0.03)
    assert apart(shown.run("geartrain.pointer(0, 'carrier').angle"), TURN * turned * 2 / 7) < 1e-9


@pytest.mark.parametrize("apart", [0, 1])
def test_a_tap_on_a_wheel_tells_which_one(show: Opening, apart: int) -> None:
    shown = show(SIMPLE, teeth=True)
    shown.page.get_by_label("Apart").fill(str(apart))
    script = """() => {
      const [stage] = geartrain.stages;
      stage.look('front'); stage.render();
      const box = stage.canvas.getBoundingClientRect(), Vector = stage.camera.position.constructor;
      const {wheels} = geartrain.scenes[0], [x, y] = wheels[2].centre, off = Math.hypot(x, y);
      return wheels.map(w => {  // away from where they mesh
        const reach = (w.kind === 'ring' ? 1.05 : 0.9) * w.radius / off;
        const rim = new Vector(...w.centre).add(new Vector(-reach * y, reach * x, 0)).project(stage.camera);
        return [box.left + (rim.x + 1) / 2 * box.width, box.top + (1 - rim.y) / 2 * box.height];
      });
    }"""
    for wheel, (x, y) in enumerate(shown.run(script)):
        shown.page.mouse.click(x, y)
        assert shown.run("geartrain.stages[0].world.looks.selected") == wheel


@pytest.mark.parametrize(
    ("rest", "kind"),
    [
        ("gears: [{pair: [x, y]}, {pair: [y, z]}, {pair: [z, x]}]\ninputs: {a: 1}", "locked"),
        ("gears: [{pair: [x, y]}]\ninputs: {a: 1}", "free"),
        ("gears: [{pair: [x, y]}, {pair: [y, z]}]\ninputs: {a: 1, c: 1}", "contradictory"),
    ],
)
def test_trains_that_cannot_turn_are_shown_standing(show: Opening, rest: str, kind: str) -> None:
    scene = build_scene(load(THREE + rest))
    assert scene.verdict["kind"] == kind
    shown = show(text=THREE + rest)
    shown.run("geartrain.setTurns('5/7')")
    assert shown.errors == []
    assert kind in shown.page.inner_text("body").lower()
    red = shown.run("""() => geartrain.stages[0].world.wheels.map(({own}) => {
      const {r, g, b} = geartrain.stages[0].world.palette.looks[own].colour;
      return r > 3 * g && r > 3 * b;
    })""")
    assert red == [any(pair.broken and at in pair.wheels for pair in scene.pairs) for at in range(3)]
    assert any(red) == (kind == "locked") or kind == "contradictory"


def test_nothing_is_drawn_while_nothing_changes(show: Opening) -> None:
    shown = show(SIMPLE, teeth=True)
    shown.run(DRAWN)
    frames = "geartrain.stages[0].renderer.info.render.frame"
    before = shown.run(frames)
    shown.run(DRAWN)
    assert shown.run(frames) == before
    shown.run("geartrain.setTurns(1/3)")
    wait(shown, f"{frames} > {before}")


def test_a_frame_of_the_largest_train_takes_five_calls_of_the_gpu(show: Opening) -> None:
    shown = show("freeth-2021", teeth=True)
    calls, triangles = shown.run("""() => {
      const [stage] = geartrain.stages;
      stage.setTurns(1 / 37);
      stage.render();
      return [stage.renderer.info.render.calls, stage.renderer.info.render.triangles];
    }""")
    assert triangles > 69 * 12
    assert calls <= 5, "what stands there first, the teeth, plates, those of glass, and the ground"
    assert shown.errors == shown.requests == []
