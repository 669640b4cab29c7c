"""Parts of a sparse system that need not be square: which unknowns must be found together, and in which order.

Rows and columns are matched as far as they can be; alternating paths from unmatched ones part the system into three
(Dulmage and Mendelsohn 1958): one with rows to spare, one that is square, one with columns to spare. Each needs only
what stands before it, and the square one has its own block triangular form.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from geartrain.blocks import Block, find_blocks


def find_parts(rows: Mapping[int, Collection[int]], columns: int) -> list[Block]:
    """Parts in the order in which they can be solved; `rows` gives the columns that each row may hold.

    Only the first can have more rows than columns, and only the last more columns than rows.
    """
    row_of = _match(rows)
    column_of = {row: column for column, row in row_of.items()}
    users: dict[int, list[int]] = {column: [] for column in range(columns)}
    for row, held in rows.items():
        for column in held:
            users[column].append(row)
    over = _reached([row for row in rows if row not in column_of], rows, row_of)
    under = _reached([column for column in users if column not in row_of], users, column_of)
    above = {column_of[row] for row in over if row in column_of}
    below = {row_of[column] for column in under if column in row_of}
    parts = [Block(tuple(sorted(over)), tuple(sorted(above)))] if over else []
    parts += _square({row: held for row, held in rows.items() if row not in over and row not in below}, above)
    return [*parts, Block(tuple(sorted(below)), tuple(sorted(under)))] if under else parts


def _square(rows: Mapping[int, Collection[int]], known: Collection[int]) -> list[Block]:
    """Blocks of the square part, whose rows and columns are numbered anew meanwhile."""
    names = list(rows)
    columns = sorted({column for held in rows.values() for column in held}.difference(known))
    number = {column: at for at, column in enumerate(columns)}
    blocks = find_blocks([[number[column] for column in held if column in number] for held in rows.values()]) or []
    return [
        Block(tuple(names[row] for row in block.rows), tuple(columns[column] for column in block.columns))
        for block in blocks
    ]


def _match(rows: Mapping[int, Collection[int]]) -> dict[int, int]:
    """A matching of as many rows as can be: column -> row. A round visits every column once at most."""
    row_of: dict[int, int] = {}
    free = list(rows)
    while True:
        seen: set[int] = set()
        left = [row for row in free if not _augment(rows, row, row_of, seen)]
        if len(left) == len(free):
            return row_of
        free = left


def _augment(rows: Mapping[int, Collection[int]], root: int, row_of: dict[int, int], seen: set[int]) -> bool:
    """Match one more row by moving others along a shortest alternating path; False if there is none."""
    came: dict[int, tuple[int, int | None]] = {}  # column -> the row that reached it, and that row's own column
    queue: list[tuple[int, int | None]] = [(root, None)]
    for row, own in queue:
        for column in rows[row]:
            if column in seen:
                continue
            seen.add(column)
            came[column] = row, own
            if column in row_of:
                queue.append((row_of[column], column))
                continue
            last: int | None = column
            while last is not None:
                row_of[last], last = came[last]
            return True
    return False


def _reached(starts: list[int], across: Mapping[int, Collection[int]], back: Mapping[int, int]) -> set[int]:
    """All that alternating paths reach: from a start across to the other kind, and back along the matching."""
    found, queue = set(starts), list(starts)
    for here in queue:
        for there in across[here]:
            if (after := back.get(there)) is not None and after not in found:
                found.add(after)
                queue.append(after)
    return found
