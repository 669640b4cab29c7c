"""Graphs in families that grow: hulls, zonohedra, trapezohedra."""

from __future__ import annotations

import numpy as np

Edges = list[tuple[str, str]]


def graph(family: str, given: int) -> Edges:
    """Who meshes with whom, in a graph of a family; see `hull`, `zonohedron` and `trapezohedron`."""
    return {"hull": hull, "zonohedron": zonohedron, "trapezohedron": trapezohedron}[family](given)


def hull(points: int) -> Edges:
    """Gears on all vertices and faces of the convex hull of random points on the sphere: 3 points - 4 gears."""
    from scipy.spatial import ConvexHull

    cloud = np.random.default_rng(points).normal(size=(points, 3))
    found = ConvexHull(cloud / np.linalg.norm(cloud, axis=1)[:, None])
    return [(f"v{vertex}", f"f{at}") for at, face in enumerate(found.simplices) for vertex in face]


def zonohedron(zones: int) -> Edges:
    """Gears on the vertices of a zonohedron with random directions: zones (zones - 1) + 2; all regions have four."""
    way = np.random.default_rng(zones).normal(size=(zones, 3))
    names: dict[tuple[int, ...], str] = {}
    edges: dict[tuple[str, str], None] = {}
    for i, j in zip(*np.triu_indices(zones, 1), strict=True):
        side = np.sign(way @ np.cross(way[i], way[j])).astype(int)
        for face in (side, -side):
            kinks = []
            for face[i], face[j] in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
                kinks.append(names.setdefault(tuple(face.tolist()), f"v{len(names)}"))
            for k in range(4):
                a, b = sorted((kinks[k - 1], kinks[k]))
                edges[a, b] = None
    return list(edges)


def trapezohedron(sides: int) -> Edges:
    """Gears on the vertices of a trapezohedron: two poles, and 2 sides small ones between; all regions have four."""
    edges = []
    for k in range(sides):
        edges += [("north", f"u{k}"), ("south", f"l{k}"), (f"u{k}", f"l{k}"), (f"l{k}", f"u{(k + 1) % sides}")]
    return edges
