"""Ways to tooth numbers for one ratio: what makers do by hand, and what geartrain does, with one form of answer.

All take a ratio of 1 or more; the counts on top come from the wheels, those beneath from the pinions.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import combinations_with_replacement
from math import prod
from typing import Any, Literal

from geartrain import GearTrain
from geartrain.search import TargetRatio, approximants, find_stages, search_train
from geartrain.search.ratio.product_windows import multisets
from geartrain.search.tooth_count_ranges import Counts
from geartrain.train import Train

Pair = tuple[int, int]
Set = tuple[int, ...]
_MULTIPLES = 1000
_PLACES = 10**17


@dataclass(frozen=True, slots=True)
class RatioCase:
    """One question.

    name     of the ratio
    value    the ratio, exact, 1 or more
    stages   number of stages
    wheels   first and last count on top, `pinions` those beneath
    """

    name: str
    value: Fraction
    stages: int
    wheels: Pair
    pinions: Pair

    @property
    def top(self) -> range:
        """Counts on top."""
        return range(self.wheels[0], self.wheels[1] + 1)

    @property
    def beneath(self) -> range:
        """Counts beneath."""
        return range(self.pinions[0], self.pinions[1] + 1)

    @property
    def considered(self) -> int:
        """Pairs of unordered sets of counts."""
        return multisets(len(self.top), self.stages) * multisets(len(self.beneath), self.stages)


@dataclass(frozen=True, slots=True)
class Found:
    """What a way came to.

    error     |ratio / wanted - 1|, exact; None where nothing was found
    top       counts on top, `beneath` those beneath
    tries     candidates looked at one by one, or all that there are where `proved`
    proved    True if no set of counts is nearer
    seconds   since the start, where one run is told as it goes
    """

    error: Fraction | None
    top: Set = ()
    beneath: Set = ()
    tries: int = 0
    proved: bool = False
    seconds: float | None = None


def of_counts(case: RatioCase, top: Sequence[int], beneath: Sequence[int], tries: int, proved: bool = False) -> Found:
    """Counts with their exact error."""
    error = abs(Fraction(prod(top), prod(beneath)) / case.value - 1)
    return Found(error, tuple(sorted(top)), tuple(sorted(beneath)), tries, proved)


# by hand -------------------------------------------------------------------------------------------------------------


def factored(case: RatioCase, kind: Literal["convergent", "intermediate"]) -> Found:
    """The nearest fraction on the way to the ratio that can be cut into so many admissible counts.

    kind   "convergent" takes those of the continued fraction, "intermediate" all that the tree of Stern and Brocot
           passes. A fraction whose terms have a prime above all counts is dropped; others are multiplied above and
           below by up to 1000 whole numbers until both terms are products of counts.
    """
    most = max(case.wheels[1], case.pinions[1])
    walk = sorted(approximants(case.value, most**case.stages, kind), key=lambda one: abs(one.error))
    for tries, one in enumerate(walk, 1):
        sets = _cut(one.value, case) if _smooth(one.value.numerator * one.value.denominator, most) else None
        if sets:
            return of_counts(case, *sets, tries)
    return Found(None, tries=len(walk))


def _cut(fraction: Fraction, case: RatioCase) -> tuple[Set, Set] | None:
    p, q, k = fraction.numerator, fraction.denominator, case.stages
    first = max(-(-(case.wheels[0] ** k) // p), -(-(case.pinions[0] ** k) // q))
    last = min(case.wheels[1] ** k // p, case.pinions[1] ** k // q)
    for m in range(first, min(last, first + _MULTIPLES - 1) + 1):
        beneath = _multisets(m * q, case.beneath, k)
        top = _multisets(m * p, case.top, k) if beneath else []
        if top:
            return top[0], beneath[0]
    return None


def _multisets(product: int, counts: Sequence[int], size: int) -> list[Set]:
    """All multisets of `size` counts with this product, each ascending."""
    if size == 1:
        return [(product,)] if product in counts else []
    first = [(at, count) for at, count in enumerate(counts) if count**size <= product and product % count == 0]
    return [(count, *rest) for at, count in first for rest in _multisets(product // count, counts[at:], size - 1)]


def _smooth(number: int, most: int) -> bool:
    """True if no prime above `most` divides it."""
    for factor in range(2, most + 1):
        while number % factor == 0:
            number //= factor
    return number == 1


def by_stage(case: RatioCase, width: int = 1) -> Found:
    """Each stage takes a pair of counts near the equal share of the remaining ratio, the last stage all of it.

    width   pairs that each stage but the last tries; the best of all is kept
    """
    pick = partial(_nearest_pairs, case.top, case.beneath)
    best: tuple[Fraction, tuple[Pair, ...]] | None = None
    tries = 0
    for pairs in _shares(case.value, case.stages, pick, width):
        tries += 1
        error = abs(prod((Fraction(*pair) for pair in pairs), start=Fraction(1)) / case.value - 1)
        if best is None or error < best[0]:
            best = error, pairs
    if best is None:
        return Found(None, tries=tries)
    return of_counts(case, [a for a, _ in best[1]], [b for _, b in best[1]], tries)


def _shares(
    left: Fraction, stages: int, pick: Callable[[Fraction, int], Sequence[Pair]], width: int
) -> Iterator[tuple[Pair, ...]]:
    """Stages one after the other: an equal share of what is left is its root, by floats."""
    if stages == 1:
        for pair in pick(left, 1):
            yield (pair,)
        return
    share = Fraction(round(float(left) ** (1 / stages) * _PLACES), _PLACES)
    for pair in pick(share, width):
        for rest in _shares(left / Fraction(*pair), stages - 1, pick, width):
            yield (pair, *rest)


def _nearest_pairs(top: Counts, beneath: Counts, value: Fraction, number: int) -> list[Pair]:
    """The nearest pairs of one stage."""
    sides = (top, beneath) if value >= 1 else (beneath, top)
    return [(one.top[0], one.beneath[0]) for one in find_stages(TargetRatio(value), 1, *sides, best=number)]


# by geartrain --------------------------------------------------------------------------------------------------------


def by_products(case: RatioCase) -> Found:
    """Sorted products: the best of all sets, proved."""
    found = find_stages(TargetRatio(case.value), case.stages, case.top, case.beneath, best=1)
    return of_counts(case, found[0].top, found[0].beneath, case.considered, found.complete)


def in_train(train: Train, case: RatioCase) -> Found:
    """The search in a train of so many stages whose wheels are all free; proved."""
    found = search_train(train, best=1)
    teeth = found.solutions[0].teeth
    top, beneath = ([teeth[f"{side}{at}"] for at in range(case.stages)] for side in "ab")
    return of_counts(case, top, beneath, found.considered, found.complete and found.ranked)


def chain(case: RatioCase, tolerance: str = "") -> Train:
    """Stages a0 b0, a1 b1, ... one after the other; all wheels free, a on top."""
    meshes = [(f"L{at}", f"a{at}", f"L{at + 1}", f"b{at}") for at in range(case.stages)]
    counts = {wheel: case.wheels if wheel[0] == "a" else case.pinions for _, *pair in meshes for wheel in pair[::2]}
    return _train(meshes, counts, {f"L{case.stages}": case.value}, tolerance)


def _train(
    meshes: Sequence[tuple[str, str, str, str]],
    counts: Mapping[str, Pair],
    wanted: Mapping[str, Fraction],
    tolerance: str,
) -> Train:
    """Fixed axes; meshes are (link, wheel, link, wheel). What is wanted is a magnitude, hence a period."""
    links: dict[str, dict[str, Any]] = {"frame": {}}
    for one, first, other, second in meshes:
        for link, wheel in ((one, first), (other, second)):
            links.setdefault(link, {"wheels": {}})["wheels"][wheel] = {"teeth": {"search": list(counts[wheel])}}
    joints = [{"pair": ["frame", link], "axis": f"axis of {link}"} for link in links if link != "frame"]
    extra = {"tolerance": tolerance} if tolerance else {}
    outputs = {link: {"targets": [{"period": f"{1 / value} d", **extra}]} for link, value in wanted.items()}
    gears = [{"pair": [first, second]} for _, first, _, second in meshes]
    moved = {"inputs": {meshes[0][0]: 1}, "outputs": outputs}
    return GearTrain.declare(
        {"name": "stages", "unit": {"per": "1 d"}, "links": links, "revolutes": joints, "gears": gears, **moved}
    ).declaration


# every set -----------------------------------------------------------------------------------------------------------


def every_set(case: RatioCase, patience: float) -> list[Found]:
    """Plain brute force: all sets on top with all beneath, in the order of the counts, told whenever one is better.

    patience   seconds after which it is given up. Floats pass over what is surely no better, Fractions decide. An
               error of 0 ends the search: nothing is better.
    """
    start = time.perf_counter()
    trace: list[Found] = []
    tops = list(map(prod, combinations_with_replacement(case.top, case.stages)))
    value = float(case.value)
    best, tries, ended = Fraction(10**9), 0, True
    for beneath in combinations_with_replacement(case.beneath, case.stages):
        found = _best_in(tops, prod(beneath), case.value, value, best)
        tries += len(tops)
        if found is not None:
            best, top = found
            trace.append(_told(case, best, top, beneath, tries, start))
        ended = not best or beneath[0] == case.pinions[1]
        if not best or time.perf_counter() - start > patience:
            break
    last = trace[-1]
    return [
        *trace[:-1],
        last,
        Found(last.error, last.top, last.beneath, tries, ended, time.perf_counter() - start),
    ]


def _best_in(
    tops: Sequence[int], beneath: int, exact: Fraction, value: float, best: Fraction
) -> tuple[Fraction, int] | None:
    """The least |error| below `best` of all products on top over one beneath, and the product's place."""
    found = None
    wanted = value * beneath
    slack = wanted * (float(best) * (1 + 1e-9) + 1e-14)
    low, high = wanted - slack, wanted + slack
    for at, product in enumerate(tops):
        if low < product < high:
            error = abs(Fraction(product, beneath) / exact - 1)
            if error < best:
                best, found = error, at
                slack = wanted * (float(best) * (1 + 1e-9) + 1e-14)
                low, high = wanted - slack, wanted + slack
    return None if found is None else (best, found)


def _told(case: RatioCase, best: Fraction, at: int, beneath: Set, tries: int, start: float) -> Found:
    for place, top in enumerate(combinations_with_replacement(case.top, case.stages)):
        if place == at:
            return Found(best, top, beneath, tries, seconds=time.perf_counter() - start)
    raise AssertionError(at)
