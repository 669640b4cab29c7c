"""Places at which teeth may part, stepped once more by ever shorter steps, each from shortly before it.

While all flanks touch, angles do not depend on the rate, and what a pair carries at an angle is quadratic in it. So two
runs of equal steps of angle, at two rates, tell where and from what rate on a pair would carry nothing. Steps of one
length see a flight only if it lasts for some of them: where the torque is least just after a corner of a law and rises
soon, the rate found is too high by as much as steps are long, and falls with them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.steps.simulation import SimulatedRun, StepPlan, simulate

if TYPE_CHECKING:
    from geartrain.dynamics.contacts.contact_model import ContactModel
    from geartrain.numerics.arrays import Floats

FLIGHT = 4
"""Steps for which a flank carries nothing when it parts: a blow within a step may leave flanks apart for one or two."""
FINER = 8
"""From one length of steps to the next."""

_BEFORE, _AFTER = 24, 12  # of the longer steps, that are stepped by the shorter
STEPS = (_BEFORE + _AFTER) * FINER
"""Steps of one run about a place."""
_SETTLE = 8  # steps after a start that are not looked at
_SURE = 1e-5  # of a rate: how near it is bracketed
_TRIES = 40


class PartingPlace(NamedTuple):
    """Where a pair may part, and from what rate on.

    pair            its number
    angle, speed    of the coordinates shortly before (rad; rad/s at the rate of the model)
    turns           of the input at the place
    holds, parts    rates over that of the model at which it touches, and at which it parts
    """

    pair: int
    angle: Floats
    speed: Floats
    turns: float
    holds: float
    parts: float


@dataclass(frozen=True)
class PartingSearch:
    """Steps of a train about single places.

    model     at one rate of the input, whose turn takes `turn` (s)
    advance   called with the steps of each run; where it returns True the search ends with `StoppedSearchError`
    """

    model: ContactModel
    turn: float
    fast: bool
    advance: Callable[[int], object]

    @property
    def loose(self) -> list[int]:
        """Numbers of the pairs that can part."""
        return [m for m, pair in enumerate(self.model.pairs) if not pair.two_sided]

    def run(
        self, share: float, plan: StepPlan, angle: Floats | None = None, speed: Floats | None = None
    ) -> SimulatedRun:
        """Steps at a share of the model's rate; from the start, or from elsewhere."""

        def on_done(steps: int) -> None:
            if self.advance(steps) is True:
                raise StoppedSearchError

        model = self.model.elsewhere(share, angle, speed)
        return simulate(model, plan._replace(step=plan.step / share), self.fast, on_done)

    def suspects(self, plan: StepPlan, share: float, most: int) -> list[PartingPlace]:
        """Where pairs part first in a whole run, by two rates up to a share of the model's; the first ones first."""
        low = 0.9 * share
        slow, quick = self.run(low, plan), self.run(share, plan)
        found = []
        for m in self.loose:
            rates = _vanishing(slow.forces[:, m], low, quick.forces[:, m], share)
            for at in _lowest(rates, most):
                found.append((float(rates[at]), m, at))
        found.sort()
        places = []
        for rate, m, at in found[:most]:
            before = max(at - max(1, -(-_BEFORE // plan.stride)), 0)
            turns = plan.step * plan.stride * (at + 1) / self.turn
            places.append(PartingPlace(m, quick.angles[before], quick.speeds[before] / share, turns, share, rate))
        return places

    def finer(self, place: PartingPlace, step: float) -> PartingPlace:
        """The place by steps of a length (s at the model's rate), after it was found by longer ones.

        Rates are those at which its pair carries nothing for some steps, bracketed.
        """
        plan = StepPlan(step, 0, STEPS, 1)
        known: list[tuple[float, float]] = []
        low, high = 0.0, inf
        guess = min(place.parts, 4 * place.holds)
        run, at = None, 0
        tries = iter((0.9 * guess, 0.98 * guess))
        for _ in range(_TRIES):
            share = next(tries, None) or _next(known, low, high)
            if share is None:
                break
            one = self.run(share, plan, place.angle, place.speed)
            least, where = _least(one.forces[:, place.pair])
            if least > 0:
                known.append((share, least))
                if share > low:
                    low, run, at = share, one, where
            else:
                high = min(high, share)
            if high - low < _SURE * high:
                break
        if run is None:
            return place._replace(holds=0.0, parts=inf)
        before = max(at - _BEFORE, 0)
        turns = place.turns + (at - _BEFORE * FINER) * step / self.turn
        return PartingPlace(place.pair, *self._state(place, run, before, low), turns, low, high)

    def _state(self, place: PartingPlace, run: SimulatedRun, at: int, share: float) -> tuple[Floats, Floats]:
        return place.angle + run.angles[at], run.speeds[at] / share


class StoppedSearchError(Exception):
    """Raised where whoever looks on wants no more."""


def _next(known: Sequence[tuple[float, float]], low: float, high: float) -> float | None:
    """The next rate to try: where the last two known torques say that there is none left; else the middle."""
    if len(known) > 1:
        (one, first), (other, second) = sorted(known)[-2:]
        found = float(_vanishing(np.array([first]), one, np.array([second]), other)[0])
        for near in (found * (1 - _SURE / 3), found * (1 + _SURE / 3)):
            if low < near < high and near < 4 * low:
                return near
    if high < inf:
        return (low + high) / 2
    return None if low == 0.0 or low > 100 else 1.5 * low


def _vanishing(first: Floats, slow: float, second: Floats, quick: float) -> Floats:
    """The rate at which a torque vanishes that is D + A w^2, from two; infinite where it does at none."""
    fall = first - second
    with np.errstate(divide="ignore", invalid="ignore"):
        square = (first * quick**2 - second * slow**2) / fall
    return np.where((fall > 0) & (square > 0), np.sqrt(np.maximum(square, 0.0)), inf)


def _least(forces: Floats) -> tuple[float, int]:
    """The least torque that a pair carries for some steps on end, and the step in the middle of those."""
    spans = np.lib.stride_tricks.sliding_window_view(forces, FLIGHT).max(axis=1)[_SETTLE:]
    at = int(spans.argmin())
    return float(spans[at]), at + _SETTLE + FLIGHT // 2


def _lowest(rates: Floats, most: int) -> Iterator[int]:
    """Places with the least rates, none beside another."""
    inner = rates.copy()
    inner[:3] = inf
    for at in np.argsort(inner, kind="stable")[: 8 * most]:
        if inner[at] == inf:
            continue
        if inner[at] <= inner[max(at - 2, 0) : at + 3].min():
            yield int(at)
