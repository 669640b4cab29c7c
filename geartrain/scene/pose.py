"""Poses of the bodies of a scene after a number of turns of the driving link."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from graphlib import TopologicalSorter
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.exact import read_fraction
from geartrain.scene.movement import ErrorStep, ErrorTable
from geartrain.scene.train_scene import Scene

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_ROUNDS, _CONVERGED = 500, 1e-14  # maximum number of fixed-point iterations, and tolerance (rad)


@dataclass(frozen=True, slots=True)
class ScenePose:
    """Pose of a scene: angles and rigid motions of the bodies. A point p of the zero pose moves to turned p + moved."""

    angles: Floats
    """Angles of the bodies about their directions [rad], modulo one turn; 2 pi times the travel in mm for slides."""
    turned: Floats
    """Rotation matrices of the bodies. Shape (bodies, 3, 3)."""
    moved: Floats
    """Displacements of the bodies [mm]. Shape (bodies, 3)."""

    def point(self, body: int, point: object) -> Floats:
        """Return points of a body in this pose [mm], shape (..., 3), from their positions in the zero pose [mm]."""
        return np.asarray(np.asarray(point, dtype=float) @ self.turned[body].T + self.moved[body])

    def way(self, body: int, way: object) -> Floats:
        """Return vectors of a body in this pose, shape (..., 3), from their directions in the zero pose."""
        return np.asarray(np.asarray(way, dtype=float) @ self.turned[body].T)


def turns_of(speed: str | None, turns: Fraction) -> Fraction:
    """Return the exact turns of a body after `turns` of the driving link, from its relative speed; 0 for None."""
    return read_fraction(speed) * turns if speed is not None else Fraction(0)


def scene_pose(scene: Scene, turns: Fraction = Fraction(0)) -> ScenePose:
    """Return the positions of all bodies of a scene, with exact mean angles and the errors of teeth and pins.

    Parameters
    ----------
    scene : Scene
        Scene of a train, from `make_scene` or `build_scene`.
    turns : Fraction
        Revolutions of the driving link from the start.

    Returns
    -------
    ScenePose
        Angles of the bodies [rad], and their rotation matrices and displacements [mm] from the zero pose.

    Raises
    ------
    RangeError
        If the iteration for pairs that depend on each other does not converge.

    Examples
    --------
    The sun drives the carrier with the ratio 2/7.

    >>> import geartrain
    >>> from geartrain.scene import make_scene
    >>> pose = scene_pose(make_scene(geartrain.load("planetary-24-18-60")), Fraction(7, 4))
    >>> [round(float(angle), 4) for angle in pose.angles][-1]
    3.1416
    """
    error = body_errors(scene, turns)
    exact = [turns_of(body.speed, turns) for body in scene.bodies]
    angles = np.array(
        [
            # reduced to one turn as a fraction: the float of many turns would lose digits of the angle
            body.sense * (body.start + 2 * pi * float(turned if body.travels else turned % 1) + error[at])
            for at, (body, turned) in enumerate(zip(scene.bodies, exact, strict=True))
        ]
    )
    turned, moved = np.zeros((len(scene.bodies), 3, 3)), np.zeros((len(scene.bodies), 3))
    above = {at: [body.parent] if body.parent is not None else [] for at, body in enumerate(scene.bodies)}
    for at in TopologicalSorter(above).static_order():  # parents first
        body = scene.bodies[at]
        if body.parent is None:
            turned[at] = np.eye(3)
            continue
        # each body turns about or slides along its own axis, which moves with the parent
        joint = angles[at] - (0.0 if body.reference is None else angles[body.reference])
        if body.travels:
            turned[at] = turned[body.parent]
            moved[at] = turned[body.parent] @ (np.array(body.direction) * joint / (2 * pi)) + moved[body.parent]
            continue
        about, point = _rotation(body.direction, joint), np.array(body.point)
        turned[at] = turned[body.parent] @ about
        moved[at] = turned[body.parent] @ (point - about @ point) + moved[body.parent]
    return ScenePose(angles, turned, moved)


def _rotation(axis: tuple[float, float, float], angle: float) -> Floats:
    """Return the matrix of a right-handed rotation by an angle [rad] about a unit vector (Rodrigues' formula)."""
    x, y, z = axis
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew)


# --------------------------------------------------------------------------------------------------------------- errors


def body_errors(scene: Scene, turns: Fraction) -> Floats:
    """Return the angular error of each body relative to its mean motion [rad], shape (bodies,)."""
    movement = scene.movement
    delta = np.zeros(len(movement.sources))
    for step in movement.steps:
        _evaluate_step(scene, step, turns, delta)
    error = np.zeros(len(scene.bodies))
    for source, each in zip(movement.sources, delta, strict=True):
        error[list(source.bodies)] += each * np.array(source.weights)
    index = {body.id: at for at, body in enumerate(scene.bodies)}
    for link, offset in movement.offsets.items():
        error[index[link]] += offset
    return error


def _evaluate_step(scene: Scene, step: ErrorStep, turns: Fraction, delta: Floats) -> None:
    """Compute the errors of one step and store them in `delta`.

    Iteration is required if these errors change the angles of the drivers in the same step.
    """
    sources, known = list(step.sources), list(step.known)
    base = np.array(step.from_known).reshape(len(sources), len(known)) @ delta[known]
    # fixed-point iteration, which converges if transmission errors vary slowly with the angle
    for _ in range(_ROUNDS):
        before = delta[sources]
        shift = base + np.array(step.own) @ before if step.own else base
        for at, each in zip(sources, shift, strict=True):
            source = scene.movement.sources[at]
            table = scene.movement.transmissions[source.transmission]
            # reduced to one period as a fraction, for the same reason as in `scene_pose`
            mean = table.period * float(read_fraction(source.cycles) * turns % 1)
            delta[at] = source.sense * _value(table, source.start + mean + float(each))
        if not step.own or np.abs(delta[sources] - before).max() < _CONVERGED:
            return
    why = "the fixed-point iteration for pairs that depend on each other diverges or is too slow"
    fix = "compute the motion with `GearTrain.motion`, or choose another number of turns"
    raise RangeError(Problem(f"the pose of '{scene.name}' does not converge", why, fix))


def _value(transmission: ErrorTable, S: float) -> float:
    """Return the tabulated transmission error at a driver's angle [rad]."""
    s = S % transmission.period
    # clamped, because rounding may make s equal to the period
    cell = min(max(int(np.searchsorted(transmission.breaks, s, side="right")) - 1, 0), len(transmission.breaks) - 2)
    x = s - (transmission.breaks[cell] + transmission.breaks[cell + 1]) / 2
    return float(np.polynomial.polynomial.polyval(x, transmission.coefficients[cell]))
