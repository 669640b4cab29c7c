"""What a layout needs to know of a declaration: axes as lines, and where wheels touch."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Literal, NamedTuple, cast

from geartrain.analysis.gear_train import GearTrain
from geartrain.dynamics.gear_meshes import find_sizes
from geartrain.errors import GearTrainError
from geartrain.kinematics.circuits import Circuit, Tree
from geartrain.kinematics.circuits.joint_tree import Axes
from geartrain.numerics.quantity import millimetres
from geartrain.numerics.vectors import Vector, dot, frame, plus, unit
from geartrain.train import Train, Wheel
from geartrain.train.outputs import looks_away
from geartrain.train.wheel_stock import wheel_thickness

if TYPE_CHECKING:
    from geartrain.teeth.lantern import Lantern

Point = tuple[float, float]
"""A place in plan: coordinates (mm) across parallel axes."""

ContactKind = Literal["side", "ring", "bevel", "crown", "screw"]
_TOUCHING = 1e-12  # of a distance: nearer to it, pitch circles touch
_ACROSS = 1e-9  # of a direction along z: below that, an axis lies across the view
WORM = Fraction(5)  # pitch radius of a worm over its axial module: slender, but not weak


@dataclass(frozen=True, slots=True)
class AxisLine:
    """An axis as declared."""

    label: str
    direction: Vector
    """Unit vector."""
    group: int
    """The same number for all parallels."""
    bearers: tuple[str, ...]
    """The link that bears it, the link that bears that one's axis, and so on to the frame."""
    pivots: tuple[str, ...]
    """The axes about which they turn, all but the frame."""
    given: Vector | None
    """Its declared point (mm)."""


@dataclass(frozen=True)
class Parallels:
    """Parallel axes, as they are planned and stacked."""

    lines: tuple[AxisLine, ...]
    up: Vector
    """Unit vector along them: heights count along it, z upwards or what is nearest to it."""
    x: Vector
    """Unit vectors across: a point of the plan has its coordinates along them."""
    y: Vector
    """Unit vectors across: a point of the plan has its coordinates along them."""

    @classmethod
    def of(cls, lines: Sequence[AxisLine]) -> Parallels:
        """Some lines of one group."""
        up = upwards(lines[0].direction)
        return cls(tuple(lines), up, *frame(up))

    @cached_property
    def index(self) -> Mapping[str, int]:
        """Number of each axis."""
        return {line.label: at for at, line in enumerate(self.lines)}

    @property
    def frame(self) -> str:
        """The link that bears all others."""
        return self.lines[0].bearers[-1]

    def flat(self, vector: Vector) -> Point:
        """A point, or a direction, in plan."""
        return dot(vector, self.x), dot(vector, self.y)

    def foot(self, place: Point) -> Vector:
        """The point in space, at height 0, of a place in plan."""
        return plus(plus((0.0, 0.0, 0.0), self.x, place[0]), self.y, place[1])


def upwards(direction: Vector) -> Vector:
    """The same direction for both senses: z, or what is nearest to it, upwards."""
    last = next(part for part in direction[::-1] if abs(part) > 1e-12)  # of a unit vector: less is rounding
    return direction if last > 0 else (-direction[0], -direction[1], -direction[2])


@dataclass(frozen=True, slots=True)
class ContactSide:
    """A pair as one of its wheels sees it: the wheel with its axis, and its mate with its own."""

    wheel: str
    axis: str
    mate: str
    mate_axis: str


@dataclass(frozen=True, slots=True)
class PitchContact:
    """A gear pair: wheels with their axes, and how they touch."""

    name: str
    wheels: tuple[str, str]
    axes: tuple[str, str]
    kind: ContactKind
    """Side and ring are about parallel axes; bevel, crown (its first wheel is the crown) and screw (its first wheel
    is the worm) about others."""
    stretch: Fraction = Fraction(1)
    """How much farther apart than touching pitch circles declared teeth want the axes, as a factor."""
    worm_sense: int = 0
    """1 where both axes of a worm and its wheel turn the pitch point the same way for positive angles, -1 where
    against each other; 0 of other pairs."""

    @property
    def parallel(self) -> bool:
        """True if its axes are parallel; else they cross, or pass each other."""
        return self.kind in ("side", "ring")

    @property
    def sides(self) -> tuple[ContactSide, ContactSide]:
        """The pair as its first wheel sees it, and as its second."""
        (first, second), (axis, other) = self.wheels, self.axes
        return ContactSide(first, axis, second, other), ContactSide(second, other, first, axis)

    @property
    def axis_pair(self) -> tuple[str, str]:
        """Its axes, the same for all pairs between them."""
        return min(self.axes), max(self.axes)


@dataclass(frozen=True, slots=True)
class PinSlotTie:
    """A pin in a slot: links and axes of the pin and of the slot, and the distance (mm) of these if declared."""

    links: tuple[str, str]
    axes: tuple[str, str]
    offset: Fraction | None
    encloses: bool
    """True if the pin's circle encloses the slot's axis, so that the two axes stand close together."""

    @property
    def axis_pair(self) -> tuple[str, str]:
        """Its axes, the same for all pairs between them."""
        return min(self.axes), max(self.axes)


@dataclass(frozen=True, slots=True)
class StrayMesh:
    """A wheel that a pair has on another axis than pairs before it."""

    wheel: str
    pair: str
    axis: str


class DialEnds(NamedTuple):
    """Whether an arbor runs out of the stack to a dial: at its low end, and at its high one."""

    low: bool = False
    high: bool = False


@dataclass(frozen=True, slots=True)
class DeclaredGeometry:
    """Lines by label; gear pairs and couplings in the order declared."""

    lines: Mapping[str, AxisLine]
    axis: Mapping[str, str]
    """Of every wheel, those first that mesh."""
    contacts: tuple[PitchContact, ...]
    ties: tuple[PinSlotTie, ...]
    wheels: Mapping[str, tuple[str, Wheel]]
    """Link and declaration of every wheel."""
    thickness: Mapping[str, float]
    """Of those that declare one (mm)."""
    strays: tuple[StrayMesh, ...]
    front: int
    """The side of z from which the train is looked at: 1 or -1."""
    dial_ends: Mapping[str, DialEnds]
    """Of links that run to a dial."""
    driven: str | None
    """The axis of the first input, which gets the origin where no position is declared."""
    discs: Mapping[str, float]
    """Of lanterns: how far (modules) their discs reach beyond the pitch circle."""

    def link(self, wheel: str) -> str:
        """The link that carries a wheel."""
        return self.wheels[wheel][0]

    def wheel(self, wheel: str) -> Wheel:
        """A wheel as declared."""
        return self.wheels[wheel][1]

    def count(self, wheel: str) -> int:
        """Teeth of a wheel; 1 where they are not known."""
        return self.wheels[wheel][1].count or 1

    def radius(self, wheel: str) -> Fraction:
        """Pitch radius over normal module."""
        if self.wheel(wheel).kind == "worm":
            return WORM
        return Fraction(self.count(wheel), 2) * Fraction(self.wheel(wheel).slant)

    def distance(self, contact: PitchContact) -> Fraction:
        """Distance of the axes of a pair over its module, where they are parallel or pass each other."""
        first, second = (self.radius(wheel) for wheel in contact.wheels)
        return contact.stretch * (abs(first - second) if contact.kind == "ring" else first + second)


def read_geometry(train: GearTrain) -> DeclaredGeometry:
    """All that matters of a train."""
    declared, tree = train.declaration, train.kinematics.tree
    lines = {line.label: line for line in _lines(declared, tree)}
    axis: dict[str, str] = {}
    contacts, ties, strays = [], [], []
    couplings = {coupling.name: coupling for coupling in declared.couplings}
    stretches = _stretches(train)
    for circuit in train.circuits:
        ends = tree.axis_seen_from(circuit.carrier, circuit.i), tree.axis_seen_from(circuit.carrier, circuit.j)
        if circuit.kind != "gear":
            offset = couplings[circuit.id].offset
            apart = None if offset is None else millimetres(offset)
            ties.append(PinSlotTie((circuit.j, circuit.i), ends[::-1], apart, circuit.b != 0))
            continue
        for wheel, end in zip(circuit.wheels, ends, strict=True):
            if axis.setdefault(wheel, end) != end:
                strays.append(StrayMesh(wheel, circuit.id, end))
        contacts.append(_contact(train, circuit, ends, lines, stretches.get(circuit.id, Fraction(1))))
    for wheel, (link, _) in declared.wheels.items():
        axis.setdefault(wheel, tree.axis(link) or next(iter(lines), ""))
    front = -1 if declared.view.positive == "clockwise" else 1
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
    )


def _lines(declared: Train, tree: Tree) -> Iterator[AxisLine]:
    axes = Axes(declared, tree)
    groups: dict[tuple[Fraction, ...], int] = {}
    for name, link in _first_links(declared, tree).items():
        direction = axes.direction(name)
        # parallels, of either sense and any length, are equal once their first coordinate is 1: exact, no tolerance
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


def _first_links(declared: Train, tree: Tree) -> dict[str, str]:
    """The first link declared on each axis."""
    found: dict[str, str] = {}
    for link in declared.links:
        name = tree.axis(link)
        if name is not None:
            found.setdefault(name, link)
    return found


def _thickness(declared: Train) -> Iterator[tuple[str, float]]:
    for name, (_, wheel) in declared.wheels.items():
        if (found := wheel_thickness(declared, wheel)) is not None:
            yield name, float(millimetres(found))


def _lantern_discs(declared: Train) -> Iterator[tuple[str, float]]:
    """A pin and half of one beyond the pitch circle: the rim of a lantern's discs is a pin wide."""
    for gear in declared.gears:
        form = declared.form_of(gear)
        if form is not None and form.form == "lantern":
            lantern = cast("Lantern", form)
            if lantern.pin_diameter.unit is None:
                yield gear.pair[lantern.pins - 1], 1.5 * float(lantern.pin_diameter.value)


def _stretches(train: GearTrain) -> dict[str, Fraction]:
    """How much farther apart than touching pitch circles real teeth want their axes, by pair; none where none is so."""
    try:
        sizes = find_sizes(train.meshes)
    except GearTrainError:
        return {}  # why there are no such teeth is told where they are asked for
    return {name: Fraction(size.stretch) for name, size in sizes.items() if abs(size.stretch - 1) > _TOUCHING}


def _dial_ends(declared: Train, tree: Tree, lines: Mapping[str, AxisLine], front: int) -> dict[str, DialEnds]:
    found: dict[str, DialEnds] = {}
    for case in declared.cases:
        for name, output in case.outputs.items():
            dial = declared.dials.get(output.dial or "")
            link = output.of or name
            line = lines.get(tree.axis(link) or "")
            across = line is not None and abs(line.direction[2]) < _ACROSS  # it looks neither to the reader nor away
            if dial is None or dial.look == "ball" or (across and dial.face not in ("front", "back")):
                continue
            high = (front > 0) != looks_away(dial.face, declared.view.from_)
            before = found.get(link, DialEnds())
            found[link] = DialEnds(before.low or not high, before.high or high)
    return found


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
    sense = _worm_sense(train, circuit, ends) if kind == "screw" else 0
    wheels = circuit.wheels
    if {"worm", "contrate"} & set(kinds) and kinds[0] not in ("worm", "contrate"):
        wheels, ends = wheels[::-1], ends[::-1]
    return PitchContact(circuit.id, wheels, ends, kind, stretch, sense)


def _worm_sense(train: GearTrain, circuit: Circuit, ends: tuple[str, str]) -> int:
    """A worm turns no pitch point sideways: how its thread moves follows from the pair's equation."""
    flip = 1
    for link, axis in zip((circuit.i, circuit.j), ends, strict=True):
        flip *= train.kinematics.signs.get(link, 1) if train.kinematics.tree.axis(link) == axis else 1
    return (-1 if circuit.a * circuit.b > 0 else 1) * flip
