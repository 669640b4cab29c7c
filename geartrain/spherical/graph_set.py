"""Gears on a sphere from a planar graph of meshing gears, by circle packing, with integer tooth numbers, and with equal
pitches or closed loops.

The graph is first embedded as a planar map. A graph that cannot be realised by gears on a sphere is rejected with the
reason.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import degrees, exp
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Key, Result
from geartrain.spherical.axis_adjustment import corners_of, fit_phases, fit_pitch, forecast_spread, loop_sums
from geartrain.spherical.circle_packing import SpherePacking, pack_circles
from geartrain.spherical.configuration import Configuration, require_tooth_numbers
from geartrain.spherical.gear_sizes import SphereSizing, size_gears

if TYPE_CHECKING:
    import networkx as nx

    from geartrain.numerics.arrays import Floats, Ints


# ----------------------------------------------------------------------------------------------------------- planar map


Edges = Iterable[tuple[Hashable, Hashable]]


def separating_pair(regions: Sequence[Sequence[int]]) -> tuple[int, int] | None:
    """Return two gears whose removal disconnects a 2-connected planar map; None if the map is 3-connected: two regions
    then have in common no gear, one gear, or the two gears of one mesh.
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
    """Return the graph if it is simple, bipartite and 2-connected; raise `QuestionError` with the reason otherwise."""
    import networkx as nx

    given = graph if isinstance(graph, nx.Graph) else None
    pairs = list(graph if given is None else given.edges())
    _check_simple(pairs, both_ways=isinstance(given, nx.DiGraph))
    loose = [] if given is None else [str(node) for node, degree in given.degree() if not degree]
    if loose:
        raise _refused(f"{', '.join(loose)} mesh with no other gear", "meshes determine the axes", "remove these gears")
    found: nx.Graph[Any] = nx.Graph(pairs)
    if found.number_of_nodes() < 4:
        why = "a circle packing needs a loop of four or more gears"
        raise _refused(f"it has {found.number_of_nodes()} gears", why, "add gears until loops close")
    _check_bipartite(found)
    _check_connected(found)
    return found


def _check_simple(pairs: Sequence[tuple[Hashable, Hashable]], both_ways: bool) -> None:
    """Raise `QuestionError` if a gear meshes with itself, or if a mesh is listed twice. If `both_ways`, opposite edges
    are regarded as one mesh, as in a directed graph.
    """
    alone = [str(i) for i, j in pairs if i == j]
    if alone:
        raise _refused(f"{alone[0]} meshes with itself", "a mesh connects two different gears", "remove this mesh")
    # a mesh is undirected
    counted = Counter(frozenset(pair) for pair in pairs)
    twice = [pair for pair, count in counted.items() if count > (2 if both_ways else 1)]
    if twice:
        names = " and ".join(sorted(map(str, twice[0])))
        raise _refused(f"{names} mesh twice", "two gears on a sphere touch at one point", "list each mesh once")


def _check_connected(found: nx.Graph[Any]) -> None:
    """Raise `QuestionError` if the graph is disconnected or has an articulation point."""
    import networkx as nx

    parts = [sorted(map(str, part)) for part in nx.connected_components(found)]
    if len(parts) > 1:
        minimum = min(parts, key=len)
        what = f"{', '.join(minimum)} are not connected to the other gears"
        raise _refused(what, "meshes determine the axes", "pack one connected part at a time")
    cut = next(iter(nx.articulation_points(found)), None)
    if cut is None:
        return
    ends = ", ".join(sorted(str(node) for node, degree in found.degree() if degree == 1))
    fix = f"remove {ends}, or add a second mesh to each" if ends else f"add a mesh that bypasses {cut}"
    raise _refused(f"only {cut} connects two parts", "the parts can turn about it, so the packing is not unique", fix)


def _check_bipartite(found: nx.Graph[Any]) -> None:
    """Raise `QuestionError` if a mesh connects two gears at equal distances from a third in the graph (odd loop)."""
    import networkx as nx

    paths: dict[Any, list[Any]] = {}
    for part in nx.connected_components(found):
        paths |= nx.single_source_shortest_path(found, min(part, key=str))
    odd = [(paths[i], paths[j]) for i, j in found.edges() if len(paths[i]) == len(paths[j])]
    if odd:
        first, second = min(odd, key=lambda ways: len(set(ways[0]) - set(ways[1])))
        shared = sum(one == other for one, other in zip(first, second, strict=True))
        walk = " - ".join(map(str, [*first[shared - 1 :], *second[: shared - 1 : -1]]))
        raise _refused(
            f"loop {walk} has an odd number of gears",
            "meshing gears turn in opposite senses, so an odd loop locks",
            "remove one mesh of the loop",
        )


def _refused(what: str, why: str, fix: str) -> QuestionError:
    return QuestionError(Problem(f"the graph cannot be packed: {what}", why, fix))


def regions_of(found: nx.Graph[Any]) -> list[list[int]]:
    """Return the regions of a planar embedding as closed walks of gears; raise `QuestionError` if none exists."""
    import networkx as nx

    drawn: Any
    planar, drawn = nx.check_planarity(found, counterexample=True)
    if not planar:
        # branch vertices of a subdivided K5 or K3,3
        corners = sorted((str(node) for node, degree in drawn.degree() if degree > 2))
        why = "each of these gears is connected to every other one"
        if len(corners) == 6:
            why = "each of three of these gears is connected to each of the other three"
        why += ", by meshes or disjoint chains of gears (Kuratowski)"
        raise _refused(f"it is not planar: {', '.join(corners)}", why, "remove a mesh of these chains")
    at = {name: k for k, name in enumerate(found)}
    seen: set[tuple[Hashable, Hashable]] = set()
    return [[at[node] for node in drawn.traverse_face(*e, seen)] for e in drawn.edges() if e not in seen]


def with_region_circles(
    gears: int, regions: Sequence[Sequence[int]], names: Sequence[Hashable]
) -> tuple[int, list[tuple[int, ...]]]:
    """Return the map with a circle tangent to the surrounding gears in every region next to an idler. Raises
    `QuestionError` if the resulting map is not 3-connected.
    """
    meshes = Counter(gear for walk in regions for gear in walk)
    completed: list[tuple[int, ...]] = []
    for walk in regions:
        # an idler has only two meshes, too few for a 3-connected map
        if any(meshes[gear] == 2 for gear in walk):
            completed += [(walk[k - 1], gear, gears) for k, gear in enumerate(walk)]
            gears += 1
        else:
            completed.append(tuple(walk))
    pair = separating_pair(completed)
    if pair is not None:
        i, j = (str(names[gear]) for gear in pair)
        raise _refused(
            f"without {i} and {j} it is not connected",
            "a part can be reflected about these two gears, so the packing is not unique",
            f"add a mesh that connects the parts other than {i} and {j}, or pack one part at a time",
        )
    return gears, completed


# ------------------------------------------------------------------------------------------------------------ graph set


Aim = Literal["pitch", "phases"]
_EXACT = 1e-11  # pitches; rounding leaves about 1e-15
_MOST_CHOICES = 24
"""Maximum number of rounded sets of tooth numbers whose closing errors are compared with each other."""


def rounded_teeth(cones: Floats, minimum: int, upto: int | None = None) -> list[Ints]:
    """Return sets of integer tooth numbers that are nearly proportional to the sines of the half-angles `cones` [rad],
    sorted by ascending variance of the pitch.

    The scale is varied so that the smallest gear has from `minimum` to `upto` teeth (by default only `minimum`). The
    variance is that of ln(z / sin rho), with tooth number z and half-angle rho.
    """
    sine = np.sin(cones)
    last = minimum if upto is None else max(upto, minimum)
    # teeth change where a scaled sine passes a half: 200 scales per tooth of the smallest gear find most roundings
    scales = np.linspace(minimum - 0.5, last + 0.5, 200 * (last - minimum + 1) + 1) / sine.min()
    found = {tuple(np.round(sine * scale).astype(int).tolist()) for scale in scales}
    fitting = [teeth for teeth in found if minimum <= min(teeth) <= last]
    best = sorted(fitting, key=lambda teeth: (float(np.var(np.log(np.array(teeth) / sine))), teeth))
    return [np.array(teeth, dtype=np.int64) for teeth in best]


def from_graph(
    graph: nx.Graph[Any] | Edges,
    minimum_teeth: int = 12,
    aim: Aim = "pitch",
    *,
    upto: int | None = None,
    teeth: Mapping[Hashable, int] | None = None,
) -> GraphSet:
    """Return a set of gears on a sphere whose meshes are the edges of a graph, with equal pitches or with loops that
    close exactly.

    The algorithm computes a circle packing of the graph (Koebe, Andreev and Thurston), rounds tooth numbers that are
    proportional to the sizes of the circles, and moves the axes as little as possible until the condition named by
    `aim` is satisfied exactly. In the packing, the idlers have additional meshes with a circle in each adjacent region.

    Parameters
    ----------
    graph : networkx.Graph, or iterable of pairs
        Graph of the meshes. It must be simple, planar and bipartite, and 3-connected except for gears with two meshes
        (idlers).
    minimum_teeth : int
        Tooth number of the smallest gear.
    aim : {"pitch", "phases"}
        `pitch`: all meshes have the same pitch. `phases`: all loops close. Both conditions can rarely be satisfied
        together.
    upto : int, optional
        Maximum tooth number of the smallest gear. The best rounding with `minimum_teeth` to `upto` teeth on the
        smallest gear is used.
    teeth : mapping of gear to int, optional
        Tooth number of each gear; by default tooth numbers are obtained by rounding.

    Returns
    -------
    GraphSet
        Set of gears, with the residuals of its pitches and loops.

    Raises
    ------
    QuestionError
        If the graph has no packing (the message states the reason), or if tooth numbers are missing.
    RangeError
        If the packing does not converge in double precision.

    Examples
    --------
    Gears on the vertices of a cube mesh along its edges:

    >>> cube = [(i, i ^ bit) for i in range(8) for bit in (1, 2, 4) if i < i ^ bit]
    >>> found = from_graph(cube, minimum_teeth=12)
    >>> found.exact, set(found.configuration.teeth.values())
    (('pitch', 'phases'), {12})
    """
    import networkx as nx

    if aim not in ("pitch", "phases"):
        what, why = f"unknown aim {aim!r}", "`aim` names the condition that all meshes or loops must satisfy"
        raise QuestionError(Problem(what, why, "pass aim='pitch' or aim='phases'"))
    named = checked_graph(graph)
    names = list(named)
    gears, regions = len(names), regions_of(named)
    # meshing gears turn in opposite senses, so a two-colouring gives the senses
    colours = nx.bipartite.color(named)
    side = np.array([1 if colours[name] else -1 for name in names], dtype=np.int64)
    packing = pack_circles(*with_region_circles(gears, regions, names))
    axes, cones = packing.axes[:gears], packing.cones[:gears]
    meshes = tuple(mesh for mesh in packing.meshes if mesh[1] < gears)
    if teeth is not None:
        require_tooth_numbers(names, teeth, "if `teeth` is given, no tooth numbers are derived from the circle packing")
        choices = [np.array([teeth[name] for name in names], dtype=np.int64)]
    else:
        choices = rounded_teeth(cones, minimum_teeth, upto)
    # over the whole sphere every tooth is counted once, so the loops of all regions but one imply the last
    largest = max(range(len(regions)), key=lambda at: len(regions[at]))
    corners = corners_of([walk for at, walk in enumerate(regions) if at != largest], side)
    if aim == "pitch":
        z = choices[0]
        fitted, residuals = fit_pitch(axes, meshes, z)
    else:
        # the rounding whose pitches remain most uniform when loops are closed
        z = min(choices[:_MOST_CHOICES], key=lambda z: forecast_spread(axes, meshes, z, corners))
        fitted, residuals = fit_phases(axes, meshes, z, corners)
    # a common rotation is removed, so that displacements are meaningful (Kabsch's algorithm)
    from scipy.spatial.transform import Rotation

    placed = Rotation.align_vectors(axes, fitted)[0].apply(fitted)
    labels = tuple(str(name) for name in names)
    chosen = dict(zip(labels, z.tolist(), strict=True))
    title = f"{gears} gears on a planar graph"
    configuration = Configuration(labels, placed, meshes, labels, (0,) * gears, chosen, title)
    sums, _ = loop_sums(placed, corners_of(regions, side), z.astype(float))
    residue = float(np.abs(sums - np.round(sums)).max(initial=0.0))
    moved = 2 * np.arcsin(np.linalg.norm(placed - axes, axis=1) / 2)
    return GraphSet(configuration, aim, packing, size_gears(configuration), residue, moved, tuple(residuals))


@dataclass(frozen=True)
class GraphSet(Result):
    """Set of gears constructed from a graph, with the residuals of its pitches and loops.

    See Also
    --------
    from_graph : function that returns it
    """

    KEYS = (
        "aim",
        "exact",
        Key("axes", "axes_by_gear"),
        Key("moved", "maximum_move", degrees),
        "spread",
        "residue",
        Key("sizes", "sizing"),
    )

    configuration: Configuration
    """Axes, meshes and tooth numbers of the set. Every gear has its own kind."""
    aim: Aim
    """Condition that the adjusted axes satisfy exactly: "pitch" or "phases"."""
    packing: SpherePacking
    """Circle packing before the adjustment of the axes. Additional circles next to idlers are after the gears."""
    sizing: SphereSizing
    """Pitch cones, pitches and pressure angles of the gears."""
    residue: float
    """Maximum closing error of the loops [pitch]."""
    moved: Floats
    """Angle by which each axis was moved from its direction in the packing [rad], shape (gears,)."""
    residuals: tuple[float, ...]
    """Residual after each step of the adjustment: maximum deviation of the logarithm of a pitch from its mean for
    "pitch" [1], or maximum closing error for "phases" [pitch].
    """

    def _summary(self) -> str:
        return f"{self.configuration._summary()}, aim {self.aim}, residue {self.residue:.3g} pitches"

    @property
    def exact(self) -> tuple[str, ...]:
        """Conditions that are satisfied within rounding errors: "pitch", "phases", both, or neither."""
        found = {"pitch": self.sizing.exact, "phases": self.residue < _EXACT}
        return tuple(name for name, holds in found.items() if holds)

    @property
    def spread(self) -> float:
        """Maximum pitch divided by minimum pitch, minus 1 [%]."""
        return 100 * (exp(self.sizing.mismatch) - 1)

    @property
    def axes_by_gear(self) -> dict[str, list[float]]:
        """Unit vector of the axis of each gear, by name."""
        return dict(zip(self.configuration.names, self.configuration.axes.tolist(), strict=True))

    @property
    def maximum_move(self) -> float:
        """Maximum angle by which an axis was moved [rad]."""
        return float(self.moved.max())

    def __str__(self) -> str:
        known = self.sizing.pressure[~np.isnan(self.sizing.pressure)]
        angles = f"{degrees(known.min()):.2f} to {degrees(known.max()):.2f} deg" if known.size else "none"
        lines = [
            f"{self.configuration.title}, {len(self.configuration.meshes)} meshes: exact "
            f"{' and '.join(self.exact) or 'in neither pitch nor phases'}",
            f"  axes moved by up to {degrees(float(self.moved.max())):.4f} deg",
            f"  pitch spread {self.spread:.3g} %, pressure angles {angles}",
            f"  maximum closing error of a loop {self.residue:.3g} pitches",
        ]
        if known.size < len(self.sizing.pressure):
            lines.append(f"  {len(self.sizing.pressure) - known.size} meshes have a pitch below the common base pitch")
        if self.aim not in self.exact:
            lines.append(f"  no axes near the packing make the {self.aim} exact; try more or other teeth")
        if self.sizing.collisions:
            lines.append(f"  {len(self.sizing.collisions)} pairs collide, worst {self.sizing.collisions[0]}")
        return "\n".join(lines)
