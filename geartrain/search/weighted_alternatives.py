"""Totals, marginals and random samples of weighted derivations by the inside-outside algorithm.

A derivation chooses one alternative at a node, and again one at each node that this alternative refers to. Its weight
is the product of the weights of all chosen alternatives. The inside sum of a node is the total weight of all ways to
complete a derivation from it. The outside sum is the total weight of all contexts in which the node occurs. Their
product is the weight of all derivations that include the node. With integer weights all sums are exact. Sources: Baker
1979; for chains the forward-backward algorithm, Baum 1970.

A node may also be a table in which each row is a node and the alternatives of all rows are arrays. This form is used
for millions of nodes. `relative_entropy` and `entropy` measure the information in probabilities in bits.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import accumulate
from math import log2, prod
from random import Random
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Ints

Node = TypeVar("Node", bound=Hashable)


@dataclass(frozen=True, slots=True)
class Alternative(Generic[Node]):
    """One alternative at a node: its weight, its facts, and the nodes at which a derivation continues."""

    weight: int
    """Weight of this alternative without the weights of its parts, not negative."""
    tells: tuple[Hashable, ...] = ()
    """Facts that are true if the alternative is chosen. No derivation contains the same fact twice."""
    parts: tuple[Node, ...] = ()
    """Nodes that the alternative refers to; one alternative is chosen independently at each."""

    def below(self, inside: Mapping[Node, int]) -> list[int]:
        """Return the inside sum of each part."""
        return [inside[part] for part in self.parts]

    def around(self, outside: int) -> int:
        """Return `outside`, the outside sum of the node of this alternative."""
        return outside

    def sum_at_node(self, values: int) -> int:
        """Return the contribution of the alternative to a sum at its node."""
        return values

    def sum_at_part(self, at: int, values: int, inside: int) -> int:
        """Return the contribution of the alternative to a sum at its part number `at`."""
        return values

    def tell(self, found: dict[Hashable, Any], around: int, below: int) -> None:
        """Add the weight of all derivations that include this alternative to the entry of each of its facts in
        `found`.
        """
        if through := around * below:
            for told in self.tells:
                found[told] = found.get(told, 0) + through


@dataclass(frozen=True, slots=True, eq=False)
class AlternativeRows(Generic[Node]):
    """Alternatives of all rows of a table, stored as arrays with one entry for each of m alternatives."""

    weight: Any
    """Weights of the alternatives, of either sign: an array of shape (m,), or one number for all."""
    size: int
    """Number of rows of the table."""
    owners: Ints | None
    """Row of the table that each alternative belongs to, shape (m,); None if alternative i belongs to row i."""
    leads: tuple[tuple[Node, Ints], ...] = ()
    """Parts of the alternatives: pairs of a table and the row in it, shape (m,)."""
    tells: tuple[tuple[Hashable, int, Ints], ...] = ()
    """Variables, each with its number of values and the index of the value that each alternative assigns, shape (m,).
    """

    @property
    def parts(self) -> tuple[Node, ...]:
        """Tables that the alternatives refer to."""
        return tuple(part for part, _ in self.leads)

    def below(self, inside: Mapping[Node, NDArray[Any]]) -> list[NDArray[Any]]:
        """Return the inside sums of each part, shape (m,) each."""
        return [inside[part][rows] for part, rows in self.leads]

    def around(self, outside: NDArray[Any]) -> NDArray[Any]:
        """Return the outside sum of the row that each alternative belongs to, shape (m,)."""
        return outside if self.owners is None else outside[self.owners]

    def sum_at_node(self, values: NDArray[Any]) -> NDArray[Any]:
        """Return the sum of the values over the alternatives of each row, shape (size,)."""
        return values if self.owners is None else sums_by(self.owners, values, self.size)

    def sum_at_part(self, at: int, values: NDArray[Any], inside: NDArray[Any]) -> NDArray[Any]:
        """Return the sum of the values over the alternatives that refer to each row of part number `at`."""
        return sums_by(self.leads[at][1], values, len(inside))

    def tell(self, found: dict[Hashable, Any], around: NDArray[Any], below: NDArray[Any]) -> None:
        """Add to each array in `found` the weights of all derivations, summed by the value that an alternative assigns
        to the variable.
        """
        for told, size, answers in self.tells:
            found[told] = found.get(told, 0) + sums_by(answers, around * below, size)


class WeightedAlternatives(Generic[Node]):
    """Weighted derivations from a root node, with their total weight, marginals and random samples.

    Parameters
    ----------
    root : hashable
        Node at which every derivation begins.
    alternatives : callable
        Function that returns the alternatives of a node. The graph of nodes must be acyclic. The alternatives are all
        `Alternative`, or all `AlternativeRows`.
    """

    def __init__(
        self, root: Node, alternatives: Callable[[Node], Iterator[Alternative[Node] | AlternativeRows[Node]]]
    ) -> None:
        self.root = root
        self._ways: dict[Node, list[Any]] = {}
        self._below: dict[Node, list[Any]] = {}
        self._inside: dict[Node, Any] = {}
        # depth-first traversal with a stack, because the graph may be deeper than the recursion limit
        waiting = [(root, False)]
        while waiting:
            node, known = waiting.pop()
            if known:
                self._below[node] = [prod(way.below(self._inside), start=way.weight) for way in self._ways[node]]
                both = zip(self._ways[node], self._below[node], strict=True)
                self._inside[node] = sum(way.sum_at_node(below) for way, below in both)
            elif node not in self._ways:
                self._ways[node] = list(alternatives(node))
                # second visit, when the inside sums of all parts are known
                waiting.append((node, True))
                waiting += [(part, False) for way in self._ways[node] for part in way.parts]

    @property
    def total(self) -> Any:
        """Total weight of all derivations; an array with one entry per row if the root is a table."""
        return self._inside[self.root]

    @cached_property
    def marginals(self) -> dict[Hashable, Any]:
        """Total weight of all derivations in which each fact is true. Facts that are in no derivation are absent.

        If nodes are tables, the key is a variable and the value is an array with the weight of each of its values.
        """
        outside: dict[Node, Any] = dict.fromkeys(self._inside, 0)
        outside[self.root] = self._inside[self.root] ** 0  # 1 for each row
        found: dict[Hashable, Any] = {}
        for node in reversed(self._inside):  # in reverse order, every node comes after all nodes that refer to it
            for way, below in zip(self._ways[node], self._below[node], strict=True):
                around, inside = way.around(outside[node]), way.below(self._inside)
                way.tell(found, around, below)
                for at, part in enumerate(way.parts):
                    # not total / inside[at], which may be 0
                    beside = prod(inside[:at] + inside[at + 1 :], start=around * way.weight)
                    outside[part] = outside[part] + way.sum_at_part(at, beside, self._inside[part])
        return found

    def draw(self, probability: Random) -> list[Hashable]:
        """Return the facts of one derivation, drawn with a probability proportional to its weight. Nodes must not be
        tables.
        """
        found: list[Hashable] = []
        waiting = [self.root]
        while waiting:
            node = waiting.pop()
            chosen = self._ways[node][draw_index(self._below[node], probability)]
            found += chosen.tells
            waiting += chosen.parts
        return found


def draw_index(weights: list[int], probability: Random) -> int:
    """Draw an index with a probability proportional to its integer weight, without rounding. One weight must be
    positive.
    """
    # integers, because floats would round the probabilities of large weights
    left = probability.randrange(sum(weights))
    return next(at for at, reached in enumerate(accumulate(weights)) if left < reached)


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
