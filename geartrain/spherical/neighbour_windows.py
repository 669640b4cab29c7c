"""Tooth ratios at which equal gears beside each other on a sphere do not overlap."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi

from geartrain.spherical.configuration import Configuration, mesh_kinds, nearest_unmeshed
from geartrain.spherical.pitch_cones import overlap_limit


@dataclass(frozen=True)
class NeighbourRatioWindow:
    """Range of a tooth ratio in which equal neighbours do not overlap, tips not counted.

    Attributes
    ----------
    a, b : str
        The kinds of gear that mesh.
    low, high : float
        Bounds of z_a / z_b; `inf` where there is none.

    See Also
    --------
    ratio_windows : what gives these.
    """

    a: str
    b: str
    low: float
    high: float

    def __str__(self) -> str:
        return f"{self.low:.9f} < z({self.a})/z({self.b}) < {self.high:.9f}"


def ratio_windows(configuration: Configuration) -> tuple[NeighbourRatioWindow, ...]:
    """For each kind of mesh between unlike gears, the tooth ratios at which equal neighbours do not overlap.

    With several kinds of mesh each window holds for the operating cones of its own mesh.

    Parameters
    ----------
    configuration : Configuration
        The set; its teeth are not asked for.

    Returns
    -------
    tuple of NeighbourRatioWindow
        One a kind of mesh between unlike gears.

    Examples
    --------
    >>> from geartrain.spherical import from_polyhedron
    >>> print(ratio_windows(from_polyhedron("icosidodecahedron"))[0])
    0.794654472 < z(5)/z(3) < 5.330704256
    """
    nearest = nearest_unmeshed(configuration)
    found = []
    for mesh in mesh_kinds(configuration):
        if mesh.a == mesh.b:
            continue
        own, other = (nearest.get((kind, kind), pi) for kind in (mesh.a, mesh.b))
        lift = overlap_limit(mesh.angle, own)
        found.append(NeighbourRatioWindow(mesh.a, mesh.b, overlap_limit(mesh.angle, other), 1 / lift if lift else inf))
    return tuple(found)
