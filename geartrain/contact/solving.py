"""Driven angle, play and pairs in contact of two wheels at given angles of the driver."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from geartrain.contact.meeting import Meeting
from geartrain.errors import Problem, RangeError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.contact.outline import Outline
    from geartrain.contact.polynomials import Floats, Indices

KINDS = ("flank", "corner of first", "corner of second", "corner on corner")


@dataclass(frozen=True, slots=True)
class Contact:
    """Where the driven wheel stands against one side of the driver's teeth; arrays of the driver's shape.

    angle     driven angle (rad), NaN where no tooth is in reach
    speed     d angle / d driver's angle
    pair      number of the driver's tooth that touches, counted forward from tooth 0 without end
    kind      index into KINDS: what touches, smooth sides or a corner
    radius1, radius2   of the contact about either axle (bevel: polar angles)
    sharing   how many pairs of teeth are within reach of the contact
    curves    (2, ...): which curve of either outline touches, counted through the sides of all its teeth; -1 where none
    """

    angle: Floats
    speed: Floats
    pair: Indices
    kind: Indices
    radius1: Floats
    radius2: Floats
    sharing: Indices
    curves: Indices

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        names = ("angle", "speed", "pair", "radius1", "radius2", "sharing")
        kinds = np.array([*KINDS, "none"])[self.kind].tolist()
        return {**{name: getattr(self, name).tolist() for name in names}, "kind": kinds}


@dataclass(frozen=True, slots=True)
class Touch:
    """Both sides: `front` pushes the driven wheel forward, `back` holds it from running ahead."""

    front: Contact
    back: Contact

    @property
    def phi2(self) -> Floats:
        """Driven angle (rad) with the front sides in contact."""
        return self.front.angle

    @property
    def play(self) -> Floats:
        """What the driven wheel can turn freely (rad); below 0 the teeth interfere by as much."""
        found: Floats = self.back.angle - self.front.angle
        return found

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {"front": self.front.to_dict(), "back": self.back.to_dict(), "play": self.play.tolist()}


def solve(first: Outline, second: Outline, distance: float, phi1: ArrayLike, within: float = 1e-9) -> Touch:
    """Where the second wheel stands when the first, driving, is at angles phi1 (rad), any shape.

    distance   from axle to axle, in the outlines' unit; bevel: the shaft angle (rad)
    within     couples that would touch if the driven wheel were turned back by less (rad) count as sharing
    Angles are within some 1e-15 rad of the outlines given, which are taken as polynomials as good as their own rounding
    (`Outline.ahead.error`); far from 0 the rounding of phi1 itself is more.
    Both angles are 0 where tooth 0 is on the line of centres, and grow forward; tooth 0 pushes tooth 0.
    Raises `QuestionError` where the wheels do not go together.
    """
    return Touch(
        contact(first, second, distance, phi1, within=within),
        contact(first, second, distance, phi1, "back", within=within),
    )


def contact(
    first: Outline,
    second: Outline,
    distance: float,
    phi1: ArrayLike,
    side: Literal["front", "back"] = "front",
    within: float = 1e-9,
) -> Contact:
    """One side of `solve`, for half the time."""
    phi1 = np.asarray(phi1, dtype=float)
    if not np.isfinite(phi1).all():
        raise RangeError(Problem("an angle of the driver is not finite", "it has no place on a turn", "leave it out"))
    meeting = Meeting(first, second, distance, side)
    flat = meeting.at(phi1.ravel(), within)
    shapes = (each.reshape((*each.shape[:-1], *phi1.shape)) for each in flat)
    return Contact(*shapes)
