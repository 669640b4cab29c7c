"""The rate of the input at which teeth first part, sought by stepping: a check of the closed condition for it.

Places at which teeth may part are stepped once more by ever shorter steps, each from shortly before it. While all
flanks touch, angles do not depend on the rate, and what a pair carries at an angle is quadratic in it. So two runs of
equal steps of angle, at two rates, tell where and from what rate on a pair would carry nothing. Steps of one length see
a flight only if it lasts for some of them: where the torque is least just after a corner of a law and rises soon, the
rate found is too high by as much as steps are long, and falls with them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Result
from geartrain.simulation.steps.simulation import SimulatedRun, StepPlan, simulate

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.simulation.contacts.contact_model import ContactModel
    from geartrain.simulation.time.time_study import TimeStudy


FLIGHT = 4
"""Steps for which a flank carries nothing when it parts: a blow within a step may leave flanks apart for one or two."""
FINER = 8
"""From one length of steps to the next."""

_BEFORE, _AFTER = 24, 12  # of the longer steps, that are stepped by the shorter
STEPS = (_BEFORE + _AFTER) * FINER
"""Steps of one run about a place."""
_SETTLE = 8  # steps after a start that are not looked at
_SURE = 1e-5  # of a rate: how near it is bracketed
_PLACE_TRIES = 40
FINE_TABLES = 1e-14
"""Driven pitches: laws are read so finely here, for over short steps an error of a speed counts as a jolt."""
_RUNS = 8  # about so many of a place with each length of steps
_MOST = 200_000  # stretches that are kept
_BELOW = 0.95  # of the rate by the condition: where the search begins
_SLOWER = 0.8  # from rate to rate until one is found at which all flanks touch
_TRIES = 12
_NEARER = 0.2  # of the change from one length of steps to the next: at the first order an eighth
_KEPT = 16, 6, 3  # places that are stepped by shorter steps, each time a few of those before


class PartingPlace(NamedTuple):
    """Where a pair may part, and from what rate on."""

    pair: int
    """Its number."""
    angle: Floats
    """Of the coordinates shortly before (rad; rad/s at the rate of the model)."""
    speed: Floats
    """Of the coordinates shortly before (rad; rad/s at the rate of the model)."""
    turns: float
    """Of the input at the place."""
    holds: float
    """Rates over that of the model at which it touches, and at which it parts."""
    parts: float
    """Rates over that of the model at which it touches, and at which it parts."""


@dataclass(frozen=True)
class PartingSearch:
    """Steps of a train about single places."""

    model: ContactModel
    """At one rate of the input, whose turn takes `turn` (s)."""
    turn: float
    fast: bool
    advance: Callable[[int], object]
    """Called with the steps of each run; where it returns True the search ends with `StoppedSearchError`."""

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
        for _ in range(_PLACE_TRIES):
            share = next(tries, None) or _next(known, low, high)
            if share is None:
                break
            one = self.run(share, plan, place.angle, place.speed)
            minimum, where = _minimum(one.forces[:, place.pair])
            if minimum > 0:
                known.append((share, minimum))
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


def _minimum(forces: Floats) -> tuple[float, int]:
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


@dataclass(frozen=True)
class SteppedSeparation(Result):
    """At which rate of the input stepping first parts teeth, without restitution.

    See Also
    --------
    geartrain.simulation.step_to_separation : gives it.
    """

    input: str
    """The link whose rate it is."""
    turns: float
    """Turns of it from the start that were stepped."""
    predicted: float
    """By the condition, in as many turns [turn/s]."""
    rate: float | None
    """By steps ever shorter [turn/s]; None where none was found nearby."""
    error: float | None
    """By how much it may be wrong, because steps are not shorter still [turn/s]."""
    pair: str | None
    """The pair that parts."""
    at: float | None
    """Turns of the input at which it does."""
    holds: float | None
    """Greatest rate tried at which all flanks touch, by the shortest steps [turn/s]."""
    parts: float | None
    """Least rate tried at which some flanks part, by the shortest steps [turn/s]."""
    flight: float
    """Turns of the input for which flanks must be apart to be noticed for certain."""
    complete: bool = True
    """False where the search was stopped."""


def find_stepped_separation(
    study: TimeStudy, predicted: float | None, on_done: Callable[[float], object]
) -> SteppedSeparation:
    """Step the whole run at two rates that hold, then the places where least is carried by ever shorter steps.

    study       what is asked, at the rate that is predicted
    predicted   by the condition (turn/s)
    on_done     called with the share of the work that is done; where it returns True, what is known is given back
    """
    if not predicted:
        raise _unsought(predicted)
    plan = study.plan(1)
    plan = plan._replace(stride=max(FLIGHT, -(-plan.steps // _MOST)), skip=0)
    whole = 2 * plan.steps + _RUNS * sum(_KEPT) * STEPS
    search = PartingSearch(study.of.model, 1 / predicted, study.is_fast, lambda steps: on_done(steps / whole))
    flight = (2 * plan.stride - 1) / study.per_turn
    none = (None,) * 6
    known = SteppedSeparation(study.of.problem.driving_link, study.turns, predicted, *none, flight)
    try:
        share, places = _suspects(search, plan)
        known = replace(known, holds=share * predicted)
        step, levels = plan.step, [places[0].parts] if places else []
        for kept in _KEPT:
            step /= FINER
            places = sorted((search.finer(each, step) for each in places[:kept]), key=lambda each: each.parts)
            if not places or places[0].parts == inf:
                break
            levels.append(places[0].parts)
            if _is_noise(levels):
                break
            known = _told(known, search, places[0], step, levels[-2])
    except StoppedSearchError:
        return replace(known, complete=False)
    return known


def _unsought(predicted: float | None) -> QuestionError:
    what = "no rate is there to be found by stepping"
    why = f"by the condition for it teeth part at {'no' if predicted is None else 'any'} rate"
    return QuestionError(Problem(what, why, "ask without --find-rate"))


def _suspects(search: PartingSearch, plan: StepPlan) -> tuple[float, Sequence[PartingPlace]]:
    """A share of the rate at which nothing parts by long steps, and where something may beyond it."""
    share = _BELOW
    for _ in range(_TRIES):
        places = search.suspects(plan, share, _KEPT[0])
        if not places or places[0].parts > share:
            break
        share *= _SLOWER
    return share, places


def _is_noise(levels: Sequence[float]) -> bool:
    """Whether rates by ever shorter steps no longer settle: rounding, which grows as steps shorten."""
    if len(levels) < 4:
        return False
    before, last = (abs(one - other) for one, other in zip(levels[-3:], levels[-2:], strict=False))
    return last > _NEARER * before


def _told(
    known: SteppedSeparation, search: PartingSearch, place: PartingPlace, step: float, before: float
) -> SteppedSeparation:
    """What is known with the steps of a length (s).

    The rate falls with the step to the first power or a higher one, so that it lies between what these steps say and
    what a line through both says.

    before   the least rate at which teeth part by longer steps, over the one predicted
    """
    error = abs(before - place.parts) / (FINER - 1)
    return replace(
        known,
        rate=(place.parts - error / 2) * known.predicted,
        error=(error / 2 + place.parts - place.holds) * known.predicted,
        pair=search.model.pairs[place.pair].name,
        at=place.turns,
        holds=place.holds * known.predicted,
        parts=place.parts * known.predicted,
        flight=(2 * FLIGHT - 1) * step / search.turn,
    )
