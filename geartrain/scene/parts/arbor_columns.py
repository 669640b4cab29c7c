"""Parts on one axis of the frame: an arbor between the plates, or a stud in one plate, and pipes around it.

A pipe extends from its lowest wheel to its highest wheel and covers the arbor inside it, so that no wheel of that arbor
may be in this interval. Each pair with only one possible nesting is an edge of a graph. A topological order of the
graph is the order of nesting, and a cycle means that the arbors cannot be nested.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

from geartrain.scene.parts.processes import Process
from geartrain.scene.parts.stack_discs import Point, StackDisc, by_piece

OVER = 0.2  # mm by which a pipe extends beyond its wheels at either end
SHAKE = 0.2  # mm of end shake
HEAD = 0.6  # mm: thickness of a stud's head
COLLAR = 1.0  # mm: length and wall of a collar
HEAD_OVER = 1.0  # mm: radius of a head minus that of its stud
APART = 0.2  # mm of clearance between a column and a wheel of another axis
HEAD_ROOM = OVER + SHAKE + HEAD + APART  # mm between wheels on a stud and turning parts before its head
INTEGRAL = 0.6  # modules between roots and arbor: with less a pinion is cut from the solid arbor
HAND = 1.6  # mm by which an arbor extends beyond its pipe if both carry hands
_MINIMUM = 0.8  # mm: minimum diameter of an arbor
USUAL = 2 / 3
"""Default diameter of an arbor divided by the root radius of the smallest wheel on it."""
_CORES = (4.0, 3.0, 2.0, 1.5, 1.0, _MINIMUM)  # mm: diameters of arbors that are tried to avoid obstacles
_PIVOT = 0.55  # diameter of a pivot divided by that of its arbor, which leaves a shoulder
_WIDEST = 6.0  # mm: maximum default diameter


class AxisBearing(StrEnum):
    """Kind of bearing of an axis in the plates of the frame."""

    THROUGH = "through"
    BACK_STUD = "stud in the back plate"
    FRONT_STUD = "stud in the front plate"
    BRIDGE = "arbor in a bridge"


@dataclass(frozen=True, slots=True)
class FramePlaces:
    """Heights of the lower and upper face of the back plate and of the front plate [mm]."""

    back: tuple[float, float]
    front: tuple[float, float]


@dataclass(frozen=True, slots=True)
class ColumnMember:
    """Arbor or pipe on an axis: its link, its ends, its inner diameter (0 if solid) and its outer diameter [mm]."""

    link: str
    low: float
    high: float
    inner: float
    outer: float
    discs: tuple[StackDisc, ...]
    fixed: bool = False


@dataclass(frozen=True, slots=True)
class AxisColumn:
    """All arbors, pipes and studs on one axis of the frame, and the discs of other axes that they would touch."""

    axis: str
    at: Point
    bearing: AxisBearing
    core: float
    """Diameter of the central arbor or stud [mm], which extends from `low` to `high`."""
    pivot: float
    """Diameter of the arbor's pivots [mm]."""
    low: float
    high: float
    members: tuple[ColumnMember, ...]
    """Arbors and pipes of the column, from the innermost outwards; an arbor through both plates is the first."""
    hit: tuple[tuple[StackDisc, float], ...] = ()
    """Discs of other axes that are nearer to the column than `APART`, each with its distance to the column [mm]."""
    tangled: tuple[str, str] | None = None
    """Two links neither of which can be inside the other; None if all links can be nested."""
    on: str = ""
    """Axis of the stud from the end of which this stud projects as one part; empty for other columns."""
    topped: bool = False
    """True for a stud from the end of which another stud projects."""

    @property
    def is_stud(self) -> bool:
        """True if the core of the column is fixed in one plate."""
        return self.bearing in (AxisBearing.BACK_STUD, AxisBearing.FRONT_STUD)

    def passes(self, plate: tuple[float, float]) -> bool:
        """Return True if a member extends beyond both faces of a plate."""
        middle = sum(plate) / 2
        return any(each.low < middle < each.high for each in self.members)

    def radius(self, low: float, high: float) -> float:
        """Return the radius of the widest part between two heights [mm]."""
        wide = [each.outer / 2 for each in self.members if each.low < high and low < each.high]
        return max([*wide, self.core / 2 if self.low < high and low < self.high else 0.0])


@dataclass(frozen=True)
class ColumnProblem:
    """Input for the choice of the arbor, pipes and studs of one axis."""

    axis: str
    at: Point
    discs: Sequence[StackDisc]
    others: Sequence[StackDisc]
    ends: Mapping[str, tuple[int, int]]
    """Number of hands at the lower and the upper end of each link's arbor, by link; 0 if the end is in the stack."""
    span: tuple[float, float]
    """Lowest and highest point of the stack, including the space of dials [mm]."""
    frame: str
    process: Process
    core: float | None = None
    """Given diameter of the arbor [mm]; None if it may be chosen."""
    pivot: float | None = None
    """Given diameter of the arbor's pivots [mm]; None if it may be chosen."""
    head: float = SHAKE + HEAD
    """Length by which a stud extends beyond the parts on it [mm]."""

    @cached_property
    def beside(self) -> list[tuple[StackDisc, float]]:
        """Discs of other axes, each with its distance to the centre line of this axis [mm]."""
        return beside(self.axis, self.at, self.others)

    def columns(self, places: FramePlaces) -> Iterator[AxisColumn]:
        """Yield the possible columns, each an arbor or stud with its pipes and obstacles, in order of preference."""
        order, tangled = self._ordered(places)
        return (self._thinned(bearing, places, order, tangled) for bearing in self._bearings(places))

    def bridged(self, bridge: tuple[float, float]) -> AxisColumn:
        """Return the column (arbor and pipes) with its only bearing in a bridge, between two collars."""
        places = FramePlaces(bridge, bridge)
        return self._thinned(AxisBearing.BRIDGE, places, *self._ordered(places))

    def _thinned(
        self, bearing: AxisBearing, places: FramePlaces, order: Sequence[CoaxialLink], tangled: tuple[str, str] | None
    ) -> AxisColumn:
        """Return the column with the requested diameter of its arbor or stud, or with the thickest one that fits.

        order     links from the innermost outwards
        tangled   two links that cannot be nested, or None
        """
        stud = bearing in (AxisBearing.BACK_STUD, AxisBearing.FRONT_STUD) or all(each.fixed for each in order)

        def column(core: float) -> AxisColumn:
            return self._column(bearing, places, self._members(order, core, stud), tangled, core)

        # the preferred diameter, which does not take obstacles into account
        first = column(self._core(order, stud))
        thinner = [core for core in _CORES if core < first.core]
        # the radius of a column increases with its core at every height: an obstacle of the thinnest blocks all
        if self.core is not None or not first.hit or not thinner or column(thinner[-1]).hit:
            return first
        return next(each for each in map(column, thinner) if not each.hit)

    def _bearings(self, places: FramePlaces) -> list[AxisBearing]:
        back, front = sum(places.back) / 2, sum(places.front) / 2
        moving = [disc for disc in self.discs if disc.hub and disc.link != self.frame]
        own = {self.ends[disc.link] for disc in moving if disc.link in self.ends}
        low = min((disc.low for disc in moving), default=back)
        high = max((disc.high for disc in moving), default=front)
        if any((below and low > back) or (above and high < front) for below, above in own):
            return [AxisBearing.THROUGH]
        if low > front:
            return [AxisBearing.FRONT_STUD]
        if high < back:
            return [AxisBearing.BACK_STUD]
        if low > back and high < front:
            return [AxisBearing.THROUGH, AxisBearing.BACK_STUD, AxisBearing.FRONT_STUD]
        return [AxisBearing.THROUGH]

    def _ordered(self, places: FramePlaces) -> tuple[tuple[CoaxialLink, ...], tuple[str, str] | None]:
        """Return the arbors and pipes from the innermost outwards, and two links that cannot be nested, or None."""
        if not self._fixed_discs:
            return self._turning_order
        middle = (self._fixed_discs[0].low + self._fixed_discs[-1].high) / 2
        plates = sorted((places.back, places.front), key=lambda plate: abs(sum(plate) / 2 - middle))
        tangled = None
        for still in self._fixed_pieces(plates):
            order, clash = nested([*still, *self._turning_pieces])
            if not clash:
                return order, None
            tangled = tangled or clash
        # one piece, without its hub in the nearer plate, so that no pipe is considered to collide with it
        whole = self._fixed_piece(self._fixed_discs, plates[0])
        return nested([replace(whole, hubs=whole.hubs[:-1]), *self._turning_pieces])[0], tangled

    @cached_property
    def _turning_order(self) -> tuple[tuple[CoaxialLink, ...], tuple[str, str] | None]:
        """Order of nesting of the turning pieces, and two links that cannot be nested, for all positions of plates."""
        return nested(self._turning_pieces)

    @cached_property
    def _turning_pieces(self) -> tuple[CoaxialLink, ...]:
        """Pieces on the axis that turn, which become the arbor and the pipes."""
        found = []
        pieces = by_piece(disc for disc in self.discs if disc.hub and disc.link != self.frame)
        parted = {link for link, apart in pieces if apart}
        for (link, apart), discs in pieces.items():
            below, above = self.ends.get(link, (0, 0))
            if link in parted:  # a separate piece extends on its own side, the rest on the other
                under = min(disc.low for disc in pieces[link, True]) < min(disc.low for disc in pieces[link, False])
                below, above = below * (under == apart), above * (under != apart)
            low, high = min(disc.low for disc in discs), max(disc.high for disc in discs)
            low = self.span[0] - HAND * (below - 1) if below else low
            high = self.span[1] + HAND * (above - 1) if above else high
            hubs = tuple(disc.middle for disc in discs)
            ends = below > 0, above > 0
            found.append(CoaxialLink(link, hubs, low, high, discs=tuple(discs), ends=ends))
        return tuple(found)

    @cached_property
    def _fixed_discs(self) -> list[StackDisc]:
        """Discs of the fixed wheels, from the lowest to the highest."""
        return sorted((disc for disc in self.discs if disc.hub and disc.link == self.frame), key=lambda disc: disc.low)

    def _fixed_pieces(self, plates: Sequence[tuple[float, float]]) -> Iterator[list[CoaxialLink]]:
        """Yield the possible arrangements of the fixed wheels on one or two parts, each fixed in a plate."""
        own = self._fixed_discs
        yield from ([self._fixed_piece(own, plate)] for plate in plates)
        hubs = [height for each in self._turning_pieces for height in each.hubs]
        for plate in plates:
            # no turning disc may be between a plate and the wheels that are fixed next to it
            next_to = [
                disc
                for disc in own
                if not any(min(disc.middle, plate[0]) < height < max(disc.middle, plate[1]) for height in hubs)
            ]
            rest = [disc for disc in own if disc not in next_to]
            if next_to and rest:
                yield from (
                    [self._fixed_piece(rest, other), self._fixed_piece(next_to, plate)] for other in plates[::-1]
                )

    def _fixed_piece(self, discs: Sequence[StackDisc], plate: tuple[float, float]) -> CoaxialLink:
        """Return a part that holds the given fixed wheels and ends in a plate, whose height is its last hub."""
        low, high = min(discs[0].low, plate[0]), max(discs[-1].high, plate[1])
        hubs = (*(disc.middle for disc in discs), sum(plate) / 2)
        return CoaxialLink(self.frame, hubs, low, high, True, tuple(discs))

    def _column(
        self,
        bearing: AxisBearing,
        places: FramePlaces,
        members: tuple[ColumnMember, ...],
        tangled: tuple[str, str] | None,
        core: float,
    ) -> AxisColumn:
        low = min((each.low for each in members), default=places.back[1])
        high = max((each.high for each in members), default=places.front[0])
        head = self.head
        if bearing is AxisBearing.BACK_STUD:
            low, high = (places.back[0], high + head) if high > places.back[1] else (low - head, places.back[1])
        elif bearing is AxisBearing.FRONT_STUD:
            low, high = (low - head, places.front[1]) if low < places.front[0] else (places.front[0], high + head)
        else:
            beyond = COLLAR + SHAKE if bearing is AxisBearing.BRIDGE else 0.0
            low, high = min(low, places.back[0] - beyond), max(high, places.front[1] + beyond)
        if members and not members[0].inner:
            members = (replace(members[0], low=low, high=high), *members[1:])
        pivot = round(_PIVOT * core, 2) if self.pivot is None else min(self.pivot, core)
        pivot = core if bearing is AxisBearing.BRIDGE else pivot
        column = AxisColumn(self.axis, self.at, bearing, core, pivot, low, high, members, (), tangled)
        return with_hits(column, self.beside)

    def _core(self, order: Sequence[CoaxialLink], stud: bool) -> float:
        """Return the diameter of the arbor or stud [mm]: as requested, or so that each pipe fits in its wheels."""
        if self.core is not None:
            return self.core
        roots = [min((disc.root for disc in each.discs if disc.root), default=9.0) for each in order]
        found = [_WIDEST, *(USUAL * root for root in roots)]
        thick = [each.outer for each in self._members(order, 0.0, stud)]  # thickness added by pipes
        # the outside diameter of a pipe is core + outer, and at most the root diameter of its smallest wheel
        found += [2 * root - outer for outer, root in zip(thick, roots, strict=True)]
        return max(_MINIMUM, round(min(found), 2))

    def _members(self, order: Sequence[CoaxialLink], core: float, stud: bool) -> tuple[ColumnMember, ...]:
        found: list[ColumnMember] = []
        for each, (low, high) in zip(order, _reach(order), strict=True):
            if not found and not stud:
                found.append(ColumnMember(each.link, low, high, 0.0, core, each.discs, each.fixed))
                continue
            # the first is the core, and passes through all
            under = [one.outer for k, one in enumerate(found) if not (k or stud) or (one.low < high and low < one.high)]
            inner = round(max([core, *under]) + self.process.running, 3)
            outer = round(inner + 2 * self.process.wall, 3)
            found.append(ColumnMember(each.link, low, high, inner, outer, each.discs, each.fixed))
        return tuple(found)


def _reach(order: Sequence[CoaxialLink]) -> list[tuple[float, float]]:
    """Return the ends of each arbor or pipe [mm]; an inner one whose hand is above another hand is longer."""
    found, steps = [], [0, 0]
    for each in reversed(order):
        below, above = each.ends
        found.append((each.low - OVER - HAND * steps[0] * below, each.high + OVER + HAND * steps[1] * above))
        steps = [steps[0] + below, steps[1] + above]
    return found[::-1]


def beside(axis: str, at: Point, discs: Iterable[StackDisc]) -> list[tuple[StackDisc, float]]:
    """Return the discs of other axes, each with its distance to the centre line of the axis [mm]."""
    return [(disc, disc.clearance_to(at, 0.0)) for disc in discs if disc.axis != axis]


def with_hits(column: AxisColumn, others: Iterable[tuple[StackDisc, float]]) -> AxisColumn:
    """Return the column with the discs of other axes to which its clearance is less than 0.2 mm (`APART`)."""
    # most discs are too far off for the widest part, which saves computing the radius at their height
    room = APART + max([column.core, *(each.outer for each in column.members)]) / 2
    near = ((disc, free, column.radius(disc.low, disc.high)) for disc, free in others if free < room)
    hit = tuple((disc, free - radius) for disc, free, radius in near if radius and free - radius < APART)
    return replace(column, hit=hit)


# -------------------------------------------------------------------------------------------------------------- nesting


@dataclass(frozen=True, slots=True)
class CoaxialLink:
    """Part of a link on one axis: an arbor, or a pipe around other arbors, from `low` to `high` [mm]."""

    link: str
    hubs: tuple[float, ...]
    """Heights of the discs on the piece [mm], followed by the height of the plate that holds a fixed piece."""
    low: float
    high: float
    fixed: bool = False
    discs: tuple[StackDisc, ...] = ()
    ends: tuple[bool, bool] = (False, False)
    """True for the lower and the upper end of the piece if that end extends beyond the stack."""


def nested(links: Sequence[CoaxialLink]) -> tuple[tuple[CoaxialLink, ...], tuple[str, str] | None]:
    """Return pieces of coaxial links from the innermost outwards (topological order), and None.

    If no such order exists, return the pieces as given, and the names of two links that cannot be nested.
    """
    # a piece that covers a hub of another one cannot be a pipe around it
    around = [
        {k for k, other in enumerate(links) if k != at and any(other.low < hub < other.high for hub in each.hubs)}
        for at, each in enumerate(links)
    ]
    left, order = list(range(len(links))), list[int]()
    while left:
        # the next may contain no other: the longest first, fixed pieces last
        free = [at for at in left if around[at].isdisjoint(left)]
        if not free:
            both = ((links[a].link, links[b].link) for a in left for b in left if a in around[b] and b in around[a])
            return tuple(links), next(both, (links[0].link, links[-1].link))
        order.append(min(free, key=lambda at: (links[at].fixed, links[at].low - links[at].high)))
        left.remove(order[-1])
    return tuple(links[at] for at in order), None
