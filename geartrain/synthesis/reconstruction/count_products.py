"""How many choices of added wheels' counts have a wanted quotient of products.

With drivers y and driven wheels x, prod y / prod x = num / den in lowest terms holds exactly where prod y = num m and
prod x = den m for a whole m. So the number of choices is the sum over m of P(num m) R(den m), where P(n) is the number
of choices of drivers with the product n, and R that of driven wheels.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import product
from math import prod

import numpy as np
from numpy.typing import NDArray

from geartrain.numerics.weighted_alternatives import sums_by

Range = tuple[int, int]
"""Least and greatest count of an added wheel."""

_LONGEST = 1 << 24
"""Products in a tally; of more wheels one is tried after the other."""


@lru_cache(maxsize=16)
def product_tally(wheels: int, counts: Range) -> NDArray[np.int64]:
    """Number of choices with the product n at index n."""
    if not wheels:
        return np.array([0, 1], dtype=np.int64)
    before = product_tally(wheels - 1, counts)
    found = np.zeros((len(before) - 1) * counts[1] + 1, dtype=np.int64)
    for count in range(counts[0], counts[1] + 1):
        found[: (len(before) - 1) * count + 1 : count] += before
    return found


@lru_cache(maxsize=1 << 19)
def count_choices(quotient: Fraction, drivers: int, driven: int, counts: Range) -> int:
    """How many choices of counts have prod(drivers) / prod(driven) = quotient; wheels are told apart."""
    least, greatest = counts
    num, den = quotient.numerator, quotient.denominator
    last = min(greatest**drivers // num, greatest**driven // den)
    first = max(-(-(least**drivers) // num), -(-(least**driven) // den))
    if last < first:
        return 0
    if drivers <= 1 and driven <= 1:
        # 1 is the only product of no wheels
        return last - first + 1 if drivers and driven else int(first <= 1 <= last)
    if greatest ** max(drivers, driven) <= _LONGEST:
        above = product_tally(drivers, counts)[first * num : last * num + 1 : num]
        below = product_tally(driven, counts)[first * den : last * den + 1 : den]
        return int(above @ below)
    tried = range(least, greatest + 1)
    if drivers >= driven:
        return sum(count_choices(quotient / count, drivers - 1, driven, counts) for count in tried)
    return sum(count_choices(quotient * count, drivers, driven - 1, counts) for count in tried)


def list_choices(
    quotient: Fraction, drivers: int, driven: int, counts: Range
) -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
    """The choices themselves: counts of the drivers, and of the driven wheels."""
    num, den = quotient.numerator, quotient.denominator
    last = min(counts[1] ** drivers // num, counts[1] ** driven // den)
    for common in range(1, last + 1):
        if above := factorings(num * common, drivers, counts):
            yield from product(above, factorings(den * common, driven, counts))


@lru_cache(maxsize=1 << 16)
def quotients_of_parts(
    quotient: Fraction, one: tuple[int, int], other: tuple[int, int], counts: Range
) -> tuple[tuple[Fraction, int], ...]:
    """Quotients of the first of two parts that make a quotient together, each with the number of choices of both.

    A part is its numbers of drivers and of driven wheels.
    """
    found: dict[Fraction, int] = {}
    for drivers, driven in list_choices(quotient, one[0] + other[0], one[1] + other[1], counts):
        part = Fraction(prod(drivers[: one[0]]), prod(driven[: one[1]]))
        found[part] = found.get(part, 0) + 1
    return tuple(found.items())


@lru_cache(maxsize=1 << 16)
def factorings(number: int, wheels: int, counts: Range) -> tuple[tuple[int, ...], ...]:
    """Counts of so many wheels with a given product, in every order."""
    least, greatest = counts
    if not least**wheels <= number <= greatest**wheels:
        return ()
    if wheels <= 1:
        return ((number,),) if wheels else ((),)
    found = (count for count in range(least, greatest + 1) if number % count == 0)
    return tuple((count, *rest) for count in found for rest in factorings(number // count, wheels - 1, counts))


@dataclass(frozen=True)
class QuotientTable:
    """All quotients of products of counts, rising: in lowest terms, with the number of choices of each."""

    tops: NDArray[np.int64]
    bottoms: NDArray[np.int64]
    choices: NDArray[np.int64]
    values: NDArray[np.float64]

    @staticmethod
    def of(tops: NDArray[np.int64], bottoms: NDArray[np.int64], choices: NDArray[np.int64]) -> QuotientTable:
        """The table of quotients that may come several times, not in lowest terms."""
        common = np.gcd(tops, bottoms)
        pairs, at = np.unique(np.stack([tops // common, bottoms // common]), axis=1, return_inverse=True)
        number = sums_by(at.ravel(), choices, pairs.shape[1])
        # two of them differ by more than rounding: their denominators are short
        values = pairs[0] / pairs[1]
        order = np.argsort(values)
        return QuotientTable(pairs[0][order], pairs[1][order], number[order], values[order])

    def within(self, least: Fraction, greatest: Fraction) -> slice:
        """Where the quotients within bounds stand."""
        first = int(np.searchsorted(self.values, float(least) * (1 - 1e-15)))
        last = int(np.searchsorted(self.values, float(greatest) * (1 + 1e-15), side="right"))
        while first < last and self[first] < least:
            first += 1
        while first < last and self[last - 1] > greatest:
            last -= 1
        return slice(first, last)

    def __getitem__(self, at: int) -> Fraction:
        return Fraction(int(self.tops[at]), int(self.bottoms[at]))


@lru_cache(maxsize=32)
def quotient_table(drivers: int, driven: int, counts: Range) -> QuotientTable:
    """The table of so many drivers over so many driven wheels."""
    one = np.ones(1, dtype=np.int64)
    if not drivers and not driven:
        return QuotientTable.of(one, one, one)
    up = drivers > driven
    before = quotient_table(drivers - up, driven - (not up), counts)
    each = np.arange(counts[0], counts[1] + 1)
    tops, bottoms = before.tops[:, None], before.bottoms[:, None]
    tops, bottoms = (tops * each, bottoms + 0 * each) if up else (tops + 0 * each, bottoms * each)
    return QuotientTable.of(tops.ravel(), bottoms.ravel(), np.repeat(before.choices, len(each)))


def quotients(
    least: Fraction, greatest: Fraction, drivers: int, driven: int, counts: Range
) -> Iterator[tuple[Fraction, int]]:
    """Quotients within bounds, rising, each with its number of choices."""
    if least == greatest:
        if number := count_choices(least, drivers, driven, counts):
            yield least, number
        return
    table = quotient_table(drivers, driven, counts)
    found = table.within(least, greatest)
    for at in range(found.start, found.stop):
        yield table[at], int(table.choices[at])


def count_between(least: Fraction, greatest: Fraction, drivers: int, driven: int, counts: Range) -> int:
    """How many choices have a quotient within bounds."""
    if least == greatest:
        return count_choices(least, drivers, driven, counts)
    if drivers + driven <= 3:
        table = quotient_table(drivers, driven, counts)
        return int(table.choices[table.within(least, greatest)].sum())
    some = (
        quotient_table(1, 1, counts) if drivers and driven else quotient_table(min(drivers, 2), min(driven, 2), counts)
    )
    used = (1, 1) if drivers and driven else (min(drivers, 2), min(driven, 2))
    return sum(
        int(own) * count_between(least / some[at], greatest / some[at], drivers - used[0], driven - used[1], counts)
        for at, own in enumerate(some.choices)
    )
