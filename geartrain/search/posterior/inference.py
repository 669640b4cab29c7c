"""The posterior of counts in doubt: by the exact join of all combinations, or from a sample of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import inf, prod
from typing import Any, NamedTuple

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError, suggest
from geartrain.numerics.work import Execution, Journal
from geartrain.search.join.exact_join import BudgetSpentError, ExactJoin
from geartrain.search.join.inside_outside import AssignmentSums, BestFirst, CountWeights, RecordedNode, record_join
from geartrain.search.join.join_plan import JoinProblem, SelectivitySample, find_join_problem
from geartrain.search.posterior.inference_problem import (
    InferenceProblem,
    LikelihoodKind,
    ToothCountPrior,
    build_inference_problem,
    find_priors,
)
from geartrain.search.posterior.posterior_result import CountProbability, Method, ToothCountPosterior
from geartrain.search.posterior.posterior_summary import (
    PosteriorSummary,
    correlations_of,
    find_variance_shares,
    first_with_ties,
    rank_combinations,
    summary_of_sample,
    wheel_posterior,
)
from geartrain.search.posterior.sampled_posterior import (
    LikelihoodBatch,
    PosteriorTally,
    misfit_of,
    packed,
    plain_number,
    sample_task,
)
from geartrain.train import Train

LIMIT = 2_000_000
"""Steps that the exact join may take by default: some seconds."""
SAMPLES = 1_000_000
_ALONE = 200_000  # steps for one output by itself: a fraction of a second
_DRAWN = 1 << 16  # combinations where that is too much, or where the exact join is interrupted
_ENOUGH = 100  # effective combinations: below, an interval is as wide as a tenth of what it is about
METHODS: tuple[Method, ...] = ("exact", "sample")
_NOTHING_YET = (
    "interrupted: the exact method knows nothing before its end, so the figures are of {} combinations drawn at "
    "random; the method `sample` draws as many as are wanted"
)
_LONG = 1 << 62  # products of total weights below this: every sum of weights is exact in int64


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
    """Bayes' theorem for tooth counts in doubt: which fit what is known of the outputs, and how likely each is then.

    Interrupted (Ctrl-C), it returns what is known, with `cut` True: of a sample what had been drawn. The exact join
    knows nothing before its end; of the combinations a short sample is drawn then, and a remark says so.

    Parameters
    ----------
    train : Train
        A declared train with wheels in doubt: `teeth: {value: 64, range: [63, 66]}`, `choices` or `search`.
    state : str, optional
        Of a train with states; None takes all of them at once.
    free : mapping of str to sequence of int, optional
        Wheel -> counts it may have, beside or in place of what is declared.
    outputs : sequence of str
        Those that count as evidence; default all.
    tolerance : Fraction, optional
        Relative, for targets without one, 0 or more.
    against : {"all", "targets", "figures"}
        Which claims count; figures are `expect` and `published`.
    scale : Fraction
        Multiplies every tolerance, 0 or more.
    soft : bool
        False: an output is within its tolerances or it is not. True: Gaussian, the tolerances taken as standard
        deviations.
    method : {"exact", "sample"}, optional
        By default exact where there are at most `limit` combinations or it takes at most `limit` steps.
    most : int
        Combinations to list, 1 or more.
    limit : int
        Bounds the work of the exact join, 1 or more.
    samples : int
        Combinations drawn otherwise, 1 or more.
    seed : int
        Of the sample, and of variance shares that are not exact; 0 or more.
    executor : Executor, optional
        By default in this process; see `geartrain.numerics.work.open_executor`. The answer does not depend on it.
    journal : Journal, optional
        Where finished work is kept, for a run that may be cut.
    tell : callable, optional
        Called with (tasks done, tasks in all).

    Returns
    -------
    ToothCountPosterior
        Evidence, posteriors by wheel, correlations, the best combinations.

    Raises
    ------
    QuestionError
        For what cannot be asked: no wheel in doubt, nothing known of an output, weights that are no probabilities.
    RangeError
        Where the exact method is asked for and would pass the limit, or a doubt is too wide to list.

    Notes
    -----
    p(counts | outputs) = p(counts) L(outputs | counts) / evidence. The prior p is that of independent wheels; the
    likelihood L is 1 or 0, or exp(-misfit / 2) where agreement is by degree; the evidence is the sum of their products
    (docs/counts-in-doubt.md). The exact join groups what no later output can tell apart, and sums in whole numbers.

    Examples
    --------
    A wheel of 60 to 62 teeth on a pinion of 20 turns 1/3 as fast, to 2 %: 60 and 61 fit, 62 is 3.2 % slow.

    >>> from fractions import Fraction
    >>> from geartrain.train import declare
    >>> train = declare({"links": {"frame": {}, "a": {"wheels": {"p": 20}},
    ...         "b": {"wheels": {"w": {"teeth": {"value": 60, "range": [60, 62]}}}}},
    ...     "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    ...     "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1},
    ...     "outputs": {"b": {"targets": [{"speed": "-1/3", "tolerance": "2 %"}]}}})
    >>> found = infer_counts(train)
    >>> found.evidence.value, [str(chance) for chance in found["w"].chances]
    (Fraction(2, 3), ['0.5', '0.5', '0'])
    """
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
    outcome = _find(question, method, most, limit, samples, seed, means)
    chosen, found, cut = outcome.method, outcome.found, outcome.cut
    exact = found.evidence if chosen != "sample" else None
    shares = {
        name: find_variance_shares(name, formula, question.doubts, seed) for name, formula in question.outputs.items()
    }
    return ToothCountPosterior(
        question.name,
        chosen,
        soft,
        question.combinations,
        found.examined,
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
        (*question.remarks, *outcome.remarks, *_doubts_of_sample(found, chosen)),
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
    for name, value, minimum in (("most", most, 1), ("limit", limit, 1), ("samples", samples, 1), ("seed", seed, 0)):
        if value < minimum:
            raise QuestionError(Problem(f"{name} is {value}", "nothing is found with it", f"give {minimum} or more"))


class _Outcome(NamedTuple):
    """What was found, by which method; `cut` if it was interrupted."""

    method: Method
    found: PosteriorSummary
    cut: bool = False
    remarks: tuple[str, ...] = ()


def _find(
    question: InferenceProblem,
    method: Method | None,
    most: int,
    limit: int,
    samples: int,
    seed: int,
    means: Execution,
) -> _Outcome:
    """By the method asked for, or the first that stays within the limit."""
    if method != "sample":
        few = prod(len(doubt.counts) for doubt in question.moved.values()) <= limit
        try:
            return _Outcome("exact", find_exact_posterior(question, most, inf if few else limit))
        except KeyboardInterrupt:
            # the exact join has no partial answer: a moment's sample says more than nothing, and it is not journalled,
            # since the exact join would begin anew
            found, _ = _sampled(question, most, min(samples, _DRAWN), seed, Execution())
            return _Outcome("sample", found, True, (_NOTHING_YET.format(found.examined),))
        except BudgetSpentError:
            if method is not None:
                fix = "raise the limit, narrow the doubts, or let it sample"
                raise RangeError(Problem("too many steps", f"the limit is {limit}", fix)) from None
    return _Outcome("sample", *_sampled(question, most, samples, seed, means))


def _sampled(
    question: InferenceProblem, most: int, samples: int, seed: int, means: Execution
) -> tuple[PosteriorSummary, bool]:
    """A sample; True if it was interrupted."""
    # at most 1000 tasks; from the samples alone, so that any number of workers draws the same
    size = max(1 << 14, -(-samples // 1000))
    tasks = [[seed, at, min(size, samples - at * size)] for at in range(-(-samples // size))]
    tally, cut = PosteriorTally(LikelihoodBatch(question), most), False
    work = partial(sample_task, packed(question, most))
    try:
        for result in means.run(work, tasks):
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


# ---------------------------------------------------------------- the weighted join of `search.join`, in whole numbers


def find_exact_posterior(question: InferenceProblem, most: int, limit: float) -> PosteriorSummary:
    """All that is asked, exactly. Raises `BudgetSpentError` where it takes more than `limit` steps.

    most   combinations to list
    """
    doubts = question.moved
    root, steps = _recorded(question, limit)
    sums = AssignmentSums(root, question.soft)
    weights = _weights(doubts, question.soft)
    share = plain_number(sums.total(weights))
    marginals = {wheel: own.tolist() for wheel, own in sums.marginals(weights).items()} if share else {}
    candidates, ranked = first_with_ties(iter(BestFirst(root, question.domains)), most) if share else ([], True)
    floats = _weights(doubts, True)
    return PosteriorSummary(
        steps,
        _probability(question, doubts, share),
        turning_of(question, limit),
        None if question.soft else _fits(question, sums),
        {
            wheel: wheel_posterior(doubt, marginals[wheel] if wheel in doubts and share else None, share, None)
            for wheel, doubt in question.doubts.items()
        },
        correlations_of(question, marginals, share, sums.covariances(floats, question.domains)) if share else {},
        candidates,
        ranked,
        float("inf"),
    )


def evidence_of(question: InferenceProblem, limit: float) -> CountProbability:
    """The share of the prior weight that fits. Raises `BudgetSpentError` where that takes more than `limit` steps."""
    doubts = question.moved
    if question.soft:
        root, _ = _recorded(question, limit)
        return _probability(question, doubts, float(AssignmentSums(root, True).total(_weights(doubts, True))))
    join = ExactJoin(_join_problem(question, graded=False), budget=limit)
    counted, _ = join.count(join.question.plan, join.start())
    return _probability(question, doubts, int(counted[0]))


def turning_of(question: InferenceProblem, limit: float) -> CountProbability:
    """The share of the prior weight with which the train turns, whatever its outputs do."""
    if not question.conditions:
        return CountProbability(Fraction(1))
    return evidence_of(replace(question, witnesses=(), soft=False), limit)


def _join_problem(question: InferenceProblem, graded: bool) -> JoinProblem:
    """What is to be joined: the witnesses first, then the conditions.

    graded   True: how well the witnesses agree is asked for too
    """
    doubts = question.moved
    domains = {wheel: doubt.counts for wheel, doubt in doubts.items()}
    requested = [*(one.constraint(question.soft, graded) for one in question.witnesses), *question.conditions]
    sample = SelectivitySample.of(domains)
    weights = {wheel: doubt.weights for wheel, doubt in doubts.items()}
    return find_join_problem(domains, requested, (), {one.name: sample.of_demand(one) for one in requested}, weights)


def _recorded(question: InferenceProblem, limit: float) -> tuple[RecordedNode, int]:
    misfits = {at: misfit_of(witness) for at, witness in enumerate(question.witnesses)}
    return record_join(_join_problem(question, graded=True), limit, misfits)


def _weights(doubts: Mapping[str, ToothCountPrior], soft: bool) -> CountWeights:
    """Prior weights as whole numbers, of a type that holds all their sums; or prior chances as floats."""
    if soft:
        return {wheel: np.array([float(prior) for prior in doubt.priors]) for wheel, doubt in doubts.items()}
    dtype: Any = np.int64 if prod(doubt.total for doubt in doubts.values()) < _LONG else object
    return {wheel: np.array(doubt.weights, dtype=dtype) for wheel, doubt in doubts.items()}


def _fits(question: InferenceProblem, sums: AssignmentSums) -> int:
    """How many combinations fit: the sum with every weight 1, times all counts of the wheels that nothing tells of."""
    alike = {w: replace(doubt, weights=(1,) * len(doubt.counts)) for w, doubt in question.moved.items()}
    idle = [doubt for wheel, doubt in question.doubts.items() if wheel not in alike]
    return int(sums.total(_weights(alike, False))) * prod(len(doubt.counts) for doubt in idle)


def _probability(
    question: InferenceProblem, doubts: Mapping[str, ToothCountPrior], share: int | float
) -> CountProbability:
    if question.soft:
        return CountProbability(float(share))
    return CountProbability(Fraction(int(share), prod(doubt.total for doubt in doubts.values())))


# ------------------------------------------------------------------------------------------------- two wheels at a time


Again = Callable[[Mapping[str, Sequence[int]]], ToothCountPosterior]
Pairs = dict[tuple[str, str], dict[tuple[int, int], float]]


def most_informative_wheels(found: ToothCountPosterior, most: int = 6) -> list[str]:
    """The wheels of which the outputs tell most, in the order declared; those with one count possible say nothing.

    Parameters
    ----------
    found : ToothCountPosterior
        What is known of the counts.
    most : int
        The maximum number of wheels.

    Returns
    -------
    list of str

    Examples
    --------
    >>> import geartrain
    >>> most_informative_wheels(infer_counts(geartrain.load("freeth-2008-doubt").declaration), 2)
    ['m3', 'n1']
    """
    heard = [wheel for wheel, each in found.posteriors.items() if not each.idle and len(each.doubt.counts) > 1]
    kept = set(sorted(heard, key=lambda wheel: -found[wheel].bits)[:most])
    return [wheel for wheel in heard if wheel in kept]


def joint_posterior(found: ToothCountPosterior, wheels: Sequence[str], again: Again) -> Pairs:
    """The joint posterior of every two of some wheels, by the chain rule p(a, b) = p(a) p(b | a).

    One more posterior is found for each count that is possible, of every wheel but the last.

    Parameters
    ----------
    found : ToothCountPosterior
        What is known of the counts.
    wheels : sequence of str
        In the order declared.
    again : callable
        Wheel -> counts to which it is held, to the posterior of the same train for the same evidence.

    Returns
    -------
    dict
        Two wheels -> their two counts -> probability, for `counts_figure`.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load("planetary-24-18-60").declaration
    >>> free = {"s": (23, 24), "ring": (58, 60)}
    >>> found = infer_counts(train, free=free)
    >>> joint_posterior(found, ["s", "ring"], lambda held: infer_counts(train, free=free | held))
    {('s', 'ring'): {(24, 60): 1.0}}
    """
    pairs: Pairs = {(a, b): {} for at, a in enumerate(wheels) for b in wheels[at + 1 :]}
    for at, wheel in enumerate(wheels[:-1]):
        for count, chance in zip(found[wheel].doubt.counts, found[wheel].chances, strict=False):
            if not float(chance):
                continue
            held = again({wheel: [count]})
            for other in wheels[at + 1 :]:
                after = held[other]
                for its, likely in zip(after.doubt.counts, after.chances, strict=False):
                    if float(likely):
                        pairs[wheel, other][count, its] = float(chance) * float(likely)
    return pairs
