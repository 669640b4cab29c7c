"""Alternatives with weights, each made of independent parts with alternatives of their own: totals, marginals, draws.

The inside-outside algorithm (Baker 1979; on a chain forward-backward, Baum 1970). The weight of a whole is the product
of those of the alternatives chosen in it. Of each node the inside sum is the weight of all ways on from it, the outside
sum that of all ways around it, and their product that of all that pass. Of whole numbers all sums are exact.

Where there are millions, a node is a table: each row is a node of its own, and the alternatives of all rows are arrays.
`relative_entropy` and `entropy` measure what probabilities tell, in bits.
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
    """One way on from a node."""

    weight: int
    """Its own, not negative."""
    tells: tuple[Hashable, ...] = ()
    """What holds where it is chosen; no whole tells the same twice."""
    parts: tuple[Node, ...] = ()
    """Nodes, at each of which one alternative is chosen independently."""

    def below(self, inside: Mapping[Node, int]) -> list[int]:
        """Of each part the inside sum."""
        return [inside[part] for part in self.parts]

    def around(self, outside: int) -> int:
        """The outside sum of the node that it is a way on from."""
        return outside

    def sum_at_node(self, values: int) -> int:
        """What it adds to a sum of that node."""
        return values

    def sum_at_part(self, at: int, values: int, inside: int) -> int:
        """What it adds to a sum of a part."""
        return values

    def tell(self, found: dict[Hashable, Any], around: int, below: int) -> None:
        """Add to what it tells the weight of all wholes that it is in."""
        if through := around * below:
            for told in self.tells:
                found[told] = found.get(told, 0) + through


@dataclass(frozen=True, slots=True, eq=False)
class AlternativeRows(Generic[Node]):
    """All ways on from the rows of a table, one a row of arrays."""

    weight: Any
    """(m,) of each, or one for all; may have either sign."""
    size: int
    """Rows of the table."""
    owners: Ints | None
    """(m,) the row of the table that it is a way on from; None: its own."""
    leads: tuple[tuple[Node, Ints], ...] = ()
    """Its parts: tables, each with (m,) the row in it."""
    tells: tuple[tuple[Hashable, int, Ints], ...] = ()
    """What is told with several answers, their number, and (m,) which of them it tells."""

    @property
    def parts(self) -> tuple[Node, ...]:
        """The tables alone."""
        return tuple(part for part, _ in self.leads)

    def below(self, inside: Mapping[Node, NDArray[Any]]) -> list[NDArray[Any]]:
        """As for one."""
        return [inside[part][rows] for part, rows in self.leads]

    def around(self, outside: NDArray[Any]) -> NDArray[Any]:
        """As for one."""
        return outside if self.owners is None else outside[self.owners]

    def sum_at_node(self, values: NDArray[Any]) -> NDArray[Any]:
        """As for one."""
        return values if self.owners is None else sums_by(self.owners, values, self.size)

    def sum_at_part(self, at: int, values: NDArray[Any], inside: NDArray[Any]) -> NDArray[Any]:
        """As for one."""
        return sums_by(self.leads[at][1], values, len(inside))

    def tell(self, found: dict[Hashable, Any], around: NDArray[Any], below: NDArray[Any]) -> None:
        """As for one, an array of all answers."""
        for told, size, answers in self.tells:
            found[told] = found.get(told, 0) + sums_by(answers, around * below, size)


class WeightedAlternatives(Generic[Node]):
    """All wholes that begin at a node.

    Parameters
    ----------
    root : hashable
    alternatives : callable
        The ways on from a node, of which none leads back to it. All of them `Alternative`, or all `AlternativeRows`.
    """

    def __init__(
        self, root: Node, alternatives: Callable[[Node], Iterator[Alternative[Node] | AlternativeRows[Node]]]
    ) -> None:
        self.root = root
        self._ways: dict[Node, list[Any]] = {}
        self._below: dict[Node, list[Any]] = {}
        self._inside: dict[Node, Any] = {}
        waiting = [(root, False)]
        while waiting:
            node, known = waiting.pop()
            if known:
                self._below[node] = [prod(way.below(self._inside), start=way.weight) for way in self._ways[node]]
                both = zip(self._ways[node], self._below[node], strict=True)
                self._inside[node] = sum(way.sum_at_node(below) for way, below in both)
            elif node not in self._ways:
                self._ways[node] = list(alternatives(node))
                waiting.append((node, True))
                waiting += [(part, False) for way in self._ways[node] for part in way.parts]

    @property
    def total(self) -> Any:
        """The weight of all wholes; of a table, of those from each row on."""
        return self._inside[self.root]

    @cached_property
    def marginals(self) -> dict[Hashable, Any]:
        """By what is told, the weight of all wholes that tell it; what none tells is not there.

        Of a table, the weights of all answers.
        """
        outside: dict[Node, Any] = dict.fromkeys(self._inside, 0)
        outside[self.root] = self._inside[self.root] ** 0  # 1 for each row
        found: dict[Hashable, Any] = {}
        for node in reversed(self._inside):  # each after all that lead to it
            for way, below in zip(self._ways[node], self._below[node], strict=True):
                around, inside = way.around(outside[node]), way.below(self._inside)
                way.tell(found, around, below)
                for at, part in enumerate(way.parts):
                    beside = prod(inside[:at] + inside[at + 1 :], start=around * way.weight)
                    outside[part] = outside[part] + way.sum_at_part(at, beside, self._inside[part])
        return found

    def draw(self, chance: Random) -> list[Hashable]:
        """What one whole tells, drawn with the chance that its weight has among all; not of tables."""
        found: list[Hashable] = []
        waiting = [self.root]
        while waiting:
            node = waiting.pop()
            chosen = self._ways[node][draw_index(self._below[node], chance)]
            found += chosen.tells
            waiting += chosen.parts
        return found


def draw_index(weights: list[int], chance: Random) -> int:
    """An index with exactly the chance of its weight among all, of which one at least is positive."""
    left = chance.randrange(sum(weights))
    return next(at for at, reached in enumerate(accumulate(weights)) if left < reached)


def sums_by(owners: Ints, values: NDArray[Any], size: int) -> NDArray[Any]:
    """Values added up by owner, (size,); whole numbers stay exact."""
    found: NDArray[Any] = np.zeros(size, dtype=values.dtype)
    np.add.at(found, owners, values)
    return found


# ---------------------------------------------------------------------------------- information in bits (Shannon 1948)


def relative_entropy(after: Iterable[float], before: Iterable[float | Fraction]) -> float:
    """What is learnt where chances `before` become chances `after` [bit]; 0 where nothing changes."""
    pairs = zip(after, before, strict=False)
    # never negative but for rounding
    return max(0.0, sum(chance * log2(chance / prior) for chance, prior in pairs if chance))


def entropy(chances: Iterable[float]) -> float:
    """What an answer is expected to tell [bit]: each leaves itself alone, with its chance.

    It is the mean of the relative entropies of what is known after each answer and before.
    """
    return sum((chance * relative_entropy((1.0,), (chance,)) for chance in chances if chance), 0.0)
