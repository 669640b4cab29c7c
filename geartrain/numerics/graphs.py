"""Paths in a rooted forest, and groups of things that are joined: what several rooms ask of a small graph.

A forest is given by the vertex above each one; None above a root. It may be as deep as it likes: nothing recurs.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from fractions import Fraction
from itertools import pairwise
from typing import Generic, TypeVar

V = TypeVar("V", bound=Hashable)


def chain_to_root(vertex: V, above: Callable[[V], V | None]) -> list[V]:
    """A vertex and all that stand above it, up to its root."""
    chain = [vertex]
    while (vertex_above := above(chain[-1])) is not None:
        chain.append(vertex_above)
    return chain


def ways_to_common_ancestor(i: V, j: V, above: Callable[[V], V | None]) -> tuple[list[V], list[V]]:
    """The ways from two vertices of one tree up to the nearest vertex above both; each ends with that one.

    With the edge i j they make the fundamental cycle of that edge.

    >>> ways_to_common_ancestor("c", "d", {"c": "b", "b": "a", "d": "b"}.get)
    (['c', 'b'], ['d', 'b'])
    """
    up, down = chain_to_root(i, above), chain_to_root(j, above)
    while len(up) > 1 and len(down) > 1 and up[-2] == down[-2]:
        up.pop()
        down.pop()
    return up, down


def tree_path(i: V, j: V, above: Callable[[V], V | None]) -> list[V]:
    """The vertices on the way from i to j in one tree, both ends included."""
    up, down = ways_to_common_ancestor(i, j, above)
    return up + down[-2::-1]


class DisjointSets(Generic[V]):
    """Things in groups that only grow together (union-find); a thing not heard of before is a group by itself."""

    def __init__(self) -> None:
        self._above: dict[V, V] = {}

    def find(self, thing: V) -> V:
        """The head of a thing's group: the same for all of its members until the group grows."""
        above = self._above
        while (head := above.setdefault(thing, thing)) != thing:
            above[thing] = above[head]  # path halving: half the way for the next to ask
            thing = above[thing]
        return thing

    def join(self, first: V, second: V) -> None:
        """Make one group of the groups of two things."""
        self._above[self.find(second)] = self.find(first)

    def are_apart(self, first: V, second: V) -> bool:
        """True if two things are in different groups."""
        return self.find(first) != self.find(second)


class RatioSets(Generic[V]):
    """Things whose sizes are known multiples of one another: a union-find with exact weights.

    A thing not heard of before is known against itself only. What is said first counts: `join` changes no known ratio.

    >>> sizes = RatioSets()
    >>> sizes.join("inch", "foot", Fraction(12))
    >>> sizes.join("yard", "foot", Fraction(1, 3))
    >>> sizes.ratio("yard", "inch"), sizes.ratio("yard", "mile")
    (Fraction(36, 1), None)
    """

    def __init__(self) -> None:
        self._above: dict[V, tuple[V, Fraction]] = {}

    def root(self, thing: V) -> tuple[V, Fraction]:
        """The head of a thing's group, and how many times the head's size its own is."""
        way = []
        while (step := self._above.get(thing)) is not None:
            way.append((thing, step[1]))
            thing = step[0]
        times = Fraction(1)
        for passed, factor in reversed(way):  # all on the way hang on the head from now on
            times *= factor
            self._above[passed] = thing, times
        return thing, times

    def join(self, first: V, second: V, ratio: Fraction) -> None:
        """Make the size of the second `ratio` times that of the first, where nothing says how large it is."""
        (root, times), (other, multiple) = self.root(first), self.root(second)
        if root != other:
            self._above[other] = root, ratio * times / multiple

    def ratio(self, first: V, second: V) -> Fraction | None:
        """Size of the first over that of the second; None where it is not known."""
        (root, times), (other, multiple) = self.root(first), self.root(second)
        return times / multiple if root == other else None


def joined_groups(things: Iterable[V], joints: Iterable[Iterable[V]]) -> list[list[V]]:
    """The groups of things that joints, each between any number of things, hold together.

    Groups stand in the order of their first members, and members in the order given. What a joint names beside the
    things does not count.

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
