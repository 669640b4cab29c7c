"""Contact of two wheels given by outlines: driven angle, backlash and teeth in contact at given angles of the driver.

`OutlinePair` finds the tooth pairs within range at one centre distance, and the pair that determines the driven angle.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, lcm, pi
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.arrays import some
from geartrain.numerics.results import Shown
from geartrain.teeth.contact.first_touch import AxlePlacement, CandidatePairs, FirstTouches, FirstTouchSearch

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Indices
    from geartrain.teeth.contact.gear_outline import GearOutline

_BLOCK = 60_000  # nodes per block, which limits the memory of long arrays of angles
_TIE = 4e-15  # rad: among touches within this the later tooth pair, and a flank before a corner, is reported
KINDS = ("flank", "corner of first", "corner of second", "corner on corner")


class OutlinePair:
    """Contact of one flank of two wheels: front flanks as they are, back flanks in the mirror image of both wheels."""

    def __init__(
        self, first: GearOutline, second: GearOutline, distance: float, side: Literal["front", "back"]
    ) -> None:
        _check_pair(first, second, distance)
        self.first, self.second, self.sign = first, second, 1 if side == "front" else -1
        axles = AxlePlacement(distance, first.bevel, 1 if first.ring else 2 if second.ring else 0)
        # the back side is computed as the front side of the mirrored wheels
        driving_side, driven_side = first.ahead, second.behind
        if side == "back":
            driving_side, driven_side = first.behind.mirrored, second.ahead.mirrored
        self.touch_search = FirstTouchSearch(driving_side, driven_side, axles)
        low, high, behind, ahead = driving_side.reach
        minimum, most, _, _ = driven_side.reach
        # bound of the azimuths at which points of the two sides can touch
        reach = axles.bounds(low, high, minimum, most)
        self.window = (-reach - ahead, reach - behind) if reach >= 0 else (0.0, -1.0)

    @property
    def cycle(self) -> int:
        """Number of pitches of the driver after which the contact conditions repeat."""
        # one wheel with unequal teeth repeats after its revolution, two after a common multiple of both revolutions
        z1, z2 = self.first.z, self.second.z
        if self.first.equal and self.second.equal:
            return 1
        if self.second.equal:
            return z1
        return z2 if self.first.equal else lcm(z1, z2)

    def at(self, phi1: Floats, within: float) -> tuple[Any, ...]:
        """Return all values of a `FlankContact` at driver angles `phi1` of shape (n,) [rad]. Tooth pairs with a gap
        below `within` [rad] count as in contact.
        """
        period = self.cycle * self.first.pitch
        # computed within one period; whole periods are added afterwards, so that their rounding does no harm
        turns = np.floor(self.sign * phi1 / period)
        rest = self.sign * phi1 - turns * period
        # in blocks, which limit the memory for nodes
        per_angle = ((self.window[1] - self.window[0]) / self.first.pitch + 1) * self.touch_search.first.nodes[0].shape[
            1
        ]
        size = max(16, int(_BLOCK / per_angle))
        parts = [self._block(rest[at : at + size], within) for at in range(0, max(len(rest), 1), size)]
        angle, speed, pair, *others = (np.concatenate(each, axis=-1) for each in zip(*parts, strict=True))
        angle = self.sign * (angle + turns * (self.cycle * self.second.pitch))
        pair = self.sign * (pair - turns.astype(int) * self.cycle)
        return angle, speed, pair, *others

    def _tooth_pairs(self, rest: Floats) -> tuple[CandidatePairs, Indices]:
        """Return all tooth pairs that are close enough to touch at the driver angles `rest` [rad], and the number of
        the driver's tooth in each pair. Numbers increase backwards in the mirror image.
        """
        pitch = self.first.pitch
        # pitch deviations may shift teeth into the window from either side
        slack = 2 * max(map(abs, self.first.turns), default=0.0)
        lowest = np.ceil((self.window[0] - slack - rest) / pitch).astype(int)
        number = max(0, ceil((self.window[1] - self.window[0] + 2 * slack) / pitch) + 1)
        j = (lowest[:, None] + np.arange(number)).ravel()
        position = np.repeat(np.arange(len(rest)), number)
        # in the mirror image tooth j touches the tooth behind it, whose number counted backward is j + 1
        mate = j if self.sign > 0 else j + 1
        tooth1, tooth2 = (self.sign * j) % self.first.z, (self.sign * mate) % self.second.z
        x, place = rest[position] + j * pitch, np.asarray(mate * self.second.pitch, dtype=np.float64)
        if self.first.turns:
            x += self.sign * np.array(self.first.turns)[tooth1]
        if self.second.turns:
            place += self.sign * np.array(self.second.turns)[tooth2]
        shape1 = tooth1 if len(self.first.teeth) > 1 else np.zeros_like(j)
        shape2 = tooth2 if len(self.second.teeth) > 1 else np.zeros_like(j)
        near = (x >= self.window[0]) & (x <= self.window[1])
        return some(CandidatePairs(x, shape1, shape2, place, position), near), j[near]

    def _block(self, rest: Floats, within: float) -> tuple[Any, ...]:
        tooth_pairs, j = self._tooth_pairs(rest)
        touch_search, count = self.touch_search, len(rest)
        if not len(j):
            return _no_contact(count)
        found = touch_search.touch(tooth_pairs, touch_search.segments(tooth_pairs))
        position = tooth_pairs.position[found.tooth_pair]
        best = np.full(count, -np.inf)
        np.maximum.at(best, position, found.angle)
        touching = np.unique(found.tooth_pair[found.angle >= best[position] - within])
        sharing = np.bincount(tooth_pairs.position[touching], minlength=count)
        kind = self.kinds(found)
        # order of ties: later tooth pair, then flank before corner, then maximum angle
        ties = np.flatnonzero(found.angle >= best[position] - _TIE)
        order = ties[np.lexsort((found.angle[ties], kind[ties] == 0, j[found.tooth_pair[ties]], position[ties]))]
        last = np.flatnonzero(np.diff(position[order], append=count))
        chosen = order[last]
        where = position[chosen]
        angle, speed, pair, kinds, r1, r2, _, curves = _no_contact(count)
        angle[where], speed[where], kinds[where] = best[where], found.speed[chosen], kind[chosen]
        pair[where], r1[where], r2[where] = j[found.tooth_pair[chosen]], found.radius1[chosen], found.radius2[chosen]
        curves[0, where] = touch_search.first.curve[found.piece1[chosen]]
        curves[1, where] = touch_search.second.curve[found.piece2[chosen]]
        return angle, speed, pair, kinds, r1, r2, sharing, curves

    def kinds(self, found: FirstTouches) -> Indices:
        """Return the kind of each contact: 0 for two flanks, 1 or 2 for a corner of that wheel, 3 for two corners."""
        kind = np.zeros(len(found.u), int)
        for at, (table, piece, u) in enumerate(
            ((self.touch_search.first, found.piece1, found.u), (self.touch_search.second, found.piece2, found.v))
        ):
            kind += (1 + at) * ((u == -1) & table.corners[0][piece] | (u == 1) & table.corners[1][piece])
        return kind


def _no_contact(count: int) -> tuple[Any, ...]:
    angle, speed, radius1, radius2 = np.full((4, count), np.nan)
    pair, sharing = np.zeros((2, count), int)
    kind, *curves = np.full((3, count), -1)
    return angle, speed, pair, kind, radius1, radius2, sharing, np.stack(curves)


def _check_pair(first: GearOutline, second: GearOutline, distance: float) -> None:
    """Raise an error for a spur and a bevel wheel, two ring gears, or a centre distance out of range."""
    if first.bevel != second.bevel or (first.ring and second.ring):
        why = "one is a spur wheel and the other a bevel wheel, or both are rings"
        fix = "give two spur wheels, two bevel wheels, or a wheel and a ring"
        raise QuestionError(Problem("these two wheels cannot mesh", why, fix))
    if not 0 < distance < (pi if first.bevel else np.inf):
        what, limit, wanted = "centre distance", "finite", "distance between the axles"
        if first.bevel:
            what, limit, wanted = "shaft angle", "below pi rad", "shaft angle in rad"
        why = f"it must be above 0 and {limit}"
        raise RangeError(Problem(f"the {what} {distance:.6g} is out of range", why, f"give the {wanted}"))


# ---------------------------------------------------------------------------------------------- contact at given angles


@dataclass(frozen=True, slots=True)
class FlankContact(Shown):
    """Contact of the driven wheel with one flank of the driver's teeth. Arrays have the shape of the driver angles.

    See Also
    --------
    contact : Function that computes the contact of one flank.
    solve : Function that computes the contacts of both flanks.
    """

    angle: Floats
    """Angle of the driven wheel at which the flanks are in contact [rad]; NaN where no tooth is within reach."""
    speed: Floats
    """Speed ratio: derivative of the driven angle by the driver angle; NaN where the teeth do not touch."""
    pair: Indices
    """Number of the driver's tooth that is in contact; 0 where the teeth do not touch. Teeth are counted forward from
    tooth 0, and the count continues beyond z after a revolution.
    """
    kind: Indices
    """Kind of contact, two flanks or a corner, as an index into `KINDS`; -1 where the teeth do not touch."""
    radius1: Floats
    """Distance of the contact from the driver's axle, in the unit of the outlines; for bevel wheels, polar angle [rad].
    """
    radius2: Floats
    """Distance of the contact from the driven axle, in the unit of the outlines; for bevel wheels, polar angle [rad].
    """
    sharing: Indices
    """Number of tooth pairs whose gap is smaller than the tolerance."""
    curves: Indices
    """Numbers of the curves in contact on both outlines, shape (2, ...); -1 where the teeth do not touch. Curves are
    numbered consecutively over all teeth.
    """

    def to_dict(self) -> dict[str, Any]:
        """Return the contact as plain data for JSON."""
        names = ("angle", "speed", "pair", "radius1", "radius2", "sharing")
        kinds = np.array([*KINDS, "none"])[self.kind].tolist()
        return {**{name: getattr(self, name).tolist() for name in names}, "kind": kinds}


@dataclass(frozen=True, slots=True)
class TwoFlankContact(Shown):
    """Contact of both flanks: `front` pushes the driven wheel forward, and `back` prevents it from running ahead.

    See Also
    --------
    solve : Function that computes the contacts of both flanks.
    """

    front: FlankContact
    """Contact of the drive flanks."""
    back: FlankContact
    """Contact of the coast flanks."""

    @property
    def backlash(self) -> Floats:
        """Backlash of the driven wheel [rad]. If the value is negative, the teeth interfere by this angle."""
        found: Floats = self.back.angle - self.front.angle
        return found

    def to_dict(self) -> dict[str, Any]:
        """Return both contacts as plain data for JSON."""
        return {"front": self.front.to_dict(), "back": self.back.to_dict(), "backlash": self.backlash.tolist()}


def solve(
    first: GearOutline, second: GearOutline, distance: float, phi1: ArrayLike, within: float = 1e-9
) -> TwoFlankContact:
    """Return the contacts of two wheels on both flanks, at given angles of the first wheel, which drives.

    The driven angle is the maximum of the angles that the points of the driver's outline require. Normals and a path of
    contact are not used. Angles are accurate to about 1e-15 rad for the given outlines, which are approximated by
    polynomials to within rounding errors (`GearOutline.ahead.error`). At angles far from 0 the rounding of phi1 itself
    dominates. The angle of each wheel is 0 where its tooth 0 is on the line of centres, and increases forward. Tooth 0
    of the driver pushes tooth 0 of the driven wheel.

    Parameters
    ----------
    first, second : GearOutline
        Driver and driven wheel.
    distance : float
        Centre distance, in the unit of the outlines; for bevel wheels the shaft angle [rad].
    phi1 : array_like
        Driver angles [rad], any shape.
    within : float
        Tolerance [rad]: a tooth pair counts as sharing if its gap is less than this rotation of the driven wheel.

    Returns
    -------
    TwoFlankContact
        Driven angles for both flanks, and the backlash between them.

    Raises
    ------
    QuestionError
        If the wheels cannot be in contact.
    RangeError
        If the distance is out of range, or an angle is not finite.

    Examples
    --------
    Wheels with 10 and 20 pointed teeth, whose tips are 0.5 above pitch circles of radius 5 and 10:

    >>> from math import pi
    >>> from geartrain.teeth.contact import GearOutline, ToothFlanks, polyline
    >>> def wheel(z):
    ...     flank = polyline([(0.75, z / 2 - 1), (0.0, z / 2 + 0.5)])
    ...     return GearOutline((ToothFlanks.symmetric(flank),), z)
    >>> found = solve(wheel(10), wheel(20), 15.0, [0.0, pi / 5])
    >>> round(float(found.front.angle[1] - found.front.angle[0]) * 10 / pi, 9)  # a pitch of one is a pitch of the other
    1.0
    >>> bool((found.backlash > 0).all())
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
    """Return the contact of two wheels on one flank only, in half the computing time of `solve`.

    Parameters
    ----------
    first, second, distance, phi1, within
        As in `solve`.
    side : {"front", "back"}
        Flank that pushes the driven wheel ("front"), or flank that prevents it from running ahead ("back").

    Returns
    -------
    FlankContact
        Driven angles for that flank.

    Raises
    ------
    QuestionError, RangeError
        As in `solve`.

    See Also
    --------
    solve : Contact on both flanks.

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
        what, why, fix = (
            "an angle of the driver is not finite",
            "positions must be finite",
            "remove infinite and NaN angles",
        )
        raise RangeError(Problem(what, why, fix))
    pair_contact = OutlinePair(first, second, distance, side)
    flat = pair_contact.at(phi1.ravel(), within)
    shapes = (each.reshape((*each.shape[:-1], *phi1.shape)) for each in flat)
    return FlankContact(*shapes)
