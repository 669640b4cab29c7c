"""One solid part of a train, and where it stands in the zero pose."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.results import Shown
from geartrain.scene.parts.turned_parts import TurnedPart
from geartrain.scene.solids.triangle_solids import Solid, plate_solid
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneWheel


@dataclass(frozen=True)
class SolidPart(Shown):
    """One solid of a body: a point p of it stands at turn p + place.

    See Also
    --------
    SolidModel : gives it, in `parts`.
    """

    body: int
    """Index of its body in the scene."""
    name: str
    """Of the wheel, or what it belongs to."""
    kind: str
    """Wheel, plate, arbor, pipe, eccentric, stud, collar, spacer, collet, barrel, pillar, post, foot, cock, pin,
    rod, bob or weight."""
    turn: Floats
    """Rotation that puts it into the zero pose."""
    place: Floats
    """Shift that puts it into the zero pose [mm]."""
    status: str = ""
    """Of a wheel as declared: surviving, reconstructed, ..."""
    contours: tuple[Contour, ...] = ()
    """Its flat shape, from which the solid is made; empty where it has none."""
    height: float = 0.0
    """Thickness over the flat shape [mm]."""
    turned: TurnedPart | None = None
    """What it is turned to, about its own z, if it is a body of revolution."""
    drawn: Solid | None = None
    """Its surface where that follows from neither of these: helical teeth, and likenesses."""

    @cached_property
    def solid(self) -> Solid:
        """A closed surface of triangles about its own origin (mm), made when it is first asked for."""
        if self.drawn is not None:
            return self.drawn
        return plate_solid(self.contours, self.height) if self.turned is None else self.turned.solid()

    @property
    def placed(self) -> Solid:
        """The solid where it stands."""
        return self.solid.moved(self.turn, self.place.tolist())


def wheel_frame(wheel: SceneWheel) -> tuple[Floats, Floats]:
    """Axes of a wheel's own coordinates as columns, x through its first tooth, and its middle (mm)."""
    along, reference = np.array(wheel.direction), np.array(wheel.reference)
    across = np.cross(along, reference)
    x = cos(wheel.turn) * reference + sin(wheel.turn) * across
    return np.column_stack([x, np.cross(along, x), along]), np.array(wheel.centre)
