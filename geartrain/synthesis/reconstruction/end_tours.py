"""Tours of the ends of a train: from the input past the dials and back, each added wheel is passed twice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

EndPair = tuple[str, str]
"""Two ends by name, sorted."""


def end_pair(one: str, other: str) -> EndPair:
    """Two ends as a pair."""
    return (one, other) if one < other else (other, one)


def distances(ends: Sequence[str], far: Mapping[EndPair, int]) -> tuple[int, ...]:
    """How far each end is from each, row by row; 0 where that is not known."""
    return tuple(far.get(end_pair(one, two), 0) for one in ends for two in ends)


@lru_cache(maxsize=1 << 16)
def shortest_tour(number: int, far: tuple[int, ...]) -> int:
    """The least length of a tour from the first end past all others and back."""
    return min(far[one * number + two] + rest for one, two, rest in tours_with_one_more(number, far))


@lru_cache(maxsize=1 << 16)
def tours_with_one_more(number: int, far: tuple[int, ...]) -> tuple[tuple[int, int, int], ...]:
    """By two ends between which one more may stand on a tour: the least length of the rest."""
    orders, first, pairs = _orders(number)
    lengths = np.array(far, dtype=np.int64)[orders].sum(axis=1)
    least = np.minimum.reduceat(lengths, first)
    return tuple((one, two, rest) for (one, two), rest in zip(pairs, least.tolist(), strict=True))


@lru_cache(maxsize=16)
def _orders(number: int) -> tuple[NDArray[np.int64], NDArray[np.int64], tuple[tuple[int, int], ...]]:
    """Orders of ends, one of each two that are the reverse of each other, those between the same two ends together.

    By order, its steps as places in a table of distances; where those between two ends begin; and these two ends.
    """
    orders = [order for order in permutations(range(number)) if order[0] <= order[-1]]
    orders.sort(key=lambda order: (order[0], order[-1]))
    ends = np.array([(order[0], order[-1]) for order in orders])
    first = np.flatnonzero((np.diff(ends, axis=0, prepend=-1) != 0).any(axis=1))
    whole = np.array(orders)
    pairs = tuple((int(one), int(two)) for one, two in ends[first])
    return whole[:, :-1] * number + whole[:, 1:], first, pairs
