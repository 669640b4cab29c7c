"""Shapes of couplings other than pins, such as belts on pulleys, non-circular wheels, cams, Geneva drives and racks.

The outlines of non-circular wheels and of cams follow from the transmission function of the coupling. Undeclared sizes
are chosen for the picture.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import acos, asin, atan2, ceil, cos, hypot, pi, sin
from typing import TYPE_CHECKING, Any

from geartrain.numerics.quantity import Quantity
from geartrain.numerics.vectors import Vector, across, cross, dot, foot, minus, plus, scaled, size, unit, unit_or_z
from geartrain.scene.elements import SceneHanger, ScenePart

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit
    from geartrain.scene.context import SceneContext
    from geartrain.teeth.coupling import Coupling

Point = tuple[float, float]

_NONE = 1e-9  # mm: smaller distances are rounding errors
_STEPS = 240  # points of an outline that rolls
_ARC = pi / 36  # maximum angle of a chord [rad]
_THICK = 3.0  # thickness of shapes [mm]
_GAP = 1.5  # distance between shapes and wheels along the axis [mm]


@dataclass(frozen=True)
class _CouplingPlace:
    """Coupling to be drawn: its declaration, its circuit, and one point on each of its two axes."""

    stage: SceneContext
    declared: Any
    circuit: Circuit
    axis: Vector
    """Unit vector along both axes, in their reference direction."""
    driver_at: Vector
    """Point on the driver's axis at the height of the shapes [mm]."""
    driven_at: Vector
    """Point on the driven link's axis at the height of the shapes [mm]."""

    @property
    def apart(self) -> float:
        """Distance between the axes [mm]."""
        return size(minus(self.driven_at, self.driver_at))

    @property
    def towards(self) -> Vector:
        """Unit vector from the driver's axis to the driven link's axis."""
        return unit_or_z(minus(self.driven_at, self.driver_at)) if self.apart > _NONE else beside_axis(self.axis)

    @property
    def sense(self) -> int:
        """1 if the driver and the driven link turn in the same sense on average, -1 if in opposite senses."""
        return -1 if self.circuit.ratio < 0 else 1

    def flat(
        self, link: str, kind: str, at: Vector, towards: Vector, *outlines: Sequence[Point], height: float = _THICK
    ) -> ScenePart:
        """Return a flat part of a link with the given outlines, whose origin is at the point `at` [mm].

        kind      kind of the part, which is also added to its name
        towards   direction of the x axis of the outlines
        height    thickness of the part [mm]
        """
        lines = [[value for point in line for value in point] for line in outlines]
        name, body = f"{self.circuit.id} {kind}", self.stage.body[link]
        return ScenePart(body, name, kind, at, self.axis, across(towards, self.axis), (), lines, height)

    def turned(
        self, link: str, kind: str, at: Vector, radius: float, low: float, high: float, way: Vector | None = None
    ) -> ScenePart:
        """Return a cylinder of a link about an axis through the point `at` [mm].

        kind        kind of the part, which is also added to its name
        low, high   positions of the ends, measured from `at` [mm]
        way         direction of the axis; None for the direction of the coupling's axes
        """
        direction = self.axis if way is None else way
        name, body = f"{self.circuit.id} {kind}", self.stage.body[link]
        return ScenePart(body, name, kind, at, direction, beside_axis(direction), ((low, high, radius, 0.0),))

    def rod(self, link: str, to: str, at: Vector, way: Vector, length: float, radius: float) -> SceneHanger:
        """Return a rod or rope that extends along `way` from the point `at` of one link to a point of the link `to`."""
        body = self.stage.body
        return SceneHanger("rod", body[link], at, self.axis, way, length, 0.0, radius, to=body[to])

    def guides(self, at: Vector, way: Vector, aside: float, reach: float) -> Iterator[ScenePart]:
        """Yield two bars on the carrier that guide a sliding block.

        at      middle of the path of the block [mm]; `way` is the direction in which it slides
        aside   distance of each bar from the path [mm]; `reach` is half the length of a bar [mm]
        """
        up, high = cross(self.axis, way), 0.15 * aside
        for side in (1, -1):
            bar = _bar((-reach, 0.0), (reach, 0.0), 2 * high)
            yield self.flat(self.circuit.carrier, "guide", plus(at, up, side * (aside + high)), way, bar)


def beside_axis(axis: Vector) -> Vector:
    """Return a unit vector perpendicular to an axis."""
    start: Vector = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.9 else (0.0, 1.0, 0.0)
    return unit(across(start, axis))


def find_shapes(stage: SceneContext) -> tuple[tuple[ScenePart, ...], tuple[SceneHanger, ...]]:
    """Return the shapes of all couplings other than pins, in the order of declaration, and their rods and ropes."""
    circuits = {circuit.id: circuit for circuit in stage.train.circuits}
    found: list[ScenePart] = []
    rods: list[SceneHanger] = []
    for coupling in stage.train.declaration.couplings:
        draw = _SHAPES.get(coupling.kind)
        if draw is None:
            continue
        level = len({part.place for part in found})
        rows = [circuits[row.id] for row in coupling.rows(stage.train.declaration.wheels)]
        places = [_placed(stage, coupling, circuit, level) for circuit in rows]
        for each in draw(places):
            (rods if isinstance(each, SceneHanger) else found).append(each)
    return tuple(found), tuple(rods)


def _placed(stage: SceneContext, coupling: Coupling, circuit: Circuit, level: int) -> _CouplingPlace:
    """Return a coupling with the points of its axes at one height above all wheels; `level` counts drawn couplings."""
    tree = stage.train.kinematics.tree
    labels = tree.axis_seen_from(circuit.carrier, circuit.j), tree.axis_seen_from(circuit.carrier, circuit.i)
    axis = stage.reference(labels[0])
    tops = [
        dot(place.centre, axis) + place.thickness / 2
        for place in stage.layout.wheels.values()
        if abs(dot(unit_or_z(stage.along(place.axis)), axis)) > 1 - _NONE
    ]
    height = max(tops, default=0.0) + _GAP + _THICK / 2 + level * (_THICK + _GAP) * (level > 0)
    points = [stage.layout.axes[label].point if label in stage.layout.axes else (0.0, 0.0, 0.0) for label in labels]
    lifted = [plus(point, axis, height - dot(point, axis)) for point in points]
    return _CouplingPlace(stage, coupling, circuit, axis, lifted[0], lifted[1])


# ------------------------------------------------------------------------------------------------------------- outlines


def circle(radius: float, centre: Point = (0.0, 0.0), start: float = 0.0, sweep: float = 2 * pi) -> list[Point]:
    """Return points on a circle, or on an arc that begins at the angle `start` and spans `sweep` [rad]."""
    whole = abs(abs(sweep) - 2 * pi) < _NONE
    count = max(ceil(abs(sweep) / _ARC), 2)
    angles = [start + sweep * at / count for at in range(count + (not whole))]
    return [(centre[0] + radius * cos(angle), centre[1] + radius * sin(angle)) for angle in angles]


def _bar(start: Point, end: Point, width: float) -> list[Point]:
    """Return the corners of a straight bar of a given width between two points."""
    along = end[0] - start[0], end[1] - start[1]
    length = hypot(*along) or 1.0
    x, y = -along[1] / length * width / 2, along[0] / length * width / 2
    return [
        (start[0] + x, start[1] + y),
        (start[0] - x, start[1] - y),
        (end[0] - x, end[1] - y),
        (end[0] + x, end[1] + y),
    ]


def toothed(teeth: int, module: float) -> list[Point]:
    """Return the outline of a wheel with trapezoidal teeth, one of which is at angle 0."""
    radius, found = teeth * module / 2, []
    tip, root, pitch = radius + module, max(radius - 1.25 * module, 0.3 * radius), 2 * pi / teeth
    for at in range(teeth):
        shape = ((-0.36, root), (-0.12, tip), (0.12, tip), (0.36, root))
        found += [(r * cos((at + share) * pitch), r * sin((at + share) * pitch)) for share, r in shape]
    return found


def _polar(radii: Sequence[float], angles: Sequence[float]) -> list[Point]:
    return [(radius * cos(angle), radius * sin(angle)) for radius, angle in zip(radii, angles, strict=True)]


def millimetres_of(length: Quantity | None, default: float) -> float:
    """Return a declared length [mm], or `default` if the length is not declared or has no unit."""
    return default if length is None or length.unit is None else 1000 * length.si


# ---------------------------------------------------------------------------------------------------- belts and pulleys


def _box(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart]:
    """Yield the housing of a coupling for which only the ratio is known, and its two shafts with flanges."""
    place = places[0]
    half = 8.0 + 0.2 * place.apart
    holes = [circle(0.09 * half, (0.38 * half * x, 0.38 * half * y)) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    for kind, radius, middle, height in (("box", 1.0, 0.0, 1.8), ("lid", 1.15, -0.9, 0.2), ("lid", 1.15, 0.9, 0.2)):
        ends = circle(radius * half, (0.0, 0.0), pi / 2, pi), circle(radius * half, (place.apart, 0.0), -pi / 2, pi)
        at = plus(place.driver_at, place.axis, middle * half)
        yield place.flat(place.circuit.carrier, kind, at, place.towards, [*ends[0], *ends[1]], height=height * half)
    for link, at, side in ((place.circuit.j, place.driver_at, -1), (place.circuit.i, place.driven_at, 1)):
        yield place.turned(link, "shaft", at, 0.2 * half, min(0, 2 * side) * half, max(0, 2 * side) * half)
        end = plus(at, place.axis, 1.8 * side * half)
        yield place.flat(link, "flange", end, place.towards, circle(0.55 * half), *holes, height=0.2 * half)


def _belt(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart]:
    """Yield the pulleys of a belt, and the belt itself, fixed to the carrier, unless one of its pulleys idles."""
    first = places[0]
    ends = (first.circuit.j, *(place.circuit.i for place in places))
    points = (first.driver_at, *(place.driven_at for place in places))
    senses = (1, *(place.sense for place in places))
    origin, x = first.driver_at, first.towards
    y = cross(first.axis, x)
    flat = [(dot(minus(point, origin), x), dot(minus(point, origin), y)) for point in points]
    radii = _pulley_radii(first.stage, first.declared, ends, flat)
    for link, point, radius in zip(ends, points, radii, strict=True):
        rim = max(radius - 1.0, 0.6 * radius)
        holes = [
            circle(0.14 * radius, (0.55 * radius * cos(turn), 0.55 * radius * sin(turn))) for turn in (0, 2.1, 4.2)
        ]
        yield first.flat(link, "pulley", point, x, circle(rim), *holes)
    if any(_is_idle(first.stage, link) for link in ends):
        return
    width = max(0.08 * min(radii), 0.8)
    for outline in belt_outlines(flat, radii, senses, width):
        yield first.flat(first.circuit.carrier, "belt", origin, x, outline, height=0.8 * _THICK)


def _is_idle(stage: SceneContext, link: str) -> bool:
    """Return True if a link turns with only one coupling, and every clutch that could lock it is open in the state."""
    declared, case = stage.train.declaration, stage.case
    clutches = {name: each for name, each in declared.clutches.items() if link in (*(each.locks or ()), each.fixes)}
    locked = any(name in case.engaged or each.one_way for name, each in clutches.items())
    if not clutches or locked or link in case.inputs:
        return False
    return sum(link in (circuit.i, circuit.j) for circuit in stage.train.circuits) == 1


def _pulley_radii(stage: SceneContext, declared: Any, ends: Sequence[str], flat: Sequence[Point]) -> list[float]:
    """Return the pitch radii of the pulleys of a belt [mm], reduced if pulleys would overlap.

    declared   declared belt
    ends       links of the pulleys; `flat` are the positions of their axes [mm]
    """
    around = declared.around
    if isinstance(around, Mapping):
        radii = [millimetres_of(length, float(length.value)) / 2 for length in around.values()]
    else:
        radii = [stage.layout.wheels[wheel].radius for wheel in around]
    gaps = [
        hypot(flat[i][0] - flat[j][0], flat[i][1] - flat[j][1]) / (radii[i] + radii[j])
        for i in range(len(ends))
        for j in range(i)
    ]
    return [radius * min(1.0, 0.95 * min(gaps)) for radius in radii]


def belt_outlines(
    centres: Sequence[Point], radii: Sequence[float], senses: Sequence[int], width: float
) -> Iterator[list[Point]]:
    """Yield the outlines of a closed belt: for each pulley, its arc and the straight part to the next pulley.

    The belt passes the pulleys in the given order. `senses` is 1 for pulleys that turn in the sense of the first
    pulley, and -1 for pulleys that the outer face of the belt touches.
    """
    count = len(centres)
    # centres in order of a positive turn about the first pulley, otherwise the belt would run round them backwards
    area = sum(centres[i - 1][0] * centres[i][1] - centres[i][0] * centres[i - 1][1] for i in range(count))
    if count > 2 and area < 0:
        order = [0, *range(count - 1, 0, -1)]
        centres, radii, senses = ([values[i] for i in order] for values in (centres, radii, senses))
    leave: list[Point] = [(0.0, 0.0)] * count
    reach: list[Point] = [(0.0, 0.0)] * count
    for i in range(count):
        j = (i + 1) % count
        dx, dy = centres[j][0] - centres[i][0], centres[j][1] - centres[i][1]
        own, other = senses[i] * radii[i], senses[j] * radii[j]
        # the normal L of the tangent, to the left of the direction of travel, has d . L = s_j r_j - s_i r_i
        angle = atan2(dy, dx) + acos(max(-1.0, min(1.0, (other - own) / hypot(dx, dy))))
        normal = cos(angle), sin(angle)
        leave[i] = centres[i][0] - own * normal[0], centres[i][1] - own * normal[1]
        reach[j] = centres[j][0] - other * normal[0], centres[j][1] - other * normal[1]
    for i in range(count):
        (x, y), (r, s) = centres[i], (radii[i], senses[i])
        start, end = (atan2(point[1] - y, point[0] - x) for point in (reach[i], leave[i]))
        sweep = s * ((s * (end - start)) % (2 * pi))
        outer, inner = (circle(r + side * width / 2, centres[i], start, sweep) for side in (1, -1))
        if abs(sweep) > _NONE:
            yield [*outer, *reversed(inner)]
        yield _bar(leave[i], reach[(i + 1) % count], width)


# ------------------------------------------------------------------------------------------- wheels that roll, and cams


def _rolling(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart]:
    """Yield two non-circular wheels that roll on each other without slip, computed from their transmission function.

    At the driver's angle S, the radii are C q'/(1 + q') and C/(1 + q'), with the axis distance C and the speed ratio
    q'.
    """
    import numpy as np

    place = places[0]
    transmission = place.declared.transmission
    S = np.arange(_STEPS) * (2 * pi / _STEPS)
    # the driven wheel makes one turn in 1/mean turns of the driver
    turn = np.arange(_STEPS) * (2 * pi / float(transmission.ratio) / _STEPS)
    C = place.apart
    first = C * transmission.speed(S) / (1 + transmission.speed(S))
    second = C / (1 + transmission.speed(turn))
    driver = _polar(first.tolist(), (-S).tolist())
    driven = _polar(second.tolist(), transmission.angle(turn).tolist())
    yield from _drilled(place, place.circuit.j, place.driver_at, place.towards, driver)
    yield from _drilled(place, place.circuit.i, place.driven_at, scaled(place.towards, -1.0), driven)


def _drilled(
    place: _CouplingPlace, link: str, at: Vector, towards: Vector, outline: list[Point]
) -> Iterator[ScenePart]:
    nearest = min(hypot(*point) for point in outline)
    yield place.flat(link, "wheel", at, towards, outline)
    yield place.turned(link, "hub", at, 0.25 * nearest, -_THICK, _THICK)


def _cam(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart]:
    """Yield a cam and its follower arm with a roller. The angle of the arm follows the transmission function."""
    import numpy as np

    place = places[0]
    transmission, C = place.declared.transmission, place.apart
    if float(transmission.ratio):
        if transmission.speed_range()[0] > 0 and (1 / transmission.ratio).denominator == 1:
            yield from _rolling(places)
        return
    # an arm that swings far is short, so that its cam is not much wider than the distance of the axes
    swing = float(np.ptp(transmission.error_range()))
    arm, roller, base = (0.8 if swing < pi / 3 else 0.35) * C, 0.05 * C, acos(0.5)
    S = np.arange(_STEPS) * (2 * pi / _STEPS)
    angle = pi - base + transmission.error(S)
    x, y = C + arm * np.cos(angle), arm * np.sin(angle)
    centre = (x + 1j * y) * np.exp(-1j * S)
    along = np.roll(centre, -1) - np.roll(centre, 1)
    inside = centre + roller * 1j * along / np.abs(along) * np.sign(np.sum((centre.conj() * along).imag))
    outline = [(float(point.real), float(point.imag)) for point in inside]
    yield from _drilled(place, place.circuit.j, place.driver_at, place.towards, outline)
    tip = float(arm * cos(pi - base)), float(arm * sin(pi - base))
    lifted = plus(place.driven_at, place.axis, _THICK)
    yield place.flat(place.circuit.i, "arm", lifted, place.towards, _bar((0.0, 0.0), tip, 0.06 * C))
    end = plus(plus(place.driven_at, place.towards, tip[0]), cross(place.axis, place.towards), tip[1])
    yield place.turned(place.circuit.i, "roller", end, roller, -_THICK / 2, 1.5 * _THICK)
    yield place.turned(place.circuit.i, "hub", place.driven_at, 0.05 * C, -_THICK, 2 * _THICK)


# ---------------------------------------------------------------------------------------------------------------- steps


def _geneva(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart]:
    """Yield the slotted cross or star of a Geneva drive, and the driver with its pins and locking disc."""
    place = places[0]
    n, C, internal = place.declared.slots, place.apart, place.declared.internal
    r, pin = C * sin(pi / n), 0.035 * C
    driven, driver = place.circuit.i, place.circuit.j
    back = scaled(place.towards, -1.0)
    if internal:
        outline = [point for at in range(n) for point in _slot(2 * pi * at / n, C * cos(pi / n) * 0.98, C + r, pin)]
        yield place.flat(driven, "cross", place.driven_at, back, circle(C + r + 4 * pin), outline)
    else:
        yield place.flat(driven, "cross", place.driven_at, back, _cross(n, C, r, pin))
        alpha, lock = pi / 2 - pi / n, r - 2.2 * pin
        notch = circle(lock, (0.0, 0.0), alpha, 2 * pi - 2 * alpha)
        yield place.flat(driver, "lock", place.driver_at, place.towards, [*notch, (0.3 * lock, 0.0)])
    for at in range(place.declared.pins):
        turn = 2 * pi * at / place.declared.pins
        end = r * cos(turn), r * sin(turn)
        below = plus(place.driver_at, place.axis, -_THICK)
        yield place.flat(driver, "arm", below, place.towards, _bar((0.0, 0.0), end, 4 * pin))
        where = plus(plus(below, place.towards, end[0]), cross(place.axis, place.towards), end[1])
        yield place.turned(driver, "pin", where, pin, 0.0, 1.6 * _THICK)


def _slot(angle: float, near: float, far: float, half: float) -> list[Point]:
    """Return the corners of a radial slot of half width `half`, open at the radius `near` and closed at `far` [mm]."""
    corners = ((near, -half), (far, -half), (far, half), (near, half))
    return [(x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)) for x, y in corners]


def _cross(n: int, C: float, r: float, pin: float) -> list[Point]:
    """Return the outline of a Geneva cross with `n` slots, one of them at angle 0, and locking arcs between them.

    C     axis distance [mm]
    r     radius of the path of the driving pin [mm]
    pin   half width of a slot [mm]
    """
    rim, bottom, lock = C * cos(pi / n), C - r - 1.5 * pin, r - 2.0 * pin
    found: list[Point] = []
    for at in range(n):
        angle = 2 * pi * at / n
        edge = asin(pin / rim)
        found += [(rim * cos(angle - edge), rim * sin(angle - edge))]
        shape = ((bottom, -pin), (bottom, pin))
        found += [(x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)) for x, y in shape]
        found += [(rim * cos(angle + edge), rim * sin(angle + edge))]
        middle = angle + pi / n
        # a locking arc about the driver's axis at rest, which is at C in the direction of the middle
        open_ = (C * C + rim * rim - lock * lock) / (2 * C * rim)
        if abs(open_) < 1 and acos(open_) < pi / n - edge:
            half = acos(open_)
            arc = atan2(rim * sin(half), C - rim * cos(half))
            centre = C * cos(middle), C * sin(middle)
            found += circle(lock, centre, middle + pi + arc, -2 * arc)
    return found


def _star(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart]:
    """Yield a star wheel with pointed teeth, and the driver with the fingers that move the star."""
    place = places[0]
    z, C = place.declared.teeth, place.apart
    reach = 0.62 * C
    star = _polar([reach if at % 2 == 0 else 0.8 * reach for at in range(2 * z)], [pi * at / z for at in range(2 * z)])
    yield place.flat(place.circuit.i, "star", place.driven_at, scaled(place.towards, -1.0), star)
    finger = C - 0.84 * reach
    for at in range(place.declared.times):
        turn = 2 * pi * at / place.declared.times
        end = finger * cos(turn), finger * sin(turn)
        yield place.flat(place.circuit.j, "finger", place.driver_at, place.towards, _bar((0.0, 0.0), end, 0.05 * C))
    yield place.flat(place.circuit.j, "hub", place.driver_at, place.towards, circle(0.6 * finger))


# --------------------------------------------------------------------------------------------------------------- travel


def _along_slide(place: _CouplingPlace) -> Vector:
    """Return the unit vector of the direction in which the sliding link of a coupling travels."""
    circuit, tree = place.circuit, place.stage.train.kinematics.tree
    return place.stage.line(tree.axis_seen_from(circuit.carrier, circuit.i))


def _rack(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart]:
    """Yield a pinion, and a rack on the sliding link. The rack is tangent to the pitch circle of the pinion."""
    place = places[0]
    declared, way = place.declared, _along_slide(place)
    z = declared.teeth or 18
    pitch = getattr(declared, "pitch", None)
    module = millimetres_of(getattr(declared, "module", None), millimetres_of(pitch, 2 * pi) / pi)
    up = cross(place.axis, way)
    side = 1 if getattr(declared, "reversed", False) else -1
    yield place.flat(declared.turns, "pinion", place.driver_at, scaled(up, side), toothed(z, module))
    line = plus(place.driver_at, up, side * (z * module / 2))
    p, many = pi * module, max(z, 12)
    teeth: list[Point] = []
    for at in range(-many // 2, many // 2):
        # a tooth space of the rack is opposite to the tooth of the pinion in the zero pose
        shape = ((0.14, -1.25), (0.36, 1.0), (0.64, 1.0), (0.86, -1.25))
        teeth += [((at + share) * p, -side * height * module) for share, height in shape]
    ends = [(teeth[-1][0], side * 3.5 * module), (teeth[0][0], side * 3.5 * module)]
    yield place.flat(declared.slides, "rack", line, way, [*teeth, *ends])
    # the rail behind the rack, which the pinion pushes against it
    rail = _bar((-0.6 * many * p, side * 4.2 * module), (0.6 * many * p, side * 4.2 * module), 1.2 * module)
    yield place.flat(place.circuit.carrier, "guide", line, way, rail, height=1.5 * _THICK)


def _screw(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart]:
    """Yield a threaded rod on the turning link, drawn as collars one lead apart, and a nut on the sliding link."""
    place = places[0]
    declared = place.declared
    lead = millimetres_of(declared.lead, 4.0)
    radius = millimetres_of(getattr(declared, "diameter", None), max(3 * lead, 8.0)) / 2
    turns = 12
    bands: list[tuple[float, float, float, float]] = []
    for at in range(-turns, turns):
        low = at * lead / 2
        bands.append((low, low + lead / 2, radius if at % 2 else 0.8 * radius, 0.0))
    name, body = f"{place.circuit.id} screw", place.stage.body[declared.turns]
    yield ScenePart(body, name, "screw", place.driver_at, place.axis, beside_axis(place.axis), tuple(bands))
    nut = [(1.8 * radius * cos(pi * at / 3), 1.8 * radius * sin(pi * at / 3)) for at in range(6)]
    rods = [(1.45 * radius * cos(turn), 1.45 * radius * sin(turn)) for turn in (0.0, pi)]
    holes = (circle(0.16 * radius, rod) for rod in rods)
    yield place.flat(
        declared.slides, "nut", place.driver_at, place.towards, nut, circle(radius), *holes, height=2 * lead
    )
    for x, _ in rods:  # which keep the nut from turning
        middle, end = plus(place.driver_at, place.towards, x), turns * lead / 2
        yield place.turned(place.circuit.carrier, "guide", middle, 0.14 * radius, -end, end)


def _drum(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart | SceneHanger]:
    """Yield a drum, its falls of rope, and the weight of the sliding link, with a pulley if there are several falls."""
    place = places[0]
    declared, way = place.declared, _along_slide(place)
    radius = millimetres_of(declared.diameter, 20.0) / 2
    yield place.turned(declared.turns, "drum", place.driver_at, radius, -2 * _THICK, 2 * _THICK)
    side = scaled(cross(way, place.axis), -1.0 if declared.reversed else 1.0)
    hang = scaled(way, -1.0 if (place.stage.speed(declared.slides) or 0) < 0 else 1.0)
    start, apart, long = plus(place.driver_at, side, radius), 0.5 * radius, 4 * radius
    last = (declared.falls - 1) * apart
    for fall in range(declared.falls):
        at, link = plus(start, side, fall * apart), place.circuit.carrier
        yield place.rod(link, declared.slides, at, hang, long, 0.04 * radius + 0.2)
    middle = plus(plus(start, side, last / 2), hang, long)
    if last:
        yield place.turned(declared.slides, "pulley", middle, last / 2, -0.4 * _THICK, 0.4 * _THICK)
    top = last / 2 + 0.1 * radius
    yield place.turned(declared.slides, "cord", middle, 0.04 * radius + 0.2, 0.0, top, hang)
    yield place.turned(declared.slides, "weight", plus(middle, hang, top), 0.6 * radius, 0.0, 1.6 * radius, hang)


def _slider(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart | SceneHanger]:
    """Yield the crank of a slider-crank with its pin, the connecting rod, and the sliding block between its guides."""
    place = places[0]
    declared, way = place.declared, _along_slide(place)
    radius, rod = (millimetres_of(length, 10.0) for length in (declared.radius, declared.rod))
    yield place.flat(declared.turns, "arm", place.driver_at, way, _bar((0.0, 0.0), (radius, 0.0), 0.25 * radius))
    yield place.turned(declared.turns, "pin", plus(place.driver_at, way, radius), 0.1 * radius, -_THICK, _THICK)
    block = plus(place.driver_at, way, radius + rod)
    w, h = 0.5 * radius, 0.35 * radius
    front = plus(place.driver_at, place.axis, _THICK)
    yield place.rod(declared.turns, declared.slides, plus(front, way, radius), way, rod, 0.08 * radius)
    yield place.turned(declared.slides, "pin", block, 0.1 * radius, -_THICK, 1.5 * _THICK)
    yield from place.guides(plus(block, way, -radius), way, h, radius + w)
    yield place.flat(declared.slides, "block", block, way, [(-w, -h), (w, -h), (w, h), (-w, h)])


# ------------------------------------------------------------------------------------------------------ universal joint


def _universal(places: Sequence[_CouplingPlace]) -> Iterator[ScenePart]:
    """Yield two shafts with forks at the point where their axes intersect, with pins at right angles."""
    place = places[0]
    stage, circuit = place.stage, place.circuit
    tree = stage.train.kinematics.tree
    labels = [tree.axis_seen_from(circuit.carrier, link) for link in (circuit.j, circuit.i)]
    lines = [stage.layout.axes[label] for label in labels if label in stage.layout.axes]
    if len(lines) < 2:
        return
    ways = [stage.reference(label) for label in labels]
    centre = lines[0].point
    if size(cross(*ways)) > _NONE:
        centre = foot(lines[0].point, ways[0], lines[1].point, ways[1])[0]
    normal = unit_or_z(cross(*ways)) if size(cross(*ways)) > _NONE else beside_axis(ways[0])
    # joints far apart are drawn larger, so that they are visible in a picture of the whole train
    points = [each.point for each in stage.layout.axes.values()]
    wide = max(8.0, 0.08 * max(size(minus(point, centre)) for point in points))
    phase = getattr(place.declared, "phase", None)
    turn = 0.0 if phase is None else phase.si
    in_plane = cross(normal, ways[0])
    first = plus(scaled(in_plane, cos(turn)), normal, sin(turn))
    second = unit_or_z(cross(ways[1], first)) if size(cross(ways[1], first)) > _NONE else normal
    for link, way, pin, side in ((circuit.j, ways[0], first, -1), (circuit.i, ways[1], second, 1)):
        yield _fork(stage, f"{circuit.id} fork", link, centre, scaled(way, float(side)), pin, wide)
        for kind, low, high, direction, radius in (
            ("shaft", 0.9 * wide, 4 * wide, scaled(way, float(side)), 0.3 * wide),
            ("pin", -0.75 * wide, 0.75 * wide, pin, 0.12 * wide),
        ):
            bands = ((low, high, radius, 0.0),)
            name = f"{circuit.id} {kind}"
            yield ScenePart(stage.body[link], name, kind, centre, direction, beside_axis(direction), bands)


def _fork(
    stage: SceneContext, name: str, link: str, centre: Vector, way: Vector, pin: Vector, wide: float
) -> ScenePart:
    """Return the fork of a universal joint, whose two prongs hold the ends of a pin.

    way    unit vector along the shaft of the fork, from the centre of the joint
    pin    unit vector along the pin; `wide` is half its length [mm]
    """
    a, b = 0.7 * wide, 0.45 * wide
    outline = [(-0.2 * wide, b), (0.7 * wide, b), (0.7 * wide, -b), (-0.2 * wide, -b)]
    outline += [(-0.2 * wide, -a), (1.1 * wide, -a), (1.1 * wide, a), (-0.2 * wide, a)]
    flat = [value for point in outline for value in point]
    return ScenePart(stage.body[link], name, "fork", centre, unit(cross(way, pin)), way, (), [flat], 0.35 * wide)


_SHAPES: Mapping[str, Callable[[Sequence[_CouplingPlace]], Iterator[Any]]] = {
    "belt": _belt,
    "ratio": _box,
    "elliptical": _rolling,
    "pitch_curve": _rolling,
    "law": _cam,
    "geneva": _geneva,
    "step": _star,
    "rack": _rack,
    "screw": _screw,
    "drum": _drum,
    "crank_slider": _slider,
    "universal_joint": _universal,
}
"""Function that yields the shapes of a coupling, for each kind of coupling."""
