"""Totals and marginals of weighted derivations by the inside-outside algorithm, for tables of nodes.

A derivation chooses one alternative at a node, and again one at each node that this alternative refers to. Its weight
is the product of the weights of all chosen alternatives. The inside sum of a node is the total weight of all ways to
complete a derivation from it. The outside sum is the total weight of all contexts in which the node occurs. Their
product is the weight of all derivations that include the node. With integer weights all sums are exact. Sources: Baker
1979; for chains the forward-backward algorithm, Baum 1970.

Each row of a table is a node, and the alternatives of all rows are arrays, so that millions of nodes are summed at
once. `relative_entropy` and `entropy` measure the information in probabilities in bits.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
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
    """Alternatives of all rows of a table, stored as arrays with one entry for each of m alternatives."""

    weight: Any
    """Weights of the alternatives, of either sign: an array of shape (m,), or one number for all."""
    size: int
    """Number of rows of the table."""
    owners: Ints | None
    """Row of the table that each alternative belongs to, shape (m,); None if alternative i belongs to row i."""
    leads: tuple[tuple[Table, Ints], ...] = ()
    """Parts of the alternatives: pairs of a table and the row in it, shape (m,)."""
    facts: tuple[tuple[Hashable, int, Ints], ...] = ()
    """Variables, each with its number of values and the index of the value that each alternative assigns, shape (m,).
    """

    def below(self, inside: Mapping[Table, NDArray[Any]]) -> list[NDArray[Any]]:
        """Return the inside sums of each part, shape (m,) each."""
        return [inside[part][rows] for part, rows in self.leads]


class WeightedAlternatives(Generic[Table]):
    """Weighted derivations from the rows of a root table, with their total weight and marginals.

    root           table at whose rows the derivations begin
    alternatives   function that returns the alternatives of a table. The graph of tables must be acyclic.
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
                below = self._below[table] = prod(way.below(self._inside), start=way.weight)
                self._inside[table] = below if way.owners is None else sums_by(way.owners, below, way.size)
            elif table not in self._ways:
                self._ways[table] = alternatives(table)
                # second visit, when the inside sums of all parts are known
                waiting.append((table, True))
                waiting += [(part, False) for part, _ in self._ways[table].leads]

    @property
    def total(self) -> NDArray[Any]:
        """Total weight of all derivations from each row of the root."""
        return self._inside[self.root]

    @cached_property
    def marginals(self) -> dict[Hashable, NDArray[Any]]:
        """Array for each variable, with the total weight of all derivations that assign each of its values."""
        outside: dict[Table, Any] = dict.fromkeys(self._inside, 0)
        outside[self.root] = self._inside[self.root] ** 0  # 1 for each row
        found: dict[Hashable, Any] = {}
        for table in reversed(self._inside):  # in reverse order, every table comes after all tables that refer to it
            way, inside = self._ways[table], self._ways[table].below(self._inside)
            around = outside[table] if way.owners is None else outside[table][way.owners]
            for variable, size, values in way.facts:
                found[variable] = found.get(variable, 0) + sums_by(values, around * self._below[table], size)
            for at, (part, rows) in enumerate(way.leads):
                # not total / inside[at], which may be 0
                beside = prod(inside[:at] + inside[at + 1 :], start=around * way.weight)
                outside[part] = outside[part] + sums_by(rows, beside, len(self._inside[part]))
        return found


def sums_by(owners: Ints, values: NDArray[Any], size: int) -> NDArray[Any]:
    """Return the sum of the values of each owner, shape (size,). Python integers are added exactly."""
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
    """Return the Shannon entropy of a distribution [bit], the expected information of observing its outcome.

    It is the mean relative entropy of the distributions after and before the observation.
    """
    return sum(
        (probability * relative_entropy((1.0,), (probability,)) for probability in probabilities if probability), 0.0
    )
