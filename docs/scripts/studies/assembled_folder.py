"""An exported folder as a stranger reads it: trimesh on its files, manifold3d for volumes, and nothing of geartrain.

Surfaces are those of assembly.stl; names and bodies are those of assembly.glb, whose positions are rounded. Fits are
measured on sections across the axes, between the corners of a hole and those of what stands in it.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import shapely
import trimesh

_ROUND = 2e-3  # of a radius: by how much the corners of a circle may differ from it
_LEVEL = 1e-3  # mm: heights that differ by less are one
_NOTHING = 1e-12  # mm3


@dataclass(frozen=True)
class AssembledPart:
    """A part where it stands (mm), and the body it turns with."""

    name: str
    body: str
    mesh: Any

    @cached_property
    def solid(self) -> Any:
        """The part for volumes; empty where its surface is not closed."""
        faces = np.ascontiguousarray(self.mesh.faces, dtype=np.uint64)
        return manifold3d.Manifold(manifold3d.Mesh64(np.ascontiguousarray(self.mesh.vertices, dtype=float), faces))

    @cached_property
    def ends(self) -> tuple[float, float]:
        """Lowest and highest point."""
        return float(self.mesh.bounds[0][2]), float(self.mesh.bounds[1][2])

    def section(self, height: float) -> list[Any]:
        """The lines in which a plane across z cuts it, as polygons without holes."""
        low, high = self.ends
        cut = self.mesh.section((0, 0, 1), (0, 0, height)) if low < height < high else None
        lines = () if cut is None else cut.discrete
        return [shapely.Polygon(line[:, :2]) for line in lines if len(line) > 3]


@dataclass(frozen=True)
class MeasuredFit:
    """A round part in a round hole: their names, diameters (mm), how far (mm) apart their middles are.

    joined   both are of one body
    """

    hole_of: str
    rod_of: str
    hole: float
    rod: float
    aside: float
    joined: bool

    @property
    def clearance(self) -> float:
        """The hole's diameter less that of the rod (mm)."""
        return self.hole - self.rod


@dataclass(frozen=True)
class MeasuredOverlap:
    """Two parts in one place: their common volume (mm3), and as a share of the smaller one."""

    one: str
    other: str
    volume: float
    share: float


def read_parts(folder: Path) -> list[AssembledPart]:
    """All parts of assembly.stl, which follow each other as the nodes of assembly.glb that have a mesh."""
    whole: Any = trimesh.load(folder / "assembly.stl", process=False)
    triangles = whole.triangles
    data = (folder / "assembly.glb").read_bytes()
    content = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    nodes = content["nodes"]
    bodies = {child: node["name"] for node in nodes for child in node.get("children", ())}
    parts, start = [], 0
    for at, node in enumerate(nodes):
        if "mesh" in node:
            (shown,) = content["meshes"][node["mesh"]]["primitives"]
            kinks = content["accessors"][shown["indices"]]["count"]
            own, start = triangles[start : start + kinks // 3], start + kinks // 3
            mesh = trimesh.Trimesh(own.reshape(-1, 3), np.arange(kinks).reshape(-1, 3))
            parts.append(AssembledPart(node["name"], bodies[at], mesh))
    assert start == len(triangles)
    return parts


def find_overlaps(parts: Sequence[AssembledPart]) -> list[MeasuredOverlap]:
    """Every two parts that share some volume, the largest share first."""
    found = []
    for one, other in combinations(parts, 2):
        (low, high), (minimum, most) = one.mesh.bounds, other.mesh.bounds
        if (low < most).all() and (minimum < high).all():
            volume = float((one.solid ^ other.solid).volume())
            if volume > _NOTHING:
                share = volume / min(one.solid.volume(), other.solid.volume())
                found.append(MeasuredOverlap(one.name, other.name, volume, share))
    return sorted(found, key=lambda each: -each.share)


def find_fits(parts: Sequence[AssembledPart]) -> list[MeasuredFit]:
    """Of every hole and what stands next inside it the tightest place."""
    levels = sorted(height for part in parts for height in set(part.mesh.vertices[:, 2].round(4).tolist()))
    found: dict[tuple[str, str], MeasuredFit] = {}
    for low, high in pairwise(levels):
        for fit in _fits_at(parts, (low + high) / 2) if high - low > _LEVEL else ():
            key = fit.hole_of, fit.rod_of
            if key not in found or fit.clearance < found[key].clearance:
                found[key] = fit
    return list(found.values())


def _fits_at(parts: Sequence[AssembledPart], height: float) -> Iterator[MeasuredFit]:
    """In one plane: the largest rod in each hole."""
    rods: list[tuple[AssembledPart, tuple[Any, float]]] = []
    holes: list[tuple[AssembledPart, tuple[Any, float]]] = []
    for part in parts:
        lines = part.section(height)
        for line in lines:
            if (circle := _circle(line)) is not None:
                inside = any(other is not line and other.contains(line) for other in lines)
                (holes if inside else rods).append((part, circle))
    for part, (at, radius) in holes:
        within = [
            (rod, middle, size)
            for rod, (middle, size) in rods
            if rod is not part and np.hypot(*(middle - at)) + size <= radius * (1 + _ROUND)
        ]
        if within:
            rod, middle, size = max(within, key=lambda each: each[2])
            aside = float(np.hypot(*(middle - at)))
            yield MeasuredFit(part.name, rod.name, 2 * radius, 2 * size, aside, part.body == rod.body)


def _circle(line: Any) -> tuple[Any, float] | None:
    """Middle and radius of the corners of a line that is round; None of others."""
    middle = np.array(line.centroid.coords[0])
    kinks = shapely.get_coordinates(line.simplify(1e-6))[:-1]
    radii = np.hypot(*(kinks - middle).T)
    return (middle, float(radii.max())) if len(radii) >= 8 and np.ptp(radii) <= _ROUND * radii.max() else None
