"""Torques that each pair must transmit to keep its flanks in contact during motion: docs/dynamics.md, equations (1) to
(6).

By the principle of virtual work, the flanks of a pair carry the torque D(x) + V(x) w + A(x) w^2 at the position x and
the input speed w, with loads and dry friction of bearings in D, viscous drag in V, and inertia in A. The separation
speed is the minimum w > 0, over all positions, at which it vanishes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import inf
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.error_composition import InputPhase
from geartrain.dynamics.motion.motion_model import Motion
from geartrain.dynamics.motion.pair_errors import PairErrors
from geartrain.errors import Problem, QuestionError
from geartrain.teeth.transmission_table import CellTable, fit, folded_kinks

if TYPE_CHECKING:
    from geartrain.dynamics.motion.error_composition import PairErrorSource
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.kinematics.circuits import Circuit, Tree
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.numerics.quantity import Quantity
    from geartrain.simulation.contacts.link_inertia import LinkInertia
    from geartrain.simulation.contacts.pair_tables import TabledFunction
    from geartrain.teeth.transmission import TransmissionFunction
    from geartrain.train import StateCase, Train


_SLOPE = 1e-12  # tolerance, relative to the mean ratio, of tables of the speed that are differentiated
# degree of these tables: the derivative loses one order, and few cells must reach the tolerance
_DEGREE = 9
_LEAP = 1e-7  # relative to the larger of the input's and the link's maximum speed: smaller jumps are rounding
_NUMBERS = 1 << 22  # maximum number of matrix entries in one batch


class CarriedTorques(NamedTuple):
    """Terms D [N m], V [N m s] and A [N m s2] of the torque D + V w + A w^2 that each pair must transmit in the forward
    direction.

    Here w is the input speed [rad/s]. Arrays have shape (pairs, n).
    """

    constant: Floats
    viscous: Floats
    inertial: Floats


class _State(NamedTuple):
    """Speeds and accelerations of all links at n positions for an input speed of 1 rad/s, with the matrix and the
    virtual speeds from which the torques of pairs are computed.
    """

    speed: Floats
    acceleration: Floats
    inverse: Floats
    """Inverse of the matrix that couples the transmission errors of the pairs, with friction in each driver's lever
    arm, shape (n, pairs, pairs).

    The inverse is used to compute virtual work.
    """
    virtual: Floats
    """Virtual speeds of the links, computed with friction in each driver's lever arm, shape (links, n)."""


class InertialContacts:
    """Computation of the torques that the pairs of a moving train must transmit at given positions."""

    def __init__(
        self,
        moving: MotionProblem,
        acting: InertialLoads,
        rubbing: Mapping[str, tuple[TabledFunction, TabledFunction]] | None = None,
    ) -> None:
        self.moving, self.acting, self.rubbing = moving, acting, rubbing or {}
        outputs = {link: (link, moving.frame) for link in moving.system.links}
        self.motion = Motion(moving, outputs)
        self.sources: tuple[PairErrorSource, ...] = self.motion._forward.sources

    # ------------------------------------------------------------------------------------------------------- components

    @property
    def pairs(self) -> tuple[str, ...]:
        """Names of all pairs and couplings."""
        return self.motion._propagation.pairs

    @cached_property
    def _response(self) -> Floats:
        """Response matrix R of link angles to transmission errors of pairs [rad/rad], shape (links, pairs)."""
        return self.motion._propagation.response

    def _inverse(self, slope: Floats) -> Floats:
        """Return the inverse of the matrix J = I - diag(slope) G at n positions, shape (n, pairs, pairs). G contains
        the change of each driver's angle per unit transmission error of each pair.
        """
        found = np.tile(np.eye(len(self.pairs)), (slope.shape[1], 1, 1))
        found[:, [source.pair for source in self.sources]] -= slope.T[:, :, None] * self.motion._forward.gains
        return np.asarray(np.linalg.inv(found))

    @cached_property
    def _slopes(self) -> tuple[CellTable, ...]:
        """Tables of the derivative of each pair's speed ratio with respect to its driver angle [1/rad]."""
        return tuple(speed_slope(source.transmission) for source in self.sources)

    @cached_property
    def _senses(self) -> Floats:
        """Sense of rotation of the driven side of each pair in the mean motion: 1 forwards, -1 backwards."""
        circuits: dict[str, Circuit] = {circuit.id: circuit for circuit in self.moving.circuits}
        errors = PairErrors(self.moving, ())
        return np.array([errors.sense(circuits[name]) for name in self.pairs], dtype=float)

    def _by_link(self, values: Mapping[str, float]) -> Floats:
        return np.array([values.get(link, 0.0) for link in self.moving.system.links], dtype=float)

    @cached_property
    def _joints(self) -> tuple[Ints, Floats]:
        """Index of the link that carries the axis of each link, and 1 or -1 if the axes of these two links have the
        same or opposite directions.
        """
        at = {link: number for number, link in enumerate(self.moving.system.links)}
        bearers = [self.acting.bearer.get(link, self.moving.frame) for link in at]
        signs = self.moving.signs
        senses = [signs.get(link, 1) * signs.get(bearer, 1) for link, bearer in zip(at, bearers, strict=True)]
        return np.array([at[bearer] for bearer in bearers]), np.array(senses, dtype=float)

    # ---------------------------------------------------------------------------------------------- values at positions

    def _state(self, turns: Floats) -> _State:
        composition = self.motion._forward
        found = self.motion.at(turns)
        offsets = np.array(composition.offsets or (0.0,) * len(self.motion.outputs))
        error = found.error - offsets[:, None]
        means = np.array([float(self.moving.ratio(link)) for link in self.moving.system.links])
        phase = InputPhase(turns)
        slope = np.zeros((len(self.sources), len(turns)))  # sense (tau - mean)
        arm = np.zeros((len(self.sources), len(turns)))
        kick = np.zeros((len(self.pairs), len(turns)))
        pulled = np.zeros((len(self.pairs), len(turns)))
        for row, source in enumerate(self.sources):
            S = composition.driver_angle(source, phase, error)
            turning = source.mean + sum(sign * found.rate[link] for link, sign in composition.turned_by(source))
            slope[row] = source.sense * (source.transmission.speed(S) - float(source.transmission.ratio))
            # second derivative of the error at constant speed of the driver: (d tau/dS) S'^2
            kick[source.pair] = source.sense * self._slopes[row](S) * turning**2
            arm[row] = slope[row]
            if source.id in self.rubbing:
                ahead, back = self.rubbing[source.id]
                arm[row] += source.sense * np.where(turning >= 0, ahead(S), back(S))
            pulled[source.pair] = arm[row] * source.mean
        inverse = self._inverse(slope)
        acceleration = self._response @ np.einsum("nij,jn->in", inverse, kick)
        speed = means[:, None] + found.rate
        virtual = speed
        if self.rubbing:
            inverse = self._inverse(arm)
            virtual = means[:, None] + self._response @ np.einsum("nij,jn->in", inverse, pulled)
        return _State(speed, acceleration, inverse, virtual)

    def torques(self, turns: Floats) -> CarriedTorques:
        """Return the torque terms of all pairs at positions of the input [revolutions]."""
        # batches bound the memory of the dense matrices
        size = max(64, _NUMBERS // (len(self.pairs) ** 2 + 4 * len(self.moving.system.links)))
        parts = [self._torques(turns[at : at + size]) for at in range(0, len(turns), size)]
        return CarriedTorques(*(np.concatenate(each, axis=1) for each in zip(*parts, strict=True)))

    def _torques(self, turns: Floats) -> CarriedTorques:
        state, (bearer, sense) = self._state(turns), self._joints
        relative = state.speed - sense[:, None] * state.speed[bearer]
        forces = []
        for by_link in (
            self._by_link(self.acting.friction)[:, None] * np.sign(relative),
            self._by_link(self.acting.drag)[:, None] * relative,
        ):
            force = by_link.copy()
            np.add.at(force, bearer, -sense[:, None] * by_link)
            forces.append(force)
        forces[0] -= self.moving.way * self._by_link(self.acting.load)[:, None]
        forces.append(self._by_link(self.acting.inertia)[:, None] * state.acceleration)
        return CarriedTorques(*self._carried(state, forces))

    def _carried(self, state: _State, forces: Sequence[Floats]) -> Iterator[Floats]:
        """Yield the torque that each pair transmits, shape (pairs, n), for each array of torques on the links in
        `forces`.
        """
        for requested in forces:
            force = self._without_crank_power(requested, state.virtual)
            yield self._senses[:, None] * np.einsum("nji,jn->in", state.inverse, self._response.T @ force)

    def _without_crank_power(self, requested: Floats, speed: Floats) -> Floats:
        """Return the torques on the links, to which a torque on the crank is added so that their total power at the
        link speeds `speed` is 0.
        """
        # a prescribed input absorbs any torque, so no correction is needed
        if self.acting.crank is None:
            return requested
        crank = self.moving.system.links.index(self.acting.crank)
        force = requested.copy()
        # the crank torque follows from zero total virtual power
        force[crank] -= (requested * speed).sum(axis=0) / speed[crank]
        return force

    def rates(self, turns: Floats) -> Floats:
        """Return the input speed at which the flanks of a pair separate [rad/s], for each pair at each position, shape
        (pairs, n).
        """
        return minimum_rate(*self.torques(turns))

    def impulses(self, kinks: Floats, width: float) -> Floats:
        """Return the impulse of each pair at kinks of the transmission functions, per unit of input speed [N m s2].

        Pairs with a negative impulse separate at any input speed. The impulse is 0 at positions where no speed ratio
        jumps.

        width   distance of the evaluated positions from a kink [revolutions of the input]
        """
        before, after = self._state(kinks - width), self._state(kinks + width)
        jump = after.speed - before.speed
        scale = np.maximum(1.0, np.abs(after.speed).max(axis=1, initial=0.0))[:, None]
        # rounding of speeds must not count as an impact
        jump[np.abs(jump) <= _LEAP * scale] = 0.0
        (found,) = self._carried(after, [self._by_link(self.acting.inertia)[:, None] * jump])
        return found


def minimum_rate(D: Floats, V: Floats, A: Floats) -> Floats:
    """Return the minimum input speed w >= 0 [rad/s] above which the torque D + V w + A w^2 becomes negative.

    The result is infinite if the torque is never negative.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(V * V - 4 * D * A)  # NaN if it never vanishes
        q = -(V + np.copysign(root, V)) / 2  # the stable quadratic formula: neither the sum nor the quotients cancel
        first, second = q / A, D / q
    roots = np.stack([np.where(each > 0, each, inf) for each in (first, second)]).min(axis=0)
    starts = (D < 0) | ((D == 0) & ((V < 0) | ((V == 0) & (A < 0))))
    # at D = 0 the torque becomes negative beyond a positive root only if A < 0
    return np.where(starts, 0.0, np.where((D == 0) & (A >= 0), inf, roots))


def speed_slope(transmission: TransmissionFunction) -> CellTable:
    """Return a table of the derivative of the speed ratio tau with respect to the driver angle S [1/rad].

    The table is computed from a table of tau.
    """
    maximum = max(abs(each) for each in transmission.speed_range())
    return fit(
        transmission.speed, transmission.period, folded_kinks(transmission), _SLOPE * max(maximum, 1.0), _DEGREE
    ).derivative()


# ------------------------------------------------------------------------------------------------------ forces on links


@dataclass(frozen=True)
class InertialLoads:
    """Inertia, external torques and friction of each link about its own axis, in SI units.

    The mappings are keyed by link. Torques that pairs transmit are not included.
    """

    inertia: Mapping[str, float]
    """Moment of inertia of each link [kg m2], including the planets that it carries."""
    load: Mapping[str, float]
    """Constant external torque on each link [N m], positive about the link's axis."""
    friction: Mapping[str, float]
    """Dry friction torque in the bearing of each link while it turns [N m], 0 or more.

    `drag` contains the viscous coefficients [N m s].
    """
    drag: Mapping[str, float]
    bearer: Mapping[str, str]
    """Name of the link that bears each link."""
    crank: str | None = None
    """Name of the link whose torque keeps the input turning uniformly; None if the input itself is driven."""


def find_inertial_loads(
    train: Train, case: StateCase, tree: Tree, inertias: Sequence[LinkInertia], speeds: Mapping[str, Fraction]
) -> InertialLoads:
    """Return the loads of one state. Raises `QuestionError` if no link has an inertia, or if a torque has no unit.

    speeds   mean speeds of the links, which give the sense in which a driving weight or torque acts
    """
    if not any(each.value for each in inertias):
        what = f"no link of '{train.name}' has a moment of inertia"
        fix = "give links an `inertia`, such as `inertia: 30 kg mm2`, or wheels `density`, `thickness` and `module`"
        raise QuestionError(Problem(what, "teeth separate at a speed that depends on inertia", fix))
    turning = {link: part for link, part in train.links.items() if link != train.frame}
    load, friction = _torques(train, case)
    for key, torques in (("load", load), ("bearing", friction)):
        for link, torque in torques.items():
            if _is_plain(torque):
                what = f"the {key} torque of '{link}', {torque}, has no unit"
                why = "torques are compared with inertias in kg m2"
                raise QuestionError(Problem(what, why, f"for example, write '{torque} N m'"))
    loads = {link: torque.si for link, torque in load.items()}
    driven = None if case.drive is None else case.drive.steady_torque
    # a torque on a prescribed input does no virtual work
    if driven is not None and train.crank is not None and train.crank not in case.inputs:
        way = -1 if speeds[train.crank] < 0 else 1
        loads[train.crank] = loads.get(train.crank, 0.0) + way * driven
    return InertialLoads(
        {each.link: each.value for each in inertias},
        loads,
        {link: torque.si for link, torque in friction.items()},
        {link: part.drag.si for link, part in turning.items() if part.drag is not None},
        {link: tree.borne_by(link) for link in turning},
        train.crank if _is_cranked(train, case) and speeds[train.crank or ""] else None,
    )


def _is_cranked(train: Train, case: StateCase) -> bool:
    """Return True if a crank that is not an input drives a train with one input, by a torque that is not constant."""
    steady = case.drive is not None and case.drive.steady_torque is not None
    return train.crank is not None and train.crank not in case.inputs and len(case.inputs) == 1 and not steady


def torques_have_units(train: Train, case: StateCase) -> bool:
    """Return True if every torque that acts in one state is declared with a unit."""
    return not any(_is_plain(torque) for torques in _torques(train, case) for torque in torques.values())


def _torques(train: Train, case: StateCase) -> tuple[dict[str, Quantity], dict[str, Quantity]]:
    """Return the load torques and the friction torques of bearings, both by link. Loads on inputs do no virtual work;
    they are omitted unless a crank drives the train.
    """
    # torques on a prescribed input do no virtual work
    still = {train.frame} if _is_cranked(train, case) else {train.frame, *case.inputs}
    loads = {link: torque for link, torque in case.loads.items() if link not in still}
    bearings = ((link, part.bearing) for link, part in train.links.items() if link != train.frame)
    return loads, {link: bearing.sliding for link, bearing in bearings if bearing is not None}


def _is_plain(torque: Quantity) -> bool:
    return torque.unit is None and bool(torque.value)
