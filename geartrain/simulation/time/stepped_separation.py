"""Rate of the input at which teeth first separate, found by time stepping: a check of the closed-form condition.

Positions at which teeth may separate are simulated again with ever shorter time steps, each from shortly before it.
While all flanks touch, angles do not depend on the rate, and the torque that a pair carries at an angle is quadratic in
it. Two runs with equal angular steps at two rates therefore give the rate at which the torque would vanish. A flight is
detected only if it lasts several steps. Where the torque is minimal just after a kink and increases soon, the rate
found is too high by an amount that decreases with the time step.
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
"""Number of consecutive steps without torque that is a separation.

An impact within a step may open flanks for one or two.
"""
FINER = 8
"""Factor between successive time steps."""

_BEFORE, _AFTER = 24, 12  # longer steps before and after a position that are repeated with shorter ones
STEPS = (_BEFORE + _AFTER) * FINER
"""Number of steps of one run about a position."""
_SETTLE = 8  # steps after a start that are ignored
_SURE = 1e-5  # relative width of the bracket of a rate
_PLACE_TRIES = 40
FINE_TABLES = 1e-14
"""Tolerance of the tables of transmission functions [driven pitches].

In short time steps an error of a speed would count as an impact.
"""
_RUNS = 8  # estimated number of runs about a position with each time step
_MOST = 200_000  # maximum number of samples
_BELOW = 0.95  # the search begins at this fraction of the predicted rate
_SLOWER = 0.8  # factor between tried rates until one is found at which all flanks touch
_TRIES = 12
_NEARER = 0.2  # maximum ratio of successive changes while the rate converges; at first order it is 1/8
_KEPT = 16, 6, 3  # numbers of positions that are refined with each shorter time step


class SeparationPosition(NamedTuple):
    """Position at which a pair may separate, with bounds of the rate divided by the rate of the model."""

    pair: int
    """Index of the pair."""
    angle: Floats
    """Angles of the coordinates shortly before the position [rad]."""
    speed: Floats
    """Speeds of the coordinates shortly before the position, at the rate of the model [rad/s]."""
    turns: float
    """Position of the input [revolutions]."""
    holds: float
    """Rate at which the flanks of the pair touch, divided by the rate of the model."""
    parts: float
    """Rate at which the flanks of the pair separate, divided by the rate of the model."""


@dataclass(frozen=True)
class SeparationSearch:
    """Simulation of a train about single positions."""

    model: ContactModel
    """Model at one rate of the input; `turn` is the duration of one revolution [s]."""
    turn: float
    fast: bool
    advance: Callable[[int], object]
    """Function called with the number of steps of each run; if it returns True, `StoppedSearchError` is raised."""

    @property
    def loose(self) -> list[int]:
        """Indices of the pairs that can separate."""
        return [m for m, pair in enumerate(self.model.pairs) if not pair.two_sided]

    def run(
        self, share: float, plan: StepPlan, angle: Floats | None = None, speed: Floats | None = None
    ) -> SimulatedRun:
        """Return a simulated run at the fraction `share` of the model's rate, from the start or from another state."""

        def on_done(steps: int) -> None:
            if self.advance(steps) is True:
                raise StoppedSearchError

        model = self.model.restarted(share, angle, speed)
        return simulate(model, plan._replace(step=plan.step / share), self.fast, on_done)

    def candidates(self, plan: StepPlan, share: float, most: int) -> list[SeparationPosition]:
        """Return the positions at which pairs separate first in a whole run, in ascending order of the rate.

        The rates are extrapolated from two runs, at `share` of the model's rate and slightly below.
        """
        # two rates determine D and A of the quadratic
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
            # samples are before the position, so that the refined run includes it
            before = max(at - max(1, -(-_BEFORE // plan.stride)), 0)
            turns = plan.step * plan.stride * (at + 1) / self.turn
            places.append(SeparationPosition(m, quick.angles[before], quick.speeds[before] / share, turns, share, rate))
        return places

    def finer(self, place: SeparationPosition, step: float) -> SeparationPosition:
        """Return a position refined with a shorter time step [s at the model's rate].

        The rates bracket the one at which its pair carries no torque for several steps.
        """
        plan = StepPlan(step, 0, STEPS, 1)
        known: list[tuple[float, float]] = []
        low, high = 0.0, inf
        guess = min(place.parts, 4 * place.holds)
        run, at = None, 0
        # two rates below the guess, at which the pair still touches
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
        return SeparationPosition(place.pair, *self._state(place, run, before, low), turns, low, high)

    def _state(self, place: SeparationPosition, run: SimulatedRun, at: int, share: float) -> tuple[Floats, Floats]:
        return place.angle + run.angles[at], run.speeds[at] / share


class StoppedSearchError(Exception):
    """Error raised when the caller stops the search."""


def _next(known: Sequence[tuple[float, float]], low: float, high: float) -> float | None:
    """Return the next rate to try: where the last two torques extrapolate to 0, or else the middle of the bracket."""
    if len(known) > 1:
        (one, first), (other, second) = sorted(known)[-2:]
        found = float(_vanishing(np.array([first]), one, np.array([second]), other)[0])
        # slightly to both sides of the extrapolated root, to bracket it
        for near in (found * (1 - _SURE / 3), found * (1 + _SURE / 3)):
            if low < near < high and near < 4 * low:
                return near
    if high < inf:
        return (low + high) / 2
    return None if low == 0.0 or low > 100 else 1.5 * low


def _vanishing(first: Floats, slow: float, second: Floats, quick: float) -> Floats:
    """Return the rate at which a torque D + A w^2 vanishes, from its values at two rates; infinite if it never
    vanishes.
    """
    fall = first - second
    with np.errstate(divide="ignore", invalid="ignore"):
        # root of D + A w^2 from its values at two rates
        square = (first * quick**2 - second * slow**2) / fall
    return np.where((fall > 0) & (square > 0), np.sqrt(np.maximum(square, 0.0)), inf)


def _minimum(forces: Floats) -> tuple[float, int]:
    """Return the minimum torque that a pair transmits during `FLIGHT` consecutive steps, and the index of the middle
    step.
    """
    # a separation lasts several steps, so the maximum over consecutive steps must vanish
    spans = np.lib.stride_tricks.sliding_window_view(forces, FLIGHT).max(axis=1)[_SETTLE:]
    at = int(spans.argmin())
    return float(spans[at]), at + _SETTLE + FLIGHT // 2


def _lowest(rates: Floats, most: int) -> Iterator[int]:
    """Yield the indices of the lowest rates that are local minima."""
    inner = rates.copy()
    inner[:3] = inf
    for at in np.argsort(inner, kind="stable")[: 8 * most]:
        if inner[at] == inf:
            continue
        if inner[at] <= inner[max(at - 2, 0) : at + 3].min():
            yield int(at)


@dataclass(frozen=True)
class SteppedSeparation(Result):
    """Input speed at which teeth first separate, found by time stepping without restitution.

    See Also
    --------
    geartrain.simulation.step_to_separation : Returns such an object.
    """

    input: str
    """Name of the input link, whose speed the results give."""
    turns: float
    """Range of the input over which the motion was simulated, from the start [turn]."""
    predicted: float
    """Separation speed of the input according to the closed-form condition, for the same range [turn/s]."""
    rate: float | None
    """Separation speed of the input, found with successively shorter time steps [turn/s]; None if no separation
    occurred near the predicted speed.
    """
    error: float | None
    """Bound of the error of `rate` due to the time step [turn/s]."""
    pair: str | None
    """Name of the pair that separates."""
    at: float | None
    """Position of the input at which the pair separates [turn]."""
    holds: float | None
    """Maximum input speed at which all flanks remained in contact in the simulation with the shortest time step
    [turn/s].
    """
    parts: float | None
    """Minimum input speed at which flanks separated in the simulation with the shortest time step [turn/s]."""
    flight: float
    """Duration above which the simulation reliably detects a separation [turn of the input]."""
    complete: bool = True
    """False if the search was stopped before its end."""


def find_stepped_separation(
    study: TimeStudy, predicted: float | None, on_done: Callable[[float], object]
) -> SteppedSeparation:
    """Return the separation rate by time stepping: two runs without separation, then refinement of the minimum torques.

    study       the train and its range, at the predicted rate
    predicted   rate by the closed-form condition [turn/s]
    on_done     called with the fraction of the work that is done; the search stops if it returns True
    """
    if not predicted:
        raise _search_error(predicted)
    plan = study.plan(1)
    plan = plan._replace(stride=max(FLIGHT, -(-plan.steps // _MOST)), skip=0)
    whole = 2 * plan.steps + _RUNS * sum(_KEPT) * STEPS
    search = SeparationSearch(study.of.model, 1 / predicted, study.is_fast, lambda steps: on_done(steps / whole))
    # a flight between two samples must contain a whole sample
    flight = (2 * plan.stride - 1) / study.per_turn
    none = (None,) * 6
    known = SteppedSeparation(study.of.problem.driving_link, study.turns, predicted, *none, flight)
    try:
        share, places = _candidates(search, plan)
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
            known = _refined(known, search, places[0], step, levels[-2])
    except StoppedSearchError:
        return replace(known, complete=False)
    return known


def _search_error(predicted: float | None) -> QuestionError:
    what = "the separation rate cannot be found by time stepping"
    why = f"the closed-form condition predicts separation at {'no' if predicted is None else 'any'} rate"
    return QuestionError(Problem(what, why, "omit --find-rate, or change the inertias or loads"))


def _candidates(search: SeparationSearch, plan: StepPlan) -> tuple[float, Sequence[SeparationPosition]]:
    """Return a fraction of the rate without separation at the long time step, and the positions to refine."""
    # below the prediction, because the stepped rate may be lower
    share = _BELOW
    for _ in range(_TRIES):
        places = search.candidates(plan, share, _KEPT[0])
        if not places or places[0].parts > share:
            break
        share *= _SLOWER
    return share, places


def _is_noise(levels: Sequence[float]) -> bool:
    """Return True if rates with ever shorter time steps no longer converge, because rounding grows."""
    # the convergence needs three changes
    if len(levels) < 4:
        return False
    before, last = (abs(one - other) for one, other in zip(levels[-3:], levels[-2:], strict=False))
    return last > _NEARER * before


def _refined(
    known: SteppedSeparation, search: SeparationSearch, place: SeparationPosition, step: float, before: float
) -> SteppedSeparation:
    """Return the result with a shorter time step [s].

    The rate converges with the step to the first order or higher. It therefore lies between the value at this step and
    the linear extrapolation from both.

    before   minimum rate of separation with the longer time step, over the predicted one
    """
    # Richardson's estimate for a first-order error
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
