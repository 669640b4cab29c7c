"""Posterior of uncertain tooth counts, by an exact join of all combinations or by sampling."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import inf, prod
from typing import Any

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError, suggest
from geartrain.numerics.work import Execution, Journal
from geartrain.search.join.exact_join import BudgetSpentError, ExactJoin
from geartrain.search.join.inside_outside import AssignmentSums, BestFirst, CountWeights, RecordedNode, record_join
from geartrain.search.join.join_plan import JoinProblem, find_join_problem
from geartrain.search.posterior.inference_problem import (
    InferenceProblem,
    LikelihoodKind,
    ToothCountPrior,
    build_inference_problem,
    find_priors,
    observation_constraint,
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
    plain_number,
    sample_task,
)
from geartrain.train import Train

LIMIT = 2_000_000
"""Default maximum number of steps of the exact join. This number of steps takes a few seconds."""
SAMPLES = 1_000_000
_SINGLE_OUTPUT_STEPS = 200_000  # maximum steps for a single output: a fraction of a second
_DRAWN = 1 << 16  # combinations if a single output takes longer, or if the exact join is interrupted
METHODS: tuple[Method, ...] = ("exact", "sample")
_NO_PARTIAL_RESULT = (
    "interrupted: the exact method has no partial result, so the values are estimated from {} combinations drawn at "
    "random; the method `sample` draws any number of them"
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
    """Compute the posterior of uncertain tooth counts, given the observed speeds of outputs.

    After an interruption (Ctrl-C), `cut` is True, and the result is based on the combinations sampled until then. An
    interrupted exact join is replaced by a short sample, which is reported in a remark.

    Parameters
    ----------
    train : Train
        Declared train with uncertain tooth counts: `teeth: {value: 64, range: [63, 66]}`, `choices` or `search`.
    state : str, optional
        Name of a state; by default the observations of all states are used together.
    free : mapping of str to sequence of int, optional
        Mapping from wheel to possible tooth counts, which replace the declared tooth counts.
    outputs : sequence of str
        Names of the outputs used as evidence; by default all outputs.
    tolerance : Fraction, optional
        Relative tolerance of targets without a declared tolerance, at least 0.
    against : {"all", "targets", "figures"}
        Kinds of observations to use; "figures" are the values under `expect` and `published`.
    scale : Fraction
        Factor by which every tolerance is multiplied, at least 0.
    soft : bool
        If False, the likelihood is 1 within all tolerances and 0 outside. If True, it is Gaussian with the tolerances
        as standard deviations.
    method : {"exact", "sample"}, optional
        Method of computation. By default "exact" if there are at most `limit` combinations, or if the exact join needs
        at most `limit` steps.
    most : int
        Number of combinations to list, at least 1.
    limit : int
        Maximum number of steps of the exact join, at least 1.
    samples : int
        Number of combinations in a sample, at least 1.
    seed : int
        Random seed of the sample, at least 0.
    executor : Executor, optional
        Executor of the tasks; by default they run in this process. See `geartrain.numerics.work.open_executor`. The
        executor does not change the result.
    journal : Journal, optional
        Journal of completed work, for a run that may be interrupted.
    tell : callable, optional
        Progress function, called with (number of completed tasks, total number of tasks).

    Returns
    -------
    ToothCountPosterior
        Evidence, posteriors of tooth counts, correlations, and the best combinations.

    Raises
    ------
    QuestionError
        If no tooth count is uncertain, if no output has an observed speed, or if weights are not probabilities.
    RangeError
        If the exact method is requested and exceeds the limit, or if a tooth count has too many possible values to
        list.

    Notes
    -----
    p(counts | outputs) = p(counts) L(outputs | counts) / evidence. The prior p treats wheels as independent. The
    likelihood L is 1 or 0, or exp(-misfit / 2) with `soft`. The evidence is the sum of the products of prior and
    likelihood (docs/which-counts.md). The exact join merges partial combinations that no later output distinguishes,
    and uses integer arithmetic.

    Examples
    --------
    A pinion of 20 teeth drives a wheel of 60 to 62 teeth at 1/3 of its speed, within 2 %. The wheel is 3.2 % too slow
    with 62 teeth:

    >>> from fractions import Fraction
    >>> from geartrain.train import declare
    >>> train = declare({"links": {"frame": {}, "a": {"wheels": {"p": 20}},
    ...         "b": {"wheels": {"w": {"teeth": {"value": 60, "range": [60, 62]}}}}},
    ...     "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    ...     "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1},
    ...     "outputs": {"b": {"targets": [{"speed": "-1/3", "tolerance": "2 %"}]}}})
    >>> found = infer_counts(train)
    >>> found.evidence.value, [str(probability) for probability in found["w"].probabilities]
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
    found = _summarise(question, method, most, limit, samples, seed, means)
    sampled = found.effective < inf
    shares = {
        name: find_variance_shares(name, formula, question.uncertainties) for name, formula in question.outputs.items()
    }
    return ToothCountPosterior(
        question.name,
        "sample" if sampled else "exact",
        soft,
        question.combinations,
        found.examined,
        found.evidence,
        found.turning,
        found.fits,
        question.witnesses,
        _single_output_evidence(question, seed),
        found.posteriors,
        found.correlations,
        rank_combinations(question, found.candidates, most, None if sampled else found.evidence),
        found.ranked and not sampled,
        {name: one for name, one in shares.items() if one is not None},
        (*question.remarks, *found.remarks),
        seed if sampled else None,
        found.cut,
    )


def _check(method: str | None, most: int, limit: int, samples: int, seed: int) -> None:
    if method is not None and method not in METHODS:
        what, why = f"'{method}' is not a method", "the methods are exact and sample"
        raise QuestionError(Problem(what, why, suggest(method, METHODS)))
    for name, value, minimum in (("most", most, 1), ("limit", limit, 1), ("samples", samples, 1), ("seed", seed, 0)):
        if value < minimum:
            what, why = f"{name} is {value}", f"{name} must be at least {minimum}"
            raise QuestionError(Problem(what, why, f"give {name} >= {minimum}"))


def _summarise(
    question: InferenceProblem,
    method: Method | None,
    most: int,
    limit: int,
    samples: int,
    seed: int,
    means: Execution,
) -> PosteriorSummary:
    """Return the posterior computed by the requested method. If `method` is None, the exact join is used, or sampling
    if the join exceeds the limit.
    """
    if method != "sample":
        few = prod(len(uncertainty.counts) for uncertainty in question.moved.values()) <= limit
        try:
            return find_exact_posterior(question, most, inf if few else limit)
        except KeyboardInterrupt:
            # an interrupted exact join has no partial result: a short sample is returned instead, without a journal,
            # because the exact join would begin again
            found = _sampled(question, most, min(samples, _DRAWN), seed, Execution())
            return replace(found, cut=True, remarks=(*found.remarks, _NO_PARTIAL_RESULT.format(found.examined)))
        except BudgetSpentError:
            if method is not None:
                what = f"the exact method needs more than {limit} steps"
                why = "`limit` bounds the number of partial combinations that the method examines"
                fix = "raise the limit, narrow the ranges of counts, or use the method `sample`"
                raise RangeError(Problem(what, why, fix)) from None
    return _sampled(question, most, samples, seed, means)


def _sampled(question: InferenceProblem, most: int, samples: int, seed: int, means: Execution) -> PosteriorSummary:
    """Return the posterior summary of a random sample of combinations."""
    # at most 1000 tasks, which depend only on the number of samples, so that any number of workers draws the same
    size = max(1 << 14, -(-samples // 1000))
    tasks = [[seed, at, min(size, samples - at * size)] for at in range(-(-samples // size))]
    tally, cut = PosteriorTally(LikelihoodBatch(question), most), False
    work = partial(sample_task, pickle.dumps((question, most)))
    try:
        for result in means.run(work, tasks):
            tally.join(result)
    except KeyboardInterrupt:
        cut = True
    return summary_of_sample(question, tally, cut)


def _single_output_evidence(question: InferenceProblem, seed: int) -> dict[str, CountProbability]:
    """Return the evidence of each output, computed from the observations of this output only. The evidence is estimated
    from a sample if the exact join would take too long.
    """
    found = {}
    for witness in question.witnesses:
        # other wheels do not change the evidence of this output
        uncertainties = {wheel: question.uncertainties[wheel] for wheel in witness.function.wheels}
        one = replace(question, uncertainties=uncertainties, witnesses=(witness,), conditions=())
        try:
            found[witness.name] = evidence_of(one, _SINGLE_OUTPUT_STEPS)
        except BudgetSpentError:
            found[witness.name] = _sampled(one, 1, _DRAWN, seed, Execution()).evidence
    return found


# ---------------------------------------------------------------------- the weighted join of `search.join`, in integers


def find_exact_posterior(question: InferenceProblem, most: int, limit: float) -> PosteriorSummary:
    """Return the exact posterior of the tooth counts, computed by a join. `BudgetSpentError` is raised if the join
    examines more than `limit` partial combinations.

    most   maximum number of combinations to list
    """
    # other wheels keep their prior
    uncertainties = question.moved
    root, steps = _recorded(question, limit)
    sums = AssignmentSums(root, question.soft)
    weights = _weights(uncertainties, question.soft)
    share = plain_number(sums.total(weights))
    marginals = {wheel: own.tolist() for wheel, own in sums.marginals(weights).items()} if share else {}
    candidates, ranked = first_with_ties(iter(BestFirst(root, question.domains)), most) if share else ([], True)
    # covariances use weights relative to the mean, which are not integers
    floats = _weights(uncertainties, True)
    turning = CountProbability(Fraction(1))
    if question.conditions:
        turning = evidence_of(replace(question, witnesses=(), soft=False), limit)
    return PosteriorSummary(
        steps,
        _probability(question, share),
        turning,
        None if question.soft else _fits(question, sums),
        {
            wheel: wheel_posterior(
                uncertainty, marginals[wheel] if wheel in uncertainties and share else None, share, None
            )
            for wheel, uncertainty in question.uncertainties.items()
        },
        correlations_of(question, marginals, share, sums.covariances(floats, question.domains)) if share else {},
        candidates,
        ranked,
    )


def evidence_of(question: InferenceProblem, limit: float) -> CountProbability:
    """Return the evidence of the observations, which is the prior mean of the likelihood. `BudgetSpentError` is raised
    if the join examines more than `limit` partial combinations.
    """
    if question.soft:
        root, _ = _recorded(question, limit)
        return _probability(question, float(AssignmentSums(root, True).total(_weights(question.moved, True))))
    join = ExactJoin(_join_problem(question, graded=False), budget=limit)
    counted, _ = join.count(join.question.plan, join.start())
    return _probability(question, int(counted[0]))


def _join_problem(question: InferenceProblem, graded: bool) -> JoinProblem:
    """Return the join problem with the constraints of the observed outputs, followed by the conditions for the train to
    turn.

    graded   True if the join must also compute the misfits of the outputs
    """
    uncertainties = question.moved
    domains = {wheel: uncertainty.counts for wheel, uncertainty in uncertainties.items()}
    requested = [
        *(observation_constraint(one, question.soft, graded) for one in question.witnesses),
        *question.conditions,
    ]
    weights = {wheel: uncertainty.weights for wheel, uncertainty in uncertainties.items()}
    return find_join_problem(domains, requested, (), weights)


def _recorded(question: InferenceProblem, limit: float) -> tuple[RecordedNode, int]:
    misfits = {at: misfit_of(witness) for at, witness in enumerate(question.witnesses)}
    return record_join(_join_problem(question, graded=True), limit, misfits)


def _weights(uncertainties: Mapping[str, ToothCountPrior], soft: bool) -> CountWeights:
    """Return the prior weights of the tooth counts: floats if `soft` is True, or integers of a type that holds all
    their sums.
    """
    if soft:
        return {wheel: np.array([*map(float, prior.priors)]) for wheel, prior in uncertainties.items()}
    dtype: Any = np.int64 if prod(uncertainty.total for uncertainty in uncertainties.values()) < _LONG else object
    return {wheel: np.array(uncertainty.weights, dtype=dtype) for wheel, uncertainty in uncertainties.items()}


def _fits(question: InferenceProblem, sums: AssignmentSums) -> int:
    """Return the number of combinations that satisfy all observations. The combinations include all possible tooth
    counts of wheels on which no observation depends.
    """
    # with equal weights the total weight is a number of combinations
    alike = {wheel: replace(prior, weights=(1,) * len(prior.counts)) for wheel, prior in question.moved.items()}
    # wheels that no observation depends on multiply the number
    idle = prod(len(prior.counts) for wheel, prior in question.uncertainties.items() if wheel not in alike)
    return int(sums.total(_weights(alike, False))) * idle


def _probability(question: InferenceProblem, share: int | float) -> CountProbability:
    if question.soft:
        return CountProbability(float(share))
    return CountProbability(Fraction(int(share), prod(uncertainty.total for uncertainty in question.moved.values())))


# ------------------------------------------------------------------------------------------------------ pairs of wheels


Again = Callable[[Mapping[str, Sequence[int]]], ToothCountPosterior]
Pairs = dict[tuple[str, str], dict[tuple[int, int], float]]


def most_informative_wheels(found: ToothCountPosterior, most: int = 6) -> list[str]:
    """Return the names of the wheels about whose tooth counts the outputs give the most information, in the order of
    declaration.

    Wheels with one possible tooth count, and wheels on which no output depends, are omitted.

    Parameters
    ----------
    found : ToothCountPosterior
        Posterior of the tooth counts.
    most : int
        Maximum number of wheels.

    Returns
    -------
    list of str

    Examples
    --------
    >>> import geartrain
    >>> most_informative_wheels(infer_counts(geartrain.load("freeth-2008-doubt").declaration), 2)
    ['m3', 'n1']
    """
    informed = [wheel for wheel, each in found.posteriors.items() if not each.idle and len(each.uncertainty.counts) > 1]
    kept = set(sorted(informed, key=lambda wheel: -found[wheel].bits)[:most])
    return [wheel for wheel in informed if wheel in kept]


def joint_posterior(found: ToothCountPosterior, wheels: Sequence[str], again: Again) -> Pairs:
    """Compute the joint posterior of each pair of wheels, by the chain rule p(a, b) = p(a) p(b | a).

    For every wheel except the last, one further posterior is computed for each tooth count with a non-zero probability.

    Parameters
    ----------
    found : ToothCountPosterior
        Posterior of the tooth counts.
    wheels : sequence of str
        Names of the wheels in the order of declaration.
    again : callable
        Function of a mapping from wheel to fixed tooth counts, which returns the posterior of the same train for the
        same evidence.

    Returns
    -------
    dict
        Probability of each pair of tooth counts, for each pair of wheels, as required by `counts_figure`.

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
        # if nothing fits the observations, `probabilities` is empty
        for count, probability in zip(found[wheel].uncertainty.counts, found[wheel].probabilities, strict=False):
            if not float(probability):
                continue
            held = again({wheel: [count]})
            for other in wheels[at + 1 :]:
                after = held[other]
                for its, likely in zip(after.uncertainty.counts, after.probabilities, strict=False):
                    if float(likely):
                        pairs[wheel, other][count, its] = float(probability) * float(likely)
    return pairs
