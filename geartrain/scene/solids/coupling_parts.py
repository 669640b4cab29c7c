"""Pins of couplings and their slots as solids: pins in wheels, or on arms, and bars with a slot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.parts.turned_parts import Band, TurnedPart
from geartrain.scene.solids.bearing_plates import around
from geartrain.scene.solids.pin_couplings import pin_axis, pin_width, slot_bar, slot_frame
from geartrain.scene.solids.solid_part import SolidPart

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneCoupling, SceneWheel
    from geartrain.scene.parts.processes import Process
    from geartrain.scene.solids.pin_couplings import CutCoupling
    from geartrain.scene.solids.wheel_blanks import Blank
    from geartrain.scene.train_scene import Scene

_GAP = 1.0  # mm between a plate and what turns before it


@dataclass(frozen=True)
class CouplingParts:
    """All of a scene that no plate bears; pins that stand in plates are parts of these.

    cut      couplings that are cut into wheels
    wheels   flat shapes by name
    """

    scene: Scene
    cut: Mapping[str, CutCoupling]
    wheels: Mapping[str, Blank]
    process: Process

    def parts(self) -> Iterator[SolidPart]:
        """Pins, from their wheel to the slot's, and bars for slots that are in no wheel."""
        for coupling in self.scene.couplings:
            turn, axis = pin_axis(self.scene, coupling)
            along, cut = turn[:, 2], self.cut.get(coupling.id)
            if coupling.hole and (cut is None or cut.pin is None):
                continue  # no wheel bears such pins
            if cut is None or cut.pin is None:
                height = float(coupling.pin_at @ along)
                levels = [self._level(body, height, along) for body in (coupling.pin, coupling.slot)]
                low, high = min(levels) - _GAP, max(levels) + _GAP
            else:
                low, high = self._faces(cut.pin, cut.slot, along)
            band = Band(low, high, pin_width(coupling) / 2)
            joint, first = self.process.joint, np.array(coupling.pin_at)
            for at, place in enumerate(coupling.pins_at or (coupling.pin_at,)):
                name = f"{coupling.id} pin" + (f" {at + 1}" if coupling.pins_at else "")
                part = TurnedPart(self.scene.bodies[coupling.pin].id, name, "pin", (0.0, 0.0), (band,), joint)
                middle = axis + np.array(place) - first
                yield SolidPart(coupling.pin, name, part.kind, turn, middle, turned=part)
            if cut is None:
                yield self._pin_arm(coupling, turn, levels[0])
                yield self._bar(coupling, along)

    def _faces(self, pin: SceneWheel, slot: SceneWheel, along: Floats) -> tuple[float, float]:
        """From the far face of the pin's wheel to that of the slot's."""
        ends = [
            float(wheel.centre @ along) + side * self._thick(wheel) / 2 for wheel in (pin, slot) for side in (-1, 1)
        ]
        return min(ends), max(ends)

    def _pin_arm(self, coupling: SceneCoupling, turn: Floats, level: float) -> SolidPart:
        """From the axis of the pin's link out to the pin."""
        body = self.scene.bodies[coupling.pin]
        along, pin = turn[:, 2], np.array(coupling.pin_at)
        hub = np.array(body.point) + along * (level - float(np.array(body.point) @ along))
        aside = pin - hub - along * float((pin - hub) @ along)
        away = float(np.linalg.norm(aside))
        x = aside / away
        cut = (around([(0.0, 0.0), (away, 0.0)], 0.9 * pin_width(coupling)),)
        name, own = f"{coupling.id} pin arm", np.column_stack([x, np.cross(along, x), along])
        return SolidPart(coupling.pin, name, "plate", own, hub, "", cut, _GAP)

    def _bar(self, coupling: SceneCoupling, along: Floats) -> SolidPart:
        hub, turn = np.array(coupling.slot_at), slot_frame(self.scene, coupling)
        level = self._level(coupling.slot, float(coupling.pin_at @ along), along)
        place = hub + along * (level - hub @ along)
        return SolidPart(coupling.slot, f"{coupling.id} slot", "plate", turn, place, "", slot_bar(coupling), _GAP)

    def _level(self, body: int, height: float, along: Floats) -> float:
        """The face, nearest to a height, of the wheels of a body."""
        own = [wheel for wheel in self.scene.wheels if wheel.body == body]
        faces = [
            float(np.array(wheel.centre) @ along) + side * (self._thick(wheel) + _GAP) / 2
            for wheel in own
            for side in (-1, 1)
        ]
        return min(faces, key=lambda face: abs(face - height), default=float(height))

    def _thick(self, wheel: SceneWheel) -> float:
        blank = self.wheels.get(wheel.id)
        return wheel.thickness if blank is None else blank.thickness
