"""Torque of a train over revolutions of its input, computed with the speed ratio and the friction at every position.

The theory is in docs/torques.md, sections 16 to 18.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.motion_model import Motion
from geartrain.dynamics.motion.motion_problem import find_motion_problem
from geartrain.dynamics.torques.neglected_effects import neglected_over_turn, unknown_forces
from geartrain.dynamics.torques.torque_analysis import build_balance, find_question
from geartrain.dynamics.torques.torque_balance import generic_balance, idle_pairs
from geartrain.dynamics.torques.torque_results import NeglectedEffect, TorqueVerdict
from geartrain.dynamics.turn.position_motion import PositionMotion
from geartrain.dynamics.turn.torque_cycle import CycleEnergy, PairCycle, PlaceInRun, TorqueCycle, TorqueExtreme
from geartrain.dynamics.turn.train_contacts import (
    dragging_links,
    find_bearings,
    find_contacts,
    followed_pairs,
    mean_friction_pairs,
)
from geartrain.dynamics.turn.turn_balance import TurnBalance
from geartrain.dynamics.turn.turn_run import FAINT, NODES, RunScales, TurnRun, sign_beyond
from geartrain.errors import Problem, QuestionError, check_choice, check_numbers, check_whole_numbers
from geartrain.numerics.labelled_array import labelled_array

if TYPE_CHECKING:
    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.train_mechanics import TrainMechanics
    from geartrain.dynamics.turn.turn_balance import PositionTorques
    from geartrain.dynamics.turn.turn_run import RunCells
    from geartrain.numerics.arrays import Floats


_CELLS = 12  # candidate cells in which an extreme is refined
_PARTS = 16  # subdivisions per round of refinement
_ROUNDS = 6  # rounds of refinement: each narrows the interval by 8
SAMPLES = 20_000  # default number of positions of a run
MOST_TURNS = 1e9  # positions in float64 then resolve 1e-7 of a revolution
_ODD = Fraction(1_414_213, 1_000_003)  # factor of friction that cancels no declared load


def find_extreme(
    value_at: Callable[[Floats], Floats], cells: RunCells, way: int, values: Floats
) -> tuple[float, float] | None:
    """Return the position [revolutions] and the value of the maximum (`way` 1) or minimum (`way` -1) of a quantity over
    a run; None if no value is finite.

    value_at   function that returns the values at given positions
    values     values at the positions of the run, NaN where the train is locked
    """
    signed = np.where(np.isfinite(values), way * values, -np.inf)
    if not np.isfinite(signed).any():
        return None
    highest = np.argsort(-signed.reshape(-1, NODES).max(axis=1), kind="stable")[:_CELLS]
    top = int(np.argmax(signed))
    best, at = float(signed[top]), float(cells.turns[top])
    # inside the cell: beyond its end another transmission function may apply
    low, high = cells.low[highest] + cells.aside, cells.high[highest] - cells.aside
    for _ in range(_ROUNDS):
        grid = low[:, None] + (high - low)[:, None] * (np.arange(_PARTS + 1) / _PARTS)
        found = way * value_at(grid.ravel()).reshape(grid.shape)
        found = np.where(np.isfinite(found), found, -np.inf)
        which = np.argmax(found, axis=1)
        peak = found[np.arange(len(which)), which]
        if peak.max() > best:
            best = float(peak.max())
            at = float(grid[np.argmax(peak), which[np.argmax(peak)]])
        rows = np.arange(len(which))
        # a smooth maximum lies between the neighbours of the best grid point
        low, high = grid[rows, np.maximum(which - 1, 0)], grid[rows, np.minimum(which + 1, _PARTS)]
    return at, way * best + 0.0  # avoids -0.0


def solve(
    train: TrainMechanics,
    state: str | None,
    turns: float,
    samples: int = SAMPLES,
    of: str | None = None,
    on_done: Callable[[int], object] | None = None,
) -> TorqueCycle:
    """Compute the torque at every position over several revolutions of the input; see `GearTrain.torques`."""
    check_numbers(turns=turns)
    check_whole_numbers(samples=samples)
    train = train.unfolded
    setting = train.load_case(state)
    if of is not None:
        check_choice("link", of, tuple(train.declaration.links))
    if setting is None:
        return TorqueCycle(state, TorqueVerdict("still", "the speeds of this state are not determined"), of or "")
    if not 0 < turns <= MOST_TURNS:
        what, why = f"turns = {turns:g} is out of range", f"a run has more than 0 and at most {MOST_TURNS:g} turns"
        raise QuestionError(Problem(what, why, f"pass turns above 0, up to {MOST_TURNS:g}"))
    if samples < 2:
        why = "a run has at least two positions of the input"
        raise QuestionError(Problem(f"samples = {samples} is too small", why, "pass samples >= 2"))
    if of is not None and of in setting.case.loads:
        why = f"'{of}' carries a load of {setting.case.loads[of]}"
        fix = "request the torque at a link without a load"
        raise QuestionError(Problem(f"the torque at '{of}' is already known", why, fix))
    found = find_turn_balance(setting, find_motion_problem(train, state), of)
    if isinstance(found, TorqueVerdict):
        return TorqueCycle(setting.case.state, found, of or "")
    found.on_done = on_done
    return _RunResults(TurnRun(found, turns, samples), of).cycle()


def find_torque_period(train: TrainMechanics, state: str | None = None, of: str | None = None) -> Fraction | None:
    """Return the exact number of revolutions of the input after which the torque repeats."""
    train = train.unfolded
    loads = train.load_case(state)
    if loads is None:
        return None
    found = find_turn_balance(loads, find_motion_problem(train, state), of)
    return None if isinstance(found, TorqueVerdict) else found.motion.period


def find_turn_balance(setting: LoadCase, problem: MotionProblem, of: str | None) -> TurnBalance | TorqueVerdict:
    """Return the torque balance of a train for any position; return a verdict if the torques cannot be determined.

    of   link whose torque is unknown; None for the declared link
    """
    question = find_question(setting, of or setting.case.solve_for)
    if isinstance(question, TorqueVerdict):
        return question
    if not question.enough:
        text = "fewer torques are unknown than the train has degrees of freedom: loads cannot balance everywhere"
        return question.undecided or TorqueVerdict("undecided", text)
    bearings, frame = find_bearings(setting), setting.train.frame
    known = dict(question.loads)
    for link, friction in bearings.items():
        # only the presence of friction matters here; the odd factor prevents it from cancelling a load by chance
        for end in (link, setting.tree.borne_by(link)):
            known[end] = known.get(end, Fraction(0)) + Fraction(sum(friction[1:])) * _ODD
    known.pop(frame, None)
    whole = generic_balance(build_balance(setting, known, question.links))
    # only the pairs that transmit torque are evaluated
    idle = idle_pairs(whole)
    balance = replace(
        whole,
        meshes=tuple(mesh for mesh in whole.meshes if mesh.id not in idle),
        ties=tuple(tied for tied in whole.ties if idle.isdisjoint(tied)),
    )
    busy = replace(setting, circuits=[each for each in setting.circuits if each.id not in idle])
    links = {link for circuit in busy.circuits for link in (circuit.i, circuit.j, *circuit.subtracted)}
    links.update(*((link, setting.tree.borne_by(link)) for link in bearings), known, question.links)
    links.update(map(setting.reacts_on, question.links))
    teeth = {mesh.name: mesh for mesh in problem.teeth}
    for name in (circuit.id for circuit in busy.circuits if circuit.id in setting.joints):
        if setting.joints[name].transmission.at_once:
            what = f"the torque of '{name}' over a turn is not defined"
            why = "an instantaneous step has no defined force; only the mean torque is known"
            raise QuestionError(Problem(what, why, "give `over`, the angle of the driver during a step"))
    motion = Motion(problem, {link: (link, frame) for link in problem.system.links if link in {*links, frame}})
    positions = PositionMotion(motion, followed_pairs(busy, teeth))
    contacts = find_contacts(busy, positions, teeth)
    loads = {link: float(torque) for link, torque in question.loads.items()}
    pressed = None
    if any(each.radius for each in bearings.values()):
        from geartrain.dynamics.torques.bearing_loads import BearingLoads

        pressed = BearingLoads(busy)
    return TurnBalance(busy, positions, balance, contacts, loads, bearings, pressed)


@dataclass
class _RunResults:
    """Results for the reported link `of`, from the torques at all positions over several revolutions of the input."""

    run: TurnRun
    of: str | None

    @cached_property
    def _row(self) -> int:
        """Row index of the reported link in arrays with one row for each link of unknown torque."""
        requested = self.run.train.requested
        return requested.index(self.of) if self.of in requested else 0

    @cached_property
    def _way(self) -> int:
        """Sign of the reported link's mean speed about its own axis."""
        setting, link = self.run.train.setting, self._link
        return -1 if setting.sense(link) * (setting.relative(link, setting.reacts_on(link)) or 0) < 0 else 1

    def _torque(self, found: PositionTorques) -> Floats:
        """Return the torque at the reported link with minimum loss, positive in the sense of its mean speed."""
        return np.asarray(self._way * found.torque[self._row] / self._arm)

    def _highest(self, found: PositionTorques) -> Floats:
        """Return the torque at the reported link with maximum loss, positive in the sense of its mean speed."""
        return np.asarray(self._way * found.highest[self._row] / self._arm)

    @property
    def _link(self) -> str:
        return self.run.train.requested[self._row]

    @property
    def _arm(self) -> float:
        """Lever arm of the force if the reported link slides [m]; 1 if the link turns."""
        return float(self.run.train.setting.arms.get(self._link, 1))

    def cycle(self) -> TorqueCycle:
        train, found = self.run.train, self.run.found
        link = self._link
        locked, ambiguous = self.run.share(~found.valid), self.run.share(found.layers > 1)
        maximum = None if locked else self._extreme(1, False)
        starting = None
        if self.run.standing.valid.all():
            # without static friction the maximum torque is sufficient to start the train
            starting = self._extreme(1, True) if train.starts_harder else maximum
        torque, neglected, period = self._torque(found), self._neglected(), train.motion.period
        names = (*train.pairs, *(f"bearing {link}" for link in train.bearings))
        parts = self._parts(names)
        # repr: the label of a position has all digits
        labels = [repr(each) for each in self.run.cells.turns.tolist()]
        return TorqueCycle(
            train.setting.case.state,
            self._verdict(locked, ambiguous, neglected),
            link,
            train.setting.train.has_torque_units(train.setting.case.state),
            self.run.span,
            None if period is None else float(period),
            self.run.cells.turns,
            torque,
            self._highest(found),
            self._highest(self.run.standing),
            labelled_array(found.speeds, link=train.outside, position=labels),
            labelled_array(found.powers, link=train.outside, position=labels),
            labelled_array(found.losses, part=names, position=labels),
            None if locked else float(self.run.cells.weights @ torque) / self.run.span,
            maximum,
            self._extreme(-1, False),
            starting,
            None if locked else self._energy(parts),
            parts,
            locked,
            self._held(),
            ambiguous,
            self._stretches(),
            train.complete,
            neglected,
            link in train.setting.arms,
        )

    def _neglected(self) -> tuple[NeglectedEffect, ...]:
        train = self.run.train
        teeth = {mesh.name: mesh for mesh in train.motion.motion._problem.teeth}
        found = neglected_over_turn(
            train.setting, tuple(mean_friction_pairs(train.setting, train.motion.sources, teeth))
        )
        if train.bearing_loads is not None:
            found += tuple(unknown_forces(train.bearing_loads))
        if links := dragging_links(train.setting):
            why = (
                "it depends on speed, and torques or speeds have no units: give `rate` or the inputs a unit, and the "
                "loads too"
            )
            found += (NeglectedEffect("viscous drag", links, why),)
        if share := self.run.share(self.run.found.unresolved):
            why = (
                f"over {share:.2%} of the run a link would turn backwards on drive flanks and forwards on coast "
                "flanks; it is assumed to rest within its backlash and to need no torque, and its position there is "
                "not computed"
            )
            found += (NeglectedEffect("rest within the backlash", train.flanked, why),)
        return found

    def _verdict(self, locked: float, ambiguous: float, neglected: tuple[NeglectedEffect, ...]) -> TorqueVerdict:
        requested = ", ".join(self.run.train.requested)
        if locked:
            text = f"no torque on {requested} balances the loads over {locked:.4%} of the run: the train locks there"
            return TorqueVerdict("self-locking", text)
        if shared := self.run.train.shared:
            text = (
                f"the load sharing of {', '.join(shared)} is not determined: they are redundant, and `share` is not "
                "declared"
            )
            return TorqueVerdict("indeterminate", f"{text}; minimum-norm torques are reported", shared)
        if ambiguous:
            text = f"several patterns of power flow balance over {ambiguous:.4%} of the run"
            return TorqueVerdict("ambiguous", f"{text}; the pattern with minimum loss is reported")
        if neglected:
            what = ", ".join(map(str, neglected))
            return TorqueVerdict("incomplete", f"the torque at every position is determined; not included: {what}")
        return TorqueVerdict("determined", "the torque at every position is determined")

    def _place(self, turns: float) -> PlaceInRun:
        train = self.run.train.setting.train
        if train.unit_days is None:
            return PlaceInRun(turns)
        speed = abs(float(self.run.train.setting.speeds[self.run.train.motion.motion._problem.driving_link]))
        return PlaceInRun(turns, turns / speed * float(train.unit_days) if speed else None)

    def _extreme(self, way: int, static: bool) -> TorqueExtreme | None:
        """Return the maximum (`way` 1) or minimum (`way` -1) torque at the reported link, which is also searched for
        between the computed positions; None if all values are infinite. `static` selects static friction.
        """
        torque = self._highest if way > 0 else self._torque
        values = torque(self.run.standing if static else self.run.found)
        extreme = find_extreme(lambda turns: torque(self.run.train.at(turns, static)), self.run.cells, way, values)
        return None if extreme is None else TorqueExtreme(extreme[1], *self._place(extreme[0]))

    def _energy(self, parts: Mapping[str, PairCycle]) -> CycleEnergy:
        """Return the energies over the evaluated revolutions [J, or rad if torques are numbers without a unit]."""
        found, requested = self.run.found, len(self.run.train.requested)
        # powers are divided by the speed of the input, so the integral is over its angle in radians
        weights = self.run.cells.weights * 2 * np.pi
        driving, loading = found.powers[:requested], found.powers[requested:]

        def summed(powers: Floats) -> float:
            """Return the integral of the positive parts of the given powers over the evaluated revolutions."""
            return float(weights @ np.maximum(powers, 0).sum(axis=0))

        lost = dict.fromkeys(("mesh", "pin", "bearing"), 0.0)
        for part in parts.values():
            lost[part.kind] += part.loss
        return CycleEnergy(
            put_in=summed(driving),
            returned=summed(-driving),
            taken_out=summed(-loading),
            loads_put_in=summed(loading),
            **lost,
        )

    def _parts(self, names: tuple[str, ...]) -> Mapping[str, PairCycle]:
        found, weights = self.run.found, self.run.cells.weights * 2 * np.pi
        kinds = [each.kind for each in self.run.train.contacts.values()] + ["bearing"] * len(self.run.train.bearings)
        losses, passed = (np.where(found.valid, each, 0) @ weights for each in (found.losses, found.passed))
        # noise around a torque of 0 is not a change of flanks
        changes = [_changes(row, self._closes) for row in sign_beyond(found.pressed, RunScales.of(found).pressed)]
        bearings = len(self.run.train.bearings)
        changes += [0] * bearings
        maximum = np.abs(np.where(found.valid, found.pressed, 0)).max(axis=1, initial=0.0).tolist() + [0.0] * bearings
        rows = zip(names, kinds, losses.tolist(), passed.tolist(), changes, maximum, strict=True)
        return {name: PairCycle(kind, *figures) for name, kind, *figures in rows}

    @property
    def _closes(self) -> bool:
        """True if the evaluated revolutions of the input are an integer number of periods."""
        period = self.run.train.motion.period
        return period is None or (self.run.span / float(period)) % 1 == 0

    def _held(self) -> float:
        """Return the fraction of the revolutions in which loads and unknown torques both supply power."""
        found, requested = self.run.found, len(self.run.train.requested)
        driving, loading = found.powers[:requested].sum(axis=0), found.powers[requested:].sum(axis=0)
        minimum = FAINT * np.nanmax(np.abs(found.powers), initial=0.0)
        return self.run.share((driving > minimum) & (loading > minimum))

    def _stretches(self) -> tuple[tuple[PlaceInRun, PlaceInRun], ...]:
        """Return the first and last position of each range of input positions in which no torques balance the loads."""
        turns, locked = self.run.cells.turns, np.concatenate([[False], ~self.run.found.valid, [False]])
        starts, ends = np.flatnonzero(locked[1:] & ~locked[:-1]), np.flatnonzero(locked[:-1] & ~locked[1:]) - 1
        return tuple(
            (self._place(float(turns[a])), self._place(float(turns[b]))) for a, b in zip(starts, ends, strict=True)
        )


def _changes(signs: Floats, closes: bool) -> int:
    """Return the number of sign changes in a sequence, ignoring zeros. If `closes` is True, the sequence is periodic,
    so the last element is also compared with the first.
    """
    own = signs[signs != 0]
    if not len(own):
        return 0
    return int(np.count_nonzero(own[1:] != own[:-1])) + int(closes and own[0] != own[-1])
