"""Block triangular form of a sparse system, by the decomposition of Dulmage and Mendelsohn (1958).

The algorithms are iterative, because a train can be deeper than Python's recursion limit, and need neither numpy nor
networkx, so that commands that solve exactly start fast.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple


class Block(NamedTuple):
    """Rows and an equal number of columns that are solved together; the k-th row is matched to the k-th column."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]


def find_blocks(rows: Sequence[Sequence[int]]) -> list[Block] | None:
    """Return the blocks of a square system, each preceded by the blocks it depends on; None without a matching."""
    row_of = _maximum_matching(dict(enumerate(rows)))
    if len(row_of) < len(rows):
        return None
    taken = [row_of[column] for column in range(len(rows))]
    return _strongly_connected_components(rows, taken)


def _strongly_connected_components(rows: Sequence[Sequence[int]], taken: Sequence[int]) -> list[Block]:
    """Return the strongly connected components (Tarjan's algorithm); `taken` is the row matched to each column."""
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
                # an edge into a finished component closes no cycle
                if not done[other]:
                    low[column] = min(low[column], order[other])
            else:  # every column that this one depends on is done
                stack.pop()
                if stack:
                    above = stack[-1][0]
                    low[above] = min(low[above], low[column])
                if low[column] == order[column]:
                    # a component consists of all columns that were opened since its first one
                    found = [open_.pop()]
                    while found[-1] != column:
                        found.append(open_.pop())
                    for each in found:
                        done[each] = True
                    blocks.append(Block(tuple(taken[each] for each in found), tuple(found)))
    return blocks


def dulmage_mendelsohn_blocks(rows: Mapping[int, Collection[int]], columns: int) -> list[Block]:
    """Return the blocks of the Dulmage-Mendelsohn decomposition, in an order in which they can be solved.

    Only the first block can have more rows than columns, and only the last block can have more columns than rows.
    `rows` maps each row to its columns.
    """
    row_of = _maximum_matching(rows)
    column_of = {row: column for column, row in row_of.items()}
    users: dict[int, list[int]] = {column: [] for column in range(columns)}
    for row, held in rows.items():
        for column in held:
            users[column].append(row)
    over = _reachable([row for row in rows if row not in column_of], rows, row_of)
    under = _reachable([column for column in users if column not in row_of], users, column_of)
    above = {column_of[row] for row in over if row in column_of}
    below = {row_of[column] for column in under if column in row_of}
    parts = [Block(tuple(sorted(over)), tuple(sorted(above)))] if over else []
    parts += _square_blocks({row: held for row, held in rows.items() if row not in over and row not in below}, above)
    return [*parts, Block(tuple(sorted(below)), tuple(sorted(under)))] if under else parts


def _square_blocks(rows: Mapping[int, Collection[int]], known: Collection[int]) -> list[Block]:
    """Return the blocks of square rows without their `known` columns, with the original row and column numbers."""
    names = list(rows)
    columns = sorted({column for held in rows.values() for column in held}.difference(known))
    number = {column: at for at, column in enumerate(columns)}
    blocks = find_blocks([[number[column] for column in held if column in number] for held in rows.values()]) or []
    return [
        Block(tuple(names[row] for row in block.rows), tuple(columns[column] for column in block.columns))
        for block in blocks
    ]


def _maximum_matching(rows: Mapping[int, Collection[int]]) -> dict[int, int]:
    """Return a maximum bipartite matching as a mapping from column to row, found by augmenting paths."""
    row_of: dict[int, int] = {}
    free = list(rows)
    while True:
        # shared by all rows of a round: a column without an augmenting path has none until the matching changes
        seen: set[int] = set()
        left = [row for row in free if not _augment_from(rows, row, row_of, seen)]
        if len(left) == len(free):
            return row_of
        free = left


def _augment_from(rows: Mapping[int, Collection[int]], root: int, row_of: dict[int, int], seen: set[int]) -> bool:
    """Match the row `root` along an augmenting path outside the columns `seen`; return True if there is such a path."""
    # column -> the row that reached it, and the column matched to that row
    came: dict[int, tuple[int, int | None]] = {}
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
            # flip the matching along the path back to the root
            last: int | None = column
            while last is not None:
                row_of[last], last = came[last]
            return True
    return False


def _reachable(starts: list[int], across: Mapping[int, Collection[int]], back: Mapping[int, int]) -> set[int]:
    """Return the rows that alternating paths reach from `starts`: `across` to columns, `back` to their matched rows."""
    found, queue = set(starts), list(starts)
    for here in queue:
        for there in across[here]:
            if (after := back.get(there)) is not None and after not in found:
                found.add(after)
                queue.append(after)
    return found
