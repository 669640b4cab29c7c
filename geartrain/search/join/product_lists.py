"""Variables of a join, whose values are sorted distinct products of tooth counts, and partial assignments of these
values.

An output depends on most wheels only through one monomial, such as a c / (b d). The join therefore assigns variables
(class `Item`) instead of wheels: here one variable for a c, and another one for b d. A wheel in a constraint on tooth
counts is a separate variable.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.arrays import Floats, Ints

Tallies = NDArray[Any]
"""Numbers or weights of assignments: int64 if all of them fit in int64, or Python integers if they do not."""
Domains = Mapping[str, tuple[int, ...]]
Factors = tuple[tuple[str, int], ...]
"""Definition of a variable: the wheels in its product, each with its positive power."""
Weights = Mapping[str, tuple[int, ...]]
"""Integer weight of each tooth count, keyed by wheel. The tooth counts of a wheel without an entry have weight 1, so
that assignments are counted.
"""

BLOCK = 1 << 18
"""Number of rows in a block. It limits the memory of a join to about 50 MB in addition to the lists of products."""
_LONGEST = 1 << 23  # maximum number of products in one table: 64 MB of int64
_TRIED = 4_000_000  # maximum number of products formed for a forecast, which is extrapolated beyond it
_REMEMBERED = 20_000_000  # maximum number of values of all cached variables


def forecast(wheels: Sequence[tuple[str, int]], domains: Mapping[str, Sequence[int]]) -> tuple[int, int]:
    """Return the number of distinct products of tooth counts, and the number of multiplications that are needed to list
    them. `wheels` contains pairs (wheel, power). Large numbers are estimates.
    """
    return _forecast(tuple(tuple(count**power for count in domains[wheel]) for wheel, power in wheels))


@lru_cache(maxsize=256)
def _forecast(factors: tuple[tuple[int, ...], ...]) -> tuple[int, int]:
    values, sizes, cost = np.ones(1, dtype=np.int64), [1], 0
    for at, some in enumerate(factors):
        examined = sizes[-1] * len(some)
        cost += examined
        if cost <= _TRIED and len(values) == sizes[-1] and prod(map(max, factors[: at + 1])) < 1 << 62:
            values = np.unique(np.multiply.outer(values, np.array(some, dtype=np.int64)))
            sizes.append(len(values))
        else:
            # extrapolation: each further wheel repeats more products, so the growth factor decreases, at least by a
            # fifth
            growth = 0.8 * sizes[-1] / sizes[-2] * len(some) / len(factors[at - 1]) if at else len(some)
            sizes.append(max(sizes[-1], int(sizes[-1] * min(growth, len(some)))))
    return sizes[-1], cost


@dataclass(frozen=True, slots=True, eq=False)
class ProductStep:
    """Table of the multiplications of the products of some wheels by the tooth counts of one more wheel. Each entry of
    the arrays is one multiplication.
    """

    wheel: str
    choices: Ints
    """Index of the tooth count of the additional wheel, for each transition."""
    children: Ints
    """Index of the product after the multiplication, for each transition."""
    parents: Ints
    """Index of the product before the multiplication, for each transition."""
    size: int
    """Number of distinct products after the step."""
    before: ProductStep | None
    """Step of the previous wheel; None if there is no previous wheel."""

    def chain(self) -> Iterator[ProductStep]:
        """Yield this step, and then the steps of all previous wheels, last wheel first."""
        yield self
        if self.before is not None:
            yield from self.before.chain()


class Item:
    """Values of a variable in ascending order: distinct products of one tooth count of each wheel, raised to the power
    of the wheel.

    values   products, int64, shape (m,), where m is the number of products
    x        products as float64, shape (m,)
    times    total weight of the assignments that produce each product, shape (m,)
    sums     cumulative weights, starting with 0, shape (m + 1,)
    """

    def __init__(self, wheels: Factors, domains: Domains, weights: Weights, dtype: Any) -> None:
        self.wheels = wheels
        self.counts = [np.array(domains[wheel], dtype=np.int64) for wheel, _ in wheels]
        self.powers = [counts**power for counts, (_, power) in zip(self.counts, wheels, strict=True)]
        # products of the counts of the first 0, 1, 2, ... wheels
        self.levels = [np.ones(1, dtype=np.int64)]
        self.times: Tallies = np.ones(1, dtype=dtype)
        for powers, (wheel, _) in zip(self.powers, wheels, strict=True):
            own = np.array(weights.get(wheel, (1,) * len(powers)), dtype=dtype)
            values, self.times = _multiplied(self.levels[-1], self.times, powers, own)
            self.levels.append(values)
        self.values = self.levels[-1]
        self.x = self.values.astype(np.float64)
        self.sums = np.concatenate([np.zeros(1, dtype=dtype), np.cumsum(self.times, dtype=dtype)])

    def __len__(self) -> int:
        return len(self.values)

    def ways(self, indices: Ints) -> tuple[Ints, dict[str, Ints]]:
        """Return every assignment of tooth counts that produces one of the products at the given indices.

        The result is (owner, tooth counts keyed by wheel). For each assignment, `owner` is the position of its product
        in `indices`, in ascending order.
        """
        owner, rest = np.arange(len(indices)), self.values[indices]
        found: dict[str, Ints] = {}
        for level in range(len(self.wheels) - 1, -1, -1):
            kept, factor, rest = _divided(rest, self.powers[level], self.levels[level])
            owner = owner[kept]
            found = {wheel: column[kept] for wheel, column in found.items()}
            found[self.wheels[level][0]] = self.counts[level][factor]
        return owner, found

    def last_step(self, values: Ints, level: int = -1) -> ProductStep:
        """Return the multiplications by the tooth counts of the last wheel that produce the given distinct products.
        They are linked to the multiplications by the tooth counts of all previous wheels.

        level   index of the last wheel in these products; by default the last wheel of the variable
        """
        level %= len(self.wheels)
        children, choices, rest = _divided(values, self.powers[level], self.levels[level])
        products, parents = np.unique(rest, return_inverse=True)
        before = self.last_step(products, level - 1) if level else None
        return ProductStep(self.wheels[level][0], choices, children, parents, len(values), before)


def _multiplied(values: Ints, times: Tallies, factors: Ints, weights: Tallies) -> tuple[Ints, Tallies]:
    """Return the distinct products of an element of `values`, whose weights are `times`, and an element of `factors`,
    whose weights are `weights`, and the sum of the products of the weights for each distinct product.
    """
    step = max(1, _LONGEST // len(values))
    found: list[tuple[Ints, Tallies]] = []
    for at in range(0, len(factors), step):
        block = factors[at : at + step]
        products = np.multiply.outer(block, values).ravel()
        found.append(_distinct(products, np.multiply.outer(weights[at : at + step], times).ravel()))
        last = at + step >= len(factors)
        # merge lists of similar length (binary counter), so that each value is moved only a few times
        while len(found) > 1 and (last or len(found[-2][0]) <= 2 * len(found[-1][0])):
            (left, p), (right, q) = found.pop(), found.pop()
            found.append(_distinct(np.concatenate([left, right]), np.concatenate([p, q])))
    return found[0]


def _distinct(values: Ints, times: Tallies) -> tuple[Ints, Tallies]:
    # sorting and `reduceat` instead of np.unique, which cannot sum weights that are Python integers
    order = np.argsort(values, kind="stable")
    values = values[order]
    first = np.flatnonzero(np.concatenate([[True], values[1:] != values[:-1]]))
    return values[first], np.add.reduceat(times[order], first)


def _divided(rest: Ints, factors: Ints, shorter: Ints) -> tuple[Ints, Ints, Ints]:
    """Return all divisions of a product in `rest` by a factor in `factors` whose quotient is an element of `shorter`,
    as three arrays: index of the product, index of the factor, and quotient.
    """
    found = []
    step = max(1, _LONGEST // len(factors))
    for at in range(0, max(len(rest), 1), step):
        quotient, left = np.divmod(rest[at : at + step, None], factors[None, :])
        # the quotient must be a product of the previous wheels
        place = np.minimum(np.searchsorted(shorter, quotient), len(shorter) - 1)
        rows, columns = np.nonzero((left == 0) & (shorter[place] == quotient))
        found.append((rows + at, columns, quotient[rows, columns]))
    rows, columns, quotients = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return rows, columns, quotients


_ITEMS: OrderedDict[Hashable, Item] = OrderedDict()
"""Least-recently-used cache of variables, limited by the total length of their lists."""


def find_item(recipe: Factors, domains: Domains, weights: Weights, dtype: Any) -> Item:
    """Return the variable whose values are the products of the tooth counts of the wheels in `recipe`, from the cache
    if possible.
    """
    key = recipe, tuple((domains[wheel], weights.get(wheel)) for wheel, _ in recipe), dtype is object
    if key not in _ITEMS:
        _ITEMS[key] = Item(recipe, domains, weights, dtype)
    _ITEMS.move_to_end(key)
    # the requested variable is kept, even if it exceeds the limit by itself
    while len(_ITEMS) > 1 and sum(map(len, _ITEMS.values())) > _REMEMBERED:
        _ITEMS.popitem(last=False)
    return _ITEMS[key]


# ----------------------------------------------------------- rows over some variables, each with the index of its value


class PartialAssignments:
    """Table of partial assignments. Each row contains, for every assigned variable, the index of its value.

    columns   index of the value for each row, shape (size,), keyed by assigned variable
    """

    __slots__ = ("_x", "columns", "items", "size")

    def __init__(self, items: Sequence[Item], columns: Mapping[int, Ints], size: int) -> None:
        self.items, self.columns, self.size = items, columns, size
        self._x: dict[int, Floats] = {}

    def x(self, item: int) -> Floats:
        """Return the value of a variable as float64 for each row."""
        if item not in self._x:
            self._x[item] = self.items[item].x[self.columns[item]]
        return self._x[item]

    def value(self, item: int) -> Ints:
        """Return the value of a variable as int64 for each row."""
        return self.items[item].values[self.columns[item]]

    def pick(self, where: NDArray[Any]) -> PartialAssignments:
        """Return the rows that are selected by `where`, a Boolean mask of shape (size,) or an array of row indices."""
        columns = {item: column[where] for item, column in self.columns.items()}
        size = int(where.sum()) if where.dtype == np.bool_ else len(where)
        return PartialAssignments(self.items, columns, size)

    def plus(self, parents: Ints, item: int, indices: Ints) -> PartialAssignments:
        """Return partial assignments extended by a value of variable `item`. `parents` contains the index of the
        original row of each extension, and `indices` the index of its value.
        """
        columns = {known: column[parents] for known, column in self.columns.items()}
        return PartialAssignments(self.items, {**columns, item: indices}, len(parents))

    def distinct(self, items: Sequence[int]) -> tuple[PartialAssignments, Ints | slice]:
        """Return the distinct combinations of the values of some variables as rows, and for each original row the index
        of its combination. The indices are `slice(None)` if the rows are unchanged.
        """
        if len(items) == len(self.columns):
            return self, slice(None)
        key, most = np.zeros(self.size, dtype=np.int64), 1
        for item in items:
            values = len(self.items[item])
            if most * values >= 1 << 62:  # renumber the keys before they overflow
                _, key = np.unique(key, return_inverse=True)
                most = self.size
            key = key * values + self.columns[item]  # mixed-radix number of the indices
            most *= values
        _, first, inverse = np.unique(key, return_index=True, return_inverse=True)
        return PartialAssignments(self.items, {item: self.columns[item][first] for item in items}, len(first)), inverse

    def blocks(self, sizes: Tallies) -> Iterator[tuple[int, int]]:
        """Yield half-open ranges of consecutive rows, in each of which the sum of `sizes` is at most about `BLOCK`. A
        row with a larger size forms a range by itself.
        """
        ends = np.cumsum(sizes)
        at = 0
        while at < self.size:
            done = ends[at - 1] if at else 0
            upto = max(int(np.searchsorted(ends, done + BLOCK, side="right")), at + 1)
            yield at, upto
            at = upto
