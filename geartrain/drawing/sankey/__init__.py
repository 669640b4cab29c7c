"""Where the parts of a picture of power flow stand: columns from where power enters, bands between them.

Lengths are in inches, x to the right and y down. A band is a stream; its width is its power. Bands that close a loop
run back above everything else.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from geartrain.drawing.sankey.sankey_bands import (
    BEND,
    DROP,
    NAME,
    TURN,
    BandSegment,
    ReturnBand,
    SankeyLayout,
    SankeySpot,
)
from geartrain.drawing.sankey.sankey_columns import (
    TALL,
    abscissae,
    collapsed,
    direct,
    find_columns,
    find_scale,
    make_bands,
    turns,
)
from geartrain.drawing.sankey.sankey_order import order_columns, settle_heights
from geartrain.dynamics import PowerFlow, PowerNode

__all__ = [
    "BEND",
    "DROP",
    "NAME",
    "TALL",
    "TURN",
    "BandSegment",
    "ReturnBand",
    "SankeyLayout",
    "SankeySpot",
    "lay_out_sankey",
]

Width = Callable[[PowerNode, Fraction], float]


def lay_out_sankey(flow: PowerFlow, name: Width, loss: Width, least: float) -> SankeyLayout:
    """All parts of a flow in their places.

    name    width of the words above a node that some power passes; `loss`, of those below one that loses some power
    least   width of the whole at least
    """
    sheds, streams = collapsed(flow)
    ahead, back = direct(streams)
    columns = find_columns(ahead)
    through: dict[PowerNode, Fraction] = {}
    for node in columns:
        given = sum((s.power for s in streams if s.source == node), Fraction(0)) + sheds.get(node, Fraction(0))
        through[node] = max(given, sum((s.power for s in streams if s.target == node), Fraction(0)))
    scale = find_scale(columns, through, back)
    spots = {}
    for node, at in columns.items():
        lost = sheds.get(node, Fraction(0))
        spot = spots[node] = SankeySpot(node, at, float(through[node]) * scale, through[node], float(lost) * scale)
        spot.left = spot.right = name(node, through[node]) / 2
        if lost:
            middle, half = spot.width / 2 + BEND + spot.shed / 2, loss(node, lost) / 2
            spot.left, spot.right = max(spot.left, half - middle), max(spot.right, half + middle)
    bands, passing = make_bands(spots, ahead, back, scale)
    every = [*spots.values(), *passing]
    table = [[spot for spot in every if spot.column == at] for at in range(max(columns.values()) + 1)]
    order_columns(table)
    settle_heights(table)
    lanes, gaps = turns(table, [band[0] for band in bands if band[0].back])
    x = abscissae(table, gaps, least)
    high = min([spot.top - spot.above for spot in every] + [turn.lane for turn in lanes])
    low = max(spot.top + spot.height + spot.below for spot in every)
    edge = max(spot.right for spot in table[-1]) + 0.1
    leading = [band for band in bands if not band[0].back]
    return SankeyLayout(every, leading, lanes, x, scale, sheds, high, x[-1] + edge, low - high)
