"""Three ways through time for one pair that flies and strikes: by events, by steps of rigid teeth, by teeth that yield.

A pin of 10 in a slot 2 off and 0.4 wider than it, behind a drive of constant speed, faster than the pin lets the slot
follow. Events are the truth: flights by scipy's solve_ivp to where a flank is met, contact to where it would pull.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from geartrain.simulation.contacts.compliant_train import damping_ratio
from geartrain.simulation.contacts.contact_model import Bearing, ContactModel, ContactPair, ToothCompliance
from geartrain.simulation.contacts.pair_tables import tabled_angle
from geartrain.simulation.contacts.train_model import SlackPin
from geartrain.simulation.steps.contact_solution import GAP, IMPACT_COUNT, IMPACT_LOSS, TIME_APART
from geartrain.simulation.steps.simulation import SimulatedRun, StepPlan, simulate
from geartrain.teeth import PinToSlotTransmission

INERTIA, DRAG, RATE, TURNS = 1e-5, 1e-3, 32.0, 2
"""kg m2, N m, rad/s: teeth part from 20.4 rad/s on."""
_TRANSMISSION = PinToSlotTransmission(10, 2)
FLANKS = SlackPin(_TRANSMISSION, 0.4, -1), SlackPin(_TRANSMISSION, 0.4, 1)
"""The slot's side that drives, and the other."""
_STICKS = 1e-7  # of the driver's speed: what comes back slower touches on
_MOST = 20_000  # events


@dataclass(frozen=True)
class PairRun:
    """What one way finds: greatest gap (rad), time apart (share), energy of blows (J), how many blows."""

    gap: float
    apart: float
    impacts: float
    count: int


def by_events(restitution: float, tolerance: float) -> PairRun:
    """From event to event, flights by DOP853 of such a tolerance."""
    run = _EventRun(restitution, tolerance)
    run.go(TURNS * 2 * pi / RATE)
    return PairRun(run.gap, run.apart / run.t, run.lost, run.count)


class _EventRun:
    """Where the slot is (t, q, v), and the flank it touches or None."""

    def __init__(self, restitution: float, tolerance: float) -> None:
        self.e, self.tolerance = restitution, tolerance
        self.t, self.q, self.v = 0.0, float(FLANKS[0].angle(0.0)), RATE * float(FLANKS[0].speed(0.0))
        self.side: int | None = 0
        self.apart, self.gap, self.lost, self.count = 0.0, 0.0, 0.0, 0

    def go(self, end: float) -> None:
        for _ in range(_MOST):
            if self.t >= end:
                return
            if self.side is None:
                self._fly(end)
            else:
                self._follow(end)
        raise ArithmeticError("too many events")

    def _gap(self, t: float, q: float, side: int) -> float:
        return (1 - 2 * side) * (q - float(FLANKS[side].angle(RATE * t)))

    def _fly(self, end: float) -> None:
        drag = -np.sign(self.v) * DRAG / INERTIA
        start = self.t

        def event(side: int) -> Any:
            def gap(t: float, y: Any) -> float:
                # over the time, so that where a flight starts from a flank is no root
                return self._gap(t, y[0], side) / (t - start) if t > start else 1.0

            gap.terminal, gap.direction = True, -1  # type: ignore[attr-defined]
            return gap

        def slope(t: float, y: Any) -> list[float]:
            return [y[1], drag]

        found = solve_ivp(
            slope,
            (self.t, end),
            [self.q, self.v],
            "DOP853",
            rtol=self.tolerance,
            atol=self.tolerance,
            max_step=pi / 40 / RATE,
            events=[event(0), event(1)],
            dense_output=True,
        )
        assert found.sol is not None
        assert found.t_events is not None
        times = np.linspace(found.t[0], found.t[-1], 2001)
        q = found.sol(times)[0]
        gaps = np.minimum(q - FLANKS[0].angle(RATE * times), FLANKS[1].angle(RATE * times) - q)
        self.apart += float(times[-1] - times[0])
        self.gap = max(self.gap, float(gaps.max()))
        self.t, self.q, self.v = float(found.t[-1]), *map(float, found.y[:, -1])
        for side in range(2):
            if len(found.t_events[side]):
                self._strike(side)

    def _strike(self, side: int) -> None:
        flank = RATE * float(FLANKS[side].speed(RATE * self.t))
        closing = self.v - flank
        self.lost += INERTIA / 2 * closing**2 * (1 - self.e**2)
        self.count += 1
        self.v = flank - self.e * closing
        if abs(self.e * closing) < _STICKS * RATE:
            self.side = side

    def _follow(self, end: float) -> None:
        """Along a flank until it would pull: J q'' + drag changes its sign."""
        side = self.side
        assert side is not None
        sign = 1 - 2 * side

        def push(t: Any) -> Any:
            d = 1e-5
            bend = (FLANKS[side].speed(RATE * t + d) - FLANKS[side].speed(RATE * t - d)) / (2 * d)
            return sign * (INERTIA * RATE**2 * bend + DRAG)

        times = np.linspace(self.t, end, max(2, int((end - self.t) * RATE * 200)))
        signs = push(times[1:]) < 0 if len(times) > 2 else np.array([False])
        if signs.any():
            after = int(np.argmax(signs)) + 1
            low, high = times[after - 1], times[after]
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (low, middle) if push(middle) < 0 else (middle, high)
            self.t, self.side = float(high), None
        else:
            self.t = end
        self.q = float(FLANKS[side].angle(RATE * self.t))
        self.v = RATE * float(FLANKS[side].speed(RATE * self.t))


def _model(restitution: float) -> ContactModel:
    pair = ContactPair(
        "pin",
        {0: 1.0},
        {1: 1.0},
        (0.0, float(FLANKS[0].angle(0.0))),
        tabled_angle(FLANKS[0]),
        tabled_angle(FLANKS[1]),
        restitution=restitution,
    )
    speeds = np.array([RATE, RATE * float(FLANKS[0].speed(0.0))])
    drags = [Bearing("slot", {1: 1.0}, DRAG, DRAG)]
    mass, none = np.diag([0.0, INERTIA]), np.zeros((2, 2))
    return ContactModel(mass, none, np.zeros(2), {0: RATE}, speeds, [pair], drags, start=speeds)


def stepped(restitution: float, steps: int, fast: bool = True) -> PairRun:
    """Rigid, by so many steps in a turn."""
    return _told(simulate(_model(restitution), _plan(steps), fast))


def yielding(restitution: float, stiffness: float, steps: int, fast: bool = True) -> PairRun:
    """With teeth of a stiffness (N m/rad), and the damping at which as much comes back."""
    damping = 2 * damping_ratio(restitution) * sqrt(stiffness * INERTIA)
    yields = ToothCompliance(np.array([stiffness]), np.array([damping]))
    return _told(simulate(_model(0.0), _plan(steps), fast, yields=yields))


def _plan(steps: int) -> StepPlan:
    return StepPlan(2 * pi / RATE / steps, 0, TURNS * steps, TURNS * steps)


def _told(run: SimulatedRun) -> PairRun:
    apart = float(run.counts[0, TIME_APART]) / run.plan.steps
    return PairRun(float(run.counts[0, GAP]), apart, float(run.energy[IMPACT_LOSS]), int(run.counts[0, IMPACT_COUNT]))
