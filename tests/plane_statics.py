"""Statics of a plane mechanism at one instant: rigid bodies, hinges, flanks in contact, Coulomb friction.

Every body has three equations of balance (two of forces, one of moments about the origin), every hinge has two unknown
forces, and every contact has one, along its normal with the corresponding friction. Speeds follow from the same bodies:
both bodies of a hinge have the same velocity at its point, and both bodies of a contact the same velocity along its
normal. No ratio, efficiency or power is used, so this module is an independent reference for torques at one position.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin

import numpy as np

FRAME = "frame"
Vector = tuple[float, float]


@dataclass(frozen=True)
class Hinge:
    """The body `inner` turns in `outer` about a point; `friction` is the torque of the bearing [N m]."""

    outer: str
    inner: str
    point: Vector
    friction: float = 0.0


@dataclass(frozen=True)
class Touch:
    """A flank of `first` that can press on `second` at a point, along `normal` (unit vector out of the first body).

    `through` is another point on the line of the force, for a pair of which only the efficiency is known. Its two
    values apply if the first or the second wheel drives in the frame of the carrier.
    """

    first: str
    second: str
    point: Vector
    normal: Vector
    friction: float = 0.0
    through: tuple[Vector, Vector] | None = None
    bearer: str = FRAME


@dataclass(frozen=True)
class Balance:
    """Torques in equilibrium: of the solved body and the held bodies [N m], normal forces [N], and lost power [W].

    `lost` lists contacts, then hinges; `put_in` is the power of all external torques.
    """

    torque: float
    held: tuple[float, ...]
    forces: tuple[float, ...]
    flanks: tuple[int, ...]
    lost: tuple[float, ...]
    put_in: float


def flanks(first: str, second: str, point: Vector, normal: Vector, friction: float) -> tuple[Touch, Touch]:
    """Return both sides of a pin in a slot, one of which is in contact."""
    return (
        Touch(first, second, point, normal, friction),
        Touch(first, second, point, (-normal[0], -normal[1]), friction),
    )


def toothed(
    first: str,
    second: str,
    centres: tuple[Vector, Vector],
    radii: tuple[float, float],
    efficiencies: tuple[float, float],
    bearer: str = FRAME,
) -> tuple[Touch, Touch]:
    """Return the contact of two pitch circles with basic efficiencies for either wheel driving; a ring has a negative
    radius.

    The force of a pair that loses power does not pass through the pitch point: its moment arms are in the ratio of the
    torques, which determines its intersection with the line of centres.
    """
    (x, y), (X, Y) = centres
    distance = hypot(X - x, Y - y)
    along = ((X - x) / distance, (Y - y) / distance)
    share = -radii[1] / radii[0]  # (distance from the second axis) : (from the first), signed

    def place(ratio: float) -> Vector:
        far = distance / (1 - ratio)
        return x + far * along[0], y + far * along[1]

    through = place(share * efficiencies[0]), place(share / efficiencies[1])
    pressure = pi / 9
    found = []
    for side in (1, -1):
        angle = atan2(along[1], along[0]) + side * (pi / 2 - pressure)
        found.append(Touch(first, second, place(share), (cos(angle), sin(angle)), 0.0, through, bearer))
    return found[0], found[1]


@dataclass(frozen=True)
class Mechanism:
    """Bodies at one instant. `joints` contains, for each pair, the flanks that may press, usually two."""

    hinges: Sequence[Hinge]
    joints: Sequence[tuple[Touch, ...]]

    @property
    def bodies(self) -> list[str]:
        """All bodies except the frame."""
        names = dict.fromkeys(name for hinge in self.hinges for name in (hinge.outer, hinge.inner))
        return [name for name in names if name != FRAME]

    def motion(self, driven: Mapping[str, float], used: Sequence[int] | None = None) -> dict[str, Vector3]:
        """Return the velocity at the origin and the angular velocity of each body, from some angular velocities."""
        used = used or [0] * len(self.joints)
        names = self.bodies
        at = {name: 3 * place for place, name in enumerate(names)}
        rows, values = [], []
        for hinge in self.hinges:
            for normal in ((1.0, 0.0), (0.0, 1.0)):
                rows.append(self._row(at, hinge.outer, hinge.inner, hinge.point, normal))
                values.append(0.0)
        for pair, side in zip(self.joints, used, strict=True):
            touch = pair[side]
            rows.append(self._row(at, touch.first, touch.second, touch.point, touch.normal))
            values.append(0.0)
        for name, speed in driven.items():
            row = np.zeros(3 * len(names))
            row[at[name] + 2] = 1.0
            rows.append(row)
            values.append(speed)
        found = np.linalg.solve(np.array(rows), np.array(values))
        speeds = {name: (found[k], found[k + 1], found[k + 2]) for name, k in at.items()}
        return {FRAME: (0.0, 0.0, 0.0), **speeds}

    def balances(
        self, motions: Mapping[str, float], loads: Mapping[str, float], requested: str, held: Sequence[str] = ()
    ) -> list[Balance]:
        """Return all equilibria of the bodies for this motion, with the torque of one body unknown.

        `held` are further bodies whose motion is maintained by external torques of any magnitude.
        """
        found = []
        for used in itertools.product(*(range(len(pair)) for pair in self.joints)):
            motion = self.motion(motions, used)
            for ways in itertools.product(*(self._directions(self.joints[k][side]) for k, side in enumerate(used))):
                balance = self._balance(used, ways, motion, loads, requested, held)
                if balance is not None and not any(_same(balance, other) for other in found):
                    found.append(balance)
        return found

    @staticmethod
    def _directions(touch: Touch) -> tuple[int, ...]:
        return (0,) if touch.through is None else (0, 1)

    def _balance(
        self,
        used: tuple[int, ...],
        ways: tuple[int, ...],
        motion: Mapping[str, Vector3],
        loads: Mapping[str, float],
        requested: str,
        held: Sequence[str],
    ) -> Balance | None:
        names = self.bodies
        at = {name: 3 * place for place, name in enumerate(names)}
        columns, known = [], np.zeros(3 * len(names))
        for hinge in self.hinges:
            for force in ((1.0, 0.0), (0.0, 1.0)):
                columns.append(self._row(at, hinge.outer, hinge.inner, hinge.point, force))
            rubs = -hinge.friction * np.sign(_relative_turning(motion, hinge))
            for name, torque in ((hinge.inner, rubs), (hinge.outer, -rubs)):
                if name != FRAME:
                    known[at[name] + 2] += torque
        touches = [pair[side] for pair, side in zip(self.joints, used, strict=True)]
        for touch, way in zip(touches, ways, strict=True):
            point, force = self._force(touch, way, motion)
            columns.append(self._row(at, touch.first, touch.second, point, force))
        for name in (requested, *held):
            column = np.zeros(3 * len(names))
            column[at[name] + 2] = 1.0
            columns.append(column)
        for name, torque in loads.items():
            known[at[name] + 2] += torque
        solved = np.linalg.solve(np.array(columns).T, -known)
        start = 2 * len(self.hinges)
        pressing = solved[start : start + len(touches)]
        scale = 1e-11 * (np.abs(pressing).max(initial=0.0) + 1e-300)
        if any(force < -scale for force in pressing):
            return None
        lost = []
        for touch, way, normal_force in zip(touches, ways, pressing, strict=True):
            point, force = self._force(touch, way, motion)
            first, second = (_velocity(motion[name], point) for name in (touch.first, touch.second))
            work = normal_force * ((first[0] - second[0]) * force[0] + (first[1] - second[1]) * force[1])
            if touch.through is not None and normal_force * self._drives(touch, motion) * (1, -1)[way] < -scale:
                return None
            lost.append(float(work))
        for hinge in self.hinges:
            lost.append(abs(hinge.friction * _relative_turning(motion, hinge)))
        torque, *others = map(float, solved[start + len(touches) :])
        acting = [*loads.items(), *zip((requested, *held), (torque, *others), strict=True)]
        put_in = sum(acts * motion[name][2] for name, acts in acting)
        return Balance(torque, tuple(others), tuple(map(float, pressing)), used, tuple(lost), put_in)

    @staticmethod
    def _drives(touch: Touch, motion: Mapping[str, Vector3]) -> float:
        """Return the speed of the first flank along its normal relative to the carrier: positive if it pushes."""
        seen, bearer = (_velocity(motion[name], touch.point) for name in (touch.first, touch.bearer))
        return (seen[0] - bearer[0]) * touch.normal[0] + (seen[1] - bearer[1]) * touch.normal[1]

    @staticmethod
    def _force(touch: Touch, way: int, motion: Mapping[str, Vector3]) -> tuple[Vector, Vector]:
        """Return a point of the force on the second body, and this force per unit of normal force."""
        if touch.through is not None:
            return touch.through[way], touch.normal
        along = (-touch.normal[1], touch.normal[0])
        first, second = (_velocity(motion[name], touch.point) for name in (touch.first, touch.second))
        slides = (second[0] - first[0]) * along[0] + (second[1] - first[1]) * along[1]
        rubs = -touch.friction * np.sign(slides)
        return touch.point, (touch.normal[0] + rubs * along[0], touch.normal[1] + rubs * along[1])

    @staticmethod
    def _row(at: Mapping[str, int], first: str, second: str, point: Vector, force: Vector) -> np.ndarray:
        """Return force and moment on the second body, the reaction on the first, and their speed along the force."""
        row = np.zeros(3 * len(at))
        moment = point[0] * force[1] - point[1] * force[0]
        for name, sign in ((second, 1.0), (first, -1.0)):
            if name != FRAME:
                row[at[name] : at[name] + 3] += sign * np.array([force[0], force[1], moment])
        return row


Vector3 = tuple[float, float, float]


def _relative_turning(motion: Mapping[str, Vector3], hinge: Hinge) -> float:
    return motion[hinge.inner][2] - motion[hinge.outer][2]


def _velocity(twist: Vector3, point: Vector) -> Vector:
    return twist[0] - twist[2] * point[1], twist[1] + twist[2] * point[0]


def _same(one: Balance, other: Balance) -> bool:
    scale = max(map(abs, (one.torque, other.torque, *one.forces, *other.forces)))
    return abs(one.torque - other.torque) <= 1e-9 * scale and np.allclose(one.lost, other.lost, 1e-9, 1e-9 * scale)
