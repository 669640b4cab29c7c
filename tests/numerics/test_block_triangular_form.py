"""Block triangular form: against networkx, and the defining properties."""

from __future__ import annotations

from math import prod

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from geartrain.numerics.block_triangular import dulmage_mendelsohn_blocks, find_blocks


@st.composite
def patterns(draw: st.DrawFn) -> list[list[int]]:
    size = draw(st.integers(1, 9))
    columns = st.lists(st.integers(0, size - 1), min_size=1, max_size=4, unique=True)
    return draw(st.lists(columns, min_size=size, max_size=size))


@given(patterns())
def test_blocks_are_a_triangular_form_with_the_fewest_columns_a_block(rows: list[list[int]]) -> None:
    graph = nx.Graph()
    graph.add_nodes_from(("row", at) for at in range(len(rows)))
    graph.add_edges_from((("row", at), ("column", column)) for at, row in enumerate(rows) for column in row)
    matching = nx.bipartite.maximum_matching(graph, [("row", at) for at in range(len(rows))])
    blocks = find_blocks(rows)
    if len(matching) < 2 * len(rows):
        assert blocks is None
        return
    assert sorted(row for block in blocks for row in block.rows) == list(range(len(rows)))
    assert sorted(column for block in blocks for column in block.columns) == list(range(len(rows)))
    known: set[int] = set()
    for block in blocks:
        assert all(column in rows[row] for row, column in zip(block.rows, block.columns, strict=True))
        known.update(block.columns)
        assert all(set(rows[row]) <= known for row in block.rows)
    # any matching has the same blocks: the strong components of its graph
    hangs = nx.DiGraph()
    hangs.add_nodes_from(range(len(rows)))
    for at, row in enumerate(rows):
        own = matching["row", at][1]
        hangs.add_edges_from((own, column) for column in row)
    assert {frozenset(block.columns) for block in blocks} == set(
        map(frozenset, nx.strongly_connected_components(hangs))
    )


def test_a_chain_of_a_hundred_thousand_is_as_many_blocks() -> None:
    size = 100_000
    blocks = find_blocks([[0], *([at, at + 1] for at in range(size - 1))])
    assert [block.columns for block in blocks] == [(at,) for at in range(size)]
    ring = find_blocks([[at, (at + 1) % size] for at in range(size)])
    assert len(ring) == 1


@given(st.dictionaries(st.integers(0, 7), st.sets(st.integers(0, 6), max_size=4), min_size=1))
def test_parts_need_only_what_stands_before_them(rows: dict[int, set[int]]) -> None:
    parts = dulmage_mendelsohn_blocks(rows, 7)
    assert sorted(row for part in parts for row in part.rows) == sorted(rows)
    assert sorted(column for part in parts for column in part.columns) == list(range(7))
    known: set[int] = set()
    for at, part in enumerate(parts):
        known.update(part.columns)
        assert all(rows[row] <= known for row in part.rows)
        assert len(part.rows) <= len(part.columns) or at == 0
        assert len(part.rows) >= len(part.columns) or at == len(parts) - 1
    graph = nx.Graph()
    graph.add_nodes_from(("row", row) for row in rows)
    graph.add_edges_from((("row", row), ("column", column)) for row, held in rows.items() for column in held)
    matching = nx.bipartite.maximum_matching(graph, [("row", row) for row in rows])
    assert sum(min(len(part.rows), len(part.columns)) for part in parts) == len(matching) // 2


def test_an_ordinary_chain_has_one_unknown_a_part() -> None:
    parts = dulmage_mendelsohn_blocks({at: {at, at + 1} for at in range(5000)} | {5000: {0}}, 5001)
    assert prod(len(part.columns) for part in parts) == 1
