"""The rate of the input at which teeth first part, sought by stepping: a check of the closed condition for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.steps.simulation import simulate
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.plain_data import Result

if TYPE_CHECKING:
    from geartrain.dynamics.time.time_study import TimeStudy

_FLIGHT = 4  # steps: a blow within a step may leave flanks apart for one or two
_MOST = 200_000  # stretches that are kept
_WIDEN = 1.04  # from rate to rate until the first that parts lies between two
_TRIES = 12
_CLOSE = 2e-3  # of the rate


@dataclass(frozen=True)
class SteppedSeparation(Result):
    """Between which rates of the input stepping first parts teeth, without restitution.

    Attributes
    ----------
    input : str
        The link whose rate it is.
    turns : float
        Turns of it from the start that were stepped.
    predicted : float
        By the condition, in as many turns [turn/s].
    holds, parts : float or None
        The greatest rate tried at which all flanks touch, and the least at which some part [turn/s]; None where none
        was found nearby.
    pair : str or None
        The pair that parts.
    flight : float
        Turns of the input for which flanks must be apart to be noticed for certain.

    See Also
    --------
    geartrain.GearTrain.stepped_separation : gives it.
    """

    input: str
    turns: float
    predicted: float
    holds: float | None
    parts: float | None
    pair: str | None
    flight: float


def find_stepped_separation(
    study_at: Callable[[float], TimeStudy], predicted: float | None, on_done: Callable[[int], object]
) -> SteppedSeparation:
    """Bisect between a rate that holds and one that parts.

    study_at    what is asked at a rate (turn/s)
    predicted   by the condition (turn/s)
    """
    if not predicted:
        what = "no rate is there to be found by stepping"
        why = f"by the condition for it teeth part at {'no' if predicted is None else 'any'} rate"
        raise QuestionError(Problem(what, why, "ask without --find-rate"))
    parted = {predicted: _parted(study_at(predicted), on_done)}
    rate = predicted
    for _ in range(_TRIES):
        holding = parted[rate] is None
        rate *= _WIDEN if holding else 1 / _WIDEN
        parted[rate] = _parted(study_at(rate), on_done)
        if (parted[rate] is None) is not holding:
            break
    low = max((each for each, pair in parted.items() if pair is None), default=None)
    high = min((each for each, pair in parted.items() if pair is not None), default=None)
    while low is not None and high is not None and high - low > _CLOSE * high:
        middle = (low + high) / 2
        pair = parted[middle] = _parted(study_at(middle), on_done)
        low, high = (middle, high) if pair is None else (low, middle)
    study = study_at(predicted)
    stride = _stride(study)
    return SteppedSeparation(
        study.of.problem.lead,
        study.turns,
        predicted,
        low,
        high,
        None if high is None else parted[high],
        (2 * stride - 1) / study.per_turn,
    )


def _stride(study: TimeStudy) -> int:
    return max(_FLIGHT, -(-study.plan(1).steps // _MOST))


def _parted(study: TimeStudy, on_done: Callable[[int], object]) -> str | None:
    """The pair through which no torque passes in some stretch of steps; the first of them."""
    plan = study.plan(1)._replace(stride=_stride(study), skip=0)

    def advance(steps: int) -> None:
        on_done(steps)

    pairs = study.of.model.pairs
    loose = np.array([not pair.two_sided for pair in pairs], dtype=bool)
    apart = (simulate(study.of.model, plan, study.is_fast, advance).forces[:, : len(pairs)] == 0) & loose
    stretches = apart.any(axis=1)
    return pairs[int(apart[stretches.argmax()].argmax())].name if stretches.any() else None
