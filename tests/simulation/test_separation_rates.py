"""At what rate teeth part: closed forms, a chain reckoned by hand, and bodies balanced one by one."""

from __future__ import annotations

from math import acos, degrees, pi, sqrt, tau

import numpy as np
import pytest

from geartrain import GearTrain, GearTrainError, load
from geartrain.dynamics.motion import find_motion_problem
from geartrain.simulation import SeparationRates, find_link_inertias, find_separation
from geartrain.simulation.contacts import InertialContacts, find_inertial_loads, minimum_rate, separate_rubbing
from geartrain.teeth.outlines.contour import Contour

PIN = """
links: {{frame: {{}}, a: {{}}, b: {{inertia: 1e-5 kg m2, {drag}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
couplings: [{{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: {offset} mm}}]
inputs: {{a: 1}}
{rest}
"""


def pin(offset: int, drag: str = "bearing: 1 N mm", rest: str = "") -> SeparationRates:
    return find_separation(load(PIN.format(offset=offset, drag=drag, rest=rest)).mechanics)


def steepest(r: float, e: float) -> tuple[float, float]:
    """Greatest fall of the speed of a slot (1/rad), and the pin's angle there: cos S = (-A + sqrt(A^2 + 8B^2))/(2B)."""
    A, B = r * r + e * e, 2 * r * e
    cosine = (-A + sqrt(A * A + 8 * B * B)) / (2 * B)
    return r * e * (r * r - e * e) * sqrt(1 - cosine**2) / (A - B * cosine) ** 2, acos(cosine)


@pytest.mark.parametrize(("offset", "fall", "angle", "rate"), [
    (8, 13.0441342, 7.3814, 2.76880500),
    (2, 0.24016005, 51.6154, 20.4056115),
])  # fmt: skip
def test_a_slot_leaves_its_pin_where_its_speed_falls_most(offset: int, fall: float, angle: float, rate: float) -> None:
    closed, S = steepest(10, offset)
    assert closed == pytest.approx(fall, rel=3e-8)
    assert degrees(S) == pytest.approx(angle, abs=1e-4)
    found = pin(offset)
    assert found.complete
    assert found.rate * tau == pytest.approx(sqrt(1e-3 / (1e-5 * closed)), rel=1e-9)
    assert found.rate * tau == pytest.approx(rate, rel=3e-9)
    assert 360 * found.first.at == pytest.approx(degrees(S), abs=2e-3)


def test_viscous_drag_holds_a_slot_to_its_pin() -> None:
    """Under viscous drag alone beta w tau = J w^2 (-tau'): a rate that grows with the drag over the inertia."""
    r, e = 10.0, 2.0
    S = np.linspace(0, np.pi, 2_000_001)
    square = r * r + e * e - 2 * r * e * np.cos(S)
    speed, fall = r * (r - e * np.cos(S)) / square, r * e * (r * r - e * e) * np.sin(S) / square**2
    expected = float(np.min(2e-4 * speed[1:-1] / (1e-5 * fall[1:-1])))
    found = pin(2, "drag: 0.2 N mm s/rad")
    assert found.rate * tau == pytest.approx(expected, rel=1e-9)


def test_a_load_holds_as_friction_does_and_nothing_holds_at_any_rate() -> None:
    loaded, rubbing = pin(8, "", "loads: {b: -1 N mm}"), pin(8)
    assert loaded.rate == pytest.approx(rubbing.rate, rel=1e-12)
    assert pin(8, "").rate == 0
    assert pin(8, "", "loads: {b: 1 N mm}").rate == 0


def test_teeth_of_one_ratio_never_part() -> None:
    train = load("extends: planetary-24-18-60\nlinks: {carrier: {inertia: 1 kg m2, bearing: 1 N m}}")
    found = find_separation(train.mechanics)
    assert (found.rate, found.pair, found.first) == (None, None, None)
    assert {each.rate for each in found.pairs} == {None}
    assert found.unknown == ("planet",)


def test_the_minimum_rate_is_the_first_root() -> None:
    cases = [(1, 0, -4, 0.5), (1, 0, 4, np.inf), (0, 1, -2, 0.5), (2, 3, -5, 1), (-1, 0, 1, 0), (0, 0, 0, np.inf)]
    cases += [(0, 0, -1, 0), (0, -1, 1, 0), (0, 1, 1, np.inf), (2, -3, 1, 1), (1, -1, 1, np.inf), (3, -2, 0, 1.5)]
    cases += [(1, 2, 0, np.inf), (1, 1e9, -1, 1e9)]
    D, V, A, expected = np.array(cases, dtype=float).T
    assert minimum_rate(D, V, A) == pytest.approx(expected)


# --------------------------------------------------------------------------------------------------- moon-triangular

MOON = """
extends: moon-triangular
links:
  sun:  {inertia: 3e-5 kg m2, bearing: 1 N mm}
  c:    {inertia: 5e-6 kg m2, bearing: 1 N mm}
  d:    {inertia: 8e-6 kg m2, bearing: 1 N mm}
  moon: {inertia: 2e-6 kg m2, bearing: 1 N mm}
"""
INERTIAS = (3e-5, 5e-6, 8e-6, 2e-6)


def by_hand(x: np.ndarray, rubs: bool = False) -> np.ndarray:
    """The rate (turn/s) of each pair of the Moon's train at crank angles x (rad), link by link from the Moon back.

    A driver whose teeth rub gives tau/eta times the torque on the driven side.
    """
    transmissions = [mesh.transmission for mesh in load("moon-triangular").meshes]
    speeds, falls, accelerations, arms = [], [], [], []
    S, first, second = x, np.ones_like(x), np.zeros_like(x)
    for transmission in transmissions:
        slope = (transmission.speed(S + 1e-6) - transmission.speed(S - 1e-6)) / 2e-6
        speed = transmission.speed(S)
        first, second = speed * first, slope * first**2 + speed * second
        speeds.append(speed)
        arms.append(speed / transmission.efficiency(S) if rubs else speed)
        falls.append(slope)
        accelerations.append(second)
        S = transmission.angle(S) - transmission.angle(0.0)  # from a tooth on the line of centres
    rates = []
    D = A = np.zeros_like(x)
    for at in (3, 2, 1, 0):
        onward = arms[at + 1] if at < 3 else 0.0
        D, A = 1e-3 + onward * D, INERTIAS[at] * accelerations[at] + onward * A
        rates.append(np.sqrt(np.where(A < 0, -D / np.where(A < 0, A, -1.0), np.inf)) / tau)
    return np.array(rates[::-1])


def test_the_moons_train_parts_first_at_its_last_pair() -> None:
    """Figures of `by_hand` on a grid of 1e-5 turns; teeth part first just after a corner, at a lesser rate."""
    found = find_separation(load(MOON + "friction: 0\n").mechanics)
    printed = {"d2~e": 0.4821, "c2~d1": 0.5149, "b2~c1": 0.5321, "a~b1": 0.5406}
    assert [each.pair for each in found.pairs] == list(printed)
    for each in found.pairs:
        assert each.rate == pytest.approx(printed[each.pair], rel=1.5e-3)
        assert each.rate < printed[each.pair]
    assert found.first.at == pytest.approx(16.9213, abs=5e-4)
    assert found.complete
    assert found.turns == 95
    names = ["a~b1", "b2~c1", "c2~d1", "d2~e"]
    rates = {each.pair: each.rate for each in found.pairs}
    beyond = np.linspace(1e-6, 4e-6, 50)  # just after a corner: extrapolated to it, as differences need room
    here = by_hand(tau * (found.first.at + beyond))
    at_the_kink = [np.polynomial.Polynomial.fit(beyond, each, 3)(0.0) for each in here]
    assert at_the_kink == pytest.approx([rates[name] for name in names], rel=1e-6)


@pytest.mark.parametrize("rubs", [False, True])
def test_at_any_position_the_moons_pairs_carry_what_a_chain_does(rubs: bool) -> None:
    train = load(MOON)
    moving = find_motion_problem(train.mechanics)
    rubbing, uncounted = separate_rubbing(moving)
    assert list(rubbing) == ["a~b1", "b2~c1", "c2~d1", "d2~e"]
    assert uncounted == ()
    contacts = InertialContacts(moving, contacts_of(train).acting, rubbing=rubbing if rubs else None)
    turns = np.random.default_rng(3).uniform(0, 95, 400)
    order = [contacts.pairs.index(name) for name in ("a~b1", "b2~c1", "c2~d1", "d2~e")]
    found, expected = contacts.rates(turns)[order] / tau, by_hand(tau * turns, rubs)
    both = np.isfinite(found) & np.isfinite(expected)
    assert (np.isfinite(found) == np.isfinite(expected)).mean() > 0.99
    assert np.median(np.abs(found[both] / expected[both] - 1)) < 1e-7


# ---------------------------------------------------------------------------------------------------- any other train

PLANETS = """
links:
  frame:  {wheels: {f: 40}}
  arm:    {inertia: 4e-5 kg m2, bearing: 2 N mm}
  planet: {wheels: {p: 30, q: 28}, inertia: 6e-6 kg m2, bearing: 1 N mm}
  out:    {wheels: {o: 42, s: 50}, inertia: 9e-6 kg m2, bearing: 1.5 N mm}
  last:   {wheels: {t: 20}, inertia: 2e-6 kg m2, bearing: 0.5 N mm, drag: 1e-4 N m s/rad}
  slot:   {inertia: 5e-6 kg m2, bearing: 0.7 N mm}
revolutes: {A: [frame, arm, out], P: [arm, planet], B: [frame, last], Q: [arm, slot]}
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
gears: [{pair: [f, p]}, {pair: [q, o]}, {pair: [s, t]}]
couplings: [{kind: pin_and_slot, pin: planet, slot: slot, pin_radius: 10 mm, offset: 3 mm}]
inputs: {arm: 1}
loads: {last: 2 N mm}
"""


def contacts_of(train: GearTrain) -> InertialContacts:
    case = train.declaration.case(None)
    moving = find_motion_problem(train.mechanics)
    acting = find_inertial_loads(
        train.declaration, case, train.kinematics.tree, find_link_inertias(train.mechanics), moving.speeds
    )
    return InertialContacts(moving, acting)


def balanced(train: GearTrain, turns: float, rate: float) -> dict[str, float]:
    """Torque on the driven side of each pair (N m), forwards, from the balance of every body by itself.

    Speeds and accelerations are differences of angles; each pair pushes its two wheels by its ratio at that place, and
    its carrier with what is left.
    """
    links, step = list(train.declaration.links), 2e-6
    found = train.motion(outputs=links).at(turns + step * np.array([-1.0, 0.0, 1.0]))
    means = np.array([float(train.solve()[link] / train.solve()["arm"]) for link in links])
    speed = means + found.rate[:, 1]
    acceleration = (found.rate[:, 2] - found.rate[:, 0]) / (2 * step * tau)
    omega = dict(zip(links, speed * rate, strict=True))
    alpha = dict(zip(links, acceleration * rate**2, strict=True))
    others = [link for link in links if link != "frame"]
    column = {link: at for at, link in enumerate(others)}
    outside = np.zeros(len(others))
    for link in others:
        part, bearer = train.declaration.links[link], train.kinematics.tree.parent[link][0]
        relative = omega[link] - omega[bearer]
        torque = 0.0 if part.bearing is None else -part.bearing.sliding.si * np.sign(relative)
        torque -= 0.0 if part.drag is None else part.drag.si * relative
        outside[column[link]] += torque - (part.inertia.si if part.inertia else 0.0) * alpha[link]
        if bearer != "frame":
            outside[column[bearer]] -= torque
    for link, load_ in train.declaration.loads.items():
        outside[column[link]] += load_.si
    matrix = np.zeros((len(others), len(train.circuits) + 1))
    for at, circuit in enumerate(train.circuits):
        ratio = (omega[circuit.j] - omega[circuit.carrier]) / (omega[circuit.i] - omega[circuit.carrier])
        for link, arm in ((circuit.i, -ratio), (circuit.j, 1.0), (circuit.carrier, ratio - 1.0)):
            if link != "frame":
                matrix[column[link], at] += arm
    matrix[column["arm"], -1] = 1.0
    solved = np.linalg.solve(matrix, -outside)
    torques = {}
    for at, circuit in enumerate(train.circuits):
        # the first link of a coupling is its slot, which is driven
        drives = circuit.kind == "gear" and train.mechanics.drivers()[circuit.id].wheel == circuit.wheels[0]
        driven = circuit.j if drives else circuit.i
        ratio = (omega[circuit.j] - omega[circuit.carrier]) / (omega[circuit.i] - omega[circuit.carrier])
        on_driven = solved[at] if drives else -ratio * solved[at]
        mean = float(train.solve()[driven] - train.solve()[circuit.carrier])
        torques[circuit.id] = on_driven * np.sign(mean)
    return torques


def test_planets_and_pins_carry_what_the_balance_of_each_body_asks() -> None:
    train, rate = load(PLANETS), 3.0
    contacts = contacts_of(train)
    for turns in (0.1237, 0.4, 0.77123, 3.1):
        D, V, A = contacts.torques(np.array([turns]))
        found = dict(zip(contacts.pairs, (D + V * rate + A * rate**2)[:, 0], strict=True))
        assert found == pytest.approx(balanced(train, turns, rate), rel=2e-6, abs=1e-9)


def test_a_train_that_turns_the_other_way_parts_alike() -> None:
    one = load(PLANETS)
    mirrored = load(PLANETS.replace("arm: 1}", "arm: -1}").replace("last: 2 N mm", "last: -2 N mm"))
    assert [(each.pair, each.rate) for each in find_separation(mirrored.mechanics, turns=2).pairs] == [
        (each.pair, pytest.approx(each.rate)) for each in find_separation(one.mechanics, turns=2).pairs
    ]


# ------------------------------------------------------------------------------------------------------------- jumps

TEETH = """
links: {{frame: {{}}, a: {{wheels: {{p: 15}}}}, b: {{wheels: {{w: 60}}, inertia: 1e-5 kg m2, bearing: 1 N mm}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, w]}}]
tooth_form: {{form: triangular, half_angle: 30 deg, clearance_factor: {0}}}
inputs: {{a: 1}}
"""


def test_teeth_whose_speed_falls_at_once_part_at_any_rate() -> None:
    """Beyond 1.031256 the driven wheel stands still for a while in each pitch: it would have to be stopped."""
    still, running = (find_separation(load(TEETH.format(clearance)).mechanics).first for clearance in ("1.035", "1.03"))
    assert (still.rate, still.leap) == (0, True)
    assert not running.leap
    transmission = load(TEETH.format("1.03")).meshes[0].transmission
    assert running.rate * tau == pytest.approx(sqrt(1e-3 / (1e-5 * (transmission.steepest_fall() or 0))), rel=1e-6)


def test_a_notebook_shows_from_which_rate_each_pair_parts() -> None:
    page = find_separation(load("moon-triangular-inertia").mechanics, turns=37)._repr_html_()
    # 0.482 turn/s, docs/dynamics.md
    assert "d2~e</th><td>0.48188</td><td>16.9213</td>" in page
    assert page.count("<tr>") == 5


def test_what_cannot_be_requested_is_said() -> None:
    with pytest.raises(GearTrainError, match="no link of 'moon-triangular' has a moment of inertia"):
        find_separation(load("moon-triangular").mechanics)
    with pytest.raises(GearTrainError, match="has no unit"):
        find_separation(load(PIN.format(offset=2, drag="bearing: 1", rest="")).mechanics)


@pytest.mark.parametrize("way", [1, -1])
def test_what_drives_with_a_steady_torque_holds_the_flanks_of_links_before_the_input(way: int) -> None:
    # the slot goes evenly; its pin, pulled by T, must not be thrown ahead: J w^2 max(-tau' / tau^3) = T
    train = load(f"""
links: {{frame: {{}}, p: {{inertia: 100 kg mm2}}, s: {{}}}}
revolutes: [{{pair: [frame, p], axis: A}}, {{pair: [frame, s], axis: B}}]
couplings: [{{kind: pin_and_slot, pin: p, slot: s, pin_radius: 10 mm, offset: 5 mm}}]
inputs: {{s: {way}}}
crank: p
drive: {{torque: 0.02 N m}}
""")
    r, e, S = 10.0, 5.0, np.linspace(-pi, pi, 200001)
    rho2 = r * r + e * e - 2 * r * e * np.cos(S)
    ratio, slope = r * (r - e * np.cos(S)) / rho2, -r * e * (r * r - e * e) * np.sin(S) / rho2**2
    rate = sqrt(0.02 / (1e-4 * float((-slope / ratio**3).max()))) / tau
    assert find_separation(train.mechanics).rate == pytest.approx(rate, rel=1e-8)


@pytest.mark.parametrize("way", [1, -1])
def test_a_crank_behind_the_input_keeps_its_own_teeth_together_by_what_it_gives(way: int) -> None:
    # of the chain crank - input - slot the first pair carries what the input's bearing and all behind it ask
    train = load(f"""
links:
  frame: {{}}
  c: {{wheels: {{c20: 20}}, bearing: 1 N mm}}
  a: {{wheels: {{a30: 30}}, bearing: 0.5 N mm}}
  b: {{inertia: 1e-5 kg m2, bearing: 1 N mm}}
revolutes: [{{pair: [frame, c], axis: C}}, {{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [c20, a30]}}]
couplings: [{{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm}}]
inputs: {{a: {way}}}
crank: c
""")
    r, e, S = 10.0, 8.0, np.linspace(0, pi, 2_000_001)[1:-1]
    rho2 = r * r + e * e - 2 * r * e * np.cos(S)
    ratio, slope = r * (r - e * np.cos(S)) / rho2, -r * e * (r * r - e * e) * np.sin(S) / rho2**2
    squared = (0.5e-3 + 1e-3 * ratio) / (1e-5 * -slope * ratio)
    rates = {each.pair: each.rate for each in find_separation(train.mechanics).pairs}
    assert rates["c20~a30"] == pytest.approx(sqrt(float(squared.min())) / tau, rel=1e-8)
    assert rates["a~b"] == pytest.approx(2.76880500 / tau, rel=1e-8)


def test_friction_that_is_not_counted_is_named() -> None:
    def named(**more: object) -> tuple[str, ...]:
        links = {"frame": {}, "a": {"wheels": {"w": 20}}, "b": {"wheels": {"v": 40}, "inertia": "1e-5 kg m2"}}
        turning = [{"pair": ["frame", link], "axis": link.upper()} for link in "ab"]
        gears = [{"pair": ["w", "v"], **more}]
        train = GearTrain.declare({"links": links, "revolutes": turning, "gears": gears, "inputs": {"a": 1}})
        return find_separation(train.mechanics).uncounted

    assert named() == ()
    assert named(efficiency=0.9) == ("w~v",)
    assert named(efficiency=1) == ()
    assert named(tooth_form={"form": "involute"}, friction=0.1) == ("w~v",)


# ------------------------------------------------------------------------------------------ moments of inertia of links


def test_a_disc_has_its_closed_form_wherever_it_stands() -> None:
    """pi r^4/2 about its centre, and pi r^2 d^2 more about a point d away."""
    area, polar = Contour.circle(3.0).moments()
    assert area == pytest.approx(9 * pi, rel=1e-15)
    assert polar == pytest.approx(81 * pi / 2, rel=1e-15)
    area, polar = Contour.circle(3.0, (4.0, -5.0)).moments()
    assert polar == pytest.approx(81 * pi / 2 + 9 * pi * 41, rel=1e-14)


def test_arcs_that_turn_left_and_right_agree_with_fine_triangles() -> None:
    shape = Contour.of([(1, 0, 0.3), (5, 1, -0.4), (4, 4, 0.0), (1, 5, 1.7), (-1, 2, -0.2)])
    area, polar = shape.moments()
    points = shape.flattened(1e-9)
    following = np.roll(points, -1, axis=0)
    cross = points[:, 0] * following[:, 1] - points[:, 1] * following[:, 0]
    thirds = (points**2 + points * following + following**2).sum(axis=1)
    assert area == pytest.approx(cross.sum() / 2, rel=1e-8)
    assert polar == pytest.approx((cross * thirds).sum() / 12, rel=1e-8)
    backwards = Contour(shape.points[::-1], -np.roll(shape.bulges, 1)[::-1])
    assert backwards.moments() == pytest.approx((-area, -polar), rel=1e-12)


WHEELS = """
links: {{frame: {{}}, a: {{wheels: {{p: 20}}}}, b: {{wheels: {{w: {{teeth: 60, module: 1 mm}}}}{link}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, w]}}]
density: 8.7 g/cm3
{rest}
inputs: {{a: 1}}
"""


def test_a_wheel_is_a_disc_between_its_root_and_its_tip() -> None:
    (found,) = find_link_inertias(load(WHEELS.format(link="", rest="thickness: 2 mm")).mechanics)
    assert (found.source, found.missing) == ("outlines", ())
    low, high = (8700 * 0.002 * pi / 2 * (radius * 1e-3) ** 4 for radius in (30 - 1.25, 30 + 1))
    assert low < found.value < high
    assert found.value == pytest.approx(8700 * 0.002 * pi / 2 * 0.03**4, rel=0.03)


def test_what_is_declared_stands_before_outlines_and_what_is_not_known_is_said() -> None:
    (declared,) = find_link_inertias(
        load(WHEELS.format(link=", inertia: 2e-5 kg m2", rest="thickness: 2 mm")).mechanics
    )
    assert (declared.source, declared.value) == ("declared", 2e-5)
    (unknown,) = find_link_inertias(load(WHEELS.format(link="", rest="")).mechanics)
    assert (unknown.source, unknown.value) == ("unknown", 0)
    assert unknown.missing == ("wheel 'w' has no thickness",)
    assert (
        find_link_inertias(load("moon-triangular").mechanics)[0].missing[0]
        == "wheel 'b1' has no density, no thickness, no module"
    )


PLANET_PLATES = """
extends: planetary-24-18-60
links: {{sun: {{wheels: {{s: {{teeth: 24, module: 2 mm}}}}}}, carrier: {{inertia: 1e-5 kg m2}}, planet: {{{planet}}}}}
{rest}
"""


def test_a_planet_goes_round_with_its_carrier() -> None:
    """Its axis is (24 + 18) modules / 2 from the middle: 42 mm."""
    found = {
        each.link: each
        for each in find_link_inertias(load(PLANET_PLATES.format(planet="mass: 30 g", rest="")).mechanics)
    }
    assert found["carrier"].carried == pytest.approx(0.03 * 0.042**2, rel=1e-14)
    assert found["carrier"].value == pytest.approx(1e-5 + 0.03 * 0.042**2, rel=1e-14)
    plates = find_link_inertias(
        load(PLANET_PLATES.format(planet="", rest="density: 1 g/cm3\nthickness: 5 mm")).mechanics
    )
    carried = {each.link: each.carried for each in plates}["carrier"]
    assert carried == pytest.approx(1000 * 0.005 * pi * 0.018**2 * 0.042**2, rel=0.05)
    nothing = {each.link: each for each in find_link_inertias(load(PLANET_PLATES.format(planet="", rest="")).mechanics)}
    assert nothing["carrier"].missing == ("the mass of 'planet', which it carries, is not known",)


def test_teeth_part_by_the_inertia_of_their_outlines() -> None:
    rest = "thickness: 2 mm\ntooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}"
    train = load(WHEELS.format(link=", bearing: 1 N mm", rest=rest))
    (found,) = find_link_inertias(train.mechanics)
    assert found.source == "outlines"
    declared = load(WHEELS.format(link=f", bearing: 1 N mm, inertia: {found.value!r} kg m2", rest=rest))
    assert find_separation(train.mechanics).rate == pytest.approx(find_separation(declared.mechanics).rate, rel=1e-12)
