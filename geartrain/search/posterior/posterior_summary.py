"""Results common to both methods of inference (exact join and sampling): evidence, correlations, best combinations, and
Sobol indices.

The order of the best combinations does not depend on rounding errors or on the method.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import exp, isqrt, prod, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.kinematics.formulas import Formula
from geartrain.numerics.arrays import Floats
from geartrain.numerics.confidence_intervals import DEVIATIONS, wilson
from geartrain.numerics.exact import as_float
from geartrain.numerics.graphs import joined_groups
from geartrain.search.join.inside_outside import GradedAssignment
from geartrain.search.posterior.inference_problem import InferenceProblem, ToothCountPrior
from geartrain.search.posterior.posterior_result import (
    CountCombination,
    CountProbability,
    VarianceShares,
    WheelPosterior,
)
from geartrain.search.posterior.sampled_posterior import KEPT, TIE, PosteriorTally, origin_of, plain_number

_LISTED = 2_000_000  # maximum number of combinations that are enumerated for a variance
_ENOUGH = 100  # effective sample size, below which a 95 % interval is wider than a fifth of the value
_CERTAIN = 1e-4
"""Ratio of the standard deviation of a tooth count to its range, below which the tooth count is treated as certain and
has no correlations.

Below this ratio, values that differ from the mean by the whole range have a total probability below 1e-8, and
covariances in float64 would be rounding errors.
"""

_NONE = 1e-13
"""Magnitude below which a correlation is considered a rounding error and is reported as 0."""


def first_with_ties(candidates: Iterator[GradedAssignment], most: int) -> tuple[list[GradedAssignment], bool]:
    """Return the first `most` candidates in ascending order of misfit, followed by all candidates whose misfit equals
    that of the last of them up to rounding errors. The second result is False if some of these equal candidates are
    omitted.
    """
    # misfits in floats: entries that may be tied with the last are later sorted exactly
    found: list[GradedAssignment] = []
    for candidate in candidates:
        if len(found) >= most and candidate.misfit > found[most - 1].misfit * TIE:
            return found, True
        if len(found) >= max(most, KEPT):
            return found, False
        found.append(candidate)
    return found, True


def rank_combinations(
    question: InferenceProblem, candidates: Iterable[GradedAssignment], most: int, evidence: CountProbability | None
) -> tuple[CountCombination, ...]:
    """Return the `most` best combinations of tooth counts, sorted exactly by misfit, then by prior weight (highest
    first), then by the number of changed tooth counts.

    evidence   evidence of all observations; None if it is not known, in which case no probabilities are computed
    """
    made = [_combination(question, candidate.teeth, evidence) for candidate in candidates]
    # exact misfits, then integers: the order does not depend on the method of search
    made.sort(key=lambda one: (one.misfit, -question.weight(one.teeth), len(one.changed), tuple(one.teeth.values())))
    return tuple(made[:most])


def _combination(
    question: InferenceProblem, teeth: Mapping[str, int], evidence: CountProbability | None
) -> CountCombination:
    ordered = {wheel: teeth[wheel] for wheel in question.uncertainties if wheel in teeth}
    speeds: dict[str, Fraction] = {}
    errors: dict[str, Fraction] = {}
    misfit = Fraction(0)
    for witness in question.witnesses:
        speed = witness.function.value(ordered)
        assert speed is not None, "what fits has a speed"
        speeds[witness.name] = speed
        claim = max(witness.demands, key=lambda one: one.misfit(speed))
        errors[witness.name] = claim.error(speed)
        misfit += witness.misfit(speed)
    changed = tuple(wheel for wheel, count in ordered.items() if count != question.uncertainties[wheel].declared)
    probability = None
    if evidence is not None and evidence.value:
        prior = Fraction(question.weight(ordered), prod(question.uncertainties[wheel].total for wheel in ordered))
        joint = float(prior) * exp(-float(misfit) / 2) if question.soft else prior
        probability = CountProbability(joint / evidence.value)
    return CountCombination(ordered, speeds, errors, misfit, probability, changed)


@dataclass(frozen=True, slots=True)
class PosteriorSummary:
    """Evidence, posteriors, correlations and best combinations, computed by the exact join or from a sample. The fields
    are those of `ToothCountPosterior`.
    """

    examined: int
    evidence: CountProbability
    turning: CountProbability
    fits: int | None
    posteriors: Mapping[str, WheelPosterior]
    correlations: Mapping[tuple[str, str], float]
    candidates: Sequence[GradedAssignment]
    ranked: bool
    effective: float = float("inf")
    """Effective sample size by Kish's formula; infinite for the exact method."""
    cut: bool = False
    """True if the computation was interrupted."""
    remarks: tuple[str, ...] = ()
    """Remarks on the method of computation."""


def summary_of_sample(question: InferenceProblem, tally: PosteriorTally, cut: bool) -> PosteriorSummary:
    """Return the summary of a sample of combinations. `cut` is True if the sampling was interrupted."""
    wheels = tally.batch.wheels
    candidates = [
        GradedAssignment(misfit, {w: tally.batch.domains[w][index] for w, index in zip(wheels, at, strict=True)})
        for misfit, at in tally.best
    ]
    by = dict(zip(wheels, tally.by, strict=True))
    # Kish's effective sample size: the number of hits of equal weight with the same variance
    trials = tally.weight**2 / tally.square if tally.square else None
    posteriors = {
        wheel: wheel_posterior(uncertainty, by.get(wheel), tally.weight, trials)
        for wheel, uncertainty in question.uncertainties.items()
    }
    effective = trials or 0.0
    few = (
        f"the values are estimated from only {effective:.3g} combinations that fit: increase --samples, "
        "raise --limit to use the exact method, or narrow the ranges of counts"
    )
    turning = CountProbability(Fraction(1))
    if question.conditions:
        share = tally.turning / tally.examined if tally.examined else 0.0
        turning = CountProbability(share, *wilson(tally.turning, tally.examined))
    return PosteriorSummary(
        tally.examined,
        _share(question, tally),
        turning,
        None,
        posteriors,
        _sample_correlations(question, tally),
        candidates,
        tally.ranked,
        effective,
        cut,
        (few,) if effective < _ENOUGH else (),
    )


def _share(question: InferenceProblem, tally: PosteriorTally) -> CountProbability:
    """Return the evidence estimated from a sample, with its 95 % confidence interval: a Wilson score interval for
    likelihoods of 0 or 1, and a normal-approximation interval for a Gaussian likelihood.
    """
    if not tally.examined:
        return CountProbability(0.0, 0.0, 1.0)
    mean = tally.weight / tally.examined
    if not question.soft or not tally.weight:
        return CountProbability(mean, *wilson(tally.weight, tally.examined))
    # rounding may make a variance negative
    half = DEVIATIONS * sqrt(max(tally.square / tally.examined - mean**2, 0.0) / tally.examined)
    return CountProbability(mean, max(0.0, mean - half), min(1.0, mean + half))


def wheel_posterior(
    uncertainty: ToothCountPrior, weights: Sequence[Any] | None, total: Any, trials: float | None
) -> WheelPosterior:
    """Return the posterior of the tooth count of one wheel.

    weights   posterior weight of each tooth count; None if no observed output depends on the wheel
    total     sum of the weights
    trials    effective number of sampled combinations; None if the weights are not from a sample
    """
    found: Iterable[CountProbability] = ()
    if total and weights is None:
        found = map(CountProbability, uncertainty.priors)
    elif total and weights is not None and trials is None and not isinstance(total, float | np.floating):
        found = (CountProbability(Fraction(int(weight), int(total))) for weight in weights)
    elif total and weights is not None:
        shares = (float(weight) / float(total) for weight in weights)
        found = (CountProbability(share, *(wilson(share * trials, trials) if trials else ())) for share in shares)
    return WheelPosterior(uncertainty, tuple(found), weights is None)


def _sample_correlations(question: InferenceProblem, tally: PosteriorTally) -> dict[tuple[str, str], float]:
    """Return the posterior correlation of each pair of wheels, from the weighted sums of products of their tooth counts
    in a sample.
    """
    if not tally.weight:
        return {}
    wheels = tally.batch.wheels
    means, spreads = _moments(question, dict(zip(wheels, tally.by, strict=True)), tally.weight)
    # E[(x - a)(y - b)] - (E[x] - a)(E[y] - b) loses fewer digits than E[xy] - E[x] E[y] if a and b are probable counts
    off = [means[wheel] - origin_of(question.uncertainties[wheel]) for wheel in wheels]
    found = {}
    for i, first in enumerate(wheels):
        for j, second in enumerate(wheels[i + 1 :], i + 1):
            found[first, second] = float(tally.sizes[i, j]) / float(tally.weight) - off[i] * off[j]
    return _correlated(found, spreads)


def correlations_of(
    question: InferenceProblem,
    marginals: Mapping[str, Sequence[Any]],
    total: Any,
    covariances: Mapping[tuple[str, str], float],
) -> dict[tuple[str, str], float]:
    """Return the correlations of the tooth counts of pairs of wheels, computed from covariances. Only pairs connected
    by outputs or conditions are included.
    """
    scopes = [
        *(one.function.wheels for one in question.witnesses),
        *(one.function.wheels for one in question.conditions),
    ]
    group = {wheel: at for at, wheels in enumerate(joined_groups(marginals, scopes)) for wheel in wheels}
    _, spreads = _moments(question, marginals, total)
    return _correlated(
        {pair: value for pair, value in covariances.items() if group[pair[0]] == group[pair[1]]}, spreads
    )


def _moments(
    question: InferenceProblem, by: Mapping[str, Sequence[Any]], total: Any
) -> tuple[dict[str, float], dict[str, float]]:
    """Return the posterior mean and the posterior standard deviation of each tooth count, keyed by wheel. The standard
    deviation is set to 0 if it is less than `_CERTAIN` times the range of the possible tooth counts.

    by      posterior weight of each possible tooth count, keyed by wheel
    total   sum of the posterior weights of one wheel
    """
    means, spreads = {}, {}
    for wheel, weights in by.items():
        counts, whole = question.uncertainties[wheel].counts, Fraction(plain_number(total))
        pairs = [(count, Fraction(plain_number(weight)) / whole) for count, weight in zip(counts, weights, strict=True)]
        # in fractions: for counts near 10^12 floats lose the square of a deviation
        mean = sum((probability * count for count, probability in pairs), Fraction(0))
        means[wheel] = float(mean)
        spread = sqrt(sum((probability * (count - mean) ** 2 for count, probability in pairs), Fraction(0)))
        spreads[wheel] = spread if spread > _CERTAIN * (counts[-1] - counts[0]) else 0.0
    return means, spreads


def _correlated(
    covariances: Mapping[tuple[str, str], float], spreads: Mapping[str, float]
) -> dict[tuple[str, str], float]:
    found = {}
    for (first, second), covariance in covariances.items():
        size = spreads[first] * spreads[second]
        if size:
            value = min(1.0, max(-1.0, covariance / size))  # rounding may exceed 1
            found[first, second] = value if abs(value) > _NONE else 0.0
    return dict(sorted(found.items(), key=lambda pair: -abs(pair[1])))


# ------------------------------------------------------------------------- Sobol indices: variance shares of the counts


# For independent x = (x_1 ... x_n) and f with mean m and variance V, S_i = Var(E[f | x_i]) / V is the share of variance
# that vanishes if x_i is known, and T_i = 1 - Var(E[f | all but x_i]) / V the share that remains if all others are
# known (Sobol 1993, 2001). A speed that is a sum of monomials needs only the means of powers of each count, and its
# indices are exact. Other speeds are evaluated over all combinations.


Monomials = Sequence[tuple[Fraction, tuple[int, ...]]]
"""Terms of a formula. Each term consists of a coefficient and the powers of the tooth counts, which may be negative."""


def find_variance_shares(
    name: str, formula: Formula, uncertainties: Mapping[str, ToothCountPrior]
) -> VarianceShares | None:
    """Return the Sobol indices of the speed of an output. Return None if the speed is constant, or undefined for some
    tooth counts, or if its formula is not a sum of monomials and there are more than two million combinations.
    """
    own = [uncertainties[wheel] for wheel in formula.wheels]
    if not any(len(uncertainty.counts) > 1 for uncertainty in own):
        return None
    if len(formula.denominator) == 1:
        return _exact_indices(name, formula.wheels, _monomials(formula), own)
    if prod(len(uncertainty.counts) for uncertainty in own) > _LISTED:
        return None
    return _listed_indices(name, formula, own)


def _monomials(formula: Formula) -> Monomials:
    ((below, lowest),) = formula.denominator
    return [(Fraction(above, below), tuple(map(int.__sub__, powers, lowest))) for above, powers in formula.numerator]


def _means(uncertainty: ToothCountPrior) -> Callable[[int], Fraction]:
    """Return a cached function that maps an exponent to the prior mean of the tooth count raised to this exponent."""
    pairs = list(zip(uncertainty.counts, uncertainty.priors, strict=True))
    return cache(lambda power: sum((prior * Fraction(count) ** power for count, prior in pairs), Fraction(0)))


def _exact_indices(
    name: str, wheels: Sequence[str], terms: Monomials, uncertainties: Sequence[ToothCountPrior]
) -> VarianceShares | None:
    """Return the exact Sobol indices of a sum of monomials, computed from the prior means of the products of two
    terms.
    """
    means = [_means(uncertainty) for uncertainty in uncertainties]
    mean = sum((c * prod(m(e) for m, e in zip(means, powers, strict=True)) for c, powers in terms), Fraction(0))
    pairs = [(a * b, p, q) for a, p in terms for b, q in terms]
    joint = [[m(i + j) for m, i, j in zip(means, p, q, strict=True)] for _, p, q in pairs]
    apart = [[m(i) * m(j) for m, i, j in zip(means, p, q, strict=True)] for _, p, q in pairs]
    variance = sum((c * prod(both) for (c, _, _), both in zip(pairs, joint, strict=True)), Fraction(0)) - mean**2
    if not variance:
        return None
    own: dict[str, Fraction] = {}
    whole: dict[str, Fraction] = {}
    for at, wheel in enumerate(wheels):
        alone = others = Fraction(0)
        for (c, _, _), both, each in zip(pairs, joint, apart, strict=True):
            alone += c * both[at] * prod(each[:at]) * prod(each[at + 1 :])
            others += c * each[at] * prod(both[:at]) * prod(both[at + 1 :])
        own[wheel] = (alone - mean**2) / variance
        whole[wheel] = 1 - (others - mean**2) / variance
    return VarianceShares(name, mean, _root(variance), own, whole)


def _root(value: Fraction) -> float | None:
    """Return the square root of a positive Fraction, accurate to 53 bits; None if it is out of the range of float64."""
    # scale by an even power of two to about 2^128, so that the integer square root has at least 63 bits
    shift = (128 - value.numerator.bit_length() + value.denominator.bit_length()) // 2
    power = Fraction(2) ** shift
    return as_float(Fraction(isqrt(int(value * power * power))) / power)


def _listed_indices(name: str, formula: Formula, uncertainties: Sequence[ToothCountPrior]) -> VarianceShares | None:
    """Return the Sobol indices computed from the speeds of all combinations, in an array with one axis per wheel."""
    shape = tuple(len(uncertainty.counts) for uncertainty in uncertainties)
    columns = {
        uncertainty.wheel: np.array(uncertainty.counts).reshape([-1 if at == axis else 1 for at in range(len(shape))])
        for axis, uncertainty in enumerate(uncertainties)
    }
    values = np.broadcast_to(formula.values(columns), shape)
    doubtful = np.flatnonzero(np.isinf(np.broadcast_to(formula.accuracy(columns), shape)))
    if formula.has_poles and _has_pole(formula, uncertainties, doubtful):
        return None
    priors = [np.array([float(prior) for prior in uncertainty.priors]) for uncertainty in uncertainties]
    mean = float(_averaged(values, priors, range(len(shape))).ravel()[0])
    # relative to the mean: a mean of squares minus the squared mean would lose a small variance
    values = values - mean
    variance = float(_averaged(values**2, priors, range(len(shape))).ravel()[0])
    # rounding error of a speed that is constant
    if variance <= (1e-13 * mean) ** 2:
        return None
    own, whole = {}, {}
    for axis, uncertainty in enumerate(uncertainties):
        others = [at for at in range(len(shape)) if at != axis]
        alone = _averaged(values, priors, others).ravel()
        own[uncertainty.wheel] = float((priors[axis] * alone**2).sum()) / variance
        rest = _averaged(values, priors, [axis])
        whole[uncertainty.wheel] = 1 - float(_averaged(rest**2, priors, others).ravel()[0]) / variance
    return VarianceShares(name, mean, sqrt(variance), own, whole)


def _has_pole(formula: Formula, uncertainties: Sequence[ToothCountPrior], places: NDArray[np.int64]) -> bool:
    """Return whether the speed is undefined for one of the combinations of tooth counts with the given flat indices
    `places`, by exact arithmetic.
    """
    shape = [len(uncertainty.counts) for uncertainty in uncertainties]
    for place in places:
        at = np.unravel_index(int(place), shape)
        counts = {
            uncertainty.wheel: uncertainty.counts[int(index)]
            for uncertainty, index in zip(uncertainties, at, strict=True)
        }
        if formula.value(counts) is None:
            return True
    return False


def _averaged(values: Floats, priors: Sequence[Floats], axes: Sequence[int]) -> Floats:
    """Return the prior mean of an array over the given axes, each of which represents a wheel. These axes are kept with
    length 1.
    """
    found: Floats = values
    for axis in axes:
        shape = [-1 if at == axis else 1 for at in range(values.ndim)]
        found = (found * priors[axis].reshape(shape)).sum(axis=axis, keepdims=True)
    return found
