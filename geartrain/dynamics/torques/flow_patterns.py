"""Patterns of power flow that are consistent with the losses; see equations (5), (7) and (8) of docs/torques.md.

The balance is piecewise linear, with one linear system for each pattern. If all pieces have the same orientation, there
is exactly one solution (Samelson, Thrall and Wesler). If not, there may be no solution (self-locking) or several. In
block triangular form, an ordinary train has one unknown per block, and only the patterns of coupled meshes within a
block are enumerated. If a block contains too many meshes with losses, a fixed-point iteration gives one pattern, and
the result is marked as not exhaustively checked.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, product

from geartrain.dynamics.torques.torque_balance import DrivingSides, SolvedTorques, TorqueBalance, TorqueUnknown
from geartrain.numerics.block_triangular import Block
from geartrain.numerics.elimination import Echelon, LinearForm, eliminate, feasible

Sides = Mapping[int, int]
"""Driving side of each unknown torque, by column of the balance; see `TorqueUnknown`."""

KnownTorques = Mapping[int, LinearForm]
"""Known torque of each row of the balance, as a linear form of symbols, whose columns are negative numbers."""
_MOST_TRIED = 14  # lossy torques of a block with exhaustive enumeration: 2^14 small systems
_MOST_OPEN = 10  # the same if torques remain undetermined anyway and the iteration has found a solution
_MOST_ROUNDS = 50  # maximum iterations; a repeated pattern ends them sooner
_MOST_FLOWS = 256  # maximum number of partial solutions
_KNOWN = -1  # column of the known torques

Values = dict[int, Fraction | None]
"""Value of each unknown torque, by column of the balance; None if it is undetermined."""


def eliminate_block(columns: Sequence[TorqueUnknown], block: Block, sides: Sides, known: KnownTorques) -> Echelon:
    """Return the exact echelon form of the torque equations of one block, equations (3) of docs/torques.md. `sides` is
    the driving side of each unknown torque: 1 for the first link, -1 for the second, 0 without losses.
    """
    rows = {row: dict(form) for row, form in known.items()}
    for column in block.columns:
        for row, value in columns[column].pieces[sides[column]].items():
            if row in rows:
                rows[row][column] = value
    return eliminate(rows.values())


def solve_block(
    columns: Sequence[TorqueUnknown], block: Block, sides: Sides, known: KnownTorques
) -> dict[int, LinearForm | None] | None:
    """Return the unknown torques of a block as linear forms of symbols; None for each undetermined torque.

    The result is None if no torques balance the known torques.
    """
    if len(block.rows) == len(block.columns) == 1:
        # fast path: an ordinary train may have thousands of such blocks
        (row,), (column,) = block.rows, block.columns
        if coefficient := columns[column].pieces[sides[column]].get(row):  # else the general elimination decides
            return {column: {symbol: -value / coefficient for symbol, value in known[row].items()}}
    echelon = eliminate_block(columns, block, sides, known)
    if echelon.conditions:
        return None
    # an unknown is determined if only symbols (negative columns) are left in its form
    closed = {column: form for column, form in echelon.forms().items() if all(other < 0 for other in form)}
    return {column: closed.get(column) for column in block.columns}


@dataclass(frozen=True)
class FlowPattern:
    """Driving side of every pair with losses, and the torques, which transmit power in these directions."""

    pattern: DrivingSides
    solved: SolvedTorques


@dataclass
class _Partial:
    """Solution of some blocks of the balance: driving side and torque of each solved column, and sum of the known and
    computed torques in each row.
    """

    sides: dict[int, int]
    values: Values
    rows: dict[int, Fraction]


def find_flow_patterns(balance: TorqueBalance) -> tuple[tuple[FlowPattern, ...], bool]:
    """Return all flow patterns whose torques agree with the assumed driving sides, and True if all patterns were tried.

    The blocks of the Dulmage-Mendelsohn decomposition are solved in order, each by enumeration of its patterns or by
    fixed-point iteration.
    """
    found = _solve_blocks(balance, balance.parts)
    if found is None:
        found = _solve_blocks(balance, [balance.whole])
    partials, complete = found or ([], True)
    return tuple(_flow(balance, each) for each in partials), complete


def _solve_blocks(balance: TorqueBalance, blocks: Sequence[Block]) -> tuple[list[_Partial], bool] | None:
    """Return all solutions of the balance, and True if all combinations of driving sides were tried; None if a block
    other than the last leaves one of its torques undetermined.
    """
    partials, complete = [_Partial({}, {}, dict(balance.rows))], True
    for block in blocks:
        followed: list[_Partial] = []
        for partial in partials:
            found, tried = _solutions(balance.columns, block, partial.rows)
            complete &= tried
            # an undetermined torque may be determined by a later block
            if block is not blocks[-1] and any(value is None for _, values in found for value in values.values()):
                return None
            for at, (sides, values) in enumerate(found):
                # the last solution extends the partial solution in place
                branch = partial
                if at + 1 < len(found):
                    branch = _Partial(dict(partial.sides), dict(partial.values), dict(partial.rows))
                branch.sides.update(sides)
                branch.values.update(values)
                for column, value in values.items():
                    if value:
                        for row, coefficient in balance.columns[column].pieces[sides[column]].items():
                            if row in branch.rows:
                                branch.rows[row] += coefficient * value
                followed.append(branch)
        complete &= len(followed) <= _MOST_FLOWS
        partials = followed[:_MOST_FLOWS]
    return partials, complete


def _flow(balance: TorqueBalance, partial: _Partial) -> FlowPattern:
    pattern: dict[str, int] = {}
    found: dict[str, Fraction | None] = {}
    for at, column in enumerate(balance.columns):
        for mesh in column.meshes:
            found[mesh.id] = partial.values[at]
            if mesh.loses:
                pattern[mesh.id] = column.side_of(mesh, partial.sides[at])
    multipliers = {mesh.id: found[mesh.id] for mesh in balance.meshes}
    plain = [partial.values[at] for at, column in enumerate(balance.columns) if not column.meshes]
    # columns without meshes are in the order: unknown torques, brakes, locks
    unknown, held = len(balance.unknown), len(balance.held)
    external = dict(zip(balance.unknown, plain, strict=False))
    brakes = dict(zip(balance.held, plain[unknown:], strict=False))
    return FlowPattern(
        pattern,
        SolvedTorques(
            {name: value or Fraction(0) for name, value in multipliers.items()},
            {link: value for link, value in external.items() if value is not None},
            {link: value for link, value in brakes.items() if value is not None},
            tuple(plain[unknown + held :]),
            tuple(name for name, value in multipliers.items() if value is None),
            tuple(link for links in (external, brakes) for link, value in links.items() if value is None),
        ),
    )


def _solutions(
    columns: Sequence[TorqueUnknown], block: Block, rows: Mapping[int, Fraction]
) -> tuple[list[tuple[Sides, Values]], bool]:
    """Return the driving sides and torques of every solution of one block, and True if all combinations of sides were
    tried.
    """
    known: KnownTorques = {row: {_KNOWN: rows[row]} if rows[row] else {} for row in block.rows}
    lossy = [column for column in block.columns if len(columns[column].sides) > 1]
    base = {column: columns[column].sides[0] for column in block.columns}
    if not any(known.values()):
        # without known torques all torques of a regular block are 0, for any driving sides
        values = _solve(columns, block, base, known)
        if values is not None and None not in values.values():
            return [(base, values)], True
    first = _iterate(columns, block, lossy, base, known) if len(lossy) > _MOST_OPEN else None
    is_open = len(block.columns) > len(block.rows)
    tried = len(lossy) <= (_MOST_OPEN if is_open and first else _MOST_TRIED)
    found: list[tuple[Sides, Values]] = []
    every = product(*(columns[column].sides for column in lossy)) if tried else ()
    rest = ({**base, **dict(zip(lossy, sides, strict=True))} for sides in every)
    for sides in chain([first] if first else [], rest):
        values = _solve(columns, block, sides, known)
        if values is None or not _is_consistent(columns, block, sides, values, known):
            continue
        # both sides of an idle mesh give the same torques
        if all(values != each for _, each in found):
            found.append((sides, values))
    return found, tried


def _is_consistent(
    columns: Sequence[TorqueUnknown], block: Block, sides: Sides, values: Values, known: KnownTorques
) -> bool:
    """Return True if some values of the undetermined torques make power flow from the assumed driving sides, equation
    (7) of docs/torques.md.
    """
    if not all(columns[column].admits(sides[column], value or Fraction(0)) for column, value in values.items()):
        return False
    bound = [
        column
        for column, value in values.items()
        if value is None and (sides[column] or columns[column].barred or columns[column].sense)
    ]
    if not bound:
        return True
    solved = eliminate_block(columns, block, sides, known).forms()
    demands: list[LinearForm] = []
    for column in bound:
        form = solved.get(column, {column: Fraction(1)})
        # required sign of the torque: power in the direction of the side, or the sense of a one-way clutch
        way = -sides[column] * columns[column].turn or columns[column].sense
        demands.append({at: way * value for at, value in form.items()})
        if columns[column].barred:
            demands.append({at: -way * value for at, value in form.items()})
    return feasible(demands, _KNOWN)


def _solve(columns: Sequence[TorqueUnknown], block: Block, sides: Sides, known: KnownTorques) -> Values | None:
    """Return the torques of one block, by column, for given driving sides; None if none balance the known ones."""
    found = solve_block(columns, block, sides, known)
    if found is None:
        return None
    return {column: None if form is None else form.get(_KNOWN, Fraction(0)) for column, form in found.items()}


def _iterate(
    columns: Sequence[TorqueUnknown], block: Block, lossy: Sequence[int], base: Sides, known: KnownTorques
) -> Sides | None:
    """Return driving sides that agree with the torques, found by fixed-point iteration from the solution without
    losses; None if the iteration fails or repeats a choice of sides.
    """
    sides: Sides = {**base, **dict.fromkeys(lossy, 0)}
    seen: list[Sides] = []
    for _ in range(_MOST_ROUNDS):
        values = _solve(columns, block, sides, known)
        if values is None:
            return None
        # the first round has no losses, so it is not a pattern
        if seen and _is_consistent(columns, block, sides, values, known):
            return sides
        wanted = {column: -1 if (values[column] or 0) * columns[column].turn > 0 else 1 for column in lossy}
        sides = {**base, **wanted}
        if sides in seen:
            return None
        seen.append(sides)
    return None
