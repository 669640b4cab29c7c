"""Counts in doubt: all combinations taken together, or a sample of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import inf, prod
from typing import Any

from geartrain.errors import Problem, QuestionError, RangeError, suggest
from geartrain.numerics.work import Execution, Journal, run
from geartrain.synthesis.join.exact_join import BudgetSpentError
from geartrain.train import Train
from geartrain.uncertainty.posterior.inference_problem import InferenceProblem, build_inference_problem
from geartrain.uncertainty.posterior.joined_posterior import evidence_of, find_joined_posterior
from geartrain.uncertainty.posterior.observations import LikelihoodKind
from geartrain.uncertainty.posterior.posterior_result import CountProbability, Method, ToothCountPosterior
from geartrain.uncertainty.posterior.posterior_summary import (
    PosteriorSummary,
    rank_combinations,
    summary_of_sample,
)
from geartrain.uncertainty.posterior.priors import find_priors
from geartrain.uncertainty.posterior.sampled_posterior import (
    LikelihoodBatch,
    PosteriorTally,
    packed,
    sample_task,
)
from geartrain.uncertainty.posterior.variance_shares import find_variance_shares

LIMIT = 2_000_000
"""Steps that the exact way may take by default: some seconds."""
SAMPLES = 1_000_000
_ALONE = 200_000
_DRAWN = 1 << 16
_ENOUGH = 100
METHODS: tuple[Method, ...] = ("exact", "sample")
_FORMER: dict[str, Method] = {"enumerate": "exact", "decompose": "exact"}
"""What a method was called when combinations could also be listed one by one."""


def infer_counts(
    train: Train,
    state: str | None = None,
    *,
    free: Mapping[str, Sequence[int]] | None = None,
    outputs: Sequence[str] = (),
    tolerance: Fraction | None = None,
    against: LikelihoodKind = "all",
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
) -> ToothCountPosterior:
    """Which tooth counts fit what is known of a train's outputs, and how likely each is then.

    state      of a train with states; None: all of them at once
    free       wheel -> counts it may have, beside or in place of what is declared
    outputs    those that count as evidence; all without any
    tolerance  relative, for targets without one
    against    which claims count: "targets", "figures" (`expect` and `published`), or "all"
    scale      multiplies every tolerance
    soft       False: within its tolerances or not; True: Gaussian, the tolerances taken as standard deviations
    method     "exact": all combinations taken together; "sample"; None: the former where there are at most `limit`
               combinations or it takes at most `limit` steps, else the latter
    most       combinations to list
    limit      bounds the work of the exact way
    samples    combinations drawn otherwise
    seed       of the sample, and of variance shares that are not exact
    executor   None: in this process; see `geartrain.numerics.work.open_executor`. The answer does not depend on it
    journal    where finished work is kept, for a run that may be cut
    tell       called with (tasks done, tasks in all)

    Interrupted while it samples, it returns what is known, with `cut` True. Raises `QuestionError` for what
    cannot be asked, `RangeError` where the method asked for would pass the limit.
    """
    method = None if method is None else _FORMER.get(method, method)
    _check(method, most, limit, samples, seed)
    question = build_inference_problem(
        train,
        find_priors(train, free),
        state,
        outputs=outputs,
        tolerance=tolerance,
        against=against,
        scale=scale,
        soft=soft,
    )
    means = Execution(executor, journal, tell)
    chosen, found, cut = _find(question, method, most, limit, samples, seed, means)
    exact = found.evidence if chosen != "sample" else None
    shares = {
        name: find_variance_shares(name, formula, question.doubts, seed) for name, formula in question.outputs.items()
    }
    return ToothCountPosterior(
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
        rank_combinations(question, found.candidates, most, exact),
        found.ranked and chosen != "sample" and not cut,
        {name: one for name, one in shares.items() if one is not None},
        (*question.remarks, *_doubts_of_sample(found, chosen)),
        seed if chosen == "sample" else None,
        cut,
    )


def _doubts_of_sample(found: PosteriorSummary, method: Method) -> Iterator[str]:
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
    question: InferenceProblem,
    method: Method | None,
    most: int,
    limit: int,
    samples: int,
    seed: int,
    means: Execution,
) -> tuple[Method, PosteriorSummary, bool]:
    """The way asked for, or the first that stays within the limit."""
    if method != "sample":
        few = prod(len(doubt.counts) for doubt in question.moved.values()) <= limit
        try:
            return "exact", find_joined_posterior(question, most, inf if few else limit), False
        except BudgetSpentError:
            if method is not None:
                fix = "raise the limit, narrow the doubts, or let it sample"
                raise RangeError(Problem("too many steps", f"the limit is {limit}", fix)) from None
    return "sample", *_sampled(question, most, samples, seed, means)


def _sampled(
    question: InferenceProblem, most: int, samples: int, seed: int, means: Execution
) -> tuple[PosteriorSummary, bool]:
    """A sample; True if it was interrupted."""
    size = max(1 << 14, -(-samples // 1000))
    tasks = [[seed, at, min(size, samples - at * size)] for at in range(-(-samples // size))]
    tally, cut = PosteriorTally(LikelihoodBatch(question), most), False
    work = partial(sample_task, packed(question, most))
    results: Iterable[Any] = run(work, tasks, means.executor, means.journal, means.tell)
    try:
        for result in results:
            tally.join(result)
    except KeyboardInterrupt:
        cut = True
    return summary_of_sample(question, tally), cut


def _alone(question: InferenceProblem, seed: int) -> dict[str, CountProbability]:
    """What each output would tell by itself; of a sample where that is more than a little work."""
    found = {}
    for witness in question.witnesses:
        doubts = {wheel: question.doubts[wheel] for wheel in witness.formula.wheels}
        one = replace(question, doubts=doubts, witnesses=(witness,), conditions=())
        try:
            found[witness.name] = evidence_of(one, _ALONE)
        except BudgetSpentError:
            found[witness.name] = _sampled(one, 1, _DRAWN, seed, Execution())[0].evidence
    return found
