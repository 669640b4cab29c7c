"""Transmission functions given by a table or by harmonics, as periodic piecewise polynomials.

The deviation d from uniform motion is a polynomial on each piece, so that its extremes, those of the speed ratio, and
the moments are exact to rounding error. Tables give a periodic cubic spline, straight lines or steps; harmonics and
pitch curves are interpolated to rounding error.
"""

from __future__ import annotations

from itertools import pairwise
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.polynomial_pieces import extremes, fitted, moments, value
from geartrain.teeth.transmission import LosslessTransmission, SpeedLeap

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from fractions import Fraction
    from typing import Literal

    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Indices

_SLIGHT = 1e-12  # of the range of the speed ratio, or of the deviation: smaller jumps are rounding error


class TableTransmission(LosslessTransmission):
    """Transmission function q = m S + d(S + phase) with a periodic piecewise polynomial d.

    Parameters
    ----------
    ratio : Fraction
        Mean speed ratio m, without sign.
    edges : ndarray, (n + 1,)
        Driver angles at the ends of the pieces [rad], ascending, over one period.
    coefficients : ndarray, (k, n)
        Coefficients of d on each piece [rad of the driven side], by ascending powers of u, which increases from -1 to 1
        along the piece; at least two rows.
    phase : float, optional
        Angle of the driver at S = 0 [rad], default 0.
    waves : int, optional
        Number of periods of the fastest component in one period of a d that is smooth at the edges; 0 (default) if it
        has kinks there.

    See Also
    --------
    table_transmission, harmonic_transmission : make it from a table or from harmonics
    """

    def __init__(
        self, ratio: Fraction, edges: Floats, coefficients: Floats, phase: float = 0.0, waves: int = 0
    ) -> None:
        self.ratio, self.edges, self.coefficients, self.phase = ratio, edges, coefficients, phase
        self.smooth, self.waves = bool(waves), max(waves, 1)
        self.period = float(edges[-1] - edges[0])
        self.halves = np.diff(edges) / 2
        powers = np.arange(1, len(coefficients))[:, None]
        self.slopes = powers * coefficients[1:] / self.halves
        self.at_once = self.jumps

    def mirrored(self) -> TableTransmission:
        """Return the function for a driver whose forward sense is reversed: minus the deviation at minus the angle."""
        signs = np.where(np.arange(len(self.coefficients)) % 2, 1.0, -1.0)[:, None]
        waves = self.waves if self.smooth else 0
        return TableTransmission(
            self.ratio, -self.edges[::-1], (signs * self.coefficients)[:, ::-1], -self.phase, waves
        )

    def _place(self, S: ArrayLike) -> tuple[Indices, Floats]:
        """Return the index of the piece at driver angles S, and u in this piece."""
        x = self.edges[0] + np.mod(np.asarray(S, dtype=float) + self.phase - self.edges[0], self.period)
        piece = np.clip(np.searchsorted(self.edges, x, side="right") - 1, 0, len(self.halves) - 1)
        return piece, (x - self.edges[piece]) / self.halves[piece] - 1

    def error(self, S: ArrayLike) -> Floats:
        """Return the deviation from uniform motion at driver angles S [rad of the driven side]."""
        return value(self.coefficients, *self._place(S))[0]

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at driver angles S; at a kink the ratio after it."""
        return float(self.ratio) + value(self.slopes, *self._place(S))[0]

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio; jumps of the driven angle are not included."""
        low, high = extremes(self.slopes)
        return float(self.ratio) + low, float(self.ratio) + high

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum deviation from uniform motion [rad of the driven side]."""
        return extremes(self.coefficients)

    def error_moments(self) -> tuple[float, float]:
        """Return the mean of the deviation from uniform motion, and its rms value about the mean [rad]."""
        return moments(self.coefficients, self.halves)

    def kinks(self) -> list[float]:
        """Return the driver angles of the edges [rad]; an empty list if the function is smooth there."""
        return [] if self.smooth else [float(each) for each in self.edges[:-1] - self.phase]

    def speed_leaps(self) -> tuple[SpeedLeap, ...]:
        """Return the upward steps of the speed ratio at the edges."""
        before, after = self._at_edges(self.slopes)
        rises = after - before > _SLIGHT * (np.ptp(self.slopes[0]) + np.abs(self.slopes).max())
        mean = float(self.ratio)
        return tuple(
            SpeedLeap(mean + float(low), mean + float(high))
            for low, high in zip(before[rises], after[rises], strict=True)
        )

    def steepest_fall(self) -> float | None:
        """Return the maximum rate at which the speed ratio decreases [1/rad]; None if it falls abruptly at an edge."""
        before, after = self._at_edges(self.slopes)
        if self.jumps or (before - after > _SLIGHT * np.abs(self.slopes).max()).any():
            return None
        if len(self.slopes) < 2:
            return 0.0
        bends = np.arange(1, len(self.slopes))[:, None] * self.slopes[1:] / self.halves
        return max(0.0, -extremes(bends)[0])

    @property
    def jumps(self) -> bool:
        """True if the driven angle jumps at an edge."""
        before, after = self._at_edges(self.coefficients)
        low, high = self.error_range()
        return bool((np.abs(after - before) > _SLIGHT * (high - low)).any())

    @staticmethod
    def _at_edges(coefficients: Floats) -> tuple[Floats, Floats]:
        """Return the values before and after each edge, shape (n,) each."""
        signs = np.where(np.arange(len(coefficients)) % 2, -1.0, 1.0)
        return np.roll(coefficients.sum(axis=0), 1), signs @ coefficients


def table_transmission(
    ratio: Fraction,
    values: Sequence[float],
    period: float,
    between: Literal["smooth", "straight", "steps"] = "smooth",
    phase: float = 0.0,
) -> TableTransmission:
    """Return the transmission function whose deviation from uniform motion is a table at equal steps of the driver.

    Parameters
    ----------
    ratio : Fraction
        Mean speed ratio, without sign.
    values : sequence of float
        Deviations at the driver angles 0, period/n, 2 period/n, ... [rad of the driven side].
    period : float
        Angle of the driver after which the table repeats [rad].
    between : {"smooth", "straight", "steps"}
        Periodic cubic spline, straight lines, or constant values from each point to the next.
    phase : float, optional
        Angle of the driver at S = 0 [rad], default 0.
    """
    here = np.asarray(values, dtype=float)
    edges = np.arange(len(here) + 1) * (period / len(here))
    if between == "smooth":
        return TableTransmission(ratio, edges, spline_pieces(here), phase)
    there = np.roll(here, -1) if between == "straight" else here
    return TableTransmission(ratio, edges, np.array([(here + there) / 2, (there - here) / 2]), phase)


def spline_pieces(values: Floats) -> Floats:
    """Return the coefficients of the periodic cubic spline through values at equal steps, shape (4, n), by ascending
    powers of u.
    """
    before, after = np.roll(values, 1), np.roll(values, -1)
    # slopes s per step satisfy s[i-1] + 4 s[i] + s[i+1] = 3 (y[i+1] - y[i-1]): a circulant system, solved by FFT
    eigenvalues = 4 + 2 * np.cos(2 * pi * np.arange(len(values) // 2 + 1) / len(values))
    slopes = np.fft.irfft(np.fft.rfft(3 * (after - before)) / eigenvalues, len(values))
    ahead = np.roll(slopes, -1)
    # Hermite form on u from -1 to 1
    bend, rise = (slopes - ahead) / 8, after - values
    tilt = rise / 4 - (slopes + ahead) / 8
    return np.array([(values + after) / 2 + bend, rise / 2 + tilt, -bend, -tilt])


def harmonic_transmission(
    ratio: Fraction, harmonics: Mapping[int, tuple[float, float]], period: float, phase: float = 0.0
) -> TableTransmission:
    """Return the transmission function whose deviation from uniform motion is a sum of harmonics.

    Parameters
    ----------
    ratio : Fraction
        Mean speed ratio, without sign.
    harmonics : mapping of int to (float, float)
        Order k -> amplitude [rad of the driven side] and phase angle [rad] of a term A sin(2 pi k S / period + angle).
    period : float
        Angle of the driver after which the sum repeats [rad].
    phase : float, optional
        Angle of the driver at S = 0 [rad], default 0.
    """
    orders = np.array(list(harmonics), dtype=float)[:, None]
    sizes, angles = np.array(list(harmonics.values()), dtype=float).T[..., None]

    def curve(x: Floats) -> Floats:
        return np.asarray(np.sum(sizes * np.sin(orders * x * (2 * pi / period) + angles), axis=0)[None])

    return fitted_transmission(ratio, curve, np.array([0.0, period]), phase, waves=int(orders.max()))


def fitted_transmission(
    ratio: Fraction, curve: Callable[[Floats], Floats], cuts: Floats, phase: float = 0.0, waves: int = 0
) -> TableTransmission:
    """Return the transmission function whose deviation from uniform motion interpolates a curve to rounding error.

    curve   function of driver angles, shape (n,), that returns deviations [rad], shape (1, n)
    cuts    ends of the smooth parts of the curve over one period [rad], ascending
    """
    pieces = [piece for low, high in pairwise(cuts.tolist()) for piece in fitted(curve, low, high)]
    edges = np.array([*(piece.start for piece in pieces), cuts[-1]])
    return TableTransmission(ratio, edges, np.array([piece.coefficients[:, 0] for piece in pieces]).T, phase, waves)
