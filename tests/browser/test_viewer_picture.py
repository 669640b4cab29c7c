"""Picture of the viewer in a browser: its contents, its camera, and its use of the browser."""

from __future__ import annotations

from fractions import Fraction

import pytest
import shipped
from viewing import ANTIKYTHERA, PLAN, SIMPLE, Opening, turns, wait

# maximum distances of the rims of all wheels and dials from the middle of the picture, horizontally and vertically
SPREAD = """(scene) => {
  const stage = geartrain.stages[scene];
  stage.render();
  const Vector = stage.camera.position.constructor, {nodes, crank} = stage.world;
  const most = [0, 0];
  const see = (body, point) => {
    const {x, y} = point.applyMatrix4(nodes[body].matrixWorld).project(stage.camera);
    most[0] = Math.max(most[0], Math.abs(x));
    most[1] = Math.max(most[1], Math.abs(y));
  };
  const round = (body, at, normal, radius) => {
    const {main, poses} = stage.world; // taken apart, layers stand further along
    const centre = new Vector(...at).addScaledVector(main, poses.share * poses.lift(body, new Vector(...at))).toArray();
    const n = new Vector(...normal);
    const a = new Vector(n.y - n.z, n.z - n.x, n.x - n.y).lengthSq() > 1e-6
      ? new Vector(n.y - n.z, n.z - n.x, n.x - n.y).normalize() : new Vector(1, -1, 0).normalize();
    const b = n.clone().cross(a);
    for (let k = 0; k < 40; k += 1) {
      const [c, s] = [Math.cos(k * Math.PI / 20), Math.sin(k * Math.PI / 20)];
      see(body, new Vector(...centre).addScaledVector(a, radius * c).addScaledVector(b, radius * s));
    }
  };
  const {wheels, dials} = geartrain.scenes[scene];
  for (const w of wheels) round(w.body, w.centre, w.direction, w.kind === 'ring' ? w.root : w.tip);
  const {position} = stage.camera; // the oblique view includes the dials that face the reader
  const faces = ({normal, centre}) => new Vector(...normal).dot(position.clone().sub(new Vector(...centre))) > 0;
  for (const d of dials) if (stage.from !== 'free' || faces(d)) round(d.body, d.centre, d.normal, d.radius);
  if (crank && !stage.world.poses.share) see(crank.body, crank.knob.clone());
  return most;
}"""

# angles of hands from the zero mark, clockwise for a reader of the dial [turns]
NEEDLES = """() => {
  const [stage] = geartrain.stages, [scene] = geartrain.scenes, {nodes} = stage.world;
  stage.world.turn();
  const Vector = stage.camera.position.constructor;
  const turned = (body, values) => new Vector(...values).transformDirection(nodes[body].matrixWorld);
  return Object.fromEntries(scene.pointers.filter(({dial}) => dial !== null).map(({output, body, dial}) => {
    const {body: under, zero, normal} = scene.dials[dial];
    const [from, up, hand] = [turned(under, zero), turned(under, normal), turned(body, zero)];
    return [output, -Math.atan2(from.clone().cross(hand).dot(up), from.dot(hand)) / (2 * Math.PI)];
  }));
}"""


@pytest.mark.parametrize(
    "names", [("planetary",), ("humpage",), ("worm",), ("longcase-clock",), ("price-1974", "worm")]
)
def test_the_whole_train_and_its_crank_fill_the_picture(show: Opening, names: tuple[str, ...]) -> None:
    shown = show(*names, compare=len(names) > 1)
    for scene in range(len(names)):
        for look in ("Front", "Side", "Free"):
            shown.page.get_by_role("button", name=look, exact=True).click()
            for turn in ("0", "5/13"):
                shown.run("(t) => geartrain.setTurns(t)", turn)
                across, upwards = shown.run(SPREAD, scene)
                assert max(across, upwards) <= 1, (names[scene], look, turn)
            assert max(across, upwards) > 0.5, (names[scene], look)


@pytest.mark.parametrize("name", [ANTIKYTHERA, "bevel-differential", "worm"])
def test_taken_apart_nothing_leaves_the_picture(show: Opening, name: str) -> None:
    shown = show(name)
    apart = shown.page.get_by_label("Apart")
    for look in ("Front", "Back", "Side", "Free"):
        shown.page.get_by_role("button", name=look, exact=True).click()
        for share in ("0.4", "1", "0"):
            apart.fill(share)
            across, upwards = shown.run(SPREAD, 0)
            assert max(across, upwards) < 1, (look, share)
            assert max(across, upwards) > 0.5, (look, share)  # wheels; the corners of plates are farther out
    shown.page.mouse.move(200, 300)
    for _ in range(12):
        shown.page.mouse.wheel(0, -400)  # nearer: the target keeps its position and its distance
    wait(shown, f"({SPREAD})(0)[1] > 1.3")
    near = shown.run(SPREAD, 0)
    for share in ("1", "0"):
        apart.fill(share)
    assert shown.run(SPREAD, 0) == pytest.approx(near, rel=1e-3)


def test_needles_in_the_picture_point_where_fractions_say(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    train = shipped.train(ANTIKYTHERA)
    solved = train.solve()
    at = Fraction(1234, 7)
    shown.run("(t) => geartrain.setTurns(t)", "0")
    first = shown.run(NEEDLES)
    shown.run("(t) => geartrain.setTurns(t)", str(at))
    pointed = shown.run(NEEDLES)
    positive = 1 if train.declaration.view.positive == "clockwise" else -1
    for output in ("sun", "metonic", "games", "callippic", "saros", "exeligmos"):
        face = train.declaration.dials[str(train.declaration.outputs[output].dial)].face
        sense = positive if face == "front" else -positive
        # only pointers that the declaration sets to the sky start elsewhere than at their zero mark
        assert (abs(first[output]) < 1e-9) == (train.declaration.outputs[output].at_epoch is None)
        off = (pointed[output] - first[output] - float(sense * Fraction(solved[output]) * at % 1)) % 1
        assert min(off, 1 - off) < 1e-6, output


def test_what_stands_before_the_middle_is_hidden_and_comes_back(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    seen = "geartrain.stages[0].world.wheels.map(({own}) => geartrain.stages[0].world.palette.looks[own].shown)"
    assert all(shown.run(seen))
    shown.page.get_by_label("Hide front").check()
    scene = shipped.built(ANTIKYTHERA)
    heights = [scene.front * wheel.centre[2] for wheel in scene.wheels]
    middle = (min(heights) + max(heights)) / 2
    assert shown.run(seen) == [height <= middle + 1e-9 for height in heights]
    shown.page.get_by_label("Hide front").uncheck()
    assert all(shown.run(seen))


def test_teeth_are_drawn_when_they_are_wanted(show: Opening) -> None:
    """Plain rims replace the teeth; both are never drawn at once."""
    shown = show(SIMPLE, teeth=True)
    drawn = """[...geartrain.stages[0].world.wheels].map(({toothed, smooth}) => [toothed, smooth]
        .map((slot) => geartrain.stages[0].world.palette.looks[slot].shown))"""
    assert shown.run(drawn) == [[True, False]] * 3
    shown.page.get_by_label("Teeth").uncheck()
    assert shown.run(drawn) == [[False, True]] * 3


def test_no_button_says_from_where_one_looks_once_the_picture_was_turned_by_hand(show: Opening) -> None:
    shown = show(SIMPLE)
    shown.page.get_by_role("button", name="Front", exact=True).click()
    pressed = "[...document.querySelectorAll('[data-look][aria-pressed=true]')].map((each) => each.dataset.look)"
    assert shown.run(pressed) == ["front"]
    box = shown.page.locator("canvas").bounding_box()
    shown.page.mouse.move(box["x"] + 20, box["y"] + 20)
    shown.page.mouse.down()
    shown.page.mouse.move(box["x"] + 120, box["y"] + 60, steps=4)
    shown.page.mouse.up()
    wait(shown, f"{pressed}.length === 0")
    shown.page.get_by_role("button", name="Back", exact=True).click()
    assert shown.run(pressed) == ["back"]


def test_only_what_is_shown_holds_a_drawing_context(show: Opening) -> None:
    """Browsers permit about 16 contexts; a page may have more states."""
    count = """
      globalThis.contexts = new Set();
      const asked = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (...all) {
        const found = asked.apply(this, all);
        if (found) contexts.add(found);
        return found;
      };"""
    shown = show("zf-8hp70", before=count)
    names = list(shipped.train("zf-8hp70").states)
    live = "[...contexts].filter((each) => !each.isContextLost()).length"
    assert shown.run(live) == 1
    for name in (*names[1:], names[0]):
        shown.page.get_by_label("State").select_option(label=name)
    shown.page.get_by_label("Beside").select_option(label=names[1])
    assert shown.run("contexts.size") > len(names)
    wait(shown, f"{live} <= 2")
    assert shown.run("geartrain.stages.filter(Boolean).length") == 2
    assert shown.page.locator(".view:visible canvas").count() == 2
    assert shown.errors == shown.requests == []


# --- two at once ---


def test_equal_times_pass_in_two_trains_whose_units_are_times(show: Opening) -> None:
    shown = show("huygens-planetarium-1682", "longcase-clock", compare=True, **PLAN)
    first, second = (shipped.train(name).declaration for name in ("huygens-planetarium-1682", "longcase-clock"))
    assert second.unit_days == Fraction(1, 24)
    speeds = [next(Fraction(speed.value) for speed in each.inputs.values()) for each in (first, second)]
    for _ in range(2):
        shown.page.get_by_label("one unit of the input forward").click()
    years = 2
    assert turns(shown) == years * speeds[0]
    made = [Fraction(text) for text in shown.run("geartrain.machines.map(({turns}) => String(turns))")]
    assert made == [years * speeds[0], years * first.unit_days * 24 * speeds[1]]
    assert "of centre beside for each" in shown.page.locator(".crank").inner_text()


BY_THE_ROAD = """
name: by-the-road
links: {frame: {}, a: {wheels: {p: 20}}, b: {wheels: {q: 30}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, q]}]
unit: {per: 18 ft}
inputs: {a: 5}
"""


@pytest.mark.parametrize("first", [SIMPLE, BY_THE_ROAD])
def test_equal_turns_are_made_where_a_train_has_no_unit_of_time(show: Opening, first: str) -> None:
    shown = show(first, "longcase-clock", compare=True, **PLAN)
    shown.run("geartrain.setTurns('22/7')")
    assert shown.run("geartrain.machines.map(({turns}) => String(turns))") == ["22/7", "22/7"]
