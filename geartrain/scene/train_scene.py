"""A train as a scene: all that a picture of it needs, as plain data. Lengths in mm, angles in rad.

Everything stands in the zero pose: the one in which the angle of every link is zero. A body's angle about its
`direction`, after `t` turns of the lead, is

    A(t) = sense (start + 2 pi speed t + error(t))

with speed exact and error from `Movement`. The body is turned, as seen from its parent, by A(body) - A(parent) about
the line through `point` along `direction`, after its parent has carried that line along (the frame has A = 0).
"""
# Not in every train: the verdict's "advice" (trains that stand).

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, Literal

from geartrain.numerics.results import Shown, plain
from geartrain.numerics.vectors import Vector
from geartrain.scene.count_formulas import SceneFormulas
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

FORMAT = 1


@dataclass(frozen=True, slots=True)
class DialFace(Shown):
    """A scale over which pointers turn.

    See Also
    --------
    make_scene : gives it, in `Scene.dials`.
    """

    id: str
    """Its name."""
    body: int
    """Index of the body on which it stands."""
    face: str
    """Front or back, or a name of its own."""
    centre: Vector
    """Its middle [mm]."""
    normal: Vector
    """Unit vector along which the face looks."""
    zero: Vector
    """Unit vector from the middle to the zero mark."""
    radius: float
    """Of all that is engraved [mm]."""
    scale: DialScale
    """Its divisions, over its radius."""
    look: Literal["scale", "ball"] = "scale"
    """A scale with a pointer, or a ball in the pointer of the link on which it stands: then `radius` is that of the
    ball, `normal` the direction of the axis about which it turns, through its middle."""
    note: str = ""
    """As declared."""
    plate: float = 0.0
    """Radius of the disc on which it is engraved, which is one of the scene's parts [mm]; 0 where none is made."""
    seated: bool = False
    """Whether it turns on the end of an arbor or pipe, with a hand of the dial below it."""
    title: str = ""
    """What stands over it: its name, and in brackets the outputs read on it where the dial stands about several
    axes."""
    engraving: Sequence[tuple[str, float, Sequence[Sequence[int]]]] = ()
    """What is engraved: rim, fine, bold or letters, the width of lines over the radius, and lines in 4,000ths of it:
    x to the reader's right and y to the zero mark, first from the middle, then from point to point."""


@dataclass(frozen=True, slots=True)
class PointerTarget(Shown):
    """What an output should show.

    See Also
    --------
    make_scene : gives it, in `Pointer.targets`.
    """

    label: str
    """The target in words."""
    speed: str
    """Over the lead's, exact; of a target without a sense, in that of the output."""
    source: str = ""
    """Key of its source; empty where it names none."""


@dataclass(frozen=True, slots=True)
class SceneEpoch(Shown):
    """The date at which the lead has made some turns, and what a turn lasts.

    See Also
    --------
    make_scene : gives it, in `Scene.epoch`.
    """

    julian_day: str
    """Of that date, exact [d]."""
    turns: str
    """That the lead has made by then, exact."""
    days: str
    """That one turn of the lead lasts, exact; negative where the lead turns against its positive sense."""
    calendar: str | None
    """In which dates are told; None for Julian before 1582-10-15 and Gregorian from then on."""
    source: str
    """Source as declared."""
    note: str
    """Note as declared."""


@dataclass(frozen=True, slots=True)
class Pointer(Shown):
    """An output as a pointer.

    See Also
    --------
    make_scene : gives it, in `Scene.pointers`.
    """

    output: str
    """Its name."""
    body: int
    """Index of the body that turns."""
    base: int
    """Index of the body from which it is seen."""
    dial: int | None
    """Index of its dial; None for an output without one, which gets a small one of its own in the picture."""
    speed: str | None
    """Over the lead's, exact; None where it is not determined."""
    shown: str | None
    """Exact speed at the declared inputs, in the train's unit."""
    decimal: str
    """Rounded speed at the declared inputs, in the train's unit."""
    sense: int
    """1 where a positive angle is clockwise for one who reads the dial, -1 where it is counter-clockwise."""
    text: str
    """What it shows, in words."""
    pairs: Sequence[str]
    """Names of the pairs and couplings on which the output depends, in order from the input."""
    bodies: Sequence[int]
    """Indices of the bodies of its path."""
    wheels: Sequence[int]
    """Indices of the wheels of its path."""
    note: str = ""
    """As declared."""
    targets: Sequence[PointerTarget] = ()
    """What it should show, in the order declared; none where nothing is driven, or it is not determined."""
    level: float = 0.0
    """How high the middle of its hand stands over its dial [mm]."""
    seat: float = 0.0
    """Diameter of the arbor or pipe on whose end the hand sits [mm]; 0 where none is made."""
    reach: float = 0.0
    """Length of its hand over the radius of its scale."""
    outline: Sequence[tuple[float, float]] = ()
    """Of its hand, over its length: how far from the axis, and half its width there; none without a dial."""


@dataclass(frozen=True, slots=True)
class Scene(Shown):
    """A train in one state, ready to be drawn: plain data, in mm and rad.

    See Also
    --------
    make_scene : gives it.
    """

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    note: str
    """Note of the train."""
    state: str | None
    """The state; None where the train has none."""
    unit: str
    """Unit of speeds."""
    positive: str
    """Declared sense of a positive speed."""
    front: int
    """Side of z from which it is looked at, 1 or -1."""
    driving_link: int | None
    """Index of the body whose turns are given."""
    crank: int | None
    """Index of the body at which a hand would turn the train."""
    step: str
    """Turns of the lead in one unit of the input, exact."""
    verdict: Mapping[str, Any]
    """Kind, text, the offending loops: {"pairs": [...], "links": [...], "text": ...}, and "advice", a list of
    sentences that say what would free it."""
    bodies: Sequence[SceneBody]
    """Links, in the order declared, which is that of indices."""
    wheels: Sequence[SceneWheel]
    """In the order declared, which is that of indices."""
    profiles: Sequence[ToothProfile]
    """Tooth forms that wheels share."""
    pairs: Sequence[ScenePair]
    """Gear pairs."""
    couplings: Sequence[SceneCoupling]
    """Pins in slots."""
    dials: Sequence[DialFace]
    """Scales."""
    pointers: Sequence[Pointer]
    """Outputs; of a train that declares none, its links, a hundred at most."""
    movement: Movement
    """How angles differ from exact ones, for positive turns."""
    sources: Mapping[str, Mapping[str, str]]
    """Citations by key."""
    notices: Sequence[Mapping[str, str]]
    """What could not be placed or followed, and why: {"what", "why", "fix", "place"}."""
    back: Movement | None = None
    """The movement while the lead turns against its declared sense, on the other flanks; None where it is the same."""
    unit_days: str | None = None
    """Length of the unit in days, exact, where it is a time; None elsewhere."""
    elements: Sequence[SceneShiftElement] = ()
    """Brakes and clutches, in the order declared; which are closed."""
    epoch: SceneEpoch | None = None
    """A date for turns of the lead, where one is declared."""
    formulas: SceneFormulas | None = None
    """Speeds as functions of tooth counts, where they were asked for and there are any."""
    asks: bool = True
    """False where no output is declared, and links stand for outputs."""
    run: SceneRun | None = None
    """The simulated motion through time, which is then played; None where the train is turned by its crank."""
    parts: Sequence[ScenePart] = ()
    """Plates, pillars, arbors, pipes and all else that holds the wheels, of a train as built; else none."""
    hangers: Sequence[SceneHanger] = ()
    """The pendulum and the weight of a train as built that declares them; else none."""
    waves: Sequence[SceneWave] = ()
    """What bends thin wheels into their rings."""

    def _summary(self) -> str:
        state = "" if self.state is None else f" state {self.state}"
        return f"{self.name}{state}: {len(self.bodies)} bodies, {len(self.wheels)} wheels, {len(self.pairs)} gear pairs"

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; arrays as base64 of little-endian numbers, row by row; `run` only where there is one."""
        named = {each.name: plain(getattr(self, each.name)) for each in fields(self)}
        if self.run is None:
            del named["run"]
        return {"format": FORMAT} | named
