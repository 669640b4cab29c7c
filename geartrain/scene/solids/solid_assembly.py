"""The parts of a train as solids, each on its body, in the pose in which all angles are zero."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.construction import make_scene
from geartrain.scene.layout import lay_out
from geartrain.scene.solids.bearing_plates import Plate, Plates, basis, find_plates, pin_diameter, slotted_bar
from geartrain.scene.solids.bevel_solids import likeness_solid
from geartrain.scene.solids.manufacturing_sizes import ManufacturingSizes, bores, sized, thick
from geartrain.scene.solids.triangle_solids import Solid, cylinder, plate_solid, wheel_solid
from geartrain.scene.solids.wheel_blanks import Blanks, find_blanks

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneWheel
    from geartrain.scene.layout import Layout
    from geartrain.scene.train_scene import Scene
    from geartrain.teeth.outlines.contour import Contour

_SHEET = 2.0  # mm, the thickness of plates
_GAP = 1.0  # mm between a plate and what turns before it


@dataclass(frozen=True, slots=True)
class SolidPart:
    """One solid of a body: a point p of it stands at turn p + place.

    Attributes
    ----------
    body : int
        Index of its body in the scene.
    name : str
        Of the wheel, or what it belongs to.
    kind : {"wheel", "arbor", "plate"}
        What it is.
    solid : Solid
        A closed surface of triangles about its own origin [mm].
    turn, place : array of float, (3, 3) and (3,)
        Rotation and shift [mm] that put it into the zero pose.
    status : str
        Of a wheel as declared: surviving, reconstructed, ...
    contours : tuple of Contour
        Its flat shape, from which the solid is made; empty where it has none.
    height : float
        Thickness over the flat shape [mm].

    See Also
    --------
    SolidModel : gives it, in `parts`.
    """

    body: int
    name: str
    kind: str
    solid: Solid
    turn: Floats
    place: Floats
    status: str = ""
    contours: tuple[Contour, ...] = ()
    height: float = 0.0

    @property
    def placed(self) -> Solid:
        """The solid where it stands."""
        return self.solid.moved(self.turn, self.place.tolist())


@dataclass(frozen=True)
class SolidModel:
    """A train with all that exports ask for, each made once when it is first asked for.

    Parameters
    ----------
    train : GearTrain
        Loaded or declared.
    making : ManufacturingSizes
        Sizes it is made in.
    state : str, optional
        One of its states; by default the first.

    Raises
    ------
    QuestionError
        By what is asked for, if the train declares sizes that `making` gives too, or teeth that cannot have the play.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import ManufacturingSizes
    >>> model = SolidModel(geartrain.load("planetary-24-18-60"), ManufacturingSizes(module=2.0))
    >>> {name: wheel.radius for name, wheel in model.layout.wheels.items()}
    {'ring': 60.0, 's': 24.0, 'p': 18.0}
    """

    train: GearTrain
    making: ManufacturingSizes
    state: str | None = None

    @cached_property
    def sized(self) -> GearTrain:
        """The train with the modules and the play asked for."""
        return sized(self.train, self._laid, self.making)

    @cached_property
    def layout(self) -> Layout:
        """Places of axes and wheels, at the sizes asked for."""
        return thick(self._laid if self.sized is self.train else lay_out(self.sized), self.making)

    @cached_property
    def blanks(self) -> Blanks:
        """Flat shapes of the wheels."""
        return find_blanks(self.sized, self.layout, self.making)

    @cached_property
    def plates(self) -> Plates:
        """Plates that bear the arbors, and discs of pins and slots."""
        return find_plates(self.sized, self.layout, self.making)

    @cached_property
    def scene(self) -> Scene:
        """How it moves."""
        return make_scene(self.sized, self.state, self.layout)

    @cached_property
    def parts(self) -> tuple[SolidPart, ...]:
        """All solids: wheels, arbors, plates of the frame and of carriers, pins and slots."""
        return tuple(_Parts(self).all())

    @cached_property
    def _laid(self) -> Layout:
        return lay_out(self.train)


class _Parts:
    def __init__(self, work: SolidModel) -> None:
        self.work, self.scene = work, work.scene
        self.bodies = {body.id: at for at, body in enumerate(self.scene.bodies)}
        self.bores = bores(work.layout, work.making)

    def all(self) -> Iterator[SolidPart]:
        for wheel in self.scene.wheels:
            yield self.wheel(wheel)
        yield from self.arbors()
        yield from self.plates()
        yield from self.couplings()

    def wheel(self, wheel: SceneWheel) -> SolidPart:
        """By its flat shape where it has one."""
        turn, place = _frame(wheel)
        blank = self.work.blanks.wheels.get(wheel.id)
        if blank is None:
            declared = self.work.train.declaration.wheels[wheel.id][1]
            drawn = likeness_solid(wheel, self.scene.profiles[wheel.profile], -1 if declared.hand == "left" else 1)
            return SolidPart(wheel.body, wheel.id, "wheel", drawn, turn, place, wheel.status)
        solid = wheel_solid(blank)
        return SolidPart(
            wheel.body, wheel.id, "wheel", solid, turn, place, wheel.status, blank.contours, blank.thickness
        )

    def arbors(self) -> Iterator[SolidPart]:
        """A rod for every body that turns and has wheels, from the lowest to the highest of them."""
        for at, body in enumerate(self.scene.bodies):
            own = [wheel for wheel in self.scene.wheels if wheel.body == at and wheel.kind != "ring"]
            radius = self.bores.get(body.axis, 0.0) / 2
            if body.parent is None or not own or not radius:
                continue
            point, along = np.array(body.point), np.array(body.direction)
            ends = [
                float((np.array(wheel.centre) - point) @ along) + side * self._thick(wheel) / 2
                for wheel in own
                for side in (-1, 1)
            ]
            right, up = basis(body.direction)
            turn = np.column_stack([right, up, body.direction])
            low, high = min(ends) - _GAP, max(ends) + _GAP
            solid = cylinder(radius, low, high)
            yield SolidPart(at, f"{body.id} arbor", "arbor", solid, turn, point)

    def _thick(self, wheel: SceneWheel) -> float:
        blank = self.work.blanks.wheels.get(wheel.id)
        return wheel.thickness if blank is None else blank.thickness

    def plates(self) -> Iterator[SolidPart]:
        """Plates of carriers, under all that turns on them, and that of the frame, behind the whole."""
        thickness = self.work.making.thickness or _SHEET
        for plate in self.work.plates.plates:
            if not plate.name.startswith("plate-"):
                continue
            at = self.bodies[plate.link]
            normal = np.array(plate.normal)
            place = np.array(plate.point)
            if self.scene.bodies[at].parent is None:
                side, far = self._behind(normal), 2 * _GAP + 1.5 * thickness  # beyond the plates of carriers
            else:
                side, far = min(self._heights(plate, normal), default=0.0), _GAP + thickness / 2
            away = -self.scene.front if self.scene.bodies[at].parent is None else -1
            place = place + normal * (side - place @ normal + away * far)
            right, up = basis(plate.normal)
            solid = plate_solid(plate.drawing.cut, thickness)
            turn = np.column_stack([right, up, plate.normal])
            yield SolidPart(at, f"{plate.link} plate", "plate", solid, turn, place, "", plate.drawing.cut, thickness)

    def _behind(self, normal: Floats) -> float:
        """Height of what is farthest from the reader."""
        places = self.work.layout.wheels.values()
        front = self.scene.front
        ends = (float(np.array(place.centre) @ normal) - front * place.thickness / 2 for place in places)
        return front * min((front * end for end in ends), default=0.0)

    def couplings(self) -> Iterator[SolidPart]:
        """Pins, from their wheel to the slot's, and bars with a slot as long as the pin wanders."""
        for coupling in self.scene.couplings:
            body = self.scene.bodies[coupling.slot]
            along = np.array(body.direction)
            pin, hub = (np.array(each) for each in (coupling.pin_at, coupling.slot_at))
            low, high = sorted(
                (self._level(coupling.pin, pin @ along, along), self._level(coupling.slot, pin @ along, along))
            )
            r, e = coupling.pin_radius, coupling.offset
            thick = pin_diameter(r)
            across = np.column_stack([*basis(body.direction), body.direction])
            middle = pin - along * (pin @ along)
            yield SolidPart(
                coupling.pin,
                f"{coupling.id} pin",
                "arbor",
                cylinder(thick / 2, low - _GAP, high + _GAP),
                across,
                middle,
            )
            out = pin - hub
            x = out / np.linalg.norm(out)
            c, s = cos(coupling.slot_turn), sin(coupling.slot_turn)
            x = c * x + s * np.cross(along, x)
            turn = np.column_stack([x, np.cross(along, x), along])
            contours = slotted_bar(r, e, thick)
            level = self._level(coupling.slot, pin @ along, along)
            place = hub + along * (level - hub @ along)
            yield SolidPart(
                coupling.slot,
                f"{coupling.id} slot",
                "plate",
                plate_solid(contours, _GAP),
                turn,
                place,
                "",
                contours,
                _GAP,
            )

    def _level(self, body: int, height: float, along: Floats) -> float:
        """The face, nearest to a height, of the wheels of a body."""
        own = [wheel for wheel in self.scene.wheels if wheel.body == body]
        faces = [
            float(np.array(wheel.centre) @ along) + side * (self._thick(wheel) + _GAP) / 2
            for wheel in own
            for side in (-1, 1)
        ]
        return min(faces, key=lambda face: abs(face - height), default=float(height))

    def _heights(self, plate: Plate, normal: Floats) -> Iterator[float]:
        for place in self.work.layout.wheels.values():
            if place.axis in plate.holes:
                yield float(np.array(place.centre) @ normal) - place.thickness / 2


def _frame(wheel: SceneWheel) -> tuple[Floats, Floats]:
    """Axes of a wheel's own coordinates as columns, x through its first tooth, and its middle (mm)."""
    along, reference = np.array(wheel.direction), np.array(wheel.reference)
    across = np.cross(along, reference)
    x = cos(wheel.turn) * reference + sin(wheel.turn) * across
    return np.column_stack([x, np.cross(along, x), along]), np.array(wheel.centre)


def by_body(parts: Sequence[SolidPart]) -> Mapping[int, list[SolidPart]]:
    """Parts in the order of their bodies."""
    found: dict[int, list[SolidPart]] = {}
    for part in parts:
        found.setdefault(part.body, []).append(part)
    return found
