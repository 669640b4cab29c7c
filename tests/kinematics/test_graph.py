"""The graph, its matrices, and its texts as independent readers see them; the tree and its paths."""

from __future__ import annotations

import itertools
import json
import re
from io import BytesIO
from typing import Any

import networkx as nx
import pytest
from hypothesis import given
from reference_solver import find_carrier, turning_graph
from strategies import Data, trains

from geartrain import GearTrain, load
from geartrain.kinematics.graph import adjacency_labels, adjacency_matrix, to_dot, to_graphml, to_json

PLANETARY = """
frame: "0"
links:
{links}
revolutes:
  - {{pair: [s, "0"], axis: main}}
  - {{pair: ["0", c], axis: main}}
  - {{pair: [p, c], axis: planet}}
gears:
  - {{id: inner, pair: [{inner}]}}
  - {{id: outer, pair: [{outer}]}}
inputs: {{s: 1}}
"""
LINKS = [
    '  "0": {wheels: {r: {teeth: 60, internal: true}}}',
    "  s: {wheels: {zs: 24}}",
    "  c: {}",
    "  p: {wheels: {zp: 18}}",
]


def planetary(frame_at: int = 0, inner: str = "zs, zp", outer: str = "zp, r") -> GearTrain:
    links = LINKS[1:]
    links.insert(frame_at, LINKS[0])
    return load(PLANETARY.format(links="\n".join(links), inner=inner, outer=outer))


@pytest.mark.parametrize("frame_at", [0, 1, 3])
@pytest.mark.parametrize("inner", ["zs, zp", "zp, zs"])
@pytest.mark.parametrize("outer", ["zp, r", "r, zp"])
def test_direction_is_never_read_from_an_undirected_edge(frame_at: int, inner: str, outer: str) -> None:
    train = planetary(frame_at, inner, outer)
    # 24 w_s - 60 w_r ... : the carrier makes 24/(24 + 60) of the sun's turns, whichever link was declared first
    assert train.solve()["c"] * 84 == 24
    graph = train.graph
    for name, pair in (("inner", inner), ("outer", outer)):
        (declared,) = (data["declared"] for *_, data in graph.edges(data=True) if data["label"] == name)
        assert declared.pair == tuple(pair.split(", "))
    exported = {edge["label"]: edge for edge in json.loads(to_json(graph))["edges"]}
    assert [exported["inner"]["first_wheel"], exported["inner"]["second_wheel"]] == inner.split(", ")
    assert [exported["outer"]["first_wheel"], exported["outer"]["second_wheel"]] == outer.split(", ")


def test_a_pin_and_its_slot_are_told_apart_in_every_order() -> None:
    for pin, slot in (("a", "b"), ("b", "a")):
        train = load(
            f"""
            links: {{b: {{}}, frame: {{}}, a: {{}}}}
            revolutes: [{{pair: [frame, b], axis: B}}, {{pair: [a, frame], axis: A}}]
            couplings: [{{kind: pin_follower, pin: {pin}, slot: {slot}}}]
            inputs: {{{pin}: 5}}
            """
        )
        assert train.solve()[slot] == 0
        (edge,) = (e for e in json.loads(to_json(train.graph))["edges"] if e["kind"] == "pin_follower")
        assert (edge["pin"], edge["slot"]) == (pin, slot)


def edges_of(train: GearTrain) -> list[tuple[str, ...]]:
    """What must be in every export: the two links, the kind and the label of every edge, from the declaration."""
    declared = train.declaration
    on = {wheel: link for link, part in declared.links.items() for wheel in part.wheels}
    edges = [(*sorted(joint.pair), "revolute", joint.axis) for joint in declared.revolutes]
    edges += [(*sorted(on[wheel] for wheel in gear.pair), "gear", gear.name) for gear in declared.gears]
    edges += [(*sorted(c.ends[:2]), c.kind, c.name) for c in declared.couplings]
    return sorted(edges)


def sorted_edges(graph: Any) -> list[tuple[str, ...]]:
    return sorted((*sorted((a, b)), d["kind"], d["label"]) for a, b, d in graph.edges(data=True))


QUOTED = r'"((?:[^"\\]|\\.)*)"'


def read_dot(text: str) -> tuple[set[str], list[tuple[str, ...]]]:
    """A small reader of the dot language: quoted nodes, and quoted edges with a label."""

    def plain(name: str) -> str:
        return re.sub(r"\\(.)", r"\1", name)

    nodes = {plain(name) for name in re.findall(rf"^  {QUOTED}(?: \[shape=box\])?;$", text, re.MULTILINE)}
    edges = re.findall(rf"^  {QUOTED} -- {QUOTED} \[label={QUOTED}, [^\]]*\];$", text, re.MULTILINE)
    return nodes, sorted((*sorted((plain(a), plain(b))), plain(label)) for a, b, label in edges)


@given(trains())
def test_the_graph_and_every_export_of_it_have_every_link_joint_pair_and_coupling(data: Data) -> None:
    train = GearTrain.declare(data)
    links, edges = list(data["links"]), edges_of(train)
    graphml = nx.read_graphml(BytesIO(to_graphml(train.graph).encode()))
    assert (list(train.graph), sorted_edges(train.graph)) == (links, edges)
    assert (list(graphml), sorted_edges(graphml)) == (links, edges)
    raw = json.loads(to_json(train.graph))
    assert [node["id"] for node in raw["nodes"]] == links
    assert [node["id"] for node in raw["nodes"] if node["frame"]] == ["frame"]
    assert sorted((*sorted((e["source"], e["target"])), e["kind"], e["label"]) for e in raw["edges"]) == edges
    assert read_dot(to_dot(train.graph)) == (set(links), sorted((a, b, label) for a, b, _, label in edges))


def test_names_with_quotes_and_signs_survive_every_export() -> None:
    odd = 'a"b\\c <&> ω'
    train = GearTrain.declare(
        {"links": {"frame": {}, odd: {}}, "revolutes": [{"pair": ["frame", odd], "axis": 'x"y'}], "inputs": {odd: 1}}
    )
    assert read_dot(to_dot(train.graph)) == ({"frame", odd}, [(odd, "frame", 'x"y')])
    assert set(nx.read_graphml(BytesIO(to_graphml(train.graph).encode()))) == {"frame", odd}
    assert [node["id"] for node in json.loads(to_json(train.graph))["nodes"]] == ["frame", odd]


@given(trains())
def test_the_numeric_adjacency_is_symmetric_and_counts_every_edge(data: Data) -> None:
    train = GearTrain.declare(data)
    matrix, labels = adjacency_matrix(train.graph), adjacency_labels(train.declaration)
    values = matrix.values
    assert (values == values.T).all()
    assert values.sum() == 2 * len(edges_of(train))
    assert not values.diagonal().any()
    assert not values.flags.writeable
    for at, first in enumerate(data["links"]):
        for to, second in enumerate(data["links"]):
            assert len(labels[at][to].split()) == values[at, to] == matrix[first, second]


def test_turning_pairs_and_gear_pairs_are_told_apart_by_labels() -> None:
    train = planetary()
    assert adjacency_matrix(train.graph).values.sum() == 2 * (3 + 2)
    assert adjacency_labels(train.declaration)[0] == ["", "R(main)", "R(main)", "outer"]


@given(trains())
def test_the_carrier_is_where_the_label_changes_on_the_path(data: Data) -> None:
    train, graph = GearTrain.declare(data), turning_graph(data)
    for circuit in train.circuits:
        assert circuit.carrier == find_carrier(graph, circuit.i, circuit.j)
        links, labels = train.kinematics.tree.path(circuit.i, circuit.j)
        assert links == nx.shortest_path(graph, circuit.i, circuit.j)
        assert labels == [graph.edges[step]["axis"] for step in itertools.pairwise(links)]


@given(trains())
def test_turning_edges_form_a_tree_and_each_pair_closes_one_circuit(data: Data) -> None:
    train = GearTrain.declare(data)
    turning = nx.Graph((a, b) for a, b, d in train.graph.edges(data=True) if d["kind"] == "revolute")
    assert nx.is_tree(turning)
    assert len(train.circuits) == train.graph.number_of_edges() - turning.number_of_edges()
