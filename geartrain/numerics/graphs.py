"""Paths in a rooted forest: what several rooms ask of a small graph.

A forest is given by the vertex above each one; None above a root. It may be as deep as it likes: nothing recurs.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import TypeVar

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
