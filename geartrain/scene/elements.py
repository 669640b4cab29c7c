"""What is in a scene: links, wheels with their teeth, pairs, pins in slots; as built, supporting parts and hangers.

Lengths are in mm, angles in rad. Ratios are exact, as text (`-254/19`). Bodies, wheels and tooth forms are named by
their index in the scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from geartrain.numerics.results import Shown
from geartrain.numerics.vectors import Vector
from geartrain.scene.layout.wheel_reach import reach, span, web

# ------------------------------------------------------------------------------------------------------------- as built


@dataclass(frozen=True, slots=True)
class ScenePart(Shown):
    """What holds wheels, as it is made: a turned part, or a flat one; about its own z, its middle at `place`.

    See Also
    --------
    build_scene : gives it, in `Scene.parts`.
    """

    body: int
    """Index of the body to which it belongs."""
    name: str
    """Name in the list of parts."""
    kind: str
    """Of a part list: arbor, pipe, stud, collar, spacer, collet, barrel, pillar, post, foot, cock, pin, plate; frame
    for a plate of the frame, carrier for one that turns with a carrier or a ring, dial for one of dials."""
    place: Vector
    """Where it stands in the zero pose [mm]."""
    direction: Vector
    """Unit vector of its z axis."""
    across: Vector
    """Unit vector of its x axis."""
    bands: Sequence[tuple[float, float, float, float]] = ()
    """Of a turned part, from below: from and to along z, outside and inside radius [mm]."""
    outlines: Sequence[Sequence[float]] = ()
    """Of a flat part: its edge, then its holes, as x and y in turn [mm]."""
    height: float = 0.0
    """Thickness of a flat part, half of it to either side [mm]."""


@dataclass(frozen=True, slots=True)
class SceneHanger(Shown):
    """What hangs on a train: a pendulum, the line of a weight, or the weight.

    See Also
    --------
    build_scene : gives it, in `Scene.hangers`.
    """

    kind: Literal["pendulum", "line", "weight"]
    """A pendulum swings as its escape wheel lets it; a weight falls and its line grows as their barrel turns."""
    body: int
    """Index of the body by whose angle it moves."""
    point: Vector
    """Where it hangs [mm]."""
    direction: Vector
    """Unit vector along the axis about which it swings or turns."""
    down: Vector
    """Unit vector downwards, across that axis."""
    length: float
    """From where it hangs to the middle of the bob, or to the weight in the zero pose [mm]."""
    rate: float
    """Of a pendulum swings to and fro in a turn of its body; else how far a weight falls for each radian [mm]."""
    wide: float
    """Radius of the bob, the weight or the line [mm]."""
    parts: Sequence[ScenePart] = ()
    """What is turned for it, where it hangs in the zero pose: rod and bob, or the weight."""


# Not in every train: `SceneCoupling.slot_turn` (starting angles), heights in place of radii in the profiles of bevel
# and contrate wheels.


# ---------------------------------------------------------------------------------------------- links, wheels and pairs


@dataclass(frozen=True, slots=True)
class SceneBody(Shown):
    """A link of a scene, with the axis about which it turns.

    See Also
    --------
    make_scene : gives it, in `Scene.bodies`.
    """

    id: str
    """Name of the link."""
    parent: int | None
    """Index of the body that bears its axis; None for the frame."""
    axis: str
    """Label of its axis."""
    point: Vector
    """A point of the axis [mm]."""
    direction: Vector
    """Reference direction of the parallels of its axis, a unit vector."""
    sense: int
    """-1 where the declared axis points against `direction`: its declared speed is about the other way; else 1."""
    speed: str | None
    """Over the lead's, about its declared axis, exact; None where it is not determined."""
    shown: str | None
    """Exact speed at the declared inputs, in the train's unit."""
    decimal: str
    """Rounded speed at the declared inputs, in the train's unit."""
    start: float
    """Declared starting angle [rad]."""
    role: str
    """A carrier bears a moving axis."""
    bookkeeping: bool = False
    """True where its speed is a sum over non-parallel joints, and no rotation."""
    note: str = ""
    """As declared."""


@dataclass(frozen=True, slots=True)
class ToothProfile(Shown):
    """One tooth of a wheel, from the middle of a space to the middle of the next, the tooth's middle at angle 0.

    See Also
    --------
    make_scene : gives it, in `Scene.profiles`.
    """

    form: str
    """Triangular, involute, cycloidal, ...; `standard` where none is declared, `likeness` without a flat outline."""
    points: Sequence[tuple[float, float]]
    """Radius (over the pitch radius) and angle [rad], in order of angle from -pi/z to pi/z, both ends there; of a
    bevel or contrate wheel the radius is 1 and the height over the pitch cone, along the back cone."""
    hole: bool = False
    """True for a lantern's pin or another closed curve, whose points then go round it."""


@dataclass(frozen=True, slots=True)
class SceneWheel(Shown):
    """A wheel of a body.

    See Also
    --------
    make_scene : gives it, in `Scene.wheels`.
    """

    id: str
    """Its name."""
    body: int
    """Index of its body."""
    teeth: int
    """Tooth count; 1 where it is not known."""
    kind: str
    """Kind of wheel; `pins` is a lantern."""
    centre: Vector
    """Of its pitch circle, on its axis [mm]."""
    direction: Vector
    """Unit vector along the axis, that of its body."""
    reference: Vector
    """Unit vector across the axis, from which `turn` is counted."""
    turn: float
    """Angle of its first tooth about `direction` [rad]."""
    radius: float
    """Pitch radius [mm]."""
    tip: float
    """Tip radius [mm]; of a ring less than the root radius."""
    root: float
    """Root radius [mm]."""
    module: float
    """Pitch diameter over tooth count [mm]."""
    thickness: float
    """Of its rim along the axis [mm]."""
    cone: float
    """Half angle of its pitch cone [rad]: 0 of a cylinder, pi/2 of a crown wheel."""
    facing: int
    """Side of the axis to which the cone opens: 1 or -1; 0 of a cylinder."""
    profile: int
    """Index of the tooth's form."""
    layer: int | None
    """Level in the stack; None off it."""
    status: str
    """Surviving, reconstructed, hypothetical, or empty where nothing is said."""
    source: str
    """Source as declared."""
    note: str
    """Note as declared."""
    doubt: str
    """Counts that the evidence allows, in words; empty for a sure count."""
    circuits: Sequence[str]
    """Names of the gear pairs it belongs to."""
    loss: float | None = None
    """Part of the power put in that is lost at its meshes, where loads and friction are declared."""
    helix: float = 0.0
    """Angle of its teeth, of a worm of its thread, from the axis [rad], of a right hand above 0."""
    holes: Sequence[Sequence[float]] = ()
    """As it is built, outlines of what is cut out of it for pins that move in it, or for an eccentric in which it
    turns, as x and y in turn from its middle, x through its first tooth [mm]."""

    @property
    def span(self) -> tuple[float, float]:
        """Between which places its body stands, from its centre along its direction [mm]."""
        depths = self.root - self.radius, self.tip - self.radius
        return span(self.facing, *reach(self.cone, self.radius, self.thickness, *depths))

    @property
    def web(self) -> tuple[float, float]:
        """The same of the disc within its teeth."""
        return span(self.facing, *web(self.cone, self.radius, self.thickness, self.root - self.radius))


@dataclass(frozen=True, slots=True)
class ScenePair(Shown):
    """A gear pair of a scene.

    See Also
    --------
    make_scene : gives it, in `Scene.pairs`.
    """

    id: str
    """Its name."""
    wheels: tuple[int, int]
    """Indices of its wheels."""
    carrier: int
    """Index of the body that carries both axes."""
    ratio: str
    """Of its fundamental circuit, exact: (w_i - w_k) / (w_j - w_k), equation (4) of docs/theory.md."""
    form: str
    """Tooth form; empty where none is declared."""
    text: str
    """The circuit in words."""
    broken: bool = False
    """True if it belongs to a loop that does not close, or lets the train not turn."""
    fault: str = ""
    """The loop in words."""


@dataclass(frozen=True, slots=True)
class SceneCoupling(Shown):
    """A pin in a slot, or pins in round holes.

    See Also
    --------
    make_scene : gives it, in `Scene.couplings`.
    """

    id: str
    """Its name."""
    kind: str
    """Its kind."""
    pin: int
    """Index of the body of the pin."""
    slot: int
    """Index of the body of the slot."""
    carrier: int
    """Index of the body that carries both axes."""
    pin_at: Vector
    """Centre of the pin in the zero pose [mm]."""
    slot_at: Vector
    """Axis of the slot at the height of the pin [mm]."""
    pin_radius: float
    """Distance of the pin from its axis [mm]."""
    offset: float
    """Distance of the two axes [mm]."""
    drawn: bool
    """False where dimensions are not declared: sizes are then chosen for the picture."""
    text: str
    """The circuit in words."""
    slot_turn: float = 0.0
    """Angle about the slot's direction by which the slot, in the zero pose, runs aside from the line from `slot_at`
    to `pin_at` [rad]: 0 unless starting angles are declared."""
    pins_at: Sequence[Vector] = ()
    """Middles of all pins in round holes in the zero pose [mm]; none of a pin in a slot."""
    holes_at: Sequence[Vector] = ()
    """Middles of these holes in the zero pose [mm]; none of a pin in a slot."""
    pin_diameter: float = 0.0
    """Diameter of such a pin [mm]; 0 of a pin in a slot."""
    hole: float = 0.0
    """Diameter of such a hole [mm]; 0 of a pin in a slot."""


@dataclass(frozen=True, slots=True)
class SceneShiftElement:
    """A brake or a clutch.

    See Also
    --------
    make_scene : gives it, in `Scene.elements`.
    """

    id: str
    """Its name, and brake or clutch."""
    kind: Literal["brake", "clutch"]
    """Its name, and brake or clutch."""
    bodies: Sequence[int]
    """Indices of what it holds to the frame, or of the two that it joins."""
    closed: bool
    """Whether it is closed in this state."""
    text: str
    """What it is and does, such as `B brakes ring`."""


@dataclass(frozen=True, slots=True)
class SceneWave(Shown):
    """What bends a thin wheel into its ring as it goes round; wheel and wall of its cup stand about one axis with it.

    See Also
    --------
    make_scene : gives it, in `Scene.waves`.
    """

    wheel: int
    """Index of the wheel."""
    by: int
    """Index of the body whose angle is that of the wave."""
    towards: Vector
    """Unit vector across the axis: to the first lobe in the zero pose."""
    rise: float
    """How far the middle line of the wheel's wall goes out at a lobe, and in between lobes [mm]."""
    lobes: int
    """How many of them."""
    middle: float
    """Radius of the middle line of the wall in the round wheel [mm]."""
    wall: float
    """Thickness of the wall [mm]."""
