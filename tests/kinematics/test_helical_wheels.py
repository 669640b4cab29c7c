"""Helical wheels: sense on crossed axes, what cannot mesh, teeth of the transverse section, efficiency of screws."""

from __future__ import annotations

from fractions import Fraction
from math import acos, atan, cos, degrees, hypot, pi, radians, sin, sqrt, tan
from random import Random
from typing import Any

import numpy as np
import pytest

from geartrain import GearTrain, GearTrainError
from geartrain.scene import ManufacturingSizes, SolidModel, lay_out


def train(first: dict[str, Any], second: dict[str, Any], **also: Any) -> GearTrain:
    links = {"frame": {}, "a": {"wheels": {"a1": first}}, "b": {"wheels": {"b1": second}}}
    revolutes = [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}]
    gears = [{"pair": ["a1", "b1"], **also.pop("pair", {})}]
    given = {"name": "pair", "links": links, "revolutes": revolutes, "gears": gears}
    return GearTrain.declare({**given, "inputs": {"a": 1}, "outputs": {"b": {}}, **also})


def helical(teeth: int, angle: float, hand: str | None = None, **also: Any) -> dict[str, Any]:
    return {"teeth": teeth, "helix_angle": f"{angle!r} deg", **({} if hand is None else {"hand": hand}), **also}


def axes(first: list[Any], second: list[Any], place: list[Any] | None) -> dict[str, Any]:
    found: dict[str, Any] = {"A": {"direction": first}, "B": {"direction": second}}
    if place is not None:
        found["A"]["position"], found["B"]["position"] = ["0 mm"] * 3, [f"{each} mm" for each in place]
    return found


def cross(a: list[float], b: list[float]) -> list[float]:
    return np.cross(a, b).tolist()


def dot(a: list[float], b: list[float]) -> float:
    return float(np.dot(a, b))


def unit(vector: list[float]) -> list[float]:
    return [x / hypot(*vector) for x in vector]


def test_a_worm_is_a_helical_wheel_near_a_right_angle() -> None:
    random, tried = Random(4), 0
    while tried < 200:
        first, second, place = ([random.randint(-3, 3) for _ in range(3)] for _ in range(3))
        upright = cross(first, second)
        if not any(upright) or dot(first, second) or not dot(upright, place):
            continue
        hand = random.choice(["right", "left"])
        placed = axes(first, second, place)
        worm = train({"teeth": 2, "kind": "worm", "hand": hand}, {"teeth": 40}, axes=placed)
        screw = train(helical(2, 85, hand), helical(40, 5, hand), axes=placed)
        assert screw.solve().speeds["b"] == worm.solve().speeds["b"] in (Fraction(1, 20), Fraction(-1, 20))
        tried += 1


def rolled(beta: tuple[float, float], first: list[float], second: list[float], place: list[float]) -> float | None:
    """Speed of the second wheel of twice the teeth, from velocities of points of two surfaces; None if they cross.

    Of threads drawn as curves about both axes: their directions and where they are a moment later at the contact.
    """
    ways = unit(first), unit(second)
    normal = unit(cross(*ways))
    if dot(normal, place) < 0:
        normal = [-x for x in normal]
    threads, moved = [], []
    for way, outward, lean in ((ways[0], normal, beta[0]), (ways[1], [-x for x in normal], beta[1])):
        side = cross(way, outward)

        def point(turn: float, along: float, way: Any = way, outward: Any = outward, side: Any = side) -> list[float]:
            return [along * w + cos(turn) * o + sin(turn) * s for w, o, s in zip(way, outward, side, strict=True)]

        step = 1e-6
        start, later, turned = point(0, 0), point(step * sin(lean), step * cos(lean)), point(step, 0)
        threads.append([(x - y) / step for x, y in zip(later, start, strict=True)])
        moved.append([(x - y) / step for x, y in zip(turned, start, strict=True)])
    if hypot(*cross(threads[0], threads[1])) > 1e-4:
        return None
    across = cross(normal, threads[0])
    radii = 1 / cos(beta[0]), 2 / cos(beta[1])
    return radii[0] * dot(moved[0], across) / (radii[1] * dot(moved[1], across))


def test_the_sense_on_skew_axes_is_that_of_the_surfaces() -> None:
    random, tried = Random(5), 0
    while tried < 100:
        first, second, place = ([random.randint(-3, 3) for _ in range(3)] for _ in range(3))
        upright = cross(first, second)
        if not any(upright) or not dot(upright, place):
            continue
        angle = degrees(acos(dot(first, second) / (hypot(*first) * hypot(*second)))) * (
            -1 if dot(upright, place) > 0 else 1
        )
        one = random.uniform(-80, 80)
        for other in (angle - one, angle - one + 180, angle - one - 180, 7.0):
            if abs(other) >= 89:
                continue
            hands = ["left" if each < 0 else "right" for each in (one, other)]
            wheels = helical(20, abs(one), hands[0]), helical(40, abs(other), hands[1])
            expected = rolled((radians(one), radians(other)), first, second, place)
            if expected is None:
                with pytest.raises(GearTrainError, match="are not aligned in mesh"):
                    train(*wheels, axes=axes(first, second, place)).solve()
            else:
                speed = train(*wheels, axes=axes(first, second, place)).solve().speeds["b"]
                assert float(speed) == pytest.approx(expected, abs=1e-3)
                tried += 1


def test_without_places_the_hands_may_decide() -> None:
    told = train(
        helical(20, 40, "right"), helical(40, 20, "right"), axes=axes([1, 0, 0], ["1/2", "0.8660254038", 0], None)
    )
    assert told.solve().speeds["b"] == Fraction(-1, 2)
    assert not told.circuits[0].note
    open_ = train(helical(20, 45), helical(40, 45), axes=axes([1, 0, 0], [0, 1, 0], None))
    assert open_.solve().speeds["b"] == Fraction(-1, 2)
    assert "sense of rotation by convention" in open_.circuits[0].note


@pytest.mark.parametrize(
    ("first", "second", "words"),
    [
        (helical(20, 15, "right"), helical(40, 20, "left"), "helix angles of 15 and 20 deg"),
        (helical(20, 15, "right"), helical(40, 15, "right"), "a right-hand wheel meshes with a right-hand wheel"),
        (helical(20, 15, "right"), helical(60, 15, "left", internal=True), "a ring and its mate have the same hand"),
        (helical(20, 15), {"teeth": 40}, "helix angles of 15 and 0 deg"),
    ],
)
def test_teeth_that_do_not_lean_alike_are_refused(first: dict[str, Any], second: dict[str, Any], words: str) -> None:
    with pytest.raises(GearTrainError, match=words):
        train(first, second).solve()


@pytest.mark.parametrize("angle", ["90 deg", "-5 deg"])
def test_an_angle_that_is_none_is_refused(angle: str) -> None:
    with pytest.raises(GearTrainError, match="helix_angle"):
        train({"teeth": 20, "helix_angle": angle}, {"teeth": 40})
    with pytest.raises(GearTrainError, match="a bevel wheel cannot have a helix angle"):
        train({"teeth": 20, "kind": "bevel", "helix_angle": "20 deg"}, {"teeth": 40})


def test_involutes_are_those_of_the_transverse_section() -> None:
    """Contact ratios by the textbook's formulas for helical gears (Dudley; ISO 21771)."""
    beta, alpha, m, z, width = radians(18), radians(20), 2.0, (21, 50), 25.0
    wheels = [helical(each, 18, module="2 mm", thickness="25 mm") for each in z]
    found = train(*wheels, tooth_form={"form": "involute"}, pair={"friction": 0.05})
    figures = found.meshes[0].account().figures.to_dict()
    transverse = atan(tan(alpha) / cos(beta))
    mt = m / cos(beta)
    r = [mt * each / 2 for each in z]
    base, tip = [each * cos(transverse) for each in r], [each + m for each in r]
    reach = sum(sqrt(t**2 - b**2) for t, b in zip(tip, base, strict=True)) - sum(r) * sin(transverse)
    assert figures["contact_ratio"] == pytest.approx(reach / (pi * mt * cos(transverse)), rel=1e-12)
    assert figures["overlap_ratio"] == pytest.approx(width * sin(beta) / (pi * m), rel=1e-12)
    assert figures["pressure_angle"] == pytest.approx(transverse, rel=1e-12)
    place = lay_out(found).wheels
    assert place["a1"].radius == pytest.approx(r[0])
    apart = np.subtract(place["a1"].centre, place["b1"].centre)
    assert hypot(apart[0], apart[1]) == pytest.approx(sum(r))
    straight = train({"teeth": 21}, {"teeth": 50}, tooth_form={"form": "involute"}, pair={"friction": 0.05})
    losses = [1 - each.meshes[0].efficiency("a1").mean for each in (found, straight)]
    assert losses[0] < losses[1]


def test_other_teeth_do_not_lean() -> None:
    with pytest.raises(GearTrainError, match="only involute teeth are supported on helical wheels"):
        _ = train(helical(20, 15), helical(40, 15), tooth_form={"form": "cycloidal"}).meshes
    skew = axes([0, 0, 1], [0, 1, 0], [30, 0, 0])
    with pytest.raises(GearTrainError, match="have point contact"):
        _ = train(helical(20, 45), helical(20, 45), tooth_form={"form": "involute"}, axes=skew).meshes


def test_torques_take_the_efficiency_of_screws() -> None:
    placed = axes([0, 0, 1], [0, 1, 0], [30, 0, 0])
    worm = {"teeth": 1, "kind": "worm", "helix_angle": "85 deg"}
    given = {"axes": placed, "pair": {"friction": 0.1}, "loads": {"a": "1 N m"}}
    found = train(worm, helical(40, 5), **given).torques()
    lead, rough = radians(5), atan(0.1 / cos(radians(20)))
    assert float(found.efficiency) == pytest.approx(tan(lead) / tan(lead + rough))
    back = train(worm, helical(40, 5), **{**given, "loads": {"b": "-1 N m"}}).torques()
    assert "lock" in str(back.verdict)


def share_of_vectors(g1: list[float], g2: list[float], place: list[float], beta: float, rough: float) -> float:
    """Power that arrives at the second wheel over that of the first, from forces and velocities at the pitch point.

    Only the first wheel's helix angle is used: the tooth of the second lies along it.
    """
    up = cross(g1, g2)
    a = [x / hypot(*up) * (1 if dot(up, place) > 0 else -1) for x in up]
    side = cross(g1, a)
    tooth = [cos(beta) * x + sin(beta) * y for x, y in zip(g1, side, strict=True)]
    across = cross(a, tooth)
    first, second = side, cross(g2, a)
    first = [x / dot(first, across) for x in first]  # both move by 1 across the teeth, the first pushes that way
    second = [x / dot(second, across) for x in second]
    slip = dot(first, tooth) - dot(second, tooth)
    force = [n + (rough if slip > 0 else -rough) * t for n, t in zip(across, tooth, strict=True)]
    return dot(force, second) / dot(force, first)


@pytest.mark.parametrize("worm_first", [True, False])
def test_the_lead_of_a_worm_and_the_shaft_angle_give_its_efficiency(worm_first: bool) -> None:
    """At the normal pressure angle of 20 degrees: friction counts mu/cos(20 deg) in the pitch plane."""
    random, locked = Random(7), 0
    for _ in range(60):
        first, second, place = ([random.randint(-3, 3) for _ in range(3)] for _ in range(3))
        if not any(upright := cross(first, second)) or not dot(upright, place):
            continue
        hand, angle, friction = random.choice(["right", "left"]), random.uniform(40, 88), random.uniform(0.02, 0.3)
        # the worm is on axis A through the origin, its wheel on axis B through `place`
        screw, wheel = helical(2, angle, hand, kind="worm"), {"teeth": 40}
        pair = {"pair": ["a1", "b1"] if worm_first else ["b1", "a1"], "friction": friction}
        found = train(screw, wheel, axes=axes(first, second, place), pair=pair)
        beta, rough = radians(angle if hand == "right" else -angle), friction / cos(radians(20))
        ahead = share_of_vectors(unit(first), unit(second), place, beta, rough)
        # driven by its wheel, the force of friction turns round
        back = 1 / share_of_vectors(unit(first), unit(second), place, beta, -rough)
        for share, way in ((ahead, ("b", "a")), (back, ("a", "b"))):
            answer = found.driven(*way)
            if share > 0:
                assert answer.verdict.kind == "determined"
                assert float(answer.efficiency) == pytest.approx(share, rel=1e-9)
            else:
                assert answer.verdict.kind == "self-locking"
                locked += 1
    assert locked > 3


@pytest.mark.parametrize("mate", [{"teeth": 60}, helical(60, 11.31), helical(60, 11.31, "left")])
def test_a_worm_of_five_threads_has_its_textbook_efficiency(mate: dict[str, Any]) -> None:
    """tan g/tan(g + r) and tan(g - r)/tan g with g = 11.31 deg and tan r = 0.08/cos(20 deg): 0.689482 and 0.564716."""
    placed = axes([0, 0, 1], [0, 1, 0], [30, 0, 0])
    found = train(helical(5, 78.69, "left", kind="worm"), mate, axes=placed, pair={"friction": 0.08})
    assert round(float(found.driven("b", "a").efficiency), 6) == 0.689482
    assert round(float(found.driven("a", "b").efficiency), 6) == 0.564716


def test_a_straight_wheel_slides_along_a_helical_one() -> None:
    """On axes that cross by the helix angle of its mate: 1/(1 + mu' tan(30 deg)), and backwards 1 - mu' tan(30 deg)."""
    placed = axes([1, 0, 0], ["0.8660254037844386", "0.5", 0], None)
    found = train(helical(20, 30), {"teeth": 40}, axes=placed, pair={"friction": 0.1})
    rough = 0.1 / cos(radians(20)) * tan(radians(30))
    assert float(found.driven("b", "a").efficiency) == pytest.approx(1 / (1 + rough))
    assert float(found.driven("a", "b").efficiency) == pytest.approx(1 - rough)


@pytest.mark.parametrize("mate", [helical(60, 12), helical(60, 11.31, "right")])
def test_the_wheel_of_a_worm_lies_along_its_thread(mate: dict[str, Any]) -> None:
    placed = axes([0, 0, 1], [0, 1, 0], [30, 0, 0])
    with pytest.raises(GearTrainError, match="are not aligned in mesh"):
        train(helical(5, 78.69, "left", kind="worm"), mate, axes=placed).solve()


def test_friction_of_a_worm_of_unknown_lead_asks_for_its_helix_angle() -> None:
    placed = axes([0, 0, 1], [0, 1, 0], [30, 0, 0])
    given = {"axes": placed, "pair": {"friction": 0.08}, "loads": {"a": "1 N m"}}
    (left,) = train({"teeth": 5, "kind": "worm"}, {"teeth": 60}, **given).torques().neglected
    assert left.what == "friction of teeth"
    assert "declare the `helix_angle` of the worm" in left.why
    assert "tooth_form" not in left.why


def test_solids_turn_along_their_axis_by_the_helix() -> None:
    """A corner of the upper face stands width tan(helix) / radius ahead of its place in the lower one."""
    beta = radians(30)
    wheels = (helical(z, 30, hand, module="2 mm", thickness="20 mm") for z, hand in ((17, "right"), (40, "left")))
    model = SolidModel(train(*wheels, tooth_form={"form": "involute"}), ManufacturingSizes())
    parts = {part.name: part for part in model.parts}
    for name, teeth, sign in (("a1", 17, 1), ("b1", 40, -1)):
        solid = parts[name].drawn
        low, high = (solid.vertices[np.isclose(solid.vertices[:, 2], z)] for z in (-10, 10))
        ahead = np.angle((high[:, 0] + 1j * high[:, 1]) / (low[:, 0] + 1j * low[:, 1]))
        assert ahead == pytest.approx(sign * 20 * tan(beta) / (teeth / cos(beta)))
        a, b, c = (solid.vertices[solid.faces[:, at]] for at in range(3))
        top = np.isclose([a[:, 2], b[:, 2], c[:, 2]], 10).all(axis=0)
        area = np.cross(b - a, c - a)[top, 2].sum() / 2
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        assert volume == pytest.approx(20 * area, rel=4e-3)  # chords of the helix
