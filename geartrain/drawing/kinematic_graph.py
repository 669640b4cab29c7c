"""Kinematic graph of a train: links as vertices, turning pairs as thin edges, gear pairs as heavy edges.

Edges of turning pairs are labelled with their axis. The style follows Buchsbaum and Freudenstein (1970), Synthesis of
kinematic structure of geared kinematic chains.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.analysis.gear_train import GearTrain
from geartrain.drawing.arrangement import Box, LabelSpace, settle, text_box, text_width
from geartrain.drawing.style import (
    BLACK,
    BLUE,
    FINE,
    GREY,
    PURPLE,
    RED,
    SMALL,
    Axes,
    Circle,
    Figure,
    Line2D,
    Path,
    PathPatch,
    Rectangle,
    sheet,
    title_of,
    too_many,
    write,
)
from geartrain.scene.palette import Dash

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_MOST = 150  # maximum number of links on a page
_EDGE, _HUB = 1.05, 0.055  # inches: length of an edge, and addition for each further edge at its ends
_VERTEX_DISTANCE = 0.33  # inches: wanted distance of an edge from vertices that are not its ends
_PENALTY = 6.0  # penalty per inch of missing distance, in inches of bend
_SPREAD = 3.0  # inches: addition to the edge lengths of small graphs, divided by the number of links
_BENDS = [0.0, *(side * size for size in (0.15, 0.3, 0.5, 0.8, 1.2, 1.7) for side in (1, -1))]
_SHORT = 4  # letters of the longest name that fits into a vertex
_TRACED = 81  # sampled points per edge, from which labels of other edges keep off
_LABEL_MARGIN = 0.03  # inches between two labels
_EDGE_MARGIN = 0.03  # inches between a label and other edges
_SHARES = tuple(share / 100 for share in range(14, 87, 3))  # relative positions of a label along its edge
_EDGE_STYLES: dict[str, tuple[float, Dash, str]] = {
    "revolute": (0.9, "-", GREY),
    "prismatic": (0.9, (0, (1, 2)), GREY),
    "gear": (3.2, "-", BLUE),
    "coupling": (2.2, (0, (4, 2)), PURPLE),
}
"""Line width [pt], dash pattern and colour of an edge, keyed by the kind of the edge."""
_JOINTS = ("revolute", "prismatic")
# inches: offsets of a label next to its edge
_LABEL_OFFSETS = (0.0, 0.12), (0.0, -0.12), (0.2, 0.06), (-0.2, -0.06), (0.0, 0.24), (0.0, -0.24)
_NAME = 8.5  # points: a name next to its vertex
_INNER_NAME = 9  # points: a name in its vertex
_SMALL, _LARGE = 0.11, 0.19  # inches: half width of a vertex with its name outside, minimum with its name inside
_RIM, _HEAD, _FOOT = 0.75, 0.75, 0.55


@dataclass(frozen=True, slots=True)
class GraphEdge:
    """Edge of a kinematic graph: two links, and the joint, gear pair or coupling between them."""

    ends: tuple[str, str]
    kind: str
    """Kind of the edge: revolute, prismatic, gear or coupling."""
    label: str
    """Axis of a joint, or name of a gear pair or coupling."""
    broken: bool = False


def edges_of(train: GearTrain, broken: Sequence[str] = ()) -> list[GraphEdge]:
    """Return an edge for each joint, gear pair and coupling. `broken` contains the names of pairs and couplings in
    loops that cannot turn.
    """
    declared = train.declaration
    wheels = declared.wheels
    found = [GraphEdge(joint.pair, "revolute", joint.axis) for joint in declared.revolutes]
    found += [GraphEdge(slide.pair, "prismatic", slide.axis) for slide in declared.slides]
    for gear in declared.gears:
        ends = (wheels[gear.pair[0]][0], wheels[gear.pair[1]][0])
        found.append(GraphEdge(ends, "gear", gear.name, gear.name in broken))
    for coupling in declared.couplings:
        for row in coupling.rows(wheels):
            found.append(GraphEdge((row.driver, row.driven), "coupling", row.id, row.id in broken))
    return found


def graph_figure(train: GearTrain, state: str | None = None, labels: bool = True) -> Figure:
    """Return a figure of the kinematic graph of a train, in which faulty loops are red.

    Raise `QuestionError` if there are too many links.
    """
    declared = train.declaration
    links = list(declared.links)
    too_many(train, len(links), _MOST, "links")
    broken = {
        pair
        for loop in train.solve(train.declaration.state_or_first(state)).verdict.loops
        if not loop.closes
        for pair in loop.pairs
    }
    edges = edges_of(train, tuple(broken))
    places = _places(links, edges)
    low, high = places.min(0), places.max(0)
    width, height = high - low + 2 * _RIM
    width = max(float(width), 6.0)
    shift = np.array([width / 2, _FOOT + _RIM]) - np.array([(low[0] + high[0]) / 2, low[1]])
    figure, axes = sheet(width, float(height) + _HEAD + _FOOT - 0.3, title_of(declared.name, declared.title))
    at = {link: (float(x), float(y)) for link, (x, y) in zip(links, places + shift, strict=True)}
    beside = max(map(len, links)) > _SHORT
    inner = max(_LARGE, *(text_width(link, _INNER_NAME, "bold") / 2 + 0.05 for link in links))
    curves = _curves(edges, at)
    for edge, curve in zip(edges, curves, strict=True):
        _draw_edge(axes, edge, curve)
    room, traces = LabelSpace(), _Traces.of(edges, curves)
    outside = [link for link in links if beside or link == declared.frame]  # text over hatching is illegible
    half = {link: _SMALL if link in outside else inner for link in links}
    for link in links:
        room.take((*at[link], 2 * half[link], 2 * half[link]))
    for link in links:
        _draw_vertex(axes, link, at, link == declared.frame, half[link])
        if link in outside:
            _name_vertex(axes, link, at, edges, traces, room)
        else:
            write(axes, *at[link], link, fontweight="bold", fontsize=_INNER_NAME)
    if labels:
        _draw_labels(axes, edges, curves, traces, room)
    figure.legend(handles=list(_legend(edges)), loc="lower center", ncols=5, fontsize=SMALL - 1, frameon=False)
    return figure


# -------------------------------------------------------------------------------------------------------------- placing


def graph_layout(train: GearTrain) -> tuple[dict[str, tuple[float, float]], list[tuple[GraphEdge, Floats]]]:
    """Return the positions of links [in], and the edges with their curves (3, 2): start, control point and end."""
    links, edges = list(train.declaration.links), edges_of(train)
    at = {link: (float(x), float(y)) for link, (x, y) in zip(links, _places(links, edges), strict=True)}
    return at, list(zip(edges, _curves(edges, at), strict=True))


def _places(links: Sequence[str], edges: Sequence[GraphEdge]) -> Floats:
    """Return the positions (n, 2) of the links [in], rotated so that the longer side of the graph is horizontal."""
    degree = dict.fromkeys(links, 0)
    for edge in edges:
        for end in edge.ends:
            degree[end] += 1
    pairs = [edge.ends for edge in edges]
    minimum = _EDGE + _SPREAD / len(links)
    lengths = {
        edge.ends: max(
            minimum + _HUB * max(sum(degree[end] for end in edge.ends) - 6, 0), text_width(edge.label) + 0.55
        )
        for edge in edges
    }
    places = settle(links, pairs, lengths)
    middle = places - places.mean(0)
    # principal axes; the signs of singular vectors are arbitrary and are fixed below
    _, _, turned = np.linalg.svd(middle, full_matrices=False)
    flat = middle @ turned.T if len(links) > 2 else middle
    signs = np.where(flat[np.abs(flat).argmax(0), [0, 1]] < 0, -1.0, 1.0) if len(links) > 2 else 1.0
    return np.asarray(np.round(flat * signs, 3))  # coarser than rounding errors, so that all machines agree


def _curves(edges: Sequence[GraphEdge], at: Mapping[str, tuple[float, float]]) -> list[Floats]:
    """Return the curve of every edge; edges between the same two links have different curvatures."""
    turns: dict[frozenset[str], int] = {}
    found = []
    for edge in edges:
        turn = turns[frozenset(edge.ends)] = turns.get(frozenset(edge.ends), -1) + 1
        found.append(_curve(edge, at, turn))
    return found


def _curve(edge: GraphEdge, at: Mapping[str, tuple[float, float]], turn: int) -> Floats:
    """Return the curve (3, 2) of an edge (start, control point, end), bent only as needed to avoid other vertices.

    turn   number of earlier edges between the same links, which are less bent
    """
    start, end = (np.array(at[link]) for link in edge.ends)
    along = end - start
    normal = np.array([-along[1], along[0]]) / max(float(hypot(*along)), 1e-9)  # coincident ends: no bend
    others = np.array([place for link, place in at.items() if link not in edge.ends]).reshape(-1, 2)
    trials = [(bend, np.array([start, (start + end) / 2 + 2 * bend * normal, end])) for bend in _BENDS[turn:]]
    costs = [abs(bend) + _PENALTY * max(_VERTEX_DISTANCE - _clearance(curve, others), 0.0) for bend, curve in trials]
    return trials[int(np.argmin(costs))][1]


def _clearance(curve: Floats, others: Floats) -> float:
    if not len(others):
        return np.inf
    points = np.array([_point(curve, share) for share in np.linspace(0.05, 0.95, 25)])
    return float(np.sqrt(((points[:, None] - others[None]) ** 2).sum(2)).min())


def _point(curve: Floats, share: float) -> Floats:
    """Return the point of a quadratic Bezier curve at the parameter `share`, from 0 to 1."""
    rest = 1 - share
    return np.asarray(rest**2 * curve[0] + 2 * rest * share * curve[1] + share**2 * curve[2])


# -------------------------------------------------------------------------------------------------------------- drawing


def _draw_edge(axes: Axes, edge: GraphEdge, curve: Floats) -> None:
    width, style, color = _EDGE_STYLES[edge.kind]
    color = RED if edge.broken else color
    path = Path(curve, [Path.MOVETO, Path.CURVE3, Path.CURVE3])
    axes.add_patch(
        PathPatch(
            path,
            facecolor="none",
            edgecolor=color,
            linewidth=width,
            linestyle=style,
            capstyle="butt",
            zorder=2 if edge.kind in _JOINTS else 3,
            gid=f"{edge.kind} {edge.label}",
        )
    )


@dataclass(frozen=True, slots=True)
class _Traces:
    """Points sampled along the curve of each edge, with the area of ink that each point represents."""

    points: Floats
    """Positions of the points [in]. Shape (edges, points, 2)."""
    ink: Floats
    """Inked area that each point of an edge represents, length [in] times line width [pt]. Shape (edges,)."""

    @classmethod
    def of(cls, edges: Sequence[GraphEdge], curves: Sequence[Floats]) -> _Traces:
        points = np.array([[_point(curve, share) for share in np.linspace(0, 1, _TRACED)] for curve in curves])
        steps = np.sqrt((np.diff(points, axis=1) ** 2).sum(2)).mean(1)
        return cls(points, steps * [_EDGE_STYLES[edge.kind][0] for edge in edges])

    def hidden(self, box: Box, own: int | None = None) -> float:
        """Return the drawn area [in pt] that a box with a margin would hide, except the area of the edge `own`."""
        inside = (np.abs(self.points - box[:2]) < np.array(box[2:]) / 2 + _EDGE_MARGIN).all(2).sum(1)
        ink = inside * self.ink
        return float(ink.sum() - (0.0 if own is None else ink[own]))


def _draw_labels(
    axes: Axes, edges: Sequence[GraphEdge], curves: Sequence[Floats], traces: _Traces, room: LabelSpace
) -> None:
    """Draw every edge's label on the edge, close to its middle, where it hides the smallest drawn area of other edges.

    A label is placed next to its edge only if no position on the edge is free.
    """
    spots = [_spots(edge, curve, at, traces) for at, (edge, curve) in enumerate(zip(edges, curves, strict=True))]
    order = sorted(range(len(edges)), key=lambda at: (sum(not ink for ink, _ in spots[at]), at))
    for at in order:
        edge, boxes = edges[at], [box for _, box in sorted(spots[at], key=lambda spot: spot[0])]
        beside = [(x + dx, y + dy, wide, high) for dx, dy in _LABEL_OFFSETS for x, y, wide, high in boxes]
        x, y, _, _ = room.place([*boxes, *beside]) or boxes[0]
        color = RED if edge.broken else _EDGE_STYLES[edge.kind][2]
        style = "italic" if edge.kind in _JOINTS else "normal"
        write(axes, x, y, edge.label, color, 6.0, fontsize=FINE, fontstyle=style, gid=f"label {edge.label}")


def _spots(edge: GraphEdge, curve: Floats, at: int, traces: _Traces) -> list[tuple[float, Box]]:
    """Return possible boxes for the label of the edge `at`, each with the drawn area it would hide [in pt]."""
    found = []
    for share in sorted(_SHARES, key=lambda share: abs(share - 0.5)):
        x, y = map(float, _point(curve, share))
        _, _, wide, high = text_box([edge.label], FINE, x, y)
        box = (x, y, wide + _LABEL_MARGIN, high + _LABEL_MARGIN)
        found.append((traces.hidden(box, at), box))
    return found


def _draw_vertex(axes: Axes, link: str, at: Mapping[str, tuple[float, float]], frame: bool, size: float) -> None:
    """Draw a vertex with the half-width `size`: a circle for a link, or a hatched square for the frame."""
    x, y = at[link]
    style: dict[str, Any] = {
        "facecolor": "white",
        "edgecolor": BLACK,
        "linewidth": 1.3,
        "zorder": 5,
        "gid": f"link {link}",
    }
    if frame:
        axes.add_patch(Rectangle((x - size, y - size), 2 * size, 2 * size, hatch="////", **style))
    else:
        axes.add_patch(Circle((x, y), size, **style))


def _name_vertex(
    axes: Axes,
    link: str,
    at: Mapping[str, tuple[float, float]],
    edges: Sequence[GraphEdge],
    traces: _Traces,
    room: LabelSpace,
) -> None:
    """Draw a link's name next to its vertex, where it hides the smallest drawn area of edges."""
    boxes = []
    for reach in (_SMALL + 0.05, _SMALL + 0.13):
        for dx, dy in _free_sides(link, at, edges):
            _, _, wide, high = text_box([link], _NAME, 0.0, 0.0, "bold")
            lean = 1 if dx > 0.35 else -1 if dx < -0.35 else 0
            x = at[link][0] + reach * dx + lean * wide / 2
            boxes.append((x, at[link][1] + (reach + 0.05) * dy, wide, high))
    boxes.sort(key=lambda box: round(traces.hidden(box), 6))
    x, y, _, _ = room.place(boxes) or boxes[0]
    write(axes, x, y, link, fontweight="bold", fontsize=_NAME, zorder=9)


def _free_sides(
    link: str, at: Mapping[str, tuple[float, float]], edges: Sequence[GraphEdge]
) -> list[tuple[float, float]]:
    """Return sixteen unit directions from a vertex, those with the largest angles from its edges first."""
    here = np.array(at[link])
    mates = [other for edge in edges if link in edge.ends for other in edge.ends if other != link]
    if not mates:
        return [(1.0, 0.0)]
    away = np.array([at[mate] for mate in mates]) - here
    away /= np.maximum(np.sqrt((away**2).sum(1)), 1e-9)[:, None]
    angles = np.arange(16) * np.pi / 8
    sides = np.stack([np.cos(angles), np.sin(angles)], 1)
    # sideways reads better than above; rounding makes ties break by order on every machine
    nearest = np.round((sides @ away.T).max(1) + 0.08 * np.abs(sides[:, 1]), 9)
    return [(float(x), float(y)) for x, y in sides[np.argsort(nearest, kind="stable")]]


def _legend(edges: Sequence[GraphEdge]) -> Iterator[Line2D]:
    kinds = {edge.kind for edge in edges}
    for kind, words in (
        ("revolute", "turning pair, with its axis"),
        ("prismatic", "sliding pair, with its axis"),
        ("gear", "gear pair"),
        ("coupling", "coupling"),
    ):
        if kind in kinds:
            width, dashes, color = _EDGE_STYLES[kind]
            yield Line2D([], [], color=color, linewidth=width, linestyle=dashes, label=words)
    yield Line2D([], [], marker="s", color=BLACK, markerfacecolor="white", linestyle="", label="frame")
    if any(edge.broken for edge in edges):
        yield Line2D([], [], color=RED, linewidth=3.2, label="loop that does not close")
