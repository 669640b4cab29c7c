"""Feasibility trials: wheels, friction, strengths of metals and the torque limit are random.

Cutting errors and pointer errors are the same as in `run_trials` with the same seed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import pairwise
from math import inf, nan, radians
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.confidence_intervals import IntervalEstimate, ProbabilityEstimate, percentile_of
from geartrain.numerics.results import Key, Pictured, Result
from geartrain.numerics.work import Execution
from geartrain.workshop.cutting.declared_errors import ErrorSpecification
from geartrain.workshop.feasibility.feasibility_plan import FeasibilityPlan, wedge_torque
from geartrain.workshop.monte_carlo.friction_trials import friction_spreads
from geartrain.workshop.monte_carlo.monte_carlo_result import PartialTrials
from geartrain.workshop.monte_carlo.trial_block import (
    BLOCK,
    CLASH,
    DISENGAGED,
    JAM,
    UNCUT,
    RandomStreams,
    draw_trial_wheels,
    judge_trial_pairs,
)
from geartrain.workshop.monte_carlo.trial_results import TrialResults
from geartrain.workshop.monte_carlo.trial_run import check_trials, gathered, trial_tasks, unpack, work_block

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Ints

OUTCOMES = ("cannot be cut", "jams", "too stiff", "breaks", "turns")
"""Outcomes of a trial, in the order in which they are examined. Exactly one of them applies to each trial."""

_MOST = 100  # accuracies of a curve: each costs nearly as much as the trials


@dataclass(frozen=True)
class FeasibilityResult(Pictured, Result):
    """Outcomes of the feasibility trials of a train.

    See Also
    --------
    run_feasibility : Run the trials.
    """

    PAGE = "workshop.feasibility.feasibility_report:describe_feasibility"
    FIGURE = "workshop.feasibility.feasibility_report:feasibility_figure"

    KEYS = (
        *(Key("train", "trials.plan.name"), Key("seed", "trials.seed"), Key("trials", "trials.done"), "conditions"),
        *("outcomes", "rough", "loose", "forced", "causes", "crank_torque", Key("outputs", "trials.pointers")),
        *("curve", "neglected", "partial"),
    )

    plan: FeasibilityPlan
    """Input data of the trials."""
    trials: TrialResults
    """Trials with cutting errors: events of the pairs, and pointer errors."""
    torque: Floats | None
    """Torque at the crank in each trial [N m], shape (trials,); infinite if friction locks the train, None if no loads
    are declared.
    """
    driven: Mapping[str, Floats]
    """Torque on the driven wheel of each pair in each trial, shape (trials,) [N m]."""
    efficiency: Mapping[str, Floats]
    """Efficiency of each pair in each trial, shape (trials,) [1]."""
    stops: Mapping[float, Bools] = field(default_factory=dict)
    """Masks of the trials with a jam or with a wheel that cannot be cut, keyed by accuracy [deg]."""

    def _summary(self) -> str:
        return ", ".join(f"{name} {100 * each.value:.3g} %" for name, each in self.outcomes.items() if each.count)

    @cached_property
    def hand(self) -> Floats | None:
        """Maximum torque that the hand or the drive can exert on the crank in each trial [N m], shape (trials,); None
        if it is not declared.
        """
        return self.plan.hands(self.trials.seed, self.trials.done)

    @cached_property
    def strengths(self) -> Floats:
        """Strength of each part of the plan in each trial, shape (trials, parts) [MPa]."""
        return self.plan.strengths(self.trials.seed, self.trials.done)

    @cached_property
    def stiff(self) -> Bools:
        """Mask, (trials,), of the trials in which friction locks the train, or in which the torque required at the
        crank exceeds the maximum torque of the hand or drive.
        """
        if self.torque is None:
            return np.zeros(self.trials.done, dtype=bool)
        return np.isinf(self.torque) if self.hand is None else self.torque > self.hand

    @cached_property
    def excess(self) -> Floats:
        """Ratio of stress to strength of each part in each trial [1], shape (trials, parts)."""
        return self._excess(self.driven)

    def _excess(self, torques: Mapping[str, Floats | float]) -> Floats:
        columns = [np.broadcast_to(part.stresses(torques), (self.trials.done,)) for part in self.plan.parts]
        return np.nan_to_num(np.stack(columns, axis=1) / self.strengths) if columns else self.strengths

    def _marked(self, mark: int) -> Bools:
        found: Bools = (self.trials.marks & mark) != 0
        return found

    @cached_property
    def outcome(self) -> Ints:
        """Index in `OUTCOMES` of the outcome of each trial, shape (trials,)."""
        uncut, jams = (self._marked(mark).any(axis=1) for mark in (UNCUT, JAM))
        return np.select([uncut, jams, self.stiff, (self.excess > 1).any(axis=1)], [*range(4)], 4)

    @cached_property
    def outcomes(self) -> Mapping[str, ProbabilityEstimate]:
        """Probability of each outcome; the probabilities sum to 1."""
        counts = np.bincount(self.outcome, minlength=len(OUTCOMES)).tolist()
        return {name: ProbabilityEstimate(n, self.trials.done) for name, n in zip(OUTCOMES, counts, strict=True)}

    @property
    def rough(self) -> ProbabilityEstimate:
        """Probability of rough running, in which a tip strikes the tip of its mate, if the train turns."""
        return self._of_turning(CLASH)

    @property
    def loose(self) -> ProbabilityEstimate:
        """Probability that a pair loses contact if the train turns."""
        return self._of_turning(DISENGAGED)

    def _of_turning(self, mark: int) -> ProbabilityEstimate:
        marked: Bools = np.asarray(self._marked(mark).any(axis=1))
        return _estimate(marked, self.outcome == OUTCOMES.index("turns"))

    @cached_property
    def forced(self) -> Mapping[str, ProbabilityEstimate] | None:
        """Probability that the maximum torque at the crank breaks a part if the train jams; None if no strengths or no
        maximum torque is declared.

        The value with the key "torque" is a lower bound, because only this torque is considered. The value with the key
        "wedge" also considers the forces between the jammed flanks. Jams of pairs that the crank does not load, or
        whose driven wheel is fixed, are not counted.
        """
        if self.hand is None or not self.plan.parts:
            return None
        known, *none = np.zeros((3, self.trials.done), dtype=bool)
        broken = dict(zip(("torque", "wedge"), none, strict=True))
        for pair, jams in zip(self.plan.cutting.pairs, self._marked(JAM).T, strict=True):
            held = self.plan.held(pair.name) if jams.any() else {}
            if not held:
                continue
            known |= jams
            # the flanks have equal ratios and the mean efficiency of the pair
            gains = [wedge_torque(1.0, (1.0, each), (1.0, each)) for each in self.efficiency[pair.name].tolist()]
            torques = {name: each * self.hand for name, each in held.items()}
            wedge = {**torques, pair.name: torques[pair.name] * np.maximum(gains, 1.0)}
            for name, each in (("torque", torques), ("wedge", wedge)):
                broken[name] |= jams & (self._excess(each) > 1).any(axis=1)
        forced = known & (self.outcome == OUTCOMES.index("jams"))
        return {name: _estimate(each, forced) for name, each in broken.items()}

    @cached_property
    def causes(self) -> Mapping[str, Mapping[str, ProbabilityEstimate]]:
        """Probability of each cause, keyed by outcome and then by cause, with the most frequent cause first.

        The causes are the pairs that cannot be cut, the pairs that jam (several may jam in one trial), and the part
        with the highest ratio of stress to strength.
        """
        names = [pair.name for pair in self.plan.cutting.pairs]
        masks = dict(zip(OUTCOMES, (self._marked(UNCUT), self._marked(JAM)), strict=False))
        masks["breaks"] = self.excess == self.excess.max(axis=1, initial=0.0, keepdims=True)
        found: dict[str, dict[str, ProbabilityEstimate]] = {}
        for kind, mask in masks.items():
            parts = [part.name for part in self.plan.parts] if kind == "breaks" else names
            counts = np.count_nonzero(mask & (self.outcome == OUTCOMES.index(kind))[:, None], axis=0).tolist()
            ranked = sorted(zip(parts, counts, strict=True), key=lambda item: -item[1])
            found[kind] = {name: ProbabilityEstimate(count, self.trials.done) for name, count in ranked if count}
        return found

    @property
    def crank_torque(self) -> Mapping[float, IntervalEstimate] | None:
        """Percentiles 5, 50 and 95 of the crank torque with 95 % confidence intervals [N m], over all trials in which
        friction does not lock the train; None if no loads are declared.
        """
        known = np.zeros(0) if self.torque is None else np.sort(self.torque[np.isfinite(self.torque)])
        return {percent: percentile_of(known, percent) for percent in (5.0, 50.0, 95.0)} if known.size else None

    @property
    def curve(self) -> Mapping[float, ProbabilityEstimate]:
        """Probability that the train turns, keyed by the standard deviation of the pitch deviations of all wheels
        [deg].
        """
        sound, every = ~self.stiff & ~(self.excess > 1).any(axis=1), np.ones(self.trials.done, dtype=bool)
        return {accuracy: _estimate(sound & ~stops, every) for accuracy, stops in self.stops.items()}

    def accuracy_for(self, probability: float = 0.5) -> float | None:
        """Return the accuracy at which the train turns with a given probability, by linear interpolation of the curve
        [deg]; None if the curve does not reach the probability.

        Parameters
        ----------
        probability : float
            Probability that the train turns, 0 to 1.
        """
        for (near, above), (far, below) in pairwise((at, each.value) for at, each in self.curve.items()):
            if above >= probability > below:
                return near + (far - near) * (above - probability) / (above - below)
        return None

    @property
    def conditions(self) -> str:
        """Description of the conditions of the trials: clearance, friction, filing, and how often values are drawn."""
        pairs, declared, spreads = self.plan.cutting.pairs, self.plan.declared, friction_spreads(self.plan.declared)
        found = []
        for name, values in (
            ("backlash (pitches)", [pair.backlash for pair in pairs]),
            ("clearance factor", [1 + pair.sizes.excess for pair in pairs if hasattr(pair, "sizes")]),
        ):
            if values:
                found.append(f"{name} {min(values):.4g} to {max(values):.4g}")
        texts = (
            f"of {'bearings' if name.startswith('bearing of ') else name} {each}" for name, each in spreads.items()
        )
        fixed = "none" if declared.friction is None else "without spread"
        found.append("friction " + ("; ".join(dict.fromkeys(texts)) or fixed))
        found.append("filed to fit" if self.plan.cutting.files else "no filing")
        if spreads or any(part.spread for part in self.plan.parts):
            apart = any(link.bearing and len(link.bearing.shared) < 2 for link in declared.links.values())
            own = ", of bearings as `shared` declares" if apart and not self.plan.per_part else ""
            found.append(f"spreads drawn once per {'part' if self.plan.per_part else 'workshop'}{own}")
        return ", ".join(found)

    @property
    def perfect(self) -> bool:
        """True if no wheel has a cutting error, so that the wheels are the same in all trials."""
        return all(wheel.true for wheel in self.plan.cutting.wheels)

    @property
    def neglected(self) -> tuple[str, ...]:
        """Names of the outcomes that are not examined, because their data are not declared."""
        found = []
        if self.perfect:
            found.append("cutting errors: declare `cutting: {pitch_deviation: {normal: 0.1 deg}}`, or give --cutting")
        if self.torque is None:
            found.append("crank torque and stresses: declare `loads` or `bearing` friction with a unit")
        elif not self.plan.parts:
            found.append("breakage: declare `material`, `module` and `face_width`")
        if self.hand is None:
            found.append("the strength of the hand: declare `drive: {hand: {torque: 300 N mm}}`")
        return tuple(found)

    @property
    def partial(self) -> PartialTrials | None:
        """Numbers of completed and requested trials if the run was interrupted; None if all trials were completed."""
        return None if self.trials.complete else PartialTrials(self.trials.done, self.trials.wanted)


def _estimate(event: Bools, of: Bools) -> ProbabilityEstimate:
    """Return the estimated probability of an event (mask of trials) among the trials selected by the mask `of`."""
    return ProbabilityEstimate(int(np.count_nonzero(event & of)), int(np.count_nonzero(of)))


# --------------------------------------------------------------------------------------------------------------- trials


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
        Train with its random data, from `find_feasibility_plan`.
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
    The outcomes are examined in the order of `OUTCOMES`: docs/cut-by-hand.md, section 10.

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
    if len(accuracies) > _MOST or not all(0 <= each < inf for each in accuracies):
        what = f"{', '.join(f'{each:g}' for each in accuracies[:4])} are not valid accuracies"
        why = f"an accuracy is a standard deviation [deg] of 0 or more, and a curve has at most {_MOST}"
        raise QuestionError(Problem(what, why, "for example, give --accuracy 0.02:0.3:6"))
    parts = trial_tasks(trials)
    tasks = [[at, *part] for at in range(-1, len(accuracies)) for part in parts]
    found: list[Any] = []
    try:
        for each in (means or Execution()).run(partial(work_feasibility, plan, seed, tuple(accuracies)), tasks):
            found.append(each)
    except KeyboardInterrupt:
        if not found:  # without a complete task there is nothing to return
            raise
    count = len(parts)
    records = [unpack(part[0], each["trials"]) for part, each in zip(parts, found[:count], strict=False)]
    # an interrupted run has only complete accuracies
    later = {at: found[count * (k + 1) : count * (k + 2)] for k, at in enumerate(accuracies)}
    stops = {at: np.concatenate([*map(np.array, each)]) for at, each in later.items() if len(each) == count}
    loads = [row for each in found[:count] for row in each["loads"]]
    return FeasibilityResult(plan, gathered(plan.cutting, seed, trials, records), *_columns(plan, loads), stops)


def _columns(plan: FeasibilityPlan, loads: Sequence[Any]) -> tuple[Floats | None, dict[str, Floats], dict[str, Floats]]:
    """Return arrays of the `loads` of all trials: crank torque, and torque and efficiency keyed by pair."""
    if plan.nominal is None:
        return None, {}, {}
    crank = np.array([inf if row is None or row[0] is None else row[0] for row in loads])
    driven, efficiency = (
        {
            name: np.array([nan if row is None else row[at].get(name, nan) for row in loads])
            for name in plan.nominal.driven
        }
        for at in (1, 2)
    )
    return crank, driven, efficiency


def work_feasibility(plan: FeasibilityPlan, seed: int, accuracies: tuple[float, ...], task: Sequence[int]) -> Any:
    """Return the results of one task as plain data.

    They are the records and the loads of its trials or, for one of the `accuracies`, a flag for each trial that is True
    if a pair jams or cannot be cut.

    task   index of an accuracy (-1: none), number of the first trial, number of trials
    """
    at, first, trials = task
    if at < 0:
        loads = [plan.drawn_loads(seed, trial) for trial in range(first, first + trials)]
        packed = [each and [each.crank if each.crank < inf else None, each.driven, each.efficiency] for each in loads]
        return {"trials": work_block(plan.cutting, seed, [first, trials]), "loads": packed}
    deviation = radians(accuracies[at])
    wheels = tuple(
        replace(each, errors={**each.errors, "pitch_deviation": ErrorSpecification(deviation / each.pitch, "normal")})
        for each in plan.cutting.wheels
    )
    changed = replace(plan.cutting, wheels=wheels)
    marks, _ = judge_trial_pairs(draw_trial_wheels(changed, RandomStreams(seed, first // BLOCK), trials, first % BLOCK))
    return ((marks & (JAM | UNCUT)) != 0).any(axis=1).tolist()
