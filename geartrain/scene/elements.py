# Not in every train: `Coupling.slot_turn` (starting angles), the verdict's "advice" (trains that stand), heights in
# place of radii in the profiles of bevel and contrate wheels.
"""What a scene is made of. Lengths in mm, angles in rad, ratios exact as text (`-254/19`).

Everything stands in the zero pose: the one in which the angle of every link is zero. A body's angle about its
`direction`, after `t` turns of the lead, is

    A(t) = sense (start + 2 pi speed t + error(t))

with speed exact and error from `Movement`. The body is turned, as seen from its parent, by A(body) - A(parent) about
the line through `point` along `direction`, after its parent has carried that line along (the frame has A = 0).
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass
from typing import TYPE_CHECKING, Any

from geartrain.numerics.vectors import Vector

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[Any]

FORMAT = 1


@dataclass(frozen=True, slots=True)
class SceneBody:
    """A link.

    parent       index of the body that bears its axis; None for the frame
    axis         label of its axis; `point` (mm) and `direction` (unit), the reference direction of its parallels
    sense        -1 where the declared axis points against `direction`: its declared speed is about the other way
    speed        over the lead's, about its declared axis, exact; None where it is not determined
    shown        its speed at the declared inputs, exact, in the train's unit; `decimal`, the same rounded
    start        declared starting angle (rad)
    role         frame, carrier (bears a moving axis) or arbor
    bookkeeping  its speed is a sum over non-parallel joints, and no rotation
    """

    id: str
    parent: int | None
    axis: str
    point: Vector
    direction: Vector
    sense: int
    speed: str | None
    shown: str | None
    decimal: str
    start: float
    role: str
    bookkeeping: bool = False
    note: str = ""


@dataclass(frozen=True, slots=True)
class ToothProfile:
    """One tooth of a wheel, from the middle of a space to the middle of the next, the tooth's middle at angle 0.

    form    triangular, involute, cycloidal, ...; `standard` where none is declared, `likeness` without a flat outline
    points  radius (over the pitch radius) and angle (rad), in order of angle from -pi/z to pi/z, both ends there; of a
            bevel or contrate wheel the radius is 1 and the height over the pitch cone, along the back cone
    hole    True for a lantern's pin or another closed curve, whose points then go round it
    """

    form: str
    points: Sequence[tuple[float, float]]
    hole: bool = False


@dataclass(frozen=True, slots=True)
class SceneWheel:
    """A wheel of a body.

    kind       spur, ring, bevel, contrate, worm, pins
    centre     of its pitch circle (mm), on the axis through it along `direction` (unit, that of its body)
    reference  unit vector across the axis from which `turn`, the angle of its first tooth, is counted about `direction`
    radius     of its pitch circle (mm); `tip` and `root` radius (of a ring the tip is the smaller)
    cone, facing   as in a layout
    profile    index of the tooth's form
    layer      level in the stack; None off it
    status     surviving, reconstructed, hypothetical, or "" where nothing is said
    circuits   names of the gear pairs it belongs to
    loss       part of the power put in that is lost at its meshes, where loads and friction are declared
    """

    id: str
    body: int
    teeth: int
    kind: str
    centre: Vector
    direction: Vector
    reference: Vector
    turn: float
    radius: float
    tip: float
    root: float
    module: float
    thickness: float
    cone: float
    facing: int
    profile: int
    layer: int | None
    status: str
    source: str
    note: str
    doubt: str
    circuits: Sequence[str]
    loss: float | None = None


@dataclass(frozen=True, slots=True)
class ScenePair:
    """A gear pair: its wheels and its carrier by index.

    ratio   of its fundamental circuit, exact: (w_i - w_k) / (w_j - w_k)
    text    the circuit in words
    broken  it belongs to a loop that does not close, or lets the train not turn
    """

    id: str
    wheels: tuple[int, int]
    carrier: int
    ratio: str
    form: str
    text: str
    broken: bool = False
    fault: str = ""


@dataclass(frozen=True, slots=True)
class SceneCoupling:
    """A pin in a slot: bodies by index; where the pin is in the zero pose, and from where the slot runs (mm).

    pin_at      the pin's centre; `slot_at`, the slot's axis at the pin's height
    drawn       False where dimensions are not declared: sizes are then a likeness
    slot_turn   angle (rad) about the slot's direction by which the slot, in the zero pose, runs aside from the line
                slot_at -> pin_at: 0 unless starting angles are declared
    """

    id: str
    kind: str
    pin: int
    slot: int
    carrier: int
    pin_at: Vector
    slot_at: Vector
    pin_radius: float
    offset: float
    drawn: bool
    text: str
    slot_turn: float = 0.0


@dataclass(frozen=True, slots=True)
class DialFace:
    """A scale: on which body it stands, its middle, the way its face looks, where its zero mark is.

    turns, divisions   turns of its spiral, and cells along all of them
    radius             of the outermost turn (mm); `inner`, of the innermost
    """

    id: str
    body: int
    face: str
    centre: Vector
    normal: Vector
    zero: Vector
    radius: float
    inner: float
    turns: int
    divisions: int
    note: str = ""


@dataclass(frozen=True, slots=True)
class Pointer:
    """An output as a pointer: `body` seen from `base`, on a dial by index (or on one of its own for the picture).

    speed     over the lead's, exact; `shown`, at the declared inputs, in the train's unit
    sense     1 where a positive angle is clockwise for one who reads the dial, -1 where it is counter-clockwise
    pairs     names of the pairs and couplings that the output hangs on, in order from the input
    bodies, wheels   the same, by index
    """

    output: str
    body: int
    base: int
    dial: int | None
    speed: str | None
    shown: str | None
    decimal: str
    sense: int
    text: str
    pairs: Sequence[str]
    bodies: Sequence[int]
    wheels: Sequence[int]
    note: str = ""


@dataclass(frozen=True, slots=True)
class ErrorLawTable:
    """An error law as polynomials: `breaks` (n + 1,) from 0 to the period (rad); `coefficients` (n, degree + 1) of the
    error (rad of the driven side) in powers of the driver's angle less the middle of its cell."""

    pair: str
    period: float
    breaks: Floats
    coefficients: Floats
    uncertainty: float


@dataclass(frozen=True, slots=True)
class ErrorSource:
    """A pair that ripples; the driver's forward angle after `t` turns is

        S = start + period frac(cycles t) + forward (driver_sense error[driver] - carrier_sense error[carrier])

    and the pair adds sense law(S) to what it drives.
    """

    pair: str
    law: int
    driver: int
    carrier: int
    driver_sense: int
    carrier_sense: int
    cycles: str
    start: float
    forward: int
    sense: int


@dataclass(frozen=True, slots=True)
class ErrorStep:
    """error[bodies] = from_known error[known] + from_sources delta[sources]; together where `coupled`, else at once."""

    bodies: Sequence[int]
    known: Sequence[int]
    from_known: Sequence[Sequence[float]]
    sources: Sequence[int]
    from_sources: Sequence[Sequence[float]]
    coupled: bool


@dataclass(frozen=True, slots=True)
class Movement:
    """How errors follow from the turns of the lead: steps in order, then constant `offsets` by body (rad).

    kind   exact (nothing ripples), real (teeth or pins ripple), mean (they would, but cannot be followed: `why`), or
           still (no speed is determined: `why`)
    period turns of the lead after which all stands as before, exact; None where nothing repeats
    """

    kind: str
    why: str = ""
    period: str | None = None
    laws: Sequence[ErrorLawTable] = ()
    sources: Sequence[ErrorSource] = ()
    steps: Sequence[ErrorStep] = ()
    offsets: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Scene:
    """A train in one state, ready to be drawn.

    lead      index of the body whose turns are given; `crank`, that of the body at which a hand would turn it
    step      turns of the lead in one unit of the input, exact
    front     side of z from which it is looked at, 1 or -1; `positive`, the declared sense of a positive speed
    verdict   kind, text, the offending loops: {"pairs": [...], "links": [...], "text": ...}, and "advice", a list of
              sentences that say what would free it
    sources   citations by key
    notices   what could not be placed or followed, and why: {"what", "why", "fix", "place"}
    back      the movement for negative turns, when the other flanks drive; None where it is the same
    unit_days   length of the unit in days, exact, where it is a time; None elsewhere
    """

    name: str
    title: str
    note: str
    state: str | None
    unit: str
    positive: str
    front: int
    lead: int | None
    crank: int | None
    step: str
    verdict: Mapping[str, Any]
    bodies: Sequence[SceneBody]
    wheels: Sequence[SceneWheel]
    profiles: Sequence[ToothProfile]
    pairs: Sequence[ScenePair]
    couplings: Sequence[SceneCoupling]
    dials: Sequence[DialFace]
    pointers: Sequence[Pointer]
    movement: Movement
    sources: Mapping[str, Mapping[str, str]]
    notices: Sequence[Mapping[str, str]]
    back: Movement | None = None
    unit_days: str | None = None

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; float arrays as base64 of little-endian float64, row by row."""
        return {"format": FORMAT, **plain(self)}


def plain(value: Any) -> Any:
    """What JSON can say; two values that are written alike are alike."""
    if is_dataclass(value):
        return {each.name: plain(getattr(value, each.name)) for each in fields(value)}
    if isinstance(value, Mapping):
        return {key: plain(each) for key, each in value.items()}
    if hasattr(value, "dtype"):
        return b64encode(value.astype("<f8").tobytes()).decode("ascii")
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    return value
