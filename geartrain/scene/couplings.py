"""Pins in slots: where the pin stands, so that it moves as its law says."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.scene.moving import Moved
from geartrain.scene.pairs import in_words
from geartrain.scene.result import Coupling
from geartrain.scene.space import Vector, across, beside, dot, minus, plus, size, unit
from geartrain.scene.stage import Stage

if TYPE_CHECKING:
    from geartrain.circuits import Circuit
    from geartrain.pins import Coupling as Declared

_LIKE = {"pin_and_slot": 0.15, "pin_follower": 3.0}  # offset over pin radius, where none is declared
_REACH = 10.0  # mm, of a pin where neither sizes nor places give one
_NONE = 1e-9  # mm


def find_couplings(stage: Stage, moved: Moved) -> tuple[Coupling, ...]:
    """All couplings in the order declared."""
    circuits = {circuit.id: circuit for circuit in stage.train.circuits}
    return tuple(_coupling(stage, moved, circuits[each.name], each) for each in stage.train.declaration.couplings)


def _coupling(stage: Stage, moved: Moved, circuit: Circuit, declared: Declared) -> Coupling:
    tree = stage.train.tree
    axis = stage.reference(tree.axis(declared.pin))
    pin_axis, slot_axis = (_point(stage, tree.axis(link)) for link in (declared.pin, declared.slot))
    between = across(minus(slot_axis, pin_axis), axis)
    radius, offset = _sizes(declared, size(between))
    towards = unit(between) if size(between) > _NONE else beside(axis)
    pin_axis, slot_axis = (_at_height(point, axis, _height(stage, declared, axis)) for point in (pin_axis, slot_axis))
    return Coupling(
        id=circuit.id,
        kind=declared.kind,
        pin=stage.body[declared.pin],
        slot=stage.body[declared.slot],
        carrier=stage.body[circuit.carrier],
        pin_at=plus(pin_axis, towards, radius),
        slot_at=slot_axis,
        pin_radius=radius,
        offset=offset,
        drawn=declared.pin_radius is not None and declared.offset is not None,
        text=in_words(circuit, stage.train.signs),
        slot_turn=_aside(stage, moved, circuit),
    )


def _aside(stage: Stage, moved: Moved, circuit: Circuit) -> float:
    """How far (rad) the slot in the zero pose is turned aside from its pin.

    With both at their zero a law has slot and pin in line; declared starting angles may be any others.
    """
    setting = moved.driving.get(circuit.id)
    if setting is None:
        return 0.0
    followed = float(circuit.ratio) * setting.S + setting.error
    return setting.forward * followed - (moved.rest[circuit.i] - moved.rest[circuit.carrier])


def _sizes(declared: Declared, apart: float) -> tuple[float, float]:
    """Pin radius and offset (mm): as declared; else by the axes as placed; else a likeness."""
    if declared.pin_radius is not None and declared.offset is not None:
        radius, offset = declared.pin_radius.si * 1000, declared.offset.si * 1000
        if declared.pin_radius.unit is None:
            radius, offset = radius / 1000, offset / 1000
            if apart > _NONE and offset > 0:
                radius, offset = radius * apart / offset, apart
        return radius, offset
    if apart > _NONE:
        return apart / _LIKE[declared.kind], apart
    return _REACH, _REACH * _LIKE[declared.kind]


def _point(stage: Stage, label: str | None) -> Vector:
    place = stage.layout.axes.get(label or "")
    return (0.0, 0.0, 0.0) if place is None else place.point


def _height(stage: Stage, declared: Declared, axis: Vector) -> float:
    """Along the axis, midway between the nearest wheels of the two links; that of the axis where they have none."""
    levels = [
        [dot(stage.layout.wheels[wheel].centre, axis) for wheel in stage.train.declaration.links[link].wheels]
        for link in (declared.pin, declared.slot)
    ]
    if all(levels):
        near = min(((a, b) for a in levels[0] for b in levels[1]), key=lambda both: abs(both[0] - both[1]))
        return sum(near) / 2
    return next((level[0] for level in levels if level), dot(_point(stage, stage.train.tree.axis(declared.pin)), axis))


def _at_height(point: Vector, axis: Vector, height: float) -> Vector:
    return plus(point, axis, height - dot(point, axis))
