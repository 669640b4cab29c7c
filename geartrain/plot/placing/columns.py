"""Which column a node stands in, which bands run back, how wide a unit of power is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise

from geartrain.plot.placing.parts import Piece, Spot
from geartrain.torques.flowing import Node, PowerFlow, Stream

TALL = 2.4  # of the fullest column
_BACK = 1.1  # of all bands that run back, at most


def collapsed(flow: PowerFlow) -> tuple[dict[Node, Fraction], list[Stream]]:
    """Losses by node, and streams, with bearings that only take from one shaft drawn as a loss of that shaft."""
    gives = {stream.source for stream in flow.streams}
    takers: dict[Node, list[Node]] = {}
    for stream in flow.streams:
        takers.setdefault(stream.target, []).append(stream.source)
    at = {
        node: takers[node][0] if node.kind == "bearing" and node not in gives and len(takers[node]) == 1 else node
        for node in flow.losses
    }
    sheds: dict[Node, Fraction] = {}
    for node, loss in flow.losses.items():
        sheds[at[node]] = sheds.get(at[node], Fraction(0)) + loss
    return sheds, [stream for stream in flow.streams if at.get(stream.target, stream.target) == stream.target]


def direct(streams: Sequence[Stream]) -> tuple[list[Stream], list[Stream]]:
    """Streams that lead on, and those that run back: of a loop, one in which power only circles."""
    ahead = [stream for stream in streams if stream.circling < stream.power]
    back: list[Stream] = []
    for stream in _met(streams):
        if stream.circling == stream.power:
            closes = stream.source in _reached(ahead, stream.target)
            (back if closes else ahead).append(stream)
    return ahead, back


def _met(streams: Sequence[Stream]) -> Iterator[Stream]:
    """All streams as one meets them who comes in with the power and follows the greatest first."""
    after: dict[Node, list[Stream]] = {}
    for stream in sorted(streams, key=lambda each: (each.source.kind != "in", -each.power)):
        after.setdefault(stream.source, []).append(stream)
    seen: set[Node] = set()
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


def _reached(streams: Sequence[Stream], node: Node) -> set[Node]:
    seen, todo = {node}, [node]
    while todo:
        here = todo.pop()
        fresh = {stream.target for stream in streams if stream.source == here} - seen
        seen |= fresh
        todo += fresh
    return seen


def find_columns(ahead: Sequence[Stream]) -> dict[Node, int]:
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


def find_scale(columns: Mapping[Node, int], through: Mapping[Node, Fraction], back: Sequence[Stream]) -> float:
    """Inches by power."""
    sums = [Fraction(0)] * (max(columns.values()) + 1)
    for node, at in columns.items():
        sums[at] += through[node]
    scale = TALL / float(max(sums))
    returning = float(sum((stream.power for stream in back), Fraction(0)))
    return min(scale, _BACK / returning) if returning else scale


def make_bands(
    spots: Mapping[Node, Spot], ahead: Sequence[Stream], back: Sequence[Stream], scale: float
) -> tuple[list[list[Piece]], list[Spot]]:
    """Streams as bands of pieces, and the spots where they pass columns."""
    bands: list[list[Piece]] = []
    passing: list[Spot] = []
    for stream in (*ahead, *back):
        width = float(stream.power) * scale
        way = [spots[stream.source], spots[stream.target]]
        if stream in ahead:
            between = [Spot(None, at, width) for at in range(way[0].column + 1, way[1].column)]
            passing += between
            way[1:1] = between
        band = [Piece(source, target, stream, width, stream not in ahead) for source, target in pairwise(way)]
        for piece in band:
            piece.source.after.append(piece)
            piece.target.before.append(piece)
        bands.append(band)
    return bands, passing
