"""One ratio by one to five stages of gear pairs: every solution within a tolerance, or the best, proved.

A train of k stages has the ratio P / Q, P and Q products of k counts each. For every product Q beneath, those P on top
that are within the tolerance are a window of a sorted list: sorted products answer what trying all pairs would, at the
cost of sorting. Where a window ends is decided in integers. Products are made in segments of value, which bounds the
memory and makes independent pieces of work: four stages of 200 counts (69 million sets a side) stay below 0.2 GB, five
(2800 million) below 0.4 GB; conditions and other orders stay below 0.5 GB.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from fractions import Fraction
from math import prod
from typing import ClassVar, Literal

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.exact import decimal, plural
from geartrain.numerics.results import Key, Result, Tabular
from geartrain.numerics.work import Execution, Journal
from geartrain.search.ratio.gear_pair_search import count_pairs, find_pairs
from geartrain.search.ratio.product_windows import MOST_STAGES, check_memory, multisets, rounded_up
from geartrain.search.ratio.segment_sweep import SweepOutcome, nearest, tally, within
from geartrain.search.ratio.stage_problem import StageConstraints, StageProblem, StageRank, best_pairing, check_order
from geartrain.search.search_outcome import GearStages, Shortfall
from geartrain.search.target_ratio import TargetRatio
from geartrain.search.tooth_count_ranges import CountRuns, Counts

OUTSIDE = "outside the tolerance"
SENSE = "the other sense of rotation"
DEFAULT_TOLERANCE = Fraction(1, 10**6)
_FAR = 10**12  # times beyond all ratios of the counts
_LONG = 100_000  # counts of a wheel beyond which single pairs come from the tree of fractions, not from tables
_QUICK = 3 * 10**6  # products made to find out what one more stage would give


@dataclass(frozen=True, slots=True)
class StageFindings(Tabular, Result):
    """Solutions of one ratio by stages: pairs of unordered sets of counts. A sequence of its `solutions`.

    See Also
    --------
    find_stages : gives it.
    """

    ROWS = "search.tooth_numbers_report:stage_rows"
    MEANINGS: ClassVar = {
        "top": "Tooth counts on top.",
        "beneath": "Tooth counts beneath.",
        "ratio": "Product of the counts on top over that of those beneath [1].",
        "value": "The ratio as a float [1].",
        "error": "Ratio over the wanted ratio, less 1 [1].",
        "stages": "The stages as they are best paired.",
        "total": "Sum of all tooth counts.",
        "largest": "Largest tooth count.",
        "distinct": "Number of different tooth counts.",
    }

    PAGE = "search.tooth_numbers_report:describe_stages"

    KEYS = (
        "wanted",
        "stages",
        Key("top", "top_runs"),
        Key("beneath", "beneath_runs"),
        "fit",
        Key("order", "by"),
        Key("tolerance", to=float),
        "complete",
        "count",
        "considered",
        "solutions",
        "shortfall",
        "note",
        "ended",
    )

    wanted: TargetRatio
    """The ratio."""
    stages: int
    """Number of stages."""
    top: Sequence[int]
    """Admissible counts on top, ascending."""
    beneath: Sequence[int]
    """Admissible counts beneath, ascending."""
    fit: StageConstraints
    """Conditions on the counts."""
    by: str
    """The order of `solutions`."""
    tolerance: Fraction | None
    """The greatest |error|, as a fraction of the ratio: the one asked for, or one that proves the list; None where
    the best pairs of long ranges were found without any."""
    complete: bool
    """True if everything within the tolerance was looked at; False if the search was interrupted."""
    count: int | None
    """Number of solutions within the tolerance, exact if `complete`; None without a tolerance."""
    solutions: tuple[GearStages, ...]
    """The best of them."""
    shortfall: Shortfall
    """Where the other pairs of sets went."""
    note: str = ""
    """What was assumed, in words; empty if nothing."""

    def _summary(self) -> str:
        best = f", best {self.solutions[0]._summary()}" if self.solutions else ""
        return (
            f"{self.wanted.label or self.wanted.value}: {len(self.solutions)} solutions in {self.stages} stages{best}"
        )

    @property
    def ended(self) -> Literal["whole", "interrupted"]:
        """Whether the search was whole."""
        return "whole" if self.complete else "interrupted"

    @property
    def considered(self) -> int:
        """Number of pairs of unordered sets that the admissible counts make."""
        return self.shortfall.considered

    @property
    def top_runs(self) -> str:
        """The counts that may stand on top, as they are asked for: `15:60`."""
        return str(CountRuns.of(self.top)) if self.top else ""

    @property
    def beneath_runs(self) -> str:
        """The counts that may stand beneath."""
        return str(CountRuns.of(self.beneath)) if self.beneath else ""

    def __len__(self) -> int:
        return len(self.solutions)

    def __iter__(self) -> Iterator[GearStages]:
        return iter(self.solutions)

    def __getitem__(self, at: int) -> GearStages:
        return self.solutions[at]


def find_stages(
    wanted: TargetRatio,
    stages: int,
    wheels: Counts,
    pinions: Counts,
    *,
    tolerance: Fraction | None = None,
    best: int = 20,
    by: str = "error",
    fit: StageConstraints | None = None,
    executor: Executor | None = None,
    journal: Journal | None = None,
    tell: Callable[[int, int], None] | None = None,
) -> StageFindings:
    """Solutions of a ratio by stages of gear pairs, counted, and the best of them: meet in the middle.

    Every product of counts beneath finds its window in the sorted products on top; where a window ends is decided in
    integers. The answer is complete.

    Parameters
    ----------
    wanted : TargetRatio
        The ratio, teeth on top over teeth beneath. Its sense, if it asks for one, must be that of so many external and
        internal meshes.
    stages : int
        Gear pairs one after the other, 1 to 5.
    wheels, pinions : sequence of int
        Admissible counts: of a ratio of 1 or more those on top and those beneath, of one below 1 the other way round.
    tolerance : Fraction, optional
        Greatest |error| as a fraction of the ratio, 0 or more. Without it the order by error finds and proves the best,
        within a tolerance that holds enough of them; other orders take 1e-6, and `note` says so.
    best : int
        How many to list, 1 or more.
    by : {"error", "total", "largest", "distinct", "hunting", "centres"}
        What comes first: least |error|, fewest teeth together, least largest count, fewest different counts, most
        stages with coprime counts, fewest centre distances. Ties: least |error|, then sum, largest, and the counts.
    fit : StageConstraints, optional
        Conditions on the counts.
    executor : concurrent.futures.Executor, optional
        Where independent pieces of a large search run; default here. The answer does not depend on it.
    journal : Journal, optional
        Where finished pieces are kept, for a run that may be cut.
    tell : callable, optional
        Called with (pieces done, pieces in all).

    Returns
    -------
    StageFindings
        With `complete` False if an interrupt from the keyboard ended the search early.

    Raises
    ------
    QuestionError
        For a question that makes no sense.
    RangeError
        For counts whose tables would not fit in memory (more than some 400 counts for four stages and more), and for a
        ratio far out of reach.

    Examples
    --------
    The 13.368 turns of the Moon in a year, 254/19, by two stages:

    >>> from geartrain.search import (read_counts, read_ratio)
    >>> counts = read_counts("15:130")
    >>> found = find_stages(read_ratio("254/19"), 2, counts, counts, tolerance=Fraction(0), best=1)
    >>> found.count, found[0].pairs, found.complete
    (76, ((30, 19), (127, 15)), True)
    """
    fit = fit or StageConstraints()
    larger, smaller = CountRuns.of(wheels), CountRuns.of(pinions)
    plain = by == "error" and fit == StageConstraints() and wanted.sense <= 0
    if stages == 1 and plain and max(len(larger), len(smaller)) > _LONG:
        return _long_ranges(wanted, larger, smaller, tolerance, best)
    question, considered, note = _question(wanted, stages, (wheels, pinions), tolerance, best, by, fit)
    if wanted.sense and wanted.sense != fit.sense(stages):
        return _findings(wanted, question, SweepOutcome(question.tolerance), _wrong_sense(question, considered), note)
    if not (question.top and question.beneath):
        return _findings(wanted, question, SweepOutcome(question.tolerance), _too_large(question, considered), note)
    _check_reach(question)
    means = Execution(executor, journal, tell)
    open_ended = tolerance is None and by == "error"
    try:
        outcome = nearest(question, means) if open_ended else within(question, means)
    except KeyboardInterrupt:
        outcome = SweepOutcome(question.tolerance, complete=False)
    shortfall = explain(question, considered, outcome, wanted.sense, means)
    return _findings(wanted, question, outcome, shortfall, note or outcome.note)


def _long_ranges(
    wanted: TargetRatio, wheels: CountRuns, pinions: CountRuns, tolerance: Fraction | None, best: int
) -> StageFindings:
    """Single pairs of long ranges, found without a list of the counts."""
    solutions = find_pairs(wanted, wheels, pinions, tolerance, best)
    count = None if tolerance is None else count_pairs(wanted, wheels, pinions, tolerance)
    top, beneath = (wheels, pinions) if wanted.value >= 1 else (pinions, wheels)
    considered = len(top) * len(beneath)
    shortfall = Shortfall(considered, {} if count is None else {OUTSIDE: considered - count})
    fit = StageConstraints()
    return StageFindings(wanted, 1, top, beneath, fit, "error", tolerance, True, count, solutions, shortfall)


def _question(
    wanted: TargetRatio,
    stages: int,
    counts: tuple[Counts, Counts],
    tolerance: Fraction | None,
    best: int,
    by: str,
    fit: StageConstraints,
) -> tuple[StageProblem, int, str]:
    """The question in plain data, the number of pairs of sets, and what is assumed."""
    check_order(by)
    if not 1 <= stages <= MOST_STAGES:
        raise _refused(f"{stages} stages are asked for", f"1 to {MOST_STAGES} can be searched", "take fewer stages")
    if best < 1:
        raise _refused(f"the best {best} are asked for", "that is no list", "ask for 1 or more")
    if tolerance is not None and tolerance < 0:
        raise _refused(f"the tolerance is {tolerance}", "no error is less than 0", "give 0 or more, such as 1e-6")
    fit.check(stages)
    given = [tuple(CountRuns.of(each).as_array().tolist()) for each in counts]
    top, beneath = given if wanted.value >= 1 else given[::-1]
    considered = multisets(len(top), stages) * multisets(len(beneath), stages)
    if fit.largest is not None:
        top, beneath = (tuple(count for count in each if count <= fit.largest) for each in (top, beneath))
    note = ""
    if tolerance is None and by != "error":
        note = f"no tolerance was given, and the order by {by} needs one: it is 1e-6"
    used = DEFAULT_TOLERANCE if tolerance is None else Fraction(tolerance)
    return StageProblem(wanted.value, stages, top, beneath, fit, by, best, used), considered, note


def _findings(
    wanted: TargetRatio, question: StageProblem, outcome: SweepOutcome, shortfall: Shortfall, note: str
) -> StageFindings:
    return StageFindings(
        wanted,
        question.stages,
        question.top,
        question.beneath,
        question.fit,
        question.by,
        outcome.tolerance,
        outcome.complete,
        outcome.count,
        tuple(_stages(key, question) for key in outcome.keys),
        shortfall,
        note,
    )


def _stages(key: StageRank, question: StageProblem) -> GearStages:
    """One solution, paired."""
    top, beneath = key[4:]
    ratio = Fraction(prod(top), prod(beneath))
    pairs = best_pairing(top, beneath, question.fit, centres=question.by == "centres")
    assert pairs is not None  # the search lists only what can be paired
    return GearStages(top, beneath, ratio, ratio / question.value - 1, pairs)


def _wrong_sense(question: StageProblem, considered: int) -> Shortfall:
    """No train of so many external meshes turns that way."""
    stages, internal = question.stages, question.fit.internal
    rings = internal + 1 if internal < stages else internal - 1
    has = "the same sense as" if question.fit.sense(stages) > 0 else "the opposite sense to"
    return Shortfall(
        considered,
        {SENSE: considered},
        f"{plural(stages, 'stage')}, {internal} with a ring: the output has {has} the input, whatever the counts",
        f"add an idler, or a stage (stages={stages + 1}), or make a mesh internal (internal={rings})",
    )


def _too_large(question: StageProblem, considered: int) -> Shortfall:
    largest = question.fit.largest
    reason = f"a count above {largest}"
    return Shortfall(considered, {reason: considered}, "no count is left", f"let largest be more than {largest}")


def _check_reach(question: StageProblem) -> None:
    """`RangeError` for products that would not fit in memory, or a ratio that is far beyond all of them."""
    for counts in (question.top, question.beneath):
        check_memory(counts, question.stages, question.plain_integers)
    low, high = question.reach
    if not low / _FAR < question.value < high * _FAR:
        made = f"{question.stages} stages of these counts make {decimal(low, 3)} to {decimal(high, 3)}"
        raise RangeError(
            Problem(
                f"a ratio of {decimal(question.value, 3)} is far out of reach",
                made,
                "take more stages, or a wider range of counts",
            )
        )


def _refused(what: str, why: str, fix: str) -> QuestionError:
    return QuestionError(Problem(what, why, fix))


# --------------------------------------------- why there are no stages, or so few: what was nearest, and what to relax


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


def in_words(key: StageRank, value: Fraction) -> str:
    """Counts, ratio and error of one solution."""
    top, beneath = key[4:]
    ratio = Fraction(prod(top), prod(beneath))
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
