"""Which unknowns of a sparse system must be found together, and in which order; known is only which row holds which.

Rows are matched to columns of their own as far as they can be. In a square system a column then depends on the other
columns of its row, and columns that depend on each other make one block of the block triangular form. In any other,
alternating paths from unmatched rows and columns part the system into three (Dulmage and Mendelsohn 1958): one with
rows to spare, one that is square, one with columns to spare; each needs only what stands before it.

Written out here, for the answers that need it are to load neither numpy nor networkx, and without recursion: trains are
as deep as they like.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple


class Block(NamedTuple):
    """Rows and as many columns that are solved together, in parallel: each row is matched to its column."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]


def find_blocks(rows: Sequence[Sequence[int]], also: Sequence[Sequence[int]] = ()) -> list[Block] | None:
    """Block triangular form of a square system: each block after all it depends on; None where no matching exists.

    rows   the columns of each row; `also`, columns that a row depends on without holding them
    Cost is linear in trees, and rows times entries at worst.
    """
    row_of = _maximum_matching(dict(enumerate(rows)))
    if len(row_of) < len(rows):
        return None
    taken = [row_of[column] for column in range(len(rows))]
    return _strong([(*row, *more) for row, more in zip(rows, also, strict=True)] if also else rows, taken)


def _strong(rows: Sequence[Sequence[int]], taken: Sequence[int]) -> list[Block]:
    """Tarjan's strongly connected components, without recursion: each comes after those it depends on."""
    order: dict[int, int] = {}
    low = [0] * len(rows)
    done = [False] * len(rows)
    open_: list[int] = []
    blocks: list[Block] = []
    for root in range(len(rows)):
        if root in order:
            continue
        stack = [(root, iter(rows[taken[root]]))]
        order[root] = low[root] = len(order)
        open_.append(root)
        while stack:
            column, others = stack[-1]
            for other in others:
                if other not in order:
                    order[other] = low[other] = len(order)
                    open_.append(other)
                    stack.append((other, iter(rows[taken[other]])))
                    break
                if not done[other]:
                    low[column] = min(low[column], order[other])
            else:  # all that the column depends on is done
                stack.pop()
                if stack:
                    above = stack[-1][0]
                    low[above] = min(low[above], low[column])
                if low[column] == order[column]:
                    found = _close(open_, column, done)
                    blocks.append(Block(tuple(taken[each] for each in found), found))
    return blocks


def _close(open_: list[int], root: int, done: list[bool]) -> tuple[int, ...]:
    found = []
    while True:
        column = open_.pop()
        done[column] = True
        found.append(column)
        if column == root:
            return tuple(found)


def dulmage_mendelsohn_blocks(rows: Mapping[int, Collection[int]], columns: int) -> list[Block]:
    """Dulmage-Mendelsohn decomposition: parts in the order in which they can be solved, from the columns of each row.

    Only the first can have more rows than columns, and only the last more columns than rows.
    """
    row_of = _maximum_matching(rows)
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
    parts += _square_blocks({row: held for row, held in rows.items() if row not in over and row not in below}, above)
    return [*parts, Block(tuple(sorted(below)), tuple(sorted(under)))] if under else parts


def _square_blocks(rows: Mapping[int, Collection[int]], known: Collection[int]) -> list[Block]:
    """Blocks of the square part, whose rows and columns are numbered anew meanwhile."""
    names = list(rows)
    columns = sorted({column for held in rows.values() for column in held}.difference(known))
    number = {column: at for at, column in enumerate(columns)}
    blocks = find_blocks([[number[column] for column in held if column in number] for held in rows.values()]) or []
    return [
        Block(tuple(names[row] for row in block.rows), tuple(columns[column] for column in block.columns))
        for block in blocks
    ]


def _maximum_matching(rows: Mapping[int, Collection[int]]) -> dict[int, int]:
    """Maximum bipartite matching by augmenting paths: column -> row. A round visits every column once at most."""
    row_of: dict[int, int] = {}
    free = _peel(rows, row_of)
    while True:
        # one set for all rows of a round: a column from which no way led on leads nowhere until the matching changes
        seen: set[int] = set()
        left = [row for row in free if not _augment_from(rows, row, row_of, seen)]
        if len(left) == len(free):
            return row_of
        free = left


def _peel(rows: Mapping[int, Collection[int]], row_of: dict[int, int]) -> list[int]:
    """Karp and Sipser's rule: match rows with one column left, again and again; the rows that remain.

    This settles trees in linear time.
    """
    users: dict[int, list[int]] = {}
    for row, held in rows.items():
        for column in held:
            users.setdefault(column, []).append(row)
    missing = {row: len(held) for row, held in rows.items()}
    matched: set[int] = set()
    queue = [row for row, count in missing.items() if count == 1]
    for row in queue:
        free = next((column for column in rows[row] if column not in row_of), None)
        if free is None:
            continue
        row_of[free] = row
        matched.add(row)
        for other in users[free]:
            missing[other] -= 1
            if missing[other] == 1 and other not in matched:
                queue.append(other)
    return [row for row in rows if row not in matched]


def _augment_from(rows: Mapping[int, Collection[int]], root: int, row_of: dict[int, int], seen: set[int]) -> bool:
    """Breadth-first search for an alternating path that lets one more row be matched; False if there is none."""
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
