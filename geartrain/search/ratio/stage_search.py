"""Search for tooth counts of one to five gear stages with a given ratio: all solutions within a tolerance, or solutions
that are proved to be the best.

A train of k stages has the ratio P / Q, where P and Q are products of k tooth counts each. For every denominator
product Q, the numerator products P within the tolerance are a contiguous range of a sorted list (meet in the middle).
Products are generated for segments of their value, which limits the memory and gives independent tasks. With 200
admissible tooth counts, four stages (69 million multisets) need less than 0.2 GB, and five less than 0.5 GB.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from fractions import Fraction
from math import prod
from typing import Any, ClassVar, Literal, get_args

from geartrain.errors import Problem, QuestionError, RangeError, suggest
from geartrain.numerics.exact import decimal, plural
from geartrain.numerics.results import Key, Result, Tabular
from geartrain.numerics.work import Execution, Journal
from geartrain.search.ratio.product_windows import MOST_STAGES, check_products, multisets, rounded_up
from geartrain.search.ratio.search_segments import SweepOutcome, solve
from geartrain.search.ratio.stage_problem import StageConstraints, StageOrder, StageProblem, StageRank, best_pairing
from geartrain.search.search_outcome import GearStages, Shortfall
from geartrain.search.target_ratio import TargetRatio
from geartrain.search.tooth_count_ranges import CountRuns, Counts

OUTSIDE = "outside the tolerance"
SENSE = "opposite sense of rotation"
DEFAULT_TOLERANCE = Fraction(1, 10**6)
_FAR = 10**12  # factor beyond the ratios of all counts
_QUICK = 3 * 10**6  # maximum number of products for the suggestion of one more stage


@dataclass(frozen=True, slots=True)
class StageFindings(Tabular, Result):
    """Results of a search for gear pairs in series with a given ratio; each solution is a pair of multisets of tooth
    counts (numerator, denominator).

    See Also
    --------
    find_stages : Search for gear trains in stages with a given ratio.
    """

    ROWS = "search.tooth_numbers_report:stage_rows"
    MEANINGS: ClassVar = {
        "top": "Tooth counts of the numerator.",
        "beneath": "Tooth counts of the denominator.",
        "ratio": "Product of the numerator counts divided by product of the denominator counts [1].",
        "value": "Ratio as a float [1].",
        "error": "Ratio divided by the requested ratio, minus 1 [1].",
        "stages": "Stages of the best pairing.",
        "total": "Sum of all tooth counts.",
        "largest": "Largest tooth count.",
        "distinct": "Number of distinct tooth counts.",
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
    """Requested ratio."""
    stages: int
    """Number of stages."""
    top: Sequence[int]
    """Admissible tooth counts in the numerator of the ratio, in ascending order."""
    beneath: Sequence[int]
    """Admissible tooth counts in the denominator of the ratio, in ascending order."""
    fit: StageConstraints
    """Constraints on the tooth counts."""
    by: str
    """Name of the criterion by which `solutions` are sorted."""
    tolerance: Fraction
    """Maximum absolute relative error: the requested tolerance, or the tolerance within which the list of the best
    solutions is proved to be complete.
    """
    complete: bool
    """True if all candidates within the tolerance were examined; False if the search was interrupted."""
    count: int
    """Number of solutions within the tolerance. It is exact if `complete` is True."""
    solutions: tuple[GearStages, ...]
    """Best solutions, in the order given by `by`."""
    shortfall: Shortfall
    """Number of rejected pairs of multisets for each reason."""
    note: str = ""
    """Assumption that the search added to the request, or reason why the list is shorter than requested; empty if there
    is neither.
    """

    def _summary(self) -> str:
        best = f", best {self.solutions[0]._summary()}" if self.solutions else ""
        return (
            f"{self.wanted.label or self.wanted.value}: {len(self.solutions)} solutions in {self.stages} stages{best}"
        )

    @property
    def ended(self) -> Literal["whole", "interrupted"]:
        """Outcome of the search: "whole" if it was completed, "interrupted" if it was not."""
        return "whole" if self.complete else "interrupted"

    @property
    def considered(self) -> int:
        """Number of pairs of multisets of admissible tooth counts."""
        return self.shortfall.considered

    @property
    def top_runs(self) -> str:
        """Admissible tooth counts in the numerator as text, in which consecutive integers are abbreviated, such as
        `15:60`.
        """
        return str(CountRuns.of(self.top)) if self.top else ""

    @property
    def beneath_runs(self) -> str:
        """Admissible tooth counts in the denominator as text, in which consecutive integers are abbreviated, such as
        `15:60`.
        """
        return str(CountRuns.of(self.beneath)) if self.beneath else ""

    def __len__(self) -> int:
        return len(self.solutions)

    def __iter__(self) -> Iterator[GearStages]:
        return iter(self.solutions)

    def __getitem__(self, at: int) -> GearStages:
        return self.solutions[at]


def stages_to_train(found: GearStages, internal: int = 0) -> dict[str, Any]:
    """Return a declaration of a solution as plain data. The numerator wheels are the driving wheels, so the exact ratio
    is output speed divided by input speed.

    internal   number of internal pairs, which are the last pairs; the larger wheel of such a pair is a ring
    """
    stages = len(found.pairs)
    links: dict[str, Any] = {"frame": {}, **{f"arbor {at}": {"wheels": {}} for at in range(1, stages + 2)}}
    for at, pair in enumerate(found.pairs, 1):
        for arbor, wheel, teeth in ((at, f"{at}a", pair[0]), (at + 1, f"{at}b", pair[1])):
            ring = at > stages - internal and teeth == max(pair)
            links[f"arbor {arbor}"]["wheels"][wheel] = {"teeth": teeth, "internal": True} if ring else teeth
    arbors = list(links)[1:]
    speed = found.ratio if (stages - internal) % 2 == 0 else -found.ratio
    return {
        "name": f"stages-{found.ratio.numerator}-{found.ratio.denominator}",
        "links": links,
        "revolutes": [{"pair": ["frame", arbor], "axis": arbor} for arbor in arbors],
        "gears": [{"pair": [f"{at}a", f"{at}b"]} for at in range(1, stages + 1)],
        "inputs": {arbors[0]: 1},
        "outputs": {arbors[-1]: {"expect": str(speed)}},
    }


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
    """Find and count all gear pairs in series that give a ratio, and list the best solutions, by a meet-in-the-middle
    search.

    For every product of denominator counts, the range of numerator products within the tolerance is located in a sorted
    list. The ends of the ranges are determined by integer arithmetic, and the search is exhaustive.

    Parameters
    ----------
    wanted : TargetRatio
        Requested ratio, numerator divided by denominator. If it has a sense of rotation, the sense must agree with the
        numbers of external and internal meshes.
    stages : int
        Number of gear pairs in series, 1 to 5.
    wheels, pinions : sequence of int
        Admissible tooth counts. If the ratio is 1 or more, `wheels` applies to the numerator and `pinions` to the
        denominator; if it is below 1, vice versa.
    tolerance : Fraction, optional
        Maximum absolute relative error, 0 or more. If None and the order is "error", the search increases the tolerance
        until it includes enough solutions, so that the listed solutions are proved to be the best. If None and the
        order is another one, the tolerance is 1e-6, which is reported in `note`.
    best : int
        Maximum number of solutions to list, 1 or more.
    by : {"error", "total", "largest", "distinct", "hunting", "centres"}
        Primary criterion: minimum absolute error, minimum sum of tooth counts, minimum largest tooth count, minimum
        number of distinct tooth counts, maximum number of stages with coprime tooth counts, or minimum number of centre
        distances. Ties are broken by absolute error, sum of tooth counts, largest tooth count, and the tooth counts.
    fit : StageConstraints, optional
        Constraints on the tooth counts.
    executor : concurrent.futures.Executor, optional
        Executor of the independent tasks of a large search; by default they run in this process. The executor does not
        change the result.
    journal : Journal, optional
        Journal of finished tasks, with which an interrupted run can be resumed.
    tell : callable, optional
        Progress function, called with (tasks done, total tasks).

    Returns
    -------
    StageFindings
        Solutions and their number. `complete` is False if a keyboard interrupt ended the search early.

    Raises
    ------
    QuestionError
        If an argument is invalid.
    RangeError
        If the tables of products would not fit in memory (more than about 400 counts for four or more stages), if too
        many candidates must be tested one by one, or if the admissible tooth counts cannot approximate the ratio.

    Examples
    --------
    The 13.368 revolutions of the Moon in a year, 254/19, with two stages:

    >>> from geartrain.search import (read_counts, read_ratio)
    >>> counts = read_counts("15:130")
    >>> found = find_stages(read_ratio("254/19"), 2, counts, counts, tolerance=Fraction(0), best=1)
    >>> found.count, found[0].pairs, found.complete
    (76, ((30, 19), (127, 15)), True)
    """
    fit = fit or StageConstraints()
    question, note = _question(wanted, stages, (wheels, pinions), tolerance, best, by, fit)
    if wanted.sense and wanted.sense != fit.sense(stages):
        return _findings(wanted, question, SweepOutcome(question.tolerance), _wrong_sense(question), note)
    _check_reach(question)
    means = Execution(executor, journal, tell)
    try:
        outcome = solve(question, None if tolerance is None and by == "error" else question.tolerance, means)
    except KeyboardInterrupt:
        outcome = SweepOutcome(question.tolerance, complete=False)
    shortfall = explain(question, outcome, wanted.sense, means)
    return _findings(wanted, question, outcome, shortfall, note or outcome.note)


def _question(
    wanted: TargetRatio,
    stages: int,
    counts: tuple[Counts, Counts],
    tolerance: Fraction | None,
    best: int,
    by: str,
    fit: StageConstraints,
) -> tuple[StageProblem, str]:
    """Return the search problem and a note. If the order of the solutions requires a tolerance and none is given, the
    note reports the tolerance that is used; otherwise it is empty.
    """
    for valid, what, why, fix in (
        (
            by in get_args(StageOrder),
            f"solutions cannot be sorted by '{by}'",
            "no such criterion is computed for a solution",
            suggest(str(by), get_args(StageOrder)),
        ),
        (
            1 <= stages <= MOST_STAGES,
            f"stages is {stages}",
            f"1 to {MOST_STAGES} gear pairs in series are supported",
            f"give stages from 1 to {MOST_STAGES}",
        ),
        (best >= 1, f"best is {best}", "a list has at least one solution", "give best >= 1"),
        (
            tolerance is None or tolerance >= 0,
            f"the tolerance is {tolerance}",
            "a tolerance must not be negative",
            "give 0 or more, such as 1e-6",
        ),
    ):
        if not valid:
            raise QuestionError(Problem(what, why, fix))
    fit.check(stages)
    given = [tuple(CountRuns.of(each).as_array().tolist()) for each in counts]
    top, beneath = given if wanted.value >= 1 else given[::-1]
    note = ""
    if tolerance is None and by != "error":
        note = f"the order by {by} needs a tolerance, and 1e-6 was used"
    used = DEFAULT_TOLERANCE if tolerance is None else Fraction(tolerance)
    return StageProblem(wanted.value, stages, top, beneath, fit, by, best, used), note


def _findings(
    wanted: TargetRatio, question: StageProblem, outcome: SweepOutcome, shortfall: Shortfall, note: str
) -> StageFindings:
    solutions = []
    for *_, top, beneath in outcome.keys:
        ratio = Fraction(prod(top), prod(beneath))
        pairs = best_pairing(top, beneath, question.fit, centres=question.by == "centres")
        assert pairs is not None  # the search lists only solutions with a feasible pairing
        solutions.append(GearStages(top, beneath, ratio, ratio / question.value - 1, pairs))
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
        tuple(solutions),
        shortfall,
        note,
    )


def _wrong_sense(question: StageProblem) -> Shortfall:
    """Return the shortfall of a search in which every candidate is rejected, because the numbers of external and
    internal meshes give the wrong sense of rotation. It contains suggestions of changes.
    """
    stages, internal = question.stages, question.fit.internal
    # one more or one less internal mesh reverses the sense
    rings = internal + 1 if internal < stages else internal - 1
    has = "the same sense as" if question.fit.sense(stages) > 0 else "the opposite sense to"
    return Shortfall(
        question.considered,
        {SENSE: question.considered},
        f"with {plural(stages, 'stage')}, {internal} of them internal, the output has {has} the input for all counts",
        f"add an idler, or a stage (stages={stages + 1}), or make a mesh internal (internal={rings})",
    )


def _check_reach(question: StageProblem) -> None:
    """Raise `RangeError` if products are too large, if their tables would not fit in memory, or if the ratio is far
    from all ratios that are possible with the admissible tooth counts.
    """
    for counts in (question.top, question.beneath):
        check_products(counts, question.stages)
    low, high = question.reach
    if not low / _FAR < question.value < high * _FAR:
        made = f"ratios of {question.stages} stages with these counts are from {decimal(low, 3)} to {decimal(high, 3)}"
        raise RangeError(
            Problem(
                f"a ratio of {decimal(question.value, 3)} cannot be approximated",
                made,
                "use more stages, or a wider range of counts",
            )
        )


# ------------------------------------- explanation of short results: closest rejected candidate, constraints to relax


def explain(question: StageProblem, outcome: SweepOutcome, sense: int, means: Execution) -> Shortfall:
    """Return the number of rejected pairs of multisets for each reason. If there is no solution, the result also
    contains the closest rejected candidate and suggestions.
    """
    if not outcome.complete:
        return Shortfall(
            question.considered, {}, advice="the search was interrupted; resume it, or narrow the range of counts"
        )
    # the sum of these numbers and of the number of solutions is the number of candidates
    removed = {
        "no pairing with equal centre distances": question.considered - question.candidates,
        OUTSIDE: question.candidates - sum(outcome.removed.values()) - outcome.count,
        **outcome.removed,
    }
    removed = {reason: number for reason, number in removed.items() if number}
    if outcome.count:
        return Shortfall(question.considered, removed)
    # the journal belongs to the search itself, not to its explanation
    one, means = replace(question, by="error", best=1), replace(means, journal=None)
    try:
        miss = solve(one, None, means)
        plain = miss if question.fit.free else solve(replace(one, fit=StageConstraints()), None, means)
        advice = "; ".join(_advice(question, miss, removed, sense))
    except KeyboardInterrupt:  # the result is complete, only its explanation is interrupted
        return Shortfall(question.considered, removed)
    return Shortfall(question.considered, removed, _nearest(question, miss, plain), advice)


def _nearest(question: StageProblem, miss: SweepOutcome, plain: SweepOutcome) -> str:
    """Describe the rejected solution that is nearest to the requested ratio. The best solution without constraints is
    described too if it differs.

    miss    result of the search for the solution with the smallest error that satisfies the constraints
    plain   result of the search for the solution with the smallest error without constraints
    """
    parts = []
    if miss.keys and miss.complete:
        parts.append(in_words(miss.keys[0], question.value))
    elif miss.complete and not miss.note:
        parts.append("no counts satisfy the constraints at any tolerance")
    if plain.keys and plain.complete and plain.keys[:1] != miss.keys[:1]:
        parts.append(f"without constraints {in_words(plain.keys[0], question.value)}")
    return "; ".join(parts)


def in_words(key: StageRank, value: Fraction) -> str:
    """Format the tooth counts of one solution, their ratio, and the error of this ratio with respect to the requested
    ratio `value`.
    """
    top, beneath = key[4:]
    ratio = Fraction(prod(top), prod(beneath))
    counts = f"{' x '.join(map(str, top))} / {' x '.join(map(str, beneath))}"
    return f"{counts} = {decimal(ratio, 10)}, error {float(ratio / value - 1):+.3g}"


def _advice(question: StageProblem, miss: SweepOutcome, removed: Mapping[str, int], sense: int) -> Iterator[str]:
    """Yield suggestions of which constraints to relax, in descending order of the certainty that the suggestion gives a
    solution.
    """
    if miss.keys and miss.complete:
        yield f"a tolerance of {decimal(rounded_up(miss.keys[0][1]), 6)} gives a solution"
    for reason, number in removed.items():
        if reason != OUTSIDE:
            yield f"relax the constraint that rejected {number} candidates within the tolerance ({reason})"
    if question.stages < MOST_STAGES:
        yield from _one_more(question, sense)


def _one_more(question: StageProblem, sense: int) -> Iterator[str]:
    """Yield the suggestion to search with one more stage, if there are solutions with one more stage. The suggestion
    contains the number of these solutions unless counting them would be slow.
    """
    size = question.stages + 1
    # one more external stage would reverse the required sense
    fit = replace(question.fit, internal=question.fit.internal + 1) if sense else question.fit
    ring = " with an internal mesh, which keeps the sense," if sense else ""
    more = replace(question, stages=size, best=1, by="error", fit=fit)
    if max(multisets(len(counts), size) for counts in (question.top, question.beneath)) > _QUICK or not fit.free:
        yield f"try {size} stages"
        return
    try:
        count = solve(more, more.tolerance, Execution()).count
    except RangeError:
        return
    if count:
        yield f"one more stage{ring} gives {count} solutions"
