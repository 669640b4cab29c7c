"""Two wheels of triangular teeth in the plane at one moment: outlines, contact point, normal, instant centre.

The driver turns about (0, 0), the driven wheel about (D, 0), or (-D, 0) if it is a ring. Lengths are in the unit of
the sizes. Turning forward, the
entry side is above the line of centres, where alpha_1 and alpha_2 are positive; backwards it is below.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, cos, floor, pi, sin, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.real_path import DriveInterval
from geartrain.teeth.triangular.tooth_couple import APPROACH
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

Point = tuple[float, float]
DRIVER, DRIVEN = 1, 2


@dataclass(frozen=True, slots=True)
class ToothPairPose:
    """The couple that drives at alpha_1 and alpha_2 (rad), in one phase; all other teeth follow from the pitch."""

    sizes: TriangularSizes
    phase: str
    touching: bool
    alpha1: float
    alpha2: float
    tau: float
    direction: int

    def wheel(self, which: int) -> tuple[int, float, float, float]:
        """Teeth, tip radius, root radius and angle (rad) of the driving couple's tooth of a wheel."""
        sizes = self.sizes
        if which == DRIVER:
            return sizes.z1, sizes.R1, sizes.R1 - sizes.signs[0] * sizes.depths[0], self.alpha1
        return sizes.z2, sizes.R2, sizes.R2 - sizes.signs[1] * sizes.depths[1], self.alpha2

    @property
    def axis2(self) -> float:
        """Place of the driven wheel's axis on the line of centres, from the driver's."""
        return self.sizes.signs[1] * self.sizes.D

    def place(self, which: int, radius: float | Floats, angle: float | Floats) -> Floats:
        """Points (..., 2) at a radius about a wheel's centre and an angle (rad) from the line of centres, entry up."""
        along: Floats = radius * np.cos(angle)
        across: Floats = radius * np.sin(angle)
        x = along if which == DRIVER else self.axis2 - self.sizes.side * along
        return np.stack([x, self.direction * across], axis=-1)

    def outline(self, which: int, within: float = pi) -> Floats:
        """Corners (n, 2) of a wheel: of all its teeth, or of those within an angle (rad) of the line of centres.

        In the second case the centre is a corner too; the body of a ring ends at a circle beyond its roots.
        """
        z, tip, root, alpha = self.wheel(which)
        half = pi / z
        steps = np.arange(2 * z)
        if within < pi:
            steps = np.arange(ceil((-within - alpha) / half), floor((within - alpha) / half) + 1)
        radii: Floats = np.where(steps % 2 == 0, tip, root).astype(float)
        angles = alpha + half * steps.astype(float)
        teeth = self.place(which, radii, angles)
        if root > tip:
            if within >= pi:  # closed, so that the rim can be cut open where the teeth begin
                angles, teeth = np.append(angles, angles[0] + 2 * pi), np.vstack([teeth, teeth[:1]])
            return np.vstack([teeth, self.place(which, 2 * root - tip, angles[::-1])])
        return teeth if within >= pi else np.vstack([teeth, self.place(which, 0.0, 0.0)])

    @property
    def lean(self) -> float:
        """Angle (rad) from the line of centres to the flank in contact, towards the entry side."""
        if self.phase == APPROACH:
            return self.alpha1 + self.sizes.signs[0] * self.sizes.beta1
        return self.sizes.signs[0] * self.sizes.beta2 - self.sizes.side * self.alpha2

    @property
    def contact(self) -> Point:
        """Where the couple touches: the driven apex in approach, the driver's in recess."""
        which = DRIVEN if self.phase == APPROACH else DRIVER
        _, tip, _, alpha = self.wheel(which)
        x, y = self.place(which, tip, alpha)
        return float(x), float(y)

    @property
    def normal(self) -> Point:
        """Unit vector across the flank in contact, along which the driver pushes."""
        return sin(self.lean), -self.direction * cos(self.lean)

    @property
    def centre(self) -> Point:
        """Instant centre: where the normal at the contact meets the line of centres."""
        x, y = self.contact
        return x + self.direction * y * tan(self.lean), 0.0


def tooth_pair_pose(law: TriangularTransmission, alpha1: float | None = None) -> ToothPairPose:
    """The wheels of a law when the driving couple is at `alpha1` (rad); the middle of its first interval if None.

    Where no couple drives at alpha1, the moment at which some driver's tooth is there.
    """
    interval, x = _moment(law, alpha1)
    couple, standing = law.contact.path.couple, interval.held
    alpha2 = float(couple.angle(interval.phase, x)) if standing is None else standing
    tau = law.contact.speed(interval, x)
    return ToothPairPose(law.sizes, interval.phase, standing is None, x, alpha2, tau, law.direction)


def _moment(law: TriangularTransmission, alpha1: float | None) -> tuple[DriveInterval, float]:
    if alpha1 is None:
        first = law.intervals[0]
        return first, (first.start + first.end) / 2
    for interval in law.intervals:
        if interval.end <= alpha1 <= interval.start:
            return interval, alpha1
    return law.contact.locate(alpha1)
