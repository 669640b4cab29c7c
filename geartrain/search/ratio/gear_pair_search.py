"""One gear pair for a ratio: every pair of tooth counts within a tolerance, or the best ones, in ranges of any length.

Two ways lead to the same pairs. A scan takes the counts of one wheel one by one and looks up those of its mate; it
suits lists and short ranges. The tree of Stern and Brocot yields reduced fractions in the order of their errors, and
each of them stands for its multiples; its cost follows what it yields, so it suits long ranges.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from heapq import nsmallest
from itertools import islice, product

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.exact import decimal
from geartrain.search.search_outcome import GearStages
from geartrain.search.stern_brocot import nearest_first
from geartrain.search.target_ratio import TargetRatio
from geartrain.search.tooth_count_ranges import CountRuns, Counts

_MOST_PAIRS = 10**6  # listed
_MOST_SCANNED = 10**6  # counts taken one by one where a list has gaps
_MOST_BOXES = 400  # pairs of runs, where lists with gaps are longer
_FAR = 10**12  # times beyond all ratios of the counts
_Pair = tuple[int, int]


def find_pairs(
    wanted: TargetRatio,
    wheels: Counts,
    pinions: Counts,
    tolerance: Fraction | None = None,
    best: int | None = None,
) -> tuple[GearStages, ...]:
    """All pairs of one count over another whose ratio is `wanted`, nearest first; complete and exact.

    wheels, pinions  counts of the larger and of the smaller wheel: a ratio of 1 or more is one of `wheels` over one of
                     `pinions`, a ratio below 1 the other way round
    tolerance        the greatest |error| that is let in; none if None
    best             how many at most; all within the tolerance if None, and 20 if there is no tolerance either

    Of pairs with one |error| the fewest teeth come first, then the smaller largest wheel, then the smaller count on
    top. The sense is not looked at: an external pair reverses, an internal one keeps. Ranges may reach 10^12.
    `RangeError` where more than a million pairs would have to be listed: `count_pairs` tells how many there are; and
    for a ratio 10^12 times beyond all pairs.
    """
    boxes = _boxes(wanted, wheels, pinions)
    _check_reach(wanted.value, boxes)
    bound = None if tolerance is None else _checked(tolerance)
    number = 20 if best is None and bound is None else best
    if number is not None and number < 1:
        raise QuestionError(Problem(f"the best {number} are asked for", "that is no list", "ask for 1 or more"))
    found = [pair for box in boxes for pair in _found(wanted.value, box, bound, number)]
    found.sort(key=lambda pair: _rank(wanted.value, pair))
    return tuple(_stages(wanted.value, pair) for pair in found[:number])


def count_pairs(wanted: TargetRatio, wheels: Counts, pinions: Counts, tolerance: Fraction) -> int:
    """How many pairs `find_pairs` would list within `tolerance`, without listing them.

    Between ranges this counts the grid points between two lines, in a time that grows with the logarithm of the counts.
    """
    bound = _checked(tolerance)
    return sum(box.number(*_limits(wanted.value, bound)) for box in _boxes(wanted, wheels, pinions))


@dataclass(frozen=True, slots=True)
class _Box:
    """The counts on top and beneath that are looked at together."""

    top: CountRuns
    beneath: CountRuns

    @property
    def contiguous(self) -> bool:
        return self.top.contiguous and self.beneath.contiguous

    def windows(self, low: Fraction, high: Fraction) -> Iterator[tuple[int, bool, int, int]]:
        """Where low <= top/beneath <= high: a count of the wheel with fewer of them in reach, whether that is the one
        on top, and the first and last count of its mate."""
        (a, b), (c, d) = (low.numerator, low.denominator), (high.numerator, high.denominator)
        beneath = (-(-self.top.minimum * d // c), self.top.most * b // a if a > 0 else self.beneath.most)
        top = (-(-self.beneath.minimum * a // b), self.beneath.most * c // d)
        if _size(self.beneath, beneath) <= _size(self.top, top):
            for q in self.beneath.between(*beneath):
                yield q, False, -(-q * a // b), q * c // d
        else:
            for p in self.top.between(*top):
                yield p, True, -(-p * d // c), p * b // a if a > 0 else self.beneath.most

    def pairs(self, low: Fraction, high: Fraction) -> Iterator[_Pair]:
        """All pairs with low <= top/beneath <= high, where high > 0."""
        for count, on_top, first, last in self.windows(low, high):
            if on_top:
                yield from ((count, q) for q in self.beneath.between(first, last))
            else:
                yield from ((p, count) for p in self.top.between(first, last))

    def number(self, low: Fraction, high: Fraction) -> int:
        """How many pairs have low <= top/beneath <= high, where high > 0."""
        if self.contiguous:
            below = _under(self, low, strictly=True) if low > 0 else 0
            return _under(self, high) - below
        return sum(
            _size(self.beneath if on_top else self.top, (first, last))
            for _, on_top, first, last in self.windows(low, high)
        )


def _boxes(wanted: TargetRatio, wheels: Counts, pinions: Counts) -> list[_Box]:
    """The whole as one box, or a box for each two runs where lists are too long to be scanned."""
    top, beneath = CountRuns.of(wheels), CountRuns.of(pinions)
    if wanted.value < 1:
        top, beneath = beneath, top
    if min(len(top), len(beneath)) <= _MOST_SCANNED or (top.contiguous and beneath.contiguous):
        return [_Box(top, beneath)]
    if len(top.spans) * len(beneath.spans) > _MOST_BOXES:
        raise RangeError(
            Problem(
                f"{len(top)} counts over {len(beneath)}, with gaps, are too many",
                "counts with gaps are taken one by one, or range by range where the ranges are few",
                "give one range for each wheel, such as 12:1000000",
            )
        )
    return [_Box(CountRuns((p,)), CountRuns((q,))) for p, q in product(top.spans, beneath.spans)]


def _check_reach(value: Fraction, boxes: list[_Box]) -> None:
    """`RangeError` for a ratio so far beyond all pairs that none of them is near."""
    low = min(Fraction(box.top.minimum, box.beneath.most) for box in boxes)
    high = max(Fraction(box.top.most, box.beneath.minimum) for box in boxes)
    if not low / _FAR < value < high * _FAR:
        made = f"these counts make {decimal(low, 3)} to {decimal(high, 3)}"
        what = f"a ratio of {decimal(value, 3)} is far out of reach"
        raise RangeError(Problem(what, made, "take more stages, or a wider range of counts"))


def _found(value: Fraction, box: _Box, tolerance: Fraction | None, number: int | None) -> list[_Pair]:
    """The pairs of one box: those within the tolerance, or the `number` best, which stand in for any others."""
    if tolerance is not None:
        inside = box.number(*_limits(value, tolerance))
        if number is None and inside > _MOST_PAIRS:
            raise RangeError(
                Problem(
                    f"{inside} pairs lie within the tolerance",
                    f"more than {_MOST_PAIRS} are not listed",
                    "ask for the best of them, or lower the tolerance",
                )
            )
        number = min(inside, number or inside)
    else:
        number = min(number or 0, len(box.top) * len(box.beneath))
    if not number:
        return []
    return _by_tree(value, box, number) if _tree_is_shorter(value, box, number) else _by_scan(value, box, number)


def _tree_is_shorter(value: Fraction, box: _Box, number: int) -> bool:
    """Whether the tree needs fewer steps than a scan; both find the same.

    With x the ratio, the pairs in reach have a count beneath from L to U. A scan takes U - L steps, or x times as many
    where that is fewer. The tree passes all fractions with a denominator up to U, and of these a share of about
    2 (U/L - 1) has a multiple in the ranges.
    """
    if not box.contiguous:
        return False
    minimum = max(Fraction(box.beneath.minimum), box.top.minimum / value)
    most = min(Fraction(box.beneath.most), box.top.most / value)
    if most <= minimum:
        return False
    scanned = (most - minimum) * min(value, Fraction(1))
    return scanned > 1000 and scanned > 4 * number / min(Fraction(1), 2 * (most / minimum - 1))


def _by_tree(value: Fraction, box: _Box, number: int) -> list[_Pair]:
    """The `number` best pairs of two ranges: nearest fractions first, each with its multiples."""
    found: list[_Pair] = []
    last: Fraction | None = None
    for fraction in nearest_first(value, box.top.most, box.beneath.most):
        distance = abs(fraction - value)
        if last is not None and distance > last:
            break
        p, q = fraction.numerator, fraction.denominator
        first = max(-(-box.top.minimum // p), -(-box.beneath.minimum // q))
        multiples = range(first, min(box.top.most // p, box.beneath.most // q) + 1)
        found += [(k * p, k * q) for k in islice(multiples, number)]
        if last is None and len(found) >= number:
            # a fraction as far away on the other side may still have fewer teeth
            last = distance
    return nsmallest(number, found, key=lambda pair: _rank(value, pair))


def _by_scan(value: Fraction, box: _Box, number: int) -> list[_Pair]:
    """The `number` best pairs: the tolerance is widened until it holds that many, so all better ones are inside."""
    farthest = [box.top.minimum / Fraction(box.beneath.most), box.top.most / Fraction(box.beneath.minimum)]
    tolerance = max(farthest[0] / value - 1, 1 - farthest[1] / value, Fraction(0))
    # narrower than evenly spread pairs would need, then four times as wide each time: the last count costs most
    step = Fraction(number, len(box.top) * len(box.beneath)) / 64
    while box.number(*_limits(value, tolerance)) < number:
        tolerance += step
        step *= 4
    return nsmallest(number, box.pairs(*_limits(value, tolerance)), key=lambda pair: _rank(value, pair))


def _under(box: _Box, ratio: Fraction, strictly: bool = False) -> int:
    """How many pairs of two ranges have top/beneath <= ratio, or below it if `strictly`."""
    (first, last), (low, high) = box.top.spans[0], box.beneath.spans[0]
    n, d = ratio.numerator, ratio.denominator
    off = 1 if strictly else 0
    # beneath `start` not even the first count on top is small enough, from `full` on all of them are
    start = min(max(-(-(first * d + off) // n), low), high + 1)
    full = min(max(-(-(last * d + off) // n), start), high + 1)
    part = _floor_sum(full - start, n, n * start - off, d) - (full - start) * (first - 1)
    return part + (high + 1 - full) * (last - first + 1)


def _floor_sum(number: int, slope: int, offset: int, divisor: int) -> int:
    """Sum of floor((slope i + offset)/divisor) for i from 0 to `number` - 1, all of them 0 or more.

    Grid points under a line: whole parts are taken out, then the axes change places, as in Euclid's algorithm.
    """
    total, sign = 0, 1
    while number > 0:
        total += sign * (number * (number - 1) // 2 * (slope // divisor) + number * (offset // divisor))
        slope, offset = slope % divisor, offset % divisor
        rows = (slope * (number - 1) + offset) // divisor
        # points of row j = 1..rows under the line are those right of it: `number` less ceil((divisor j - offset)/slope)
        total += sign * rows * number
        if not rows:
            return total
        sign = -sign
        number, slope, offset, divisor = rows, divisor, divisor - offset + slope - 1, slope
    return total


def _limits(value: Fraction, tolerance: Fraction) -> tuple[Fraction, Fraction]:
    return value * (1 - tolerance), value * (1 + tolerance)


def _size(counts: CountRuns, window: _Pair) -> int:
    """How many of the counts lie in the window."""
    return max(counts.upto(window[1]) - counts.upto(window[0] - 1), 0)


def _rank(value: Fraction, pair: _Pair) -> tuple[Fraction, int, int, _Pair]:
    """The order of pairs: |error|, here as a distance; then teeth; then the largest; then the counts."""
    return abs(Fraction(*pair) - value), sum(pair), max(pair), pair


def _stages(value: Fraction, pair: _Pair) -> GearStages:
    ratio = Fraction(*pair)
    return GearStages(pair[:1], pair[1:], ratio, ratio / value - 1, (pair,))


def _checked(tolerance: Fraction) -> Fraction:
    if tolerance < 0:
        raise QuestionError(
            Problem(f"a tolerance of {tolerance}", "an error is compared by its size", "give 0 or more, such as 1e-6")
        )
    return tolerance
