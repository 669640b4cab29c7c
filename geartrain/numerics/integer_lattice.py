"""Lattices of integer rows: a basis of all integer rows in a rational span, and its dual basis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from geartrain.numerics.elimination import add_into

Row = dict[int, int]


def saturated_lattice(rows: Sequence[Mapping[int, int]]) -> tuple[list[Row], list[Row], int]:
    """Return a basis of the saturated lattice of integer rows, its dual columns, and the index of the given rows in it.

    The saturated lattice consists of all integer rows in the rational span. Unimodular column operations V bring the
    rows Y to triangular form, Y V = [H 0], which is the Hermite normal form without reduction of its entries. The basis
    is H^-1 Y, and the first columns of V are dual to it. The index is det H, and is 1 if the rows are already a basis.
    Linearly dependent rows are omitted.
    """
    columns: dict[int, Row] = {}
    for at, row in enumerate(rows):
        for key, value in row.items():
            columns.setdefault(key, {})[at] = value
    moves: dict[int, Row] = {key: {key: 1} for key in columns}
    basis: list[Row] = []
    dual: list[Row] = []
    pivots: list[Row] = []
    index = 1
    for at, row in enumerate(rows):
        pivot = _reduce(columns, moves, at)
        if pivot is None:
            continue
        column, move = columns.pop(pivot), moves.pop(pivot)
        rest = dict(row)
        for known, before in zip(basis, pivots, strict=True):
            add_into(rest, known, -before.get(at, 0))
        basis.append({key: value // column[at] for key, value in rest.items()})  # divides without remainder
        pivots.append(column)
        dual.append(move)
        index *= abs(column[at])  # the diagonal of H
    return basis, dual, index


def _reduce(columns: dict[int, Row], moves: dict[int, Row], at: int) -> int | None:
    """Reduce row `at` by Euclid's algorithm until only one column has an entry in it; return this column, or None."""
    live = [key for key, column in columns.items() if at in column]
    while len(live) > 1:
        # divide by the smallest entry: remainders, and the numbers in `moves`, stay short
        minimum = min(live, key=lambda key: abs(columns[key][at]))
        size = columns[minimum][at]
        for key in live:
            if key != minimum:
                times = columns[key][at] // size
                add_into(columns[key], columns[minimum], -times)
                add_into(moves[key], moves[minimum], -times)
        live = [key for key in live if at in columns[key]]
    return live[0] if live else None
