"""Teeth of a scene as plane figures: they touch and do not overlap."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import pi
from typing import Any

import numpy as np
import pytest
from shapely.geometry import Point, Polygon
from shapely.ops import unary_union
from test_scene_movement import Reader

from geartrain import GearTrain, load
from geartrain.scene import Scene, make_scene


def outline(scene: Scene, number: int, turned: float) -> Any:
    """Return a wheel about its centre, rotated by an additional angle; a ring is a disc with a toothed hole."""
    wheel = scene.wheels[number]
    profile = scene.profiles[wheel.profile]
    x, y, _ = wheel.centre
    base = np.arctan2(wheel.reference[1], wheel.reference[0])
    r, angle = np.array(profile.points).T
    teeth = []
    for k in range(wheel.teeth):
        at = base + wheel.direction[2] * (wheel.turn + turned + 2 * pi * k / wheel.teeth + angle)
        teeth.append(np.column_stack([x + r * wheel.radius * np.cos(at), y + r * wheel.radius * np.sin(at)]))
    if profile.hole:
        return unary_union([Polygon(tooth) for tooth in teeth])
    whole = Polygon(np.concatenate([tooth[:-1] for tooth in teeth]))  # adjacent teeth share an end point
    return Point(x, y).buffer(1.5 * wheel.radius, 128).difference(whole) if wheel.kind == "ring" else whole


def meshing(train: GearTrain, steps: int = 12) -> tuple[float, float]:
    """Return the maximum overlap and the maximum gap of all pairs over one pitch [modules]."""
    scene = make_scene(train)
    reader, bodies = Reader(scene), scene.bodies
    deepest = widest = 0.0
    for pair in scene.pairs:
        wheel = scene.wheels[pair.wheels[0]]
        own, base = (Fraction(bodies[at].speed or 0) for at in (wheel.body, pair.carrier))
        for k in range(steps):
            angles = reader.angles(0.137 + k / steps / wheel.teeth / abs(float(own - base)))
            first, second = (
                outline(scene, at, angles[scene.wheels[at].body] - angles[pair.carrier]) for at in pair.wheels
            )
            deepest = max(deepest, depth(first.intersection(second)) / wheel.module)
            widest = max(widest, first.distance(second) / wheel.module)
    return deepest, widest


def depth(common: Any) -> float:
    """Return the maximum thickness of the overlap of two wheels: twice its inradius, by bisection."""
    low, high = 0.0, 10.0
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (low, middle) if common.buffer(-middle).is_empty else (middle, high)
    return 2 * high


def pair_of(z1: int, z2: int, form: Mapping[str, Any], **more: Any) -> GearTrain:
    ring = more.pop("ring", False)
    return GearTrain.declare(
        {
            "links": {
                "frame": {},
                "a": {"wheels": {"p": z1}, **more.pop("a", {})},
                "b": {"wheels": {"q": {"teeth": z2, "internal": ring}}, **more.pop("b", {})},
            },
            "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
            "gears": [{"pair": ["p", "q"], "tooth_form": form, **more.pop("gear", {})}],
            "inputs": {"a": 1},
            **more,
        }
    )


TRIANGULAR = {"form": "triangular", "half_angle": "30 deg", "clearance_factor": "1.01"}


@pytest.mark.parametrize(
    "train",
    [
        pair_of(64, 38, TRIANGULAR),
        pair_of(38, 64, TRIANGULAR, inputs={"a": -1}),
        pair_of(24, 60, TRIANGULAR, gear={"phase": "0.3"}),
        pair_of(24, 60, TRIANGULAR, gear={"driver": "q", "phase": "0.3"}),
        pair_of(30, 41, TRIANGULAR, a={"angle": "17 deg"}, b={"angle": "5 deg"}),
    ],
    ids=["64/38", "backwards", "a phase", "the second drives", "starting angles"],
)
def test_triangular_teeth_touch_at_every_instant_and_never_cut_into_each_other(train: GearTrain) -> None:
    deep, gap = meshing(train)
    assert deep < 1e-6
    assert gap < 1e-6


@pytest.mark.parametrize(
    "train",
    [
        pair_of(24, 60, {"form": "involute"}),
        pair_of(24, 60, {"form": "involute", "backlash": "0.1"}),
        pair_of(40, 25, {"form": "involute", "centre_distance": "32.8"}),
        pair_of(20, 60, {"form": "involute", "addendum": [1, 0.8]}, ring=True),
        pair_of(12, 60, {"form": "cycloidal"}, inputs={"a": -1}),
        pair_of(48, 12, {"form": "lantern"}),
        pair_of(30, 20, {"form": "involute", "backlash": "0.1"}, b={"angle": "100 deg"}),
    ],
    ids=["plain", "play", "apart", "ring", "cycloidal", "lantern", "starting angle"],
)
def test_conjugate_teeth_touch_and_do_not_cut_beyond_their_chords(train: GearTrain) -> None:
    deep, gap = meshing(train)
    assert deep < 5e-3
    assert gap < 5e-3


def test_likenesses_mesh_without_cutting_into_each_other() -> None:
    for z1, z2, ring in ((24, 60, False), (8, 8, False), (224, 12, False), (20, 60, True), (50, 60, True)):
        deep, gap = meshing(pair_of(z1, z2, {"form": "ideal"}, ring=ring), steps=5)
        assert deep < 1e-6
        assert gap < 0.1


def test_a_bent_wheel_stands_about_its_generator_and_its_wave_rises_by_a_module() -> None:
    """Two lobes, for two teeth more of 1 mm; a wall of 1.2 % of 200 mm under roots at 100 - 0.9 mm.

    That tips of rigid wheels would run into each other is no fault of a wave.
    """
    scene = make_scene(load("strain-wave"))
    (wave,) = scene.waves
    spline, ring = scene.wheels[wave.wheel], scene.wheels[0]
    assert (spline.id, scene.bodies[wave.by].id, wave.lobes) == ("spline", "generator", 2)
    assert (wave.rise, wave.wall, wave.middle) == pytest.approx((1.0, 2.4, 99.1 - 1.2))
    assert spline.centre == pytest.approx(ring.centre)
    assert scene.bodies[spline.body].parent == scene.bodies[wave.by].parent
    assert not scene.notices


def test_a_flexible_wheel_that_nothing_bends_is_drawn_round_which_is_said() -> None:
    text = "links: {frame: {}, a: {wheels: {a20: {teeth: 20, flexible: true}}}, b: {wheels: {b30: 30}}}\n"
    text += "revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]\n"
    text += "gears: [{pair: [a20, b30]}]\ninputs: {a: 1}\nframe: frame\nname: stiff\n"
    scene = make_scene(load(text))
    assert not scene.waves
    assert "flexible wheel 'a20' is drawn undeformed" in [notice["what"] for notice in scene.notices]
