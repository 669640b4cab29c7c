"""Forces of gear pairs on the axes of their wheels, and the bearing friction that is proportional to these forces.

With the torques T_i and T_j of a pair about its axes and the centre distance a, the component of its force
perpendicular to the line of centres is (T_i + T_j)/a, for any point of contact. The friction torque of a bearing under
the resultant R is rho |R|, where rho is the radius of the friction circle; see equations (26) to (28) of
docs/torques.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from math import cos, tan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.torques.flow_patterns import FlowPattern, solve_block
from geartrain.dynamics.torques.load_case import power_inputs
from geartrain.dynamics.torques.mean_efficiencies import NORMAL_ANGLE
from geartrain.dynamics.torques.torque_balance import TorqueBalance, equal_planets
from geartrain.numerics.elimination import LinearForm
from geartrain.numerics.vectors import Vector, across, cross, minus, scaled
from geartrain.train.mechanism import Axis, unit_vector
from geartrain.train.states import GRAVITY

if TYPE_CHECKING:
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.kinematics.circuits import Circuit
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.gear_mesh import GearMesh

_MM = 1e-3
_MOST_ROUNDS = 20_000  # maximum iterations; one that needs more is at the limit of locking
_GROWTH = 1e12  # multiple of the first torques: a larger friction torque grows without limit
_KNOWN = -1  # column of the known torques


def separation(setting: LoadCase, circuit: Circuit, mesh: GearMesh | None) -> float | None:
    """Return the separating force of a pair on parallel axes divided by its tangential force, without friction [1];
    None if it is unknown.

    mesh   pair with its tooth form; None to use the declared pressure angle, which is 20 degrees by default
    """
    if mesh is not None:
        return mesh.separation
    form, helix = setting.train.form_of(setting.gears[circuit.id]), setting.train.wheels[circuit.wheels[0]][1].helix
    angle = NORMAL_ANGLE if form is None or form.rack_angle is None else form.rack_angle
    return tan(angle) / cos(helix)


class AxisForce(NamedTuple):
    """Force on the second link of a pair and the opposite force on its first link, or a force on a single link.

    The force is r `along` + |r| `lean` `apart`, where r is the torque on the carrier, or on the single link. The
    vectors `along` and `apart` are the tangential and the separating force for r = 1 and `lean` = 1.
    """

    name: str
    """Name of the pair, or of the link on which the cord of a weight acts."""
    links: tuple[str | None, str]
    """First link (None for a force on a single link) and second link."""
    carrier: str
    along: Vector
    apart: Vector
    lean: float
    """Mean separating force divided by the tangential force [1]."""
    places: tuple[float | None, float | None]
    """Position along the axis at which the force acts on each link [m]; None if it acts midway between two bearings."""


@dataclass(frozen=True)
class BearingLoads:
    """Loads of all bearings with load-dependent friction, in one load case."""

    setting: LoadCase
    steady: bool = True
    """True to include the weights of links; False to omit them, so that all forces are proportional to the torques."""
    _left_out: dict[str, list[str]] = field(default_factory=dict, init=False)

    @cached_property
    def links(self) -> tuple[str, ...]:
        """Names of the links whose bearings have load-dependent friction."""
        links = self.setting.train.links.items()
        return tuple(link for link, part in links if part.friction_radius and link in self.setting.tree.parent)

    @cached_property
    def forces(self) -> tuple[AxisForce, ...]:
        """Forces of pairs, and of the cord of a driving weight, that load these bearings."""
        found = [*self._pairs(), *self._line()]
        return tuple(
            each for each in found if any(self._inside(link, end) for link in self.links for end in each.links)
        )

    @property
    def missing(self) -> Mapping[str, Sequence[str]]:
        """Names of the pairs and cords with unknown forces on these bearings, by the reason or the remedy."""
        _ = self.forces  # lists the pairs
        return self._left_out

    def _inside(self, link: str, end: str | None) -> bool:
        """Return True if `end` is `link` or is carried by it, so that a force on `end` loads the bearing of `link`."""
        while end is not None and end != link:
            end = self.setting.tree.above(end)
        return end is not None

    def _pairs(self) -> Iterator[AxisForce]:
        setting, train = self.setting, self.setting.train
        for circuit in setting.circuits:
            if circuit.kind != "gear" or not setting.axes.are_parallel(labels := setting.axis_labels(circuit)):
                self._leave_out(circuit, "forces are computed only for gear pairs on parallel axes")
                continue
            axes = [train.axes.get(label) for label in labels]
            points = [None if axis is None else axis.point for axis in axes]
            if lacking := sorted({label for label, point in zip(labels, points, strict=True) if point is None}):
                self._leave_out(circuit, f"give the positions of the axes {', '.join(lacking)} in `axes`")
                continue
            lean = separation(setting, circuit, setting.meshes.get(circuit.id))
            if lean is None:
                self._leave_out(circuit, "the direction of the force of these teeth is unknown")
                continue
            first, second = (point for point in points if point is not None)
            wheels = [train.wheels[name] for name in circuit.wheels]
            thrusting = [end for end, wheel in wheels if wheel.is_helical]
            shoulders = [link for link in self.links if train.links[link].shoulder_friction]
            if any(self._inside(link, end) for link in shoulders for end in thrusting):
                why = "thrusts of helical teeth on shoulders are not included"
                self._left_out.setdefault(why, []).append(circuit.id)
            # about the reference direction of parallel axes, as the signs of the torques
            way = scaled((axes[0] or Axis()).way, setting.axes.sign(labels[0]))
            line = across(scaled(minus(second, first), _MM), way)
            i, j = (wheel for _, wheel in wheels)
            square = float(np.dot(line, line)) * (-1 if i.internal or j.internal else 1)
            yield AxisForce(
                circuit.id,
                (circuit.i, circuit.j),
                circuit.carrier,
                scaled(cross(way, line), 1 / abs(square)),
                scaled(line, 1 / square),
                lean,
                (0.0 if i.along is None else i.along.si, 0.0 if j.along is None else j.along.si),
            )

    def _line(self) -> Iterator[AxisForce]:
        """Yield the force that the cord of a driving weight exerts on its drum; yield nothing if it is unknown."""
        drive, source = self.setting.case.drive, next(iter(power_inputs(self.setting)), None)
        if drive is None or drive.drum is None or source is None:
            return
        if (down := self._down) is None:
            self._left_out.setdefault("give the direction of `gravity`", []).append(f"line on '{source}'")
            return
        frame = self.setting.train.frame
        pull = scaled(down, 1 / drive.drum.si)
        yield AxisForce(source, (None, source), frame, (0.0, 0.0, 0.0), pull, 1.0, (None, None))

    @property
    def _down(self) -> Vector | None:
        return self.setting.train.gravity and unit_vector(self.setting.train.gravity)

    def _leave_out(self, circuit: Circuit, why: str) -> None:
        if any(self._inside(link, circuit.i) != self._inside(link, circuit.j) for link in self.links):
            self._left_out.setdefault(why, []).append(circuit.id)

    # -------------------------------------------------------------------------------------------------------- supports

    @cached_property
    def supports(self) -> tuple[tuple[int, float | None, float | None], ...]:
        """Index of the link, position of the bearing, and position of the other bearing of the link [m], for each
        bearing; a position is None if `at` is not declared.
        """
        found: list[tuple[int, float | None, float | None]] = []
        for number, link in enumerate(self.links):
            bearing = self.setting.train.links[link].bearing
            a, b = (None, None) if bearing is None or bearing.at is None else (each.si for each in bearing.at)
            found += [(number, a, b)] if a is None else [(number, a, b), (number, b, a)]
        return tuple(found)

    @cached_property
    def shares(self) -> Floats:
        """Fraction of each force that each bearing carries, shape (bearings, forces)."""
        found = np.zeros((len(self.supports), len(self.forces)))
        for row, (number, own, other) in enumerate(self.supports):
            for column, force in enumerate(self.forces):
                for sign, end, place in zip((-1, 1), force.links, force.places, strict=True):
                    if self._inside(self.links[number], end):
                        found[row, column] += sign * _share(own, other, place)
        return found

    @cached_property
    def masses(self) -> Mapping[str, float | None]:
        """Mass of each link whose weight loads these bearings [kg], by link; None if the mass is not declared."""
        links = self.setting.train.links.items() if self._down and self.steady else ()
        carried = {link: part.mass for link, part in links if any(self._inside(each, link) for each in self.links)}
        return {link: None if mass is None else mass.si for link, mass in carried.items()}

    @cached_property
    def weights(self) -> Floats:
        """Weight that each bearing carries, as a force vector [N], shape (bearings, 3, 1)."""
        found = np.zeros((len(self.supports), 3, 1))
        for row, (number, own, other) in enumerate(self.supports):
            mass = sum(mass or 0.0 for link, mass in self.masses.items() if self._inside(self.links[number], link))
            found[row, :, 0] = np.array(self._down or (0.0,) * 3) * GRAVITY * mass * _share(own, other, None)
        return found

    @cached_property
    def thrust(self) -> Floats:
        """Friction torque on the shoulder of each link due to weights along its axis [N m], shape (links, 1)."""
        down = self._down or (0.0,) * 3
        along = np.abs(self.ways(self.links)[:, :, 0] @ down)
        carried = [sum(m or 0.0 for end, m in self.masses.items() if self._inside(link, end)) for link in self.links]
        shoulders = np.array([self.setting.train.links[link].shoulder_friction for link in self.links])
        found: Floats = GRAVITY * shoulders * along * carried
        return found[:, None]

    def ways(self, links: Iterable[str]) -> Floats:
        """Return the unit vectors along the axes of the given links in reference direction, shape (links, 3, 1)."""
        labels, axes = [self.setting.tree.axis(link) or "" for link in links], self.setting.axes
        ways = [scaled(self.setting.train.axes.get(label, Axis()).way, axes.sign(label)) for label in labels]
        return np.array(ways).reshape(-1, 3, 1)

    # --------------------------------------------------------------------------------------------------------- friction

    def loads(self, reactions: Floats, angles: Floats | None = None, leans: Floats | None = None) -> Floats:
        """Return the load on the bearings of each link [N], shape (links, n), which is the sum over its two bearings.

        reactions   torque on the carrier of each force, about the reference direction [N m], shape (forces, n)
        angles      angle by which each carrier has turned from its declared position [rad], shape (forces, n)
        leans       separating force divided by the tangential force, shape (forces, n); None for the mean ratios
        """
        along, apart = (
            np.array([getattr(force, key) for force in self.forces]).reshape(-1, 3, 1) for key in ("along", "apart")
        )
        leans = np.array([[force.lean] for force in self.forces]).reshape(-1, 1) if leans is None else leans
        vectors = reactions[:, None] * along + (np.abs(reactions) * leans)[:, None] * apart
        if angles is not None:
            vectors = self._turned(vectors, angles)
        total = np.einsum("bf,fdn->bdn", self.shares, vectors) + self.weights
        ways = self.ways(self.links[number] for number, _, _ in self.supports)
        total = total - ways * (total * ways).sum(axis=1, keepdims=True)
        found = np.zeros((len(self.links), reactions.shape[1]))
        np.add.at(found, [number for number, _, _ in self.supports], np.sqrt((total**2).sum(axis=1)))
        return found

    def _turned(self, vectors: Floats, angles: Floats) -> Floats:
        """Return force vectors of shape (forces, 3, n), rotated by `angles` [rad] about the axes of their carriers."""
        way = self.ways(force.carrier for force in self.forces)
        inside = way * (vectors * way).sum(axis=1, keepdims=True)
        turn = angles[:, None]
        found: Floats = (vectors - inside) * np.cos(turn) + np.cross(way, vectors, axis=1) * np.sin(turn) + inside
        return found

    def friction(self, loads: Floats, balance: TorqueBalance) -> Floats:
        """Return the friction torque in the bearings of each link [N m], given their loads [N], both of shape (links,
        n). The torque is averaged over equal planets, whose loads may differ due to weights or rounding.
        """
        own = np.array([[self.setting.train.links[link].friction_radius] for link in self.links]) * loads + self.thrust
        like, row = equal_planets(balance), {link: at for at, link in enumerate(self.links)}
        return np.array([own[[row[peer] for peer in like.get(link, (link,))]].mean(axis=0) for link in self.links])

    def friction_torques(
        self, balance: TorqueBalance, flow: FlowPattern, applied: Mapping[str, Fraction]
    ) -> Mapping[str, tuple[float, float]] | None:
        """Return the friction torque [N m] and the load [N] of each bearing, by link, for one pattern of power flow;
        None if no friction torques are consistent with the loads, because bearing friction locks the train.

        The torques of pairs, and thus the bearing loads R, are linear in the friction torques M, so M = rho |R(M)| is
        solved by fixed-point iteration, where rho is the radius of the friction circle.

        applied   known external torques without friction, by link
        """
        found = self._responses(balance, flow, applied)
        if found is None:
            return None

        def loads(torques: Floats) -> Floats:
            return self.loads(found[:, :1] + found[:, 1:] @ torques)

        torques = fixed_point(lambda each: self.friction(loads(each), balance), len(self.links))
        if torques is None:
            return None
        rows = zip(self.links, torques[:, 0].tolist(), loads(torques)[:, 0].tolist(), strict=True)
        return {link: (torque, load) for link, torque, load in rows}

    def _responses(self, balance: TorqueBalance, flow: FlowPattern, applied: Mapping[str, Fraction]) -> Floats | None:
        """Return the torque of each force on the carrier, shape (forces, 1 + links); None if the torques do not
        balance.

        Column 0 contains the torques without load-dependent friction. Each further column contains the torques per unit
        friction torque in the bearing of one link, or in the bearings of all equal planets (column of the first
        planet).
        """
        like = equal_planets(balance)
        known: dict[str, LinearForm] = {link: {_KNOWN: torque} for link, torque in balance.known.items()}
        for link in self.links:
            number = self.links.index(like.get(link, (link,))[0])
            for end, torque in self.setting.friction_senses(link):
                form = known.setdefault(end, {})
                form[-2 - number] = form.get(-2 - number, Fraction(0)) + torque
        # different numbers for the loaded links, so that rows are not taken as equal by chance
        links = dict(enumerate(balance.links))
        marks = {link: Fraction(2 + balance.links.index(like.get(link, (link,))[0])) for link in links.values()}
        balance = replace(balance, known={link: mark for link, mark in marks.items() if link in known})
        sides = {}
        for at, column in enumerate(balance.columns):
            lossy = next((mesh for mesh in column.meshes if mesh.loses), None)
            sides[at] = 0 if lossy is None else flow.pattern[lossy.id]
        forms = solve_block(
            balance.columns, balance.whole, sides, {row: known.get(links.get(row, ""), {}) for row in balance.rows}
        )
        if forms is None:
            return None
        torques: dict[str, LinearForm] = {link: {_KNOWN: torque} for link, torque in applied.items()}
        first = sum(1 for column in balance.columns if column.meshes)  # meshes precede the unknown external torques
        torques |= {link: forms[first + at] or {} for at, link in enumerate(balance.unknown)}
        for at, column in enumerate(balance.columns):
            for mesh in column.meshes:
                own = mesh.torques(flow.pattern.get(mesh.id, 0))
                factor = -mesh.senses[0] * own[0] - mesh.senses[1] * own[1]
                torques[mesh.id] = {symbol: factor * value for symbol, value in (forms[at] or {}).items()}
        found = np.zeros((len(self.forces), 1 + len(self.links)))
        for row, force in enumerate(self.forces):
            for symbol, value in torques.get(force.name, {}).items():
                found[row, -1 - symbol] = float(value)
        return found


def _share(own: float | None, other: float | None, place: float | None) -> float:
    """Return the fraction of a force at `place` [m] that is carried by the bearing at `own` [m], if a second bearing is
    at `other` [m]. It is 1/2 if `place` is None, and 1 if the position of a bearing is unknown.
    """
    if own is None or other is None:
        return 1.0
    return 0.5 if place is None else (other - place) / (other - own)


def fixed_point(function: Callable[[Floats], Floats], size: int) -> Floats | None:
    """Return a column x = f(x) of non-negative numbers by damped fixed-point iteration from 0; None if it diverges.

    Each iteration uses the mean of x and f(x), which converges even if f reverses the sign of deviations, as when
    friction relieves a bearing.
    """
    found = np.zeros((size, 1))
    first = float(np.max(function(found), initial=0.0))
    for _ in range(_MOST_ROUNDS):
        after = (found + function(found)) / 2
        if np.all(np.abs(after - found) <= np.finfo(float).eps * np.abs(after)):
            return after
        if not np.max(after) <= _GROWTH * first:
            return None
        found = after
    return None
