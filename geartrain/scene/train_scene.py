"""Scene of a train: all data that are required to draw the train, as plain data. Lengths are in mm, angles in rad.

Positions are given in the zero pose, in which the angle of every link is zero. The angle of a body about its
`direction`, after `t` turns of the driving link, is

    A(t) = sense (start + 2 pi speed t + error(t))

with the exact speed, and the error computed from `Movement`. Relative to its parent, the body is rotated by A(body) -
A(parent) about the line through `point` along `direction`, after the parent has moved that line with it (the frame has
A = 0).
"""
# Not in every train: the verdict's "advice" (only for trains that cannot turn).

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any, Literal

from geartrain.numerics.results import Shown, plain
from geartrain.numerics.vectors import Vector
from geartrain.scene.dial_scale import DialScale
from geartrain.scene.elements import (
    SceneBody,
    SceneCoupling,
    SceneHanger,
    ScenePair,
    ScenePart,
    SceneShiftElement,
    SceneWave,
    SceneWheel,
    ToothProfile,
)
from geartrain.scene.movement import Movement
from geartrain.scene.scene_run import SceneRun


@dataclass(frozen=True, slots=True)
class CountFormula(Shown):
    """Ratio of two polynomials in tooth counts with integer coefficients, which gives one speed or one condition."""

    wheels: Sequence[int]
    """Indices in `SceneFormulas.wheels` of the tooth counts in the formula; an index is repeated for equal planets that
    share a tooth count.
    """
    numerator: Sequence[tuple[str, Sequence[int]]]
    """Terms of the numerator. Each term is a coefficient (as text) and the power, 0 or more, of the tooth count of each
    entry of `wheels`.
    """
    denominator: Sequence[tuple[str, Sequence[int]]]
    """Terms of the denominator, in the same form as the terms of the numerator."""


@dataclass(frozen=True, slots=True)
class CountCondition(Shown):
    """Condition on tooth counts under which the formulas of a scene are valid."""

    formula: CountFormula
    """Function of the tooth counts that must be 0, or must not be 0."""
    zero: bool
    """True if the value of `formula` must be 0, False if it must differ from 0."""
    text: str
    """Description of the condition, such as `loop a - b - c closes`."""
    carrier: int | None = None
    """Index of the body relative to which the wheels of a loop turn; None if the condition does not concern a loop."""


@dataclass(frozen=True, slots=True)
class SceneFormulas(Shown):
    """Speeds of a scene as functions of tooth counts, at the declared inputs and in the train's unit."""

    wheels: Sequence[str]
    """Names of the declared wheels whose tooth counts can be changed."""
    count: Sequence[int | None]
    """Index in `wheels` of the tooth count of each wheel of the scene; None if the tooth count cannot be changed."""
    formulas: Sequence[CountFormula]
    """Distinct functions of the tooth counts, to which `bodies` and `pointers` refer."""
    bodies: Sequence[int | None]
    """Index in `formulas` of the speed of each body of the scene; None if the speed is not determined."""
    pointers: Sequence[int | None]
    """Index in `formulas` of the speed of each pointer of the scene; None if the speed is not determined."""
    conditions: Sequence[CountCondition]
    """Conditions of validity. If one is violated, the formulas do not describe the motion."""
    input: str
    """Exact declared speed of the driving link, in the train's unit, as text."""
    exact: bool
    """True if speeds are displayed as fractions, False if as decimals."""
    parent: str
    """Name of the bundled example or of the file that is extended by the declaration of a train with changed tooth
    counts.
    """


FORMAT = 1


@dataclass(frozen=True, slots=True)
class DialFace(Shown):
    """Dial of a scene: a scale over which pointers turn, or a ball that is mounted in a pointer."""

    id: str
    """Name of the dial."""
    body: int
    """Index of the body on which the dial is mounted."""
    face: str
    """Face of the train on which the dial is: front, back or another declared name; empty if none is declared."""
    centre: Vector
    """Centre of the dial [mm]."""
    normal: Vector
    """Unit vector perpendicular to the face, towards the reader of the dial."""
    zero: Vector
    """Unit vector from the centre to the zero mark."""
    radius: float
    """Radius of the whole engraving [mm]."""
    scale: DialScale
    """Divisions of the scale; its radii are relative to `radius`."""
    look: Literal["scale", "ball"] = "scale"
    """Appearance: a scale with a pointer, or a ball in the pointer of the link on which it is mounted. For a ball,
    `radius` is the radius of the ball, and `normal` is the direction of its axis of rotation, which passes through its
    centre.
    """
    note: str = ""
    """Declared note on the dial; empty if none is declared."""
    plate: float = 0.0
    """Radius of the engraved disc, which is one of the scene's parts [mm]; 0 if the scene has no such disc."""
    placed: bool = False
    """True if the centre of the dial is declared and its pointers turn about this centre; False if its position is
    computed.
    """
    seated: bool = False
    """True if the dial turns on the end of an arbor or pipe, together with a hand of the dial below it."""
    title: str = ""
    """Caption: the name of the dial. If dials on several axes have this name, its outputs follow in brackets."""
    engraving: Sequence[tuple[str, float, Sequence[Sequence[int]]]] = ()
    """Engraved lines: kind (rim, fine, bold or letters), width relative to the radius, and points in units of 1/4,000
    of the radius. The x axis points to the reader's right and the y axis to the zero mark. The first point of a line is
    relative to the centre, and each further point is relative to the previous point.
    """


@dataclass(frozen=True, slots=True)
class PointerTarget(Shown):
    """Target speed of an output, with which the speed of its pointer is compared."""

    label: str
    """Name of the target speed."""
    speed: str
    """Exact target speed, divided by the speed of the driving link. A target without a sense of rotation has the sense
    of the output.
    """
    source: str = ""
    """Key of the source of the target; empty if no source is declared."""


@dataclass(frozen=True, slots=True)
class SceneSetting(Shown):
    """Angle to which a pointer is set for a date, as a polynomial of the time."""

    pointer: int
    """Index of the pointer in `Scene.pointers`."""
    sense: int
    """1 if the angle is measured in the sense of the output, -1 if it is measured in the opposite sense."""
    angle: Sequence[float]
    """Coefficients of the angle [deg], in ascending powers of Julian centuries of Terrestrial Time since J2000.0."""
    body: str
    """Celestial body whose longitude the pointer shows, such as sun or moon_node; empty for other angles."""


@dataclass(frozen=True, slots=True)
class SceneEpoch(Shown):
    """Date that corresponds to a number of turns of the driving link, and the duration of one turn."""

    julian_day: str
    """Exact Julian day of the date [d]."""
    turns: str
    """Exact number of turns of the driving link at that date."""
    days: str
    """Exact duration of one turn of the driving link [d]; negative if the link turns against its positive sense."""
    calendar: str | None
    """Calendar in which dates are displayed. If it is None, the Julian calendar is used before 1582-10-15, and the
    Gregorian calendar from then on.
    """
    source: str
    """Declared source of the date; empty if none is declared."""
    note: str
    """Declared note on the date; empty if none is declared."""
    settings: Sequence[SceneSetting] = ()
    """Settings of the pointers at that date. Each pointer is listed after the pointer that determines the position of
    its base.
    """
    unset: Sequence[str] = ()
    """Names of the outputs that are read on a zodiac but whose pointers are not set."""
    elements: Mapping[str, Mapping[str, Sequence[float]]] = field(default_factory=dict)
    """Mean elements of the Earth, the Moon and the planets, by body and element, as polynomials like
    `SceneSetting.angle`: longitude and perihelion (for the Moon, perigee and node) [deg], eccentricity, distance [au];
    empty if `settings` is empty.
    """


@dataclass(frozen=True, slots=True)
class TourStop(Shown):
    """Stop on the declared guided tour of a scene, at which one part is described."""

    kind: str
    """Kind of the described part: output, link, wheel, dial or coupling."""
    name: str
    """Name of the part."""
    text: str
    """Declared text about the part."""


@dataclass(frozen=True, slots=True)
class Pointer(Shown):
    """Pointer of a scene, which shows one output of the train."""

    output: str
    """Name of the output."""
    body: int
    """Index of the body that turns with the pointer."""
    base: int
    """Index of the body relative to which the angle of the pointer is read."""
    dial: int | None
    """Index of the dial; None for an output without a dial, for which a small dial is drawn instead."""
    speed: str | None
    """Exact speed of the output divided by the speed of the driving link; None if it is not determined."""
    shown: str | None
    """Speed of the output at the declared inputs, in the train's unit, exact if the inputs are exact; None if the speed
    is not determined.
    """
    decimal: str
    """Rounded speed of the output at the declared inputs, in the train's unit; empty if it is not determined."""
    sense: int
    """1 if a positive angle is clockwise for a reader of the dial, -1 if it is counter-clockwise."""
    text: str
    """Description of the pointer's sense of rotation, such as `clockwise as read` or `at rest`; empty if its speed is
    not determined.
    """
    pairs: Sequence[str]
    """Names of the pairs and couplings on which the output depends, in order from the input."""
    bodies: Sequence[int]
    """Indices of the bodies on the path from the input to the output."""
    wheels: Sequence[int]
    """Indices of the wheels on the path from the input to the output."""
    note: str = ""
    """Declared note on the output; empty if none is declared."""
    targets: Sequence[PointerTarget] = ()
    """Target speeds of the output in the order of declaration; empty if no link is driven or the speed is not
    determined.
    """
    level: float = 0.0
    """Height of the middle of the hand above the dial [mm]."""
    seat: float = 0.0
    """Diameter of the arbor or pipe on whose end the hand is fitted [mm]; 0 if the scene has no such part."""
    reach: float = 0.0
    """Length of the hand divided by the radius of the scale; 0 for a pointer without a dial."""
    outline: Sequence[tuple[float, float]] = ()
    """Outline of the hand: pairs of the distance from the axis and the half width, divided by the length of the hand;
    empty for a pointer without a dial.
    """
    hand: str = "needle"
    """Declared shape of the hand."""
    ball: float = 0.0
    """Radius of the sphere at the end of the hand, divided by the radius of the dial; 0 if the hand has no sphere."""


@dataclass(frozen=True, slots=True)
class Scene(Shown):
    """Train in one state, ready to be drawn, as plain data. Lengths are in mm, angles in rad.

    See Also
    --------
    make_scene : returns it.
    """

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    note: str
    """Declared note on the train; empty if none is declared."""
    state: str | None
    """State of the train; None if it has no states."""
    unit: str
    """Unit of the speeds that are shown for bodies and pointers."""
    positive: str
    """Declared sense of rotation of a positive speed, as text."""
    front: int
    """Side from which the train is viewed: 1 for the side of positive z, -1 for negative z."""
    driving_link: int | None
    """Index of the body whose turns are prescribed; None if no link is driven."""
    crank: int | None
    """Index of the body that is turned by hand, which is the declared crank or the driving link; None if neither
    exists.
    """
    drive: Literal["hand", "motor", "spring", "weight"]
    """Kind of the declared drive. Without a declared drive, it is `motor` if the input speed is in real time, and
    `hand` if not.
    """
    fusee: Sequence[float]
    """Radii of the fusee of the drive at equally spaced angles from its start to its end [mm]; empty if there is none.
    """
    up: Vector
    """Unit vector that points up (against gravity), in picture coordinates: y, or the direction towards the observer in
    a view from above.
    """
    step: str
    """Exact number of revolutions of the input link per time unit of its speed (one minute for `100 rpm`); 1 if no
    input speed is declared.
    """
    verdict: Mapping[str, Any]
    """Verdict as plain data, with keys "kind", "text", "links", "loops" and "advice".

    A faulty loop is {"pairs": [...], "links": [...], "text": ...}. The advice is a list of sentences that propose a
    remedy.
    """
    bodies: Sequence[SceneBody]
    """Links, in the order of declaration, which is the order of their indices."""
    wheels: Sequence[SceneWheel]
    """Wheels, in the order of declaration, which is the order of their indices."""
    profiles: Sequence[ToothProfile]
    """Distinct tooth profiles, to which the wheels refer by index."""
    pairs: Sequence[ScenePair]
    """Gear pairs, in the order of declaration."""
    couplings: Sequence[SceneCoupling]
    """Pins in slots and in round holes, in the order of declaration."""
    dials: Sequence[DialFace]
    """Dials of the scene, with their scales."""
    pointers: Sequence[Pointer]
    """Pointers of the outputs, or of the first 100 links if no output is declared."""
    movement: Movement
    """Deviations of the bodies' angles from uniform motion while the driving link turns in its positive sense."""
    sources: Mapping[str, Mapping[str, str]]
    """Citation of each source, by key of the source."""
    notices: Sequence[Mapping[str, str]]
    """Problems of the layout, the teeth or the motion. Each has the keys "what", "why", "fix" and "place"."""
    back: Movement | None = None
    """Deviations of the bodies' angles while the driving link is reversed, with coast flanks in contact; None if equal
    to `movement`.
    """
    unit_days: str | None = None
    """Exact length of the train's unit in days, if the unit is a time; None for other units."""
    elements: Sequence[SceneShiftElement] = ()
    """Brakes and clutches, each engaged or open in this state, in the order of declaration."""
    epoch: SceneEpoch | None = None
    """Declared date and its relation to turns of the driving link. None if the date, the time unit or the driving link
    is missing, and for a simulated run.
    """
    tour: Sequence[TourStop] = ()
    """Stops of the declared guided tour of the train; empty if none is declared."""
    formulas: SceneFormulas | None = None
    """Speeds as functions of tooth counts; None if they are not requested or not available, or if a run is replayed."""
    asks: bool = True
    """True if outputs are declared; False if the scene shows links as outputs because none are declared."""
    run: SceneRun | None = None
    """Simulated motion to be replayed; None if the scene shows the motion without a simulation."""
    parts: Sequence[ScenePart] = ()
    """Plates, pillars, arbors, pipes and all other structural parts; empty if the scene was not built with parts."""
    hangers: Sequence[SceneHanger] = ()
    """Declared pendulum and weight with its line; empty if the scene was not built with parts."""
    waves: Sequence[SceneWave] = ()
    """Strain waves that deflect flexible wheels into mesh with their rings."""
    shapes: Sequence[ScenePart] = ()
    """Parts of couplings other than pins, such as belts, cams and stars. They also exist in a scene that was not built
    with structural parts.
    """

    def _summary(self) -> str:
        state = "" if self.state is None else f" state {self.state}"
        return f"{self.name}{state}: {len(self.bodies)} bodies, {len(self.wheels)} wheels, {len(self.pairs)} gear pairs"

    def to_dict(self) -> dict[str, Any]:
        """Return the scene as plain data, in which arrays are base64 text of little-endian numbers. A simulated run is
        included if there is one.
        """
        named = {each.name: plain(getattr(self, each.name)) for each in fields(self)}
        if self.run is None:
            del named["run"]
        return {"format": FORMAT} | named
