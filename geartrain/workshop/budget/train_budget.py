"""The budget of a train in one state: what is requested, how the causes are gathered, and two of the causes.

First cause, the ratio: a pointer of speed w (turns a unit) that should turn at t gains 360 (|w| - |t|) degrees a unit,
and 360 (|w|/|t| - 1) in a turn; w and t are exact.

Fifth cause, wheels cut by hand: trials of the whole train. The error of a trial includes the ripple of even teeth,
which is a cause of its own: the same positions with even teeth are composed again and subtracted (docs/cut-by-hand.md).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import degrees, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem, QuestionError, check_choice
from geartrain.kinematics.judged_outputs import OutputResult, TargetResult
from geartrain.numerics.confidence_intervals import deviation_of, percentile_of
from geartrain.train.periods import period_table
from geartrain.workshop.budget.crank_load import find_crank_load
from geartrain.workshop.budget.motion_causes import (
    Body,
    DeclaredPairs,
    ErrorDifference,
    TheoryError,
    find_bodies,
    find_tooth_motion,
    link_theory,
    theory_cause,
    tooth_causes,
    without_teeth,
)
from geartrain.workshop.budget.pointer_budget import BudgetCause, Declared, PointerBudget, RatioDrift, TrainBudget
from geartrain.workshop.cutting.declared_errors import read_error_overrides
from geartrain.workshop.monte_carlo.clearance_study import run_clearances
from geartrain.workshop.monte_carlo.trial_plan import find_trial_plan
from geartrain.workshop.monte_carlo.trial_results import FEWEST, turning_trials
from geartrain.workshop.monte_carlo.trial_run import run_trials

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Motion
    from geartrain.kinematics.answer import Answer
    from geartrain.kinematics.judged_outputs import OutputResult
    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.work import Execution
    from geartrain.train import Target
    from geartrain.workshop.budget.motion_causes import ToothMotion
    from geartrain.workshop.monte_carlo.clearance_study import ClearanceCase
    from geartrain.workshop.monte_carlo.trial_plan import TrialPlan
    from geartrain.workshop.monte_carlo.trial_results import TrialResults


SAROS = float(period_table()["saros_223_synodic_modern"].value)  # d


@dataclass(frozen=True)
class BudgetQuestion:
    """What a budget is made of.

    Examples
    --------
    >>> BudgetQuestion().span_days
    6585.3213
    """

    outputs: tuple[str, ...] = ()
    """Names of outputs; by default all that have a target or a dial, or all where none has."""
    without: tuple[str, ...] = ()
    """Pairs left out, so that real teeth do not contradict each other around a loop."""
    span_days: float = SAROS
    """Over which ratios drift [d]; by default one Saros."""
    turns: float = 20.0
    """Of the input, over which teeth are followed."""
    samples: int = 20_000
    """Positions of these turns, 2 or more."""
    cutting: tuple[str, ...] = ()
    """Cutting errors that replace the declared ones, such as "pitch_deviation=1 %"."""
    trials: int = 256
    """How many times the wheels are cut."""
    seed: int = 1
    """Of the random numbers."""
    jam_trials: int = 64
    """How many times they are cut at each clearance."""
    clearances: tuple[float, ...] = (0.1, 0.3, 0.5, 0.7, 0.9)
    """Shares of each pair's window, or factors of the centre distance, at which jams are counted."""
    bodies: Mapping[str, Body | None] = field(default_factory=dict)
    """By output, whose true motion it should show, where its name does not tell; None for nobody's."""

    def __post_init__(self) -> None:
        if not 0 < self.span_days < 1e9:
            what = f"a span of {self.span_days:g} days"
            raise QuestionError(
                Problem(what, "ratios drift in time that passes", "give a span above 0 and below 1e9 days")
            )
        if self.samples < 2 or not 0 < self.turns <= 1e6:
            what = f"{self.samples} positions of {self.turns:g} turns"
            raise QuestionError(
                Problem(what, "teeth are followed while the input turns", "give 2 or more, and turns above 0")
            )


STAGES = 5
"""Of a budget, told one by one: speeds and pins, teeth and play, cutting, jams, crank."""


def find_budget(
    train: GearTrain,
    requested: BudgetQuestion | None = None,
    state: str | None = None,
    means: Execution | None = None,
    on_stage: Callable[[], None] = lambda: None,
) -> TrainBudget:
    """The budget of each pointer of a train: what its error comes from, in degrees and in days.

    Parameters
    ----------
    train : GearTrain
        Whatever it does not declare is named, and never counted as 0.
    requested : BudgetQuestion, optional
        Pointers, span, positions, errors of cutting.
    state : str, optional
        A declared state; None only of a train that has none.
    means : Execution, optional
        Who does the trials of cut wheels; by default this process.
    on_stage : callable
        Called after each of `STAGES` stages.

    Returns
    -------
    TrainBudget
        By pointer the causes, ranked; torque of the crank; jams over clearance.

    Raises
    ------
    QuestionError
        If the train does not move, or an output is not declared.
    GearTrainError
        If cutting is asked for, and the train's teeth cannot be cut.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.workshop import (BudgetQuestion, find_budget)
    >>> question = BudgetQuestion(outputs=("moon",), span_days=36525)
    >>> moon = find_budget(geartrain.load("freeth-2008"), question)["moon"]
    >>> moon["ratio"].note, round(moon["ratio"].degrees, 3), round(moon["ratio"].days, 3)
    ('against month_tropical_J2000 direct', 5.567, 0.422)
    """
    from geartrain.numerics.work import Execution

    requested, means = requested or BudgetQuestion(), means or Execution()
    answer = train.solve(state)
    names = pointer_names(answer, requested)
    motion = train.motion(state, names, requested.without)
    theories = _theories(train, requested, answer, motion)
    on_stage()
    teeth = find_tooth_motion(motion, requested.turns, requested.samples)
    on_stage()
    plan, uncut = cutting_plan(train, requested.cutting, names, state, requested.without)
    cut = None if plan is None else find_cutting_trials(plan, motion, requested.trials, requested.seed, means)
    on_stage()
    jams, jams_note = _jams(plan, uncut, requested, means)
    on_stage()
    crank = find_crank_load(
        train, state, motion._problem.driving_link, {name: answer.outputs[name].of for name in names}
    )
    on_stage()
    causes = _TrainCauses(requested, _float(train.declaration.unit_days), theories, teeth, cut, uncut)
    pointers = tuple(causes.pointer(answer.outputs[name]) for name in names)
    return TrainBudget(
        train.name,
        state,
        requested.span_days,
        requested.turns,
        requested.samples,
        motion._problem.driving_link,
        pointers,
        crank,
        jams,
        jams_note,
        teeth.reversing_drivers,
    )


@dataclass(frozen=True)
class _TrainCauses:
    """What was found of the whole train, from which the budget of each pointer is taken."""

    requested: BudgetQuestion
    unit_days: float | None
    theories: Mapping[str, list[TheoryError]]
    teeth: ToothMotion
    cut: CuttingTrials | None
    uncut: str

    def pointer(self, output: OutputResult) -> PointerBudget:
        """The budget of one output."""
        name, speed = output.name, output.speed
        # mean speed without sign; none where the pointer stands or the unit is no time
        rate = 360 * abs(float(speed)) / self.unit_days if speed and self.unit_days else None
        drifts = find_drifts(output, self.unit_days, self.requested.span_days)
        ratio, theory = ratio_cause(drifts), theory_cause(self.theories[name])
        found = (ratio, theory, *tooth_causes(self.teeth, name), self._cutting(name))
        causes = tuple(cause.in_days(rate) for cause in found)
        return PointerBudget(name, output.of, output.relative_to, speed, rate, causes, drifts, self.teeth.pairs[name])

    def _cutting(self, name: str) -> BudgetCause:
        known = self.teeth.declared[name]
        if not known.gears and not known.pins:
            return BudgetCause("cutting", "whole", 0.0, 0.0, 0.0, note="no gear pair lies between it and the input")
        if self.cut is None:
            return BudgetCause.unknown("cutting", self.uncut)
        return self.cut.cause(name, known)


def pointer_names(answer: Answer, requested: BudgetQuestion) -> tuple[str, ...]:
    """The outputs asked for, else those that somebody reads: with a target or a dial, or all where none has either."""
    for name in (*requested.outputs, *requested.bodies):
        check_choice("output", name, tuple(answer.outputs))
    if requested.outputs:
        return requested.outputs
    read = tuple(name for name, each in answer.outputs.items() if each.targets or each.output.dial)
    names = read or tuple(answer.outputs)
    if not names:
        why = "a budget is that of a pointer"
        raise QuestionError(Problem(f"'{answer.train}' declares no output", why, "declare `outputs`"))
    return names


def _float(value: Fraction | None) -> float | None:
    return None if value is None else float(value)


def _theories(
    train: GearTrain, requested: BudgetQuestion, answer: Answer, motion: Motion
) -> dict[str, list[TheoryError]]:
    """By pointer the anomalies of its link and of the link it is read against, each against its body."""
    problem, days = motion._problem, _float(train.declaration.unit_days)
    bodies = find_bodies(answer.outputs.values(), problem.frame, days, requested.bodies)
    links = {link: link_theory(problem, link, body) for link, body in bodies.items()}
    found = {}
    for name in motion.outputs:
        output = answer.outputs[name]
        ends = [link for link in (output.of, output.relative_to) if link in links]
        # what stands for nothing and is read against the Moon is no pointer of the Moon
        found[name] = [links[link] for link in ends] if output.of in links else []
    return found


def _jams(
    plan: TrialPlan | None, uncut: str, requested: BudgetQuestion, means: Execution
) -> tuple[tuple[ClearanceCase, ...], str]:
    """How often wheels jam over clearance, or why that is not known."""
    if plan is None:
        return (), uncut
    return jams_over_clearance(plan, requested.clearances, requested.jam_trials, requested.seed, means)


# ---------------------------------------------------------------------------------------------------------------- ratio


YEAR, CENTURY = 365.25, 36525.0  # Julian, in days


def find_drifts(output: OutputResult, unit_days: float | None, span_days: float) -> tuple[RatioDrift, ...]:
    """What an output gains against each of its targets; what the sky was seen to do comes first.

    unit_days   the train's unit of time (d), None where it is none
    """
    judged = list(zip(output.output.targets, output.targets, strict=False))
    judged.sort(key=lambda both: not _is_seen(both[0]))  # stable: else as declared
    return tuple(_drift(result, unit_days, span_days) for _, result in judged)


def _is_seen(target: Target) -> bool:
    """A period of the shipped table is a time in the sky; speeds and relations are what makers meant."""
    return target.name is not None and period_table()[target.name].kind == "period"


def _drift(result: TargetResult, unit_days: float | None, span_days: float) -> RatioDrift:
    per_unit, ppm = result.degrees_per_unit, result.ppm
    per_day = per_unit / unit_days if per_unit is not None and unit_days else None
    return RatioDrift(
        result.goal.words if result.goal.sense else result.label,
        ppm,
        None if ppm is None else ppm * 360e-6,
        *(None if per_day is None else per_day * days for days in (YEAR, CENTURY, span_days)),
    )


def ratio_cause(drifts: tuple[RatioDrift, ...]) -> BudgetCause:
    """The drift over the span, against the first target."""
    if not drifts:
        return BudgetCause.unknown("ratio", "no target is declared for this pointer")
    first = drifts[0]
    if first.degrees_over_span is None:
        note = f"against {first.target}: the train's unit is no time, so that there is no span to drift over"
        return BudgetCause.unknown("ratio", note)
    size = abs(first.degrees_over_span)
    # a line from 0 to its end: rms about its mean
    return BudgetCause("ratio", "whole", size, size / sqrt(12), note=f"against {first.target}")


# -------------------------------------------------------------------------------------------------------------- cutting


@dataclass(frozen=True)
class CuttingTrials:
    """Trials of a train, with what even teeth do at the same positions (rad), (outputs, trials)."""

    trials: TrialResults
    even: Floats

    def cause(self, name: str, known: DeclaredPairs) -> BudgetCause:
        """The range that holds 95 % of the errors of one output, and its interval: ends of both percentiles'.

        known   what moves the output
        """
        at = self.trials.plan.outputs.index(name)
        errors = self.trials.errors[:, at]
        whole = np.isfinite(errors)
        reach = len(self.trials.plan.reach[at])
        if known.gears and not reach:
            return BudgetCause.unknown("cutting", "none of the pairs that move it can be cut")
        if known.bare and not np.ptp(errors[whole]):
            return BudgetCause.unknown("cutting", f"no dimensions are declared of {', '.join(known.bare)}")
        runs = whole & turning_trials(self.trials.marks, self.trials.plan.reach[at])
        kept = runs if np.count_nonzero(runs) >= FEWEST else whole
        note = f"{int(np.count_nonzero(runs))} of {self.trials.done} trials turn"
        note += f", {reach} of {known.gears} pairs cut" if reach < known.gears else ""
        note += "" if kept is runs else "; taken from all, as the pushing flanks alone would have them"
        values = np.sort((errors - self.even[at])[kept])
        low, high = percentile_of(values, 2.5), percentile_of(values, 97.5)
        size = degrees(high.value - low.value)
        within = degrees(max(high.low - low.high, 0.0)), degrees(high.high - low.low)
        interval = within if np.isfinite(within).all() else None
        if interval is None:
            note += "; too few trials for an interval"
        declared: Declared = "part" if known.bare or reach < known.gears else "whole"
        deviation = degrees(deviation_of(values).value)
        return BudgetCause("cutting", declared, size, deviation, interval=interval, note=note)


def find_cutting_trials(plan: TrialPlan, motion: Motion, count: int, seed: int, means: Execution) -> CuttingTrials:
    """Cut the wheels so many times; the motion is that with even teeth."""
    found = run_trials(plan, count, seed, means)
    if not found.complete:  # interrupted: a budget of half the trials would not say so
        raise KeyboardInterrupt
    teeth = ErrorDifference(plan.composition, without_teeth(motion)._forward)
    parts = [teeth.at(found.turns[start : start + teeth.chunk]).error for start in range(0, found.done, teeth.chunk)]
    return CuttingTrials(found, np.concatenate(parts, axis=1))


def cutting_plan(
    train: GearTrain, cutting: Sequence[str], outputs: Sequence[str], state: str | None, without: Sequence[str]
) -> tuple[TrialPlan | None, str]:
    """What trials need, or why there are none. Raises `GearTrainError` where `cutting` cannot be tried."""
    settings = read_error_overrides(cutting)
    try:
        return find_trial_plan(train, settings, outputs, state, without), ""
    except GearTrainError as error:
        if cutting:
            raise
        return None, error.problems[0].what


def jams_over_clearance(
    plan: TrialPlan, clearances: Sequence[float], count: int, seed: int, means: Execution
) -> tuple[tuple[ClearanceCase, ...], str]:
    """How often some pair jams at each clearance; none, and why, where a pair has no window."""
    if not clearances:
        return (), "no clearance was asked for"
    try:
        return tuple(run_clearances(plan, clearances, count, seed, means)), ""
    except GearTrainError as error:
        return (), error.problems[0].what
