"""Phases of all meshes as one linear system modulo a pitch: residues of loops, angles and errors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.components import Components, ReducedSystem, reduce_components
from geartrain.kinematics.phasing.azimuths import PitchPoints, centred_residue
from geartrain.numerics.containers import collector_paused
from geartrain.numerics.elimination import Echelon, LinearForm, TooDenseError, eliminate
from geartrain.numerics.exact import whole_multiple
from geartrain.numerics.integer_lattice import saturated_lattice

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices


# Least squares with a sparse matrix that has a few entries per row.


_DENSE = 250_000  # entries of a matrix up to which it counts as small


@dataclass(frozen=True)
class SparseRows:
    """Matrix with a small fixed number of entries in each row, given by their columns and coefficients."""

    columns: Indices
    factors: Floats
    width: int

    def small(self, height: int) -> bool:
        """Return True if a matrix with `height` rows is small enough for a dense solution."""
        return height * self.width <= _DENSE

    def least_squares(self, right: Floats) -> Floats:
        """Return the vector x of minimum norm that minimises |A x - right|, by LSMR (Fong and Saunders 2011)."""
        from scipy.sparse import csr_array
        from scipy.sparse.linalg import lsmr

        # scale the columns: tooth counts from 8 to 10^6 would slow down the iteration
        size = np.zeros(self.width)
        np.maximum.at(size, self.columns.ravel(), np.abs(self.factors).ravel())
        size[size == 0] = 1.0
        rows = np.repeat(np.arange(len(right)), self.columns.shape[1])
        entries = (self.factors / size[self.columns]).ravel(), (rows, self.columns.ravel())
        accuracy = 1e-13 if self.small(len(right)) else 1e-6
        found = lsmr(csr_array(entries, shape=(len(right), self.width)), right, atol=accuracy, btol=accuracy, conlim=0)
        return np.asarray(found[0] / size, float)

    def times(self, x: Floats) -> Floats:
        """Return the product of the matrix and a vector x."""
        product: Floats = (self.factors * x[self.columns]).sum(axis=1)
        return product


Row = Mapping[int, int]
"""Integer combination of the equations of meshes: weight of each equation, by index of the mesh."""


class PhaseCycle(NamedTuple):
    """Loop of meshes. The node `nodes[k]` is between the meshes `meshes[k - 1]` and `meshes[k]`, and `nodes[0]` is
    after the last mesh.
    """

    nodes: tuple[int, ...]
    meshes: tuple[int, ...]
    weights: tuple[int, ...]
    """Coprime integer weight of each mesh. The left-hand sides of the equations of the meshes, multiplied by these
    weights, add up to 0.
    """

    @property
    def row(self) -> dict[int, int]:
        """Weight of the equation of each mesh in the loop."""
        return dict(zip(self.meshes, self.weights, strict=True))


_LENGTHS = (4, 6, 8, 12, math.inf)  # maximum number of meshes of a loop; short loops are searched first
_PASSES = 8  # passes over the remaining chords: a chord that is taken shortens other loops

_Edges = dict[int, list[tuple[int, int]]]


def find_cycle_basis(parts: Components, ends: Sequence[tuple[int, int]]) -> Iterator[tuple[list[int], list[int]]]:
    """Yield the nodes and the meshes of each loop of a cycle basis. A loop consists of one chord (a mesh outside the
    search tree) and a shortest path between the ends of the chord. The path uses the search tree and earlier chords.

    Each loop contains its own chord and no later chord, so the loops are independent and generate all loops.
    """
    groups = {parts.node_group[ends[chord][0]] for chord in parts.closing}
    edges: _Edges = {}
    for node, mesh in enumerate(parts.node_circuit):
        if mesh >= 0 and parts.node_group[node] in groups:
            _join(edges, mesh, node, parts.node_parent[node])
    depth = node_depths(parts)
    # chords near the root first: their loops are short, and shorten others
    waiting = sorted(parts.closing, key=lambda at: depth[ends[at][0]] + depth[ends[at][1]])
    for most in _LENGTHS:
        for _ in range(_PASSES):
            later = []
            for chord in waiting:
                i, j = ends[chord]
                way = _shortest(edges, i, j, most - 1)
                if way is None:
                    later.append(chord)
                    continue
                yield way[0], [*way[1], chord]
                _join(edges, chord, i, j)
            progress = len(later) < len(waiting)
            waiting = later[::-1]  # reversed, because chords left over by one pass may be reachable from the other end
            if not progress or not waiting:
                break


def node_depths(parts: Components) -> list[int]:
    """Return the number of meshes between every node and the root of its component."""
    depth = [-1] * len(parts.node_parent)
    for node in range(len(depth)):
        way = []
        while node >= 0 and depth[node] < 0:
            way.append(node)
            node = parts.node_parent[node]
        # `way` ends at a known node, or at a root with depth 0
        level = depth[node] if node >= 0 else -1
        for below, back in enumerate(reversed(way), 1):
            depth[back] = level + below
    return depth


def _join(edges: _Edges, mesh: int, i: int, j: int) -> None:
    edges.setdefault(i, []).append((mesh, j))
    edges.setdefault(j, []).append((mesh, i))


def _shortest(edges: _Edges, start: int, goal: int, most: float) -> tuple[list[int], list[int]] | None:
    """Return the nodes and the meshes of a shortest path from `start` to `goal`, by breadth-first search; None if the
    path has more than `most` meshes.
    """
    came = {start: (-1, -1)}
    front, length = [start], 0
    while front and goal not in came:
        length += 1
        if length > most:
            return None
        reached = []
        for node in front:
            for mesh, there in edges[node]:
                if there not in came:
                    came[there] = (mesh, node)
                    reached.append(there)
        front = reached
    nodes, meshes = [goal], []
    while nodes[-1] != start:
        mesh, node = came[nodes[-1]]
        nodes.append(node)
        meshes.append(mesh)
    return nodes[::-1], meshes[::-1]


# --------------------------------------------------------------------------------------------------------- phase system


Number = Fraction | float
PhaseKind = Literal["closes", "misses", "unclear", "open"]
ResidueKnowledge = Literal["exact", "recognised", "numeric"]

_BUDGET = 10**7  # operations of elimination; beyond, trains of coupled planetaries are checked loop by loop
_UNCLEAR = 0.05  # pitch: a residue within a larger error than this is undecided
_MOST = 20_000  # maximum number of matrix entries for which loops with unequal weights are combined
_ROUNDS = 20  # rounds of reassigning teeth, if a round is fast
_FEW = 3  # rounds if it is slow
_SAME = 1e-6  # pitch: tolerance at which no tooth changes its gap


@dataclass(frozen=True)
class PhaseCondition:
    """Condition of one or several loops of meshes. With suitable integer weights, the left-hand sides of the phase
    equations of the meshes add up to 0, so the weighted sum of the constants must be an integer [pitch].
    """

    cycle: PhaseCycle | None
    """Loop of the condition; None for a condition on several loops together."""
    row: Mapping[int, int]
    """Integer weight of the equation of each mesh in the sum."""
    residue: Fraction | float
    """Weighted sum of the constants minus the nearest integer [pitch]; a Fraction if it is exact."""
    slack: float
    """Maximum error of the residue [pitch]."""
    guessed: bool
    """True if an exact residue depends on fractions that were recognised from rounded positions."""

    @property
    def kind(self) -> PhaseKind:
        """Verdict: "closes", "misses", or "unclear" if the positions are not accurate enough."""
        return judge_residue(self.residue, self.slack)

    @property
    def how(self) -> ResidueKnowledge:
        """Accuracy of the residue: "exact", "recognised" (exact, with inferred fractions), or "numeric"."""
        if not isinstance(self.residue, Fraction):
            return "numeric"
        return "recognised" if self.guessed else "exact"

    @property
    def miss(self) -> Fraction | float:
        """Phase error of the last mesh if all other meshes have no phase error [pitch]."""
        return self.residue / (self.cycle.weights[-1] if self.cycle else list(self.row.values())[-1])


def judge_residue(residue: Fraction | float, slack: float) -> PhaseKind:
    """Return "misses" if the residue [pitch] exceeds its maximum error `slack`. If it does not, return "unclear" if
    `slack` exceeds `_UNCLEAR`, and "closes" if not.
    """
    if abs(float(residue)) > slack:
        return "misses"
    return "unclear" if slack > _UNCLEAR else "closes"


@dataclass(frozen=True)
class PhaseSystem:
    """Phase equations of all meshes, a theta_i + b theta_j - (a + b) theta_k = c (mod 1): equation (1) of
    docs/closure.md.

    Angles theta are in turns, and constants c in pitches.
    """

    parts: Components
    contacts: PitchPoints

    @property
    def circuits(self) -> Sequence[Circuit]:
        """Fundamental circuits of the meshes."""
        return self.contacts.circuits

    @cached_property
    def ends(self) -> list[tuple[int, int]]:
        """Nodes of the two links of every mesh, relative to its carrier."""
        parts, index = self.parts, self.parts.index
        at = {key: node for node, key in enumerate(zip(parts.node_link, parts.node_carrier, strict=True))}
        return [(at[index[c.i], index[c.carrier]], at[index[c.j], index[c.carrier]]) for c in self.circuits]

    @cached_property
    def cycles(self) -> list[PhaseCycle]:
        """Loops of a cycle basis. The loops are as short as possible."""
        with collector_paused():
            return [self._cycle(*loop) for loop in find_cycle_basis(self.parts, self.ends)]

    def _cycle(self, nodes: Sequence[int], meshes: Sequence[int]) -> PhaseCycle:
        """Return the loop with the given nodes and meshes, and with weights of its mesh equations for which the
        coefficients cancel at every node. The weight of the last mesh is positive.
        """
        weights: list[Fraction | int] = [1]
        for node, before, mesh in zip(nodes[1:], meshes, meshes[1:], strict=False):
            came, goes = self.coefficient(before, node), self.coefficient(mesh, node)
            # one wheel in both meshes, the usual case: no Fraction is needed
            if abs(came) == abs(goes):
                weights.append(-weights[-1] if came == goes else weights[-1])
            else:
                weights.append(Fraction(-came, goes) * weights[-1])
        sign = -1 if weights[-1] < 0 else 1
        return PhaseCycle(tuple(nodes), tuple(meshes), tuple(sign * weight for weight in whole_multiple(weights)))

    def coefficient(self, mesh: int, node: int) -> int:
        """Return the coefficient (a or b) of a node's angle in the equation of a mesh."""
        return self.circuits[mesh].a if self.ends[mesh][0] == node else self.circuits[mesh].b

    # ------------------------------------------------------------------------------------ coupling through shared links

    @cached_property
    def _reduced(self) -> ReducedSystem:
        """Linear system that couples the components through the links that turn relative to several carriers."""
        return reduce_components(self.parts)

    @cached_property
    def _echelon(self) -> tuple[Echelon, Mapping[int, LinearForm]] | None:
        """Equations that couple the components, in echelon form, and the unknowns of the components as linear forms of
        the right-hand sides. The right-hand side of equation n has the column -1 - n. None if elimination exceeds its
        budget.
        """
        equations = ({**row, -at - 1: Fraction(-1)} for at, row in enumerate(self._reduced.equations))
        try:
            echelon = eliminate(equations, _BUDGET)
            return echelon, echelon.forms(_BUDGET)
        except TooDenseError:
            return None

    @cached_property
    def coupled_rows(self) -> list[dict[int, int]]:
        """Integer weights of the equations of meshes, by mesh. In each row, the left-hand sides of the weighted
        equations cancel in sum, although the meshes have several carriers.
        """
        rows = []
        for condition in self._echelon[0].conditions if self._echelon else ():
            causes = {-column - 1: self._reduced.origin[-column - 1] for column in condition}
            if all(kind == "share" for kind, _, _ in causes.values()):  # rigid loops have no phase condition
                total: dict[int, Fraction] = {}
                for at, (_, link, node) in causes.items():
                    factor = condition[-at - 1]
                    self._add_contributions(node, factor, total)
                    if link not in self._reduced.own:
                        self._add_contributions(self.parts.nodes_of[link][0], -factor, total)
                weights = whole_multiple(total.values())
                rows.append({mesh: weight for mesh, weight in zip(total, weights, strict=True) if weight})
        return rows

    def _add_contributions(self, node: int, factor: Fraction, total: dict[int, Fraction]) -> None:
        """Add to `total`, for each mesh on the path from the root to a node, `factor` times the coefficient of the
        mesh's constant in the angle of the node.
        """
        parts = self.parts
        speed = parts.relative(node) * factor
        while parts.node_parent[node] >= 0:
            mesh = parts.node_circuit[node]
            share = speed / (parts.relative(node) * self.coefficient(mesh, node))
            total[mesh] = total.get(mesh, Fraction(0)) + share
            node = parts.node_parent[node]

    @cached_property
    def carriers(self) -> frozenset[int]:
        """Indices of the carriers of all meshes, except the frame."""
        return frozenset(self.parts.group_carrier) - {self.parts.frame}

    # ------------------------------------------------------------------------------------------------------ conditions

    @cached_property
    def conditions(self) -> list[PhaseCondition]:
        """Phase conditions of single loops, followed by conditions that each concern several loops together."""
        cycles = self.cycles
        with collector_paused():
            found = [self._condition(cycle, cycle.row) for cycle in cycles]
        basis, _, index = self._saturated
        if index != 1 or self.coupled_rows:
            alone = {tuple(sorted(cycle.row.items())) for cycle in self.cycles}
            found += [self._condition(None, row) for row in basis if tuple(sorted(row.items())) not in alone]
        return found

    @cached_property
    def complete(self) -> bool:
        """False if only the conditions of single loops were found, and not those on several loops together."""
        return self._echelon is not None and self._unequal_size <= _MOST

    @cached_property
    def _unequal_rows(self) -> list[dict[int, int]]:
        """Weights of the conditions in components with weights other than 1 and -1, by mesh."""
        if not self.cycles:
            return self.coupled_rows
        group = self.parts.node_group
        uneven = {group[cycle.nodes[0]] for cycle in self.cycles if any(abs(w) != 1 for w in cycle.weights)}
        uneven |= {group[self.ends[mesh][0]] for row in self.coupled_rows for mesh in row}
        return [cycle.row for cycle in self.cycles if group[cycle.nodes[0]] in uneven] + self.coupled_rows

    @cached_property
    def _unequal_size(self) -> int:
        return len(self._unequal_rows) * len({mesh for row in self._unequal_rows for mesh in row})

    @cached_property
    def _saturated(self) -> tuple[list[dict[int, int]], list[dict[int, int]], int]:
        return saturated_lattice(self._unequal_rows) if self._unequal_size <= _MOST else ([], [], 1)

    def _condition(self, cycle: PhaseCycle | None, row: Mapping[int, int]) -> PhaseCondition:
        contacts = self.contacts
        families = self._families(row)
        if families is None:
            slack = 0.0
            terms = []
            for mesh, weight in row.items():
                slack += abs(weight) * self._uncertainty[mesh]
                constant = self._constant[mesh]
                # exact, because a large weight would cancel the digits of the fraction
                terms.append(weight * constant if abs(weight) == 1 else float(weight * Fraction(constant) % 1))
            # fsum rounds once, so the result does not depend on the order of the meshes
            total = math.fsum(terms)
            # in (-1/2, 1/2] like `centred_residue`; `round` would round halves to even integers
            return PhaseCondition(cycle, row, total - math.ceil(total - 0.5), slack, False)
        scale, exact = contacts.scale, contacts.exact_constant
        parts = sum(weight * exact[mesh] for mesh, weight in row.items()) % scale
        guessed = bool(contacts.guessed) and not contacts.guessed.isdisjoint(families)
        return PhaseCondition(cycle, row, centred_residue(Fraction(parts, scale)), 0.0, guessed)

    @cached_property
    def _constant(self) -> list[float]:
        values: list[float] = self.contacts.constant.tolist()
        return values

    @cached_property
    def _uncertainty(self) -> list[float]:
        values: list[float] = self.contacts.uncertainty.tolist()
        return values

    def _families(self, row: Mapping[int, int]) -> list[int] | None:
        """Return the family numbers of all contacts in a condition; None if their unknown azimuths do not cancel."""
        total: dict[int, int] = {}
        for mesh, weight in row.items():
            circuit = self.circuits[mesh]
            for number, factor in zip(self.contacts.family[mesh], (circuit.a, circuit.b), strict=True):
                total[number] = total.get(number, 0) + weight * factor
        return None if any(total.values()) else list(total)

    # ---------------------------------------------------------------------------------------------------------- angles

    @cached_property
    def _whole_pitches(self) -> dict[int, int]:
        """Integers by mesh, added to the constants [pitch], with which loops of compound wheels nearly close."""
        basis, dual, _ = self._saturated
        found: dict[int, int] = {}
        for row, column in zip(basis, dual, strict=True):
            total = sum((weight * Fraction(self._constant[mesh]) for mesh, weight in row.items()), Fraction(0))
            residue = self._condition(None, row).residue
            # an integer except for the rounding of the constants
            whole = round(total - Fraction(residue))
            for mesh, factor in column.items():
                found[mesh] = found.get(mesh, 0) - whole * factor
        return found

    @cached_property
    def _tree_nodes(self) -> list[Number]:
        """Angles of nodes relative to their carriers that satisfy the equation of every mesh in the search tree [turn].

        In components with compound wheels, the angles are exact fractions that are not reduced to one turn, because a
        full turn of one link changes which teeth of other links engage.
        """
        parts = self.parts
        found: list[Number] = [0.0 for _ in parts.node_parent]
        exact = {parts.node_group[self.ends[mesh][0]] for row in self._saturated[0] for mesh in row}
        # from the roots outwards, so that the predecessor is known
        for node in sorted(range(len(found)), key=node_depths(parts).__getitem__):
            up = parts.node_parent[node]
            if up < 0:
                continue
            mesh = parts.node_circuit[node]
            circuit, first = self.circuits[mesh], self.ends[mesh][0] == node
            own, other = (circuit.a, circuit.b) if first else (circuit.b, circuit.a)
            if parts.node_group[node] in exact:
                right = Fraction(self._constant[mesh]) + self._whole_pitches.get(mesh, 0)
                found[node] = (right - other * Fraction(found[up])) / own
            else:
                found[node] = ((self._constant[mesh] - other * found[up]) / own) % 1.0
        return found

    @cached_property
    def tree_angles(self) -> list[float]:
        """Angles of links that satisfy the equations of all meshes except the meshes that close loops [turn]."""
        return self._link_angles(self._tree_nodes)

    def _link_angles(self, nodes: Sequence[Number]) -> list[float]:
        """Return the angles of links [turn], given the angles of nodes relative to carriers [turn]. Free unknowns are
        set to 0, so that carriers are in their declared pose.
        """
        parts, own = self.parts, self._reduced.own
        together = [self._angle_difference(*origin, nodes) for origin in self._reduced.origin]
        values: dict[int, Number] = {}
        for unknown, form in (self._echelon[1] if self._echelon else {}).items():
            values[unknown] = sum(factor * together[-column - 1] for column, factor in form.items() if column < 0)
        found: list[Number] = [0.0 for _ in parts.links]
        for link, unknown in own.items():
            found[link] = values.get(unknown, 0.0)
        for link, (node, *_) in parts.nodes_of.items():
            if link not in own and link != parts.frame:
                turned = values.get(parts.node_group[node], 0)
                found[link] = nodes[node] + found[parts.node_carrier[node]]
                found[link] += parts.relative(node) * turned if turned else 0
        return [float(angle % 1) for angle in found]

    def _angle_difference(self, kind: str, first: int, node: int, nodes: Sequence[Number]) -> Number:
        """Return the right-hand side of an equation that couples components [turn]. For the kind `share`, it is the
        difference between the angles of the link `first` relative to two carriers. For other kinds, it is the angle of
        a component that satisfies the equation of the mesh `first`, which closes a loop that cannot turn.
        """
        parts = self.parts
        if kind == "share":
            return nodes[node] - (0 if first in self._reduced.own else nodes[parts.nodes_of[first][0]])
        (i, j), circuit = self.ends[first], self.circuits[first]
        left = self._constant[first] - circuit.a * nodes[i] - circuit.b * nodes[j]
        return left / (circuit.a * parts.relative(i) + circuit.b * parts.relative(j))

    @cached_property
    def _link_rows(self) -> SparseRows:
        """Matrix of the phase equations, with the two links and the carrier of every mesh as columns."""
        index = self.parts.index
        links = np.array([(index[c.i], index[c.j], index[c.carrier]) for c in self.circuits]).reshape(-1, 3)
        teeth = self.contacts.teeth
        factors = np.column_stack([teeth, np.where(links[:, 2] == self.parts.frame, 0.0, -teeth.sum(axis=1))])
        return SparseRows(links, self._without_rigid_loops(factors), len(self.parts.links))

    @cached_property
    def _node_rows(self) -> SparseRows:
        nodes = np.array(self.ends).reshape(-1, 2)
        return SparseRows(nodes, self._without_rigid_loops(self.contacts.teeth), len(self.parts.node_parent))

    def _without_rigid_loops(self, factors: Floats) -> Floats:
        """Return the coefficients with zeros in the rows of meshes that close loops that cannot turn."""
        found = factors.copy()
        found[list(self.parts.breaking)] = 0.0
        return found

    def errors(self, angles: Sequence[float] | Floats) -> Floats:
        """Return the phase error of every mesh [pitch] for given link angles [turn]; 0 in loops that cannot turn."""
        return self._errors(self._link_rows, np.asarray(angles))

    def _errors(self, rows: SparseRows, angles: Floats) -> Floats:
        # integer pitches are removed before the sum, to keep the digits of the fraction
        off: Floats = self.contacts.constant - np.mod(rows.factors * angles[rows.columns], 1.0).sum(axis=1)
        off -= np.ceil(off - 0.5)
        off[list(self.parts.breaking)] = 0.0
        return off

    @cached_property
    def spread_angles(self) -> list[float]:
        """Angles of links for which the sum of the squared phase errors is the smallest that was found [turn].

        Two initial assignments of teeth to gaps are tried: in one, the errors of the pairs that close loops are below
        half a pitch; in the other, the residues of short loops are below half a pitch. Then the errors are distributed
        by least squares and teeth are reassigned to gaps, alternately, until the assignment does not change. Each step
        reduces the sum, so the result is a local minimum.
        """
        start = self.errors(self.tree_angles)
        starts = [self._loop_errors(start), start][: 2 if self._node_rows.small(len(start)) else 1]
        found = [self._distribute(start) for start in starts]
        return min(found, key=lambda angles: float((self.errors(angles) ** 2).sum()))

    def _loop_errors(self, errors: Floats) -> Floats:
        """Return the phase errors of all meshes [pitch], plus integers for which short loops have small residues."""
        found = errors.tolist()
        for condition in self.conditions:
            if condition.cycle is not None:
                *others, (last, weight) = condition.row.items()
                left = float(condition.residue) - sum(factor * found[mesh] for mesh, factor in others)
                found[last] += round(left / weight - found[last])
        return np.array(found)

    def _distribute(self, errors: Floats) -> list[float]:
        """Return the angles of links after distributing the phase errors of the meshes over them [turn]. A carrier
        keeps its angle unless it is itself connected by gears.
        """
        if self.coupled_rows:
            together = np.mod(self._iterate(self._link_rows, np.array(self.tree_angles), errors), 1.0)
            return [float(angle) for angle in together]
        start = self._tree_nodes
        moved = self._iterate(self._node_rows, np.zeros(len(start)), errors, [float(angle % 1) for angle in start])
        return self._link_angles([angle + type(angle)(step) for angle, step in zip(start, moved.tolist(), strict=True)])

    def _iterate(self, rows: SparseRows, angles: Floats, errors: Floats, start: Sequence[float] = (0.0,)) -> Floats:
        """Return the angles after alternating least squares and reassignment of teeth to gaps [turn]."""
        for _ in range(_ROUNDS if rows.small(len(errors)) else _FEW):
            step = rows.least_squares(errors)
            angles = angles + step
            left, errors = errors - rows.times(step), self._errors(rows, angles + np.asarray(start))
            if np.abs(left - errors).max() < _SAME:
                break
        return angles
