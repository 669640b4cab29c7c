"""What a layout needs to know of a declaration: axes as lines, and where wheels touch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from geartrain.analysis.gear_train import GearTrain
from geartrain.dynamics.gear_meshes import find_sizes
from geartrain.errors import GearTrainError
from geartrain.kinematics.circuits import Circuit, Tree
from geartrain.kinematics.circuits.axes import Axes
from geartrain.numerics.quantity import Quantity
from geartrain.numerics.vectors import Vector, unit
from geartrain.train import Train, Wheel

ContactKind = Literal["side", "ring", "bevel", "crown", "screw"]
_TOUCHING = 1e-12  # of a distance: nearer to it, pitch circles touch
WORM = Fraction(5)  # pitch radius of a worm over its axial module: slender, but not weak


@dataclass(frozen=True, slots=True)
class AxisLine:
    """An axis as declared.

    way      unit vector of its direction
    group    the same number for all parallels
    bearers  the link that bears it, the link that bears that one's axis, and so on to the frame
    pivots   the axes about which they turn, all but the frame
    given    its declared point (mm)
    """

    label: str
    way: Vector
    group: int
    bearers: tuple[str, ...]
    pivots: tuple[str, ...]
    given: Vector | None


@dataclass(frozen=True, slots=True)
class PitchContact:
    """A gear pair: wheels with their axes, and how they touch.

    side and ring are about parallel axes; bevel, crown (its first wheel is the crown) and screw (its first wheel is
    the worm) about others. `likeness` says why it is drawn so where it cannot be drawn as declared; `stretch`, how much
    farther apart than touching pitch circles declared teeth want the axes.
    """

    name: str
    wheels: tuple[str, str]
    axes: tuple[str, str]
    kind: ContactKind
    carrier: str
    likeness: str = ""
    stretch: Fraction = Fraction(1)


@dataclass(frozen=True, slots=True)
class PinSlotTie:
    """A pin in a slot: axes of the pin and of the slot, their distance (mm) if declared, and the wheels of the pin."""

    name: str
    axes: tuple[str, str]
    offset: Fraction | None
    encloses: bool
    pin: str


@dataclass(frozen=True, slots=True)
class DeclaredGeometry:
    """Lines by label, the axis of every wheel, touches and ties in the order declared."""

    lines: Mapping[str, AxisLine]
    axis: Mapping[str, str]
    touches: tuple[PitchContact, ...]
    ties: tuple[PinSlotTie, ...]
    wheels: Mapping[str, tuple[str, Wheel]]
    strays: tuple[tuple[str, str, str], ...]

    def size(self, wheel: str) -> Fraction:
        """Pitch radius over module."""
        kind = self.wheels[wheel][1]
        return WORM if kind.kind == "worm" else Fraction(kind.count or 1, 2)

    def reach(self, touch: PitchContact) -> Fraction:
        """Distance of the axes of a pair over its module, where they are parallel or pass each other."""
        first, second = (self.size(wheel) for wheel in touch.wheels)
        return touch.stretch * (abs(first - second) if touch.kind == "ring" else first + second)


def read_geometry(train: GearTrain) -> DeclaredGeometry:
    """All that matters of a train. `strays` are wheels that mesh about two axes: (wheel, pair, the other axis)."""
    declared, tree = train.declaration, train.tree
    lines = _lines(declared, tree)
    axis: dict[str, str] = {}
    touches, ties, strays = [], [], []
    couplings = {coupling.name: coupling for coupling in declared.couplings}
    stretches = _stretches(train)
    for circuit in train.circuits:
        ends = tree.axis_seen_from(circuit.carrier, circuit.i), tree.axis_seen_from(circuit.carrier, circuit.j)
        if circuit.kind != "gear":
            coupling = couplings[circuit.id]
            offset = None if coupling.offset is None else millimetres(coupling.offset)
            ties.append(PinSlotTie(circuit.id, (ends[1], ends[0]), offset, circuit.b != 0, coupling.pin))
            continue
        for wheel, end in zip(circuit.wheels, ends, strict=True):
            if axis.setdefault(wheel, end) != end:
                strays.append((wheel, circuit.id, end))
        touches.append(_touch(declared, circuit, ends, lines, stretches.get(circuit.id, Fraction(1))))
    for wheel, (link, _) in declared.wheels.items():
        axis.setdefault(wheel, tree.axis(link) or next(iter(lines), ""))
    return DeclaredGeometry(lines, axis, tuple(touches), tuple(ties), declared.wheels, tuple(strays))


def millimetres(length: Quantity) -> Fraction:
    """A length in mm, exact; a plain number counts as mm."""
    return length.value if length.unit is None else length.base * 1000


def _lines(declared: Train, tree: Tree) -> dict[str, AxisLine]:
    axes = Axes(declared, tree)
    groups: dict[tuple[Fraction, ...], int] = {}
    lines: dict[str, AxisLine] = {}
    for link in declared.links:
        name = tree.axis(link)
        if name is None or name in lines:
            continue
        way = axes.direction(name)
        scale = next(part for part in way if part)
        group = groups.setdefault(tuple(part / scale for part in way), len(groups))
        top = max(map(abs, way))
        place = declared.axes[name].position if name in declared.axes else None
        given = None if place is None else tuple(float(millimetres(part)) for part in place)
        bearers = [tree.top[link]]
        while bearers[-1] in tree.top:
            bearers.append(tree.top[bearers[-1]])
        pivots = tuple(axis for bearer in bearers if (axis := tree.axis(bearer)) is not None)
        x, y, z = (float(part / top) for part in way)
        lines[name] = AxisLine(name, unit((x, y, z)), group, tuple(bearers), pivots, given)  # type: ignore[arg-type]
    return lines


def _stretches(train: GearTrain) -> dict[str, Fraction]:
    """How much farther apart than touching pitch circles real teeth want their axes, by pair; none where none is so."""
    try:
        sizes = find_sizes(train.meshes)
    except GearTrainError:
        return {}  # why there are no such teeth is told where they are asked for
    return {name: Fraction(size.stretch) for name, size in sizes.items() if abs(size.stretch - 1) > _TOUCHING}


def _touch(
    declared: Train, circuit: Circuit, ends: tuple[str, str], lines: Mapping[str, AxisLine], stretch: Fraction
) -> PitchContact:
    kinds = [declared.wheels[wheel][1].kind for wheel in circuit.wheels]
    parallel = lines[ends[0]].group == lines[ends[1]].group
    ring = any(declared.wheels[wheel][1].internal for wheel in circuit.wheels)
    wheels, kind, likeness = circuit.wheels, "bevel", ""
    if parallel:
        kind = "ring" if ring else "side"
        shaped = next((each for each in kinds if each != "spur"), "")
        likeness = f"a {shaped} pair whose axes are declared parallel" if shaped else ""
    elif "worm" in kinds:
        kind = "screw"
    elif sorted(kinds) == ["contrate", "spur"]:
        kind = "crown"
    if kind in ("screw", "crown") and kinds[0] not in ("worm", "contrate"):
        wheels, ends = wheels[::-1], ends[::-1]
    return PitchContact(circuit.id, wheels, ends, kind, circuit.carrier, likeness, stretch)  # type: ignore[arg-type]
