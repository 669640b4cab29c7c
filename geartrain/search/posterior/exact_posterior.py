"""Counts in doubt by the exact join of `search.join`: all combinations at once, weighed by their priors.

Nothing is listed that an output refuses, and what no later output can tell apart is one. Exact in whole numbers, or to
rounding where agreement is a matter of degree.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from math import prod
from typing import Any

import numpy as np

from geartrain.search.join.exact_join import ExactJoin
from geartrain.search.join.inside_outside import AssignmentSums, BestFirst, CountWeights, RecordedNode, record_join
from geartrain.search.join.join_plan import JoinProblem, SelectivitySample, find_join_problem
from geartrain.search.posterior.inference_problem import InferenceProblem
from geartrain.search.posterior.likelihood import misfit_of
from geartrain.search.posterior.posterior_result import CountProbability
from geartrain.search.posterior.posterior_summary import (
    PosteriorSummary,
    correlations_of,
    first_with_ties,
    wheel_posterior,
)
from geartrain.search.posterior.priors import ToothCountPrior
from geartrain.search.posterior.sampled_posterior import plain_number

_LONG = 1 << 62  # products of total weights below this: every sum of weights is exact in int64


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
    asked = [*(one.constraint(question.soft, graded) for one in question.witnesses), *question.conditions]
    sample = SelectivitySample.of(domains)
    weights = {wheel: doubt.weights for wheel, doubt in doubts.items()}
    return find_join_problem(domains, asked, (), {one.name: sample.of_demand(one) for one in asked}, weights)


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
