"""One tooth from root to tip: flank, round, and what it leaves of the circle at its tip."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.outlines.contour import Contour, bulge_about

if TYPE_CHECKING:
    from collections.abc import Iterator

    from geartrain.outlines.contour import Floats
    from geartrain.outlines.fillet import Fillet
    from geartrain.outlines.flank import Flank

_ROUND = 33  # points of a round where teeth are held against each other


@dataclass(frozen=True, slots=True)
class Tooth:
    """A tooth of z alike; lengths in modules.

    widening   half angle (rad) of the tooth at the pitch circle
    root       radius of the root circle
    """

    z: int
    flank: Flank
    fillet: Fillet
    widening: float
    root: float

    @property
    def tip(self) -> float:
        """Radius of the tip circle."""
        return float(self.flank.r[-1])

    @property
    def land(self) -> float:
        """Half the angle (rad) of the top land."""
        return self.widening + float(self.flank.angle[-1])

    def profile(self) -> tuple[Floats, Floats]:
        """Radius and half angle from root to tip, as a polyline."""
        x, y = np.array([point[:2] for point in self._half()]).T
        fillet = self.fillet
        start, end = (atan2(p[1] - fillet.centre[1], p[0] - fillet.centre[0]) for p in (fillet.end, fillet.start))
        turn = start + np.linspace(0, (end - start + pi) % (2 * pi) - pi, _ROUND)
        xs = np.concatenate((fillet.centre[0] + fillet.radius * np.cos(turn), x[2:]))
        ys = np.concatenate((fillet.centre[1] + fillet.radius * np.sin(turn), y[2:]))
        return np.hypot(xs, ys), np.arctan2(ys, xs)

    def _half(self) -> list[tuple[float, float, float]]:
        """From root to tip on the far side of the axis of the tooth, with the bulge to the next point."""
        fillet = self.fillet
        half = self.widening + self.flank.angle
        flank = zip((self.flank.r * np.cos(half)).tolist(), (self.flank.r * np.sin(half)).tolist(), strict=True)
        round_ = bulge_about(fillet.end, fillet.start, fillet.centre) if fillet.radius else 0.0
        return [(*fillet.end, round_), (*fillet.start, 0.0), *((x, y, 0.0) for x, y in flank)]

    def whole(self) -> Contour:
        """All teeth round the axle, counter-clockwise, the first of them about the x axis."""
        return Contour.of(self._round())

    def _round(self) -> Iterator[tuple[float, float, float]]:
        half = self._half()
        origin = (0.0, 0.0)
        x, y, _ = half[-1]
        land = bulge_about((x, -y), (x, y), origin)
        gap = 2 * (pi / self.z - self.fillet.half)
        ground = np.tan(max(gap, 0.0) / 4)
        up = [(x, -y, -bulge) for x, y, bulge in half[:-1]] + [(x, -y, float(land))]
        # coming down each edge is met at its other end
        bulges = [bulge for _, _, bulge in half]
        down = [(x, y, -bulge) for (x, y, _), bulge in zip(half[:0:-1], bulges[-2::-1], strict=True)]
        down.append((*half[0][:2], float(ground)))
        for k in range(self.z):
            turn = 2 * pi * k / self.z
            c, s = cos(turn), sin(turn)
            for x, y, bulge in (*up, *down):
                yield c * x - s * y, s * x + c * y, bulge

    def span(self) -> Floats:
        """Radius and signed half angle of flanks and top land, as the mate meets them: shape (2, n)."""
        half = self.widening + self.flank.angle
        land = np.linspace(-self.land, self.land, 9)
        r = np.concatenate((self.flank.r, np.full(9, self.tip), self.flank.r[::-1]))
        return np.stack([r, np.concatenate((-half, land, half[::-1]))])


def pin_span(R: float, radius: float) -> Floats:
    """A pin of `radius` on the circle of radius R, as `Tooth.span`."""
    turn = np.linspace(0, 2 * pi, 181)
    x, y = R + radius * np.cos(turn), radius * np.sin(turn)
    return np.stack([np.hypot(x, y), np.arctan2(y, x)])
