"""Alternatives with weights, each made of independent parts with alternatives of their own: totals, marginals, draws.

The weight of a whole is the product of those of the alternatives chosen in it. Of each node the inside sum is the
weight of all ways on from it, the outside sum that of all ways around it, and their product that of all that pass.
Weights are whole numbers, so that all sums are exact.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from math import prod
from random import Random
from typing import Generic, TypeVar

Node = TypeVar("Node", bound=Hashable)


@dataclass(frozen=True, slots=True)
class Alternative(Generic[Node]):
    """One way on from a node.

    weight  its own, not negative
    tells   what holds where it is chosen; no whole tells the same twice
    parts   nodes, at each of which one alternative is chosen independently
    """

    weight: int
    tells: tuple[Hashable, ...] = ()
    parts: tuple[Node, ...] = ()


class WeightedAlternatives(Generic[Node]):
    """All wholes that begin at a node.

    Parameters
    ----------
    root : hashable
    alternatives : callable
        The ways on from a node, of which none leads back to it.
    """

    def __init__(self, root: Node, alternatives: Callable[[Node], Iterator[Alternative[Node]]]) -> None:
        self.root = root
        self._ways: dict[Node, list[Alternative[Node]]] = {}
        self._inside: dict[Node, int] = {}
        waiting = [(root, False)]
        while waiting:
            node, known = waiting.pop()
            if known:
                ways = [way for way in self._ways[node] if self._below(way)]
                self._ways[node] = ways
                self._inside[node] = sum(self._below(way) for way in ways)
            elif node not in self._ways:
                self._ways[node] = list(alternatives(node))
                waiting.append((node, True))
                waiting += [(part, False) for way in self._ways[node] for part in way.parts]

    def _below(self, way: Alternative[Node]) -> int:
        return way.weight * prod(self._inside[part] for part in way.parts)

    @property
    def total(self) -> int:
        """The weight of all wholes."""
        return self._inside[self.root]

    @cached_property
    def marginals(self) -> dict[Hashable, int]:
        """By what is told, the weight of all wholes that tell it; what none tells is not there."""
        outside: dict[Node, int] = dict.fromkeys(self._inside, 0)
        outside[self.root] = 1
        found: dict[Hashable, int] = {}
        for node in reversed(self._inside):  # each after all that lead to it
            around = outside[node]
            if not around:
                continue
            for way in self._ways[node]:
                through = around * self._below(way)
                for told in way.tells:
                    found[told] = found.get(told, 0) + through
                for at, part in enumerate(way.parts):
                    beside = prod(self._inside[other] for nth, other in enumerate(way.parts) if nth != at)
                    outside[part] += around * way.weight * beside
        return found

    def draw(self, chance: Random) -> list[Hashable]:
        """What one whole tells, drawn with the chance that its weight has among all."""
        found: list[Hashable] = []
        waiting = [self.root]
        while waiting:
            ways = self._ways[waiting.pop()]
            chosen = ways[draw_index([self._below(way) for way in ways], chance)]
            found += chosen.tells
            waiting += chosen.parts
        return found


def draw_index(weights: list[int], chance: Random) -> int:
    """An index with exactly the chance of its weight among all, of which one at least is positive."""
    left = chance.randrange(sum(weights))
    return next(at for at, reached in enumerate(accumulate(weights)) if left < reached)
