"""Simulated motion of a train as stored in a page: angles at selected samples, contacts, and impacts.

The time of sample n is n `step` seconds after the start of the replayed part. The angle of a link at the time t is

    turned(t) = rate t + line(t)

where `line` interpolates linearly between the kept samples and is within `tolerance` of every sample of the simulation.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import tau
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.circuits import pallet_link
from geartrain.numerics.polylines import simplified
from geartrain.numerics.results import Result
from geartrain.numerics.vectors import Vector, across, minus, plus, size, unit_or_z
from geartrain.scene.context import packed_key
from geartrain.wings import WingResult

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.scene.context import SceneContext
    from geartrain.scene.elements import SceneCoupling, ScenePair, SceneWheel
    from geartrain.scene.movement import Movement

TimeRun: TypeAlias = Any
"""A `geartrain.simulation.TimeRun`; scenes do not import that package, not even for types."""


@dataclass(frozen=True, slots=True)
class LinkCourse(Result):
    """Angle of a link as a function of time, stored as a mean speed and deviations from uniform motion."""

    KEYS = ("rate", packed_key("samples", "<u4"), packed_key("angles", "<f4"))

    rate: float
    """Mean speed of the link about its declared axis in the replayed part [rad/s]."""
    samples: Ints
    """Indices of the simulation samples at which `angles` are stored. Shape (n,)."""
    angles: Floats
    """Angle by which the link has turned since the start, minus `rate` multiplied by the time [rad]. Shape (n,)."""


@dataclass(frozen=True, slots=True)
class SceneContact(Result):
    """Contact of a gear pair, a pin or an escapement as a function of time."""

    KEYS = (
        *("name", "kind", "body", "at", "apart", "coast", "impact_rate", "hardest"),
        *(packed_key("changes", "<u4"), "states", packed_key("impact_times"), packed_key("impact_speeds", "<f4")),
    )

    name: str
    """Name of the pair or coupling; for an escapement, name of its link."""
    kind: str
    """Kind of contact: pair, pin or escapement."""
    body: int
    """Index of the body that carries the contact point."""
    at: Vector
    """Position of the contact point in the zero pose [mm]."""
    apart: float
    """Fraction of the displayed simulation time during which no flank is in contact, 0 to 1."""
    coast: float
    """Fraction of the displayed simulation time during which the coast flank is in contact, 0 to 1."""
    impact_rate: float
    """Mean number of impacts per second [1/s]."""
    hardest: float
    """Maximum closing speed of all impacts, referred to the driven link [rad/s]."""
    changes: Ints
    """Indices of the samples at which the contact changes to the corresponding entry of `states`. Shape (n,)."""
    states: str
    """One letter per change: `d` for the drive flank, `c` for the coast flank, `a` for no contact; empty for a contact
    without flanks.
    """
    impact_times: Floats
    """Times of impacts since the start of the replayed part [s]. Shape (m,)."""
    impact_speeds: Floats
    """Closing speeds at the impacts, referred to the driven link [rad/s]. Shape (m,)."""


@dataclass(frozen=True, slots=True)
class SceneRun(Result):
    """Simulated motion of a train, ready to be replayed; angles in rad, times in s."""

    driven: str
    """Kind of drive that supplies power to the train."""
    link: str
    """Link at which power enters."""
    rate: float
    """Mean speed of the driving link [rad/s]."""
    period: float
    """Duration of one turn of the driving link at its mean speed [s]; if the mean speed is 0, the duration of the
    replayed part.
    """
    skip: float
    """Simulated time before the replayed part [s]."""
    duration: float
    """Duration of the replayed part [s]."""
    step: float
    """Time between samples of the replayed part [s]."""
    tolerance: float
    """Maximum difference between stored and simulated angles [rad]; for the driving link, the difference is smaller."""
    torque: float
    """Mean torque at the link where power enters [N m]."""
    complete: bool
    """True if the simulation ran to its end, False if it stopped earlier."""
    links: Sequence[LinkCourse]
    """Angles of the links, in the order of the scene's bodies."""
    contacts: Sequence[SceneContact]
    """Contacts of teeth, pins and the escapement."""
    deviations: Sequence[Annotated[Any, WingResult("simulation.time.time_run", "OutputDeviation")]]
    """Maximum angles by which each output leads and lags the motion with all drive flanks in contact [rad]."""
    notes: Sequence[str]
    """Simplifications of the simulation and of its replay: neglected effects, and links that are drawn as one link."""


# ------------------------------------------------------------------------------------------------- from a simulated run


TOLERANCE = 1e-4
"""Maximum difference between the angles on a page and the simulated angles [rad]."""
_TOUCHES = 1e-9  # rad: smaller gaps are rounding errors of angles
_FLAT = 1e6  # ratio of the scales of time and angle, so that deviations from a line are measured along the angle


@dataclass(frozen=True)
class ShownSamples:
    """Samples of the evaluated part of a run, including the sample at time 0, which the run does not store."""

    run: TimeRun

    @cached_property
    def _picked(self) -> Bools:
        return np.asarray(self.run.time > self.run.skip - self.run.step / 2)

    def of(self, values: Floats, first: float = 0.0) -> Floats:
        """Return the values at the samples that a page replays.

        first   value at time 0, which is not in `values`, for a replay that starts at time 0
        """
        picked = values[self._picked]
        return np.concatenate(([first], picked)) if self.run.skip == 0 else picked

    @cached_property
    def start(self) -> float:
        """Time of the first replayed sample [s]."""
        return float(self.of(self.run.time)[0])

    @cached_property
    def time(self) -> Floats:
        """Times of the replayed samples, measured from the first replayed sample [s]."""
        return self.of(self.run.time) - self.start

    @property
    def step(self) -> float:
        """Time between replayed samples [s]."""
        return float(self.time[-1]) / (len(self.time) - 1)

    def link(self, turned: Floats, tolerance: float) -> LinkCourse:
        """Return the mean speed and the deviations of a link, from its angles `turned` at all samples [rad].

        tolerance   maximum error of the simplified angles [rad]
        """
        shown = self.of(turned)
        # without the mean motion the stored angles are small, so that float32 has enough digits for them
        rate = float(shown[-1] - shown[0]) / float(self.time[-1])
        line = shown - rate * self.time
        kept = simplified(np.column_stack((_FLAT * self.time, line)), tolerance)
        return LinkCourse(rate, np.array(kept), line[kept])

    def states(self, contact: str) -> tuple[Ints, str]:
        """Return the samples at which a contact's state changes, and its states as letters; empty without flanks."""
        if contact not in self.run.gaps.labels[0]:
            return np.zeros(0, dtype=np.int64), ""
        front, back = (self.of(gaps[contact]) for gaps in (self.run.gaps, self.run.coast_gaps))
        on_front = (front <= back) | (front <= _TOUCHES)  # without backlash a pair is on both
        # index of a letter of "dca"
        code = np.where(np.minimum(front, back) > _TOUCHES, 2, np.where(on_front, 0, 1))
        changes = np.concatenate(([0], 1 + np.flatnonzero(np.diff(code))))
        return changes, "".join("dca"[each] for each in code[changes])

    def impacts(self, contact: str) -> tuple[Floats, Floats]:
        """Return the times [s] and closing speeds [rad/s] of the impacts of a contact, merged within each sample."""
        own = np.array([name == contact for name in self.run.impacts.contact], dtype=bool)
        times, speeds = self.run.impacts.time[own] - self.start, self.run.impacts.speed[own]
        if not len(times):
            return times, speeds
        first = np.concatenate(([0], 1 + np.flatnonzero(np.diff(np.floor(times / self.step)))))
        return times[first], np.maximum.reduceat(speeds, first)


def find_run(
    stage: SceneContext,
    run: TimeRun,
    moves: Mapping[str, str],
    movement: Movement,
    wheels: Sequence[SceneWheel],
    pairs: Sequence[ScenePair],
    couplings: Sequence[SceneCoupling],
) -> SceneRun:
    """Return the evaluated part of a run for replay on a page.

    Raise `QuestionError` if the run is of another train or state.

    moves   for each link, the link of the run that has the same motion
    """
    if (run.train, run.state) != (stage.train.name, stage.answer.state):
        what = f"the run of {run.train}{f', state {run.state}' if run.state else ''} does not belong to this scene"
        why = f"the scene is of {stage.train.name}{f', state {stage.answer.state}' if stage.answer.state else ''}"
        raise QuestionError(Problem(what, why, "pass the run of the same train in the same state"))
    samples = ShownSamples(run)
    places = dict(_places(stage, wheels, pairs, couplings))
    contacts = tuple(
        SceneContact(
            each.name,
            *places[each.name],
            each.apart,
            each.coast,
            each.impact_rate,
            each.hardest,
            *samples.states(each.name),
            *samples.impacts(each.name),
        )
        for each in run.contacts
    )
    links = stage.train.declaration.links
    duration = float(samples.time[-1])
    notes = list(run.notes)
    if movement.kind == "mean":
        notes.append(f"initial angles are those of the mean motion, without transmission errors; {movement.why}")
    kept = len(run.impacts.time)
    if run.impacts.total > kept:
        last = run.impacts.time[-1] - run.skip
        notes.append(f"impacts after {last:.4g} s are not shown: the first {kept} of {run.impacts.total} are kept")
    return SceneRun(
        driven=run.driven,
        link=run.link,
        rate=run.rate,
        period=tau / abs(run.rate) if run.rate else duration,
        skip=run.skip,
        duration=duration,
        step=samples.step,
        tolerance=TOLERANCE,
        torque=run.torque,
        complete=run.complete,
        links=tuple(
            samples.link(run.angles[moves[link]] - stage.start(moves[link]), _tolerance(stage, link)) for link in links
        ),
        contacts=contacts,
        deviations=run.deviations,
        notes=tuple(notes),
    )


def _tolerance(stage: SceneContext, link: str) -> float:
    """Return the tolerance of stored angles [rad], smaller for the driving link, whose error all ratios multiply."""
    if link != stage.driving_link:
        return TOLERANCE
    ratios = (stage.ratio(each) for each in stage.train.declaration.links)
    return TOLERANCE / max(1.0, *(abs(float(ratio)) for ratio in ratios if ratio))


def _places(
    stage: SceneContext, wheels: Sequence[SceneWheel], pairs: Sequence[ScenePair], couplings: Sequence[SceneCoupling]
) -> Iterator[tuple[str, tuple[str, int, Vector]]]:
    """Yield each contact by name, with its kind, and the body and position [mm] of its contact point."""
    if (escapement := stage.train.declaration.escapement) is not None:
        link, rim = escapement.link, (0.0, 0.0, 0.0)
        own = [wheel for wheel in wheels if wheel.body == stage.body[link]]
        if own:  # pallets touch the largest wheel; an escape wheel has no mate among gears
            wheel = max([each for each in own if not each.circuits] or own, key=lambda each: each.radius)
            rim = plus(wheel.centre, wheel.reference, wheel.radius)
        yield link, ("escapement", stage.body[pallet_link(escapement, stage.train.kinematics.tree)], rim)
    for pair in pairs:
        yield pair.id, ("pair", pair.carrier, pitch_point(*(wheels[each] for each in pair.wheels)))
    for coupling in couplings:
        yield coupling.id, ("pin", coupling.pin, coupling.pin_at)


def pitch_point(one: SceneWheel, other: SceneWheel) -> Vector:
    """Return the pitch point of two wheels in the zero pose [mm], on the pitch circle of the ring or of `one`."""
    if other.kind == "ring":
        one, other = other, one
    way = across(minus(other.centre, one.centre), one.direction)
    if size(way) < 1e-9:  # wheels on one axis have no line of centres
        way = one.reference
    return plus(one.centre, unit_or_z(way), one.radius)
