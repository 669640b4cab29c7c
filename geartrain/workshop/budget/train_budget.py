"""Budget of a train in one state: its options, the collection of all causes, and the causes "ratio" and "cutting".

First cause, the ratio: a pointer with the speed w (turns per unit), which should turn at the speed t, gains 360 (|w| -
|t|) degrees per unit, and 360 (|w|/|t| - 1) degrees per turn. Both w and t are exact.

Fifth cause, cutting errors: Monte Carlo trials of the whole train. The error of a trial includes the ripple of perfect
teeth, which is a separate cause. The motion with perfect teeth is therefore composed at the same positions and
subtracted (docs/cut-by-hand.md).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import degrees, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorDifference
from geartrain.errors import GearTrainError, Problem, QuestionError, check_choice
from geartrain.kinematics.judged_outputs import OutputResult
from geartrain.numerics.confidence_intervals import deviation_of, percentile_of
from geartrain.train.periods import period_table
from geartrain.workshop.budget.motion_causes import (
    Body,
    DeclaredPairs,
    TheoryError,
    find_bodies,
    find_tooth_motion,
    link_theory,
    theory_cause,
    tooth_causes,
)
from geartrain.workshop.budget.pointer_budget import BudgetCause, Declared, PointerBudget, RatioDrift, TrainBudget
from geartrain.workshop.cutting.declared_errors import read_error_overrides
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
    from geartrain.workshop.monte_carlo.trial_results import TrialResults


SAROS = float(period_table()["saros_223_synodic_modern"].value)  # d


@dataclass(frozen=True)
class BudgetQuestion:
    """Options of an error budget: outputs, time span, positions of the input, and Monte Carlo trials of cut wheels.

    Examples
    --------
    >>> BudgetQuestion().span_days
    6585.3213
    """

    outputs: tuple[str, ...] = ()
    """Names of the outputs to include. By default these are all outputs with a target or a dial, or all outputs if none
    has one.
    """
    without: tuple[str, ...] = ()
    """Names of pairs to omit so that the teeth of the remaining pairs do not form a closed loop."""
    span_days: float = SAROS
    """Time span over which drifts are evaluated [d], above 0 and below 1e9. The default is one Saros."""
    turns: float = 20.0
    """Number of turns of the input over which transmission errors are evaluated, above 0 and up to 1e6."""
    samples: int = 20_000
    """Number of positions of the input within `turns`, 2 or more."""
    cutting: tuple[str, ...] = ()
    """Cutting errors that replace the declared errors, such as "pitch_deviation=1 %". By default none are replaced."""
    trials: int = 256
    """Number of trials with cutting errors."""
    seed: int = 1
    """Random seed of the trials."""
    bodies: Mapping[str, Body | None] = field(default_factory=dict)
    """Celestial body whose motion an output represents, keyed by output, for outputs whose names do not identify it.
    None means that the output represents no body.
    """

    def __post_init__(self) -> None:
        if not 0 < self.span_days < 1e9:
            what = f"a span of {self.span_days:g} days is out of range"
            raise QuestionError(
                Problem(what, "a span must be above 0 and below 1e9 days", "for example, give --span '6940 d'")
            )
        if self.samples < 2 or not 0 < self.turns <= 1e6:
            what = f"{self.samples} positions in {self.turns:g} turns are out of range"
            why = "the errors of teeth are computed at 2 or more positions in more than 0 and at most 1e6 turns"
            raise QuestionError(Problem(what, why, "for example, give --turns 20 --samples 20000"))


STAGES = 3
"""Number of stages in the computation of a budget: speeds and pins, teeth and backlash, cutting."""


def find_budget(
    train: GearTrain,
    requested: BudgetQuestion | None = None,
    state: str | None = None,
    means: Execution | None = None,
    on_stage: Callable[[], None] = lambda: None,
) -> TrainBudget:
    """Return the error budget of each pointer of a train: the contribution of every cause, in degrees and in days.

    Parameters
    ----------
    train : GearTrain
        Train to analyse. Causes for which the train declares no data are reported as "not declared"; their size is not
        set to 0.
    requested : BudgetQuestion, optional
        Options of the budget: pointers, time span, input positions and cutting errors.
    state : str, optional
        Name of a declared state. Required if the train declares states.
    means : Execution, optional
        Executor of the trials with cutting errors; by default this process.
    on_stage : callable
        Progress function, called after each of `STAGES` stages.

    Returns
    -------
    TrainBudget
        Ranked causes of each pointer.

    Raises
    ------
    QuestionError
        If the train does not move, or an output is not declared or slides, or the train has no outputs.
    GearTrainError
        If cutting errors are requested and the train's teeth cannot be cut.

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
    motion = train.motion(state, names, requested.without)._turning(requested.outputs)
    names = tuple(motion.outputs)
    theories = _theories(train, requested, answer, motion)
    on_stage()
    teeth = find_tooth_motion(motion, requested.turns, requested.samples)
    on_stage()
    cut = _cutting_trials(train, requested, motion, state, means)
    on_stage()
    days, pointers = _float(train.declaration.unit_days), []
    for name in names:
        output, speed, known = answer.outputs[name], answer.outputs[name].speed, teeth.declared[name]
        # absolute mean speed; None if the pointer does not turn or the unit is not a time
        rate = 360 * abs(float(speed)) / days if speed and days else None
        drifts = find_drifts(output, days, requested.span_days)
        cutting = BudgetCause.unknown("cutting", cut) if isinstance(cut, str) else cutting_cause(*cut, name, known)
        if not known.gears and not known.pins:
            # without pairs the error is known to be 0, and not undeclared
            cutting = BudgetCause("cutting", "whole", 0.0, 0.0, 0.0, note="no gear pair is between it and the input")
        found = (ratio_cause(drifts), theory_cause(theories[name]), *tooth_causes(teeth, name), cutting)
        causes = tuple(
            replace(cause, days=cause.degrees / rate) if cause.degrees is not None and rate else cause
            for cause in found
        )
        pointers.append(
            PointerBudget(name, output.of, output.relative_to, speed, rate, causes, drifts, teeth.pairs[name])
        )
    return TrainBudget(
        train.name,
        state,
        requested.span_days,
        requested.turns,
        requested.samples,
        motion._problem.driving_link,
        tuple(pointers),
        teeth.reversing_drivers,
        requested.outputs or train.declaration.dial_outputs(names),
    )


def pointer_names(answer: Answer, requested: BudgetQuestion) -> tuple[str, ...]:
    """Return the names of the requested outputs. If none is requested, return the outputs with a target or a dial, or
    all outputs if there are none.

    Raises `QuestionError` if a requested output does not exist or the train declares no outputs.
    """
    for name in (*requested.outputs, *requested.bodies):
        check_choice("output", name, tuple(answer.outputs))
    if requested.outputs:
        return requested.outputs
    read = tuple(name for name, each in answer.outputs.items() if each.targets or each.output.dial)
    names = read or tuple(answer.outputs)
    if not names:
        why = "an error budget is computed for the outputs of a train"
        raise QuestionError(Problem(f"'{answer.train}' declares no output", why, "declare `outputs: {LINK: {}}`"))
    return names


def _float(value: Fraction | None) -> float | None:
    return None if value is None else float(value)


def _theories(
    train: GearTrain, requested: BudgetQuestion, answer: Answer, motion: Motion
) -> dict[str, list[TheoryError]]:
    """Return, for each pointer, the errors of its link and of its reference link against the true celestial motion."""
    problem, days = motion._problem, _float(train.declaration.unit_days)
    bodies = find_bodies(answer.outputs.values(), problem.frame, days, requested.bodies)
    links = {link: link_theory(problem, link, body) for link, body in bodies.items()}
    found = {}
    for name in motion.outputs:
        output = answer.outputs[name]
        ends = [link for link in (output.of, output.relative_to) if link in links]
        # an output that does not represent a body but is read against the Moon is not a pointer of the Moon
        found[name] = [links[link] for link in ends] if output.of in links else []
    return found


# ---------------------------------------------------------------------------------------------------------------- ratio


YEAR, CENTURY = 365.25, 36525.0  # Julian, in days


def find_drifts(output: OutputResult, unit_days: float | None, span_days: float) -> tuple[RatioDrift, ...]:
    """Return the drift of an output relative to each of its targets: first the observed periods, then all others.

    unit_days   duration of the train's unit of time (d); None if its unit is not a time
    span_days   time span over which the drift is evaluated (d)
    """
    observed: list[RatioDrift] = []
    intended: list[RatioDrift] = []
    for target, result in zip(output.output.targets, output.targets, strict=False):
        per_unit, ppm = result.degrees_per_unit, result.ppm
        per_day = per_unit / unit_days if per_unit is not None and unit_days else None
        drift = RatioDrift(
            result.goal.words if result.goal.sense else result.label,
            ppm,
            None if ppm is None else ppm * 360e-6,  # 1 ppm of a turn is 360e-6 deg
            *(None if per_day is None else per_day * days for days in (YEAR, CENTURY, span_days)),
        )
        is_period = target.name is not None and period_table()[target.name].kind == "period"
        (observed if is_period else intended).append(drift)
    return (*observed, *intended)


def ratio_cause(drifts: tuple[RatioDrift, ...]) -> BudgetCause:
    """Return the contribution of the cause "ratio": the magnitude of the first drift over the time span [deg]."""
    if not drifts:
        return BudgetCause.unknown("ratio", "no target is declared for this pointer")
    first = drifts[0]
    if first.degrees_over_span is None:
        note = f"against {first.target}: the train's unit is not a time, so the drift over the span is undefined"
        return BudgetCause.unknown("ratio", note)
    size = abs(first.degrees_over_span)
    # rms about the mean of a line from 0 to `size`
    return BudgetCause("ratio", "whole", size, size / sqrt(12), note=f"against {first.target}")


# -------------------------------------------------------------------------------------------------------------- cutting


def cutting_cause(trials: TrialResults, even: Floats, name: str, known: DeclaredPairs) -> BudgetCause:
    """Return the contribution of the cause "cutting" to one output: the central 95 % range of its errors [deg].

    trials   results of trials with cutting errors
    even     errors with perfect teeth at the input positions of the trials (rad), shape (outputs, trials)
    name     name of the output; `known` are the pairs and couplings that move it
    """
    at = trials.plan.outputs.index(name)
    errors, reach = trials.errors[:, at], trials.plan.reach[at]
    whole = np.isfinite(errors)
    if known.gears and not reach:
        return BudgetCause.unknown("cutting", "none of the pairs that move it can be cut")
    if known.bare and not np.ptp(errors[whole]):
        return BudgetCause.unknown("cutting", f"no dimensions are declared for {', '.join(known.bare)}")
    runs = whole & turning_trials(trials.marks, reach)
    # too few turning trials give no useful percentiles, so all trials are used
    kept = runs if np.count_nonzero(runs) >= FEWEST else whole
    note = f"{int(np.count_nonzero(runs))} of {trials.done} trials turn"
    note += f", {len(reach)} of {known.gears} pairs cut" if len(reach) < known.gears else ""
    note += "" if kept is runs else "; errors of all trials, given by the pushing flanks"
    values = np.sort((errors - even[at])[kept])
    low, high = percentile_of(values, 2.5), percentile_of(values, 97.5)
    size = degrees(high.value - low.value)
    # smallest and largest range that the intervals of both percentiles allow
    within = degrees(max(high.low - low.high, 0.0)), degrees(high.high - low.low)
    interval = within if np.isfinite(within).all() else None
    if interval is None:
        note += "; too few trials for an interval"
    declared: Declared = "part" if known.bare or len(reach) < known.gears else "whole"
    deviation = degrees(deviation_of(values).value)
    return BudgetCause("cutting", declared, size, deviation, interval=interval, note=note)


def _cutting_trials(
    train: GearTrain, requested: BudgetQuestion, motion: Motion, state: str | None, means: Execution
) -> tuple[TrialResults, Floats] | str:
    """Return the results of trials with cutting errors, and the errors of the outputs with perfect teeth.

    The errors are at the input positions of the trials [rad], shape (outputs, trials). If no trials are possible, the
    reason is returned as a text.
    """
    settings = read_error_overrides(requested.cutting)
    try:
        plan = find_trial_plan(train, settings, tuple(motion.outputs), state, requested.without)
    except GearTrainError as error:
        if settings:  # errors given explicitly must be applied; otherwise the cause is only marked as unknown
            raise
        return error.problems[0].what
    found = run_trials(plan, requested.trials, requested.seed, means)
    if not found.complete:  # interrupted: a budget does not state that it uses only some of the trials
        raise KeyboardInterrupt
    teeth = ErrorDifference(plan.composition, motion._with_ideal_teeth()._forward)
    parts = [teeth.at(found.turns[start : start + teeth.chunk]).error for start in range(0, found.done, teeth.chunk)]
    return found, np.concatenate(parts, axis=1)
