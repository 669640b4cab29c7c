"""Solid part of a train, with its position in the zero pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.results import Shown
from geartrain.numerics.vectors import Vector, basis
from geartrain.scene.parts.turned_parts import TurnedPart
from geartrain.scene.solids.triangle_solids import Solid, plate_solid
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneWheel


@dataclass(frozen=True)
class SolidPart(Shown):
    """Solid part of a body. A point p of the part is at `turn` p + `place` in the zero pose.

    See Also
    --------
    SolidModel : contains all solids in `parts`.
    """

    body: int
    """Index in the scene of the body to which the part belongs."""
    name: str
    """Name of the wheel or part."""
    kind: str
    """Kind of the part.

    It is one of wheel, plate, arbor, pipe, eccentric, stud, collar, spacer, collet, barrel, pillar, post, foot, cock,
    pin, wall, rod, bob or weight.
    """
    turn: Floats
    """Rotation matrix from part coordinates to zero-pose coordinates, shape (3, 3)."""
    place: Floats
    """Translation from part coordinates to zero-pose coordinates [mm]."""
    status: str = ""
    """Declared status of a wheel, such as surviving or reconstructed; empty if none is declared."""
    contours: tuple[Contour, ...] = ()
    """Flat shape from which the part is made; empty if the part is not flat."""
    height: float = 0.0
    """Thickness of the flat shape [mm]."""
    turned: TurnedPart | None = None
    """Turned part about the z axis of the solid; None if the solid is not a body of revolution."""
    drawn: Solid | None = None
    """Surface mesh of a wheel: its flat shape extruded, or an approximation; None for other parts."""

    @cached_property
    def solid(self) -> Solid:
        """Closed surface of triangles relative to the origin of the part [mm], computed at first use."""
        if self.drawn is not None:
            return self.drawn
        return plate_solid(self.contours, self.height) if self.turned is None else self.turned.solid()

    @property
    def placed(self) -> Solid:
        """Surface of the part moved to its position in the zero pose."""
        return self.solid.moved(self.turn, self.place.tolist())


def turned_about(body: int, part: TurnedPart, direction: Vector, place: Sequence[float] | Floats) -> SolidPart:
    """Return a turned part as a solid of a body, with its axis through `place` [mm] in the given direction."""
    turn = np.column_stack([*basis(direction), direction])
    return SolidPart(body, part.name, part.kind, turn, np.array(place), turned=part)


def wheel_frame(wheel: SceneWheel) -> tuple[Floats, Floats]:
    """Return the axes of a wheel as columns of a matrix, x through its first tooth, and its centre [mm]."""
    along, reference = np.array(wheel.direction), np.array(wheel.reference)
    across = np.cross(along, reference)
    x = cos(wheel.turn) * reference + sin(wheel.turn) * across
    return np.column_stack([x, np.cross(along, x), along]), np.array(wheel.centre)
