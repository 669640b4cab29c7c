"""The tooth of an escape wheel: points on a circle, faces that lean the way it turns, one shape drawn and cut."""

from __future__ import annotations

from math import atan2, cos, degrees, sin
from typing import Any

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate
from shipped import train as load

from geartrain import load as load_text
from geartrain.scene import ManufacturingSizes, SolidModel, make_scene


def lean(blank: Any, sense: int) -> float:
    """Angle (deg) of the leading face of one tooth from the radius of its point, above 0 where the point is ahead."""
    tooth, tip, root = blank.contours[0].points[:4], blank.tip_radius, blank.root_radius
    angles, radii = sense * np.arctan2(*tooth.T[::-1]), np.hypot(*tooth.T)
    head = max(angle for angle, r in zip(angles, radii, strict=True) if abs(r - tip) < 1e-9)
    foot = max(angle for angle, r in zip(angles, radii, strict=True) if abs(r - root) < 1e-9)
    ahead = head - foot
    return degrees(atan2(root * sin(ahead), tip - root * cos(ahead)))


@pytest.mark.parametrize(("z", "sense"), [(30, 1), (30, -1), (15, 1), (12, -1), (5, 1), (3, -1)])
def test_an_escape_wheel_has_its_teeth_evenly_and_its_tips_on_a_circle(z: int, sense: int) -> None:
    train = load_text(
        f"""
links: {{frame: {{}}, a: {{wheels: {{w: 40}}}}, e: {{wheels: {{p: 8, points: {z}}}}}}}
revolutes: {{A: [frame, a], E: [frame, e]}}
gears: [w ~ p]
inputs: {{a: {-sense}}}
escapement: {{link: e, teeth: {z}, beat: 1 s}}
"""
    )
    blank = SolidModel(train, ManufacturingSizes()).blanks.wheels["points"]
    shape = shapely.Polygon(blank.contours[0].flattened(1e-4))
    assert shape.is_valid
    assert shape.exterior.is_ccw
    turned = rotate(shape, 360 / z, origin=(0, 0))
    assert shape.symmetric_difference(turned).area < 1e-3
    tip, root = blank.tip_radius, blank.root_radius
    assert shape.hausdorff_distance(shapely.Point(0, 0)) == pytest.approx(tip, abs=1e-6)
    assert shapely.Point(0, 0).distance(shape.exterior) == pytest.approx(root, abs=1e-3)
    ring = shapely.Point(0, 0).buffer(0.9995 * tip, quad_segs=720).exterior.intersection(shape)
    assert len(ring.geoms) in (z, z + 1), "so many points, one of them perhaps cut where the ring begins"
    assert lean(blank, sense) == pytest.approx(6.0, abs=1e-9)


@pytest.mark.parametrize("name", ["longcase-clock", "longcase-clock-cycloidal"])
def test_the_escape_wheel_of_a_train_leans_the_way_it_turns(name: str) -> None:
    train = load(name)
    escapement = train.declaration.escapement
    assert escapement is not None
    work = SolidModel(train, ManufacturingSizes())
    (blank,) = (each for each in work.blanks.wheels.values() if (each.link, each.teeth) == (escapement.link, 30))
    sense = 1 if train.solve().speeds[escapement.link] > 0 else -1
    assert lean(blank, sense) == pytest.approx(6.0, abs=1e-9)
    assert blank.tip_radius == pytest.approx(blank.pitch_radius)
    assert len(blank.contours[0].points) == 4 * 30
    assert any("no anchor is declared" in each.why for each in work.blanks.notices)
    scene = make_scene(train)
    (drawn,) = (wheel for wheel in scene.wheels if wheel.id == blank.wheel)
    assert scene.profiles[drawn.profile].form == "escapement"


# a pinion of 12 in a ring of 120, carried round at 1: relative to its carriage it turns 10 times as fast as the ring
@pytest.mark.parametrize(("ring", "speed", "passed"), [("9/10", 0, -1), ("19/20", 0.5, -0.5), ("11/10", 2, 1)])
def test_a_carried_escape_wheel_leans_as_it_turns_on_its_carriage(ring: str, speed: float, passed: float) -> None:
    train = load_text(
        f"""
frame: plate
links:
  plate: {{}}
  ring: {{wheels: {{r: {{teeth: 120, internal: true}}}}}}
  carriage: {{}}
  escape: {{wheels: {{e: 12, points: 20}}}}
revolutes: {{C: [plate, ring, carriage], E: [carriage, escape]}}
gears: [r ~ e]
inputs: {{carriage: 1, ring: {ring}}}
escapement: {{link: escape, teeth: 20, beat: 1 s}}
"""
    )
    assert train.solve()["escape"] == speed
    (blank,) = (each for each in SolidModel(train, ManufacturingSizes()).blanks.wheels.values() if each.teeth == 20)
    assert lean(blank, 1 if passed > 0 else -1) == pytest.approx(6.0, abs=1e-9)


def test_a_wheel_without_mate_is_a_disc_where_no_escapement_names_it() -> None:
    train = load("price-1974")
    work = SolidModel(train, ManufacturingSizes())
    meshed = {name for gear in train.declaration.gears for name in gear.pair}
    for name, blank in work.blanks.wheels.items():
        assert blank.contours[0].is_circle == (name not in meshed)
