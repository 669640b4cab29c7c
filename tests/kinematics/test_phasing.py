"""Phase closure: rules of makers, teeth placed in space, whole-number algebra, and what cannot be told."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from studies.residue_errors import first_float_failure, measure_phase_accuracy
from teeth3d import Wheel, best, in_space, misfits

from geartrain import GearTrain, GearTrainError
from geartrain.kinematics.phasing.azimuths import rational_angle
from geartrain.kinematics.phasing.mesh_phasing import find_divisibility_rule
from geartrain.spherical import Configuration, from_polyhedron, spherical_divisibility_rule, spherical_phasing

Data = dict[str, Any]


def position(radius: float, turn: Fraction | float, digits: int = 6) -> list[str]:
    x, y = radius * math.cos(math.tau * turn), radius * math.sin(math.tau * turn)
    return [f"{x:.{digits}f} mm", f"{y:.{digits}f} mm", "0 mm"]


def planetary(sun: int, planet: int, ring: int, turns: Sequence[Fraction | float], digits: int = 6) -> Data:
    """A sun, a ring on the frame, and planets at these parts of a turn."""
    count = range(len(turns))
    return {
        "links": {
            "frame": {"wheels": {"r": {"teeth": ring, "internal": True}}},
            "sun": {"wheels": {"s": sun}},
            "arm": {},
        }
        | {f"planet{k}": {"wheels": {f"p{k}": planet}} for k in count},
        "axes": {"main": {"position": ["0 mm", "0 mm", "0 mm"]}}
        | {f"P{k}": {"position": position((sun + planet) / 2, turn, digits)} for k, turn in enumerate(turns)},
        "revolutes": [{"pair": ["frame", "sun"], "axis": "main"}, {"pair": ["frame", "arm"], "axis": "main"}]
        + [{"pair": ["arm", f"planet{k}"], "axis": f"P{k}"} for k in count],
        "gears": [{"pair": pair} for k in count for pair in (["s", f"p{k}"], [f"p{k}", "r"])],
    }


def stepped(sun: int, first: int, second: int, ring: int, turns: Sequence[Fraction | float]) -> Data:
    """Planets with two wheels: one meets the sun, one the ring."""
    data = planetary(sun, first, ring, turns)
    for k in range(len(turns)):
        data["links"][f"planet{k}"]["wheels"] = {f"p{k}": first, f"q{k}": second}
        data["gears"][2 * k + 1] = {"pair": [f"q{k}", "r"]}
    return data


def ordinary(teeth: Sequence[int], places: Sequence[Sequence[object]], meshes: Iterable[tuple[int, int]]) -> Data:
    """Wheels w0, w1, ... on fixed parallel axes."""
    return {
        "links": {"frame": {}} | {f"g{k}": {"wheels": {f"w{k}": z}} for k, z in enumerate(teeth)},
        "axes": {f"A{k}": {"position": [*map(str, place), "0"]} for k, place in enumerate(places)},
        "revolutes": [{"pair": ["frame", f"g{k}"], "axis": f"A{k}"} for k in range(len(teeth))],
        "gears": [{"pair": [f"w{i}", f"w{j}"]} for i, j in meshes],
    }


def check_in_space(train: GearTrain) -> None:
    """The angles the train is given must fit, tooth for tooth, if it closes; if it misses nothing may fit."""
    closure = train.closure
    wheels, pairs = in_space(train)
    off = misfits(wheels, pairs, closure.angles)
    if closure.missing:
        assert best(wheels, pairs) > 1e-4
        errors = list(closure.errors.values())
        assert np.abs(off) == pytest.approx(np.abs(errors), abs=1e-4)
    else:
        assert np.abs(off).max() < 1e-4
        assert best(wheels, pairs) < 1e-4


def wrapped(value: Fraction) -> Fraction:
    return (value + Fraction(1, 2)) % 1 - Fraction(1, 2)


@pytest.mark.parametrize("count", range(2, 8))
def test_equal_planets_close_if_their_number_divides_the_teeth_of_sun_and_ring(count: int) -> None:
    turns = [Fraction(k, count) for k in range(count)]
    for sun, planet in product(range(12, 26), (9, 10, 13)):
        closure = GearTrain.declare(planetary(sun, planet, sun + 2 * planet, turns)).closure
        assert bool(closure) == ((2 * sun + 2 * planet) % count == 0)
        assert len(closure.loops) == count - 1
        assert closure.how in ("exact", "recognised")
        for loop in closure.loops:
            # the planets of a loop stand some n-ths of a turn apart
            inside = abs(Fraction(loop.inside["s"]))
            assert (inside * count).denominator == 1
            assert abs(loop.residue) == abs(wrapped(inside * (2 * sun + 2 * planet)))


def test_the_rule_of_a_planetary_is_found_in_words() -> None:
    for count, text in [(2, "2 divides zr + zs"), (3, "3 divides zr + zs"), (6, "6 divides zr + zs")]:
        closure = GearTrain.declare(planetary(24, 18, 60, [Fraction(k, count) for k in range(count)])).closure
        assert closure.rule.text == text


@pytest.mark.parametrize(("sun", "planet", "count"), [(24, 18, 3), (24, 18, 4), (24, 18, 5), (15, 12, 3), (14, 9, 4)])
def test_teeth_in_space_agree_about_planets(sun: int, planet: int, count: int) -> None:
    check_in_space(
        GearTrain.declare(planetary(sun, planet, sun + 2 * planet, [Fraction(k, count) for k in range(count)]))
    )


def test_planets_fit_at_every_multiple_of_a_turn_over_the_teeth_of_sun_and_ring_and_between_them_nowhere() -> None:
    sun, planet, ring = 19, 14, 47
    for step in (0, 11, 17, 25, 38):
        train = GearTrain.declare(planetary(sun, planet, ring, [0, Fraction(step, sun + ring)], 9))
        if step:
            assert train.closure.kind == "closes"
            check_in_space(train)
        off = GearTrain.declare(planetary(sun, planet, ring, [0, (step + 0.3) / (sun + ring)], 9))
        assert off.closure.kind == "misses"
        assert abs(float(off.closure.worst)) == pytest.approx(0.3, abs=1e-5)
        check_in_space(off)


def test_an_axis_that_points_against_its_parallels_counts_about_the_common_direction() -> None:
    data = planetary(19, 14, 47, [0, Fraction(17, 66)], 9)
    straight = GearTrain.declare(data).closure
    data["axes"]["P1"]["direction"] = [0, 0, -1]
    train = GearTrain.declare(data)
    assert train.closure.angles == pytest.approx(straight.angles)
    check_in_space(train)


def test_rounded_positions_are_taken_for_parts_of_a_turn_only_where_that_is_no_accident() -> None:
    thirds = [Fraction(k, 3) for k in range(3)]
    fine = GearTrain.declare(planetary(24, 18, 60, thirds, 3)).closure
    assert (fine.how, fine.worst) == ("recognised", 0)
    rough = GearTrain.declare(planetary(24, 18, 60, thirds, 1)).closure
    assert rough.how == "numeric"
    assert rough.kind == "unclear"
    assert "can be decided" in rough.text
    assert not rough
    square = GearTrain.declare(planetary(24, 18, 60, [Fraction(k, 4) for k in range(4)], 0)).closure
    assert (square.how, square.worst) == ("exact", 0)
    # a residue within what the last digits leave open is no miss, and one beyond is
    near = GearTrain.declare(planetary(19, 14, 47, [0, 25 / 66], 4)).closure
    assert near.kind == "closes"
    assert 0 < near.loops[0].slack < 0.05


def test_whole_millimetres_are_exact_and_a_third_of_a_turn_cannot_be_written_in_them() -> None:
    data = planetary(24, 18, 60, [Fraction(k, 3) for k in range(3)])
    for label, (x, y) in {"P0": (21000, 0), "P1": (-10500, 18187), "P2": (-10500, -18187)}.items():
        data["axes"][label]["position"] = [f"{x} mm", f"{y} mm", "0 mm"]
    closure = GearTrain.declare(data).closure
    assert closure.how == "numeric"
    assert closure.kind == "misses"
    assert abs(float(closure.worst)) < 1e-3


def test_four_gears_on_a_square_close_if_four_divides_the_alternating_sum_of_their_teeth() -> None:
    kinks = [(0, 0), (1, 0), (1, 1), (0, 1)]
    ring = [(0, 1), (1, 2), (2, 3), (3, 0)]
    for teeth in product((12, 13, 14, 15), repeat=4):
        closure = GearTrain.declare(ordinary(teeth, kinks, ring)).closure
        assert closure.how == "exact"
        total = teeth[0] - teeth[1] + teeth[2] - teeth[3]
        assert abs(closure.worst) == abs(wrapped(Fraction(total, 4)))
    check_in_space(GearTrain.declare(ordinary((12, 13, 14, 15), kinks, ring)))
    check_in_space(GearTrain.declare(ordinary((12, 13, 14, 17), kinks, ring)))


@settings(max_examples=60, deadline=None)
@given(st.tuples(*[st.integers(7, 40)] * 4), st.floats(0.05, 0.95), st.booleans())
def test_four_gears_on_a_quadrilateral_are_judged_as_teeth_in_space_are(
    teeth: tuple[int, ...], share: float, reflex: bool
) -> None:
    """Sides are the sums of teeth; the diagonal is free, and the fourth gear stands on either side of it."""
    a, b, c, d = (teeth[k] + teeth[(k + 1) % 4] for k in range(4))
    low, high = max(abs(a - b), abs(c - d)), min(a + b, c + d)
    diagonal = low + share * (high - low)
    if diagonal < 1e-3 or high - low < 0.1:
        return

    def kink(near: float, far: float, side: int) -> tuple[float, float]:
        x = (diagonal**2 + near**2 - far**2) / (2 * diagonal)
        return x, side * math.sqrt(max(near**2 - x**2, 0.0))

    places = [(0.0, 0.0), kink(a, b, 1), (diagonal, 0.0), kink(d, c, 1 if reflex else -1)]
    exact = [[Fraction(x).limit_denominator(10**9), Fraction(y).limit_denominator(10**9)] for x, y in places]
    train = GearTrain.declare(ordinary(teeth, exact, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    closure = train.closure
    wheels, pairs = in_space(train)
    assert best(wheels, pairs) == pytest.approx(abs(float(closure.worst)), abs=1e-5)
    off = misfits(wheels, pairs, closure.angles)
    assert np.abs(off) == pytest.approx(np.full(4, abs(float(closure.worst)) / 4), abs=1e-5)


def test_a_hexagon_of_idlers_round_a_wheel_is_six_loops_and_a_hexagonal_lattice_knows_its_angles() -> None:
    """Integer coordinates on the plane across (1, 1, 1) make exact sixths of a turn."""
    way = {"direction": [1, 1, 1]}
    spots = [(1, -1, 0), (1, 0, -1), (0, 1, -1), (-1, 1, 0), (-1, 0, 1), (0, -1, 1)]
    data = ordinary([12] * 6, [(0, 0)] * 6, [(k, (k + 1) % 6) for k in range(6)])
    data["axes"] = {f"A{k}": way | {"position": [str(x) for x in spot]} for k, spot in enumerate(spots)}
    closure = GearTrain.declare(data).closure
    assert (closure.how, closure.kind) == ("exact", "closes")
    for teeth in (9, 10, 11):  # three wheels of 12 and three of these, each with a sixth or a third of a turn inside
        for k in (1, 3, 5):
            data["links"][f"g{k}"] = {"wheels": {f"w{k}": teeth}}
        closure = GearTrain.declare(data).closure
        assert closure.how == "exact"
        assert abs(closure.worst) == abs(wrapped(Fraction(3 * (12 - teeth), 3)))


@pytest.mark.parametrize("count", [2, 3, 4, 5])
def test_stepped_planets_close_by_their_known_rule(count: int) -> None:
    """n gcd(z1, z2) divides z_sun z2 + z_ring z1, for planets that are all alike (Mueller)."""
    turns = [Fraction(k, count) for k in range(count)]
    for sun, first, second in product((17, 18, 20, 21, 24), (12, 14, 15), (8, 9, 10)):
        ring = sun + first + second
        train = GearTrain.declare(stepped(sun, first, second, ring, turns))
        expected = (sun * second + ring * first) % (count * math.gcd(first, second)) == 0
        assert bool(train.closure) == expected, (sun, first, second)


@pytest.mark.parametrize(
    ("sun", "first", "second", "count"), [(18, 12, 8, 2), (18, 8, 5, 2), (19, 6, 3, 3), (17, 15, 10, 2)]
)
def test_teeth_in_space_agree_about_stepped_planets(sun: int, first: int, second: int, count: int) -> None:
    check_in_space(
        GearTrain.declare(stepped(sun, first, second, sun + first + second, [Fraction(k, count) for k in range(count)]))
    )


def test_turning_one_wheel_of_a_stepped_planet_on_its_arbor_by_what_is_said_closes_the_loop() -> None:
    train = GearTrain.declare(stepped(19, 9, 5, 33, [0, Fraction(1, 3)]))
    (loop,) = train.closure.loops
    assert train.closure.kind == "misses"
    assert set(loop.retime) == {"p0", "q0", "p1", "q1"}
    wheels, pairs = in_space(train)
    for wheel, pitches in loop.retime.items():
        one = wheels[wheel]
        step = math.tau / one.teeth * pitches
        mark = np.array([math.cos(step), math.sin(step), 0.0])
        set_anew = Wheel(one.link, one.teeth, one.centre, one.axis, mark, one.internal, one.outward)
        assert best(wheels | {wheel: set_anew}, pairs) < 1e-5
        wrong = Wheel(one.link, one.teeth, one.centre, one.axis, mark * [1, -1, 1], one.internal, one.outward)
        assert best(wheels | {wheel: wrong}, pairs) > 1e-3


@pytest.mark.parametrize("teeth", [12, 13])
def test_a_loop_of_three_with_one_ring_in_it_keeps_its_half_pitch(teeth: int) -> None:
    """Ratios 20/40, 15/b, b/30 multiply to 1, and the weights 3, -4, 4 to an odd number of halves."""
    data = ordinary([20, teeth, 40], [(10, 0), (5, 5), (0, 0)], [(0, 2)])
    data["links"]["g0"]["wheels"]["w15"] = 15
    data["links"]["g2"]["wheels"] = {"w2": {"teeth": 40, "internal": True}, "w30": 30}
    data["gears"] += [{"pair": ["w15", "w1"]}, {"pair": ["w1", "w30"]}]
    train = GearTrain.declare(data)
    (loop,) = train.closure.loops
    assert (train.closure.how, sorted(map(abs, loop.weights))) == ("exact", [3, 4, 4])
    contacts = train.closure.problem.contacts
    numeric = sum(
        w * contacts.constant[[c.id for c in contacts.circuits].index(m)]
        for w, m in zip(loop.weights, loop.meshes, strict=True)
    )
    assert abs((numeric - float(loop.residue) + 0.5) % 1 - 0.5) < 1e-9
    check_in_space(train)


def test_two_rings_on_the_frame_are_mounted_each_as_its_planets_want_it() -> None:
    data = stepped(19, 14, 9, 42, [0, Fraction(1, 2)])
    data["links"]["frame"]["wheels"] = {f"r{k}": {"teeth": 42, "internal": True} for k in range(2)}
    for k in range(2):
        data["gears"][2 * k + 1] = {"pair": [f"q{k}", f"r{k}"]}
    train = GearTrain.declare(data)
    assert train.closure.kind == "open"
    assert set(train.closure.angles) >= {"r0", "r1", "sun"}
    check_in_space(train)


def kernel(rows: Sequence[Sequence[int]]) -> list[list[int]]:
    """A basis of all whole y with y A = 0, by whole row operations on [A | 1]."""
    wide = [[*map(int, row), *(int(at == k) for k in range(len(rows)))] for at, row in enumerate(rows)]
    done, columns = 0, len(rows[0])
    for column in range(columns):
        while len(live := [at for at in range(done, len(wide)) if wide[at][column]]) > 1:
            minimum = min(live, key=lambda at: abs(wide[at][column]))
            for at in live:
                if at != minimum:
                    times = wide[at][column] // wide[minimum][column]
                    wide[at] = [a - times * b for a, b in zip(wide[at], wide[minimum], strict=True)]
        if live:
            wide[done], wide[live[0]] = wide[live[0]], wide[done]
            done += 1
    return [row[columns:] for row in wide[done:]]


def willis(train: GearTrain) -> tuple[list[list[int]], list[str]]:
    """Rows of all pairs over links and wheels of the frame, from the declaration alone, for parallel axes."""
    declared = train.declaration
    columns = [*declared.links, *(f"{name}!" for name in declared.wheels)]
    rows = []
    for circuit in train.circuits:
        row = dict.fromkeys(columns, 0)
        for wheel, link, factor in zip(circuit.wheels, (circuit.i, circuit.j), (circuit.a, circuit.b), strict=True):
            row[f"{wheel}!" if link == "frame" else link] += factor
        row[circuit.carrier] -= circuit.a + circuit.b
        row["frame"] = 0
        rows.append([row[name] for name in columns])
    return rows, columns


COUNTS = st.sampled_from([4, 6, 8, 9, 10, 12, 15])


@st.composite
def compounds(draw: st.DrawFn) -> Data:
    """Compound wheels on a grid of fixed axes; counts depend on row or column, so ratios round a loop multiply to 1."""
    rows, columns = draw(st.integers(2, 3)), draw(st.integers(2, 3))
    across = [draw(COUNTS) for _ in range(columns)]  # a column's wheel that meets the next column
    back = [draw(COUNTS) for _ in range(columns)]
    up = [draw(COUNTS) for _ in range(rows)]
    down = [draw(COUNTS) for _ in range(rows)]
    links: Data = {"frame": {}}
    axes, joints, gears = {}, [], []
    for r, c in product(range(rows), range(columns)):
        name = f"{r}{c}"
        links[name] = {"wheels": {f"x{name}": across[c], f"b{name}": back[c], f"u{name}": up[r], f"d{name}": down[r]}}
        place = [draw(st.integers(-5, 5)) + 20 * c, draw(st.integers(-5, 5)) + 20 * r]
        axes[f"A{name}"] = {"position": [*map(str, place), "0"]}
        joints.append({"pair": ["frame", name], "axis": f"A{name}"})
        if c:
            gears.append({"pair": [f"x{r}{c - 1}", f"b{name}"]})
        if r:
            gears.append({"pair": [f"u{r - 1}{c}", f"d{name}"]})
    return {"links": links, "axes": axes, "revolutes": joints, "gears": gears}


def judged_by_algebra(train: GearTrain) -> float:
    """The largest residue over a basis of all whole conditions, with constants from the closure's own contacts."""
    rows, _ = willis(train)
    constants = train.closure.problem.contacts.constant
    totals = [sum(Fraction(y) * Fraction(c) for y, c in zip(row, constants, strict=True)) for row in kernel(rows)]
    return max((abs(float(wrapped(total))) for total in totals), default=0.0)


def round_constants(train: GearTrain, draw: st.DataObject, denominator: int) -> None:
    """Constants drawn as small fractions, so that closing sets are met too."""
    contacts = train.closure.problem.contacts
    drawn = [draw.draw(st.integers(0, denominator - 1)) / denominator for _ in contacts.circuits]
    contacts.__dict__["constant"] = np.array(drawn)
    apart = [((2 * k, 2 * k + 1)) for k in range(len(drawn))]
    object.__setattr__(contacts, "family", apart)
    contacts.__dict__["doubt"] = np.full(len(drawn), 1e-9)


@settings(max_examples=150, deadline=None)
@given(compounds(), st.data(), st.sampled_from([1, 2, 3, 4, 6]))
def test_conditions_on_compound_wheels_are_all_whole_conditions_there_are(
    data: Data, draw: st.DataObject, denominator: int
) -> None:
    train = GearTrain.declare(data)
    round_constants(train, draw, denominator)
    closure = train.closure
    assert closure.rigid == 0
    assert closure.problem.complete
    assert bool(closure) == (judged_by_algebra(train) < 1e-7)
    if closure:
        assert max(map(abs, closure.last_errors.values())) < 1e-7
    own = closure.problem.conditions
    cycles = [[condition.row.get(k, 0) for k in range(len(data["gears"]))] for condition in own]
    rows, _ = willis(train)
    assert np.array_equal(np.array(cycles, object) @ np.array(rows, object), np.zeros((len(own), len(rows[0]))))


def coupled(sun: int, planet: int, ring: int, copies: int, places: Sequence[tuple[int, int]]) -> Data:
    """Carriers of their own, geared together by wheels of one count, between one sun and one ring: ratios agree."""
    axis = {"main": {"position": ["0", "0", "0"]}}
    links: Data = {
        "frame": {},
        "sun": {"wheels": {"s": sun}},
        "ring": {"wheels": {"r": {"teeth": ring, "internal": True}}},
    }
    links["lay"] = {"wheels": {f"l{k}": 20 for k in range(copies)}}
    joints = [{"pair": ["frame", "sun"], "axis": "main"}, {"pair": ["frame", "ring"], "axis": "main"}]
    joints.append({"pair": ["frame", "lay"], "axis": "L"})
    gears = []
    for k in range(copies):
        links[f"arm{k}"] = {"wheels": {f"a{k}": 30}}
        links[f"planet{k}"] = {"wheels": {f"p{k}": planet}}
        joints += [{"pair": ["frame", f"arm{k}"], "axis": "main"}, {"pair": [f"arm{k}", f"planet{k}"], "axis": f"P{k}"}]
        gears += [{"pair": ["s", f"p{k}"]}, {"pair": [f"p{k}", "r"]}, {"pair": [f"a{k}", f"l{k}"]}]
        axis[f"P{k}"] = {"position": [*map(str, places[k]), "0"]}
    axis["L"] = {"position": ["50", "0", "0"]}
    return {"links": links, "axes": axis, "revolutes": joints, "gears": gears}


@settings(max_examples=60, deadline=None)
@given(st.integers(2, 4), st.integers(8, 30), st.data(), st.sampled_from([1, 2, 3]))
def test_carriers_geared_together_are_requested_for_what_only_all_their_meshes_fulfil(
    copies: int, sun: int, draw: st.DataObject, denominator: int
) -> None:
    train = GearTrain.declare(coupled(sun, 10, sun + 20, copies, [(21, k) for k in range(copies)]))
    rows, _ = willis(train)
    free = len(kernel(rows))
    assert free == copies - 1
    round_constants(train, draw, denominator)
    assert len(train.closure.problem.conditions) == free
    assert bool(train.closure) == (judged_by_algebra(train) < 1e-7)
    if train.closure:
        assert max(map(abs, train.closure.last_errors.values())) < 1e-6
    assert all(not loop.gears and "together" in loop.text for loop in train.closure.loops)


def antiprism(n: int, latitude: float) -> Configuration:
    """Two caps and a zigzag of 2n gears north and south by turns, each in mesh with its cap and its neighbours."""
    c, s = math.cos(latitude), math.sin(latitude)
    sides = [
        (c * math.cos(math.pi * k / n), c * math.sin(math.pi * k / n), s if k % 2 == 0 else -s) for k in range(2 * n)
    ]
    meshes = [(k, (k + 1) % (2 * n)) for k in range(2 * n)] + [(k, 2 * n + k % 2) for k in range(2 * n)]
    axes = np.array([*sides, (0, 0, 1), (0, 0, -1)])
    names = tuple(f"g{k}" for k in range(2 * n + 2))
    return Configuration(names, axes, tuple(meshes), ("3",) * 2 * n + ("n",) * 2, (0,) * (2 * n) + (n, n))


def prism_without_sides(n: int) -> Configuration:
    axes = [(math.cos(math.tau * k / n), math.sin(math.tau * k / n), 0) for k in range(n)] + [(0, 0, 1), (0, 0, -1)]
    meshes = tuple((k, n + cap) for k in range(n) for cap in (0, 1))
    names = tuple(f"g{k}" for k in range(n + 2))
    return Configuration(names, np.array(axes), meshes, ("side",) * n + ("cap",) * 2, (2,) * n + (n, n))


RULES = {
    "octahedron": "always",
    "cuboctahedron": "3 divides z3 and 2 divides z4",
    "icosidodecahedron": "3 divides z3 and 5 divides z5",
    "rhombicuboctahedron": "3 divides z3 and 4 divides z4a + 2 z4b",
    "rhombicosidodecahedron": "3 divides z3 and 2 divides z4 and 5 divides z5",
    "tetrahedron and idlers": "2 divides ze",
    "cube and idlers": "4 divides z4 + 2 ze",
    "octahedron and idlers": "3 divides z3",
    "dodecahedron and idlers": "5 divides z5 and 2 divides ze",
    "icosahedron and idlers": "3 divides z3 and 2 divides ze",
    "cuboctahedron and idlers": "3 divides z3 and 2 divides z4",
    "icosidodecahedron and idlers": "3 divides z3 and 5 divides z5",
}
SETS: dict[str, tuple[Configuration, str]] = {
    **{
        name: (from_polyhedron(name.removesuffix(" and idlers"), "faces+edges" if "idlers" in name else "faces"), text)
        for name, text in RULES.items()
    },
    **{
        f"prism of {n} without sides": (prism_without_sides(n), f"{m} divides z[cap]")
        for n, m in ((3, 3), (4, 2), (5, 5), (6, 3))
    },
}


def without_angles(config: Configuration) -> Configuration:
    """The same set with no angle known but in floats."""
    return Configuration(config.names, config.axes, config.meshes, config.kinds, (0,) * len(config.names))


def on_sphere(config: Configuration, teeth: Mapping[str, int]) -> tuple[dict[str, Wheel], list[tuple[str, str]]]:
    wheels = {}
    for at, (name, kind) in enumerate(zip(config.names, config.kinds, strict=True)):
        mark = config.frame(at)[0]
        wheels[name] = Wheel(name, teeth[kind], np.zeros(3), config.axes[at], mark)
    return wheels, [(config.names[i], config.names[j]) for i, j in config.meshes]


@pytest.mark.parametrize("name", SETS)
def test_rules_of_sets_are_found_and_agree_with_floats_for_all_tooth_numbers_of_a_range(name: str) -> None:
    config, text = SETS[name]
    rule = spherical_divisibility_rule(config)
    assert rule.text == text
    kinds = list(dict.fromkeys(config.kinds))
    bare = without_angles(config)
    for counts in product(range(10, 22 if len(config.names) < 40 else 16, 1), repeat=min(len(kinds), 2)):
        teeth = dict(zip(kinds, (*counts, 12), strict=False))
        numeric = spherical_phasing(bare, teeth)
        assert numeric.how == "numeric"
        assert bool(numeric) == rule.holds(teeth), teeth


@pytest.mark.parametrize(
    ("name", "teeth"),
    [
        ("octahedron", {"3": 7}),
        ("octahedron", {"3": 10}),
        ("cuboctahedron", {"3": 9, "4": 8}),
        ("cuboctahedron", {"3": 9, "4": 9}),
        ("cuboctahedron", {"3": 8, "4": 8}),
        ("icosidodecahedron", {"5": 10, "3": 6}),
        ("icosidodecahedron", {"5": 12, "3": 6}),
        ("icosidodecahedron", {"5": 11, "3": 7}),
        ("rhombicuboctahedron", {"4a": 10, "4b": 9, "3": 6}),
        ("rhombicuboctahedron", {"4a": 10, "4b": 10, "3": 6}),
        ("rhombicosidodecahedron", {"5": 15, "4": 12, "3": 6}),
        ("cube and idlers", {"4": 10, "e": 9}),
        ("cube and idlers", {"4": 10, "e": 8}),
        ("prism of 4 without sides", {"side": 9, "cap": 10}),
        ("prism of 4 without sides", {"side": 9, "cap": 11}),
    ],
)
def test_teeth_in_space_agree_about_sets_on_a_sphere(name: str, teeth: dict[str, int]) -> None:
    config, _ = SETS[name]
    closure = spherical_phasing(config, teeth)
    wheels, pairs = on_sphere(config, teeth)
    off = misfits(wheels, pairs, closure.angles)
    together = best(wheels, pairs)
    assert np.abs(off) == pytest.approx(np.abs(list(closure.errors.values())) if not closure else 0.0, abs=1e-9)
    assert (together < 1e-9) == bool(closure)


def test_largest_errors_of_the_icosidodecahedron_are_those_known() -> None:
    known = {(5, 3): 0, (10, 6): 0, (20, 12): 0, (25, 15): 0, (15, 6): 0, (20, 9): 0, (35, 24): 0}
    known |= {(12, 6): Fraction(2, 5), (10, 4): Fraction(1, 3), (25, 16): Fraction(1, 3), (11, 7): Fraction(7, 15)}
    for (five, three), error in known.items():
        closure = spherical_phasing(from_polyhedron("icosidodecahedron"), {"5": five, "3": three})
        assert closure.last == pytest.approx(float(error), abs=1e-12)
        wheels, pairs = on_sphere(from_polyhedron("icosidodecahedron"), {"5": five, "3": three})
        assert best(wheels, pairs) == pytest.approx(float(error), abs=1e-9)
        loop = wrapped(Fraction(2 * three, 3) - Fraction(2 * five, 5))
        assert {abs(one.residue) for one in closure.loops} == {abs(loop)}
        assert all(len(one.gears) == 4 for one in closure.loops)


@pytest.mark.parametrize("n", [4, 5, 6, 8])
def test_the_residue_of_an_antiprism_is_that_of_its_formula(n: int) -> None:
    """z_n / n - 4 z_3 theta / 2 pi, with theta the angle at a side gear between its cap and a neighbour.

    In the loop cap - side - neighbour - next side both sides have theta. The neighbour's own cap is outside: it has
    2 pi - 2 theta, and its z_3 whole teeth go out.
    """
    for latitude in (0.2, 0.3, 0.4):
        config = antiprism(n, latitude)
        ours = config.azimuth(0, 2 * n), config.azimuth(0, 1)
        theta = abs((ours[0] - ours[1] + math.pi) % math.tau - math.pi)
        for cap, side in [(24, 12), (29, 17), (36, 18)]:
            closure = spherical_phasing(config, {"n": cap, "3": side})
            expected = cap / n - 4 * side * theta / math.tau
            near = [one for one in closure.loops if len(one.gears) == 4]
            assert len(near) == len(closure.loops) == 2 * n - 1
            for loop in near:
                assert loop.how == "numeric"
                found = float(loop.residue)
                assert min(abs((found - sign * expected + 0.5) % 1 - 0.5) for sign in (1, -1)) < 1e-12


@pytest.mark.parametrize(
    ("spiders", "left", "right"), [(2, 16, 16), (2, 15, 16), (3, 16, 16), (3, 15, 18), (4, 14, 18)]
)
def test_a_bevel_differential_closes_if_its_spiders_divide_the_teeth_of_both_sides(
    spiders: int, left: int, right: int
) -> None:
    ways = [
        [0, f"{math.cos(math.tau * k / spiders):.9f}", f"{math.sin(math.tau * k / spiders):.9f}"]
        for k in range(spiders)
    ]
    data: Data = {
        "links": {
            "frame": {},
            "crown": {},
            "left": {"wheels": {"l": {"teeth": left, "kind": "bevel"}}},
            "right": {"wheels": {"r": {"teeth": right, "kind": "bevel", "facing": -1}}},
        }
        | {f"spider{k}": {"wheels": {f"p{k}": {"teeth": 11, "kind": "bevel"}}} for k in range(spiders)},
        "axes": {"axle": {"direction": [1, 0, 0]}} | {f"S{k}": {"direction": way} for k, way in enumerate(ways)},
        "revolutes": [{"pair": ["frame", name], "axis": "axle"} for name in ("crown", "left", "right")]
        + [{"pair": ["crown", f"spider{k}"], "axis": f"S{k}"} for k in range(spiders)],
        "gears": [{"pair": [side, f"p{k}"]} for k in range(spiders) for side in ("l", "r")],
    }
    train = GearTrain.declare(data)
    if left != right:  # unequal sides would not be borne by spiders at right angles to the axle; their teeth may meet
        assert train.closure.problem.parts.breaking == []
    assert bool(train.closure) == ((left + right) % spiders == 0)
    check_in_space(train)


def test_an_angle_between_whole_vectors_is_rational_if_and_only_if_floats_see_a_multiple_of_a_24th() -> None:
    box = [v for v in product(range(-2, 4), repeat=3) if any(v)][::2]
    for u, v in product(box, box):
        turn = math.atan2(float(np.linalg.norm(np.cross(u, v))), float(np.dot(u, v))) / math.tau
        near = abs(24 * turn - round(24 * turn)) < 1e-9
        assert (rational_angle(u, v, turn) is not None) == near, (u, v)


@given(
    st.lists(
        st.dictionaries(st.sampled_from("abc"), st.fractions(max_denominator=12), max_size=3), min_size=1, max_size=4
    )
)
def test_a_rule_holds_exactly_where_all_forms_are_whole(forms: list[dict[str, Fraction]]) -> None:
    rule = find_divisibility_rule(forms)
    for counts in product(range(6), (0, 1, 5, 7), (0, 2, 3, 11)):
        teeth = dict(zip("abc", counts, strict=True))
        whole = all(sum(f * teeth[k] for k, f in form.items()) % 1 == 0 for form in forms)
        assert rule.holds(teeth) == whole
    assert all(math.gcd(m, *terms.values()) == 1 for m, terms in rule.conditions)


def test_a_rule_has_no_condition_that_follows_from_others() -> None:
    quarter, half = Fraction(1, 4), Fraction(1, 2)
    rule = find_divisibility_rule([{"3": half, "5": quarter}, {"3": half, "5": 3 * quarter}])
    assert rule.text == "4 divides 2 z3 + z5"
    assert find_divisibility_rule([{"3": Fraction(1, 6), "sun": Fraction(1, 6)}]).text == "6 divides z[3] + z[sun]"
    assert find_divisibility_rule([{"3": Fraction(2)}]).text == "always"


def test_backlash_takes_up_a_small_miss_and_not_a_large_one() -> None:
    data = ordinary([20, 20, 20, 20], [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (3, 0)])
    data["tooth_form"] = {"form": "triangular", "half_angle": "30 deg", "window": 0.1}
    closure = GearTrain.declare(data).closure
    assert closure.fits is True
    assert set(closure.backlashes) == {"w0~w1", "w1~w2", "w2~w3", "w3~w0"}
    (backlash,) = {round(backlash, 9) for backlash in closure.backlashes.values()}
    small = 1e-4  # of w2 moved outwards along the diagonal; errors grow in proportion
    data["axes"]["A2"]["position"] = [str(1 + Fraction(1, 10**4))] * 2 + ["0"]
    rate = GearTrain.declare(data).closure.spread / small
    for part in (0.9, 1.1):
        shift = Fraction(part * backlash / 2 / rate).limit_denominator(10**9)
        data["axes"]["A2"]["position"] = [str(1 + shift)] * 2 + ["0"]
        closure = GearTrain.declare(data).closure
        assert closure.kind == "misses"
        assert closure.spread == pytest.approx(part * backlash / 2, rel=0.05)
        assert closure.fits is (part < 1)
    del data["tooth_form"]
    assert GearTrain.declare(data).closure.fits is None


def test_loops_through_axes_without_positions_are_counted_and_not_judged() -> None:
    data = planetary(24, 18, 60, [Fraction(k, 3) for k in range(3)])
    del data["axes"]["P1"]
    closure = GearTrain.declare(data).closure
    assert (closure.kind, len(closure.loops), closure.unjudged) == ("closes", 1, 1)
    assert "positions of its axes are not declared" in closure.text
    bare = GearTrain.declare({key: value for key, value in data.items() if key != "axes"}).closure
    assert (bare.kind, bare.unjudged, bool(bare)) == ("open", 2, True)
    assert json.dumps(bare.to_dict())


def test_a_loop_that_cannot_turn_is_not_requested_for_phases() -> None:
    data = ordinary([12, 12, 12], [(0, 0), (2, 0), (1, Fraction(7, 4))], [(0, 1), (1, 2), (2, 0)])
    closure = GearTrain.declare(data).closure
    assert (closure.kind, closure.rigid) == ("open", 1)
    assert "cannot turn" in closure.text


def test_what_is_answered_can_be_read_and_written() -> None:
    closure = GearTrain.declare(planetary(24, 18, 61, [Fraction(k, 3) for k in range(3)])).closure
    assert closure.text.splitlines() == [
        "phase closure: 2 of 2 loops miss",
        "  p1 - s - p0 - r - p1 misses by 1/3 pitch at p1~r (angles recognised)",
        "  p2 - s - p0 - r - p2 misses by 1/3 pitch at p2~r (angles recognised)",
        "  assembled one after the other, the last meshes are off by up to 0.333333 pitch",
        "  distributed over all meshes, errors are up to 0.166667 pitch",
    ]
    told = json.loads(json.dumps(closure.to_dict()))
    assert told["verdict"] == "misses"
    assert told["worst"] == "1/3"
    assert told["rule"]["text"] == "3 divides zr + zs"
    assert set(told["wheels"]) == {"s", "r", "p0", "p1", "p2"}
    assert 0 <= told["wheels"]["s"] < 360 / 24


def test_tooth_numbers_must_be_chosen_and_regular_gears_must_be_regular() -> None:
    with pytest.raises(GearTrainError, match="no tooth number is given for 5"):
        spherical_phasing(from_polyhedron("icosidodecahedron"), {"3": 12})
    config = from_polyhedron("cuboctahedron")
    wrong = Configuration(config.names, config.axes, config.meshes, config.kinds, (7,) * len(config.names))
    with pytest.raises(GearTrainError, match="regular"):
        spherical_phasing(wrong, {"3": 12, "4": 12})


def test_a_lattice_is_judged_by_its_squares() -> None:
    side = 30
    cells = list(product(range(side), range(side)))
    at = {cell: k for k, cell in enumerate(cells)}
    meshes = [(at[c], at[d]) for c in cells for d in ((c[0] + 1, c[1]), (c[0], c[1] + 1)) if d in at]
    teeth = [12 + 4 * ((x * 7 + y * 3) % 5) for x, y in cells]
    closure = GearTrain.declare(ordinary(teeth, cells, meshes)).closure
    assert (closure.how, closure.kind) == ("exact", "closes")
    assert len(closure.loops) == (side - 1) ** 2
    assert {len(loop.gears) for loop in closure.loops} == {4}
    teeth[at[3, 4]] += 1
    broken = GearTrain.declare(ordinary(teeth, cells, meshes)).closure
    assert len(broken.missing) == 4
    assert all("w94" in broken.loops[one].gears for one in broken.missing)
    assert broken.spread < broken.last


def test_distributed_errors_are_those_of_a_dense_solution() -> None:
    requested = spherical_phasing(from_polyhedron("icosidodecahedron"), {"5": 12, "3": 6}).problem
    rows, right = requested._node_rows, requested.errors(requested.tree_angles)
    matrix = np.zeros((len(right), rows.width))
    np.add.at(matrix, (np.arange(len(right))[:, None], rows.columns), rows.factors)
    dense = right - matrix @ np.linalg.lstsq(matrix, right, rcond=1e-11)[0]
    assert right - rows.times(rows.least_squares(right)) == pytest.approx(dense, abs=1e-9)


def test_floats_fail_where_they_say_they_may() -> None:
    for found in measure_phase_accuracy([10**k for k in range(1, 17)]):
        assert found.error <= found.bound
    assert first_float_failure() in (10**13, 10**14, 10**15)
