"""Counts in doubt: every combination looked at, one by one, all at once, or by a sample."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from math import prod
from typing import Any

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.parallel import Journal, run
from geartrain.train import Train, suggest
from geartrain.uncertainty.counts.batch import Batch
from geartrain.uncertainty.counts.decomposing import TooManyError, decompose
from geartrain.uncertainty.counts.doubts import find_doubts
from geartrain.uncertainty.counts.evidence import Kind
from geartrain.uncertainty.counts.found import Found, of_sums, of_tally, posterior
from geartrain.uncertainty.counts.question import Question, ask
from geartrain.uncertainty.counts.ranking import gather, rank, together
from geartrain.uncertainty.counts.result import Chance, CountSweep, Method
from geartrain.uncertainty.counts.shares import find_shares
from geartrain.uncertainty.counts.summing import Best, Sums
from geartrain.uncertainty.counts.tallying import Tally, enumerate_task, grid_of, packed, sample_task

LIMIT = 2_000_000
"""Combinations that are listed one by one, and transitions of a decomposition, by default: some seconds."""
SAMPLES = 1_000_000
_TASKS = 64
_ALONE = 200_000
_DRAWN = 1 << 16
_ENOUGH = 100
METHODS: tuple[Method, ...] = ("enumerate", "decompose", "sample")


@dataclass(frozen=True, slots=True)
class Means:
    """Who does the work, what is kept of it, and who is told."""

    executor: Executor | None = None
    journal: Journal | None = None
    tell: Callable[[int, int], None] | None = None


def sweep(
    train: Train,
    state: str | None = None,
    *,
    free: Mapping[str, Sequence[int]] | None = None,
    outputs: Sequence[str] = (),
    tolerance: Fraction | None = None,
    against: Kind = "all",
    scale: Fraction = Fraction(1),
    soft: bool = False,
    method: Method | None = None,
    most: int = 20,
    limit: int = LIMIT,
    samples: int = SAMPLES,
    seed: int = 1,
    executor: Executor | None = None,
    journal: Journal | None = None,
    tell: Callable[[int, int], None] | None = None,
) -> CountSweep:
    """Which tooth counts fit what is known of a train's outputs, and how likely each is then.

    state      of a train with states; None: all of them at once
    free       wheel -> counts it may have, beside or in place of what is declared
    outputs    those that count as evidence; all without any
    tolerance  relative, for targets without one
    against    which claims count: "targets", "figures" (`expect` and `published`), or "all"
    scale      multiplies every tolerance
    soft       False: within its tolerances or not; True: Gaussian, the tolerances taken as standard deviations
    method     None: "enumerate" where there are at most `limit` combinations, else "decompose" with at most `limit`
               transitions, else "sample"
    most       combinations to list
    limit      bounds the work of the first two ways; both are exact
    samples    combinations drawn in the third
    seed       of the sample, and of variance shares that are not exact
    executor   None: in this process; see `geartrain.parallel.open_executor`. The answer does not depend on it
    journal    where finished work is kept, for a run that may be cut
    tell       called with (tasks done, tasks in all)

    Interrupted while it lists or samples, it returns what is known, with `cut` True. Raises `QuestionError` for what
    cannot be asked, `RangeError` where the method asked for would pass the limit.
    """
    _check(method, most, limit, samples, seed)
    question = ask(
        train,
        find_doubts(train, free),
        state,
        outputs=outputs,
        tolerance=tolerance,
        against=against,
        scale=scale,
        soft=soft,
    )
    means = Means(executor, journal, tell)
    chosen, found, cut = _find(question, method, most, limit, samples, seed, means)
    exact = found.evidence if chosen != "sample" else None
    shares = {name: find_shares(name, formula, question.doubts, seed) for name, formula in question.outputs.items()}
    return CountSweep(
        question.name,
        chosen,
        soft,
        question.combinations,
        found.looked,
        found.evidence,
        found.turning,
        found.fits,
        question.witnesses,
        _alone(question, seed),
        found.posteriors,
        found.correlations,
        rank(question, found.candidates, most, exact),
        found.ranked and chosen != "sample" and not cut,
        {name: one for name, one in shares.items() if one is not None},
        (*question.remarks, *_doubts_of_sample(found, chosen)),
        seed if chosen == "sample" else None,
        cut,
    )


def _doubts_of_sample(found: Found, method: Method) -> Iterator[str]:
    """A remark where so little of a sample fits that its figures say nothing."""
    if method == "sample" and found.effective < _ENOUGH:
        yield (
            f"the figures rest on {found.effective:.3g} combinations that fit: draw more, raise the limit so that "
            "nothing need be drawn, or narrow the doubts"
        )


def _check(method: str | None, most: int, limit: int, samples: int, seed: int) -> None:
    if method is not None and method not in METHODS:
        raise QuestionError(Problem(f"there is no method '{method}'", "others are", suggest(method, METHODS)))
    for name, value, least in (("most", most, 1), ("limit", limit, 1), ("samples", samples, 1), ("seed", seed, 0)):
        if value < least:
            raise QuestionError(Problem(f"{name} is {value}", "nothing is found with it", f"give {least} or more"))


def _find(
    question: Question, method: Method | None, most: int, limit: int, samples: int, seed: int, means: Means
) -> tuple[Method, Found, bool]:
    """The way asked for, or the first that stays within the limit."""
    listed = prod(len(question.doubts[wheel].counts) for wheel in Batch(question).wheels)
    if method == "enumerate" and listed > limit:
        raise _passed(f"{listed} combinations to list", limit, "decompose")
    if method == "enumerate" or (method is None and listed <= limit):
        return "enumerate", *_enumerated(question, most, means)
    if method != "sample":
        try:
            return "decompose", _decomposed(question, most, limit), False
        except TooManyError:
            if method is not None:
                raise _passed("too many rows", limit, "sample") from None
    return "sample", *_sampled(question, most, samples, seed, means)


def _passed(what: str, limit: int, other: str) -> RangeError:
    why = f"the limit is {limit}"
    return RangeError(Problem(what, why, f"raise the limit, narrow the doubts, or let it {other}"))


def _enumerated(question: Question, most: int, means: Means) -> tuple[Found, bool]:
    runs = grid_of(question).runs
    step = max(1, -(-runs // _TASKS))
    tasks = [[at, min(at + step, runs)] for at in range(0, runs, step)]
    tally, cut = _added(question, most, enumerate_task, tasks, means)
    return of_tally(question, tally, drawn=False), cut


def _sampled(question: Question, most: int, samples: int, seed: int, means: Means) -> tuple[Found, bool]:
    size = max(1 << 14, -(-samples // 1000))
    tasks = [[seed, at, min(size, samples - at * size)] for at in range(-(-samples // size))]
    tally, cut = _added(question, most, sample_task, tasks, means)
    return of_tally(question, tally, drawn=True), cut


def _added(
    question: Question, most: int, work: Callable[[bytes, Any], dict[str, Any]], tasks: Sequence[Any], means: Means
) -> tuple[Tally, bool]:
    """The sum of all tasks; True if it was interrupted."""
    tally = Tally(Batch(question), most)
    results: Iterable[Any] = run(
        partial(work, packed(question, most)), tasks, means.executor, means.journal, means.tell
    )
    try:
        for result in results:
            tally.join(result)
    except KeyboardInterrupt:
        return tally, True
    return tally, False


def _decomposed(question: Question, most: int, limit: int) -> Found:
    parts = decompose(question, limit)
    sums = [Sums(part, question.doubts, question.soft) for part in parts]
    moved = [one for one in sums if any(step.wheel in Batch(question).wheels for step in one.part.steps)]
    share: Any = prod((one.evidence for one in moved), start=1.0 if question.soft else 1)
    total = prod(one.total for one in moved)
    evidence = Chance(float(share)) if question.soft else Chance(Fraction(int(share), total))
    posteriors = {}
    for one in sums:
        for wheel, weights in one.posteriors.items():
            idle = one not in moved
            posteriors[wheel] = posterior(
                question.doubts[wheel], None if idle else weights, one.evidence if share else 0, None
            )
    lists = [gather(iter(Best(one.part, question.doubts)), most) for one in moved]
    return Found(
        sum(len(step.choices) for part in parts for step in part.steps),
        evidence,
        _turning(question, limit),
        None if question.soft else _count(question, sums),
        {wheel: posteriors[wheel] for wheel in question.doubts},
        of_sums(question, moved) if share else {},
        together([some for some, _ in lists], most) if share else (),
        all(whole for _, whole in lists),
        float("inf"),
    )


def _count(question: Question, sums: Sequence[Sums]) -> int:
    """How many combinations fit: the same sums with every weight 1."""
    alike = {w: replace(doubt, weights=(1,) * len(doubt.counts)) for w, doubt in question.doubts.items()}
    return prod(int(Sums(one.part, alike, False).evidence) for one in sums)


def _turning(question: Question, limit: int) -> Chance:
    """The share of the prior weight with which the train turns, whatever its outputs do."""
    if not question.conditions:
        return Chance(Fraction(1))
    return _evidence(replace(question, witnesses=(), soft=False), limit)


def _evidence(question: Question, limit: int) -> Chance:
    sums = [Sums(part, question.doubts, question.soft) for part in decompose(question, limit)]
    if question.soft:
        return Chance(float(prod(float(one.evidence) for one in sums)))
    return Chance(Fraction(prod(int(one.evidence) for one in sums), prod(one.total for one in sums)))


def _alone(question: Question, seed: int) -> dict[str, Chance]:
    """What each output would tell by itself; of a sample where that is more than a little work."""
    found = {}
    for witness in question.witnesses:
        doubts = {wheel: question.doubts[wheel] for wheel in witness.formula.wheels}
        one = replace(question, doubts=doubts, witnesses=(witness,), conditions=())
        try:
            found[witness.name] = _evidence(one, _ALONE)
        except TooManyError:
            found[witness.name] = _sampled(one, 1, _DRAWN, seed, Means())[0].evidence
    return found
