"""What a rule may say of tooth counts: an equation that they meet, or a condition that refuses them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce
from math import gcd
from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Ints = NDArray[np.int64]
    Bools = NDArray[np.bool_]

Columns = Mapping[str, "Ints"]
"""Wheel -> tooth counts of many candidates, int64 arrays of one length."""

Part = str | int
"""A tooth count in a rule: that of a free wheel, by id, or a fixed one."""


class Test(Protocol):
    """A predicate on candidates: a frozen object that can be pickled."""

    def __call__(self, columns: Columns, /) -> Bools:
        """True for the candidates that pass, (candidates,)."""


@dataclass(frozen=True, slots=True)
class Equation:
    """A rule that counts meet exactly: sum of coefficient times count, plus a constant, is 0.

    name          the reason, for a reader
    coefficients  free wheel -> whole number, none of them 0; at least one wheel
    constant      what the wheels with fixed counts add
    """

    name: str
    coefficients: Mapping[str, int]
    constant: int

    @property
    def wheels(self) -> tuple[str, ...]:
        """The free wheels it is about."""
        return tuple(self.coefficients)

    def left(self, columns: Columns) -> Ints:
        """The sum of the equation, (candidates,); 0 where it holds. Sums above 2^63 overflow."""
        terms = [factor * columns[wheel] for wheel, factor in self.coefficients.items()]
        return np.asarray(reduce(np.add, terms) + self.constant, dtype=np.int64)

    def holds(self, columns: Columns) -> Bools:
        """True for the candidates that meet it, (candidates,)."""
        return np.asarray(self.left(columns) == 0)

    def solve_for(self, wheel: str, columns: Columns) -> tuple[Ints, Bools]:
        """The count of one wheel from those of the others, and where it is whole; both (candidates,).

        Columns need not hold `wheel`. The count may be 0 or less, and is rounded down where it is not whole. Of an
        equation on one wheel alone both arrays have one entry.
        """
        others = [factor * columns[name] for name, factor in self.coefficients.items() if name != wheel]
        total = reduce(np.add, others, np.array(self.constant, dtype=np.int64))
        count, rest = np.divmod(np.atleast_1d(-total), self.coefficients[wheel])
        return np.asarray(count, dtype=np.int64), np.asarray(rest == 0)

    @property
    def possible(self) -> bool:
        """False where no whole numbers meet it: the greatest common divisor of the factors leaves a rest."""
        return self.constant % gcd(*self.coefficients.values()) == 0


@dataclass(frozen=True, slots=True)
class Condition:
    """A rule that refuses candidates.

    name    the reason, for a reader; several conditions may share one
    wheels  the free wheels it is about, at least one
    test    what decides
    """

    name: str
    wheels: tuple[str, ...]
    test: Test

    def holds(self, columns: Columns) -> Bools:
        """True for the candidates that pass, (candidates,), read-only. Columns of other wheels are not looked at."""
        return np.broadcast_to(self.test(columns), columns[self.wheels[0]].shape)


Rule = Equation | Condition
"""A fitter's rule: `.name`, `.wheels`, `.holds(columns)`."""


def taken(columns: Columns, part: Part) -> Ints:
    """The counts of a part: those of a free wheel, or one number, which numpy spreads over all candidates."""
    return columns[part] if isinstance(part, str) else np.asarray(part, dtype=np.int64)


def free_of(*parts: Part) -> tuple[str, ...]:
    """The free wheels among parts, each once, in order."""
    return tuple(dict.fromkeys(part for part in parts if isinstance(part, str)))
