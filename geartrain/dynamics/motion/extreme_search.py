"""Extreme errors and rates of outputs over a range of input positions, at kinks and between them.

The kinks of all transmission functions divide the evaluated range into smooth pieces, which are evaluated at their ends
and in the middle. A maximum between these positions is located only if it may exceed all of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import common_period, evaluate
from geartrain.dynamics.motion.kink_positions import KinkSearch

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import ErrorComposition, ErrorDifference
    from geartrain.dynamics.motion.run_statistics import RunningStatistics
    from geartrain.numerics.arrays import Bools, Floats, Indices

MOST_KINKS = 400_000  # kinks of a run that are all searched, which takes about 10 s in a train of 50 pairs
_BESIDE = 1e-9  # [narrow steps] distance from the end of a piece at which its one-sided limit is taken
_ULPS = 32  # units in the last place of the turns: minimum distance, so that rounding does not pass a kink
_BEYOND = 0.1  # [range in a piece] allowance for a maximum above the parabola through its ends and middle
_STEEP = 4  # ratio of rise to bend in a piece, above which its values are taken to rise or fall throughout
_SURE = 1e-9  # [range of an output's errors or rates] tolerance of the search
_ROUNDING = 1e-12  # rad: absolute tolerance, above rounding
_BATCH = 512  # pieces in which maxima are located at once
_PARTS = 8  # subdivisions of a piece per round
_ROUNDS = 6  # rounds of subdivision: each narrows the interval by 4


class _Candidates(NamedTuple):
    """Intervals from `low` to `high` [revolutions] in which quantity number `sought` may exceed the maximum found so
    far, because its estimated maximum in the interval is `promise`.
    """

    sought: Indices
    promise: Floats
    low: Floats
    high: Floats

    def chosen(self, which: Bools | Indices | slice) -> _Candidates:
        """Return the intervals that a mask, an array of indices or a slice selects."""
        return _Candidates(self.sought[which], self.promise[which], self.low[which], self.high[which])

    def exceeding(self, maxima: Floats) -> _Candidates:
        """Return the intervals whose estimated maximum exceeds the value in `maxima` for the same quantity."""
        return self.chosen(self.promise > (maxima + _tolerance(maxima))[self.sought])


def count_extremes(
    compositions: Sequence[ErrorComposition],
    sampler: ErrorComposition | ErrorDifference,
    turns: float,
    tallies: Sequence[RunningStatistics],
) -> frozenset[str]:
    """Include the extremes over a run from position 0 to `turns` [revolutions] in `tallies`, the statistics of the
    outputs. Return the names of the pairs whose driver turns against its mean sense of rotation at some position.

    compositions   compositions whose kinks divide the run
    sampler        errors to be searched: one of the compositions, or the difference of two

    Runs with more than `MOST_KINKS` kinks are not searched.
    """
    searches = [KinkSearch(each) for each in compositions]
    low, high = sorted((0.0, turns))
    # after a common period all values repeat
    period = common_period([source for each in compositions for source in each.used])
    if period is not None and period < high - low:
        high = low + float(period)
    if sum(each.rate for each in searches) * (high - low) > MOST_KINKS:
        return frozenset()
    # errors and rates of each output, and their negatives, so that minima are maxima too
    maxima, reversing = np.full(4 * len(tallies), -np.inf), frozenset[str]()
    kept: list[_Candidates] = []
    for start, end in pieces(searches, low, high, max(1, sampler.chunk // 3)):
        found = evaluate(sampler, np.concatenate([start, (start + end) / 2, end]))
        reversing |= found.reversing_drivers
        values = np.stack([found.error, -found.error, found.rate, -found.rate], axis=1).reshape(len(maxima), 3, -1)
        # NaN marks positions where no teeth touch
        maxima = np.fmax(maxima, np.fmax.reduce(values, axis=(1, 2)))
        promise = _promise(*np.moveaxis(values, 1, 0))
        sought, piece = np.nonzero(promise > (maxima + _tolerance(maxima))[:, None])
        kept.append(_Candidates(sought, promise[sought, piece], start[piece], end[piece]))
    joined = _Candidates(*map(np.concatenate, zip(*kept, strict=True)))
    # the most promising pieces come first, because they raise the maxima, which excludes most of the others
    joined = joined.chosen(np.argsort((maxima[joined.sought] - joined.promise) / _tolerance(maxima)[joined.sought]))
    while len(joined.sought):
        _locate(sampler, maxima, joined.chosen(slice(_BATCH)))
        joined = joined.chosen(slice(_BATCH, None)).exceeding(maxima)
    for tally, (most, minimum, fast, slow) in zip(tallies, maxima.reshape(-1, 4).tolist(), strict=True):
        tally.most, tally.minimum = max(tally.most, most), min(tally.minimum, -minimum)
        tally.fast, tally.slow = max(tally.fast, fast), min(tally.slow, -slow)
        tally.searched = True
    return reversing


def pieces(searches: Sequence[KinkSearch], low: float, high: float, size: int) -> Iterator[tuple[Floats, Floats]]:
    """Yield the two ends of each interval between kinks from `low` to `high` [revolutions], moved slightly inwards, in
    arrays of `size` intervals.
    """
    narrowest = min(searches, key=lambda each: each.step)
    for steps in narrowest.steps(low, high):
        kinks = [search.between(steps).turns for search in searches]
        edges = np.unique(np.concatenate([steps.low, steps.high[-1:], *kinks]))
        beside = np.maximum(_BESIDE * (steps.high[0] - steps.low[0]), _ULPS * np.spacing(np.abs(edges[1:])))
        # a narrower piece is between two copies of one kink, which differ by rounding
        wide = np.diff(edges) > 4 * beside
        first, last = (edges[:-1] + beside)[wide], (edges[1:] - beside)[wide]
        yield from ((first[at : at + size], last[at : at + size]) for at in range(0, len(first), size))


def _promise(first: Floats, middle: Floats, last: Floats) -> Floats:
    """Return an estimate of the maximum of a smooth function in each interval, from its values at three positions."""
    highest, lowest = (each.reduce([first, middle, last]) for each in (np.maximum, np.minimum))
    bend, rise = 2 * middle - first - last, np.abs(last - first)
    # vertex of the parabola through the three values, if it is between the ends
    inner = rise < 2 * bend
    vertex = middle + np.divide(rise**2, 8 * bend, where=inner, out=np.zeros_like(bend))
    # values that clearly rise or fall have their maximum at an end, whose value is known
    allowance = np.where(rise > _STEEP * np.abs(bend), 0.0, _BEYOND * (highest - lowest))
    found: Floats = np.where(inner, vertex, highest) + allowance
    return found


def _tolerance(maxima: Floats) -> Floats:
    """Return the absolute tolerance of each maximum, a small fraction of the range of the errors or speeds."""
    # a maximum plus the maximum of the negatives is the range
    ranges = np.repeat(maxima[::2] + maxima[1::2], 2)
    return np.maximum(_SURE * ranges, _ROUNDING)


def _locate(sampler: ErrorComposition | ErrorDifference, maxima: Floats, given: _Candidates) -> None:
    """Replace each value in `maxima` by the maximum of its quantity inside the intervals `given`, if that is larger."""
    for _ in range(_ROUNDS):
        given = given.exceeding(maxima)
        rows = np.arange(len(given.sought))
        if not len(rows):
            break
        grid = given.low[:, None] + (given.high - given.low)[:, None] * (np.arange(_PARTS + 1) / _PARTS)
        found, (output, kind) = evaluate(sampler, grid.ravel()), np.divmod(given.sought, 4)
        errors, rates = (each.reshape(-1, *grid.shape)[output, rows] for each in (found.error, found.rate))
        values = np.where(kind % 2, -1, 1)[:, None] * np.where(kind[:, None] < 2, errors, rates)
        # the highest point inside the piece and its neighbours enclose a smooth maximum
        at = np.clip(np.argmax(np.nan_to_num(values, nan=-np.inf), axis=1), 1, _PARTS - 1)
        three = [values[rows, at + side] for side in (-1, 0, 1)]
        np.fmax.at(maxima, given.sought, np.fmax.reduce(three))
        given = _Candidates(given.sought, _promise(*three), grid[rows, at - 1], grid[rows, at + 1])
