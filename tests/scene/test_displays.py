"""Road wheels and figures, drives, and belts of a state."""

from __future__ import annotations

from math import hypot, isclose

import numpy as np
import pytest
import shipped

from geartrain import load
from geartrain.scene import make_scene

SPRING = """
extends: watch-going-train
name: with a spring
drive: {spring: {stiffness: 0.02 N m/rad, turns: 6%s}}
"""


def test_the_track_of_two_road_wheels_is_their_diameter_and_they_roll_below_all_wheels() -> None:
    scene = make_scene(shipped.train("south-pointing-chariot"))
    left, right = (part for part in scene.shapes if part.kind == "road")
    edges = [np.hypot(part.outlines[0][::2], part.outlines[0][1::2]).max() for part in (left, right)]
    assert isclose(edges[0], edges[1])
    assert np.linalg.norm(np.subtract(left.place, right.place)) == pytest.approx(2 * edges[0])
    ground = left.place[2] - edges[0]
    assert all(wheel.centre[2] - wheel.tip > ground for wheel in scene.wheels)
    assert scene.up == (0, 0, 1)


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        *(("planetary", "hand"), ("longcase-clock", "weight"), ("lathe-back-gear", "motor")),
        *(("mesh-sidebands", "motor"), (SPRING % "", "spring")),
    ],
)
def test_a_train_is_driven_by_what_it_declares(name: str, kind: str) -> None:
    scene = make_scene(load(name))
    assert scene.drive == kind
    assert not scene.fusee


def test_a_fusee_has_the_radii_that_its_torque_requires() -> None:
    """T = k w r/R with the wound angle w, which falls by r/R per angle: r w is constant for a constant torque."""
    scene = make_scene(load(SPRING % ", barrel: 15 mm, fusee: {turns: 5, torque: 0.27 N m}"))
    radii = np.array(scene.fusee)
    step = 5 * 2 * np.pi / (len(radii) - 1)
    wound = 6 * 2 * np.pi - np.concatenate([[0], np.cumsum((radii[1:] + radii[:-1]) / 2 * step / 15)])
    assert 0.02 * wound * radii / 15 == pytest.approx(np.full(len(radii), 0.27), rel=2e-3)


@pytest.mark.parametrize(("state", "belt"), [("1", "belt 1"), ("2", "belt 2"), ("6", "belt 3")])
def test_only_the_belt_in_force_is_drawn(state: str, belt: str) -> None:
    scene = make_scene(shipped.train("lathe-back-gear"), state)
    assert {part.name for part in scene.shapes if part.kind == "belt"} == {f"{belt} belt"}
    assert len([part for part in scene.shapes if part.kind == "pulley"]) == 6


def test_a_chain_over_a_freewheel_that_overruns_stays() -> None:
    scene = make_scene(shipped.train("retro-direct"), "forward")
    assert len({part.name for part in scene.shapes if part.kind == "belt"}) == 2


def test_a_figure_points_where_its_hand_would() -> None:
    scene = make_scene(shipped.train("south-pointing-chariot"))
    body, arm = (part for part in scene.shapes if part.kind == "figure")
    assert np.allclose(body.direction, scene.up)
    assert np.allclose(arm.direction, (0, 1, 0))
    assert hypot(*np.subtract(body.place, arm.place)[:2]) == 0
