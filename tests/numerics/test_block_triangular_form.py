"""Block triangular form: against networkx, and the defining properties."""

from __future__ import annotations

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from geartrain.numerics.block_triangular import find_blocks


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
