"""Sums of tooth counts with weights: centre distances, and what follows from them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.synthesis.rules.conditions import Columns, Ints, Part


@dataclass(frozen=True, slots=True)
class Sum:
    """A sum of weight times count over free wheels, and a constant; weights are never 0."""

    terms: Mapping[str, Fraction]
    constant: Fraction = Fraction(0)

    @classmethod
    def of(cls, parts: Iterable[tuple[Fraction | int, Part]]) -> Sum:
        """Weights times parts: of a free wheel by id, or of a fixed count."""
        total = cls({})
        for weight, part in parts:
            total = total + (
                cls({part: Fraction(weight)}) if isinstance(part, str) else cls({}, Fraction(weight * part))
            )
        return total

    def __add__(self, other: Sum) -> Sum:
        terms = dict(self.terms)
        for wheel, weight in other.terms.items():
            terms[wheel] = terms.get(wheel, Fraction(0)) + weight
        return Sum({wheel: weight for wheel, weight in terms.items() if weight}, self.constant + other.constant)

    def __sub__(self, other: Sum) -> Sum:
        return self + other.times(-1)

    def times(self, factor: Fraction | int) -> Sum:
        """The sum with all weights multiplied."""
        if not factor:
            return Sum({})
        return Sum({wheel: weight * factor for wheel, weight in self.terms.items()}, self.constant * factor)

    def plus(self, number: Fraction | int) -> Sum:
        """The sum with a larger constant."""
        return Sum(self.terms, self.constant + number)


@dataclass(frozen=True, slots=True)
class WholeSum:
    """A sum of whole weights times counts, and a whole constant."""

    terms: tuple[tuple[str, int], ...]
    constant: int

    @property
    def wheels(self) -> tuple[str, ...]:
        """The free wheels in it."""
        return tuple(wheel for wheel, _ in self.terms)

    def of(self, columns: Columns) -> Ints:
        """Its values, (candidates,); one number where there is no free wheel in it. Sums above 2^63 overflow."""
        total = np.asarray(self.constant, dtype=np.int64)
        for wheel, weight in self.terms:
            total = total + weight * columns[wheel]
        return np.asarray(total)


def whole(*sums: Sum) -> tuple[WholeSum, ...]:
    """Sums times the least positive number that makes all their weights whole, the same for all."""
    scale = lcm(*(number.denominator for one in sums for number in (*one.terms.values(), one.constant)))
    return tuple(
        WholeSum(tuple((wheel, int(weight * scale)) for wheel, weight in one.terms.items()), int(one.constant * scale))
        for one in sums
    )


def plainest(one: Sum) -> WholeSum:
    """A sum in the smallest whole numbers, its first weight positive: what is 0 stays 0, and nothing else becomes 0."""
    (found,) = whole(one)
    common = gcd(*(weight for _, weight in found.terms), found.constant) or 1
    if found.terms and found.terms[0][1] < 0:
        common = -common
    return WholeSum(tuple((wheel, weight // common) for wheel, weight in found.terms), found.constant // common)


def equality(one: WholeSum) -> str:
    """A sum that is 0, in words, with plus signs only: `s + 2 p = r`."""
    pieces = [(one.constant, str(abs(one.constant)))] if one.constant else []
    pieces += [(weight, f"{abs(weight)} {wheel}" if abs(weight) != 1 else wheel) for wheel, weight in one.terms]
    left, right = ([text for weight, text in pieces if weight * side > 0] for side in (1, -1))
    return f"{' + '.join(left) or '0'} = {' + '.join(right) or '0'}"
