"""How a point that turns about the first axle is seen from the second one, on parallel axes and on the sphere."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True, slots=True)
class AxlePlacement:
    """The place of two axles.

    distance   from axle to axle; bevel: the shaft angle (rad)
    ring       which of the two wheels has its teeth inside; 0 if none has
    Azimuths are 0 on the line of centres, on the side where the wheels meet, and grow as both turn forward.
    """

    distance: float
    bevel: bool = False
    ring: Literal[0, 1, 2] = 0

    def look(self, r: Floats, b: Floats) -> DrivenFrame:
        """The view of points at radii r (bevel: polar angles) and azimuths b about the first axle."""
        return DrivenFrame(self, r, b)

    def bounds(self, lowest: float, highest: float, least: float, most: float) -> float:
        """The greatest |azimuth| at which a radius from `lowest` to `highest` is seen from `least` to `most`.

        Taken from samples, and widened: never too small but for rounding.
        """
        r = np.linspace(lowest, highest, 129)[:, None]
        b = np.linspace(0, np.pi, 721)[None, :]
        seen = DrivenFrame(self, *np.broadcast_arrays(r, b)).radius
        # what may pass between two samples, and rounding
        slack = 2 * (highest - lowest) / 128 + 1e-9 * highest
        inside = ((seen <= most + slack) & (seen >= least - slack)).any(axis=0)
        if not inside.any():
            return -1.0
        return float(b[0, inside].max() + np.pi / 720)


class DrivenFrame:
    """Points seen from the second axle: `radius` and `azimuth`, and how both change with the points."""

    __slots__ = ("across", "along", "bevel", "cos_b", "height", "radius", "side", "sight", "sin_b", "tilt", "up")

    def __init__(self, sight: AxlePlacement, r: Floats, b: Floats) -> None:
        self.sight, self.bevel = sight, sight.bevel
        self.sin_b, self.cos_b = np.sin(b), np.cos(b)
        reach = np.sin(r) if sight.bevel else r
        self.height: Floats | float = np.cos(r) if sight.bevel else 1.0
        self.side, self.across = reach * self.sin_b, reach * self.cos_b
        far, self.tilt = (sin(sight.distance), cos(sight.distance)) if sight.bevel else (sight.distance, 1.0)
        e, s = self._signs()
        self.along = e * far * self.height + s * self.tilt * self.across
        if sight.bevel:
            self.up = self.tilt * self.height - s * e * far * self.across
            # not arccos of `up`, which loses half the digits near the axle
            self.radius = np.arctan2(np.hypot(self.side, self.along), self.up)
        else:
            self.radius = np.hypot(self.side, self.along)

    def _signs(self) -> tuple[float, float]:
        """Which way the second axle lies from the first, and which way the first one's radius points along it."""
        return {0: (1.0, -1.0), 1: (-1.0, 1.0), 2: (1.0, 1.0)}[self.sight.ring]

    @property
    def azimuth(self) -> Floats:
        """Azimuth about the second axle (rad)."""
        found: Floats = np.arctan2(self.side, self.along)
        return found

    def moved(self, dr: Floats | float, db: Floats | float) -> tuple[Floats, Floats]:
        """Changes of radius and azimuth as the points change by dr and db."""
        e, s = self._signs()
        stretch = self.height * dr
        side, across = stretch * self.sin_b + self.across * db, stretch * self.cos_b - self.side * db
        along = s * self.tilt * across
        if not self.bevel:
            h = self.radius
            radius = (self.side * side + self.along * along) / h
            return radius, (self.along * side - self.side * along) / (h * h)
        far = sin(self.sight.distance)
        fall = -self._sine() * dr
        along = along + e * far * fall
        up = self.tilt * fall - s * e * far * across
        h = np.hypot(self.side, self.along)
        return (self.up * (self.side * side + self.along * along) / h - h * up), (
            self.along * side - self.side * along
        ) / (h * h)

    def _sine(self) -> Floats:
        """sin r on the sphere."""
        found: Floats = np.hypot(self.side, self.across)
        return found
