"""How a search is cut into pieces of equal work, and how densely solutions lie: estimates, which decide nothing.

One piece of the search: all products beneath in a segment of value, against the products on top that they need.

The pieces are independent, their questions and results plain JSON data, and how they are cut changes no answer.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, exp, isqrt, log
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.synthesis.ratio.product_windows import ProductWindows, Range, multisets
from geartrain.synthesis.ratio.stage_problem import StageProblem, stage_problem_of

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_BINS = 256  # of the logarithms of counts


@dataclass(frozen=True, slots=True)
class SegmentPlan:
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
        # without a density to go by a search begins narrow, and is widened
        return Fraction(number / self.density) if self.density * 1e18 > number else Fraction(1, 10**18)


def lay_out(question: StageProblem) -> SegmentPlan:
    """Segments of about two blocks of products each, those beneath and those on top that go with them."""
    size, value = question.stages, question.value
    spans = [log(counts[-1] / counts[0]) for counts in (question.top, question.beneath)]
    # a single count spans nothing
    width = max(*spans, 1e-6) / _BINS
    over, under = (_spread(counts, size, width) for counts in (question.top, question.beneath))
    start = size * log(question.beneath[0])
    shift = (size * log(question.beneath[0] / question.top[0]) + log(value.numerator) - log(value.denominator)) / width
    at = np.arange(len(under))
    beside = np.interp(at + shift, np.arange(len(over)), over, left=0.0, right=0.0)
    used = np.flatnonzero((at + shift > -1) & (at + shift < len(over)))
    least, most = question.beneath[0] ** size, question.beneath[-1] ** size
    if not len(used):
        return SegmentPlan((least, most + 1), 0, 0.0)
    work = np.cumsum((under + beside)[used])
    number = max(ceil(work[-1] / (2 * block_of(question))), 1)
    places = np.searchsorted(work, work[-1] * np.arange(1, number) / number) + used[0] + 1
    middle = {min(max(ceil(exp(start + place * width)), least + 1), most) for place in places.tolist()}
    bounds = (least, *sorted(middle - {least}), most + 1)
    both = under * beside
    peak = ceil(exp(start + (int(both.argmax()) + 0.5) * width))
    densest = int(np.searchsorted(np.array(bounds[1:-1], dtype=np.float64), float(peak), side="right"))
    # twice, for an |error| has a side above the ratio and one below
    return SegmentPlan(bounds, densest, float(2 * both.sum() / width))


def _spread(counts: tuple[int, ...], size: int, width: float) -> Floats:
    """Number of unordered sets by the logarithm of their product, in bins of `width` from the least."""
    places = np.array([log(count / counts[0]) / width for count in counts])
    one = np.bincount(places.astype(np.int64)).astype(np.float64)
    found = np.ones(1)
    for _ in range(size):
        found = np.convolve(found, one)
    # the convolution counts ordered choices: scaled to the number of unordered sets
    return np.asarray(found * (multisets(len(counts), size) / found.sum()))


BLOCK = 1 << 21
"""Products of one side held at once: what bounds the memory."""
PER_ROW = 3
"""A window costs a search in every row of the tables: it should bring some products for each."""
_FEW = 1000  # solutions that may be made one by one from their products


def task_of(
    question: StageProblem, low: int, high: int, hint: Fraction, bound: tuple[int, Fraction, int] | None = None
) -> dict[str, Any]:
    """The plain data of one piece.

    low, high  products beneath, half-open
    hint       a tolerance within which some of the best may be expected
    bound      first, |error| and sum of a solution that is surely no better than the last one kept
    """
    plain = [bound[0], str(bound[1]), bound[2]] if bound else None
    return {"question": question.plain(), "low": low, "high": high, "hint": str(hint), "bound": plain}


def search_segment(task: Mapping[str, Any]) -> dict[str, Any]:
    """Count the solutions of a piece, exactly, and give its best.

    Result: `count`; `removed`, reason -> pairs of sets within the tolerance that are no solutions; `rows`, the best as
    [what the order asks for, counts on top, counts beneath].
    """
    from geartrain.synthesis.ratio.candidate_stages import RowFinder
    from geartrain.synthesis.ratio.distinct_ratios import ValueFinder

    question = stage_problem_of(task["question"])
    plain = task["bound"]
    bound = (plain[0], Fraction(plain[1]), plain[2]) if plain else None
    by_value = listed_by_value(question)
    finder = ValueFinder(question, Fraction(task["hint"]), bound) if by_value else RowFinder(question, bound)
    for beneath, top in blocks(question, task["low"], task["high"]):
        finder.look(beneath, top)
    return finder.result()


def listed_by_value(question: StageProblem) -> bool:
    """True if solutions need not be looked at one by one: what is asked can be seen from their products."""
    return question.by == "error" and question.loose and question.best <= _FEW


def block_of(question: StageProblem) -> int:
    """Products of one side that are held at once: `BLOCK`, or more where even the tables are longer."""
    numbers = max(len(question.top), len(question.beneath))
    return max(BLOCK, PER_ROW * multisets(numbers, (question.stages + 1) // 2))


def blocks(question: StageProblem, low: int, high: int) -> Iterator[tuple[Range, Range]]:
    """Ranges of products beneath and on top that cover every pair within the tolerance once, none too long."""
    if not question.reachable:
        return
    most = block_of(question)
    for beneath in pieces(question.under, *question.beneath_within(low, high), most):
        for top in pieces(question.over, *question.tops_for(*beneath), most):
            yield beneath, top


def pieces(products: ProductWindows, low: int, high: int, most: int) -> Iterator[Range]:
    """[low, high) in parts of no more than `most` products each, ascending; nothing where there are none."""
    low, high = max(low, products.least), min(high, products.most + 1)
    number = products.below(high) - products.below(low) if low < high else 0
    if number > most and high - low > 1:
        # the geometric mean, for products are spread evenly in logarithms
        middle = min(max(isqrt(low * high), low + 1), high - 1)
        yield from pieces(products, low, middle, most)
        yield from pieces(products, middle, high, most)
    elif number:
        yield low, high
