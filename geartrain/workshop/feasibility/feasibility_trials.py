"""Trials of feasibility: one trial has one cutting of all wheels, one friction, one strength of each metal, one hand.

The cutting and the pointer errors are those of the Monte Carlo trials of the same seed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from math import inf, nan
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.confidence_intervals import ProbabilityEstimate
from geartrain.numerics.work import Execution
from geartrain.workshop.feasibility.feasibility_plan import wedge_torque
from geartrain.workshop.feasibility.feasibility_result import (
    OUTCOMES,
    AccuracyStep,
    FeasibilityResult,
    OutcomeCause,
)
from geartrain.workshop.monte_carlo.trial_block import (
    BLOCK,
    JAM,
    UNCUT,
    RandomStreams,
    draw_trial_wheels,
    judge_trial_pairs,
)
from geartrain.workshop.monte_carlo.trial_run import check_trials, gathered, trial_tasks, unpack, work_block

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.workshop.feasibility.feasibility_plan import FeasibilityPlan
    from geartrain.workshop.monte_carlo.trial_results import TrialResults

_MOST = 100  # accuracies of a curve: each costs nearly as much as the trials


def run_feasibility(
    plan: FeasibilityPlan,
    trials: int,
    seed: int = 1,
    accuracies: Sequence[float] = (),
    means: Execution | None = None,
) -> FeasibilityResult:
    """Run trials of a train, and return the probability that it turns, jams, is too stiff, breaks or cannot be cut.

    The result is the same for any number of workers, and for a run that was interrupted and resumed. After an interrupt
    (Ctrl-C), the results of the completed trials are returned.

    Parameters
    ----------
    plan : FeasibilityPlan
        Train with its spreads, from `find_feasibility_plan`.
    trials : int
        Number of trials, 1 to 10^9.
    seed : int
        Random seed.
    accuracies : sequence of float
        Standard deviations of the pitch deviation at which the probability of turning is computed, with the same
        random numbers [deg].
    means : Execution, optional
        Executor, journal and progress function; by default this process without journal and progress function.

    Returns
    -------
    FeasibilityResult
        Probabilities of the outcomes, crank torque, pointer errors, and the curve of the accuracies.

    Raises
    ------
    QuestionError
        If the number of trials or an accuracy is out of range.

    Notes
    -----
    The outcomes are examined in the order of `OUTCOMES`: docs/cut-by-hand.md, section 9.

    Examples
    --------
    Perfect wheels without spreads give the deterministic verdict:

    >>> from geartrain import load
    >>> from geartrain.workshop import find_feasibility_plan
    >>> found = run_feasibility(find_feasibility_plan(load("moon-triangular")), trials=4)
    >>> {name: each.count for name, each in found.outcomes.items()}
    {'cannot be cut': 0, 'jams': 0, 'too stiff': 0, 'breaks': 0, 'turns': 4}
    """
    check_trials(trials)
    _check_accuracies(accuracies)
    parts = trial_tasks(trials)
    tasks = [[at, *part] for at in range(-1, len(accuracies)) for part in parts]
    found: list[Any] = []
    try:
        for each in (means or Execution()).run(partial(work_feasibility, plan, seed, tuple(accuracies)), tasks):
            found.append(each)
    except KeyboardInterrupt:
        if not found:  # without a complete task there is nothing to return
            raise
    first, later = found[: len(parts)], found[len(parts) :]
    records = [unpack(part[0], packed["trials"]) for part, packed in zip(parts, first, strict=False)]
    judged = _Judged(
        plan, gathered(plan.cutting, seed, trials, records), [row for each in first for row in each["loads"]]
    )
    curve = []
    for at, accuracy in enumerate(accuracies):
        rows = [row for each in later[at * len(parts) : (at + 1) * len(parts)] for row in each["stops"]]
        if len(rows) == trials:  # an interrupted run has fewer
            turning = ~np.array(rows) & ~judged.stiff & ~judged.breaks
            curve.append(AccuracyStep(accuracy, ProbabilityEstimate(int(np.count_nonzero(turning)), trials)))
    return judged.result(tuple(curve))


def _check_accuracies(accuracies: Sequence[float]) -> None:
    """Raise `QuestionError` if there are too many accuracies, or if an accuracy is not 0 or more."""
    if len(accuracies) > _MOST or not all(0 <= each < inf for each in accuracies):
        what = f"{', '.join(f'{each:g}' for each in accuracies[:4])} are not valid accuracies"
        why = f"an accuracy is a standard deviation [deg] of 0 or more, and a curve has at most {_MOST}"
        raise QuestionError(Problem(what, why, "for example, give --accuracy 0.02:0.3:6"))


def work_feasibility(plan: FeasibilityPlan, seed: int, accuracies: tuple[float, ...], task: Sequence[int]) -> Any:
    """Return the results of some trials as plain data: records and loads, or for an accuracy whether they stop."""
    at, first, trials = task
    if at < 0:
        loads = [plan.drawn_loads(seed, trial) for trial in range(first, first + trials)]
        packed = [None if each is None else [_plain(each.crank), each.driven, each.efficiency] for each in loads]
        return {"trials": work_block(plan.cutting, seed, [first, trials]), "loads": packed}
    changed = plan.at_accuracy(accuracies[at])
    marks, _ = judge_trial_pairs(draw_trial_wheels(changed, RandomStreams(seed, first // BLOCK), trials, first % BLOCK))
    return {"stops": ((marks & (JAM | UNCUT)) != 0).any(axis=1).tolist()}


def _plain(torque: float) -> float | None:
    return torque if torque < inf else None


class _Judged:
    """Outcome of each trial.

    loads   for each trial torque at the crank (None if locked), and torques and efficiencies of pairs; None if unknown
    """

    def __init__(self, plan: FeasibilityPlan, trials: TrialResults, loads: Sequence[Any]) -> None:
        self.plan, self.trials = plan, trials
        done, seed = trials.done, trials.seed
        self.torque: Floats | None = None
        self.driven: Mapping[str, Floats] = {}
        self.efficiency: Mapping[str, Floats] = {}
        if loads and loads[0] is not None:
            self.torque = np.array([inf if row is None or row[0] is None else row[0] for row in loads])
            names = plan.nominal.driven if plan.nominal else ()
            self.driven, self.efficiency = (
                {name: np.array([nan if row is None else row[at].get(name, nan) for row in loads]) for name in names}
                for at in (1, 2)
            )
        self.hand, self.strengths = plan.hands(seed, done), plan.strengths(seed, done)
        self.uncut = self._marked(UNCUT).any(axis=1)
        self.jam = self._marked(JAM)
        self.stiff = np.zeros(done, dtype=bool) if self.torque is None else np.isinf(self.torque)
        if self.torque is not None and self.hand is not None:
            self.stiff |= self.torque > self.hand
        self.excess = self._excess(self.driven)
        self.breaks = (self.excess > 1).any(axis=1)

    def _marked(self, mark: int) -> Bools:
        found: Bools = (self.trials.marks & mark) != 0
        return found

    def _excess(self, torques: Mapping[str, Floats | float]) -> Floats:
        """Return stress divided by strength of each part in each trial, shape (trials, parts)."""
        columns = [np.broadcast_to(part.stresses(torques), (self.trials.done,)) for part in self.plan.parts]
        return np.nan_to_num(np.stack(columns, axis=1) / self.strengths) if columns else np.zeros(self.strengths.shape)

    def forced(self) -> tuple[Bools, Bools]:
        """Return masks of jamming trials in which the hand breaks a tooth: by its torque, and by the wedge of the pair
        that jams.
        """
        plain, wedge = np.zeros(self.trials.done, dtype=bool), np.zeros(self.trials.done, dtype=bool)
        if self.hand is None or not self.plan.parts:
            return plain, wedge
        for at, pair in enumerate(self.plan.cutting.pairs):
            held = self.plan.held(pair.name) if self.jam[:, at].any() else {}
            if not held:
                continue
            torques = {name: each * self.hand for name, each in held.items()}
            shares = self.efficiency[pair.name]
            gains = np.array([wedge_torque(1.0, (1.0, share), (1.0, share)) for share in shares.tolist()])
            plain |= self.jam[:, at] & (self._excess(torques) > 1).any(axis=1)
            squeezed = {**torques, pair.name: torques[pair.name] * np.maximum(gains, 1.0)}
            wedge |= self.jam[:, at] & (self._excess(squeezed) > 1).any(axis=1)
        return plain, wedge

    def result(self, curve: tuple[AccuracyStep, ...]) -> FeasibilityResult:
        """Return the result of all trials."""
        jams = self.jam.any(axis=1)
        events = dict(zip(OUTCOMES, (self.uncut, jams, self.stiff, self.breaks), strict=False))
        outcome = np.select(list(events.values()), list(range(len(events))), len(events))
        jammed = outcome == OUTCOMES.index("jams")
        forced = tuple(int(np.count_nonzero(each & jammed)) for each in self.forced())
        return FeasibilityResult(
            self.plan, self.trials, outcome, self.torque, self.hand, forced, tuple(self._causes(outcome)), curve
        )

    def _causes(self, outcome: Ints) -> Iterator[OutcomeCause]:
        """Yield the pairs and parts that cause each outcome, most frequent first."""
        done, names = self.trials.done, [pair.name for pair in self.plan.cutting.pairs]
        weakest = self.excess.argmax(axis=1) if self.plan.parts else np.zeros(done, dtype=int)
        parts = {part.name: weakest == at for at, part in enumerate(self.plan.parts)}
        stops = {"cannot be cut": self._marked(UNCUT), "jams": self.jam}
        for at, kind in enumerate(OUTCOMES[:-1]):
            masks = dict(zip(names, stops[kind].T, strict=True)) if kind in stops else parts if kind == "breaks" else {}
            counts = {name: int(np.count_nonzero(mask & (outcome == at))) for name, mask in masks.items()}
            for name, count in sorted(counts.items(), key=lambda item: -item[1]):
                if count:
                    yield OutcomeCause(kind, name, ProbabilityEstimate(count, done))
