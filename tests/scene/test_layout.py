"""Layouts of all shipped trains: wheels touch, roll, do not collide, and have their declared positions."""

from __future__ import annotations

import cmath
import itertools
import math
import random
from collections.abc import Iterator

import numpy as np
import pytest
import shipped
from places import train_files
from shapely.geometry import Point

import geartrain
from geartrain.scene import Layout, WheelPlace, lay_out

NAMES = sorted(path.stem for path in train_files())
Z = np.array([0.0, 0.0, 1.0])


def load(name: str) -> tuple[geartrain.GearTrain, Layout]:
    return shipped.train(name).unfolded, shipped.layout(name)


def named(layout: Layout, *names: str) -> bool:
    told = [notice for notice in layout.notices if "pitch circles of" in notice.what]
    return any(all(f"'{name}'" in notice.what for name in names) for notice in told)


def way(layout: Layout, wheel: WheelPlace) -> np.ndarray:
    return np.array(layout.axes[wheel.axis].direction)


def touching(layout: Layout, first: WheelPlace, second: WheelPlace) -> tuple[np.ndarray, float, bool]:
    """Return the common point of two pitch circles, their distance from it, and True if their axes are parallel."""
    u, v = way(layout, first), way(layout, second)
    a, b = np.array(first.centre), np.array(second.centre)
    if np.linalg.norm(np.cross(u, v)) < 1e-12:
        b = b + u * ((a - b) @ u)  # the middle of a broadened wheel is at another height
        line = (b - a) / (np.linalg.norm(b - a) or 1.0)
        ends = [(a + s * first.radius * line, b + t * second.radius * line) for s in (1, -1) for t in (1, -1)]
    else:
        e, f = v - (u @ v) * u, u - (u @ v) * v
        e, f = e / np.linalg.norm(e), f / np.linalg.norm(f)
        ends = [(a + s * first.radius * e, b + t * second.radius * f) for s in (1, -1) for t in (1, -1)]
    p, q = min(ends, key=lambda each: float(np.linalg.norm(each[0] - each[1])))
    return (p + q) / 2, float(np.linalg.norm(p - q)), bool(np.linalg.norm(np.cross(u, v)) < 1e-12)


def sense(train: geartrain.GearTrain, label: str) -> np.ndarray:
    """Return the direction that defines the sign of speeds on an axis: that of the first parallel axis."""
    ways = [Z, *(np.array([float(part.value) for part in axis.direction]) for axis in train.declaration.axes.values())]
    own = train.declaration.axes.get(label)
    mine = Z if own is None else np.array([float(part.value) for part in own.direction])
    return next(each for each in ways if np.linalg.norm(np.cross(each, mine)) < 1e-12) / np.linalg.norm(mine)


@pytest.mark.parametrize("name", shipped.every_train(NAMES))
def test_pitch_circles_of_wheels_in_mesh_touch_and_roll(name: str) -> None:
    train, layout = load(name)
    gears = [circuit for circuit in train.circuits if circuit.kind == "gear"]
    assert len(gears) == len(train.declaration.gears)
    triangular = {mesh.name for mesh in train.meshes if mesh.form == "triangular"}
    for circuit in gears:
        first, second = (layout.wheels[wheel] for wheel in circuit.wheels)
        if named(layout, first.wheel, second.wheel):
            assert circuit.id in layout.apart
            continue
        assert circuit.id not in layout.apart
        kinds = [train.declaration.wheels[wheel][1] for wheel in circuit.wheels]
        # in the frame of the carrier, with one turn of the second wheel
        spins = [float(circuit.ratio) * sense(train, first.axis), sense(train, second.axis)]
        if "worm" in (kinds[0].kind, kinds[1].kind):
            if kinds[0].kind != "worm":
                first, second, kinds, spins = second, first, kinds[::-1], spins[::-1]
            starts = (kinds[0].count or 0) * (-1 if kinds[0].hand == "left" else 1)
            rolls_on_a_worm(layout, first, second, starts, spins)
            continue
        if any(kind.is_helical for kind in kinds) and np.linalg.norm(np.cross(*spins)) > 1e-12:
            slides_along_its_mate(layout, first, second, kinds[0].helix, spins)
            continue
        point, miss, parallel = touching(layout, first, second)
        if circuit.id in triangular and miss > 1e-6:
            assert miss < 0.1 * (first.radius + second.radius), "their law says how far, not their pitch circles"
            continue
        assert miss < (1e-9 if parallel else 1e-6) * (first.radius + second.radius)
        speeds = [
            np.cross(spin, point - np.array(wheel.centre)) for spin, wheel in zip(spins, (first, second), strict=True)
        ]
        assert np.linalg.norm(speeds[0]) == pytest.approx(second.radius, rel=1e-6)
        assert speeds[0] == pytest.approx(speeds[1], abs=1e-6 * second.radius)


def slides_along_its_mate(
    layout: Layout, first: WheelPlace, second: WheelPlace, helix: float, spins: list[np.ndarray]
) -> None:
    """Assert that helical wheels on skew axes touch at the common perpendicular, with equal normal speeds."""
    apart = np.array(second.centre) - np.array(first.centre)
    assert np.linalg.norm(apart) == pytest.approx(first.radius + second.radius, rel=1e-9)
    u, v = way(layout, first), way(layout, second)
    assert abs(apart @ u) + abs(apart @ v) < 1e-9 * second.radius
    out = apart / np.linalg.norm(apart)
    across = np.cross(out, np.cos(helix) * u + np.sin(helix) * np.cross(u, out))
    speeds = [np.cross(spins[0], first.radius * out) @ across, np.cross(spins[1], -second.radius * out) @ across]
    assert speeds[0] == pytest.approx(speeds[1], abs=1e-6 * second.radius)
    assert abs(speeds[0]) > 0.1


def rolls_on_a_worm(layout: Layout, worm: WheelPlace, wheel: WheelPlace, starts: int, spins: list[np.ndarray]) -> None:
    """Assert that the thread of a worm moves along its axis like the wheel's teeth, backwards if right-handed."""
    u, v = way(layout, worm), way(layout, wheel)
    apart = np.array(worm.centre) - np.array(wheel.centre)
    assert abs(apart @ u) + abs(apart @ v) < 1e-9 * wheel.radius
    assert np.linalg.norm(apart) == pytest.approx(worm.radius + wheel.radius, rel=1e-9)
    at = apart * wheel.radius / np.linalg.norm(apart)
    thread = -(spins[0] @ u) * starts * worm.module / 2
    assert np.cross(spins[1], at) @ u == pytest.approx(thread, rel=1e-9)


def poses(train: geartrain.GearTrain, layout: Layout, count: int) -> Iterator[dict[str, np.ndarray]]:
    """Yield positions of axes in plan for arbitrary angles of all carriers about their axes."""
    dice = random.Random(1)
    carriers = sorted({axis.carrier for axis in layout.axes.values()} - {train.declaration.frame})

    def carried(label: str, point: np.ndarray, angles: dict[str, float]) -> np.ndarray:
        bearer = layout.axes[label].carrier
        while bearer != train.declaration.frame:
            pivot = layout.axes[train.kinematics.tree.axis(bearer) or ""]
            c, s = math.cos(angles[bearer]), math.sin(angles[bearer])
            x, y = point[:2] - np.array(pivot.point[:2])
            point = np.array(pivot.point[:2]) + np.array([c * x - s * y, s * x + c * y])
            bearer = pivot.carrier
        return point[:2]

    for _ in range(count if carriers else 1):
        angles = {carrier: dice.uniform(0, math.tau) for carrier in carriers}
        yield {label: carried(label, np.array(axis.point), angles) for label, axis in layout.axes.items()}


@pytest.mark.parametrize("name", shipped.every_train(NAMES))
def test_no_two_wheels_of_one_height_overlap_while_carriers_turn(name: str) -> None:
    train, layout = load(name)
    upright = [wheel for wheel in layout.wheels.values() if abs(way(layout, wheel)[2]) == 1 and not wheel.cone]
    mates = {frozenset(gear.pair) for gear in train.declaration.gears}
    pairs = [
        (a, b)
        for a, b in itertools.combinations(upright, 2)
        if frozenset((a.wheel, b.wheel)) not in mates
        and abs(a.centre[2] - b.centre[2]) < (a.thickness + b.thickness) / 2 * (1 - 1e-9)
    ]
    for places in poses(train, layout, 8):
        for a, b in pairs:
            discs = []
            for wheel in (a, b):
                internal = train.declaration.wheels[wheel.wheel][1].internal
                disc = Point(*places[wheel.axis]).buffer(wheel.radius + (2 if internal else 0.9) * wheel.module, 24)
                hole = Point(*places[wheel.axis]).buffer(wheel.radius - 0.9 * wheel.module, 24)
                discs.append(disc.difference(hole) if internal else disc)
            assert discs[0].intersection(discs[1]).area < 1e-6, (a.wheel, b.wheel)


@pytest.mark.parametrize("name", shipped.every_train(NAMES))
def test_a_tooth_stands_before_a_space_in_every_mesh(name: str) -> None:
    train, layout = load(name)
    for gear in train.declaration.gears:
        first, second = (layout.wheels[wheel] for wheel in gear.pair)
        kinds = [train.declaration.wheels[wheel][1] for wheel in gear.pair]
        ways = way(layout, first), way(layout, second)
        skew = any(kind.is_helical for kind in kinds) and np.linalg.norm(np.cross(*ways)) > 1e-12
        if gear.name in layout.apart or skew or "worm" in (kinds[0].kind, kinds[1].kind):
            continue
        if any("teeth" in notice.what and f"'{gear.name}'" in notice.what for notice in layout.notices):
            continue
        point, _, _ = touching(layout, first, second)
        along = np.cross(way(layout, first), point - np.array(first.centre))
        along /= np.linalg.norm(along)
        past = []
        for wheel, kind in ((first, kinds[0]), (second, kinds[1])):
            u, x = way(layout, wheel), np.array(wheel.reference)
            out = point - np.array(wheel.centre)
            angle = math.atan2(out @ np.cross(u, x), out @ x)
            teeth = (wheel.turn - angle) * (kind.count or 0) / math.tau
            past.append(teeth * np.sign(np.cross(u, out) @ along))
        assert math.remainder(past[0] - past[1] - 0.5, 1.0) == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("name", shipped.every_train(NAMES))
def test_declared_positions_and_modules_hold_and_notices_say_what_why_and_what_to_do(name: str) -> None:
    train, layout = load(name)
    for label, axis in train.declaration.axes.items():
        if axis.position is not None and label in layout.axes:
            assert layout.axes[label].how == "given"
            assert layout.axes[label].point == pytest.approx(
                [float(part.si) * 1000 for part in axis.position], rel=1e-15
            )
    for wheel, (_, kind) in train.declaration.wheels.items():
        if kind.module is not None and kind.module.unit:
            assert layout.wheels[wheel].module == pytest.approx(kind.module.si * 1000 * kind.slant, rel=1e-15)
            assert layout.wheels[wheel].given
        assert layout.wheels[wheel].radius > 0
    for notice in layout.notices:
        assert notice.what
        assert notice.why
        assert notice.fix
    assert layout.front == (-1 if train.declaration.view.positive == "clockwise" else 1)


@pytest.mark.parametrize("name", ["longcase-clock", "pennestri-2002-teeth", "humpage", "freeth-2021"])
def test_a_train_read_again_is_laid_out_the_same(name: str) -> None:
    assert lay_out(geartrain.load(name)) == load(name)[1]


def test_axes_of_pins_stand_as_far_apart_as_declared() -> None:
    _, layout = load("freeth-2021")
    for first, second, far in (("K1", "K2", 1.1), ("ME20", "B", 36), ("R1", "B", 27.8), ("MA71", "MA80", 6.58)):
        a, b = (layout.axes[label].point for label in (first, second))
        assert math.dist(a[:2], b[:2]) == pytest.approx(far, rel=1e-9)


@pytest.mark.slow
def test_trains_that_cannot_be_laid_out_as_declared_are_these() -> None:
    """Their pairs require different distances of the same axes; in all other trains all pitch circles touch."""
    said = {name: [notice.what for notice in load(name)[1].notices] for name in NAMES}
    assert {name for name in NAMES if load(name)[1].apart} == {"ferguson-paradox", "prague-orloj", "prius-power-split"}
    assert [name for name in NAMES if any("wheels collide" in what for what in said[name])] == []
    assert [name for name in NAMES if any("teeth of" in what for what in said[name])] == ["four-gear-loop"]


def test_each_wheel_of_a_shared_pinion_has_its_own_height() -> None:
    _, layout = load("ferguson-paradox")
    heights = sorted(layout.wheels[name].centre[2] for name in ("w99", "w100", "w101"))
    broad = layout.wheels["p20"]
    thin = layout.wheels["w99"].thickness
    assert heights[1] - heights[0] > thin
    assert heights[2] - heights[1] > thin
    assert broad.centre[2] - broad.thickness / 2 <= heights[0] - thin / 2 + 1e-12
    assert broad.centre[2] + broad.thickness / 2 >= heights[2] + thin / 2 - 1e-12


@pytest.mark.parametrize("face", ["front", "back"])
@pytest.mark.parametrize("large_first", [True, False])
def test_an_arbor_runs_to_its_dial_past_a_wheel_that_covers_it(face: str, large_first: bool) -> None:
    """The large wheel C covers the axis of A, whose arbor would pass through it on the side of A's dial."""
    wheels = {"A": (20, 0, 0), "B": (20, 20, 0), "C": (80, 0, -30), "D": (20, 0, -80)}
    names = "CDAB" if large_first else "ABCD"
    data = {
        "links": {"frame": {}} | {f"arbor {name}": {"wheels": {name: wheels[name][0]}} for name in names},
        "axes": {name: {"position": [f"{x} mm", f"{y} mm", "0 mm"]} for name, (_, x, y) in wheels.items()},
        "revolutes": [{"pair": ["frame", f"arbor {name}"], "axis": name} for name in names],
        "gears": [{"pair": list(names[:2])}, {"pair": list(names[2:])}],
        "inputs": {"arbor A": 1, "arbor C": 1},
        "dials": {"dial": {"face": face}},
        "outputs": {"arbor A": {"dial": "dial"}},
    }
    layout = lay_out(geartrain.GearTrain.declare(data))
    above = layout.wheels["A"].centre[2] - layout.wheels["C"].centre[2]
    assert above > 1 if face == "front" else above < -1


RAVIGNEAUX = """
name: planets on planets
links:
  frame: {{}}
  small: {{wheels: {{s1: {small}}}}}
  large: {{wheels: {{s2: 21}}}}
  ring: {{wheels: {{r: {{teeth: 45, internal: true}}}}}}
  carrier: {{}}
  short: {{wheels: {{ps: 12}}, copies: {copies}}}
  long: {{wheels: {{pl: 12}}, copies: {copies}}}
revolutes: {{main: [frame, small, large, ring, carrier], S: [carrier, short], L: [carrier, long]}}
gears: [s1 ~ ps, s2 ~ pl, pl ~ r, ps ~ pl]
inputs: {{small: 1}}
fixed: [carrier]
"""


@pytest.mark.parametrize(("small", "copies", "fits"), [(15, 2, True), (15, 3, True), (16, 3, False)])
def test_copies_of_planets_that_mesh_with_each_other_are_rotated_about_their_carrier(
    small: int, copies: int, fits: bool
) -> None:
    train = geartrain.load(RAVIGNEAUX.format(small=small, copies=copies))
    layout = lay_out(train)
    points = {label: complex(*place.point[:2]) for label, place in layout.axes.items()}
    for number in range(1, copies):
        turn = cmath.exp(2j * math.pi * number / copies)
        for first in "SL":
            found = points[f"{first}.{number + 1}"] - points["main"]
            assert found == pytest.approx((points[first] - points["main"]) * turn)
    # the rule on equal planets, which knows no positions, finds the same
    assert any("do not mesh" in notice.what for notice in layout.notices) != fits
    assert any(finding.rule == "A2" for finding in train.build_findings) != fits
