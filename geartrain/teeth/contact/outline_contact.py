"""Contact of two wheels given by outlines: driven angle, backlash and teeth in contact at given angles of the driver.

`OutlinePair` finds which pairs of teeth are in reach at one centre distance, and which of them holds the driven wheel.
"""

from __future__ import annotations

from collections.abc import Iterator
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

_BLOCK = 60_000  # nodes worked on at once: bounds the memory of long arrays of angles
_MARGIN = 1e-5  # of a driven pitch: how far rough angles may be off
_TIE = 4e-15  # rad: of touches as near as this the later couple, and a flank before a corner, is named
KINDS = ("flank", "corner of first", "corner of second", "corner on corner")


class OutlinePair:
    """One side of two wheels at one distance. The back is the front seen in a mirror."""

    def __init__(
        self, first: GearOutline, second: GearOutline, distance: float, side: Literal["front", "back"]
    ) -> None:
        _check(first, second, distance)
        self.first, self.second, self.sign = first, second, 1 if side == "front" else -1
        sight = AxlePlacement(distance, first.bevel, 1 if first.ring else 2 if second.ring else 0)
        mine, theirs = (
            (first.ahead, second.behind)
            if side == "front"
            else (
                first.behind.mirrored,
                second.ahead.mirrored,
            )
        )
        self.judge = FirstTouchSearch(mine, theirs, sight)
        low, high, behind, ahead = mine.reach
        minimum, most, _, _ = theirs.reach
        reach = sight.bounds(low, high, minimum, most)
        self.window = (-reach - ahead, reach - behind) if reach >= 0 else (0.0, -1.0)

    @property
    def cycle(self) -> int:
        """Driver's pitches after which all repeats."""
        z1, z2 = self.first.z, self.second.z
        if self.first.equal and self.second.equal:
            return 1
        if self.second.equal:
            return z1
        return z2 if self.first.equal else lcm(z1, z2)

    def at(self, phi1: Floats, within: float) -> tuple[Any, ...]:
        """The fields of `FlankContact` at angles of shape (n,)."""
        period = self.cycle * self.first.pitch
        # worked out within one period, and whole periods added after: their rounding stays out of the contact
        turns = np.floor(self.sign * phi1 / period)
        rest = self.sign * phi1 - turns * period
        parts = [self._block(part, within) for part in self._blocks(rest)]
        angle, speed, pair, *others = (np.concatenate(each, axis=-1) for each in zip(*parts, strict=True))
        angle = self.sign * (angle + turns * (self.cycle * self.second.pitch))
        pair = self.sign * (pair - turns.astype(int) * self.cycle)
        return angle, speed, pair, *others

    def _blocks(self, rest: Floats) -> Iterator[Floats]:
        wide = self.window[1] - self.window[0]
        per_angle = (wide / self.first.pitch + 1) * self.judge.first.nodes[0].shape[1]
        size = max(16, int(_BLOCK / per_angle))
        return (rest[start : start + size] for start in range(0, max(len(rest), 1), size))

    def _tooth_pairs(self, rest: Floats) -> tuple[CandidatePairs, Indices]:
        """All couples in reach, and the number of each one's driving tooth (in a mirror, counted backward)."""
        pitch = self.first.pitch
        slack = 2 * max(map(abs, self.first.turns), default=0.0)
        lowest = np.ceil((self.window[0] - slack - rest) / pitch).astype(int)
        number = max(0, ceil((self.window[1] - self.window[0] + 2 * slack) / pitch) + 1)
        j = (lowest[:, None] + np.arange(number)).ravel()
        position = np.repeat(np.arange(len(rest)), number)
        # in a mirror tooth j touches the tooth behind it, whose number is one more when counted backward
        mate = j if self.sign > 0 else j + 1
        tooth1, tooth2 = (self.sign * j) % self.first.z, (self.sign * mate) % self.second.z
        x = rest[position] + j * pitch + self.sign * _taken(self.first.turns, tooth1)
        place = np.asarray(mate * self.second.pitch + self.sign * _taken(self.second.turns, tooth2), dtype=np.float64)
        shape1 = tooth1 if len(self.first.teeth) > 1 else np.zeros_like(j)
        shape2 = tooth2 if len(self.second.teeth) > 1 else np.zeros_like(j)
        near = (x >= self.window[0]) & (x <= self.window[1])
        return some(CandidatePairs(x, shape1, shape2, place, position), near), j[near]

    def _block(self, rest: Floats, within: float) -> tuple[Any, ...]:
        tooth_pairs, j = self._tooth_pairs(rest)
        judge, count = self.judge, len(rest)
        if not len(j):
            return _nothing(count)
        margin = _MARGIN * self.second.pitch + within
        found = judge.touch(tooth_pairs, judge.furthest(tooth_pairs, judge.segments(tooth_pairs), margin))
        position = tooth_pairs.position[found.tooth_pair]
        best = np.full(count, -np.inf)
        np.maximum.at(best, position, found.angle)
        sharing = self._sharing(found, best[position] - within, tooth_pairs, count)
        kind = self._kind(found)
        # of touches that tie: the later couple, then what has fewer corners, then the furthest
        ties = np.flatnonzero(found.angle >= best[position] - _TIE)
        order = ties[np.lexsort((found.angle[ties], kind[ties] == 0, j[found.tooth_pair[ties]], position[ties]))]
        last = np.flatnonzero(np.diff(position[order], append=count))
        chosen = order[last]
        where = position[chosen]
        angle, speed, pair, kinds, r1, r2, _, curves = _nothing(count)
        angle[where], speed[where], kinds[where] = best[where], found.speed[chosen], kind[chosen]
        pair[where], r1[where], r2[where] = j[found.tooth_pair[chosen]], found.radius1[chosen], found.radius2[chosen]
        curves[:, where] = judge.first.curve[found.piece1[chosen]], judge.second.curve[found.piece2[chosen]]
        return angle, speed, pair, kinds, r1, r2, sharing, curves

    def _kind(self, found: FirstTouches) -> Indices:
        """Which of the two is at a corner: 1, 2, both 3."""
        kind = np.zeros(len(found.u), int)
        for at, (table, piece, u) in enumerate(
            ((self.judge.first, found.piece1, found.u), (self.judge.second, found.piece2, found.v))
        ):
            kind += (1 + at) * ((u == -1) & table.kinks[0][piece] | (u == 1) & table.kinks[1][piece])
        return kind

    def _sharing(self, found: FirstTouches, minimum: Floats, tooth_pairs: CandidatePairs, count: int) -> Indices:
        """How many couples have a touch at `minimum` or beyond."""
        touching = np.unique(found.tooth_pair[found.angle >= minimum])
        return np.bincount(tooth_pairs.position[touching], minlength=count)


def _taken(turns: tuple[float, ...], tooth: Indices) -> Floats | float:
    return np.array(turns)[tooth] if turns else 0.0


def _nothing(count: int) -> tuple[Any, ...]:
    """The fields of `FlankContact` where no tooth is in reach."""
    nan = np.full(count, np.nan)
    none = np.full(count, -1)
    return (
        nan,
        nan.copy(),
        np.zeros(count, int),
        none,
        nan.copy(),
        nan.copy(),
        np.zeros(count, int),
        -np.ones((2, count), int),
    )


def _check(first: GearOutline, second: GearOutline, distance: float) -> None:
    """Whether two wheels can be looked at together."""
    if first.bevel != second.bevel or (first.ring and second.ring):
        raise QuestionError(
            Problem(
                "two wheels do not go together",
                "one is flat and the other on a sphere, or both are rings",
                "give two spur wheels, two bevel wheels, or a wheel and a ring",
            )
        )
    limit = pi if first.bevel else np.inf
    if not 0 < distance < limit:
        raise RangeError(
            Problem(
                f"a distance of {distance:.6g} between axles",
                "it must be above 0" + (", and a shaft angle below 180 deg" if first.bevel else ""),
                "give the distance from axle to axle (bevel: the shaft angle in rad)",
            )
        )


# ---------------------------------------------------------------------------------------------- contact at given angles


@dataclass(frozen=True, slots=True)
class FlankContact(Shown):
    """Where the driven wheel stands against one side of the driver's teeth; arrays of the shape of the driver's angles.

    See Also
    --------
    contact, solve : what gives it.
    """

    angle: Floats
    """Driven angle [rad], NaN where no tooth is in reach."""
    speed: Floats
    """D angle / d driver's angle."""
    pair: Indices
    """Number of the driver's tooth that touches, counted forward from tooth 0 without end."""
    kind: Indices
    """What touches, an index into `KINDS`: smooth sides or a corner."""
    radius1: Floats
    """Radius of the contact about the driver's axle, in the outlines' unit; bevel: polar angle [rad]."""
    radius2: Floats
    """Radius of the contact about the driven axle, in the outlines' unit; bevel: polar angle [rad]."""
    sharing: Indices
    """How many pairs of teeth are within reach of the contact."""
    curves: Indices
    """(2, ...): which curve of either outline touches, counted through the sides of all its teeth; -1 where none."""

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        names = ("angle", "speed", "pair", "radius1", "radius2", "sharing")
        kinds = np.array([*KINDS, "none"])[self.kind].tolist()
        return {**{name: getattr(self, name).tolist() for name in names}, "kind": kinds}


@dataclass(frozen=True, slots=True)
class TwoFlankContact(Shown):
    """Both sides: `front` pushes the driven wheel forward, `back` holds it from running ahead.

    See Also
    --------
    solve : what gives it.
    """

    front: FlankContact
    """Contact of the drive flanks."""
    back: FlankContact
    """Contact of the coast flanks."""

    @property
    def backlash(self) -> Floats:
        """What the driven wheel can turn freely (rad); below 0 the teeth interfere by as much."""
        found: Floats = self.back.angle - self.front.angle
        return found

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {"front": self.front.to_dict(), "back": self.back.to_dict(), "backlash": self.backlash.tolist()}


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
