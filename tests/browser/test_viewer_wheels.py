"""Wheels of the viewer in a browser: their data, and the meaning of their colours."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
import shipped
from viewing import ANTIKYTHERA, SIMPLE, Opening, tab

# appearance of each wheel: entry of its body's slot in the palette
PAINTED = """geartrain.scenes[0].wheels.map(({ status }, k) => {
  const { palette, wheels } = geartrain.stages[0].world;
  const { r, g, b } = palette.looks[wheels[k].own].colour.clone().convertLinearToSRGB();
  return [status, `rgb(${[r, g, b].map((part) => Math.round(255 * part)).join(', ')})`];
})"""


def test_the_wheel_panel_tells_all_that_is_declared(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    tab(shown, "Wheels")
    shown.page.get_by_label("find a wheel").fill("e5")
    assert shown.page.locator(".wheels li:visible").count() == 1
    shown.page.locator("[data-wheel='e5']").click()
    text = shown.page.locator(".detail").inner_text()
    for part in ("Wheel e5", "50", "surviving", "e5~k1", "e_table", "Nature 444", "\u2212254/19", "\u221213.368421"):
        assert part in text, part
    assert shown.run("geartrain.scenes[0].wheels[geartrain.stages[0].world.looks.selected].id") == "e5"


def test_a_wheel_picked_in_the_picture_is_shown_in_the_panel(show: Opening) -> None:
    shown = show(SIMPLE)
    shown.run("geartrain.stages[0].onPick(1)")
    wheel = shipped.built(SIMPLE).wheels[1]
    assert f"Wheel {wheel.id}" in shown.page.locator(".detail").inner_text()


def test_the_legend_of_the_status_counts_every_wheel_and_shows_its_colour(show: Opening) -> None:
    shown = show(ANTIKYTHERA)
    shown.page.get_by_label("Colours").select_option("status")
    declared = [
        wheel.status for link in shipped.train(ANTIKYTHERA).declaration.links.values() for wheel in link.wheels.values()
    ]
    rows = shown.page.locator(".legend li")
    told = {
        row.inner_text(): row.locator(".swatch").evaluate("(s) => getComputedStyle(s).backgroundColor")
        for row in rows.all()
    }
    picture, legend = (shown.page.locator(each).bounding_box() for each in (".view canvas", ".legend"))
    assert legend["y"] >= picture["y"] + picture["height"], "the legend stands over the picture"
    painted = shown.run(PAINTED)
    for status in ("surviving", "reconstructed"):
        words = f"{status} ({declared.count(status)})"
        assert {colour for each, colour in painted if each == status} == {told[words]}


def test_tools_stand_in_one_row_on_a_laptop(show: Opening) -> None:
    shown = show(SIMPLE, viewport={"width": 1280, "height": 800})
    tools = [each.bounding_box() for each in shown.page.locator(".tools > *:visible").all()]
    assert len(tools) > 6
    assert max(box["y"] for box in tools if box) - min(box["y"] for box in tools if box) < 20


# colours of plates, of arms of carriers and of other brass parts that are not wheels, by body
OF_BRASS = """[geartrain.stages[0].world].flatMap(({ parts, palette }) => parts.filter(
  ({ plate, dial }) => plate && dial === undefined,
).map(({ slot, body }) => {
  const { r, g, b } = palette.looks[slot].colour.clone().convertLinearToSRGB();
  return [geartrain.scenes[0].bodies[body].id, [r, g, b].map((part) => Math.round(255 * part))];
}))"""


def test_what_is_no_wheel_has_the_colour_of_its_link_where_colours_tell_speeds(show: Opening) -> None:
    shown = show(SIMPLE)
    brass = shown.run(OF_BRASS)
    shown.page.get_by_label("Colours").select_option("speed")
    speeds = dict(shown.run(OF_BRASS))
    grey, turning = speeds["frame"], speeds["carrier"]
    assert max(grey) - min(grey) < 40, "plates that stand still look as if they turned"
    assert turning[2] > turning[0] + 40, "a carrier that turns as its sun does is not blue"
    shown.page.get_by_label("Colours").select_option("plain")
    assert shown.run(OF_BRASS) == brass


def test_losses_are_told_where_they_are_known(show: Opening) -> None:
    shown = show("norton-compound")
    shown.page.get_by_label("Colours").select_option("loss")
    assert "of the input power" in shown.page.locator(".legend").inner_text()
    tab(shown, "Wheels")
    wheel = next(wheel for wheel in shipped.built("norton-compound").wheels if wheel.loss)
    shown.page.locator(f"[data-wheel='{wheel.id}']").click()
    assert f"{100 * float(wheel.loss or 0):.3g} % of the input power" in shown.page.locator(".detail").inner_text()
    shown = show(SIMPLE)
    shown.page.get_by_label("Colours").select_option("loss")
    assert "declares no loads" in shown.page.locator(".legend").inner_text()


# area of the face of a disc with holes [mm^2], from its triangles; null for a wheel without holes
FACE = """((id) => {
  const { world } = geartrain.stages[0];
  const part = world.wheels[geartrain.scenes[0].wheels.findIndex((wheel) => wheel.id === id)];
  if (!part.wheel.holes.length) return null;
  const cast = [];
  part.castBody((shape) => cast.push(shape));
  const [shape] = cast;
  const { points, normals, indices } = shape;
  const at = (corner) => points.slice(3 * corner, 3 * corner + 3);
  let doubled = 0;
  for (let n = 0; n < indices.length; n += 3) {
    const [[ax, ay], [bx, by], [cx, cy]] = indices.slice(n, n + 3).map(at);
    if (normals[3 * indices[n] + 2] > 0) doubled += Math.abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay));
  }
  return doubled / 2;
})"""


def test_a_disc_has_holes_for_its_pins_in_place_of_arms(show: Opening) -> None:
    """The sectors with its teeth begin at 97 % of its root of 25 - 3 - 1.5 mm.

    A hole is as wide as its pin of 4 mm and two eccentricities of 1.5 mm.

    In its middle it sits on an eccentric of 12 mm; what runs in a hole has some play there, of 0.05 mm at most.
    """
    shown = show("cycloidal-reducer")
    minimum, most = (
        pi * ((0.97 * 20.5) ** 2 - 6 * (3.5 + backlash) ** 2 - (6 + backlash) ** 2) for backlash in (0.05, 0.0)
    )
    assert minimum < shown.run(f"{FACE}('lobes')") < most
    shown = show("rv-reducer")
    assert shown.run(f"{FACE}('lobes')") is not None


# for a train with one strain wave, after some turns: vertices of the wheel's teeth and of its cup's wall about its axis
BENT = """((turns) => {
  const { world } = geartrain.stages[0];
  if (turns !== null) geartrain.setTurns(turns);
  if (!world.cut) world.castTeeth();
  if (turns !== null) world.turn();
  const corners = (casting, slot) => {
    const { first, last } = casting.parts.find((part) => part.slot === slot);
    return [...casting.geometry.attributes.position.array.slice(3 * first, 3 * last)];
  };
  const wheel = world.wheels[world.scene.waves[0].wheel];
  const wall = world.parts.find((part) => part.wall);
  return [corners(world.castings[1], wheel.toothed), corners(world.castings[0], wall.slot)];
})"""


def test_a_thin_wheel_is_bent_where_its_wave_stands_and_its_cup_is_round_at_the_bottom(show: Opening) -> None:
    """After 1/8 turn the lobes are at 45 degrees, and the wheel has turned backwards by 0.45 degrees."""
    shown = show("strain-wave")
    standing = np.array(shown.run(f"{BENT}(null)")[0]).reshape(-1, 3)
    assert np.abs(standing[:, 0]).max() == pytest.approx(101.7, abs=0.01), "before it has been turned"
    assert np.abs(standing[:, 1]).max() == pytest.approx(99.7, abs=0.01)
    teeth, wall = (np.array(each).reshape(-1, 3) for each in shown.run(f"{BENT}('1/8')"))
    tips = np.hypot(*teeth[:, :2].T)
    at = np.degrees(np.arctan2(teeth[:, 1], teeth[:, 0])) % 180
    near = {lobe: np.abs((at - lobe - 0.45 + 90) % 180 - 90) < 1.0 for lobe in (45, 135)}
    assert tips[near[45]].max() == pytest.approx(101.7, abs=0.01)
    assert tips[near[135]].max() == pytest.approx(99.7, abs=0.01)
    outside = np.hypot(*wall[:, :2].T)
    bottom, mouth = (np.abs(wall[:, 2] - end(wall[:, 2])) < 0.01 for end in (np.max, np.min))
    assert np.ptp(outside[bottom & (outside > 98)]) < 0.01
    assert np.ptp(outside[mouth & (outside > 98)]) == pytest.approx(2.0, abs=0.1)
