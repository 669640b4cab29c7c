"""Jam probability for several clearance factors and error scales, estimated from one common set of random wheels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.confidence_intervals import ProbabilityEstimate
from geartrain.numerics.results import Key, Result
from geartrain.numerics.work import Execution
from geartrain.workshop.monte_carlo.trial_block import BLOCK, UNCUT, RandomStreams, draw_trial_wheels, judge_trial_pairs
from geartrain.workshop.monte_carlo.trial_results import EVENTS, EventRates
from geartrain.workshop.monte_carlo.trial_run import check_trials, trial_tasks

if TYPE_CHECKING:
    from geartrain.workshop.monte_carlo.trial_plan import TrialPlan

_MOST = 1000  # clearances of a sweep: each costs as much as the trials themselves


@dataclass(frozen=True, slots=True)
class ClearanceCase(Result):
    """Event probabilities of a train for one clearance factor and one scale factor of the errors."""

    KEYS = ("clearance", "scale", Key("", "rates"), "pairs")

    clearance: float | None
    """Clearance factor (1 or more), or relative position between the limits of each pair's clearance factor (below 1);
    None for the declared clearance factor.
    """
    scale: float
    """Factor by which all manufacturing errors are multiplied, except errors that were measured tooth by tooth."""
    events: Mapping[str, ProbabilityEstimate]
    """Probability that each event (jam, clash, stops, dwell, disengaged) occurs in at least one pair; stops means jam
    or clash.
    """
    pairs: Mapping[str, Mapping[str, ProbabilityEstimate]]
    """Probability of each event in each pair, keyed by pair and then by event, as in `events`."""

    @property
    def rates(self) -> EventRates:
        """Probabilities that each event occurs in at least one pair, keyed by the name of the event."""
        return cast("EventRates", self.events)


_SWEPT = {"clearance_factor": (1.0, 10.0), "window": (0.0, 1.0), "accuracy": (0.0, 90.0)}
"""Range of each quantity that can be varied; the upper limit is excluded."""


def read_sweep(text: str, option: str = "--vary") -> list[float]:
    """Return equally spaced values parsed from text such as `window=0.1:0.9:9` or `accuracy=0.02:0.3:6`.

    Values of `window` are below 1, clearance factors are at least 1, and accuracies are in degrees.
    """
    name, _, rest = text.partition("=")
    bounds = _SWEPT.get(name.strip())
    try:
        first, last, many = rest.split(":")
        low, high, count = float(first), float(last), int(many)
    except ValueError:
        low, high, count = 0.0, 0.0, 0
    if bounds is None or not bounds[0] <= low <= high < bounds[1] or not 1 <= count <= _MOST:
        why = (
            "a sweep is FIRST:LAST:COUNT of ascending values of clearance_factor (1 to 10), window (0 to 1) or "
            f"accuracy (0 to 90 deg), with a count of at most {_MOST}"
        )
        fix = f"for example, give {'clearance_factor=1.005:1.04:8' if option == '--vary' else '0.02:0.3:6'}"
        raise QuestionError(Problem(f"'{text}' is not a sweep of values", why, fix, option))
    return [float(each) for each in np.linspace(low, high, count)]


def jamming_map(
    plan: TrialPlan,
    clearances: Sequence[float | None],
    scales: Sequence[float] = (1.0,),
    trials: int = 256,
    seed: int = 1,
    means: Execution | None = None,
) -> list[ClearanceCase]:
    """Return the probabilities of a jam, clash, dwell and loss of contact for a grid of clearance factors and of scale
    factors of the cutting errors.

    The same random wheels are used in all cases.

    Parameters
    ----------
    plan : TrialPlan
        Train with its cutting and fitting errors.
    clearances : sequence of float or None
        Clearance factors. A value of 1 or more multiplies the minimum centre distance, at which tips touch the roots. A
        value below 1 is a relative position between the limits of each pair's clearance factor. None is the declared
        clearance factor. These values vary in the outer loop.
    scales : sequence of float
        Factors, 0 or more, by which all errors except measured tables are multiplied; by default 1.
    trials : int
        Number of trials of each case, 1 to 10^9; by default 256.
    seed : int
        Random seed. The same seed gives the same wheels.
    means : Execution, optional
        Executor, journal and progress function; by default this process without journal and progress function.

    Returns
    -------
    list of ClearanceCase
        One case for each combination of clearance factor and scale.

    Raises
    ------
    QuestionError
        If the number of trials is out of range.
    RangeError
        If a value below 1 is given and a pair has no limits of its clearance factor.

    Examples
    --------
    >>> from geartrain import load
    >>> from geartrain.workshop import (find_trial_plan, read_error_overrides)
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["pitch_deviation=0.1 %"]), ["sun"])
    >>> [case.events["jam"].count for case in jamming_map(plan, [0.5], [1.0, 80.0], trials=16)]
    [0, 16]
    """
    check_trials(trials)
    means = means or Execution()
    cases = [(clearance, scale) for clearance in clearances for scale in scales]
    parts = trial_tasks(trials, len(cases))
    results = means.run(partial(work_case, plan, seed), [[*case, *part] for case in cases for part in parts])
    names, found = [pair.name for pair in plan.pairs], []
    for case in cases:
        counts = np.sum([next(results) for _ in parts], axis=0)  # results come in the order of the tasks
        *pairs, train = [
            dict(zip(EVENTS, (ProbabilityEstimate(*each) for each in row.tolist()), strict=True)) for row in counts
        ]
        found.append(ClearanceCase(*case, train, dict(zip(names, pairs, strict=True))))
    return found


def work_case(plan: TrialPlan, seed: int, task: Sequence[Any]) -> list[Any]:
    """Return, for each pair and last for the whole train, a list with two numbers for each event.

    They are the number of trials in which the event occurs, and the number of trials in which all wheels can be cut.

    task   clearance factor, scale factor of the errors, number of the first trial, number of trials
    """
    clearance, scale, first, trials = task
    changed = plan.scaled(scale)
    changed = changed if clearance is None else changed.cleared(clearance)
    marks, _ = judge_trial_pairs(draw_trial_wheels(changed, RandomStreams(seed, first // BLOCK), trials, first % BLOCK))
    columns = [*marks.T, np.bitwise_or.reduce(marks, axis=1)]
    return [
        [[int(np.count_nonzero(cut & mark)), len(cut)] for mark in EVENTS.values()]
        # trials with a wheel that cannot be cut are not counted, as in the trials themselves
        for cut in (each[(each & UNCUT) == 0] for each in columns)
    ]
