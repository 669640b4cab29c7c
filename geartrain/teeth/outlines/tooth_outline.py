"""Outline of one tooth from root to tip: a flank computed from the path of contact, a root fillet and a top land."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, ceil, cos, pi, sin, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.outlines.contour import Contour, bulge_about

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact

_DENSE = 801  # sample points from which the final spacing is computed
_FEWEST = 8  # minimum number of pieces of a flank
_FINE = 4e-6  # modules: at smaller tolerances the change of direction is lost in rounding
_NEAR = 1e-3  # fraction of a flank: points closer than this are merged
_STRAIGHT = 1e-9  # modules, or rad: pieces with smaller deviation count as straight
_MEETING = 1e-9  # rad: fillets closer to each other meet in the middle of the space


@dataclass(frozen=True, slots=True)
class RootFillet:
    """Root fillet in the frame of the tooth. Points are complex numbers x + iy, with x along the centre line of the
    tooth and y towards the tooth space.

    Lengths are in modules.
    """

    start: complex
    """Point at which the straight root flank ends and the fillet arc begins [module]."""
    end: complex
    """Point at which the fillet arc touches the root circle [module]."""
    centre: complex
    """Centre of the fillet arc [module]."""
    radius: float
    """Radius of the fillet arc [module]."""

    @property
    def half(self) -> float:
        """Angle from the centre line of the tooth to the point where its root circle begins [rad]."""
        return atan2(self.end.imag, self.end.real)


def fillet(
    flank: FlankCurve, widening: float, root: float, radius: float, z: float, relief: float = 0.0
) -> RootFillet | None:
    """Return the root fillet with the given radius between a flank and the root circle with the radius `root` [module];
    None if the fillet does not fit.

    widening   half of the angular tooth thickness at the pitch circle [rad]
    relief     angle [rad] by which the straight root flank is turned from the flank's tangent into the tooth
    """
    half = widening + float(flank.angle[0])
    turn = complex(cos(half), sin(half))
    along, across = flank.tangent
    # the flank continues along its tangent, turned into the tooth by the relief
    lean = atan2(across, abs(along)) - relief
    way = complex(cos(lean) if along > 0 else -cos(lean), sin(lean))
    E, T = float(flank.r[0]) * turn, way * turn
    # of the two normals the one that points into the space, away from the centre line of the tooth
    N = 1j * T if way.real > 0 else -1j * T
    s = flank.outward
    # the centre is on a line parallel to the flank, at a distance of one radius from the root circle
    base = E + radius * N
    b, c = (base.conjugate() * T).real, abs(base) ** 2 - (root + s * radius) ** 2
    under = b * b - c
    # the arc would not touch the root circle
    if s * c < 0 or under < 0 or (t := -b - s * sqrt(under)) < 0:
        return None
    centre = base + t * T
    found = RootFillet(E + t * T, centre * root / abs(centre), centre, radius)
    # an arc across the middle of the space would intersect the arc of the next tooth
    return found if found.half <= pi / z else None


Vertex = tuple[float, float, float]
"""Vertex (x, y, bulge) of an outline. The bulge describes the edge from this vertex to the next one."""


@dataclass(frozen=True, slots=True)
class ToothOutline:
    """Outline of one of z equal teeth. Lengths are in modules."""

    z: float
    flank: FlankCurve
    fillet: RootFillet
    widening: float
    """Half of the angular tooth thickness at the pitch circle [rad]."""
    root: float
    """Radius of the root circle [module]."""

    @property
    def tip(self) -> float:
        """Radius of the tip circle [module]."""
        return float(self.flank.r[-1])

    @property
    def land(self) -> float:
        """Half of the angular thickness of the top land [rad]."""
        return self.widening + float(self.flank.angle[-1])

    def half_at(self, radius: Floats) -> Floats:
        """Return half the angular thickness of tooth and fillet [rad] at each `radius` from root to tip circle."""
        x, y = np.array([point[:2] for point in self._half()[1:]]).T
        place = x + 1j * y
        r, s = np.abs(place), self.flank.outward
        at = np.clip(np.searchsorted(r * s, radius * s, side="right") - 1, 0, len(r) - 2)
        start, along = place[at], place[at + 1] - place[at]
        # |start + t along| = radius, with the root at which the radius increases towards the tip
        a, b, c = np.abs(along) ** 2, (np.conj(along) * start).real, r[at] ** 2 - radius**2
        t = (-b + s * np.sqrt(np.maximum(b * b - a * c, 0.0))) / a
        edge = np.angle(start + np.clip(t, 0.0, 1.0) * along)
        if not self.fillet.radius:
            return np.asarray(edge)
        centre, far = self.fillet.centre, abs(self.fillet.centre)
        # avoids a division by 0
        cosine = (radius**2 + far**2 - self.fillet.radius**2) / (2 * np.maximum(radius, 1e-300) * far)
        on_fillet = np.angle(centre) - np.arccos(np.clip(cosine, -1.0, 1.0))
        return np.asarray(np.where(radius * s < r[0] * s, on_fillet, edge))

    def _half(self) -> list[tuple[float, float, float]]:
        """Return the vertices (x, y, bulge) of the half tooth with positive y, from root to tip."""
        fillet = self.fillet
        flank = self.flank.r * np.exp(1j * (self.widening + self.flank.angle))
        bulge = bulge_about(fillet.end, fillet.start, fillet.centre) if fillet.radius else 0.0
        end = fillet.end
        if pi / self.z - fillet.half < _MEETING:  # two fillets meet in the middle of the space
            end = self.root * complex(cos(pi / self.z), sin(pi / self.z))
        points = [end, fillet.start, *flank.tolist()]
        return [(at.real, at.imag, turn) for at, turn in zip(points, [bulge, *[0.0] * len(flank), 0.0], strict=True)]

    def whole(self) -> Contour:
        """Return the counter-clockwise contour of all teeth [module]. The first tooth is symmetric about the x axis."""
        return Contour.of(repeated(self.vertices(), int(self.z)))

    def vertices(self) -> list[Vertex]:
        """Return the vertices of one tooth symmetric about the x axis; its last edge is on the root circle."""
        half = self._half()
        x, y, _ = half[-1]
        land = bulge_about(complex(x, -y), complex(x, y))
        gap = pi / self.z - self.fillet.half
        ground = np.tan(gap / 2) if gap >= _MEETING else 0.0
        up = [(x, -y, -bulge) for x, y, bulge in half[:-1]] + [(x, -y, float(land))]
        # in reverse order the bulge of an edge belongs to its other end
        bulges = [bulge for _, _, bulge in half]
        down = [(x, y, -bulge) for (x, y, _), bulge in zip(half[:0:-1], bulges[-2::-1], strict=True)]
        return [*up, *down, (*half[0][:2], float(ground))]


def repeated(tooth: Sequence[Vertex], z: int) -> Iterator[Vertex]:
    """Yield the vertices of z teeth around the axle, as rotated copies of one tooth.

    Parameters
    ----------
    tooth : sequence of tuple
        x, y and bulge of each vertex.
    z : int
        Number of teeth.

    Yields
    ------
    tuple
        Vertices of all teeth, for `Contour.of`.

    Examples
    --------
    >>> [(round(x, 6), round(y, 6)) for x, y, _ in repeated([(1.0, 0.0, 0.0)], 2)]
    [(1.0, 0.0), (-1.0, 0.0)]
    """
    for k in range(z):
        c, s = cos(2 * pi * k / z), sin(2 * pi * k / z)
        for x, y, bulge in tooth:
            yield c * x - s * y, s * x + c * y, bulge


def pin_span(R: float, radius: float) -> Floats:
    """Return the radii and azimuths [rad], shape (2, n), of points on the surface of a pin with the radius `radius`
    whose centre is at the distance R from the axle.
    """
    turn = np.linspace(0, 2 * pi, 181)
    x, y = R + radius * np.cos(turn), radius * np.sin(turn)
    return np.stack([np.hypot(x, y), np.arctan2(y, x)])


# --------------------------------------------------------------------------------------- flank from the path of contact


@dataclass(frozen=True, slots=True)
class FlankCurve:
    """Flank from its root end to its tip end. Lengths are in modules.

    The polyline of the flank is always inside the true tooth. Convex parts are approximated by chords and concave parts
    by tangents, so that teeth in contact without backlash do not overlap.
    """

    r: Floats
    """Radii of the vertices of the polyline [module]."""
    angle: Floats
    """Half of the angular tooth thickness at each vertex, minus half of the thickness at the pitch circle [rad]."""
    curve: Floats
    """Radii [module] and angles [rad] of densely spaced points on the true flank, shape (2, n)."""
    tangent: tuple[float, float]
    """Unit tangent at the root end of the flank towards the root: components along the radius and towards the space."""
    R: float
    """Pitch radius of the wheel [module]."""
    outward: int
    """Sign of the radial direction from root to tip: 1 for an external wheel, -1 for a ring gear."""


def flank(path: PathOfContact, gear: int, arcs: tuple[float, float], tolerance: float) -> FlankCurve:
    """Return the flank of gear 1 or 2 between the arcs X of approach and recess, as a polyline within `tolerance`
    [module] of the true flank.

    If an arc is negative, the flank begins beyond the pitch point.
    """
    approach, recess = arcs
    pitch = path.pitch
    ends = (-approach, recess) if gear == 1 else (recess, -approach)
    dense = np.linspace(*ends, _DENSE)
    X = _spaced_displacements(path, gear, dense, max(tolerance, _FINE))
    outward = -1 if gear == 2 and pitch.R2 < 0 else 1
    if (np.diff(_polar(path, gear, X)[0]) * outward <= 0).any():
        why = "its radius does not increase steadily from the root to the tip"
        raise RangeError(Problem(f"the flank of gear {gear} turns back", why, "shorten the arcs, or use more teeth"))
    r, angle = _inner_polyline(path, gear, X, outward)
    along, across = _tangents(path, gear, X[:1], outward)
    tangent = float(along[0]), float(across[0])
    return FlankCurve(r, angle, np.stack(_polar(path, gear, dense)), tangent, abs(pitch.axle_of(gear)), outward)


def _polar(path: PathOfContact, gear: int, X: Floats) -> tuple[Floats, Floats]:
    """Return radius about the axle [module] and azimuth from the pitch point [rad] of the flank points in contact at
    arcs X on the pitch circles. The azimuth is positive towards the tooth space.
    """
    radius, azimuth = path.pitch.polar(gear, path.flank(gear, X))
    return radius, azimuth if gear == 1 else -azimuth


def _spaced_displacements(path: PathOfContact, gear: int, X: Floats, tolerance: float) -> Floats:
    """Return arcs on the pitch circles such that all chords between the flank points in contact at successive arcs
    deviate equally from the flank: the product of chord length and square root of the curvature is constant.
    """
    points = path.flank(gear, X)
    steps = np.diff(points, axis=0)
    length = np.hypot(steps[:, 0], steps[:, 1])
    heading = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    turned = np.abs(np.gradient(heading))
    # a chord of length ds deviates from an arc by ds^2 curvature / 8
    cost = np.concatenate(([0.0], np.cumsum(np.sqrt(turned * length / (8 * tolerance)))))
    # a share proportional to length gives points to straight parts also
    cost += np.linspace(0, 0.02 * cost[-1] + 1e-9, len(cost))
    # 20 % more points than estimated, for curvature that varies within a piece
    count = max(_FEWEST, ceil(1.2 * cost[-1])) + 1
    found = np.interp(np.linspace(0, cost[-1], count), cost, X)
    bends = np.append(X[_inflections(path, gear, X)], _corner(path, gear, found, tolerance))
    if not bends.size:
        return found
    near = _NEAR * abs(found[-1] - found[0])
    inner = [x for x in found[1:-1].tolist() if np.abs(bends - x).min() > near]
    ends = [b for b in bends.tolist() if min(abs(b - found[0]), abs(b - found[-1])) > near]
    whole = np.unique([found[0], *inner, *ends, found[-1]])
    return whole if found[0] < found[-1] else whole[::-1]


def _corner(path: PathOfContact, gear: int, X: Floats, tolerance: float) -> list[float]:
    """Return a list with the arc 0 of the pitch point if a chord across this point would cut off a corner of the flank,
    and an empty list if not. The curvature of a cycloid is infinite there, so that the deviation cannot be estimated
    from it.
    """
    if not X.min() < 0 < X.max():
        return []
    first, last, corner = path.flank(gear, np.array([X[X < 0].max(), X[X > 0].min(), 0.0])) @ np.array([1, 1j])
    return [0.0] if abs(_cross(last - first, corner - first)) > tolerance / 2 * abs(last - first) else []


def _inflections(path: PathOfContact, gear: int, X: Floats) -> Floats:
    """Return the indices of the last flank points before each sign change of the curvature, for contacts at arcs X."""
    points = path.flank(gear, X)
    steps = np.diff(points @ np.array([1, 1j]))
    bent = np.angle(steps[1:] * np.conj(steps[:-1]))
    sense = np.sign(np.where(np.abs(bent) > _STRAIGHT, bent, 0.0))
    bending = np.flatnonzero(sense)
    turns = sense[bending[1:]] != sense[bending[:-1]]
    return np.asarray(bending[:-1][turns] + 1)


def _inner_polyline(path: PathOfContact, gear: int, X: Floats, outward: int) -> tuple[Floats, Floats]:
    """Return radii [module] and angles [rad] of a polyline inside the tooth. It consists of points of the flank where
    the flank is convex, and of intersections of tangents where the flank is concave. `outward` is 1 if radii increase.
    """
    r, angle = _polar(path, gear, X)
    points = r * np.exp(1j * angle)
    along, across = _tangents(path, gear, X, outward)
    ways = (along + 1j * across) * np.exp(1j * angle)  # towards the root
    middle, turned = _polar(path, gear, (X[1:] + X[:-1]) / 2)
    chord = points[1:] - points[:-1]
    # distance of the middle of a piece from its chord, away from the space
    sagitta = _cross(chord, middle * np.exp(1j * turned) - points[:-1]) / np.abs(chord) * -outward
    det = _cross(ways[:-1], ways[1:])
    concave = (sagitta > _STRAIGHT) & (np.abs(det) > _STRAIGHT)
    if not concave.any():
        return r, angle
    reach = _cross(chord, ways[1:]) / np.where(concave, det, 1.0)
    corners = points[:-1] + reach * ways[:-1]
    line = [points[0]]
    for k, bent in enumerate(concave.tolist()):
        # between two concave pieces the tangent point is on the line from corner to corner
        line += [corners[k]] if bent else []
        line += [] if bent and k + 1 < len(concave) and concave[k + 1] else [points[k + 1]]
    found = np.array(line)
    return np.abs(found), np.angle(found)


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray((np.conj(a) * b).imag)


def _tangents(path: PathOfContact, gear: int, X: Floats, outward: int) -> tuple[Floats, Floats]:
    """Return two components of the flank's unit tangents: radial, and towards the tooth space. They are perpendicular
    to the contact normal and directed towards the root; `outward` is 1, or -1 for a ring gear.
    """
    contact = path.at(X)
    sine, cosine = contact.sin_psi, contact.cos_psi
    x, y = path.pitch.point(contact.d, contact.sin_psi, contact.cos_psi).T
    y = y - path.pitch.axle_of(gear)
    up = 1.0 if (gear == 1 or outward < 0) else -1.0
    lean = np.arctan2(x, y * up)  # angle of the radius to the contact, from the line of centres towards +x
    # unit vectors along the radius and across it towards +x; the flank runs along (-sine, cosine)
    along = -sine * np.sin(lean) + cosine * up * np.cos(lean)
    across = (-sine * np.cos(lean) - cosine * up * np.sin(lean)) * (1 if gear == 1 else -1)
    rootward = np.where(along > 0, -outward, outward)
    return rootward * along, rootward * across
