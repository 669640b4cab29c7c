"""Time stepping with contact: closed forms of free and dragged bodies, an integrator with events, linear algebra."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import cos, exp, pi, sin

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

from geartrain.numerics.kernels import kernel
from geartrain.simulation.contacts.contact_model import (
    Bearing,
    ContactModel,
    ContactPair,
    ContactSystem,
    Form,
    Spring,
    Stop,
)
from geartrain.simulation.contacts.pair_tables import TabledFunction, join_tables, tabled_angle, value_and_slope
from geartrain.simulation.contacts.train_model import SlackPin
from geartrain.simulation.steps import simulation
from geartrain.simulation.steps.contact_solution import (
    BEARINGS,
    GAP,
    IMPACT_COUNT,
    IMPACT_LOSS,
    STEP,
    TIME_APART,
    VISCOUS,
    ContactState,
    StepRules,
)
from geartrain.simulation.steps.simulation import SimulatedRun, StepPlan, simulate
from geartrain.teeth import PinToSlotTransmission, TransmissionFunction
from geartrain.teeth.transmission import ExactRatio

TURN = 2 * pi
EVEN = tabled_angle(ExactRatio(Fraction(1), TURN))


def ahead(backlash: float) -> TabledFunction:
    """The coast flank of even teeth with some play."""
    return tabled_angle(ExactRatio(Fraction(1), TURN, backlash))


def pair(
    front: TabledFunction,
    back: TabledFunction,
    restitution: float = 0.0,
    start: float = 0.0,
    ends: tuple[Form, Form] = ({0: 1.0}, {1: 1.0}),
) -> ContactPair:
    """Coordinate 0 drives coordinate 1, which is `start` ahead."""
    return ContactPair("pair", *ends, (0.0, start), front, back, None, restitution)


def model(
    inertia: Sequence[float],
    speed: Sequence[float],
    pairs: Sequence[ContactPair],
    given: dict[int, float] | None = None,
    bearings: Sequence[Bearing] = (),
    stops: Sequence[Stop] = (),
    springs: Sequence[Spring] = (),
    torque: Sequence[float] = (),
    viscous: Sequence[float] = (),
) -> ContactModel:
    n = len(inertia)
    return ContactModel(
        np.diag(inertia).astype(float),
        np.diag(viscous or [0.0] * n),
        np.array(torque or [0.0] * n),
        given or {},
        np.array(speed, dtype=float),
        pairs,
        bearings,
        stops,
        springs,
        np.array(speed, dtype=float),
    )


def run(
    of: ContactModel,
    step: float,
    time: float,
    skip: float = 0.0,
    samples: int = 1,
    fast: bool = False,
) -> SimulatedRun:
    steps = round(time / step)
    found = simulate(of, StepPlan(step, round(skip / step), steps, steps // samples), fast)
    assert_energy_is_accounted_for(found)
    return found


def assert_energy_is_accounted_for(found: SimulatedRun) -> None:
    put_in, taken = found.energy[:3].sum(), found.energy[3:].sum()
    scale = np.abs(found.energy).sum() + found.start + found.end
    assert found.end - found.start - put_in + taken == pytest.approx(0, abs=1e-10 * scale)


class ShakenCavity(ExactRatio):
    """A wall that stands at sin S, whatever its mean."""

    def __init__(self, width: float) -> None:
        super().__init__(Fraction(0), TURN)
        self.width = width

    def error(self, S: ArrayLike) -> NDArray[np.float64]:
        return self.width + np.sin(np.asarray(S, dtype=float))

    def speed(self, S: ArrayLike) -> NDArray[np.float64]:
        return np.cos(np.asarray(S, dtype=float))


class BehindPin(PinToSlotTransmission):
    """A pin that leaves its slot some play."""

    def error(self, S: ArrayLike) -> NDArray[np.float64]:
        return super().error(S) + 0.5


# ------------------------------------------------------------------------------------------------------ closed forms


def test_two_free_bodies_share_their_momentum_by_three_impacts() -> None:
    # mu u^2 (1 - e^(2 n))/2 is lost in n blows at 0.1, 0.1 + 0.1/e, ...
    found = run(model([2, 1], [1, 0], [pair(EVEN, ahead(0.1), 0.6, start=0.1)]), 1e-3, 1.0)
    assert found.speeds[-1] == pytest.approx([0.5946666667, 0.8106666667], rel=1e-9)
    assert found.energy[IMPACT_LOSS] == pytest.approx(0.3177813333, rel=1e-9)
    assert found.impacts[:, 0] == pytest.approx([0.1, 0.266667, 0.544444], abs=5e-3)
    assert 2 * found.speeds[-1, 0] + found.speeds[-1, 1] == pytest.approx(2, rel=1e-14)


def test_a_ball_in_a_shaken_cavity_reaches_the_closed_motion_of_two_impacts_a_period() -> None:
    # v pi = L + 2 sin phi, cos phi = -v (1 - e)/(1 + e)
    width, e = 3.0, 0.6
    cavity = pair(tabled_angle(ShakenCavity(0.0)), tabled_angle(ShakenCavity(width)), e, start=1.0)
    found = run(model([1, 1], [1, 1.2], [cavity], given={0: 1.0}), 1e-2, 12 * TURN)
    time, _, closing, _, _ = found.impacts[-6:].T
    phi = 1.9666333
    assert time % pi == pytest.approx(np.full(6, phi), abs=0.02)
    assert closing.mean() == pytest.approx(1.5423223 - cos(phi), rel=1e-2)


def dragged(step: float, samples: int = 1, fast: bool = False) -> SimulatedRun:
    backlash = pair(EVEN, ahead(0.2), 0.7)
    drag = Bearing("drag", {1: 1.0}, 0.5, 0.5)
    return run(
        model([1, 1], [0, 1.5], [backlash], given={0: 0.0}, bearings=[drag]), step, 2.0, samples=samples, fast=fast
    )


def test_drag_and_impacts_stop_a_body_between_its_flanks() -> None:
    found = dragged(1e-3)
    assert found.counts[0, IMPACT_COUNT] == 3
    assert found.energy[BEARINGS] == pytest.approx(0.34758022, abs=2e-3)
    assert found.energy[IMPACT_LOSS] == pytest.approx(0.77741978, abs=2e-3)
    assert abs(found.speeds[-1, 1]) < 1e-9


@pytest.mark.slow
def test_small_steps_give_the_closed_forms_at_their_digits() -> None:
    free = run(model([2, 1], [1, 0], [pair(EVEN, ahead(0.1), 0.6, start=0.1)]), 1e-6, 1.0, fast=True)
    assert free.impacts[:, 0] == pytest.approx([0.1, 0.266667, 0.544444], abs=3e-6)
    walls = (tabled_angle(ShakenCavity(0.0)), tabled_angle(ShakenCavity(3.0)))
    shaken = run(model([1, 1], [1, 1.2], [pair(*walls, 0.6, start=1.0)], given={0: 1.0}), 1e-4, 30 * TURN, fast=True)
    time, _, closing, _, _ = shaken.impacts[-6:].T
    assert time % pi == pytest.approx(np.full(6, 1.9666333), abs=2e-4)  # two steps
    assert closing + cos(1.9666333) == pytest.approx(np.full(6, 1.5423223), abs=1e-4)
    stopped = dragged(1e-6, samples=2000, fast=True)
    assert 0.7 * stopped.impacts[:, 2] == pytest.approx([1.0022475, 0.6278575, 0.3084809], abs=2e-6)
    assert stopped.energy[BEARINGS] == pytest.approx(0.34758022, abs=2e-6)
    assert stopped.energy[IMPACT_LOSS] == pytest.approx(0.77741978, abs=2e-6)
    assert 1e-3 * np.argmax(abs(stopped.speeds[:, 1]) < 1e-8) == pytest.approx(1.338355, abs=1e-3)


def test_friction_of_rest_holds_what_friction_of_motion_would_not() -> None:
    for torque, moves in ((0.9, False), (1.1, True)):
        found = run(model([1], [0], [], bearings=[Bearing("b", {0: 1.0}, 0.5, 1.0)], torque=[torque]), 1e-3, 1.0)
        assert bool(abs(found.speeds[-1, 0]) > 0.1) is moves
        if moves:
            assert found.speeds[-1, 0] == pytest.approx(torque - 0.5, rel=1e-2)


def test_viscous_drag_slows_exponentially_and_a_spring_swings_at_its_frequency() -> None:
    found = run(model([2], [1], [], viscous=[0.5]), 1e-3, 2.0)
    assert found.speeds[-1, 0] == pytest.approx(exp(-0.5), rel=1e-3)
    assert found.energy[VISCOUS] == pytest.approx(1 - exp(-1), rel=1e-3)
    swing = run(model([2], [1], [], springs=[Spring("s", {0: 1.0}, 8.0)]), 1e-4, 0.5)
    assert swing.angles[-1, 0] == pytest.approx(sin(2 * 0.5) / 2, rel=1e-3)


def test_a_stopped_wheel_passes_one_pitch_a_beat() -> None:
    found = run(
        model([1], [0], [], stops=[Stop("escapement", {0: 1.0}, 0.1, 0.5)], torque=[10.0]), 1e-3, 5.0, samples=10
    )
    assert found.angles[:, 0] == pytest.approx(0.1 * np.arange(1, 11), abs=1e-9)
    # ten falls through a pitch: the work of the torque is lost in blows
    assert found.energy[IMPACT_LOSS] + found.energy[STEP] == pytest.approx(10 * 0.1 * 10, rel=1e-9)


@kernel
def never_idle(system: ContactSystem, state: ContactState, rules: StepRules, most: int) -> int:
    """Every step for itself."""
    return 0


@pytest.mark.parametrize(("kept", "rubs"), [(10, False), (7, False), (250, True)])
def test_a_wheel_that_rests_between_beats_is_stepped_at_once_and_all_figures_stay(
    kept: int, rubs: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    escapement = Stop("escapement", {1: 1.0}, 0.1, 0.5, 0.3)
    of = model(
        [1, 0.5],
        [0.1, 0.2],
        [pair(EVEN, ahead(0.01), 0.0)],
        stops=[escapement],
        torque=[6.0, 0.0],
        bearings=[Bearing("drag", {1: 1.0}, 0.5, 1.0)] if rubs else [],
        springs=[Spring("spring", {0: 1.0}, 0.2, 20.0)],
    )
    quick = run(of, 1e-3, 4.2, samples=kept)
    monkeypatch.setattr(simulation, "run_steps", simulation.run_steps.replaced(find_idle_steps=never_idle))
    slow = run(of, 1e-3, 4.2, samples=kept)
    assert quick.numbers == slow.numbers
    for name in ("angles", "speeds", "energy", "impacts"):
        assert getattr(quick, name) == pytest.approx(getattr(slow, name), rel=1e-6, abs=1e-8), name
    # what a bearing that sticks and a stop carry together is not determined
    near = {"rel": 0.1} if rubs else {"rel": 1e-6, "abs": 1e-8}
    for name in ("forces", "counts"):
        assert getattr(quick, name) == pytest.approx(getattr(slow, name), **near), name


@pytest.mark.parametrize("e", [0.0, 0.3, 0.7])
@pytest.mark.parametrize("height", [1e-4, 1e-6])
def test_a_body_that_falls_on_its_flank_is_apart_until_its_bounces_end(e: float, height: float) -> None:
    # a fall takes sqrt(2 height/a), all bounces together 2 e/(1 - e) times as long, and then it stays in contact
    fall = np.sqrt(2 * height / 3.0)
    whole = fall * (1 + 2 * e / (1 - e))
    of = model([1, 2], [0, 0], [pair(EVEN, ahead(0.5), e, start=height)], given={0: 0.0}, torque=[0, -6.0])
    found = run(of, fall / 2000, 1.3 * whole)
    assert found.counts[0, TIME_APART] * fall / 2000 == pytest.approx(whole, rel=0.02)
    assert found.energy[IMPACT_LOSS] == pytest.approx(6.0 * height, rel=0.01)


@pytest.mark.parametrize("step", [3e-2, 1e-2, 1.7e-3])
@pytest.mark.parametrize("e", [0.0, 0.4])
def test_a_wheel_meets_its_stop_at_the_speed_of_its_fall_whatever_the_step(step: float, e: float) -> None:
    # J = 2, T = 3, pitch 0.1: v^2 = 2 T pitch/J = 0.3; then e times that speed, and e^2
    of = model([2], [0.2], [], stops=[Stop("escapement", {0: 1.0}, 0.1, 0.9, e)], torque=[3.0])
    of = ContactModel(of.mass, of.viscous, of.torque, of.given, of.typical, stops=of.stops)
    found = run(of, step, 4.4)
    speeds = found.impacts[:, 2]
    assert speeds.max() == pytest.approx(np.sqrt(0.3), rel=3e-3 if e else 1e-6)
    firsts = speeds[speeds > 0.9 * speeds.max()]
    assert firsts == pytest.approx(np.full(5, np.sqrt(0.3)), rel=3e-3 if e else 1e-6)
    if e:  # a bounce shorter than a step ends in contact
        assert speeds[1] == pytest.approx(e * np.sqrt(0.3), rel=1e-4)


def test_blocks_add_up_to_the_run() -> None:
    plan = StepPlan(1e-3, 100, 1000, 7, 7 * 30)
    of = model([1, 2], [0, 0], [pair(EVEN, ahead(0.5), 0.3, start=0.1)], given={0: 0.0}, torque=[0, -6.0])
    found, plain = simulate(of, plan), simulate(of, plan._replace(block=0))
    assert [part.plan.steps for part in found.blocks] == [210] * 4
    assert found.energy == pytest.approx(plain.energy)
    assert found.counts[0] == pytest.approx(plain.counts[0])
    late = simulate(of, plan._replace(skip=98 + 840, steps=160, block=0))
    for name in ("energy", "turned"):
        parts = sum(getattr(part, name) for part in found.blocks)
        assert parts + getattr(late, name) == pytest.approx(getattr(found, name)), name


# ------------------------------------------------------------------------------------------------- a slack pin, events


J, DRAG, PIN = 1e-5, 1e-3, PinToSlotTransmission(10, 2)
PARTS = 20.4056115  # rad/s: sqrt(DRAG/(J 0.24016005))


def slack_pin(rate: float, steps: int, turns: float = 1.0) -> SimulatedRun:
    slot = pair(tabled_angle(PIN), tabled_angle(BehindPin(10, 2)))
    drag = Bearing("drag", {1: 1.0}, DRAG, DRAG)
    of = model([1, J], [rate, 2.0 / 2 * rate], [slot], given={0: rate}, bearings=[drag])
    of = ContactModel(of.mass, of.viscous, of.torque, of.given, of.typical, of.pairs, of.bearings)
    return run(of, TURN / rate / steps, turns * TURN / rate)


@pytest.mark.parametrize(("share", "minimum", "most"), [(0.999, 0.0, 1e-6), (1.01, 4e-5, 4e-4)])
def test_a_slack_pin_leaves_its_slot_at_the_rate_at_which_the_drag_no_longer_slows_it(
    share: float, minimum: float, most: float
) -> None:
    assert minimum <= slack_pin(share * PARTS, 4000).counts[0, GAP] <= most


@pytest.mark.long
@pytest.mark.parametrize(("offset", "parts", "share", "gap"), [
    (2, PARTS, 0.999, 0.0),
    (2, PARTS, 1.001, 2.249994e-6),
    (2, PARTS, 1.003, 2.035957e-5),
    (8, 2.76880500, 1.0, 0.0),
    (8, 2.76880500, 1.01, 2.674743e-4),
])  # fmt: skip
def test_beyond_that_rate_the_gap_is_that_of_an_even_fall_from_where_it_leaves(
    offset: int, parts: float, share: float, gap: float
) -> None:
    # q = F(S0) + w tau(S0) t - beta t^2/(2 J) less F(S0 + w t), with J w^2 tau'(S0) = -beta, at its greatest
    transmission, rate = PinToSlotTransmission(10, offset), share * parts
    slot = pair(tabled_angle(transmission), tabled_angle(BehindPin(10, offset)))
    drag = Bearing("drag", {1: 1.0}, DRAG, DRAG)
    of = model([1, J], [rate, rate * float(transmission.speed(0.0))], [slot], given={0: rate}, bearings=[drag])
    found = run(of, TURN / rate / 50_000, TURN / rate, fast=True)
    assert found.counts[0, GAP] == pytest.approx(gap, rel=1e-4, abs=1e-9)


def flight(rate: float) -> tuple[float, float, float, float]:
    """When a slack slot leaves its pin and meets it again, the greatest gap and the speed of the blow: by events."""

    def slope(S: float) -> float:
        return float((PIN.speed(S + 1e-5) - PIN.speed(S - 1e-5)) / 2e-5)

    low, high = 0.0, float(np.radians(51.6154))
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if J * rate**2 * slope(middle) > -DRAG else (low, middle)

    def motion(time: float, y: NDArray[np.float64]) -> list[float]:
        return [y[1], -DRAG / J]

    def gap(time: float, y: NDArray[np.float64]) -> float:
        return float(y[0] - PIN.angle(low + rate * time))

    def apart(time: float, y: NDArray[np.float64]) -> float:
        return gap(time, y) if time > 1e-3 else 1.0

    apart.terminal = True  # type: ignore[attr-defined]
    start = [float(PIN.angle(low)), rate * float(PIN.speed(low))]
    found = solve_ivp(motion, (0, TURN / rate), start, events=apart, rtol=1e-11, atol=1e-13, dense_output=True)
    end = found.t_events[0][0]
    times = np.linspace(0, end, 4000)
    most = max(gap(time, found.sol(time)) for time in times)
    return low, low + rate * end, most, float(found.sol(end)[1] - rate * PIN.speed(low + rate * end))


def test_the_flight_of_a_slack_slot_is_that_of_an_integrator_with_events() -> None:
    leaves, lands, gap, impact = flight(1.2 * PARTS)
    assert (leaves, lands, gap, impact) == pytest.approx((0.403181, 3.620379, 0.0762169, -4.07532), rel=1e-5)
    found = slack_pin(1.2 * PARTS, 5000)
    assert (lands - leaves) / TURN == pytest.approx(0.5120329, abs=2e-7)
    assert found.counts[0, GAP] == pytest.approx(gap, rel=1e-3)
    assert found.counts[0, TIME_APART] / 5000 == pytest.approx((lands - leaves) / TURN, abs=3e-4)
    assert found.impacts[0, 2] == pytest.approx(-impact, rel=1e-2)


# ------------------------------------------------------------------------------------------------------ the solution


@pytest.mark.parametrize("side", [1, -1])
def test_the_ratio_of_a_slack_pin_is_the_slope_of_its_angle(side: int) -> None:
    transmission = SlackPin(PinToSlotTransmission(10.0, 5.0), 2.0, side)
    S, step = np.linspace(0.0, 6.0, 25), 1e-5
    slope = (np.asarray(transmission.angle(S + step)) - np.asarray(transmission.angle(S - step))) / (2 * step)
    assert np.allclose(transmission.speed(S), slope, rtol=0, atol=1e-9)


def test_a_tabled_transmission_is_the_transmission_and_its_ratio_the_slope() -> None:
    for transmission in (PIN, PinToSlotTransmission(10, 8), PinToSlotTransmission(6, 10)):
        of: TransmissionFunction = transmission
        transmissions = join_tables([tabled_angle(of)])
        for S in np.linspace(-20, 20, 101):
            angle, ratio = value_and_slope(transmissions, 0, S)
            assert angle == pytest.approx(float(of.angle(S)), abs=1e-8)
            assert ratio == pytest.approx(float(of.speed(S)), abs=1e-6)


def test_where_a_carrier_moves_the_reduced_system_is_that_of_lagrange() -> None:
    # a sun (0) drives a planet (2) on a carrier (1): 20 and 30 teeth; sun and carrier are torqued, nothing is held
    mass = np.array([3.0, 5.0, 0.7])
    torque = np.array([1.0, -0.3, 0.2])
    tau = 20 / 30
    even = tabled_angle(ExactRatio(Fraction(2, 3), TURN))
    mesh = ContactPair("sun~planet", {0: 1.0, 1: -1.0}, {2: -1.0, 1: 1.0}, (0.0, 0.0), even, even)
    of = model(mass.tolist(), [0, 0, 0], [mesh], torque=torque.tolist())
    found = run(of, 1e-2, 1.0)
    row = np.array([-tau, 1 + tau, -1.0])
    saddle = np.block([[np.diag(mass), row[:, None]], [row[None], np.zeros((1, 1))]])
    expected = np.linalg.solve(saddle, np.append(torque, 0.0))[:3]
    assert found.speeds[-1] == pytest.approx(expected, rel=1e-10)


def test_two_ways_to_one_link_share_its_load_and_keep_together() -> None:
    # 0 drives 1 and 2, both drive 3: a loop that closes
    ends: list[tuple[Form, Form]] = [
        ({0: 1.0}, {1: 1.0}),
        ({0: 1.0}, {2: 1.0}),
        ({1: 1.0}, {3: 1.0}),
        ({2: 1.0}, {3: 1.0}),
    ]
    pairs = [pair(EVEN, EVEN, ends=each) for each in ends]
    found = run(model([1, 1, 1, 1], [0, 0, 0, 0], pairs, torque=[4, 0, 0, 0]), 1e-2, 1.0)
    assert found.speeds[-1] == pytest.approx(np.ones(4), rel=1e-7)
