"""Block triangular form of a square sparse system: which unknowns must be solved together, and in which order.

It knows only which row holds which column. Every row is matched to a column of its own; a column then hangs on the
other columns of its row, and columns that hang on each other make one block.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple


class Block(NamedTuple):
    """Rows and as many columns that are solved together, in parallel: each row is matched to its column."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]


def find_blocks(rows: Sequence[Sequence[int]], also: Sequence[Sequence[int]] = ()) -> list[Block] | None:
    """Blocks of a system with as many columns as rows, each after all it hangs on; None where no matching exists.

    rows   the columns of each row; `also`, columns that a row hangs on without holding them
    Cost is linear in trees, and rows times entries at worst.
    """
    taken = _match(rows)
    if taken is None:
        return None
    return _strong([(*row, *more) for row, more in zip(rows, also, strict=True)] if also else rows, taken)


def _match(rows: Sequence[Sequence[int]]) -> list[int] | None:
    """The row of every column, every row once; None where there is no such matching."""
    taken = [-1] * len(rows)
    left = _peel(rows, taken)
    return taken if all(_augment(rows, taken, row) for row in left) else None


def _peel(rows: Sequence[Sequence[int]], taken: list[int]) -> list[int]:
    """Match rows with one column left, again and again; what remains is returned."""
    users: list[list[int]] = [[] for _ in rows]
    missing = [len(row) for row in rows]
    for at, row in enumerate(rows):
        for column in row:
            users[column].append(at)
    matched = [False] * len(rows)
    queue = [at for at, count in enumerate(missing) if count == 1]
    for at in queue:
        free = next((column for column in rows[at] if taken[column] < 0), -1)
        if free < 0:
            continue
        taken[free], matched[at] = at, True
        for other in users[free]:
            missing[other] -= 1
            if missing[other] == 1 and not matched[other]:
                queue.append(other)
    return [at for at in range(len(rows)) if not matched[at]]


def _augment(rows: Sequence[Sequence[int]], taken: list[int], start: int) -> bool:
    """Give a row a column, moving other rows to other columns of theirs where need be (depth first, no recursion)."""
    for column in rows[start]:
        if taken[column] < 0:
            taken[column] = start
            return True
    seen: set[int] = set()
    stack = [(start, iter(rows[start]))]
    path: list[int] = []
    while stack:
        _, columns = stack[-1]
        fresh = next((column for column in columns if column not in seen), -1)
        if fresh < 0:
            stack.pop()
            if path:
                path.pop()
            continue
        seen.add(fresh)
        path.append(fresh)
        if taken[fresh] < 0:
            for (row, _), given in zip(stack, path, strict=True):
                taken[given] = row
            return True
        stack.append((taken[fresh], iter(rows[taken[fresh]])))
    return False


def _strong(rows: Sequence[Sequence[int]], taken: Sequence[int]) -> list[Block]:
    """Tarjan's strongly connected components, without recursion: each comes after those it hangs on."""
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
            else:
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
