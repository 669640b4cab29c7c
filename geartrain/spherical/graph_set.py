"""Gears on a sphere from any planar graph of who meshes with whom: circles, whole teeth, then pitch or phases.

The graph is first drawn as a planar map, or the reason is reported why gears on a sphere cannot follow it.
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
from geartrain.spherical.axis_adjustment import (
    AxisAdjustment,
    LoopCorners,
    corners_of,
    fit_phases,
    fit_pitch,
    forecast_spread,
    loop_sums,
)
from geartrain.spherical.circle_packing import SpherePacking, pack_circles
from geartrain.spherical.configuration import Configuration, fundamental_loops
from geartrain.spherical.gear_sizes import SphereSizing, size_gears

if TYPE_CHECKING:
    import networkx as nx

    from geartrain.numerics.arrays import Floats, Ints


# ----------------------------------------------------------------------------------------------------------- planar map


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
        minimum = min(parts, key=len)
        apart = ", ".join(minimum)
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


# ------------------------------------------------------------------------------------------------------------ graph set


Aim = Literal["pitch", "phases"]
_EXACT = 1e-11  # pitches: rounding leaves far less
_MOST_CHOICES = 24
"""Roundings of the teeth that are compared by how far their loops are from closing."""


def rounded_teeth(cones: Floats, minimum: int, upto: int | None = None) -> list[Ints]:
    """Whole teeth nearly in proportion to sin rho (cones in rad), from a scan of the scale, best first.

    The smallest gear gets from `minimum` to `upto` teeth (`minimum` only, unless given). Best is the least variance of
    ln(z / sin rho), that is, of the pitch.
    """
    sine = np.sin(cones)
    last = minimum if upto is None else max(upto, minimum)
    # teeth change where a scaled sine passes a half: 200 scales a tooth of the smallest gear meet most
    scales = np.linspace(minimum - 0.5, last + 0.5, 200 * (last - minimum + 1) + 1) / sine.min()
    found = {tuple(np.round(sine * scale).astype(int).tolist()) for scale in scales}
    fitting = [teeth for teeth in found if minimum <= min(teeth) <= last]
    best = sorted(fitting, key=lambda teeth: (float(np.var(np.log(np.array(teeth) / sine))), teeth))
    return [np.array(teeth, dtype=np.int64) for teeth in best]


def kabsch_aligned(axes: Floats, onto: Floats) -> Floats:
    """The axes after the rotation that brings them nearest to others (W. Kabsch, Acta Cryst. A32 (1976) 922)."""
    U, _, V = np.linalg.svd(axes.T @ onto)
    # the nearest orthogonal matrix may be a reflection: its least singular direction is then turned round
    flip = np.diag([1.0, 1.0, float(np.sign(np.linalg.det(U @ V)))])
    return np.asarray(axes @ U @ flip @ V, dtype=float)


def from_graph(
    graph: nx.Graph[Any] | Edges,
    minimum_teeth: int = 12,
    aim: Aim = "pitch",
    *,
    upto: int | None = None,
    teeth: Mapping[Hashable, int] | None = None,
) -> GraphSet:
    """Gears on a sphere that mesh as a graph says: circle packing, whole teeth, axes moved until pitches or phases fit.

    Circles are packed (Koebe, Andreev and Thurston), teeth rounded to the circles, and the axes moved by as little as
    it takes for what `aim` names to be exact. In a region beside an idler a circle stands in for the meshes it lacks
    while circles are packed.

    Parameters
    ----------
    graph : networkx.Graph, or iterable of pairs
        Who meshes with whom. It must be simple, planar and bipartite, and 3-connected once gears with two meshes
        (idlers) are left out of account.
    minimum_teeth : int
        Of the smallest gear.
    aim : {"pitch", "phases"}
        `pitch`: all meshes share one pitch; `phases`: all loops close. Both at once seldom exist.
    upto : int, optional
        The best rounding is sought for smallest gears from `minimum_teeth` up to that.
    teeth : mapping of gear to int, optional
        Of each gear, in place of rounding.

    Returns
    -------
    GraphSet
        The set, and what of it is exact.

    Raises
    ------
    QuestionError
        If the graph cannot be packed, with what is in the way; or teeth are missing.
    RangeError
        If no packing is found in floats.

    Examples
    --------
    The graph of a cube:

    >>> cube = [(i, i ^ bit) for i in range(8) for bit in (1, 2, 4) if i < i ^ bit]
    >>> found = from_graph(cube, minimum_teeth=12)
    >>> found.exact, set(found.configuration.teeth.values())
    (('pitch', 'phases'), {12})
    """
    if aim not in ("pitch", "phases"):
        raise QuestionError(Problem(f"no aim {aim!r}", "axes can be moved for one of two ends", "pitch or phases"))
    named = checked_graph(graph)
    names = list(named)
    gears, regions, side = len(names), regions_of(named), turning_senses(named, names)
    packing = pack_circles(*with_region_circles(gears, regions, names))
    axes, cones = packing.axes[:gears], packing.cones[:gears]
    meshes = tuple(mesh for mesh in packing.meshes if mesh[1] < gears)
    choices = [_teeth(names, teeth)] if teeth is not None else rounded_teeth(cones, minimum_teeth, upto)
    # round the sphere every tooth is counted once, so the loops of all regions but one imply the last
    largest = max(range(len(regions)), key=lambda at: len(regions[at]))
    corners = corners_of([walk for at, walk in enumerate(regions) if at != largest], side)
    if aim == "pitch":
        z = choices[0]
        fit = fit_pitch(axes, meshes, z, float((np.sin(cones) / z).mean()))
    else:
        z = min(choices[:_MOST_CHOICES], key=lambda z: forecast_spread(axes, meshes, z, corners))
        fit = fit_phases(axes, meshes, z, corners)
    return _answer(names, meshes, z, aim, packing, fit, corners_of(regions, side))


def _answer(
    names: Sequence[Hashable],
    meshes: tuple[tuple[int, int], ...],
    z: Ints,
    aim: Aim,
    packing: SpherePacking,
    fit: AxisAdjustment,
    corners: LoopCorners,
) -> GraphSet:
    labels = tuple(str(name) for name in names)
    axes = kabsch_aligned(fit.axes, packing.axes[: len(names)])
    chosen = dict(zip(labels, z.tolist(), strict=True))
    title = f"{len(names)} gears on a planar graph"
    configuration = Configuration(labels, axes, meshes, labels, (0,) * len(names), chosen, title)
    sums, _ = loop_sums(axes, corners, z.astype(float))
    residue = float(np.abs(sums - np.round(sums)).max(initial=0.0))
    apart = np.linalg.norm(axes - packing.axes[: len(names)], axis=1)
    return GraphSet(
        configuration, aim, packing, size_gears(configuration), residue, 2 * np.arcsin(apart / 2), fit.residuals
    )


def _teeth(names: Sequence[Hashable], teeth: Mapping[Hashable, int]) -> Ints:
    missing = [str(name) for name in names if name not in teeth]
    if missing:
        raise QuestionError(
            Problem(f"no teeth given for {', '.join(missing)}", "teeth= replaces all rounding", "give every gear's")
        )
    return np.array([teeth[name] for name in names], dtype=np.int64)


@dataclass(frozen=True)
class GraphSet(Result):
    """Gears made from a graph, and what of them is exact.

    See Also
    --------
    from_graph : what gives these.
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
    """Axes, meshes and teeth; every gear is a kind of its own."""
    aim: Aim
    """What the axes were moved for."""
    packing: SpherePacking
    """The circles from which the axes were moved; circles past the gears stood in beside idlers."""
    sizing: SphereSizing
    """Cones, pitches and pressure angles."""
    residue: float
    """Largest residue of a loop [pitches]."""
    moved: Floats
    """How far each axis moved from the packing [rad]. Shape (gears,)."""
    residuals: tuple[float, ...]
    """What was left after each step of the fit [rad for pitches, pitches for phases]."""

    def _summary(self) -> str:
        return f"{self.configuration._summary()}, aim {self.aim}, residue {self.residue:.3g} pitches"

    @property
    def exact(self) -> tuple[str, ...]:
        """What holds to rounding: "pitch", "phases", both or neither."""
        found = {"pitch": self.sizing.exact, "phases": self.residue < _EXACT}
        return tuple(name for name, holds in found.items() if holds)

    @property
    def spread(self) -> float:
        """How much the greatest pitch exceeds the least, in percent."""
        return 100 * (exp(self.sizing.mismatch) - 1)

    @property
    def axes_by_gear(self) -> dict[str, list[float]]:
        """Unit vectors of the axes by gear."""
        return dict(zip(self.configuration.names, self.configuration.axes.tolist(), strict=True))

    @property
    def maximum_move(self) -> float:
        """How far an axis was moved at most (rad)."""
        return float(self.moved.max())

    def __str__(self) -> str:
        known = self.sizing.pressure[~np.isnan(self.sizing.pressure)]
        angles = f"{degrees(known.min()):.2f} to {degrees(known.max()):.2f} deg" if known.size else "none"
        lines = [
            f"{self.configuration.title}, {len(self.configuration.meshes)} meshes: exact "
            f"{' and '.join(self.exact) or 'in neither pitch nor phases'}",
            f"  axes moved by up to {degrees(float(self.moved.max())):.4f} deg",
            f"  pitch spread {self.spread:.3g} %, pressure angles {angles}",
            f"  loops miss by up to {self.residue:.3g} pitches",
        ]
        if known.size < len(self.sizing.pressure):
            lines.append(f"  {len(self.sizing.pressure) - known.size} meshes are too close for the common base pitch")
        if self.aim not in self.exact:
            lines.append(f"  no axes near the packing make the {self.aim} exact; more teeth, or others, may")
        if self.sizing.collisions:
            lines.append(f"  {len(self.sizing.collisions)} pairs collide, worst {self.sizing.collisions[0]}")
        return "\n".join(lines)
