"""Tables within a width: columns that wrap at words, and strips of columns where even that takes too much room."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import zip_longest

from geartrain.report.document import Table

GAP = 2
"""Blanks between two columns; a matrix has one."""


def gap_of(table: Table) -> int:
    """Blanks between two columns of a table."""
    return 1 if table.wide else GAP


def strips(table: Table, width: int) -> Iterator[Table]:
    """A table cut into tables of so many columns that each fits, all with its first column; whole where it fits.

    Words are never broken, but for one that alone takes more than there is.

    width   characters in a line
    """
    least = [_least(column, table.wide) for column in _columns(table)]
    gap, start = gap_of(table), 1
    if len(least) < 2:
        yield table
        return
    while start < len(least):
        end, used = start + 1, least[0] + gap + least[start]
        while end < len(least) and used + gap + least[end] <= width:
            used += gap + least[end]
            end += 1
        yield table if end - start == len(least) - 1 else _chosen(table, [0, *range(start, end)])
        start = end


def column_widths(table: Table, width: int) -> list[int]:
    """Characters of each column, at most as many as it can use; those that want least more than
    their longest word get it first.

    The sum may be more than there is only if the longest words together are.
    """
    columns = _columns(table)
    full = [max(map(len, column)) for column in columns]
    least = [_least(column, table.wide) for column in columns]
    free = width - gap_of(table) * (len(columns) - 1)
    if sum(full) <= free:
        return full
    spare, sizes = max(0, free - sum(least)), list(least)
    left = len(columns)
    for at in sorted(range(len(columns)), key=lambda each: full[each] - least[each]):
        # a column that wants little gets all of it: the fewer columns wrap, the more rows take one line
        given = min(full[at] - least[at], spare if left == 1 else max(spare // 2, spare // left))
        sizes[at] += given
        spare, left = spare - given, left - 1
    return sizes


def _columns(table: Table) -> list[tuple[str, ...]]:
    return list(zip_longest(table.header, *table.rows, fillvalue=""))


def _least(column: Sequence[str], whole: bool) -> int:
    """What a column takes at least: its longest word, or its longest cell where cells do not wrap."""
    pieces = column if whole else [word for cell in column for word in cell.split()]
    return max(1, *(len(piece) for piece in pieces), 0)


def _chosen(table: Table, at: Sequence[int]) -> Table:
    rows = [[row[each] for each in at] for row in table.rows]
    return replace(table, header=[table.header[each] for each in at], rows=rows)
