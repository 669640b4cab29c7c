"""Extreme errors and rates of outputs over a run of the input: branch and bound, then smooth pieces.

The run is divided into steps narrower than the shortest pitch, and `rate_bounds` bounds errors and rates in each step.
Steps that cannot contain an extreme are discarded, and the remaining steps are repeatedly divided into four parts.
The last steps are divided at the kinks of all transmission functions. Errors are smooth on each piece, and the extremes
follow from Chebyshev polynomials and from the one-sided limits at jumps. The result does not depend on the sampled
positions of a run.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from math import ceil
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from geartrain.dynamics.motion.error_composition import ErrorComposition, common_period
from geartrain.dynamics.motion.kink_positions import InputSteps, KinkSearch, equal_steps
from geartrain.dynamics.motion.rate_bounds import RateBounds, StepBounds, error_difference
from geartrain.numerics.chebyshev import points

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import ErrorSamples
    from geartrain.numerics.arrays import Bools, Floats, Indices

_MOST_STEPS = 200_000  # maximum number of initial steps: those of a longer run are wider than a pitch
_FEWEST_STEPS = 64  # minimum number of initial steps
_MOST_LEFT = 50_000  # maximum number of narrow steps kept, those with the largest bounds (beam search)
_MOST_WIDE = 16_000  # maximum number of wide steps kept for all outputs: bounds of wide steps are rarely useful
_NUMBERS = 1 << 23  # maximum number of stored bounds
_PARTS = 4  # subdivisions of a step
_FEW = 1024  # steps that are cut at kinks without further division
_MINIMUM_DIVISIONS, _MOST_DIVISIONS = 2, 16  # levels of the branch-and-bound tree
_BATCH = 4096  # steps cut at kinks at once
_BATCHES = 16  # maximum number of batches: bounds the effort, the rest enters `dropped`
_MOST_KINKS = 200_000  # maximum number of kinks in a batch
_SURE = 1e-9  # of the range of an output's errors or rates: tolerance of the search
_ROUNDING = 1e-12  # rad: absolute tolerance, above rounding
_NODES, _TO_SERIES = points(8)  # Chebyshev nodes on a smooth piece, and the matrix from values to coefficients
_PLACES = np.linspace(-1, 1, 49)  # places on a piece at which its polynomial is evaluated
_TO_PLACES = chebyshev.chebvander(_PLACES, len(_NODES) - 1) @ _TO_SERIES
_BESIDE = 1e-9  # of a step: distance from the end of a piece at which its one-sided limit is taken
_ULPS = 32  # units in the last place of the turns: minimum distance, so that rounding does not pass a kink
_NO_PIECE = 4  # times that distance: kinks closer than this are not separated


def signed(error: Floats, rate: Floats) -> Floats:
    """Return errors, negated errors, rates and negated rates, shape (outputs, 4, n), whose maxima are searched for."""
    return np.stack([error, -error, rate, -rate], axis=1)


class BoundedSteps(NamedTuple):
    """Steps of the input, with upper bounds in each step of the values that are maximised, shape (outputs, 4, n)."""

    steps: InputSteps
    above: Floats

    @classmethod
    def joined(cls, parts: Sequence[BoundedSteps]) -> BoundedSteps:
        """Return the steps of all parts in one object."""
        low, high = (np.concatenate([part.steps[end] for part in parts]) for end in (0, 1))
        return cls(InputSteps(low, high), np.concatenate([part.above for part in parts], axis=2))

    def chosen(self, which: Bools | Indices | slice) -> BoundedSteps:
        """Return the steps selected by an index, a mask or a slice."""
        return BoundedSteps(InputSteps(self.steps.low[which], self.steps.high[which]), self.above[:, :, which])

    @property
    def number(self) -> int:
        """Number of steps."""
        return len(self.steps.low)

    @property
    def width(self) -> float:
        """Width of the widest step [revolutions]."""
        return float(np.max(self.steps.high - self.steps.low, initial=0.0))


class StepSearch:
    """Branch-and-bound search for the extremes of one composition, or of the difference of two, in steps of the input.

    parts               composition, and a second one to subtract if there is one
    share               fraction of the maximum number of wide steps that this search may store
    values              maxima found of errors, negated errors, rates, negated rates, shape (outputs, 4)
    dropped             upper bounds in steps not searched, or between evaluated positions, shape (outputs, 4)
    reversing_drivers   pairs whose driver turned against its mean motion at some position
    """

    def __init__(self, parts: tuple[ErrorComposition, ...], share: float = 1.0) -> None:
        self._parts = parts
        self._most_wide = int(_MOST_WIDE * share)
        self._bounds = tuple(RateBounds(part) for part in parts)
        self._kink_searches = tuple(KinkSearch(part) for part in parts)
        self.chunk = min(bounds.chunk for bounds in self._bounds)
        self.values = np.full((len(parts[0].outputs), 4), -np.inf)
        self.dropped = self.values.copy()
        self.reversing_drivers: set[str] = set()

    @cached_property
    def step(self) -> float:
        """Maximum width [revolutions] at which a step counts as narrow for every transmission function."""
        return min(kinks.step for kinks in self._kink_searches)

    @cached_property
    def _rate(self) -> float:
        """Mean number of kinks per revolution of the input."""
        return sum(kinks.rate for kinks in self._kink_searches)

    @property
    def tolerance(self) -> Floats:
        """Search tolerance: maxima that exceed the value found by less than this are not searched for, shape (outputs,
        4).
        """
        ranges = np.repeat(self.values[:, ::2] + self.values[:, 1::2], 2, axis=1)
        return np.maximum(_SURE * ranges, _ROUNDING)

    # ------------------------------------------------------------------------------------------------ branch and bound

    def over(self, start: float, end: float, step: float) -> None:
        """Search the run between two positions of the input, at most over its first common period, by branch and bound.

        step   width of the first steps, unless there are too many [revolutions]
        """
        period = common_period([source for part in self._parts for source in part.used])
        if period is not None and period < end - start:
            end = start + float(period)
        left, before = self._promising_of(self._first(start, end, step)), 0
        for division in range(_MOST_DIVISIONS):
            # narrow steps are divided at least twice, and then as long as their number decreases
            enough = division >= _MINIMUM_DIVISIONS and (left.number <= _FEW or left.number > before)
            if not left.number or (left.width <= self.step and enough):
                break
            before, left = left.number, self._promising_of(_divided(left.steps, self.chunk))
            most = min(_MOST_LEFT, _NUMBERS // (4 * len(self.values))) if left.width <= self.step else self._most_wide
            self._drop(left.chosen(slice(most, None)))
            left = left.chosen(slice(most))
        for _ in range(_BATCHES):
            # a wide step has too many kinks to list
            size = min(_BATCH, int(_MOST_KINKS / max(self._rate * left.width, 1.0)))
            if not left.number or not size:
                break
            self._cut_at_kinks(left.chosen(slice(size)).steps)
            left = self._promising(left.chosen(slice(size, None)))
        self._drop(left)

    def around(self, turns: Floats, step: float, start: float, end: float) -> None:
        """Search within `step`, but at most one narrow step, on each side of some positions of a run [revolutions]."""
        width = min(step, self.step)
        low = np.unique(np.clip(turns - width, start, end))
        # disjoint steps, because `_cut_at_kinks` assigns each piece to one step
        high = np.minimum(low + 2 * width, np.append(low[1:], end))
        self._cut_at_kinks(InputSteps(low[high > low], high[high > low]))

    def _first(self, start: float, end: float, step: float) -> Iterator[InputSteps]:
        """Return the whole run in equal steps."""
        wanted = (end - start) / step
        number = _MOST_STEPS if wanted > _MOST_STEPS else max(_FEWEST_STEPS, ceil(wanted))
        return equal_steps(start, end, number, self.chunk)

    def _promising_of(self, steps: Iterator[InputSteps]) -> BoundedSteps:
        """Return the steps that may contain an extreme, in descending order of their bounds."""
        return self._promising(BoundedSteps.joined([self._promising(self.bounded(part)) for part in steps]))

    def bounded(self, steps: InputSteps) -> BoundedSteps:
        """Return the steps with their bounds. Values at the ends of the steps are included in the maxima."""
        found = self._bounds[0].over(*steps)
        if len(self._bounds) > 1:
            found = StepBounds.difference(found, self._bounds[1].over(*steps))
        for passage in (found.low, found.high):
            self._count(passage)
        errors = found.errors()
        above = np.stack([errors.high, -errors.low, found.rate.high, -found.rate.low], axis=1)
        # the error is undefined where no teeth touch
        return BoundedSteps(steps, np.where(np.isnan(above), -np.inf, above))

    def _promising(self, given: BoundedSteps) -> BoundedSteps:
        """Return the steps that may exceed the maxima found so far, in descending order of their bounds."""
        excess = (given.above - self.values[:, :, None]) / self.tolerance[:, :, None]
        most = excess.max(axis=(0, 1), initial=-np.inf)
        # stable, so that ties do not depend on the platform
        order = np.argsort(-most, kind="stable")
        return given.chosen(order[: int(np.count_nonzero(most > 1))])

    def _drop(self, given: BoundedSteps) -> None:
        self.dropped = np.maximum(self.dropped, given.above.max(axis=2, initial=-np.inf))

    def _count(self, passage: ErrorSamples) -> None:
        for first, values in ((0, passage.error), (2, passage.rate)):
            # ignores NaN, where no teeth touch
            extremes = np.fmax.reduce(values, axis=1), -np.fmin.reduce(values, axis=1)
            self.values[:, first : first + 2] = np.fmax(self.values[:, first : first + 2], np.stack(extremes, axis=1))
        self.reversing_drivers |= passage.reversing_drivers

    # --------------------------------------------------------------------------------------------------- smooth pieces

    def _cut_at_kinks(self, steps: InputSteps) -> None:
        """Include in the maxima the extremes within disjoint steps, found separately on each smooth piece between
        kinks.
        """
        order = np.argsort(steps.low)
        low, high = steps.low[order], steps.high[order]
        kinks = [search.between(InputSteps(low, high)).turns for search in self._kink_searches]
        edges = np.unique(np.concatenate([low, high, *kinks]))
        middle, width = (edges[1:] + edges[:-1]) / 2, np.diff(edges)
        # step that contains each piece; gaps between steps are dropped
        within = np.maximum(np.searchsorted(low, middle) - 1, 0)
        # pieces end slightly before a kink, where one-sided limits are taken
        beside = np.maximum(_BESIDE * (high - low)[within], _ULPS * np.spacing(np.abs(middle)))
        held = (middle < high[within]) & (width > _NO_PIECE * beside)
        middle, half = middle[held], (width / 2 - beside)[held]
        size = max(1, self.chunk // len(_NODES))
        for first in range(0, len(middle), size):
            self._take_pieces(middle[first : first + size], half[first : first + size])

    def _take_pieces(self, middle: Floats, half: Floats) -> None:
        found = self._at((middle[:, None] + half[:, None] * _NODES).ravel())
        self._count(found)
        values = signed(found.error, found.rate).reshape(len(self.values), 4, len(middle), -1)
        likely: dict[int, list[float]] = {}
        for sought in np.ndindex(*self.values.shape):
            peak = self._peak(values[sought], sought)
            if peak is not None:
                likely.setdefault(peak[0], []).append(peak[1])
        # the composition is evaluated at the maxima of the polynomials, so that values are not interpolated
        if likely:
            turns = [middle[piece] + half[piece] * u for piece, places in likely.items() for u in places]
            self._count(self._at(np.array(turns)))

    def _at(self, turns: Floats) -> ErrorSamples:
        found = [part.at(turns) for part in self._parts]
        return found[0] if len(found) == 1 else error_difference(*found)

    def _peak(self, pieces: Floats, sought: tuple[int, ...]) -> tuple[int, float] | None:
        """Return the index of the piece with the largest maximum, and the position of this maximum in the piece, -1 to
        1.

        The result is None if no piece can exceed the maximum found so far, or if the largest maximum is at an end of
        its piece.

        pieces values at the Chebyshev nodes of each piece, shape (n, nodes)
        """
        # a polynomial of degree 8 hardly exceeds its values at the nodes, so pieces far below the maximum are skipped
        with np.errstate(invalid="ignore"):
            looked = np.flatnonzero(pieces.max(axis=1) + np.ptp(pieces, axis=1) > self.values[sought])
        if not len(looked):
            return None
        places = pieces[looked] @ _TO_PLACES.T
        at = np.clip(np.argmax(places, axis=1), 1, len(_PLACES) - 2)
        every = np.arange(len(at))
        one, two, three = (places[every, at + side] for side in (-1, 0, 1))
        # vertex of the parabola through the highest place and its neighbours
        bend = 2 * two - one - three
        with np.errstate(all="ignore"):
            inner = np.abs(three - one) < 2 * bend
            peaks = np.where(inner, two + (three - one) ** 2 / (8 * bend), places.max(axis=1))
        best = int(np.argmax(peaks))
        series = _TO_SERIES @ pieces[looked[best]]
        # the last coefficients of the series estimate the truncation error
        self.dropped[sought] = max(self.dropped[sought], peaks[best] + float(np.abs(series[-2:]).max()))
        if not inner[best]:
            return None
        turns = chebyshev.chebroots(chebyshev.chebder(series)).real
        near = turns[np.argmin(np.abs(turns - _PLACES[at[best]]))]
        return int(looked[best]), float(np.clip(near, -1, 1))


def _divided(steps: InputSteps, chunk: int) -> Iterator[InputSteps]:
    """Yield the steps, each divided into `_PARTS` equal parts, in chunks."""
    size = max(1, chunk // _PARTS)
    for first in range(0, len(steps.low), size):
        low, high = (each[first : first + size, None] for each in steps)
        ends = low + (high - low) * (np.arange(_PARTS + 1) / _PARTS)
        ends[:, -1:] = high
        yield InputSteps(ends[:, :-1].ravel(), ends[:, 1:].ravel())


class ExtremeSearch:
    """Search for the extremes of one composition, or of the difference of two compositions, over a run of the input."""

    def __init__(self, composition: ErrorComposition, less: ErrorComposition | None = None) -> None:
        parts = (composition,) if less is None else (composition, less)
        self._outputs = len(composition.outputs)
        # outputs that depend on the same pairs are searched together
        groups: dict[frozenset[int], list[int]] = {}
        for at in range(self._outputs):
            pairs = (source.pair for part in parts for source in _restricted(part, (at,)).used)
            groups.setdefault(frozenset(pairs), []).append(at)
        self._searches = [
            # the groups share the limit on stored wide steps
            (group, StepSearch(tuple(_restricted(part, group) for part in parts), 1 / len(groups)))
            for group in groups.values()
        ]

    @property
    def values(self) -> Floats:
        """Maxima found of errors, negated errors, rates, negated rates, shape (outputs, 4)."""
        return self._joined([search.values for _, search in self._searches])

    @property
    def uncertainty(self) -> Floats:
        """Upper bound on the true maxima minus the maxima found, 0 within twice the tolerance, shape (outputs, 4)."""
        beyond = [search.dropped - search.values for _, search in self._searches]
        tolerances = [search.tolerance for _, search in self._searches]
        return self._joined([np.where(b > 2 * t, b, 0.0) for b, t in zip(beyond, tolerances, strict=True)])

    @property
    def reversing_drivers(self) -> set[str]:
        """Pairs whose driver turned against its mean motion at some position."""
        return set().union(*(search.reversing_drivers for _, search in self._searches))

    def _joined(self, found: Sequence[Floats]) -> Floats:
        joined = np.empty((self._outputs, 4))
        for (group, _), values in zip(self._searches, found, strict=True):
            joined[group] = values
        return joined

    def over(self, start: float, end: float) -> None:
        """Search the run between two positions of the input [revolutions]."""
        step = min((search.step for _, search in self._searches), default=1.0)
        for _, search in self._searches:
            search.over(start, end, step)

    def around(self, turns: Floats, step: float, start: float, end: float) -> None:
        """Search in addition near positions where extremes are expected, shape (outputs, n) [revolutions]."""
        for group, search in self._searches:
            search.around(turns[group], step, start, end)


def _restricted(composition: ErrorComposition, outputs: Sequence[int]) -> ErrorComposition:
    seen = tuple(composition.outputs[at] for at in outputs)
    offsets = tuple(composition.offsets[at] for at in outputs) if composition.offsets else ()
    return ErrorComposition(composition.spread, composition.sources, seen, offsets)
