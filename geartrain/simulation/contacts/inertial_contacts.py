"""What the flanks of each pair must carry while a train turns fast: docs/dynamics.md, equations (1) to (6).

While all drive flanks touch, links follow `motion`. Let pair m give way: its driven side moves ahead by p_m, the input
stays, and every other pair keeps touching. Its error is then delta_m = sense (tau - mean) dS_m + p_m, so that links
move by e = R J^-1 p with the matrix J = I - diag(sense (tau - mean)) G of (5) in docs/motion.md. By d'Alembert's
principle no work is done on the way: the torque that its flanks must carry, lambda = -sum (T - J_l theta'') e, is

    lambda_m(x, w) = D_m(x) + V_m(x) w + A_m(x) w^2,

with loads and dry friction of bearings in D, viscous drag in V, inertia in A. The least w > 0 at which it vanishes is
the rate sought, the least of all positions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
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
    from geartrain.teeth.transmission import TransmissionFunction
    from geartrain.train import StateCase, Train


_SLOPE = 1e-12  # of the mean ratio: speeds of the tables whose derivatives are taken
_DEGREE = 9
_LEAP = 1e-7  # of the input's speed and the greatest of a link's: a lesser jump of a speed is rounding
_MANY, _TABLES = 8, 1e-11  # laws of longer trains are read from tables of so many pitches
_NUMBERS = 1 << 22  # most entries of matrices at once

FlankArms = tuple[Callable[["Floats"], "Floats"], Callable[["Floats"], "Floats"]]
"""What friction adds to the arm of a driver on its drive flank, turning forward and back, by its forward angle."""


class CarriedTorques(NamedTuple):
    """Terms of the torque that each pair must carry, (pairs, n): N m, N m s, N m s2, of forward driven torque."""

    constant: Floats
    viscous: Floats
    inertial: Floats


class _State(NamedTuple):
    """Speeds and accelerations of all links over the input's at n positions, and slopes of errors of the sources."""

    speed: Floats
    acceleration: Floats
    slope: Floats
    arm: Floats
    """Slopes and speeds where each driver's arm is that with friction: those of virtual work."""
    virtual: Floats
    """Slopes and speeds where each driver's arm is that with friction: those of virtual work."""


class InertialContacts:
    """The torque that each pair of a moving train must carry at every position."""

    def __init__(
        self,
        moving: MotionProblem,
        acting: InertialLoads,
        tolerance: float | None = None,
        rubbing: Mapping[str, FlankArms] | None = None,
    ) -> None:
        self.moving, self.acting, self.rubbing = moving, acting, rubbing or {}
        outputs = {link: (link, moving.frame) for link in moving.system.links}
        if tolerance is None and len(moving.circuits) > _MANY:
            tolerance = _TABLES
        self.motion = Motion(moving, outputs, tolerance)
        self.sources: tuple[PairErrorSource, ...] = self.motion._forward.sources

    # ----------------------------------------------------------------------------------------------- what it is made of

    @property
    def pairs(self) -> tuple[str, ...]:
        """Pairs and couplings by name."""
        return self.motion._propagation.pairs

    @cached_property
    def _response(self) -> Floats:
        """R: angles of links from errors of pairs, each alone, (links, pairs)."""
        return self.motion._propagation.errors(np.eye(len(self.pairs)))

    @cached_property
    def _gain(self) -> Floats:
        """G: what the error of each pair adds to the driver's angle of each source, (sources, pairs)."""
        rows = np.zeros((len(self.sources), len(self.pairs)))
        for row, source in enumerate(self.sources):
            for link, sign in self.motion._forward.turned_by(source):
                rows[row] += sign * self._response[link]
        return rows

    @cached_property
    def _yielding(self) -> YieldingPairs:
        of_pair = {source.pair: at for at, source in enumerate(self.sources)}
        blocks = [[of_pair[pair] for pair in part.pairs if pair in of_pair] for part in self.motion._propagation.parts]
        return YieldingPairs(self._gain, [source.pair for source in self.sources], [block for block in blocks if block])

    @cached_property
    def _slopes(self) -> tuple[CellTable, ...]:
        """d tau / dS of each source's law; laws of many pairs may be one."""
        known: dict[int, CellTable] = {}
        for source in self.sources:
            if id(source.transmission) not in known:
                known[id(source.transmission)] = speed_slope(source.transmission)
        return tuple(known[id(source.transmission)] for source in self.sources)

    @cached_property
    def _senses(self) -> Floats:
        """1, or -1 where the driven side of a pair turns backwards on average, by pair."""
        circuits: dict[str, Circuit] = {circuit.id: circuit for circuit in self.moving.circuits}
        errors = PairErrors(self.moving, None, ())
        return np.array([errors.sense(circuits[name]) for name in self.pairs], dtype=float)

    def _by_link(self, values: Mapping[str, float]) -> Floats:
        return np.array([values.get(link, 0.0) for link in self.moving.system.links], dtype=float)

    @cached_property
    def _joints(self) -> tuple[Ints, Floats]:
        """Of each link the one that bears it, and the sense of their axes towards each other."""
        at = {link: number for number, link in enumerate(self.moving.system.links)}
        bearers = [self.acting.bearer.get(link, self.moving.frame) for link in at]
        signs = self.moving.signs
        senses = [signs.get(link, 1) * signs.get(bearer, 1) for link, bearer in zip(at, bearers, strict=True)]
        return np.array([at[bearer] for bearer in bearers]), np.array(senses, dtype=float)

    # ----------------------------------------------------------------------------------------------------- at positions

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
            S = phase.cycles(source.cycles) * source.transmission.period + source.start
            turning = np.full(len(turns), source.mean)
            for link, sign in composition.turned_by(source):
                S += sign * error[link]
                turning += sign * found.rate[link]
            slope[row] = source.sense * (source.transmission.speed(S) - float(source.transmission.ratio))
            kick[source.pair] = source.sense * self._slopes[row](S) * turning**2
            arm[row] = slope[row]
            if source.id in self.rubbing:
                ahead, back = self.rubbing[source.id]
                arm[row] += source.sense * np.where(turning >= 0, ahead(S), back(S))
            pulled[source.pair] = arm[row] * source.mean
        acceleration = self._response @ self._yielding.errors(slope, kick)
        speed = means[:, None] + found.rate
        virtual = speed
        if self.rubbing:
            virtual = means[:, None] + self._response @ self._yielding.errors(arm, pulled)
        return _State(speed, acceleration, slope, arm, virtual)

    def torques(self, turns: Floats) -> CarriedTorques:
        """What each pair must carry where the input has made some turns."""
        size = max(64, _NUMBERS // (4 * (len(self.pairs) + len(self.moving.system.links)) + 1))
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
        """What pairs carry under forces that links ask for, by the transposed matrices: sense J^-T R^T f."""
        for requested in forces:
            force = self._less_the_crank(requested, state.virtual)
            yield self._senses[:, None] * self._yielding.torques(state.arm, self._response.T @ force)

    def _less_the_crank(self, requested: Floats, speed: Floats) -> Floats:
        """What links ask of their pairs: where a crank keeps the input turning, all the virtual work is its."""
        if self.acting.crank is None:
            return requested
        crank = self.moving.system.links.index(self.acting.crank)
        force = requested.copy()
        force[crank] -= (requested * speed).sum(axis=0) / speed[crank]
        return force

    def rates(self, turns: Floats) -> Floats:
        """The rate (rad/s of the input) from which each pair parts at each position, (pairs, n)."""
        return minimum_rate(*self.torques(turns))

    def impulses(self, kinks: Floats, width: float) -> Floats:
        """What pairs carry of the blow where some law is at a corner, for each unit of the input's speed (N m s2).

        Below 0 they part at any rate. 0 where no speed jumps.

        width   turns of the input by which a position is asked beside a corner
        """
        before, after = self._state(kinks - width), self._state(kinks + width)
        jump = after.speed - before.speed
        scale = np.maximum(1.0, np.abs(after.speed).max(axis=1, initial=0.0))[:, None]
        jump[np.abs(jump) <= _LEAP * scale] = 0.0
        (found,) = self._carried(after, [self._by_link(self.acting.inertia)[:, None] * jump])
        return found


@dataclass(frozen=True)
class YieldingPairs:
    """The matrix J = I - diag(slope) G at many positions, in the order in which pairs determine each other."""

    gain: Floats
    """G, (sources, pairs); `pairs`, the pair of each source."""
    pairs: Sequence[int]
    blocks: Sequence[Sequence[int]]
    """Sources that are solved together, each block after those that it depends on."""

    def errors(self, slope: Floats, given: Floats) -> Floats:
        """J^-1 times vectors, (pairs, n)."""
        found = given.copy()
        for block in self.blocks:
            rows = [self.pairs[at] for at in block]
            known = found.copy() if len(block) > 1 else found
            right = np.stack([given[row] + slope[at] * (self._before(block, at) @ known)
                              for at, row in zip(block, rows, strict=True)])  # fmt: skip
            found[rows] = self._solved(block, slope, right, transposed=False)
        return found

    def torques(self, slope: Floats, given: Floats) -> Floats:
        """The transposed of J^-1 times vectors, (pairs, n)."""
        found = given.copy()
        for block in reversed(self.blocks):
            rows = [self.pairs[at] for at in block]
            found[rows] = self._solved(block, slope, found[rows], transposed=True)
            for at, row in zip(block, rows, strict=True):
                found += self._before(block, at)[:, None] * (slope[at] * found[row])
        return found

    def _before(self, block: Sequence[int], at: int) -> Floats:
        """What pairs outside of its block add to a source's driver."""
        row: Floats = self.gain[at].copy()
        row[[self.pairs[each] for each in block]] = 0.0
        return row

    def _solved(self, block: Sequence[int], slope: Floats, right: Floats, transposed: bool) -> Floats:
        own = self.gain[np.ix_(block, [self.pairs[at] for at in block])]
        if not own.any():
            return right
        matrices = np.eye(len(block)) - slope[list(block)].T[:, :, None] * own
        if transposed:
            matrices = np.swapaxes(matrices, 1, 2)
        return np.asarray(np.linalg.solve(matrices, right.T[:, :, None])[:, :, 0].T)


def minimum_rate(D: Floats, V: Floats, A: Floats) -> Floats:
    """The least w >= 0 from which on D + V w + A w^2 is negative for a while; infinite where it never is."""
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(V * V - 4 * D * A)  # NaN where it never vanishes
        q = -(V + np.copysign(root, V)) / 2  # no digits are lost in this sum, nor in the quotients
        first, second = q / A, D / q
    roots = np.stack([np.where(each > 0, each, inf) for each in (first, second)]).min(axis=0)
    starts = (D < 0) | ((D == 0) & ((V < 0) | ((V == 0) & (A < 0))))
    # at D = 0 a root above 0 is one from which on it is negative only where A is
    return np.where(starts, 0.0, np.where((D == 0) & (A >= 0), inf, roots))


def speed_slope(transmission: TransmissionFunction) -> CellTable:
    """d tau / dS (1/rad) of a law, from a table of its speed that is cut at its corners."""
    maximum = max(abs(each) for each in transmission.speed_range())
    return fit(
        transmission.speed, transmission.period, folded_kinks(transmission), _SLOPE * max(maximum, 1.0), _DEGREE
    ).derivative()


# --------------------------------------------------------------------------------------------------- what acts on links


@dataclass(frozen=True)
class InertialLoads:
    """What acts on links besides their pairs: SI units, by link, about their own axes."""

    inertia: Mapping[str, float]
    """kg m2; of a link that takes others round, theirs too."""
    load: Mapping[str, float]
    """Constant torque (N m), positive about the link's axis."""
    friction: Mapping[str, float]
    """Of its bearing while it turns (N m), 0 or more; `drag`, viscous (N m s)."""
    drag: Mapping[str, float]
    bearer: Mapping[str, str]
    """The link in which it turns."""
    crank: str | None = None
    """The link at which power enters so that the input turns evenly; None where that is the input."""


def find_inertial_loads(
    train: Train, case: StateCase, tree: Tree, inertias: Sequence[LinkInertia], speeds: Mapping[str, Fraction]
) -> InertialLoads:
    """Of one state. Raises `QuestionError` where no link has an inertia, or a torque has no unit.

    speeds   mean speeds of links: a weight or a torque that drives pulls the way its link turns
    """
    if not any(each.value for each in inertias):
        what = f"no link of '{train.name}' has a moment of inertia"
        fix = "give links an `inertia`, such as 30 kg mm2, or wheels `density`, `thickness` and `module`"
        raise QuestionError(Problem(what, "without one no teeth part", fix))
    turning = {link: part for link, part in train.links.items() if link != train.frame}
    load, friction = _torques(train, case)
    for key, torques in (("load", load), ("bearing", friction)):
        for link, torque in torques.items():
            if _is_plain(torque):
                what = f"the {key} of '{link}', {torque}, has no unit"
                raise QuestionError(Problem(what, "inertias are in kg m2", f"write for example '{torque} N m'"))
    return InertialLoads(
        {each.link: each.value for each in inertias},
        loads_with_drive({link: torque.si for link, torque in load.items()}, train, case, speeds),
        {link: torque.si for link, torque in friction.items()},
        {link: part.drag.si for link, part in turning.items() if part.drag is not None},
        {link: tree.parent[link][0] for link in turning},
        train.crank if _is_cranked(train, case) and speeds[train.crank or ""] else None,
    )


def loads_with_drive(
    loads: dict[str, float], train: Train, case: StateCase, speeds: Mapping[str, Fraction]
) -> dict[str, float]:
    """Loads, and at the crank what drives with a steady torque, where the crank is not the input that stays."""
    torque = None if case.drive is None else case.drive.steady_torque
    if torque is None or train.crank is None or train.crank in case.inputs:
        return loads
    way = -1 if speeds[train.crank] < 0 else 1
    return {**loads, train.crank: loads.get(train.crank, 0.0) + way * torque}


def _is_cranked(train: Train, case: StateCase) -> bool:
    """True if a link that is no input keeps the input turning: one that drives with a torque of its own does not."""
    steady = case.drive is not None and case.drive.steady_torque is not None
    return train.crank is not None and train.crank not in case.inputs and len(case.inputs) == 1 and not steady


def torques_have_units(train: Train, case: StateCase) -> bool:
    """True if every torque that acts in one state has a unit."""
    return not any(_is_plain(torque) for torques in _torques(train, case) for torque in torques.values())


def _torques(train: Train, case: StateCase) -> tuple[dict[str, Quantity], dict[str, Quantity]]:
    """Loads and friction of bearings, by link; loads on inputs do no work when pairs give way, unless a crank does."""
    still = {train.frame} if _is_cranked(train, case) else {train.frame, *case.inputs}
    loads = {link: torque for link, torque in case.loads.items() if link not in still}
    bearings = ((link, part.bearing) for link, part in train.links.items() if link != train.frame)
    return loads, {link: bearing.sliding for link, bearing in bearings if bearing is not None}


def _is_plain(torque: Quantity) -> bool:
    return torque.unit is None and bool(torque.value)
