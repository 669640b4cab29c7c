"""A train's simulated motion as a page carries it: angles at few samples, contacts, and impacts.

Sample n is `step n` seconds after the start of the part shown. Between the samples that are kept, a link's angle is

    turned(t) = rate t + line(t)

with `line` straight from each to the next, within `tolerance` of every sample that the simulation gave.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import tau
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, TypeAlias

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.arrays import packed
from geartrain.numerics.polylines import simplified
from geartrain.numerics.results import Key, Result
from geartrain.numerics.vectors import Vector, across, minus, plus, size, unit_or_z
from geartrain.wings import WingResult

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.scene.context import SceneContext
    from geartrain.scene.elements import SceneCoupling, ScenePair, SceneWheel
    from geartrain.scene.movement import Movement

TimeRun: TypeAlias = Any
"""A `geartrain.simulation.TimeRun`; scenes do not import that wing, not even for types."""


@dataclass(frozen=True, slots=True)
class LinkCourse(Result):
    """The angle of a link through time.

    See Also
    --------
    SceneRun : holds one for each body.
    """

    KEYS: ClassVar[tuple[str | Key, ...]] = ("rate", Key("samples", "packed_samples"), Key("angles", "packed_angles"))

    rate: float
    """Its mean speed about its declared axis [rad/s]."""
    samples: Ints
    """Numbers of the samples that are kept. Shape (n,)."""
    angles: Floats
    """By how much it has turned since the start, less `rate` times the time [rad]. Shape (n,)."""

    @property
    def packed_samples(self) -> str:
        """The samples as a page carries them: base64 of little-endian uint32."""
        return packed(self.samples, "<u4")

    @property
    def packed_angles(self) -> str:
        """The angles as a page carries them: base64 of little-endian float32."""
        return packed(self.angles, "<f4")


@dataclass(frozen=True, slots=True)
class SceneContact(Result):
    """What teeth, a pin or an escapement do through time.

    See Also
    --------
    SceneRun : holds these.
    """

    KEYS: ClassVar[tuple[str | Key, ...]] = (
        "name",
        "kind",
        "body",
        "at",
        "apart",
        "coast",
        "impact_rate",
        "hardest",
        Key("changes", "packed_changes"),
        "states",
        Key("impact_times", "packed_times"),
        Key("impact_speeds", "packed_speeds"),
    )

    name: str
    """The pair or coupling; of an escapement its link."""
    kind: str
    """What it is."""
    body: int
    """Index of the body with which the place of its contact moves."""
    at: Vector
    """That place in the zero pose [mm]."""
    apart: float
    """Share of time in which no flank touches."""
    coast: float
    """Share of time on the coast flank."""
    impact_rate: float
    """Impacts a second [1/s]."""
    hardest: float
    """Greatest closing speed of one, of the driven side [rad/s]."""
    changes: Ints
    """Samples from which `states` hold. Shape (n,)."""
    states: str
    """One letter each: `d` on the drive flank, `c` on the coast flank, `a` apart; empty where that is not known."""
    impact_times: Floats
    """Times of impacts since the start of what is shown [s]. Shape (m,)."""
    impact_speeds: Floats
    """Closing speeds of the driven side at impacts [rad/s]. Shape (m,)."""

    @property
    def packed_changes(self) -> str:
        """The samples as a page carries them: base64 of little-endian uint32."""
        return packed(self.changes, "<u4")

    @property
    def packed_times(self) -> str:
        """The times as a page carries them: base64 of little-endian float64."""
        return packed(self.impact_times)

    @property
    def packed_speeds(self) -> str:
        """The speeds as a page carries them: base64 of little-endian float32."""
        return packed(self.impact_speeds, "<f4")


@dataclass(frozen=True, slots=True)
class SceneRun(Result):
    """A train in time, ready to be played; angles in rad, times in s.

    See Also
    --------
    make_scene : gives it, in `Scene.run`.
    """

    driven: str
    """What drives it."""
    link: str
    """Where power enters."""
    rate: float
    """Mean speed of the lead [rad/s]."""
    period: float
    """In which the lead would turn once at that speed [s]."""
    skip: float
    """Time before what is shown [s]."""
    duration: float
    """Time that is shown [s]."""
    step: float
    """From one sample of the simulation to the next [s]."""
    tolerance: float
    """Within which angles are those of the simulation [rad]."""
    torque: float
    """Mean torque where power enters [N m]."""
    complete: bool
    """False if the simulation was stopped before its end."""
    links: Sequence[LinkCourse]
    """Angles, in the order of bodies."""
    contacts: Sequence[SceneContact]
    """Teeth, pins and the escapement."""
    deviations: Sequence[Annotated[Any, WingResult("simulation", "OutputDeviation")]]
    """How far outputs are ahead of `motion` and behind."""
    notes: Sequence[str]
    """What is left out, and what is drawn as one."""


# ------------------------------------------------------------------------------------------------- from a simulated run


TOLERANCE = 1e-4
"""Within which angles of a page are those of the simulation (rad)."""
_TOUCHES = 1e-9  # rad: gaps that are rounding of angles
_FLAT = 1e6  # of times over angles: what is off a line is then off upwards


@dataclass(frozen=True)
class ShownSamples:
    """The samples of the counted part of a run, with the one at time 0, which a run does not keep."""

    run: TimeRun

    @cached_property
    def _picked(self) -> Bools:
        return np.asarray(self.run.time > self.run.skip - self.run.step / 2)

    def of(self, values: Floats, first: float = 0.0) -> Floats:
        """Those of these values; `first` at time 0."""
        picked = values[self._picked]
        return np.concatenate(([first], picked)) if self.run.skip == 0 else picked

    @cached_property
    def start(self) -> float:
        """Time of the first (s)."""
        return float(self.of(self.run.time)[0])

    @cached_property
    def time(self) -> Floats:
        """Since the first (s)."""
        return self.of(self.run.time) - self.start

    @property
    def step(self) -> float:
        """From one to the next (s)."""
        return float(self.time[-1]) / (len(self.time) - 1)

    def link(self, turned: Floats, tolerance: float) -> LinkCourse:
        """The course of a link that has turned by these angles, to within a tolerance (rad)."""
        shown = self.of(turned)
        rate = float(shown[-1] - shown[0]) / float(self.time[-1])
        line = shown - rate * self.time
        kept = simplified(np.column_stack((_FLAT * self.time, line)), tolerance)
        return LinkCourse(rate, np.array(kept), line[kept])

    def states(self, contact: str) -> tuple[Ints, str]:
        """Samples from which a flank touches or none does, and which; none of what has no flanks."""
        if contact not in self.run.gaps.labels[0]:
            return np.zeros(0, dtype=np.int64), ""
        front, back = (self.of(gaps[contact]) for gaps in (self.run.gaps, self.run.coast_gaps))
        on_front = (front <= back) | (front <= _TOUCHES)  # without play a pair is on both
        code = np.where(np.minimum(front, back) > _TOUCHES, 2, np.where(on_front, 0, 1))
        changes = np.concatenate(([0], 1 + np.flatnonzero(np.diff(code))))
        return changes, "".join("dca"[each] for each in code[changes])

    def impacts(self, contact: str) -> tuple[Floats, Floats]:
        """Times and closing speeds of a contact's blows; of those within one sample the first time, the most speed."""
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
    """What a page plays of a run: its counted part. Raises `QuestionError` if it is of another train or state.

    moves   link -> the link of the run that moves as it does
    """
    if (run.train, run.state) != (stage.train.name, stage.answer.state):
        what = f"a run of {run.train}{f', state {run.state}' if run.state else ''}"
        why = f"the scene is of {stage.train.name}{f', state {stage.answer.state}' if stage.answer.state else ''}"
        raise QuestionError(Problem(what, why, "give the run of the same train in the same state"))
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
        links=tuple(samples.link(_turned(stage, run, moves[link]), _tolerance(stage, link)) for link in links),
        contacts=contacts,
        deviations=run.deviations,
        notes=(*run.notes, *_left_out(run, movement)),
    )


def _turned(stage: SceneContext, run: TimeRun, link: str) -> Floats:
    """By how much a link has turned from where it is declared to start (rad)."""
    found: Floats = run.angles[link] - stage.start(link)
    return found


def _tolerance(stage: SceneContext, link: str) -> float:
    """Finer for the lead: by its angle the page says where all other links would stand if teeth touched."""
    if link != stage.driving_link:
        return TOLERANCE
    ratios = (stage.ratio(each) for each in stage.train.declaration.links)
    return TOLERANCE / max(1.0, *(abs(float(ratio)) for ratio in ratios if ratio))


def _left_out(run: TimeRun, movement: Movement) -> Iterator[str]:
    if movement.kind == "mean":
        yield f"wheels start where mean speeds have them, to within what their teeth ripple; {movement.why}"
    kept = len(run.impacts.time)
    if run.impacts.total > kept:
        last = run.impacts.time[-1] - run.skip
        yield f"impacts after {last:.4g} s are not shown: the first {kept} of {run.impacts.total} are kept"


def _places(
    stage: SceneContext, wheels: Sequence[SceneWheel], pairs: Sequence[ScenePair], couplings: Sequence[SceneCoupling]
) -> Iterator[tuple[str, tuple[str, int, Vector]]]:
    """By contact: what it is, the body with which its place moves, and that place in the zero pose (mm)."""
    if (escapement := stage.train.declaration.escapement) is not None:
        link = escapement.link
        own = [wheel for wheel in wheels if wheel.body == stage.body[link]]
        yield link, ("escapement", stage.body[stage.train.kinematics.tree.top[link]], _rim(own))
    for pair in pairs:
        yield pair.id, ("pair", pair.carrier, pitch_point(*(wheels[each] for each in pair.wheels)))
    for coupling in couplings:
        yield coupling.id, ("pin", coupling.pin, coupling.pin_at)


def _rim(wheels: Sequence[SceneWheel]) -> Vector:
    """Where pallets would meet the escape wheel, which meshes with nothing; else the largest of the link."""
    if not wheels:
        return (0.0, 0.0, 0.0)
    free = [wheel for wheel in wheels if not wheel.circuits] or wheels
    wheel = max(free, key=lambda each: each.radius)
    return plus(wheel.centre, wheel.reference, wheel.radius)


def pitch_point(one: SceneWheel, other: SceneWheel) -> Vector:
    """Where the teeth of two wheels meet in the zero pose (mm): on a pitch circle, towards the other axis."""
    if other.kind == "ring":
        one, other = other, one
    way = across(minus(other.centre, one.centre), one.direction)
    if size(way) < 1e-9:
        way = one.reference
    return plus(one.centre, unit_or_z(way), one.radius)
