"""What motion in time needs beside the motion itself: inertia, drag, restitution, what drives. SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import tau
from typing import TYPE_CHECKING, Literal

from geartrain.dynamics.pair_speeds import radians_per_second
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from fractions import Fraction

    from geartrain.dynamics.motion.motion_problem import MotionProblem
    from geartrain.kinematics.circuits import Tree
    from geartrain.numerics.quantity import Quantity
    from geartrain.train import Drive, StateCase, Train

_EQUAL = 1e-9  # of a speed: rounding of decimals in which it is given


@dataclass(frozen=True)
class PowerInput:
    """What keeps a train going."""

    link: str
    """Where it acts."""
    kind: Literal["rate", "torque", "spring", "hand"]
    rate: float = 0.0
    """Speed that is kept: of the link itself, or of the hand (rad/s)."""
    torque: float = 0.0
    """Constant torque, also that of a weight on its drum (N m)."""
    stiffness: float = 0.0
    """Of a spring or a hand (N m/rad); `wound`, by how much the spring is wound at the start (rad)."""
    wound: float = 0.0
    inertia: float = 0.0
    """What it adds to the link's own (kg m2)."""

    @property
    def value(self) -> float:
        """What could be steered: the speed of the link, or of the hand (rad/s); the torque (N m); 0 of a spring."""
        return {"rate": self.rate, "hand": self.rate, "torque": self.torque}.get(self.kind, 0.0)


@dataclass(frozen=True)
class TimeCase:
    """A train in one state, as it is to move in time."""

    drive: PowerInput
    """Where power enters; `rate`, speed of the lead that sets the scale of time (rad/s)."""
    rate: float
    inertia: Mapping[str, float]
    """Of links (kg m2); `drag`, viscous (N m s/rad)."""
    drag: Mapping[str, float] = field(default_factory=dict)
    bearing: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Dry friction of links in their bearings, sliding and sticking (N m)."""
    load: Mapping[str, float] = field(default_factory=dict)
    """Torques on links (N m)."""
    restitution: Mapping[str, float] = field(default_factory=dict)
    """Of pairs."""
    clearance: Mapping[str, float] = field(default_factory=dict)
    """Of pins in their slots (m)."""
    escapements: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """By link: angle (rad) about the link that bears it, and time (s) of a beat."""


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
    """What is declared, where a rate (rad/s of the first input that turns) or a restitution is not given instead.

    scale   magnitude of that rate where none is declared either, for answers that do not depend on it
    """
    links = {name: link for name, link in train.links.items() if name != train.frame}
    given = {part.name: train.restitution_of(part) for part in (*train.gears, *train.couplings)}
    escapement = train.escapement
    passed = None if escapement is None else problem.seen_ratio(escapement.link, tree.top[escapement.link])
    turning = rate if rate is not None else _declared_rate(train, case, problem, passed, scale)
    bounces = {name: (own or 0.0) if restitution is None else restitution for name, own in given.items()}
    if escapement is not None:
        own = 0.0 if train.restitution is None else float(train.restitution.value)
        bounces[escapement.link] = own if restitution is None else restitution
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
        {each.name: each.clearance.si for each in train.couplings if each.clearance is not None},
        beats,
    )


def _refuse_rate_beyond_beats(train: Train, problem: MotionProblem, drive: PowerInput, passed: Fraction) -> None:
    """Raises `QuestionError` where a speed is kept at which an escapement would have to let more than a tooth pass.

    passed   speed of the escape wheel relative to the link that bears it, over the lead's
    """
    beats = train.escapement
    if beats is None or not problem.ratio(drive.link):
        return
    per_turn = abs(float(passed / problem.ratio(drive.link)))
    speed, most = abs(drive.rate) / tau, float(beats.speed)
    if speed * per_turn > most * (1 + _EQUAL):
        what = f"'{drive.link}' is kept at {speed:.6g} turn/s, which its escapement does not let pass"
        why = f"'{beats.link}' may make {most:.6g} turn/s in the mean, and would make {speed * per_turn:.6g}"
        driving_link = problem.driving_link
        slow = most / abs(float(passed))
        fix = (
            f"ask for {slow:.6g} turn/s of '{driving_link}' or less, or give no rate, but a "
            f"`drive` by a weight or a spring"
        )
        raise QuestionError(Problem(what, why, fix))


def _declared_rate(
    train: Train, case: StateCase, problem: MotionProblem, passed: Fraction | None, scale: float | None
) -> float:
    """Speed of the lead (rad/s): a declared rate, the escapement's, that of a hand, or else `scale`."""
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
    what = "nothing says how fast the train turns"
    why = "the length of a step follows from the time in which teeth pass"
    raise QuestionError(
        Problem(what, why, "give a rate such as `rate: 1 turn/s`, or `--rate 1`: that which is expected")
    )


def _power_input(train: Train, case: StateCase, drive: Drive | None, problem: MotionProblem, rate: float) -> PowerInput:
    """What drives where power enters, the way its link turns."""
    driving_link = problem.driving_link
    link = train.crank or driving_link
    speed = rate * float(problem.ratio(link))
    if drive is None or drive.rate is not None:
        # beside other inputs, which keep their speeds as well, a crank that is none of them would be one too many
        return (
            PowerInput(link, "rate", rate=speed)
            if len(case.inputs) == 1
            else PowerInput(driving_link, "rate", rate=rate)
        )
    way = -1.0 if speed < 0 else 1.0
    hand = drive.hand
    inertia = 0.0 if hand is None or hand.inertia is None else hand.inertia.si
    if drive.weight is not None and drive.drum is not None:
        inertia = drive.weight.si * drive.drum.si**2
    if drive.steady_torque is not None:
        return PowerInput(link, "torque", torque=way * drive.steady_torque, inertia=inertia)
    if drive.spring is not None:
        wound = way * tau * float(drive.spring.turns.value)
        return PowerInput(link, "spring", stiffness=drive.spring.stiffness.si, wound=wound)
    assert hand is not None
    own = way * _si(hand.rate)
    if hand.stiffness is None:
        return PowerInput(link, "rate", rate=own, inertia=inertia)
    return PowerInput(link, "hand", rate=own, stiffness=hand.stiffness.si, inertia=inertia)


def _si(quantity: Quantity | None) -> float:
    return 0.0 if quantity is None else quantity.si
