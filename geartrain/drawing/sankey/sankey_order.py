"""The order of each column with the least tangle of bands, and tops of nodes so that bands run level where they can."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from geartrain.drawing.sankey.sankey_bands import SankeySpot

_SWEEPS = 24
_CROSSING = 1e-3  # what a crossing of the thinnest bands counts


def order_columns(table: Sequence[list[SankeySpot]]) -> None:
    """Put each column in the order with the least tangle, out of some beginnings."""
    found: list[tuple[float, list[list[SankeySpot]]]] = []
    declared = [list(column) for column in table]
    beginnings: tuple[Callable[[list[SankeySpot]], list[SankeySpot]], ...] = (
        list,
        lambda column: column[::-1],
        _loops_first,
    )
    for begin in beginnings:
        trial = [begin(column) for column in declared]
        _untangle(trial)
        found.append((_tangle(trial, range(len(trial))), trial))
    _, best = min(found, key=lambda each: each[0])
    for column, order in zip(table, best, strict=True):
        column[:] = order


def _loops_first(column: list[SankeySpot]) -> list[SankeySpot]:
    """What circles above what passes."""
    return sorted(column, key=lambda spot: -sum(piece.stream.circling for piece in spot.after))


def _untangle(table: Sequence[list[SankeySpot]]) -> None:
    """Order columns by what they depend on, to and fro; then swap spots while that uncrosses bands."""
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


def _swap(table: Sequence[list[SankeySpot]], at: int) -> bool:
    """Swap spots of one column where that uncrosses bands; True if any were swapped."""
    column, swapped = table[at], False
    near = range(max(0, at - 1), min(len(table), at + 2))
    tangle = _tangle(table, near)
    for upper in range(len(column) - 1):
        for lower in range(upper + 1, len(column)):
            column[upper], column[lower] = column[lower], column[upper]
            if (now := _tangle(table, near)) < tangle - 1e-9:  # a gain of rounding would be swapped back for ever
                tangle, swapped = now, True
            else:
                column[upper], column[lower] = column[lower], column[upper]
    return swapped


def _ranks(table: Sequence[Sequence[SankeySpot]]) -> dict[SankeySpot, float]:
    return {spot: (at + 0.5) / len(column) for column in table for at, spot in enumerate(column)}


def _middle(spot: SankeySpot, forth: bool, places: Mapping[SankeySpot, float]) -> float:
    """Mean place of the neighbours on one side, by width."""
    pieces = [piece for piece in (spot.before if forth else spot.after) if not piece.back]
    if not pieces:
        return places[spot]
    others = [(piece.source if forth else piece.target, piece.width) for piece in pieces]
    return sum(places[other] * width for other, width in others) / sum(width for _, width in others)


def _tangle(table: Sequence[Sequence[SankeySpot]], columns: range) -> float:
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


_HEIGHT_SWEEPS = 24


def settle_heights(table: Sequence[list[SankeySpot]]) -> None:
    """Tops of all spots, so that bands run level where they can, and of their bands."""
    for column in table:
        y = 0.0
        for spot in column:
            y += spot.above
            spot.top = y
            y += spot.height + spot.below
    for sweep in range(4 * _HEIGHT_SWEEPS):
        forth = sweep % 2 == 0
        for column in table if forth else reversed(table):
            _ports(table)
            # at first bands of one side, to come near, then both
            wanted = [
                _wanted(spot, sweep >= _HEIGHT_SWEEPS or forth, sweep >= _HEIGHT_SWEEPS or not forth) for spot in column
            ]
            for spot, top in zip(column, _apart(column, wanted), strict=True):
                spot.top = top
    _ports(table)


def _wanted(spot: SankeySpot, before: bool, after: bool) -> tuple[float, float]:
    """The top at which a spot's bands would run level, and how much they weigh; bands that pass bend the least."""
    shift = weight = 1e-9
    for sense, pieces in ((1, spot.before if before else ()), (-1, spot.after if after else ())):
        for piece in pieces:
            if not piece.back:
                passing = (piece.source.node is None) + (piece.target.node is None)
                force = (1.0, 2.0, 8.0)[passing] * (piece.width + 0.02)
                shift += sense * force * (piece.start - piece.end)
                weight += force
    return spot.top + shift / weight, weight


def _apart(column: Sequence[SankeySpot], wanted: Sequence[tuple[float, float]]) -> list[float]:
    """Tops nearest to the wanted ones that keep the spots of a column apart: the least sum of weighted squares."""
    offsets, y = [], 0.0
    for at, spot in enumerate(column):
        offsets.append(y)
        following = column[at + 1].above if at + 1 < len(column) else 0.0
        y += spot.height + spot.below + following
    groups: list[list[float]] = []  # mean, weight, members
    for (top, weight), offset in zip(wanted, offsets, strict=True):
        groups.append([top - offset, weight, 1])
        while len(groups) > 1 and groups[-2][0] > groups[-1][0]:
            (a, v, m), (b, w, n) = groups[-2:]
            groups[-2:] = [[(a * v + b * w) / (v + w), v + w, m + n]]
    means = [mean for mean, _, members in groups for _ in range(int(members))]
    return [mean + offset for mean, offset in zip(means, offsets, strict=True)]


def _ports(table: Sequence[Sequence[SankeySpot]]) -> None:
    """Tops of bands at both ends: in the order of where they come from and go to, those that run back uppermost."""
    for column in table:
        for spot in column:
            spot.before.sort(key=lambda piece: (not piece.back, piece.span, piece.source.top + piece.source.height / 2))
            spot.after.sort(key=lambda piece: (not piece.back, piece.span, piece.target.top + piece.target.height / 2))
            y = spot.top
            for piece in spot.before:
                piece.end = y
                y += piece.width
            y = spot.top
            for piece in spot.after:
                piece.start = y
                y += piece.width
