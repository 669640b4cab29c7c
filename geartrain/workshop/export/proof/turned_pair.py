"""Two written outlines rotated against each other: their overlap, and the angles at which the second wheel is free.

Wheel 1 is at the origin. The axis of wheel 2 is on the positive x axis, or on the negative x axis if wheel 2 is
internal, so that the wheels meet on the positive x axis. While wheel 1 turns by t, wheel 2 turns by -t z1/z2 (internal:
+t z1/z2) plus a `lag`. The limits of the lag between which wheel 2 is free are found by bisection on the area of
overlap.

Outlines are read back from the SVG that a laser cutter follows (`read_material`), independently of the code that writes
it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import acos, atan2, ceil, cos, hypot, lcm, pi, sin, sqrt
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

import numpy as np

from geartrain.errors import GearTrainError, MissingExtraError, Problem

if TYPE_CHECKING:
    from shapely import Geometry

    from geartrain.numerics.arrays import Floats


TOLERANCE = 2e-4
"""Maximum deviation of the chords in a proof from the arcs of the drawing [mm]."""

NOTHING = 1e-9  # mm2: a smaller overlap is a rounding error
SAME = 5e-6  # mm: larger than the rounding of coordinates in a drawing
Point = tuple[float, float]
_STEPS = 12  # positions per pitch at which backlash is measured
_DENSE = 36  # positions per pitch at which overlaps are sought: a tooth moves by about 0.1 modules in between
_OFF = 0.137  # of a step: offset that avoids symmetric positions
_HALVINGS = 22  # bisections of half a pitch: to a ten-millionth of it
_PARTS = 16  # subdivisions of a pitch, to find the stop of a wheel that is free half a pitch further
_TRIES = 48  # positions per pitch tried for a wheel that is not free
_ENDS = 0.2  # fraction of the tooth height that counts as tip, and as root
_CUT = "CUT"
_WORDS = re.compile(r"[A-Za-z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_COUNTS = {"M": 2, "L": 2, "A": 7, "Z": 0}


@dataclass(frozen=True, slots=True)
class FreeTurn:
    """Free range of wheel 2 at each position of wheel 1: the range of its lags at which the wheels do not overlap.

    A lag is the angle of wheel 2 minus its mean angle, which is proportional to the angle of wheel 1. The arrays have
    one value for each position.
    """

    low: Floats
    """Minimum lag at which wheel 2 is free [rad]; NaN at positions where no lag is free."""
    high: Floats
    """Maximum lag at which wheel 2 is free [rad]; NaN at positions where no lag is free."""
    overlap: Floats
    """Minimum over all lags of the area of overlap [mm2]; 0 at positions where wheel 2 is free."""
    place: tuple[float, float] | None
    """Coordinates of the largest overlap relative to the axis of wheel 1 [mm]; None if there is no overlap."""


@dataclass(frozen=True)
class TurnedPair:
    """Two wheels as plane shapes about their own axes. Each wheel has a tooth on its x axis."""

    materials: tuple[Any, Any]
    counts: tuple[int, int]
    """Numbers of teeth of both wheels."""
    distance: float
    """Centre distance [mm]. The field `ring` is True if wheel 2 is internal."""
    ring: bool = False
    same: float = SAME
    """Maximum distance between the outlines of two teeth that are treated as equal [mm]."""
    _cropped: dict[tuple[int, int], Any] = field(default_factory=dict, repr=False, compare=False)
    """Regions of contact that were already cropped, keyed by wheel and kind of tooth."""

    @cached_property
    def pitches(self) -> tuple[float, float]:
        """Angular pitches of both wheels [rad]."""
        return 2 * pi / self.counts[0], 2 * pi / self.counts[1]

    @cached_property
    def reaches(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Tip and root radii of each wheel, as cut [mm]."""
        outer, inner = self.materials
        first = _teeth(outer, False)
        return first, _teeth(inner, self.ring)

    def turn(self) -> FreeTurn:
        """Return the free ranges of wheel 2 while wheel 1 turns by a pitch, for each pair of `tooth_pairs`."""
        found = [self._measure(tooth_pair) for tooth_pair in self.tooth_pairs]
        worst = max(found, key=lambda each: float(each.overlap.max()))
        return _joined(found, worst.place)

    @cached_property
    def tooth_pairs(self) -> list[tuple[int, int]]:
        """Indices of a tooth of wheel 1 and a space of wheel 2 that meet, for each different combination of shapes."""
        z1, z2 = self.counts
        way = 1 if self.ring else -1
        found: dict[tuple[int, int], tuple[int, int]] = {}
        kinds = self._alike
        for n in range(lcm(z1, z2)):
            one, other = -n % z1, -way * n % z2
            found.setdefault((kinds[0][one], kinds[1][other]), (one, other))
            if len(found) == len(set(kinds[0])) * len(set(kinds[1])):
                break
        return list(found.values())

    def free(self, turned: Floats, lags: Floats, tooth_pair: tuple[int, int] = (0, 0)) -> FreeTurn:
        """Return the free range of wheel 2 for each angle `turned` of wheel 1 within a pitch [rad].

        lags         lag near which the free range is searched at each angle (rad)
        tooth_pair   indices of the tooth of wheel 1 and of the space of wheel 2 on the line of centres
        """
        t, lag = np.asarray(turned, dtype=float), np.asarray(lags, dtype=float).copy()
        first = _moved(self._contact_region(0, tooth_pair[0]), t, 0.0)
        areas = self._areas(first, t, lag, tooth_pair)
        place = None
        stuck = np.flatnonzero(areas > NOTHING)
        for at in stuck.tolist():
            lag[at], areas[at] = self._nearest_free_lag(
                first[at], float(t[at]), tooth_pair, (float(lag[at]), float(areas[at]))
            )
        if (areas > NOTHING).any():
            # centroid of the largest part of the overlap
            at = int(areas.argmax())
            shapely = plane_geometry()
            common = shapely.intersection(first[at], self._second(t[at : at + 1], lag[at : at + 1], tooth_pair)[0])
            sliver = max(shapely.get_parts(common).tolist(), key=lambda part: float(part.area))
            place = float(sliver.centroid.x), float(sliver.centroid.y)
        ends = [self._last_free_lag(first, t, lag, way, tooth_pair) for way in (-1, 1)]
        blocked = areas > NOTHING
        low, high = (np.where(blocked, np.nan, end) for end in ends)
        return FreeTurn(low, high, np.where(blocked, areas, 0.0), place)

    def _measure(self, tooth_pair: tuple[int, int]) -> FreeTurn:
        """Return the free ranges of wheel 2 while a tooth pair turns through a pitch, at equally spaced positions.

        Further positions are added where the wheels overlap between these positions.
        """
        t = self._positions(_STEPS)
        found = self.free(t, np.zeros(_STEPS), tooth_pair)
        held = np.isfinite(found.low) & np.isfinite(found.high)
        middle = (np.where(held, found.low, 0.0) + np.where(held, found.high, 0.0)) / 2
        dense = self._positions(_DENSE)
        # teeth that are not conjugate have a different lag at every position
        lags = np.interp(dense, t, middle, period=self.pitches[0])
        areas = self._areas(_moved(self._contact_region(0, tooth_pair[0]), dense, 0.0), dense, lags, tooth_pair)
        stuck = areas > NOTHING
        if not stuck.any():
            return found
        more = self.free(dense[stuck], lags[stuck], tooth_pair)
        return _joined([found, more], found.place or more.place)

    def _positions(self, steps: int) -> Floats:
        return np.asarray(self.pitches[0] * ((np.arange(steps) + _OFF) / steps - 0.5))

    def _nearest_free_lag(
        self, first: Any, t: float, tooth_pair: tuple[int, int], here: tuple[float, float]
    ) -> tuple[float, float]:
        """Return a lag of wheel 2 [rad], and the overlap of the wheels at this lag [mm2].

        The lag is the free lag nearest to the present lag; if no lag is free, the lag of minimum overlap.

        first   region of contact of wheel 1, rotated by its angle t (rad)
        here    present lag (rad) and its overlap (mm2)
        """
        tries = here[0] + self.pitches[1] * (np.arange(1, _TRIES + 1) - (_TRIES + 1) / 2) / _TRIES
        areas = self._areas(np.full(_TRIES, first), np.full(_TRIES, t), tries, tooth_pair)
        open_ = np.flatnonzero(areas <= NOTHING)
        if open_.size:
            at = open_[np.abs(tries[open_] - here[0]).argmin()]
        else:
            at = areas.argmin()
            if areas[at] >= here[1]:
                return here
        return float(tries[at]), float(areas[at])

    def _last_free_lag(self, first: Any, t: Floats, lag: Floats, way: int, tooth_pair: tuple[int, int]) -> Floats:
        """Return the last lags up to which wheel 2 is free in one direction, by bisection [rad].

        A lag is infinite if nothing stops wheel 2 within a pitch.

        first   regions of contact of wheel 1, rotated by its angles t (rad)
        lag     free lags from which wheel 2 is turned (rad); `way` is the direction, 1 or -1
        """
        free, met = lag.copy(), lag + way * self.pitches[1] / 2
        loose = self._areas(first, t, met, tooth_pair) <= NOTHING
        if loose.any():  # free at half a pitch: the tooth that stops it is nearer or farther than that
            for part in range(1, _PARTS):
                there = lag + way * self.pitches[1] * part / _PARTS
                bites = loose & (self._areas(first, t, there, tooth_pair) > NOTHING)
                met, loose = np.where(bites, there, met), loose & ~bites
        for _ in range(_HALVINGS):
            middle = (free + met) / 2
            bites = self._areas(first, t, middle, tooth_pair) > NOTHING
            free, met = np.where(bites, free, middle), np.where(bites, middle, met)
        return np.where(loose, way * np.inf, free)

    def _second(self, t: Floats, lag: Floats, tooth_pair: tuple[int, int]) -> Any:
        ratio = self.counts[0] / self.counts[1] * (1 if self.ring else -1)
        away = -self.distance if self.ring else self.distance
        return _moved(self._contact_region(1, tooth_pair[1]), t * ratio + lag, away)

    def _areas(self, first: Any, t: Floats, lag: Floats, tooth_pair: tuple[int, int]) -> Floats:
        shapely = plane_geometry()
        return np.asarray(shapely.area(shapely.intersection(first, self._second(t, lag, tooth_pair))))

    # -------------------------------------------------------------------------------------- possible regions of contact

    @cached_property
    def _extents(self) -> tuple[float, float]:
        """Half angles of the overlap of the tip circles, as seen from each of the two axes [rad]."""
        (tip, _), (other, _) = self.reaches
        a = self.distance
        if not a:
            return pi, pi
        # law of cosines in the triangle of both axes and an intersection of the tip circles
        one = (other**2 - tip**2 - a**2) / (2 * a * tip) * (1 if self.ring else -1)
        two = (a**2 + other**2 - tip**2) / (2 * a * other)
        return acos(min(max(one, -1.0), 1.0)), acos(min(max(two, -1.0), 1.0))

    def _contact_region(self, which: int, tooth: int) -> Any:
        """Return the region of a wheel (0 or 1) that can touch its mate while a tooth is near the line of centres."""
        kind = which, self._alike[which][tooth]
        if kind in self._cropped:
            return self._cropped[kind]
        shapely = plane_geometry()
        pitch = self.pitches[which]
        facing = 0.0 if which == 0 or self.ring else pi
        turn = facing - tooth * pitch + (0.0 if which == 0 else pitch / 2)
        whole = _moved(self.materials[which], np.array([turn]), 0.0)[0]
        half = self._extents[which] + 1.1 * pitch  # the wheel turns by up to a pitch, plus a margin
        if half < pi / 2:
            whole = shapely.intersection(whole, _wedge(facing, half, self.reaches[which]))
        self._cropped[kind] = whole
        return whole

    @cached_property
    def _alike(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Number for each tooth of both wheels, which is the same for teeth with equal outlines and neighbours."""
        first, second = self.materials
        return _alike(first, self.counts[0], False, self.same), _alike(second, self.counts[1], self.ring, self.same)

    # --------------------------------------------------------------------------------------------------- descriptions

    def words(self, place: tuple[float, float], names: tuple[str, str]) -> str:
        """Return a phrase with the part (tip, flank or root) and the radius of both wheels at the point `place`."""
        away = -self.distance if self.ring else self.distance
        radii = hypot(*place), hypot(place[0] - away, place[1])
        parts = [_part(radius, *reach) for radius, reach in zip(radii, self.reaches, strict=True)]
        return " on ".join(
            f"{part} of {name} (r {radius:.4g})" for part, name, radius in zip(parts, names, radii, strict=True)
        )


def _joined(found: Sequence[FreeTurn], place: tuple[float, float] | None) -> FreeTurn:
    low, high, overlap = (
        np.concatenate([getattr(each, name) for each in found]) for name in ("low", "high", "overlap")
    )
    return FreeTurn(low, high, overlap, place)


def _part(radius: float, tip: float, root: float) -> str:
    height = (radius - root) / (tip - root) if tip != root else 0.5
    return "tip" if height > 1 - _ENDS else "root" if height < _ENDS else "flank"


def _tooth_lines(material: Any, ring: bool) -> Any:
    """Return the line or lines of a wheel that can touch its mate.

    These are the largest hole of an internal wheel (`ring`), the outline of an external wheel, or the outlines of the
    pins of a lantern.
    """
    shapely = plane_geometry()
    if ring:
        return max(material.interiors, key=lambda line: float(shapely.Polygon(line).area))
    return material.exterior if material.geom_type == "Polygon" else shapely.boundary(material)


def _teeth(material: Any, ring: bool) -> tuple[float, float]:
    """Return the tip and root radii of a wheel [mm]; for a lantern, the maximum and minimum radii of its pins."""
    shapely = plane_geometry()
    radii = np.hypot(*shapely.get_coordinates(_tooth_lines(material, ring)).T)
    ends = float(radii.max()), float(radii.min())
    return ends[::-1] if ring else ends


def _alike(material: Any, count: int, ring: bool, same: float) -> tuple[int, ...]:
    """Return 0 for each tooth if a rotation by a pitch leaves the wheel unchanged, otherwise the numbers of the teeth.

    same   distance below which two outlines are treated as equal (mm)
    """
    shapely = plane_geometry()
    lines = _tooth_lines(material, ring)
    shapely.prepare(lines)
    turned = shapely.get_coordinates(lines) @ (1, 1j) * np.exp(2j * pi / count)
    near = shapely.dwithin(shapely.points(turned.real, turned.imag), lines, same)
    # a wheel that does not coincide with itself after a pitch is treated as having no two equal teeth
    return (0,) * count if near.all() else tuple(range(count))


def _wedge(facing: float, half: float, reach: tuple[float, float]) -> Any:
    """Return a sector of a ring about the axis, of half angle `half` about the direction `facing` [rad].

    reach   tip and root radii of the wheel, which the sector exceeds by margins (mm)
    """
    shapely = plane_geometry()
    height = abs(reach[0] - reach[1])
    steps = np.linspace(-half, half, 9)
    # divided by the cosine, so that the chords of the sector are outside the circle
    low, high = max(min(reach) - height, 0.0), (max(reach) + height) / cos(half / 8)
    outer = [(high * cos(facing + s), high * sin(facing + s)) for s in steps]
    inner = [(low * cos(facing + s), low * sin(facing + s)) for s in steps[::-1]]
    return shapely.Polygon([*outer, *inner] if low else [*outer, (0.0, 0.0)])


def _moved(material: Any, turns: Floats, away: float) -> Any:
    """Return copies of a shape, rotated by the angles `turns` [rad] and then shifted by `away` along x [mm]."""
    shapely = plane_geometry()
    x, y = shapely.get_coordinates(material).T
    c, s = np.cos(turns)[:, None], np.sin(turns)[:, None]
    places = np.stack([c * x - s * y + away, s * x + c * y], axis=2)
    copies = np.full(len(turns), material, dtype=object)
    return shapely.set_coordinates(copies, places.reshape(-1, 2))


# -------------------------------------------------------------------------------------------- reading a written outline


def plane_geometry() -> Any:
    """Return the module `shapely`. Raises `MissingExtraError` if the package is not installed."""
    try:
        import shapely
    except ImportError:
        raise MissingExtraError("shapely", "proof", "a proof that wheels turn") from None
    return shapely


def read_material(svg: str, pins: bool = False) -> Geometry:
    """Return the material that remains when the CUT path of a drawing is cut [mm], or the pins of a lantern.

    The largest closed line is the rim, and all other lines are holes. Raises `GearTrainError` for a drawing that cannot
    be cut: a line that crosses itself, or a hole that leaves the part.
    """
    shapely = plane_geometry()
    rings = [shapely.Polygon(line) for line in cut_lines(svg)]
    crossed = next((ring for ring in rings if not ring.is_valid), None)
    if crossed is not None:
        raise _uncuttable("a line crosses itself", shapely.is_valid_reason(crossed))
    outer = max(rings, key=lambda ring: float(ring.area))
    holes = [ring for ring in rings if ring is not outer]
    if pins:
        axle = shapely.Point(0.0, 0.0)
        return shapely.union_all([hole for hole in holes if not hole.covers(axle)])
    whole = shapely.Polygon(outer.exterior, [hole.exterior for hole in holes])
    if not whole.is_valid:
        raise _uncuttable("its lines intersect", shapely.is_valid_reason(whole))
    return whole


def cut_lines(svg: str, tolerance: float = TOLERANCE) -> list[list[Point]]:
    """Return the closed lines of the CUT path as lists of points [mm], with y upwards. Arcs are replaced by chords."""
    path = next(each for each in ElementTree.fromstring(svg).iter() if each.get("id") == _CUT)
    lines: list[list[Point]] = []
    for word, numbers in _commands(path.get("d", "")):
        if word == "M":
            lines.append([(numbers[0], -numbers[1])])
        elif word == "L":
            lines[-1].append((numbers[0], -numbers[1]))
        elif word == "A":
            end = numbers[5], -numbers[6]
            # with y upwards, a positive sweep turns right
            lines[-1] += _arc(lines[-1][-1], end, numbers[0], (bool(numbers[3]), not numbers[4]), tolerance)
    return lines


def _commands(data: str) -> Iterator[tuple[str, Sequence[float]]]:
    """Yield the letter of each command of an SVG path, with its numbers."""
    words = _WORDS.findall(data)
    at = 0
    while at < len(words):
        word = words[at]
        count = _COUNTS[word]
        yield word, [float(each) for each in words[at + 1 : at + 1 + count]]
        at += 1 + count


def _arc(start: Point, end: Point, radius: float, flags: tuple[bool, bool], tolerance: float) -> list[Point]:
    """Return the points of a circular arc from `start` to `end`, without its start, within `tolerance`.

    flags   True, True for the larger of the two possible arcs, and for a counter-clockwise arc
    """
    large, left = flags
    (x, y), (u, v) = start, end
    half = sqrt((u - x) ** 2 + (v - y) ** 2) / 2
    if not half:
        return []
    radius = max(radius, half)  # rounded coordinates may be farther apart than the diameter
    # centre by the formulas for circles that follow from appendix B.2.4 of SVG 2
    aside = sqrt(radius**2 - half**2) / (2 * half) * (1 if left != large else -1)
    cx, cy = (x + u) / 2 - aside * (v - y), (y + v) / 2 + aside * (u - x)
    first, last = atan2(y - cy, x - cx), atan2(v - cy, u - cx)
    sweep = (last - first) % (2 * pi) if left else -((first - last) % (2 * pi))
    count = max(1, ceil(abs(sweep) / (2 * acos(max(1 - tolerance / radius, -1.0)))))
    turns = (first + sweep * k / count for k in range(1, count))
    return [*((cx + radius * cos(t), cy + radius * sin(t)) for t in turns), end]


def _uncuttable(what: str, why: str) -> GearTrainError:
    fix = "change the teeth, the bore or the rim of the wheel"
    return GearTrainError(Problem(f"the wheel cannot be cut from this drawing: {what}", why, fix))
