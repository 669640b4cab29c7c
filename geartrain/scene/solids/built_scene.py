"""Scene of a train as built, with plates, arbors and dials, and with hands at the ends of arbors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import GearTrainError
from geartrain.numerics.vectors import Vector, dot, minus, plus
from geartrain.scene.construction import make_scene
from geartrain.scene.dial_pointers import with_balls
from geartrain.scene.elements import ScenePart
from geartrain.scene.parts.frame_plan import FramePlan
from geartrain.scene.solids.carrier_cages import hanging_solids
from geartrain.scene.solids.manufacturing_sizes import ManufacturingSizes
from geartrain.scene.solids.solid_assembly import SolidModel
from geartrain.scene.solids.solid_part import SolidPart
from geartrain.scene.solids.standing_pins import with_pins_apart

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.elements import SceneWheel
    from geartrain.scene.scene_run import TimeRun
    from geartrain.scene.train_scene import DialFace, Pointer, Scene

_FINE = 0.05  # mm: tolerance of chords of plates
_FIT = 0.01  # mm: tolerance of chords of holes, less than the 0.04 mm of a running fit
_DIGITS = 4  # decimals of lengths in mm
_HAND = 1.0  # mm of an arbor's end inside a hand
_LAID = 0.2  # mm from a bracket to the face of a dial on it
_CLEAR = 1.0  # mm from the edge of a dial on a bracket to other arbors
_EDGE = 1.08  # radius of the edge of such a dial divided by that of its engraving
_SAME = 1e-6


def build_scene(
    train: GearTrain, state: str | None = None, run: TimeRun | None = None, formulas: bool = False
) -> Scene:
    """Return the scene of a train with its structural parts, at the same positions as in exports.

    Parameters
    ----------
    train : GearTrain
        Loaded or declared train.
    state : str, optional
        State of the train; by default the first state, or the state of the run.
    run : geartrain.simulation.TimeRun, optional
        Result of `train.dynamics(...)` in that state, which replaces the exact motion of the scene.
    formulas : bool
        Same as in `make_scene`.

    Returns
    -------
    Scene
        Scene of `make_scene` with `parts`, and with wheels moved along their axes to make space for plates. If no parts
        can be built, the scene of `make_scene` is returned.

    Raises
    ------
    GearTrainError
        If the state does not exist, or the run is of another train or state.

    Examples
    --------
    >>> import geartrain
    >>> scene = build_scene(geartrain.load("planetary-24-18-60"))
    >>> sorted({part.kind for part in scene.parts})
    ['arbor', 'carrier', 'frame', 'pillar', 'pipe', 'post', 'stud']
    """
    state = train.declaration.state_or_first(run.state if state is None and run is not None else state)
    model = SolidModel(train, ManufacturingSizes(), state)
    try:
        parts = tuple(_scene_part(each, model) for each in model.structure)
    except GearTrainError:
        return make_scene(train, state, run=run, formulas=formulas)
    # backlash added for manufacture is not declared, so the scene moves without it
    plain = run is None and not formulas and model.sized is model.train
    scene = model.scene if plain else make_scene(train, state, model.layout, run, formulas)
    scene = scene if model.plan is None else with_pins_apart(scene, model.plan)
    dials, pointers = _sized_dials(scene, model), tuple(scene.pointers)
    if model.plan is not None:
        pointers = tuple(_on_arbor(each, scene, dials, model.plan) for each in pointers)
        dials = _with_seated(dials, pointers)
        # again, for the hands of dials that are now seated on other hands
        pointers = tuple(_on_arbor(each, scene, dials, model.plan) for each in pointers)
    for at in range(len(dials)):
        dials, pointers = _on_bracket(at, scene, dials, pointers, parts)
    wheels = tuple(_with_holes(each, model) for each in scene.wheels)
    found = replace(scene, parts=parts, wheels=wheels, dials=with_balls(dials, pointers), pointers=pointers)
    if (hanging := model.hanging) is None:
        return found
    solids = {each: hanging_solids(each, hanging.frame) for each in hanging.found()}
    hangers = (replace(each, parts=tuple(_scene_part(part, model) for part in own)) for each, own in solids.items())
    return replace(found, hangers=(*found.hangers, *hangers))


def _with_holes(wheel: SceneWheel, model: SolidModel) -> SceneWheel:
    """Return a wheel with its slots and its hole for an eccentric; other holes are not seen, as parts fill them."""
    blank = model.blanks.wheels.get(wheel.id)
    moved_in = {cut.slot.id for cut in model.cut_couplings.values()}
    if model.plan is not None:
        moved_in |= {name for each in model.plan.stack.eccentrics if each.wave is None for name in each.wheels}
    if blank is None or wheel.id not in moved_in:
        return wheel
    # with backlash the wheels of the model have other angles
    turn = next(each.turn for each in model.scene.wheels if each.id == wheel.id) - wheel.turn
    way = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    turned = ((each.flattened(_FIT) @ way).round(_DIGITS) for each in blank.contours[1:])
    return replace(wheel, holes=tuple(tuple(each.ravel().tolist()) for each in turned))


def _scene_part(part: SolidPart, model: SolidModel) -> ScenePart:
    """Return a solid part as a record of the scene, without its triangles."""
    kind = part.kind
    if kind == "plate" and model.frame is not None:
        turning = {plate.disc.name for plate in model.frame.plan.turning}
        frame = model.frame.plan.stack.frame
        if part.name in (dial.name for dial in model.dials):
            kind = "dial"
        elif part.name in (f"{frame} back plate", f"{frame} front plate", f"{frame} bridge"):
            kind = "frame"
        elif part.name in turning:
            kind = "carrier"
    bands = () if part.turned is None else part.turned.bands
    return ScenePart(
        part.body,
        part.name,
        kind,
        _vector(part.place),
        _vector(part.turn[:, 2]),
        _vector(part.turn[:, 0]),
        tuple((_round(each.low), _round(each.high), _round(each.radius), _round(each.bore)) for each in bands),
        tuple(tuple(each.flattened(_FINE).round(_DIGITS).ravel().tolist()) for each in part.contours),
        part.height,
    )


def _round(value: float) -> float:
    return round(float(value), _DIGITS)


def _vector(values: Floats) -> Vector:
    x, y, z = values.round(9).tolist()
    return x, y, z


def _sized_dials(scene: Scene, model: SolidModel) -> tuple[DialFace, ...]:
    """Return the dials. Each has the size of its plate and is on the face of the plate that is read."""
    faces = list(scene.dials)
    if model.plan is None:
        return tuple(faces)
    stack = model.plan.stack
    for plate in model.dials:
        for circle in plate.circles:
            for at, face in enumerate(faces):
                radius = circle.radii.get(face.id)
                if radius is None or np.hypot(*np.subtract(stack.flat(face.centre), circle.at)) > _SAME:
                    continue
                height = plate.high if dot(face.normal, stack.normal) > 0 else plate.low
                faces[at] = replace(face, centre=stack.in_space(circle.at, height), radius=radius, plate=circle.radius)
    return tuple(faces)


def _with_seated(dials: Sequence[DialFace], pointers: Sequence[Pointer]) -> tuple[DialFace, ...]:
    """Return the dials; each dial that is fixed to a hand of another dial is moved to the height of this hand."""
    found = list(dials)
    for at, face in enumerate(dials):
        for each in pointers:
            under = None if each.dial is None else dials[each.dial]
            if face.plate or not each.seat or under is None or each.body != face.body or each.dial == at:
                continue
            off = minus(face.centre, under.centre)
            high = dot(off, under.normal)
            if under.normal == face.normal and dot(off, off) - high * high < _SAME:
                found[at] = replace(face, centre=plus(under.centre, face.normal, each.level), seated=True)
    return tuple(found)


def _on_bracket(
    at: int, scene: Scene, dials: tuple[DialFace, ...], pointers: tuple[Pointer, ...], parts: Sequence[ScenePart]
) -> tuple[tuple[DialFace, ...], tuple[Pointer, ...]]:
    """Return all dials and pointers, with one dial moved to the bracket that supports the arbor of its pointers.

    at   index of the dial. Neighbouring arbors limit its radius. It is unchanged if it has a plate, or if a bracket or
         space is missing.
    """
    face = dials[at]
    own = [n for n, each in enumerate(pointers) if each.dial == at and not each.seat]
    along = [part for part in parts if abs(dot(part.direction, face.normal)) > 1 - _SAME]
    links = tuple(f"{scene.bodies[pointers[n].body].id} bracket" for n in own)
    under = [part for part in along if part.name.startswith(links)] if links else []
    if face.plate or face.look != "scale" or not under:
        return dials, pointers
    high = max(dot(minus(part.place, face.centre), face.normal) + part.height / 2 for part in under)
    radius = face.radius
    for part in (each for each in along if each.bands):
        off = minus(part.place, face.centre)
        apart = float(np.sqrt(max(dot(off, off) - dot(off, face.normal) ** 2, 0.0)))
        if apart > _SAME:  # not coaxial
            radius = min(radius, (apart - max(band[2] for band in part.bands) - _CLEAR) / _EDGE)
    if radius <= 0:
        return dials, pointers
    laid = replace(face, centre=plus(face.centre, face.normal, high + _LAID), radius=radius)
    hands = {}
    for n in own:
        radii = (band[2] for part in along if part.body == pointers[n].body for band in part.bands)
        hands[n] = replace(pointers[n], level=_HAND / 2, seat=2 * max(radii, default=0.0))
    return (*dials[:at], laid, *dials[at + 1 :]), tuple(hands.get(n, each) for n, each in enumerate(pointers))


def _on_arbor(pointer: Pointer, scene: Scene, dials: Sequence[DialFace], plan: FramePlan) -> Pointer:
    """Return a pointer whose hand is on the end of its arbor or pipe, if an arbor or a pipe extends beyond the dial."""
    face = None if pointer.dial is None else dials[pointer.dial]
    if face is None or not (face.plate or face.seated):
        return pointer
    for column, member in plan.members_of(scene.bodies[pointer.body].id):
        ends = [
            dot(minus(plan.stack.in_space(column.at, end), face.centre), face.normal)
            for end in (member.low, member.high)
        ]
        if max(ends) > _HAND:
            return replace(pointer, level=max(ends) - _HAND / 2, seat=member.outer)
    return pointer
