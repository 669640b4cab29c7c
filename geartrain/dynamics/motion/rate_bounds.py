"""Bounds on errors and rates of outputs over steps of the input, by interval arithmetic along the order of solution.

The angle S_m of every driver is known at both ends of a step. Within the step it is between these values; if the driver
can reverse, the range is extended according to the driver's minimum speed. A table of each transmission function gives
bounds of the speed ratio tau_m in this range. Rates follow as intervals: rate(driven) = sigma (tau - mean tau) S',
summed by equation (2) of docs/motion.md. For coupled pairs they follow from Krawczyk's operator. An error with a rate
between r and R is bounded by its values at the ends (Piyavskii's bounds).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorComposition, ErrorSamples, InputPhase

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import CompositionStep, PairErrorSource
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.transmission import TransmissionFunction


class RangeExtremes:
    """Minimum and maximum over ranges of cyclic cells in constant time, by a sparse table."""

    def __init__(self, minimum: Floats, most: Floats) -> None:
        self.count = len(minimum)
        self._first = minimum, most

    @cached_property
    def _levels(self) -> tuple[Floats, Floats]:
        """Minimum and maximum of the 2^k cells that follow each cell, shape (levels, n)."""
        minimum, most = [self._first[0]], [self._first[1]]
        length = 1
        while 2 * length <= self.count:
            minimum.append(np.minimum(minimum[-1], np.roll(minimum[-1], -length)))
            most.append(np.maximum(most[-1], np.roll(most[-1], -length)))
            length *= 2
        return np.stack(minimum), np.stack(most)

    def over(self, first: Ints, last: Ints) -> tuple[Floats, Floats]:
        """Return minimum and maximum over the cells `first` to `last`, integers modulo the number of cells."""
        length = np.clip(last - first + 1, 1, self.count)
        level = np.frexp(length)[1] - 1  # floor of the binary logarithm: two overlapping blocks of 2^level cells cover
        one, other = first % self.count, (first + length - (1 << level)) % self.count
        minimum, most = self._levels
        return (
            np.minimum(minimum[level, one], minimum[level, other]),
            np.maximum(most[level, one], most[level, other]),
        )


_CELLS = 1024  # minimum number of cells per period in a table of the speed ratio
_A_KINK = 64  # cells per kink of a transmission function, if that is more
_WITHIN = 4  # samples of the speed ratio in a cell
_MARGIN = 0.25  # of the change within a cell: allowance for values beyond these samples
_BESIDE = 1e-9  # of a period: distance from a kink at which its one-sided limits are taken


class Interval(NamedTuple):
    """Intervals given by arrays of minimum and maximum, which have the same shape."""

    low: Floats
    high: Floats

    def __add__(self, other: Interval) -> Interval:  # type: ignore[override]
        return Interval(self.low + other.low, self.high + other.high)

    def __mul__(self, other: Interval) -> Interval:  # type: ignore[override]
        """Return the interval of the product."""
        each = np.stack([self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high])
        return Interval(each.min(axis=0), each.max(axis=0))

    def scaled(self, factor: float) -> Interval:
        """Return the interval times a number."""
        ends = factor * self.low, factor * self.high
        return Interval(*(ends if factor >= 0 else ends[::-1]))

    @property
    def middle(self) -> Floats:
        """Midpoint of the interval."""
        return (self.low + self.high) / 2

    @property
    def radius(self) -> Floats:
        """Half of the width of the interval."""
        return (self.high - self.low) / 2


class SpeedRanges:
    """Bounds on the speed ratio of a transmission function over ranges of driver angles, from a table."""

    def __init__(self, transmission: TransmissionFunction) -> None:
        self.period = transmission.period
        kinks = np.mod(np.asarray(transmission.kinks(), dtype=float), transmission.period)
        self.cells = max(_CELLS, _A_KINK * len(kinks))
        width = transmission.period / self.cells
        # not at the edges of a cell, where the ratio of the neighbouring cell may apply
        inside = (np.arange(_WITHIN) / (_WITHIN - 1)) * (1 - 2 * _BESIDE) + _BESIDE
        values = transmission.speed((np.arange(self.cells)[:, None] + inside) * width)
        minimum, most = np.nanmin(values, axis=1), np.nanmax(values, axis=1)
        # the ratio may jump at a kink, so both one-sided limits are included
        for side in (-_BESIDE, _BESIDE):
            at = kinks + side * transmission.period
            cell, value = np.floor(at / width).astype(int) % self.cells, transmission.speed(at)
            np.fmin.at(minimum, cell, value)
            np.fmax.at(most, cell, value)
        spread = _MARGIN * (most - minimum)
        self._extremes = RangeExtremes(minimum - spread, most + spread)

    def over(self, phase: Floats, travel: Interval) -> Interval:
        """Return bounds on the speed ratio for driver angles from `phase` + travel.low to `phase` + travel.high
        [rad].
        """
        scale = self.cells / self.period
        first, last = (np.floor((phase + end) * scale) for end in travel)
        # one period includes all values, so that more periods need not be counted
        last = np.minimum(last, first + self.cells)
        return Interval(*self._extremes.over(first.astype(np.int64), last.astype(np.int64)))


def error_difference(one: ErrorSamples, other: ErrorSamples) -> ErrorSamples:
    """Return the errors of `one` minus the errors of `other` at the same positions, with the reversing drivers of
    both.
    """
    both = one.reversing_drivers | other.reversing_drivers
    return ErrorSamples(one.turns, one.error - other.error, one.rate - other.rate, both)


class StepBounds(NamedTuple):
    """Errors and rates of outputs at the ends of steps, and bounds on the rates between them, shape (outputs, n)."""

    low: ErrorSamples
    high: ErrorSamples
    rate: Interval

    @classmethod
    def difference(cls, one: StepBounds, other: StepBounds) -> StepBounds:
        """Return the bounds for the errors of one composition minus the errors of another."""
        ends = error_difference(one.low, other.low), error_difference(one.high, other.high)
        return cls(*ends, one.rate + other.rate.scaled(-1.0))

    def errors(self) -> Interval:
        """Return bounds on the errors within each step [rad]."""
        angle = 2 * np.pi * (self.high.turns - self.low.turns)
        start, end, (minimum, most) = self.low.error, self.high.error, self.rate
        with np.errstate(all="ignore"):
            # the steepest lines from both ends intersect at the bound (Piyavskii)
            up = np.clip((end - start - minimum * angle) / (most - minimum), 0, angle)
            down = np.clip((most * angle - (end - start)) / (most - minimum), 0, angle)
            above = np.where(most > minimum, start + most * up, np.maximum(start, end))
            below = np.where(most > minimum, start + minimum * down, np.minimum(start, end))
        lower, upper = np.minimum(start, end), np.maximum(start, end)
        known = np.isfinite(minimum) & np.isfinite(most)
        return Interval(
            np.where(known, np.minimum(below, lower), -np.inf), np.where(known, np.maximum(above, upper), np.inf)
        )


@dataclass(frozen=True)
class RateBounds:
    """Bounds on errors and rates of a composition's outputs over steps of the input."""

    composition: ErrorComposition

    @cached_property
    def _sources(self) -> dict[int, PairErrorSource]:
        return {at: self.composition.sources[at] for step in self.composition.steps for at in step.sources}

    @cached_property
    def _whole(self) -> ErrorComposition:
        """Composition with additional outputs: the drivers of its sources relative to their carriers."""
        given = self.composition
        drivers = tuple(given.seen_driver(source) for source in self._sources.values())
        offsets = (*given.offsets, *(0.0 for _ in drivers)) if given.offsets else ()
        return replace(given, outputs=(*given.outputs, *drivers), offsets=offsets)

    @cached_property
    def _ranges(self) -> dict[int, SpeedRanges]:
        return {at: SpeedRanges(source.transmission) for at, source in self._sources.items()}

    @property
    def chunk(self) -> int:
        """Maximum number of steps evaluated at once."""
        return self._whole.chunk

    def over(self, low: Floats, high: Floats) -> StepBounds:
        """Return bounds over steps from position `low` to position `high` of the input [revolutions], shape (n,), at
        most `chunk` steps.
        """
        # most steps begin where others end, so that shared ends are evaluated once
        edges, at_edge = np.unique(np.concatenate([low, high]), return_inverse=True)
        found = self._whole.at(edges)
        ends = [
            ErrorSamples(edges[which], found.error[:, which], found.rate[:, which], found.reversing_drivers)
            for which in np.split(at_edge, 2)
        ]
        own = len(self.composition.outputs)
        shifts = {}
        for at, (index, source) in enumerate(self._sources.items(), own):
            way = source.forward * source.driver_sense
            shifts[index] = way * ends[0].error[at], way * ends[1].error[at]
        rate = self._rates(low, 2 * np.pi * (high - low), shifts)
        first, last = (each._replace(error=each.error[:own], rate=each.rate[:own]) for each in ends)
        return StepBounds(first, last, rate)

    def _rates(self, low: Floats, angle: Floats, shifts: dict[int, tuple[Floats, Floats]]) -> Interval:
        """Return bounds on the rates of the outputs [1], shape (outputs, n)."""
        still = Interval(np.zeros(len(low)), np.zeros(len(low)))
        rates = [still] * len(self.composition.sources)
        phase = InputPhase(low)
        for step in self.composition.steps:
            known = [rates[at] for at in step.known]
            # driver speeds with the errors of earlier pairs; the step's own are added in `_pair_rates`
            turning = []
            for at, row in zip(step.sources, step.from_known, strict=True):
                mean = self._sources[at].mean
                turning.append(_summed(row, known, Interval(still.low + mean, still.high + mean)))
            for at, found in zip(step.sources, self._pair_rates(step, turning, phase, angle, shifts), strict=True):
                rates[at] = found
        outputs = [_summed(row, rates, still) for row in self.composition.weights]
        return Interval(np.stack([each.low for each in outputs]), np.stack([each.high for each in outputs]))

    def _pair_rates(
        self,
        step: CompositionStep,
        turning: list[Interval],
        phase: InputPhase,
        angle: Floats,
        shifts: dict[int, tuple[Floats, Floats]],
    ) -> list[Interval]:
        """Return bounds on the rates that a step's pairs add to their driven sides [1]."""
        if not step.coupled:
            slopes = self._slopes(step, turning, phase, angle, shifts)
            return [slope * speed for slope, speed in zip(slopes, turning, strict=True)]
        gain = step.own
        found = _coupled_rates(self._slopes(step, turning, phase, angle, shifts), turning, gain)
        whole = [speed + _summed(row, found, speed.scaled(0.0)) for speed, row in zip(turning, gain, strict=True)]
        if any((speed.low < 0).any() for speed in whole):
            # a driver may reverse, and pass angles beyond those at the ends
            found = _coupled_rates(self._slopes(step, whole, phase, angle, shifts), turning, gain)
        return found

    def _slopes(
        self,
        step: CompositionStep,
        turning: list[Interval],
        phase: InputPhase,
        angle: Floats,
        shifts: dict[int, tuple[Floats, Floats]],
    ) -> list[Interval]:
        """Return bounds on sigma (tau - mean tau) for the pairs of a step [1]."""
        found = []
        for at, speed in zip(step.sources, turning, strict=True):
            source, (first, last) = self._sources[at], shifts[at]
            transmission = source.transmission
            start = np.mod(
                phase.cycles(source.cycles) * transmission.period + source.start + first, transmission.period
            )
            # the driver covers at least the range between its end angles
            travel = source.mean * angle + (last - first)
            # a driver that can turn back may leave this range at both ends
            back = np.nan_to_num(
                np.maximum(0.0, -speed.low) * angle, nan=transmission.period, posinf=transmission.period
            )
            ratio = self._ranges[at].over(
                start, Interval(np.minimum(0.0, travel) - back, np.maximum(0.0, travel) + back)
            )
            mean = float(transmission.ratio)
            found.append(Interval(ratio.low - mean, ratio.high - mean).scaled(float(source.sense)))
        return found


def _summed(row: Floats, each: list[Interval], still: Interval) -> Interval:
    total = still
    for factor, interval in zip(row.tolist(), each, strict=True):
        if factor:
            total = total + interval.scaled(factor)
    return total


def _coupled_rates(slopes: list[Interval], turning: list[Interval], gain: Floats) -> list[Interval]:
    """Return intervals of x = slope (w + gain x) for intervals of slopes and speeds w; infinite intervals if none is
    found.

    Krawczyk's operator: with the middle slope m, the solution of J x = b, J = I - diag(m) G, has an error of at most r,
    where r = |J^-1| (rad b + rad slope |G| (|x| + r)) is solved for r.
    """
    count = len(slopes)
    middle, radius = (np.stack([getattr(slope, part) for slope in slopes]) for part in ("middle", "radius"))
    right = [slope * speed for slope, speed in zip(slopes, turning, strict=True)]
    b, off = (np.stack([getattr(each, part) for each in right]) for part in ("middle", "radius"))
    matrices = np.eye(count) - middle.T[:, :, None] * gain
    fit = np.isfinite(matrices).all(axis=(1, 2)) & np.isfinite(b).all(axis=0) & np.isfinite(off).all(axis=0)
    fit[fit] = np.abs(np.linalg.det(matrices[fit])) > 1e-9  # nearly singular middles give no useful bound
    matrices[~fit] = np.eye(count)
    inverse = np.linalg.inv(matrices)
    x = np.einsum("nij,jn->in", inverse, b)
    size = np.abs(inverse)
    spread = size @ (radius.T[:, :, None] * np.abs(gain))
    # Krawczyk's operator needs a contraction: the maximum norm of the spread is below 1
    fit &= spread.sum(axis=2).max(axis=1) < 1
    spread[~fit] = 0
    known = off + radius * (np.abs(gain) @ np.abs(x))
    r = np.linalg.solve(np.eye(count) - spread, size @ known.T[:, :, None])[:, :, 0].T
    low, high = np.where(fit, x - r, -np.inf), np.where(fit, x + r, np.inf)
    return [Interval(low[at], high[at]) for at in range(count)]
