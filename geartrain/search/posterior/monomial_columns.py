"""Many combinations at once: the monomials of their counts, exact as quotients of whole numbers."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Floats, Ints
from geartrain.search.join.partial_assignments import PartialAssignments
from geartrain.search.join.product_lists import ItemRecipe
from geartrain.search.join.wheel_monomials import IntervalConstraint, find_wheel_monomials

LARGEST = 1 << 62
"""Products of counts stay below this, so that they are exact in int64."""

Powers = Mapping[str, int]
"""Wheel -> its power in a monomial, never 0; powers of one monomial have no common divisor."""


Key = tuple[tuple[int, int], ...]
"""A product of powers of items: (item, power) pairs, items ascending, powers of either sign."""


class MonomialColumns(PartialAssignments):
    """Rows that hold the values of their items themselves, not places in a list.

    tops, bottoms   item -> (size,) int64, positive
    values          what was made of the rows, and by whom: values and bounds on their errors
    """

    __slots__ = ("_bottoms", "_products", "_tops", "values")

    def __init__(self, tops: Sequence[Ints], bottoms: Sequence[Ints], size: int) -> None:
        super().__init__((), {}, size)
        self._tops, self._bottoms = tops, bottoms
        self._products: dict[Key, Floats] = {}
        self.values: dict[object, tuple[Floats, Floats | None]] = {}

    def x(self, item: int) -> Floats:
        """Values of an item, float64: two conversions and one division, three roundings at most."""
        if item not in self._x:
            self._x[item] = self.top(item) / self.bottom(item)
        return self._x[item]

    def top(self, item: int) -> Ints:
        """Numerators of an item's values."""
        return self._tops[item]

    def bottom(self, item: int) -> Ints:
        """Denominators of an item's values."""
        return self._bottoms[item]

    def product(self, key: Key, plan: ProductPlan) -> Floats:
        """A product of items in float64: one rounding for each multiplication or division beside those of the items."""
        if key not in self._products:
            shorter, rest = plan.get(key, ((), key))
            found: Floats = self.product(shorter, plan) if shorter else np.ones(())
            for item, power in rest:
                for _ in range(abs(power)):
                    found = found * self.x(item) if power > 0 else found / self.x(item)
            self._products[key] = found
        return self._products[key]

    def pick(self, where: NDArray[np.generic]) -> MonomialColumns:
        """Some rows, by mask or by index."""
        size = int(where.sum()) if where.dtype == np.bool_ else len(where)
        return MonomialColumns([one[where] for one in self._tops], [one[where] for one in self._bottoms], size)


class CombinationColumns(MonomialColumns):
    """Rows of counts: the monomials are multiplied out when they are asked for.

    monomials   the items
    counts      wheel -> (size,) counts
    """

    __slots__ = ("_counts", "_monomials")

    def __init__(self, monomials: Sequence[Powers], counts: Mapping[str, Ints], size: int) -> None:
        super().__init__((), (), size)
        self._monomials, self._counts = monomials, counts

    def x(self, item: int) -> Floats:
        """Values of an item: one rounding at most for each factor, and one for each conversion."""
        if item not in self._x:
            self._x[item] = self._quotient(self._monomials[item])
        return self._x[item]

    def _quotient(self, powers: Powers) -> Floats:
        sides: list[Floats | None] = [None, None]
        for wheel, power in powers.items():
            for _ in range(abs(power)):
                side = sides[power > 0]
                if side is None:
                    sides[power > 0] = self._counts[wheel].astype(np.float64)
                else:
                    side *= self._counts[wheel]  # in place: new arrays cost more than what is done with them
        bottom, top = sides
        top = np.ones(()) if top is None else top
        return top if bottom is None else np.divide(top, bottom, out=bottom)

    def top(self, item: int) -> Ints:
        """As of `MonomialColumns`."""
        return self._whole(item, 1)

    def bottom(self, item: int) -> Ints:
        """As of `MonomialColumns`."""
        return self._whole(item, -1)

    def _whole(self, item: int, sign: int) -> Ints:
        found = np.ones(self.size, dtype=np.int64)
        for wheel, power in self._monomials[item].items():
            for _ in range(max(power * sign, 0)):
                found = found * self._counts[wheel]
        return found

    def pick(self, where: NDArray[np.generic]) -> MonomialColumns:
        """As of `MonomialColumns`."""
        size = int(where.sum()) if where.dtype == np.bool_ else len(where)
        return CombinationColumns(
            self._monomials, {wheel: column[where] for wheel, column in self._counts.items()}, size
        )


ProductPlan = Mapping[Key, tuple[Key, Key]]
"""Product -> a shorter one that it holds, and what is still to be multiplied."""


def find_product_plan(keys: Iterable[Key]) -> ProductPlan:
    """Products in few multiplications: each from the longest of the others that it holds."""
    plan: dict[Key, tuple[Key, Key]] = {}
    for key in sorted(dict.fromkeys(keys), key=lambda one: sum(abs(power) for _, power in one)):
        whole = dict(key)
        inside = [one for one in plan if all(_holds(whole.get(item, 0), power) for item, power in one)]
        longest = max(inside, key=lambda one: sum(abs(power) for _, power in one), default=())
        taken = dict(longest)
        rest = tuple((item, power - taken.get(item, 0)) for item, power in key if power != taken.get(item, 0))
        plan[key] = longest, rest
    return plan


def _holds(whole: int, power: int) -> bool:
    return 0 < power <= whole or whole <= power < 0


def recipe_of(powers: Powers) -> ItemRecipe:
    """A monomial as what is multiplied above and below."""
    above = tuple((wheel, power) for wheel, power in powers.items() if power > 0)
    return ItemRecipe(above, tuple((wheel, -power) for wheel, power in powers.items() if power < 0))


def find_monomials(asked: Sequence[IntervalConstraint], domains: Mapping[str, Sequence[int]]) -> tuple[Powers, ...]:
    """As few monomials as possible through which all functions see the wheels, each exact in int64.

    domains   the wheels in question; only those on which a function depends are in a monomial
    """
    moving = {wheel for one in asked for wheel in one.function.wheels}
    bundles = find_wheel_monomials([wheel for wheel in domains if wheel in moving], asked, frozenset())
    return tuple(part for bundle in bundles for part in _parts(bundle.powers, domains))


def primitive(powers: Powers) -> dict[str, int]:
    """Powers without their common divisor, the first positive."""
    common = math.gcd(*powers.values())
    common = common if next(iter(powers.values())) > 0 else -common
    return {wheel: power // common for wheel, power in powers.items()}


def _parts(powers: Powers, domains: Mapping[str, Sequence[int]]) -> Iterator[Powers]:
    """A monomial cut between wheels where its products would not fit int64."""
    held: dict[str, int] = {}
    for wheel in (wheel for wheel in domains if wheel in powers):
        both = {**held, wheel: powers[wheel]}
        if held and not fits(primitive(both), domains):
            yield primitive(held)
            both = {wheel: powers[wheel]}
        held = both
    yield primitive(held)


def fits(powers: Powers, domains: Mapping[str, Sequence[int]]) -> bool:
    """True if all values of a monomial, above and below, are exact in int64."""
    sizes = [1, 1]
    for wheel, power in powers.items():
        sizes[power > 0] *= max(domains[wheel]) ** abs(power)
    return max(sizes) < LARGEST
