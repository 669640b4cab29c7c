"""Chart of error budgets: a row for each pointer, with a mark for the error due to each cause."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geartrain.drawing.style import MOST_ROWS, WHITE, Figure, Row, figures, interval_chart
from geartrain.errors import Problem, QuestionError
from geartrain.scene.palette import series_colour
from geartrain.workshop.budget.pointer_budget import CAUSES

if TYPE_CHECKING:
    from geartrain.workshop.budget.pointer_budget import PointerBudget, TrainBudget

_MARKERS = ("D", "^", "o", "s", "v")
_LOOKS: dict[str, dict[str, Any]] = {
    cause: {"marker": marker, "markersize": 8, "color": series_colour(at), "markeredgewidth": 1.6}
    for at, (cause, marker) in enumerate(zip(CAUSES, _MARKERS, strict=True))
}
_OPEN: dict[str, Any] = {"markersize": 11, "markerfacecolor": WHITE}
_SMALL = 1e-4
"""Size relative to the largest cause in the chart. Smaller causes have no mark, because they would stretch the axis."""


def budget_figure(found: TrainBudget) -> Figure:
    """Draw a chart with a row for each pointer, and a mark for the error due to each cause. The pointer with the
    largest error is at the top.
    """
    pointers = [found[name] for name in found.shown]
    ranked = sorted((each for each in pointers if each.total > 0), key=lambda each: -each.total)
    if not ranked:
        why = "no cause of any pointer's error is declared, or all are 0"
        what = f"the budget of '{found.name}' has nothing to draw"
        raise QuestionError(Problem(what, why, "declare targets of outputs, or `tooth_form` of pairs"))
    days = any(pointer.degrees_per_day for pointer in ranked)
    smallest = _SMALL * max(cause.degrees or 0.0 for pointer in ranked for cause in pointer.ranked)
    rows = [_row(pointer, days, smallest) for pointer in ranked[:MOST_ROWS]]
    label = "\n".join(
        filter(None, ("size of each cause (deg); open marks: declared in part", _missing(found, pointers)))
    )
    name = found.name if found.state is None else f"{found.name}, {found.state}"
    looks = {**_LOOKS, **{_part(cause): {**look, **_OPEN} for cause, look in _LOOKS.items()}}
    heads = ("sum", *["days"] * days)
    return interval_chart({label: rows}, looks, heads, f"{name}: causes of each pointer's error", log=True)


def _part(cause: str) -> str:
    return f"{cause}, in part"


def _row(pointer: PointerBudget, days: bool, smallest: float) -> Row:
    known = [cause for cause in pointer.ranked if (cause.degrees or 0.0) >= smallest]
    marks = {_part(cause.name) if cause.declared == "part" else cause.name: cause.degrees or 0.0 for cause in known}
    spans = [cause.interval for cause in known if cause.interval is not None and cause.interval[0] > 0]
    per_day = pointer.degrees_per_day
    time = [figures(pointer.total / per_day) if per_day else "-"] * days
    return Row(pointer.name, marks, spans, (f"{figures(pointer.total)}°", *time))


def _missing(found: TrainBudget, pointers: list[PointerBudget]) -> str:
    """Return a text with the numbers of drawn pointers for which each cause is unknown."""
    counts = {cause: sum(each.name == cause for pointer in pointers for each in pointer.undeclared) for cause in CAUSES}
    unknown = ", ".join(f"{cause} of {count}" for cause, count in counts.items() if count)
    return f"not declared, of {len(pointers)} pointers: {unknown}" if unknown else ""
