"""All tooth sets of an epicyclic kind within bounds, as columns, and their exact ratios."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations, product
from math import prod
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.synthesis.epicyclic.set_assembly import clears, fits
from geartrain.synthesis.epicyclic.set_kinds import CentralWheel, EpicyclicKind, EpicyclicMode

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Ints
    from geartrain.synthesis.tooth_count_ranges import Counts

    Columns = Mapping[str, Ints]

MOST_SETS = 4 * 10**8
MOST_TEETH = 100_000
"""Numerators of third degree in the counts stay below 2^53 up to here."""

SetBounds = Mapping[str, tuple[int, ...]]
"""Admissible counts of every wheel, ascending."""


def read_bounds(kind: EpicyclicKind, counts: Counts | Mapping[str, Counts]) -> SetBounds:
    """Admissible counts of every wheel: the same for all, or by wheel. Raises `QuestionError`."""
    if isinstance(counts, Mapping):
        unknown = [wheel for wheel in counts if wheel not in kind.wheels]
        missing = [wheel for wheel in kind.wheels if wheel not in counts]
        if unknown or missing:
            what = f"'{unknown[0]}' is no wheel of" if unknown else f"wheel '{missing[0]}' has no counts in"
            why = f"its wheels are {', '.join(kind.wheels)}"
            raise QuestionError(Problem(f"{what} the kind '{kind.name}'", why, "give counts for each of them"))
        return {wheel: _usable(f"of wheel '{wheel}' ", counts[wheel]) for wheel in kind.wheels}
    return dict.fromkeys(kind.wheels, _usable("", counts))


def _usable(whose: str, counts: Counts) -> tuple[int, ...]:
    found = tuple(sorted(set(counts))) if len(counts) <= MOST_TEETH else ()
    if found and found[0] >= 1 and found[-1] <= MOST_TEETH:
        return found
    why = f"the search takes counts from 1 to {MOST_TEETH}, and at least one"
    raise QuestionError(Problem(f"the counts {whose}cannot be used", why, "give counts such as 15:120"))


def size(kind: EpicyclicKind, bounds: SetBounds, slack: int = 0) -> int:
    """How many sets there are before any constraint."""
    chosen = prod(len(bounds[wheel]) for wheel in kind.free)
    return int(chosen * (2 * slack + 1) ** len(_followers(kind)))


def blocks(
    kind: EpicyclicKind, bounds: SetBounds, planets: int, clearance: Fraction | None, slack: int = 0
) -> Iterator[tuple[int, Columns]]:
    """All sets, block by block: how many a block had, and those of them whose wheels are whole, allowed and fit.

    planets    equal planets among which an idle wheel must find room
    clearance  that room (modules), or None where it does not matter
    slack      half modules by which the other centre distances may differ from the first; profile shift bridges them

    Raises `RangeError` for more than `MOST_SETS` sets.
    """
    total = size(kind, bounds, slack)
    if total > MOST_SETS:
        why = f"the search looks at each, and takes {MOST_SETS:.0e} at most"
        raise RangeError(Problem(f"{total:.2g} tooth sets to look at", why, "narrow the counts, or ask for less slack"))
    first, *rest = (np.array(bounds[wheel], dtype=np.int64) for wheel in kind.free)
    inner = [column.ravel() for column in np.meshgrid(*rest, indexing="ij")]
    # about 20,000 sets at a time fit the processor's cache
    step = max(1, 20_000 // max(1, len(inner[0])))
    for at in range(0, len(first), step):
        head = first[at : at + step]
        columns = [np.repeat(head, len(inner[0])), *(np.tile(column, len(head)) for column in inner)]
        chosen = dict(zip(kind.free, columns, strict=True))
        for extra in product(range(-slack, slack + 1), repeat=len(_followers(kind))):
            yield len(columns[0]), _completed(kind, bounds, chosen, extra, planets, clearance)


def _followers(kind: EpicyclicKind) -> list[tuple[CentralWheel, CentralWheel]]:
    """Central wheels whose count follows from another one's: both meet the same planet link, so share a distance."""
    if kind.bevel:
        return []
    found = []
    for link in kind.planets:
        first, *others = [member for member in kind.members if member.mesh in link]
        found += [(first, other) for other in others]
    return found


def _completed(
    kind: EpicyclicKind,
    bounds: SetBounds,
    chosen: Columns,
    extra: Sequence[int],
    planets: int,
    clearance: Fraction | None,
) -> Columns:
    """The sets with their remaining wheels, without those that cannot be."""
    columns = dict(chosen)
    for (first, other), more in zip(_followers(kind), extra, strict=True):
        distance = columns[first.wheel] + (-1 if first.internal else 1) * columns[first.mesh] + more
        columns[other.wheel] = distance + (1 if other.internal else -1) * columns[other.mesh]
        columns = _kept(columns, _allowed(columns[other.wheel], bounds[other.wheel]))
    if kind.idle:
        columns = _with_idle(kind, bounds, columns, planets, clearance)
    return _kept(columns, fits(kind, columns) & _is_stepped(kind, columns))


def _is_stepped(kind: EpicyclicKind, columns: Columns) -> NDArray[np.bool_]:
    """False for equal steps of a planet that do what a plain planet does.

    They differ from one only where they meet two suns, or two rings, of different counts, which slack allows.
    """
    stepped = np.ones(len(columns[kind.free[0]]), dtype=bool)
    for one, other in ((one, other) for link in kind.planets for one, other in combinations(link, 2)):
        differ = columns[one] != columns[other]
        for first, second in combinations(kind.members, 2):
            if {first.mesh, second.mesh} == {one, other} and first.internal == second.internal:
                differ |= columns[first.wheel] != columns[second.wheel]
        stepped &= differ
    return stepped


def _with_idle(
    kind: EpicyclicKind, bounds: SetBounds, columns: Columns, planets: int, clearance: Fraction | None
) -> dict[str, Ints]:
    """The least count of the idle wheels that fits, in every set that has one."""
    # an idle wheel takes part in no ratio: the least count that fits stands for all
    common = set[int].intersection(*(set(bounds[wheel]) for wheel in kind.idle))
    found: Ints = np.zeros_like(columns[kind.free[0]])
    for count in sorted(common):
        open_ = np.flatnonzero(found == 0)
        tried = {wheel: column[open_] for wheel, column in columns.items()}
        tried |= {wheel: np.full(len(open_), count, dtype=np.int64) for wheel in kind.idle}
        at = np.flatnonzero(fits(kind, tried))
        if clearance is not None:
            at = at[clears(kind, _kept(tried, at), planets, clearance)]
        found[open_[at]] = count
    full = {**columns, **dict.fromkeys(kind.idle, found)}
    return _kept(full, found > 0)


def _allowed(column: Ints, allowed: tuple[int, ...]) -> NDArray[np.bool_]:
    if allowed[-1] - allowed[0] + 1 == len(allowed):
        return (column >= allowed[0]) & (column <= allowed[-1])
    return np.isin(column, allowed)


def _kept(columns: Columns, good: NDArray[np.bool_] | Ints) -> dict[str, Ints]:
    return {wheel: column[good] for wheel, column in columns.items()}


def ratio_terms(kind: EpicyclicKind, mode: EpicyclicMode, columns: Columns) -> tuple[Ints, Ints]:
    """Speed of the input over that of the output as numerator and denominator, exact and not reduced.

    (f_in - f_held) / (f_out - f_held) by Willis, with f = sign P / z for central wheels and 0 for the carrier.
    Where one of them is 0 the mode does not run: the output stands, or the input is locked.
    """
    (n1, d1), (n2, d2), (n0, d0) = (
        _relative(kind.member(link), columns) for link in (mode.input, mode.output, mode.held)
    )
    return np.asarray((n1 * d0 - n0 * d1) * d2, dtype=np.int64), np.asarray((n2 * d0 - n0 * d2) * d1, dtype=np.int64)


def _relative(member: CentralWheel | None, columns: Columns) -> tuple[Ints | int, Ints | int]:
    if member is None:
        return 0, 1
    return member.sign * (columns[member.step] if member.step else 1), columns[member.wheel]
