"""Equal planets: whether all can be put in and have room, against the teeth themselves."""

from __future__ import annotations

import random
from fractions import Fraction
from math import acos, cos, hypot, pi, sin

import pytest

from geartrain import GearTrain, load
from geartrain.kinematics.buildability.planet_assembly import bezout


def planets(
    number: int, sun: int, inner: int, ring: int, outer: int | None = None, module: str | None = "2 mm", more: str = ""
) -> GearTrain:
    """A sun, a held ring and equal planets; of two wheels where `outer` meshes with the ring instead."""
    size = f", module: {module}" if module else ""
    links, joints, gears = [], [], []
    for at in range(number):
        second = f", q{at}: {{teeth: {outer}}}" if outer is not None else ""
        links.append(f"  P{at}: {{wheels: {{p{at}: {{teeth: {inner}}}{second}}}}}")
        joints.append(f"  - {{pair: [arm, P{at}], axis: P{at}}}")
        gears += [f"  - {{pair: [s, p{at}]}}", f"  - {{pair: [{'p' if outer is None else 'q'}{at}, ring]}}"]
    text = "\n".join(
        [
            "links:",
            f"  frame: {{wheels: {{ring: {{teeth: {ring}, internal: true}}}}}}",
            f"  sun: {{wheels: {{s: {{teeth: {sun}{size}}}}}}}",
            "  arm: {}",
            *links,
            "revolutes:",
            "  - {pair: [frame, sun], axis: main}",
            "  - {pair: [frame, arm], axis: main}",
            *joints,
            "gears:",
            *gears,
            "inputs: {sun: 1}",
            more,
        ]
    )
    return load(text + "\n")


def found(train: GearTrain) -> list[tuple[str, str]]:
    return [(each.rule, each.level) for each in train.build_findings if each.rule.startswith("A")]


def words(train: GearTrain) -> str:
    return " ".join(str(each) for each in train.build_findings if each.rule.startswith("A"))


def go_in(number: int, sun: int, inner: int, ring: int, outer: int) -> bool:
    """By the teeth: each planet is turned by every tooth of one wheel, and its other wheel looked at.

    The line of centres stands at T; u is by what part of a pitch it is past a tooth of the sun, v past one of the
    planet, both counterclockwise: a tooth meets a gap outside if u + v is 1/2, inside (w of the ring) if v - w is.
    """
    half = Fraction(1, 2)
    # the first planet stands at 0 with a tooth of each wheel at its mark: sun and ring are put so that it meshes
    u, w = (half - inner * half) % 1, (0 - half) % 1
    for at in range(1, number):
        T = Fraction(at, number)
        wanted = (half - (u + sun * T)) % 1
        for tooth in range(inner):  # inner (T + 1/2 - phi) = wanted + tooth
            phi = T + half - (wanted + tooth) / inner
            if (outer * (T - phi) - (w + ring * T)) % 1 == half:
                break
        else:
            return False
    return True


def test_the_teeth_of_textbooks_agree() -> None:
    fits = [number for number in range(1, 13) if go_in(number, 24, 18, 60, 18)]
    assert fits == [1, 2, 3, 4, 6, 7, 12]


def test_random_planets_go_in_as_their_teeth_say() -> None:
    draw = random.Random(20)
    seen = set()
    for _ in range(300):
        number, sun, inner = draw.randint(2, 7), draw.randint(8, 40), draw.randint(8, 40)
        ring = sun + 2 * inner
        fits = go_in(number, sun, inner, ring, inner)
        seen.add(fits)
        assert ("A1" in dict(found(planets(number, sun, inner, ring, module=None)))) != fits, (number, sun, inner)
    assert seen == {True, False}


def test_random_stepped_planets_go_in_as_their_teeth_say() -> None:
    draw = random.Random(21)
    seen = set()
    for _ in range(300):
        number, sun, inner, outer = draw.randint(2, 6), draw.randint(8, 40), draw.randint(8, 40), draw.randint(8, 40)
        ring = draw.randint(outer + 10, 120)
        fits = go_in(number, sun, inner, ring, outer)
        seen.add(fits)
        told = dict(found(planets(number, sun, inner, ring, outer, module=None)))
        assert ("A2" in told) != fits, (number, sun, inner, outer, ring)
    assert seen == {True, False}


@pytest.mark.parametrize("number", range(2, 8))
def test_neighbours_of_the_textbook_planetary(number: int) -> None:
    """2 a sin(pi/n) - 2 r_a with a = 42 and r_a = 20 mm: 44, 32.746, 19.397, 9.374, 2.000, -3.554."""
    gap = 84 * sin(pi / number) - 40
    assert gap == pytest.approx([44, 32.746, 19.397, 9.374, 2.000, -3.554][number - 2], abs=6e-4)
    train = planets(number, 24, 18, 60)
    # all fit between teeth but five, which have places a step of 1/84 turn off
    expected = {5: [("A1", "note")], 7: [("A3", "error")]}
    assert found(train) == expected.get(number, [])
    if number == 5:
        assert "1/84 turn" in words(train)
        assert "2, 3, 4 or 6 would stand evenly" in words(train)
        assert "places 16 and 17 of these steps apart (4 times 17)" in words(train)
    if number == 7:
        assert "overlap by 3.554 mm" in words(train)
        assert "at most 6" in words(train)


def test_planets_that_have_room_nowhere_are_an_error() -> None:
    """Eight of 18 teeth about 24: neither evenly, 8 does not divide 84, nor elsewhere."""
    assert found(planets(8, 24, 18, 60)) == [("A1", "error"), ("A3", "error")]


def test_a_little_room_is_noted() -> None:
    """Five of 39 about 31: 70 sin(36 deg) - 41 = 0.145 modules, or 0.29 mm; five divides 31 + 109."""
    train = planets(5, 31, 39, 109)
    assert found(train) == [("A3", "note")]
    assert "leave only 0.2899 mm" in words(train)
    assert 2 * (70 * sin(pi / 5) - 41) == pytest.approx(0.2899, abs=5e-5)


MESHING = """
links:
  frame: {{wheels: {{ring: {{teeth: {ring}, internal: true}}}}}}
  sun: {{wheels: {{s: {sun}}}}}
  arm: {{}}
{links}
revolutes:
  - {{pair: [frame, sun], axis: main}}
  - {{pair: [frame, arm], axis: main}}
{joints}
gears: [{gears}]
inputs: {{sun: 1}}
"""


def test_planets_that_mesh_clear_those_of_the_next_set() -> None:
    """Inner planets meet the sun, outer ones the ring and the inner one of their set; places by the triangle."""
    draw = random.Random(22)
    seen = set()
    while len(seen) < 2 or draw.random() < 0.97:
        number, sun, p, q = draw.randint(2, 5), draw.randint(12, 40), draw.randint(12, 30), draw.randint(12, 30)
        ring = sun + 2 * p + 2 * q - draw.randint(4, 20)
        A, B, D = (sun + p) / 2, (ring - q) / 2, (p + q) / 2
        if abs(A - B) >= D:
            continue
        delta = acos((A * A + B * B - D * D) / (2 * A * B))
        turns = (2 * pi * step / number for step in range(1, number))
        near = min(hypot(B * cos(delta) - A * cos(turn), B * sin(delta) - A * sin(turn)) for turn in turns)
        gap = near - (p + q) / 2 - 2
        if abs(gap) < 1e-6:
            continue
        range_ = range(number)
        text = MESHING.format(
            ring=ring,
            sun=sun,
            links="\n".join(
                f"  I{at}: {{wheels: {{p{at}: {p}}}}}\n  O{at}: {{wheels: {{q{at}: {q}}}}}" for at in range_
            ),
            joints="\n".join(f"  - {{pair: [arm, {link}{at}], axis: {link}{at}}}" for at in range_ for link in "IO"),
            gears=", ".join(
                f"{{pair: [s, p{at}]}}, {{pair: [p{at}, q{at}]}}, {{pair: [q{at}, ring]}}" for at in range_
            ),
        )
        seen.add(gap < 0)
        assert (f"of the next of {number} equal sets overlap" in words(load(text))) == (gap < 0), (
            number,
            sun,
            p,
            q,
            ring,
        )


def placed(number: int, turns: list[float]) -> str:
    entries = ["main: {position: [0 mm, 0 mm, 0 mm]}"]
    for at in range(number):
        x, y = 42 * cos(2 * pi * turns[at]), 42 * sin(2 * pi * turns[at])
        entries.append(f"P{at}: {{position: [{x:.6f} mm, {y:.6f} mm, 0 mm]}}")
    return f"axes: {{{', '.join(entries)}}}"


def test_planets_with_places_are_judged_there() -> None:
    even = [at / 5 for at in range(5)]
    train = planets(5, 24, 18, 60, more=placed(5, even))
    assert found(train) == [("A1", "error")]
    assert "off by 0.4 of a pitch" in words(train)
    # the nearest of the 84 places, as docs/closure.md has them
    steps = [at / 84 for at in (0, 17, 34, 50, 67)]
    assert found(planets(5, 24, 18, 60, more=placed(5, steps))) == []
    close = [0, 10 / 84, 40 / 84]
    assert found(planets(3, 24, 18, 60, more=placed(3, close))) == [("A3", "error")]


def test_planets_of_other_counts_are_not_equal() -> None:
    unlike = MESHING.format(
        ring=60,
        sun=24,
        links="  P: {wheels: {p: 18}}\n  Q: {wheels: {q: 19}}",
        joints="  - {pair: [arm, P], axis: P}\n  - {pair: [arm, Q], axis: Q}",
        gears="{pair: [s, p]}, {pair: [p, ring]}, {pair: [s, q]}, {pair: [q, ring]}",
    )
    assert found(load(unlike)) == []


@pytest.mark.parametrize(("a", "b"), [(0, 5), (24, 18), (17, 5), (10**12, 35)])
def test_greatest_common_divisors_are_sums_of_multiples(a: int, b: int) -> None:
    common, u, v = bezout(a, b)
    assert u * a + v * b == common
    assert a % common == b % common == 0
