"""The rate of the input at which teeth first part, sought by stepping: a check of the closed condition for it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING

from geartrain.dynamics.time.parting_places import FINER, FLIGHT, STEPS, PartingPlace, PartingSearch, StoppedSearchError
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.plain_data import Result

if TYPE_CHECKING:
    from geartrain.dynamics.steps.simulation import StepPlan
    from geartrain.dynamics.time.time_study import TimeStudy

FINE_TABLES = 1e-14
"""Driven pitches: laws are read so finely here, for over short steps an error of a speed counts as a jolt."""
_RUNS = 8  # about so many of a place with each length of steps
_MOST = 200_000  # stretches that are kept
_BELOW = 0.95  # of the rate by the condition: where the search begins
_SLOWER = 0.8  # from rate to rate until one is found at which all flanks touch
_TRIES = 12
_NEARER = 0.2  # of the change from one length of steps to the next: at the first order an eighth
_KEPT = 16, 6, 3  # places that are stepped by shorter steps, each time a few of those before


@dataclass(frozen=True)
class SteppedSeparation(Result):
    """At which rate of the input stepping first parts teeth, without restitution.

    Attributes
    ----------
    input : str
        The link whose rate it is.
    turns : float
        Turns of it from the start that were stepped.
    predicted : float
        By the condition, in as many turns [turn/s].
    rate : float or None
        By steps ever shorter [turn/s]; None where none was found nearby.
    error : float or None
        By how much it may be wrong, because steps are not shorter still [turn/s].
    pair : str or None
        The pair that parts.
    at : float or None
        Turns of the input at which it does.
    holds, parts : float or None
        The greatest rate tried at which all flanks touch, and the least at which some part, by the shortest steps
        [turn/s].
    flight : float
        Turns of the input for which flanks must be apart to be noticed for certain.
    complete : bool
        False where the search was stopped.

    See Also
    --------
    geartrain.dynamics.step_to_separation : gives it.
    """

    input: str
    turns: float
    predicted: float
    rate: float | None
    error: float | None
    pair: str | None
    at: float | None
    holds: float | None
    parts: float | None
    flight: float
    complete: bool = True


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
    known = SteppedSeparation(study.of.problem.lead, study.turns, predicted, *none, flight)
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
