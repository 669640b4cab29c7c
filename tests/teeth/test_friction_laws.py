"""Friction that depends on speed: the laws at their printed values, the speed of sliding of every form, and losses."""

from __future__ import annotations

from math import cos, exp, pi, radians, sin
from typing import Any

import numpy as np
import pytest

from geartrain import GearTrainError, load
from geartrain.teeth import (
    BuckinghamFriction,
    CircularArc,
    Cycloidal,
    DokosFriction,
    Involute,
    Lantern,
    LeastFriction,
    PairFriction,
    StribeckFriction,
    TabulatedFriction,
    TransmissionFunction,
    Triangular,
    UniformStress,
)
from geartrain.teeth.rubbed_transmission import RubbedTransmission

FT_MIN = 0.3048 / 60


def test_buckinghams_law_has_the_three_values_that_smith_prints() -> None:
    transmission = BuckinghamFriction(law="buckingham")
    found = transmission.coefficient(np.array([0.0, 150.0, 2100.0]) * FT_MIN)
    assert [f"{value:.4f}" for value in found] == ["0.0517", "0.0112", "0.0385"]
    V = np.linspace(0, 2100, 2000) * FT_MIN
    minimum = V[np.argmin(transmission.coefficient(V))] / FT_MIN
    assert 50 < minimum < 150, "not monotone: it falls from rest and rises with the speed"


def test_dokoss_law_falls_evenly_over_seven_decades_and_is_level_beyond() -> None:
    law = DokosFriction.model_validate({"law": "dokos", "slowest": "2 mm/s"})
    ends = law.coefficient(np.array([0.0, 0.002, 2e4, 1e9]))
    assert ends == pytest.approx([0.53, 0.53, 0.18, 0.18], rel=1e-14)
    decades = law.coefficient(0.002 * 10.0 ** np.arange(8))
    assert np.diff(decades) == pytest.approx([-0.05] * 7, rel=1e-12)


def test_stribecks_law_is_static_at_rest_and_viscous_in_the_end() -> None:
    sizes = {"static": "0.2", "kinetic": "0.08", "speed": "10 mm/s", "exponent": "1", "viscous": "1/50"}
    law = StribeckFriction.model_validate({"law": "stribeck", **sizes})
    expected = [0.2, 0.08 + 0.12 * exp(-1) + 0.0002, 0.08 + 0.02 * 5]
    assert law.coefficient(np.array([0.0, 0.01, 5.0])) == pytest.approx(expected, rel=1e-13)


def test_a_table_is_joined_by_straight_lines_and_level_outside() -> None:
    given = {"law": "table", "speeds": ["60 ft/min", "120 ft/min"], "coefficients": ["0.1", "0.05"]}
    found = TabulatedFriction.model_validate(given).coefficient(np.array([0.0, 90, 500]) * FT_MIN)
    assert found == pytest.approx([0.1, 0.075, 0.05])


FORMS: dict[str, tuple[Any, tuple[int, int]]] = {
    "triangular": (Triangular.declared({"half_angle": "30 deg", "window": "0.5"}), (24, 36)),
    "involute": (Involute.declared({}), (24, 36)),
    "cycloidal": (Cycloidal.declared({}), (24, 36)),
    "lantern": (Lantern.declared({}), (12, 48)),
    "off design": (UniformStress.declared({"centre_distance": "30.02"}), (24, 36)),
    "circular arc": (CircularArc.declared({}), (60, 8)),
}
FALLING = StribeckFriction.model_validate({"law": "stribeck", "static": "0.2", "kinetic": "0.05", "speed": "20 mm/s"})


def transmission_of(form: str, friction: float = 0.0) -> TransmissionFunction:
    made, (z1, z2) = FORMS[form]
    return made.transmission(z1, z2, friction)


def test_involutes_slide_with_the_distance_of_the_contact_from_the_pitch_point() -> None:
    """On the line of action, at base pitches: v = (w1 + w2) s, with s counted along the normal."""
    transmission = transmission_of("involute")
    z1, z2, psi = 24, 36, radians(20)
    X = transmission.contacts(np.linspace(0, transmission.period, 50))  # type: ignore[attr-defined]
    sliding = transmission.rubbing(np.linspace(0, transmission.period, 50)).sliding
    r1, r2 = z1 / 2, z2 / 2
    s = np.abs(X) * cos(psi)  # the contact runs along the line of action at the base circles' speed
    assert np.nan_to_num(sliding) == pytest.approx(np.nan_to_num((1 / r1 + 1 / r2) * s), abs=1e-13)


def test_triangular_teeth_slide_by_the_difference_of_two_velocities() -> None:
    """The velocities of both wheels at the contact, by vectors in the plane."""
    transmission = Triangular.declared({"half_angle": "30 deg", "window": "0.5"}).transmission(24, 36)
    sizes, tooth_pair = transmission.sizes, transmission.contact.path.tooth_pair
    for interval in transmission.intervals:
        for share in (0.02, 0.4, 0.97):
            x = interval.start - share * interval.width
            y, tau = tooth_pair.angle(interval.phase, x), tooth_pair.speed(interval.phase, x)
            if interval.phase == "approach":
                point = np.array([sizes.D - sizes.R2 * cos(y), sizes.R2 * sin(y)])
            else:
                point = np.array([sizes.R1 * cos(x), sizes.R1 * sin(x)])
            first = np.array([point[1], -point[0]])
            second = tau * np.array([-point[1], point[0] - sizes.D])
            pitch_line = sizes.D * sizes.z1 / (sizes.z1 + sizes.z2)
            wanted = np.hypot(*(second - first)) / pitch_line
            # S = 0 has a driver's tooth on the line of centres, and its angle falls
            found = transmission.rubbing(np.array([-(x - interval.tooth_pair * transmission.period)])).sliding[0, 0]
            assert found == pytest.approx(wanted, rel=1e-11)


@pytest.mark.parametrize("form", ["triangular", "involute", "cycloidal"])
def test_the_mean_under_a_law_is_that_of_a_fine_grid(form: str) -> None:
    transmission, V = transmission_of(form), 0.2
    rubbed = RubbedTransmission(transmission, PairFriction(FALLING, V))
    S = (np.arange(40000) + 0.5) / 40000 * transmission.period
    sliding, into, out = transmission.rubbing(S)
    mu = 0.05 + 0.15 * np.exp(-((sliding * V / 0.02) ** 2))
    each = (1 + mu * out) / (1 + mu * into)
    eta = np.nanmean(each, axis=0)
    assert rubbed.efficiency_mean() == pytest.approx(eta.mean(), abs=1e-6)
    speed = transmission.speed(S)
    assert rubbed.efficiency_at_constant_load() == pytest.approx(speed.mean() / (speed / eta).mean(), abs=1e-6)
    assert rubbed.efficiency_minimum() == pytest.approx(eta.min(), abs=1e-5)


def test_faster_teeth_lose_less_where_friction_falls_with_speed_and_tend_to_the_number_at_the_end() -> None:
    transmission = transmission_of("involute")
    laws = [PairFriction(FALLING, V) for V in (0, 0.01, 0.1, 1, 100)]
    found = [RubbedTransmission(transmission, law).efficiency_mean() for law in laws]
    assert found == sorted(found)
    assert found[0] == pytest.approx(transmission_of("involute", 0.2).efficiency_mean(), rel=1e-14)
    assert found[-1] == pytest.approx(transmission_of("involute", 0.05).efficiency_mean(), abs=1e-6)


def test_teeth_lock_where_the_coefficient_of_the_moment_locks_them() -> None:
    transmission = Triangular.declared({"half_angle": "30 deg", "clearance_factor": "1.01"}).transmission(96, 72)
    limit = transmission.locking_friction
    given = {"law": "table", "speeds": ["0 m/s", "1 m/s"], "coefficients": [0.1, 2 * limit]}
    by = TabulatedFriction.model_validate(given)
    slow, fast = (RubbedTransmission(transmission, PairFriction(by, V)) for V in (0.01, 50.0))
    assert not slow.locks
    assert fast.locks
    assert np.isnan(fast.efficiency_mean())


TRAIN = """
links:
  frame: {}
  a: {wheels: {p: {teeth: 24, module: 1 mm}}}
  b: {wheels: {q: {teeth: 36, module: 1 mm}, r: {teeth: 20, module: 1 mm}}}
  c: {wheels: {s: {teeth: 60, module: 1 mm}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
tooth_form: {form: involute}
friction: FRICTION
gears: [{pair: [p, q]}, {pair: [r, s]}]
inputs: {a: 1}
rate: 2 turn/s
loads: {c: -1 N m}
"""
STRIBECK = "{law: stribeck, static: 0.2, kinetic: 0.05, speed: 20 mm/s}"


def efficiency(text: str) -> float:
    return float(load(text).torques().efficiency)


def test_each_pair_of_a_train_loses_by_its_own_pitch_line_speed() -> None:
    train = load(TRAIN.replace("FRICTION", STRIBECK))
    speeds = [2 * pi * 2 * 0.012, 2 * pi * 2 * 24 / 36 * 0.010]
    assert [mesh.wheels.pitch_line for mesh in train.meshes] == pytest.approx(speeds, rel=1e-14)
    product = 1.0
    for (z1, z2), V in zip(((24, 36), (20, 60)), speeds, strict=True):
        rubbed = RubbedTransmission(Involute.declared({}).transmission(z1, z2), PairFriction(FALLING, V))
        product *= rubbed.efficiency_at_constant_load()
    assert efficiency(TRAIN.replace("FRICTION", STRIBECK)) == pytest.approx(product, rel=1e-12)


def test_a_law_of_the_pitch_line_is_a_number_for_each_pair() -> None:
    speeds = np.array([2 * pi * 2 * 0.012, 2 * pi * 4 / 3 * 0.010])
    coefficients = BuckinghamFriction(law="buckingham").coefficient(speeds)
    text = TRAIN.replace("FRICTION", "0")
    for pair, f in zip(("[p, q]", "[r, s]"), coefficients, strict=True):
        text = text.replace(f"pair: {pair}", f"pair: {pair}, friction: {float(f)!r}")
    assert efficiency(TRAIN.replace("FRICTION", "{law: buckingham}")) == pytest.approx(efficiency(text), rel=1e-13)


@pytest.mark.parametrize(
    ("form", "radius"),
    [
        ("{form: triangular, half_angle: 30 deg, clearance_factor: 1.01}", 0.048 * 1.01),
        ("{form: triangular, half_angle: 30 deg, clearance_factor: 1.01, radii: [1, 2.01]}", 0.048),
        ("{form: triangular, half_angle: 30 deg, centre_distance: 145.5 mm, radii: [50 mm, 98.1 mm]}", 0.1455 / 3),
        ("{form: involute}", 0.048),
        ("{form: involute, centre_distance: 144.3 mm, addendum: [1, 1]}", 0.1443 / 3),
    ],
)
def test_a_pitch_line_is_where_the_wheels_of_a_size_roll(form: str, radius: float) -> None:
    text = f"""
links:
  frame: {{}}
  a: {{wheels: {{p: {{teeth: 48, module: 2 mm}}}}}}
  b: {{wheels: {{q: {{teeth: 96, module: 2 mm}}}}}}
revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
gears: [{{pair: [p, q], tooth_form: {form}, friction: {{law: dokos}}}}]
inputs: {{a: 1}}
rate: 3 turn/s
"""
    (mesh,) = load(text).meshes
    assert mesh.pitch_radius == pytest.approx(radius, rel=1e-12)
    assert mesh.wheels.pitch_line == pytest.approx(6 * pi * radius, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("rate: 2 turn/s", ""), "the declaration does not give the speed of the train"),
        (("teeth: 36, module: 1 mm", "teeth: 36"), "the declaration does not give the size of its wheels"),
    ],
)
def test_what_a_law_lacks_is_said_with_the_line_of_the_pair(change: tuple[str, str], said: str) -> None:
    text = TRAIN.replace("FRICTION", STRIBECK).replace(*change)
    train = load(text)
    with pytest.raises(GearTrainError, match=said) as raised:
        train.torques()
    assert "p~q" in raised.value.problems[0].what
    unloaded = load(text.replace("loads: {c: -1 N m}", ""))
    assert unloaded.meshes[0].efficiency_texts == ("-", "-"), "a pair itself is told without its losses"


def test_losses_under_a_law_are_named_where_no_speed_is_determined() -> None:
    text = """
links:
  frame: {}
  sun: {wheels: {s: {teeth: 24, module: 1 mm}}}
  planet: {wheels: {p: {teeth: 18, module: 1 mm}}}
  ring: {wheels: {r: {teeth: 60, internal: true, module: 1 mm}}}
  arm: {}
revolutes: {A: [frame, sun, ring, arm], P: [arm, planet]}
tooth_form: {form: involute, addendum: 0.6}
friction: {law: dokos}
gears: [{pair: [s, p]}, {pair: [p, r]}]
inputs: {sun: 1}
rate: 1 turn/s
solve_for: ring
loads: {arm: -84 N m}
"""
    neglected = {each.what: each.where for each in load(text).torques().neglected}
    assert neglected["losses of pairs"] == ("s~p", "p~r")


@pytest.mark.parametrize(
    ("friction", "said"),
    [
        ("{law: stribek}", "'stribeck'"),
        ("{law: stribeck, statc: 1, kinetic: 1, speed: 1 m/s}", "did you mean 'static'"),
        ("{law: stribeck, static: 1, kinetic: 1, speed: 1 mm}", "is a length"),
        ("{law: stribeck, static: 1, kinetic: 1, speed: 0 m/s}", "must be greater than 0"),
        ("{law: table, speeds: [1 m/s], coefficients: [1]}", "at least two"),
        ("{law: table, speeds: [2 m/s, 1 m/s], coefficients: [1, 1]}", "increasing order"),
        ("{law: table, speeds: [1 m/s, 2 m/s], coefficients: [1, -1]}", "0 or more"),
    ],
)
def test_a_law_that_is_none_is_refused_with_its_line(friction: str, said: str) -> None:
    with pytest.raises(GearTrainError) as raised:
        load(TRAIN.replace("FRICTION", friction))
    (problem,) = raised.value.problems
    assert problem.place.endswith(":9")
    assert said in " ".join((problem.what, problem.why, problem.fix))


UNDER = {
    "stribeck": {"friction_law": "stribeck,static=0.2,kinetic=0.08,speed=10 mm/s", "pitch_line_speed": "50 mm/s"},
    "viscous": {
        "friction_law": "stribeck,static=0.05,kinetic=0.05,speed=1 mm/s,viscous=5",
        "pitch_line_speed": "1 m/s",
    },
    "dokos": {"friction_law": "dokos", "pitch_line_speed": "0.1 m/s"},
}
HIGH, MARGIN = radians(25), 0.15


class Alternatives:
    """Recess sides of 24/36 by plain sums: heights eta over the distance d, and what they lose for a given arc."""

    def __init__(self, form: LeastFriction) -> None:
        assert form.friction_law is not None
        assert form.pitch_line_speed is not None
        A, self.b = 1 / 12, 1 / 18
        self.d = np.linspace(0.0, 4.0, 8001)
        self.mu = form.friction_law.coefficient((A + self.b) * self.d * form.pitch_line_speed.si)

    def loss(self, eta: np.ndarray, X: float) -> float:
        """The integral of mu d / cos^2 psi up to the end of an arc X; NaN where the path is not admissible before."""
        with np.errstate(divide="ignore", invalid="ignore"):
            sine = np.where(self.d > 0, eta / self.d, sin(HIGH))
            secant = 1 / np.sqrt(1 - sine**2)
        step = self.d[1]
        arc = np.concatenate(([0.0], np.cumsum((secant[1:] + secant[:-1]) / 2 * step)))
        last = int(np.searchsorted(arc, X))
        speeds = np.diff(eta)[: last - 1] / step - self.b * (self.d[1:last] + self.d[: last - 1]) / 2
        if not (sine[:last] <= sin(HIGH) + 1e-9).all() or not (speeds >= MARGIN - 1e-9).all():
            return float("nan")
        lost = self.mu * self.d * secant**2
        total = np.concatenate(([0.0], np.cumsum((lost[1:] + lost[:-1]) / 2 * step)))
        return float(np.interp(X, arc, total))

    def slow(self, first: float, start: float = HIGH, more: np.ndarray | float = 0.0) -> np.ndarray:
        """A ray of `start` up to `first`, then the slowest contact, `more` added to its speed, below the ceiling."""
        grown = sin(start) * first + np.concatenate(
            ([0.0], np.cumsum(np.where(self.d[1:] > first, MARGIN + more + self.b * self.d[1:], 0.0)) * self.d[1])
        )
        return np.minimum(np.where(self.d <= first, sin(start) * self.d, grown), sin(HIGH) * self.d)


@pytest.mark.parametrize("name", UNDER)
def test_teeth_made_for_a_law_lose_least_under_it(name: str) -> None:
    form = LeastFriction.declared(UNDER[name])
    side = form.transmission(24, 36).path.recess
    first, X = side.pieces[0].end, side.arc
    assert pytest.approx(pi / 2) == X
    ways = Alternatives(form)
    minimum = ways.loss(ways.slow(first), X)
    # a second way to the same length: not the first variation but the least of the loss itself
    lengths = first * np.linspace(0.8, 1.2, 41)
    losses = [ways.loss(ways.slow(each), X) for each in lengths]
    assert lengths[int(np.nanargmin(losses))] == pytest.approx(first, rel=0.011)
    curve = np.polyfit(lengths[16:25] - first, losses[16:25], 2)
    assert -curve[1] / (2 * curve[0]) == pytest.approx(0.0, abs=2e-3 * first)
    # flatter rays, faster stretches, other lengths: none is better
    random = np.random.default_rng(17)
    tried = 0
    for _ in range(60):
        start, length = radians(random.uniform(18, 25)), first * random.uniform(0.3, 1.6)
        more = random.uniform(0, 0.5) * (np.abs(ways.d[1:] - random.uniform(0, 1.6)) < random.uniform(0.02, 0.5))
        other = ways.loss(ways.slow(length, start, more), X)
        tried += not np.isnan(other)
        assert not other < minimum * (1 - 1e-7)
    assert tried > 20


def test_a_level_law_asks_for_the_usual_shape_and_one_of_the_pitch_line_is_level() -> None:
    usual = LeastFriction.declared({}).transmission(24, 36).path.recess.pieces[0].end
    level = {"law": "table", "speeds": ["0 m/s", "1 m/s"], "coefficients": [0.1, 0.1]}
    for transmission in (level, "buckingham"):
        form = LeastFriction.declared({"friction_law": transmission, "pitch_line_speed": "1 m/s"})
        assert form.transmission(24, 36).path.recess.pieces[0].end == pytest.approx(usual, rel=1e-12)


def test_a_law_under_which_faster_contacts_lose_less_is_refused() -> None:
    given = {"friction_law": "stribeck,static=0.2,kinetic=0.02,speed=10 mm/s", "pitch_line_speed": "50 mm/s"}
    with pytest.raises(GearTrainError, match="do not consist of"):
        LeastFriction.declared(given).transmission(24, 36)
    with pytest.raises(GearTrainError, match="only one of friction_law and pitch_line_speed is given"):
        LeastFriction.declared({"friction_law": "dokos"})
