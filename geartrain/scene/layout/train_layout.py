"""Layout of a train: positions of all axes and wheels in space, in the pose in which all angles are 0.

Wheels are rotated on their arbors so that teeth of one wheel mesh with tooth spaces of its mate. The algorithm is a
breadth-first search over the gear pairs: the first wheel of a train has a tooth at a pitch point, and the angle of each
mate follows. Let s be the number of pitches by which a tooth is past the pitch point, positive in the positive sense of
rotation. Teeth and spaces mesh if s_1 + s_2 = 1/2 (mod 1) when positive angles move the pitch point in opposite senses,
and if s_1 - s_2 = 1/2 otherwise. Conditions that a layout could not satisfy are reported as notices.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import hypot, pi, remainder
from typing import Literal

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import Problem
from geartrain.numerics.results import Shown
from geartrain.numerics.vectors import Vector, across, azimuth, cross, dot, frame, minus, plus, scaled, size, unit
from geartrain.scene.layout.declared_geometry import DeclaredGeometry, PitchContact, read_geometry
from geartrain.scene.layout.parallel_groups import Arrangement, arrange
from geartrain.scene.layout.wheel_modules import opposite, pitch_distance, size_geometry
from geartrain.scene.layout.wheel_reach import bare_reach, span
from geartrain.scene.layout.wheel_stacks import WheelStack

# --------------------------------------------------------------------------------------------------- layout diagnostics


_TOUCH = 1e-9  # gap divided by the pitch radii below which pitch circles touch
_MEET = 1e-6  # the same for axes that are not parallel, whose declared directions are rounded
_SHOWN = 6


def pitch_gaps(found: Arrangement) -> dict[str, float]:
    """Return the gaps between pitch circles that do not touch [mm], by pair; they are negative for an overlap."""
    sizes = found.geometry.sizes
    gaps = {}
    for contact in found.geometry.declared.contacts:
        gap = _gap(found, contact)
        slack = _TOUCH if contact.parallel else _MEET
        if abs(gap) > slack * sum(sizes[wheel].radius for wheel in contact.wheels):
            gaps[contact.name] = gap
    return gaps


def _gap(found: Arrangement, contact: PitchContact) -> float:
    declared, sizes = found.geometry.declared, found.geometry.sizes
    lines = [declared.lines[axis] for axis in contact.axes]
    radii = [sizes[wheel].radius for wheel in contact.wheels]
    if contact.parallel:
        first, second = (found.points[axis] for axis in contact.axes)
        apart = pitch_distance(declared, found.geometry.modules.module, contact)
        # heights do not matter: only the distance in plan determines whether pitch circles touch
        far = size(across(minus(second, first), lines[0].direction)) - apart
        # a wheel too far from the centre of a ring overlaps it
        return -far if contact.kind == "ring" else far
    centres = [found.centres[wheel] for wheel in contact.wheels]
    if contact.kind == "screw":
        upright = unit(cross(lines[0].direction, lines[1].direction))
        off = minus(centres[1], centres[0])
        aside = size(across(off, upright))
        far = abs(dot(off, upright)) - sum(radii)
        return far if aside <= _TOUCH * sum(radii) else hypot(far, aside)
    tip, other = (
        plus(centre, found.geometry.seats[contact.name, wheel].out, radius)
        for centre, wheel, radius in zip(centres, contact.wheels, radii, strict=True)
    )
    return size(minus(other, tip))


def notices(
    train: GearTrain, found: Arrangement, gaps: Mapping[str, float], misses: Mapping[str, float]
) -> Iterator[Problem]:
    """Yield all warnings about a layout. Warnings about faults that prevent construction come first.

    gaps     gaps of pairs whose pitch circles do not touch [mm]
    misses   phase errors of pairs whose teeth do not mesh [pitches]
    """
    yield from (each.problem for each in train.build_findings)
    declared = found.geometry.declared
    place = {gear.name: train.declaration.place("gears", at) for at, gear in enumerate(train.declaration.gears)}
    for contact in declared.contacts:
        if contact.name in gaps:
            yield _not_touching(contact, gaps[contact.name], place[contact.name])
    for wheel, pair, axis in declared.strays:
        what = f"wheel '{wheel}' is drawn only on axis '{declared.axis[wheel]}'"
        why = f"pair '{pair}' requires it on axis '{axis}' as well"
        yield Problem(what, why, "declare a separate wheel for each of its meshes", place[pair])
    yield from _misplaced(train, found)
    for stack in found.stacks:
        yield from _crowding(found, stack)
    for name, miss in misses.items():
        if name not in gaps:
            yield Problem(
                f"the teeth of '{name}' do not mesh: their phase is wrong by {abs(miss):.3g} of a pitch",
                "the pair closes a loop of wheels, whose positions determine the phases of all teeth",
                "declare axis positions at which the teeth mesh, or change tooth counts",
                place[name],
            )


def _not_touching(contact: PitchContact, gap: float, place: str) -> Problem:
    (first, second), (axis, other) = contact.wheels, contact.axes
    return Problem(
        f"the pitch circles of '{first}' and '{second}' "
        + (f"are {gap:.3g} mm apart" if gap > 0 else f"overlap by {-gap:.3g} mm"),
        f"the centre distance that pair '{contact.name}' requires between axes '{axis}' and '{other}' is incompatible "
        "with other pairs, declared positions, modules or offsets",
        "change a tooth count, a position or a module; the gap itself does not affect speeds",
        place,
    )


def _misplaced(train: GearTrain, found: Arrangement) -> Iterator[Problem]:
    """Yield warnings about dials whose pointers turn about a point other than the declared centre."""
    declared = found.geometry.declared
    for name, axis, centre in declared.centres:
        off = size(across(minus(found.points[axis], centre), declared.lines[axis].direction))
        if off > _NONE:
            yield Problem(
                f"dial '{name}' is drawn {off:.3g} mm from its declared centre",
                f"its pointers turn about axis '{axis}', whose declared or carried position differs from that centre",
                f"remove `centre` of the dial, or the position of axis '{axis}'",
                train.declaration.place("dials", name, "centre"),
            )


def _crowding(found: Arrangement, stack: WheelStack) -> Iterator[Problem]:
    """Yield warnings about wheels that collide, and about arbors that pass through wheels."""
    mates = {frozenset(contact.wheels) for contact in found.geometry.declared.contacts}
    height = {block.wheel: dot(found.centres[block.wheel], stack.up) for block in stack.upright}
    # mates overlap by the depth of their teeth
    collide = [pair for pair in stack.collisions(height) if frozenset(pair) not in mates]
    if collide:
        yield Problem(
            f"wheels collide: {_listed([f'{a} and {b}' for a, b in collide])}",
            "the axes are too close together for wheels at overlapping heights",
            "declare positions of the axes, or change the order of the gear pairs",
        )
    pierced = [f"{arbor} through {wheel}" for arbor, wheel in stack.pierced(height)]
    if pierced:
        yield Problem(
            f"arbors pass through wheels: {_listed(pierced)}",
            "no order of the levels was found in which all arbors are clear of wheels",
            "declare positions of the axes at which the arbors are clear of wheels",
        )


def _listed(words: Sequence[str]) -> str:
    more = f" and {len(words) - _SHOWN} more" if len(words) > _SHOWN else ""
    return ", ".join(words[:_SHOWN]) + more


# ------------------------------------------------------------------------------------------------------- mesh alignment


_TEETH_MEET = 1e-6  # phase error (pitches) below which teeth mesh
_NONE = 1e-9  # mm: smaller distances are rounding errors


def reference(direction: Vector) -> Vector:
    """Return the unit vector perpendicular to an axis from which angles are measured; for the z axis, it is x."""
    return frame(direction)[0]


def pitch_directions(
    wheels: tuple[WheelPlace, WheelPlace], ways: tuple[Vector, Vector], rings: tuple[bool, bool]
) -> tuple[Vector, Vector]:
    """Return the unit vectors from the axes of two wheels to their pitch point, each perpendicular to its axis.

    ways    declared directions of the axes
    rings   for each wheel, True if it is a ring
    """
    first, second = wheels
    between = minus(second.centre, first.centre)
    if first.cone or second.cone:  # on the facing side of the apex
        towards = [scaled(way, float(wheel.facing)) for wheel, way in zip(wheels, ways, strict=True)]
        towards = [towards[0] if first.facing else opposite(between), towards[1] if second.facing else between]
        return unit(across(towards[1], ways[0])), unit(across(towards[0], ways[1]))
    apart = across(between, ways[0])
    out = unit(apart) if size(apart) > _NONE else reference(ways[0])
    # contact with a ring is inside it, on the far side of its mate
    return opposite(out) if rings[1] else out, out if rings[0] else opposite(out)


def align_meshes(
    declared: DeclaredGeometry, places: Mapping[str, WheelPlace]
) -> tuple[dict[str, float], dict[str, float]]:
    """Return the angles at which wheels mesh, by wheel, and the phase errors of pairs that do not mesh, by pair.

    Each angle is that of the first tooth of a wheel (rad, from 0 to one pitch). A phase error [pitches] exists only for
    a pair that closes a loop.
    """
    sense: dict[str, int] = {}  # 1 if positive angles about both axes move the pitch point in the same direction, or -1
    angle: dict[tuple[str, str], float] = {}  # angle of the pitch point of a pair about the axis of its wheel
    of: dict[str, list[PitchContact]] = {}
    for contact in declared.contacts:
        first, second = contact.wheels
        ways = declared.lines[contact.axes[0]].direction, declared.lines[contact.axes[1]].direction
        rings = declared.wheel(first).internal, declared.wheel(second).internal
        outs = pitch_directions((places[first], places[second]), ways, rings)
        same = dot(cross(ways[0], outs[0]), cross(ways[1], outs[1])) > 0
        sense[contact.name] = contact.worm_sense or (1 if same else -1)
        for wheel, way, out in zip(contact.wheels, ways, outs, strict=True):
            angle[contact.name, wheel] = azimuth(out, way, reference(way))
            of.setdefault(wheel, []).append(contact)

    def past(contact: PitchContact, wheel: str) -> float:
        """Return the distance by which the first tooth of a wheel is past the pitch point [pitches]."""
        return (turns[wheel] - angle[contact.name, wheel]) * declared.count(wheel) / (2 * pi)

    turns: dict[str, float] = {}
    for start in of:
        if start in turns:
            continue
        turns[start] = angle[of[start][0].name, start] % (2 * pi / declared.count(start))
        waiting = deque([start])
        while waiting:
            here = waiting.popleft()
            for contact in of[here]:
                mate = next(wheel for wheel in contact.wheels if wheel != here)
                if mate not in turns:
                    pitch = 2 * pi / declared.count(mate)
                    # s_2 = 1/2 - s_1 for opposite senses, else s_1 - 1/2, which is s_1 + 1/2 (mod 1)
                    ahead = 0.5 + sense[contact.name] * past(contact, here)
                    turns[mate] = (angle[contact.name, mate] + ahead * pitch) % pitch
                    waiting.append(mate)
    misses = {}
    for contact in declared.contacts:
        first, second = contact.wheels
        misses[contact.name] = remainder(past(contact, first) - sense[contact.name] * past(contact, second) - 0.5, 1.0)
    return turns, {name: miss for name, miss in misses.items() if abs(miss) > _TEETH_MEET}


# --------------------------------------------------------------------------------------------------------- train layout


How = Literal["given", "found", "free"]
_Z: Vector = (0.0, 0.0, 1.0)  # direction for wheels without an axis
_PARALLEL = 1e-9  # of the cosine, because directions are rounded to floats


@dataclass(frozen=True, slots=True)
class AxisPlace(Shown):
    """Position and direction of an axis in the zero pose.

    See Also
    --------
    lay_out : returns it in `Layout.axes`.
    """

    label: str
    """Label of the axis in the declaration."""
    point: Vector
    """Point on the axis [mm]."""
    direction: Vector
    """Declared unit vector of the axis. Positive speeds of links on the axis are rotations about this vector."""
    how: How
    """Origin of the position: `given` if declared, `found` if determined by meshing wheels or a pin, `free` if chosen
    freely.
    """
    carrier: str
    """Link that carries the axis: the frame or a carrier."""


@dataclass(frozen=True, slots=True)
class WheelPlace(Shown):
    """Position and size of a wheel in the zero pose.

    See Also
    --------
    lay_out : returns it in `Layout.wheels`.
    """

    wheel: str
    """Name of the wheel."""
    link: str
    """Link that carries the wheel."""
    axis: str
    """Label of the axis about which the wheel turns."""
    centre: Vector
    """Centre of the wheel's pitch circle, on the axis of the wheel [mm]."""
    radius: float
    """Pitch radius [mm]; for a bevel wheel, at the large end of the teeth."""
    module: float
    """Transverse module [mm], the pitch diameter divided by the tooth count; for a worm, the axial module."""
    thickness: float
    """Thickness of the wheel's rim along the axis [mm]."""
    given: bool = False
    """True if a module is declared for the wheel itself, or for a wheel to which meshes connect it."""
    cone: float = 0.0
    """Half angle of the wheel's pitch cone [rad]: 0 for a cylinder, pi/2 for a crown wheel."""
    facing: int = 0
    """Side of the axis towards which the pitch cone opens: 1 in the axis direction, -1 against it, 0 for a cylinder."""
    layer: int | None = 0
    """Index of the level, from 0 for the lowest along the main axes; None for wheels on other axes."""
    turn: float = 0.0
    """Angle of the first tooth about the axis direction, from `reference` [rad], at which the teeth mesh."""
    reference: Vector = (1.0, 0.0, 0.0)
    """Unit vector perpendicular to the axis, from which `turn` is measured."""

    @property
    def span(self) -> tuple[float, float]:
        """Lower and upper ends of the wheel body along the direction of the axis, relative to `centre` [mm]."""
        return span(self.facing, *bare_reach(self.cone, self.radius, self.thickness, self.module))


@dataclass(frozen=True, slots=True)
class Layout(Shown):
    """Layout of a train: positions of all axes and wheels in space.

    See Also
    --------
    lay_out : returns it.
    """

    axes: Mapping[str, AxisPlace]
    """Axes by label."""
    wheels: Mapping[str, WheelPlace]
    """Wheels by name."""
    notices: tuple[Problem, ...] = ()
    """Problems with wheels and axes that collide or could not be placed as declared, with reasons and remedies."""
    front: int = 1
    """Side from which the train is viewed: 1 for the side of positive z, -1 for negative z."""
    apart: Mapping[str, float] = field(default_factory=dict)
    """Gap between pitch circles [mm] of pairs whose wheels do not touch in the layout; negative for an overlap."""

    def _summary(self) -> str:
        notices = f", {len(self.notices)} notices" if self.notices else ""
        return f"{len(self.axes)} axes, {len(self.wheels)} wheels{notices}"

    def axis_distance(self, first: str, second: str) -> float | None:
        """Return the distance between the axes of two wheels if they are parallel.

        Parameters
        ----------
        first : str
            Name of a wheel.
        second : str
            Name of another wheel.

        Returns
        -------
        float or None
            Distance [mm]; None if the axes are not parallel.
        """
        one, other = self.wheels[first], self.wheels[second]
        directions = [self.axes[each.axis].direction if each.axis in self.axes else _Z for each in (one, other)]
        if abs(abs(dot(*directions)) - 1) > _PARALLEL:
            return None
        return size(across(minus(one.centre, other.centre), directions[0]))


def lay_out(train: GearTrain) -> Layout:
    """Return the positions of all axes and wheels of a train, found by beam search and local search; the result is
    deterministic.

    Declared positions, modules and offsets of pins are always kept. All other sizes are chosen so that pitch circles
    touch, wheels on one level do not overlap and the plan is compact. Every valid train has a layout. The computing
    time is less than a second for 70 wheels, and for a chain of 1000 axes.

    Parameters
    ----------
    train : GearTrain
        Loaded or declared train; it need not be able to turn.

    Returns
    -------
    Layout
        Layout with lengths in mm, in the pose in which all angles are 0. Its `notices` report conditions that are not
        satisfied.

    Notes
    -----
    The steps are: modules of all wheels (`wheel_modules`), groups of parallel axes (`parallel_groups`), for each group
    the plan (`plan_search`) and the heights of its wheels (`wheel_stacks`), then the angles at which teeth mesh
    (`align_meshes`).

    Examples
    --------
    A sun of 24, a planet of 18 and a ring of 60 teeth have a module of 1 mm if no size is declared.

    >>> import geartrain
    >>> layout = lay_out(geartrain.load("planetary-24-18-60"))
    >>> {name: wheel.radius for name, wheel in layout.wheels.items()}
    {'ring': 30.0, 's': 12.0, 'p': 9.0}
    """
    train = train.unfolded
    geometry = size_geometry(read_geometry(train))
    declared = geometry.declared
    found = arrange(geometry)
    places = _wheel_places(found)
    turns, misses = align_meshes(declared, places)
    gaps = pitch_gaps(found)
    return Layout(
        _axis_places(found),
        {name: replace(place, turn=turns.get(name, 0.0)) for name, place in places.items()},
        tuple(notices(train, found, gaps, misses)),
        declared.front,
        gaps,
    )


def _axis_places(found: Arrangement) -> dict[str, AxisPlace]:
    declared = found.geometry.declared
    pairs = (*found.geometry.modules.distances, *(contact.axes for contact in declared.contacts))
    tied = {label for pair in pairs for label in pair}
    places = {}
    for label, line in declared.lines.items():
        how: How = "given" if line.given else "found" if label in tied else "free"
        places[label] = AxisPlace(label, found.points[label], line.direction, how, line.bearers[0])
    return places


def _wheel_places(found: Arrangement) -> dict[str, WheelPlace]:
    """Return the positions of all wheels, before they are rotated so that teeth mesh, by wheel."""
    geometry, declared = found.geometry, found.geometry.declared
    layers, contacts = _layers(found), declared.contacts
    # wheels that also mesh with a wheel on a parallel axis have no cone
    straight = {wheel for contact in contacts if contact.parallel for wheel in contact.wheels}
    coned = {wheel: seat for (_, wheel), seat in geometry.seats.items() if wheel not in straight}
    places = {}
    for wheel, (link, kind) in declared.wheels.items():
        axis, sized = declared.axis[wheel], geometry.sizes[wheel]
        direction = declared.lines[axis].direction if axis else _Z
        cone = coned[wheel].cone if wheel in coned else 0.0
        places[wheel] = WheelPlace(
            wheel=wheel,
            link=link,
            axis=axis,
            centre=found.centres[wheel],
            radius=sized.radius,
            module=sized.module,
            thickness=sized.thickness,
            given=wheel in geometry.modules.declared,
            cone=cone,
            facing=kind.facing if cone else 0,
            layer=layers.get(wheel),
            reference=reference(direction),
        )
    return places


def _layers(found: Arrangement) -> dict[str, int]:
    """Return the index of the lowest level of each wheel on the main axes, counted from the bottom, by wheel."""
    declared, sizes = found.geometry.declared, found.geometry.sizes
    heights = {
        wheel: dot(found.centres[wheel], found.up) - sizes[wheel].foot
        for wheel, axis in declared.axis.items()
        if axis and declared.lines[axis].group == found.main
    }
    levels: list[float] = []
    layers = {}
    for wheel, height in sorted(heights.items(), key=lambda each: each[1]):
        if not levels or height - levels[-1] > 1e-6 * sizes[wheel].thickness:  # smaller differences are rounding errors
            levels.append(height)
        layers[wheel] = len(levels) - 1
    return layers
