"""Driven angle, play and pairs in contact of two wheels at given angles of the driver."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.contact.outline_pair import OutlinePair

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Indices
    from geartrain.teeth.contact.gear_outline import GearOutline


KINDS = ("flank", "corner of first", "corner of second", "corner on corner")


@dataclass(frozen=True, slots=True)
class FlankContact:
    """Where the driven wheel stands against one side of the driver's teeth; arrays of the shape of the driver's angles.

    Attributes
    ----------
    angle : ndarray
        Driven angle [rad], NaN where no tooth is in reach.
    speed : ndarray
        d angle / d driver's angle.
    pair : ndarray of int
        Number of the driver's tooth that touches, counted forward from tooth 0 without end.
    kind : ndarray of int
        What touches, an index into `KINDS`: smooth sides or a corner.
    radius1, radius2 : ndarray
        Of the contact about either axle, in the outlines' unit; bevel: polar angles [rad].
    sharing : ndarray of int
        How many pairs of teeth are within reach of the contact.
    curves : ndarray of int
        (2, ...): which curve of either outline touches, counted through the sides of all its teeth; -1 where none.

    See Also
    --------
    contact, solve : what gives it.
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
class TwoFlankContact:
    """Both sides: `front` pushes the driven wheel forward, `back` holds it from running ahead.

    Attributes
    ----------
    front, back : FlankContact
        Of either side.

    See Also
    --------
    solve : what gives it.
    """

    front: FlankContact
    back: FlankContact

    @property
    def play(self) -> Floats:
        """What the driven wheel can turn freely (rad); below 0 the teeth interfere by as much."""
        found: Floats = self.back.angle - self.front.angle
        return found

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {"front": self.front.to_dict(), "back": self.back.to_dict(), "play": self.play.tolist()}


def solve(
    first: GearOutline, second: GearOutline, distance: float, phi1: ArrayLike, within: float = 1e-9
) -> TwoFlankContact:
    """Where the second wheel stands when the first, driving, is at given angles.

    The driven wheel stands where the last point of the driver's outline lets it: no normal and no path of contact is
    used. Angles are within some 1e-15 rad of the outlines given, which are taken as polynomials as good as their own
    rounding (`GearOutline.ahead.error`); far from 0 the rounding of phi1 itself is more. Both angles are 0 where tooth
    0 is on the line of centres, and grow forward; tooth 0 pushes tooth 0.

    Parameters
    ----------
    first, second : GearOutline
        Driver and driven wheel.
    distance : float
        From axle to axle, in the outlines' unit; bevel: the shaft angle [rad].
    phi1 : array_like
        Driver's angles [rad], any shape.
    within : float
        Couples that would touch if the driven wheel were turned back by less [rad] count as sharing.

    Returns
    -------
    TwoFlankContact
        Driven angles on both sides, and the play between them.

    Raises
    ------
    QuestionError
        Where the wheels do not go together.
    RangeError
        For a distance out of range, or an angle that is not finite.

    Examples
    --------
    Pointed teeth with straight sides, 10 and 20 of them, tips 0.5 over pitch circles of radius 5 and 10:

    >>> from math import pi
    >>> from geartrain.teeth.contact import GearOutline, ToothFlanks, polyline
    >>> def wheel(z):
    ...     flank = polyline([(0.75, z / 2 - 1), (0.0, z / 2 + 0.5)])
    ...     return GearOutline((ToothFlanks.symmetric(flank),), z)
    >>> found = solve(wheel(10), wheel(20), 15.0, [0.0, pi / 5])
    >>> round(float(found.front.angle[1] - found.front.angle[0]) * 10 / pi, 9)  # a pitch of one is a pitch of the other
    1.0
    >>> bool((found.play > 0).all())
    True
    """
    return TwoFlankContact(
        contact(first, second, distance, phi1, within=within),
        contact(first, second, distance, phi1, "back", within=within),
    )


def contact(
    first: GearOutline,
    second: GearOutline,
    distance: float,
    phi1: ArrayLike,
    side: Literal["front", "back"] = "front",
    within: float = 1e-9,
) -> FlankContact:
    """One side of `solve`, for half the time.

    Parameters
    ----------
    first, second, distance, phi1, within
        As in `solve`.
    side : {"front", "back"}
        The side that pushes, or the one that holds.

    Returns
    -------
    FlankContact
        Driven angles on that side.

    Raises
    ------
    QuestionError, RangeError
        As `solve`.

    See Also
    --------
    solve : both sides.

    Examples
    --------
    >>> from geartrain.teeth.contact import GearOutline, ToothFlanks, polyline
    >>> flank = polyline([(0.75, 4.0), (0.0, 5.5)])
    >>> wheel = GearOutline((ToothFlanks.symmetric(flank),), 10)
    >>> held = contact(wheel, wheel, 10.0, [0.0, 0.1], "back")
    >>> held.angle.shape, held.pair.shape
    ((2,), (2,))
    """
    phi1 = np.asarray(phi1, dtype=float)
    if not np.isfinite(phi1).all():
        raise RangeError(Problem("an angle of the driver is not finite", "it has no place on a turn", "leave it out"))
    meeting = OutlinePair(first, second, distance, side)
    flat = meeting.at(phi1.ravel(), within)
    shapes = (each.reshape((*each.shape[:-1], *phi1.shape)) for each in flat)
    return FlankContact(*shapes)
