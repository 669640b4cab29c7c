"""The working flank of a tooth from its path of contact, as radius and angle about its own axle."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact

_DENSE = 801  # points from which the spacing of the others follows
_FEWEST = 8  # pieces, however straight a flank is
_FINE = 4e-6  # modules: finer than this turning is lost in rounding
_NEAR = 1e-3  # of a flank: points as near as that are one
_STRAIGHT = 1e-9  # modules, or rad: what bends by less is straight


@dataclass(frozen=True, slots=True)
class FlankCurve:
    """A flank from its root end to its tip end, lengths in modules.

    No chord stands out of the true tooth: a flank that bulges is cut along chords, a hollow one along tangents, so that
    teeth which touch without play do not overlap.

    r, angle   radius, and how much wider (rad) the half tooth is than at the pitch circle
    curve      radius and angle of many points of the true flank (2, n)
    tangent    unit vector at the root end towards the root: along the radius, and across it towards the space
    R          pitch radius
    outward    1, or -1 for a ring, whose tips are inside
    """

    r: Floats
    angle: Floats
    curve: Floats
    tangent: tuple[float, float]
    R: float
    outward: int


def flank(path: PathOfContact, gear: int, arcs: tuple[float, float], tolerance: float) -> FlankCurve:
    """The flank of gear 1 or 2 over arcs of approach and recess (X), its chords within `tolerance` (modules).

    A negative arc lets the flank begin beyond the pitch point.
    """
    approach, recess = arcs
    pitch = path.pitch
    ends = (-approach, recess) if gear == 1 else (recess, -approach)
    dense = np.linspace(*ends, _DENSE)
    X = _spaced(path, gear, dense, max(tolerance, _FINE))
    outward = -1 if gear == 2 and pitch.R2 < 0 else 1
    if (np.diff(_polar(path, gear, X)[0]) * outward <= 0).any():
        why = "its radius does not grow from the root to the tip"
        raise RangeError(Problem(f"the flank of gear {gear} turns back", why, "shorten the arcs, or take more teeth"))
    r, angle = _within(path, gear, X, outward)
    along, across = _tangents(path, gear, X[:1], outward)
    tangent = float(along[0]), float(across[0])
    return FlankCurve(r, angle, np.stack(_polar(path, gear, dense)), tangent, abs(_R(path, gear)), outward)


def _R(path: PathOfContact, gear: int) -> float:
    return path.pitch.R1 if gear == 1 else path.pitch.R2


def _polar(path: PathOfContact, gear: int, X: Floats) -> tuple[Floats, Floats]:
    """Radius about the axle, and azimuth from the pitch crossing towards the space."""
    radius, azimuth = path.pitch.polar(gear, path.flank(gear, X))
    return radius, azimuth if gear == 1 else -azimuth


def _spaced(path: PathOfContact, gear: int, X: Floats, tolerance: float) -> Floats:
    """Displacements at which a chord leaves the flank by as much everywhere: ds sqrt(curvature) constant."""
    points = path.flank(gear, X)
    steps = np.diff(points, axis=0)
    length = np.hypot(steps[:, 0], steps[:, 1])
    heading = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    turned = np.abs(np.gradient(heading))
    # a chord of length ds leaves an arc by ds^2 curvature / 8
    cost = np.concatenate(([0.0], np.cumsum(np.sqrt(turned * length / (8 * tolerance)))))
    # a share by length alone keeps straight stretches from having no points
    cost += np.linspace(0, 0.02 * cost[-1] + 1e-9, len(cost))
    count = max(_FEWEST, ceil(1.2 * cost[-1])) + 1
    found = np.interp(np.linspace(0, cost[-1], count), cost, X)
    return _with(found, X[_bends(path, gear, X)])


def _bends(path: PathOfContact, gear: int, X: Floats) -> Floats:
    """Which points are the last before a flank turns from hollow to bulging, or back."""
    points = path.flank(gear, X)
    steps = np.diff(points @ np.array([1, 1j]))
    bent = np.angle(steps[1:] * np.conj(steps[:-1]))
    sense = np.sign(np.where(np.abs(bent) > _STRAIGHT, bent, 0.0))
    bending = np.flatnonzero(sense)
    turns = sense[bending[1:]] != sense[bending[:-1]]
    return np.asarray(bending[:-1][turns] + 1)


def _with(found: Floats, bends: Floats) -> Floats:
    """Displacements with some more among them, those near them left out."""
    if not bends.size:
        return np.asarray(found)
    near = _NEAR * abs(found[-1] - found[0])
    inner = [x for x in found[1:-1].tolist() if np.abs(bends - x).min() > near]
    ends = [b for b in bends.tolist() if min(abs(b - found[0]), abs(b - found[-1])) > near]
    whole = np.unique([found[0], *inner, *ends, found[-1]])
    return whole if found[0] < found[-1] else whole[::-1]


def _within(path: PathOfContact, gear: int, X: Floats, outward: int) -> tuple[Floats, Floats]:
    """Radius and angle of a line that nowhere leaves the tooth: the flank's points, and where tangents meet."""
    r, angle = _polar(path, gear, X)
    points = r * np.exp(1j * angle)
    along, across = _tangents(path, gear, X, outward)
    ways = (along + 1j * across) * np.exp(1j * angle)  # towards the root
    middle, turned = _polar(path, gear, (X[1:] + X[:-1]) / 2)
    chord = points[1:] - points[:-1]
    # how far the middle of a piece lies beside its chord, away from the space
    beside = _cross(chord, middle * np.exp(1j * turned) - points[:-1]) / np.abs(chord) * -outward
    det = _cross(ways[:-1], ways[1:])
    hollow = (beside > _STRAIGHT) & (np.abs(det) > _STRAIGHT)
    if not hollow.any():
        return r, angle
    reach = _cross(chord, ways[1:]) / np.where(hollow, det, 1.0)
    corners = points[:-1] + reach * ways[:-1]
    line = [points[0]]
    for k, bent in enumerate(hollow.tolist()):
        # between two hollow pieces the point of contact lies on the line from corner to corner
        line += [corners[k]] if bent else []
        line += [] if bent and k + 1 < len(hollow) and hollow[k + 1] else [points[k + 1]]
    found = np.array(line)
    return np.abs(found), np.angle(found)


def _cross(a: Floats, b: Floats) -> Floats:
    """Cross product of plane vectors written as complex numbers."""
    return np.asarray((np.conj(a) * b).imag)


def _tangents(path: PathOfContact, gear: int, X: Floats, outward: int) -> tuple[Floats, Floats]:
    """At right angles to the contact normal, which in the fixed frame leans by psi from the pitch line."""
    contact = path.at(X)
    sine, cosine = contact.sin_psi, contact.cos_psi
    x, y = path.pitch.point(contact.d, contact.sin_psi, contact.cos_psi).T
    y = y - path.pitch.axle_of(gear)
    up = 1.0 if (gear == 1 or outward < 0) else -1.0
    lean = np.arctan2(x, y * up)  # of the radius to the contact, from the line of centres towards +x
    # unit vectors along the radius and across it towards +x; the flank runs along (-sine, cosine)
    along = -sine * np.sin(lean) + cosine * up * np.cos(lean)
    beside = (-sine * np.cos(lean) - cosine * up * np.sin(lean)) * (1 if gear == 1 else -1)
    rootward = np.where(along > 0, -outward, outward)
    return rootward * along, rootward * beside
