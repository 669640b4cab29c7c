"""Where the parts of a picture of power flow stand: columns from where power enters, bands between them.

Lengths are in inches, x to the right and y down. A band is a stream; its width is its power. Bands that close a loop
run back above everything else.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from geartrain.plot.placing.across import abscissae, turns
from geartrain.plot.placing.columns import TALL, collapsed, direct, find_columns, find_scale, make_bands
from geartrain.plot.placing.heights import settle
from geartrain.plot.placing.order import order
from geartrain.plot.placing.parts import BEND, DROP, NAME, TURN, Piece, Placed, Spot, Turn
from geartrain.torques.flowing import Node, PowerFlow

__all__ = ["BEND", "DROP", "NAME", "TALL", "TURN", "Piece", "Placed", "Spot", "Turn", "place"]

Width = Callable[[Node, Fraction], float]


def place(flow: PowerFlow, name: Width, loss: Width, least: float) -> Placed:
    """All parts of a flow in their places.

    name    width of the words above a node that some power passes; `loss`, of those below one that loses some power
    least   width of the whole at least
    """
    sheds, streams = collapsed(flow)
    ahead, back = direct(streams)
    columns = find_columns(ahead)
    through: dict[Node, Fraction] = {}
    for node in columns:
        given = sum((s.power for s in streams if s.source == node), Fraction(0)) + sheds.get(node, Fraction(0))
        through[node] = max(given, sum((s.power for s in streams if s.target == node), Fraction(0)))
    scale = find_scale(columns, through, back)
    spots = {}
    for node, at in columns.items():
        lost = sheds.get(node, Fraction(0))
        spot = spots[node] = Spot(node, at, float(through[node]) * scale, through[node], float(lost) * scale)
        spot.left = spot.right = name(node, through[node]) / 2
        if lost:
            middle, half = spot.width / 2 + BEND + spot.shed / 2, loss(node, lost) / 2
            spot.left, spot.right = max(spot.left, half - middle), max(spot.right, half + middle)
    bands, passing = make_bands(spots, ahead, back, scale)
    every = [*spots.values(), *passing]
    table = [[spot for spot in every if spot.column == at] for at in range(max(columns.values()) + 1)]
    order(table)
    settle(table)
    lanes, gaps = turns(table, [band[0] for band in bands if band[0].back])
    x = abscissae(table, gaps, least)
    high = min([spot.top - spot.above for spot in every] + [turn.lane for turn in lanes])
    low = max(spot.top + spot.height + spot.below for spot in every)
    edge = max(spot.right for spot in table[-1]) + 0.1
    leading = [band for band in bands if not band[0].back]
    return Placed(every, leading, lanes, x, scale, sheds, high, x[-1] + edge, low - high)
