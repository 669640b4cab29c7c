"""Why there are no stages, or so few: where candidates went, the nearest miss, and what to relax."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction

from geartrain.errors import RangeError
from geartrain.numerics.exact import decimal
from geartrain.numerics.work import Execution
from geartrain.search.ratio.product_windows import MOST_STAGES, multisets, rounded_up
from geartrain.search.ratio.segment_sweep import SweepOutcome, nearest, tally, within
from geartrain.search.ratio.solution_order import Key
from geartrain.search.ratio.stage_problem import StageConstraints, StageProblem
from geartrain.search.search_outcome import Shortfall

OUTSIDE = "outside the tolerance"
SENSE = "the other sense of rotation"
_QUICK = 3 * 10**6  # products made to find out what one more stage would give


def tolerance_text(tolerance: Fraction) -> str:
    """A tolerance or an error in a few digits, never less than it is."""
    return decimal(rounded_up(tolerance), 6)


def account(question: StageProblem, considered: int, outcome: SweepOutcome) -> Mapping[str, int]:
    """Reason -> pairs of sets it removed; with the solutions they make all that were considered."""
    removed = {f"a count above {question.fit.largest}": considered - question.considered}
    known = dict(outcome.removed)
    if question.fit.reverted and not question.fit.internal:
        removed.update(tally(question))
    removed[OUTSIDE] = considered - sum(removed.values()) - sum(known.values()) - outcome.count
    for reason, number in known.items():
        removed[reason] = removed.get(reason, 0) + number
    return {reason: number for reason, number in removed.items() if number}


def explain(question: StageProblem, considered: int, outcome: SweepOutcome, sense: int, means: Execution) -> Shortfall:
    """The account, and for an empty outcome the nearest miss and what to relax."""
    if not outcome.complete:
        return Shortfall(considered, {}, advice="the search was cut short; take it up again, or narrow the counts")
    removed = account(question, considered, outcome)
    if outcome.count:
        return Shortfall(considered, removed)
    one, means = replace(question, by="error", best=1), replace(means, journal=None)
    try:
        miss = nearest(one, means)
        plain = miss if question.fit.free else nearest(replace(one, fit=StageConstraints()), means)
        advice = "; ".join(_advice(question, miss, removed, sense))
    except KeyboardInterrupt:  # the answer stands, only its explanation is cut short
        return Shortfall(considered, removed)
    return Shortfall(considered, removed, _nearest(question, miss, plain), advice)


def _nearest(question: StageProblem, miss: SweepOutcome, plain: SweepOutcome) -> str:
    """The best of all in words, and the best without conditions where that is another one."""
    parts = []
    if miss.keys and miss.complete:
        parts.append(in_words(miss.keys[0], question.value))
    elif miss.complete and not miss.note:
        parts.append("no counts satisfy the conditions, whatever the tolerance")
    if plain.keys and plain.complete and plain.keys[:1] != miss.keys[:1]:
        parts.append(f"without conditions {in_words(plain.keys[0], question.value)}")
    return "; ".join(parts)


def in_words(key: Key, value: Fraction) -> str:
    """Counts, ratio and error of one solution."""
    _, _, _, _, top, beneath = key
    ratio = Fraction(1)
    for a, b in zip(top, beneath, strict=True):
        ratio *= Fraction(a, b)
    counts = f"{' x '.join(map(str, top))} / {' x '.join(map(str, beneath))}"
    return f"{counts} = {decimal(ratio, 10)}, error {float(ratio / value - 1):+.3g}"


def _advice(question: StageProblem, miss: SweepOutcome, removed: Mapping[str, int], sense: int) -> Iterator[str]:
    """What to relax, most certain first."""
    if miss.keys and miss.complete:
        yield f"a tolerance of {tolerance_text(miss.keys[0][1])} gives a solution"
    for reason, number in removed.items():
        if reason not in (OUTSIDE, f"a count above {question.fit.largest}") and not question.fit.reverted:
            yield f"'{reason}' removed {number} within the tolerance: give it up"
    if question.stages < MOST_STAGES:
        yield from _one_more(question, sense)


def _one_more(question: StageProblem, sense: int) -> Iterator[str]:
    """What another stage would give, if that is quickly known."""
    size = question.stages + 1
    fit = replace(question.fit, internal=question.fit.internal + 1) if sense else question.fit
    ring = ", its mesh with a ring so that the sense stays," if sense else ""
    more = replace(question, stages=size, best=1, by="error", fit=fit)
    if max(multisets(len(counts), size) for counts in (question.top, question.beneath)) > _QUICK or not fit.free:
        yield f"try {size} stages"
        return
    try:
        count = within(more, Execution()).count
    except RangeError:
        return
    if count:
        yield f"one more stage{ring} gives {count} solutions"
