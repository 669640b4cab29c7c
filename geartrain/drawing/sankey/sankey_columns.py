"""Columns of a Sankey diagram: which one a node stands in, where columns stand, and the bands that turn back round
them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from math import inf

from geartrain.drawing.sankey.sankey_bands import TURN, BandSegment, ReturnBand, SankeySpot
from geartrain.dynamics import PowerFlow, PowerNode, PowerStream

_LEAST_GAP = 0.62  # between columns
_CLEAR = 0.06  # between words and a band that turns back beside them


def turns(
    table: Sequence[Sequence[SankeySpot]], back: Sequence[BandSegment]
) -> tuple[list[ReturnBand], dict[tuple[int, bool], float]]:
    """Bands that run back, the shortest innermost, and how much room they take right and left of each column."""
    taken: dict[tuple[int, bool], float] = {}
    turns: list[ReturnBand] = []
    lane = inf
    for piece in sorted(back, key=lambda each: (each.span, each.start)):
        first, last = piece.target.column, piece.source.column
        lane = min([lane, *(spot.top - spot.above for column in table[first : last + 1] for spot in column)])
        lane -= piece.width + 0.06
        # the words over the ends of a band stand within its turns, not over them
        source, target = (
            end - spot.width / 2 + _CLEAR
            for end, spot in ((piece.source.right, piece.source), (piece.target.left, piece.target))
        )
        right, left = taken.get((last, True), max(TURN, source)), taken.get((first, False), max(TURN, target))
        turns.append(ReturnBand(piece, right, left, lane))
        taken[last, True], taken[first, False] = right + piece.width + 0.04, left + piece.width + 0.04
    return turns, taken


def abscissae(
    table: Sequence[Sequence[SankeySpot]], room: Mapping[tuple[int, bool], float], least: float
) -> list[float]:
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


TALL = 2.4  # of the fullest column
_BACK = 1.1  # of all bands that run back, at most


def collapsed(flow: PowerFlow) -> tuple[dict[PowerNode, Fraction], list[PowerStream]]:
    """Losses by node, and streams, with bearings that only take from one shaft drawn as a loss of that shaft."""
    gives = {stream.source for stream in flow.streams}
    takers: dict[PowerNode, list[PowerNode]] = {}
    for stream in flow.streams:
        takers.setdefault(stream.target, []).append(stream.source)
    at = {
        node: takers[node][0] if node.kind == "bearing" and node not in gives and len(takers[node]) == 1 else node
        for node in flow.losses
    }
    sheds: dict[PowerNode, Fraction] = {}
    for node, loss in flow.losses.items():
        sheds[at[node]] = sheds.get(at[node], Fraction(0)) + loss
    return sheds, [stream for stream in flow.streams if at.get(stream.target, stream.target) == stream.target]


def direct(streams: Sequence[PowerStream]) -> tuple[list[PowerStream], list[PowerStream]]:
    """Streams that lead on, and those that run back: of a loop, one in which power only circles."""
    ahead = [stream for stream in streams if stream.circling < stream.power]
    back: list[PowerStream] = []
    for stream in _met(streams):
        if stream.circling == stream.power:
            closes = stream.source in _reached(ahead, stream.target)
            (back if closes else ahead).append(stream)
    return ahead, back


def _met(streams: Sequence[PowerStream]) -> Iterator[PowerStream]:
    """All streams by depth-first search from where power comes in, the greatest stream of a node first."""
    after: dict[PowerNode, list[PowerStream]] = {}
    for stream in sorted(streams, key=lambda each: (each.source.kind != "in", -each.power)):
        after.setdefault(stream.source, []).append(stream)
    seen: set[PowerNode] = set()
    for start in after:
        todo = [iter(after[start])] if start not in seen else []
        seen.add(start)
        while todo:
            for stream in todo[-1]:
                yield stream
                if stream.target not in seen:
                    seen.add(stream.target)
                    todo.append(iter(after.get(stream.target, ())))
                    break
            else:
                todo.pop()


def _reached(streams: Sequence[PowerStream], node: PowerNode) -> set[PowerNode]:
    seen, todo = {node}, [node]
    while todo:
        here = todo.pop()
        fresh = {stream.target for stream in streams if stream.source == here} - seen
        seen |= fresh
        todo += fresh
    return seen


def find_columns(ahead: Sequence[PowerStream]) -> dict[PowerNode, int]:
    """Each node one column after all that feed it; what leaves the train stands last."""
    columns = dict.fromkeys((end for stream in ahead for end in (stream.source, stream.target)), 0)
    moved = True
    while moved:
        moved = False
        for stream in ahead:
            if columns[stream.target] <= columns[stream.source]:
                columns[stream.target] = columns[stream.source] + 1
                moved = True
    last = 1 + max(at for node, at in columns.items() if node.kind != "out")
    return {node: last if node.kind == "out" else at for node, at in columns.items()}


def find_scale(
    columns: Mapping[PowerNode, int], through: Mapping[PowerNode, Fraction], back: Sequence[PowerStream]
) -> float:
    """Inches by power."""
    sums = [Fraction(0)] * (max(columns.values()) + 1)
    for node, at in columns.items():
        sums[at] += through[node]
    scale = TALL / float(max(sums))
    returning = float(sum((stream.power for stream in back), Fraction(0)))
    return min(scale, _BACK / returning) if returning else scale


def make_bands(
    spots: Mapping[PowerNode, SankeySpot], ahead: Sequence[PowerStream], back: Sequence[PowerStream], scale: float
) -> tuple[list[list[BandSegment]], list[SankeySpot]]:
    """Streams as bands of pieces, and the spots where they pass columns."""
    bands: list[list[BandSegment]] = []
    passing: list[SankeySpot] = []
    for stream in (*ahead, *back):
        width = float(stream.power) * scale
        way = [spots[stream.source], spots[stream.target]]
        if stream in ahead:
            between = [SankeySpot(None, at, width) for at in range(way[0].column + 1, way[1].column)]
            passing += between
            way[1:1] = between
        band = [BandSegment(source, target, stream, width, stream not in ahead) for source, target in pairwise(way)]
        for piece in band:
            piece.source.after.append(piece)
            piece.target.before.append(piece)
        bands.append(band)
    return bands, passing
