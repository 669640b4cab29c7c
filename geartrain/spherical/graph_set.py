"""Gears on a sphere from any planar graph of who meshes with whom: circles, whole teeth, then pitch or phases."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from math import degrees, exp
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.plain_data import Key, Result
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
from geartrain.spherical.configuration import Configuration
from geartrain.spherical.gear_sizes import SphereSizing, size_gears
from geartrain.spherical.planar_map import Edges, checked_graph, regions_of, turning_senses, with_region_circles

if TYPE_CHECKING:
    import networkx as nx

    from geartrain.numerics.arrays import Floats, Ints


Aim = Literal["pitch", "phases"]
_EXACT = 1e-11  # pitches: rounding leaves far less
_MOST_CHOICES = 24
"""Roundings of the teeth that are compared by how far their loops are from closing."""


def rounded_teeth(cones: Floats, least: int, upto: int | None = None) -> list[Ints]:
    """Whole teeth nearly in proportion to sin rho (cones in rad), from a scan of the scale, best first.

    The smallest gear gets from `least` to `upto` teeth (`least` only, unless given). Best is the least variance of
    ln(z / sin rho), that is, of the pitch.
    """
    sine = np.sin(cones)
    last = least if upto is None else max(upto, least)
    # teeth change where a scaled sine passes a half: 200 scales a tooth of the smallest gear meet most
    scales = np.linspace(least - 0.5, last + 0.5, 200 * (last - least + 1) + 1) / sine.min()
    found = {tuple(np.round(sine * scale).astype(int).tolist()) for scale in scales}
    fitting = [teeth for teeth in found if least <= min(teeth) <= last]
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
    least_teeth: int = 12,
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
    least_teeth : int
        Of the smallest gear.
    aim : {"pitch", "phases"}
        `pitch`: all meshes share one pitch; `phases`: all loops close. Both at once seldom exist.
    upto : int, optional
        The best rounding is sought for smallest gears from `least_teeth` up to that.
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
    >>> found = from_graph(cube, least_teeth=12)
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
    choices = [_teeth(names, teeth)] if teeth is not None else rounded_teeth(cones, least_teeth, upto)
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

    Attributes
    ----------
    configuration : Configuration
        Axes, meshes and teeth; every gear is a kind of its own.
    aim : {"pitch", "phases"}
        What the axes were moved for.
    packing : SpherePacking
        The circles from which the axes were moved; circles past the gears stood in beside idlers.
    sizing : SphereSizing
        Cones, pitches and pressure angles.
    residue : float
        Largest residue of a loop [pitches].
    moved : array of float, (gears,)
        How far each axis moved from the packing [rad].
    residuals : tuple of float
        What was left after each step of the fit [rad for pitches, pitches for phases].

    See Also
    --------
    from_graph : what gives these.
    """

    KEYS = (
        "aim",
        "exact",
        Key("axes", "axes_by_gear"),
        Key("moved", "greatest_move", degrees),
        "spread",
        "residue",
        Key("sizes", "sizing"),
    )

    configuration: Configuration
    aim: Aim
    packing: SpherePacking
    sizing: SphereSizing
    residue: float
    moved: Floats
    residuals: tuple[float, ...]

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
    def greatest_move(self) -> float:
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
