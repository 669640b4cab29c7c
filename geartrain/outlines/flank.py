"""The working flank of a tooth from its path of contact, as radius and angle about its own axle."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, ceil, cos, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError

if TYPE_CHECKING:
    from geartrain.conjugate.path import Path
    from geartrain.outlines.contour import Floats

_DENSE = 801  # points from which the spacing of the others follows
_FEWEST = 8
_FINE = 4e-6  # modules: finer than this turning is lost in rounding


@dataclass(frozen=True, slots=True)
class Flank:
    """A flank from its root end to its tip end, lengths in modules.

    r, angle   radius, and how much wider (rad) the half tooth is than at the pitch circle
    tangent    unit vector at the root end towards the root: along the radius, and across it towards the space
    R          pitch radius
    outward    1, or -1 for a ring, whose tips are inside
    """

    r: Floats
    angle: Floats
    tangent: tuple[float, float]
    R: float
    outward: int


def flank(path: Path, gear: int, arcs: tuple[float, float], tolerance: float) -> Flank:
    """The flank of gear 1 or 2 over arcs of approach and recess (X), its chords within `tolerance` (modules).

    A negative arc lets the flank begin beyond the pitch point.
    """
    approach, recess = arcs
    pitch = path.pitch
    ends = (-approach, recess) if gear == 1 else (recess, -approach)
    X = _spaced(path, gear, np.linspace(*ends, _DENSE), max(tolerance, _FINE))
    r, angle = _polar(path, gear, X)
    outward = -1 if gear == 2 and pitch.R2 < 0 else 1
    if (np.diff(r) * outward <= 0).any():
        why = "its radius does not grow from the root to the tip"
        raise RangeError(Problem(f"the flank of gear {gear} turns back", why, "shorten the arcs, or take more teeth"))
    return Flank(r, angle, _tangent(path, gear, ends[0], outward), abs(_R(path, gear)), outward)


def _R(path: Path, gear: int) -> float:
    return path.pitch.R1 if gear == 1 else path.pitch.R2


def _polar(path: Path, gear: int, X: Floats) -> tuple[Floats, Floats]:
    """Radius about the axle, and azimuth from the pitch crossing towards the space."""
    points = (path.flank1 if gear == 1 else path.flank2)(X)
    centre = -path.pitch.R1 if gear == 1 else path.pitch.R2
    up = 1.0 if centre < 0 else -1.0
    azimuth = np.arctan2(points[:, 0], (points[:, 1] - centre) * up)
    return np.hypot(points[:, 0], points[:, 1] - centre), azimuth if gear == 1 else -azimuth


def _spaced(path: Path, gear: int, X: Floats, tolerance: float) -> Floats:
    """Displacements at which a chord leaves the flank by as much everywhere: ds sqrt(curvature) constant."""
    points = (path.flank1 if gear == 1 else path.flank2)(X)
    steps = np.diff(points, axis=0)
    length = np.hypot(steps[:, 0], steps[:, 1])
    heading = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    turned = np.abs(np.gradient(heading))
    cost = np.concatenate(([0.0], np.cumsum(np.sqrt(turned * length / (8 * tolerance)))))
    # a share by length alone keeps straight stretches from having no points
    cost += np.linspace(0, 0.02 * cost[-1] + 1e-9, len(cost))
    count = max(_FEWEST, ceil(1.2 * cost[-1])) + 1
    return np.asarray(np.interp(np.linspace(0, cost[-1], count), cost, X))


def _tangent(path: Path, gear: int, X: float, outward: int) -> tuple[float, float]:
    """At right angles to the contact normal, which in the fixed frame leans by psi from the pitch line."""
    contact = path.at(np.array([X]))
    sine, cosine = float(contact.sin_psi[0]), float(contact.cos_psi[0])
    point = path.pitch.point(contact.d, contact.sin_psi, contact.cos_psi)[0]
    y = point[1] - (-path.pitch.R1 if gear == 1 else path.pitch.R2)
    up = 1.0 if (gear == 1 or outward < 0) else -1.0
    lean = atan2(point[0], y * up)  # of the radius to the contact, from the line of centres towards +x
    # unit vectors along the radius and across it towards +x; the flank runs along (-sine, cosine)
    radial = (sin(lean), up * cos(lean))
    across = (cos(lean), -up * sin(lean))
    run = (-sine, cosine)
    along = run[0] * radial[0] + run[1] * radial[1]
    beside = (run[0] * across[0] + run[1] * across[1]) * (1 if gear == 1 else -1)
    rootward = -outward if along > 0 else outward
    return rootward * along, rootward * beside
