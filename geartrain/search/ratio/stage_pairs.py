"""Which count on top meshes with which beneath: the stages that a set of counts over another can be paired to."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import combinations, permutations
from math import gcd, prod
from typing import TYPE_CHECKING

import numpy as np

from geartrain.search.ratio.stage_problem import StageConstraints

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Ints


Pairs = tuple[tuple[int, int], ...]
_CHUNK = 1 << 18  # numbers handled at once
_TABLE = 1024  # up to here, a table tells which counts are coprime


@dataclass(frozen=True, slots=True)
class FeasiblePairings:
    """What the pairings that satisfy a fit have at best, for many pairs of sets at once.

    possible  some pairing satisfies the fit, (n,)
    coprime   most stages with coprime counts among these pairings, (n,); 0 where there are none
    centres   fewest different centre distances among these pairings, (n,); large where there are none
    """

    possible: Bools
    coprime: Ints
    centres: Ints

    def taken(self, at: Ints) -> FeasiblePairings:
        """Some of them."""
        return FeasiblePairings(self.possible[at], self.coprime[at], self.centres[at])


def suited(
    tops: Ints, beneaths: Ints, fit: StageConstraints, *, coprime: bool = True, centres: bool = True
) -> FeasiblePairings:
    """Judge sets of counts, (n, k) on top and beneath, by all k! pairings and choices of the meshes with a ring.

    coprime, centres   False: not wanted; then left at 0
    """
    size = tops.shape[1]
    step = max(_CHUNK // (len(_arrangements(size, fit.internal)[0]) * size), 1)
    # one chunk at least, so that an empty answer has its columns too
    parts = [
        _judged(tops[at : at + step], beneaths[at : at + step], fit, coprime, centres)
        for at in range(0, max(len(tops), 1), step)
    ]
    return FeasiblePairings(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _judged(
    tops: Ints, beneaths: Ints, fit: StageConstraints, coprime: bool, centres: bool
) -> tuple[Bools, Ints, Ints]:
    """The columns of `FeasiblePairings`."""
    size = tops.shape[1]
    orders, rings, meshes, ringed = _arrangements(size, fit.internal)
    possible = np.ones((len(tops), len(orders)), dtype=bool)
    alone = kinds = np.zeros(possible.shape, dtype=np.int64)
    if fit.hunting or coprime:
        # pairs as bits of one integer: an arrangement is tested by one `and`
        alone = np.bitwise_count(_code(_coprime(tops, beneaths))[:, None] & meshes).astype(np.int64)
        if fit.hunting:
            possible &= alone == size
    if fit.internal:
        possible &= (_code(tops[:, :, None] != beneaths[:, None, :])[:, None] & ringed) == ringed
    if fit.reverted or centres:
        tall, short = tops[:, None, :], beneaths[:, orders]
        distances = np.where(rings, np.abs(tall - short), tall + short)
        if fit.reverted:
            possible &= (distances[:, :, 1:] == distances[:, :, :1]).all(axis=2)
        if centres:
            distances.sort(axis=2)
            kinds = 1 + (distances[:, :, 1:] != distances[:, :, :-1]).sum(axis=2)
    return (
        np.asarray(possible.any(axis=1)),
        np.where(possible, alone, 0).max(axis=1),
        np.where(possible, kinds, 2 * size).min(axis=1),
    )


def _code(table: Bools) -> Ints:
    """A table of size x size truths as one integer: bit size i + j for count i on top with count j beneath."""
    size = table.shape[1]
    return table.reshape(len(table), size * size) @ (1 << np.arange(size * size, dtype=np.int64))


def _coprime(tops: Ints, beneaths: Ints) -> Bools:
    """Whether each count on top is coprime to each beneath, (n, k, k)."""
    most = int(max(tops.max(initial=1), beneaths.max(initial=1)))
    if most > _TABLE:
        return np.asarray(np.gcd(tops[:, :, None], beneaths[:, None, :]) == 1)
    return np.asarray(_coprime_table()[tops[:, :, None], beneaths[:, None, :]])


@lru_cache(maxsize=1)
def _coprime_table() -> Bools:
    numbers = np.arange(_TABLE + 1)
    return np.asarray(np.gcd(numbers[:, None], numbers) == 1)


@lru_cache(maxsize=32)
def _arrangements(size: int, internal: int) -> tuple[Ints, Bools, Ints, Ints]:
    """Every order of the counts beneath with every choice of the stages that have a ring.

    Orders and choices, (arrangements, size) each; then the meshes and those with a ring, as bits of `_code`.
    """
    choices = [[stage in chosen for stage in range(size)] for chosen in combinations(range(size), internal)]
    both = [(order, choice) for order in permutations(range(size)) for choice in choices]
    orders = np.array([order for order, _ in both], dtype=np.int64)
    rings = np.array([choice for _, choice in both], dtype=bool)
    bits = 1 << (size * np.arange(size) + orders)
    return orders, rings, bits.sum(axis=1), (bits * rings).sum(axis=1)


def best_pairing(
    top: tuple[int, ...], beneath: tuple[int, ...], fit: StageConstraints | None = None, *, centres: bool = False
) -> Pairs | None:
    """The best of the pairings that satisfy the fit, None if none does.

    Best: fewest different centre distances (only if `centres`), then most stages with coprime counts, then the most
    even ratios (least quotient of the greatest and the least). The last `fit.internal` of the pairs have the ring;
    before and behind that border pairs ascend.

    >>> best_pairing((39, 73, 91), (15, 34, 38))  # 39 and 15 have a common divisor
    ((39, 34), (73, 15), (91, 38))
    """
    fit = fit or StageConstraints()
    found: dict[Pairs, tuple[int, int]] = {}
    for order in set(permutations(beneath)):
        stages = tuple(zip(top, order, strict=True))
        for chosen in combinations(range(len(stages)), fit.internal):
            pairs = _sorted(stages, chosen)
            merit = _merit(pairs, fit, centres)
            if merit:
                found[pairs] = merit
    if not found:
        return None
    least, scale = min(found.values()), prod(beneath)
    return min((_spread(pairs, scale), pairs) for pairs, merit in found.items() if merit == least)[1]


def _sorted(stages: Pairs, chosen: tuple[int, ...]) -> Pairs:
    """External pairs first, then those with a ring, each ascending."""
    if not chosen:
        return tuple(sorted(stages))
    plain = sorted(pair for at, pair in enumerate(stages) if at not in chosen)
    return (*plain, *sorted(stages[at] for at in chosen))


def _merit(pairs: Pairs, fit: StageConstraints, centres: bool) -> tuple[int, int] | None:
    """What is compared first, least first; None if the pairing does not satisfy the fit."""
    border = len(pairs) - fit.internal
    coprime = sum(gcd(a, b) == 1 for a, b in pairs)
    if (fit.hunting and coprime < len(pairs)) or any(a == b for a, b in pairs[border:]):
        return None
    distances = 0
    if fit.reverted or centres:
        distances = len({a + b if at < border else abs(a - b) for at, (a, b) in enumerate(pairs)})
        if fit.reverted and distances > 1:
            return None
    return distances if centres else 0, -coprime


def _spread(pairs: Pairs, scale: int) -> Fraction:
    """Greatest ratio over least; `scale` is a multiple of all counts beneath."""
    ratios = [a * (scale // b) for a, b in pairs]
    return Fraction(max(ratios), min(ratios))
