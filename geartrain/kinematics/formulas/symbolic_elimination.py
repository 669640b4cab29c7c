"""Linear systems whose coefficients are Laurent polynomials: exact, and true at every assignment that solves them.

As long as a row has a monomial to divide by, it is divided by that: monomials never vanish, so this changes no
solution anywhere. What is left, the core, is coupled. It falls into blocks (block triangular form), and each block is
solved by Cramer's rule; denominators are products of the blocks' determinants, each once.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from operator import itemgetter

from geartrain.kinematics.formulas.laurent import Laurent, minors, product
from geartrain.numerics.block_triangular import find_blocks
from geartrain.numerics.elimination import PRIME, add_into, eliminate_units

Row = dict[int, Laurent]
"""A linear form: column -> coefficient. Columns >= 0 are unknowns; column -1 holds what is given."""

GIVEN = -1
_Residues = dict[int, int]


@dataclass(frozen=True, slots=True)
class SymbolicValue:
    """A numerator over the product of the determinants of some blocks, each once."""

    numerator: Laurent
    blocks: frozenset[int] = frozenset()


@dataclass(frozen=True, slots=True)
class SymbolicSolution:
    """The unknowns of a system as functions.

    pivots        (column, rest): column = -rest, rest free of all columns taken before it
    values        what the core gives for its columns; columns left free count as 0
    determinants  of the core's blocks
    span          the core's rows at a point taken at random, in echelon form: leading column -> row
    conditions    (row, function): what must vanish for the system to hold, and the row it is left of
    """

    width: int
    point: Sequence[int]
    pivots: Sequence[tuple[int, Row]]
    values: Mapping[int, SymbolicValue]
    determinants: Sequence[Laurent]
    span: Mapping[int, _Residues]
    conditions: Sequence[tuple[int, Laurent]]

    def value(self, form: Mapping[int, Laurent]) -> SymbolicValue | None:
        """A linear form of the unknowns; None where the system leaves it free."""
        rest = dict(form)
        for column, equal in self.pivots:
            factor = rest.pop(column, None)
            if factor is not None:
                add_into(rest, equal, -factor)
        free = {c: entry.modulo(self.point, PRIME) for c, entry in rest.items() if c != GIVEN}
        if _cleared(free, self.span):
            return None
        return _combined(rest, self.values, self.determinants, self.width)

    def denominator(self, value: SymbolicValue) -> Laurent:
        """The product of a value's determinants."""
        return product((self.determinants[block] for block in sorted(value.blocks)), self.width)


def solve_rows(rows: Sequence[Row], width: int, preferred: Sequence[int] | None = None) -> SymbolicSolution:
    """Solve rows that must all vanish. Which of them determine the unknowns is decided at a random point.

    preferred   an assignment that is known to be meant: if more rows than unknowns are coupled, those are used that
                are independent there; without it, rows that hold what is given come first

    Raises `TooLongError` where so many unknowns depend on each other that their functions are of no use.
    """
    # always the same point, so that a question has one answer
    draw = random.Random(width)
    # a polynomial that is not 0 vanishes at a random point with a chance below its degree over the prime, 2^61 - 1
    # (Schwartz and Zippel)
    point = [draw.randrange(1, PRIME) for _ in range(width)]
    pivots, core, conditions = _divide_out(rows)
    chosen, span = _independent(core, point)
    leading = span
    if preferred is not None and len(chosen) < len(core):
        meant, there = _independent(core, preferred)
        if len(meant) == len(chosen):
            chosen, leading = meant, there
    values, determinants = _solve_core([core[at][1] for at in chosen], sorted(leading), width)
    for at, (origin, row) in enumerate(core):
        if at not in chosen:
            left = _combined(row, values, determinants, width).numerator
            conditions += [(origin, left)] if left else []
    return SymbolicSolution(width, point, pivots, values, determinants, span, conditions)


class _LaurentRing:
    """Laurent polynomials, whose units are the monomials."""

    modulus = 0

    def inverse(self, entry: Laurent) -> Laurent | None:
        return entry.inverse() if entry.is_unit else None

    def words(self, entry: Laurent) -> int:
        return len(entry)


def _divide_out(
    rows: Sequence[Row],
) -> tuple[list[tuple[int, Row]], list[tuple[int, Row]], list[tuple[int, Laurent]]]:
    """Eliminate by monomials. Pivots, the core, and conditions."""
    pivots, left = eliminate_units(rows, _LaurentRing())
    core = [(at, row) for at, row in left if row.keys() - {GIVEN}]
    core.sort(key=lambda pair: (GIVEN not in pair[1], pair[0]))
    conditions = [(at, row[GIVEN]) for at, row in sorted(left, key=itemgetter(0)) if row.keys() == {GIVEN}]
    return pivots, core, conditions


def _independent(rows: Iterable[tuple[int, Row]], point: Sequence[int]) -> tuple[list[int], dict[int, _Residues]]:
    """The first rows that are independent at a point modulo the prime, and their echelon form."""
    chosen: list[int] = []
    span: dict[int, _Residues] = {}
    for at, (_, row) in enumerate(rows):
        rest = _cleared({c: entry.modulo(point, PRIME) for c, entry in row.items() if c != GIVEN}, span)
        if rest:
            lead = min(rest)
            inverse = pow(rest[lead], -1, PRIME)
            span[lead] = {column: value * inverse % PRIME for column, value in rest.items()}
            chosen.append(at)
    return chosen, span


def _cleared(row: Mapping[int, int], span: Mapping[int, _Residues]) -> _Residues:
    """What is left of a row when the echelon's leading columns are eliminated from it; no zeros."""
    rest = {column: value for column, value in row.items() if value}
    while True:
        lead = next((column for column in sorted(rest) if column in span), None)
        if lead is None:
            return rest
        factor = rest[lead]
        for column, value in span[lead].items():
            new = (rest.get(column, 0) - factor * value) % PRIME
            if new:
                rest[column] = new
            else:
                rest.pop(column, None)


def _solve_core(
    rows: Sequence[Row], columns: Sequence[int], width: int
) -> tuple[dict[int, SymbolicValue], list[Laurent]]:
    """The unknowns of a square core block by block; the other columns count as 0."""
    place = {column: at for at, column in enumerate(columns)}
    blocks = find_blocks([[place[column] for column in row if column in place] for row in rows])
    assert blocks is not None, "a system of full rank has a matching"
    values: dict[int, SymbolicValue] = {}
    determinants: list[Laurent] = []
    for number, block in enumerate(blocks):
        inside = {columns[at]: index for index, at in enumerate(block.columns)}
        outside = [{c: entry for c, entry in rows[at].items() if c not in inside} for at in block.rows]
        used = frozenset().union(*(values[c].blocks for row in outside for c in row if c in values))
        size = len(inside)
        matrix = [
            {inside[c]: entry for c, entry in rows[at].items() if c in inside}
            | {size: -_over_blocks(row, values, determinants, used, width)}
            for at, row in zip(block.rows, outside, strict=True)
        ]
        *replaced, whole = minors(matrix, width)
        for column, index in inside.items():
            # Cramer's rule: the right side stands last, and moves over the columns after the one it replaces
            odd = (size - 1 - index) & 1
            values[column] = SymbolicValue(-replaced[index] if odd else replaced[index], used | {number})
        determinants.append(whole)
    return values, determinants


def _combined(
    form: Mapping[int, Laurent], values: Mapping[int, SymbolicValue], determinants: Sequence[Laurent], width: int
) -> SymbolicValue:
    """A form of the core's columns and of what is given, over one denominator."""
    used = frozenset().union(*(values[column].blocks for column in form if column in values))
    return SymbolicValue(_over_blocks(form, values, determinants, used, width), used)


def _over_blocks(
    form: Mapping[int, Laurent],
    values: Mapping[int, SymbolicValue],
    determinants: Sequence[Laurent],
    used: frozenset[int],
    width: int,
) -> Laurent:
    """The numerator of a form over the product of the determinants of the blocks `used`."""
    total = Laurent.constant(0, width)
    for column, entry in form.items():
        value = SymbolicValue(Laurent.constant(1, width)) if column == GIVEN else values.get(column)
        if value is not None and value.numerator:
            missing = (determinants[block] for block in sorted(used - value.blocks))
            total = total + product((entry, value.numerator, *missing), width)
    return total
