"""Torque over a turn by plain statics, position by position: what the printed cases say, and what trains answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from math import acos, asin, cos, hypot, log, pi, sin, sqrt
from random import Random
from typing import Any

import numpy as np
import pytest
from outline_touch import Outlines
from plane_statics import FRAME, Balance, Hinge, Mechanism, Touch, flanks, rolling, toothed
from scipy.optimize import brentq, minimize_scalar

from geartrain import GearTrain, load

NODES, WEIGHTS = np.polynomial.legendre.leggauss(120)


def mean(torque: Callable[[float], float], corners: Sequence[float]) -> float:
    """Over a turn whose smooth stretches end at these places: Gauss-Legendre in each."""
    total = 0.0
    for start, end in pairwise(corners):
        middle, half = (start + end) / 2, (end - start) / 2
        total += half * sum(w * torque(middle + half * x) for x, w in zip(NODES, WEIGHTS, strict=True))
    return total / (corners[-1] - corners[0])


def greatest(torque: Callable[[float], float], start: float, end: float) -> tuple[float, float]:
    """Where a smooth torque is greatest in a stretch, and how great."""
    found = minimize_scalar(lambda x: -torque(x), bounds=(start, end), method="bounded", options={"xatol": 1e-10})
    return found.x, -found.fun


def pin_in_slot(S: float, r: float, e: float, f: float, drag: float = 0.0) -> Mechanism:
    """A pin at r on `pin` about the origin, in a radial slot of `slot` about (e, 0); S from the line of centres."""
    point = r * cos(S), r * sin(S)
    away = hypot(point[0] - e, point[1])
    normal = -point[1] / away, (point[0] - e) / away
    hinges = [Hinge(FRAME, "pin", (0.0, 0.0)), Hinge(FRAME, "slot", (e, 0.0), drag)]
    return Mechanism(hinges, [flanks("pin", "slot", point, normal, f)])


def only(found: list[Balance]) -> Balance:
    assert len(found) == 1
    return found[0]


def pushed(r: float, e: float, f: float, load: float, drag: float = 0.0) -> Callable[[float], float]:
    """Torque at the crank with the pin, by its angle."""
    return lambda S: only(pin_in_slot(S, r, e, f, drag).balances({"pin": 1.0}, {"slot": load}, "pin")).torque


def test_a_pin_drives_a_slot() -> None:
    torque = pushed(10, 8, 0.3, -10)
    found = mean(torque, (-pi, 0, pi))
    assert found == pytest.approx(10 * (1 + 0.3 / pi * log(18 / 2)), rel=1e-12)
    assert found == pytest.approx(12.0981949, abs=5e-8)
    where, peak = greatest(torque, -0.1, 0)
    assert peak == pytest.approx(50.9784589, abs=5e-8)
    assert where == pytest.approx(-0.032612, abs=5e-7)
    assert 10 / found == pytest.approx(0.8265696, abs=5e-8)


def test_the_efficiency_at_a_constant_torque_of_the_pin_is_another_mean() -> None:
    def slot_torque(S: float) -> float:
        found = only(pin_in_slot(S, 10, 8, 0.3).balances({"pin": 1.0}, {"pin": 1.0}, "slot"))
        speed = pin_in_slot(S, 10, 8, 0.3).motion({"pin": 1.0})["slot"][2]
        return -found.torque * speed

    assert mean(slot_torque, (-pi, 0, pi)) == pytest.approx(0.8357499, abs=5e-8)


def by_slot(psi: float, f: float) -> list[Balance]:
    """The slot of r = 10, e = 8 drives its pin against 10 on it, at the slot's angle from the line of centres."""
    S = psi - asin(8 / 10 * sin(psi))  # sine law in the triangle of both axes and the pin
    return pin_in_slot(S, 10, 8, f).balances({"slot": 1.0}, {"pin": -10.0}, "slot")


@pytest.mark.parametrize(("f", "middle", "peak"), [(0.3, 12.994123, 21.847911), (0.7, 36.9620, 153.3510)])
def test_a_slot_drives_its_pin(f: float, middle: float, peak: float) -> None:
    def torque(psi: float) -> float:
        return only(by_slot(psi, f)).torque

    assert mean(torque, np.linspace(-pi, pi, 9).tolist()) == pytest.approx(middle, abs=6e-7 if f < 0.5 else 6e-5)
    peaks = [greatest(torque, start, start + pi / 4)[1] for start in np.linspace(0, 3 * pi / 4, 4)]
    assert max(peaks) == pytest.approx(peak, abs=6e-7 if f < 0.5 else 6e-5)


def test_a_slot_locks_its_pin_where_friction_is_too_great() -> None:

    def pushes(psi: float, f: float) -> bool:
        found = by_slot(psi, f)
        return len(found) == 1 and found[0].torque > 0

    edge = asin(10 / 8 / sqrt(1 + 0.8**2))
    share = 1 - 2 * edge / pi
    assert share == pytest.approx(0.139505, abs=5e-7)
    for psi in (edge, pi - edge):
        inwards = 1 if psi < pi / 2 else -1
        assert pushes(psi - inwards * 1e-6, 0.8)
        assert not pushes(psi + inwards * 1e-6, 0.8)
    assert pushes(pi / 2, 0.7499)
    assert not pushes(pi / 2, 0.7501)


def swinging(S: float) -> float:
    """Speed of a follower, r = 6 and e = 10, over its pin's."""
    return pin_in_slot(S, 6, 10, 0.0).motion({"pin": 1.0})["slot"][2]


DEAD = acos(6 / 10)
HALVES = (-pi, -DEAD, 0.0, DEAD, pi)


def test_a_weight_on_a_follower_drives_it_for_a_part_of_the_turn() -> None:
    torque = pushed(6, 10, 0.2, -10)
    net = mean(torque, HALVES)
    assert net == pytest.approx(2 / pi * log(16 / 4), rel=1e-11)
    assert net == pytest.approx(0.8825424, abs=5e-8)
    assert max(greatest(torque, a, b)[1] for a, b in pairwise(HALVES)) == pytest.approx(3.9356616, abs=5e-8)
    assert torque(0.0) == pytest.approx(-15, rel=1e-13)
    # the weight moves the follower where its power is positive: between the dead points, on the near side
    assert all((swinging(S) * -10 > 0) == (abs(S) < DEAD) for S in np.linspace(-3.1, 3.1, 40))
    assert DEAD / pi == pytest.approx(0.2951672, abs=5e-8)
    # there it needs a push at the crank all the same, near each dead point
    ends = [brentq(torque, *bounds, xtol=1e-14) for bounds in ((-DEAD + 1e-9, -0.1), (0.1, DEAD - 1e-9))]
    assert (2 * DEAD - (ends[1] - ends[0])) / (2 * pi) == pytest.approx(0.0582218, abs=5e-8)
    work_returned = -mean(torque, (ends[0], 0.0, ends[1])) * (ends[1] - ends[0]) / (2 * pi)
    assert work_returned == pytest.approx(1.6542493, abs=5e-8)
    assert net + work_returned == pytest.approx(2.5367917, abs=5e-8)
    assert work_returned / (net + work_returned) == pytest.approx(0.652103, abs=5e-7)


def test_drag_on_a_follower_turns_with_it() -> None:
    torque = pushed(6, 10, 0.2, 0.0, drag=1.0)
    found = mean(torque, HALVES)
    assert found == pytest.approx(2 / pi * asin(0.6) + 0.2 / pi * log(16 / 4), rel=1e-11)
    assert found == pytest.approx(0.4979198, abs=5e-8)
    assert torque(1e-9) == pytest.approx(1.5, rel=1e-7)
    assert max(greatest(torque, a, b)[1] for a, b in pairwise(HALVES)) == pytest.approx(1.5185662, abs=5e-8)
    # on both sides of a dead point; friction is all that is left
    for side in (-1e-9, 1e-9):
        assert torque(DEAD + side) == pytest.approx(0.15, rel=1e-7)
    assert mean(pushed(6, 10, 0.0, 0.0, drag=1.0), HALVES) == pytest.approx(0.4096655, abs=5e-8)


def saturn(S: float) -> Mechanism:
    """Saturn of freeth-2021 as seen at one instant from b, which bears it: the pin at S from its line of centres."""
    at = {"b": (0, 0), "cp": (54, 0), "sa40": (70, 40), "sa68": (30, 80), "sa86s": (30, 81.50), "saturn": (0, 0)}
    # the slot's axis lies on the y axis seen from the pin's
    pin = (30 - 14.37 * sin(S), 80 + 14.37 * cos(S))
    away = hypot(pin[0] - 30, pin[1] - 81.50)
    normal = -(pin[1] - 81.50) / away, (pin[0] - 30) / away
    borne = [Hinge("b", name, at[name]) for name in ("cp", "sa40", "sa68", "sa86s")]
    pairs = [(FRAME, "cp", 56, 52), ("cp", "sa40", 61, 40), ("sa40", "sa68", 40, 68), ("sa86s", "saturn", 86, 86)]
    at[FRAME] = (0, 0)
    rolls = [rolling(i, j, (at[i], at[j]), (z, y)) for i, j, z, y in pairs]
    hinges = [Hinge(FRAME, "b", (0, 0)), *borne, Hinge(FRAME, "saturn", (0, 0), 1e-3)]
    return Mechanism(hinges, [*rolls, (Touch("sa68", "sa86s", pin, normal, pulls=True),)])


def test_the_bearing_of_a_retrograde_planet() -> None:
    def turning(S: float) -> float:
        return saturn(S).motion({"b": 1.0})["saturn"][2]

    def torque(S: float) -> float:
        return only(saturn(S).balances({"b": 1.0}, {}, "b")).torque

    places = np.linspace(-pi, pi, 25)
    stations = [brentq(turning, a, b, xtol=1e-13) for a, b in pairwise(places) if turning(a) * turning(b) < 0]
    assert len(stations) == 2
    corners = (-pi, stations[0], 0.0, stations[1], pi)
    assert mean(turning, corners) == pytest.approx(15 / 442, rel=1e-11)
    average = mean(torque, corners)
    naive = 1e-3 * 15 / 442
    assert average / naive == pytest.approx(2.065600, abs=5e-7)
    peak = max(abs(torque(S)) for S in (0.0, pi))
    assert peak / naive == pytest.approx(3.690611, abs=5e-7)
    assert (stations[1] - stations[0]) / (2 * pi) == pytest.approx(0.363642, abs=5e-7)
    # the crank's 48 turn b's 223
    assert average * 48 / 223 == pytest.approx(1.50887e-5, abs=5e-11)
    assert peak * 48 / 223 == pytest.approx(2.6959e-5, abs=5e-10)
    assert naive * 48 / 223 == pytest.approx(7.30475e-6, abs=5e-12)


# ----------------------------------------------------------------------------------------------------- triangular teeth


def test_outlines_touch_where_the_transmission_functions_say() -> None:
    for mesh in load("moon-triangular").meshes:
        wheels = Outlines.of(mesh.law.sizes)
        t = np.linspace(-1.0, 1.0, 400)
        assert wheels.places(t).driven == pytest.approx(mesh.law.angle(t), abs=1e-14)
        assert wheels.moments(t, 0.2)[0] == pytest.approx(mesh.law.speed(t), rel=1e-12)


def test_triangular_pairs_at_a_constant_load() -> None:
    printed = [0.9585852, 0.9413106, 0.9027585, 0.9232000]
    found = []
    for mesh in load("moon-triangular").meshes:
        wheels = Outlines.of(mesh.law.sizes)
        pitch = 2 * pi / wheels.z1
        speed, torque = wheels.moments((np.arange(20_000) + 0.5) * pitch / 20_000, 0.2)
        assert mesh.law.efficiency(np.arange(100) * pitch / 97) == pytest.approx(
            np.divide(*wheels.moments(np.arange(100) * pitch / 97, 0.2)), rel=1e-12
        )
        assert speed.mean() == pytest.approx(wheels.z1 / wheels.z2, rel=2e-5)
        found.append(wheels.z1 / wheels.z2 / torque.mean())
    assert found == pytest.approx(printed, abs=1e-5)


def test_a_chain_of_triangular_pairs() -> None:
    """moon-triangular with 1 N mm at the Moon: each driver's teeth counted from the line of centres."""
    t = (np.arange(60_000) + 0.5) * (2 * pi * 95 / 60_000)
    torque = np.ones_like(t)
    for mesh in load("moon-triangular").meshes:
        wheels = Outlines.of(mesh.law.sizes)
        torque *= wheels.moments(t, 0.2)[1]
        t = wheels.places(t).driven
    assert torque.mean() == pytest.approx(3.55536, abs=1e-3)
    assert 254 / 95 / torque.mean() == pytest.approx(0.752015, abs=2e-4)
    assert torque.min() == pytest.approx(1.899, abs=0.015)
    assert 7.5 < torque.max() < 7.78


BOTH = """
links: {frame: {}, a: {wheels: {p: 24}}, b: {wheels: {q: 36}}, c: {bearing: 0.5 N m}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
gears: [{pair: [p, q], friction: 0.1}]
couplings: [{kind: pin_and_slot, pin: b, slot: c, pin_radius: 10 mm, offset: 5 mm, friction: 0.2}]
inputs: {a: 1}
outputs: {c: {}}
loads: {c: 3 N m}
"""


def both(wheels: Outlines, t: float) -> Mechanism:
    """A triangular pair whose driven link carries a pin in a slot: b turns about (D, 0), c about (D, 5)."""
    u = float(wheels.places(np.array([t])).driven[0])
    centre, axis = (wheels.D, 0.0), (wheels.D, 5.0)
    # forward is clockwise at b: its pin starts on the side of the slot's axis
    point = wheels.D + 10 * sin(u), 10 * cos(u)
    away = hypot(point[0] - axis[0], point[1] - axis[1])
    normal = -(point[1] - axis[1]) / away, (point[0] - axis[0]) / away
    hinges = [Hinge(FRAME, "a", (0, 0)), Hinge(FRAME, "b", centre), Hinge(FRAME, "c", axis, 0.5)]
    teeth = wheels.touch(t, ("a", "b"), ((0.0, 0.0), centre), 0.1)
    return Mechanism(hinges, [(teeth,), flanks("b", "c", point, normal, 0.2)])


def test_teeth_and_a_pin_in_one_train() -> None:
    wheels = Outlines.of(load(BOTH).meshes[0].law.sizes)

    # one position by the balance of all bodies, the load against the clockwise turning of c
    def torque(t: float) -> float:
        found = only(both(wheels, t).balances({"a": 1.0}, {"c": 3.0}, "a"))
        assert sum(found.lost) == pytest.approx(
            found.torque + 3.0 * both(wheels, t).motion({"a": 1.0})["c"][2], rel=1e-12
        )
        return found.torque

    t = (np.arange(30_000) + 0.5) * (3 * pi / 30_000)
    _, ratio = wheels.moments(t, 0.1)
    u = wheels.places(t).driven
    distance = np.sqrt(125 - 100 * np.cos(u))
    arm, cross = (10 - 5 * np.cos(u)) / distance, 5 * np.abs(np.sin(u)) / distance
    course = ratio * 3.5 * 10 / distance * (arm + 0.2 * cross)
    assert [torque(t[k]) for k in range(0, 30_000, 2_000)] == pytest.approx(course[::2_000].tolist(), rel=1e-11)
    assert course.mean() == pytest.approx(2.55551, abs=3e-4)
    assert 3 / 1.5 / course.mean() == pytest.approx(0.782622, abs=1e-4)
    assert course.max() == pytest.approx(5.5982, abs=0.01)
    assert course.min() == pytest.approx(1.3179, abs=2e-3)


# ----------------------------------------------------------------------------------------------------- planetary drives


def differential(random: Random) -> tuple[dict[str, Any], Mechanism]:
    """Sun and ring, both driven, two wheels of one planet and a loaded arm, with losses everywhere; bodies in balance.

    The second wheel of the planet meshes with a second sun instead of a ring in half of the cases.
    """
    z = [random.randint(12, 40) for _ in range(4)]
    inside = random.random() < 0.5
    if inside:
        z[3] += z[2] + 30
    eta = [[Fraction(random.randint(80, 99), 100) for _ in range(2)] for _ in range(2)]
    rubs = {name: Fraction(random.randint(0, 5), 10) for name in ("sun", "ring", "arm", "planet")}
    data = {
        "links": {
            "frame": {},
            "sun": {"wheels": {"s": z[0]}, "bearing": str(rubs["sun"])},
            "ring": {"wheels": {"r": {"teeth": z[3], "internal": inside}}, "bearing": str(rubs["ring"])},
            "arm": {"bearing": str(rubs["arm"])},
            "planet": {"wheels": {"p": z[1], "q": z[2]}, "bearing": str(rubs["planet"])},
        },
        "revolutes": [
            *({"pair": ["frame", name], "axis": "A"} for name in ("sun", "ring", "arm")),
            {"pair": ["arm", "planet"], "axis": "P"},
        ],
        "gears": [
            {"pair": pair, "efficiency": {"forward": str(eta[at][0]), "backward": str(eta[at][1])}}
            for at, pair in enumerate((["s", "p"], ["q", "r"]))
        ],
        "inputs": {"sun": str(random.randint(5, 9)), "ring": str(random.randint(-9, 4))},
        "loads": {"arm": str(random.choice([-1, 1]) * random.randint(5, 20))},
    }
    lean = random.uniform(0, 2 * pi)
    middle, planet = (0.0, 0.0), (7 * cos(lean), 7 * sin(lean))
    hinges = [Hinge(FRAME, name, middle, float(rubs[name])) for name in ("sun", "ring", "arm")]
    hinges.append(Hinge("arm", "planet", planet, float(rubs["planet"])))
    radii = ((z[0], z[1]), (z[2], -z[3] if inside else z[3]))
    losses = [(float(one), float(other)) for one, other in eta]
    teeth = [
        toothed("sun", "planet", (middle, planet), radii[0], losses[0], "arm"),
        toothed("planet", "ring", (planet, middle), radii[1], losses[1], "arm"),
    ]
    return data, Mechanism(hinges, teeth)


def test_a_differential_balances_body_by_body() -> None:
    seen = 0
    for seed in range(60):
        data, bodies = differential(Random(seed))
        speeds = {link: float(speed) for link, speed in data["inputs"].items()}
        train = GearTrain.declare(data)
        if not train.solve().verdict:
            continue
        motion = bodies.motion(speeds)
        assert {link: motion[link][2] for link in ("arm", "planet")} == pytest.approx(
            {link: float(train.solve()[link]) for link in ("arm", "planet")}, rel=1e-9, abs=1e-9
        )
        load_on_arm = {link: float(torque) for link, torque in data["loads"].items()}
        found = bodies.balances(speeds, load_on_arm, "sun", ("ring",))
        answer = train.torques()
        assert bool(found) == bool(answer.verdict), (seed, answer.verdict)
        if answer.verdict.kind == "ambiguous" or not found:
            continue
        assert only(found).torque == pytest.approx(float(answer.external["sun"]), rel=1e-9), seed
        powers = only(found).torque * speeds["sun"] + sum(load_on_arm.values()) * motion["arm"][2]
        assert sum(only(found).lost) == pytest.approx(powers + only(found).held[0] * speeds["ring"], rel=1e-9)
        seen += 1
    assert seen > 40
