"""A periodic law of two outlines as polynomials between the driver's angles at which it has a corner."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.numerics.decimal_text import fraction_text
from geartrain.numerics.polynomial_pieces import value
from geartrain.teeth.contact.outline_contact import KINDS

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Indices


_GAUSS = np.polynomial.legendre.leggauss(20)


@dataclass(frozen=True)
class PiecewiseTransmission:
    """The driven angle as a function of the driver's, angle = ratio phi1 + error, repeating itself after a period.

    ratio         driven over driver, without sign
    period        driver's angle (rad)
    breaks        (n + 1,): ends of the stretches, from `breaks[0]` one period on
    middles, halves   (n,): u = (phi1 - middle) / half on each stretch, from -1 to 1 but for rounding
    errors, speeds   (COUNT, n): coefficients of error (rad) and of d angle / d phi1 by powers of u
    pair, kind    (n,): the driver's tooth that touches, an index into `KINDS` or -1 where none is in reach
    corners       driver's angles where something else begins to touch
    uncertainty, speed_uncertainty   twice the greatest differences found between nodes (rad; none)
    """

    ratio: Fraction
    period: float
    breaks: Floats
    middles: Floats
    halves: Floats
    errors: Floats
    speeds: Floats
    pair: Indices
    kind: Indices
    corners: Floats
    uncertainty: float
    speed_uncertainty: float

    def error(self, phi1: ArrayLike) -> Floats:
        """Transmission error (rad of the driven wheel) at driver's angles (rad), any shape; NaN where none touches."""
        return self._of(self.errors, phi1)

    def speed(self, phi1: ArrayLike) -> Floats:
        """d angle / d phi1 at driver's angles (rad)."""
        return self._of(self.speeds, phi1)

    def angle(self, phi1: ArrayLike) -> Floats:
        """Driven angle (rad) at driver's angles (rad)."""
        return self.error(phi1) + float(self.ratio) * np.asarray(phi1, dtype=float)

    def _of(self, coefficients: Floats, phi1: ArrayLike) -> Floats:
        phi1 = np.asarray(phi1, dtype=float)
        flat = phi1.ravel()
        rest = flat - self.breaks[0]
        rest -= np.floor(rest / self.period) * self.period
        rest += self.breaks[0]
        which = np.clip(np.searchsorted(self.breaks, rest, side="right") - 1, 0, len(self.breaks) - 2)
        u = (rest - self.middles[which]) / self.halves[which]
        return value(coefficients, which, u)[0].reshape(phi1.shape)

    def extremes(self) -> tuple[float, float]:
        """Least and greatest transmission error (rad): at corners, or where its slope is 0."""
        return _range(self.errors)

    def speed_range(self) -> tuple[float, float]:
        """Least and greatest speed ratio."""
        return _range(self.speeds)

    def moments(self) -> tuple[float, float]:
        """Mean of the transmission error over a period, and its rms about that mean (rad); NaN with gaps in contact."""
        points, weights = _GAUSS
        error = np.polynomial.polynomial.polyval(points, self.errors)
        share = self.halves / self.halves.sum() / 2
        mean = float(share @ error @ weights)
        return mean, float(np.sqrt(share @ (error - mean) ** 2 @ weights))

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        low, high = self.extremes()
        return {
            "ratio": fraction_text(self.ratio),
            "period": self.period,
            "breaks": self.breaks.tolist(),
            "pair": self.pair.tolist(),
            "kind": np.array([*KINDS, "none"])[self.kind].tolist(),
            "corners": self.corners.tolist(),
            "error_min": low,
            "error_max": high,
            "uncertainty": self.uncertainty,
            "speed_uncertainty": self.speed_uncertainty,
        }


def _range(coefficients: Floats) -> tuple[float, float]:
    """Least and greatest value of polynomials over u from -1 to 1; those that are NaN are left out."""
    held = coefficients[:, ~np.isnan(coefficients[0])]
    values = np.concatenate([ends(held).ravel(), *(_polynomial(column, _turns(column)) for column in held.T)])
    return float(values.min()), float(values.max())


def _polynomial(column: Floats, u: Floats) -> Floats:
    return np.asarray(np.polynomial.polynomial.polyval(u, column))


def ends(coefficients: Floats) -> Floats:
    """Values of polynomials at u = -1 and 1; coefficients (COUNT, n), values (2, n)."""
    signs = np.where(np.arange(len(coefficients)) % 2, -1.0, 1.0)
    return np.stack([signs @ coefficients, coefficients.sum(axis=0)])


def _turns(column: Floats) -> Floats:
    """Where the slope of a polynomial changes its sign; being off by a little changes little there."""
    slope = np.asarray(np.polynomial.polynomial.polyder(column), dtype=np.float64)
    u = np.linspace(-1, 1, 257)
    at = _polynomial(slope, u)
    here = np.flatnonzero(np.sign(at[:-1]) * np.sign(at[1:]) < 0)
    found: Floats = u[here] - at[here] * (u[1] - u[0]) / (at[here + 1] - at[here])
    return found
