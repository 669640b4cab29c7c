"""Groups of what is joined: against the connected components of networkx."""

from __future__ import annotations

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from geartrain.numerics.graphs import joined_groups


@given(st.lists(st.lists(st.integers(0, 14), max_size=4), max_size=12))
def test_joined_groups_are_connected_components_in_the_order_of_their_members(joints: list[list[int]]) -> None:
    graph = nx.Graph()
    graph.add_nodes_from(range(12))
    for joint in joints:
        nx.add_path(graph, [thing for thing in joint if thing < 12])
    components = sorted(sorted(members) for members in nx.connected_components(graph))
    assert joined_groups(range(12), joints) == components
