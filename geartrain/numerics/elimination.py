"""Sparse linear forms over the rationals: elimination, rank modulo a prime, and feasibility by the simplex method.

It imports the standard library only: verdicts on a train are exact, and wait for no array library.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from heapq import heapify, heappop, heappush
from typing import Any

PRIME = (1 << 61) - 1
"""A Mersenne prime: rank modulo it is a lower bound that is exact but for accidents of probability 1e-18."""

LinearForm = dict[int, Fraction]
"""A linear form: column -> coefficient. Columns >= 0 are unknowns; columns < 0 are symbols, never solved for."""


@dataclass(frozen=True, slots=True)
class Echelon:
    """What elimination leaves: pivots in the order taken, conditions on symbols alone, redundant rows.

    pivots      (column, rest): column = -(rest), rest free of all columns taken before it
    conditions  rows without unknowns: each must vanish
    redundant   indices of the rows that became 0 = 0
    """

    pivots: tuple[tuple[int, LinearForm], ...]
    conditions: tuple[LinearForm, ...]
    redundant: tuple[int, ...]

    @property
    def rank(self) -> int:
        """Number of independent rows in the unknowns."""
        return len(self.pivots)

    def forms(self, budget: int | None = None) -> dict[int, LinearForm]:
        """Back substitution: every pivot column as a linear form of symbols and unknowns that stayed free.

        Many free unknowns make long forms: past `budget` operations `TooDenseError` is raised.
        """
        solved: dict[int, LinearForm] = {}
        work = 0
        for column, rest in reversed(self.pivots):  # the last pivot's rest holds free columns only
            form: LinearForm = {}
            for other, coefficient in rest.items():
                known = solved.get(other)
                if known is None:
                    add_into(form, {other: -coefficient}, 1)
                else:
                    add_into(form, known, -coefficient)
                    # long numbers cost as many machine words as they have
                    work += len(known) * (1 + coefficient.numerator.bit_length() // 64)
            if budget is not None and work > budget:
                raise TooDenseError
            solved[column] = form
        return solved


class TooDenseError(Exception):
    """Elimination passed its budget of operations; the caller has another way."""


def add_into(row: dict[int, Any], other: Mapping[int, Any], factor: Any) -> None:
    """row += factor * other, dropping the entries that cancel; entries are numbers or polynomials, all of one kind."""
    for column, coefficient in other.items():
        value = row[column] + factor * coefficient if column in row else factor * coefficient
        if value:
            row[column] = value
        else:
            row.pop(column, None)


def eliminate(rows: Iterable[Mapping[int, Fraction]], budget: int | None = None, modulus: int = 0) -> Echelon:
    """Sparse Gaussian elimination over the rationals (or modulo a prime): shortest row first, rarest column in it.

    rows      linear forms that vanish; columns < 0 are symbols
    budget    the most operations allowed, long numbers counting more; `TooDenseError` past it
    modulus   0 for exact rationals, else a prime; coefficients must then be integers

    Rows of one or two unknowns are plain substitutions, so chains, trees and cascades cost linear time;
    fill appears only where circuits are truly coupled.
    """
    active = {index: dict(row) for index, row in enumerate(rows)}
    users: dict[int, set[int]] = {}
    for index, row in active.items():
        for column in row:
            if column >= 0:
                users.setdefault(column, set()).add(index)
    queue = [(sum(column >= 0 for column in row), index) for index, row in active.items()]
    heapify(queue)
    pivots: list[tuple[int, LinearForm]] = []
    conditions: list[LinearForm] = []
    redundant: list[int] = []
    work = 0
    while queue:
        length, index = heappop(queue)
        row = active.get(index, {})
        unknowns = [column for column in row if column >= 0]
        if index not in active or len(unknowns) != length:
            continue  # an old entry of a row that changed since, and was queued again
        del active[index]
        if not unknowns:
            if row:
                conditions.append(row)
            else:
                redundant.append(index)
            continue
        # Markowitz' rule in part: the column that fewest rows hold fills least; ties by number, so that runs repeat
        pivot = min(unknowns, key=lambda column: (len(users[column]), column))
        lead = row.pop(pivot)
        if modulus:
            inverse = pow(int(lead), -1, modulus)
            rest: LinearForm = {column: value * inverse % modulus for column, value in row.items()}
        else:
            rest = {column: value / lead for column, value in row.items()}
        pivots.append((pivot, rest))
        cost = (len(rest) + 1) * (1 + lead.numerator.bit_length() // 64)
        for column in unknowns:
            users[column].discard(index)
        for other in users.pop(pivot):
            target = active[other]
            factor = target.pop(pivot)
            work += cost
            for column, value in rest.items():
                new = target.get(column, 0) - factor * value
                if modulus:
                    new %= modulus
                if new:
                    if column >= 0 and column not in target:
                        users[column].add(other)
                    target[column] = new
                elif column in target:
                    del target[column]
                    if column >= 0:
                        users[column].discard(other)
            heappush(queue, (sum(column >= 0 for column in target), other))
            if budget is not None and work > budget:
                raise TooDenseError
    return Echelon(tuple(pivots), tuple(conditions), tuple(redundant))


def residues(row: Mapping[int, Fraction], modulus: int = PRIME) -> LinearForm:
    """A multiple of a rational row, in integers modulo a prime."""
    # one factor for the whole row leaves the rank as it is, and no denominator is to be inverted modulo the prime
    scale = math.lcm(*(value.denominator for value in row.values()))
    return {c: residue for c, value in row.items() if (residue := int(value * scale) % modulus)}  # type: ignore[misc]


def rank_modulo(rows: Iterable[Mapping[int, Fraction]], modulus: int = PRIME) -> int:
    """Rank of rational rows modulo a prime: never more than the true rank, and equal but for accidents."""
    return eliminate((residues(row, modulus) for row in rows), modulus=modulus).rank


def feasible(forms: Sequence[Mapping[int, Fraction]], constant: int = -1) -> bool:
    """Simplex method, first phase: True if some numbers for the unknowns make every linear form 0 or more.

    forms      columns >= 0 are unknowns of either sign, `constant` is the column of what is added

    Bland's rule, by which the entering and the leaving variable are those of the least number, cannot cycle.
    """
    unknowns = sorted({column for form in forms for column in form if column != constant})
    # an unknown is the difference of two variables that are not negative
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
        met = row[-1] <= 0  # where all unknowns are 0
        # right sides must be 0 or more; a row turned round has +1 at its slack, its first basic variable then
        table.append([-value for value in row] if met else row)
        basis.append(first_slack + at if met else artificial + at)
    return _reaches_zero(table, basis, artificial)


def _reaches_zero(table: list[list[Fraction]], basis: list[int], artificial: int) -> bool:
    """Whether the variables from `artificial` on, in the basis only, can all be made 0."""
    while True:
        lacking = [row for row, own in zip(table, basis, strict=True) if own >= artificial]
        if not any(row[-1] for row in lacking):
            return True
        # the reduced cost of the sum of the artificial variables; the first positive one is that of Bland's rule
        enter = next((at for at in range(artificial) if sum(row[at] for row in lacking) > 0), None)
        if enter is None:
            return False
        # the ratio test; of equal ratios `min` takes the least variable, as Bland's rule asks
        ratios = [(row[-1] / row[enter], own, at) for at, (row, own) in enumerate(zip(table, basis, strict=True))
                  if row[enter] > 0]  # fmt: skip
        _, _, leave = min(ratios)
        lead = table[leave][enter]
        pivot = table[leave] = [value / lead for value in table[leave]]
        basis[leave] = enter
        for at, row in enumerate(table):
            if at != leave and row[enter]:
                factor = row[enter]
                table[at] = [value - factor * other for value, other in zip(row, pivot, strict=True)]
