"""Totals and marginals of weighted derivations by the inside-outside algorithm, for tables of nodes.

A derivation chooses one alternative at a node, and then one alternative at each node to which the chosen alternative
refers. Its weight is the product of the weights of all chosen alternatives. The inside sum of a node is the total
weight of all derivations that start at the node. The outside sum of a node is the total weight of all contexts in which
the node occurs. Integer weights give exact sums. Sources: Baker 1979; for chains, the forward-backward algorithm of
Baum 1970. Each row of a table is a node, so that millions of nodes are summed at once.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import log2, prod
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Ints

Table = TypeVar("Table", bound=Hashable)


@dataclass(frozen=True, slots=True, eq=False)
class AlternativeRows(Generic[Table]):
    """Alternatives of all nodes of a table, stored as arrays with one entry for each of m alternatives. A row of the
    table is a node, at which a derivation chooses one alternative.
    """

    weight: Any
    """Weights of the alternatives, which may be negative: an array of shape (m,), or one number for all
    alternatives.
    """
    size: int
    """Number of rows of the table."""
    owners: Ints | None
    """Row of the table to which each alternative belongs, shape (m,); None if alternative i belongs to row i."""
    leads: tuple[tuple[Table, Ints], ...] = ()
    """Nodes to which the alternatives refer. Each entry contains a table, and the row in this table to which each
    alternative refers, shape (m,).
    """
    facts: tuple[tuple[Hashable, int, Ints], ...] = ()
    """Variables to which the alternatives assign values. Each entry contains a variable, its number of values, and the
    index of the value that each alternative assigns, shape (m,).
    """


class WeightedAlternatives(Generic[Table]):
    """Weighted derivations from the rows of a root table, with their total weight and marginals.

    root           table at whose rows the derivations begin
    alternatives   function that returns the alternatives of a table; the graph of tables must be acyclic
    """

    def __init__(self, root: Table, alternatives: Callable[[Table], AlternativeRows[Table]]) -> None:
        self.root = root
        self._ways: dict[Table, AlternativeRows[Table]] = {}
        self._below: dict[Table, Any] = {}
        self._inside: dict[Table, NDArray[Any]] = {}
        # depth-first traversal with a stack, because the graph may be deeper than the recursion limit
        waiting = [(root, False)]
        while waiting:
            table, known = waiting.pop()
            if known:
                way = self._ways[table]
                parts = (self._inside[part][rows] for part, rows in way.leads)
                below = self._below[table] = prod(parts, start=way.weight)
                self._inside[table] = below if way.owners is None else sums_by(way.owners, below, way.size)
            elif table not in self._ways:
                self._ways[table] = alternatives(table)
                # second visit, when the inside sums of all parts are known
                waiting.append((table, True))
                waiting += [(part, False) for part, _ in self._ways[table].leads]

    @property
    def total(self) -> NDArray[Any]:
        """Total weight of all derivations that start at each row of the root table."""
        return self._inside[self.root]

    @cached_property
    def marginals(self) -> dict[Hashable, NDArray[Any]]:
        """Array for each variable, which contains the total weight of the derivations that assign each value to the
        variable.
        """
        outside: dict[Table, Any] = dict.fromkeys(self._inside, 0)
        outside[self.root] = self._inside[self.root] ** 0  # 1 for each row
        found: dict[Hashable, Any] = {}
        for table in reversed(self._inside):  # in reverse order, every table comes after all tables that refer to it
            way = self._ways[table]
            inside = [self._inside[part][rows] for part, rows in way.leads]
            around = outside[table] if way.owners is None else outside[table][way.owners]
            for variable, size, values in way.facts:
                found[variable] = found.get(variable, 0) + sums_by(values, around * self._below[table], size)
            for at, (part, rows) in enumerate(way.leads):
                # not total / inside[at], which may be 0
                beside = prod(inside[:at] + inside[at + 1 :], start=around * way.weight)
                outside[part] = outside[part] + sums_by(rows, beside, len(self._inside[part]))
        return found


def sums_by(owners: Ints, values: NDArray[Any], size: int) -> NDArray[Any]:
    """Return the sums of the values that have the same owner, shape (size,). Entry i is the sum of `values` whose entry
    in `owners` is i. Python integers are added exactly.
    """
    found: NDArray[Any] = np.zeros(size, dtype=values.dtype)
    np.add.at(found, owners, values)
    return found


# ---------------------------------------------------------------------------------- information in bits (Shannon 1948)


def relative_entropy(after: Iterable[float], before: Iterable[float | Fraction]) -> float:
    """Return the Kullback-Leibler divergence of the probabilities `after` from the probabilities `before` [bit]."""
    pairs = zip(after, before, strict=False)
    # rounding may make it slightly negative
    return max(0.0, sum(probability * log2(probability / prior) for probability, prior in pairs if probability))


def entropy(probabilities: Iterable[float]) -> float:
    """Return the Shannon entropy of a distribution [bit], which is the expected information of an observation of its
    outcome.

    The entropy equals the mean relative entropy of the distribution after the observation with respect to the
    distribution before it.
    """
    return sum(
        (probability * relative_entropy((1.0,), (probability,)) for probability in probabilities if probability), 0.0
    )
