"""Transmission error of involute wheels whose centres are off their axes, exact for any eccentricity.

The axes of the wheels are D apart on the x axis, wheel 1 at the origin. A centre is e off its axis, in the direction
S + phi_1 for wheel 1 and u = phi_2 - q for wheel 2. The base circles have the radii r_1 and r_2. With the vector
(X, Y) from the first centre to the second, of direction gamma, the line of action is inclined by
cos alpha = (r_1 + r_2)/|(X, Y)|, and the angle q of wheel 2 satisfies

    r_2 q - r_1 S + (r_1 + r_2) (gamma + inv alpha - inv alpha_0) = 0,
    dq/dS = (r_1 + e_1 cos(S + phi_1 - gamma + alpha)) / (r_2 - e_2 cos(u - gamma + alpha)),

where inv a = tan a - a. The speed ratio is the ratio of the distances of the line of action from the two axes. For a
ring as wheel 2, r_2, D and q have the other sign.
"""

from __future__ import annotations

from math import cos, lcm, pi, tan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.numerics.periodic_function import HarmonicSeries
from geartrain.teeth.tooth_form import refused

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

_PER_TURN = 64  # samples per revolution of the faster wheel; twice as many resolve a large eccentricity
_MOST = 1 << 21
_FAINT = 1e-16  # rad: smaller harmonics are rounding error
_FINE = 1e-13  # of the largest harmonic: aliased harmonics are not larger
_CLOSE = 1e-15  # rad
_STEPS = 50  # Newton's method needs about five


class EccentricWheels(NamedTuple):
    """Driver and driven wheel whose centres are off their axes. All lengths are in one unit, for example in modules."""

    counts: tuple[int, int]
    """Tooth counts of the driver and of the driven wheel."""
    offsets: tuple[float, float]
    """Distances of the wheel centres from the axes, in the common length unit."""
    angles: tuple[float, float]
    """Directions of the centres at S = 0 [rad] from the driven wheel's axis, in the driver's sense of rotation."""
    pressure_angle: float
    """Pressure angle that corresponds to the centre distance [rad]."""
    internal: bool = False
    """True if the driven wheel is a ring gear."""

    @property
    def base(self) -> tuple[float, float]:
        """Base radii of both wheels, in the common length unit. The radius of a ring gear is negative."""
        first, second = (z / 2 * cos(self.pressure_angle) for z in self.counts)
        return first, -second if self.internal else second

    def errors_at(self, S: Floats) -> Floats:
        """Return the transmission error [rad of the driven wheel] at driver angles S [rad], by Newton's method."""
        (r1, r2), sign = self.base, -1 if self.internal else 1
        (e1, e2), (phi1, phi2), inv0 = self.offsets, self.angles, tan(self.pressure_angle) - self.pressure_angle
        distance = sign * abs(self.counts[0] + sign * self.counts[1]) / 2
        error = np.zeros(S.shape)
        for _ in range(_STEPS):
            u = phi2 - (S * (r1 / r2) + error)
            X = distance - e1 * np.cos(S + phi1) + e2 * np.cos(u)
            Y = -e1 * np.sin(S + phi1) + e2 * np.sin(u)
            gamma = np.arctan2(sign * Y, sign * X)
            alpha = np.arccos(abs(r1 + r2) / np.hypot(X, Y))
            step = r2 * error + (r1 + r2) * (gamma + (np.tan(alpha) - alpha - inv0))
            step /= r2 - e2 * np.cos(u - gamma + alpha)
            error -= step
            if np.abs(step).max() <= _CLOSE:
                break
        return sign * error

    def error(self) -> HarmonicSeries:
        """Return the transmission error [rad of the driven wheel] as a Fourier series of the driver angle.

        Raises `GearTrainError` if the base circles come too close to each other, or if the Fourier series is too long.
        """
        z1, z2 = self.counts
        gap = abs(z1 - z2 if self.internal else z1 + z2) / 2 - sum(self.offsets) - abs(sum(self.base))
        if gap <= 0:
            what = f"an eccentricity of {sum(self.offsets):.6g} modules is too large"
            why = f"the base circles come {-gap:.6g} modules too close at some angle, where the involutes end"
            raise refused(what, why, "give a smaller `eccentricity`, or a larger `pressure_angle`")
        turned = [z for z, offset in zip(self.counts, self.offsets, strict=True) if offset]
        pitches = lcm(*turned)
        period, count = 2 * pi * pitches / z1, _PER_TURN * (pitches // min(turned))
        while True:
            S = period * np.arange(count) / count
            lines = np.fft.rfft(self.errors_at(S)) / count
            sizes = np.abs(lines[1:])
            if sizes[-max(1, count // 16) :].max() <= _FAINT + _FINE * sizes.max():
                break
            count *= 2
            if count > _MOST:
                what, why = "the eccentricity of both wheels has too long a period", f"it needs over {_MOST} samples"
                raise refused(what, why, "declare the `eccentricity` of one wheel only")
        kept = np.flatnonzero(sizes > _FAINT) + 1
        terms = [(int(n), 2 * abs(lines[n]), float(np.angle(lines[n])) + pi / 2) for n in kept]
        return HarmonicSeries(terms, period, float(lines[0].real))
