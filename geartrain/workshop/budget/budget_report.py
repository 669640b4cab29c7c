"""Report and chart of the error budgets of a train's pointers: causes in descending order, in degrees and in days."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from geartrain.errors import Problem, QuestionError
from geartrain.report.document import Document, Section, Table, cut, ppm
from geartrain.workshop.budget.pointer_budget import CAUSES

if TYPE_CHECKING:
    from geartrain.drawing.style import Figure, Row
    from geartrain.workshop.budget.pointer_budget import BudgetCause, PointerBudget, TrainBudget

NOT_DECLARED = "not declared"
_PAIRS = 5  # maximum number of pairs listed for each pointer


def describe_budget(found: TrainBudget) -> Document:
    """Return a report on the causes of each pointer's error, in descending order of size, and on missing data."""
    name = found.name if found.state is None else f"{found.name}, state {found.state}"
    summary = [
        "Each cause is given separately, at the pointer. Ratio: error of the mean speed, as a drift over "
        f"{found.span_days:.8g} days. Theory: deviation of the anomaly of the pins from the true motion (Kepler), peak "
        f"to peak. Teeth: ripple through the train, peak to peak, over {found.turns:g} turns of "
        f"'{found.driving_link}'. Lost motion: maximum lag of the pointer when the crank turns back. Cutting: central "
        "95 % range over Monte Carlo trials of cutting errors, without the ripple of perfect teeth.",
        "Days are the time in which the pointer turns through this angle at its mean speed. This is the error of the "
        "date of an eclipse, a conjunction or a station that is read from the pointer.",
    ]
    count = len(found.pointers)
    missing = [f"{cause} of {of}" for cause, of in found.not_declared.items() if of]
    summary.append(
        f"Not declared, and therefore not included (not counted as 0), of {count} pointers: {', '.join(missing)}."
        if missing
        else f"All causes are declared for all {count} pointers."
    )
    return Document(f"Error budget of each pointer: {name}", summary, list(_sections(found)))


def _sections(found: TrainBudget) -> Iterator[Section]:
    causes = [cause.name for cause in found.pointers[0].causes]
    sized = []
    for each in found.pointers:
        largest = each.ranking[0] if each.ranked and each.ranked[0].degrees else "-"
        sized.append((each.name, *(_degrees(cause) for cause in each.causes), f"{each.total:.3g}", largest))
    yield Section("Causes in degrees", (), (Table(("pointer", *causes, "sum", "maximum"), cut(sized)),))
    timed = [
        (each.name, _figure(each.degrees_per_day), *(_figure(cause.days) for cause in each.causes))
        for each in found.pointers
    ]
    yield Section("Causes in days", (), (Table(("pointer", "deg per day", *causes), cut(timed)),))
    yield _drifts(found)
    for pointer in found.pointers:
        yield _pointer(pointer)
    if found.reversing_drivers:
        names = ", ".join(found.reversing_drivers)
        text = f"Drivers that reverse temporarily; the effect of a reversal is not included in lost motion: {names}."
        yield Section("Pairs with reversing drivers", (text,))


def _degrees(cause: BudgetCause) -> str:
    if cause.degrees is None:
        return NOT_DECLARED
    return f"{cause.degrees:.3g}" + (" (part)" if cause.declared == "part" else "")


def _figure(value: float | None) -> str:
    return "-" if value is None else f"{value:.3g}"


def _drifts(found: TrainBudget) -> Section:
    rows = []
    for pointer in found.pointers:
        for drift in pointer.drifts:
            first = drift is pointer.drifts[0]
            each = (drift.degrees_per_turn, drift.degrees_per_year, drift.degrees_per_century, drift.degrees_over_span)
            after = _figure(pointer.overtaken_after_years) if first else ""
            rows.append((pointer.name, drift.target, ppm(drift.ppm), *map(_signed, each), after))
    header = ("pointer", "target", "ppm", "deg per turn", "deg per year", "deg per century", "deg over the span",
              "years to largest other")  # fmt: skip
    texts = (
        "Positive values are fast. The first target of each pointer is used for the budget; observed periods come "
        "before targets intended by the makers. The last column gives the Julian years after which the drift equals "
        "the largest other cause.",
    )
    return Section(
        "Ratios and targets",
        texts if rows else ("No target is declared.",),
        (Table(header, cut(rows)),) if rows else (),
    )


def _signed(value: float | None) -> str:
    return "-" if value is None else f"{value:+.4g}" if value else "0"


def _pointer(pointer: PointerBudget) -> Section:
    rows = [
        (
            str(at),
            cause.name,
            _degrees(cause),
            _figure(cause.rms),
            "" if cause.interval is None else f"{cause.interval[0]:.3g}..{cause.interval[1]:.3g}",
            _figure(cause.days),
            cause.note,
        )
        for at, cause in enumerate(pointer.ranked, 1)
    ]
    rows += [("-", cause.name, NOT_DECLARED, "-", "", "-", cause.note) for cause in pointer.undeclared]
    tables = [Table(("rank", "cause", "deg", "rms", "95 % interval", "days", "note"), rows)]
    if pointer.pairs:
        sizes = [(name, f"{size:.3g}") for name, size in pointer.pairs.items()]
        tables.append(Table(("single pair", "deg peak to peak"), cut(sizes, most=_PAIRS)))
    return Section(f"Ranked: {pointer.name}", (), tables)


# ---------------------------------------------------------------------------------------------------------------- chart

_MARKERS = ("D", "^", "o", "s", "v")
_SMALL = 1e-4
"""Minimum size, relative to the largest cause, of a cause that has a mark in the chart (smaller marks would stretch the
axis).
"""


def budget_figure(found: TrainBudget) -> Figure:
    """Draw one row for each pointer, with a mark for each cause of its error; the largest total error is on top."""
    from geartrain.drawing.style import MOST_ROWS, WHITE, interval_chart
    from geartrain.scene.palette import series_colour

    pointers = [found[name] for name in found.shown]
    ranked = sorted((each for each in pointers if each.total > 0), key=lambda each: -each.total)
    if not ranked:
        why = "no cause of any pointer's error is declared, or all are 0"
        what = f"the budget of '{found.name}' has nothing to draw"
        raise QuestionError(Problem(what, why, "declare targets of outputs, or `tooth_form` of pairs"))
    looks: dict[str, dict[str, Any]] = {
        cause: {"marker": marker, "markersize": 8, "color": series_colour(at), "markeredgewidth": 1.6}
        for at, (cause, marker) in enumerate(zip(CAUSES, _MARKERS, strict=True))
    }
    looks |= {_part(cause): {**look, "markersize": 11, "markerfacecolor": WHITE} for cause, look in looks.items()}
    days = any(pointer.degrees_per_day for pointer in ranked)
    smallest = _SMALL * max(cause.degrees or 0.0 for pointer in ranked for cause in pointer.ranked)
    rows = [_row(pointer, days, smallest) for pointer in ranked[:MOST_ROWS]]
    counts = {cause: sum(each.name == cause for pointer in pointers for each in pointer.undeclared) for cause in CAUSES}
    unknown = ", ".join(f"{cause} of {count}" for cause, count in counts.items() if count)
    label = "size of each cause (deg); open marks: declared in part"
    label += f"\nnot declared, of {len(pointers)} pointers: {unknown}" if unknown else ""
    name = found.name if found.state is None else f"{found.name}, {found.state}"
    return interval_chart(
        {label: rows}, looks, ("sum", *["days"] * days), f"{name}: causes of each pointer's error", log=True
    )


def _part(cause: str) -> str:
    return f"{cause}, in part"


def _row(pointer: PointerBudget, days: bool, smallest: float) -> Row:
    from geartrain.drawing.style import Row, figures

    known = [cause for cause in pointer.ranked if (cause.degrees or 0.0) >= smallest]
    marks = {_part(cause.name) if cause.declared == "part" else cause.name: cause.degrees or 0.0 for cause in known}
    spans = [cause.interval for cause in known if cause.interval is not None and cause.interval[0] > 0]
    per_day = pointer.degrees_per_day
    time = [figures(pointer.total / per_day) if per_day else "-"] * days
    return Row(pointer.name, marks, spans, (f"{figures(pointer.total)}°", *time))
