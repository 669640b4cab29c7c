"""The best of very many assignments: bounds in floats drop what cannot be among them, exact errors order the rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf, prod
from typing import Any

import numpy as np

from geartrain.numerics.arrays import Bools, Floats, Ints
from geartrain.numerics.bounded_polynomials import BoundedQuotient, WholeTerm, products_of
from geartrain.numerics.exact import as_float
from geartrain.search.integer_columns import distinct_quotients
from geartrain.search.join.exact_join import AssignmentColumns
from geartrain.search.join.polynomial_constraints import ROUNDING
from geartrain.search.join.product_lists import Tallies
from geartrain.search.train.output_requirements import OutputRequirement
from geartrain.search.train.train_findings import Assignment, By

_POOL = 20_000
"""Assignments that a pool holds before it is sorted out."""


@dataclass(frozen=True, slots=True)
class AssignmentOrder:
    """What makes an assignment better than another.

    by        what comes first; then error, total, largest, and the counts in the order of the wheels
    best      how many are wanted
    askings   the outputs their errors are of
    declared  wheel -> declared count, where it has one
    """

    by: By
    best: int
    askings: tuple[OutputRequirement, ...]
    declared: Mapping[str, int]

    @property
    def level(self) -> bool:
        """True if all solutions have one error, because every output is asked for one exact speed."""
        return all(asking.exact for asking in self.askings)

    def assignment(self, teeth: Mapping[str, int]) -> Assignment | None:
        """What the outputs do with some counts; None where one has no speed."""
        outputs = {}
        for asking in self.askings:
            speed = asking.function.value(teeth)
            if speed is None:
                return None
            outputs[asking.name] = asking.reached(speed)
        changed = tuple(wheel for wheel, count in teeth.items() if self.declared.get(wheel, count) != count)
        return Assignment(dict(teeth), outputs, changed)

    def first(self, columns: AssignmentColumns) -> Ints:
        """What comes first, of many assignments; 0 for the error, which `errors` bounds."""
        table = np.stack(list(columns.values()))
        if self.by == "total":
            return np.asarray(table.sum(axis=0))
        if self.by == "largest":
            return np.asarray(table.max(axis=0))
        if self.by == "distinct":
            steps = np.diff(np.sort(table, axis=0), axis=0)
            return np.asarray(1 + (steps != 0).sum(axis=0))
        if self.by == "change":
            changes = [column != self.declared[wheel] for wheel, column in columns.items() if wheel in self.declared]
            return np.asarray(sum(changes, np.zeros(table.shape[1], dtype=np.int64)))
        return np.zeros(table.shape[1], dtype=np.int64)

    def errors(self, columns: AssignmentColumns) -> tuple[Floats, Floats]:
        """Bounds on the largest |error|, least and greatest."""
        size = len(next(iter(columns.values())))
        least, greatest = np.zeros(size), np.zeros(size)
        if not self.level:
            for asking in self.askings:
                low, high = _errors(asking, columns)
                least, greatest = np.maximum(least, low), np.maximum(greatest, high)
        return least, greatest

    def ranks(self, columns: AssignmentColumns) -> Ints:
        """Whole numbers in the order of the largest |error|, exactly; equal errors have equal numbers."""
        found = np.zeros(len(next(iter(columns.values()))), dtype=np.int64)
        if self.level:
            return found
        exact = [_exact_errors(asking, columns) for asking in self.askings]
        rank = {error: at for at, error in enumerate(sorted({error for errors, _ in exact for error in errors}))}
        for errors, which in exact:
            found = np.maximum(found, np.array([rank[error] for error in errors], dtype=np.int64)[which])
        return found


def _errors(asking: OutputRequirement, columns: AssignmentColumns) -> tuple[Floats, Floats]:
    """Bounds on the largest |error| of one output."""
    function = asking.function
    # a count is rounded once at most, where it is beyond 2^53
    quotient = BoundedQuotient.of(function.numerator, function.denominator, [1] * len(function.wheels))
    speed, off = quotient.bounded(products_of([columns[wheel].astype(np.float64) for wheel in function.wheels]))
    size = len(next(iter(columns.values())))
    least, greatest = np.zeros(size), np.zeros(size)
    for demand in (demand for demand in asking.demands if demand.graded):
        wanted = as_float(demand.wanted)
        if wanted is None:
            return np.zeros(size), np.full(size, inf)
        if wanted:
            error = np.abs((speed if demand.signed else np.abs(speed)) / wanted - 1)
            slack = off / abs(wanted) + 4 * ROUNDING * (1 + error)
        else:
            error, slack = np.abs(speed), off
        slack = np.where(np.isfinite(error), slack, inf)
        error = np.where(np.isfinite(error), error, 0.0)
        least, greatest = np.maximum(least, error - slack), np.maximum(greatest, error + slack)
    return least, greatest


def _exact_errors(asking: OutputRequirement, columns: AssignmentColumns) -> tuple[list[Fraction], Ints]:
    """The exact |error| of each distinct speed of an output, and for each assignment which of them is its own."""
    function = asking.function
    above, below = (_whole(function.wheels, terms, columns) for terms in (function.numerator, function.denominator))
    speeds, which = distinct_quotients(above, below)
    return [abs(asking.reached(speed).error) for speed in speeds], which


def _whole(wheels: Sequence[str], terms: Sequence[WholeTerm], columns: AssignmentColumns) -> Tallies:
    """The sum of some terms, exact: int64 where it fits, Python integers otherwise."""
    most = {wheel: int(columns[wheel].max()) for wheel in wheels}
    bound = sum(
        abs(coefficient) * prod(most[wheel] ** power for wheel, power in zip(wheels, powers, strict=True))
        for coefficient, powers in terms
    )
    dtype: Any = np.int64 if bound < 1 << 62 else object
    total = np.zeros(len(next(iter(columns.values()))), dtype=dtype)
    for coefficient, powers in terms:
        term = np.full(len(total), coefficient, dtype=dtype)
        for wheel, power in zip(wheels, powers, strict=True):
            for _ in range(power):
                term = term * columns[wheel].astype(dtype)
        total = total + term
    return total


class BestAssignments:
    """Keeps the best of all assignments it is given, a bounded number at a time."""

    def __init__(self, order: AssignmentOrder, wheels: Sequence[str]) -> None:
        self.order, self.wheels = order, tuple(wheels)
        self._table: Ints = np.zeros((len(wheels), 0), dtype=np.int64)
        self._new: list[Ints] = []

    def add(self, columns: AssignmentColumns) -> None:
        """Offer some assignments."""
        self._new.append(np.stack([columns[wheel] for wheel in self.wheels]))
        if sum(table.shape[1] for table in self._new) > _POOL:
            self._gather()
            self._drop()
            if self._table.shape[1] > max(4 * self.order.best, _POOL // 4):
                self._sort()

    def best(self) -> list[list[int]]:
        """The counts of the best, best first."""
        self._gather()
        self._drop()
        self._sort()
        found: list[list[int]] = self._table.T.tolist()
        return found

    def _gather(self) -> None:
        self._table = np.concatenate([self._table, *self._new], axis=1)
        self._new = []

    def _columns(self) -> AssignmentColumns:
        return dict(zip(self.wheels, self._table, strict=True))

    def _drop(self) -> None:
        """Drop what bounds on the errors show to be none of the best."""
        best = self.order.best
        if self._table.shape[1] <= best or self.order.level:
            return
        first = self.order.first(self._columns())
        least, greatest = self.order.errors(self._columns())
        # the n-th least upper bound: what lies surely above it is none of the best n
        last = np.lexsort((greatest, first))[best - 1]
        kept: Bools = (first < first[last]) | ((first == first[last]) & (least <= greatest[last]))
        self._table = self._table[:, kept]

    def _sort(self) -> None:
        """Sort exactly, and keep the best."""
        if self._table.shape[1]:
            columns = self._columns()
            sizes = self._table.max(axis=0), self._table.sum(axis=0)
            # lexsort takes its last key first
            keys = (*self._table[::-1], *sizes, self.order.ranks(columns), self.order.first(columns))
            self._table = self._table[:, np.lexsort(keys)[: self.order.best]]
