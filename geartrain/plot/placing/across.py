"""Where columns stand, and the bands that turn back round them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf

from geartrain.plot.placing.parts import TURN, Piece, Spot, Turn

_LEAST_GAP = 0.62  # between columns


def turns(table: Sequence[Sequence[Spot]], back: Sequence[Piece]) -> tuple[list[Turn], dict[tuple[int, bool], float]]:
    """Bands that run back, the shortest innermost, and how much room they take right and left of each column."""
    taken: dict[tuple[int, bool], float] = {}
    turns: list[Turn] = []
    lane = inf
    for piece in sorted(back, key=lambda each: (each.span, each.start)):
        first, last = piece.target.column, piece.source.column
        lane = min([lane, *(spot.top - spot.above for column in table[first : last + 1] for spot in column)])
        lane -= piece.width + 0.06
        right, left = taken.get((last, True), TURN), taken.get((first, False), TURN)
        turns.append(Turn(piece, right, left, lane))
        taken[last, True], taken[first, False] = right + piece.width + 0.04, left + piece.width + 0.04
    return turns, taken


def abscissae(table: Sequence[Sequence[Spot]], room: Mapping[tuple[int, bool], float], least: float) -> list[float]:
    """The middle of each column: wide enough apart for names and turns, and spread to fill the least width."""
    left = [max(spot.left for spot in column) for column in table]
    right = [max(spot.right for spot in column) for column in table]
    gaps = []
    for at in range(len(table) - 1):
        names = right[at] + left[at + 1] + 0.12
        behind, before = room.get((at, True), 0.0), room.get((at + 1, False), 0.0)
        turning = behind + before + (left[at + 1] if behind else 0.0) + (right[at] if before else 0.0)
        gaps.append(max(names, _LEAST_GAP, turning + 0.2))
    edges = left[0] + right[-1] + 0.2
    x = [left[0] + 0.1]
    for gap in _widened(gaps, least - edges):
        x.append(x[-1] + gap)
    return x


def _widened(gaps: Sequence[float], whole: float) -> list[float]:
    """The narrowest gaps widened alike, so that all fill the whole."""
    ranked = sorted(gaps)
    for count in range(len(gaps), 0, -1):
        level = (whole - sum(ranked[count:])) / count
        if level >= ranked[count - 1]:
            return [max(gap, level) for gap in gaps]
    return list(gaps)
