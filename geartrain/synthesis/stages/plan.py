"""How a search is cut into pieces of equal work, and how densely solutions lie: estimates, which decide nothing."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import ceil, exp, log
from typing import TYPE_CHECKING

import numpy as np

from geartrain.synthesis.stages.products import multisets
from geartrain.synthesis.stages.work import block_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.synthesis.stages.question import Question

    Floats = NDArray[np.float64]

_BINS = 256


@dataclass(frozen=True, slots=True)
class Plan:
    """Segments of the products beneath, and the density of pairs of sets.

    bounds    products beneath, ascending: segment n is [bounds[n], bounds[n + 1])
    densest   the segment in which most pairs are near the wanted ratio
    density   pairs of sets for each unit of |error|, over all segments; an estimate
    """

    bounds: tuple[int, ...]
    densest: int
    density: float

    @property
    def segments(self) -> tuple[tuple[int, int], ...]:
        """The segments, half-open."""
        return tuple(zip(self.bounds, self.bounds[1:], strict=False))

    def tolerance_for(self, number: float) -> Fraction:
        """An |error| within which about so many pairs of sets lie."""
        return Fraction(number / self.density) if self.density * 1e18 > number else Fraction(1, 10**18)


def lay_out(question: Question) -> Plan:
    """Segments of about two blocks of products each, those beneath and those on top that go with them."""
    size, value = question.stages, question.value
    spans = [log(counts[-1] / counts[0]) for counts in (question.top, question.beneath)]
    width = max(*spans, 1e-6) / _BINS
    over, under = (_spread(counts, size, width) for counts in (question.top, question.beneath))
    start = size * log(question.beneath[0])
    shift = (size * log(question.beneath[0] / question.top[0]) + log(value.numerator) - log(value.denominator)) / width
    at = np.arange(len(under))
    beside = np.interp(at + shift, np.arange(len(over)), over, left=0.0, right=0.0)
    used = np.flatnonzero((at + shift > -1) & (at + shift < len(over)))
    least, most = question.beneath[0] ** size, question.beneath[-1] ** size
    if not len(used):
        return Plan((least, most + 1), 0, 0.0)
    work = np.cumsum((under + beside)[used])
    number = max(ceil(work[-1] / (2 * block_of(question))), 1)
    places = np.searchsorted(work, work[-1] * np.arange(1, number) / number) + used[0] + 1
    middle = {min(max(ceil(exp(start + place * width)), least + 1), most) for place in places.tolist()}
    bounds = (least, *sorted(middle - {least}), most + 1)
    both = under * beside
    peak = ceil(exp(start + (int(both.argmax()) + 0.5) * width))
    densest = int(np.searchsorted(np.array(bounds[1:-1], dtype=np.float64), float(peak), side="right"))
    return Plan(bounds, densest, float(2 * both.sum() / width))


def _spread(counts: tuple[int, ...], size: int, width: float) -> Floats:
    """Number of unordered sets by the logarithm of their product, in bins of `width` from the least."""
    places = np.array([log(count / counts[0]) / width for count in counts])
    one = np.bincount(places.astype(np.int64)).astype(np.float64)
    found = np.ones(1)
    for _ in range(size):
        found = np.convolve(found, one)
    return np.asarray(found * (multisets(len(counts), size) / found.sum()))
