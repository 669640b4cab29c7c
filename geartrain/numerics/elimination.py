"""Sparse linear systems over the rationals: elimination, rank modulo a prime, and feasibility by the simplex method.

Only the standard library is imported, so that exact verdicts on a train do not require loading an array library.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from heapq import heapify, heappop, heappush
from operator import itemgetter
from typing import Any, Protocol, TypeVar

T = TypeVar("T")

PRIME = (1 << 61) - 1
"""Mersenne prime. The rank modulo it is a lower bound on the rank, and equals it except with probability 1e-18."""

LinearForm = dict[int, Fraction]
"""Linear form as column -> coefficient; columns >= 0 are unknowns, columns < 0 are symbols with known values."""


@dataclass(frozen=True, slots=True)
class Echelon:
    """Echelon form of rows in unknowns and symbols: solved unknowns, conditions on symbols, and redundant rows."""

    pivots: tuple[tuple[int, LinearForm], ...]
    """Pairs (column, rest), which mean that the unknown is -(rest). `rest` contains no column of an earlier pair."""
    conditions: tuple[LinearForm, ...]
    """Rows that contain only symbols, each of which must be 0 for a consistent system."""
    redundant: tuple[int, ...]
    """Indices of redundant rows, which elimination reduces to 0 = 0."""

    @property
    def rank(self) -> int:
        """Number of independent rows in the unknowns."""
        return len(self.pivots)

    def forms(self, budget: int | None = None) -> dict[int, LinearForm]:
        """Return each solved unknown as a linear form; raise `TooDenseError` after `budget` operations."""
        solved: dict[int, LinearForm] = {}
        work = 0
        for column, rest in reversed(self.pivots):  # the rest of the last pivot contains free columns only
            form: LinearForm = {}
            for other, coefficient in rest.items():
                known = solved.get(other)
                if known is None:
                    add_into(form, {other: -coefficient}, 1)
                else:
                    add_into(form, known, -coefficient)
                    # the cost of a long number is its length in machine words
                    work += len(known) * (1 + coefficient.numerator.bit_length() // 64)
            if budget is not None and work > budget:
                raise TooDenseError
            solved[column] = form
        return solved


class TooDenseError(Exception):
    """Error raised if elimination exceeds its budget of operations; the caller must use another method."""


def add_into(row: dict[int, Any], other: Mapping[int, Any], factor: Any) -> None:
    """Add factor * other to a row in place, and remove entries that cancel; entries are numbers or polynomials."""
    for column, coefficient in other.items():
        value = row[column] + factor * coefficient if column in row else factor * coefficient
        if value:
            row[column] = value
        else:
            row.pop(column, None)


def eliminate(rows: Iterable[Mapping[int, Fraction]], budget: int | None = None, modulus: int = 0) -> Echelon:
    """Eliminate unknowns by sparse Gaussian elimination over the rationals or modulo a prime; see `eliminate_units`.

    rows      linear forms that must be 0; columns < 0 are symbols
    budget    maximum number of operations, weighted by the length of numbers; `TooDenseError` is raised beyond it
    modulus   0 for exact rational numbers, or a prime, for which coefficients must be integers
    """
    field = Residues(modulus) if modulus else RATIONALS
    pivots, left = eliminate_units(rows, field, budget)
    conditions = tuple(row for _, row in left if row)
    return Echelon(tuple(pivots), conditions, tuple(index for index, row in left if not row))


class Ring(Protocol[T]):
    """Protocol of the ring that contains the coefficients of linear forms, for `eliminate_units`."""

    @property
    def modulus(self) -> int:
        """Modulus by which products are reduced; 0 if they are not reduced."""
        ...

    def inverse(self, entry: T) -> T | None:
        """Return the inverse of a coefficient; None if the coefficient is not a unit of the ring."""
        ...

    def words(self, entry: T) -> int:
        """Return the length of a coefficient in machine words, which is the cost of one operation with it."""
        ...


class _Rationals:
    """Field of the rational numbers, for `eliminate_units`. Its elements are Fractions."""

    modulus = 0

    def inverse(self, entry: Fraction) -> Fraction:
        return 1 / entry

    def words(self, entry: Fraction) -> int:
        return 1 + entry.numerator.bit_length() // 64


RATIONALS = _Rationals()


@dataclass(frozen=True, slots=True)
class Residues:
    """Field of the integers modulo a prime, as a ring for `eliminate_units`."""

    modulus: int

    def inverse(self, entry: Any) -> Any:
        """Return the inverse of a residue, modulo the prime."""
        return pow(int(entry), -1, self.modulus)

    def words(self, entry: Any) -> int:
        """Return 1, because a residue fits into one machine word."""
        return 1


def eliminate_units(
    rows: Iterable[Mapping[int, T]], ring: Ring[T], budget: int | None = None
) -> tuple[list[tuple[int, dict[int, T]]], list[tuple[int, dict[int, T]]]]:
    """Eliminate unknowns over any commutative ring by sparse Gaussian elimination with units as pivots.

    The shortest row is eliminated first, and its pivot is the column with the fewest entries (a simplified Markowitz
    rule). Rows with one or two unknowns are substitutions, so chains, trees and cascades take linear time. Fill-in
    occurs only where circuits are coupled.

    rows     linear forms that must be 0; columns < 0 are symbols, which are never pivots
    budget   maximum number of operations, weighted by the length of coefficients; `TooDenseError` is raised beyond it

    Returns the pivots in the order of elimination as (column, rest), which means that the unknown is -(rest), and the
    remaining rows with their indices: first rows without unknowns, then rows in which no coefficient is a unit.
    """
    modulus = ring.modulus
    active = {index: dict(row) for index, row in enumerate(rows)}
    users: dict[int, set[int]] = {}
    for index, row in active.items():
        for column in row:
            if column >= 0:
                users.setdefault(column, set()).add(index)
    queue = [(sum(column >= 0 for column in row), index) for index, row in active.items()]
    heapify(queue)
    pivots: list[tuple[int, dict[int, T]]] = []
    left: list[tuple[int, dict[int, T]]] = []
    work = 0
    while queue:
        length, index = heappop(queue)
        row = active.get(index, {})
        unknowns = [column for column in row if column >= 0]
        if index not in active or len(unknowns) != length:
            continue  # outdated entry: the row has changed and was queued again
        if not unknowns:
            left.append((index, active.pop(index)))
            continue
        # Markowitz pivoting in part: the column with the fewest entries causes minimum fill-in; ties are resolved by
        # number, so that runs are reproducible
        unknowns.sort(key=lambda column: (len(users[column]), column))
        for pivot in unknowns:
            inverse: Any = ring.inverse(row[pivot])
            if inverse is not None:
                break
        else:
            continue  # no unit; the row is queued again once it changes
        del active[index]
        cost = len(row) * ring.words(row.pop(pivot))
        rest: dict[int, Any] = {column: value * inverse for column, value in row.items()}
        if modulus:
            rest = {column: value % modulus for column, value in rest.items()}
        pivots.append((pivot, rest))
        for column in unknowns:
            users[column].discard(index)
        for other in users.pop(pivot):
            target = active[other]
            factor: Any = target.pop(pivot)
            work += cost
            for column, value in rest.items():
                known: Any = target.get(column)
                new = -(factor * value) if known is None else known - factor * value
                if modulus:
                    new %= modulus
                if new:
                    if known is None and column >= 0:
                        users[column].add(other)
                    target[column] = new
                elif known is not None:
                    del target[column]
                    if column >= 0:
                        users[column].discard(other)
            heappush(queue, (sum(column >= 0 for column in target), other))
            if budget is not None and work > budget:
                raise TooDenseError
    return pivots, [*left, *sorted(active.items(), key=itemgetter(0))]


def residues(row: Mapping[int, Fraction], modulus: int = PRIME) -> LinearForm:
    """Return a rational row, multiplied by the common denominator of its entries and reduced modulo a prime."""
    # one factor for the whole row does not change the rank, and avoids inverting denominators modulo the prime
    scale = math.lcm(*(value.denominator for value in row.values()))
    return {c: residue for c, value in row.items() if (residue := int(value * scale) % modulus)}  # type: ignore[misc]


def rank_modulo(rows: Iterable[Mapping[int, Fraction]], modulus: int = PRIME) -> int:
    """Return the rank of rational rows modulo a prime, which is a lower bound and almost always the true rank."""
    return eliminate((residues(row, modulus) for row in rows), modulus=modulus).rank


def feasible(forms: Sequence[Mapping[int, Fraction]], constant: int = -1) -> bool:
    """Return True if there are values of the unknowns for which no linear form is negative (simplex method, phase 1).

    forms      linear forms; columns >= 0 are unknowns of either sign
    constant   column of the constant term
    """
    unknowns = sorted({column for form in forms for column in form if column != constant})
    # an unknown is the difference of two nonnegative variables
    place = {column: 2 * at for at, column in enumerate(unknowns)}
    table: list[list[Fraction]] = []
    basis: list[int] = []
    first_slack = 2 * len(unknowns)
    artificial = first_slack + len(forms)
    for at, form in enumerate(forms):
        row = [Fraction(0)] * (artificial + 1)
        for column, value in form.items():
            if column != constant:
                row[place[column]], row[place[column] + 1] = value, -value
        row[first_slack + at] = Fraction(-1)
        row[-1] = -form.get(constant, Fraction(0))
        met = row[-1] <= 0  # satisfied if all unknowns are 0
        # right-hand sides must be nonnegative; a negated row has +1 at its slack, which is then its basic variable
        table.append([-value for value in row] if met else row)
        basis.append(first_slack + at if met else artificial + at)
    return _reaches_zero(table, basis, artificial)


def _reaches_zero(table: list[list[Fraction]], basis: list[int], artificial: int) -> bool:
    """Return True if all artificial variables, those from index `artificial` on, reach 0 in the simplex `table`."""
    while True:
        lacking = [row for row, own in zip(table, basis, strict=True) if own >= artificial]
        if not any(row[-1] for row in lacking):
            return True
        # reduced costs of the sum of artificial variables; Bland's rule takes the first positive one
        enter = next((at for at in range(artificial) if sum(row[at] for row in lacking) > 0), None)
        if enter is None:
            return False
        # the ratio test; of equal ratios `min` takes the lowest index, as Bland's rule requires
        ratios = [(row[-1] / row[enter], own, at) for at, (row, own) in enumerate(zip(table, basis, strict=True))
                  if row[enter] > 0]  # fmt: skip
        _, _, leave = min(ratios)
        divisor = table[leave][enter]
        pivot = table[leave] = [value / divisor for value in table[leave]]
        basis[leave] = enter
        for at, row in enumerate(table):
            if at != leave and row[enter]:
                factor = row[enter]
                table[at] = [value - factor * other for value, other in zip(row, pivot, strict=True)]
