"""Trains as trees of coupled joints: the rates of the joints of URDF and MJCF files give the speeds of all links."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from commands import call
from workpieces import workpiece

from geartrain.scene import SolidModel
from geartrain.workshop import train_file

Speeds = dict[str, np.ndarray]


def angular_speeds(work: SolidModel) -> Speeds:
    """Angular velocities of all links, from their exact speeds about their declared axes."""
    answer, axes = work.train.solve(work.state), work.layout.axes
    tree = work.train.kinematics.tree
    found: Speeds = {work.train.declaration.frame: np.zeros(3)}
    for link in work.train.declaration.links:
        if label := tree.axis(link):
            found[link] = float(Fraction(answer[link])) * np.array(axes[label].direction)
    return found


def vector(text: str | None) -> np.ndarray:
    return np.array([float(each) for each in (text or "0 0 0").split()])


ONE_INPUT = ["planetary", "nrel-grc-750", "zf-8hp70", "norton-compound", "moon-triangular", "worm", "rv-reducer"]


@pytest.mark.parametrize("name", ONE_INPUT)
def test_mimic_joints_of_urdf_add_up_to_the_speeds_of_the_links(name: str) -> None:
    work = workpiece(name)
    robot = ET.fromstring(train_file(work, "urdf"))
    joints = {joint.get("name") or "": joint for joint in robot.iter("joint") if joint.find("child") is not None}
    expected = angular_speeds(work)
    (driver,) = [link for link, speed in work.train.declaration.case(work.state).inputs.items() if speed]
    assert joints[driver].find("mimic") is None
    # the input turns on the frame
    assert {"link": work.train.declaration.frame} == joints[driver].find("parent").attrib  # type: ignore[union-attr]
    rate = float(expected[driver] @ vector(joints[driver].find("axis").get("xyz")))  # type: ignore[union-attr]
    speeds: Speeds = {work.train.declaration.frame: np.zeros(3)}
    places: Speeds = {work.train.declaration.frame: np.zeros(3)}
    while len(speeds) < len(joints) + 1:
        for link, joint in joints.items():
            given = {child.tag: child.attrib for child in joint}
            above = given["parent"]["link"]
            mimic = given.get("mimic", {"joint": driver, "multiplier": "1", "offset": "0"})
            if link in speeds or above not in speeds:
                continue
            assert (mimic["joint"], mimic["offset"]) == (driver, "0")
            own = 0.0 if joint.get("type") == "fixed" else rate * float(mimic["multiplier"])
            speeds[link] = speeds[above] + own * vector(given["axis"]["xyz"])
            places[link] = places[above] + vector(given["origin"]["xyz"])
    assert {link.get("name") for link in robot.iter("link") if link.get("name")} == set(speeds)
    for link, speed in expected.items():
        assert speeds[link] == pytest.approx(speed, rel=1e-12, abs=1e-12 * abs(rate)), link
        label = work.train.kinematics.tree.axis(link)
        if label:
            assert 1000 * places[link] == pytest.approx(np.array(work.layout.axes[label].point), abs=1e-8)


@pytest.mark.parametrize("name", [*ONE_INPUT, "prius-power-split", "ravigneaux-set"])
def test_constraints_of_mjcf_hold_at_the_speeds_and_leave_the_inputs_free(name: str) -> None:
    work = workpiece(name)
    model = ET.fromstring(train_file(work, "mjcf"))
    expected, rates = angular_speeds(work), {}
    queue = [(body, work.train.declaration.frame) for body in model.findall("worldbody/body")]
    for body, parent in queue:
        link, hinge = body.get("name") or "", body.find("joint")
        assert hinge is not None
        # the rate of a joint is the difference of the angular velocities of its bodies
        relative = expected[link] - expected[parent]
        rates[link] = float(relative @ vector(hinge.get("axis")))
        assert rates[link] * vector(hinge.get("axis")) == pytest.approx(relative, rel=1e-12, abs=1e-12)
        queue += [(child, link) for child in body.findall("body")]
    names = [*rates]
    rows = []
    for equality in model.findall("equality/joint"):
        row = dict.fromkeys(names, 0.0)
        row[equality.get("joint1") or ""] = 1.0
        offset, slope, *rest = map(float, (equality.get("polycoef") or "").split())
        assert (offset, rest) == (0.0, [0.0] * 3)
        if second := equality.get("joint2"):
            row[second] = -slope
        rows.append([*row.values()])
    for tendon in model.findall("tendon/fixed"):
        terms = {joint.get("joint") or "": float(joint.get("coef") or "") for joint in tendon.findall("joint")}
        row = dict.fromkeys(names, 0.0) | terms
        assert model.find(f"equality/tendon[@tendon1='{tendon.get('name')}']") is not None
        rows.append([*row.values()])
    matrix, vector_of_rates = np.array(rows), np.array([rates[each] for each in names])
    assert matrix @ vector_of_rates == pytest.approx(0, abs=1e-11 * max(1.0, abs(vector_of_rates).max()))
    inputs = work.train.declaration.case(work.state).inputs
    assert len(names) - np.linalg.matrix_rank(matrix) == len(inputs)
    assert [each.get("joint") for each in model.findall("actuator/velocity")] == [*inputs]


def test_a_simple_pair_has_the_ratio_of_its_teeth_in_both_formats() -> None:
    """Wheels of 45 and 225 teeth: the second turns at -45/225 of the first."""
    work = workpiece("moon-triangular")
    robot, model = (ET.fromstring(train_file(work, kind)) for kind in ("urdf", "mjcf"))
    mimic = robot.find("joint[@name='sun']/mimic")
    assert mimic is not None
    assert mimic.attrib == {"joint": "crank", "multiplier": "-0.2", "offset": "0"}
    pair = model.find("equality/joint[@name='a~b1']")
    assert pair is not None
    assert (pair.get("joint1"), pair.get("joint2"), pair.get("polycoef")) == ("crank", "sun", "0 -5.0 0 0 0")


def test_a_file_is_written_or_refused_by_name(tmp_path: Path) -> None:
    assert call("export", "planetary", "-o", tmp_path / "set.urdf").exit_code == 0
    assert call("export", "planetary", "-o", tmp_path / "set.xml").exit_code == 0
    refused = call("export", "prius-power-split", "-o", tmp_path / "two.urdf")
    assert refused.exit_code == 2
    assert "the number of moving inputs is 2" in refused.output
    assert "write MJCF" in refused.output
    assert "link 'ram' slides" in call("export", "screw-jack", "-o", tmp_path / "jack.xml").output
    noted = call("export", "carman-thorndike-evans-2012", "-o", tmp_path / "pins.xml").output
    assert "is written with its mean ratio" in noted


def test_bevels_on_a_moving_axis_roll_on_each_other() -> None:
    """Pitch lines from the apex through (10, 16) and (10, -16): with the axes of the side wheel along x and of the
    spiders along y, equal velocities there require 16 (w_left - w_crown) = -10 q, and 10 q for the second spider.
    """
    model = ET.fromstring(train_file(workpiece("bevel-differential"), "mjcf"))
    assert [vector(model.find(f".//joint[@name='{each}']").get("axis"))[1] for each in ("spider", "spider.2")] == [1, 1]  # type: ignore[union-attr]
    for pair, spider, coefficient in (("l16~p10", "spider", 10 / 16), ("l16~p10.2", "spider.2", -10 / 16)):
        row = {each.get("joint"): each.get("coef") for each in model.findall(f"tendon/fixed[@name='{pair}']/joint")}
        assert row == {"left": "1.0", spider: str(coefficient), "crown": "-1.0"}
