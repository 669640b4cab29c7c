"""Layout of a Sankey diagram of power flow: columns from the power input, with bands between them.

Lengths are in inches, x to the right and y down. A band is a stream, and its width is proportional to its power. Bands
that close a loop return above all other parts.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise
from math import inf
from typing import Any

from geartrain.dynamics import PowerFlow, PowerNode
from geartrain.dynamics.torques.power_flow import PowerStream

NAME = 0.46  # space above a node for its name
DROP, BEND = 0.14, 0.05  # height of a loss band, and the inner radius of its bend
TURN = 0.14  # inner radius of a return band's bends
_BETWEEN = 0.1  # space between passing bands of a column
_WIDTHS = {"in": 0.0, "out": 0.0, "shaft": 0.08, "pair": 0.2, "bearing": 0.2}


@dataclass(eq=False)
class SankeySpot:
    """Box of a node in a column of the diagram; without a node, the gap in a column through which a band passes."""

    node: PowerNode | None
    column: int
    height: float
    power: Fraction = Fraction(0)
    """Power that passes through the node."""
    shed: float = 0.0
    """Width of the band of the node's loss [in]."""
    left: float = 0.0
    """Space for text to the left of the node's centre [in]."""
    right: float = 0.0
    """Space for text to the right of the node's centre [in]."""
    lost: float = 0.0
    """Space for the label of the loss, below the node's box and to the right of the node's centre [in]."""
    top: float = 0.0
    before: list[BandSegment] = field(default_factory=list)
    after: list[BandSegment] = field(default_factory=list)

    @property
    def above(self) -> float:
        """Space above the box [in], which contains the name of a node or separates passing bands."""
        return NAME if self.node else _BETWEEN

    @property
    def below(self) -> float:
        """Space below the box [in], which contains the loss of a node or separates the box from the next spot."""
        return DROP + self.head + 0.24 if self.shed else _BETWEEN

    @property
    def head(self) -> float:
        """Length of the arrow head at the end of the node's loss band [in]."""
        return min(max(0.3 * self.shed, 0.08), 0.2)

    @property
    def width(self) -> float:
        """Width of the node's box [in]; 0 for inputs, outputs, and positions of passing bands."""
        return _WIDTHS[self.node.kind] if self.node else 0.0


@dataclass(eq=False)
class BandSegment:
    """Segment of a band between two boxes: in adjacent columns, or in any two columns if the power circulates."""

    source: SankeySpot
    target: SankeySpot
    stream: PowerStream
    width: float
    back: bool = False
    """True for a return band."""
    start: float = 0.0
    """Ordinate of the upper edge of the segment at `source` [in]."""
    end: float = 0.0
    """Ordinate of the upper edge of the segment at `target` [in]."""

    @property
    def span(self) -> int:
        """Number of columns that a return band spans; 0 for a forward band."""
        return self.source.column - self.target.column if self.back else 0


@dataclass(frozen=True)
class ReturnBand:
    """Band that returns circulating power from a box to a box further left, above all other bands."""

    piece: BandSegment
    right: float
    """Distance from the source to the turn at its right [in]."""
    left: float
    """Distance from the target to the turn at its left [in]."""
    lane: float
    """Ordinate of the top of the band above all other bands [in]."""


@dataclass(frozen=True)
class SankeyLayout:
    """Positions and sizes of all parts of a Sankey diagram, in inches unless noted."""

    spots: Sequence[SankeySpot]
    bands: Sequence[Sequence[BandSegment]]
    """Forward bands, each a sequence of segments from column to column."""
    turns: Sequence[ReturnBand]
    x: Sequence[float]
    """Abscissa of the centre of each column [in]."""
    scale: float
    """Scale of the widths of bands [inches per unit of power]."""
    sheds: Mapping[PowerNode, Fraction]
    """Power lost at each node that has a loss, keyed by node."""
    low: float
    width: float
    height: float


_MINIMUM_GAP = 0.5  # minimum gap between columns
_CLEAR = 0.06  # between text and a return band next to it


def turns(
    table: Sequence[Sequence[SankeySpot]], back: Sequence[BandSegment]
) -> tuple[list[ReturnBand], dict[tuple[int, bool], float]]:
    """Return the path of each return band, and the width [in] that these bands require on either side of each column.

    The space is keyed by (column, True) for the right side and (column, False) for the left side.
    """
    taken: dict[tuple[int, bool], float] = {}
    turns: list[ReturnBand] = []
    lane = inf
    for piece in sorted(back, key=lambda each: (each.span, each.start)):
        first, last = piece.target.column, piece.source.column
        lane = min([lane, *(spot.top - spot.above for column in table[first : last + 1] for spot in column)])
        lane -= piece.width + 0.06
        # the text above the ends of a band lies inside its bends
        source, target = (
            end - spot.width / 2 + _CLEAR
            for end, spot in ((piece.source.right, piece.source), (piece.target.left, piece.target))
        )
        right, left = taken.get((last, True), max(TURN, source)), taken.get((first, False), max(TURN, target))
        turns.append(ReturnBand(piece, right, left, lane))
        taken[last, True], taken[first, False] = right + piece.width + 0.04, left + piece.width + 0.04
    return turns, taken


def abscissae(
    table: Sequence[Sequence[SankeySpot]], room: Mapping[tuple[int, bool], float], minimum: float
) -> list[float]:
    """Return the abscissae of column centres [in], with space for names and bands, for a given `minimum` width."""
    left = [max(spot.left for spot in column) for column in table]
    right = [max(spot.right for spot in column) for column in table]
    lost = [max(spot.lost for spot in column) for column in table]
    gaps = []
    for at in range(len(table) - 1):
        names = right[at] + left[at + 1] + 0.12
        behind, before = room.get((at, True), 0.0), room.get((at + 1, False), 0.0)
        turning = behind + before + (left[at + 1] if behind else 0.0) + (max(right[at], lost[at]) if before else 0.0)
        # beside a return band the text of the neighbouring column needs its whole width
        gaps.append(max(names, _MINIMUM_GAP, lost[at] + 0.16, turning + 0.2))
    more = max(minimum - left[0] - right[-1] - 0.2 - sum(gaps), 0.0) / len(gaps)
    x = [left[0] + 0.1]
    for gap in gaps:
        x.append(x[-1] + gap + more)
    return x


TALL = 2.4  # height of all bands in the fullest column
_BACK = 1.1  # maximum height of all return bands together


def collapsed(flow: PowerFlow) -> tuple[dict[PowerNode, Fraction], list[PowerStream]]:
    """Return the losses by node, and the streams of power between nodes.

    A bearing that takes power from only one shaft is omitted, and its loss is added to the shaft's loss.
    """
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
    """Return the streams without loops, and the circulating streams that were removed from them, one for each loop."""
    import networkx as nx

    # depth-first search from the inputs, the largest stream of a node first: the last stream closes its loop
    ordered = sorted(streams, key=lambda each: (each.source.kind != "in", -each.power))
    graph, back = _graph(ordered), list[PowerStream]()
    with suppress(nx.NetworkXNoCycle):
        while True:
            loop = nx.find_cycle(graph, list(dict.fromkeys(stream.source for stream in ordered)))
            passed = (graph.edges[ends]["stream"] for ends in loop[::-1])
            back.append(next(stream for stream in passed if stream.circling == stream.power))
            graph.remove_edge(back[-1].source, back[-1].target)
    return [stream for stream in streams if stream not in back], back


def _graph(streams: Sequence[PowerStream]) -> Any:
    import networkx as nx

    graph: Any = nx.DiGraph()
    graph.add_edges_from((stream.source, stream.target, {"stream": stream}) for stream in streams)
    return graph


def find_columns(ahead: Sequence[PowerStream]) -> dict[PowerNode, int]:
    """Return the column of each node, right of all nodes that feed it (longest path); outputs are in the last one."""
    import networkx as nx

    graph = _graph(ahead)
    columns = {node: at for at, nodes in enumerate(nx.topological_generations(graph)) for node in nodes}
    last = 1 + max(at for node, at in columns.items() if node.kind != "out")
    return {node: last if node.kind == "out" else columns[node] for node in graph}


def make_bands(
    spots: Mapping[PowerNode, SankeySpot], ahead: Sequence[PowerStream], back: Sequence[PowerStream], scale: float
) -> tuple[list[list[BandSegment]], list[SankeySpot]]:
    """Return streams as bands of segments, and a list of the gaps through which bands pass columns.

    ahead, back   forward and circulating streams
    scale         width of a band per unit of power [in]
    """
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


_SWEEPS = 24
_CROSSING = 1e-3  # cost of each crossing, so that crossings of the thinnest bands count too


def order_columns(table: Sequence[list[SankeySpot]]) -> None:
    """Sort the nodes of each column in place to reduce crossings of bands: by barycentre sweeps, then by swaps."""
    for column in table:  # first in descending order of the recirculating power that leaves a node
        column.sort(key=lambda spot: -sum(piece.stream.circling for piece in spot.after))
    whole = range(len(table))
    best, minimum = [list(column) for column in table], _crossing_cost(table, whole)
    for sweep in range(_SWEEPS):
        forth = sweep % 2 == 0
        places = _ranks(table)
        for column in table if forth else reversed(table):
            middles = {}  # mean positions of the neighbours in the previous or next column, weighted by band width
            for spot in column:
                pieces = [piece for piece in (spot.before if forth else spot.after) if not piece.back]
                others = [(piece.source if forth else piece.target, piece.width) for piece in pieces]
                whole_width = sum(width for _, width in others)
                weighted = sum(places[other] * width for other, width in others)
                middles[spot] = weighted / whole_width if pieces else places[spot]
            column.sort(key=middles.__getitem__)
            places |= _ranks([column])
        if (tangle := _crossing_cost(table, whole)) < minimum:
            best, minimum = [list(column) for column in table], tangle
    for column, order in zip(table, best, strict=True):
        column[:] = order
    for _ in range(_SWEEPS):
        if not sum(_swap(table, at) for at in whole):
            break


def _swap(table: Sequence[list[SankeySpot]], at: int) -> bool:
    """Swap spots of one column in place where a swap reduces crossings. Return True if spots were swapped."""
    column, swapped = table[at], False
    near = range(max(0, at - 1), min(len(table), at + 2))
    tangle = _crossing_cost(table, near)
    for upper in range(len(column) - 1):
        for lower in range(upper + 1, len(column)):
            column[upper], column[lower] = column[lower], column[upper]
            now = _crossing_cost(table, near)
            if now < tangle - 1e-9:  # gains at the level of rounding could alternate for ever
                tangle, swapped = now, True
            else:
                column[upper], column[lower] = column[lower], column[upper]
    return swapped


def _ranks(table: Sequence[Sequence[SankeySpot]]) -> dict[SankeySpot, float]:
    return {spot: (at + 0.5) / len(column) for column in table for at, spot in enumerate(column)}


def _crossing_cost(table: Sequence[Sequence[SankeySpot]], columns: range) -> float:
    """Return the cost of crossings within a range of columns; each costs the product of both widths plus a constant."""
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
        # a return band crosses all bands above it in its column
        for spot in table[at]:
            for turning, after in ((spot.after, True), (spot.before, False)):
                width = sum(piece.width for piece in turning if piece.back)
                for above in table[at][: places[spot]] if width else ():
                    passed = [piece.width for piece in (above.after if after else above.before) if not piece.back]
                    total += sum(passed) * width + _CROSSING * len(passed)
    return total


_HEIGHT_SWEEPS = 24


def settle_heights(table: Sequence[list[SankeySpot]]) -> None:
    """Set the tops of all spots and bands in place, so that bands are level where possible."""
    for column in table:
        y = 0.0
        for spot in column:
            y += spot.above
            spot.top = y
            y += spot.height + spot.below
    for sweep in range(4 * _HEIGHT_SWEEPS):
        forth = sweep % 2 == 0
        for column in table if forth else reversed(table):
            _set_band_tops(table)
            # first sweeps level the bands of one side for a rough fit, later ones those of both sides
            wanted = [
                _level_top(spot, sweep >= _HEIGHT_SWEEPS or forth, sweep >= _HEIGHT_SWEEPS or not forth)
                for spot in column
            ]
            for spot, top in zip(column, _separated_tops(column, wanted), strict=True):
                spot.top = top
    _set_band_tops(table)


def _level_top(spot: SankeySpot, before: bool, after: bool) -> tuple[float, float]:
    """Return the top [in] at which the bands of a box would be level, and the total weight of these bands.

    before, after   True to include the bands on the left side or on the right side
    """
    shift = weight = 1e-9
    for sense, pieces in ((1, spot.before if before else ()), (-1, spot.after if after else ())):
        for piece in pieces:
            if not piece.back:
                passing = (piece.source.node is None) + (piece.target.node is None)
                force = (1.0, 2.0, 8.0)[passing] * (piece.width + 0.02)
                shift += sense * force * (piece.start - piece.end)
                weight += force
    return spot.top + shift / weight, weight


def _separated_tops(column: Sequence[SankeySpot], wanted: Sequence[tuple[float, float]]) -> list[float]:
    """Return separated tops of the spots of a column [in], close to the wanted tops (weighted isotonic regression)."""
    import numpy as np
    from scipy.optimize import isotonic_regression

    steps = [one.height + one.below + other.above for one, other in pairwise(column)]
    offsets = np.cumsum([0.0, *steps])
    tops, weights = np.array(wanted).T
    return list(map(float, isotonic_regression(tops - offsets, weights=weights).x + offsets))


def _set_band_tops(table: Sequence[Sequence[SankeySpot]]) -> None:
    """Set the tops of both ends of all bands in place, return bands first, in the order of their opposite ends."""
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


Width = Callable[[PowerNode, Fraction], float]


def lay_out_sankey(flow: PowerFlow, name: Width, loss: Width, minimum: float) -> SankeyLayout:
    """Return the positions and sizes of all parts of a power flow [in].

    name      function that returns the width of the text above a node, given the power that passes through the node
    loss      function that returns the width of the text below a node, given the power lost there
    minimum   minimum width of the layout
    """
    sheds, streams = collapsed(flow)
    ahead, back = direct(streams)
    columns = find_columns(ahead)
    through: dict[PowerNode, Fraction] = {}
    for node in columns:
        given = sum((s.power for s in streams if s.source == node), Fraction(0)) + sheds.get(node, Fraction(0))
        through[node] = max(given, sum((s.power for s in streams if s.target == node), Fraction(0)))
    # the scale is limited by the fullest column and by the return bands
    sums = [Fraction(0)] * (max(columns.values()) + 1)
    for node, at in columns.items():
        sums[at] += through[node]
    scale = TALL / float(max(sums))
    if returning := float(sum((stream.power for stream in back), Fraction(0))):
        scale = min(scale, _BACK / returning)
    spots = {}
    for node, at in columns.items():
        lost = sheds.get(node, Fraction(0))
        spot = spots[node] = SankeySpot(node, at, float(through[node]) * scale, through[node], float(lost) * scale)
        spot.left = spot.right = name(node, through[node]) / 2
        if lost:
            middle, half = spot.width / 2 + BEND + spot.shed / 2, loss(node, lost) / 2
            spot.left, spot.lost = max(spot.left, half - middle), half + middle
    bands, passing = make_bands(spots, ahead, back, scale)
    every = [*spots.values(), *passing]
    table = [[spot for spot in every if spot.column == at] for at in range(max(columns.values()) + 1)]
    order_columns(table)
    settle_heights(table)
    lanes, gaps = turns(table, [band[0] for band in bands if band[0].back])
    x = abscissae(table, gaps, minimum)
    high = min([spot.top - spot.above for spot in every] + [turn.lane for turn in lanes])
    low = max(spot.top + spot.height + spot.below for spot in every)
    edge = max(max(spot.right, spot.lost) for spot in table[-1]) + 0.1
    leading = [band for band in bands if not band[0].back]
    return SankeyLayout(every, leading, lanes, x, scale, sheds, high, x[-1] + edge, low - high)
