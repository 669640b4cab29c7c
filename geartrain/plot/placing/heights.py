"""Tops of all nodes and bands, so that bands run level where they can."""

from __future__ import annotations

from collections.abc import Sequence

from geartrain.plot.placing.parts import Spot

_SWEEPS = 24


def settle(table: Sequence[list[Spot]]) -> None:
    """Tops of all spots, so that bands run level where they can, and of their bands."""
    for column in table:
        y = 0.0
        for spot in column:
            y += spot.above
            spot.top = y
            y += spot.height + spot.below
    for sweep in range(4 * _SWEEPS):
        forth = sweep % 2 == 0
        for column in table if forth else reversed(table):
            _ports(table)
            # at first bands of one side, to come near, then both
            wanted = [_wanted(spot, sweep >= _SWEEPS or forth, sweep >= _SWEEPS or not forth) for spot in column]
            for spot, top in zip(column, _apart(column, wanted), strict=True):
                spot.top = top
    _ports(table)


def _wanted(spot: Spot, before: bool, after: bool) -> tuple[float, float]:
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


def _apart(column: Sequence[Spot], wanted: Sequence[tuple[float, float]]) -> list[float]:
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


def _ports(table: Sequence[Sequence[Spot]]) -> None:
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
