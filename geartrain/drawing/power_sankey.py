"""Sankey diagram of power flow: input at the left, shafts and pairs, output at the right, losses downwards."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from textwrap import fill
from typing import Any

from geartrain.drawing.sankey import BEND, DROP, TURN, BandSegment, ReturnBand, SankeyLayout, SankeySpot, lay_out_sankey
from geartrain.drawing.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    LETTER,
    PURPLE,
    RED,
    SKY,
    SMALL,
    TEXT,
    WHITE,
    WIDTH,
    Axes,
    Figure,
    Line2D,
    Patch,
    Path,
    PathPatch,
    Rectangle,
    write,
)
from geartrain.dynamics import PowerFlow, PowerNode, Torques, find_power_flow
from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.exact import percent_of_text, percent_text, watts_text

_FINEST = 0.7  # points: minimum width of a band
_MOST = 300  # maximum number of nodes
_HEAD, _FOOT = 0.6, 0.45  # inches: margins above and below
_MOVE, _LINE, _CURVE, _CLOSE = map(int, (Path.MOVETO, Path.LINETO, Path.CURVE4, Path.CLOSEPOLY))
_ROUND = 0.5523  # control point of a cubic Bezier curve that approximates a quarter circle, divided by its radius
_OPACITY = {SKY: 0.6, PURPLE: 0.6, RED: 0.8}  # in grey, losses, shafts and recirculating power differ


def power_figure(flow: PowerFlow | Torques, title: str, watts: float | None = None) -> Figure:
    """Return a Sankey diagram of the power flow. Bands of recirculating power return above the other bands."""
    if isinstance(flow, Torques):
        flow = find_power_flow(flow)
    if not flow.streams or not flow.power_in:
        what, why = "no power flows through the train", "no load acts on a link that turns"
        raise GearTrainError(Problem(what, why, "declare `loads` on links that turn"))
    if len(flow.nodes) > _MOST:
        what = f"{len(flow.nodes)} shafts and pairs do not fit in a power-flow picture"
        why, fix = f"at most {_MOST} are legible in a picture", "draw a train with fewer shafts and pairs"
        raise GearTrainError(Problem(what, why, fix))
    words = _NodeLabels(flow, watts)
    placed = lay_out_sankey(flow, words.width, words.loss_width, WIDTH)
    title = fill(title, int(placed.width / (TEXT * LETTER)) + 8)
    head = _HEAD + 0.17 * title.count("\n")
    height = placed.height + head + _FOOT
    figure = Figure(figsize=(placed.width, height), dpi=100)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_xlim(0.0, placed.width)
    axes.set_ylim(placed.low + placed.height + _FOOT, placed.low - head)
    axes.set_axis_off()
    for turn in placed.turns:
        _draw_return_band(axes, placed, turn)
    for band in placed.bands:  # circulating power as the upper part, transmitted power as the lower part
        circling = float(band[0].stream.circling) * placed.scale
        for top, width, color in ((0.0, circling, PURPLE), (circling, band[0].width - circling, SKY)):
            if width > 0:
                _ribbon(axes, placed, band, top, width, color)
    for spot in placed.spots:
        if spot.node:
            _draw_node(axes, placed, spot, spot.node, words)
    _write_circulating(axes, placed, flow)
    axes.text(0.1, placed.low - head + 0.12, title, fontsize=TEXT, color=BLACK, va="top", parse_math=False, gid="title")
    figure.legend(handles=list(_legend(placed)), loc="lower center", ncols=6, fontsize=SMALL, frameon=False)
    return figure


class _NodeLabels:
    """Texts at the nodes of a Sankey diagram, with powers as percentages of the power input or in watts."""

    def __init__(self, flow: PowerFlow, watts: float | None) -> None:
        self.whole, self.watts = flow.power_in, watts

    def lines(self, node: PowerNode, power: Fraction) -> tuple[str, str]:
        """Return the two lines of a node's label: its name and its power."""
        amount = percent_text(power / self.whole, 3)
        if node.kind == "bearing":
            return f"bearing {node.name}", amount
        if node.kind in ("in", "out"):
            own = f"{float(power):.4g}" if self.watts is None else watts_text(float(power) * self.watts)
            return f"{node.name} {node.kind}", own if node.kind == "in" else f"{own}, {amount}"
        return node.name, amount

    def width(self, node: PowerNode, power: Fraction) -> float:
        """Return the width of the longer of the two lines of a node's label [in]."""
        return max(map(len, self.lines(node, power))) * SMALL * LETTER

    def loss(self, node: PowerNode, power: Fraction) -> str:
        """Return the label of the power lost at a node."""
        return percent_text(power / self.whole, 3)

    def loss_width(self, node: PowerNode, power: Fraction) -> float:
        """Return the width of the label of the power lost at a node [in]."""
        return len(self.loss(node, power)) * SMALL * LETTER


# --------------------------------------------------------------------------------------------------------------- bands


def _ribbon(
    axes: Axes, placed: SankeyLayout, band: Sequence[BandSegment], shift: float, width: float, color: str
) -> None:
    """Draw one stripe of a band, with a notch where power enters the train and a tip where it leaves.

    shift   distance from the upper edge of the band to the upper edge of the stripe [in]
    width   width of the stripe [in]
    """
    upper: list[tuple[float, float]] = []
    codes: list[int] = []
    for piece in band:
        left = placed.x[piece.source.column] + piece.source.width / 2
        right = placed.x[piece.target.column] - piece.target.width / 2
        middle, start, end = (left + right) / 2, piece.start + shift, piece.end + shift
        upper += [(left, start), (middle, start), (middle, end), (right, end)]
        codes += [_LINE, *[_CURVE] * 3]
    lower = [(x, y + width) for x, y in reversed(upper)]
    depth = min(0.15, width / 2)
    enters, leaves = (end.kind in ("in", "out") for end in (band[0].stream.source, band[0].stream.target))
    (x, y), (far, last) = upper[0], upper[-1]
    tip, notch = far + depth * leaves, x + depth * enters
    points = [*upper, (tip, last + width / 2), *lower, (notch, y + width / 2), upper[0]]
    _fill(axes, points, [_MOVE, *codes[1:], _LINE, *codes, _LINE, _CLOSE], color)


def _fill(axes: Axes, points: list[tuple[float, float]], codes: list[int], color: str, zorder: float = 2.0) -> None:
    look: dict[str, Any] = {"facecolor": color, "edgecolor": color, "linewidth": _FINEST}
    axes.add_patch(PathPatch(Path(points, codes), alpha=_OPACITY[color], zorder=zorder, **look))


def _draw_return_band(axes: Axes, placed: SankeyLayout, turn: ReturnBand) -> None:
    """Draw a band from its source around the top of the diagram back to its target, which is further to the left."""
    piece, w = turn.piece, turn.piece.width
    right = placed.x[piece.source.column] + piece.source.width / 2
    left = placed.x[piece.target.column] - piece.target.width / 2
    inner = _band_edge(right, right + turn.right, left, left - turn.left, piece.start, piece.end, turn.lane + w, TURN)
    outer = _band_edge(
        right, right + turn.right + w, left, left - turn.left - w, piece.start + w, piece.end + w, turn.lane, TURN + w
    )
    points = [*inner, *reversed(outer), inner[0]]
    edge = [*[_LINE, *[_CURVE] * 3] * 4, _LINE]
    _fill(axes, points, [_MOVE, *edge, _LINE, *edge, _CLOSE], PURPLE, 1.0)


def _band_edge(
    right: float, far: float, left: float, near: float, start: float, end: float, lane: float, r: float
) -> list[tuple[float, float]]:
    """Return the points of one edge of a return band [in], with corners rounded to the radius `r`.

    right, left   abscissae of its ends at the source and at the target
    far, near     abscissae of its vertical parts
    start, end    ordinates of its ends
    lane          ordinate of its horizontal part
    """
    k = r * (1 - _ROUND)
    return [
        (right, start),
        (far - r, start), (far - k, start), (far, start - k), (far, start - r),
        (far, lane + r), (far, lane + k), (far - k, lane), (far - r, lane),
        (near + r, lane), (near + k, lane), (near, lane + k), (near, lane + r),
        (near, end - r), (near, end - k), (near + k, end), (near + r, end),
        (left, end),
    ]  # fmt: skip


# --------------------------------------------------------------------------------------------------------------- nodes


def _draw_node(axes: Axes, placed: SankeyLayout, spot: SankeySpot, node: PowerNode, words: _NodeLabels) -> None:
    x = placed.x[spot.column]
    if spot.width:
        pair = node.kind != "shaft"
        axes.add_patch(
            Rectangle(
                (x - spot.width / 2, spot.top),
                spot.width,
                max(spot.height, 0.03),
                facecolor="white" if pair else BLACK,
                edgecolor=BLACK,
                linewidth=1.2,
                zorder=3,
                gid=f"{node.kind} {node.name}",
            )
        )
    name, amount = words.lines(node, spot.power)
    color = {"in": BLUE, "out": GREEN}.get(node.kind, BLACK)
    weight = "normal" if node.kind == "pair" else "bold"
    write(axes, x, spot.top - 0.21, name, color, va="bottom", fontweight=weight, zorder=5)
    write(axes, x, spot.top - 0.05, amount, color if spot.width == 0 else GREY, va="bottom", zorder=5)
    if spot.shed:
        _draw_loss(axes, spot, x + spot.width / 2, words.loss(node, placed.sheds[node]))


def _draw_loss(axes: Axes, spot: SankeySpot, x: float, text: str) -> None:
    """Draw the loss of the node `spot` as a band from its lower right corner, at the abscissa `x`, downwards."""
    w, r, k = spot.shed, BEND, _ROUND
    y = spot.top + spot.height
    far, neck = x + r + w, y + DROP
    middle, wing, tip = x + r + w / 2, max(0.65 * w, 0.05), neck + spot.head
    points = [
        (x, y - w), (x + k * (r + w), y - w), (far, y + r - k * (r + w)), (far, y + r), (far, neck),
        (middle + wing, neck), (middle, tip), (middle - wing, neck), (x + r, neck),
        (x + r, y + r), (x + r, y + r - k * r), (x + k * r, y), (x, y), (x, y - w),
    ]  # fmt: skip
    codes = [_MOVE, *[_CURVE] * 3, *[_LINE] * 6, *[_CURVE] * 3, _CLOSE]
    _fill(axes, points, codes, RED, 4.0)
    write(axes, middle, tip + 0.03, text, RED, va="top", zorder=5)


def _write_circulating(axes: Axes, placed: SankeyLayout, flow: PowerFlow) -> None:
    """Write the circulating power of each loop in the middle of its highest return band."""
    for loop in flow.loops:
        turn = min(
            (turn for turn in placed.turns if turn.piece.stream.source in loop.nodes), key=lambda each: each.lane
        )
        piece = turn.piece
        x = (placed.x[piece.source.column] + placed.x[piece.target.column]) / 2
        text = f"{percent_of_text(loop.power / flow.power_in, 'the power in')} circulates"
        how: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": TEXT, "color": BLACK, "zorder": 5}
        # the box keeps the text readable in print, where the band is hatched
        box = {"boxstyle": "round,pad=0.2", "facecolor": WHITE, "linewidth": 0}
        axes.text(x, turn.lane + piece.width / 2, text, parse_math=False, bbox=box, gid="circulates", **how)


def _legend(placed: SankeyLayout) -> Iterator[Patch | Line2D]:
    yield Patch(facecolor=BLACK, label="shaft")
    yield Patch(facecolor="white", edgecolor=BLACK, label="pair")
    yield Patch(facecolor=SKY, alpha=_OPACITY[SKY], label="power")
    if placed.turns:
        yield Patch(facecolor=PURPLE, alpha=_OPACITY[PURPLE], label="recirculating power")
    if placed.sheds:
        yield Patch(facecolor=RED, alpha=_OPACITY[RED], label="lost in teeth or bearings")
