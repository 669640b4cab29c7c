"""Parts of a train as solids, each on its body, in the pose in which all angles are 0."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.results import Shown
from geartrain.scene.construction import make_scene
from geartrain.scene.layout import lay_out
from geartrain.scene.layout.declared_geometry import read_geometry
from geartrain.scene.parts.frame_plan import FramePlan
from geartrain.scene.parts.frame_plates import FlatPlate, FramePlates
from geartrain.scene.parts.frame_stack import FrameStack, find_normal
from geartrain.scene.parts.processes import Process, process_named
from geartrain.scene.parts.sleeves import find_barrel
from geartrain.scene.parts.turned_parts import Band, TurnedPart
from geartrain.scene.solids.bearing_plates import Plates, coupling_discs
from geartrain.scene.solids.carrier_cages import (
    Bracket,
    Cage,
    HangingParts,
    find_brackets,
    find_cages,
    hanging_solids,
    wheel_ends,
)
from geartrain.scene.solids.dial_plates import THICKNESS, DialPlate, dial_plates
from geartrain.scene.solids.manufacturing_sizes import ManufacturingSizes, bores, sized, thick, with_backlash
from geartrain.scene.solids.solid_part import SolidPart, turned_about, wheel_frame
from geartrain.scene.solids.standing_pins import (
    CouplingParts,
    CutCoupling,
    cut_couplings,
    holes,
    side_bars,
    standing_pins,
)
from geartrain.scene.solids.triangle_solids import approximation_solid, wheel_solid
from geartrain.scene.solids.wheel_blanks import Blanks, bored, crossed_out, find_blanks, with_seats
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.scene.elements import SceneWheel
    from geartrain.scene.layout import Layout
    from geartrain.scene.train_scene import Scene
_SHEET = 3.0  # mm: default thickness of plates
_GAP = 1.0  # mm between a plate and the next turning part


@dataclass(frozen=True)
class SolidModel(Shown):
    """Solid model of a train for exports. Each property is computed at first use.

    Raises
    ------
    QuestionError
        When a property is first used, if `making` contains sizes that the train already declares, or if the teeth
        cannot have the requested backlash.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import ManufacturingSizes
    >>> model = SolidModel(geartrain.load("planetary-24-18-60"), ManufacturingSizes(module=2.0))
    >>> {name: wheel.radius for name, wheel in model.layout.wheels.items()}
    {'ring': 60.0, 's': 24.0, 'p': 18.0}
    """

    train: GearTrain
    """Loaded or declared train."""
    making: ManufacturingSizes
    """Manufacturing sizes of the parts."""
    state: str | None = None
    """State in which the train is built; by default the first state."""

    def __post_init__(self) -> None:
        """Replace planets that are declared as copies by separate planets, because each planet is a separate part."""
        object.__setattr__(self, "train", self.train.unfolded)

    @cached_property
    def sized(self) -> GearTrain:
        """Train with the requested modules and backlash."""
        return sized(self.train, self._laid, with_backlash(self.train, self._laid, self.making))

    @cached_property
    def layout(self) -> Layout:
        """Positions of axes and wheels at the requested sizes, with space for plates."""
        return self._spread if self.plan is None else self.plan.layout

    @cached_property
    def process(self) -> Process:
        """Manufacturing process of the parts."""
        return process_named(self.making.process)

    @cached_property
    def plan(self) -> FramePlan | None:
        """Positions of plates and arbors; None if the frame carries no wheel, or if the bore is 0 (no arbors)."""
        normal = find_normal(self.sized, self._spread)
        # a bore of 0 requests wheels without arbors and plates
        if self.making.bore == 0 or normal is None:
            return None
        stack = FrameStack(self.sized, self._spread, self._toothed.wheels, normal, self.making.bore).with_head_room()
        ends = {link: (each.low, each.high) for link, each in read_geometry(self.sized).dial_ends.items()}
        # declared dials take precedence over the shafts of a reducer
        ends = {**stack.ends, **ends}
        return FramePlan(stack, self.process, self.making.thickness or _SHEET, self.making.bore, ends)

    @cached_property
    def frame(self) -> FramePlates | None:
        """Plates, pillars, arbors and other turned parts; None for a model without plates (`plan` is None)."""
        if self.plan is None:
            return None
        mortises = {side: [each.mortise for each in self.brackets if each.side == side] for side in ("back", "front")}
        feet = *(foot for dial in self.dials for foot in dial.feet), *(self.hanging.cock() if self.hanging else ())
        standing = *standing_pins(self.scene, self.plan), *side_bars(self.scene, self.plan)
        return FramePlates(self.plan, feet, mortises, standing, self.hanging.barrel if self.hanging else None)

    @cached_property
    def hanging(self) -> HangingParts | None:
        """Pendulum and weight of the train with their supports; None for a model without plates (`plan` is None)."""
        if self.plan is None:
            return None
        crank = self.scene.crank
        barrel = find_barrel(self.plan, None if crank is None else self.scene.bodies[crank].id)
        return HangingParts(self.scene, self.sized.declaration, self.plan, barrel)

    @cached_property
    def brackets(self) -> tuple[Bracket, ...]:
        """Brackets that support arbors parallel to the plates."""
        return () if self.plan is None else find_brackets(self.scene, self.plan, bores(self.layout, self.making))

    @cached_property
    def cages(self) -> tuple[Cage, ...]:
        """Supports of carried axes that are inclined to the axis of their carrier."""
        return () if self.plan is None else find_cages(self.scene, self.plan, bores(self.layout, self.making))

    @cached_property
    def blanks(self) -> Blanks:
        """Flat shapes of the wheels by name, with holes for arbors and for other parts that the wheels carry."""
        holes = self.bores_of_wheels
        wheels, notices = {}, [*self._toothed.notices]
        for name, blank in self._toothed.wheels.items():
            others = self._own_holes(name)
            wheels[name], problems = bored(with_seats(blank, self.process.press), holes.get(name, 0.0), others)
            notices += problems
            if self.making.arms is not None:
                wheels[name], problems = crossed_out(wheels[name], self.making.arms)
                notices += problems
        return replace(self._toothed, wheels=wheels, notices=tuple(notices))

    @cached_property
    def bores_of_wheels(self) -> dict[str, float]:
        """Diameter of the hole for the arbor in each wheel [mm], by name of the wheel."""
        rods = bores(self._spread, self.making)
        found = {name: rods[place.axis] for name, place in self._spread.wheels.items()}
        return found if self.plan is None else found | self.plan.bores

    def _own_holes(self, name: str) -> list[Contour]:
        """Return the slots of a wheel and its holes for studs, posts and pins, in the wheel's own coordinates [mm]."""
        wheel = next(wheel for wheel in self.scene.wheels if wheel.id == name)
        turn, place = wheel_frame(wheel)
        found = []
        for cut in self.cut_couplings.values():
            found += holes(self.scene, cut, name, turn, place, self.process)
        if self.frame is None:
            return found
        stack = self.frame.plan.stack
        for hole in self.frame.seat_holes(name):
            x, y, _ = turn.T @ (np.array(stack.in_space(hole.at)) - place)
            found.append(Contour.circle(hole.diameter / 2, (float(x), float(y))))
        return found

    @cached_property
    def cut_couplings(self) -> dict[str, CutCoupling]:
        """Couplings whose pins and slots are cut into wheels, by name."""
        return cut_couplings(self.scene, self._toothed.wheels, self.bores_of_wheels)

    @cached_property
    def couplings(self) -> Plates:
        """Separate discs that carry pins or slots, with warnings about couplings that are not modelled."""
        whole = {name for name, each in self.cut_couplings.items() if each.pin is not None}
        if self.plan is not None:
            whole |= self.plan.plated_pins.keys() & self.cut_couplings.keys()
            whole |= {each.coupling for each in self.plan.stack.eccentrics}
            whole |= {each.name for each in self.plan.stack.cups}
        loose = [each for each in self.sized.declaration.pin_couplings if each.name not in whole]
        own = {place.link: self.bores_of_wheels[wheel] for wheel, place in self.layout.wheels.items()}
        return coupling_discs(loose, own, frozenset(self.cut_couplings))

    @cached_property
    def dials(self) -> list[DialPlate]:
        """Plates of dials; empty for a model without frame plates (`plan` is None)."""
        thickness = self.making.thickness or THICKNESS
        return [] if self.plan is None else dial_plates(self.scene, self.plan, thickness)

    @cached_property
    def _spread(self) -> Layout:
        """Layout at the requested sizes, without space for plates."""
        laid = self._laid if self.sized is self.train else lay_out(self.sized)
        return thick(self.sized.declaration, laid, self.making)

    @cached_property
    def _toothed(self) -> Blanks:
        return find_blanks(self.sized, self._spread, with_backlash(self.train, self._laid, self.making))

    @cached_property
    def scene(self) -> Scene:
        """Scene of the train at the requested sizes, with its motion."""
        return make_scene(self.sized, self.state, self.layout)

    @cached_property
    def parts(self) -> tuple[SolidPart, ...]:
        """All solids: wheels, structural parts, and parts suspended from the train, such as weights."""
        wheels = map(self._wheel, self.scene.wheels)
        if (hanging := self.hanging) is None:
            return *wheels, *self.structure
        hung = (part for each in hanging.found() for part in hanging_solids(each, hanging.frame))
        return *wheels, *self.structure, *hung

    @cached_property
    def structure(self) -> tuple[SolidPart, ...]:
        """Structural parts: all solids except wheels and hanging parts."""
        frame, couplings = self.frame, CouplingParts(self.scene, self.cut_couplings, self.process)
        framed = () if frame is None else self._framed(frame)
        caged = (part for each in self.cages for part in each.parts)
        return *self._rods(), *(each.part for each in self.brackets), *caged, *framed, *couplings.parts()

    @cached_property
    def _laid(self) -> Layout:
        return lay_out(self.train)

    def _wheel(self, wheel: SceneWheel) -> SolidPart:
        """Return the solid of a wheel, from its flat shape if there is one."""
        turn, place = wheel_frame(wheel)
        blank = self.blanks.wheels.get(wheel.id)
        if blank is None:
            bore = self.bores_of_wheels.get(wheel.id, 0.0)
            drawn = approximation_solid(wheel, self.scene.profiles[wheel.profile], bore)
            return SolidPart(wheel.body, wheel.id, "wheel", turn, place, wheel.status, drawn=drawn)
        flat = SolidPart(wheel.body, wheel.id, "wheel", turn, place, wheel.status, blank.contours, blank.thickness)
        # one pitch repeated, with twisted helical teeth, instead of the plain extrusion of the contours
        return replace(flat, drawn=wheel_solid(blank))

    def _rods(self) -> Iterator[SolidPart]:
        """Yield an arbor for every body whose wheels no plate supports; it extends through all wheels and supports."""
        radii, borne = bores(self.layout, self.making), set[str]()
        if self.plan is not None:
            borne = {column.axis for column in self.plan.all_columns} | self.plan.stack.on_eccentrics
        reach = [(each.body, each.reach) for each in self.brackets]
        reach += [(each.body, each.reach) for each in self.cages]
        for at, body in enumerate(self.scene.bodies):
            wheels, radius = wheel_ends(self.scene, at), radii.get(body.axis, 0.0) / 2
            if body.parent is None or body.axis in borne or wheels is None or not radius:
                continue
            ends = [wheels[0] - _GAP, wheels[1] + _GAP, *(end for bearer, end in reach if bearer == at)]
            band = Band(min(ends), max(ends), radius)
            part = TurnedPart(body.id, f"{body.id} arbor", "arbor", (0.0, 0.0), (band,))
            yield turned_about(at, part, body.direction, body.point)

    def _framed(self, frame: FramePlates) -> Iterator[SolidPart]:
        """Yield the turned parts, the plates and the eccentrics of the frame and of the carriers, and dial plates."""
        stack, body = frame.plan.stack, {each.id: at for at, each in enumerate(self.scene.bodies)}
        for part in frame.turned():
            place = np.array(stack.in_space(part.at))
            yield SolidPart(body[part.link], part.name, part.kind, stack.turn, place, turned=part)
        eccentrics = {each.name for each in stack.eccentrics}
        flat: list[tuple[str, FlatPlate | DialPlate]] = [(plate.link, plate) for plate in frame.plates()]
        flat += [(stack.frame, dial) for dial in self.dials]
        for link, plate in flat:
            place = np.array(stack.in_space(plate.at, (plate.low + plate.high) / 2))
            kind, thickness = "eccentric" if plate.name in eccentrics else "plate", plate.high - plate.low
            yield SolidPart(body[link], plate.name, kind, stack.turn, place, "", plate.contours, thickness)
