"""Tables of results, and tables within a width: every cell once, no word broken, no line too long."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st

from geartrain.report import Document, Section, Table, to_text
from geartrain.report.document import column_widths, gap_of, result_table, strips

WORD = st.text("abcdef0123/", min_size=1, max_size=12)
CELL = st.lists(WORD, max_size=5).map(" ".join)


@st.composite
def tables(draw: st.DrawFn) -> Table:
    columns = draw(st.integers(1, 9))
    row = st.lists(CELL, min_size=columns, max_size=columns)
    return Table(draw(row), draw(st.lists(row, max_size=5)), wide=draw(st.booleans()))


@given(tables(), st.integers(30, 120))
def test_strips_hold_every_cell_once_under_the_first_column(table: Table, width: int) -> None:
    parts = list(strips(table, width))
    for at, row in enumerate((table.header, *table.rows)):
        rows = [(part.header, *part.rows)[at] for part in parts]
        assert all(each[0] == row[0] for each in rows)
        assert [row[0], *(cell for each in rows for cell in each[1:])] == list(row)


@given(tables(), st.integers(30, 120))
def test_columns_hold_their_longest_words_and_lines_their_width(table: Table, width: int) -> None:
    for part in strips(table, width):
        sizes = column_widths(part, width)
        for size, column in zip(sizes, zip(part.header, *part.rows, strict=True), strict=True):
            words = column if part.wide else [word for cell in column for word in cell.split()]
            assert size >= max(map(len, words), default=0)
        if len(sizes) > 2:  # a single column beside the first has all there is
            assert sum(sizes) + gap_of(part) * (len(sizes) - 1) <= width


@given(tables(), st.integers(40, 100))
def test_plain_text_shows_every_word_within_its_width(table: Table, width: int) -> None:
    shown = to_text([Document("Title", ("A lead.",), [Section("Part", (), [table])])], width)
    assert max(map(len, shown.splitlines())) <= width
    said = "".join(shown.split())
    for row in (table.header, *table.rows):
        for cell in row:
            for word in cell.split():
                assert word in said


def test_what_fits_is_left_whole_and_as_wide_as_it_is() -> None:
    table = Table(("link", "speed"), [("sun", "1"), ("a long name", "-254/19")])
    assert list(strips(table, 80)) == [table]
    assert column_widths(table, 80) == [11, 7]


def test_a_column_that_wants_little_gets_it_before_one_that_wants_much() -> None:
    table = Table(("of", "as read"), [("moon seen from b", "clockwise, a turn in 0.0748, a division in 0.0002077865")])
    assert column_widths(table, 50) == [16, 32]


@dataclass(frozen=True)
class Bearing:
    """A result as tables show it."""

    name: str
    side_load: float | None
    """Across the shaft [N]."""
    turns: int = 3
    """Not a number with digits."""


def test_a_table_of_results_takes_its_heads_from_fields_and_their_units() -> None:
    found = (Bearing("a", 12.3456), Bearing("b", None))
    table = result_table(found, "name", "side_load:3", "turns of it=turns", ("twice", lambda each: each.name * 2))
    assert list(table.header) == ["name", "side load (N)", "turns of it", "twice"]
    assert list(table.rows) == [("a", "12.3", "3", "aa"), ("b", "-", "3", "bb")]
    with pytest.raises(AttributeError):
        result_table(found, "sideload")
