"""Declared geometry on which a layout is based: axes as lines, and contacts between wheels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import hypot
from typing import TYPE_CHECKING, Literal, NamedTuple, cast

from geartrain.analysis.gear_train import GearTrain
from geartrain.dynamics.gear_meshes import find_sizes
from geartrain.errors import GearTrainError
from geartrain.kinematics.circuits import Circuit, Tree
from geartrain.kinematics.circuits.joint_tree import Axes
from geartrain.numerics.quantity import millimetres
from geartrain.numerics.vectors import Vector, dot, frame, plus, unit
from geartrain.train import Train, Wheel
from geartrain.train.declaration import wheel_thickness
from geartrain.train.outputs import looks_away

if TYPE_CHECKING:
    from geartrain.teeth.coupling import Coupling
    from geartrain.teeth.lantern import Lantern
    from geartrain.train.outputs import Dial

Point = tuple[float, float]
"""Point in a plan: coordinates [mm] in the plane perpendicular to a group of parallel axes."""

ContactKind = Literal["side", "ring", "bevel", "crown", "screw"]
_TOUCHING = 1e-12  # relative distance below which pitch circles touch
_ACROSS = 1e-9  # z component below which an axis is perpendicular to the view
WORM = Fraction(5)  # default pitch radius of a worm over its axial module


@dataclass(frozen=True, slots=True)
class AxisLine:
    """Declared axis of a train: a line in space, and the links that carry it."""

    label: str
    direction: Vector
    group: int
    """Index of the group of parallel axes to which the axis belongs."""
    bearers: tuple[str, ...]
    """Link that carries the axis, followed by the link that carries the axis of that link, and so on until the frame.
    """
    pivots: tuple[str, ...]
    """Axes about which the links in `bearers` turn, in the same order. The frame has no entry."""
    given: Vector | None
    """Declared point of the axis [mm]; None if no position is declared."""


@dataclass(frozen=True)
class Parallels:
    """Group of parallel axes, with the coordinate system in which their positions (plan) and heights are computed."""

    lines: tuple[AxisLine, ...]
    up: Vector
    """Unit vector along the axes, in the direction in which heights increase; its last nonzero coordinate is positive.
    """
    x: Vector
    """Unit vector perpendicular to the axes, in the direction of the first coordinate of the plan."""
    y: Vector
    """Unit vector perpendicular to the axes, in the direction of the second coordinate of the plan."""

    @classmethod
    def of(cls, lines: Sequence[AxisLine]) -> Parallels:
        """Return the group that consists of the given parallel axes."""
        up = upwards(lines[0].direction)
        return cls(tuple(lines), up, *frame(up))

    @cached_property
    def index(self) -> Mapping[str, int]:
        """Index of each axis in `lines`, by label of the axis."""
        return {line.label: at for at, line in enumerate(self.lines)}

    @property
    def frame(self) -> str:
        """Frame of the train, which directly or indirectly carries all other links."""
        return self.lines[0].bearers[-1]

    def flat(self, vector: Vector) -> Point:
        """Return the coordinates in the plan of a point or a direction in space."""
        return dot(vector, self.x), dot(vector, self.y)

    def foot(self, place: Point) -> Vector:
        """Return the point in space, at height 0, that corresponds to a point in the plan."""
        return plus(plus((0.0, 0.0, 0.0), self.x, place[0]), self.y, place[1])


def upwards(direction: Vector) -> Vector:
    """Return the given direction or its opposite, whichever has a positive last nonzero coordinate."""
    last = next(part for part in direction[::-1] if abs(part) > 1e-12)  # smaller ones are rounding errors
    return direction if last > 0 else (-direction[0], -direction[1], -direction[2])


@dataclass(frozen=True, slots=True)
class ContactSide:
    """Names in a gear pair with one wheel regarded as its own: the wheel, its axis, the mate, and the mate's axis."""

    wheel: str
    axis: str
    mate: str
    mate_axis: str


@dataclass(frozen=True, slots=True)
class PitchContact:
    """Gear pair with the axes of its wheels and the kind of contact of their pitch surfaces."""

    name: str
    wheels: tuple[str, str]
    axes: tuple[str, str]
    kind: ContactKind
    """Kind of contact. The axes are parallel for `side` and `ring`, and not parallel for `bevel`, `crown` (the first
    wheel is the crown wheel) and `screw` (the first wheel is the worm).
    """
    stretch: Fraction = Fraction(1)
    """Centre distance of the declared teeth divided by the centre distance at which the pitch circles touch."""
    worm_sense: int = 0
    """1 if positive rotations of a worm and of its wheel move the thread and the teeth at the pitch point in the same
    direction, -1 if they move them in opposite directions.

    It is 0 for pairs without a worm.
    """

    @property
    def parallel(self) -> bool:
        """True if the axes are parallel, False if they intersect or are skew."""
        return self.kind in ("side", "ring")

    @property
    def sides(self) -> tuple[ContactSide, ContactSide]:
        """Gear pair as seen from its first wheel, and as seen from its second wheel."""
        (first, second), (axis, other) = self.wheels, self.axes
        return ContactSide(first, axis, second, other), ContactSide(second, other, first, axis)

    @property
    def axis_pair(self) -> tuple[str, str]:
        """Axes of the pair in alphabetical order, as a key of the pair of axes."""
        return min(self.axes), max(self.axes)


@dataclass(frozen=True, slots=True)
class CouplingTie:
    """Coupling between two axes."""

    links: tuple[str, str]
    """Driver and driven link."""
    axes: tuple[str, str]
    offset: Fraction | None
    """Declared distance between the axes [mm]; None if no distance is declared."""
    encloses: bool
    """True if the circle of a pin encloses the axis of its slot, so that the two axes are close together."""
    wish: float | None = None
    """Preferred distance between the axes [mm] if nothing determines it; None if there is no preference."""

    @property
    def axis_pair(self) -> tuple[str, str]:
        """Axes of both links in alphabetical order, as a key of the pair of axes."""
        return min(self.axes), max(self.axes)


class DialEnds(NamedTuple):
    """Number of hands that each end of an arbor carries above a dial: 0, 1, or 2 to pass over a smaller dial."""

    low: int = 0
    high: int = 0


@dataclass(frozen=True, slots=True)
class DeclaredGeometry:
    """Declared geometry of a train: its axes by label, and its gear pairs and couplings in the order of declaration."""

    lines: Mapping[str, AxisLine]
    axis: Mapping[str, str]
    """Axis of every wheel, by name of the wheel; wheels that mesh are listed first."""
    contacts: tuple[PitchContact, ...]
    ties: tuple[CouplingTie, ...]
    wheels: Mapping[str, tuple[str, Wheel]]
    thickness: Mapping[str, float]
    """Declared thickness of a wheel [mm], by name; wheels without a declared thickness are omitted."""
    strays: tuple[tuple[str, str, str], ...]
    """Wheels that a gear pair requires on another axis than earlier pairs do: wheel, gear pair and axis of each."""
    front: int
    """Side from which the train is viewed: 1 for the side of positive z, -1 for the side of negative z."""
    dial_ends: Mapping[str, DialEnds]
    """Ends of each arbor that extend to a dial, by link."""
    driven: str | None
    """Axis of the first input, which is at the origin by default; None if the train has no input."""
    discs: Mapping[str, float]
    """Radial extent of the discs of lantern pinions beyond the pitch circle [modules], by wheel."""
    belts: tuple[Mapping[str, float], ...] = ()
    """Radii of the pulleys [mm], by axis, of each belt with declared diameters."""
    centres: tuple[tuple[str, str, Vector], ...] = ()
    """Dials with a declared centre: name, axis of the pointers, and centre at height 0 [mm] of each."""

    def link(self, wheel: str) -> str:
        """Return the link that carries a wheel."""
        return self.wheels[wheel][0]

    def wheel(self, wheel: str) -> Wheel:
        """Return the declaration of a wheel."""
        return self.wheels[wheel][1]

    def count(self, wheel: str) -> int:
        """Return the tooth count of a wheel; 1 if it is unknown."""
        return self.wheels[wheel][1].count or 1

    def radius(self, wheel: str) -> Fraction:
        """Return the pitch radius of a wheel in normal modules; for a worm, in axial modules."""
        if self.wheel(wheel).kind == "worm":
            return WORM
        return Fraction(self.count(wheel), 2) * Fraction(self.wheel(wheel).slant)

    def distance(self, contact: PitchContact) -> Fraction:
        """Return the centre distance of a gear pair with parallel or skew axes [modules]."""
        first, second = (self.radius(wheel) for wheel in contact.wheels)
        return contact.stretch * (abs(first - second) if contact.kind == "ring" else first + second)


def read_geometry(train: GearTrain) -> DeclaredGeometry:
    """Return the declared geometry of a train: its axes, wheels, gear pairs and couplings."""
    declared, tree = train.declaration, train.kinematics.tree
    # a positive rotation about z is clockwise only for a viewer on the side of -z
    front = -1 if declared.view.positive == "clockwise" else 1
    lines = {line.label: line for line in _lines(declared, tree)}
    carriers = {circuit.id: circuit.carrier for circuit in train.circuits if circuit.kind == "belt"}
    belts = []
    for belt in declared.couplings if carriers else ():
        if belt.kind == "belt" and any(True for _ in belt.lengths):
            pulleys = (tree.axis_seen_from(carriers[belt.row_names[0]], link) for link in belt.ends)
            radii = (float(millimetres(size)) / 2 for size in belt.lengths)
            belts.append(dict(zip(pulleys, radii, strict=True)))
    centres = tuple(dict.fromkeys(_dial_centres(declared, tree, front)))
    for label, centre in {dial: (label, centre) for dial, label, centre in reversed(centres)}.values():
        line = lines[label]
        if line.given is None and len(line.bearers) == 1 and 1 - abs(line.direction[2]) < _ACROSS:
            lines[label] = replace(line, given=centre)
    axis: dict[str, str] = {}
    contacts, ties, strays = [], [], []
    pins = {coupling.name: coupling for coupling in declared.pin_couplings}
    wishes = {row.id: _preferred_distance(each) for each in declared.couplings for row in each.rows(declared.wheels)}
    stretches = _stretches(train)
    for circuit in train.circuits:
        ends = tree.axis_seen_from(circuit.carrier, circuit.i), tree.axis_seen_from(circuit.carrier, circuit.j)
        if circuit.kind != "gear":
            pin = pins.get(circuit.id)
            apart = None if pin is None or pin.offset is None else millimetres(pin.offset)
            encloses = pin is not None and circuit.b != 0
            if ends[0] != ends[1]:
                ties.append(CouplingTie((circuit.j, circuit.i), ends[::-1], apart, encloses, wishes[circuit.id]))
            continue
        for wheel, end in zip(circuit.wheels, ends, strict=True):
            if axis.setdefault(wheel, end) != end:
                strays.append((wheel, circuit.id, end))
        contacts.append(_contact(train, circuit, ends, lines, stretches.get(circuit.id, Fraction(1))))
    for wheel, (link, _) in declared.wheels.items():
        axis.setdefault(wheel, tree.axis(link) or next(iter(lines), ""))
    return DeclaredGeometry(
        lines,
        axis,
        tuple(contacts),
        tuple(ties),
        declared.wheels,
        dict(_thickness(declared)),
        tuple(strays),
        front,
        _dial_ends(declared, tree, lines, front),
        next((tree.axis(link) for case in declared.cases for link in case.inputs), None),
        dict(_lantern_discs(declared)),
        tuple(belts),
        centres,
    )


def _lines(declared: Train, tree: Tree) -> Iterator[AxisLine]:
    axes = Axes(declared, tree)
    groups: dict[tuple[Fraction, ...], int] = {}
    first: dict[str, str] = {}  # axis -> the first link that is declared on it
    for link in declared.links:
        if (own := tree.axis(link)) is not None:
            first.setdefault(own, link)
    for name, link in first.items():
        direction = axes.direction(name)
        # parallel vectors are equal if scaled to a first nonzero coordinate of 1: exact, without a tolerance
        scale = next(part for part in direction if part)
        group = groups.setdefault(tuple(part / scale for part in direction), len(groups))
        top = max(map(abs, direction))  # divided exactly first: the float of a huge Fraction would overflow
        x, y, z = (float(part / top) for part in direction)
        given = declared.axes[name].point if name in declared.axes else None
        bearers = [tree.top[link]]
        while bearers[-1] in tree.top:
            bearers.append(tree.top[bearers[-1]])
        pivots = tuple(axis for bearer in bearers if (axis := tree.axis(bearer)) is not None)
        yield AxisLine(name, unit((x, y, z)), group, tuple(bearers), pivots, given)


def _thickness(declared: Train) -> Iterator[tuple[str, float]]:
    for name, (_, wheel) in declared.wheels.items():
        if (found := wheel_thickness(declared, wheel)) is not None:
            yield name, float(millimetres(found))


def _lantern_discs(declared: Train) -> Iterator[tuple[str, float]]:
    """Yield each lantern pinion with the extent of its discs beyond the pitch circle, 1.5 pin diameters [modules]."""
    for gear in declared.gears:
        form = declared.form_of(gear)
        if form is not None and form.form == "lantern":
            lantern = cast("Lantern", form)
            # a diameter in mm cannot be given in modules here, because modules are determined later
            if lantern.pin_diameter.unit is None:
                yield gear.pair[lantern.pins - 1], 1.5 * float(lantern.pin_diameter.value)


def _stretches(train: GearTrain) -> dict[str, Fraction]:
    """Return the quotient of declared and nominal centre distance of each gear pair, by pair, unless it is 1."""
    try:
        sizes = find_sizes(train.meshes)
    except GearTrainError:
        return {}  # the reason is reported where the teeth are requested
    return {name: Fraction(size.stretch) for name, size in sizes.items() if abs(size.stretch - 1) > _TOUCHING}


def _dial_centres(declared: Train, tree: Tree, front: int) -> Iterator[tuple[str, str, Vector]]:
    """Yield each dial in the frame whose centre is declared: its name, the axis of its pointer, and its centre [mm]."""
    for case in declared.cases:
        for name, output in case.outputs.items():
            dial = declared.dials.get(output.dial or "")
            of, base = output.links(name, declared.frame)
            if dial is None or dial.centre is None or base != declared.frame or (axis := tree.axis(of)) is None:
                continue
            x, y = (float(millimetres(each)) for each in dial.centre)
            # the right of a reader who looks along +z is -x
            side = -front if looks_away(dial.face, declared.view.from_) else front
            yield output.dial or "", axis, (side * x, y, 0.0)


def _dial_ends(declared: Train, tree: Tree, lines: Mapping[str, AxisLine], front: int) -> dict[str, DialEnds]:
    found: dict[str, DialEnds] = {}
    for case in declared.cases:
        for name, output in case.outputs.items():
            dial = declared.dials.get(output.dial or "")
            link = output.of or name
            line = lines.get(tree.axis(link) or "")
            across = line is not None and abs(line.direction[2]) < _ACROSS  # it faces neither the reader nor away
            if dial is None or dial.look == "ball" or (across and dial.face not in ("front", "back")):
                continue
            hands = 2 if any(_encloses(dial, each) for each in declared.dials.values()) else 1
            high = (front > 0) != looks_away(dial.face, declared.view.from_)
            before = found.get(link, DialEnds())
            ends = (before.low, max(before.high, hands)) if high else (max(before.low, hands), before.high)
            found[link] = DialEnds(*ends)
    return found


def _encloses(dial: Dial, other: Dial) -> bool:
    """Return True if the dial `other`, on the same face, is inside the scale of the dial `dial`."""
    one, two = dial.circle, other.circle
    if one is None or two is None or dial.face != other.face or two[2] >= one[2]:
        return False
    return 0 < hypot(one[0] - two[0], one[1] - two[1]) < one[2]


def _contact(
    train: GearTrain, circuit: Circuit, ends: tuple[str, str], lines: Mapping[str, AxisLine], stretch: Fraction
) -> PitchContact:
    declared = [train.declaration.wheels[wheel][1] for wheel in circuit.wheels]
    kinds = [wheel.kind for wheel in declared]
    if lines[ends[0]].group == lines[ends[1]].group:
        ring = any(wheel.internal for wheel in declared)
        return PitchContact(circuit.id, circuit.wheels, ends, "ring" if ring else "side", stretch)
    screw = "worm" in kinds or any(wheel.is_helical for wheel in declared)
    kind: ContactKind = "screw" if screw else "crown" if sorted(kinds) == ["contrate", "spur"] else "bevel"
    sense = 0
    if screw:
        # a (w_i - w_k) + b (w_j - w_k) = 0: with equal signs of a and b the relative speeds are opposite; velocities
        # do not give the sense, because the velocities of worm and wheel are not parallel at the pitch point
        sense = -1 if circuit.a * circuit.b > 0 else 1
        for link, axis in zip((circuit.i, circuit.j), ends, strict=True):
            sense *= train.kinematics.signs.get(link, 1) if train.kinematics.tree.axis(link) == axis else 1
    wheels = circuit.wheels
    if {"worm", "contrate"} & set(kinds) and kinds[0] not in ("worm", "contrate"):
        wheels, ends = wheels[::-1], ends[::-1]
    return PitchContact(circuit.id, wheels, ends, kind, stretch, sense)


_APART = 40.0  # distance of the axes of a coupling [mm] if no size is declared
_BELT = 1.25  # distance of pulleys divided by the largest diameter


def _preferred_distance(coupling: Coupling) -> float | None:
    """Return the preferred distance between the axes of a coupling [mm]; None if there is no preference."""
    around = getattr(coupling, "around", None)
    if isinstance(around, Mapping):
        return _BELT * float(max(millimetres(diameter) for diameter in around.values()))
    declared = getattr(coupling, "centre_distance", None)
    if declared is not None:
        return float(millimetres(declared))
    return _APART if coupling.kind in ("elliptical", "pitch_curve", "law", "geneva", "step") else None
