"""Exact join by bucket elimination, which counts all assignments of a problem or yields them block by block."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from geartrain.numerics.arrays import Ints
from geartrain.search.constraints.count_conditions import CountConstraint, CountEquation
from geartrain.search.integer_columns import spread, spread_in_blocks
from geartrain.search.join.join_plan import JoinProblem, PlanNode
from geartrain.search.join.polynomial_constraints import PolynomialConstraint
from geartrain.search.join.product_lists import BLOCK, PartialAssignments, Tallies, find_item

# Once x and y are assigned, an output that depends only on x cannot distinguish assignments by y. Rows with equal
# values of all variables of later constraints are merged as soon as possible (bucket elimination, Dechter 1999).

Slices = Mapping[int, tuple[int, int]]
"""Half-open range of indices into the values of a variable, keyed by variable. One task of a join covers only these
values. Variables without an entry are unrestricted.
"""
AssignmentColumns = dict[str, Ints]


class BudgetSpentError(Exception):
    """Exception raised if an exact join examines more partial assignments than its budget permits."""


RefusalCounts = dict[int, Tallies]
"""Number of rejected assignments of each row (partial assignment), keyed by the index of the constraint that rejects
them.
"""


class ExactJoin:
    """Enumeration of the assignments of tooth counts that satisfy all constraints of a join problem, by bucket
    elimination (Dechter 1999).

    budget   maximum number of partial assignments to examine; `BudgetSpentError` is raised if it is exceeded
    """

    def __init__(self, question: JoinProblem, budget: float = np.inf) -> None:
        self.question = question
        # no tally exceeds the total, so that int64 cannot overflow below 2^62
        self.dtype: Any = np.int64 if question.total < 1 << 62 else object
        self.items = [find_item(one, question.domains, question.weights, self.dtype) for one in question.recipes]
        self.extents = [(float(item.x[0]), float(item.x[-1])) for item in self.items]
        self.constraints: list[CountConstraint | PolynomialConstraint] = [
            *question.rules,
            *question.polynomial_constraints,
        ]
        self.wheel_of = {recipe[0][0]: at for at, recipe in enumerate(question.recipes) if len(recipe) == 1}
        self.cut({}, budget)

    def cut(self, slices: Slices, budget: float) -> None:
        """Set, for each variable in `slices`, the half-open range of indices of its values to which the join is
        restricted; set the maximum number of partial assignments to examine, and reset the counter of examined partial
        assignments to 0.
        """
        self.slices, self.budget, self.steps = slices, budget, 0
        self._unconstrained: dict[int, int] = {}

    def start(self) -> PartialAssignments:
        """Return a single partial assignment in which no variable is assigned, from which a join starts."""
        return PartialAssignments(self.items, {}, 1)

    def unconstrained_count(self, node: PlanNode) -> int:
        """Return the number of assignments of tooth counts to the variables of a node of the join plan and of all its
        descendants, regardless of the constraints.
        """
        if id(node) not in self._unconstrained:
            total = self._total(node.item)
            for child in node.children:
                total *= self.unconstrained_count(child)
            self._unconstrained[id(node)] = total
        return self._unconstrained[id(node)]

    def count(self, node: PlanNode, rows: PartialAssignments) -> tuple[Tallies, RefusalCounts]:
        """Return, for each partial assignment in `rows`, the number of its extensions to the variables of a node and of
        all its descendants that satisfy all constraints, and the number of extensions that each constraint rejects.
        """
        total = np.zeros(rows.size, dtype=self.dtype)
        removed: RefusalCounts = defaultdict(lambda: np.zeros(rows.size, dtype=self.dtype))
        at, alive = self.pruned(node, rows, removed)
        # a last variable with only a guide is counted from the ends of its windows, without a row for each value
        if not node.children and not node.checks and node.guide >= len(self.question.rules):
            constraint, item = self.constraints[node.guide], self.items[node.item]
            assert isinstance(constraint, PolynomialConstraint)
            self.spend(alive.size)
            for window in constraint.windows(alive, node.item):
                start, end = (np.clip(one, *self._run(node.item)) for one in window)
                # cases exclude each other, so their windows do not overlap
                total[at] += item.sums[end] - item.sums[start]
            np.add.at(removed[node.guide], at, self.unconstrained_count(node) - total[at])
            return total, removed
        for parents, grown in self.grown(node, alive, at, removed):
            counts = self._count_below(node, parents, grown, removed)
            np.add.at(total, parents, counts)
        return total, removed

    def stream(self, nodes: Sequence[PlanNode], rows: PartialAssignments) -> Iterator[PartialAssignments]:
        """Yield, block by block, all extensions of the partial assignments `rows` to the variables of the given nodes
        and of all their descendants that satisfy the constraints.
        """
        if not nodes:
            yield rows
            return
        node = nodes[0]
        _, alive = self.pruned(node, rows, None)
        for _, grown in self.grown(node, alive, np.arange(alive.size), None):
            # rows without solutions in a later child would be enumerated in vain for the first child
            for child in node.children if len(node.children) > 1 else ():
                distinct, which = grown.distinct(child.interface)
                found, _ = self.count(child, distinct)
                grown = grown.pick(found[which] > 0)
            yield from self.stream((*node.children, *nodes[1:]), grown)

    def wheels(self, rows: PartialAssignments) -> Iterator[AssignmentColumns]:
        """Yield, block by block, all assignments of tooth counts that are represented by the partial assignments
        `rows`, as an array of tooth counts for each wheel. A row identifies the product of the tooth counts of each
        group of wheels.
        """
        sizes = np.ones(rows.size, dtype=self.dtype)
        for item, column in rows.columns.items():
            sizes = sizes * self.items[item].times[column]
        for first, last in rows.blocks(sizes):
            self.spend(int(sizes[first:last].sum()))
            part = rows.pick(np.arange(first, last))
            columns: AssignmentColumns = {}
            owner = np.arange(part.size)
            for item, column in part.columns.items():
                # decompose each distinct value once, however many rows have it
                values, which = np.unique(column, return_inverse=True)
                ways, more = self.items[item].ways(values)
                starts = np.searchsorted(ways, np.arange(len(values) + 1))
                chosen = which[owner]
                grown, at = spread(starts[chosen], starts[chosen + 1])
                owner = owner[grown]
                columns = {wheel: known[grown] for wheel, known in columns.items()}
                columns |= {wheel: counts[at] for wheel, counts in more.items()}
            yield {wheel: columns[wheel] for wheel in self.question.wheels}

    def spend(self, steps: int) -> None:
        """Add a number of examined partial assignments to the counter of the join. `BudgetSpentError` is raised if the
        counter exceeds the budget.
        """
        self.steps += steps
        if self.steps > self.budget:
            raise BudgetSpentError

    def _run(self, item: int) -> tuple[int, int]:
        return self.slices.get(item, (0, len(self.items[item])))

    def pruned(
        self, node: PlanNode, rows: PartialAssignments, removed: RefusalCounts | None
    ) -> tuple[Ints, PartialAssignments]:
        """Return the partial assignments that can still satisfy all constraints, preceded by their indices in `rows`.
        The other partial assignments are counted in `removed` under the constraint that rejects them for all values of
        the unassigned variables.
        """
        at = np.arange(rows.size)
        for number in node.prunes:
            constraint = self.constraints[number]
            assert isinstance(constraint, PolynomialConstraint)
            hopeful = constraint.possible(rows, self.extents)
            if hopeful.all():
                continue
            if removed is not None:
                gone = at[~hopeful]
                np.add.at(removed[number], gone, np.full(len(gone), self.unconstrained_count(node), dtype=self.dtype))
            at, rows = at[hopeful], rows.pick(hopeful)
        return at, rows

    def grown(
        self, node: PlanNode, rows: PartialAssignments, at: Ints, removed: RefusalCounts | None
    ) -> Iterator[tuple[Ints, PartialAssignments]]:
        """Yield, block by block, the extensions of the partial assignments `rows` by all values of the variable of a
        node that satisfy the constraints of this node. Each block is preceded by an array of integers, which identify
        the original row of each extension; `at` contains the integer that identifies each row.
        """
        times, total = self.items[node.item].times, self._total(node.item)
        below = self.unconstrained_count(node) // total  # assignments of the subtree for each value of the variable
        # all assignments are charged here; those that the guide accepts are subtracted below. `np.add.at`, because `+=`
        # would add only one number to a repeated row
        if node.guide >= 0 and removed is not None:
            np.add.at(removed[node.guide], at, np.full(rows.size, total * below, dtype=self.dtype))
        for parents, indices in self._candidates(node, rows):
            grown = rows.plus(parents, node.item, indices)
            self.spend(grown.size)
            if node.guide >= 0 and removed is not None:
                np.add.at(removed[node.guide], at[parents], times[indices] * -below)
            for number in node.checks:
                constraint = self.constraints[number]
                if isinstance(constraint, PolynomialConstraint):
                    met = constraint.holds(grown)
                else:
                    met = constraint.holds(self._counts(constraint, grown))
                if removed is not None:
                    np.add.at(removed[number], at[parents[~met]], times[indices[~met]] * below)
                parents, indices, grown = parents[met], indices[met], grown.pick(met)
            if grown.size:
                yield at[parents], grown

    def _candidates(self, node: PlanNode, rows: PartialAssignments) -> Iterator[tuple[Ints, Ints]]:
        """Yield, block by block, the pairs of a partial assignment and a value of the variable of a node that satisfy
        the constraint `node.guide`, as two arrays: indices of rows, and indices of values. Without such a constraint,
        all pairs are yielded.
        """
        first, last = self._run(node.item)
        if node.guide < 0:
            whole = np.zeros(rows.size, dtype=np.int64)
            yield from spread_in_blocks(whole + first, whole + last, BLOCK)
            return
        guide = self.constraints[node.guide]
        if isinstance(guide, PolynomialConstraint):
            for window in guide.windows(rows, node.item):
                start, end = (np.clip(one, first, last) for one in window)
                yield from spread_in_blocks(start, end, BLOCK)
            return
        assert isinstance(guide, CountEquation)
        counts, integral = guide.solve_for(self.question.recipes[node.item][0][0], self._counts(guide, rows))
        values = self.items[node.item].values
        # clipped; a solution above all values fails the comparison below
        indices = np.minimum(np.searchsorted(values, counts), len(values) - 1)
        found = np.flatnonzero(integral & (values[indices] == counts) & (indices >= first) & (indices < last))
        yield found, indices[found]

    def _counts(self, rule: CountConstraint, rows: PartialAssignments) -> AssignmentColumns:
        """Return the tooth counts of the wheels of a constraint in all partial assignments, as an array for each wheel.
        Wheels whose variable is not assigned are omitted.
        """
        items = {wheel: self.wheel_of[wheel] for wheel in rule.wheels}
        return {wheel: rows.value(item) for wheel, item in items.items() if item in rows.columns}

    def _count_below(self, node: PlanNode, parents: Ints, grown: PartialAssignments, removed: RefusalCounts) -> Tallies:
        """Return, for each partial assignment in `grown`, the number of its extensions to the descendants of a node
        that satisfy all constraints. The numbers of rejected extensions are added to the arrays in `removed`, at the
        index that `parents` contains for each partial assignment.
        """
        counts = self.items[node.item].times[grown.columns[node.item]]
        alive = np.arange(grown.size)
        # assignments of the children that are not yet counted
        later = self.unconstrained_count(node) // self._total(node.item)
        for child in node.children:
            later //= self.unconstrained_count(child)
            distinct, which = grown.pick(alive).distinct(child.interface)
            found, gone = self.count(child, distinct)
            for number, numbers in gone.items():
                np.add.at(removed[number], parents[alive], counts[alive] * numbers[which] * later)
            counts[alive] = counts[alive] * found[which]
            # rows without solutions in one child need no other child
            alive = alive[counts[alive] > 0]
        return counts

    def _total(self, item: int) -> int:
        first, last = self._run(item)
        return int(self.items[item].sums[last] - self.items[item].sums[first])
