"""Effect of displaced flanks on the driven wheel, for any two outlines without a path of contact.

A single tooth pair is turned through its contact, and the common normal is found at each contact. The normal passes
through the point that divides the line of centres in the ratio of the instantaneous speeds. A flank that protrudes by n
along the normal turns the driven wheel ahead by n divided by the moment arm of the normal about the driven axle,
docs/cut-by-hand.md (1), as for conjugate teeth. Unlike for conjugate teeth, the lag of error-free wheels is not
constant.
"""

from __future__ import annotations

from functools import lru_cache
from math import inf, radians
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.polynomial_pieces import value
from geartrain.teeth.conjugate.displaced_contact import CornerLag, DisplacedContact, DisplacedWheelSizes
from geartrain.teeth.contact.first_touch import CandidatePairs
from geartrain.teeth.contact.outline_contact import OutlinePair

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Indices
    from geartrain.teeth.contact.gear_outline import GearOutline
    from geartrain.teeth.contact.outline_transmission import OutlineGears

_NODES = 1025  # of the tables along the contact, with linear interpolation
_CORNER_NODES = 257  # of the tables beyond its ends
_SEARCHED = 2001  # samples in the window of a tooth pair, for the ends of its contact
_FARTHEST = 0.25  # fraction of a driven pitch: with more lag the neighbouring pairs are in contact instead
_NO_CORNER = 1e-9  # rad of the driver: shorter contact of a tip beyond the flanks is neglected
_AT_PITCH_POINT = 1e-6  # modules: closer to the pitch point the normal is taken from the flank
_BLUNT = radians(10)  # lower bound of the half aperture, by which errors are divided; it is 0 for parallel sides


class ToothPairContact(NamedTuple):
    """Contact of a single tooth pair at driver angles x [rad]. The angle is 0 where the driver's tooth is on the line
    of centres.

    The driver's axle is at the origin, and the driven axle is on the x axis.
    """

    x: Floats
    lag: Floats
    """Lag of the driven wheel behind uniform motion [rad]."""
    point: Floats
    """Contact points [module], shape (2, n)."""
    normal: Floats
    """Unit vectors in the direction in which the driver pushes the driven wheel, shape (2, n)."""
    angle: Floats
    """Angle of the driven tooth from the line of centres, positive in the direction of motion [rad]."""
    corner: Indices
    """Tip corner in contact: 1 for a corner of the driver, 2 for a corner of the driven wheel, 3 for both corners, 0
    for none; -1 where the teeth do not touch.
    """


class ToothPairSearch:
    """Search for the contact of single tooth pairs of two outlines. The front flanks of the driver are in contact."""

    def __init__(self, gears: OutlineGears, driver: int) -> None:
        self.first, self.second = gears.of(driver)
        self.pair = OutlinePair(self.first, self.second, gears.distance, "front")
        self.distance = gears.distance
        # driven angle at which flanks touch: the sum of half thicknesses as an angle at the pitch radius z2 / 2
        self.offset = 2 * gears.half_teeth / self.second.z

    def at(self, x: Floats) -> ToothPairContact:
        """Return the contacts of one tooth pair at driver angles x [rad]."""
        count, none = len(x), np.zeros(len(x), int)
        touch_search = self.pair.touch_search
        tooth_pairs = CandidatePairs(x, none, none, np.zeros(count), np.arange(count))
        touches = touch_search.touch(tooth_pairs, touch_search.segments(tooth_pairs))
        # the touch of maximum angle of each pair is sorted last
        order = np.lexsort((touches.angle, touches.tooth_pair))
        last = order[np.flatnonzero(np.diff(touches.tooth_pair[order], append=count))]
        where = touches.tooth_pair[last]
        corner = np.full(count, -1)
        corner[where] = self.pair.kinds(touches)[last]
        angle, point, normal = np.full(count, np.nan), np.full((2, count), np.nan), np.full((2, count), np.nan)
        angle[where] = touches.angle[last]
        r, dr = value(touch_search.first.radius, touches.piece1[last], touches.u[last])
        a, da = value(touch_search.first.azimuth, touches.piece1[last], touches.u[last])
        a = a + x[where]
        point[:, where] = r * np.cos(a), r * np.sin(a)
        along = np.stack([dr * np.cos(a) - r * da * np.sin(a), dr * np.sin(a) + r * da * np.cos(a)])
        normal[:, where] = self._normals(point[:, where], along, touches.speed[last])
        ratio = self.first.z / self.second.z
        return ToothPairContact(x, ratio * x + self.offset - angle, point, normal, angle, corner)

    def _normals(self, point: Floats, along: Floats, speed: Floats) -> Floats:
        """Return the unit normals at contacts `point`: directions to the point that divides the line of centres in the
        ratio `speed`, or, at that point itself, the normals of the flank directions `along`.
        """
        with np.errstate(all="ignore"):
            to = np.stack([self.distance * speed / (1 + speed) - point[0], -point[1]])
            flank = np.stack([-along[1], along[0]])
            found = np.where(np.hypot(*to) > _AT_PITCH_POINT, to, flank)
            found = found / np.hypot(*found)
        # the push is in the direction in which the near side of the driven wheel moves
        return np.asarray(np.where(found[1] < 0, -found, found))


@lru_cache(maxsize=256)
def displaced_outlines(gears: OutlineGears, driver: int) -> DisplacedContact:
    """Return the contact points of two tooth outlines at their centre distance, and the lag of the driven wheel that
    results if a flank of either wheel is displaced from its nominal position by a unit length.

    Raises `RangeError` if the teeth do not touch for a whole pitch.
    """
    search = ToothPairSearch(gears, driver)
    first, second = search.first, search.second
    start, end, minimum, most = _ends(search)
    found = search.at(np.linspace(start, end, _NODES))
    axles = np.array([[0.0, gears.distance], [0.0, 0.0]])
    px, py = found.point
    nx, ny = found.normal
    # reciprocal of the moment arm about the driven axle
    normal = 1 / np.abs((px - axles[0, 1]) * ny - py * nx)
    # the contacts at which this tooth pair drives, rather than the pair one pitch ahead or behind
    others = [np.interp(found.x + way * first.pitch, found.x, found.lag, left=inf, right=inf) for way in (-1, 1)]
    working = np.flatnonzero(found.lag <= np.minimum(*others))
    tables = search.pair.touch_search.first, search.pair.touch_search.second
    sizes, levers, longer = [], [], []
    for gear, wheel in enumerate((first, second)):
        radius = np.hypot(px - axles[0, gear], py)
        half = _half_widths(search, found, gear)[working]
        sizes.append(_sizes(wheel, radius[working], tables[gear].reach[1], half))
        pitch_x, pitch_y = _pitch_points(search, found, gear)
        levers.append(normal * ((py - pitch_y) * nx - (px - pitch_x) * ny))
        rise = np.gradient(radius, found.x)[-1 if gear == 0 else 0] * (1 if gear == 0 else -1)
        longer.append(float(1 / rise) if rise > 0 else 0.0)
    across, away = normal * ny, normal * nx
    return DisplacedContact(
        wheels=(sizes[0], sizes[1]),
        start=start,
        end=end,
        across=(across, across),
        along=(away, -away),
        tilt=(levers[0], levers[1]),
        apart=away,
        normal=normal,
        entering=_corner(search, start, minimum),
        leaving=_corner(search, end, most),
        longer=(longer[0], longer[1]),
        backlash=2 * gears.backlash / second.z,
        tooth_phase=search.offset,
        even=found.lag,
        distance=gears.distance,
    )


def _ends(search: ToothPairSearch) -> tuple[float, float, float, float]:
    """Return four driver angles [rad] of the tooth pair in `search`: the first and the last contact of two flanks, and
    the first and the last contact if contacts of tips with flanks are included.
    """
    found = search.at(np.linspace(*search.pair.window, _SEARCHED))
    near = (found.corner >= 0) & (found.lag < _FARTHEST * search.second.pitch + np.nanmin(found.lag))
    whole = _around(near, int(np.nanargmin(found.lag)))
    flanks = np.flatnonzero(whole & (found.corner == 0))
    reach = np.flatnonzero(whole)
    if len(flanks) < 2 or found.x[reach[-1]] - found.x[reach[0]] < search.first.pitch:
        what = "these teeth do not touch for a whole pitch"
        why = "the effect of a displaced flank is defined for a contact of at least one pitch"
        raise RangeError(Problem(what, why, "use larger addenda or a smaller centre distance"))
    # the search samples are finer than the tables, so no refinement of the ends is needed
    start, end, minimum, most = (float(found.x[at]) for at in (flanks[0], flanks[-1], reach[0], reach[-1]))
    return start, end, minimum, most


def _around(held: Bools, at: int) -> Bools:
    """Return a mask of the contiguous entries that are True in the mask `held` and include the entry `at`."""
    gaps = np.flatnonzero(~held)
    low, high = gaps[gaps < at], gaps[gaps > at]
    found = np.zeros(len(held), bool)
    found[(low[-1] + 1 if len(low) else 0) : (high[0] if len(high) else len(held))] = True
    return found


def _corner(search: ToothPairSearch, end: float, last: float) -> CornerLag:
    """Return the additional lag of the driven wheel while a tip is in contact, from the end of flank contact at the
    driver angle `end` to the end of tip contact at `last` [rad].
    """
    if abs(last - end) < _NO_CORNER:
        return CornerLag(_NO_CORNER, np.zeros(2))
    lag = search.at(np.linspace(end, last, _CORNER_NODES)).lag
    return CornerLag(abs(last - end) / (_CORNER_NODES - 1), lag - lag[0])


def _half_widths(search: ToothPairSearch, found: ToothPairContact, gear: int) -> Floats:
    """Return the half-thickness [module] of the tooth of `gear` at the point of each contact in `found`."""
    if gear == 0:
        return np.asarray(np.hypot(*found.point) * (np.arctan2(found.point[1], found.point[0]) - found.x))
    x, y = search.distance - found.point[0], found.point[1]
    return np.asarray(np.hypot(x, y) * (found.angle - np.arctan2(y, x)))


def _sizes(wheel: GearOutline, radius: Floats, tip: float, half: Floats) -> DisplacedWheelSizes:
    foot, top = int(np.argmin(radius)), int(np.argmax(radius))
    lean = float(np.arctan2(half[foot] - half[top], radius[top] - radius[foot]))
    return DisplacedWheelSizes(wheel.z, float(tip - radius[foot]), max(lean, _BLUNT))


def _pitch_points(search: ToothPairSearch, found: ToothPairContact, gear: int) -> tuple[Floats, Floats]:
    """Return x and y [module] of the points where flanks in contact (`found`) cross the pitch circle of `gear`."""
    table = (search.pair.touch_search.first, search.pair.touch_search.second)[gear]
    radius = (search.first, search.second)[gear].z / 2
    piece = np.flatnonzero((table.ends[0] <= radius) & (radius <= table.ends[1]) & ~table.flat)[:1]
    azimuth = float(value(table.azimuth, piece, table.inverse(piece, np.array([radius])))[0][0])
    turned = (found.angle if gear else found.x) + azimuth
    x, y = radius * np.cos(turned), radius * np.sin(turned)
    return (search.distance - x, y) if gear else (x, y)
