"""Graph of a train. The attributes of its links and pairs are computed on first access."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import cached_property, partial
from math import pi
from typing import TYPE_CHECKING, Any, NoReturn

import networkx as nx

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.graph import build_graph
from geartrain.numerics.lazy_graph import Lazy, LazyDict

if TYPE_CHECKING:
    from geartrain.dynamics.gear_meshes import CouplingMesh
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.kinematics.answer import Answer
    from geartrain.kinematics.circuits import Circuit
    from geartrain.kinematics.graph import Graph
    from geartrain.kinematics.judged_outputs import SpeedValue
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.transmission import TransmissionFunction

_OF_PAIRS = ("circuit", "carrier", "ratio", "form", "transmission", "mesh", "efficiency")
_GIVEN = frozenset(("declared", "frame", "wheels", "reference", "speed", "kind", "label", "axis", *_OF_PAIRS))


def _refuse(*_: object, **__: object) -> NoReturn:
    what, why = "the graph of a train cannot be changed", "results of a changed graph would not agree with the train"
    fix = "build another train with `with_teeth` or `with_changes`, or change a copy, `graph.copy()`"
    raise QuestionError(Problem(what, why, fix))


class _Attributes(LazyDict):
    """Attributes of a node or edge of the graph. Attributes that geartrain sets are read-only; users can add others."""

    __slots__ = ()
    clear = popitem = _refuse

    def __setitem__(self, key: str, value: Any) -> None:
        if key in _GIVEN:
            _refuse()
        super().__setitem__(key, value)

    def __delitem__(self, key: str) -> None:
        if key in _GIVEN:
            _refuse()
        super().__delitem__(key)

    def pop(self, key: str, *default: Any) -> Any:
        return _refuse() if key in _GIVEN else super().pop(key, *default)

    def update(self, *others: Any, **more: Any) -> None:
        for key, value in dict(*others, **more).items():
            self[key] = value

    def __ior__(self, others: Any) -> _Attributes:  # type: ignore[override,misc]
        self.update(others)
        return self


def build_train_graph(train: TrainMechanics, state: str | None = None) -> Graph:
    """Build the kinematic graph of a train as a networkx MultiGraph, in which links are nodes, and turning pairs, gear
    pairs and couplings are edges.

    Nodes have the attributes `declared`, `frame` (True for the fixed link), `wheels`, `reference` (the link that
    carries its axis) and `speed`. Edges have the attributes `kind`, `label`, `declared` and `axis`; edges of pairs also
    have `circuit`, `carrier`, `ratio`, `form`, `transmission`, `mesh` and `efficiency` (docs/library.md, 2). Attributes
    that are not declared are computed when they are read, so a graph can also be built for a train whose speeds cannot
    be solved.

    Parameters
    ----------
    train : TrainMechanics
        Mechanics of the train, `GearTrain.mechanics`.
    state : str, optional
        A declared state; None only if the train has no states.

    Returns
    -------
    networkx.MultiGraph
        Read-only graph; a copy of it can be changed.

    Examples
    --------
    >>> import geartrain
    >>> build_train_graph(geartrain.load("planetary-24-18-60").mechanics).nodes["carrier"]["speed"]
    Fraction(2, 7)
    """
    state = train.kinematics.case(state).state
    graph = build_graph(train.declaration)
    graph.graph["state"] = state
    found = _GraphFacts(train, state)
    for link, data in graph.nodes(data=True):
        data["wheels"] = data["declared"].wheels
        data["reference"] = Lazy(partial(found.reference, link))
        data["speed"] = Lazy(partial(found.speed, link))
    for _, _, data in graph.edges(data=True):
        if data["kind"] in ("revolute", "prismatic"):
            # edges have the same keys, None for turning pairs
            data.update(dict.fromkeys(_OF_PAIRS), axis=data["label"])
            continue
        name = data["label"]
        data["form"] = train.declaration.form_of(data["declared"]) if data["kind"] == "gear" else None
        for key in ("axis", "circuit", "carrier", "ratio", "transmission", "mesh", "efficiency"):
            data[key] = Lazy(partial(getattr(found, key), name))
    return _frozen(graph)


def _frozen(graph: Graph) -> Graph:
    """Make the nodes, edges and given attributes of a graph read-only, and return it. Users can add attributes."""
    before = {"frozen", *vars(graph)}
    nx.freeze(graph)
    for name in vars(graph).keys() - before:  # methods replaced by nx.freeze
        setattr(graph, name, _refuse)
    for *_, data in (*graph.nodes(data=True), *graph.edges(data=True)):
        # changed in place, because both ends of an edge refer to the same dict
        data.__class__ = _Attributes
    return graph


class _GraphFacts:
    """Values of the attributes of nodes and edges, for a train in one state. Each value is computed only once."""

    def __init__(self, train: TrainMechanics, state: str | None) -> None:
        self._train, self._state = train, state

    def reference(self, link: str) -> str | None:
        """Return the link that carries the axis of `link`, to which its rotation is relative; None for the frame."""
        return self._train.tree.top.get(link)

    def speed(self, link: str) -> SpeedValue | None:
        return self._answer.speeds.get(link)

    def circuit(self, name: str) -> Circuit:
        return self._circuits[name]

    def carrier(self, name: str) -> str:
        return self._circuits[name].carrier

    def ratio(self, name: str) -> Fraction:
        """Return the speed of the first link of a circuit divided by that of the second, relative to the carrier."""
        return self._circuits[name].ratio

    def axis(self, name: str) -> tuple[str, str]:
        circuit, tree = self._circuits[name], self._train.tree
        return tree.axis_seen_from(circuit.carrier, circuit.i), tree.axis_seen_from(circuit.carrier, circuit.j)

    def mesh(self, name: str) -> GearMesh | CouplingMesh | None:
        """Return a pair with its tooth form, or a coupling with its dimensions; None if these are not declared."""
        return self._meshes.get(name)

    def transmission(self, name: str) -> TransmissionFunction:
        """Return the transmission function of a pair or coupling; it has a constant ratio if no form is declared."""
        from geartrain.teeth.transmission import ExactRatio

        if (mesh := self.mesh(name)) is not None:
            return mesh.transmission
        circuit = self._circuits[name]
        # a coupling lists its driven link first
        driver, driven = (circuit.a, circuit.b) if circuit.kind == "gear" else (circuit.b, circuit.a)
        return ExactRatio(abs(Fraction(driver, driven)), 2 * pi / (abs(driver) if circuit.kind == "gear" else 1))

    def efficiency(self, name: str) -> tuple[Fraction | float, Fraction | float]:
        """Return two basic efficiencies of a pair: with its first link as the driver, and with its second link."""
        from geartrain.dynamics.torques.mean_efficiencies import find_mean_efficiencies

        found = find_mean_efficiencies(self._losses, self._circuits[name])
        return found.driver if found.exact else (float(found.driver[0]), float(found.driver[1]))

    @cached_property
    def _answer(self) -> Answer:
        return self._train.kinematics.solve(self._state)

    @cached_property
    def _circuits(self) -> Mapping[str, Circuit]:
        return {circuit.id: circuit for circuit in self._train.circuits}

    @cached_property
    def _meshes(self) -> Mapping[str, Any]:
        pins = {pin.coupling.name: pin for pin in self._train.couplings}
        return {mesh.name: mesh for mesh in self._train.meshes_in(self._state)} | pins

    @cached_property
    def _losses(self) -> LoadCase:
        """Load case without speeds, which has the data for basic efficiencies: losses relative to fixed carriers."""
        from geartrain.dynamics.torques.load_case import LoadCase

        own = self._train
        case, meshes = own.kinematics.cases[self._state], {mesh.name: mesh for mesh in own.meshes}
        return LoadCase(own.declaration, own.tree, own.circuits, own.signs, case, {}, meshes, own.couplings)
