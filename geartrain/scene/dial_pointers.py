"""Dials, pointers, the gear pairs on which each pointer depends, and dates.

An output depends on the pairs whose errors would change it; this dependence is computed exactly. An error in one pair
is a right-hand side in the row of that pair. Its effect on an output is the weight of that row in the only combination
of rows that gives the output, so that one elimination of the transposed system gives the dependence of all outputs. The
mean speed of a pin follower, which oscillates, does not depend on the speed of its pin, but its position does: the
pairs that turn the pin are included too.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from math import hypot, inf, pi, sqrt
from typing import TYPE_CHECKING

from geartrain.kinematics.judged_outputs import SpeedValue, goal_of
from geartrain.kinematics.willis_system import axis_sense, relative_speed
from geartrain.numerics.elimination import LinearForm, TooDenseError, eliminate
from geartrain.numerics.exact import fraction_text, read_fraction
from geartrain.numerics.quantity import millimetres
from geartrain.numerics.vectors import Vector, beside, cross, dot, minus, plus, scaled, size
from geartrain.scene.context import SceneContext, exact
from geartrain.scene.dial_scale import DialScale, engrave, scale_of
from geartrain.scene.layout import WheelPlace
from geartrain.scene.stroke_letters import HANDS, Stroke, hand_with_ball
from geartrain.scene.train_scene import DialFace, Pointer, PointerTarget, SceneEpoch, SceneSetting
from geartrain.train.outputs import RING, looks_away
from geartrain.train.sky import angle_at, mean_elements, read_sky_angle

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit
    from geartrain.kinematics.willis_system import WillisSystem
    from geartrain.train import Output


# ---------------------------------------------------------------------------------------------------- output dependence


_BUDGET = 4_000_000  # maximum number of operations of the elimination


def find_dependence(stage: SceneContext) -> Mapping[str, tuple[str, ...]]:
    """Return the names of the pairs and couplings on which each output depends, in order from the input.

    The result is empty for a train that does not move, or whose system is too dense to be eliminated.
    """
    if not stage.answer.verdict:
        return {}
    system = stage.train.equations(stage.answer.state)
    circuits = {circuit.id: circuit for circuit in stage.train.circuits}
    followers = [circuit for circuit in circuits.values() if circuit.kind == "pin_follower"]
    frame = stage.train.declaration.frame
    ends = [_seen(stage, *output.links(name, frame)) for name, output in stage.outputs.items()]
    ends += [_seen(stage, circuit.j, circuit.carrier) for circuit in followers]
    try:
        weights = _weights(system, ends)
    except TooDenseError:
        return {}
    swings = dict(zip((circuit.id for circuit in followers), weights[len(stage.outputs) :], strict=True))
    found = {}
    for name, used in zip(stage.outputs, weights, strict=False):
        every, left = set(used), set(swings)
        # with the pairs that turn the pins of followers; repeated, because another follower may turn the link of a pin
        while met := every & left:
            left -= met
            every.update(*(swings[follower] for follower in met))
        found[name] = _ordered(stage, circuits, every)
    return found


def _seen(stage: SceneContext, of: str, base: str) -> dict[str, int]:
    """Return the coefficients, by link, with which speeds are added to give the speed of `of` relative to `base`."""
    found, base = {of: 1}, stage.train.kinematics.tree.reference(of, base)
    found[base] = found.get(base, 0) - axis_sense(of, base, stage.train.kinematics.signs)
    return found


def _weights(system: WillisSystem, outputs: Sequence[Mapping[str, int]]) -> list[set[str]]:
    """Return, for each output, the labels of the equations (of pairs, inputs and brakes) that determine its speed."""
    columns: dict[str, LinearForm] = {link: {} for link in system.links}
    for at, row in enumerate(system.equations):
        for link, coefficient in row.terms:
            columns[link][at] = Fraction(coefficient)
    for number, output in enumerate(outputs):
        for link, factor in output.items():
            if factor:
                columns[link][-1 - number] = Fraction(-factor)
    # rows of the transposed system; negative columns are outputs, as right-hand sides
    forms = eliminate(columns.values(), _BUDGET).forms(_BUDGET)
    found: list[set[str]] = [set() for _ in outputs]
    for at, form in forms.items():
        for number in range(len(outputs)):
            if form.get(-1 - number):
                found[number].add(system.equations[at].label)
    return found


def _ordered(stage: SceneContext, circuits: Mapping[str, Circuit], used: Iterable[str]) -> tuple[str, ...]:
    """Return the pairs in `used` and all pairs of their loops, in breadth-first order from the inputs."""
    left = dict.fromkeys(name for name in circuits if name in set(used))
    for loop in stage.train.mobility.loops:
        if any(pair in left for pair in loop.pairs):
            left.update(dict.fromkeys(loop.pairs))
    touching: dict[str, list[str]] = {}
    for name in left:
        for link in {circuits[name].i, circuits[name].j, circuits[name].carrier}:
            touching.setdefault(link, []).append(name)
    frame = stage.train.declaration.frame
    queue = deque(link for link in (stage.driving_link, *stage.case.inputs) if link is not None)
    seen = {frame, *queue}
    found: dict[str, None] = {}
    while queue:
        for name in touching.get(queue.popleft(), ()):
            if name not in found:
                found[name] = None
                for link in (circuits[name].j, circuits[name].i, circuits[name].carrier):
                    if link not in seen:
                        seen.add(link)
                        queue.append(link)
    return (*found, *(name for name in left if name not in found))


# -------------------------------------------------------------------------------------------------------- dial pointers


Key = tuple[str, str, str]
"""Key of a dial: name of the dial, link on which it is mounted, and axis of the pointer that is read on it."""

_APART = 0.96  # maximum sum of the radii of two neighbours, divided by their distance
_SPIRAL = 1.8  # radius of a spiral divided by that of a circle next to it
_NESTED = 0.74  # radius divided by that of the dial around it
_OUT, _BALL = 0.5, 0.07  # distance of a ball from the axis, and its radius, divided by the radius of its dial
_SPHERE, _INWARDS = (0.78, 0.05), 0.12  # reach of a sphere and its radius over that of its scale; less for the next one
_RINGS, _BEAD = (0.12, 0.7), 0.035  # radii of the rings of beads, and maximum radius of a bead, in the same way
_LOWEST, _STEP = 0.02, 0.018  # heights of hands without pipes divided by the radius of the dial
_PARTS = 4000  # integer units of an engraving in a radius
_SAME = 1e-6  # mm
_MINIMUM = 0.3  # minimum width of a side for the size of its dials, divided by the train's width
_GAP = 0.04  # gap between wheels and dials, and between dials, divided by the train's width


def find_dials(stage: SceneContext) -> Mapping[Key, DialFace]:
    """Return the faces of all declared dials that show an output: one face for each carrying link and pointer axis."""
    declared = stage.train.declaration
    faces: dict[Key, DialFace] = {}
    width = train_width(stage)
    for name, output in stage.outputs.items():
        dial = declared.dials.get(output.dial or "")
        key = dial_key(stage, name)
        if dial is None or key is None or key in faces:
            continue
        normal = facing(stage, name)
        zero, scale = beside(stage.reference(key[2])), scale_of(dial)
        axis, placed = stage.layout.axes.get(key[2]), False
        if dial.centre is not None and axis is not None:
            x, y = (float(millimetres(each)) for each in dial.centre)
            placed = hypot(dot(axis.point, cross(zero, normal)) - x, dot(axis.point, zero) - y) < _SAME
        faces[key] = DialFace(
            id=key[0],
            body=stage.body[key[1]],
            face=dial.face or "",
            centre=_beyond_wheels(stage, key[2], normal, _GAP * width),
            normal=normal,
            zero=zero,
            placed=placed,
            # an upper bound, which `_fitted` reduces
            radius=0.4 * min(width, _side_width(stage, normal)),
            scale=scale,
            look=dial.look,
            note=dial.note or "",
            engraving=_engraving(scale) if dial.look == "scale" else (),
        )
    scales = _fitted({key: face for key, face in faces.items() if face.look == "scale"}, _GAP * width)
    for key, face in scales.items():
        if (given := declared.dials[key[0]].diameter) is not None:
            scales[key] = replace(face, radius=float(millimetres(given)) / 2)
    for key, face in faces.items():
        if key not in scales:  # a ball next to the axis of its pointer, unless another pointer carries it
            foot = stage.layout.axes[key[2]].point if key[2] in stage.layout.axes else (0.0, 0.0, 0.0)
            at, radius = plus(foot, face.normal, _OUT * face.radius), _BALL * face.radius
            faces[key] = replace(face, centre=at, radius=radius)
    return faces | scales


@lru_cache(maxsize=64)
def _engraving(scale: DialScale) -> tuple[tuple[str, float, tuple[tuple[int, ...], ...]], ...]:
    """Return the kind, the line width and the lines of each part of an engraving as tuples, which can be compared.

    A line is stored as integer differences of successive coordinates, in 1/4,000 of the dial's radius.
    """
    return tuple((each.kind, round(each.width, 4), tuple(map(_differences, each.lines))) for each in engrave(scale))


def _differences(line: Stroke) -> tuple[int, ...]:
    x = y = 0
    found: list[int] = []
    for point in line:
        u, v = (round(_PARTS * each) for each in point)
        found += (u - x, v - y)
        x, y = u, v
    return tuple(found)


def with_balls(dials: Sequence[DialFace], pointers: Sequence[Pointer]) -> tuple[DialFace, ...]:
    """Return the dials, with each ball that shows the Moon's phase moved into the hand that carries it."""
    found = list(dials)
    for at, face in enumerate(dials):
        if face.look != "ball":
            continue
        own = [(each, dials[each.dial]) for each in pointers if each.body == face.body and each.dial is not None]
        for hand, under in [pair for pair in own if pair[1].look == "scale"][:1]:
            foot = plus(under.centre, under.normal, hand.level)
            centre, radius = plus(foot, face.normal, _OUT * under.radius), _BALL * under.radius
            found[at] = replace(face, centre=centre, radius=radius)
    return tuple(found)


def with_titles(dials: Sequence[DialFace], pointers: Sequence[Pointer]) -> tuple[DialFace, ...]:
    """Return the dials with titles, which include the outputs if dials about different axes have the same name."""
    often = Counter(face.id for face in dials)
    read = [", ".join(each.output for each in pointers if each.dial == at) for at in range(len(dials))]
    return tuple(
        replace(face, title=f"{face.id} ({outputs})" if often[face.id] > 1 else face.id)
        for face, outputs in zip(dials, read, strict=True)
    )


def dial_key(stage: SceneContext, name: str) -> Key | None:
    """Return the key of the dial on which an output is shown; None if the output has no dial."""
    output = stage.outputs[name]
    if output.dial is None:
        return None
    of, base = output.links(name, stage.train.declaration.frame)
    return output.dial, base, stage.train.kinematics.tree.axis(of) or ""


def facing(stage: SceneContext, name: str) -> Vector:
    """Return the unit vector along an output's axis towards the reader of its dial, on the side that the dial faces."""
    declared = stage.train.declaration
    output = stage.outputs[name]
    along = stage.along(stage.train.kinematics.tree.axis(output.of or name))
    side = dot(along, stage.near)
    # rounding errors must not decide for an axis perpendicular to the view: it keeps its direction
    normal = along if side > 0 or abs(side) < 1e-9 else scaled(along, -1.0)
    dial = declared.dials.get(output.dial or "")
    away = dial is not None and looks_away(dial.face, declared.view.from_)
    return scaled(normal, -1.0) if away else normal


def train_width(stage: SceneContext) -> float:
    """Return the largest minus the smallest of all x and y coordinates of the wheels [mm]."""
    places = stage.layout.wheels.values()
    if not places:
        return 1.0
    low = min(place.centre[at] - place.radius for place in places for at in (0, 1))
    high = max(place.centre[at] + place.radius for place in places for at in (0, 1))
    # not 0, because sizes of dials are relative to it
    return max(high - low, 1e-6)


def _side_width(stage: SceneContext, normal: Vector) -> float:
    """Return the width [mm] of the side of the train on which a dial is placed; infinite for the front and the back."""
    # a cosine of 0.5 (60 degrees) separates dials on the front and back from dials on the sides
    if abs(dot(normal, stage.near)) > 0.5:
        return inf
    ways: list[Vector] = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
    wide = (_extent(stage, way) for way in ways if abs(dot(way, normal)) < 0.5)
    return max(min(wide, default=inf), _MINIMUM * train_width(stage))


def _extent(stage: SceneContext, way: Vector) -> float:
    """Return the extent of all wheels along a direction [mm]."""
    ends = []
    for wheel in stage.layout.wheels.values():
        along = dot(stage.layout.axes[wheel.axis].direction, way)
        flat = wheel.radius * sqrt(max(0.0, 1 - along * along))
        low, high = _faces(stage, wheel, way)
        ends += [low - flat, high + flat]
    return max(ends) - min(ends) if ends else inf


def _beyond_wheels(stage: SceneContext, axis: str, normal: Vector, gap: float) -> Vector:
    """Return the point on an axis that is `gap` [mm] beyond all wheels in the direction `normal`."""
    place = stage.layout.axes.get(axis)
    point = (0.0, 0.0, 0.0) if place is None else place.point
    wheels = stage.layout.wheels.values()
    top = max((_faces(stage, wheel, normal)[1] - dot(point, normal) for wheel in wheels), default=0.0)
    return plus(point, normal, top + gap)


def _faces(stage: SceneContext, wheel: WheelPlace, way: Vector) -> tuple[float, float]:
    """Return the lower and the upper position of the face centres of a wheel, measured along a direction [mm]."""
    along = dot(stage.layout.axes[wheel.axis].direction, way)
    low, high = sorted(dot(wheel.centre, way) + at * along for at in wheel.span)
    return low, high


def _fitted(faces: dict[Key, DialFace], gap: float) -> dict[Key, DialFace]:
    """Return the dials with radii reduced so that no dials overlap.

    Dials about one axis are nested, and each is `gap` / 4 [mm] above the previous one.
    """
    about: dict[tuple[Vector, Vector], list[Key]] = {}
    for key, face in faces.items():
        about.setdefault((_rounded(face.centre), _rounded(face.normal)), []).append(key)
    found = {}
    share = {at: max(_SPIRAL if faces[key].scale.turns > 1 else 1.0 for key in keys) for at, keys in about.items()}
    for (centre, normal), keys in about.items():
        radius, own = faces[keys[0]].radius, share[centre, normal]
        for (other, way), theirs in share.items():
            apart = size(minus(other, centre))
            if way == normal and apart > 0:
                radius = min(radius, _APART * apart * own / (own + theirs))
        own = radius
        for depth, key in enumerate(keys):
            face = faces[key]
            high = plus(face.centre, face.normal, gap * 0.25 * depth)
            found[key] = replace(face, radius=own, centre=high)
            own *= _NESTED - (RING if face.scale.around else 0.0)
    return {key: found[key] for key in faces}


def _rounded(u: Vector) -> Vector:
    return round(u[0], 6), round(u[1], 6), round(u[2], 6)  # removes rounding errors, for use as a key


def find_pointers(stage: SceneContext, dials: Mapping[Key, DialFace]) -> tuple[Pointer, ...]:
    """Return a pointer for every output of the state; hands on one dial are stacked in the order of declaration."""
    paths, keys, taken = find_dependence(stage), tuple(dials), Counter[str]()
    found, spheres = [], 0
    for name in stage.outputs:
        pointer = _pointer(stage, name, keys, paths.get(name, ()))
        if pointer.dial is not None:
            face = dials[keys[pointer.dial]]
            shape = stage.outputs[name].hand
            orbit = _orbit(stage, name, face) if shape == "bead" else (_SPHERE[0] - spheres * _INWARDS, _SPHERE[1])
            spheres += shape == "sphere"
            ball = {"sphere": _SPHERE[1], "bead": orbit[1]}.get(shape, 0.0)
            hand = hand_with_ball(*orbit) if ball else HANDS.get(shape, HANDS["needle"])
            level = face.radius * (_LOWEST + _STEP * taken[face.id])
            pointer = replace(
                pointer, level=level, reach=hand.reach, outline=hand.stations, hand=shape, ball=ball * face.scale.outer
            )
            taken[face.id] += 1
        found.append(pointer)
    return tuple(found)


def _orbit(stage: SceneContext, name: str, face: DialFace) -> tuple[float, float]:
    """Return the outer radius of the ring that a bead (a ball used as a pointer) covers, and the radius of the bead.

    Both are in radii of the scale. The rings of a dial are equidistant; the ring of the first output is innermost.
    """
    dial = stage.outputs[name].dial
    rings = [each for each, output in stage.outputs.items() if output.hand == "bead" and output.dial == dial]
    inner, outer = _RINGS
    step = (outer - inner) / len(rings)
    ball = min(_BEAD, 0.4 * step)
    return inner + step * (rings.index(name) + 0.5) + ball, ball


def _pointer(stage: SceneContext, name: str, dials: Sequence[Key], pairs: Sequence[str]) -> Pointer:
    output = stage.outputs[name]
    of, base = output.links(name, stage.train.declaration.frame)
    signs, seen = stage.train.kinematics.signs, stage.train.kinematics.tree.reference(of, base)
    speed, ratio = (_exact(relative_speed(of, seen, each, signs)) for each in (stage.speed, stage.ratio))
    # viewed against its axis, a positive angle is counter-clockwise
    sense = -1 if dot(stage.along(stage.train.kinematics.tree.axis(of)), facing(stage, name)) > 0 else 1
    key = dial_key(stage, name)
    by_id = {circuit.id: circuit for circuit in stage.train.circuits}
    circuits = [by_id[pair] for pair in pairs]
    bodies = dict.fromkeys(stage.body[link] for c in circuits for link in (c.j, c.i, c.carrier))
    wheels = dict.fromkeys(stage.wheel[wheel] for c in circuits if c.kind == "gear" for wheel in c.wheels)
    return Pointer(
        output=name,
        body=stage.body[of],
        base=stage.body[seen],
        dial=dials.index(key) if key in dials else None,
        speed=exact(ratio),
        shown=stage.shown(speed, of),
        decimal=stage.rounded(speed, of),
        sense=sense,
        text="" if of in stage.train.kinematics.tree.lines else _as_read(sense, speed),
        pairs=tuple(pairs),
        bodies=tuple(bodies),
        wheels=tuple(wheels),
        note=output.note or "",
        targets=find_targets(stage, output, speed),
    )


def _exact(speed: SpeedValue | None) -> Fraction | None:
    return None if speed is None else Fraction(speed)


def _as_read(sense: int, speed: Fraction | None) -> str:
    if not speed:
        return "at rest" if speed is not None else ""
    return f"{'clockwise' if (speed > 0) == (sense > 0) else 'counter-clockwise'} as read"


# ---- the sky: dates of turns of the driving link, and mean motions that pointers should show


def find_epoch(stage: SceneContext, pointers: Sequence[Pointer], dials: Sequence[DialFace]) -> SceneEpoch | None:
    """Return the declared date with its turns of the driving link and pointer angles; None if it is not available."""
    declared = stage.train.declaration
    epoch, unit = declared.epoch, declared.unit_days
    if epoch is None or unit is None or stage.driving_link is None:
        return None
    settings = tuple(_settings(stage, pointers, dials))
    dialled = [(each.output, dials[each.dial].scale.names) for each in pointers if each.dial is not None]
    return SceneEpoch(
        julian_day=fraction_text(epoch.julian_day),
        turns=fraction_text(epoch.turns.value),
        days=fraction_text(unit / stage.step),
        calendar=epoch.calendar,
        source=epoch.source or "",
        note=epoch.note or "",
        settings=settings,
        unset=tuple(
            output
            for output, names in dialled
            if names[:1] and names[0][0] == "Aries" and not stage.outputs[output].at_epoch
        ),
        elements=mean_elements() if settings else {},
    )


def _settings(stage: SceneContext, pointers: Sequence[Pointer], dials: Sequence[DialFace]) -> Iterator[SceneSetting]:
    for at, pointer in enumerate(pointers):
        text = stage.outputs[pointer.output].at_epoch
        if text is None or pointer.speed is None:
            continue
        (angle, body), dial = read_sky_angle(text), None if pointer.dial is None else dials[pointer.dial]
        sense = 1 if dial is None or dial.look == "ball" else pointer.sense * dial.scale.way
        yield SceneSetting(at, sense, angle, body)


def angles_at_start(
    stage: SceneContext, epoch: SceneEpoch, pointers: Sequence[Pointer], dials: Sequence[DialFace]
) -> dict[str, float]:
    """Return the angles of links at 0 turns [rad] for which the pointers have their declared angles at the epoch."""
    links, found = tuple(stage.body), dict[str, float]()
    for setting in epoch.settings:
        pointer = pointers[setting.pointer]
        of, base = links[pointer.body], links[pointer.base]
        angle = angle_at(setting.angle, float(Fraction(epoch.julian_day)))
        turned = read_fraction(pointer.speed or "0") * Fraction(epoch.turns)
        own = (setting.sense * angle - float(turned)) % (1 if pointer.dial is None else dials[pointer.dial].scale.turns)
        found[of] = 2 * pi * own + stage.sense(of) * stage.sense(base) * found.get(base, stage.start(base))
    slots = {}  # a slot without an angle follows its pin
    for coupling in stage.train.declaration.pin_couplings:
        pin, slot = coupling.pin, coupling.slot
        if coupling.kind == "pin_and_slot" and pin in found and slot not in found:
            swing = found[pin] - stage.start(pin)
            slots[slot] = stage.sense(slot) * stage.sense(pin) * swing + stage.start(slot)
    return found | slots


def find_targets(stage: SceneContext, output: Output, speed: Fraction | None) -> tuple[PointerTarget, ...]:
    """Return the target speeds of an output, divided by the speed of the driving link.

    A target that prescribes only a magnitude has the sign of `speed`, the speed of the output.
    """
    if stage.driving_link is None or speed is None:
        return ()
    driving_speed = stage.case.inputs[stage.driving_link]
    found = []
    for target in output.targets:
        goal = goal_of(stage.train.declaration, target)
        wanted = -goal.speed if not goal.signed and speed < 0 else goal.speed
        found.append(PointerTarget(goal.label, fraction_text(wanted / driving_speed), target.source or ""))
    return tuple(found)
