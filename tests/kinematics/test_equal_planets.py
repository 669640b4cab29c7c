"""Equal planets: whether all can be put in and have room, against the teeth themselves."""

from __future__ import annotations

import random
from fractions import Fraction
from math import acos, asin, ceil, cos, floor, hypot, pi, radians, sin, sqrt

import pytest
from test_buildability import distance_of

from geartrain import GearTrain, load

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
        gears += [f"{{pair: [s, p{at}]}}", f"{{pair: [{'p' if outer is None else 'q'}{at}, ring]}}"]
    parts = {"links": "\n".join(links), "joints": "\n".join(joints), "gears": ", ".join(gears)}
    return load(MESHING.format(ring=ring, sun=f"{{teeth: {sun}{size}}}", **parts) + more + "\n")


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


@pytest.mark.parametrize("stepped", [False, True])
def test_random_planets_go_in_as_their_teeth_say(stepped: bool) -> None:
    draw = random.Random(21)
    seen = set()
    for _ in range(300):
        number, sun, inner, outer = draw.randint(2, 6), draw.randint(8, 40), draw.randint(8, 40), draw.randint(8, 40)
        ring = draw.randint(outer + 10, 120) if stepped else sun + 2 * inner
        fits = go_in(number, sun, inner, ring, outer if stepped else inner)
        seen.add(fits)
        rules = dict(found(planets(number, sun, inner, ring, outer if stepped else None, module=None)))
        assert (("A2" if stepped else "A1") in rules) != fits, (number, sun, inner, outer, ring)
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
        assert "use 2, 3, 4 or 6 planets, which can be evenly spaced" in words(train)
        assert "space neighbours by 16 or 17 of these steps (4 of the gaps with 17)" in words(train)
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
    assert "have a clearance of only 0.2899 mm" in words(train)
    assert 2 * (70 * sin(pi / 5) - 41) == pytest.approx(0.2899, abs=5e-5)


AROUND = """
links:
  frame: {{}}
  sun: {{wheels: {{s: {sun}}}}}
  planet: {{wheels: {{p: {planet}}}, copies: {number}}}
  arm: {{}}
revolutes: {{main: [frame, sun, arm], P: [arm, planet]}}
gears: [{pair}]
inputs: {{sun: 1}}
"""


def around(number: int, sun: object, planet: object, form: str = "", pair: str = "s, p") -> GearTrain:
    """Equal planets that mesh with a sun only."""
    form = f", tooth_form: {form}" if form else ""
    return load(AROUND.format(number=number, sun=sun, planet=planet, pair=f"{{pair: [{pair}]{form}}}"))


def cycloidal_tip(z: int, mate: int, arc: float) -> float:
    """Tip radius (modules) of an epicycloid that runs with a radial dedendum over an arc (pitches).

    The rolling circle, of a quarter of the mate's teeth, has then rolled so far that its tracing point is at the end of
    a chord 2 rho sin(f) that leaves the common tangent at f = arc pi/(2 rho).
    """
    R, rho = z / 2, mate / 4
    return sqrt(R**2 + 4 * rho * (R + rho) * sin(arc * pi / (2 * rho)) ** 2)


LEAN = radians(20)


@pytest.mark.parametrize(
    ("form", "pair", "tip", "distance"),
    [
        ("cycloidal", "s, p", cycloidal_tip(18, 17, 0.5), 17.5),
        ("{form: cycloidal, arcs: [1, 1/2]}", "s, p", cycloidal_tip(18, 17, 1), 17.5),  # by 0.4412 modules
        ("{form: cycloidal, addendum: [1, 1.25]}", "s, p", 10.25, 17.5),
        ("involute", "s, p", 10, 17.5),
        ("{form: involute, addendum: [1, 1.2]}", "s, p", 10.2, 17.5),
        ("{form: involute, addendum: [1.4, 1]}", "p, s", 10.4, 17.5),
        ("{form: involute, shift: [-0.3, 0.3]}", "s, p", 10.3, 17.5),
        ("{form: involute, shift: [0, 0.5]}", "s, p", 10.5, distance_of(0.5, 35)),
        ("{form: involute, shift: [0.6, -0.4]}", "s, p", 9.6, distance_of(0.2, 35)),
        ("{form: lantern, pin_diameter: 2.8}", "s, p", 10.4, 17.5),  # pins of the planet
        ("{form: lantern, pin_diameter: 1.5, addendum: 1.3}", "p, s", 10.3, 17.5),  # the mate of the sun's pins
        ("{form: circular_arc, addendum: [1, 1.25], radius: 2, thickness: 1}", "s, p", 10.25, 17.5),
        ("{form: triangular, half_angle: 30 deg, radii: [9.4, 10], centre_distance: 18}", "s, p", 10 * 17.5 / 18, 17.5),
    ],
)
def test_tips_of_neighbours_end_where_declared_teeth_end(form: str, pair: str, tip: float, distance: float) -> None:
    """Five planets of 18 about a sun of 17: teeth of addendum 1 would have 0.5725 modules of room."""
    gap = 2 * distance * sin(pi / 5) - 2 * tip
    train = around(5, 17, 18, form, pair)
    expected = [] if gap >= 0.2 else [("A3", "note" if gap > 0 else "error")]
    assert found(train) == expected
    if expected:
        assert f"{'have a clearance of only' if gap > 0 else 'overlap by'} {abs(gap):.4g} modules" in words(train)


def test_tips_of_helical_planets_are_counted_across_the_axis() -> None:
    """In transverse modules an addendum is 1/cos(helix) times lower; lengths are in mm of 2/cos(20 deg)."""
    wheels = (f"{{teeth: {z}, module: 2 mm, helix_angle: 20 deg, hand: {hand}}}" for z, hand in
              ((31, "left"), (39, "right")))  # fmt: skip
    train = around(5, *wheels, "{form: involute, addendum: 1.06}")
    gap = 70 * sin(pi / 5) - 39 - 2 * 1.06 * cos(LEAN)
    assert found(train) == [("A3", "note")]
    assert f"have a clearance of only {gap * 2 / cos(LEAN):.4g} mm" in words(train)


@pytest.mark.parametrize("number", [4, 5, 6, 7, 8])
def test_teeth_that_are_not_declared_may_be_shorter(number: int) -> None:
    """A note as far down as an addendum of half a module, and the addendum at which they fit is named."""
    draw, seen = random.Random(number), set()
    for _ in range(60):
        sun, planet = draw.randint(8, 30), draw.randint(8, 40)
        fits = ((sun + planet) * sin(pi / number) - planet) / 2
        if abs(fits - 0.5) < 1e-6 or abs(fits - 1) < 1e-6:
            continue
        expected = [] if fits >= 1.1 else [("A3", "note" if fits > 0.5 else "error")]
        train = around(number, sun, planet)
        assert found(train) == expected, (sun, planet)
        seen.add(fits > 0.5)
        named = f"unless their addenda are at most {floor(fits * 1000) / 1000:g};"
        assert (named in words(train)) == (0.5 < fits < 1), (sun, planet, fits)
    assert seen == {True, False}


def test_planets_with_shorter_teeth_have_room_elsewhere() -> None:
    """Five of 15 about 13: 1/56 turn apart they need 11 steps at addendum 1/2 and 12 at addendum 1, and 5 * 12 > 56."""
    steps = [ceil(56 * asin((15 + 2 * height) / 28) / pi) for height in (0.5, 1)]
    assert steps == [11, 12]
    assert found(planets(5, 13, 15, 43, module=None)) == [("A1", "note"), ("A3", "note")]
    declared = planets(5, 13, 15, 43, module=None, more="tooth_form: involute")
    assert found(declared) == [("A1", "error"), ("A3", "error")]


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
        told = f"of neighbouring planet sets collide ({number} sets)" in words(load(text))
        assert told == (gap < 0), (number, sun, p, q, ring)


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
    assert "misaligned by 0.4 pitch" in words(train)
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
