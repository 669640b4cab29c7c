"""Trains drawn at random, each with the chance of its weight among all explanations."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from random import Random

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import whole_multiple
from geartrain.numerics.weighted_alternatives import draw_index
from geartrain.synthesis.reconstruction.candidate_prior import skeleton_prior, weight_ranks
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.reconstruction_result import Candidate, Reconstructions
from geartrain.synthesis.reconstruction.skeleton_trains import SkeletonTrains


def draw_candidates(
    found: Reconstructions, problem: ReconstructionProblem, dials: Sequence[str], number: int, seed: int
) -> tuple[Candidate, ...]:
    """Draw candidates independently of each other; one may come several times.

    Parameters
    ----------
    found : Reconstructions
        All explanations of the question.
    problem : ReconstructionProblem
    dials : sequence of str
        In the order of the evidence.
    number : int
        How many are drawn, from 0 on.
    seed : int
        The same seed draws the same trains.

    Raises
    ------
    QuestionError
        If trains are weighed one by one, by measured sizes or by class.
    """
    if not found.skeletons:
        if not sum(each.mechanisms for each in found.counts):
            return ()
        what = "no trains can be drawn where each is weighed by itself"
        fix = "list them instead (--all), or ask without measured sizes and with `--per mechanism`"
        raise QuestionError(Problem(what, "they are drawn from sums over trains that weigh the same", fix))
    weights = [skeleton_prior(each.skeleton, problem) for each in found.skeletons]
    whole = whole_multiple(weights)
    shares = [weight * each.mechanisms for weight, each in zip(whole, found.skeletons, strict=True)]
    ranks = weight_ranks((weight, each.mechanisms) for weight, each in zip(weights, found.skeletons, strict=True))
    trains, chance = SkeletonTrains(problem, dials), Random(seed)
    drawn = []
    for _ in range(number):
        at = draw_index(shares, chance)
        skeleton, weight = found.skeletons[at].skeleton, weights[at]
        share = float(Fraction(whole[at], sum(shares)))
        drawn.append(Candidate(trains.draw(skeleton, chance), skeleton.added.number, share, ranks[weight]))
    return tuple(drawn)
