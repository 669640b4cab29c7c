"""Joints of a scene: equations of gear pairs, gear pairs that prevent the train from turning, and pins in slots."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi, sin
from typing import TYPE_CHECKING, Any

from geartrain.numerics.vectors import Vector, across, beside, dot, minus, plus, size, turned, unit_or_z
from geartrain.scene.context import SceneContext
from geartrain.scene.elements import SceneCoupling, ScenePair, SceneShiftElement
from geartrain.scene.movement import MovementStart
from geartrain.teeth.couplings.pins import Parallel, PinsInHoles

if TYPE_CHECKING:
    from geartrain.kinematics.answer import Loop
    from geartrain.kinematics.circuits import Circuit
    from geartrain.teeth.couplings.pins import PinCoupling as Declared


def find_pairs(stage: SceneContext, faults: Mapping[str, str]) -> tuple[ScenePair, ...]:
    """Return all gear pairs in the order of declaration; `faults` describes the fault of each faulty pair, by name."""
    forms = {mesh.name: mesh.form for mesh in stage.meshes}
    return tuple(
        ScenePair(
            id=circuit.id,
            wheels=(stage.wheel[circuit.wheels[0]], stage.wheel[circuit.wheels[1]]),
            carrier=stage.body[circuit.carrier],
            ratio=str(circuit.ratio),
            form=forms.get(circuit.id, ""),
            text=in_words(circuit, stage.train.kinematics.signs),
            broken=circuit.id in faults,
            fault=faults.get(circuit.id, ""),
        )
        for circuit in stage.train.circuits
        if circuit.kind == "gear"
    )


def in_words(circuit: Circuit, signs: Mapping[str, int]) -> str:
    """Return the equation of a circuit in terms of declared speeds, such as `64 (b - frame) + 38 (c - frame) = 0`."""
    i, j, k = (f"-{link}" if signs.get(link, 1) < 0 else link for link in (circuit.i, circuit.j, circuit.carrier))
    minus = "+" if k.startswith("-") and signs.get(circuit.carrier, 1) < 0 else "-"
    k = k.removeprefix("-") if minus == "+" else k
    first = _term(circuit.a, f"({i} {minus} {k})")
    if not circuit.b:
        return f"{first} = 0"
    return f"{first} {'-' if circuit.b < 0 else '+'} {_term(abs(circuit.b), f'({j} {minus} {k})')} = 0"


def _term(factor: int, what: str) -> str:
    return what if factor == 1 else f"{factor} {what}"


def find_verdict(stage: SceneContext) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the verdict with its faulty loops as plain data, and the fault of each faulty pair as text, by name."""
    verdict = stage.answer.verdict
    faults: dict[str, str] = {}
    loops = {loop.pairs: _loop_data(loop) for loop in verdict.loops}
    # a determined train may still have parts that are locked
    if verdict.kind != "determined" or stage.train.mobility.locked:
        for jam in stage.train.kinematics.gridlock.jams:
            loops.setdefault(jam.loop.pairs, {**_loop_data(jam.loop), "text": str(jam)})
    unusable = []  # pairs whose tooth forms cannot run together, in the format of a faulty loop
    for mesh in stage.meshes:
        if (fault := mesh.fault) is not None:
            links = [stage.train.declaration.wheels[wheel][0] for wheel in mesh.gear.pair]
            said = "; ".join(filter(None, (fault.what, fault.why, fault.fix)))
            unusable.append({"pairs": [mesh.name], "links": links, "text": said})
    for loop in (*loops.values(), *unusable):
        loops.setdefault(tuple(loop["pairs"]), loop)
        for pair in loop["pairs"]:
            faults.setdefault(pair, loop["text"])
    fixes = [] if stage.train.kinematics.gridlock.moves else list(stage.train.kinematics.gridlock.lines())
    return {
        "kind": verdict.kind,
        "text": verdict.text,
        "links": list(verdict.links),
        "loops": list(loops.values()),
        "advice": fixes,
    }, faults


def _loop_data(loop: Loop) -> dict[str, Any]:
    return {"pairs": list(loop.pairs), "links": list(loop.links), "text": f"{loop} does not close"}


def find_elements(stage: SceneContext, state: str | None) -> tuple[SceneShiftElement, ...]:
    """Return the brakes and clutches in the order of declaration, each engaged or open in one state."""
    declared = stage.train.declaration
    case = stage.train.kinematics.cases[state]
    actions = {each.name: each for each in case.one_way}
    found = []
    for name, clutch in declared.clutches.items():
        links = clutch.locks or (clutch.fixes or declared.frame,)
        bodies = tuple(stage.body[link] for link in links)
        brakes = clutch.locks is None
        text = f"{name} {'brakes' if brakes else 'joins'} {' and '.join(links)}"
        if name in actions:
            text += f" one way ({'holds' if actions[name].holds else 'overruns'})"
        closed, one_way = name in case.engaged, name in actions
        found.append(SceneShiftElement(name, "brake" if brakes else "clutch", bodies, closed, text, one_way))
    return tuple(found)


# default ratio of offset to pin radius
_LIKE = {"pin_and_slot": 0.15, "pin_follower": 3.0, "pins_in_holes": 0.1}
_PART = 0.65  # default diameter of a hole divided by the distance between two pins
_REACH = 10.0  # default pin radius (mm)
_NONE = 1e-9  # mm: smaller distances are rounding errors


def find_couplings(stage: SceneContext, moved: MovementStart) -> tuple[SceneCoupling, ...]:
    """Return all couplings by pins, in the order of declaration."""
    circuits = {circuit.id: circuit for circuit in stage.train.circuits}
    drawn = (each for each in stage.train.declaration.pin_couplings if not isinstance(each, Parallel))
    return tuple(_coupling(stage, moved, circuits[each.name], each) for each in drawn)


def _coupling(stage: SceneContext, moved: MovementStart, circuit: Circuit, declared: Declared) -> SceneCoupling:
    tree = stage.train.kinematics.tree
    axis = stage.reference(tree.axis(declared.pin))
    pin_axis, slot_axis = (_point(stage, tree.axis(link)) for link in (declared.pin, declared.slot))
    between = across(minus(slot_axis, pin_axis), axis)
    radius, offset = coupling_sizes(declared, size(between))
    towards = unit_or_z(between) if size(between) > _NONE else beside(axis)
    towards = _clear_of_carried(stage, declared, pin_axis, axis, towards)
    pin, hole = pin_and_hole(declared, radius, offset)
    height = _height(stage, declared, axis)
    pin_axis, slot_axis = (plus(point, axis, height - dot(point, axis)) for point in (pin_axis, slot_axis))
    slot_turn, setting = 0.0, moved.driving.get(circuit.id)
    if setting is not None:  # the slot is at an angle from its pin that follows from the starting angles
        followed = float(circuit.ratio) * setting.S + setting.error
        slot_turn = setting.forward * followed - (moved.rest[circuit.i] - moved.rest[circuit.carrier])
    return SceneCoupling(
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
        text=in_words(circuit, stage.train.kinematics.signs),
        slot_turn=slot_turn,
        pins_at=_around(declared, pin_axis, towards, radius, axis),
        holes_at=_around(declared, slot_axis, towards, radius, axis),
        pin_diameter=pin,
        hole=hole,
    )


def _clear_of_carried(stage: SceneContext, declared: Declared, middle: Vector, axis: Vector, towards: Vector) -> Vector:
    """Return the unit vector from the axis of the pin's link to its first pin, with pins between carried axes."""
    if isinstance(declared, PinsInHoles):
        tree = stage.train.kinematics.tree
        same = (each for each in stage.train.declaration.pin_couplings if isinstance(each, PinsInHoles))
        first = next(each for each in same if each.pin == declared.pin)  # its pins pass through all discs
        between = across(minus(_point(stage, tree.axis(first.slot)), middle), axis)
        towards = unit_or_z(between) if size(between) > _NONE else towards
        for place in stage.layout.axes.values():
            aside = across(minus(place.point, middle), axis)
            if place.carrier == declared.pin and size(aside) > _NONE:
                return turned(unit_or_z(aside), axis, pi / declared.pins)
    return towards


def _around(declared: Declared, middle: Vector, towards: Vector, radius: float, axis: Vector) -> tuple[Vector, ...]:
    """Return equally spaced points on a circle, the first in the direction `towards`; empty for a pin in a slot."""
    number = declared.pins if isinstance(declared, PinsInHoles) else 0
    return tuple(plus(middle, turned(towards, axis, 2 * pi * at / number), radius) for at in range(number))


def pin_and_hole(declared: Declared, radius: float, offset: float) -> tuple[float, float]:
    """Return the diameter of the pins and the diameter of their round holes [mm]; both are 0 for a pin in a slot."""
    if not isinstance(declared, PinsInHoles):
        return 0.0, 0.0
    apart = 2 * radius * sin(pi / declared.pins)
    # a hole is wider than its pin by 2 offset, so that a large offset leaves little space for the pin
    pin = max(_PART * apart - 2 * offset, 0.1 * apart)
    if declared.pin_diameter is not None:
        own = declared.pin_diameter
        pin = 1000 * own.si if own.unit is not None else float(own.value)
    return pin, pin + 2 * offset


def coupling_sizes(declared: Declared, apart: float) -> tuple[float, float]:
    """Return the pin radius and the offset [mm], as declared or in default proportions to the axis distance `apart`."""
    if declared.pin_radius is not None and declared.offset is not None:
        radius, offset = declared.pin_radius.si * 1000, declared.offset.si * 1000
        if declared.pin_radius.unit is None:
            radius, offset = radius / 1000, offset / 1000
            # sizes without a unit define only a ratio: the distance of the placed axes sets the scale
            if apart > _NONE and offset > 0:
                radius, offset = radius * apart / offset, apart
        return radius, offset
    if apart > _NONE:
        return apart / _LIKE[declared.kind], apart
    return _REACH, _REACH * _LIKE[declared.kind]


def _point(stage: SceneContext, label: str | None) -> Vector:
    place = stage.layout.axes.get(label or "")
    return (0.0, 0.0, 0.0) if place is None else place.point


def _height(stage: SceneContext, declared: Declared, axis: Vector) -> float:
    """Return the height of a pin along its axis [mm], if possible midway between the nearest wheels of both links."""
    levels = [
        [dot(stage.layout.wheels[wheel].centre, axis) for wheel in stage.train.declaration.links[link].wheels]
        for link in (declared.pin, declared.slot)
    ]
    if all(levels):
        near = min(((a, b) for a in levels[0] for b in levels[1]), key=lambda both: abs(both[0] - both[1]))
        return sum(near) / 2
    return next(
        (level[0] for level in levels if level),
        dot(_point(stage, stage.train.kinematics.tree.axis(declared.pin)), axis),
    )
