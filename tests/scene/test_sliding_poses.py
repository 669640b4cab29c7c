"""Poses of links that slide, in scenes and in animations."""

from __future__ import annotations

import json
import struct
from fractions import Fraction
from math import cos, pi, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
import shipped
from commands import call

import geartrain
from geartrain.scene import Scene, make_scene
from geartrain.scene.pose import scene_pose


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
