"""A periodic law of two outlines as polynomials between the driver's angles at which it has a corner."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.numerics.exact import fraction_text
from geartrain.numerics.polynomial_pieces import ends, extremes, moments, value
from geartrain.teeth.contact.outline_contact import KINDS
from geartrain.teeth.transmission import SpeedLeap

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Indices


_LEAP = 1e-6  # of the ratio: less is rounding at a corner


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
        # quicker than %, and good enough: `searchsorted` is clipped where rounding leaves `rest` outside the period
        rest -= np.floor(rest / self.period) * self.period
        rest += self.breaks[0]
        which = np.clip(np.searchsorted(self.breaks, rest, side="right") - 1, 0, len(self.breaks) - 2)
        u = (rest - self.middles[which]) / self.halves[which]
        return value(coefficients, which, u)[0].reshape(phi1.shape)

    def extremes(self) -> tuple[float, float]:
        """Least and greatest transmission error (rad): at corners, or where its slope is 0."""
        return extremes(self.errors)

    def speed_range(self) -> tuple[float, float]:
        """Least and greatest speed ratio."""
        return extremes(self.speeds)

    def speed_leaps(self) -> tuple[SpeedLeap, ...]:
        """Where the speed ratio leaps up as one stretch follows another, but for rounding, in order of angle."""
        start, before = ends(self.speeds)
        after = np.roll(start, -1)
        leaps = after - before > _LEAP * float(self.ratio)
        return tuple(SpeedLeap(*each) for each in zip(before[leaps].tolist(), after[leaps].tolist(), strict=True))

    def steepest_fall(self) -> float:
        """Greatest -d speed / d phi1 within the stretches (1/rad), 0 if the speed never falls."""
        slopes = np.zeros_like(self.speeds)  # one degree less, in as many coefficients
        slopes[:-1] = self.speeds[1:] * np.arange(1, len(slopes))[:, None] / self.halves
        return max(0.0, -extremes(slopes)[0])

    def moments(self) -> tuple[float, float]:
        """Mean of the transmission error over a period, and its rms about that mean (rad); NaN with gaps in contact."""
        return moments(self.errors, self.halves)

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
