"""Between which wheels the two plates stand, and where carriers have theirs.

Every gap between levels is tried: for each axis the best way to bear it is taken, and what is in its way is counted.
Of the places with the fewest obstacles the one with the fewest studs and arbors that pass a plate wins.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import islice, product
from math import inf

from geartrain.scene.parts.arbor_columns import AxisColumn, ColumnProblem, FramePlaces
from geartrain.scene.parts.carried_axes import CarrierSeat
from geartrain.scene.parts.stack_discs import StackDisc

_TRIED = 64  # ways to place plates of carriers
_INSIDE, _OUTSIDE, _PASSING = 30, 15, 11  # costs: a stud between the plates, one beyond them, an arbor through one


@dataclass(frozen=True, slots=True)
class PlateChoice:
    """Heights of both plates in the stack as it is laid out, seats of carriers, and what stands on each axis.

    outside   1 if the train goes on above the front plate, -1 if below the back one, 0 if it does not
    cost      obstacles on all axes, with wheels across that a plate would cut; then studs and arbors that pass a plate
    """

    places: FramePlaces
    seats: tuple[CarrierSeat, ...]
    columns: tuple[AxisColumn, ...]
    outside: int
    cost: tuple[int, int]


def best_places(
    axes: Sequence[ColumnProblem],
    discs: Sequence[StackDisc],
    seats: Sequence[Sequence[CarrierSeat]],
    slab_gaps: Sequence[float],
    blocked: Callable[[Sequence[CarrierSeat]], int],
    cut: Callable[[float], int],
) -> PlateChoice:
    """The best places of the plates with every way to seat carriers, by branch and bound.

    One plate stands at an end of the stack; only if something is in the way then, both may stand inside it.

    blocked   counts the obstacles on axes that carriers bear
    cut       counts wheels across that a plate at some height would cut
    """
    count = len(slab_gaps)
    best: PlateChoice | None = None
    crossed = [cut(height) for height in slab_gaps]
    pairs = [(low, high) for high in range(count - 1, 0, -1) for low in range(high)]
    ways = []
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
    """The best column of every axis and the cost of all; None as soon as that reaches the bound.

    The axis that reaches it becomes the first, because it is likely to exclude the next places too.
    """
    found: dict[str, AxisColumn] = {}
    for at, problem in enumerate(problems if cost < bound else ()):
        column = found[problem.axis] = best_column(problem.columns(places))
        cost = cost[0] + obstacles([column]), cost[1] + _effort(column, places)
        if cost >= bound:
            problems.insert(0, problems.pop(at))
            break
    return (found, cost) if cost < bound else None


def _effort(column: AxisColumn, places: FramePlaces) -> int:
    if column.is_stud:
        inside = any(places.back[1] < each.high and each.low < places.front[0] for each in column.members)
        return _INSIDE if inside else _OUTSIDE
    return _PASSING * sum(column.passes(plate) for plate in (places.back, places.front))


def obstacles(columns: Iterable[AxisColumn]) -> int:
    """How many things are in the way of some columns."""
    return sum(len(each.hit) + bool(each.tangled) for each in columns)


def with_discs(axis: ColumnProblem, discs: Sequence[StackDisc]) -> ColumnProblem:
    """The same axis in another stack."""
    own = [disc for disc in discs if disc.axis == axis.axis]
    others = [disc for disc in discs if disc.axis != axis.axis]
    return replace(axis, discs=own, others=others)


def best_column(columns: Iterable[AxisColumn]) -> AxisColumn:
    """The first without an obstacle, else the first; no more of them are made than are looked at."""
    first = None
    for each in columns:
        if not each.hit and not each.tangled:
            return each
        first = first or each
    assert first is not None
    return first
