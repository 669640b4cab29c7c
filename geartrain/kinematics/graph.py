"""Train as a networkx graph, whose edges have the declared objects as data, and adjacency matrix of this graph.

The edges are undirected. The declared object of an edge determines which link has which wheel, or which link has the
pin.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from geartrain.errors import printable
from geartrain.train import Train

if TYPE_CHECKING:
    import networkx as nx

    from geartrain.numerics.labelled_array import LabelledArray

    Graph = nx.MultiGraph[str]


def build_graph(train: Train) -> Graph:
    """Return a graph whose vertices are the links, and whose edges are the turning pairs, sliding pairs, gear pairs and
    couplings.

    Edges have the data `kind` (revolute, prismatic, gear, or the kind of a coupling), `label` (axis, or name of the
    pair) and `declared`, the object of the declaration. The key of an edge is the name of the pair or coupling; joints
    have the keys `revolute 0`, `revolute 1`, `prismatic 0` etc. in the order of the declaration.
    """
    from geartrain.numerics.lazy_graph import LazyGraph

    # a multigraph, because a turning pair and several gear pairs may join the same two links
    graph: Graph = LazyGraph(name=train.name)
    for name, link in train.links.items():
        graph.add_node(name, declared=link, frame=name == train.frame)
    for links, key, kind, label, declared in _edges(train):
        graph.add_edge(*links, key=key, kind=kind, label=label, declared=declared)
    return graph


def _edges(train: Train) -> Iterator[tuple[tuple[str, str], str, str, str, Any]]:
    """Yield, for each edge, its two links, its key, its kind, its label, and its declared object."""
    for at, joint in enumerate(train.revolutes):
        first, second = joint.pair
        yield (first, second), f"revolute {at}", "revolute", joint.axis, joint
    wheels = train.wheels
    for at, slide in enumerate(train.slides):
        first, second = slide.pair
        yield (first, second), f"prismatic {at}", "prismatic", slide.axis, slide
    for gear in train.gears:
        first, second = (wheels[wheel][0] for wheel in gear.pair)
        yield (first, second), gear.name, "gear", gear.name, gear
    for coupling in train.couplings:
        for row in coupling.rows(wheels):
            yield (row.driver, row.driven), row.id, coupling.kind, row.id, coupling


_JOINTS = {"revolute": "R", "prismatic": "P"}
MOST_SQUARE = 48
"""Maximum number of links for which the adjacency matrix is shown by default. The size of the matrix is quadratic in
this number.
"""


def edge_rows(graph: Graph) -> list[tuple[str, str, str, str]]:
    """Return the two links, the kind and the label (name of the axis, pair or coupling) of each edge, in order."""
    return [(first, second, data["kind"], str(data["label"])) for first, second, data in graph.edges(data=True)]


def adjacency_labels(train: Train) -> list[list[str]]:
    """Return the adjacency matrix as text. An entry is `R(axis)` for a turning pair, `P(axis)` for a sliding pair, the
    name of a gear pair or coupling, or "".
    """
    at = {link: position for position, link in enumerate(train.links)}
    cells: list[list[list[str]]] = [[[] for _ in at] for _ in at]
    for (first, second), _, kind, label, _ in _edges(train):
        text = f"{_JOINTS[kind]}({label})" if kind in _JOINTS else label
        cells[at[first]][at[second]].append(text)
        cells[at[second]][at[first]].append(text)
    return [[" ".join(cell) for cell in row] for row in cells]


def adjacency_kinds(train: Train) -> list[list[str]]:
    """Return the kind of the edge between any two links: revolute, prismatic, gear, or the kind of a coupling;
    "several" if there are several edges, "" if there is none.
    """
    at = {link: position for position, link in enumerate(train.links)}
    cells = [["" for _ in at] for _ in at]
    for (first, second), _, kind, _, _ in _edges(train):
        for i, j in ((at[first], at[second]), (at[second], at[first])):
            cells[i][j] = "several" if cells[i][j] else kind
    return cells


def adjacency_matrix(graph: Graph) -> LabelledArray:
    """Return the adjacency matrix. Each entry is the number of edges between two links."""
    import numpy as np

    from geartrain.numerics.labelled_array import labelled_array

    at = {link: position for position, link in enumerate(graph)}
    values = np.zeros((len(at), len(at)), dtype=np.int64)
    for first, second in graph.edges():
        values[at[first], at[second]] += 1
        values[at[second], at[first]] += 1
    return labelled_array(values, link=tuple(at), neighbour=tuple(at))


def to_dot(graph: Graph) -> str:
    """Return the graph as Graphviz text. Turning pairs are thin lines, gear pairs thick lines, couplings dashed lines,
    and the frame is a box.
    """
    lines = [f"graph {_quoted(graph.name)} {{", "  node [shape=circle];"]
    for link, data in graph.nodes(data=True):
        lines.append(f"  {_quoted(link)}{' [shape=box]' if data['frame'] else ''};")
    for first, second, data in graph.edges(data=True):
        style = {"revolute": "penwidth=1", "prismatic": "penwidth=1, style=dotted", "gear": "penwidth=3"}.get(
            data["kind"], "style=dashed, penwidth=2"
        )
        lines.append(f"  {_quoted(first)} -- {_quoted(second)} [label={_quoted(data['label'])}, {style}];")
    return printable("\n".join([*lines, "}"]))


def to_graphml(graph: Graph) -> str:
    """Return the graph as GraphML text. Edges have a kind and a label. Gear pairs also have the names of their wheels,
    and couplings of two links the names of these links by their roles, such as `pin` and `slot`.
    """
    import networkx as nx

    return printable("\n".join(nx.generate_graphml(_plain(graph))))  # XML does not allow control characters


def to_json(graph: Graph) -> str:
    """Return the graph as node-link JSON with the same data as in `to_graphml`."""
    import networkx as nx

    data = nx.node_link_data(_plain(graph), edges="edges")
    text = json.dumps(data, indent=1, ensure_ascii=False)
    # ASCII escapes if names contain control characters, which a terminal would interpret
    return text if printable(text) == text else json.dumps(data, indent=1)


def _plain(graph: Graph) -> Graph:
    import networkx as nx

    plain: Graph = nx.MultiGraph(name=graph.name)
    for link, data in graph.nodes(data=True):
        wheels = " ".join(f"{name}:{wheel.count}" for name, wheel in data["declared"].wheels.items())
        plain.add_node(link, frame=data["frame"], wheels=wheels)
    for first, second, key, data in graph.edges(keys=True, data=True):
        text, declared = {"kind": data["kind"], "label": data["label"]}, data["declared"]
        if data["kind"] == "gear":
            text |= dict(zip(("first_wheel", "second_wheel"), declared.pair, strict=True))
        elif data["kind"] not in _JOINTS and len(declared.ENDS) == 2:
            text |= dict(zip(declared.ENDS, declared.ends, strict=True))
        plain.add_edge(first, second, key=key, **text)
    return plain


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
