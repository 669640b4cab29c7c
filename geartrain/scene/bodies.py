"""Links of a scene with their axes and parents, and wheels with their positions and the profile of one tooth each.

Wheels without a flat outline (bevels, crowns, worms, and wheels that cannot be cut) get nominal teeth.

A declaration places the flexible wheel of a strain wave on an axis that the generator carries, as if the wheel were
rigid. This gives the speed of the wheel. The scene places the deformed wheel about the generator's own axis, and its
teeth mesh with the ring at each lobe (docs/reducers.md, (8)).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import acos, atan2, ceil, cos, pi, sqrt, tan
from typing import TYPE_CHECKING

from geartrain.dynamics.train_teeth import STANDARD, TrainTeeth, find_train_teeth
from geartrain.errors import Problem
from geartrain.numerics.vectors import Vector, across, minus, size, unit_or_z
from geartrain.scene.context import SceneContext, exact
from geartrain.scene.elements import SceneBody, SceneWave, SceneWheel, ToothProfile
from geartrain.teeth.outlines.fixed_teeth import wall
from geartrain.teeth.standard_teeth import ADDENDUM, DEDENDUM

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.scene.layout import Layout, WheelPlace
    from geartrain.train import Wheel as Declared


# --------------------------------------------------------------------------------------------------------- strain waves


@dataclass(frozen=True, slots=True)
class BentWheel:
    """Flexible wheel of a strain wave gear, the link that deforms it, and the offset and lobes of its wave."""

    wheel: str
    link: str
    """Name of the link that is the wave generator."""
    axis: str
    """Label of the axis of the wave generator."""
    offset: Vector
    """Vector from the wave generator's axis to the declared axis of the wheel [mm], along the first lobe."""
    lobes: int
    """Number of lobes of the wave: the tooth count of the ring minus the tooth count of the flexible wheel."""


def bent_wheels(train: GearTrain, layout: Layout) -> Iterator[BentWheel]:
    """Yield every flexible wheel of a train that is deformed by a wave generator."""
    declared = train.declaration
    for gear in declared.gears:
        thin = next((name for name in gear.pair if declared.wheels[name][1].flexible), None)
        place = None if thin is None else layout.axes.get(train.kinematics.tree.axis(declared.wheels[thin][0]) or "")
        label = None if place is None else train.kinematics.tree.axis(place.carrier)
        if thin is None or place is None or label is None:
            continue
        own = layout.axes[label]
        counts = (declared.wheels[name][1] for name in gear.pair)
        lobes = abs(sum((wheel.count or 0) * (1 if wheel.internal else -1) for wheel in counts))
        # only the offset perpendicular to the axis deforms the wheel: it may also be displaced along the axis
        offset = across(minus(place.point, own.point), unit_or_z(own.direction))
        if lobes and size(offset):
            yield BentWheel(thin, place.carrier, label, offset, lobes)


def bend(
    stage: SceneContext, bodies: Sequence[SceneBody], wheels: Sequence[SceneWheel]
) -> tuple[tuple[SceneBody, ...], tuple[SceneWheel, ...], tuple[SceneWave, ...]]:
    """Return bodies, wheels and strain waves; flexible wheels are moved to the axes of their wave generators.

    A flexible wheel is declared off centre, on an axis that the generator carries.
    """
    bent, moved, waves = list(bodies), list(wheels), []
    for each in bent_wheels(stage.train, stage.layout):
        at, by = stage.wheel[each.wheel], stage.body[each.link]
        wheel = wheels[at]
        bent[wheel.body] = replace(bodies[wheel.body], parent=bodies[by].parent, point=bodies[by].point)
        moved[at] = replace(wheel, centre=minus(wheel.centre, each.offset))
        way, rise, thin = unit_or_z(each.offset), size(each.offset), wall(wheel.radius)
        waves.append(SceneWave(at, by, way, rise, each.lobes, wheel.root - thin / 2, thin))
    return tuple(bent), tuple(moved), tuple(waves)


# -------------------------------------------------------------------------------------------------------- nominal teeth


Points = tuple[tuple[float, float], ...]
"""Points of a flank or of a whole tooth. Each point is a radius divided by the pitch radius, and an angle [rad]."""

FORM = "likeness"
_PRESSURE = pi / 9
_BACKLASH = 0.02  # circumferential backlash per tooth, in pitches
_MINIMUM_ROOT = 0.2  # minimum root radius divided by the pitch radius: with few teeth little is left
_ROOM = 0.92  # maximum half width of a tooth at the root, divided by half a pitch
_POINTS = 10  # points of a flank
_PASSING = 0.12  # height (modules) per tooth of difference between ring and wheel
_CROWN_BACKLASH = 0.06  # pitches: no rack meshes with a crown's flanks, so its teeth are thinner
_STEP = pi / 18  # rad between points of a thread's section, as a worm has few threads
_LAND = 0.08  # minimum half width of a tip, divided by half a pitch


def spur(z: int, height: float = ADDENDUM) -> ToothProfile:
    """Return a nominal tooth of an external wheel with z teeth, at most `height` [modules] above the pitch circle."""
    return ToothProfile(FORM, _tooth(z, min(ADDENDUM, height)))


def ring(z: int, height: float = ADDENDUM) -> ToothProfile:
    """Return a nominal tooth of an internal gear with z teeth, at most `height` [modules] inside the pitch circle."""
    most = 1 + 2 * DEDENDUM / z
    # a tooth space of the ring is a tooth of an external wheel, higher and slightly wider
    tip = max(1 - 2 * min(ADDENDUM, height) / z, _MINIMUM_ROOT)
    half = pi / z
    # a space of an external wheel is wider than half a pitch by the backlash, and a tooth narrower by as much
    flank = [(r, half - _half(z, r) - 2 * _BACKLASH * pi / z) for r in _spread(tip, most)]
    return ToothProfile(
        FORM, _mirrored([(r, min(max(angle, _LAND * half), _ROOM * half)) for r, angle in reversed(flank)], z)
    )


def _root(z: float) -> float:
    return max(1 - 2 * DEDENDUM / z, _MINIMUM_ROOT)


def bevel(z: int, cone: float) -> ToothProfile:
    """Return a nominal tooth of a bevel wheel at its large end, by Tredgold's virtual spur wheel on the back cone.

    Each radius of the profile is 1 plus the height above the pitch cone along the back cone; `cone` is the half angle
    of the pitch cone [rad].
    """
    # the back cone of a crown wheel is a cylinder: its teeth are nearly those of a rack
    narrow = max(cos(cone), 1e-3)
    # tooth count of the virtual spur wheel (Tredgold)
    virtual = z / narrow
    points = _tooth(virtual)
    return ToothProfile(FORM, tuple((1 + (r - 1) / narrow, angle / narrow) for r, angle in points))


def crown(z: int, mate: int, section: Sequence[tuple[float, float]]) -> ToothProfile:
    """Return a tooth of a crown wheel with z teeth, whose spaces fit the `section` (radius, angle) of its mate."""
    import numpy as np

    r, angle = np.array([point for point in section if point[1] >= 0]).T
    heights, halves = (1 - r) * mate / 2, 0.5 - angle * mate / (2 * pi) - _CROWN_BACKLASH
    # the same bottom clearance at the roots of its mate and at its own
    low, high = heights[0] - (DEDENDUM - ADDENDUM), heights[-1] - (DEDENDUM - ADDENDUM)
    at = [low, *heights[heights < high], high]
    widths = np.clip(np.interp(at, heights, halves), _LAND / 2, _ROOM / 2)
    return ToothProfile(FORM, _mirrored([(1 + 2 * h / z, w * 2 * pi / z) for h, w in zip(at, widths, strict=True)], z))


def worm(starts: int, height: float) -> ToothProfile:
    """Return the axial section of a worm's thread as a tooth profile; `height` is the addendum over the radius."""
    half = pi / starts
    low, high = max(1 - DEDENDUM * height, _MINIMUM_ROOT), 1 + height
    flanks = [(low, -0.75 * half), (high, -0.25 * half), (high, 0.25 * half), (low, 0.75 * half)]
    corners = [(low, -half), *flanks, (low, half)]
    points = [corners[0]]
    for (r, angle), (to, end) in pairwise(corners):
        steps = ceil((end - angle) / _STEP)
        points += [(r + (to - r) * at / steps, angle + (end - angle) * at / steps) for at in range(1, steps + 1)]
    return ToothProfile(FORM, tuple(points))


def _tooth(z: float, addendum: float = ADDENDUM) -> Points:
    root = _root(z)
    tip = 1 + 2 * addendum / z
    # a pointed tooth is shortened until its tip has a minimum width
    while _half(z, tip) < _LAND * pi / z and tip > 1:
        tip = 1 + 0.9 * (tip - 1)
    flank = [(r, min(_half(z, r), _ROOM * pi / z)) for r in _spread(root, tip)]
    return _mirrored(flank, z)


def _spread(low: float, high: float) -> list[float]:
    return [low + (high - low) * at / (_POINTS - 1) for at in range(_POINTS)]


def _half(z: float, r: float) -> float:
    """Return the half-angle [rad] of a tooth with `z` teeth per turn at the radius `r` [pitch radii], with undercut."""
    base = cos(_PRESSURE)
    inner = 0.0 if r <= base else sqrt((r / base) ** 2 - 1) - acos(base / r)
    involute = (pi / 2 * (1 - 2 * _BACKLASH)) / z + tan(_PRESSURE) - _PRESSURE - inner
    # the rack undercuts only where its path is inside the involute
    return min(involute, pi / z - _swept(z, r))


def _swept(z: float, r: float) -> float:
    """Return half the angle [rad] of the tooth space that the tips of a rack cut out at `r` pitch radii."""
    # the rack's tip corner is b from the middle of the rack's tooth, and c above the wheel's axis
    c = 1 - 2 * ADDENDUM / z
    b = pi / 2 / z - (1 - c) * tan(_PRESSURE)
    # a rotation of the wheel by u - b displaces the corner by u, to the angle atan(u / c) - (u - b)
    u = sqrt(max(r * r - c * c, 0.0))
    return atan2(u, c) - u + b if c > 0 and r < 1 else 0.0


def _mirrored(flank: list[tuple[float, float]], z: float) -> Points:
    """Return a whole tooth between the middles of two tooth spaces, given one flank from root to tip."""
    root = flank[0][0]
    before = [(r, -angle) for r, angle in flank]
    return ((root, -pi / z), *before, *reversed(flank), (root, pi / z))


# --------------------------------------------------------------------------------------------------------------- bodies


def find_bodies(stage: SceneContext) -> tuple[SceneBody, ...]:
    """Return the bodies of all links, in the order in which the links are declared."""
    return tuple(_body(stage, link) for link in stage.train.declaration.links)


def _body(stage: SceneContext, link: str) -> SceneBody:
    tree, train = stage.train.kinematics.tree, stage.train
    label = tree.axis(link) or ""
    place = stage.layout.axes.get(label)
    role = "carrier" if link in tree.top.values() else "arbor"
    # coaxial links are carried by the link that carries their axis, whatever joints were declared
    bearer = tree.top.get(link)
    speed, travels = stage.speed(link), link in tree.lines
    return SceneBody(
        id=link,
        parent=None if bearer is None else stage.body[bearer],
        axis=label,
        point=(0.0, 0.0, 0.0) if place is None else place.point,
        direction=stage.line(label) if travels else stage.reference(label),
        sense=stage.sense(link),
        speed=exact(stage.ratio(link)),
        shown=stage.shown(speed, link),
        decimal=stage.rounded(speed, link),
        start=stage.start(link),
        role="frame" if link == train.declaration.frame else role,
        bookkeeping=link in train.kinematics.joint_sums,
        note=train.declaration.links[link].note or "",
        travels=travels,
        base=None if bearer is None or tree.bearer(link) == bearer else stage.body[tree.bearer(link)],
    )


def find_profiles(stage: SceneContext) -> tuple[dict[str, ToothProfile], tuple[Problem, ...]]:
    """Return each wheel's profile, nominal if its teeth cannot be cut as declared, and a notice of each reason."""
    toothed = find_train_teeth(stage.train.mechanics, stage.layout.wheels)
    cut = {
        wheel: ToothProfile(each.form, each.section(), each.kind == "pins")
        for wheel, each in {**toothed.approximations, **toothed.wheels}.items()
    }
    profiles = {
        wheel: cut[wheel] if wheel in cut else _approximation(stage, toothed, wheel)
        for wheel in stage.train.declaration.wheels
    }
    return profiles, tuple(_notices(stage, toothed))


def _notices(stage: SceneContext, toothed: TrainTeeth) -> Iterator[Problem]:
    """Yield warnings about planar wheels that are drawn with approximate teeth, and about flexible wheels without a
    wave generator.
    """
    by_reason: dict[tuple[str, str, str, bool], list[str]] = {}
    for wheel, problems in toothed.problems.items():
        if wheel in toothed.flat:
            first = problems[0]
            by_reason.setdefault((first.what, first.why, first.fix, wheel in toothed.approximations), []).append(wheel)
    for (what, why, fix, of_first), wheels in by_reason.items():
        names = " and ".join(f"'{wheel}'" for wheel in wheels)
        drawn = "drawn with teeth that fit only the first pair of each wheel" if of_first else "drawn approximately"
        yield Problem(f"the wheels {names} are {drawn}: {what}", why, fix)
    bent = {each.wheel for each in bent_wheels(stage.train, stage.layout)}
    for name, (_, own) in stage.train.declaration.wheels.items():
        if own.flexible and name not in bent:
            why = "its axis is not carried off centre by a wave generator inside a ring with another tooth count"
            fix = "declare the strain wave gear as in trains/engineering/strain-wave.yaml"
            yield Problem(f"flexible wheel '{name}' is drawn undeformed", why, fix)


def _approximation(stage: SceneContext, toothed: TrainTeeth, name: str) -> ToothProfile:
    _, wheel = stage.train.declaration.wheels[name]
    place, z = stage.layout.wheels[name], wheel.count or 1
    if wheel.kind == "worm":
        return worm(z, stage.layout.wheels[next(_mates(stage, name), name)].module / place.radius)
    shaped = next((toothed.wheels[mate] for mate in _mates(stage, name) if mate in toothed.wheels), None)
    if place.cone and shaped is not None and shaped.form != STANDARD and shaped.pins is None:
        return crown(z, shaped.z, shaped.section())
    if place.cone:
        return bevel(z, place.cone)
    heights = []  # at which a tooth does not touch the roots of a mate with few teeth
    for mate in (stage.train.declaration.wheels[mate][1] for mate in _mates(stage, name)):
        count = mate.count or 1
        if wheel.internal or mate.internal:  # the tips must also clear each other outside of the mesh
            heights.append(_PASSING * abs(z - count))
        else:
            heights.append(count / 2 * (1 - _root(count)) - (DEDENDUM - ADDENDUM) / 2)
    return (ring if wheel.internal else spur)(z, *([min(heights)] if heights else []))


def _mates(stage: SceneContext, name: str) -> Iterator[str]:
    """Yield the wheels with which a wheel meshes."""
    for circuit in stage.train.circuits:
        if name in circuit.wheels:
            yield circuit.wheels[1 - circuit.wheels.index(name)]


def find_wheels(
    stage: SceneContext, profiles: Mapping[str, ToothProfile], turns: Mapping[str, float]
) -> tuple[tuple[SceneWheel, ...], tuple[ToothProfile, ...]]:
    """Return all wheels in the order of declaration, and the tooth profiles to which the wheels refer.

    profiles   tooth profile of each wheel, by name
    turns      angle [rad] of the first tooth of each wheel about the direction of its body
    """
    shared: dict[ToothProfile, int] = {}
    circuits: dict[str, list[str]] = {}
    for circuit in stage.train.circuits:
        if circuit.kind == "gear":
            for each in circuit.wheels:
                circuits.setdefault(each, []).append(circuit.id)
    losses = _losses(stage)
    found = []
    for name, (link, wheel) in stage.train.declaration.wheels.items():
        profile = profiles[name]
        number = shared.setdefault(profile, len(shared))
        place = stage.layout.wheels[name]
        found.append(
            _wheel(stage, place, link, wheel, profile, number, turns[name], circuits.get(name, []), losses.get(name))
        )
    return tuple(found), tuple(shared)


def _wheel(
    stage: SceneContext,
    place: WheelPlace,
    link: str,
    wheel: Declared,
    profile: ToothProfile,
    number: int,
    turn: float,
    circuits: list[str],
    loss: float | None,
) -> SceneWheel:
    radii = [place.radius * r for r, _ in profile.points]
    inner, outer = min(radii), max(radii)
    same = flip(stage, place)
    uncertainty = wheel.uncertainty
    helix = wheel.helix if wheel.is_helical else 0.0
    if wheel.kind == "worm":
        lead = pi * place.module * (wheel.count or 1)
        # relative to the axis: the complement of the lead angle, which tables of worms give
        helix = (-1 if wheel.hand == "left" else 1) * atan2(2 * pi * place.radius, lead)
    return SceneWheel(
        id=place.wheel,
        body=stage.body[link],
        teeth=wheel.count or 1,
        kind="ring" if wheel.internal else "pins" if profile.hole else wheel.kind,
        centre=place.centre,
        direction=stage.reference(place.axis),
        reference=place.reference,
        turn=turn,
        radius=place.radius,
        tip=inner if wheel.internal else outer,
        root=outer if wheel.internal else inner,
        module=place.module,
        thickness=place.thickness,
        cone=place.cone,
        facing=place.facing * same,
        profile=number,
        layer=place.layer,
        status=wheel.status or "",
        source=wheel.source or (uncertainty.source if uncertainty and uncertainty.source else "") or "",
        note=wheel.note or (uncertainty.note if uncertainty and uncertainty.note else "") or "",
        doubt=_uncertainty(wheel),
        circuits=tuple(circuits),
        loss=loss,
        helix=helix,
    )


def flip(stage: SceneContext, place: WheelPlace) -> int:
    """Return -1 if the declared direction of an axis is opposite to the reference direction of the axes parallel to it,
    or 1 if it is not.
    """
    return 1 if stage.along(place.axis) == stage.reference(place.axis) else -1


def as_placed(stage: SceneContext, wheel: str) -> float:
    """Return the angle of a wheel's first tooth in the layout, about the reference direction of its axis [rad]."""
    place = stage.layout.wheels[wheel]
    return place.turn * flip(stage, place)


def _uncertainty(wheel: Declared) -> str:
    """Return the tooth counts that the evidence allows for a wheel, as text; empty if the count is certain."""
    uncertainty = wheel.uncertainty
    if uncertainty is None:
        return ""
    if uncertainty.range is not None:
        return f"{uncertainty.range[0]} to {uncertainty.range[1]} teeth"
    return f"{', '.join(map(str, uncertainty.allowed[:-1]))} or {uncertainty.allowed[-1]} teeth"


def _losses(stage: SceneContext) -> dict[str, float]:
    """Return the fraction of the input power that is lost at each wheel: half the loss of each of its pairs."""
    declared = stage.train.declaration
    if not stage.answer.verdict or not declared.is_loaded(stage.answer.state):
        return {}
    torques = stage.train.torques(stage.answer.state)
    power = torques.power_in if torques.verdict else 0
    if not power:
        return {}
    found: dict[str, float] = {}
    for gear in declared.gears:
        pair = torques.pairs.get(gear.name)
        if pair is not None and not pair.loose:
            for wheel in gear.pair:
                found[wheel] = found.get(wheel, 0.0) + float(pair.loss / power) / 2
    return found
