"""Room between planets, interference and declared positions: against circles, involutes and teeth put in place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest
import shapely
from fitters import SIMPLE, box, columns, epicyclic, passed, rules_of
from shapely import affinity

from geartrain import load
from geartrain.errors import QuestionError
from geartrain.numerics import Quantity

Data = dict[str, Any]


def angle(text: str) -> Quantity:
    return Quantity.parse(text, "angle", plain=False)


def interference(wheels: str, degrees: float, h: Any = 1, ring: Any = 1) -> Sequence[Any]:
    """The rules of interference between two of the sun, the planet and the ring."""
    rules = rules_of(
        epicyclic(*SIMPLE), coaxial=False, interference=angle(f"{degrees} deg"), addendum=Fraction(str(h)),
        ring_addendum=Fraction(str(ring)),
    )  # fmt: skip
    return [rule for rule in rules if {*rule.wheels} == {*wheels}]


# ---------------------------------------------------------------------------------------------------------------- ties


def neighbours(planets: int) -> Any:
    rules = rules_of(epicyclic(*SIMPLE), ["s", "p"], coaxial=False, planets=planets, clearance=Fraction(0))
    (rule,) = [rule for rule in rules if "neighbours" in rule.name]
    return rule


def test_near_ties_are_decided_by_digits_that_floats_do_not_have() -> None:
    # convergents of the square root of 2 are above and below it in turn, by less than a float can tell
    p, q = [1], [1]
    for _ in range(24):
        p, q = [*p, p[-1] + 2 * q[-1]], [*q, p[-1] + q[-1]]
    tops, beneath = np.array(p[3:]), np.array(q[3:])
    # four planets: s + p is more than the square root of 2 times p + 2
    found = neighbours(4).holds(columns(s=tops - beneath + 2, p=beneath - 2))
    assert found.tolist() == [at % 2 == 1 for at in range(3, len(p))]


def test_a_tie_is_no_room_but_is_no_interference() -> None:
    # sin(30 deg) is 1/2: 9 (9 + 2 28) / 4 = 4 h (28 + h) with h = 5/4
    assert passed(interference("sp", 30, 1.25), s=9, p=28)
    assert not passed(interference("sp", 30, 1.25), s=9, p=29)
    # six planets: half of s + p is p + 2 where s = p + 4
    found = neighbours(6).holds(columns(s=[22, 23, 24, 23], p=[18, 19, 20, 18]))
    assert found.tolist() == [False, False, False, True]


# ---------------------------------------------------------------------------------------------------------------- room


def gap(planets: Sequence[tuple[float, float, float]], number: int, own: Sequence[tuple[int, int]]) -> float:
    """The least gap between circles of neighbouring sets, and of those of one set that do not touch.

    planets  (radius of the axis's circle, azimuth in turns, tip radius); own: pairs of one set that mesh
    """
    found = []
    for (i, (a, u, r)), (j, (b, v, q)) in product(enumerate(planets), repeat=2):
        for step in range(number):
            if step == 0 and (i == j or (i, j) in own or (j, i) in own):
                continue
            turn = math.tau * (v - u + step / number)
            found.append(math.dist((a, 0), (b * math.cos(turn), b * math.sin(turn))) - r - q)
    return min(found)


@pytest.mark.parametrize("number", [2, 3, 4, 5, 6, 7])
@pytest.mark.parametrize("clearance", ["0", "0.5", "-1/3"])
def test_neighbouring_planets_clear_each_other_as_circles_do(number: int, clearance: str) -> None:
    rules = rules_of(epicyclic(*SIMPLE), planets=number, clearance=Fraction(clearance), coaxial=False)
    (rule,) = [rule for rule in rules if "neighbours" in rule.name]
    grid = box(s=range(12, 60, 5), p=range(12, 60, 7))
    for s, p, held in zip(grid["s"].tolist(), grid["p"].tolist(), rule.holds(grid), strict=True):
        room = gap([((s + p) / 2, 0, p / 2 + 1)], number, []) - float(Fraction(clearance))
        if abs(room) > 1e-9:
            assert held == (room > 0)


def test_modules_weigh_the_tips_of_stepped_planets() -> None:
    data = epicyclic({"s": (20, False), "r": (60, True)}, [{"p": 15, "q": 12}], [("s", "p"), ("q", "r")])
    data["links"]["Ls"]["wheels"]["s"]["module"] = "1 mm"
    data["links"]["Lr"]["wheels"]["r"]["module"] = "1.5 mm"
    rules = [rule for rule in rules_of(data, planets=3, clearance=Fraction(0)) if "neighbours" in rule.name]
    for s, p, q in product(range(12, 40, 5), range(10, 40, 4), range(10, 40, 4)):
        r = q + Fraction(2 * (s + p), 3)
        if r.denominator == 1:
            room = gap([((s + p) / 2, 0, max(p / 2 + 1, 1.5 * (q / 2 + 1)))], 3, [])
            assert passed(rules, s=s, p=p, q=q, r=int(r)) == (room > 0)
    del data["links"]["Lr"]["wheels"]["r"]["module"]
    with pytest.raises(QuestionError, match="declare the module of all of them"):
        rules_of(data, planets=3, clearance=Fraction(0))


PAIRED: tuple[Any, ...] = (
    {"s": (24, False), "r": (72, True)},
    [{"p": 15}, {"q": 14}],
    [("s", "p"), ("p", "q"), ("q", "r")],
)


@pytest.mark.parametrize("number", [2, 3, 4])
def test_planets_one_after_the_other_clear_each_other_and_the_central_wheels_as_circles_do(number: int) -> None:
    rules = [
        rule
        for rule in rules_of(epicyclic(*PAIRED), planets=number, clearance=Fraction(1, 4))
        if "neighbours" in rule.name
    ]
    assert len(rules) == 5
    held = 0
    for s, p, q, r in product(range(14, 40, 6), range(12, 30, 5), range(12, 30, 5), range(50, 100, 7)):
        A, B, D = (s + p) / 2, (r - q) / 2, (p + q) / 2
        fits = abs(A - B) <= D <= A + B
        if fits:
            delta = math.acos((A * A + B * B - D * D) / (2 * A * B)) / math.tau
            room = gap([(A, 0, p / 2 + 1), (B, delta, q / 2 + 1)], number, [(0, 1)])
            room = min(room, B - (s + q) / 2 - 2, r / 2 - 1 - A - p / 2 - 1) - 0.25
            fits = room > 0
            if abs(room) < 1e-9:
                continue
        held += fits
        assert passed(rules, s=s, p=p, q=q, r=r) == fits
    assert held > 3


def test_planets_of_a_ravigneaux_set_reach_each_other() -> None:
    train = load("ravigneaux-set").declaration
    rules = [rule for rule in rules_of(train, planets=3, clearance=Fraction(0)) if "neighbours" in rule.name]
    assert len(rules) == 3
    for a, ps, pl, b in product(range(18, 40, 4), range(14, 30, 4), range(14, 30, 4), range(24, 50, 6)):
        A, B, D = (a + ps) / 2, (b + pl) / 2, (ps + pl) / 2
        fits = abs(A - B) <= D
        if fits:
            delta = math.acos((A * A + B * B - D * D) / (2 * A * B)) / math.tau
            room = gap([(A, 0, ps / 2 + 1), (B, delta, pl / 2 + 1)], 3, [(0, 1)])
            if abs(room) < 1e-9:
                continue
            fits = room > 0
        assert passed(rules, a=a, ps=ps, pl=pl, b=b, r=b + 2 * pl) == fits


def test_room_is_requested_only_where_the_number_of_spur_planets_is_known() -> None:
    with pytest.raises(QuestionError, match="the number of planets"):
        rules_of(epicyclic(*SIMPLE), clearance=Fraction(0))
    with pytest.raises(QuestionError, match="bevel"):
        rules_of(load("bevel-differential").declaration, planets=2, clearance=Fraction(0))


# ------------------------------------------------------------------------------------------------------------ undercut


@pytest.mark.parametrize(
    ("degrees", "addendum", "minimum"),
    # 2 h / sin^2: 31.9, 17.1, 11.2, 8; with short teeth 13.7
    [("14.5", "1", 32), ("20", "1", 18), ("25", "1", 12), ("30", "1", 8), ("20", "0.8", 14), ("45", "1", 4)],
)
def test_a_rack_undercuts_fewer_teeth_than_textbooks_print(degrees: str, addendum: str, minimum: int) -> None:
    rules = rules_of(epicyclic(*SIMPLE), coaxial=False, undercut=angle(f"{degrees} deg"), addendum=Fraction(addendum))
    assert {rule.wheels for rule in rules} == {("s",), ("p",)}
    assert passed(rules, s=minimum, p=minimum)
    assert not passed(rules, s=minimum - 1, p=minimum)


# -------------------------------------------------------------------------------------------------------- interference


def test_the_largest_mate_of_a_pinion_is_the_printed_one() -> None:
    # 20 degrees, full depth, as in textbooks of machine elements; with 18 a rack may mesh
    rules = interference("sp", 20)
    for pinion, largest in [(13, 16), (14, 26), (15, 45), (16, 101), (17, 1309)]:
        assert [passed(rules, s=pinion, p=mate) for mate in (largest, largest + 1)] == [True, False]
        assert [passed(rules, s=mate, p=pinion) for mate in (largest, largest + 1)] == [True, False]
    assert passed(rules, s=18, p=18)
    assert passed(rules, s=18, p=10**6)
    assert not any(passed(rules, s=12, p=mate) for mate in range(12, 200))


def contact_end(z: float, tip: float, pressure: float, ring: bool = False) -> float:
    """Where a tip circle cuts the line of action, from the point where that touches its own base circle.

    Found by walking along the line, not by a formula: the line is x = base radius, turned so that it stands upright.
    """
    base = z / 2 * math.cos(pressure)
    low, high = 0.0, 2 * tip
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if math.hypot(base, middle) < tip else (low, middle)
    return low


@pytest.mark.parametrize("degrees", [14.5, 20.0, 25.0])
@pytest.mark.parametrize("h", [1.0, 0.8])
def test_tips_stay_on_involutes_as_points_on_the_line_of_action_say(degrees: float, h: float) -> None:
    pressure = math.radians(degrees)
    pair, ring = interference("sp", degrees, h), interference("pr", degrees, h, h)
    for z1, z2 in product(range(8, 60, 3), range(8, 200, 7)):
        # the points where the line touches both base circles are a sin(alpha) apart
        apart = (z1 + z2) / 2 * math.sin(pressure)
        left = [apart - contact_end(z, z / 2 + h, pressure) for z in (z1, z2)]
        assert passed(pair, s=z1, p=z2) == (min(left) >= 0)
        if z2 > z1 + 2:
            apart = (z2 - z1) / 2 * math.sin(pressure)
            reaches = z2 / 2 - h > z2 / 2 * math.cos(pressure)
            good = reaches and contact_end(z2, z2 / 2 - h, pressure) >= apart
            held = passed(ring, p=z1, r=z2)
            # tips collide besides where the ring has few teeth more
            assert held == good if z2 > z1 + 16 else held <= good


def half_angles(z: int, pressure: float, radii: Sequence[float]) -> list[float]:
    """Half the angle of a tooth at some radii: unwinding a string from the base circle, radial below it."""
    base = z / 2 * math.cos(pressure)
    found = []
    for r in radii:
        string = math.sqrt(max(r * r - base * base, 0.0))
        unwound, turned = string / base, math.atan2(string, base)
        pitch = math.tan(pressure) - pressure
        found.append(math.pi / (2 * z) + pitch - (unwound - turned))
    return found


def outline(z: int, pressure: float, low: float, high: float) -> list[tuple[float, float]]:
    """A wheel with involute teeth between two radii (modules), without play."""
    radii = np.linspace(low, high, 60).tolist()
    halves = half_angles(z, pressure, radii)
    points = []
    for tooth in range(z):
        at = math.tau * tooth / z
        sides = [(r, at - half) for r, half in zip(radii, halves, strict=True)]
        sides += [(r, at + half) for r, half in zip(radii[::-1], halves[::-1], strict=True)]
        points += [(r * math.cos(a), r * math.sin(a)) for r, a in sides]
    return points


def overlap(z1: int, z2: int, pressure: float, h1: float, h2: float) -> float:
    """The largest area (square modules) that a planet and a ring share while they turn through a pitch."""
    planet = shapely.Polygon(outline(z1, pressure, z1 / 2 - 1.25, z1 / 2 + h1))
    hole = shapely.Polygon(outline(z2, pressure, z2 / 2 - h2, z2 / 2 + 1.25))
    ring = shapely.Point(0, 0).buffer(z2 / 2 + 3).difference(hole)
    worst = 0.0
    for step in range(12):
        turn = math.tau / z1 * step / 12
        here = affinity.translate(affinity.rotate(planet, turn, (0, 0), use_radians=True), (z2 - z1) / 2)
        there = affinity.rotate(ring, turn * z1 / z2, (0, 0), use_radians=True)
        worst = max(worst, here.intersection(there).area)
    return worst


@pytest.mark.parametrize(
    ("h1", "h2", "ring", "minimum"), [(1, 1, 40, 9), (1, 1, 60, 9), (1, "0.8", 40, 8), ("0.8", "0.8", 40, 7)]
)
def test_planets_nearly_as_large_as_their_ring_collide_as_outlines_of_teeth_do(
    h1: Any, h2: Any, ring: int, minimum: int
) -> None:
    # planets so large keep off the ring's flanks, so that corners alone decide
    for less in (4, 5, 6, minimum - 1, minimum, minimum + 1, 12):
        held = passed(interference("pr", 20, h1, h2), p=ring - less, r=ring)
        assert held == (less >= minimum)
        if (ring, less) != (60, 8):  # which overlap by less than the polygons are exact
            assert (overlap(ring - less, ring, math.radians(20), float(h1), float(h2)) < 5e-6) == held


def test_a_ring_of_fifty_takes_forty_one_teeth_as_they_are_and_forty_two_only_shifted() -> None:
    # as SDP/SI print it: 42 in 50 without trochoid interference at a shift of 0.01
    assert [passed(interference("pr", 20), p=planet, r=50) for planet in (41, 42)] == [True, False]


def test_full_teeth_of_a_ring_cut_into_the_flanks_of_small_planets() -> None:
    for planet, fits in [(14, False), (17, False), (22, True), (26, True)]:
        assert passed(interference("pr", 20), p=planet, r=60) == fits
        assert (overlap(planet, 60, math.radians(20), 1, 1) < 5e-6) == fits
    # the usual example of a planetary needs a ring with shorter teeth
    data = epicyclic(*SIMPLE)
    twenty = angle("20 deg")
    assert not passed(rules_of(data, interference=twenty), s=24, p=18, r=60)
    assert passed(rules_of(data, interference=twenty, ring_addendum=Fraction("0.8")), s=24, p=18, r=60)


def test_a_planet_as_large_as_its_ring_does_not_go_in() -> None:
    rules = interference("pr", 20)
    assert not any(passed(rules, p=planet, r=40) for planet in range(35, 60))
    assert not passed(rules, p=1, r=2)
