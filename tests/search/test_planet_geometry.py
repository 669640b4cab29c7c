"""Room between planets against circles, and tips of planets and rings against outlines of teeth."""

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
from geartrain.kinematics.buildability.pitch_distances import tip_margin

# ---------------------------------------------------------------------------------------------------------------- ties


def neighbours(train: Any, planets: int, clearance: Any = 0, **more: Any) -> list[Any]:
    """The conditions on clearance."""
    rules = rules_of(train, planets=planets, clearance=Fraction(clearance), **more)
    return [rule for rule in rules if "neighbours" in rule.name]


def test_near_ties_are_decided_by_digits_that_floats_do_not_have() -> None:
    # convergents of the square root of 2 are above and below it in turn, by less than a float can tell
    p, q = [1], [1]
    for _ in range(24):
        p, q = [*p, p[-1] + 2 * q[-1]], [*q, p[-1] + q[-1]]
    tops, beneath = np.array(p[3:]), np.array(q[3:])
    # four planets: s + p is more than the square root of 2 times p + 2
    (rule,) = neighbours(epicyclic(*SIMPLE), 4, coaxial=False)
    found = rule.holds(columns(s=tops - beneath + 2, p=beneath - 2))
    assert found.tolist() == [at % 2 == 1 for at in range(3, len(p))]


def test_a_tie_is_no_room() -> None:
    # six planets: half of s + p is p + 2 where s = p + 4
    (rule,) = neighbours(epicyclic(*SIMPLE), 6, coaxial=False)
    found = rule.holds(columns(s=[22, 23, 24, 23], p=[18, 19, 20, 18]))
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
    (rule,) = neighbours(epicyclic(*SIMPLE), number, clearance, coaxial=False)
    grid = box(s=range(12, 60, 5), p=range(12, 60, 7))
    for s, p, held in zip(grid["s"].tolist(), grid["p"].tolist(), rule.holds(grid), strict=True):
        room = gap([((s + p) / 2, 0, p / 2 + 1)], number, []) - float(Fraction(clearance))
        if abs(room) > 1e-9:
            assert held == (room > 0)


def test_modules_weigh_the_tips_of_stepped_planets() -> None:
    data = epicyclic({"s": (20, False), "r": (60, True)}, [{"p": 15, "q": 12}], [("s", "p"), ("q", "r")])
    data["links"]["Ls"]["wheels"]["s"]["module"] = "1 mm"
    data["links"]["Lr"]["wheels"]["r"]["module"] = "1.5 mm"
    rules = neighbours(data, 3)
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
    rules = neighbours(epicyclic(*PAIRED), number, "1/4")
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
    rules = neighbours(load("ravigneaux-set").declaration, 3)
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


# --------------------------------------------------------------------------------------- tips of planets and rings


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
        held = tip_margin(ring - less, ring, math.radians(20), float(h1), float(h2)) > 1e-9
        assert held == (less >= minimum)
        if (ring, less) != (60, 8):  # which overlap by less than the polygons are exact
            assert (overlap(ring - less, ring, math.radians(20), float(h1), float(h2)) < 5e-6) == held


def test_a_ring_of_fifty_takes_forty_one_teeth_as_they_are_and_forty_two_only_shifted() -> None:
    # as SDP/SI print it: 42 in 50 without trochoid interference at a shift of 0.01
    assert [tip_margin(planet, 50, math.radians(20), 1, 1) > 0 for planet in (41, 42)] == [True, False]
