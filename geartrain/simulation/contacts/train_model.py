"""Reduction of a train and its drive to coordinates and contacts: ideal pairs are eliminated, and other pairs are
contacts.

Rows of ideal pairs, locks and brakes are eliminated exactly. Speeds of links are then linear forms N of a few
coordinate speeds, equation (8) of docs/dynamics.md, and the mass matrix is M = N^T diag(J) N with the moments of
inertia J of the links. Pairs with a tooth form, pins, and pairs with a declared efficiency are contacts between
coordinates.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.dynamics.gear_meshes import CouplingMesh, PinMesh
from geartrain.dynamics.motion.motion_model import Motion
from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.circuits import pallet_link
from geartrain.kinematics.willis_system import axis_sense
from geartrain.numerics.elimination import eliminate
from geartrain.simulation.contacts.contact_model import Bearing, ContactModel, ContactPair, Form, Spring, Stop
from geartrain.simulation.contacts.pair_tables import TabledFunction, tabled_angle
from geartrain.simulation.contacts.rubbing_arms import Arms, efficiency_arms, pin_arms, tooth_arms
from geartrain.simulation.contacts.time_case import TimeCase
from geartrain.teeth.coupling import unmodelled_properties
from geartrain.teeth.transmission import ExactRatio

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.dynamics.motion.error_composition import PairErrorSource
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.kinematics.circuits import Circuit, Tree
    from geartrain.numerics.arrays import Floats
    from geartrain.simulation.contacts.bearing_forces import BearingForces
    from geartrain.simulation.contacts.contact_model import ToothCompliance
    from geartrain.teeth.couplings.pin_transmission import PinToSlotTransmission
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.transmission import TransmissionFunction
    from geartrain.train import Train


_FREE = 0.05  # relative to the mean ratio: a pair whose ratio stays above can also be solved for its driver


class SlackPin(ExactRatio):
    """Transmission function of a pin with clearance that touches one side of its slot, equation (9) of
    docs/dynamics.md.

    The slot is asin(clearance/(2 rho)) ahead of its position with a tight pin (`side` 1), or behind it (`side` -1); rho
    is the distance of the pin from the slot's axis.
    """

    def __init__(self, transmission: PinToSlotTransmission, clearance: float, side: int) -> None:
        super().__init__(transmission.ratio, transmission.period)
        self.transmission, self.clearance, self.side = transmission, clearance, side
        self.friction = transmission.friction

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error [rad of the slot] at pin angles S [rad]."""
        square = self.transmission._reach(S)[1]
        return np.asarray(self.transmission.error(S) + self.side * np.arcsin(self.clearance / 2 / np.sqrt(square)))

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at pin angles S [rad]."""
        square, half = self.transmission._reach(S)[1], self.clearance / 2
        # derivative of asin(half/rho), with d(rho^2)/dS = 2 r e sin S
        turning = half * self.transmission.r * self.transmission.e * np.sin(S) / (square * np.sqrt(square - half**2))
        return np.asarray(self.transmission.speed(S) - self.side * turning)


@dataclass(frozen=True)
class TrainModel:
    """Contact model of a train in one state.

    problem   equations, mean speeds, transmission functions and drivers of the train
    case      inertia, drag, loads, and the drive
    tree      turning pairs of the train
    """

    train: Train
    problem: MotionProblem
    case: TimeCase
    tree: Tree
    state: str | None = None
    bearing_forces: BearingForces | None = None
    """Forces on the bearings whose friction depends on their load; None if there are no such bearings."""

    def typical(self, link: str) -> float:
        """Return the speed of a link in the mean motion [rad/s]."""
        return float(self.problem.ratio(link)) * self.case.rate

    def sense(self, link: str, base: str) -> int:
        """Return 1 if the axes of two links have the same direction, -1 if they have opposite directions."""
        return axis_sense(link, base, self.problem.signs)

    @cached_property
    def sources(self) -> Mapping[str, PairErrorSource]:
        """Pairs and pins with a variable ratio, each with its initial phase, keyed by name."""
        names = [circuit.id for circuit in self.contacts if circuit.id in self._meshes]
        return {source.id: source for source in self.motion._with_sources(names).sources}

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on effects that the simulation does not include."""
        found = []
        if not self.contacts:
            found.append(
                "backlash and impacts: the train has no tooth form, pin or efficiency, so all speed ratios are constant"
            )
        left = [mesh.name for mesh in self.problem.teeth if mesh.has_friction and not mesh.computes_losses]
        if left:
            found.append(f"friction of {', '.join(left)}: it depends on a sliding speed that is not known")
        found += [] if self.bearing_forces is None else self.bearing_forces.notes
        found += unmodelled_properties(self.train.couplings)
        return tuple(found)

    @property
    def assumed(self) -> tuple[str, ...]:
        """Notes on the estimates that are used for undeclared stiffness and damping; empty for rigid teeth."""
        return ()

    @property
    def yields(self) -> ToothCompliance | None:
        """Stiffness and damping of the teeth of each pair; None for rigid teeth."""
        return None

    @property
    def fastest(self) -> float:
        """Maximum angular frequency that time steps must resolve [rad/s]; 0 for rigid teeth."""
        return 0.0

    # ------------------------------------------------------------------------------------------------------ coordinates

    @cached_property
    def index(self) -> Mapping[str, int]:
        """Index of the row of each link in arrays that have one row for each link."""
        return {link: at for at, link in enumerate(self.problem.system.links)}

    @cached_property
    def contacts(self) -> tuple[Circuit, ...]:
        """Circuits of the gear pairs and couplings whose contacts are simulated. Ideal pairs of constant ratio are
        eliminated instead, unless they load a bearing with load-dependent friction.
        """
        return tuple(circuit for circuit in self.problem.circuits if self._is_contact(circuit))

    def _is_contact(self, circuit: Circuit) -> bool:
        # elimination loses the forces of ideal pairs, on which friction of bearings depends
        if circuit.id in self._couplings or (self.bearing_forces and circuit.id in self.bearing_forces.names):
            return True
        mesh = self._meshes.get(circuit.id)
        if mesh is not None:
            return not mesh.rigid or mesh.verdict.backlash > 0 or (mesh.has_friction and mesh.computes_losses)
        declared = self._efficiencies.get(circuit.id)
        return declared is not None and declared.forward.base < 1

    @cached_property
    def _meshes(self) -> Mapping[str, GearMesh]:
        return {mesh.name: mesh for mesh in self.problem.teeth}

    @cached_property
    def _couplings(self) -> Mapping[str, CouplingMesh]:
        return {joint.coupling.name: joint for joint in self.problem.couplings}

    @cached_property
    def _efficiencies(self) -> Mapping[str, Any]:
        """Declared efficiency of each gear pair and of each Willis equation of a coupling, by name; None if no
        efficiency is declared.
        """
        gears = {gear.name: gear.efficiency for gear in self.train.gears}
        return gears | {name: each.efficiency for each in self.train.couplings for name in each.row_names}

    @cached_property
    def prescribed(self) -> Mapping[str, float]:
        """Prescribed speed of each link [rad/s], keyed by link."""
        unit = self.case.rate / float(self.problem.speeds[self.problem.driving_link])
        held = {
            row.label.removeprefix("input "): float(row.right)
            for row in self.problem.system.equations
            if row.kind == "input"
        }
        found = {link: speed * unit for link, speed in held.items()}
        drive = self.case.drive
        if drive.kind != "rate" or drive.link not in found:
            # power enters at one link instead; if that is not an input, the first input that turns is released
            found.pop(drive.link if drive.link in found else self.problem.driving_link)
        return found if drive.kind != "rate" else {**found, drive.link: drive.rate}

    @cached_property
    def forms(self) -> tuple[tuple[str, ...], Floats]:
        """Names of the coordinate links, and speeds of links per unit coordinate speed, shape (links, coordinates)."""
        free = {circuit.id for circuit in self.contacts}
        symbols = {self.index[link]: -1 - at for at, link in enumerate(self.prescribed)}
        rows = []
        for row in self.problem.system.equations:
            if row.label not in free and row.kind != "input":
                rows.append({symbols.get(self.index[link], self.index[link]): Fraction(c) for link, c in row.terms})
        # exact rationals: ideal pairs must not add rounding to the constraints
        solved = eliminate(rows)
        if solved.conditions:
            what = f"the prescribed speeds of {', '.join(self.prescribed)} depend on each other"
            raise QuestionError(
                Problem(what, "pairs with a constant ratio couple these links", "prescribe only one of them")
            )
        pivots = solved.forms()
        columns = [each for each in range(len(self.index)) if each not in pivots and each not in symbols]
        place = {symbol: at for at, symbol in enumerate((*symbols.values(), *columns))}
        # one row for each link, over the prescribed and the free coordinates
        speeds = np.zeros((len(self.index), len(place)))
        for link in range(len(self.index)):
            own = symbols.get(link, link)
            for column, value in pivots.get(own, {own: Fraction(1)}).items():
                speeds[link, place[column]] += float(value)
        names = tuple(self.prescribed) + tuple(self.problem.system.links[each] for each in columns)
        return names, speeds

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the links whose angles are the coordinates."""
        return self.forms[0]

    @property
    def speeds(self) -> Floats:
        """Speeds of all links per unit speed of each coordinate, shape (links, coordinates)."""
        return self.forms[1]

    def _form(self, link: str, base: str | None = None) -> Floats:
        own: Floats = self.speeds[self.index[link]]
        if base is not None:
            own = own - self.sense(link, base) * self.speeds[self.index[base]]
        return own

    @cached_property
    def mass(self) -> Floats:
        """Mass matrix N^T diag(J) N [kg m2], from the moments of inertia J of the links and their `speeds` N."""
        inertia = np.array([self.case.inertia.get(link, 0.0) for link in self.index])
        inertia[self.index[self.case.drive.link]] += self.case.drive.inertia
        found: Floats = self.speeds.T @ (inertia[:, None] * self.speeds)
        # the diagonal of M is the inertia that turns with a coordinate
        lacking = [
            name for at, name in enumerate(self.coordinates) if found[at, at] <= 0 and name not in self.prescribed
        ]
        if lacking:
            what = f"no link that turns with {', '.join(lacking)} has a moment of inertia"
            why = "a link without inertia has no equation of motion after teeth separate"
            fix = "declare `inertia: 30 kg mm2` of a link, or `thickness` and `density` of its wheels"
            raise QuestionError(Problem(what, why, fix))
        return found

    # --------------------------------------------------------------------------------------------------------- contacts

    @cached_property
    def motion(self) -> Motion:
        """Motion of all links with all drive flanks in contact."""
        frame = self.problem.frame
        return Motion(self.problem, {link: (link, frame) for link in self.problem.system.links})

    def _pairs(self) -> Iterator[ContactPair]:
        for circuit in self.contacts:
            restitution = self.case.restitution.get(circuit.id, 0.0)
            driver, driven = self._sides(circuit)
            # a pair with constant ratio has neither a phase nor a second flank
            if circuit.id not in self.sources:
                coefficient = self.motion._path(circuit.id).coefficient
                own = circuit.b if coefficient == circuit.a else circuit.a
                transmission = ExactRatio(abs(Fraction(own, coefficient)), 2 * pi)
                front = tabled_angle(transmission)
                arms = self._constant_ratio_arms(circuit, transmission)
                yield ContactPair(circuit.id, driver, driven, (0.0, 0.0), front, front, arms, restitution, True)
                continue
            front, back, arms, first = self._flanks(circuit)
            S = self.sources[circuit.id].phase
            start = S, float(first.angle(S))
            # with a dwell the driven side cannot drive
            free = first.speed_range()[0] > _FREE * float(first.ratio)
            yield ContactPair(circuit.id, driver, driven, start, front, back, arms, restitution, free)

    def _flanks(self, circuit: Circuit) -> tuple[TabledFunction, TabledFunction, Arms | None, TransmissionFunction]:
        """Return the tabulated driven angle in contact on the drive flank and on the coast flank of a pair, its
        friction terms, and the transmission function of the drive flank.
        """
        if circuit.id in self._couplings:
            joint, transmission = self._couplings[circuit.id], self.sources[circuit.id].transmission
            if not isinstance(joint, PinMesh):
                # a coupling has no backlash, and its losses follow from its declared efficiency
                label, ways = f"coupling '{joint.coupling.name}'", joint.coupling.efficiency
                if transmission.at_once:
                    what, why = (
                        f"the dynamics of {label} cannot be simulated",
                        "an instantaneous step has no defined force",
                    )
                    fix = "give `over`, the angle of the driver during a step, or a law `between: straight`"
                    raise QuestionError(Problem(what, why, fix))
                declared = (1.0, 1.0) if ways is None else (float(ways.forward.base), float(ways.backward.base))
                front = tabled_angle(transmission)
                return front, front, efficiency_arms(transmission, *declared, label), transmission
            transmission = joint.transmission
            clearance = self.case.clearance.get(circuit.id, 0.0)
            if not clearance:
                front = tabled_angle(transmission)
                return front, front, pin_arms(transmission), transmission
            # with clearance the two sides of the slot are two flanks
            before, behind = SlackPin(transmission, clearance, -1), SlackPin(transmission, clearance, 1)
            return tabled_angle(before), tabled_angle(behind), pin_arms(transmission), before
        mesh = self._meshes[circuit.id]
        front = tabled_angle(mesh.transmission)
        back = front if mesh.verdict.backlash <= 0 else tabled_angle(mesh.coast)
        return front, back, tooth_arms(mesh), mesh.transmission

    def _senses(self, circuit: Circuit) -> tuple[int, int]:
        """Return 1 or -1 for the driver and for the driven side of a pair: the sense of forward rotation about the
        reference direction of parallel axes.
        """
        source = self.sources.get(circuit.id)
        # forwards is the sense in which the input turns; front flanks are those that drive in this sense
        way = self.problem.way
        forward = way * (source.forward if source else 1)
        return forward, way * (source.sense if source else (1 if circuit.a * circuit.b < 0 else -1))

    def _sides(self, circuit: Circuit) -> tuple[Form, Form]:
        """Return the speeds of the driver and of the driven side of a pair as linear forms in the coordinate speeds.
        Both speeds are relative to the carrier, and positive in the mean sense of rotation.
        """
        forward, sense = self._senses(circuit)
        path = self.motion._path(circuit.id)
        signs, names = self.problem.signs, self.problem.system.links
        own, mate, base, driven_base = (
            signs.get(names[at], 1) * self.speeds[at]
            for at in (path.driver, path.driven, path.carrier, path.driven_carrier)
        )
        return _sparse(forward * (own - base)), _sparse(sense * (mate - driven_base))

    def _constant_ratio_arms(self, circuit: Circuit, transmission: ExactRatio) -> Arms | None:
        ways = self._efficiencies[circuit.id]
        if ways is None:
            return None
        passed = float(ways.forward.base), float(ways.backward.base)
        # efficiencies are declared for the first wheel as driver; the driver of a coupling is its first link
        if circuit.kind == "gear" and self.problem.drivers[circuit.id].wheel != circuit.wheels[0]:
            passed = passed[1], passed[0]
        return efficiency_arms(transmission, *passed, f"pair '{circuit.id}'")

    # ----------------------------------------------------------------------------------------- other parts of the model

    def _bearings(self) -> Iterator[Bearing]:
        """Yield the bearings with dry friction. Bearings whose speeds are proportional are combined into one."""
        joined: dict[tuple[tuple[int, float], ...], list[tuple[str, float, float, float]]] = {}
        for link, (sliding, sticking) in self.case.bearing.items():
            radius = 0.0 if self.bearing_forces is None else self.train.links[link].friction_radius
            thrust = 0.0 if self.bearing_forces is None else self.bearing_forces.thrust.get(link, 0.0)
            sliding, sticking = sliding + thrust, sticking + thrust
            form = self._form(link, self.tree.borne_by(link))
            scale = float(np.max(np.abs(form), initial=0.0))
            if not scale or not (sticking or radius):
                continue
            first = form[np.argmax(np.abs(form) > 1e-12 * scale)]
            # bearings with proportional forms have one relative speed, so their friction adds up
            scale = float(first)
            key = tuple((at, round(value / scale, 12)) for at, value in _sparse(form).items())
            joined.setdefault(key, []).append((link, abs(scale) * sliding, abs(scale) * sticking, abs(scale) * radius))
        for key, parts in joined.items():
            links, radii = ", ".join(part[0] for part in parts), {part[0]: part[3] for part in parts if part[3]}
            yield Bearing(links, dict(key), sum(each[1] for each in parts), sum(each[2] for each in parts), radii)

    def _stops(self) -> Iterator[Stop]:
        escapement = self.train.escapement
        for link, (pitch, beat) in self.case.escapements.items():
            assert escapement is not None  # it is the only stop
            base = self.tree.reference(link, pallet_link(escapement, self.tree))
            way = -1 if self.problem.seen_ratio(link, base) * self.problem.way < 0 else 1
            restitution = self.case.restitution.get(link, 0.0)
            yield Stop(link, _sparse(way * self._form(link, base)), pitch, beat, restitution)

    def torque_of(self, loads: Mapping[str, float], drive: float) -> Floats:
        """Return the generalised torques on the coordinates [N m] due to torques on links and to the drive."""
        torque = drive * self._form(self.case.drive.link)
        for link, load in loads.items():
            torque += load * self._form(link)
        return torque

    @cached_property
    def model(self) -> ContactModel:
        """Contact model of the train for the time-stepping kernels."""
        drive = self.case.drive
        torque = self.torque_of(self.case.load, drive.torque)
        viscous = np.zeros((len(self.coordinates),) * 2)
        for link, drag in self.case.drag.items():
            form = self._form(link, self.tree.borne_by(link))
            viscous += drag * np.outer(form, form)
        springs: tuple[Spring, ...] = ()
        if drive.kind in ("spring", "hand"):
            rate = drive.rate if drive.kind == "hand" else 0.0
            springs = (Spring(drive.link, _sparse(self._form(drive.link)), drive.stiffness, drive.wound, rate),)
        typical = np.array([self.typical(link) for link in self.coordinates])
        given = dict(enumerate(self.prescribed.values()))
        bearings, forces = tuple(self._bearings()), self.bearing_forces
        senses = {circuit.id: self._senses(circuit) for circuit in self.contacts} if forces else {}
        return ContactModel(
            self.mass,
            viscous,
            torque,
            given,
            typical,
            tuple(self._pairs()),
            bearings,
            tuple(self._stops()),
            springs,
            None if forces is None else forces.arrays(bearings, senses, self.speeds),
        )


def _sparse(form: Floats) -> dict[int, float]:
    """Return the coefficients of a linear form that are not 0, by index of the coordinate."""
    scale = float(np.max(np.abs(form), initial=0.0))
    # smaller coefficients are rounding errors
    return {at: float(value) for at, value in enumerate(form) if abs(value) > 1e-13 * scale}
