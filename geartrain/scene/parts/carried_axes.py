"""Additional parts of carriers and turning rings: a plate with studs, a wheel that is used as a plate, or a disc."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from math import dist

from geartrain.scene.parts.arbor_columns import HEAD, SHAKE, AxisColumn, ColumnProblem, FramePlaces, beside, with_hits
from geartrain.scene.parts.processes import Process
from geartrain.scene.parts.stack_discs import Point, StackDisc

BOSS = 2.0  # mm: minimum width of plate round a stud
NEAREST = 0.4  # mm from the middle of a gap: plates of pins are nearest to their disc
_NEAR, _FAR, _THIN = 0.3, 0.2, 0.02  # mm from the middle of a gap: then carriers, then discs of rings
WIDEST = 3.0  # mm: assumed radius of a stud before it is known
_STEP = 3.0  # mm: maximum diameter of a stud on the end of another
_BLADE = 0.1  # mm: minimum metal between two holes, or round the foot of a stud


@dataclass(frozen=True, slots=True)
class TurningPlate:
    """Plate of a carrier or a turning ring, to be inserted into a gap of the stack, with the axes that it carries."""

    disc: StackDisc
    """Cylinder that the plate sweeps as it turns, at the height of its gap."""
    spots: tuple[str, ...] = ()
    """Labels of the axes that the plate carries; empty for the disc of a ring."""
    ring: str = ""
    """Name of the ring wheel that the plate holds; empty for other plates."""
    round: bool = False
    """True if the outline of the plate is the full circle that it sweeps."""
    flange: bool = False
    """True if the plate is a flange for brakes and clutches on a shaft without wheels."""


@dataclass(frozen=True, slots=True)
class CarrierSeat:
    """Support of the axes that a link carries: one of its wheels, or a separate plate."""

    link: str
    seat: str
    plates: tuple[TurningPlate, ...]

    @property
    def is_bearing(self) -> bool:
        """True if the link carries axes or pins at this seat; False for discs of rings, arms, and flanges of shafts."""
        return not any(plate.ring or plate.disc.apart or plate.flange for plate in self.plates)


@dataclass(frozen=True, slots=True)
class CarriedAxis:
    """Axis that a link carries, with the discs on it."""

    label: str
    carrier: str
    at: Point
    discs: tuple[StackDisc, ...]
    through: frozenset[str] = frozenset()
    """Wheels of other links that have holes for the arbor of the axis."""


def plate_seat(
    disc: StackDisc,
    height: float,
    spots: tuple[str, ...] = (),
    ring: str = "",
    round_: bool = False,
    flange: bool = False,
) -> CarrierSeat:
    """Return a support that consists of one plate at the given height [mm], in a gap of the stack.

    spots    axes that the plate carries
    ring     ring that the plate holds, or ""
    round_   True for a round plate
    flange   True for the plate of a shaft with only brakes or clutches
    """
    disc = replace(disc, low=height - _THIN, high=height + _THIN)  # nominal faces until heights are set
    return CarrierSeat(disc.link, disc.name, (TurningPlate(disc, spots, ring, round_, flange),))


def carrier_seats(
    link: str,
    axis: str,
    at: Point,
    carried: Sequence[CarriedAxis],
    own: Sequence[StackDisc],
    slab_gaps: Sequence[float],
) -> list[CarrierSeat]:
    """Return the possible seats of the axes that a link carries: its own wheels, or a plate below or above the axes."""
    reach = max(dist(at, each.at) for each in carried) + BOSS
    fit = (disc for disc in own if disc.hub and disc.root > reach + WIDEST / 2)
    found = [CarrierSeat(link, disc.name, ()) for disc in fit]
    discs = [disc for each in carried for disc in each.discs]
    low, high = min(disc.low for disc in discs), max(disc.high for disc in discs)
    spots = tuple(each.label for each in carried)
    plate = StackDisc(f"{link} carrier plate", link, axis, at, 0.0, 0.0, reach + WIDEST)
    # off the middle of the gap, so that several plates in one gap have a fixed order
    heights = gap_beside(slab_gaps, low, -1) + _NEAR, gap_beside(slab_gaps, high, 1) - _NEAR
    return [*found, *(plate_seat(plate, height, spots) for height in heights)]


def ring_seats(ring: StackDisc, rim: float, slab_gaps: Sequence[float]) -> list[CarrierSeat]:
    """Return the two possible supports of a turning ring: a disc in the gap above the ring, or in the gap below it."""
    disc = replace(ring, name=f"{ring.name} disc", outer=rim, inner=0.0, root=rim, hub=True)
    heights = gap_beside(slab_gaps, ring.high, 1) - _FAR, gap_beside(slab_gaps, ring.low, -1) + _FAR
    return [plate_seat(disc, height, (), ring.name, round_=True) for height in heights]


def gap_beside(slab_gaps: Sequence[float], face: float, side: int) -> float:
    """Return the height of the gap nearest to a face [mm]: above the face if `side` is 1, below it if `side` is -1."""
    return min((each for each in slab_gaps if (each - face) * side > 0), key=lambda each: abs(each - face))


def carried_columns(
    axes: Sequence[CarriedAxis],
    seat: StackDisc,
    discs: Sequence[StackDisc],
    process: Process,
    core: float | None,
    head: float = SHAKE + HEAD,
) -> list[AxisColumn]:
    """Return the column (stud and pipes) of each axis in `axes`, all on one carrier, in positions relative to it.

    If `head` is 0, no space is reserved for the heads of studs. If the studs of two axes would intersect, they become
    one stepped part: the stud of the axis with wheels farther from the seat starts at the end of the other stud.
    """
    seen = [seen_from_carrier(seat.link, seat.at, disc) for disc in discs if disc.name != seat.name]
    faces = seat.low, seat.high

    def column(at: int, core: float | None) -> AxisColumn:
        axis, others = axes[at], [disc for disc in seen if disc.name not in axes[at].through]
        problem = ColumnProblem(axis.label, axis.at, axis.discs, others, {}, faces, "", process, core, head=head)
        return next(problem.columns(FramePlaces(faces, faces)))

    def away(at: int) -> float:
        return min((abs(disc.middle - seat.middle) for disc in axes[at].discs), default=0.0)

    found = [column(at, core) for at in range(len(axes))]
    for pair in combinations(range(len(axes)), 2):
        near, far = sorted(pair, key=away)
        apart, meeting = dist(axes[near].at, axes[far].at), (found[near].core + found[far].core) / 2 + _BLADE
        if 0 < apart < meeting and found[near].bearing is found[far].bearing and found[near].is_stud:
            thin = min(found[far].core, _STEP)
            # the end of the nearer stud contains the section of the farther one
            wide = round(thin + 2 * apart + _BLADE, 2)
            others = [disc for disc in seen if disc.name not in axes[near].through]
            found[near], found[far] = _stepped(column(near, wide), column(far, thin), others)
    return found


def _stepped(near: AxisColumn, far: AxisColumn, others: Sequence[StackDisc]) -> tuple[AxisColumn, AxisColumn]:
    """Return both columns, changed so that the stud of `far` starts at the end of the stud of `near`."""
    if max(each.high for each in far.members) > max(each.high for each in near.members):
        end = max(each.high for each in near.members) + SHAKE / 2
        near, far = replace(near, high=end, topped=True), replace(far, low=end, on=near.axis)
    else:
        end = min(each.low for each in near.members) - SHAKE / 2
        near, far = replace(near, low=end, topped=True), replace(far, high=end, on=near.axis)
    return with_hits(near, beside(near.axis, near.at, others)), with_hits(far, beside(far.axis, far.at, others))


def seen_from_carrier(carrier: str, middle: Point, disc: StackDisc) -> StackDisc:
    """Return a disc as seen from a turning carrier. It is at rest if it turns with the carrier; otherwise it revolves
    about the axis of the carrier.

    middle   position of the axis of the carrier [mm]
    """
    still = disc.link == carrier or (disc.carrier is not None and dist(disc.carrier, middle) < 1e-6)
    return replace(disc, carrier=None if still else middle)
