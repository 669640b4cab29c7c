"""What nodes and edges of `train.graph` carry, against the declaration; and that nothing is made before it is read."""

from __future__ import annotations

import copy
import pickle
from fractions import Fraction
from math import cos, pi, radians
from typing import Any

import networkx as nx
import pytest
import shipped
from commands import imported_by
from reference_solver import find_carrier

import geartrain
from geartrain import GearTrain, load
from geartrain.analysis import build_train_graph
from geartrain.errors import DeclarationError, QuestionError
from geartrain.scene import ManufacturingSizes, SolidModel
from geartrain.workshop import train_file

OF_LINKS = {"declared", "frame", "wheels", "reference", "speed"}
OF_EDGES = {
    *("kind", "label", "declared", "axis"),
    *("circuit", "carrier", "ratio", "form", "transmission", "mesh", "efficiency"),
}
SLOW_LOSSES = {"longcase-clock-bs978"}  # whose efficiencies come from the contact of outlines: seconds


def turning_graph(train: GearTrain) -> nx.Graph:
    graph = nx.Graph()
    for joint in train.declaration.revolutes:
        graph.add_edge(*joint.pair, axis=joint.axis)
    return graph


@pytest.mark.parametrize("name", shipped.every_train())
def test_every_link_and_pair_of_a_shipped_train_carries_what_is_declared(name: str) -> None:
    train = shipped.train(name)
    if train.declaration.slides:
        pytest.skip("links slide")
    declared, turning = train.declaration, turning_graph(train)
    graph = train.graph
    assert isinstance(graph, nx.MultiGraph)
    assert train.graph is graph
    assert graph.graph["state"] == next(iter(declared.states), None)
    assert list(graph) == list(declared.links)
    for link, data in graph.nodes(data=True):
        assert set(data) == OF_LINKS
        assert data["declared"] is declared.links[link]
        assert data["wheels"] == declared.links[link].wheels
        assert data["frame"] == (link == declared.frame)
        assert data["reference"] == holder(turning, link, declared.frame)
    gears = {gear.name: gear for gear in declared.gears}
    couplings = {row: each for each in declared.couplings for row in each.row_names}
    seen = []
    for first, second, data in graph.edges(data=True):
        assert set(data) == OF_EDGES
        if data["kind"] == "revolute":
            assert {first, second} == set(data["declared"].pair)
            assert data["axis"] == data["label"] == data["declared"].axis
            assert not {data[key] for key in ("circuit", "carrier", "ratio", "form", "mesh", "efficiency")} - {None}
            continue
        seen.append(data["label"])
        circuit = data["circuit"]
        if data["kind"] == "belt":
            continue
        assert circuit.id == data["label"]
        assert {first, second} == {circuit.i, circuit.j}
        assert data["carrier"] == find_carrier(turning, first, second)
        path = nx.shortest_path(turning, circuit.i, circuit.j)
        assert data["axis"] == (turning.edges[path[:2]]["axis"], turning.edges[path[-2:]]["axis"])
        if data["kind"] == "gear":
            gear = gears[data["label"]]
            (i, wheel_i), (j, wheel_j) = (declared.wheels[wheel] for wheel in gear.pair)
            assert data["declared"] is gear
            assert (circuit.i, circuit.j) == (i, j)
            assert abs(data["ratio"]) == Fraction(wheel_j.count or 0, wheel_i.count or 0)
            if not declared.axes:
                assert (data["ratio"] > 0) == (wheel_i.internal or wheel_j.internal)
            assert data["form"] is (declared.tooth_form if gear.tooth_form is None else gear.tooth_form)
        else:
            coupling = couplings[data["label"]]
            assert data["declared"] is coupling
            assert (circuit.j, circuit.i) == coupling.ends[:2]
            pins = data["kind"].startswith("pin") or data["kind"] == "parallel"
            assert data["ratio"] == ((data["kind"] != "pin_follower") if pins else coupling.mean)
            assert data["form"] is None
    assert sorted(seen) == sorted([*gears, *couplings])


def holder(turning: nx.Graph, link: str, frame: str) -> str | None:
    """The link that holds an axis: past all joints of that axis, on the way to the frame."""
    if link == frame:
        return None
    path = nx.shortest_path(turning, link, frame)
    axis, at = turning.edges[path[:2]]["axis"], 1
    while at + 1 < len(path) and turning.edges[path[at : at + 2]]["axis"] == axis:
        at += 1
    return str(path[at])


@pytest.mark.parametrize("name", shipped.every_train())
def test_speeds_of_a_graph_are_those_of_its_state(name: str) -> None:
    train = shipped.train(name)
    for state in train.states or (None,):
        answer, graph = train.solve(state), build_train_graph(train.mechanics, state)
        assert dict(graph.nodes(data="speed")) == {link: answer.speeds.get(link) for link in graph}
        if answer.method != "exact" or train.declaration.axes:
            continue
        for *_, data in graph.edges(data=True):
            circuit = data["circuit"]
            links = circuit and (circuit.i, circuit.j, *circuit.subtracted)
            speeds = links and [graph.nodes[link]["speed"] for link in links]
            if speeds and None not in speeds:
                assert speeds[0] - speeds[2] == data["ratio"] * (speeds[1] - speeds[3])


@pytest.mark.parametrize("name", shipped.every_train(name for name in shipped.trains() if name not in SLOW_LOSSES))
def test_meshes_and_efficiencies_are_those_in_force(name: str) -> None:
    train = shipped.train(name)
    if train.declaration.tooth_form is None and not any(gear.tooth_form for gear in train.declaration.gears):
        assert not train.meshes
    friction = train.declaration.friction is not None
    for *_, data in train.graph.edges(data=True):
        if data["kind"] != "gear":
            continue
        gear, mesh = data["declared"], data["mesh"]
        assert (mesh is None) == (data["form"] is None or data["form"].form == "ideal")
        if mesh is not None:
            assert mesh.gear is gear
            assert mesh.tooth_form is data["form"]
            assert data["mesh"] is mesh
        ahead, back = data["efficiency"]
        if gear.efficiency is not None:
            assert (ahead, back) == (gear.efficiency.forward.base, gear.efficiency.backward.base)
        elif mesh is None and gear.friction and name == "crossed-helical":
            # flanks that slide along each other: (cos 20 - mu tan 45) / (cos 20 + mu tan 45)
            mu, across = 0.1, cos(radians(20))
            assert float(ahead) == float(back) == pytest.approx((across - mu) / (across + mu), rel=1e-14)
        elif mesh is None or not (gear.friction or friction or mesh.computes_losses):
            assert (ahead, back) == (1, 1)
        else:
            for found, wheel in zip((ahead, back), gear.pair, strict=True):
                mean = mesh.efficiency(wheel).mean
                assert float(found) == pytest.approx(0 if mean is None else mean, abs=1e-12)


def test_a_pin_with_dimensions_is_its_mesh() -> None:
    graph = load("freeth-2006").graph
    pins = [data for *_, data in graph.edges(data=True) if data["kind"] == "pin_and_slot"]
    assert pins
    for data in pins:
        assert data["mesh"].coupling is data["declared"]
        assert data["mesh"].transmission.e > 0


def test_nothing_is_made_before_it_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*_: object, **__: object) -> Any:
        raise AssertionError("made unasked")

    train = GearTrain(load("pennestri-2002-teeth").declaration)
    monkeypatch.setattr("geartrain.kinematics.train_kinematics.find_circuits", never)
    monkeypatch.setattr("geartrain.dynamics.gear_meshes.find_meshes", never)
    monkeypatch.setattr("geartrain.kinematics.train_kinematics.TrainKinematics.solve", never)
    graph = train.graph
    assert {data["kind"] for *_, data in graph.edges(data=True)} == {"revolute", "gear"}
    assert {data["form"].form for *_, data in graph.edges(data=True) if data["form"]} == {"triangular"}
    for kind in ("dot", "graphml"):
        assert b"G18" in train_file(SolidModel(train, ManufacturingSizes()), kind)
    assert nx.is_connected(graph)
    assert nx.shortest_path(graph, "2", "3") == ["2", "3"]
    with pytest.raises(AssertionError, match="made unasked"):
        graph.edges["2", "3", "G1"]["ratio"]
    with pytest.raises(AssertionError, match="made unasked"):
        graph.nodes["2"]["speed"]


def test_a_graph_whose_ratios_are_read_brings_neither_teeth_nor_scipy() -> None:
    code = "import geartrain; g = geartrain.load('pennestri-2002-teeth').graph; list(g.edges(data='ratio'))"
    used = imported_by(code)
    assert "networkx" in used
    assert "scipy" not in used


def test_a_train_without_circuits_has_a_graph_still() -> None:
    """No carrier can be found for this pair: that is said by what needs one."""
    train = GearTrain.declare(
        {
            "links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"q": 30}}},
            "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "A"}],
            "gears": [{"id": "G", "pair": ["p", "q"]}],
            "inputs": {"a": 1},
        }
    )
    edge = train.graph.edges["a", "b", "G"]
    assert (edge["kind"], edge["form"], edge["declared"].pair) == ("gear", None, ("p", "q"))
    assert b'"G' in train_file(SolidModel(train, ManufacturingSizes()), "dot")
    with pytest.raises(DeclarationError, match="coaxial"):
        edge["carrier"]


def test_a_state_that_there_is_not_is_refused() -> None:
    with pytest.raises(QuestionError, match="no state '9'"):
        build_train_graph(load("zf-8hp70").mechanics, "9")
    with pytest.raises(QuestionError):
        build_train_graph(load("zf-8hp70").mechanics)
    assert load("zf-8hp70").graph.graph["state"] == "1"


def test_every_way_of_networkx_to_read_an_attribute_finds_its_value() -> None:
    graph = load("planetary-24-18-60").graph
    ratios = {"s~p": Fraction(-18, 24), "p~ring": Fraction(60, 18)}
    wanted = {(u, v, key): ratios.get(key) for u, v, key in graph.edges(keys=True)}
    assert nx.get_edge_attributes(graph, "ratio") == wanted
    assert {key: ratio for *_, key, ratio in graph.edges(keys=True, data="ratio") if ratio} == ratios
    assert nx.get_node_attributes(graph, "speed")["carrier"] == Fraction(2, 7)
    for other in (graph.copy(), nx.Graph(graph), nx.MultiGraph(graph), copy.deepcopy(graph), graph.to_directed()):
        assert other.nodes["carrier"]["speed"] == Fraction(2, 7)
        for link, data in other.nodes(data=True):
            assert [*data.values()] == [graph.nodes[link][key] for key in data], "no value is left to compute"
    kept = pickle.loads(pickle.dumps(graph))
    assert nx.get_edge_attributes(kept, "ratio") == wanted
    part = graph.edge_subgraph([edge for edge in graph.edges(keys=True) if edge[2] in ratios])
    assert {data["ratio"] for *_, data in part.edges(data=True)} == set(ratios.values())
    with pytest.raises(KeyError):
        graph.edges["frame", "planet", "p~ring"]["colour"]


def test_a_user_may_add_attributes_to_a_graph() -> None:
    graph = geartrain.load("worm").graph
    for colour in ("red", "blue"):
        graph.nodes["wheel"]["colour"] = colour
        nx.set_edge_attributes(graph, 7, "weight")
    assert graph.nodes["wheel"].pop("colour") == "blue"
    assert [weight for *_, weight in graph.edges(data="weight")] == [7] * len(graph.edges)
    assert geartrain.load("worm").graph.nodes["wheel"].get("colour", "none") == "none"


def test_a_graph_that_would_differ_from_its_train_is_refused_with_what_changes_the_train() -> None:
    graph = geartrain.load("planetary-24-18-60").graph
    assert nx.is_frozen(graph)
    edge = graph.edges["planet", "sun", "s~p"]
    changes = [
        lambda: graph.add_edge("sun", "carrier"),
        lambda: graph.add_node("more"),
        lambda: graph.remove_edge("planet", "sun", "s~p"),
        lambda: graph.remove_node("sun"),
        lambda: graph.add_edges_from([("sun", "carrier")]),
        graph.clear,
        lambda: edge.__setitem__("ratio", 7),
        lambda: edge.update(ratio=7),
        lambda: edge.pop("mesh"),
        lambda: edge.__delitem__("declared"),
        lambda: edge.__ior__({"form": None}),
        edge.clear,
        edge.popitem,
        lambda: nx.set_node_attributes(graph, 0, "speed"),
    ]
    for change in changes:
        with pytest.raises(QuestionError, match=r"`with_teeth` or `with_changes`"):
            change()
    assert edge["ratio"] == Fraction(-18, 24)
    assert len(graph) == 4
    copied = graph.copy()
    copied.remove_node("sun")
    copied.edges["planet", "frame", "p~ring"]["ratio"] = 7
    assert (len(copied), graph.edges["planet", "frame", "p~ring"]["ratio"]) == (3, Fraction(60, 18))


def test_edges_have_the_transmission_function_in_force() -> None:
    error = {"over": "driver_turn", "harmonics": [[1, "1 deg"]]}
    train = GearTrain.declare(
        {
            "links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"q": 30, "r": 12}}, "c": {}, "d": {}},
            "revolutes": {axis: ["frame", axis] for axis in "abcd"},
            "gears": [{"pair": ["p", "q"], "tooth_form": {"form": "table", "error": error}}],
            "couplings": [
                {"kind": "pin_and_slot", "pin": "b", "slot": "c", "pin_radius": "9 mm", "offset": "1 mm"},
                {"kind": "parallel", "pin": "c", "slot": "d"},
            ],
            "inputs": {"b": 1},
        }
    )
    law = train.graph.edges["a", "b", "p~q"]["transmission"]
    assert (law.ratio, law.period) == (Fraction(3, 2), pytest.approx(2 * pi * 2 / 3))  # the second wheel drives
    assert train.graph.edges["b", "c", "b~c"]["transmission"].ratio == 1
    assert train.graph.edges["c", "d", "c~d"]["transmission"].error_range() == (0, 0)
    ideal = train.with_tooth_form("ideal").graph.edges["a", "b", "p~q"]["transmission"]
    assert (ideal.ratio, ideal.period) == (Fraction(2, 3), 2 * pi / 20)
