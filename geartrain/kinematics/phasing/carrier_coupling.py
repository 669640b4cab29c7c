"""Links seen from several carriers: what their meshes must fulfil together, and the angles of links that follow."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.components import Components, ReducedSystem, reduce_components
from geartrain.kinematics.phasing.cycle_basis import mesh_coefficient
from geartrain.numerics.elimination import LinearForm, TooDenseError, eliminate
from geartrain.numerics.exact import whole_multiple

_BUDGET = 10**7  # operations; past it, trains of coupled planetaries are judged loop by loop

Number = Fraction | float
Left = Callable[[int, Sequence[Number]], Number]
"""What is left of the constant of a mesh at given angles of the nodes."""


@dataclass(frozen=True)
class CarrierCoupling:
    """How components are connected.

    rows       weights of meshes of several carriers whose equations add up to 0 on the left
    complete   False where finding them was given up
    forms      unknowns of the components by the angles at which they come together (symbol -1 - equation)
    """

    reduced: ReducedSystem
    circuits: Sequence[Circuit]
    ends: Sequence[tuple[int, int]]
    rows: tuple[dict[int, int], ...] = ()
    forms: Mapping[int, LinearForm] | None = None

    @property
    def complete(self) -> bool:
        """False where it was too dense to be solved: only loops in one carrier's frame are known."""
        return self.forms is not None

    def angles(self, nodes: Sequence[Number], left: Left) -> list[Number]:
        """Angles of links from those of nodes, as their components alone give them (turns).

        What stays free is 0: carriers stand in the pose in which they are declared.
        """
        parts, own = self.reduced.components, self.reduced.own
        together = [self._apart(at, nodes, left) for at in range(len(self.reduced.origin))]
        values: dict[int, Number] = {}
        for unknown, form in (self.forms or {}).items():
            values[unknown] = sum(factor * together[-column - 1] for column, factor in form.items() if column < 0)
        found: list[Number] = [0.0 for _ in parts.links]
        for link, unknown in own.items():
            found[link] = values.get(unknown, 0.0)
        for link, (node, *_) in parts.nodes_of.items():
            if link not in own and link != parts.frame:
                turned = values.get(parts.node_group[node], 0)
                found[link] = nodes[node] + found[parts.node_carrier[node]]
                found[link] += parts.relative(node) * turned if turned else 0
        return found

    def _apart(self, at: int, nodes: Sequence[Number], left: Left) -> Number:
        """By how much a link differs as two carriers see it; or where a loop that cannot turn must stand."""
        parts = self.reduced.components
        kind, first, node = self.reduced.origin[at]
        if kind == "share":
            return nodes[node] - (0 if first in self.reduced.own else nodes[parts.nodes_of[first][0]])
        rates = (
            mesh_coefficient(self.circuits, self.ends, first, end) * parts.relative(end) for end in self.ends[first]
        )
        return left(first, nodes) / sum(rates, Fraction(0))


def find_carrier_coupling(
    parts: Components, circuits: Sequence[Circuit], ends: Sequence[tuple[int, int]]
) -> CarrierCoupling:
    """Solve what couples the components, with the angles at which they come together as symbols."""
    reduced = reduce_components(parts)
    try:
        equations = ({**row, -at - 1: Fraction(-1)} for at, row in enumerate(reduced.equations))
        echelon = eliminate(equations, _BUDGET)
        forms = echelon.forms(_BUDGET)
    except TooDenseError:
        return CarrierCoupling(reduced, circuits, ends)
    rows = []
    for condition in echelon.conditions:
        origins = {-column - 1: reduced.origin[-column - 1] for column in condition}
        if all(kind == "share" for kind, _, _ in origins.values()):  # a train that cannot turn is asked for no more
            total: dict[int, Fraction] = {}
            for at, (_, link, node) in origins.items():
                factor = condition[-at - 1]
                _follow(parts, circuits, ends, node, factor, total)
                if link not in reduced.own:
                    _follow(parts, circuits, ends, parts.nodes_of[link][0], -factor, total)
            weights = whole_multiple(total.values())
            rows.append({mesh: weight for mesh, weight in zip(total, weights, strict=True) if weight})
    return CarrierCoupling(reduced, circuits, ends, tuple(rows), forms)


def _follow(
    parts: Components,
    circuits: Sequence[Circuit],
    ends: Sequence[tuple[int, int]],
    node: int,
    factor: Fraction,
    total: dict[int, Fraction],
) -> None:
    """Add what the constants of the meshes on the way from the root contribute to a node's angle."""
    speed = parts.relative(node) * factor
    while parts.node_parent[node] >= 0:
        mesh = parts.node_circuit[node]
        share = speed / (parts.relative(node) * mesh_coefficient(circuits, ends, mesh, node))
        total[mesh] = total.get(mesh, Fraction(0)) + share
        node = parts.node_parent[node]
