"""Whether a demand can be met at all while some of its items are still open: what lets a join give up rows early.

The open items lie between bounds. Where a polynomial has at most two powers of each of them, it is, divided by the
lower ones, monotone in each: its extremes lie at the corners of the box. Where no open item is in two of its terms,
each term has its own extreme. Otherwise, or with too many corners, the terms' own extremes are bounds all the same.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import prod

import numpy as np

from geartrain.synthesis.trains.items import Floats
from geartrain.synthesis.trains.rows import Rows
from geartrain.synthesis.trains.signs import Polynomial
from geartrain.synthesis.trains.windows import Bools, Half

Corners = Mapping[int, tuple[float, float]]
"""Open item -> its least and greatest value."""

_MOST_CORNERS = 64
_SHORT = 4096
"""Rows up to which a product of matrices is faster than one term after the other."""


@dataclass(frozen=True, slots=True)
class Reach:
    """A half with some items open.

    sense        of the half
    rest         what the items that are set make of each term
    lows, highs  what the open items make of each term at the least and at the greatest, (terms,)
    points       what they make of each term at each corner, (terms, corners); None where each term is taken by itself
    slack        rounding of the sum, over the sum with all signs plus
    scale        the polynomial's
    """

    sense: int
    rest: tuple[Polynomial, ...]
    lows: Floats
    highs: Floats
    points: Floats | None
    slack: float
    scale: int

    def possible(self, rows: Rows) -> Bools:
        """False where the half surely fails for all values of the open items."""
        factors = [self.sense * one.values(rows, self.scale)[0] for one in self.rest]
        least = np.zeros(rows.size)
        for factor, high in zip(factors, self.highs, strict=True):
            least -= self.slack * high * np.abs(factor)
        if self.points is None:
            best = np.zeros(rows.size)
            for factor, low, high in zip(factors, self.lows, self.highs, strict=True):
                best += np.maximum(low * factor, high * factor)
            return np.asarray(best >= least)
        if rows.size <= _SHORT:
            return np.asarray((np.stack(factors, axis=1) @ self.points >= least[:, None]).any(axis=1))
        found: Bools = np.zeros(rows.size, dtype=np.bool_)
        for point in self.points.T:
            values = np.zeros(rows.size)
            for factor, size in zip(factors, point, strict=True):
                values += size * factor
            found |= values >= least
        return found


def find_reach(half: Half, corners: Corners) -> Reach:
    """A half with the items in `corners` open; others that it depends on are set."""
    polynomial = half.polynomial
    inside = [item for item in polynomial.items if item in corners]
    lows, highs = (_factors(polynomial, inside, [corners[item][end] for item in inside]) for end in (0, 1))
    few = all(len(polynomial.powers(item)) <= 2 for item in inside) and 2 ** len(inside) <= _MOST_CORNERS
    points = None
    if few and not all(_alone(polynomial, item) for item in inside):
        ends = product(*(corners[item] for item in inside))
        points = np.stack([_factors(polynomial, inside, point) for point in ends], axis=1)
    rest = tuple(
        Polynomial(((coefficient, tuple(pair for pair in monomial if pair[0] not in inside)),))
        for coefficient, monomial in polynomial.terms
    )
    return Reach(half.sense, rest, lows, highs, points, 2 * polynomial.rounding, polynomial.scale)


def _alone(polynomial: Polynomial, item: int) -> bool:
    """True if one term at most has more than the lowest power of an item."""
    powers = [dict(monomial).get(item, 0) for _, monomial in polynomial.terms]
    return sum(power > min(powers) for power in powers) <= 1


def _factors(polynomial: Polynomial, inside: Sequence[int], point: Sequence[float]) -> Floats:
    """What the open items make of each term at some values of theirs; their lowest powers are divided out."""
    least = {item: polynomial.powers(item)[0] for item in inside}
    factors = []
    for _, monomial in polynomial.terms:
        powers = dict(monomial)
        factors.append(prod(x ** (powers.get(item, 0) - least[item]) for item, x in zip(inside, point, strict=True)))
    return np.array(factors, dtype=np.float64)
