"""What the three ways of looking at all combinations have in common when they are done."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import sqrt
from typing import Any

import numpy as np

from geartrain.uncertainty.counts.doubts import Doubt
from geartrain.uncertainty.counts.question import Question
from geartrain.uncertainty.counts.result import Chance, Posterior
from geartrain.uncertainty.counts.summing import Candidate, Sums, plain
from geartrain.uncertainty.counts.tallying import Tally, origin_of

_Z = 1.959963984540054  # of 95 %
_CERTAIN = 1e-4
"""Spread over range below which a count has no correlation to tell: other counts have a chance under 10^-8, and
covariances in float64 would be rounding."""


@dataclass(frozen=True, slots=True)
class Found:
    """Evidence, posteriors, correlations and candidates for the best, whoever found them.

    effective  number of combinations that the figures rest on, where they are of a sample; infinite where they are not
    """

    looked: int
    evidence: Chance
    turning: Chance
    fits: int | None
    posteriors: Mapping[str, Posterior]
    correlations: Mapping[tuple[str, str], float]
    candidates: Sequence[Candidate]
    ranked: bool
    effective: float


def wilson(hits: float, trials: float) -> tuple[float, float]:
    """The 95 % score interval of a share (Wilson 1927): hits and trials may be effective, not whole numbers."""
    if not trials:
        return 0.0, 1.0
    share, square = hits / trials, _Z * _Z
    middle = (share + square / (2 * trials)) / (1 + square / trials)
    half = _Z * sqrt(max(share * (1 - share), 0.0) / trials + square / (4 * trials * trials)) / (1 + square / trials)
    return (max(0.0, middle - half) if hits else 0.0), (min(1.0, middle + half) if hits < trials else 1.0)


def of_tally(question: Question, tally: Tally, drawn: bool) -> Found:
    """What a listing of combinations comes to, or a sample of them."""
    wheels = tally.batch.wheels
    candidates = [
        Candidate(misfit, {w: tally.batch.domains[w][index] for w, index in zip(wheels, at, strict=True)})
        for misfit, at in tally.best
    ]
    by = dict(zip(wheels, tally.by, strict=True))
    if drawn:
        evidence, turning = _share(tally.weight, tally.looked, tally, question.soft), _counted(tally)
    else:
        total = int(np.prod([question.doubts[wheel].total for wheel in wheels], dtype=object))
        evidence = Chance(float(tally.weight)) if question.soft else Chance(Fraction(int(tally.weight), total))
        turning = Chance(Fraction(int(tally.turning), total))
    trials = tally.weight**2 / tally.square if drawn and tally.square else None
    posteriors = {
        wheel: posterior(doubt, by.get(wheel), tally.weight, trials) for wheel, doubt in question.doubts.items()
    }
    fits = None if drawn or question.soft else _all(question, wheels) * tally.fits
    return Found(
        tally.looked,
        evidence,
        turning,
        fits,
        posteriors,
        _of_sizes(question, tally),
        candidates,
        tally.ranked,
        (trials or 0.0) if drawn else float("inf"),
    )


def _all(question: Question, wheels: Sequence[str]) -> int:
    """Combinations of the wheels on which nothing depends."""
    found = 1
    for wheel, doubt in question.doubts.items():
        found *= 1 if wheel in wheels else len(doubt.counts)
    return found


def _share(weight: float, looked: int, tally: Tally, soft: bool) -> Chance:
    """A share with its interval: Wilson's for hits, the normal one for degrees of agreement."""
    if not looked:
        return Chance(0.0, 0.0, 1.0)
    mean = float(weight) / looked
    if not soft or not weight:
        return Chance(mean, *wilson(float(weight), looked))
    half = _Z * sqrt(max(tally.square / looked - mean**2, 0.0) / looked)
    return Chance(mean, max(0.0, mean - half), min(1.0, mean + half))


def _counted(tally: Tally) -> Chance:
    if not tally.batch.question.conditions:
        return Chance(Fraction(1))
    share = tally.turning / tally.looked if tally.looked else 0.0
    return Chance(share, *wilson(tally.turning, tally.looked))


def posterior(doubt: Doubt, weights: Sequence[Any] | None, total: Any, trials: float | None) -> Posterior:
    """The chances of one wheel's counts.

    weights   of what fits with each count; None: nothing known depends on the wheel
    total     their sum
    trials    number of hits behind them, where they are of a sample
    """
    if not total:
        return Posterior(doubt, (), weights is None)
    if weights is None:
        return Posterior(doubt, tuple(Chance(prior) for prior in doubt.priors), True)
    if trials is not None:
        shares = [float(weight) / float(total) for weight in weights]
        return Posterior(doubt, tuple(Chance(share, *wilson(share * trials, trials)) for share in shares), False)
    if isinstance(total, float | np.floating):
        return Posterior(doubt, tuple(Chance(float(weight) / float(total)) for weight in weights), False)
    return Posterior(doubt, tuple(Chance(Fraction(int(weight), int(total))) for weight in weights), False)


def _of_sizes(question: Question, tally: Tally) -> dict[tuple[str, str], float]:
    """Correlations from sums of products of counts."""
    if not tally.weight:
        return {}
    wheels = tally.batch.wheels
    means, spreads = _moments(question, dict(zip(wheels, tally.by, strict=True)), tally.weight)
    off = [means[wheel] - origin_of(question.doubts[wheel]) for wheel in wheels]
    found = {}
    for i, first in enumerate(wheels):
        for j, second in enumerate(wheels[i + 1 :], i + 1):
            found[first, second] = float(tally.sizes[i, j]) / float(tally.weight) - off[i] * off[j]
    return _correlated(found, spreads)


def of_sums(question: Question, sums: Sequence[Sums]) -> dict[tuple[str, str], float]:
    """Correlations from decomposed parts; wheels of different parts have none."""
    found: dict[tuple[str, str], float] = {}
    order = {wheel: at for at, wheel in enumerate(question.doubts)}
    for one in sums:
        if one.evidence:
            _, spreads = _moments(question, one.posteriors, one.evidence)
            pairs = {(a, b) if order[a] < order[b] else (b, a): value for (a, b), value in one.covariances.items()}
            found |= _correlated(pairs, spreads)
    return dict(sorted(found.items(), key=lambda pair: -abs(pair[1])))


def _moments(
    question: Question, by: Mapping[str, Sequence[Any]], total: Any
) -> tuple[dict[str, float], dict[str, float]]:
    """Posterior mean and standard deviation of every wheel's count; 0 for one that is as good as certain."""
    means, spreads = {}, {}
    for wheel, weights in by.items():
        counts, whole = question.doubts[wheel].counts, Fraction(plain(total))
        pairs = [(count, Fraction(plain(weight)) / whole) for count, weight in zip(counts, weights, strict=True)]
        mean = sum((chance * count for count, chance in pairs), Fraction(0))
        means[wheel] = float(mean)
        spread = sqrt(sum((chance * (count - mean) ** 2 for count, chance in pairs), Fraction(0)))
        spreads[wheel] = spread if spread > _CERTAIN * (counts[-1] - counts[0]) else 0.0
    return means, spreads


def _correlated(
    covariances: Mapping[tuple[str, str], float], spreads: Mapping[str, float]
) -> dict[tuple[str, str], float]:
    found = {}
    for (first, second), covariance in covariances.items():
        size = spreads[first] * spreads[second]
        if size:
            found[first, second] = min(1.0, max(-1.0, covariance / size))
    return dict(sorted(found.items(), key=lambda pair: -abs(pair[1])))
