"""Orders and places that keep what belongs together close: of rows and columns, and of vertices on a page."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import cos, inf, pi, sin
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


Pairs = Sequence[tuple[str, str]]
_PASSES = 12
_STEPS = 300


def arrange(items: Sequence[str], pairs: Pairs) -> list[str]:
    """The items in an order in which the two of each pair stand close: least sum of distances, by moving one at a time.

    The same items and pairs give the same order.
    """
    order = _walk(items, pairs)
    at = {item: position for position, item in enumerate(order)}
    ends = [(at[one], at[other]) for one, other in pairs if one != other and one in at and other in at]
    sequence = list(range(len(order)))
    best = _length(sequence, ends)
    for _ in range(_PASSES):
        before = best
        for item in range(len(sequence)):
            sequence, best = _moved(sequence, item, ends, best)
        if best == before:
            break
    return [order[item] for item in sequence]


def _walk(items: Sequence[str], pairs: Pairs) -> list[str]:
    """Breadth first from the first item of each part."""
    mates = neighbours(items, pairs)
    seen: dict[str, None] = {}
    for item in items:
        queue = deque([item])
        while queue:
            here = queue.popleft()
            if here not in seen:
                seen[here] = None
                queue.extend(other for other in mates[here] if other not in seen)
    return list(seen)


def neighbours(items: Sequence[str], pairs: Pairs) -> dict[str, list[str]]:
    """Item -> the items it is paired with, in the order of the pairs."""
    mates: dict[str, list[str]] = {item: [] for item in items}
    for one, other in pairs:
        if one in mates and other in mates and one != other:
            mates[one].append(other)
            mates[other].append(one)
    return mates


def _length(sequence: Sequence[int], ends: Sequence[tuple[int, int]]) -> int:
    place = [0] * len(sequence)
    for position, item in enumerate(sequence):
        place[item] = position
    return sum(abs(place[one] - place[other]) for one, other in ends)


def _moved(sequence: list[int], item: int, ends: Sequence[tuple[int, int]], best: int) -> tuple[list[int], int]:
    """The best place for one item, the others staying in order; its old one unless another is better."""
    rest = [other for other in sequence if other != item]
    found = sequence
    for position in range(len(sequence)):
        trial = [*rest[:position], item, *rest[position:]]
        length = _length(trial, ends)
        if length < best:
            found, best = trial, length
    return found, best


def spread(wanted: Sequence[float], needs: Sequence[float], bounds: tuple[float, float] = (-inf, inf)) -> list[float]:
    """Middles of boxes that do not overlap, in the order of the wanted ones and near to them.

    needs    width of each box
    bounds   within which they stay as far as there is room
    """
    order = sorted(range(len(wanted)), key=lambda at: wanted[at])
    clusters: list[tuple[list[int], float]] = []  # members, and the place of the first
    for at in order:
        clusters.append(([at], _kept([at], wanted[at], needs, bounds)))
        while len(clusters) > 1 and _overlap(clusters[-2], clusters[-1], needs):
            members = clusters[-2][0] + clusters[-1][0]
            shifts = [wanted[each] - step for each, step in zip(members, _steps(members, needs), strict=True)]
            clusters[-2:] = [(members, _kept(members, sum(shifts) / len(shifts), needs, bounds))]
    places = [0.0] * len(wanted)
    for members, first in clusters:
        for each, step in zip(members, _steps(members, needs), strict=True):
            places[each] = first + step
    return places


def _kept(members: Sequence[int], first: float, needs: Sequence[float], bounds: tuple[float, float]) -> float:
    """Place of the first box at which a row of boxes is within bounds; from the left where it is too long."""
    most = bounds[1] - needs[members[-1]] / 2 - _steps(members, needs)[-1]
    return max(min(first, most), bounds[0] + needs[members[0]] / 2)


def _steps(members: Sequence[int], needs: Sequence[float]) -> list[float]:
    """Distances from the first box."""
    steps = [0.0]
    for one, other in pairwise(members):
        steps.append(steps[-1] + (needs[one] + needs[other]) / 2)
    return steps


def _overlap(left: tuple[list[int], float], right: tuple[list[int], float], needs: Sequence[float]) -> bool:
    end = left[1] + _steps(left[0], needs)[-1]
    # boxes that just touch do not overlap, whatever rounding says
    return right[1] - end < (needs[left[0][-1]] + needs[right[0][0]]) / 2 - 1e-12


def settle(items: Sequence[str], pairs: Pairs, lengths: Mapping[tuple[str, str], float]) -> Floats:
    """Places (n, 2) in which paired items stand about their length apart, and others as far as their paths are long.

    lengths   of each pair, in either order; stress majorization from places on a circle in arranged order
    (Gansner, Koren and North 2004, Graph drawing by stress majorization, equation 3)
    """
    count = len(items)
    order = {item: at for at, item in enumerate(arrange(items, pairs))}
    angle = [2 * pi * order[item] / count for item in items]
    places = np.array([(cos(each), sin(each)) for each in angle]) * count**0.5
    wanted = _distances(items, pairs, lengths)
    weights = np.where(wanted > 0, 1 / np.where(wanted > 0, wanted, 1.0) ** 2, 0.0)
    # a Laplacian is singular: moving all alike costs nothing, and the pseudoinverse leaves the mean where it is
    inverse = np.linalg.pinv(np.diag(weights.sum(1)) - weights)
    for _ in range(_STEPS):
        apart: Any = places[:, None, :] - places[None, :, :]
        distance = np.sqrt((apart**2).sum(2))
        # two at one place have no direction to be pushed in, and do not pull: the others part them
        pull = -weights * wanted / np.where(distance > 1e-9, distance, 1.0)
        pull[distance <= 1e-9] = 0.0
        np.fill_diagonal(pull, 0.0)
        np.fill_diagonal(pull, -pull.sum(1))
        places = inverse @ (pull @ places)
    return np.asarray(np.round(places, 4))  # coarser than the rounding of the linear algebra of any machine


def _distances(items: Sequence[str], pairs: Pairs, lengths: Mapping[tuple[str, str], float]) -> Floats:
    """Lengths of the shortest paths (n, n)."""
    at = {item: position for position, item in enumerate(items)}
    far = np.full((len(items), len(items)), np.inf)
    np.fill_diagonal(far, 0.0)
    for one, other in pairs:
        i, j = at[one], at[other]
        length = lengths[one, other] if (one, other) in lengths else lengths[other, one]
        far[i, j] = far[j, i] = min(far[i, j], length) if i != j else 0.0
    for middle in range(len(items)):
        far = np.minimum(far, far[:, middle, None] + far[None, middle, :])
    return np.where(np.isfinite(far), far, 0.0)
