"""Information in bits: what is learnt when chances change, and what an answer is expected to tell (Shannon 1948)."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import log2


def relative_entropy(after: Iterable[float], before: Iterable[float | Fraction]) -> float:
    """What is learnt where chances `before` become chances `after` [bit]; 0 where nothing changes."""
    pairs = zip(after, before, strict=False)
    # never negative but for rounding
    return max(0.0, sum(chance * log2(chance / prior) for chance, prior in pairs if chance))


def entropy(chances: Iterable[float]) -> float:
    """What an answer is expected to tell [bit]: each leaves itself alone, with its chance.

    It is the mean of the relative entropies of what is known after each answer and before.
    """
    return sum((chance * relative_entropy((1.0,), (chance,)) for chance in chances if chance), 0.0)
