"""A graph of who meshes with whom as a planar map, or why gears on a sphere cannot follow it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Sequence
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.spherical.assembly_loops import fundamental_loops

if TYPE_CHECKING:
    import networkx as nx

    from geartrain.numerics.arrays import Ints


Edges = Iterable[tuple[Hashable, Hashable]]


def separating_pair(regions: Sequence[Sequence[int]]) -> tuple[int, int] | None:
    """Two gears whose removal parts a 2-connected planar map, or None: it is then 3-connected.

    Two regions of a 3-connected map share nothing, one gear, or the two gears of one mesh between them.
    """
    sides: dict[frozenset[int], list[int]] = {}
    beside: dict[int, list[int]] = {}
    for at, walk in enumerate(regions):
        for k, gear in enumerate(walk):
            beside.setdefault(gear, []).append(at)
            sides.setdefault(frozenset((gear, walk[k - 1])), []).append(at)
    shared: dict[tuple[int, int], list[int]] = {}
    for gear, around in beside.items():
        for pair in combinations(sorted(around), 2):
            shared.setdefault(pair, []).append(gear)
    for pair, gears in shared.items():
        for i, j in combinations(gears, 2):
            if sorted(sides.get(frozenset((i, j)), ())) != list(pair):
                return i, j
    return None


def checked_graph(graph: nx.Graph[Any] | Edges) -> nx.Graph[Any]:
    """The graph, if it is simple, bipartite and 2-connected. Raises `QuestionError` with the reason where it is not."""
    import networkx as nx

    given = graph if isinstance(graph, nx.Graph) else None
    pairs = list(graph if given is None else given.edges())
    _simple(pairs, both_ways=isinstance(given, nx.DiGraph))
    loose = [] if given is None else [str(node) for node, degree in given.degree() if not degree]
    if loose:
        raise _refused(f"{', '.join(loose)} mesh with nothing", "their place would be anywhere", "leave them out")
    found: nx.Graph[Any] = nx.Graph(pairs)
    if found.number_of_nodes() < 4:
        raise _refused(
            f"{found.number_of_nodes()} gears", "a packing needs a loop of four or more", "add gears until loops close"
        )
    _no_odd_loop(found)
    _holds_together(found)
    return found


def _simple(pairs: Sequence[tuple[Hashable, Hashable]], both_ways: bool) -> None:
    """No gear in mesh with itself, and no mesh named twice (unless arrows lead both ways)."""
    alone = [str(i) for i, j in pairs if i == j]
    if alone:
        raise _refused(f"{alone[0]} meshes with itself", "a gear has one axis", "leave that mesh out")
    counted = Counter(frozenset(pair) for pair in pairs)
    twice = [pair for pair, count in counted.items() if count > (2 if both_ways else 1)]
    if twice:
        names = " and ".join(sorted(map(str, twice[0])))
        raise _refused(f"{names} mesh twice", "two gears on a sphere touch at one point", "name each mesh once")


def _holds_together(found: nx.Graph[Any]) -> None:
    """Connected, and not through one gear alone."""
    import networkx as nx

    parts = [sorted(map(str, part)) for part in nx.connected_components(found)]
    if len(parts) > 1:
        least = min(parts, key=len)
        apart = ", ".join(least)
        raise _refused(
            f"{apart} stand apart", "parts without a mesh between them do not fix each other", "pack one part at a time"
        )
    cut = next(iter(nx.articulation_points(found)), None)
    if cut is None:
        return
    ends = ", ".join(sorted(str(node) for node, degree in found.degree() if degree == 1))
    fix = f"leave {ends} out: gears at an end go wherever there is room" if ends else f"add a mesh that passes {cut} by"
    raise _refused(
        f"{cut} alone holds two parts together", "the parts can turn about it, so that no packing is the only one", fix
    )


def _no_odd_loop(found: nx.Graph[Any]) -> None:
    names = list(found)
    at = {name: k for k, name in enumerate(names)}
    loops = fundamental_loops(len(names), [(at[i], at[j]) for i, j in found.edges()])
    odd = [loop for loop in loops if len(loop) % 2]
    if odd:
        walk = " - ".join(str(names[k]) for k in min(odd, key=len))
        raise _refused(
            f"loop {walk} is odd", "neighbours turn against each other, so an odd loop locks", "leave one mesh out"
        )


def _refused(what: str, why: str, fix: str) -> QuestionError:
    return QuestionError(Problem(f"the graph cannot be packed: {what}", why, fix))


def turning_senses(found: nx.Graph[Any], names: Sequence[Hashable]) -> Ints:
    """+1 or -1 for each gear: the way it turns."""
    import networkx as nx

    colours = nx.bipartite.color(found)
    return np.array([1 if colours[name] else -1 for name in names], dtype=np.int64)


def regions_of(found: nx.Graph[Any]) -> list[list[int]]:
    """The regions of a planar embedding, as walks of gear numbers."""
    import networkx as nx

    drawn: Any
    planar, drawn = nx.check_planarity(found, counterexample=True)
    if not planar:
        corners = sorted((str(node) for node, degree in drawn.degree() if degree > 2))
        why = "every two of them are joined" if len(corners) == 5 else "three of them are joined to the other three"
        raise _refused(
            f"it is not planar: {', '.join(corners)}",
            f"{why}, by meshes or chains of gears that meet nowhere else (Kuratowski)",
            "leave a mesh out of these chains",
        )
    at = {name: k for k, name in enumerate(found)}
    seen: set[tuple[Hashable, Hashable]] = set()
    return [[at[node] for node in drawn.traverse_face(*e, seen)] for e in drawn.edges() if e not in seen]


def with_region_circles(
    gears: int, regions: Sequence[Sequence[int]], names: Sequence[Hashable]
) -> tuple[int, list[tuple[int, ...]]]:
    """Gears and regions with one circle more in every region beside an idler, touching all that bound it."""
    meshes = Counter(gear for walk in regions for gear in walk)
    propped: list[tuple[int, ...]] = []
    for walk in regions:
        if any(meshes[gear] == 2 for gear in walk):
            propped += [(walk[k - 1], gear, gears) for k, gear in enumerate(walk)]
            gears += 1
        else:
            propped.append(tuple(walk))
    pair = separating_pair(propped)
    if pair is not None:
        i, j = (str(names[gear]) for gear in pair)
        raise _refused(
            f"without {i} and {j} it falls apart",
            "one of its parts can be flipped over about these two, so that no packing is the only one",
            f"add a mesh that joins the parts beside {i} and {j}, or take one part at a time",
        )
    return gears, propped
