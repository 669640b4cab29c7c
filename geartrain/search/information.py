"""Information in probability distributions in bits (Shannon 1948)."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import log2


def relative_entropy(after: Iterable[float], before: Iterable[float | Fraction]) -> float:
    """Return the Kullback-Leibler divergence of the probabilities `after` from the probabilities `before` [bit]."""
    pairs = zip(after, before, strict=False)
    # rounding may make it slightly negative
    return max(0.0, sum(probability * log2(probability / prior) for probability, prior in pairs if probability))


def entropy(probabilities: Iterable[float]) -> float:
    """Return the Shannon entropy of a distribution [bit], which is the expected information of an observation of its
    outcome.

    The entropy equals the mean relative entropy of the distribution after the observation with respect to the
    distribution before it.
    """
    return sum(
        (probability * relative_entropy((1.0,), (probability,)) for probability in probabilities if probability), 0.0
    )
