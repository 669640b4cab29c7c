"""A tooth of radial flanks under a tip of two arcs of circles: its corners, its arcs, its outline.

Each arc passes through the end of the tooth's thickness on the pitch circle and through the tip on the middle of the
tooth; the flank below is the tangent to it from the axle.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import asin, atan2, cos, hypot, pi, sin, sqrt, tan
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.contact.gear_outline import GearOutline
    from geartrain.teeth.outlines.tooth_outline import Vertex


@dataclass(frozen=True, slots=True)
class ArcTooth:
    """A tooth with radial flanks and a tip of two arcs, lengths in modules.

    z           teeth of the wheel; `thickness` of one along the pitch circle
    addendum    height of the tip over the pitch circle; `radius` of the arcs
    dedendum    depth of the root under it
    """

    z: int
    thickness: float
    addendum: float
    radius: float
    dedendum: float

    @property
    def tip(self) -> float:
        """Radius of the tip (modules)."""
        return self.z / 2 + self.addendum

    @property
    def root(self) -> float:
        """Radius of the root circle (modules)."""
        return self.z / 2 - self.dedendum

    @property
    def centre(self) -> tuple[float, float]:
        """Of the arc on the side of positive x, the middle of the tooth along y; beyond it for a pointed tip."""
        half = self.thickness / self.z
        x, y = self.z / 2 * sin(half), self.z / 2 * cos(half)
        chord = hypot(x, self.tip - y)
        far = sqrt(self.radius**2 - chord**2 / 4) / chord
        return x / 2 - far * (self.tip - y), (self.tip + y) / 2 - far * x

    @property
    def fits(self) -> bool:
        """True if the arc spans from the pitch circle to the tip and rises all the way, and the flank ends on it."""
        half = self.thickness / self.z
        chord = hypot(self.z / 2 * sin(half), self.tip - self.z / 2 * cos(half))
        if 2 * self.radius < chord or not 0 < half < pi / self.z:
            return False
        x, y = self.centre
        start, lean = self.flank
        # the centre of a round tip is on the middle of the tooth, to the three digits of printed sizes
        return x <= 1e-3 * self.radius and hypot(x, y) > self.radius and self.root < start and 0 < lean < pi / self.z

    @property
    def flank(self) -> tuple[float, float]:
        """Radius at which the flank ends and the arc begins, and angle (rad) of the flank from the tooth's middle."""
        x, y = self.centre
        far = hypot(x, y)
        return sqrt(far**2 - self.radius**2), atan2(x, y) + asin(self.radius / far)

    def outline(self) -> GearOutline:
        """All teeth of the wheel, for the contact of outlines."""
        import numpy as np

        from geartrain.teeth.contact.gear_outline import GearOutline, ToothFlanks
        from geartrain.teeth.contact.outline_curve import OutlineCurve

        (start, lean), (cx, cy), radius = self.flank, self.centre, self.radius
        way = np.array([sin(lean), cos(lean)])
        # angles on the arc, counted from x towards y
        low, high = atan2(start * way[1] - cy, start * way[0] - cx), atan2(self.tip - cy, -cx)

        def arc(turn: Floats) -> Floats:
            return np.stack([cx + radius * np.cos(turn), cy + radius * np.sin(turn)], axis=1)

        side = (OutlineCurve(lambda r: r[:, None] * way, self.root, start), OutlineCurve(arc, low, high))
        return GearOutline((ToothFlanks.symmetric(side),), self.z)

    def vertices(self) -> Iterator[Vertex]:
        """The tooth about the x axis, from root to root, with the bulge of each edge; the arcs are exact."""
        (start, lean), (cx, cy) = self.flank, self.centre
        sweep = atan2(self.tip - cy, -cx) - atan2(start * cos(lean) - cy, start * sin(lean) - cx)
        along, beside = cos(lean), sin(lean)
        yield self.root * along, -self.root * beside, 0.0
        yield start * along, -start * beside, tan(sweep / 4)
        yield self.tip, 0.0, tan(sweep / 4)
        yield start * along, start * beside, 0.0
        yield self.root * along, self.root * beside, tan((pi / self.z - lean) / 2)
