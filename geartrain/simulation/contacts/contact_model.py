"""Model of a train for the kernels: coordinates, contacts, bearings, stops and springs, with an elimination order.

The coordinates are the independent motions while no contact touches. A pair has two rows over the coordinates: the
speeds of its driver and of its driven side in forward angles. In the solved order each touching pair determines one
coordinate from earlier coordinates; this coordinate appears on only one side of the pair. Prescribed coordinates come
first.
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
"""Linear form of the coordinates: coefficient by index of the coordinate."""

# a row that determines no coordinate is regularised: its inverse compliance exceeds the inertia of all that turns
# with it by the first factor, and that of its own coordinates by at most the second
_STIFF, _STIFFEST = 1e6, 1e9


@dataclass(frozen=True)
class ContactPair:
    """Contact between two toothed wheels, or between a pin and its slot."""

    name: str
    driver: Form
    """Forward speed of the driver as a linear form of the coordinates' speeds."""
    driven: Form
    """Forward speed of the driven side as a linear form of the coordinates' speeds."""
    start: tuple[float, float]
    """Forward angles of driver and driven side where all coordinates are 0 [rad]."""
    front: TabledFunction
    """Driven angle as a function of the driver's angle, in contact on the drive flank [rad]."""
    back: TabledFunction
    """Driven angle as a function of the driver's angle, in contact on the coast flank [rad]; for a pair without
    backlash it is
    the same object as `front`.
    """
    rubbing: tuple[TabledFunction, TabledFunction, TabledFunction, TabledFunction] | None = None
    """Friction terms of the driver's lever arm, which is its torque divided by the driven side's torque.

    In the order: front flank turning forward and backward, back flank turning forward and backward. None without
    friction.
    """
    restitution: float = 0.0
    """Coefficient of restitution."""
    has_no_dwell: bool = False
    """True if the transmission function has no dwell: the driven side could also drive."""

    @property
    def two_sided(self) -> bool:
        """True if the pair has no backlash."""
        return self.front is self.back

    @property
    def row(self) -> tuple[int, ...]:
        """Indices of the coordinates of both sides."""
        return tuple(dict.fromkeys((*self.driven, *self.driver)))

    def could_determine(self, coordinate: int) -> bool:
        """Return True if exactly one side contains the coordinate, with a coefficient that never vanishes."""
        driven, driver = bool(self.driven.get(coordinate)), bool(self.driver.get(coordinate))
        return driven != driver and (driven or self.has_no_dwell)


@dataclass(frozen=True)
class Bearing:
    """Dry friction against a relative speed: sliding torque and maximum sticking torque [N m]."""

    name: str
    speed: Form
    sliding: float
    sticking: float


@dataclass(frozen=True)
class Stop:
    """Upper limit of an angle that increases by `pitch` [rad] after each `beat` [s], as in an escapement."""

    name: str
    angle: Form
    pitch: float
    beat: float
    restitution: float = 0.0


@dataclass(frozen=True)
class Spring:
    """Spring that exerts the torque stiffness (rest + rate t - angle) on a linear form of the coordinates [N m/rad,
    rad,
    rad/s].
    """

    name: str
    angle: Form
    stiffness: float
    rest: float = 0.0
    rate: float = 0.0


class SolvedOrder(NamedTuple):
    """Order in which the kernels eliminate the coordinates, and the pair that determines each coordinate.

    `owner` is the index of the pair that determines each coordinate, -1 for none.
    """

    coordinates: tuple[int, ...]
    owner: tuple[int, ...]


@dataclass(frozen=True)
class ContactModel:
    """Contact model of a train for time-domain simulation: matrices, torques, contacts, bearings, stops and springs."""

    mass: Floats
    """Mass matrix over the coordinates [kg m2]."""
    viscous: Floats
    """Viscous damping matrix over the coordinates [N m s]."""
    torque: Floats
    """Constant torques on the coordinates [N m]."""
    given: Mapping[int, float]
    """Prescribed speeds by coordinate [rad/s]."""
    typical: Floats
    """Speeds of all coordinates in mean motion, used as scales [rad/s]."""
    pairs: Sequence[ContactPair] = ()
    bearings: Sequence[Bearing] = ()
    stops: Sequence[Stop] = ()
    springs: Sequence[Spring] = ()
    start: Floats | None = field(default=None)

    @cached_property
    def order(self) -> SolvedOrder:
        """Order in which the coordinates are eliminated, and the pair that determines each coordinate.

        A pair whose row has one undetermined coordinate determines it; if no pair has, one coordinate is left free.
        """
        # prescribed coordinates first, because nothing determines them
        order = list(self.given)
        owner = [-1] * len(order)
        left = list(range(len(self.pairs)))
        while left:
            found = False
            for m in list(left):
                unknown = [each for each in self.pairs[m].row if each not in order]
                if len(unknown) > 1:
                    continue
                left.remove(m)
                if unknown and self.pairs[m].could_determine(unknown[0]):
                    order.append(unknown[0])
                    owner.append(m)
                    found = True
            # no pair has a single unknown: free a coordinate, preferably one that no pair determines
            if not found and left:
                driven = {each for m in left for each in self.pairs[m].row if self.pairs[m].could_determine(each)}
                rows = [each for m in left for each in self.pairs[m].row if each not in order]
                order.append(next((each for each in rows if each not in driven), rows[0]))
                owner.append(-1)
        # coordinates that appear in no pair
        rest = [each for each in range(len(self.torque)) if each not in order]
        order += rest
        owner += [-1] * len(rest)
        return SolvedOrder(tuple(order), tuple(owner))

    @property
    def fall_times(self) -> list[float]:
        """Time that each stopped link takes from one stop to the next [s], with all coordinates in their mean ratios.

        It follows from the driving torque at the start, without resistance.
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
        """Distinct tabulated functions, and for each pair the indices of its transmission and friction functions."""
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
        """Return the arrays of the kernels for the time step `step` [s].

        yields   stiffness and damping of compliant teeth, for the midpoint rule, in which every pair is a compliant row
                 and determines no coordinate; None for rigid teeth
        """
        order, n = self.order, len(self.torque)
        place = {each: at for at, each in enumerate(order.coordinates)}
        mass, viscous = (matrix[np.ix_(order.coordinates, order.coordinates)] for matrix in (self.mass, self.viscous))
        # implicit in drag and springs, so that stiff ones remain stable; the midpoint rule weighs them by h/2 and h^2/4
        past = step if yields is None else step / 2
        matrix = mass + past * viscous
        for spring in self.springs:
            c = np.zeros(n)
            for each, value in spring.angle.items():
                c[place[each]] = value
            matrix = matrix + past**2 * spring.stiffness * np.outer(c, c)
        _, transmissions, rubbing = self._functions
        if yields is None:
            stiff = [0.0 if m in order.owner else self._stiffness(_joined(pair)) for m, pair in enumerate(self.pairs)]
        else:
            stiff = (step**2 / 4 * yields.stiffness + step / 2 * yields.damping).tolist()
        return ContactSystem(
            np.ascontiguousarray(mass),
            np.ascontiguousarray(viscous),
            np.ascontiguousarray(matrix),
            np.array([self.torque[each] for each in order.coordinates], dtype=np.float64),
            np.array([each in self.given for each in order.coordinates], dtype=np.int64),
            np.array(order.owner if yields is None else [-1] * n, dtype=np.int64),
            *self._pair_rows(place),
            np.array([pair.start[0] for pair in self.pairs], dtype=np.float64),
            np.array([pair.start[1] for pair in self.pairs], dtype=np.float64),
            np.array([pair.two_sided for pair in self.pairs], dtype=np.int64),
            np.array([pair.restitution for pair in self.pairs], dtype=np.float64),
            np.array(transmissions, dtype=np.int64).reshape(-1, 2),
            np.array(rubbing, dtype=np.int64).reshape(-1, 4),
            np.array(stiff, dtype=np.float64),
            *_sparse([_placed(each.speed, place) for each in self.bearings]),
            np.array([each.sliding for each in self.bearings], dtype=np.float64),
            np.array([each.sticking for each in self.bearings], dtype=np.float64),
            *_sparse([_placed(each.angle, place) for each in self.stops]),
            np.zeros(len(self.stops)),
            np.array([each.pitch for each in self.stops], dtype=np.float64),
            np.array([each.beat for each in self.stops], dtype=np.float64),
            np.array([each.restitution for each in self.stops], dtype=np.float64),
            np.array([self._stiffness(each.angle) for each in self.stops], dtype=np.float64),
            *_sparse([_placed(each.angle, place) for each in self.springs]),
            np.array([each.stiffness for each in self.springs], dtype=np.float64),
            np.array([each.rest for each in self.springs], dtype=np.float64),
            np.array([each.rate for each in self.springs], dtype=np.float64),
        )

    def _pair_rows(self, place: Mapping[int, int]) -> tuple[Ints, Ints, Floats, Floats]:
        """Return the sparse rows of the pairs, with the determined coordinate of each first."""
        owner = {m: d for d, m in enumerate(self.order.owner) if m >= 0}
        rows = []
        for m, pair in enumerate(self.pairs):
            # a stable sort, so that the others keep their order
            names = sorted(pair.row, key=lambda each: place[each] != owner.get(m))
            rows.append({place[each]: (pair.driver.get(each, 0.0), pair.driven.get(each, 0.0)) for each in names})
        sides = [_sparse([{each: own[side] for each, own in row.items()} for row in rows]) for side in (0, 1)]
        return *sides[0], sides[1][2]

    def _stiffness(self, form: Form) -> float:
        """Return the regularising inverse compliance of a row [kg m2], far above the inertia of the links that turn
        with it.
        """
        row = np.zeros(len(self.torque))
        for each, value in form.items():
            row[each] = value
        heavy = float(self.typical @ self.mass @ self.typical)
        speed = float(row @ self.typical)
        # a prescribed coordinate has infinite inertia, so it does not contribute
        free = [at for at, value in form.items() if value and at not in self.given]
        with np.errstate(divide="ignore"):
            own = float(1 / np.sum(row[free] ** 2 / np.diag(self.mass)[free])) if free else heavy
        return min(_STIFF * max(own, heavy / speed**2 if speed else 0.0), _STIFFEST * own)


def _joined(pair: ContactPair) -> Form:
    return {each: pair.driven.get(each, 0.0) or pair.driver.get(each, 0.0) for each in pair.row}


def _placed(form: Form, place: Mapping[int, int]) -> dict[int, float]:
    return {place[each]: float(value) for each, value in form.items()}


def _sparse(rows: Sequence[Mapping[int, float]]) -> tuple[Ints, Ints, Floats]:
    """Return rows in compressed sparse row format: row starts, columns, coefficients."""
    at = np.cumsum([0, *(len(row) for row in rows)]).astype(np.int64)
    of = np.array([each for row in rows for each in row], dtype=np.int64)
    return at, of, np.array([value for row in rows for value in row.values()], dtype=np.float64)


# --------------------------------------------------------------------------------------------------- arrays for kernels


class ContactSystem(NamedTuple):
    """Arrays of a train with its coordinates and contacts, in SI units.

    mass, viscous, matrix   M, D, and M + h D + h^2 K, (n, n)
    torque                  constant torque on each coordinate
    given                   1 if the speed is prescribed
    owner                   pair that determines a coordinate while it is in contact; -1 for none
    pair_of                 coordinates of a pair's row; `pair_driver`, `pair_driven`: coefficients of the speeds of
                            both sides
    start_driver, start_driven   angles of both sides where all coordinates are 0
    two_sided               1 for pins without clearance and gears without backlash
    tables, rubbing         functions of both flanks; friction terms of the driver's arm, (front, back) x (forward,
                            back)
    stiff                   inverse compliance of the rows of pairs that determine no coordinate
    bearing_*               rows of relative speeds in bearings, with torques of sliding and sticking
    stop_*                  rows limited to first + (1 + floor(t/beat)) pitch
    spring_*                rows with the torque stiffness (rest + rate t - angle)
    """

    mass: Floats
    viscous: Floats
    matrix: Floats
    torque: Floats
    given: Ints
    owner: Ints
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
    stiff: Floats
    bearing_at: Ints
    bearing_of: Ints
    bearing_c: Floats
    sliding: Floats
    sticking: Floats
    stop_at: Ints
    stop_of: Ints
    stop_c: Floats
    stop_first: Floats
    stop_pitch: Floats
    stop_beat: Floats
    stop_restitution: Floats
    stop_stiff: Floats
    spring_at: Ints
    spring_of: Ints
    spring_c: Floats
    spring_stiffness: Floats
    spring_rest: Floats
    spring_rate: Floats


class ToothCompliance(NamedTuple):
    """Stiffness [N m/rad] and damping [N m s/rad] of each pair about its driven side."""

    stiffness: Floats
    damping: Floats
