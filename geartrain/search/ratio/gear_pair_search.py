"""Search for one gear pair of a given ratio: all pairs within a tolerance, or the best, in ranges of any length.

Two algorithms give the same pairs. A scan visits the tooth counts of one wheel and looks up the admissible counts of
the other; it is fast for lists and short ranges. The Stern-Brocot tree yields reduced fractions in the order of their
errors, and each fraction represents all its multiples. Its cost is proportional to the number of fractions that it
yields, so it is fast for long ranges.
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

_MOST_PAIRS = 10**6  # maximum length of a list of pairs
_MOST_SCANNED = 10**6  # counts that are scanned if a list has gaps
_MOST_BOXES = 400  # pairs of runs, for longer lists with gaps
_FAR = 10**12  # factor beyond the ratios of all counts
_Pair = tuple[int, int]


def find_pairs(
    wanted: TargetRatio,
    wheels: Counts,
    pinions: Counts,
    tolerance: Fraction | None = None,
    best: int | None = None,
) -> tuple[GearStages, ...]:
    """Return all pairs of tooth counts whose ratio approximates `wanted`, nearest first; complete and exact.

    wheels, pinions  tooth counts of the larger and of the smaller wheel. For a ratio of 1 or more, `wheels` are the
                     numerators and `pinions` the denominators; for a ratio below 1 the opposite.
    tolerance        maximum absolute relative error; None for no limit
    best             maximum number of pairs. None lists all pairs within the tolerance, or 20 without a tolerance.

    Pairs with equal absolute error are ordered by the sum of the counts, then by the larger count, then by the
    numerator. The sense of rotation is not checked: an external pair reverses it, an internal pair keeps it. Ranges may
    extend to 10^12. `RangeError` is raised if more than a million pairs would have to be listed (`count_pairs` counts
    them), and for a ratio more than 10^12 times beyond all pairs.
    """
    boxes = _boxes(wanted, wheels, pinions)
    _check_reach(wanted.value, boxes)
    bound = None if tolerance is None else _checked(tolerance)
    number = 20 if best is None and bound is None else best
    if number is not None and number < 1:
        raise QuestionError(Problem(f"best is {number}", "a list has at least one solution", "give best >= 1"))
    found = [pair for box in boxes for pair in _box_pairs(wanted.value, box, bound, number)]
    # pairs of several boxes are merged by rank
    found.sort(key=lambda pair: _rank(wanted.value, pair))
    return tuple(_stages(wanted.value, pair) for pair in found[:number])


def count_pairs(wanted: TargetRatio, wheels: Counts, pinions: Counts, tolerance: Fraction) -> int:
    """Return the number of pairs that `find_pairs` would list within `tolerance`, without listing them.

    For contiguous ranges the grid points between two lines are counted. The time grows with the logarithm of the
    counts.
    """
    bound = _checked(tolerance)
    return sum(box.number(*_limits(wanted.value, bound)) for box in _boxes(wanted, wheels, pinions))


@dataclass(frozen=True, slots=True)
class _Box:
    """Ranges of the numerator and the denominator that are searched together."""

    top: CountRuns
    beneath: CountRuns

    @property
    def contiguous(self) -> bool:
        return self.top.contiguous and self.beneath.contiguous

    def windows(self, low: Fraction, high: Fraction) -> Iterator[tuple[int, bool, int, int]]:
        """Yield the windows of counts for which low <= top/beneath <= high.

        Each window is a tuple: a count of one wheel, True if that count is the numerator, and the first and last count
        of the other wheel. The first wheel is the one with fewer counts that can occur in a pair.
        """
        (a, b), (c, d) = (low.numerator, low.denominator), (high.numerator, high.denominator)
        # counts of each wheel for which some count of the other wheel may be in reach
        beneath = (-(-self.top.minimum * d // c), self.top.most * b // a if a > 0 else self.beneath.most)
        top = (-(-self.beneath.minimum * a // b), self.beneath.most * c // d)
        if _size(self.beneath, beneath) <= _size(self.top, top):
            for q in self.beneath.between(*beneath):
                yield q, False, -(-q * a // b), q * c // d
        else:
            for p in self.top.between(*top):
                yield p, True, -(-p * d // c), p * b // a if a > 0 else self.beneath.most

    def pairs(self, low: Fraction, high: Fraction) -> Iterator[_Pair]:
        """Yield all pairs for which low <= top/beneath <= high, where high > 0."""
        for count, on_top, first, last in self.windows(low, high):
            if on_top:
                yield from ((count, q) for q in self.beneath.between(first, last))
            else:
                yield from ((p, count) for p in self.top.between(first, last))

    def number(self, low: Fraction, high: Fraction) -> int:
        """Count the pairs for which low <= top/beneath <= high, where high > 0."""
        if self.contiguous:
            below = _count_below(self, low, strictly=True) if low > 0 else 0
            return _count_below(self, high) - below
        return sum(
            _size(self.beneath if on_top else self.top, (first, last))
            for _, on_top, first, last in self.windows(low, high)
        )


def _boxes(wanted: TargetRatio, wheels: Counts, pinions: Counts) -> list[_Box]:
    """Return one box of all counts, or a box for each two contiguous runs if the lists are too long for a scan."""
    top, beneath = CountRuns.of(wheels), CountRuns.of(pinions)
    if wanted.value < 1:
        top, beneath = beneath, top
    if min(len(top), len(beneath)) <= _MOST_SCANNED or (top.contiguous and beneath.contiguous):
        return [_Box(top, beneath)]
    if len(top.spans) * len(beneath.spans) > _MOST_BOXES:
        raise RangeError(
            Problem(
                f"the lists of {len(top)} and {len(beneath)} tooth counts are too long",
                f"lists with gaps are limited to {_MOST_SCANNED:,} counts (the shorter list), or to {_MOST_BOXES} "
                "pairs of contiguous ranges",
                "give one contiguous range for each wheel, such as 12:1000000",
            )
        )
    return [_Box(CountRuns((p,)), CountRuns((q,))) for p, q in product(top.spans, beneath.spans)]


def _check_reach(value: Fraction, boxes: list[_Box]) -> None:
    """Raise `RangeError` if the ratio differs from the ratios of all pairs by a factor of more than 10^12."""
    low = min(Fraction(box.top.minimum, box.beneath.most) for box in boxes)
    high = max(Fraction(box.top.most, box.beneath.minimum) for box in boxes)
    if not low / _FAR < value < high * _FAR:
        made = f"ratios of these counts are from {decimal(low, 3)} to {decimal(high, 3)}"
        what = f"a ratio of {decimal(value, 3)} cannot be approximated"
        raise RangeError(Problem(what, made, "use more stages, or a wider range of counts"))


def _box_pairs(value: Fraction, box: _Box, tolerance: Fraction | None, number: int | None) -> list[_Pair]:
    """Return all pairs of one box within the tolerance; without a tolerance, its `number` best pairs."""
    if tolerance is not None:
        inside = box.number(*_limits(value, tolerance))
        if number is None and inside > _MOST_PAIRS:
            raise RangeError(
                Problem(
                    f"{inside} pairs are within the tolerance",
                    f"at most {_MOST_PAIRS} are listed",
                    "request only the best, or reduce the tolerance",
                )
            )
        # no more pairs are requested than exist, otherwise the algorithms would not terminate
        number = min(inside, number or inside)
    else:
        number = min(number or 0, len(box.top) * len(box.beneath))
    if not number:
        return []
    return _by_tree(value, box, number) if _tree_is_shorter(value, box, number) else _by_scan(value, box, number)


def _tree_is_shorter(value: Fraction, box: _Box, number: int) -> bool:
    """Return whether the Stern-Brocot tree needs fewer steps than a scan. Both find the same pairs.

    Let x be the ratio, and let the pairs that are possible have denominators from L to U. A scan takes min(x, 1) (U -
    L) steps. The tree visits all fractions with a denominator up to U, and a fraction 2 (U/L - 1) of them has a
    multiple in the ranges.
    """
    if not box.contiguous:
        return False
    # range of denominators whose matching numerator is admissible
    minimum = max(Fraction(box.beneath.minimum), box.top.minimum / value)
    most = min(Fraction(box.beneath.most), box.top.most / value)
    if most <= minimum:
        return False
    scanned = (most - minimum) * min(value, Fraction(1))
    return scanned > 1000 and scanned > 4 * number / min(Fraction(1), 2 * (most / minimum - 1))


def _by_tree(value: Fraction, box: _Box, number: int) -> list[_Pair]:
    """Return the `number` best pairs of two ranges: fractions of the Stern-Brocot tree with all their multiples."""
    found: list[_Pair] = []
    last: Fraction | None = None
    for fraction in nearest_first(value, box.top.most, box.beneath.most):
        distance = abs(fraction - value)
        if last is not None and distance > last:
            break
        p, q = fraction.numerator, fraction.denominator
        first = max(-(-box.top.minimum // p), -(-box.beneath.minimum // q))
        multiples = range(first, min(box.top.most // p, box.beneath.most // q) + 1)
        # of one fraction only the `number` smallest multiples can be among the best
        found += [(k * p, k * q) for k in islice(multiples, number)]
        if last is None and len(found) >= number:
            # a fraction with the same error on the other side may have fewer teeth
            last = distance
    return nsmallest(number, found, key=lambda pair: _rank(value, pair))


def _by_scan(value: Fraction, box: _Box, number: int) -> list[_Pair]:
    """Return the `number` best pairs by scans, with a tolerance that is increased until it includes enough pairs."""
    farthest = [box.top.minimum / Fraction(box.beneath.most), box.top.most / Fraction(box.beneath.minimum)]
    tolerance = max(farthest[0] / value - 1, 1 - farthest[1] / value, Fraction(0))
    # smaller than for uniformly distributed pairs, then increased fourfold: the last count costs most
    step = Fraction(number, len(box.top) * len(box.beneath)) / 64
    while box.number(*_limits(value, tolerance)) < number:
        tolerance += step
        step *= 4
    return nsmallest(number, box.pairs(*_limits(value, tolerance)), key=lambda pair: _rank(value, pair))


def _count_below(box: _Box, ratio: Fraction, strictly: bool = False) -> int:
    """Count the pairs of two ranges for which top/beneath <= ratio, or < ratio if `strictly`."""
    (first, last), (low, high) = box.top.spans[0], box.beneath.spans[0]
    n, d = ratio.numerator, ratio.denominator
    off = 1 if strictly else 0
    # below `start` no numerator is small enough, from `full` on all are
    start = min(max(-(-(first * d + off) // n), low), high + 1)
    full = min(max(-(-(last * d + off) // n), start), high + 1)
    part = _floor_sum(full - start, n, n * start - off, d) - (full - start) * (first - 1)
    return part + (high + 1 - full) * (last - first + 1)


def _floor_sum(number: int, slope: int, offset: int, divisor: int) -> int:
    """Return the sum of floor((slope i + offset)/divisor) for i from 0 to `number` - 1; all arguments are 0 or more.

    The sum counts the lattice points under a line. Integer parts are split off and the axes are exchanged, as in
    Euclid's algorithm, so the number of steps is logarithmic.
    """
    total, sign = 0, 1
    while number > 0:
        total += sign * (number * (number - 1) // 2 * (slope // divisor) + number * (offset // divisor))
        slope, offset = slope % divisor, offset % divisor
        rows = (slope * (number - 1) + offset) // divisor
        # row j = 1..rows has `number` - ceil((divisor j - offset)/slope) points under the line
        total += sign * rows * number
        if not rows:
            return total
        sign = -sign
        number, slope, offset, divisor = rows, divisor, divisor - offset + slope - 1, slope
    return total


def _limits(value: Fraction, tolerance: Fraction) -> tuple[Fraction, Fraction]:
    return value * (1 - tolerance), value * (1 + tolerance)


def _size(counts: CountRuns, window: _Pair) -> int:
    return max(counts.upto(window[1]) - counts.upto(window[0] - 1), 0)


def _rank(value: Fraction, pair: _Pair) -> tuple[Fraction, int, int, _Pair]:
    """Return the sort key of a pair: distance of its ratio from `value`, sum of counts, larger count, counts."""
    return abs(Fraction(*pair) - value), sum(pair), max(pair), pair


def _stages(value: Fraction, pair: _Pair) -> GearStages:
    ratio = Fraction(*pair)
    return GearStages(pair[:1], pair[1:], ratio, ratio / value - 1, (pair,))


def _checked(tolerance: Fraction) -> Fraction:
    if tolerance < 0:
        raise QuestionError(
            Problem(f"the tolerance is {tolerance}", "a tolerance must not be negative", "give 0 or more, such as 1e-6")
        )
    return tolerance
