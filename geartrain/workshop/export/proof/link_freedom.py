"""Each link's freedom by brute motion: between which angles the teeth, as cut and as they stand, let it turn.

Of every mesh the outlines say between which lags its second wheel is free, at the angles of a pose. A lag is a sum of
angles of links, so all meshes together say how far a link may turn while the input is held, and whether the input can
be turned at all: linear programmes, which know tooth numbers and places of axles, and nothing of speeds. A link that
`solve` has determined is held, and wherever the train has been turned to it stands within its play.
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

_POSES = (Fraction(0), Fraction(1, 7), Fraction(17, 31), Fraction(41, 13))  # turns of the lead
_TOUCH = 2e-3  # of a pitch: how far a wheel that touches its mate may stand in it, chords and digits included
_PARALLEL = 1e-9


@dataclass(frozen=True, slots=True)
class LinkFreedom(Result):
    """How far a link turns by hand while the input is held."""

    link: str
    """Its name."""
    backlash: float | None
    """From end to end, the play of all meshes up to it [rad]; None for a link that nothing holds."""


@dataclass(frozen=True, slots=True)
class FreedomProof:
    """The freedom of all links but the frame, and where it is not what `solve` says."""

    links: tuple[LinkFreedom, ...]
    findings: tuple[BuildFinding, ...] = ()


def prove_freedom(
    work: SolidModel, pairs: Mapping[str, TurnedPair], names: Mapping[str, tuple[str, str]]
) -> FreedomProof:
    """Turn a train by its teeth.

    pairs   the meshes that are proved to turn, each alone; `names`, wheels 1 and 2 of each
    """
    try:
        return _Motion(work, pairs, names).prove()
    except GearTrainError as error:  # pairs that depend on each other and do not settle
        return FreedomProof((), tuple(BuildFinding("F1", "note", problem) for problem in error.problems))


@dataclass(frozen=True, slots=True)
class _Row:
    """A mesh as a condition on angles of links: low <= weights . deviations <= high."""

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
        """At several poses; what of them disagrees is told once."""
        findings: dict[str, BuildFinding] = {}
        links: tuple[LinkFreedom, ...] = ()
        speeds = {body.id: body.speed for body in self.scene.bodies}
        turns = any(speed not in (None, "0") for speed in speeds.values())
        for at, pose in enumerate(_POSES if turns else _POSES[:1]):
            rows, off = self._rows(pose)
            for pair, mm in off.items():
                findings.setdefault(pair, self._out_of_step(pair, mm, pose))
            if off:
                break
            if not at:
                links = tuple(self._links(rows))
                findings |= {found.problem.what: found for found in self._against(links, rows, turns)}
        return FreedomProof(links, tuple(findings.values()))

    # ------------------------------------------------------------------------------------------------------------ rows

    def _rows(self, pose: Fraction) -> tuple[list[_Row], dict[str, float]]:
        """All meshes at a pose, and those whose wheels do not stand within their play: how far (mm) they are off."""
        angles = scene_pose(self.scene, pose).angles
        rows, off = [], {}
        for circuit in self.work.sized.circuits:
            turned = self.pairs.get(circuit.id)
            if turned is None or self._along(circuit) is None:
                weights = self._by_ratio(circuit)
                rows.append(_Row(circuit.id, weights, 0.0, 0.0))
                continue
            row, beyond = self._mesh(circuit, turned, angles)
            rows.append(row)
            if beyond > _TOUCH * turned.pitches[1]:
                off[circuit.id] = beyond * self.work.layout.wheels[self.names[circuit.id][1]].radius
        return rows, off

    def _by_ratio(self, circuit: Circuit) -> Floats:
        """What is not turned here, as pins in slots and cones, by its tooth numbers."""
        weights = np.zeros(len(self.scene.bodies))
        for link, count in ((circuit.i, circuit.a), (circuit.j, circuit.b), (circuit.carrier, -circuit.a - circuit.b)):
            at = self.bodies[link]
            weights[at] += count * self.scene.bodies[at].sense
        return weights / max(float(np.abs(weights).max()), 1.0)

    def _along(self, circuit: Circuit) -> tuple[int, int, int] | None:
        """Senses of both wheels' bodies and of their carrier about the first one's direction; None if not parallel."""
        one, other = (self.wheels[name] for name in self.names[circuit.id])
        n = np.array(one.direction)
        bodies = (one.body, other.body, self.bodies[circuit.carrier])
        senses = []
        for body in bodies:
            cosine = float(n @ self.scene.bodies[body].direction)
            if self.scene.bodies[body].parent is None:
                cosine = 1.0  # the frame stands still about any axis
            if abs(abs(cosine) - 1) > _PARALLEL:
                return None
            senses.append(1 if cosine > 0 else -1)
        return senses[0], senses[1], senses[2]

    def _mesh(self, circuit: Circuit, turned: TurnedPair, angles: Floats) -> tuple[_Row, float]:
        """A mesh as it stands, and by how much (rad) its second wheel is beyond its play."""
        one, other = (self.wheels[name] for name in self.names[circuit.id])
        first, second, held = (one.body, other.body, self.bodies[circuit.carrier])
        senses = self._along(circuit)
        assert senses is not None
        s1, s2, sk = senses
        ratio = turned.counts[0] / turned.counts[1] * (1 if turned.ring else -1)
        stands = pi / turned.counts[1] + (0.0 if turned.ring else pi)
        begin, end = self._tooth(one, one, other, turned), self._tooth(other, one, other, turned)
        t = begin + s1 * angles[first] - sk * angles[held]
        lag = end + s2 * angles[second] - sk * angles[held] - stands - ratio * t
        near, lag = _wrapped(t, turned.pitches[0]), _wrapped(lag, turned.pitches[1])
        free = turned.free(np.array([near]), np.array([lag]))
        low, high = float(free.low[0]) - lag, float(free.high[0]) - lag
        weights = np.zeros(len(self.scene.bodies))
        weights[second] += s2
        weights[first] -= ratio * s1
        weights[held] += sk * (ratio - 1)
        return _Row(circuit.id, weights, low, high), max(low, -high, 0.0) if low == low else inf

    def _tooth(self, wheel: SceneWheel, one: SceneWheel, other: SceneWheel, turned: TurnedPair) -> float:
        """Angle (rad) of a wheel's first tooth in the zero pose, from where the two touch, about the first's axis."""
        n = np.array(one.direction)
        between = np.subtract(other.centre, one.centre) * (-1 if turned.ring else 1)
        x = between - (between @ n) * n
        x = x / np.linalg.norm(x)
        reference, along = np.array(wheel.reference), np.array(wheel.direction)
        tooth = np.cos(wheel.turn) * reference + np.sin(wheel.turn) * np.cross(along, reference)
        return atan2(float(tooth @ np.cross(n, x)), float(tooth @ x))

    # ----------------------------------------------------------------------------------------------------------- links

    @cached_property
    def _held(self) -> Floats:
        """Conditions of the case, as rows that are 0: what stands, what turns as one, and the inputs by hand."""
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

    def _inputs(self) -> Floats:
        """Each input held."""
        count = len(self.scene.bodies)
        return np.array([np.eye(count)[self.bodies[link]] for link in self.case.inputs]).reshape(-1, count)

    def _links(self, rows: Sequence[_Row]) -> Iterator[LinkFreedom]:
        """Each link's play while the inputs are held."""
        fixed = np.concatenate([self._held, self._inputs()])
        still = {self.work.sized.declaration.frame}
        for body in self.scene.bodies:
            if body.id in still or body.bookkeeping:
                continue
            if body.id in self.case.inputs:
                continue
            ends = [self._farthest(rows, fixed, self.bodies[body.id], way) for way in (-1, 1)]
            yield LinkFreedom(body.id, ends[1] - ends[0] if np.isfinite(ends).all() else None)

    def _farthest(self, rows: Sequence[_Row], fixed: Floats, at: int, way: int) -> float:
        """How far (rad) a link can be turned one way; infinite where nothing stops it."""
        from scipy.optimize import linprog

        cost = np.zeros(len(self.scene.bodies))
        cost[at] = -way
        weights = np.array([row.weights for row in rows]).reshape(-1, len(cost))
        low, high = (np.array([getattr(row, side) for row in rows]) for side in ("low", "high"))
        # a wheel that touches its mate stands on the border, or a chord beyond it
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
        return -way * float(found.fun or 0.0) if found.status == 0 else way * inf

    # -------------------------------------------------------------------------------------------------------- judgement

    def _against(self, links: Sequence[LinkFreedom], rows: Sequence[_Row], turns: bool) -> Iterator[BuildFinding]:
        """Where the teeth say otherwise than `solve`."""
        speeds = {body.id: body.speed for body in self.scene.bodies}
        for link in links:
            if link.backlash is None and speeds[link.link] is not None:
                what = f"link '{link.link}' turns freely while the input is held"
                yield _finding("error", what, "no teeth hold it, though its speed is determined", "give it a mesh")
            elif link.backlash is not None and speeds[link.link] is None:
                what = f"link '{link.link}' is held by its teeth, and `solve` does not determine its speed"
                yield _finding("note", what, "the proof and the solution differ", "")
        driving_link = self.scene.driving_link
        if driving_link is None or not self.case.inputs:
            return
        ends = [self._farthest(rows, self._held, driving_link, way) for way in (-1, 1)]
        if turns and np.isfinite(ends).any():
            what = f"'{self.scene.bodies[driving_link].id}' jams after {np.degrees(ends[1] - ends[0]):.3g} degrees"
            yield _finding(
                "error", what, "the plays of all meshes do not let it turn on", "take out a mesh of the loop"
            )

    def _out_of_step(self, pair: str, mm: float, pose: Fraction) -> BuildFinding:
        where = f" after {pose} turns" if pose else ""
        what = f"pair '{pair}': its wheels overlap{where}" + ("" if mm == inf else f" by {mm:.3g} mm")
        why = "where all links stand as solved, a tooth meets a tooth"
        return _finding("error", what, why, "join a wheel to its arbor at another angle, or change tooth numbers")


def _finding(level: str, what: str, why: str, fix: str) -> BuildFinding:
    return BuildFinding("F1", "error" if level == "error" else "note", Problem(what, why, fix))


def _wrapped(angle: float, pitch: float) -> float:
    return (angle + pitch / 2) % pitch - pitch / 2
