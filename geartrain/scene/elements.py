"""Records of a scene: links, wheels with their teeth, gear pairs, pins in slots, structural parts and hanging parts.

Lengths are in mm, angles in rad. Ratios are exact strings (`-254/19`). Bodies, wheels and tooth profiles are referenced
by their indices in the scene.
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
    """Structural part as manufactured, such as an arbor or a plate.

    A turned part has `bands`, and a flat part has `outlines`. The z axis of the part passes through `place`, which is
    at mid-height of a flat part.
    """

    body: int
    """Index of the body to which the part belongs."""
    name: str
    """Name of the part in the parts list."""
    kind: str
    """Kind of the part in the parts list: arbor, pipe, stud, collar, spacer, collet, barrel, pillar, post, drum, foot,
    cock, pin, plate. Plates of the frame have the kind `frame`, plates that turn with a carrier or a ring `carrier`,
    and plates of dials `dial`.
    """
    place: Vector
    """Position of the origin of the part in the zero pose [mm]."""
    direction: Vector
    """Unit vector of the z axis of the part."""
    across: Vector
    """Unit vector of the x axis of the part."""
    bands: Sequence[tuple[float, float, float, float]] = ()
    """Bands of a turned part, from the lowest to the highest. Each is start and end along z, outer and inner radius
    [mm].
    """
    outlines: Sequence[Sequence[float]] = ()
    """Outlines of a flat part: first the edge, then the holes. Each is a sequence of alternating x and y coordinates
    [mm].
    """
    height: float = 0.0
    """Thickness of a flat part [mm]; the part is centred on z = 0."""


@dataclass(frozen=True, slots=True)
class SceneHanger(Shown):
    """Part that hangs from a train, such as a pendulum or a weight with its line, or that connects two bodies."""

    kind: Literal["pendulum", "line", "weight", "rod"]
    """Kind of the part. A pendulum swings with its escape wheel. A weight falls on its line as the barrel turns. A rod
    (rigid, or a rope) extends from a point of one body to a point of another body.
    """
    body: int
    """Index of the body whose rotation moves the part, or of the body at the start of a rod."""
    point: Vector
    """Point of suspension, or start of a rod [mm]."""
    direction: Vector
    """Unit vector along the axis about which the pendulum swings or the barrel turns."""
    down: Vector
    """Unit vector that points down, perpendicular to `direction`."""
    length: float
    """Distance in the zero pose from the point of suspension to the middle of the bob or to the weight, or length of a
    rod [mm].
    """
    rate: float
    """Number of full swings of a pendulum per turn of its body, or descent of a weight per radian of rotation of its
    body [mm/rad].
    """
    wide: float
    """Radius of the bob, the weight, the line or the rod [mm]."""
    parts: Sequence[ScenePart] = ()
    """Turned parts (the rod and the bob, or the weight) at their positions in the zero pose."""
    to: int | None = None
    """Index of the body at the end of a rod, which is at `point` + `length` * `down` in the zero pose; None for other
    parts.
    """


# Not in every train: `SceneCoupling.slot_turn` (starting angles), heights instead of radii in the profiles of bevel
# and contrate wheels.


# ---------------------------------------------------------------------------------------------- links, wheels and pairs


@dataclass(frozen=True, slots=True)
class SceneBody(Shown):
    """Link of a scene as a rigid body, with the axis about which it turns."""

    id: str
    """Name of the link."""
    parent: int | None
    """Index of the body that carries the axis of the link; None for the frame."""
    axis: str
    """Label of the axis about which the link turns, as declared."""
    point: Vector
    """Point on the axis of the link [mm]."""
    direction: Vector
    """Unit vector along the link's axis, in the reference direction of all axes that are parallel to it."""
    sense: int
    """-1 if the declared axis is opposite to `direction`, so that the speed changes its sign; 1 if it is not."""
    speed: str | None
    """Exact speed of the link about its declared axis, divided by the speed of the driving link; None if the speed is
    not determined. For a link that slides, one turn corresponds to a travel of 1 mm.
    """
    shown: str | None
    """Speed of the link at the declared inputs, in the train's unit, exact if the inputs are exact; None if the speed
    is not determined.
    """
    decimal: str
    """Rounded speed of the link at the declared inputs, in the train's unit; empty if the speed is not determined."""
    start: float
    """Starting angle of the link [rad]: declared, or computed from the epoch."""
    role: str
    """Role of the link: frame, carrier (it carries a moving axis) or arbor."""
    bookkeeping: bool = False
    """True if the speed is a sum of joint speeds about non-parallel axes, and therefore not the speed of a rotation."""
    note: str = ""
    """Declared note on the link; empty if none is declared."""
    travels: bool = False
    """True if the link slides along its axis, by 1 mm for each turn of its angle."""
    base: int | None = None
    """Index of the body whose angle is subtracted from the angle of this body to obtain the joint angle; None if it is
    `parent`.
    """

    @property
    def reference(self) -> int | None:
        """Index of the body whose angle is subtracted from the angle of this body to obtain the joint angle; None for
        the frame.
        """
        return self.parent if self.base is None else self.base


@dataclass(frozen=True, slots=True)
class ToothProfile(Shown):
    """Profile of one tooth of a wheel, from the middle of one tooth space to the middle of the next tooth space.

    The middle of the tooth is at angle 0.
    """

    form: str
    """Tooth form, such as triangular, involute or cycloidal.

    It is `standard` if no form is declared, and `likeness` for nominal teeth of a wheel without a flat outline.
    """
    points: Sequence[tuple[float, float]]
    """Points of the profile. Each is a radius divided by the pitch radius, and an angle [rad].

    The angles of an open profile increase from -pi/z to pi/z, where z is the tooth count. For a bevel or contrate wheel
    the radius is 1 plus the height above the pitch cone, along the back cone.
    """
    hole: bool = False
    """True if the points form a closed curve, such as the outline of a lantern pinion's pin."""


@dataclass(frozen=True, slots=True)
class SceneWheel(Shown):
    """Wheel in a scene: its position, dimensions, teeth and declared data."""

    id: str
    """Name of the wheel."""
    body: int
    """Index of the body to which the wheel belongs."""
    teeth: int
    """Tooth count; 1 if it is not known."""
    kind: str
    """Kind of the wheel: `ring` for an internal gear, `pins` for a lantern pinion, and the declared kind for other
    wheels.
    """
    centre: Vector
    """Centre of the wheel's pitch circle, on the axis of the wheel [mm]."""
    direction: Vector
    """Unit vector along the axis of the wheel, equal to the direction of the wheel's body."""
    reference: Vector
    """Unit vector perpendicular to the axis of the wheel, from which `turn` is measured."""
    turn: float
    """Angle of the wheel's first tooth about `direction`, measured from `reference` [rad]."""
    radius: float
    """Pitch radius [mm]."""
    tip: float
    """Tip radius [mm]. It is smaller than the root radius if the wheel is a ring."""
    root: float
    """Root radius [mm]."""
    module: float
    """Transverse module [mm]; for a worm, its axial module."""
    thickness: float
    """Thickness of the wheel's rim along the axis [mm]."""
    cone: float
    """Half angle of the wheel's pitch cone [rad]: 0 for a cylinder, pi/2 for a crown wheel."""
    facing: int
    """Side towards which the pitch cone opens: 1 in the direction of the axis, -1 against it, 0 for a cylinder."""
    profile: int
    """Index of the tooth profile of the wheel in `Scene.profiles`."""
    layer: int | None
    """Level of the wheel in the stack, counted from 0; None if the wheel's axis is not parallel to the main axes."""
    status: str
    """Status of the wheel: surviving, reconstructed or hypothetical; empty if no status is declared."""
    source: str
    """Declared source of the data on the wheel, or of its uncertainty; empty if none is declared."""
    note: str
    """Declared note on the wheel, or on its uncertainty; empty if none is declared."""
    doubt: str
    """Tooth counts that the evidence allows for the wheel, as text; empty if the count is certain."""
    circuits: Sequence[str]
    """Names of the gear pairs to which the wheel belongs."""
    loss: float | None = None
    """Fraction of the input power that is lost at the wheel's meshes; None if it is unknown, for example because no
    loads are declared.
    """
    helix: float = 0.0
    """Helix angle of the teeth, or of a worm's thread, relative to the axis [rad]; positive for a right-hand helix."""
    holes: Sequence[Sequence[float]] = ()
    """Outlines of holes in the wheel as built, for pins that move in them or for an eccentric on which the wheel turns.
    Each outline is a sequence of alternating x and y coordinates [mm], relative to the wheel centre; the x axis passes
    through the first tooth.
    """

    @property
    def span(self) -> tuple[float, float]:
        """Lower and upper ends of the wheel body along `direction`, relative to `centre` [mm]."""
        depths = self.root - self.radius, self.tip - self.radius
        return span(self.facing, *reach(self.cone, self.radius, self.thickness, *depths))

    @property
    def web(self) -> tuple[float, float]:
        """Lower and upper ends of the disc inside the toothed rim along `direction`, relative to `centre` [mm]."""
        return span(self.facing, *web(self.cone, self.radius, self.thickness, self.root - self.radius))


@dataclass(frozen=True, slots=True)
class ScenePair(Shown):
    """Gear pair of a scene: two wheels that mesh, with the equation of their speeds."""

    id: str
    """Name of the gear pair."""
    wheels: tuple[int, int]
    """Indices of the two wheels in `Scene.wheels`."""
    carrier: int
    """Index of the body that carries both axes."""
    ratio: str
    """Exact speed ratio of the pair, (w_i - w_k) / (w_j - w_k), where w_i and w_j are the speeds of the links of its
    first and second wheel, and w_k is the speed of their carrier; see equation (4) of docs/theory.md.
    """
    form: str
    """Tooth form of the pair; empty if its tooth geometry is unknown."""
    text: str
    """Equation of the pair's fundamental circuit, as text."""
    broken: bool = False
    """True if the teeth of the pair cannot run together, or if the pair belongs to a loop that does not close or that
    locks links.
    """
    fault: str = ""
    """Reason why the pair is broken: a faulty loop that contains it, or a defect of its teeth. It is empty for other
    pairs.
    """


@dataclass(frozen=True, slots=True)
class SceneCoupling(Shown):
    """Coupling of two links in a scene by a pin in a slot, or by pins in round holes."""

    id: str
    """Name of the coupling."""
    kind: str
    """Kind of the coupling: `pin_and_slot`, `pin_follower` or `pins_in_holes`."""
    pin: int
    """Index of the body that carries the pin."""
    slot: int
    """Index of the body that has the slot or the holes."""
    carrier: int
    """Index of the body that carries both axes."""
    pin_at: Vector
    """Centre of the pin, or of the first of several pins, in the zero pose [mm]."""
    slot_at: Vector
    """Point on the axis of the slot's body at the height of the pin [mm]."""
    pin_radius: float
    """Distance from the centre of the pin to the axis of the link that carries it [mm]."""
    offset: float
    """Distance between the axes of the pin's body and the slot's body [mm]."""
    drawn: bool
    """True if the dimensions of the coupling are declared, False if they were chosen for the picture."""
    text: str
    """Equation of the coupling's fundamental circuit, as text."""
    slot_turn: float = 0.0
    """Angle in the zero pose from the line between `slot_at` and `pin_at` to the slot [rad]; 0 if there are no starting
    angles.
    """
    pins_at: Sequence[Vector] = ()
    """Centres of all pins in round holes in the zero pose [mm]; empty for a pin in a slot."""
    holes_at: Sequence[Vector] = ()
    """Centres of the round holes in the zero pose [mm]; empty for a pin in a slot."""
    pin_diameter: float = 0.0
    """Diameter of a pin in a round hole [mm]; 0 for a pin in a slot."""
    hole: float = 0.0
    """Diameter of a round hole [mm]; 0 for a pin in a slot."""


@dataclass(frozen=True, slots=True)
class SceneShiftElement:
    """Brake or clutch in a scene, which is either engaged or open in the state of the scene."""

    id: str
    kind: Literal["brake", "clutch"]
    """Kind of the element. A brake fixes a body to the frame; a clutch connects two bodies."""
    bodies: Sequence[int]
    """Index of the body that a brake fixes to the frame, or indices of the two bodies that a clutch connects."""
    closed: bool
    """True if the element is engaged in the state of the scene."""
    text: str
    """Description of the brake or clutch, such as `B brakes ring`."""
    one_way: bool = False
    """True for an active one-way clutch, which is engaged if it transmits torque and open if it overruns."""


@dataclass(frozen=True, slots=True)
class SceneWave(Shown):
    """Strain wave that deflects a flexible wheel (flexspline) into mesh with its ring (circular spline). The wheel, its
    cup wall and the wave generator are coaxial.
    """

    wheel: int
    """Index of the flexible wheel."""
    by: int
    """Index of the body that is the wave generator."""
    towards: Vector
    """Unit vector perpendicular to the axis that points to the first lobe in the zero pose."""
    rise: float
    """Amplitude of the radial deflection of the wall's middle line [mm], outwards at a lobe and inwards between lobes.
    """
    lobes: int
    """Number of lobes of the wave around the wheel."""
    middle: float
    """Radius of the middle line of the wall of the undeformed wheel [mm]."""
    wall: float
    """Thickness of the wall of the wheel [mm]."""
