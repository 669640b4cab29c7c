"""Contact model of a train for the time-stepping kernels: coordinates, contacts, bearings, stops and springs.

The coordinates describe the independent motions while all contacts are open. For each pair, two rows of coefficients
relate the forward speeds of its driver and of its driven side to the speeds of the coordinates.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.simulation.contacts.pair_tables import PairTables, TabledFunction, join_tables

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


Form = Mapping[int, float]
"""Linear form of the coordinates: a mapping from the index of a coordinate to its coefficient."""

_STIFF = 1e6  # inverse compliance of a contact between prescribed coordinates, relative to the inertia of the train


@dataclass(frozen=True)
class ContactPair:
    """Contact between two toothed wheels, or between a pin and its slot."""

    name: str
    driver: Form
    """Forward speed of the driver as a linear form of the coordinate speeds."""
    driven: Form
    """Forward speed of the driven side as a linear form of the coordinate speeds."""
    start: tuple[float, float]
    """Forward angles of the driver and of the driven side if all coordinates are 0 [rad]."""
    front: TabledFunction
    """Driven angle as a function of the driver angle, in contact on the drive flank [rad]."""
    back: TabledFunction
    """Driven angle as a function of the driver angle, in contact on the coast flank [rad]. For a pair without backlash,
    this is the same object as `front`.
    """
    rubbing: tuple[TabledFunction, TabledFunction, TabledFunction, TabledFunction] | None = None
    """Friction terms of the driver's lever arm, which is the driver's torque divided by the driven side's torque; None
    without friction.

    The terms are ordered as follows: front flank in forward and in backward rotation, then back flank in forward and in
    backward rotation.
    """
    restitution: float = 0.0
    """Coefficient of restitution of impacts in this contact [1]."""
    has_no_dwell: bool = False
    """True if the transmission function has no dwell, so that the driven side could also be the driver."""

    @property
    def two_sided(self) -> bool:
        """True if the pair has no backlash."""
        return self.front is self.back

    def opening_row(self, n: int, ratio: float) -> Floats:
        """Return the coefficients by which n coordinate speeds give the separation speed of the pair's flanks, for one
        speed ratio.
        """
        return _dense(self.driven, n) - ratio * _dense(self.driver, n)


@dataclass(frozen=True)
class Bearing:
    """Dry friction in a bearing: sliding torque and maximum sticking torque [N m], which oppose the relative speed."""

    name: str
    speed: Form
    sliding: float
    sticking: float
    radii: Mapping[str, float] = field(default_factory=dict)
    """Radius of the friction circle [m] for each link whose friction also depends on the load, keyed by link."""


class LoadedBearings(NamedTuple):
    """Forces of pairs on bearings with load-dependent friction, in SI units."""

    pair: Ints
    """Index of the pair of each force."""
    forces: Floats
    """Torque on the carrier per unit torque on the driver and per unit torque on the driven side, and the components
    `along` and `apart` of `AxisForce` for a unit torque on the carrier, shape (forces, 8).
    """
    turn: Floats
    """Speed of the carrier of each force per unit speed of each coordinate, shape (forces, n)."""
    about: Floats
    """Direction of the axis of the carrier of each force, shape (forces, 3)."""
    bearing: Ints
    """Index of the bearing of each support. `share`, shape (supports, forces), contains the share of each force on the
    support.
    """
    share: Floats
    supports: Floats
    """Constant force on each support, direction of its axis and radius of its friction circle, shape (supports, 7)."""

    @classmethod
    def none(cls, n: int) -> LoadedBearings:
        """Return empty arrays for a train with `n` coordinates in which no friction depends on loads."""
        no = np.zeros(0, dtype=np.int64)
        return cls(no, np.zeros((0, 8)), np.zeros((0, n)), np.zeros((0, 3)), no, np.zeros((0, 0)), np.zeros((0, 7)))


@dataclass(frozen=True)
class Stop:
    """Upper limit of an angle, as in an escapement. The limit increases by `pitch` [rad] after each `beat` [s]."""

    name: str
    angle: Form
    pitch: float
    beat: float
    restitution: float = 0.0


@dataclass(frozen=True)
class Spring:
    """Spring that exerts the torque stiffness (rest + rate t - angle) at time t, where `angle` is a linear form of the
    coordinates.

    The units of `stiffness`, `rest` and `rate` are N m/rad, rad and rad/s.
    """

    name: str
    angle: Form
    stiffness: float
    rest: float = 0.0
    rate: float = 0.0


@dataclass(frozen=True)
class ContactModel:
    """Contact model of a train for time-domain simulation: matrices, torques, contacts, bearings, stops and springs."""

    mass: Floats
    """Mass matrix of the coordinates [kg m2]."""
    viscous: Floats
    """Viscous damping matrix of the coordinates [N m s]."""
    torque: Floats
    """Constant torques on the coordinates [N m]."""
    given: Mapping[int, float]
    """Prescribed speeds of coordinates [rad/s], keyed by the index of the coordinate."""
    typical: Floats
    """Speeds of all coordinates in the mean motion, which are used as scales [rad/s]."""
    pairs: Sequence[ContactPair] = ()
    bearings: Sequence[Bearing] = ()
    stops: Sequence[Stop] = ()
    springs: Sequence[Spring] = ()
    loaded: LoadedBearings | None = None
    """Forces on the bearings whose friction depends on these forces; None if there are no such bearings."""
    start: Floats | None = None

    @property
    def fall_times(self) -> list[float]:
        """Time that each link with stops, such as an escape wheel, needs from one stop to the next [s].

        The train is assumed to start from rest under the driving torque, without resistance, and to move in its mean
        ratios.
        """
        # generalised torque and inertia of the mean motion, which has one degree of freedom
        torque = float(self.typical @ self.torque)
        for spring in self.springs:
            torque += spring.stiffness * spring.rest * sum(self.typical[at] * c for at, c in spring.angle.items())
        heavy = float(self.typical @ self.mass @ self.typical)
        found = []
        for stop in self.stops:
            speed = sum(self.typical[at] * c for at, c in stop.angle.items())
            if torque > 0 and speed:
                # constant acceleration from rest: pitch = |speed| (torque/heavy) t^2 / 2
                found.append(float(np.sqrt(2 * stop.pitch * heavy / (torque * abs(speed)))))
        return found

    @cached_property
    def transmissions(self) -> PairTables:
        """Tables of the transmission functions of all pairs."""
        return join_tables(self._functions[0])

    @cached_property
    def _functions(self) -> tuple[list[TabledFunction], list[list[int]], list[list[int]]]:
        """All different tabulated functions, and the indices of each pair's functions among them: two transmission
        functions (front and back flanks), and four functions of tooth friction (-1 without friction).
        """
        # functions shared by several pairs are tabulated once, by identity
        known: dict[int, int] = {}
        functions: list[TabledFunction] = []

        def number(function: TabledFunction) -> int:
            if id(function) not in known:
                known[id(function)] = len(functions)
                functions.append(function)
            return known[id(function)]

        transmissions = [[number(pair.front), number(pair.back)] for pair in self.pairs]
        rubbing = [[-1] * 4 if pair.rubbing is None else list(map(number, pair.rubbing)) for pair in self.pairs]
        return functions, transmissions, rubbing

    def system(self, step: float, yields: ToothCompliance | None = None) -> ContactSystem:
        """Return the arrays of the model that the kernels need for the time step `step` [s].

        yields   stiffness and damping of compliant teeth, for the midpoint rule; None for rigid teeth
        """
        n, coordinates = len(self.torque), range(len(self.torque))
        # implicit in drag and springs, so that stiff ones remain stable; the midpoint rule weighs them by h/2 and h^2/4
        past = step if yields is None else step / 2
        matrix = self.mass + past * self.viscous
        for spring in self.springs:
            c = _dense(spring.angle, n)
            matrix = matrix + past**2 * spring.stiffness * np.outer(c, c)
        _, transmissions, rubbing = self._functions
        if yields is None:
            # during a dwell the driver's speed has no effect
            ratios = [pair.front.slope if pair.has_no_dwell else 0.0 for pair in self.pairs]
            contacts = [pair.opening_row(n, ratio) for pair, ratio in zip(self.pairs, ratios, strict=True)]
            compliance = [self._compliance(row) for row in contacts]
        else:
            compliance = (1 / (step**2 / 4 * yields.stiffness + step / 2 * yields.damping)).tolist()
        compliance += [self._compliance(_dense(stop.angle, n)) for stop in self.stops]
        # a stop has the row of a pair whose driver does not move
        rows: list[tuple[Form, Form]] = [(pair.driver, pair.driven) for pair in self.pairs]
        rows += [({}, stop.angle) for stop in self.stops]
        driver, driven = (
            _sparse([{at: row[side].get(at, 0.0) for at in (*row[1], *row[0])} for row in rows]) for side in (0, 1)
        )
        return ContactSystem(
            np.ascontiguousarray(self.mass, dtype=np.float64),
            np.ascontiguousarray(self.viscous, dtype=np.float64),
            np.ascontiguousarray(matrix, dtype=np.float64),
            np.array(self.torque, dtype=np.float64),
            np.array([each in self.given for each in coordinates], dtype=np.int64),
            *driver,
            driven[2],
            np.array([pair.start[0] for pair in self.pairs], dtype=np.float64),
            np.array([pair.start[1] for pair in self.pairs], dtype=np.float64),
            np.array([*(pair.two_sided for pair in self.pairs), *(False for _ in self.stops)], dtype=np.int64),
            np.array([pair.restitution for pair in self.pairs], dtype=np.float64),
            np.array(transmissions, dtype=np.int64).reshape(-1, 2),
            np.array(rubbing, dtype=np.int64).reshape(-1, 4),
            np.array(compliance, dtype=np.float64),
            *_sparse([each.speed for each in self.bearings]),
            np.array([each.sliding for each in self.bearings], dtype=np.float64),
            np.array([each.sticking for each in self.bearings], dtype=np.float64),
            np.array([each.pitch for each in self.stops], dtype=np.float64),
            np.array([each.beat for each in self.stops], dtype=np.float64),
            np.array([each.restitution for each in self.stops], dtype=np.float64),
            *_sparse([each.angle for each in self.springs]),
            np.array([each.stiffness for each in self.springs], dtype=np.float64),
            np.array([each.rest for each in self.springs], dtype=np.float64),
            np.array([each.rate for each in self.springs], dtype=np.float64),
            self.loaded or LoadedBearings.none(n),
        )

    def _compliance(self, row: Floats) -> float:
        """Return the compliance of a contact between rigid flanks [1/(kg m2)]. It is 0, or a small value if all
        coordinates that move the contact are prescribed, so that the equations are regular.
        """
        if any(value and at not in self.given for at, value in enumerate(row)):
            return 0.0
        return 1 / (_STIFF * (float(np.trace(self.mass)) or 1.0))


def _dense(form: Form, n: int) -> Floats:
    row = np.zeros(n)
    for at, value in form.items():
        row[at] = value
    return row


def _sparse(rows: Sequence[Mapping[int, float]]) -> tuple[Ints, Ints, Floats]:
    """Return sparse rows in compressed row format: first entry of each row, column and value of each entry."""
    at = np.cumsum([0, *(len(row) for row in rows)]).astype(np.int64)
    of = np.array([each for row in rows for each in row], dtype=np.int64)
    return at, of, np.array([value for row in rows for value in row.values()], dtype=np.float64)


# --------------------------------------------------------------------------------------------------- arrays for kernels


class ContactSystem(NamedTuple):
    """Arrays that describe the coordinates and contacts of a train, in SI units.

    The rows of pairs are followed by the rows of stops.

    mass, viscous  mass matrix M and damping matrix D, shape (n, n)
    matrix         M + h D + h^2 K with the time step h and the stiffness matrix K, shape (n, n)
    torque         constant torque on each coordinate
    given          1 if the speed of a coordinate is prescribed, 0 if it is free
    pair_of        index of the coordinate to which each coefficient of a row refers
    pair_driver, pair_driven     coefficients of the speeds of the driver (0 for a stop) and of the driven side
    start_driver, start_driven   angles of the driver and of the driven side if all coordinates are 0
    two_sided      1 for pins without clearance and gears without backlash, 0 for stops and other pairs
    tables         index of the transmission function of each flank
    rubbing        indices of the friction terms of the front and of the back flank, each for both senses of rotation
    compliance     compliance of each row [1/(kg m2)]; 0 for rigid teeth
    bearing_*      rows with the relative speeds in bearings, with the torques of sliding and sticking friction
    stop_*         rows whose angle is limited to (1 + floor(t/beat)) pitch at the time t
    spring_*       rows with the torque stiffness (rest + rate t - angle) at the time t
    """

    mass: Floats
    viscous: Floats
    matrix: Floats
    torque: Floats
    given: Ints
    pair_at: Ints
    pair_of: Ints
    pair_driver: Floats
    pair_driven: Floats
    start_driver: Floats
    start_driven: Floats
    two_sided: Ints
    restitution: Floats
    tables: Ints
    rubbing: Ints
    compliance: Floats
    bearing_at: Ints
    bearing_of: Ints
    bearing_c: Floats
    sliding: Floats
    sticking: Floats
    stop_pitch: Floats
    stop_beat: Floats
    stop_restitution: Floats
    spring_at: Ints
    spring_of: Ints
    spring_c: Floats
    spring_stiffness: Floats
    spring_rest: Floats
    spring_rate: Floats
    loaded: LoadedBearings


class ToothCompliance(NamedTuple):
    """Stiffness [N m/rad] and damping [N m s/rad] of each pair about the axis of its driven side."""

    stiffness: Floats
    damping: Floats
