"""Tours of the ends of a train: from the input past the dials and back, each added wheel is passed twice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from itertools import pairwise, permutations

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
    tours = ((0, *order, 0) for order in permutations(range(1, number)) if order[:1] <= order[-1:])
    return min(sum(far[one * number + two] for one, two in pairwise(tour)) for tour in tours)


@lru_cache(maxsize=1 << 16)
def tours_with_one_more(number: int, far: tuple[int, ...]) -> tuple[tuple[int, int, int], ...]:
    """By two ends between which one more may stand on a tour: the least length of the rest."""
    if number == 1:
        return ((0, 0, 0),)
    best: dict[tuple[int, int], int] = {}
    for order in permutations(range(number)):
        if order[0] < order[-1]:
            rest = sum(far[one * number + two] for one, two in pairwise(order))
            best[order[0], order[-1]] = min(rest, best.get((order[0], order[-1]), rest))
    return tuple((one, two, rest) for (one, two), rest in best.items())
