"""Freedom of each link: the range of angles that the teeth allow in the parts as cut and assembled.

For every mesh at a pose, the outlines give the limits of the lag of its second wheel. A lag is a linear combination of
angles of links. Linear programmes over all meshes therefore give the range of each link while the input is held, and
whether the input can be turned at all. These programmes use tooth numbers and axis positions, but no speeds. If `solve`
determines the speed of a link, the teeth must limit its angle, and in every pose the link must be within its backlash.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import atan2, inf, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError, Problem
from geartrain.kinematics.buildability import BuildFinding
from geartrain.numerics.results import Result
from geartrain.scene.pose import scene_pose

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneWheel
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.workshop.export.proof.turned_pair import TurnedPair

# turns of the driving link, with prime denominators, so that teeth are seldom in the same phase in two poses
_POSES = (Fraction(0), Fraction(1, 7), Fraction(17, 31), Fraction(41, 13))
_TOUCH = 2e-3  # of a pitch: tolerated overlap of wheels in contact, due to chords and rounded coordinates
_PARALLEL = 1e-9  # deviation of a cosine from 1 that counts as rounding


@dataclass(frozen=True, slots=True)
class LinkFreedom(Result):
    """Range of angles through which a link can be turned by hand while the input is fixed."""

    link: str
    """Name of the link."""
    backlash: float | None
    """Range of the angle due to backlash between the input and the link [rad]; None if teeth do not limit it."""


FreedomProof = tuple[tuple[LinkFreedom, ...], tuple[BuildFinding, ...]]


def prove_freedom(
    work: SolidModel, pairs: Mapping[str, TurnedPair], names: Mapping[str, tuple[str, str]]
) -> FreedomProof:
    """Return the freedom of all links except frame and inputs, and findings where it contradicts the solved speeds.

    pairs   outlines of the meshes that were individually proved to turn, keyed by the name of the pair
    names   names of wheels 1 and 2 of each mesh, keyed by the name of the pair
    """
    try:
        return _Motion(work, pairs, names).prove()
    except GearTrainError as error:  # pairs that depend on each other and do not converge
        return (), tuple(BuildFinding("F1", "note", problem) for problem in error.problems)


@dataclass(frozen=True, slots=True)
class _Constraint:
    """Constraint low <= weights @ changes <= high [rad] that a mesh imposes on small changes of all link angles."""

    pair: str
    weights: Floats
    low: float
    high: float


class _Motion:
    def __init__(self, work: SolidModel, pairs: Mapping[str, TurnedPair], names: Mapping[str, tuple[str, str]]) -> None:
        self.work, self.scene, self.pairs, self.names = work, work.scene, pairs, names
        self.bodies = {body.id: at for at, body in enumerate(self.scene.bodies)}
        self.wheels = {wheel.id: wheel for wheel in self.scene.wheels}
        self.case = work.sized.declaration.case(work.sized.declaration.state_or_first(work.state))

    def prove(self) -> FreedomProof:
        """Return the freedom of all links at the first pose, and findings in several poses, each reported once."""
        findings: dict[str, BuildFinding] = {}
        links: tuple[LinkFreedom, ...] = ()
        speeds = {body.id: body.speed for body in self.scene.bodies}
        turns = any(speed not in (None, "0") for speed in speeds.values())
        for at, pose in enumerate(_POSES if turns else _POSES[:1]):
            rows, off = self._constraints(pose)
            for pair, mm in off.items():
                where = f" after {pose} turns" if pose else ""
                what = f"pair '{pair}': its wheels overlap{where}" + ("" if mm == inf else f" by {mm:.3g} mm")
                why = "at the solved angles of all links, a tooth of one wheel meets a tooth of the other"
                fix = "fix a wheel to its arbor at another angle, or change tooth numbers"
                findings.setdefault(pair, BuildFinding("F1", "error", Problem(what, why, fix)))
            if off:
                break
            if not at:
                links = tuple(self._links(rows))
                findings |= {found.problem.what: found for found in self._contradictions(links, rows, turns)}
        return links, tuple(findings.values())

    # ------------------------------------------------------------------------------------------------------------ rows

    def _constraints(self, pose: Fraction) -> tuple[list[_Constraint], dict[str, float]]:
        """Return the constraints of all meshes in a pose, and the arc by which teeth overlap [mm], keyed by pair."""
        angles = scene_pose(self.scene, pose).angles
        rows, off = [], {}
        for circuit in self.work.sized.circuits:
            turned = self.pairs.get(circuit.id)
            senses = None if turned is None else self._axis_senses(circuit)
            if turned is None or senses is None:
                rows.append(_Constraint(circuit.id, self._ratio_constraint(circuit), 0.0, 0.0))
                continue
            row, beyond = self._mesh_constraint(circuit, turned, senses, angles)
            rows.append(row)
            if beyond > _TOUCH * turned.pitches[1]:
                off[circuit.id] = beyond * self.work.layout.wheels[self.names[circuit.id][1]].radius
        return rows, off

    def _ratio_constraint(self, circuit: Circuit) -> Floats:
        """Return the coefficients of the exact ratio of a pair whose outlines were not turned, such as a bevel pair."""
        weights = np.zeros(len(self.scene.bodies))
        for link, count in ((circuit.i, circuit.a), (circuit.j, circuit.b), (circuit.carrier, -circuit.a - circuit.b)):
            at = self.bodies[link]
            weights[at] += count * self.scene.bodies[at].sense
        # tooth counts as coefficients would scale a linear programme badly
        return weights / max(float(np.abs(weights).max()), 1.0)

    def _axis_senses(self, circuit: Circuit) -> tuple[int, int, int] | None:
        """Return the senses (1, -1) of both wheels and carrier about the first axis; None unless axes are parallel."""
        one, other = (self.wheels[name] for name in self.names[circuit.id])
        n = np.array(one.direction)
        bodies = (one.body, other.body, self.bodies[circuit.carrier])
        senses = []
        for body in bodies:
            cosine = float(n @ self.scene.bodies[body].direction)
            if self.scene.bodies[body].parent is None:
                cosine = 1.0  # the frame does not turn about any axis
            if abs(abs(cosine) - 1) > _PARALLEL:
                return None
            senses.append(1 if cosine > 0 else -1)
        return senses[0], senses[1], senses[2]

    def _mesh_constraint(
        self, circuit: Circuit, turned: TurnedPair, senses: tuple[int, int, int], angles: Floats
    ) -> tuple[_Constraint, float]:
        """Return the constraint of a mesh for the link angles `angles`, and the angle by which its teeth overlap [rad].

        The overlap is an angle of the second wheel; it is inf if that wheel is nowhere free. `senses` are
        computed by `_axis_senses`.
        """
        one, other = (self.wheels[name] for name in self.names[circuit.id])
        first, second, held = (one.body, other.body, self.bodies[circuit.carrier])
        s1, s2, sk = senses
        ratio = turned.counts[0] / turned.counts[1] * (1 if turned.ring else -1)
        # a tooth of the first wheel faces a space of the second one on the line of centres
        start = pi / turned.counts[1] + (0.0 if turned.ring else pi)
        begin, end = self._tooth_angle(one, one, other, turned), self._tooth_angle(other, one, other, turned)
        t = begin + s1 * angles[first] - sk * angles[held]
        lag = end + s2 * angles[second] - sk * angles[held] - start - ratio * t
        near, lag = _wrapped(t, turned.pitches[0]), _wrapped(lag, turned.pitches[1])
        free = turned.free(np.array([near]), np.array([lag]))
        low, high = float(free.low[0]) - lag, float(free.high[0]) - lag
        # the lag is linear in the angles of the two wheels and of their carrier
        weights = np.zeros(len(self.scene.bodies))
        weights[second] += s2
        weights[first] -= ratio * s1
        weights[held] += sk * (ratio - 1)
        # the limits are NaN if the second wheel is nowhere free
        return _Constraint(circuit.id, weights, low, high), max(low, -high, 0.0) if low == low else inf

    def _tooth_angle(self, wheel: SceneWheel, one: SceneWheel, other: SceneWheel, turned: TurnedPair) -> float:
        """Return the angle from the line of centres to the first tooth of `wheel` at the start of the motion [rad].

        one, other   first and second wheel of the mesh; the angle is positive about the axis of the first wheel
        """
        n = np.array(one.direction)
        between = np.subtract(other.centre, one.centre) * (-1 if turned.ring else 1)
        x = between - (between @ n) * n
        x = x / np.linalg.norm(x)
        reference, along = np.array(wheel.reference), np.array(wheel.direction)
        tooth = np.cos(wheel.turn) * reference + np.sin(wheel.turn) * np.cross(along, reference)
        return atan2(float(tooth @ np.cross(n, x)), float(tooth @ x))

    # ----------------------------------------------------------------------------------------------------------- links

    @cached_property
    def _fixed_equations(self) -> Floats:
        """Coefficients of the equations of fixed links (except inputs) and of locked links, one equation per row."""
        count = len(self.scene.bodies)
        rows = []
        frame = self.work.sized.declaration.frame
        for link in {frame, *self.case.fixed}:
            rows.append(np.eye(count)[self.bodies[link]])
        for one, other in self.case.locks:
            row = np.zeros(count)
            for link, sign in ((one, 1), (other, -1)):
                row[self.bodies[link]] += sign * self.scene.bodies[self.bodies[link]].sense
            rows.append(row)
        return np.array(rows)

    def _links(self, rows: Sequence[_Constraint]) -> Iterator[LinkFreedom]:
        """Yield the freedom of each link under the constraints `rows` while the inputs are fixed."""
        held = np.eye(len(self.scene.bodies))[[self.bodies[link] for link in self.case.inputs]]
        fixed = np.concatenate([self._fixed_equations, held])
        still = {self.work.sized.declaration.frame, *self.case.inputs}
        for body in self.scene.bodies:
            if body.id in still or body.bookkeeping:
                continue
            ends = [self._maximum_angle(rows, fixed, self.bodies[body.id], way) for way in (-1, 1)]
            yield LinkFreedom(body.id, ends[1] - ends[0] if np.isfinite(ends).all() else None)

    def _maximum_angle(self, rows: Sequence[_Constraint], fixed: Floats, at: int, way: int) -> float:
        """Return the maximum angle of a link in one direction by linear programming [rad]; infinite without a limit.

        rows    constraints of the meshes
        fixed   coefficients of further equations, one in each row
        at      index of the link; `way` is the direction, 1 or -1
        """
        from scipy.optimize import linprog

        cost = np.zeros(len(self.scene.bodies))
        cost[at] = -way
        weights = np.array([row.weights for row in rows]).reshape(-1, len(cost))
        low, high = (np.array([getattr(row, side) for row in rows]) for side in ("low", "high"))
        # a wheel in contact is at the limit, or beyond it by the error of a chord
        low, high = np.minimum(low, 0.0), np.maximum(high, 0.0)
        equal = low == high
        sides = np.concatenate([weights[~equal], -weights[~equal]])
        limits = np.concatenate([high[~equal], -low[~equal]])
        finite = np.isfinite(limits)
        still = np.concatenate([fixed, weights[equal]])
        found = linprog(
            cost,
            A_ub=sides[finite] if finite.any() else None,
            b_ub=limits[finite] if finite.any() else None,
            A_eq=still,
            b_eq=np.zeros(len(still)),
            bounds=(None, None),
        )
        # an unbounded programme means that the teeth do not stop the link
        return -way * float(found.fun or 0.0) if found.status == 0 else way * inf

    # --------------------------------------------------------------------------------------------------------- findings

    def _contradictions(
        self, links: Sequence[LinkFreedom], rows: Sequence[_Constraint], turns: bool
    ) -> Iterator[BuildFinding]:
        """Yield findings on links for which the teeth (constraints `rows`) contradict the solved speeds."""
        speeds = {body.id: body.speed for body in self.scene.bodies}
        for link in links:
            if link.backlash is None and speeds[link.link] is not None:
                what = f"link '{link.link}' can turn while the input is fixed"
                why = "its speed is determined, but the cut teeth do not prevent this motion"
                fix = "declare a tooth form for its meshes, or give taller teeth"
                yield BuildFinding("F1", "error", Problem(what, why, fix))
            elif link.backlash is not None and speeds[link.link] is None:
                what = f"link '{link.link}' is fixed by its teeth, but `solve` does not determine its speed"
                fix = "check the pairs of this link, or declare another input"
                yield BuildFinding("F1", "note", Problem(what, "the proof and the solution contradict each other", fix))
        driving_link = self.scene.driving_link
        if driving_link is None or not self.case.inputs:
            return
        # a train that can turn through any angle has no finite ends
        ends = [self._maximum_angle(rows, self._fixed_equations, driving_link, way) for way in (-1, 1)]
        if turns and np.isfinite(ends).any():
            what = f"'{self.scene.bodies[driving_link].id}' jams after {np.degrees(ends[1] - ends[0]):.3g} degrees"
            why = "the backlash of all meshes together does not allow a full turn"
            yield BuildFinding("F1", "error", Problem(what, why, "remove one mesh of the loop"))


def _wrapped(angle: float, pitch: float) -> float:
    return (angle + pitch / 2) % pitch - pitch / 2
