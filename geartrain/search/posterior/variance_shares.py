"""Which wheel decides which output: shares of the variance of its speed over the counts in doubt.

For independent x = (x_1 ... x_n) and f with mean m and variance V, S_i = Var(E[f | x_i]) / V is what goes if x_i is
known, T_i = 1 - Var(E[f | all but x_i]) / V what stays if all others are (Sobol 1993, 2001). A speed that is a sum of
monomials needs only the means of powers of each count, and is exact; any other is taken over its combinations, or over
a sample by the estimators of Saltelli et al. (2010), table 2.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import isqrt, prod, sqrt

import numpy as np
from numpy.typing import NDArray

from geartrain.kinematics.formulas import Formula
from geartrain.numerics.arrays import Floats
from geartrain.numerics.long_float import Real, rounded
from geartrain.search.posterior.posterior_result import VarianceShares
from geartrain.search.posterior.priors import ToothCountPrior

_LISTED = 200_000  # combinations up to which all are taken
_DRAWN = 1 << 14  # in each of two samples otherwise

Monomials = Sequence[tuple[Fraction, tuple[int, ...]]]
"""Coefficients and powers (of either sign), in parallel to the wheels of a formula."""


def find_variance_shares(
    name: str, formula: Formula, doubts: Mapping[str, ToothCountPrior], seed: int = 0
) -> VarianceShares | None:
    """The shares of one output; None where its speed has no value for some counts, or is the same for all."""
    own = [doubts[wheel] for wheel in formula.wheels]
    if not any(len(doubt.counts) > 1 for doubt in own):
        return None
    if len(formula.denominator) == 1:
        return _exactly(name, formula.wheels, _monomials(formula), own)
    if prod(len(doubt.counts) for doubt in own) <= _LISTED:
        return _listed(name, formula, own)
    return _sampled(name, formula, own, seed)


def _monomials(formula: Formula) -> Monomials:
    ((below, lowest),) = formula.denominator
    return [(Fraction(above, below), tuple(map(int.__sub__, powers, lowest))) for above, powers in formula.numerator]


class _Means:
    """Means of powers of one count."""

    def __init__(self, doubt: ToothCountPrior) -> None:
        self._pairs = list(zip(doubt.counts, doubt.priors, strict=True))
        self._known: dict[int, Fraction] = {}

    def __call__(self, power: int) -> Fraction:
        if power not in self._known:
            self._known[power] = sum((prior * Fraction(count) ** power for count, prior in self._pairs), Fraction(0))
        return self._known[power]


def _exactly(
    name: str, wheels: Sequence[str], terms: Monomials, doubts: Sequence[ToothCountPrior]
) -> VarianceShares | None:
    """E[f g] of two sums of monomials is a sum over pairs of terms of products of means, wheel by wheel."""
    means = [_Means(doubt) for doubt in doubts]
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
    return VarianceShares(name, mean, _root(variance), own, whole, True)


def _root(value: Fraction) -> Real:
    """The square root of a positive Fraction of any size, to 53 bits."""
    # an even power of two brings the value near 2^128, so that its whole root has 63 bits and more
    shift = (128 - value.numerator.bit_length() + value.denominator.bit_length()) // 2
    power = Fraction(2) ** shift
    return rounded(Fraction(isqrt(int(value * power * power))) / power)


def _listed(name: str, formula: Formula, doubts: Sequence[ToothCountPrior]) -> VarianceShares | None:
    """Over all combinations, as an array with one axis for each wheel; exact but for rounding."""
    shape = tuple(len(doubt.counts) for doubt in doubts)
    columns = {
        doubt.wheel: np.array(doubt.counts).reshape([-1 if at == axis else 1 for at in range(len(shape))])
        for axis, doubt in enumerate(doubts)
    }
    values = np.broadcast_to(formula.values(columns), shape)
    doubtful = np.flatnonzero(np.isinf(np.broadcast_to(formula.accuracy(columns), shape)))
    if formula.has_poles and _has_pole(formula, doubts, doubtful):
        return None
    priors = [np.array([float(prior) for prior in doubt.priors]) for doubt in doubts]
    mean = float(_averaged(values, priors, range(len(shape))).ravel()[0])
    # about the mean: a mean of squares less its square would lose a small variance
    values = values - mean
    variance = float(_averaged(values**2, priors, range(len(shape))).ravel()[0])
    # rounding of a speed that is the same for all counts
    if variance <= (1e-13 * mean) ** 2:
        return None
    own, whole = {}, {}
    for axis, doubt in enumerate(doubts):
        others = [at for at in range(len(shape)) if at != axis]
        alone = _averaged(values, priors, others).ravel()
        own[doubt.wheel] = float((priors[axis] * alone**2).sum()) / variance
        rest = _averaged(values, priors, [axis])
        whole[doubt.wheel] = 1 - float(_averaged(rest**2, priors, others).ravel()[0]) / variance
    return VarianceShares(name, mean, sqrt(variance), own, whole, True)


def _has_pole(formula: Formula, doubts: Sequence[ToothCountPrior], places: NDArray[np.int64]) -> bool:
    """True if the speed has no value at one of some places, where floats cannot tell."""
    shape = [len(doubt.counts) for doubt in doubts]
    for place in places:
        at = np.unravel_index(int(place), shape)
        counts = {doubt.wheel: doubt.counts[int(index)] for doubt, index in zip(doubts, at, strict=True)}
        if formula.value(counts) is None:
            return True
    return False


def _averaged(values: Floats, priors: Sequence[Floats], axes: Sequence[int]) -> Floats:
    """The mean over some axes, which stay with length 1."""
    found: Floats = values
    for axis in axes:
        shape = [-1 if at == axis else 1 for at in range(values.ndim)]
        found = (found * priors[axis].reshape(shape)).sum(axis=axis, keepdims=True)
    return found


def _sampled(name: str, formula: Formula, doubts: Sequence[ToothCountPrior], seed: int) -> VarianceShares | None:
    """By two independent samples A and B, and A with one column of B for each wheel."""
    draw = np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, len(doubts)])))
    first, second = (
        {doubt.wheel: draw.choice(doubt.counts, _DRAWN, p=[float(prior) for prior in doubt.priors]) for doubt in doubts}
        for _ in range(2)
    )
    a, b = formula.values(first), formula.values(second)
    both = np.concatenate([a, b])
    mean, variance = float(both.mean()), float(both.var())
    if not np.isfinite(both).all() or variance <= (1e-13 * mean) ** 2:
        return None
    own, whole = {}, {}
    for doubt in doubts:
        mixed = formula.values(first | {doubt.wheel: second[doubt.wheel]})
        # estimators (b) and (f) of the table; less the mean, which adds nothing but scatter
        own[doubt.wheel] = float(((b - mean) * (mixed - a)).mean()) / variance
        whole[doubt.wheel] = float(((a - mixed) ** 2).mean()) / 2 / variance
    return VarianceShares(name, mean, sqrt(variance), own, whole, False, _DRAWN)
