"""Groups of what is joined and paths in trees: against networkx."""

from __future__ import annotations

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from geartrain.numerics.graphs import joined_groups, tree_path


@given(st.lists(st.lists(st.integers(0, 14), max_size=4), max_size=12))
def test_joined_groups_are_connected_components_in_the_order_of_their_members(joints: list[list[int]]) -> None:
    graph = nx.Graph()
    graph.add_nodes_from(range(12))
    for joint in joints:
        nx.add_path(graph, [thing for thing in joint if thing < 12])
    components = sorted(sorted(members) for members in nx.connected_components(graph))
    assert joined_groups(range(12), joints) == components


@given(st.lists(st.integers(0, 10**6), min_size=1, max_size=30), st.data())
def test_the_way_between_two_vertices_of_a_tree_is_the_only_path(picks: list[int], data: st.DataObject) -> None:
    above = {at: pick % at for at, pick in enumerate(picks, 1)}  # each vertex below one that came before it
    tree = nx.Graph(above.items())
    i, j = (data.draw(st.integers(0, len(picks))) for _ in range(2))
    assert tree_path(i, j, above.get) == nx.shortest_path(tree, i, j)
