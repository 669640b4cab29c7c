"""The order of each column with the least tangle of bands."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from geartrain.plot.placing.parts import Spot

_SWEEPS = 24
_CROSSING = 1e-3  # what a crossing of the thinnest bands counts


def order(table: Sequence[list[Spot]]) -> None:
    """Put each column in the order with the least tangle, out of some beginnings."""
    found: list[tuple[float, list[list[Spot]]]] = []
    declared = [list(column) for column in table]
    beginnings: tuple[Callable[[list[Spot]], list[Spot]], ...] = (list, lambda column: column[::-1], _loops_first)
    for begin in beginnings:
        trial = [begin(column) for column in declared]
        _untangle(trial)
        found.append((_tangle(trial, range(len(trial))), trial))
    _, best = min(found, key=lambda each: each[0])
    for column, order in zip(table, best, strict=True):
        column[:] = order


def _loops_first(column: list[Spot]) -> list[Spot]:
    """What circles above what passes."""
    return sorted(column, key=lambda spot: -sum(piece.stream.circling for piece in spot.after))


def _untangle(table: Sequence[list[Spot]]) -> None:
    """Order columns by what they hang on, to and fro; then swap spots while that uncrosses bands."""
    whole = range(len(table))
    best, least = [list(column) for column in table], _tangle(table, whole)
    for sweep in range(_SWEEPS):
        forth = sweep % 2 == 0
        places = _ranks(table)
        for column in table if forth else reversed(table):
            column.sort(key=lambda spot: _middle(spot, forth, places))
            places |= _ranks([column])
        if (tangle := _tangle(table, whole)) < least:
            best, least = [list(column) for column in table], tangle
    for column, order in zip(table, best, strict=True):
        column[:] = order
    for _ in range(_SWEEPS):
        if not sum(_swap(table, at) for at in whole):
            break


def _swap(table: Sequence[list[Spot]], at: int) -> bool:
    """Swap spots of one column where that uncrosses bands; True if any were swapped."""
    column, swapped = table[at], False
    near = range(max(0, at - 1), min(len(table), at + 2))
    tangle = _tangle(table, near)
    for upper in range(len(column) - 1):
        for lower in range(upper + 1, len(column)):
            column[upper], column[lower] = column[lower], column[upper]
            if (now := _tangle(table, near)) < tangle - 1e-9:
                tangle, swapped = now, True
            else:
                column[upper], column[lower] = column[lower], column[upper]
    return swapped


def _ranks(table: Sequence[Sequence[Spot]]) -> dict[Spot, float]:
    return {spot: (at + 0.5) / len(column) for column in table for at, spot in enumerate(column)}


def _middle(spot: Spot, forth: bool, places: Mapping[Spot, float]) -> float:
    """Mean place of the neighbours on one side, by width."""
    pieces = [piece for piece in (spot.before if forth else spot.after) if not piece.back]
    if not pieces:
        return places[spot]
    others = [(piece.source if forth else piece.target, piece.width) for piece in pieces]
    return sum(places[other] * width for other, width in others) / sum(width for _, width in others)


def _tangle(table: Sequence[Sequence[Spot]], columns: range) -> float:
    """How much bands cross near some columns: for each crossing the widths multiplied, and a little."""
    total = 0.0
    for at in columns:
        places = {spot: place for place, spot in enumerate(table[at])}
        ahead = [piece for spot in table[at] for piece in spot.after if not piece.back]
        if at + 1 < len(table) and at + 1 in columns:
            ends = {spot: place for place, spot in enumerate(table[at + 1])}
            for number, one in enumerate(ahead):
                for other in ahead[number + 1 :]:
                    if (places[one.source] - places[other.source]) * (ends[one.target] - ends[other.target]) < 0:
                        total += one.width * other.width + _CROSSING
        # a band that turns back passes all that is above it in its column
        for spot in table[at]:
            for turning, after in ((spot.after, True), (spot.before, False)):
                width = sum(piece.width for piece in turning if piece.back)
                for above in table[at][: places[spot]] if width else ():
                    passed = [piece.width for piece in (above.after if after else above.before) if not piece.back]
                    total += sum(passed) * width + _CROSSING * len(passed)
    return total
