"""Wheels and plates as discs in a stack of parallel axes, and the gaps between their levels."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import dist

Point = tuple[float, float]

EDGE = 1.0  # mm below and above the stack, where it counts as a gap
_SAME = 1e-6  # mm: faces that touch but for rounding do not overlap


@dataclass(frozen=True, slots=True)
class StackDisc:
    """A wheel, or a plate that turns, as what it sweeps; lengths in mm.

    Attributes
    ----------
    name, link, axis : str
        Its name, the link it belongs to and its axis.
    at : tuple of float
        Its axis across the stack.
    low, high : float
        Its faces.
    outer : float
        Of its teeth, or its rim.
    inner : float
        Radius that is free inside: of a ring's teeth; 0 of any other.
    root : float
        Of its teeth.
    hub : bool
        True if it sits on the arbor of its link; a ring does not.
    carrier : tuple of float or None
        The axis about which its own is carried round, if it is.
    apart : bool
        True of an arm that a bar beside the axis joins to its link, round what stands between them.
    """

    name: str
    link: str
    axis: str
    at: Point
    low: float
    high: float
    outer: float
    inner: float = 0.0
    root: float = 0.0
    hub: bool = True
    carrier: Point | None = None
    apart: bool = False

    @property
    def middle(self) -> float:
        """Height of its middle plane."""
        return (self.low + self.high) / 2

    def room_for(self, at: Point, radius: float) -> float:
        """Least gap to a column of some radius that stands still, wherever the disc is carried; below 0: overlap."""
        if self.carrier is None:
            away = dist(at, self.at)
            return max(away - self.outer, self.inner - away if self.inner else -self.outer) - radius
        away, aside = dist(at, self.carrier), dist(self.at, self.carrier)
        inside = self.inner - away - aside if self.inner else aside - self.outer - away
        return max(away - aside - self.outer, inside) - radius


def slabs(discs: Iterable[StackDisc], tied: Sequence[tuple[float, float]] = ()) -> list[tuple[float, float]]:
    """Heights that are taken, from below: discs that overlap make one, and so does all between ends that are tied."""
    found: list[tuple[float, float]] = []
    for low, high in sorted([*((disc.low, disc.high) for disc in discs), *tied]):
        if found and low < found[-1][1] - _SAME:
            found[-1] = found[-1][0], max(high, found[-1][1])
        else:
            found.append((low, high))
    return found


def gaps(taken: Sequence[tuple[float, float]]) -> list[float]:
    """Middle heights of the gaps below, between and above slabs."""
    between = [(below[1] + above[0]) / 2 for below, above in pairwise(taken)]
    return [taken[0][0] - EDGE, *between, taken[-1][1] + EDGE]


def swept_circle(disc: StackDisc) -> tuple[Point, float]:
    """The circle that holds a disc wherever it is carried."""
    if disc.carrier is None:
        return disc.at, disc.outer
    return disc.carrier, dist(disc.carrier, disc.at) + disc.outer


def by_piece(discs: Iterable[StackDisc]) -> Mapping[tuple[str, bool], list[StackDisc]]:
    """Discs of each link, in order; those apart from the rest of it by themselves."""
    found: dict[tuple[str, bool], list[StackDisc]] = {}
    for disc in discs:
        found.setdefault((disc.link, disc.apart), []).append(disc)
    return found
