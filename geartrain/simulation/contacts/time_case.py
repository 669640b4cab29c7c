"""Data of a time-domain simulation other than the kinematics: inertia, drag, restitution and drive, in SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import tau
from typing import TYPE_CHECKING, Literal

from geartrain.dynamics.pair_speeds import radians_per_second
from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.circuits import pallet_link

if TYPE_CHECKING:
    from fractions import Fraction

    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.kinematics.circuits import Tree
    from geartrain.train import Drive, StateCase, Train

_EQUAL = 1e-9  # relative tolerance of a speed given in rounded decimals


@dataclass(frozen=True)
class PowerInput:
    """Drive of a train: a prescribed speed, a torque, a spring, or a hand.

    A hand is a prescribed speed that acts on the link through a torsional spring.
    """

    link: str
    """Name of the link on which the drive acts."""
    kind: Literal["rate", "torque", "spring", "hand"]
    rate: float = 0.0
    """Prescribed speed of the link or of the hand [rad/s]."""
    torque: float = 0.0
    """Constant torque on the link [N m], such as the torque of a weight on its drum."""
    stiffness: float = 0.0
    """Torsional stiffness of the spring or of the hand [N m/rad]. `wound` is the initial deflection of the spring
    [rad].
    """
    wound: float = 0.0
    inertia: float = 0.0
    """Moment of inertia that the drive adds to the link [kg m2]."""

    @property
    def value(self) -> float:
        """Control value: the speed of the link or of the hand [rad/s], the torque [N m], or 0 for a spring."""
        return {"rate": self.rate, "hand": self.rate, "torque": self.torque}.get(self.kind, 0.0)


@dataclass(frozen=True)
class TimeCase:
    """Data of a train in one state for time-domain simulation, in SI units."""

    drive: PowerInput
    """Drive of the train. `rate` is the mean speed of the driving link, which sets the time scale [rad/s]."""
    rate: float
    inertia: Mapping[str, float]
    """Moment of inertia of each link [kg m2]. `drag` contains the viscous coefficients [N m s/rad]."""
    drag: Mapping[str, float] = field(default_factory=dict)
    bearing: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Dry friction in the bearings of each link: sliding torque and maximum sticking torque [N m]."""
    load: Mapping[str, float] = field(default_factory=dict)
    """Load torque on each link [N m]."""
    restitution: Mapping[str, float] = field(default_factory=dict)
    """Coefficient of restitution of each pair [1]."""
    clearance: Mapping[str, float] = field(default_factory=dict)
    """Clearance of the pin in the slot of each coupling [m]."""
    escapements: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Angular pitch of each escape wheel relative to its bearing link [rad], and duration of a beat [s]."""


def find_time_case(
    train: Train,
    case: StateCase,
    problem: MotionProblem,
    tree: Tree,
    inertia: Mapping[str, float],
    rate: float | None = None,
    restitution: float | None = None,
    scale: float | None = None,
) -> TimeCase:
    """Return the data of one state in SI units. The arguments `rate` and `restitution` replace the declared values.

    rate    speed of the first input that turns [rad/s]
    scale   input speed that is assumed if none is declared, for results that do not depend on it [rad/s]
    """
    links = {name: link for name, link in train.links.items() if name != train.frame}
    given = {gear.name: train.restitution_of(gear) for gear in train.gears}
    given |= {row.id: train.restitution_of(each) for each in train.couplings for row in each.rows(train.wheels)}
    escapement = train.escapement
    passed = None if escapement is None else problem.seen_ratio(escapement.link, pallet_link(escapement, tree))
    turning = rate if rate is not None else _declared_rate(train, case, problem, passed, scale)
    bounces = {name: (own or 0.0) if restitution is None else restitution for name, own in given.items()}
    if escapement is not None:
        # a stop has only the restitution of the whole train
        own = 0.0 if train.restitution is None else float(train.restitution.value)
        bounces[escapement.link] = own if restitution is None else restitution
    # each beat lets half a tooth pass
    beats = {} if escapement is None else {escapement.link: (tau / (2 * escapement.teeth), escapement.beat.si)}
    drive = _power_input(train, case, None if rate is not None else case.drive, problem, turning)
    if drive.kind == "rate" and passed:
        _refuse_rate_beyond_beats(train, problem, drive, passed)
    return TimeCase(
        drive,
        turning,
        inertia,
        {name: link.drag.si for name, link in links.items() if link.drag is not None},
        {
            name: (link.bearing.sliding.si, link.bearing.at_rest.si)
            for name, link in links.items()
            if link.bearing is not None
        },
        {name: torque.si for name, torque in case.loads.items()},
        bounces,
        {each.name: each.clearance.si for each in train.pin_couplings if each.clearance is not None},
        beats,
    )


def _refuse_rate_beyond_beats(train: Train, problem: MotionProblem, drive: PowerInput, passed: Fraction) -> None:
    """Raise `QuestionError` if a prescribed speed would turn an escape wheel by more than one tooth in two beats.
    `passed` is the speed of the escape wheel relative to its pallets divided by the speed of the driving link.
    """
    beats = train.escapement
    if beats is None or not problem.ratio(drive.link):
        return
    per_turn = abs(float(passed / problem.ratio(drive.link)))
    speed, most = abs(drive.rate) / tau, float(beats.speed)
    if speed * per_turn > most * (1 + _EQUAL):
        what = f"'{drive.link}' has a prescribed speed of {speed:.6g} turn/s, which is more than its escapement permits"
        why = (
            f"the beat limits '{beats.link}' to {most:.6g} turn/s on average, but it would turn at "
            f"{speed * per_turn:.6g}"
        )
        driving_link = problem.driving_link
        slow = most / abs(float(passed))
        fix = (
            f"give at most {slow:.6g} turn/s for '{driving_link}', or omit the rate and declare a weight or a spring "
            "as `drive`"
        )
        raise QuestionError(Problem(what, why, fix))


def _declared_rate(
    train: Train, case: StateCase, problem: MotionProblem, passed: Fraction | None, scale: float | None
) -> float:
    """Return the speed of the driving link [rad/s]. It is derived from the first of these that is declared: an input
    speed with a unit, the escapement, the speed of a hand. If none is declared, it is `scale`.

    passed   speed of the escape wheel relative to its pallets divided by the speed of the driving link
    """
    unit = radians_per_second(train, case)
    if unit is not None:
        return unit * float(problem.speeds[problem.driving_link])
    if train.escapement is not None and passed:
        return problem.way * tau * float(train.escapement.speed / abs(passed))
    hand = None if case.drive is None else case.drive.hand
    if hand is not None and hand.rate is not None:
        return problem.way * hand.rate.si / abs(float(problem.ratio(train.crank or problem.driving_link)))
    if scale is not None:
        return problem.way * scale
    what = "no input speed is declared"
    why = "the time step is a fraction of the tooth-passing period, which depends on the input speed"
    raise QuestionError(Problem(what, why, "declare the input speed, such as `rate: 1 turn/s`, or pass `--rate 1`"))


def _power_input(train: Train, case: StateCase, drive: Drive | None, problem: MotionProblem, rate: float) -> PowerInput:
    """Return the drive of the train: its link, kind and values, with the sign of the link's mean speed."""
    driving_link = problem.driving_link
    link = train.crank or driving_link
    speed = rate * float(problem.ratio(link))
    if drive is None or drive.rate is not None:
        # with several prescribed inputs, a crank that is not one of them would overdetermine the train
        return (
            PowerInput(link, "rate", rate=speed)
            if len(case.inputs) == 1
            else PowerInput(driving_link, "rate", rate=rate)
        )
    # a weight, spring or torque acts in the sense in which its link turns
    way = -1.0 if speed < 0 else 1.0
    hand = drive.hand
    inertia = 0.0 if hand is None or hand.inertia is None else hand.inertia.si
    if drive.weight is not None and drive.arm is not None:
        # a falling weight adds m r^2 to the link of its drum, with its descent r per radian
        inertia = drive.weight.si * drive.arm**2
    if drive.steady_torque is not None:
        return PowerInput(link, "torque", torque=way * drive.steady_torque, inertia=inertia)
    if drive.spring is not None:
        if drive.spring.fusee is not None:
            what, why = "a fusee with declared radii cannot be simulated in time", "its torque varies with its angle"
            mean = drive.spring.chained.run().mean if drive.spring.chained else 0.0
            fix = f"declare its mean torque, `drive: {{torque: {mean:.6g} N m}}`, or a `torque` of the fusee"
            raise QuestionError(Problem(what, why, fix))
        wound = way * tau * float(drive.spring.turns.value)
        return PowerInput(link, "spring", stiffness=drive.spring.stiffness.si, wound=wound)
    assert hand is not None
    own = 0.0 if hand.rate is None else way * hand.rate.si
    if hand.stiffness is None:
        return PowerInput(link, "rate", rate=own, inertia=inertia)
    return PowerInput(link, "hand", rate=own, stiffness=hand.stiffness.si, inertia=inertia)
