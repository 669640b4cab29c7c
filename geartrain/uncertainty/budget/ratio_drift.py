"""The first cause: a mean speed that is not the sky's, so that the pointer gains or loses ever more.

A pointer of speed w (turns a unit) that should turn at t gains 360 (|w| - |t|) degrees a unit, and 360 (|w|/|t| - 1) in
a turn; w and t are exact.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from geartrain.kinematics.judged_outputs import OutputResult, TargetResult
from geartrain.train.periods import period_table
from geartrain.uncertainty.budget.pointer_budget import BudgetCause, RatioDrift

if TYPE_CHECKING:
    from geartrain.train import Target

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
