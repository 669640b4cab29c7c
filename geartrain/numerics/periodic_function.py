"""Periodic functions of one variable, given by points, harmonics or functions, with their derivatives and extremes.

Extremes between points are found as bracketed roots of the derivative between samples.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from functools import cached_property
from itertools import pairwise
from math import inf, isfinite, perm, pi, sqrt
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
from numpy.polynomial.polynomial import polyint

from geartrain.errors import Problem, RangeError
from geartrain.numerics.polynomial_pieces import PolynomialPiece, fitted
from geartrain.numerics.roots import roots_by_false_position

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats

Interpolation = Literal["pchip", "cubic", "linear", "steps"]
"""Interpolation between points: monotone cubics, periodic cubic spline, straight lines, or the last point's value."""

_FEWEST_POINTS = {"pchip": 3, "cubic": 4, "linear": 2, "steps": 2}
_PER_WAVE = 32  # samples of the shortest wave
_INSET = 16 * float(np.finfo(float).eps)  # periods: distance of the samples from breakpoints, several rounding errors
_FINE = 1e-9  # [brackets] the value at a stationary point is exact to the square of its error
_MOST_SAMPLES = 5_000_000
_GAUSS = np.polynomial.legendre.leggauss(8)  # exact to degree 15


class PeriodicFunction(ABC):
    """Function f with f(x + period) = f(x) that is smooth between its breakpoints.

    period        period, which is positive
    breakpoints   ascending positions in [0, period) at which the function or one of its derivatives is discontinuous
    resolution    maximum distance between samples that resolve the function between breakpoints
    """

    period: float
    breakpoints: Floats
    resolution: float = inf
    per_interval: int = 9
    """Minimum number of samples in an interval between breakpoints."""

    @property
    def waves(self) -> float:
        """Number of periods of the fastest component in one period of the function; 0 if only breakpoints count."""
        return self.period / self.resolution / _PER_WAVE

    @abstractmethod
    def derivative(self, x: ArrayLike, order: int = 1) -> Floats:
        """Return the derivative of the given order, from 0 (the function) to 3, at any positions."""

    def __call__(self, x: ArrayLike) -> Floats:
        """Return the values of the function at any positions."""
        return self.derivative(x, 0)

    @cached_property
    def _samples(self) -> Floats:
        """Ascending positions over a period, at most `resolution` apart, with one close to each side of breakpoints."""
        starts = self.breakpoints if len(self.breakpoints) else np.zeros(1)
        widths = np.diff(starts, append=starts[0] + self.period)
        counts = self.per_interval + np.ceil(widths / self.resolution).astype(np.int64)
        if counts.sum() > _MOST_SAMPLES:
            what = f"a periodic function with {len(starts)} breakpoints in one period is too long"
            why = f"its extremes need {counts.sum()} samples, and at most {_MOST_SAMPLES} are computed"
            raise RangeError(Problem(what, why, "give fewer points, or parts with a shorter common period"))
        at = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        inset = _INSET * self.period
        found: Floats = np.repeat(starts + inset, counts) + np.repeat((widths - 2 * inset) / (counts - 1), counts) * at
        return found

    def extremes(self, order: int = 0) -> tuple[float, float]:
        """Return the minimum and maximum over a period of the derivative of order 0 to 2; NaN values are ignored."""
        x = self._samples
        slopes = self.derivative(x, order + 1)
        turns = np.flatnonzero(slopes[:-1] * slopes[1:] < 0)
        low, high = x[turns], x[turns + 1]
        at = roots_by_false_position(
            lambda x, _: self.derivative(x, order + 1),
            low,
            high,
            slopes[turns],
            slopes[turns + 1],
            _FINE * float((high - low).min(initial=inf)),
        )
        values = self.derivative(np.append(x, at), order)
        return float(np.nanmin(values)), float(np.nanmax(values))

    def minimum_at(self, order: int = 0) -> float:
        """Return the approximate position in [0, period) of the minimum of a derivative of order 0 to 2."""
        return float(self._samples[np.argmin(self.derivative(self._samples, order))] % self.period)

    def moments(self) -> tuple[float, float]:
        """Return the mean and the root mean square deviation from it over a period, by Gauss-Legendre quadrature."""
        x, (nodes, weights) = self._samples, _GAUSS
        half = np.diff(x) / 2
        values = self(x[:-1, None] + half[:, None] * (1 + nodes))
        mean = float(half @ values @ weights) / self.period
        # two passes: the mean of squares minus the square of the mean would cancel
        return mean, sqrt(float(half @ (values - mean) ** 2 @ weights) / self.period)

    def sides(self, order: int) -> tuple[Floats, Floats]:
        """Return the left and right limits of the derivative of the given order, from 0 to 3, at each breakpoint."""
        inset = _INSET * self.period
        return self.derivative(self.breakpoints - inset, order), self.derivative(self.breakpoints + inset, order)


class PeriodicPieces(PeriodicFunction):
    """Periodic function that is a polynomial on each piece.

    starts         ascending positions at which the pieces begin
    coefficients   coefficients of the powers of the distance from the piece's origin, in descending order of powers
    period         period, at least the difference between the last and the first start
    origins        origin of each piece; by default its start
    """

    def __init__(self, starts: Floats, coefficients: Floats, period: float, origins: Floats | None = None) -> None:
        self.breakpoints, self._coefficients, self.period = starts, coefficients, period
        # positions are compared with differences of starts, so that each start is in the piece that it begins
        self._starts = starts - starts[0]
        self._origins = self._starts if origins is None else origins - starts[0]
        self._first, self.per_interval = starts[0], max(self.per_interval, len(coefficients) + 2)

    def derivative(self, x: ArrayLike, order: int = 1) -> Floats:
        """Return the derivative of the given order, from 0 (the function) to 3, at any positions."""
        u = np.mod(np.asarray(x, dtype=float) - self._first, self.period)
        piece = np.searchsorted(self._starts, u, side="right") - 1
        u = u - self._origins[piece]
        found = np.zeros(u.shape)
        for power, row in zip(range(len(self._coefficients) - 1, order - 1, -1), self._coefficients, strict=False):
            found = found * u + perm(power, order) * row.take(piece)
        return found


class PeriodicTable(PeriodicPieces):
    """Periodic function that interpolates points.

    positions       ascending positions in [0, period)
    values          values at these positions
    period          period
    interpolation   "pchip" never exceeds the values of neighbouring points; "cubic" is twice differentiable; "steps"
                    keeps each value up to the next point
    """

    def __init__(
        self,
        positions: Sequence[float],
        values: Sequence[float],
        period: float,
        interpolation: Interpolation = "pchip",
    ) -> None:
        check_points(positions, values, period, interpolation)
        starts, closed = np.array(positions, dtype=float), np.append(np.array(values, dtype=float), values[0])
        super().__init__(starts, _cubics(np.append(starts, positions[0] + period), closed, interpolation), period)


def _cubics(x: Floats, y: Floats, interpolation: Interpolation) -> Floats:
    """Return the coefficients of the cubics between points, in descending order of powers, shape (4, pieces)."""
    if interpolation == "steps":
        return np.vstack([np.zeros((3, len(x) - 1)), y[:-1]])
    if interpolation == "linear":
        return np.vstack([np.zeros((2, len(x) - 1)), np.diff(y) / np.diff(x), y[:-1]])
    from scipy.interpolate import CubicSpline, PchipInterpolator

    if interpolation == "cubic":
        return np.asarray(CubicSpline(x, y, bc_type="periodic").c)
    # a slope depends on the two neighbouring intervals, so that one more point at each end makes the curve periodic
    period = x[-1] - x[0]
    around = np.concatenate(([x[-2] - period], x, [x[1] + period]))
    return np.asarray(PchipInterpolator(around, np.concatenate(([y[-2]], y, [y[1]]))).c[:, 1:-1])


def check_points(
    positions: Sequence[float], values: Sequence[float], period: float, interpolation: Interpolation
) -> None:
    """Raise `RangeError` if the points do not define a periodic function."""
    if interpolation not in get_args(Interpolation):
        known = ", ".join(get_args(Interpolation))
        what, why = f"unknown interpolation '{interpolation}'", f"the interpolations are {known}"
        raise RangeError(Problem(what, why, "write `interpolation: pchip`"))
    fewest = _FEWEST_POINTS[interpolation]
    if len(positions) < fewest or len(positions) != len(values):
        what = f"{len(positions)} positions and {len(values)} values are not enough points"
        why = f"interpolation by {interpolation} needs at least {fewest} points, each with a value"
        raise RangeError(Problem(what, why, "give more points over the period"))
    if not all(map(isfinite, (*positions, *values, period))) or period <= 0:
        why = "positions, values and period must be finite, and the period above 0"
        raise RangeError(
            Problem("a table of a periodic function contains an invalid number", why, "replace this number")
        )
    for at, x in enumerate(positions):
        if not 0 <= x < period:
            what = f"the position of point {at + 1}, {x:.10g}, is outside the period from 0 to {period:.10g}"
            why = "the points repeat after the period, and the end of the period is its start"
            raise RangeError(Problem(what, why, "give each position once, from 0 up to the period, without its end"))
        if at and x <= positions[at - 1]:
            what = f"the position of point {at + 1}, {x:.10g}, is not greater than that of the previous point"
            raise RangeError(Problem(what, "positions must ascend", "sort the points, without repeated positions"))


def periodic_integral(
    slope: Callable[[Floats], Floats], period: float, breakpoints: Sequence[float] | Floats = ()
) -> tuple[PeriodicPieces, float]:
    """Return the integral of a periodic slope minus its mean, and this mean. The integral begins at the first
    breakpoint, or at 0 if there is none.

    slope         function that returns the slope at positions of shape (n,), as an array of the same shape
    period        period
    breakpoints   positions at which the slope or one of its derivatives is discontinuous
    """
    cuts, inset = np.unique(np.mod(np.array(breakpoints, dtype=float), period)), _INSET * period
    edges = cuts.tolist() or [0.0]

    def between(low: float, high: float) -> list[PolynomialPiece]:
        # shrunk a little about the middle, so that the slope is not evaluated beyond a breakpoint
        return fitted(lambda x: slope(x + inset * (low + high - 2 * x) / (high - low))[None], low, high)

    pieces = [piece for ends in pairwise([*edges, edges[0] + period]) for piece in between(*ends)]
    starts, ends = np.array([(piece.start, piece.end) for piece in pieces]).T
    half = (ends - starts) / 2
    rising = polyint(np.array([piece.coefficients[:, 0] for piece in pieces]).T, lbnd=-1) * half
    rises = rising.sum(axis=0)
    mean = float(rises.sum()) / period
    rising[0] += np.cumsum(rises) - rises - mean * (starts + half - starts[0])
    rising[1] -= mean * half
    coefficients = (rising / half ** np.arange(len(rising))[:, None])[::-1]
    found = PeriodicPieces(starts, coefficients, period, starts + half)
    found.breakpoints, found.resolution = cuts, float(half.min()) / found.per_interval
    return found, mean


class HarmonicSeries(PeriodicFunction):
    """Sum of a constant and harmonics of the form amplitude sin(2 pi n x / period + phase).

    terms      order n (an integer of 1 or more), amplitude and phase [rad] of each harmonic
    period     period of the first harmonic
    constant   constant, which is the mean of the function
    """

    def __init__(self, terms: Sequence[tuple[float, float, float]], period: float, constant: float = 0.0) -> None:
        for n, amplitude, phase in terms:
            if n < 1 or n != int(n) or not (isfinite(amplitude) and isfinite(phase)):
                what = f"the harmonic of order {n:g}, amplitude {amplitude:g} and phase {phase:g} is out of range"
                why = "orders are whole numbers from 1, since the series repeats after one period; values are finite"
                raise RangeError(Problem(what, why, "give orders 1, 2, 3, ... of the period"))
        self.terms, self.period, self.constant = tuple(terms), period, constant
        self.breakpoints = np.zeros(0)
        self.resolution = period / max((n for n, _, _ in terms), default=1) / _PER_WAVE

    def derivative(self, x: ArrayLike, order: int = 1) -> Floats:
        """Return the derivative of the given order, from 0 (the function) to 3, at any positions."""
        angle = np.mod(np.asarray(x, dtype=float), self.period) * (2 * pi / self.period)
        found = np.full(angle.shape, 0.0 if order else self.constant)
        for n, amplitude, phase in self.terms:
            # each derivative advances the phase by a quarter of a wave
            wave = np.cos if order % 2 else np.sin
            sign = -1 if order in (2, 3) else 1
            found += sign * amplitude * (2 * pi * n / self.period) ** order * wave(n * angle + phase)
        return found


class PeriodicSum(PeriodicFunction):
    """Sum of periodic functions with a common period.

    parts    functions that are added
    period   period of the sum, which is a multiple of the period of each part
    """

    def __init__(self, parts: Sequence[PeriodicFunction], period: float) -> None:
        self.parts, self.period = tuple(parts), period
        self.resolution = min((part.resolution for part in parts), default=inf)

    @cached_property
    def breakpoints(self) -> Floats:  # type: ignore[override]
        """Ascending positions in [0, period) of the breakpoints of all parts."""
        cuts = [
            (np.arange(round(self.period / part.period))[:, None] * part.period + part.breakpoints).ravel()
            for part in self.parts
        ]
        found = np.unique(np.concatenate([np.zeros(0), *cuts]))
        # breakpoints of two parts that differ by rounding are one
        return found[np.diff(found, prepend=-self.period) > 4 * _INSET * self.period]

    def derivative(self, x: ArrayLike, order: int = 1) -> Floats:
        """Return the derivative of the given order, from 0 (the function) to 3, at any positions."""
        x = np.asarray(x, dtype=float)
        found = np.zeros(x.shape)
        for part in self.parts:
            found += part.derivative(x, order)
        return found
