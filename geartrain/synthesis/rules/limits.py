"""Limits on the counts of one wheel, and of two: least and most teeth, common divisors, repeats."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.synthesis.rules.conditions import taken

if TYPE_CHECKING:
    from geartrain.synthesis.rules.conditions import Bools, Columns, Part
    from geartrain.synthesis.rules.sums import WholeSum


@dataclass(frozen=True, slots=True)
class Within:
    """A count of a wheel within bounds, inclusive; None for no bound."""

    wheel: str
    least: int | None = None
    most: int | None = None

    def __call__(self, columns: Columns) -> Bools:
        """True where it is, (candidates,)."""
        counts = columns[self.wheel]
        found = np.ones(counts.shape, dtype=bool)
        if self.least is not None:
            found &= counts >= self.least
        if self.most is not None:
            found &= counts <= self.most
        return found


@dataclass(frozen=True, slots=True)
class Coprime:
    """Two counts without a common divisor: every tooth meets every tooth of its mate (hunting tooth)."""

    first: Part
    second: Part

    def __call__(self, columns: Columns) -> Bools:
        """True where the greatest common divisor is 1, (candidates,)."""
        return np.asarray(np.gcd(taken(columns, self.first), taken(columns, self.second)) == 1)


@dataclass(frozen=True, slots=True)
class Unlike:
    """A count that differs from others."""

    wheel: str
    others: tuple[Part, ...]

    def __call__(self, columns: Columns) -> Bools:
        """True where it does, (candidates,)."""
        found = np.ones(columns[self.wheel].shape, dtype=bool)
        for other in self.others:
            found &= columns[self.wheel] != taken(columns, other)
        return found


@dataclass(frozen=True, slots=True)
class Near:
    """A sum no farther from 0 than a whole number."""

    total: WholeSum
    most: int

    def __call__(self, columns: Columns) -> Bools:
        """True where it is, (candidates,)."""
        return np.asarray(np.abs(self.total.of(columns)) <= self.most)


@dataclass(frozen=True, slots=True)
class Divisible:
    """Sums that are multiples of a number each: (modulus, sum)."""

    sums: tuple[tuple[int, WholeSum], ...]

    def __call__(self, columns: Columns) -> Bools:
        """True where all are, (candidates,)."""
        found = np.asarray(True)
        for modulus, total in self.sums:
            found = found & (total.of(columns) % modulus == 0)
        return np.asarray(found)
