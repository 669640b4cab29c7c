"""Train cut open: a quarter of rings that hide stages is not drawn, and all other parts are unchanged."""

from __future__ import annotations

import numpy as np
import pytest
from viewing import SIMPLE, Opening, picture, wait

TWO_RINGS = "wolfrom-175"
PICTURE = """() => {
  const [stage] = geartrain.stages;
  stage.render();
  return stage.canvas.toDataURL('image/png');
}"""
# a picture from a side, opaque parts drawn from the front (0) or from both sides (2)
SIDED = """([side, towards]) => {
  const [stage] = geartrain.stages;
  stage.world.materials[0].side = side;
  stage.fit(stage.camera.position.clone().set(...towards).normalize());
  stage.render();
  return stage.canvas.toDataURL('image/png');
}"""
# first wheel on a line parallel to the axis of most rings, at a given radius and angle from the right
MET = """([radius, degrees]) => {
  const [stage] = geartrain.stages, [scene] = geartrain.scenes, {world, camera} = stage;
  const Vector = camera.position.constructor, angle = degrees * Math.PI / 180;
  const towards = new Vector(0, 0, scene.front);
  const [x, y] = [scene.front * radius * Math.cos(angle), radius * Math.sin(angle)];
  const origin = new Vector(x, y, 0).addScaledVector(towards, 1e3);
  const met = world.pick(Object.assign(stage.hands.ray.ray.clone(), {origin, direction: towards.clone().negate()}));
  return met === null ? null : scene.wheels[met].id;
}"""


@pytest.mark.parametrize(("name", "opened"), [(TWO_RINGS, True), (SIMPLE, False)])
def test_rings_before_each_other_are_cut_open_and_a_lone_one_is_whole(show: Opening, name: str, opened: bool) -> None:
    shown = show(name)
    assert shown.page.get_by_label("Cut open").is_checked() is opened
    assert shown.run("geartrain.stages[0].world.opened") is opened


# triangles of a frame as three.js counts them, and of the visible parts, with the insides of those that are cut open
DRAWN = """() => {
  const [stage] = geartrain.stages, {castings, palette, opened, ground} = stage.world;
  stage.render();
  const shown = castings.flatMap(({parts}) => parts ?? []).filter(({slot}) => palette.looks[slot].shown);
  const cut = shown.filter(({slot}) => opened && palette.looks[slot].opened && palette.looks[slot].opacity === 1);
  const count = (parts) => parts.reduce((sum, {from, to}) => sum + (to - from) / 3, 0);
  return [stage.renderer.info.render.triangles, count(shown) + count(cut) + ground.mesh.geometry.index.count / 3];
}"""


def test_a_train_without_rings_cannot_be_cut_open(show: Opening) -> None:
    assert not show("worm").page.get_by_label("Cut open").is_visible()


def test_what_is_cut_out_lies_in_the_quarter_and_one_taps_through_it(show: Opening) -> None:
    shown = show(TWO_RINGS)
    shown.page.get_by_label("Teeth").check()
    wait(shown, "geartrain.stages[0].world.cut")
    shown.page.get_by_role("button", name="Front", exact=True).click()
    ring = shown.run("geartrain.scenes[0].wheels.find(({kind}) => kind === 'ring')")
    beyond = (ring["radius"] + ring["root"]) / 2 + 0.3 * ring["module"]
    met = [shown.run(MET, [beyond, degrees]) for degrees in (45, 135, 225, 315)]
    assert met[0] is None
    assert None not in met[1:]
    cut = picture(shown.run(PICTURE))
    shown.page.get_by_label("Cut open").uncheck()
    assert shown.run(MET, [beyond, 45]) is not None
    whole = picture(shown.run(PICTURE))
    changed = np.abs(cut - whole).sum(axis=2) > 60
    axis = shown.run(
        "(([{camera, world}]) => world.quarter.at.clone().project(camera).toArray().slice(0, 2))(geartrain.stages)"
    )
    high, wide = changed.shape
    column, row = (1 + axis[0]) / 2 * wide, (1 - axis[1]) / 2 * high
    margin = 0.04 * high  # planes parallel to the axis are visible in perspective
    rows, columns = np.nonzero(changed)
    outside = (columns < column - margin) | (rows > row + margin)
    assert 0.02 < changed.mean() < 0.25
    assert outside.sum() < 1e-3 * changed.size, "but for single points on edges of teeth"


def test_backs_of_closed_bodies_need_not_be_drawn(show: Opening) -> None:
    """Cones of both hands, whose outlines have both senses, face outwards: their inside is visible from no side."""
    shown = show("bevel-differential")
    shown.page.get_by_label("Teeth").check()
    wait(shown, "geartrain.stages[0].world.cut")
    for towards in ((0.4, 0.3, 0.9), (-0.4, 0.3, -0.9), (0.9, 0.2, -0.3)):
        front, both = (picture(shown.run(SIDED, [side, towards])) for side in (0, 2))
        differs = np.abs(front - both).max(axis=2) > 40
        assert differs.mean() < 0.002, "but for single points on edges"


def test_visible_parts_are_drawn_once_and_hidden_ones_not_at_all(show: Opening) -> None:
    shown = show(TWO_RINGS, teeth=True)
    counts = []
    for name in (None, "Teeth", "Cut open"):
        if name is not None:
            shown.page.get_by_label(name).uncheck()
        drawn, visible = shown.run(DRAWN)
        assert drawn == visible, name
        counts.append(drawn)
    assert counts == sorted(counts, reverse=True), "teeth and insides are no longer drawn"
    shown.run("() => { const {world} = geartrain.stages[0]; world.meshOf = () => 0; world.arranged = false; }")
    drawn, visible = shown.run(DRAWN)
    assert drawn > visible, "the count notices hidden parts"
