"""Paths in a rooted forest, and disjoint sets (union-find), optionally with known ratios between elements.

A forest is given by a function that returns the parent of a vertex, and None for a root. All algorithms are iterative,
so that the forest can have any depth.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from fractions import Fraction
from itertools import pairwise
from typing import Generic, TypeVar

V = TypeVar("V", bound=Hashable)


def chain_to_root(vertex: V, above: Callable[[V], V | None]) -> list[V]:
    """Return a vertex and its ancestors, in ascending order up to the root, for which `above` returns None."""
    chain = [vertex]
    while (vertex_above := above(chain[-1])) is not None:
        chain.append(vertex_above)
    return chain


def ways_to_common_ancestor(i: V, j: V, above: Callable[[V], V | None]) -> tuple[list[V], list[V]]:
    """Return the paths from two vertices of one tree to their lowest common ancestor, with which both paths end.

    The two paths and the edge (i, j) form the fundamental cycle of this edge.

    >>> ways_to_common_ancestor("c", "d", {"c": "b", "b": "a", "d": "b"}.get)
    (['c', 'b'], ['d', 'b'])
    """
    up, down = chain_to_root(i, above), chain_to_root(j, above)
    # both chains end at the root, so their common end is removed from there
    while len(up) > 1 and len(down) > 1 and up[-2] == down[-2]:
        up.pop()
        down.pop()
    return up, down


class DisjointSets(Generic[V]):
    """Disjoint sets that can only be merged (union-find). An element that has not been merged is a set by itself."""

    def __init__(self) -> None:
        self._above: dict[V, V] = {}

    def find(self, thing: V) -> V:
        """Return the representative of an element's set; it is the same for all elements until sets are merged."""
        above = self._above
        while (head := above.setdefault(thing, thing)) != thing:
            above[thing] = above[head]  # path halving
            thing = above[thing]
        return thing

    def join(self, first: V, second: V) -> None:
        """Merge the sets of two elements."""
        self._above[self.find(second)] = self.find(first)

    def are_apart(self, first: V, second: V) -> bool:
        """Return True if two elements are in different sets."""
        return self.find(first) != self.find(second)


class RatioSets(Generic[V]):
    """Sets of quantities with known ratios: union-find with exact weights.

    A new quantity is in a set by itself. `join` does not change ratios that are already known.

    >>> sizes = RatioSets()
    >>> sizes.join("inch", "foot", Fraction(12))
    >>> sizes.join("yard", "foot", Fraction(1, 3))
    >>> sizes.ratio("yard", "inch"), sizes.ratio("yard", "mile")
    (Fraction(36, 1), None)
    """

    def __init__(self) -> None:
        self._above: dict[V, tuple[V, Fraction]] = {}

    def root(self, thing: V) -> tuple[V, Fraction]:
        """Return the representative of a quantity's set, and the quantity divided by this representative."""
        way = []
        while (step := self._above.get(thing)) is not None:
            way.append((thing, step[1]))
            thing = step[0]
        times = Fraction(1)
        for passed, factor in reversed(way):  # path compression
            times *= factor
            self._above[passed] = thing, times
        return thing, times

    def join(self, first: V, second: V, ratio: Fraction) -> None:
        """Record that the second quantity is `ratio` times the first, unless their ratio is already known."""
        (root, times), (other, multiple) = self.root(first), self.root(second)
        if root != other:
            # the ratio of the representatives follows from the ratio of their members
            self._above[other] = root, ratio * times / multiple

    def ratio(self, first: V, second: V) -> Fraction | None:
        """Return the first quantity divided by the second; None if their ratio is unknown."""
        (root, times), (other, multiple) = self.root(first), self.root(second)
        return times / multiple if root == other else None


def joined_groups(things: Iterable[V], joints: Iterable[Iterable[V]]) -> list[list[V]]:
    """Return groups of elements that are connected by joints; a joint connects any number of elements.

    Groups are in the order of their first members, and members are in the given order. Members of a joint that are not
    in `things` are ignored.

    >>> joined_groups("abcde", ["cax", "eb", "xd"])
    [['a', 'c'], ['b', 'e'], ['d']]
    """
    sets: DisjointSets[V] = DisjointSets()
    order = dict.fromkeys(things)
    for joint in joints:
        for first, second in pairwise(thing for thing in joint if thing in order):
            sets.join(first, second)
    groups: dict[V, list[V]] = {}
    for thing in order:
        groups.setdefault(sets.find(thing), []).append(thing)
    return list(groups.values())
