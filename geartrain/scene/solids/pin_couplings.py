"""Pins and slots that are cut into wheels of their links, where these are wide enough, and where they come.

A wheel whose roots reach beyond the pin bears the pin; one beyond all that the pin wanders has the slot. Otherwise the
slot is in a bar of its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.scene.solids.bearing_plates import around, basis, holed_bar, pin_diameter, slotted_bar
from geartrain.teeth.outlines.contour import Contour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneCoupling, SceneWheel
    from geartrain.scene.parts.processes import Process
    from geartrain.scene.solids.wheel_blanks import Blank
    from geartrain.scene.train_scene import Scene

WIDE = 0.55
"""Half the width of a slot over the diameter of its pin."""
_WEB = 0.6  # mm of a wheel that stay round a pin and round a slot, at least


@dataclass(frozen=True, slots=True)
class CutCoupling:
    """A pin in one wheel, and its slot in another; None where no wheel bears the pins of round holes."""

    coupling: SceneCoupling
    pin: SceneWheel | None
    slot: SceneWheel


def cut_couplings(scene: Scene, blanks: Mapping[str, Blank], bores: Mapping[str, float]) -> dict[str, CutCoupling]:
    """Couplings that find their place in two flat wheels, by name; `bores` are diameters of holes for arbors (mm)."""
    found = {}
    for coupling in scene.couplings:
        r, e, half = coupling.pin_radius, coupling.offset, WIDE * pin_width(coupling)
        far = coupling.hole / 2 if coupling.hole else e + half
        pins = _roomy(scene, coupling.pin, blanks, bores, (r - half, r + half))
        slots = _roomy(scene, coupling.slot, blanks, bores, (abs(r - far), r + far))
        if coupling.drawn and slots and not pins and coupling.hole:
            found[coupling.id] = CutCoupling(coupling, None, slots[0])
        elif coupling.drawn and pins and slots:
            along = np.array(scene.bodies[coupling.slot].direction)
            near = min(
                ((pin, slot) for pin in pins for slot in slots), key=lambda both: _apart(both[0], both[1], along)
            )
            found[coupling.id] = CutCoupling(coupling, *near)
    return found


def pin_width(coupling: SceneCoupling) -> float:
    """Diameter of its pins (mm)."""
    return coupling.pin_diameter or pin_diameter(coupling.pin_radius)


def _roomy(
    scene: Scene, body: int, blanks: Mapping[str, Blank], bores: Mapping[str, float], reach: tuple[float, float]
) -> list[SceneWheel]:
    """Flat wheels of a body with material from the one radius to the other (mm)."""
    low, high = reach
    return [
        wheel
        for wheel in scene.wheels
        if wheel.body == body
        and (blank := blanks.get(wheel.id)) is not None
        and blank.kind == "external"
        and bores.get(wheel.id, 0.0) / 2 + _WEB <= low
        and high + _WEB <= min(blank.root_radius, blank.tip_radius)
    ]


def _apart(one: SceneWheel, other: SceneWheel, along: Floats) -> float:
    return float(abs(np.subtract(one.centre, other.centre) @ along))


def slot_bar(coupling: SceneCoupling) -> tuple[Contour, ...]:
    """The bar that has the slot: where nobody declares the sizes, a hole in which the pin goes round evenly."""
    shape = slotted_bar if coupling.drawn else holed_bar
    return shape(coupling.pin_radius, coupling.offset, pin_diameter(coupling.pin_radius))


def slot_reach(coupling: SceneCoupling) -> tuple[float, float]:
    """In a bar of its own: from the slot's axis to the middle of its outer end, and half the bar's width (mm)."""
    return coupling.pin_radius + coupling.offset, 1.2 * pin_diameter(coupling.pin_radius)


def slot_frame(scene: Scene, coupling: SceneCoupling) -> Floats:
    """Along the slot from its axis outwards, across it, and along the axis: columns, in the zero pose."""
    along = np.array(scene.bodies[coupling.slot].direction)
    out = np.subtract(coupling.pin_at, coupling.slot_at)
    x = out / np.linalg.norm(out)
    x = cos(coupling.slot_turn) * x + sin(coupling.slot_turn) * np.cross(along, x)
    return np.column_stack([x, np.cross(along, x), along])


def pin_axis(scene: Scene, coupling: SceneCoupling) -> tuple[Floats, Floats]:
    """Across and along a pin as columns, and its axis at height 0."""
    direction = scene.bodies[coupling.slot].direction
    along, at = np.array(direction), np.array(coupling.pin_at)
    return np.column_stack([*basis(direction), along]), at - along * (at @ along)


def holes(scene: Scene, cut: CutCoupling, wheel: str, turn: Floats, place: Floats, process: Process) -> list[Contour]:
    """What a wheel, whose own axes are `turn` at `place`, has cut out for a pin and for a slot."""
    coupling, thick = cut.coupling, pin_width(cut.coupling)
    found = []
    if cut.pin is not None and wheel == cut.pin.id:
        found += [
            Contour.circle((thick + process.press) / 2, _flat(at, turn, place))
            for at in coupling.pins_at or (coupling.pin_at,)
        ]
    if wheel == cut.slot.id and coupling.hole:
        found += [
            Contour.circle((coupling.hole + process.running) / 2, _flat(at, turn, place)) for at in coupling.holes_at
        ]
    elif wheel == cut.slot.id:
        x = slot_frame(scene, coupling)[:, 0]
        ends = abs(coupling.pin_radius - coupling.offset), coupling.pin_radius + coupling.offset
        points = [_flat(coupling.slot_at + x * end, turn, place) for end in ends]
        found.append(around(points, WIDE * thick))
    return found


def _flat(point: object, turn: Floats, place: Floats) -> tuple[float, float]:
    x, y, _ = turn.T @ (np.array(point, float) - place)
    return float(x), float(y)
