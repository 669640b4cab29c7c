"""A join that is kept: which values of each item go with what is set above, and which counts make up each value.

Every transition leads to at least one whole assignment. Sums over all assignments are then sums over the tree, taken
again and again with other weights; see `inside_outside`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from geartrain.numerics.arrays import Floats, Ints
from geartrain.synthesis.join.exact_join import ExactJoin
from geartrain.synthesis.join.join_plan import JoinProblem, PlanNode
from geartrain.synthesis.join.partial_assignments import PartialAssignments
from geartrain.synthesis.join.polynomial_constraints import PolynomialConstraint
from geartrain.synthesis.join.product_lists import Item, ProductStep, Tallies

Misfits = Mapping[int, Callable[[Floats], Floats]]
"""Number of a graded demand in `JoinProblem.asked` -> how badly its values agree with it, 0 for perfectly."""
CountWeights = Mapping[str, Tallies]
"""Wheel -> a weight for each of its counts, all of one dtype."""


class RecordedItem:
    """Some values of an item, and how the counts of its wheels make them up.

    size    of these values
    sides   of the products above, and below if there are any: the last step to them, and the product of each value
    """

    def __init__(self, item: Item, indices: Ints) -> None:
        self.size = len(indices)
        self.sides: list[tuple[ProductStep, Ints]] = []
        for products, places in item.sides(indices):
            distinct, rows = np.unique(places, return_inverse=True)
            last = products.last_step(distinct)
            self.sides += [] if last is None else [(last, rows)]

    @property
    def transitions(self) -> int:
        """How many there are in all steps."""
        return sum(len(step.choices) for last, _ in self.sides for step in last.chain())

    def ways(self, value: int) -> Iterator[dict[str, int]]:
        """Each way to one value: wheel -> index of its count."""
        for sides in product(*(list(_ways(last, int(rows[value]))) for last, rows in self.sides)):
            yield {wheel: index for own in sides for wheel, index in own.items()}


def _ways(last: ProductStep | None, row: int) -> Iterator[dict[str, int]]:
    """Each way through the steps to a row."""
    if last is None:
        yield {}
        return
    for at in np.flatnonzero(last.children == row):
        for before in _ways(last.before, int(last.parents[at])):
            yield before | {last.wheel: int(last.choices[at])}


@dataclass(frozen=True, eq=False)
class RecordedNode:
    """A node of a join's plan.

    size       rows: settings of what this node and those below look at
    parents    row of each transition, ascending
    places     which value it sets, of `values`
    values     those of the item that occur
    misfit     what the graded demands decided here add to each transition; None where none is decided
    children   nodes below, and for each of them the row that each transition leads to
    """

    size: int
    parents: Ints
    places: Ints
    values: RecordedItem
    misfit: Floats | None
    children: tuple[tuple[RecordedNode, Ints], ...]


def record_join(question: JoinProblem, limit: float, misfits: Misfits) -> tuple[RecordedNode, int]:
    """The tree of a question without late rules, and the steps it took.

    Raises `BudgetSpentError` where that needs more than `limit` partial assignments.
    """
    join = ExactJoin(question, budget=limit)
    return _Recorder(join, misfits).record(question.plan, join.start()), join.steps


@dataclass(frozen=True)
class _Recorder:
    join: ExactJoin
    misfits: Misfits

    def record(self, node: PlanNode, rows: PartialAssignments) -> RecordedNode:
        """A node and all below, for some distinct rows on its interface."""
        at, alive = self.join.pruned(node, rows, None)
        blocks = list(self.join.grown(node, alive, at, None))
        # rows without any block still have columns
        nothing = [(at[:0], alive.pick(at[:0]).plus(at[:0], node.item, at[:0]))]
        parents = np.concatenate([owners for owners, _ in blocks or nothing])
        # transitions of one row stand together: `BestFirst` finds them by bisection
        order = np.argsort(parents, kind="stable")
        parents, grown = parents[order], _joined([block for _, block in blocks or nothing]).pick(order)
        misfit = self._misfit(node, grown)
        children: list[tuple[RecordedNode, Ints]] = []
        for child in node.children:
            distinct, which = self.join.seen(child, grown)
            below = self.record(child, distinct)
            onward = np.arange(grown.size) if which is None else which
            leads = np.zeros(distinct.size, dtype=np.bool_)
            leads[below.parents] = True
            kept = leads[onward]
            parents, grown, misfit = parents[kept], grown.pick(kept), None if misfit is None else misfit[kept]
            children = [(known, to[kept]) for known, to in children] + [(below, onward[kept])]
        live, places = np.unique(grown.columns[node.item], return_inverse=True)
        values = RecordedItem(self.join.items[node.item], live)
        self.join.spend(values.transitions)
        return RecordedNode(rows.size, parents, places, values, misfit, tuple(children))

    def _misfit(self, node: PlanNode, rows: PartialAssignments) -> Floats | None:
        """What the graded demands that are complete with this node add."""
        found: Floats | None = None
        for number in (node.guide, *node.checks):
            demand = number - len(self.join.question.rules)
            if number >= 0 and demand in self.misfits:
                constraint = self.join.constraints[number]
                assert isinstance(constraint, PolynomialConstraint)
                own = self.misfits[demand](constraint.value(rows))
                found = own if found is None else found + own
        return found


def _joined(blocks: Sequence[PartialAssignments]) -> PartialAssignments:
    """Rows of several blocks over the same items as one."""
    first = blocks[0]
    columns = {item: np.concatenate([block.columns[item] for block in blocks]) for item in first.columns}
    return PartialAssignments(first.items, columns, sum(block.size for block in blocks))
