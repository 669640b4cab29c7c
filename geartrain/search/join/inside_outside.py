"""Sums over all assignments of a recorded join: total weight, and weight for each tooth count of each wheel.

Inside-outside algorithm (Baker 1979): the inside sum of a row is the total weight of all ways to complete it, and its
outside sum is the total weight of all contexts in which it occurs. Sums of integer weights are exact. All sums are
linear in the weights of each wheel. If the weights w(z) of the tooth counts z of one wheel are replaced by
w(z) (z - mean), the sums for another wheel give the covariance of the two tooth counts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush
from math import prod
from typing import Any

import numpy as np

from geartrain.numerics.arrays import Floats, Ints
from geartrain.search.integer_columns import sums_by
from geartrain.search.join.exact_join import ExactJoin
from geartrain.search.join.join_plan import JoinProblem, PlanNode
from geartrain.search.join.polynomial_constraints import PolynomialConstraint
from geartrain.search.join.product_lists import PartialAssignments, ProductStep, Tallies

Misfits = Mapping[int, Callable[[Floats], Floats]]
"""Functions that convert values of a constrained function to misfits, keyed by the index of the constraint in
`JoinProblem.requested`.
"""
CountWeights = Mapping[str, Tallies]
"""Weights of the tooth counts of each wheel. All arrays have the same dtype."""


def _ways(last: ProductStep | None, row: int) -> Iterator[dict[str, int]]:
    """Yield all assignments of tooth counts whose product has the index `row` among the products of the multiplication
    step `last`, each as a dict from wheel to the index of its tooth count. If `last` is None, there are no wheels, and
    one empty dict is yielded.
    """
    if last is None:
        yield {}
        return
    for at in np.flatnonzero(last.children == row):
        for before in _ways(last.before, int(last.parents[at])):
            yield before | {last.wheel: int(last.choices[at])}


@dataclass(frozen=True, eq=False)
class RecordedNode:
    """Node of a recorded join with all its transitions. A transition assigns one value to the variable of the node, and
    is part of at least one complete assignment.
    """

    size: int
    """Number of rows, that is, of distinct states before the variable of the node is assigned."""
    parents: Ints
    """Index of the row from which each transition starts, in ascending order."""
    places: Ints
    """Index in `values` of the value that is assigned by each transition."""
    values: ProductStep
    """Values of the variable of the node, represented by the last step of the multiplication that produces them."""
    misfit: Floats
    """Misfit added by each transition, from the graded constraints whose last variable is assigned at this node."""
    children: tuple[tuple[RecordedNode, Ints], ...]
    """Child nodes, each with an array that contains the index of the row of the child to which each transition
    leads.
    """


def record_join(question: JoinProblem, limit: float, misfits: Misfits) -> tuple[RecordedNode, int]:
    """Record all complete assignments of a join problem as a tree, and return its root and the number of examined
    partial assignments. `question.late` must be empty.

    `BudgetSpentError` is raised if the number of examined partial assignments exceeds `limit`.
    """
    join = ExactJoin(question, budget=limit)
    return _record_node(join, misfits, question.plan, join.start()), join.steps


def _record_node(join: ExactJoin, misfits: Misfits, node: PlanNode, rows: PartialAssignments) -> RecordedNode:
    """Return the recorded node of a plan node and all its descendants, with the transitions that start from the partial
    assignments `rows`.
    """
    at, alive = join.pruned(node, rows, None)
    blocks = list(join.grown(node, alive, at, None))
    # rows without any block still need columns
    blocks = blocks or [(at[:0], alive.pick(at[:0]).plus(at[:0], node.item, at[:0]))]
    parents = np.concatenate([owners for owners, _ in blocks])
    columns = {item: np.concatenate([block.columns[item] for _, block in blocks]) for item in blocks[0][1].columns}
    # transitions of one row are adjacent: `BestFirst` finds them by bisection
    order = np.argsort(parents, kind="stable")
    parents, grown = parents[order], PartialAssignments(join.items, columns, len(parents)).pick(order)
    misfit = _added_misfit(join, misfits, node, grown)
    children: list[tuple[RecordedNode, Ints]] = []
    for child in node.children:
        distinct, which = grown.distinct(child.interface)
        below = _record_node(join, misfits, child, distinct)
        onward = np.arange(distinct.size)[which]
        # transitions to rows without a complete assignment are removed
        leads = np.zeros(distinct.size, dtype=np.bool_)
        leads[below.parents] = True
        kept = leads[onward]
        parents, grown, misfit = parents[kept], grown.pick(kept), misfit[kept]
        children = [(known, to[kept]) for known, to in children] + [(below, onward[kept])]
    live, places = np.unique(grown.columns[node.item], return_inverse=True)
    values = join.items[node.item].last_step(join.items[node.item].values[live])
    join.spend(sum(len(step.choices) for step in values.chain()))
    return RecordedNode(rows.size, parents, places, values, misfit, tuple(children))


def _added_misfit(join: ExactJoin, misfits: Misfits, node: PlanNode, rows: PartialAssignments) -> Floats:
    """Return the misfit that a plan node adds to each partial assignment in `rows`: the sum over the constraints in
    `misfits` whose last variable is assigned at this node.
    """
    found = np.zeros(rows.size)
    for number in (node.guide, *node.checks):
        demand = number - len(join.question.rules)
        if number >= 0 and demand in misfits:
            constraint = join.constraints[number]
            assert isinstance(constraint, PolynomialConstraint)
            found = found + misfits[demand](constraint.value(rows))
    return found


_Table = RecordedNode | ProductStep
_Sums = dict[_Table, Any]
"""Array of numbers for each table, with one number for each row or for each transition."""


def _parts(table: _Table) -> tuple[tuple[_Table, Ints], ...]:
    """Return the tables that follow a table, each with an array that contains, for each transition of the table, the
    row to which it leads. A recorded node is followed by the last step of its `values` and by its children; a
    multiplication step is followed by the step of the previous wheel.
    """
    if isinstance(table, RecordedNode):
        return (table.values, table.places), *table.children
    return () if table.before is None else ((table.before, table.parents),)


def _start_rows(table: _Table) -> Ints:
    """Return an array that contains, for each transition of a table, the row of the table from which the transition
    starts.
    """
    return table.parents if isinstance(table, RecordedNode) else table.children


class AssignmentSums:
    """Calculator of weighted sums over all assignments of a recorded join, for different weights of tooth counts.

    graded   True to multiply the weight of an assignment, which is the product of the weights of its tooth counts, by
             exp(-misfit / 2)
    """

    def __init__(self, root: RecordedNode, graded: bool) -> None:
        self.root, self.graded = root, graded
        self._tables: dict[_Table, None] = {}
        self._add(root)

    def _add(self, table: _Table) -> None:
        """Add a recorded node or a multiplication step to the list of tables, after all tables that follow it."""
        for part, _ in reversed(_parts(table)):
            self._add(part)
        self._tables[table] = None

    def total(self, weights: CountWeights) -> Any:
        """Return the total weight of all assignments of tooth counts."""
        inside, _, _ = self._inside(weights)
        return inside[self.root].sum()

    def _inside(self, weights: CountWeights) -> tuple[_Sums, _Sums, _Sums]:
        """Return three arrays for each table: the total weight of all assignments that complete each row (inside sum),
        the weight of each transition, and the total weight of all assignments that begin with each transition.
        """
        inside: _Sums = {}
        own: _Sums = {}
        onward: _Sums = {}
        for table in self._tables:
            if isinstance(table, RecordedNode):
                own[table] = np.exp(-table.misfit / 2) if self.graded else 1
            else:
                own[table] = weights[table.wheel][table.choices]
            onward[table] = prod((inside[part][rows] for part, rows in _parts(table)), start=own[table])
            inside[table] = sums_by(_start_rows(table), onward[table], table.size)
        return inside, own, onward

    def marginals(self, weights: CountWeights) -> dict[str, Tallies]:
        """Return, for each wheel, the total weight of the assignments with each of its tooth counts."""
        inside, own, onward = self._inside(weights)
        outside: _Sums = dict.fromkeys(self._tables, 0)
        outside[self.root] = inside[self.root] ** 0  # 1 for each row
        found: dict[str, Tallies] = {}
        for table in reversed(self._tables):
            around = outside[table][_start_rows(table)]
            if isinstance(table, ProductStep):
                found[table.wheel] = sums_by(table.choices, around * onward[table], len(weights[table.wheel]))
            parts = [(part, rows, inside[part][rows]) for part, rows in _parts(table)]
            for at, (part, rows, _) in enumerate(parts):
                # not total / inside sum of the part, which may be 0
                others = (sums for _, _, sums in parts[:at] + parts[at + 1 :])
                outside[part] = outside[part] + sums_by(rows, prod(others, start=around * own[table]), part.size)
        return found

    def covariances(self, weights: CountWeights, counts: Mapping[str, Sequence[int]]) -> dict[tuple[str, str], float]:
        """Return the covariance of the tooth counts of each pair of wheels, keyed by pair in the order of `counts`.

        weights   arrays of non-negative float64 values
        """
        total, marginals = float(self.total(weights)), self.marginals(weights)
        wheels = [wheel for wheel in counts if wheel in marginals]
        steps, found = {}, {}
        for wheel in wheels:
            sizes = np.array(counts[wheel], dtype=np.float64)
            # relative to the mean: E[xy] - E[x] E[y] would lose the digits of a small covariance
            steps[wheel] = sizes - float((marginals[wheel] * sizes).sum()) / total
        for at, first in enumerate(wheels):
            # marginals of the others are then sums of (z - mean) of the first wheel
            tilted = self.marginals({**weights, first: weights[first] * steps[first]})
            for second in wheels[at + 1 :]:
                found[first, second] = float((tilted[second] * steps[second]).sum()) / total
        return found


@dataclass(frozen=True, slots=True)
class GradedAssignment:
    """Assignment of tooth counts with its misfit, which is accurate up to rounding errors."""

    misfit: float
    teeth: Mapping[str, int]


class BestFirst:
    """Iterator over the assignments of a recorded join in ascending order of misfit (A* search).

    counts   tooth counts of each wheel
    """

    def __init__(self, root: RecordedNode, counts: Mapping[str, Sequence[int]]) -> None:
        self._counts = counts
        self._nodes: list[RecordedNode] = []
        self._ahead: list[Floats] = []
        self._below: list[tuple[int, ...]] = []
        self._add(root)

    def _add(self, node: RecordedNode) -> int:
        """Append a node and all its descendants to the list of nodes, compute for each of their rows the minimum misfit
        that completes it, and return the index of the node in the list.
        """
        at = len(self._nodes)
        self._nodes.append(node)
        self._ahead.append(np.full(node.size, np.inf))
        self._below.append(())
        self._below[at] = tuple(self._add(child) for child, _ in node.children)
        minimum = node.misfit.copy()
        for number, (_, to) in zip(self._below[at], node.children, strict=True):
            # children are independent given the row, so the sum of their minima is exact
            minimum += self._ahead[number][to]
        np.minimum.at(self._ahead[at], node.parents, minimum)
        return at

    def __iter__(self) -> Iterator[GradedAssignment]:
        """Yield the assignments in ascending order of misfit."""
        # entry: bound, negative depth, misfit so far, open pairs (node, row), assigned pairs (node, value)
        heap: list[tuple[float, int, float, tuple[tuple[int, int], ...], tuple[tuple[int, int], ...]]] = []
        if np.isfinite(self._ahead[0][0]):
            heappush(heap, (float(self._ahead[0][0]), 0, 0.0, ((0, 0),), ()))
        while heap:
            bound, depth, spent, agenda, taken = heappop(heap)
            if not agenda:
                yield from (GradedAssignment(spent, teeth) for teeth in self._teeth(taken))
                continue
            (number, row), *later = agenda
            node = self._nodes[number]
            first, last = np.searchsorted(node.parents, [row, row + 1])
            for at in range(int(first), int(last)):
                so_far = spent + float(node.misfit[at])
                below = zip(self._below[number], node.children, strict=True)
                then = (*((child, int(to[at])) for child, (_, to) in below), *later)
                ahead = so_far + sum(float(self._ahead[one][its]) for one, its in then)
                # the depth decreases, so that for equal bounds the deepest entry comes first and completes soon; `max`
                # prevents rounding from sorting a child before its parent
                heappush(heap, (max(ahead, bound), depth - 1, so_far, then, (*taken, (number, int(node.places[at])))))

    def _teeth(self, taken: Sequence[tuple[int, int]]) -> Iterator[dict[str, int]]:
        """Yield all assignments of tooth counts for given values of the variables. `taken` contains pairs: index of a
        node, and index of the value of the variable of this node.
        """
        if not taken:
            yield {}
            return
        (number, value), *others = taken
        for way in _ways(self._nodes[number].values, value):
            named = {wheel: self._counts[wheel][index] for wheel, index in way.items()}
            yield from (named | more for more in self._teeth(others))
