"""Plan of plates, pillars, arbors, pipes and studs of a train, with their positions in the stack.

The two plates of the frame, and the plates of carriers, are tried in every gap between levels. Among the positions with
the fewest obstacles, the position with the lowest cost of studs and of arbors that pass through a plate is selected.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice, product
from math import inf
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.scene.parts.arbor_columns import (
    APART,
    HEAD_ROOM,
    INTEGRAL,
    AxisColumn,
    ColumnMember,
    ColumnProblem,
    FramePlaces,
)
from geartrain.scene.parts.carried_axes import (
    CarriedAxis,
    CarrierSeat,
    TurningPlate,
    carried_columns,
    carrier_seats,
    plate_seat,
    ring_seats,
)
from geartrain.scene.parts.eccentrics import FlexibleCup, PinCircle, pin_seats, running_hole, too_thin
from geartrain.scene.parts.frame_stack import AcrossWheel, FrameStack
from geartrain.scene.parts.processes import Process
from geartrain.scene.parts.stack_discs import Point, StackDisc, gaps, slabs

if TYPE_CHECKING:
    from geartrain.scene.layout import Layout


# ----------------------------------------------------------------------------------------------------- places of plates


_TRIED = 64  # maximum number of combinations of carrier plates
_INSIDE, _OUTSIDE, _PASSING = 30, 15, 11  # costs of a stud between the plates or beyond, of an arbor through one


@dataclass(frozen=True, slots=True)
class PlateChoice:
    """Heights of the frame plates, supports of carried axes, and columns of all axes, with the cost of this choice."""

    places: FramePlaces
    seats: tuple[CarrierSeat, ...]
    columns: tuple[AxisColumn, ...]
    outside: int
    """1 if the train extends above the front plate, -1 if it extends below the back plate, 0 if neither."""
    cost: tuple[int, int]
    """Number of obstacles, including crossing wheels that a plate would cut; cost of studs and of passing arbors."""


def best_places(
    axes: Sequence[ColumnProblem],
    discs: Sequence[StackDisc],
    seats: Sequence[Sequence[CarrierSeat]],
    slab_gaps: Sequence[float],
    blocked: Callable[[Sequence[CarrierSeat]], int],
    cut: Callable[[float], int],
) -> PlateChoice:
    """Return the best positions of the plates and the best seats of carriers, by branch and bound.

    At most 64 combinations of seats are tried. One plate is at an end of the stack; only if obstacles remain, both
    plates may be inside the stack.

    blocked   function that returns the number of obstacles on axes of carriers for given seats
    cut       function that returns the number of crossing wheels that a plate at a given height [mm] would cut
    """
    count = len(slab_gaps)
    best: PlateChoice | None = None
    crossed = [cut(height) for height in slab_gaps]
    # both plates at the ends come first, a good bound for all others
    pairs = [(low, high) for high in range(count - 1, 0, -1) for low in range(high)]
    ways = []
    # the product is exponential in the number of carriers, so it is truncated
    for chosen in islice(product(*seats), _TRIED):
        every = [*discs, *(plate.disc for seat in chosen for plate in seat.plates)]
        ways.append((chosen, [with_discs(axis, every) for axis in axes], blocked(chosen)))
    for inside in (False, True):
        for chosen, problems, bad in ways:
            for low, high in pairs:
                if (low > 0 and high < count - 1) != inside:
                    continue
                places = FramePlaces((slab_gaps[low],) * 2, (slab_gaps[high],) * 2)
                cost = bad + crossed[low] + crossed[high], 0
                if found := _columns(problems, places, cost, (inf, 0) if best is None else best.cost):
                    columns = tuple(found[0][axis.axis] for axis in axes)
                    best = PlateChoice(places, chosen, columns, (high < count - 1) - (low > 0), found[1])
        if best is not None and not best.cost[0]:
            break
    assert best is not None
    return best


def _columns(
    problems: list[ColumnProblem], places: FramePlaces, cost: tuple[int, int], bound: tuple[float, int]
) -> tuple[dict[str, AxisColumn], tuple[int, int]] | None:
    """Return the best column of every axis, by axis, and their total cost; None if the cost reaches the bound.

    cost    cost of the plates themselves; the first number counts obstacles
    bound   lowest total cost that is known
    """
    found: dict[str, AxisColumn] = {}
    for at, problem in enumerate(problems if cost < bound else ()):
        column = found[problem.axis] = best_column(problem.columns(places))
        if column.is_stud:
            inside = any(places.back[1] < each.high and each.low < places.front[0] for each in column.members)
            effort = _INSIDE if inside else _OUTSIDE
        else:
            effort = _PASSING * sum(column.passes(plate) for plate in (places.back, places.front))
        cost = cost[0] + obstacles([column]), cost[1] + effort
        if cost >= bound:
            # this axis comes first from now on, as it is likely to exclude the next positions of the plates too
            problems.insert(0, problems.pop(at))
            break
    return (found, cost) if cost < bound else None


def obstacles(columns: Iterable[AxisColumn]) -> int:
    """Return the number of obstacles of all columns; a pair of links that cannot be nested counts as one obstacle."""
    return sum(len(each.hit) + bool(each.tangled) for each in columns)


def with_discs(axis: ColumnProblem, discs: Sequence[StackDisc]) -> ColumnProblem:
    """Return the same `ColumnProblem` for a stack with other discs."""
    own = [disc for disc in discs if disc.axis == axis.axis]
    others = [disc for disc in discs if disc.axis != axis.axis]
    return replace(axis, discs=own, others=others)


def best_column(columns: Iterable[AxisColumn]) -> AxisColumn:
    """Return the first column without an obstacle; if all have obstacles, return the first column."""
    first = None
    for each in columns:
        if not each.hit and not each.tangled:
            return each
        first = first or each
    assert first is not None
    return first


# ----------------------------------------------------------------------------------------------------------------- plan


_DIAL = 6.0  # mm by which an arbor extends towards a dial


@dataclass(frozen=True)
class FramePlan:
    """Positions of all parts of a mechanism. Heights are measured along the normal of the plates; lengths are in mm."""

    stack: FrameStack
    """Wheels at their positions in the layout."""
    process: Process
    thickness: float
    core: float | None
    """Diameter of all arbors [mm]; None if it may be chosen for each axis."""
    ends: Mapping[str, tuple[int, int]]
    """Number of hands at the lower and the upper end of each link's arbor, by link; 0 if the end is not at a dial."""

    @property
    def has_sized_dials(self) -> bool:
        """True if the diameter of at least one dial is declared."""
        return any(each.diameter is not None for each in self.stack.train.declaration.dials.values())

    # --------------------------------------------------------------------------------------------------- as laid out

    @cached_property
    def _slabs(self) -> list[tuple[float, float]]:
        return slabs(self.stack.discs, list(self.stack.tied.values()))

    @cached_property
    def _gaps(self) -> list[float]:
        return gaps(self._slabs)

    @cached_property
    def choice(self) -> PlateChoice:
        """Positions of the plates with the fewest obstacles; ties are broken in favour of the lowest cost of studs."""
        first = self._best([])
        tangled = [each for each in first.columns if each.tangled]
        # a link that extends to a dial but cannot be nested may get an arm, which a bar connects to the link
        arms = [[arm] for column in tangled for arm in arm_seats(self.stack, column, self.ends, self._gaps)]
        return min(first, self._best(arms), key=lambda each: each.cost[0]) if arms else first

    def _best(self, arms: list[list[CarrierSeat]]) -> PlateChoice:
        axes, seats = list(self._axes(self.stack.discs, self._slabs)), [*self._seats(), *arms]
        return best_places(axes, self.stack.discs, seats, self._gaps, self._blocked, self._cut)

    def _axes(self, discs: Sequence[StackDisc], taken: Sequence[tuple[float, float]]) -> Iterator[ColumnProblem]:
        # dials of a declared size are beyond wheels on crossing axes too
        beyond = self.stack.across if self.has_sized_dials else ()
        low = min([taken[0][0], *(each.low for each in beyond)])
        span = low - _DIAL, max([taken[-1][1], *(each.high for each in beyond)]) + _DIAL
        for label, axis in self.stack.axes.items():
            if any(disc.axis == label for disc in self.stack.discs):
                at, sizes = self.stack.flat(axis.point), self._arbor(label)
                problem = ColumnProblem(label, at, (), (), self.ends, span, self.stack.frame, self.process, *sizes)
                yield with_discs(problem, discs)

    def _arbor(self, axis: str) -> tuple[float | None, float | None]:
        """Return the diameters of the arbor and the pivots of an axis [mm], as requested or declared for its link."""
        train = self.stack.train
        links = [link for link in train.declaration.links if train.kinematics.tree.axis(link) == axis]
        declared = [arbor for link in links if (arbor := train.declaration.links[link].arbor) is not None]
        # a requested diameter applies to all arbors, even if the declaration gives others
        if self.core is not None or not declared:
            return self.core, None
        thinnest = min(declared, key=lambda arbor: arbor.diameter.si)  # the innermost
        return 1000 * thinnest.diameter.si, None if thinnest.pivot is None else 1000 * thinnest.pivot.si

    def _seats(self) -> Iterator[list[CarrierSeat]]:
        """Yield the possible plates or wheels that can support each carrier, circle of pins, cup, ring and flange."""
        by_carrier: dict[str, list[CarriedAxis]] = {}
        for each in self.stack.carried.values():
            by_carrier.setdefault(each.carrier, []).append(each)
        for link, carried in by_carrier.items():
            axis = self.stack.train.kinematics.tree.axis(link) or ""
            own = [disc for disc in self.stack.discs if disc.link == link]
            at = self.stack.flat(self.stack.axes[axis].point)
            own_pins = next((each for each in self.stack.pin_circles.values() if each.link == link), None)
            if own_pins is not None and (slots := self._slots(own_pins)):
                yield pin_seats(own_pins, axis, at, slots, self._gaps, carried)
                continue
            ways = carrier_seats(link, axis, at, carried, own, self._gaps)
            bad = {way: self._carried_cost(way, carried) for way in ways}
            yield [way for way in ways if bad[way] == min(bad.values())]
        circles: list[PinCircle | FlexibleCup] = [*self.stack.pin_circles.values(), *self.stack.cups]
        seated: set[str] = set()
        for circle in circles:
            if circle.link in seated:
                continue  # its pins pass through all discs
            seated.add(circle.link)
            axis = self.stack.train.kinematics.tree.axis(circle.link) or ""
            slots = self._slots(circle)
            if circle.link not in by_carrier and axis in self.stack.axes and slots:
                at = self.stack.flat(self.stack.axes[axis].point)
                yield pin_seats(circle, axis, at, slots, self._gaps)
        for disc in self.stack.discs:
            if not disc.hub and disc.link != self.stack.frame and disc.carrier is None:
                yield ring_seats(disc, disc.outer, self._gaps)
        yield from flange_seats(self.stack, self._gaps)

    def _slots(self, circle: PinCircle | FlexibleCup) -> list[StackDisc]:
        same = {each.slot for each in self.stack.pin_circles.values() if each.link == circle.link}
        return [disc for disc in self.stack.wheel_discs if disc.link in same | {circle.slot}]

    def _cut(self, height: float) -> int:
        """Return the number of crossing wheels with which a plate at a given height would collide."""
        points = [self.stack.flat(axis.point) for axis in self.stack.axes.values()]
        (left, low), (right, high) = ([end(each) for each in zip(*points, strict=True)] for end in (min, max))
        return sum(
            wheel.low < height < wheel.high
            and any(left - r < x < right + r and low - r < y < high + r for (x, y), r in wheel.circles)
            for wheel in self.stack.across
        )

    def _blocked(self, seats: Sequence[CarrierSeat]) -> int:
        """Return the number of obstacles on all axes that carriers carry, when all turning plates are in their gaps."""
        plates = [plate for seat in seats for plate in seat.plates]
        return sum(self._carried_cost(seat, self._borne_by(seat), plates) for seat in seats)

    def _borne_by(self, seat: CarrierSeat) -> list[CarriedAxis]:
        return [each for each in self.stack.carried.values() if seat.is_bearing and each.carrier == seat.link]

    def _carried_cost(
        self, way: CarrierSeat, carried: Sequence[CarriedAxis], plates: Sequence[TurningPlate] = ()
    ) -> int:
        """Return the number of obstacles on the axes of a carrier that is supported by `way`, without stud heads."""
        every = [*self.stack.discs, *(plate.disc for plate in plates or way.plates)]
        if not carried:
            return 0
        seat = next(disc for disc in every if disc.name == way.seat)
        return obstacles(carried_columns(carried, seat, every, self.process, self.core, head=0.0))

    # ------------------------------------------------------------------------------------------------------ as built

    @cached_property
    def turning(self) -> tuple[TurningPlate, ...]:
        """Plates of carriers and discs of rings, at their heights in the layout."""
        return tuple(plate for seat in self.choice.seats for plate in seat.plates)

    @cached_property
    def heights(self) -> StackHeights:
        """Heights of all parts as built [mm], with all plates inserted."""
        return stack_up(self._slabs, self.choice.places, self.turning, self.thickness)

    @property
    def places(self) -> FramePlaces:
        """Heights of the faces of both frame plates, as built [mm]."""
        return self.heights.places

    @cached_property
    def discs(self) -> tuple[StackDisc, ...]:
        """Wheels and turning plates as discs, at their heights as built."""
        rises = [(disc, self.heights.shift(disc.middle)) for disc in self.stack.discs]
        faces = [(plate.disc, *self.heights.plates[plate.disc.name]) for plate in self.turning]
        faces = [*((disc, disc.low + rise, disc.high + rise) for disc, rise in rises), *faces]
        return tuple(replace(disc, low=low, high=high) for disc, low, high in faces)

    @cached_property
    def columns(self) -> tuple[AxisColumn, ...]:
        """Column (arbor or stud, with pipes) of each axis of the frame, in a bridge if no plate can support it."""
        found = [best_column(axis.columns(self.places)) for axis in self._built_axes(self.bridge)]
        if self.bridge is None:
            return tuple(found)
        bridged = (axis.bridged(self.bridge) for axis in self._built_axes(self.bridge))
        return tuple(other if one.hit and not other.hit else one for one, other in zip(found, bridged, strict=True))

    def members_of(self, link: str | None) -> list[tuple[AxisColumn, ColumnMember]]:
        """Return the arbors and pipes of a link on axes of the frame, each with the column that contains it."""
        return [(column, each) for column in self.columns for each in column.members if each.link == link]

    @cached_property
    def bridge(self) -> tuple[float, float] | None:
        """Heights of the faces of a plate beyond all wheels, for an axis that the frame plates cannot support [mm].

        The value is None if no axis needs a bridge, or if no bridge can support the axis.
        """
        blocked = [axis for axis in self._built_axes(None) if best_column(axis.columns(self.places)).hit]
        low, high = (end(face for disc in self.discs for face in (disc.low, disc.high)) for end in (min, max))
        above = high + BEHIND, high + BEHIND + self.thickness
        below = low - BEHIND - self.thickness, low - BEHIND
        for axis in blocked:
            for faces, outside in (
                (above, all(disc.low > self.places.front[1] for disc in axis.discs)),
                (below, all(disc.high < self.places.back[0] for disc in axis.discs)),
            ):
                if outside and not axis.bridged(faces).hit:
                    return faces
        return None

    @property
    def bridged_plate(self) -> tuple[float, float]:
        """Heights of the faces of the plate to which the bridge is fixed [mm]."""
        above = self.bridge is not None and self.bridge > self.places.front
        return self.places.front if above else self.places.back

    def _built_axes(self, bridge: tuple[float, float] | None) -> list[ColumnProblem]:
        plates = [self.places.back, self.places.front, *([] if bridge is None else [bridge])]
        return list(self._axes(self.discs, slabs([*self.discs], plates)))

    @cached_property
    def carried(self) -> dict[str, AxisColumn]:
        """Column (stud, with pipes) of each carried axis, by axis."""
        named = {disc.name: disc for disc in self.discs}
        found: dict[str, AxisColumn] = {}
        for seat in self.choice.seats:
            own = self._borne_by(seat)
            if not own:
                continue
            axes = [replace(each, discs=tuple(named[disc.name] for disc in each.discs)) for each in own]
            columns = carried_columns(axes, named[seat.seat], self.discs, self.process, self.core)
            found |= dict(zip((each.label for each in own), columns, strict=True))
        return found

    def seat_of(self, carrier: str) -> str:
        """Return the name of the wheel or plate on which a carrier carries its axes or its pins."""
        return next(seat.seat for seat in self.choice.seats if seat.link == carrier and seat.is_bearing)

    @property
    def plated_pins(self) -> dict[str, str]:
        """Name of the turning plate in which the pins of a coupling are fixed, by coupling."""
        bearing = {seat.link for seat in self.choice.seats if seat.is_bearing}
        circles = self.stack.pin_circles.values()
        return {each.name: self.seat_of(each.link) for each in circles if each.link in bearing}

    @cached_property
    def all_columns(self) -> tuple[AxisColumn, ...]:
        """Columns (arbor or stud, with pipes) of the axes of the frame, followed by those of the carried axes."""
        return *self.columns, *self.carried.values()

    @cached_property
    def members(self) -> dict[str, ColumnMember]:
        """Arbor or pipe on which each wheel and each turning plate is mounted, by name of the wheel or plate."""
        return {disc.name: each for column in self.all_columns for each in column.members for disc in each.discs}

    @cached_property
    def cut(self) -> frozenset[str]:
        """Names of the pinions that are cut from the solid arbor, because their roots are too close to the arbor."""
        wheels = self.stack.layout.wheels
        return frozenset(
            disc.name
            for disc in self.discs
            if disc.name in wheels
            and disc.name in self.members
            and disc.root < self.members[disc.name].outer / 2 + INTEGRAL * wheels[disc.name].module
        )

    @cached_property
    def bores(self) -> dict[str, float]:
        """Diameter of the hole in each wheel and turning plate [mm], by name; 0 for a pinion cut from a solid arbor."""
        found = {}
        for name, member in self.members.items():
            found[name] = member.inner if name in self.cut else member.outer + self.process.press
        for each in self.stack.eccentrics:
            for name in each.wheels:
                found[name] = 2 * each.middle or running_hole(each, self.process)
        return found

    @cached_property
    def layout(self) -> Layout:
        """Layout with wheels at their heights as built; wheels on crossing axes are moved together with their mates."""
        return self.stack.raised(self.heights.shift)

    @cached_property
    def wheels_across(self) -> tuple[AcrossWheel, ...]:
        """Wheels on axes that are not perpendicular to the plates, at their positions as built."""
        return replace(self.stack, layout=self.layout).across

    def across(self, low: float, high: float) -> list[tuple[Point, float]]:
        """Return circles (centre, radius [mm]) around the wheels on inclined axes that extend between two heights."""
        return [circle for wheel in self.wheels_across if wheel.is_between(low, high) for circle in wheel.circles]

    @cached_property
    def notices(self) -> tuple[Problem, ...]:
        """Warnings about parts that cannot be made as they are laid out."""
        return tuple(self._problems())

    def _problems(self) -> Iterator[Problem]:
        yield from self.stack.omitted()
        for column in self.all_columns:
            if column.tangled:
                one, other = column.tangled
                why = f"on axis '{column.axis}' neither arbor can be a pipe around the other without enclosing a wheel"
                fix = "move one of the arbors to another axis, or remove a wheel from one of them"
                yield Problem(f"arbors '{one}' and '{other}' cannot be nested", why, fix)
            for disc, room in column.hit:
                who = f"arbor on axis '{column.axis}'"
                what = f"the {who} {'passes through' if room < 0 else 'is too close to'} '{disc.name}'"
                why = f"the clearance is {room:.3f} mm, and at least {APART:g} mm is required"
                yield Problem(what, why, "move the axis, change the order of the wheels, or use a smaller --bore")
        for name, member in self.members.items():
            root = next(disc.root for disc in member.discs if disc.name == name)
            if name in self.stack.layout.wheels and root < member.outer / 2 - 1e-9:
                shaft = "pipe" if member.inner else "arbor"
                what = f"wheel '{name}' is too small for its {shaft}"
                why = (
                    f"its root diameter is {2 * root:.3f} mm, and the outer diameter of the {shaft} '{member.link}' is "
                    f"{member.outer:g} mm"
                )
                yield Problem(what, why, "use a smaller --bore, or a larger module")
        for each in self.stack.eccentrics:
            if each.name in self.members and (problem := too_thin(each, self.members[each.name].outer)):
                yield problem


# ------------------------------------------------------------------------------------------------------ seats of shafts

_ARM, _FLANGE = 0.3, 0.2  # mm from the middle of the outermost gaps: arms are nearer to the wheels
_PART = 0.4  # radius of a flange divided by that of the widest disc on its axis
_ROOM = 4.0  # mm of a disc beyond all others on its axis, for a bar


def arm_seats(
    stack: FrameStack, column: AxisColumn, ends: Mapping[str, tuple[int, int]], slab_gaps: Sequence[float]
) -> Iterator[CarrierSeat]:
    """Yield the seats of arms beyond all wheels, for links that extend to a dial and cannot be nested."""
    for link in column.tangled or ():
        below, above = ends.get(link, (0, 0))
        about = [disc for disc in stack.discs if disc.axis == column.axis and disc.hub]
        own = [disc for disc in about if disc.link == link]
        if not own or below == above or link == stack.frame:
            continue
        widest = max(own, key=lambda disc: disc.root)
        between = [disc for disc in about if disc.link != link and (disc.middle > widest.middle) == above]
        if all(disc.outer + _ROOM < widest.root for disc in between):
            disc = replace(widest, name=f"{link} arm", outer=widest.root, root=0.0, apart=True)
            yield plate_seat(disc, slab_gaps[-1] - _ARM if above else slab_gaps[0] + _ARM)


def flange_seats(stack: FrameStack, slab_gaps: Sequence[float]) -> Iterator[list[CarrierSeat]]:
    """Yield the possible seats of a flange, below or above all wheels, for each shaft with only brakes or clutches."""
    train = stack.train
    held = {link for each in train.declaration.clutches.values() for link in each.locks or (each.fixes,)}
    bearing = {axis.carrier for axis in stack.layout.axes.values()}
    for link, declared in train.declaration.links.items():
        axis = train.kinematics.tree.axis(link) or ""
        radius = _PART * max((disc.outer for disc in stack.discs if disc.axis == axis), default=0.0)
        if link in held - bearing and not declared.wheels and axis in stack.axes and radius:
            disc = StackDisc(f"{link} flange", link, axis, stack.flat(stack.axes[axis].point), 0.0, 0.0, radius)
            heights = slab_gaps[0] + _FLANGE, slab_gaps[-1] - _FLANGE
            yield [plate_seat(disc, height, round_=True, flange=True) for height in heights]


# -------------------------------------------------------------------------------------------------------------- heights

BEHIND = 1.5  # mm between a plate of the frame and the nearest turning part
BETWEEN = HEAD_ROOM  # mm between a turning plate and its neighbours


@dataclass(frozen=True, slots=True)
class StackHeights:
    """Heights of all parts as built, with plates inserted into the stack of the layout."""

    starts: tuple[float, ...]
    """Height of the lower face of each slab in the layout [mm]."""
    shifts: tuple[float, ...]
    """Distance by which each slab is moved up [mm]."""
    places: FramePlaces
    plates: dict[str, tuple[float, float]]

    def shift(self, height: float) -> float:
        """Return the distance by which a part at a given height in the layout is moved up [mm]."""
        # a part on the lower face of a slab moves with the slab, despite rounding errors
        return self.shifts[max(bisect_right(self.starts, height + 1e-6) - 1, 0)]


def stack_up(
    taken: Sequence[tuple[float, float]], places: FramePlaces, turning: Sequence[TurningPlate], thickness: float
) -> StackHeights:
    """Return the heights as built. Plates are inserted between slabs of wheels, and the lowest slab is not moved."""
    rows = [(low, high - low, BETWEEN, ("slab", str(at))) for at, (low, high) in enumerate(taken)]
    rows += [(each.disc.middle, thickness, BETWEEN, ("turning", each.disc.name)) for each in turning]
    rows += [
        (places.back[0], thickness, BEHIND, ("frame", "back")),
        (places.front[0], thickness, BEHIND, ("frame", "front")),
    ]
    rows.sort(key=lambda row: row[0])
    faces: dict[tuple[str, str], tuple[float, float]] = {}
    top, before = 0.0, None
    for row in rows:
        low, tall, room, name = row
        if before is not None:
            slabs = before[3][0] == name[0] == "slab"
            # neighbouring slabs keep their gap of the layout; only plates need other gaps
            top += low - before[0] - before[1] if slabs else max(room, before[2])
        faces[name] = top, top + tall
        top, before = top + tall, row
    # the lowest slab keeps its height
    rise = taken[0][0] - faces["slab", "0"][0]
    moved = {name: (low + rise, high + rise) for name, (low, high) in faces.items()}
    shifts = tuple(moved["slab", str(at)][0] - low for at, (low, _) in enumerate(taken))
    turned = {name: each for (kind, name), each in moved.items() if kind == "turning"}
    starts = tuple(low for low, _ in taken)
    return StackHeights(starts, shifts, FramePlaces(moved["frame", "back"], moved["frame", "front"]), turned)
