"""Time stepping with contact: closed forms of falling, flying and dragged bodies, escape wheels and slack pins."""

from __future__ import annotations

from math import asin, cos, exp, pi, sqrt, tau
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from geartrain import GearTrain
from geartrain.simulation import Simulation, TimeRun
from geartrain.simulation.contacts import SlackPin
from geartrain.teeth import PinToSlotTransmission

J, BACKLASH = 1e-5, 0.02  # kg m2; rad on both wheels, whose pitch radius is 20 modules
EVEN: dict[str, Any] = {
    "links": {
        "frame": {},
        "a": {"wheels": {"p": 40}, "inertia": f"{2 * J} kg m2"},
        "b": {"wheels": {"w": 40}, "inertia": f"{J} kg m2"},
    },
    "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    "gears": [{"pair": ["p", "w"], "tooth_form": {"form": "involute", "backlash": f"{20 * BACKLASH}"}}],
    "inputs": {"a": 1},
}


def with_b(**more: Any) -> dict[str, Any]:
    return EVEN["links"] | {"b": EVEN["links"]["b"] | more}


def turned(
    step: float, restitution: float = 0.0, at: float | None = 1.0, fast: bool = False, **more: Any
) -> Simulation:
    """Two equal wheels with backlash; b turns backwards while a turns forwards."""
    return GearTrain.declare(EVEN | more).simulation(at, step=step, restitution=restitution, fast=fast)


@pytest.mark.parametrize("e", [0.0, 0.3, 0.7])
@pytest.mark.parametrize("torque", [1e-3, 1e-5])
def test_a_body_that_falls_on_its_flank_is_apart_until_its_bounces_end(e: float, torque: float) -> None:
    # a fall takes sqrt(2 height/a), all bounces together 2 e/(1 - e) times as long, and then it stays in contact
    fall = sqrt(2 * BACKLASH * J / torque)
    whole = fall * (1 + 2 * e / (1 - e))
    made = turned(fall / 2000, e).anew(drive=0.0)
    made.set_load("b", -torque)
    made.advance(1.3 * whole)
    assert made.apart["p~w"] * made.time == pytest.approx(whole, rel=0.02)
    assert made.impact_energy["p~w"] == pytest.approx(torque * BACKLASH, rel=0.01)
    assert made.angles["b"] == pytest.approx(-BACKLASH, rel=1e-6)
    assert made.unsolved == 0


def test_free_bodies_share_their_momentum_by_impacts() -> None:
    # b falls across most of its backlash, then flies on at the speed u; n impacts leave mu u^2 e^(2 n)/2
    e, torque = 0.6, 1e-4
    made = turned(1e-4, e, None, rate="1 rad/s", drive={"torque": "1 N mm"})
    made.set_drive(0.0)
    made.set_load("b", -torque)
    fall = sqrt(2 * 0.9 * BACKLASH * J / torque)
    made.advance(round(fall, 4))
    made.set_load("b", 0.0)
    u = -made.speeds["b"]
    assert u == pytest.approx(torque / J * round(fall, 4), rel=1e-9)
    made.advance(2.0)
    # masses 2 J and J, which turn in opposite senses
    reduced = 2 * J / 3
    assert 2 * J * made.speeds["a"] - J * made.speeds["b"] == pytest.approx(J * u, rel=1e-9)
    ends = [u * e**n for n in range(1, 60)]
    gap = abs(made.speeds["a"] + made.speeds["b"])
    n = 1 + int(np.argmin([abs(gap - each) for each in ends]))
    assert n >= 3
    assert gap == pytest.approx(u * e**n, rel=1e-6)
    assert made.impact_energy["p~w"] == pytest.approx(reduced * u**2 / 2 * (1 - e ** (2 * n)), rel=1e-6)


@pytest.mark.parametrize(
    ("step", "fast", "off"), [(1e-3, False, 2e-3), pytest.param(1e-5, True, 2e-5, marks=pytest.mark.slow)]
)
def test_drag_and_impacts_stop_a_body_between_its_flanks(step: float, fast: bool, off: float) -> None:
    # the crank stops, b flies on at 0.15 rad/s and is slowed by 0.05 rad/s2: energies by hand, in J of a unit inertia
    made = turned(step, 0.7, 0.15, fast=fast, links=with_b(bearing=f"{0.05 * J} N m"))
    made.advance(step)
    made.set_drive(0.0)
    made.advance(2.0)
    assert made.impact_energy["p~w"] == pytest.approx(0.77741978e-2 * J, abs=off * 1e-2 * J)
    assert abs(made.speeds["b"]) < 1e-10


@pytest.mark.parametrize(("torque", "moves"), [(0.9, False), (1.1, True)])
def test_friction_at_rest_holds_what_friction_of_motion_would_not(torque: float, moves: bool) -> None:
    made = turned(1e-3, links=with_b(bearing={"sliding": "0.5 N mm", "static": "1 N mm"})).anew(drive=0.0)
    made.set_load("b", -1e-3 * torque)
    made.advance(0.02)
    expected = 1e-3 * (torque - 0.5) / J * 0.02 if moves else 0.0
    assert -made.speeds["b"] == pytest.approx(expected, rel=0.05, abs=1e-8)


def test_viscous_drag_limits_a_speed_exponentially_and_a_spring_swings_at_its_frequency() -> None:
    links = with_b(drag="1e-4 N m s/rad")
    # the ideal pair makes one body of 3 J, with the drag of b
    gears = [{"pair": ["p", "w"]}]
    made = turned(1e-4, at=None, rate="1 rad/s", drive={"torque": "1 N mm"}, links=links, gears=gears)
    made.advance(0.5)
    assert made.speed == pytest.approx(10 * (1 - exp(-0.5 * 1e-4 / (3 * J))), rel=1e-3)
    spring = {"spring": {"stiffness": "1e-3 N m/rad", "turns": 0.5}}
    made = turned(1e-4, at=None, rate="1 rad/s", drive=spring, gears=gears)
    made.advance(0.2)
    assert made.angle == pytest.approx(pi * (1 - cos(sqrt(1e-3 / (3 * J)) * 0.2)), rel=1e-2)


def clock(step: float, e: float, **more: Any) -> GearTrain:
    """A barrel that drives an escape wheel of 30 teeth through a pair with backlash, 0.9 s from beat to beat."""
    links = with_b(bearing={"sliding": "0.5 N mm", "static": "1 N mm"})
    escapement = {"link": "b", "teeth": 30, "beat": "0.9 s"}
    return GearTrain.declare(
        EVEN | {"links": links, "escapement": escapement, "drive": {"torque": "3 N mm"}, "restitution": e} | more
    )


@pytest.mark.parametrize("step", [3e-3, 1e-3, 1.7e-4])
@pytest.mark.parametrize("e", [0.0, 0.4])
def test_a_wheel_meets_its_stop_at_the_speed_of_its_fall_whatever_the_step(step: float, e: float) -> None:
    # the drive's torque less friction turns 3 J through half the pitch of a tooth
    train = clock(step, e)
    turn = 0.9 * 60
    run = train.dynamics(turns=4.4 / turn, skip=0, steps=round(turn / step), samples=10, fast=False)
    speeds, times = (
        each[[name == "b" for name in run.impacts.contact]] for each in (run.impacts.speed, run.impacts.time)
    )
    expected = sqrt(2 * 2.5e-3 / (3 * J) * pi / 30)
    assert speeds.max() == pytest.approx(expected, rel=1e-6)
    # the fall takes twice as long as at its final speed
    firsts = times[speeds > 0.9 * expected]
    assert firsts == pytest.approx(0.9 * np.arange(5) + 2 * pi / 30 / expected, abs=2 * run.step)
    if e:
        # a rebound is slowed by 3 + 0.5 N mm, and returns under 3 - 0.5 N mm
        assert speeds[1] == pytest.approx(e * expected * sqrt(2.5 / 3.5), rel=2e-3)


@pytest.mark.parametrize("beats", [0.97, 2.6])
def test_a_train_that_rests_between_beats_takes_the_steps_of_one_that_does_not_skip_any(beats: float) -> None:
    one, other = (clock(1e-3, 0.3).simulation(step=1e-3) for _ in range(2))
    one.advance(0.9 * beats)
    found: dict[str, float] = dict.fromkeys(("apart", "torque", "impacts"), 0.0)
    count = round(0.9 * beats / 1e-3)
    for _ in range(count):
        other.advance(1e-3)
        found["apart"] += other.apart["p~w"] / count
        found["torque"] += other.torques["b"] / count
        found["impacts"] += other.impact_energy["b"]
    assert one.angles == pytest.approx(other.angles, rel=1e-9)
    assert found["apart"] == pytest.approx(one.apart["p~w"], rel=1e-6)
    assert found["impacts"] == pytest.approx(one.impact_energy["b"], rel=1e-6)
    # what a bearing that sticks and a stop carry together is not determined
    assert found["torque"] == pytest.approx(one.torques["b"], rel=0.02)


# ------------------------------------------------------------------------------------------------------- a slack pin

DRAG, CLEARANCE = 1e-3, 2.0  # N m; mm
PIN = PinToSlotTransmission(10, 2)


def slot(S: float) -> float:
    """Angle of the slot while its driven side touches the pin."""
    return float(PIN.angle(S)) - asin(CLEARANCE / 2 / sqrt(104 - 40 * cos(S)))


def slope(S: float) -> float:
    return (slot(S + 1e-5) - slot(S - 1e-5)) / 2e-5


def bend(S: float) -> float:
    return (slope(S + 1e-4) - slope(S - 1e-4)) / 2e-4


PARTS = sqrt(DRAG / J / -min(bend(S) for S in np.linspace(0, pi, 20_001)))
"""Rate at which the drag just slows the slot as much as the pin does [rad/s]."""


def slack_pin(rate: float) -> TimeRun:
    pin = {"kind": "pin_and_slot", "pin": "a", "slot": "b", "pin_radius": "10 mm", "offset": "2 mm"}
    train = GearTrain.declare(
        {
            "links": {"frame": {}, "a": {}, "b": {"inertia": f"{J} kg m2", "bearing": f"{DRAG} N m"}},
            "revolutes": EVEN["revolutes"],
            "couplings": [pin | {"clearance": f"{CLEARANCE} mm"}],
            "inputs": {"a": 1},
        }
    )
    return train.dynamics(rate, turns=1, skip=0, steps=2500, fast=False)


def test_a_slack_pin_leaves_its_slot_at_the_rate_at_which_the_drag_no_longer_slows_it() -> None:
    assert slack_pin(0.999 * PARTS).contacts[0].gap < 1e-6
    assert 4e-5 < slack_pin(1.01 * PARTS).contacts[0].gap < 4e-4


def test_the_flight_of_a_slack_slot_is_an_even_fall_from_where_it_leaves() -> None:
    rate = 1.2 * PARTS
    leaves = brentq(lambda S: J * rate**2 * bend(S) + DRAG, 0.0, 0.9)

    def gap(t: float) -> float:
        fallen = slot(leaves) + rate * slope(leaves) * t - DRAG * t**2 / (2 * J)
        return fallen - slot(leaves + rate * t)

    lands = brentq(gap, 1 / rate, 5 / rate)
    run = slack_pin(rate)
    contact = run.contacts[0]
    assert contact.gap == pytest.approx(max(gap(t) for t in np.linspace(0, lands, 4000)), rel=1e-3)
    assert contact.apart * tau == pytest.approx(lands * rate, abs=2e-3)
    closing = rate * slope(leaves + rate * lands) - rate * slope(leaves) + DRAG * lands / J
    assert run.impacts.speed[0] == pytest.approx(closing, rel=1e-2)


@pytest.mark.parametrize("side", [1, -1])
def test_the_ratio_of_a_slack_pin_is_the_slope_of_its_angle(side: int) -> None:
    transmission = SlackPin(PinToSlotTransmission(10.0, 5.0), 2.0, side)
    S, step = np.linspace(0.0, 6.0, 25), 1e-5
    found = (np.asarray(transmission.angle(S + step)) - np.asarray(transmission.angle(S - step))) / (2 * step)
    assert np.allclose(transmission.speed(S), found, rtol=0, atol=1e-9)
